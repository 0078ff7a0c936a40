//! Friction of a rim at its centre of pressure, and about the vertical.

use super::arc::Pressed;
use super::{ALL, Motion, Rim};
use crate::rocking_body::drilling;
use crate::rocking_body::moment::Moment;
use crate::shared::dual::{Dual, times};
use std::f64::consts::PI;
use trilith_element::lanes::Real;

/// What the friction does in a step.
pub(super) struct Rubbed<R> {
    pub(super) traction: [Dual<ALL, R>; 2],
    pub(super) torsion: Dual<ALL, R>,
    pub(super) slip: [R; 2],
    /// Heat, J.
    pub(super) heat: R,
}

impl<R: Real> Rim<R> {
    /// Elastic energy of the friction.
    #[inline(always)]
    pub(super) fn held(&self, [t1, t2]: [R; 2], torsion: R) -> R {
        let zero = torsion.of(0.0);
        let about = torsion / self.radius;
        let all = t1 * t1 + t2 * t2 + about * about;
        (zero.of(0.5) * all / self.ks).only(zero.lt(self.mu))
    }

    /// Friction of a step that is closed at both ends.
    #[inline(always)]
    pub(super) fn friction(
        &self,
        committed: &[R],
        (before, first): (&Moment<R>, &Pressed<0, R>),
        (now, m, p): (&Moment<R>, &Motion<ALL, R>, &Pressed<ALL, R>),
    ) -> Rubbed<R> {
        let (zero, half, one) = (self.ks.of(0.0), self.ks.of(0.5), self.ks.of(1.0));
        let (ks, kt) = (self.ks, self.ks * self.radius * self.radius);
        let mut middle = p.centre;
        for i in 0..3 {
            middle[i] = (middle[i] + first.centre[i].x) * half;
        }
        let to = times(&m.r, &middle);
        let r0 = &before.turn.matrix;
        let mut way = [to[0], to[1]];
        for i in 0..2 {
            let from = middle[0] * r0[i][0] + middle[1] * r0[i][1] + middle[2] * r0[i][2];
            way[i] = m.u[i] + -before.d[i] + to[i] - from;
        }
        let mut turn = Dual::constant(zero);
        for i in 0..3 {
            let by = Dual::variable(now.theta[i] - before.theta[i], 3 + i);
            turn = turn + (m.r[2][i] + r0[2][i]) * half * by;
        }

        let limit = p.arc.normal * self.mu;
        let old = [committed[0], committed[1]];
        let mut traction = [way[0] * ks + old[0], way[1] * ks + old[1]];
        let slips = limit.x.lt(traction[0].x.hypot(traction[1].x));
        if zero.any(slips) {
            let length = (traction[0] * traction[0] + traction[1] * traction[1]).sqrt();
            let share = limit / length;
            for t in &mut traction {
                *t = Dual::select(slips, *t * share, *t);
            }
        }
        let mut torsion = turn * kt + committed[2];
        let most = limit * self.radius;
        let may = self.may_drill(p, torsion.x.abs(), most.x) & p.closed;
        if zero.any(may) {
            let most = most * self.arm(p, may);
            let sign = R::select(zero.lt(torsion.x), one, -one);
            let drills = most.x.lt(torsion.x.abs()) & may;
            torsion = Dual::select(drills, most * sign, torsion);
        }
        let mut slip = old;
        let mut heat = zero;
        for i in 0..2 {
            slip[i] = way[i].x - (traction[i].x - old[i]) / ks;
            heat = heat + (old[i] + traction[i].x) * slip[i];
        }
        let spin = turn.x - (torsion.x - committed[2]) / kt;
        let heat = (half * (heat + (committed[2] + torsion.x) * spin)).max(zero);
        Rubbed { traction, torsion, slip, heat }
    }

    /// Mean distance of what presses from its centre, over the radius, where it is asked for.
    #[inline(always)]
    fn arm(&self, p: &Pressed<ALL, R>, asked: R::Mask) -> Dual<ALL, R> {
        let radius = self.radius * self.radius;
        let (depth, half, around);
        if let Some(stiffness) = self.arc_stiffness {
            // As deep as it would be pressed in.
            depth = p.arc.normal * (radius.of(1.0) / stiffness);
            around = (p.square.x * radius).le(depth.x * depth.x);
            let share = depth * radius.of(PI) / (p.square.sqrt() * self.radius);
            let [psi, slope] = share.x.only(asked & !around).map_pair(drilling::arc);
            half = share.map(psi, slope);
        } else {
            (depth, half, around) = (p.depth, p.arc.half, p.whole);
        }
        if !radius.any(asked & around) {
            return Self::arm_of_part(half, asked);
        }
        let flat = p.square * radius / (depth * depth);
        let [m, slope] = flat.x.only(asked & around).map_pair(drilling::of_circle);
        let all = flat.map(m, slope);
        if radius.any(asked & !around) {
            Dual::select(around, all, Self::arm_of_part(half, asked & !around))
        } else {
            all
        }
    }

    /// The same of an arc.
    #[inline(always)]
    fn arm_of_part(half: Dual<ALL, R>, asked: R::Mask) -> Dual<ALL, R> {
        let [m, slope] = half.x.only(asked).map_pair(drilling::of_arc);
        half.map(m, slope)
    }

    /// Where a torsion is more than μ N ρ times a bound below the [`arm`](Self::arm), told at once; `most` = μ N ρ.
    #[inline(always)]
    fn may_drill(&self, p: &Pressed<ALL, R>, torsion: R, most: R) -> R::Mask {
        let least = torsion.of(drilling::LEAST);
        let Some(stiffness) = self.arc_stiffness else {
            return (most * (least * p.arc.half.x)).lt(torsion);
        };
        // A half angle ψ in which a rim of this stiffness carries less: sin ψ − ψ cos ψ ≤ ψ³/3 = π N/(k b)/3.
        let cube =
            torsion.of(3.0 * PI) * p.arc.normal.x / (stiffness * p.square.x.sqrt() * self.radius);
        let share = torsion / (most * least);
        cube.lt(share * share * share) | share.of(PI).lt(share)
    }
}

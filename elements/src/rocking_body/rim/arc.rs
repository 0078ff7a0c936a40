//! The arc of a rim that is pressed, and the force of its springs.

use super::{Motion, Rim};
use crate::shared::dual::{Dual, Dual3};
use crate::shared::spatial::angle;
use std::f64::consts::PI;
use trilith_element::lanes::Real;

/// The arc that is pressed, and what the springs do there.
pub(super) struct Arc<const N: usize, R> {
    /// Half of its angle, and sine and cosine of it.
    pub(super) half: Dual<N, R>,
    pub(super) sine: Dual<N, R>,
    pub(super) cosine: Dual<N, R>,
    /// Direction from the centre to its middle, the lowest point, in the axes of the body; any for the whole rim.
    pub(super) low: [Dual<N, R>; 2],
    /// Energy of the springs, J.
    pub(super) energy: R,
    /// Normal force, and the g of the centre of pressure.
    pub(super) normal: Dual<N, R>,
    pub(super) g: Dual<N, R>,
}

impl<const N: usize, R: Real> Arc<N, R> {
    #[inline(always)]
    fn select(mask: R::Mask, yes: &Self, no: &Self) -> Self {
        Self {
            half: Dual::select(mask, yes.half, no.half),
            sine: Dual::select(mask, yes.sine, no.sine),
            cosine: Dual::select(mask, yes.cosine, no.cosine),
            low: [
                Dual::select(mask, yes.low[0], no.low[0]),
                Dual::select(mask, yes.low[1], no.low[1]),
            ],
            energy: R::select(mask, yes.energy, no.energy),
            normal: Dual::select(mask, yes.normal, no.normal),
            g: Dual::select(mask, yes.g, no.g),
        }
    }
}

/// How the rim is pressed in at one moment; what it holds counts where it is closed.
pub(super) struct Pressed<const N: usize, R: Real> {
    /// Where it is pressed at all, and where all around.
    pub(super) closed: R::Mask,
    pub(super) whole: R::Mask,
    /// How deep its plane is pressed in at the middle of the rim, and the square of the sine of the tilt.
    pub(super) depth: Dual<N, R>,
    pub(super) square: Dual<N, R>,
    pub(super) arc: Arc<N, R>,
    /// Centre of pressure in the axes of the body.
    pub(super) centre: Dual3<N, R>,
}

impl<R: Real> Rim<R> {
    /// Distance of the lowest point from the ground, negative while pressed, and forces of the springs, where some rim is closed.
    #[inline(always)]
    pub(super) fn pressed<const N: usize>(&self, m: &Motion<N, R>) -> (R, Option<Pressed<N, R>>) {
        let w = &m.r[2];
        let depth = -m.u[2] - m.sunk * self.depth;
        let square = w[0] * w[0] + w[1] * w[1];
        let b = self.radius * square.x.sqrt();
        let (closed, whole) = ((-b).lt(depth.x), b.le(depth.x));
        let gap = -(depth.x + b);
        if !gap.any(closed) {
            return (gap, None);
        }
        let arc = if !gap.any(closed & !whole) {
            self.all_around(depth, b)
        } else {
            let arc = self.arc(depth, square, w);
            if gap.any(whole) { Arc::select(whole, &self.all_around(depth, b), &arc) } else { arc }
        };
        let share = arc.g / arc.normal;
        let centre = [-(w[0] * share), -(w[1] * share), Dual::constant(-self.depth)];
        (gap, Some(Pressed { closed, whole, depth, square, arc, centre }))
    }

    /// All of it is pressed; `b` = ρ s.
    #[inline(always)]
    pub(super) fn all_around<const N: usize>(&self, a: Dual<N, R>, b: R) -> Arc<N, R> {
        let (zero, half) = (b.of(0.0), b.of(0.5));
        Arc {
            half: Dual::constant(b.of(PI)),
            sine: Dual::constant(zero),
            cosine: Dual::constant(b.of(-1.0)),
            low: [Dual::constant(b.of(1.0)), Dual::constant(zero)],
            energy: half * self.kn * (a.x * a.x + half * (b * b)),
            normal: a * self.kn,
            g: Dual::constant(half * self.kn * (self.radius * self.radius)),
        }
    }

    /// A part of it is pressed.
    #[inline(always)]
    pub(super) fn arc<const N: usize>(
        &self,
        a: Dual<N, R>,
        square: Dual<N, R>,
        w: &Dual3<N, R>,
    ) -> Arc<N, R> {
        let (zero, two) = (a.x.of(0.0), a.x.of(2.0));
        let per_angle = self.kn * zero.of(0.5 / PI);
        let tilt = square.sqrt();
        let b = tilt * self.radius;
        let cosine = -(a / b);
        // Where the arc begins or closes its angle has no slope; what is made of it has.
        let across = ((b.x - a.x) * (b.x + a.x)).max(zero).sqrt();
        let (sine, psi) = (across / b.x, angle(-a.x, across));
        let slope = zero.of(-1.0) / sine.max(zero.of(1e-6));
        let both = psi + sine * cosine.x;
        let twice = two * sine;
        let normal = a.with(
            b,
            per_angle * two * (a.x * psi + b.x * sine),
            per_angle * two * psi,
            per_angle * twice,
        );
        let by_b =
            a.with(b, per_angle * (twice * a.x + b.x * both), per_angle * twice, per_angle * both);
        let back = Dual::constant(zero.of(1.0)) / tilt;
        Arc {
            half: cosine.map(psi, slope),
            sine: cosine.map(sine, cosine.x * slope),
            cosine,
            low: [-(w[0] * back), -(w[1] * back)],
            energy: zero.of(0.5) * (a.x * normal.x + b.x * by_b.x),
            normal,
            g: by_b * back * self.radius,
        }
    }
}

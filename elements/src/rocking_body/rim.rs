//! A circular base: contact along a rim, in closed form, so that the body rolls on it without corners.
//!
//! ```text
//!   w = Rᵀ e_z,  s = √(w₁² + w₂²)                   the vertical in the axes of the body, sine of the tilt
//!   a = −u_z − h (1 − w₃),  b = ρ s                  penetration of the rim: δ(ψ) = a + b cos ψ, ψ from its lowest point
//!   U = (kₙ/4π) ∫ δ² dψ over |ψ| < ψ꜀,  cos ψ꜀ = −a/b     ψ꜀ = π where the whole rim is pressed
//!   N = ∂U/∂a,  moment ∂U/∂w × w                    forces of the springs
//!   c/(2π) δ̇ over the same arc                      dashpots; they may pull
//!   r꜀ = (−w₁ g/N, −w₂ g/N, −h),  g = ∂U/∂b ρ²/b     centre of pressure in the axes of the body
//!   T ← T + kₛ Δs, |T| ≤ μ N                         friction there; Δs: way of the material point
//!   M ← M + kₛ ρ² Δϑ, |M| ≤ μ N ρ m                  torsion about the vertical, see `drilling.rs`
//! ```
//!
//! Rolling moves the centre of pressure along the rim without slip, because T follows the way of the
//! material that is there. A rim that closes within a step anchors where it is at its end.
//!
//! Springs and friction depend on u and φ alone; the dashpots are linear in the rates, so that their tangent by these
//! is written down.

mod arc;
mod dashpots;
mod friction;

use super::moment::Moment;
use crate::shared::dual::{Dual, Dual3, cross, rotation, transposed_times};
use crate::shared::lever::Carried;
use crate::shared::spatial::{self, Rotation, V3};
use arc::Pressed;
use dashpots::Damped;
use friction::Rubbed;
use trilith_element::history;
use trilith_element::lanes::{LaneContact, LaneStep, Real};

history! {
    /// Friction of the rim.
    pub(super) struct RimHistory {
        /// Friction force along X and Y on the body's contact.
        traction1: "N",
        traction2: "N",
        /// Moment of friction about the vertical.
        torsion: "N*m",
        /// Slip along X and Y so far.
        slip1: "m",
        slip2: "m",
        /// 1 while closed; for records.
        closed: "1",
    }
}

/// Variables: u and φ.
const ALL: usize = 6;

/// The body at one moment, with the derivatives by all variables or none.
struct Motion<const N: usize, R> {
    u: Dual3<N, R>,
    /// R, row by row.
    r: [Dual3<N, R>; 3],
    /// 1 − w₃ with all its digits.
    sunk: Dual<N, R>,
    rate: V3<R>,
    spin: V3<R>,
}

impl<const N: usize, R: Real> Motion<N, R> {
    #[inline(always)]
    fn new(of: &Moment<R>) -> Self {
        let r: [Dual3<N, R>; 3] = rotation(&of.turn.matrix, &of.jacobian, 3);
        let sunk = sunk(&of.turn);
        let sunk = r[2][2].map(sunk, sunk.of(-1.0));
        Self { u: Dual::variables(&of.d, 0), r, sunk, rate: of.v, spin: of.spin }
    }
}

/// 1 − w₃ with all its digits.
#[inline(always)]
fn sunk<R: Real>(turn: &Rotation<R>) -> R {
    let [_, x, y, _] = turn.quaternion;
    x.of(2.0) * (x * x + y * y)
}

/// A circular base of a body.
pub(super) struct Rim<R = f64> {
    pub radius: R,
    /// Below the centre of gravity.
    pub depth: R,
    pub kn: R,
    pub damping: R,
    pub mu: R,
    /// Any where there is no friction.
    pub ks: R,
    pub arc_stiffness: Option<R>,
}

impl RimHistory {
    /// Of a rim that stands.
    pub fn closed() -> Self {
        Self { closed: 1.0, ..Self::default() }
    }
}

impl<R: Real> Rim<R> {
    /// Forces, tangents, energies and history over a step.
    #[inline(always)]
    pub fn respond(
        &self,
        (before, now): (&Moment<R>, &Moment<R>),
        dt: R,
        committed: &[R],
        trial: &mut [R],
    ) -> (Carried<R>, LaneStep<R>) {
        let zero = dt.of(0.0);
        let no = zero.lt(zero);
        let (m0, m) = (Motion::<0, R>::new(before), Motion::<ALL, R>::new(now));
        let ((_, first), (_, p)) = (self.pressed(&m0), self.pressed(&m));
        let mut was_closed = no;
        let mut power = zero;
        if let Some(first) = &first {
            was_closed = first.closed;
            power = self.dashpots(&m0, first).power.only(was_closed);
        }
        let mut out = Carried::nothing(zero);
        let mut rubbed = Rubbed {
            traction: [Dual::constant(zero); 2],
            torsion: Dual::constant(zero),
            slip: [zero; 2],
            heat: zero,
        };
        let (mut closed, mut energy) = (no, zero);
        if let Some(p) = &p {
            closed = p.closed;
            let rubs = closed & was_closed & zero.lt(self.mu);
            if let Some(first) = first.as_ref().filter(|_| zero.any(rubs)) {
                let it = self.friction(committed, (before, first), (now, &m, p));
                for i in 0..2 {
                    rubbed.traction[i] = it.traction[i].only(rubs);
                    rubbed.slip[i] = it.slip[i].only(rubs);
                }
                rubbed.torsion = it.torsion.only(rubs);
                rubbed.heat = it.heat.only(rubs);
            }
            let damped = self.dashpots(&m, p);
            energy = p.arc.energy.only(closed);
            power = power + damped.power.only(closed);
            self.assemble((&m, p), &damped, &rubbed, &mut out);
        }
        let [t1, t2, torsion, slip1, slip2, _] = *committed else {
            unreachable!("history of a rim")
        };
        // What the friction held goes where the contact opens.
        let lost = self.held([t1, t2], torsion).only(was_closed & !closed);
        let [t1, t2] = [rubbed.traction[0].x, rubbed.traction[1].x];
        let torsion = rubbed.torsion.x;
        let [s1, s2] = [slip1 + rubbed.slip[0], slip2 + rubbed.slip[1]];
        trial.copy_from_slice(&[t1, t2, torsion, s1, s2, dt.of(1.0).only(closed)]);
        let step = LaneStep {
            stored: energy + self.held([t1, t2], torsion),
            hysteretic: rubbed.heat + lost,
            viscous: dt.of(0.5) * dt * power,
        };
        (out, step)
    }

    /// Force and moment on the node where the rim is closed.
    #[inline(always)]
    fn assemble(
        &self,
        (m, p): (&Motion<ALL, R>, &Pressed<ALL, R>),
        damped: &Damped<ALL, R>,
        rubbed: &Rubbed<R>,
        out: &mut Carried<R>,
    ) {
        let w = &m.r[2];
        let total = p.arc.normal + damped.normal;
        let q = [p.arc.g * w[0] + damped.q[0], p.arc.g * w[1] + damped.q[1], total * self.depth];
        let [t1, t2] = rubbed.traction;
        let sideways = [t1, t2, Dual::constant(total.x.of(0.0))];
        let arm = cross(&p.centre, &transposed_times(&m.r, &sideways));
        let springs = cross(&q, w);
        let mut force = [t1, t2, -total, t1, t1, t1];
        for i in 0..3 {
            force[3 + i] = springs[i] + arm[i] + rubbed.torsion * w[i];
        }
        for i in 0..6 {
            out.f[i] = force[i].x.only(p.closed);
            for j in 0..6 {
                out.k[i][j] = force[i].by[j].only(p.closed);
            }
        }
        let w = [w[0].x, w[1].x, w[2].x];
        let by = self.by_rates(&w, &p.arc);
        for j in 2..6 {
            let normal = by[0][j].only(p.closed);
            let q = [by[1][j].only(p.closed), by[2][j].only(p.closed), normal * self.depth];
            let moment = spatial::cross(&q, &w);
            out.c[2][j] = -normal;
            for i in 0..3 {
                out.c[3 + i][j] = moment[i];
            }
        }
    }

    /// How high the highest point of the rim is above the ground, m.
    #[inline(always)]
    pub fn uplift(&self, d: &V3<R>, turn: &Rotation<R>) -> R {
        let tilt = turn.matrix[2][0].hypot(turn.matrix[2][1]);
        d[2] + self.depth * sunk(turn) + self.radius * tilt
    }

    /// What the lowest point of the rim does, which carries the body, and the highest, which lifts off.
    #[inline(always)]
    pub fn contacts(&self, now: &Moment<R>, history: &[R]) -> [LaneContact<R>; 2] {
        let m = Motion::<0, R>::new(now);
        let (gap, p) = self.pressed(&m);
        let (zero, one) = (gap.of(0.0), gap.of(1.0));
        let position = [history[3], history[4]];
        let mut low = LaneContact { gap, normal: zero, position, slipping: zero };
        if let Some(p) = &p {
            let normal = p.arc.normal.x;
            let size = history[0].hypot(history[1]);
            let slips = zero.lt(size) & (self.mu * normal * zero.of(1.0 - 1e-9)).le(size);
            low.normal = normal.max(zero).only(p.closed);
            low.slipping = one.only(slips & p.closed);
        }
        let rise = zero.of(2.0) * self.radius * m.r[2][0].x.hypot(m.r[2][1].x);
        [low, LaneContact { gap: gap + rise, normal: zero, position, slipping: zero }]
    }
}

//! The body at one moment.

use crate::shared::rotation::{Turn, rows};
use crate::shared::spatial::{M3, Rotation, V3, angle};
use trilith_element::lanes::Real;

/// How it stands and moves.
pub(super) struct Moment<R> {
    pub turn: Rotation<R>,
    /// Jᵣ(φ), with φ since the start of the step.
    pub jacobian: M3<R>,
    pub d: V3<R>,
    /// Rotations of its node.
    pub theta: V3<R>,
    pub v: V3<R>,
    pub spin: V3<R>,
}

/// Tilt of a body that has turned, where its vertical axis leans along X and Y, and how high the highest point of its
/// base is.
#[inline(always)]
pub(super) fn posture<R: Real>(turn: &Rotation<R>, uplift: R) -> [R; 4] {
    let m = &turn.matrix;
    let axis = [m[0][2], m[1][2], m[2][2]];
    // The angle by its sine where its cosine is flat.
    [angle(axis[2], axis[0].hypot(axis[1])), axis[0], axis[1], uplift]
}

impl Moment<f64> {
    /// Of a body of one analysis.
    pub fn of(turn: &Turn, d: &[f64], v: &[f64]) -> Self {
        let three = |x: &[f64]| [x[0], x[1], x[2]];
        Self {
            turn: turn.rotation(),
            jacobian: rows(&turn.jacobian),
            d: three(d),
            theta: three(&d[3..]),
            v: three(v),
            spin: three(&v[3..]),
        }
    }
}

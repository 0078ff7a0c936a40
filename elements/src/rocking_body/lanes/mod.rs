//! The body over lanes: what is the same for a body on base points and on a rim.
//!
//! In a plane, X and Z, it has three coordinates: the others are zero, and are put beside them.

mod rolling;
mod standing;

use super::RockingBody;
use super::law::TURNED;
use super::moment::{Moment, posture};
use crate::shared::lever::Carried;
use crate::shared::spatial::{Rotation, V3, right_jacobian};
use crate::shared::wrench::gyroscopic;
use trilith_element::lanes::{LaneForce, LaneForm, Real};

/// Coordinates in a plane, and in space.
const PLANE: [usize; 3] = [0, 2, 4];
const SPACE: [usize; 6] = [0, 1, 2, 3, 4, 5];

/// First parameters of every body: the tilt at which it counts as overturned, and its moments of inertia.
const OWN: usize = 4;

/// All six of some coordinates.
#[inline(always)]
fn all<const N: usize, R: Real>(x: &[R]) -> [V3<R>; 2] {
    if N == 6 {
        return [[x[0], x[1], x[2]], [x[3], x[4], x[5]]];
    }
    let zero = x[0].of(0.0);
    [[x[0], zero, x[1]], [zero, x[2], zero]]
}

/// By how it had turned at the start of the step.
#[inline(always)]
fn moment<const N: usize, R: Real>(history: &[R], d: &[R], v: &[R]) -> Moment<R> {
    let ([d, theta], [v, spin]) = (all::<N, R>(d), all::<N, R>(v));
    let by = [theta[0] - history[0], theta[1] - history[1], theta[2] - history[2]];
    let quaternion = [history[3], history[4], history[5], history[6]];
    let (turn, jacobian) = (Rotation::new(&quaternion, &by), right_jacobian(&by));
    Moment { turn, jacobian, d, theta, v, spin }
}

/// The answer: what the base does and the gyroscopic moment.
#[inline(always)]
fn answer<const N: usize, R: Real>(
    mut base: Carried<R>,
    parameters: &[R],
    spin: &V3<R>,
    out: &mut LaneForce<'_, R>,
) {
    let (moment, by_spin) = gyroscopic(&[parameters[1], parameters[2], parameters[3]], spin);
    for i in 0..3 {
        base.f[3 + i] = base.f[3 + i] + moment[i];
        for j in 0..3 {
            base.c[3 + i][3 + j] = base.c[3 + i][3 + j] + by_spin[i][j];
        }
    }
    for i in 0..N {
        let row = if N == 6 { i } else { PLANE[i] };
        out.f[i] = base.f[row];
        for j in 0..N {
            let column = if N == 6 { j } else { PLANE[j] };
            out.k[N * i + j] = base.k[row][column];
            out.c[N * i + j] = base.c[row][column];
        }
    }
}

/// Turn and posture at the end of a step, the first of the history.
#[inline(always)]
fn store<R: Real>(now: &Moment<R>, uplift: R, trial: &mut [R]) {
    trial[..3].copy_from_slice(&now.theta);
    trial[3..TURNED].copy_from_slice(&now.turn.quaternion);
    trial[TURNED..].copy_from_slice(&posture(&now.turn, uplift));
}

impl RockingBody {
    /// The body over lanes, where it is on the ground and moves in space or in X and Z.
    pub(super) fn form(&self, active: &[bool]) -> Option<LaneForm> {
        if self.above.is_some() {
            return None;
        }
        let [j1, j2, j3] = self.inertia.unwrap_or_default();
        let own = vec![self.overturned, j1, j2, j3];
        match self.rim() {
            Some(rim) => Some(rolling::form(&rim, own)),
            None => standing::form(self, own, (0..6).all(|i| !active[i] || PLANE.contains(&i))),
        }
    }
}

//! A body on a rim over [`Real`], for sweeps in lanes: the law of `rim.rs`, which is written over it.

use super::{OWN, SPACE, answer, moment, store};
use crate::rocking_body::law::{BASE, TURNED};
use crate::rocking_body::rim::{Rim, RimHistory};
use trilith_element::History;
use trilith_element::lanes::{LaneAt, LaneContact, LaneForce, LaneForm, LaneLaw, LaneStep, Real};

/// Parameters of a rim, after those of every body.
const RIM: usize = 7;

/// A body of six coordinates on a rim.
struct Rolling;

impl Rolling {
    #[inline(always)]
    fn rim<R: Real>(parameters: &[R]) -> Rim<R> {
        let [radius, depth, kn, damping, mu, ks, arc_stiffness] = parameters[OWN..] else {
            unreachable!("parameters of a rim")
        };
        Rim { radius, depth, kn, damping, mu, ks, arc_stiffness: Some(arc_stiffness) }
    }
}

impl LaneLaw for Rolling {
    const COORDINATES: usize = 6;
    const HISTORY: usize = BASE + RimHistory::FIELDS.len();
    const PARAMETERS: usize = OWN + RIM;
    const CONTACTS: usize = 2;
    const FALLS: bool = true;
    const IS_LONG: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let before = moment::<6, R>(at.history, at.d0, at.v0);
        let now = moment::<6, R>(at.history, at.d, at.v);
        let rim = Self::rim(at.parameters);
        let (own, base) = trial.split_at_mut(BASE);
        store(&now, rim.uplift(&now.d, &now.turn), own);
        let (sum, step) = rim.respond((&before, &now), at.dt, &at.history[BASE..], base);
        answer::<6, R>(sum, at.parameters, &now.spin, out);
        step
    }

    #[inline(always)]
    fn contacts<R: Real>(at: &LaneAt<'_, R>, _: &[R], out: &mut [LaneContact<R>]) -> R {
        let now = moment::<6, R>(at.history, at.d, at.v);
        let contacts = Self::rim(at.parameters).contacts(&now, &at.history[BASE..]);
        out.copy_from_slice(&contacts);
        at.dt.of(1.0).only(at.parameters[0].le(at.history[TURNED]))
    }
}

/// A body on a rim, with the parameters of every body.
pub(super) fn form(rim: &Rim<f64>, mut parameters: Vec<f64>) -> LaneForm {
    let arc = rim.arc_stiffness.unwrap_or(rim.kn);
    parameters.extend([rim.radius, rim.depth, rim.kn, rim.damping, rim.mu, rim.ks, arc]);
    LaneForm::of::<Rolling>(SPACE.to_vec(), parameters)
}

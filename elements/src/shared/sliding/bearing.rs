//! A sliding bearing: contact along its normal, friction and restoring force along its surface, a rim.
//!
//! ```text
//!   g  = d₁ − h(u)            gap with `rise` (the surface lifts the load), else g = d₁;   u = (d₂, d₃)
//!   F  = F(g, ġ)              compression side, and a tension side where there is one; N = |F|
//!   τ  = kₛ (u − a) + cₛ (u̇ − ȧ), |τ| ≤ L(N, |ȧ|)      a: anchor, slips at the limit
//!   f₁ = F
//!   fₜ = τ + S ∇h(u) + stop(u)            S = N in compression, −N in tension; with `rise` S = −F
//! ```
//!
//! `inclined` friction lies in the surface and follows the force normal to it; see `incline.rs`. The history is told by
//! lengths along the surface then: the anchor lies off u by the stretch.
//!
//! With `rise` normal force and restoring force come from one potential; without it (small
//! displacements) the restoring force has none where N changes, and its work is history.

use super::coefficient::{self, BreakAway};
use super::law::{Law, Numbers};
use super::{Axial, Coefficient, Dish, Stop};
use crate::shared::written::Written;
use trilith_element::lanes::{LaneAt, LaneContact, LaneForm, LaneLaw};
use trilith_element::{Contact, Kinematics, Response, history};

history! {
    /// History of one sliding surface.
    pub struct SlidingHistory {
        /// Anchor of the friction along U2: where the tangential spring is unstretched.
        pub anchor2: "m",
        /// Anchor of the friction along U3.
        pub anchor3: "m",
        /// Length of the slip path so far.
        pub slip: "m",
        /// 1 while closed in compression, −1 in tension, 0 while open.
        pub side: "1",
        /// 1 while slipping; for records.
        pub slipping: "1",
        /// Work of the restoring force so far, without `rise`.
        pub restoring: "J",
        /// Rate of slip.
        pub slip_rate: "m/s",
        /// Length of the slip path since it last stuck.
        pub unstuck: "m",
        /// Force of the dashpot beside the pre-slip spring along U2.
        pub damped2: "N",
        /// Force of the dashpot beside the pre-slip spring along U3.
        pub damped3: "N",
    }
}

/// One side of the contact: after how much gap it closes, what presses and what rubs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) opening: f64,
    pub(crate) axial: Axial,
    pub(crate) friction: Coefficient,
}

/// The bearing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing {
    pub(crate) compression: Side,
    pub(crate) tension: Option<Side>,
    pub(crate) ks: f64,
    /// Dashpot beside the pre-slip spring, N·s/m.
    pub(crate) cs: f64,
    pub(crate) away: Option<BreakAway>,
    pub(crate) dish: Dish,
    pub(crate) rise: bool,
    /// Friction lies in the surface, of the force normal to it.
    pub(crate) inclined: bool,
    pub(crate) stop: Option<Stop>,
}

/// Stiffness of a bearing that is closed and sticks, along U1, U2 and U3.
pub(crate) fn engaged(kn: f64, ks: f64, k: &mut [f64]) {
    k[0] = kn;
    k[4] = ks;
    k[8] = ks;
}

fn flag(yes: bool) -> f64 {
    f64::from(u8::from(yes))
}

/// Parameters of a bearing with Coulomb's friction, and of all.
pub(super) const PLAIN: usize = 16;
pub(super) const ALL: usize = PLAIN + 5 + 2 * coefficient::NUMBERS;

impl Bearing {
    /// True for friction that looks at nothing but the normal force, along the horizontal.
    fn is_plain(&self) -> bool {
        let tension = self.tension.is_none_or(|side| side.friction.is_constant());
        let constant = self.compression.friction.is_constant() && tension;
        constant && self.cs == 0.0 && self.away.is_none() && !self.inclined
    }

    fn sides(&self) -> [Side; 2] {
        [self.compression, self.tension.unwrap_or(self.compression)]
    }

    fn plain_numbers(&self) -> [f64; PLAIN] {
        let [below, above] = self.sides();
        let stop = self.stop.unwrap_or(Stop { at: 0.0, stiffness: 0.0 });
        [
            below.axial.kn,
            below.axial.damping,
            flag(below.axial.pull),
            below.opening,
            flag(self.tension.is_some()),
            above.axial.kn,
            above.opening,
            self.ks,
            below.friction.constant(),
            above.friction.constant(),
            self.dish.radius,
            flag(self.dish.spherical),
            flag(self.rise),
            flag(self.stop.is_some()),
            stop.at,
            stop.stiffness,
        ]
    }

    fn numbers(&self) -> [f64; ALL] {
        let [below, above] = self.sides();
        let away = self.away.unwrap_or(BreakAway { mu: 0.0, over: 0.0 });
        let mut all = [0.0; ALL];
        all[..PLAIN].copy_from_slice(&self.plain_numbers());
        let more = [flag(self.inclined), self.cs, flag(self.away.is_some()), away.mu, away.over];
        all[PLAIN..PLAIN + 5].copy_from_slice(&more);
        let (first, second) = all[PLAIN + 5..].split_at_mut(coefficient::NUMBERS);
        first.copy_from_slice(&below.friction.numbers());
        second.copy_from_slice(&above.friction.numbers());
        all
    }

    /// History before anything has happened.
    pub(crate) fn at_rest(&self) -> SlidingHistory {
        let (zero, numbers) = ([0.0; 3], self.numbers());
        let it = Numbers::of(&numbers);
        let side = it.pressed(&it.gap(&zero, &zero)).side;
        SlidingHistory { side, ..SlidingHistory::default() }
    }

    /// Force, tangents, trial history and energies.
    pub(crate) fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        if self.is_plain() {
            PLAIN_LAW.respond(&self.plain_numbers(), (at, committed), trial, out);
        } else {
            FULL_LAW.respond(&self.numbers(), (at, committed), trial, out);
        }
    }

    /// What the contact does.
    pub(crate) fn contact(&self, at: &Kinematics<'_>, history: &[f64]) -> Contact {
        let numbers = self.numbers();
        let mut out = [LaneContact::smooth(0.0, 0.0)];
        Law::<true>::contacts(&LaneAt::new(at, history, &numbers), &[], &mut out);
        out[0].into()
    }

    /// The form for lanes.
    pub(crate) fn lanes(&self) -> LaneForm {
        if self.is_plain() {
            return PLAIN_LAW.lanes(&self.plain_numbers());
        }
        FULL_LAW.lanes(&self.numbers())
    }
}

const PLAIN_LAW: Written = Written::of::<Law<false>>();
const FULL_LAW: Written = Written::of::<Law<true>>();

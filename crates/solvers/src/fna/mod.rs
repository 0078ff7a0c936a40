//! FNA: the propagator that solves modal equations exactly for loads that are linear in the step.
//!
//! Step operators and compliances by the length of the step, modal loads, static shapes that follow.
//! May use `step` for the contract, `kernel`, `modal` and `structure`.
//!
//! ```text
//! q̈ + D q̇ + Ω² q = s(t),      s(t) = Φᵀ p(t) − (B Φ)ᵀ f̃(t) linear in the step
//! (∫q, q, q̇)ₙ₊₁ = exp(A Δt) (0, q, q̇, s, ṡ)ₙ
//! ```
//!
//! Modes without coupling by damping have a recurrence of their own; otherwise (dashpots of the
//! structure, modal damping beside effective stiffnesses) the whole space takes its step at once. Both are exact,
//! also for ω = 0 and beyond critical damping. Static shapes follow the loads (see `following`).
//!
//! **Stiff links.** With link forces linear in the step the exact rule is the linear-acceleration method
//! on a link: stable only for ω_link Δt < 2√3. Steps that are too long for it at the stiffest link, as stiff as
//! it is then, are made by average acceleration instead in the modes that hang on such links; it has the same
//! form, the same order and no such limit. A contact at rest or in steady sliding then needs no short steps;
//! where something happens, the error control shortens them until the exact rule is back.
//!
//! The work of a linear load is exact too: ∫ s q̇ dt = s₁q₁ − s₀q₀ − ṡ ∫q dt; under average acceleration,
//! with ∫q = Δt (q₀ + q₁)/2, it is the work by which that rule balances.
//!
//! Reference: \[Wilson 2002, ch. 18\].

mod following;
mod modal_loads;
mod modes;

pub(crate) use modal_loads::ModalLoads;
pub(crate) use modes::{FREE, Modes};

use crate::error::SolveError;
use crate::kernel::{Compliance, StepKey, Wanted};
use crate::modal::ClosedForm;
use crate::step::{Forces, Propagator, StepWork};
use crate::structure::{Motion, ReducedSystem};

/// Steps with a larger G·k of the stiffest link are made by average acceleration; the limit of the exact
/// rule is 2 (ω²Δt²/6), and well before it the rule is no better any more.
pub(crate) const LONGEST: f64 = 0.5;

/// The exact propagator on a basis of modes.
pub(crate) struct Modal {
    modes: Modes,
    now: ModalLoads,
}

impl Modal {
    pub(crate) fn new(modes: Modes) -> Self {
        Self { now: ModalLoads::new(&modes.space, &[], &[]), modes }
    }

    /// What several motions can share.
    pub(crate) fn into_modes(self) -> Modes {
        self.modes
    }

    #[inline]
    fn spread(&mut self, pseudo: &[f64]) {
        if let Some(to) = self.now.renew_spread(pseudo) {
            self.modes.space.links.spread_into(pseudo, to);
        }
    }
}

impl Propagator for Modal {
    fn space(&self) -> &ReducedSystem {
        &self.modes.space
    }

    fn factorizations(&self) -> usize {
        0
    }

    fn set_rates(&mut self, rate_dependent: &[usize], damped: &[usize]) -> Result<(), SolveError> {
        self.now = ModalLoads::new(&self.modes.space, rate_dependent, damped);
        Ok(())
    }

    fn choose(
        &mut self,
        dt: f64,
        stiffness: &mut dyn Iterator<Item = f64>,
        stiffest: &[f64],
    ) -> StepKey {
        self.modes.choose(dt, stiffness, stiffest)
    }

    fn prepare(&mut self, key: &StepKey) -> Result<(), SolveError> {
        self.modes.prepare(key);
        Ok(())
    }

    fn compliance(&self) -> &Compliance {
        self.modes.compliance()
    }

    fn beyond_exact(&self) -> Option<f64> {
        self.modes.beyond
    }

    fn closed_form(&self) -> Option<ClosedForm> {
        Some(self.modes.closed_form())
    }

    fn acceleration(&mut self, force: &[f64]) -> Result<Vec<f64>, SolveError> {
        Ok(self.modes.structure.free_acceleration(force))
    }

    fn predict(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion, wanted: Wanted<'_>) {
        self.spread(forces.pseudo0);
        self.modes.predict(&mut self.now, from, &forces.loads, to);
        let m = self.modes.space.order();
        let links = &self.modes.space.links;
        links.deform(&to[..m], wanted.d);
        self.now.rates(links, &to[m..2 * m], wanted.v);
    }

    fn correct(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion) {
        self.spread(forces.pseudo1);
        self.modes.complete(&mut self.now, from, &forces.loads, to);
    }

    fn is_linear(&self) -> bool {
        self.modes.structure.undamped.is_empty()
    }

    fn follow_work(&mut self, follows: bool) {
        self.now.works = follows;
    }

    fn work(&mut self, _: &Motion, _: &Motion, _: &Forces<'_>) -> StepWork {
        self.modes.work(&self.now)
    }

    /// The motion inside the step is that from its start under these forces.
    fn external_work(&mut self, from: &Motion, _: &Motion, forces: &Forces<'_>) -> f64 {
        let mut to = vec![0.0; from.len()];
        self.spread(forces.pseudo0);
        self.modes.predict(&mut self.now, from, &forces.loads, &mut to);
        self.spread(forces.pseudo1);
        self.modes.complete(&mut self.now, from, &forces.loads, &mut to);
        self.modes.work(&self.now).external
    }

    fn energy(&self, x: &[f64]) -> (f64, f64) {
        self.modes.energy(x)
    }
}

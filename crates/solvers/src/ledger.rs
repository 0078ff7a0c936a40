//! The energy ledger: where the input goes.
//!
//! The linear structure balances to rounding in every step, because its work is taken by the rule that
//! moved it. What can be wrong is the links: the work that the time rule hands them against what the
//! laws say they stored and dissipated. That difference is the error of the ledger.

use crate::observe::{EnergyTotals, LinkEnergy};
use crate::stepper::{State, StepEnergy};
use crate::vector::larger;
use serde::{Deserialize, Serialize};

/// Where all energy has left again, the error is measured against this share of the largest.
const SHARE_OF_LARGEST: f64 = 0.01;

/// Nor is it measured against less than this share of the energy that stands in springs and loads.
const SHARE_OF_STANDING: f64 = 1e-6;

/// Energies since the start of a case.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ledger {
    pub totals: EnergyTotals,
    pub links: Vec<LinkEnergy>,
    kinetic0: f64,
    strain0: f64,
    stored0: f64,
    potential0: f64,
    external: f64,
    support: f64,
    largest: f64,
    /// What rounding may make of the energies, J.
    noise: f64,
}

impl Ledger {
    /// Opens the books at a state; `kinetic`, `strain`, `potential` of that state, and what rounding may make of
    /// energies, J.
    pub(crate) fn new(
        state: &State,
        kinetic: f64,
        strain: f64,
        potential: f64,
        noise: f64,
    ) -> Self {
        let links = state
            .stored
            .iter()
            .map(|s| LinkEnergy { stored: *s, ..LinkEnergy::default() })
            .collect();
        let mut ledger = Self {
            links,
            kinetic0: kinetic,
            strain0: strain,
            stored0: state.stored.iter().sum(),
            potential0: potential,
            noise,
            ..Self::default()
        };
        ledger.totals.kinetic = kinetic;
        ledger.totals.input = kinetic;
        ledger.largest = kinetic;
        ledger
    }

    /// Books that hold only totals, of a state that nothing led to.
    pub(crate) fn of(totals: EnergyTotals) -> Self {
        Self { totals, ..Self::default() }
    }

    /// Enters a step; `potential` of constant loads after it. Returns the energy in motion: kinetic, and
    /// what springs and links hold more or less than at the start.
    pub(crate) fn enter(&mut self, step: &StepEnergy, potential: f64) -> f64 {
        let t = &mut self.totals;
        let (mut hysteretic, mut viscous, mut stored) = (t.link_hysteretic, t.link_viscous, 0.0);
        for (link, e) in self.links.iter_mut().zip(&step.links) {
            link.stored = e.stored;
            link.hysteretic += e.hysteretic;
            link.viscous += e.viscous;
            hysteretic += e.hysteretic;
            viscous += e.viscous;
            stored += e.stored;
        }
        (t.link_hysteretic, t.link_viscous) = (hysteretic, viscous);
        self.external += step.work.external;
        self.support += step.support;
        t.kinetic = step.kinetic;
        t.strain = step.strain - self.strain0;
        t.potential = potential - self.potential0;
        t.modal_damping += step.work.damping;
        t.algorithmic += step.work.algorithmic;
        t.link_stored = stored - self.stored0;
        // The external work holds that of constant loads, which is minus the change of the potential.
        t.input = self.kinetic0 + self.external + t.potential + self.support;
        let out = t.kinetic
            + t.strain
            + t.potential
            + t.modal_damping
            + t.algorithmic
            + t.link_stored
            + t.link_hysteretic
            + t.link_viscous;
        t.error = t.input - out;
        for size in [t.input, t.kinetic, t.potential, t.strain, t.link_stored] {
            self.largest = larger(self.largest, size.abs());
        }
        // A pulse may put in far more than it leaves; what counts is what stayed, or was turned to heat.
        let heat = t.modal_damping + t.algorithmic + t.link_hysteretic + t.link_viscous;
        // At rest under load there is nothing but rounding, of the energy that stands in springs.
        let standing = step.strain.abs() + stored.abs() + potential.abs();
        let shares = [SHARE_OF_LARGEST * self.largest, SHARE_OF_STANDING * standing];
        let [moved, stood] = shares;
        let size = [t.input, t.kinetic, t.potential, heat, moved, stood, self.noise]
            .into_iter()
            .fold(0.0, |size: f64, x| larger(size, x.abs()));
        t.error_relative = if size > 0.0 { t.error.abs() / size } else { 0.0 };
        t.kinetic + t.strain.abs() + t.link_stored.abs()
    }
}

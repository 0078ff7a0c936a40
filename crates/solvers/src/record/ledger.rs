//! The energy ledger: where the input goes.
//!
//! The linear structure balances to rounding in every step, because its work is taken by the rule that
//! moved it. What can be wrong is the links: the work that the time rule hands them against what the
//! laws say they stored and dissipated. That difference is the error of the ledger.

use super::energy::{EnergyTotals, LinkEnergy, StartEnergy};
use crate::step::{State, StepEnergy};
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
        let start = StartEnergy { kinetic, strain, link_stored: state.stored.iter().sum() };
        let StartEnergy { link_stored, .. } = start;
        let totals =
            EnergyTotals { start, kinetic, strain, link_stored, ..EnergyTotals::default() };
        Self { totals, links, potential0: potential, largest: kinetic, noise, ..Self::default() }
    }

    /// True where loads have done work, or released any, beyond rounding.
    pub(crate) fn moves(&self) -> bool {
        self.totals.moves()
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
        t.strain = step.strain;
        t.link_stored = stored;
        t.potential = potential - self.potential0;
        t.modal_damping += step.work.damping;
        t.algorithmic += step.work.algorithmic;
        // The external work holds that of constant loads, which is minus the change of the potential.
        t.input = self.external + t.potential + self.support;
        // What stands in springs may be far more than what moves: it enters the balance by its change.
        let strained = t.strain - t.start.strain;
        let charged = t.link_stored - t.start.link_stored;
        let driven = t.start.kinetic + t.input;
        let out = t.kinetic
            + strained
            + t.potential
            + t.modal_damping
            + t.algorithmic
            + charged
            + t.link_hysteretic
            + t.link_viscous;
        t.error = driven - out;
        for size in [driven, t.kinetic, t.potential, strained, charged] {
            self.largest = larger(self.largest, size.abs());
        }
        // A pulse may put in far more than it leaves; what counts is what stayed, or was turned to heat.
        let heat = t.modal_damping + t.algorithmic + t.link_hysteretic + t.link_viscous;
        // At rest under load there is nothing but rounding, of the energy that stands in springs.
        let standing = step.strain.abs() + stored.abs() + potential.abs();
        let shares = [SHARE_OF_LARGEST * self.largest, SHARE_OF_STANDING * standing];
        let [moved, stood] = shares;
        let size = [driven, t.kinetic, t.potential, heat, moved, stood, self.noise]
            .into_iter()
            .fold(0.0, |size: f64, x| larger(size, x.abs()));
        t.error_relative = if size > 0.0 { t.error.abs() / size } else { 0.0 };
        t.kinetic + strained.abs() + charged.abs()
    }
}

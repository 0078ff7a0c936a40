//! The energies of a case.

use serde::Serialize;

/// Energies of a case, J: what was there at its start, what came since then, and where it is now.
///
/// `start` (its sum) + `input` = `kinetic` + `strain` + `potential` + `link_stored` + `modal_damping` +
/// `link_hysteretic` + `link_viscous` + `algorithmic` + `error`; [`balance`](Self::balance) tells it in words. A
/// static case, which no time passes in, has neither input nor error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, serde::Deserialize)]
pub struct EnergyTotals {
    /// What was there at the start of the case.
    pub start: StartEnergy,
    /// Work of base motion, moving supports and varying forces since the start.
    pub input: f64,
    /// ½ u̇ᵀ M u̇ (relative velocities).
    pub kinetic: f64,
    /// ½ uᵀ K u.
    pub strain: f64,
    /// Potential of constant loads (gravity): its change since the start, since it has no zero of its own; in a
    /// static case since there was no load.
    pub potential: f64,
    /// Work of structural damping since the start.
    pub modal_damping: f64,
    /// Stored in links.
    pub link_stored: f64,
    /// Heat of friction and yielding in links since the start.
    pub link_hysteretic: f64,
    /// Heat of rate-dependent link forces since the start.
    pub link_viscous: f64,
    /// Energy removed by the time rule (HHT with α < 0) since the start.
    pub algorithmic: f64,
    /// What is not accounted for: start + input − everything else.
    pub error: f64,
    /// |error| over the largest of input (with the kinetic energy at the start), kinetic energy, potential and heat,
    /// and a hundredth of the largest energy so far.
    pub error_relative: f64,
}

impl EnergyTotals {
    /// All of them, from the input to the relative error, in the order of the fields.
    #[must_use]
    pub fn values(&self) -> [f64; 11] {
        [
            self.input,
            self.kinetic,
            self.strain,
            self.potential,
            self.modal_damping,
            self.link_stored,
            self.link_hysteretic,
            self.link_viscous,
            self.algorithmic,
            self.error,
            self.error_relative,
        ]
    }
}

/// Energies at the start of a case, J; nothing in a static case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, serde::Deserialize)]
pub struct StartEnergy {
    /// ½ u̇ᵀ M u̇ (relative velocities).
    pub kinetic: f64,
    /// ½ uᵀ K u.
    pub strain: f64,
    /// Stored in links.
    pub link_stored: f64,
}

/// Energies of one link since the start of the case, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, serde::Deserialize)]
pub struct LinkEnergy {
    /// Stored now (absolute).
    pub stored: f64,
    /// Heat of friction and yielding.
    pub hysteretic: f64,
    /// Heat of rate-dependent forces.
    pub viscous: f64,
}

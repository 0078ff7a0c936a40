//! The energies of a case as a balance: what there was, and what became of it.

use super::energy::{EnergyTotals, StartEnergy};

/// Both sides of the energies of a case, each an energy with its name, J. Their sums are equal where time passes.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyBalance {
    /// What was there at the start, what constant loads have released since then, and the input, which is the last.
    pub sources: [(&'static str, f64); 5],
    /// Where it is.
    pub uses: [(&'static str, f64); 9],
}

impl EnergyTotals {
    /// True where loads have done work, or released any, beyond rounding.
    pub(crate) fn moves(&self) -> bool {
        let balance = self.balance();
        [self.input, self.potential].iter().any(|e| !balance.is_rounding(*e))
    }

    /// The balance. The potential of constant loads, which has no zero of its own, counts from the lower of start and
    /// end: what went down is a source, what went up a use.
    #[must_use]
    pub fn balance(&self) -> EnergyBalance {
        let StartEnergy { kinetic, strain, link_stored } = self.start;
        EnergyBalance {
            sources: [
                ("at the start: kinetic", kinetic),
                ("at the start: strain", strain),
                ("at the start: stored in links", link_stored),
                ("potential released", (-self.potential).max(0.0)),
                ("input", self.input),
            ],
            uses: [
                ("kinetic", self.kinetic),
                ("strain", self.strain),
                ("potential gained", self.potential.max(0.0)),
                ("structural damping", self.modal_damping),
                ("stored in links", self.link_stored),
                ("friction and yielding", self.link_hysteretic),
                ("viscous in links", self.link_viscous),
                ("time rule", self.algorithmic),
                ("unaccounted for", self.error),
            ],
        }
    }
}

impl EnergyBalance {
    /// Share of the largest energy below which one is rounding, and so is a sum.
    const ROUNDING: f64 = 1e-12;

    /// What there was in all, of which all are shares, J; `None` where that is nothing beside the energies that there
    /// are.
    #[must_use]
    pub fn whole(&self) -> Option<f64> {
        let sum: f64 = self.sources.iter().map(|(_, e)| e).sum();
        (sum > 1e-9 * self.largest()).then_some(sum)
    }

    /// True for an energy that is nothing but rounding beside the others.
    #[must_use]
    pub fn is_rounding(&self, energy: f64) -> bool {
        energy.abs() <= Self::ROUNDING * self.largest()
    }

    /// Magnitude of the largest energy, J.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let all = self.sources.iter().chain(&self.uses);
        all.fold(0.0, |most: f64, (_, e)| most.max(e.abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swing_from_a_displacement_is_fed_by_what_was_there() {
        let start = StartEnergy { strain: 100.0, ..StartEnergy::default() };
        let energy = EnergyTotals {
            start,
            input: 1.0,
            kinetic: 60.0,
            strain: 20.0,
            potential: -4.0,
            modal_damping: 25.0,
            ..EnergyTotals::default()
        };
        let balance = energy.balance();
        let used: f64 = balance.uses.iter().map(|(_, e)| e).sum();
        assert_eq!((balance.whole(), used), (Some(105.0), 105.0));
        assert_eq!(balance.sources[3], ("potential released", 4.0));
        assert_eq!(balance.uses[2], ("potential gained", 0.0));
    }

    #[test]
    fn where_there_was_nothing_there_is_no_share() {
        let energy = EnergyTotals { link_viscous: -1.0, error: 1.0, ..EnergyTotals::default() };
        assert_eq!(energy.balance().whole(), None);
        assert_eq!(EnergyTotals::default().balance().whole(), None);
    }
}

//! What a run came to, as far as any study may ask: columns are made of it, and a store keeps it.

use crate::number::Number;
use serde::{Deserialize, Serialize};
use trilith::combine::Combinations;
use trilith::model::Model;
use trilith::results::Peak;
use trilith::solvers::{ContactSummary, EnergyTotals, Status};

/// A run at its end.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Finished {
    /// Word for how it ended.
    pub status: String,
    /// True for a result to be trusted.
    pub good: bool,
    /// How it ended in a sentence; empty where it converged.
    pub message: String,
    pub warnings: Vec<String>,
    pub contact: Option<Contact>,
    /// In the order of [`ENERGIES`](trilith::results::ENERGIES), and the share that is unaccounted for.
    pub energy: [Number; 11],
    /// Largest and smallest value with their times, and the value at the end, of every output in the order of the model.
    pub peaks: Vec<[Number; 5]>,
    /// Of what columns take [over time](crate::column::over_time).
    pub integrals: Vec<Number>,
}

/// How the contacts behaved.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Contact {
    pub initial_mode: String,
    pub mode: String,
    pub overturned: bool,
    pub uplift: Number,
    pub slip: Number,
    pub residual_slip: Number,
}

impl Finished {
    pub fn new(
        status: &Status,
        warnings: &[String],
        contact: Option<&ContactSummary>,
        energy: &EnergyTotals,
        peaks: impl Iterator<Item = Peak>,
        integrals: &[f64],
    ) -> Self {
        let message = match status {
            Status::Converged => String::new(),
            other => other.text(),
        };
        Self {
            status: status.word().to_owned(),
            good: status.is_good(),
            message,
            warnings: warnings.to_vec(),
            contact: contact.map(|c| Contact {
                initial_mode: c.initial_mode.to_owned(),
                mode: c.mode.to_owned(),
                overturned: c.overturned,
                uplift: Number(c.max_uplift),
                slip: Number(c.max_slip),
                residual_slip: Number(c.residual_slip),
            }),
            energy: energy.values().map(Number),
            peaks: peaks.map(|p| [p.max, p.t_max, p.min, p.t_min, p.last].map(Number)).collect(),
            integrals: integrals.iter().copied().map(Number).collect(),
        }
    }

    /// Of the one combination that was asked for: its extremes, and what its cases warned of.
    pub fn combined(model: &Model, found: &Combinations) -> Self {
        const UNKNOWN: Number = Number(f64::NAN);
        let outputs = found.combinations.first().map_or(&[][..], |one| &one.outputs);
        let peaks = model.outputs.iter().map(|o| {
            let own = outputs.iter().find(|of| of.output == o.name);
            let [max, min] = own.map_or([UNKNOWN; 2], |of| [Number(of.max), Number(of.min)]);
            [max, UNKNOWN, min, UNKNOWN, UNKNOWN]
        });
        let warnings = found.cases.iter().flat_map(|case| {
            let name = &case.name;
            case.warnings.iter().map(move |warning| format!("case \"{name}\": {warning}"))
        });
        let twice = found.combinations.iter().filter_map(|one| one.warning());
        let status = Status::Converged;
        Self {
            status: status.word().to_owned(),
            good: status.is_good(),
            message: String::new(),
            warnings: warnings.chain(twice).collect(),
            contact: None,
            energy: [UNKNOWN; 11],
            peaks: peaks.collect(),
            integrals: Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energies_stand_in_the_order_of_their_names() {
        let energy = EnergyTotals { link_viscous: 3.0, error: 5.0, ..EnergyTotals::default() };
        let made = Finished::new(&Status::Converged, &[], None, &energy, std::iter::empty(), &[]);
        let at = |name: &str| trilith::results::ENERGIES.iter().position(|e| *e == name).unwrap();
        assert_eq!(trilith::results::ENERGIES.len() + 1, made.energy.len());
        assert_eq!((made.energy[at("link_viscous")].0, made.energy[at("error")].0), (3.0, 5.0));
    }
}

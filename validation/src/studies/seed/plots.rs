//! Histories of the block over the reference.

use super::reference::History;
use crate::{Trace, Unit};
use trilith_report::{Figure, Stroke};

/// A millimetre.
pub(super) const MILLIMETRE: Unit = Unit { name: "mm", si: 1e-3 };

/// A run and what made it.
pub(super) type Seen = (&'static str, Trace);

/// What a figure shows.
pub(super) struct Plot<'a> {
    pub(super) title: String,
    /// Outputs and what they are called.
    pub(super) outputs: &'a [(&'static str, &'static str)],
    pub(super) axis: &'static str,
    pub(super) unit: Unit,
    /// Last time shown, s.
    pub(super) end: f64,
}

impl Plot<'_> {
    /// Outputs of runs over time, with the reference as rings.
    pub(super) fn draw(self, seen: &[Seen], reference: Option<&History>) -> Figure {
        let axis = format!("{} [{}]", self.axis, self.unit.name);
        let mut figure = Figure::new(self.title, "time [s]", axis).sized(640, 380);
        let shown =
            |(t, v): (f64, f64)| (t <= self.end * (1.0 + 1e-9)).then_some((t, v / self.unit.si));
        for (output, name) in self.outputs {
            for (solver, trace) in seen {
                let points = trace.history(output).into_iter().filter_map(shown);
                // Dashed, so that the first solver is seen beneath the second.
                let stroke = if *solver == "fna" { Stroke::Line } else { Stroke::Dashes };
                figure = figure.series(format!("{name}{}", solver.to_uppercase()), stroke, points);
            }
        }
        for (i, (output, _)) in self.outputs.iter().enumerate() {
            if let Some(history) = reference {
                let name = if i == 0 { "event-driven program" } else { "" };
                figure = figure.marks(name, history.of(output).filter_map(shown));
            }
        }
        figure
    }
}

/// Largest distance of an output from its reference, in m.
pub(super) fn distance(trace: &Trace, output: &str, reference: &History) -> f64 {
    reference.of(output).map(|(t, v)| (trace.at(output, t) - v).abs()).fold(0.0, f64::max)
}

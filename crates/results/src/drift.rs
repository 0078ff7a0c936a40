//! Drift: how far a place moves sideways against one below it.

use crate::Peak;
use serde::Serialize;
use trilith_element::Dof;
use trilith_model::{Model, NodalTerm, Quantity};

/// The output with the largest drift, by its share of the height between its two nodes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DriftSummary {
    /// Name of the output: the difference of a horizontal displacement of two nodes at different heights, or a
    /// share of it.
    pub output: String,
    /// The largest difference, m.
    pub max: f64,
    /// Height between its nodes, m.
    pub height: f64,
    /// The one over the other.
    pub ratio: f64,
}

/// The largest drift among the outputs, whose peaks stand in the order of the model.
pub(crate) fn largest(model: &Model, peaks: &[Peak]) -> Option<DriftSummary> {
    let outputs = model.outputs.iter().zip(peaks).filter(|(o, _)| !o.hidden);
    let drifts = outputs.filter_map(|(output, peak)| {
        let Quantity::Displacement(terms) = &output.quantity else { return None };
        let height = height(model, terms)?;
        // One that is taken over the height is a ratio already.
        let share = terms[0].factor.abs();
        let max = peak.max.abs().max(peak.min.abs()) / share;
        let ratio = max / height;
        ratio.is_finite().then(|| DriftSummary { output: output.name.clone(), max, height, ratio })
    });
    drifts.max_by(|a, b| a.ratio.total_cmp(&b.ratio)).filter(|d| d.ratio > 0.0)
}

/// The height between two nodes whose difference along X or Y is taken, m; none for other terms.
fn height(model: &Model, terms: &[NodalTerm]) -> Option<f64> {
    let [a, b] = terms else { return None };
    let across = a.dof == b.dof && matches!(a.dof, Dof::Ux | Dof::Uy);
    let opposite = a.factor == -b.factor;
    let up = |t: &NodalTerm| Some(model.nodes.get(t.node)?.position[2]);
    let height = (up(a)? - up(b)?).abs();
    (across && opposite && height > 0.0).then_some(height)
}

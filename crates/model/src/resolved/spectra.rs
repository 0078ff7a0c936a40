//! Floor spectra of a resolved model.

use super::text;
use crate::{FloorSpectrum, Model, Quantity};

pub(super) fn spectrum(model: &Model, s: &FloorSpectrum) -> String {
    let list = |x: &[f64]| x.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(", ");
    let place = match model.outputs.get(s.output).map(|o| &o.quantity) {
        Some(Quantity::Acceleration { terms, .. }) => terms
            .first()
            .map(|t| format!("node: {}, dof: {}", text(&model.nodes[t.node].name), t.dof.name())),
        _ => None,
    };
    let place = place.unwrap_or_default();
    format!("({place}, damping: [{}], periods: [{}])", list(&s.damping), list(&s.periods))
}

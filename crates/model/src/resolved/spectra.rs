//! Floor spectra of a resolved model.

use super::BlockText;
use crate::schema;
use crate::{FloorSpectrum, Model, Quantity};

pub(super) fn spectrum(model: &Model, s: &FloorSpectrum) -> String {
    let mut text = BlockText::new(schema::SPECTRA.blocks[0]);
    if let Some(Quantity::Acceleration { terms, .. }) =
        model.outputs.get(s.output).map(|o| &o.quantity)
        && let Some(term) = terms.first()
    {
        let node = &model.nodes[term.node].name;
        text = text.named("node", node).choice("dof", term.dof.name());
    }
    let numbers = |all: &[f64]| super::list(all.iter().map(|x| format!("{x:?}")));
    let text = text.value("damping", numbers(&s.damping));
    text.value("periods", numbers(&s.periods)).end()
}

//! Outputs that other crates offer.

use super::super::custom::made;
use super::super::elements::allowed;
use super::super::motion::unit;
use super::Reading;
use crate::tree::Node;
use crate::{Derived, Quantity, schema, units};
use std::sync::Arc;
use trilith_element::dimension::NONE;
use trilith_element::{Card, Dimension, ReadOutput};

/// `VonMises(of: ["normal", "shear"])`, with the fields of its card.
pub(super) fn derived(
    reading: &Reading<'_, '_>,
    node: &Node,
    what: &str,
    card: &'static Card,
    read: &ReadOutput,
) -> Option<(Quantity, String)> {
    let c = reading.c;
    let fields = c.fields(node, what, &allowed(card, &schema::DERIVED.map(|f| f.name)))?;
    let at = node.name_span();
    let parts = fields.required(c, schema::OF.name).map(|list| {
        let found: Vec<_> = list.items().into_iter().map(|n| reading.output_before(n)).collect();
        (list, found.into_iter().collect::<Option<Vec<usize>>>())
    });
    let own = made(c, &fields, (what, &at), card, read);
    let ((list, of), (values, output)) = (parts?, own?);
    let of = of?;
    let dimensions: Option<Vec<Dimension>> = of
        .iter()
        .map(|i| Some(units::dimension(reading.before[*i].1.as_ref()?).unwrap_or(NONE)))
        .collect();
    match output.dimension(&dimensions?) {
        Ok(dimension) => {
            let derived = Derived { card, values, output: Arc::from(output), of };
            Some((Quantity::Derived(derived), unit(dimension, false)))
        }
        Err(error) => {
            c.report(c.diagnostic("E0111", format!("{what}: {error}"), list.span.clone()));
            None
        }
    }
}

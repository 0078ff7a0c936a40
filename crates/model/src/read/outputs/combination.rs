//! Outputs put together from others.

use super::super::motion::unit;
use super::Reading;
use crate::expression::Quantity as Number;
use crate::schema::{self, Block};
use crate::tree::{Kind, Node};
use crate::{Combine, Quantity, units};
use trilith_element::Dimension;
use trilith_element::dimension::NONE;

/// `Sum(terms: [(output: "tilt", factor: "-1/balance")], constant: 1)`, `Norm(terms: ["x", "y"])`.
pub(super) fn combination(
    reading: &Reading<'_, '_>,
    node: &Node,
    what: &str,
    kind: &'static Block,
) -> Option<(Quantity, String)> {
    let c = reading.c;
    let how = Combine::ALL[Combine::NAMES.iter().position(|n| *n == kind.name)?];
    let fields = c.block(node, what, kind)?;
    let list = fields.required(c, "terms")?;
    let mut terms = Vec::new();
    let mut angles = true;
    let mut target: Option<Dimension> = None;
    let mut good = true;
    for item in list.items() {
        match term(reading, item, what, target) {
            Some((index, factor, dimension, angle)) => {
                target = target.or(Some(dimension));
                angles &= angle;
                terms.push((index, factor));
            }
            None => good = false,
        }
    }
    if list.items().is_empty() {
        c.report(c.diagnostic("E0104", format!("{what} has no terms"), list.span.clone()));
    }
    let target = target?;
    let constant = fields.get("constant").map_or(Some(0.0), |n| c.number(n, target));
    let angle = angles && target.is_none();
    good.then_some(())?;
    Some((Quantity::Combination { how, constant: constant?, terms }, unit(target, angle)))
}

/// Index, factor, dimension of factor times output, and whether that is an angle.
fn term(
    reading: &Reading<'_, '_>,
    item: &Node,
    what: &str,
    target: Option<Dimension>,
) -> Option<(usize, f64, Dimension, bool)> {
    let c = reading.c;
    let (name, factor) = match &item.kind {
        Kind::Text(_) => (item, None),
        _ => {
            let fields = c.block(item, &format!("a term of {what}"), schema::PARTS.blocks[0])?;
            (fields.required(c, "output")?, fields.get("factor"))
        }
    };
    let index = reading.output_before(name)?;
    let own_unit = reading.before[index].1.as_ref()?;
    let own = units::dimension(own_unit).unwrap_or(NONE);
    let factor = match (factor, target) {
        (None, _) => Number::bare(1.0),
        (Some(n), None) => c.quantity(n)?,
        (Some(n), Some(target)) => {
            let dimension = target / own;
            Number { value: c.number(n, dimension)?, dimension, measured: true }
        }
    };
    let dimension = factor.dimension * own;
    if let Some(target) = target.filter(|t| !t.matches(dimension)) {
        let message = format!("terms in {target} and in {dimension} cannot be put together");
        c.report(c.diagnostic("E0111", message, name.span.clone()));
        return None;
    }
    // A pure factor of an angle may make a share of it: only a plain term stays an angle.
    Some((index, factor.value, dimension, own_unit == "rad" && factor.value == 1.0))
}

//! Coordinates and levers: lengths whose squares and fourth powers a structure is made of.

use super::context::Context;
use crate::tree::Node;
use trilith_element::dimension::LENGTH;

/// Farthest coordinate and longest lever, m. The distance of the planets; a coordinate of this size is known to a
/// tenth of a millimetre in double precision, and its fourth power times any stiffness or mass is still a number.
pub(super) const FARTHEST: f64 = 1e12;

impl Context<'_> {
    /// A coordinate or a lever, m; one that is absurdly long is reported.
    pub(super) fn lever(&self, node: &Node, name: &str) -> Option<f64> {
        let x = self.number(node, LENGTH)?;
        if x.abs() <= FARTHEST {
            return Some(x);
        }
        let message =
            format!("`{name}` = {x:e} m: must be between -{FARTHEST:e} m and {FARTHEST:e} m");
        let d = self.diagnostic("E0112", message, node.span.clone()).label("out of reach");
        self.report(d.help(
            "masses and stiffnesses go with the square of a lever, which overflows: check its unit",
        ));
        None
    }

    /// Three coordinates, m; each that is absurdly large is reported where it stands.
    pub(super) fn place(&self, node: &Node, name: &str) -> Option<[f64; 3]> {
        let place = self.vector(node, name, LENGTH)?;
        if place.iter().all(|x| x.abs() <= FARTHEST) {
            return Some(place);
        }
        // Numbers of the right dimension, so nothing is told a second time.
        let near: Vec<_> = node.items().into_iter().map(|item| self.lever(item, name)).collect();
        near.iter().all(Option::is_some).then_some(place)
    }
}

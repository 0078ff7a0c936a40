//! What concerns a structure as a whole: base shear, overturning, storey drift, forces of supports.

use super::super::context::Fields;
use super::super::groups::several;
use super::super::motion::unit;
use super::Reading;
use crate::schema::Block;
use crate::tree::Node;
use crate::{Body, NodalTerm, Quantity, Span};
use trilith_element::Dof;
use trilith_element::dimension::{FORCE, LENGTH, MOMENT, NONE};

impl Reading<'_, '_> {
    /// X or Y.
    fn horizontal(&self, fields: &Fields<'_>) -> Option<Dof> {
        fields.choice(self.c, "direction", "direction").map(|i| Dof::ALL[i])
    }

    pub(super) fn base_shear(
        &self,
        node: &Node,
        what: &str,
        kind: &'static Block,
    ) -> Option<(Quantity, String)> {
        let fields = self.c.block(node, what, kind)?;
        let direction = self.horizontal(&fields)?;
        Some((Quantity::BaseShear { direction }, unit(FORCE, false)))
    }

    pub(super) fn overturning(
        &self,
        node: &Node,
        what: &str,
        kind: &'static Block,
    ) -> Option<(Quantity, String)> {
        let c = self.c;
        let fields = c.block(node, what, kind)?;
        let direction = self.horizontal(&fields);
        let about = fields.required(c, "about").and_then(|n| match n.is_list() {
            true => c.place(n, "about"),
            false => c.number(n, LENGTH).map(|z| [0.0, 0.0, z]),
        });
        let quantity = Quantity::Overturning { direction: direction?, about: about? };
        Some((quantity, unit(MOMENT, false)))
    }

    /// A drift is written out as the difference of two displacements.
    pub(super) fn storey_drift(
        &self,
        node: &Node,
        what: &str,
        kind: &'static Block,
    ) -> Option<(Quantity, String)> {
        let c = self.c;
        let fields = c.block(node, what, kind)?;
        let dof = fields.choice(c, "dof", "direction");
        let of = fields.required(c, "of")?;
        let ends = of.items();
        let [lower, upper] = ends[..] else {
            return c.wrong(of, "two nodes, such as `[\"first\", \"second\"]`");
        };
        let refer = |n: &Node| {
            self.check_single(n, self.nodes)?;
            self.nodes.refer(c, n)
        };
        let (lower, upper) = (refer(lower), refer(upper));
        let (lower, upper, dof) = (lower?, upper?, Dof::ALL[dof?]);
        let place = |i: usize| self.of.places[i].as_ref().map(|n| n.position[2]);
        let height = place(upper)? - place(lower)?;
        if height <= 0.0 {
            let message = format!(
                "{what}: node `{}` is not above node `{}`",
                self.nodes.name(upper),
                self.nodes.name(lower)
            );
            let d = c.diagnostic("E0112", message, of.span.clone());
            c.report(d.help("name the lower node first"));
            return None;
        }
        let term = |node: usize, factor: f64| NodalTerm { node, dof, factor };
        let terms = vec![term(upper, 1.0 / height), term(lower, -1.0 / height)];
        Some((Quantity::Displacement(terms), unit(NONE, false)))
    }

    pub(super) fn reaction(
        &self,
        node: &Node,
        what: &str,
        kind: &'static Block,
    ) -> Option<(Quantity, String)> {
        let c = self.c;
        let fields = c.block(node, what, kind)?;
        let nodes = fields.required(c, "node").and_then(|n| several(c, n, self.nodes));
        let dof = fields.required(c, "dof").and_then(|n| c.dof(n));
        let factor = self.factor(&fields);
        let (nodes, dof, factor) = (nodes?, dof?, factor?);
        for (node, at) in &nodes {
            self.check_supported(what, *node, dof, at)?;
        }
        let own = if dof.is_rotation() { MOMENT } else { FORCE };
        let unit = unit(own * factor.dimension, false);
        let nodes = nodes.into_iter().map(|(node, _)| node).collect();
        Some((Quantity::Reaction { nodes, dof, factor: factor.value }, unit))
    }

    /// Refuses directions whose support carries what is not recorded.
    fn check_supported(&self, what: &str, node: usize, dof: Dof, at: &Span) -> Option<()> {
        let c = self.c;
        let (name, direction) = (self.nodes.name(node), dof.name());
        let refuse = |message: String, help: &str| {
            c.report(c.diagnostic("E0106", format!("{what}: {message}"), at.clone()).help(help));
            None
        };
        let mut supports = self.of.supports.iter().flatten();
        if !supports.any(|s| s.node == node && s.fixed[dof.index()]) {
            return refuse(
                format!("no support fixes {direction} of node `{name}`"),
                "name a node of `supports`; a link to the ground has a `LinkForce`",
            );
        }
        let is_tied =
            |e: &&crate::Element| matches!(e.body, Body::Constraint(_)) && e.nodes.contains(&node);
        if let Some(e) = self.elements.iter().flatten().find(is_tied) {
            return refuse(
                format!("`{}` ({}) ties node `{name}` to others", e.name, e.kind),
                "forces of constraints are not recorded: take `BaseShear`, or the forces of the elements",
            );
        }
        let loaded = |p: &&crate::Pattern| p.forces.iter().any(|f| f.node == node && f.dof == dof);
        if let Some(p) = self.of.patterns.iter().flatten().find(loaded) {
            return refuse(
                format!("load `{}` acts on {direction} of node `{name}` itself", p.name),
                "such a force goes into the support past the structure: leave it out, or load a node that is free",
            );
        }
        Some(())
    }
}

//! Forces and deformations of links, and forces of elements: of one, or of several in sum.

use super::super::along::place;
use super::super::context::Fields;
use super::super::groups::several;
use super::super::motion::unit;
use super::super::names::Names;
use super::Reading;
use crate::schema::Block;
use crate::tree::Node;
use crate::{Body, LinkTerm, MemberForce, Quantity, Span};
use trilith_element::dimension::{FORCE, LENGTH, MOMENT, NONE};
use trilith_element::{Axis, Coordinates, Dof, Link};

impl Reading<'_, '_> {
    /// An element of the file as a link; one that is none is reported.
    fn as_link(&self, index: usize, at: &Span) -> Option<&dyn Link> {
        let element = self.elements[index].as_ref()?;
        if let Body::Link(law, _) = &element.body {
            return Some(law.as_ref());
        }
        let message = format!("`{}` ({}) is no link", element.name, element.kind);
        let d = self.c.diagnostic("E0106", message, at.clone());
        self.c.report(d.help("name a link, or record `ElementForce`"));
        None
    }

    /// The element that a field names, where it is a link.
    pub(super) fn law(&self, fields: &Fields<'_>) -> Option<(usize, &dyn Link)> {
        let node = fields.required(self.c, "link")?;
        self.check_single(node, self.names)?;
        let index = self.names.refer(self.c, node)?;
        Some((index, self.as_link(index, &node.span)?))
    }

    /// Refuses a group or a list where the values of several make no sum.
    pub(super) fn check_single(&self, node: &Node, names: &Names<'_>) -> Option<()> {
        let c = self.c;
        let what = match names.group(node) {
            Some((_, true)) => "a group",
            None if node.is_list() => "a list",
            _ => return Some(()),
        };
        let message =
            format!("{what} has one value for each of its {}s, and no sum", names.one_word());
        let d = c.diagnostic("E0106", message, node.span.clone());
        c.report(d.help(
            "record each with `For`, and put them together with `Largest`, `Smallest`, `Norm` or `Sum`",
        ));
        None
    }

    pub(super) fn link(
        &self,
        node: &Node,
        what: &str,
        kind: &'static Block,
        force: bool,
    ) -> Option<(Quantity, String)> {
        let c = self.c;
        let fields = c.block(node, what, kind)?;
        let links = match force {
            true => fields.required(c, "link").and_then(|n| several(c, n, self.names)),
            false => fields.required(c, "link").and_then(|n| {
                self.check_single(n, self.names)?;
                Some(vec![(self.names.refer(c, n)?, n.span.clone())])
            }),
        };
        let factor = self.factor(&fields);
        let mut terms = Vec::new();
        let mut first = None;
        for (element, at) in links? {
            let coordinates = self.as_link(element, &at)?.coordinates();
            let (coordinate, axis) = self.coordinate(&fields, what, &coordinates)?;
            if *first.get_or_insert(axis) != axis {
                let message = format!(
                    "{what}: coordinate {coordinate} is not the same axis in all of these links"
                );
                c.report(c.diagnostic("E0106", message, at).help("name it by `axis`"));
                return None;
            }
            terms.push((element, coordinate));
        }
        let (rotation, factor) = (first?.1, factor?);
        let own = match (force, rotation) {
            (true, false) => FORCE,
            (true, true) => MOMENT,
            (false, false) => LENGTH,
            (false, true) => NONE,
        };
        let unit = unit(own * factor.dimension, !force && rotation && factor.dimension.is_none());
        let factor = factor.value;
        let mut terms =
            terms.into_iter().map(|(element, coordinate)| LinkTerm { element, coordinate, factor });
        let quantity = if force {
            Quantity::LinkForce(terms.collect())
        } else {
            let LinkTerm { element, coordinate, factor } = terms.next()?;
            Quantity::LinkDeformation { element, coordinate, factor }
        };
        Some((quantity, unit))
    }

    /// The coordinate of a law that fields name; its axis where it has one, and whether it is a rotation.
    fn coordinate(
        &self,
        fields: &Fields<'_>,
        what: &str,
        coordinates: &Coordinates,
    ) -> Option<(usize, (Option<Axis>, bool))> {
        let c = self.c;
        match (fields.get("axis"), fields.get("coordinate")) {
            (None, Some(n)) => {
                let k = c.count(n, "coordinate", 0)?;
                if k >= coordinates.len() {
                    let last = coordinates.len().saturating_sub(1);
                    let message = format!("`coordinate` = {k}: must be between 0 and {last}");
                    c.report(c.diagnostic("E0112", message, n.span.clone()));
                    return None;
                }
                Some(match coordinates {
                    Coordinates::Local(axes) => (k, (Some(axes[k]), axes[k].index() > 2)),
                    Coordinates::Nodal { .. } => (k, (None, k % 6 > 2)),
                })
            }
            (Some(_), Some(n)) => {
                let message = format!("{what} has `axis` and `coordinate`");
                c.report(
                    c.diagnostic("E0102", message, n.span.clone()).help("keep one of the two"),
                );
                None
            }
            (axis, None) => {
                let axis = axis.or_else(|| fields.required(c, "axis"))?;
                self.axis(axis, coordinates)
            }
        }
    }

    /// Coordinate of a local axis, and whether it is a rotation.
    fn axis(
        &self,
        node: &Node,
        coordinates: &Coordinates,
    ) -> Option<(usize, (Option<Axis>, bool))> {
        let c = self.c;
        let axis = Axis::ALL[c.choice(node, "axis", Axis::NAMES)?];
        let (message, help) = match coordinates {
            Coordinates::Local(axes) => {
                if let Some(k) = axes.iter().position(|a| *a == axis) {
                    return Some((k, (Some(axis), axis.index() > 2)));
                }
                let names: Vec<&str> = axes.iter().map(|a| a.name()).collect();
                (
                    format!("the link has no axis {}", axis.name()),
                    format!("it has {}", names.join(", ")),
                )
            }
            Coordinates::Nodal { .. } => (
                "the law of this link works on the displacements of its nodes, not on axes".into(),
                format!("write `coordinate: 0` to `coordinate: {}`", coordinates.len() - 1),
            ),
        };
        c.report(c.diagnostic("E0106", message, node.span.clone()).help(help));
        None
    }

    pub(super) fn member_force(
        &self,
        node: &Node,
        what: &str,
        kind: &'static Block,
    ) -> Option<(Quantity, String)> {
        let c = self.c;
        let fields = c.block(node, what, kind)?;
        let member = fields.required(c, "element").and_then(|n| {
            self.check_single(n, self.names)?;
            self.of.members.find(c, self.names.refer(c, n)?, &n.span)
        });
        let force = fields.choice(c, "force", "force").map(|i| MemberForce::ALL[i]);
        let at = fields.required(c, "at");
        let factor = self.factor(&fields);
        let member = member?;
        let at = place(c, at?, "at", member.length());
        let (force, factor, at) = (force?, factor?, at?);
        let own = if force.is_moment() { MOMENT } else { FORCE };
        let unit = unit(own * factor.dimension, false);
        let (element, factor) = (member.index, factor.value);
        Some((Quantity::MemberForce { element, force, at, factor }, unit))
    }

    pub(super) fn element_force(
        &self,
        node: &Node,
        what: &str,
        kind: &'static Block,
    ) -> Option<(Quantity, String)> {
        let c = self.c;
        let fields = c.block(node, what, kind)?;
        let all = fields.required(c, "element").and_then(|n| several(c, n, self.names));
        let dof: Option<Dof> = fields.required(c, "dof").and_then(|n| c.dof(n));
        let end = fields.required(c, "end").and_then(|n| Some((c.count(n, "end", 0)?, n)));
        let factor = self.factor(&fields);
        let (all, dof, factor) = (all?, dof?, factor?);
        let (end, end_node) = end?;
        for (element, at) in &all {
            let found = self.elements[*element].as_ref()?;
            if !matches!(found.body, Body::Linear(_)) {
                let message = format!("`{}` ({}) is no linear element", found.name, found.kind);
                let d = c.diagnostic("E0106", message, at.clone());
                c.report(
                    d.help("record `LinkForce` of a link; constraints have no recorded force"),
                );
                return None;
            }
            if end >= found.nodes.len() {
                let last = found.nodes.len() - 1;
                let message = format!("`end` = {end}: must be between 0 and {last}");
                c.report(c.diagnostic("E0112", message, end_node.span.clone()));
                return None;
            }
        }
        let own = if dof.is_rotation() { MOMENT } else { FORCE };
        let unit = unit(own * factor.dimension, false);
        let elements = all.into_iter().map(|(element, _)| element).collect();
        Some((Quantity::ElementForce { elements, end, dof, factor: factor.value }, unit))
    }
}

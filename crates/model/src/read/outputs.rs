//! What is recorded.

mod combination;

use super::context::{Context, Fields};
use super::groups::several;
use super::names::Names;
use crate::diagnostic::names_help;
use crate::expression::Quantity as Number;
use crate::schema::{self, Block};
use crate::tree::{Entry, Kind, Node};
use crate::{Body, Element, LinkTerm, NodalTerm, Output, Quantity, Span};
use trilith_element::dimension::{FORCE, LENGTH, MOMENT, NONE};
use trilith_element::{Axis, Coordinates, Dimension, Dof, Link};

use super::motion::{nodal_dimension, unit};

struct Reading<'c, 'n> {
    c: &'c Context<'c>,
    nodes: &'c Names<'n>,
    names: &'c Names<'n>,
    elements: &'c [Option<Element>],
    /// Names and units of the outputs before.
    before: Vec<(String, Option<String>)>,
}

pub(super) fn outputs(
    c: &Context<'_>,
    entries: &[Entry],
    nodes: &Names<'_>,
    names: &Names<'_>,
    elements: &[Option<Element>],
) -> Vec<Option<Output>> {
    let mut reading = Reading { c, nodes, names, elements, before: Vec::new() };
    let mut all = Vec::with_capacity(entries.len());
    for e in entries {
        let found = reading.output(e);
        reading.before.push((e.key.clone(), found.as_ref().map(|(_, unit)| unit.clone())));
        all.push(found.map(|(quantity, unit)| Output { name: e.key.clone(), unit, quantity }));
    }
    all
}

impl Reading<'_, '_> {
    fn output(&self, e: &Entry) -> Option<(Quantity, String)> {
        let kind = self.c.one_of(&e.value, "output", &schema::OUTPUTS)?;
        let what = format!("output `{}`", e.key);
        match kind.name {
            "Displacement" => self.nodal(&e.value, &what, kind, 0),
            "Velocity" => self.nodal(&e.value, &what, kind, 1),
            "Acceleration" => self.nodal(&e.value, &what, kind, 2),
            "LinkForce" => self.link(&e.value, &what, kind, true),
            "LinkDeformation" => self.link(&e.value, &what, kind, false),
            "LinkHistory" => self.history(&e.value, &what, kind),
            "ElementForce" => self.element_force(&e.value, &what, kind),
            _ => combination::combination(self, &e.value, &what, kind),
        }
    }

    fn nodal(
        &self,
        node: &Node,
        what: &str,
        kind: &Block,
        order: usize,
    ) -> Option<(Quantity, String)> {
        let c = self.c;
        let fields = c.block(node, what, kind)?;
        let absolute = fields.get("absolute").map_or(Some(false), |n| c.flag(n, "absolute"));
        let mut terms: Vec<Option<(NodalTerm, Dimension)>> = Vec::new();
        let mut target = None;
        if let Some(list) = fields.get("terms") {
            let term = schema::TERM.blocks[0];
            if let Some(extra) = term.names().into_iter().find_map(|k| fields.get(k)) {
                let message = format!("{what} has `terms` and fields of a single term");
                c.report(c.diagnostic("E0102", message, extra.span.clone()));
            }
            for item in list.items() {
                let term = c
                    .block(item, &format!("a term of {what}"), term)
                    .and_then(|f| self.term(&f, order, target));
                target = target.or(term.map(|(_, d)| d));
                terms.push(term);
            }
            if terms.is_empty() {
                let message = format!("{what} has no terms");
                c.report(c.diagnostic("E0104", message, list.span.clone()));
            }
        } else {
            terms.push(self.term(&fields, order, None));
        }
        let terms: Vec<(NodalTerm, Dimension)> = terms.into_iter().collect::<Option<_>>()?;
        let (first, dimension) = *terms.first()?;
        let angle = first.dof.is_rotation() && dimension.matches(nodal_dimension(order, true));
        let terms = terms.into_iter().map(|(t, _)| t).collect();
        let quantity = match order {
            0 => Quantity::Displacement(terms),
            1 => Quantity::Velocity(terms),
            _ => Quantity::Acceleration { terms, absolute: absolute? },
        };
        Some((quantity, unit(dimension, angle)))
    }

    /// A term and the dimension of factor times motion; a plain factor takes the dimension that
    /// brings the term to the target.
    fn term(
        &self,
        fields: &Fields<'_>,
        order: usize,
        target: Option<Dimension>,
    ) -> Option<(NodalTerm, Dimension)> {
        let c = self.c;
        let node = fields.required(c, "node").and_then(|n| {
            self.check_single(n, self.nodes)?;
            self.nodes.refer(c, n)
        });
        let dof = fields.required(c, "dof").and_then(|n| c.dof(n))?;
        let motion = nodal_dimension(order, dof.is_rotation());
        let factor = match (fields.get("factor"), target) {
            (None, None) => Number::bare(1.0),
            (None, Some(target)) => {
                if !target.matches(motion) {
                    let message = format!(
                        "terms in {target} and in {motion} cannot be added: this one needs a `factor` in {}",
                        target / motion
                    );
                    let at = fields.get("dof").map_or(0..0, |n| n.span.clone());
                    c.report(c.diagnostic("E0111", message, at));
                    return None;
                }
                Number::bare(1.0)
            }
            (Some(n), None) => c.quantity(n)?,
            (Some(n), Some(target)) => {
                let dimension = target / motion;
                Number { value: c.number(n, dimension)?, dimension, measured: true }
            }
        };
        let term = NodalTerm { node: node?, dof, factor: factor.value };
        Some((term, factor.dimension * motion))
    }

    fn factor(&self, fields: &Fields<'_>) -> Option<Number> {
        fields.get("factor").map_or(Some(Number::bare(1.0)), |n| self.c.quantity(n))
    }

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
    fn law(&self, fields: &Fields<'_>) -> Option<(usize, &dyn Link)> {
        let node = fields.required(self.c, "link")?;
        self.check_single(node, self.names)?;
        let index = self.names.refer(self.c, node)?;
        Some((index, self.as_link(index, &node.span)?))
    }

    /// Refuses a group or a list where the values of several make no sum.
    fn check_single(&self, node: &Node, names: &Names<'_>) -> Option<()> {
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

    fn link(
        &self,
        node: &Node,
        what: &str,
        kind: &Block,
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

    fn history(&self, node: &Node, what: &str, kind: &Block) -> Option<(Quantity, String)> {
        let c = self.c;
        let fields = c.block(node, what, kind)?;
        let variable = fields.required(c, "variable")?;
        let (element, law) = self.law(&fields)?;
        let (Kind::Text(name) | Kind::Name(name)) = &variable.kind else {
            return c.wrong(variable, "the name of a history variable");
        };
        let variables = law.history();
        if let Some(field) = variables.iter().position(|f| f.name == *name) {
            let unit = variables[field].unit.to_owned();
            return Some((Quantity::LinkHistory { element, field }, unit));
        }
        let names = variables.iter().map(|f| f.name.as_ref());
        let message = format!("the link has no history variable `{name}`");
        let help = names_help(name, "history variables", names);
        c.report(c.diagnostic("E0106", message, variable.span.clone()).help(help));
        None
    }

    fn element_force(&self, node: &Node, what: &str, kind: &Block) -> Option<(Quantity, String)> {
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

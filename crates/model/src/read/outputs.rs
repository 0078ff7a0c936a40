//! What is recorded.

mod combination;
mod derived;
mod forces;
mod whole;

use super::along::Members;
use super::context::{Context, Fields};
use super::names::Names;
use crate::diagnostic::{closest, names_help};
use crate::expression::Quantity as Number;
use crate::registry::Reader;
use crate::schema::{self, Block};
use crate::tree::{Entry, Kind, Node};
use crate::{Element, NodalTerm, Output, Pattern, Quantity, Support};
use trilith_element::Dimension;

use super::motion::{nodal_dimension, unit};

/// What outputs refer to.
pub(super) struct Structure<'c, 'n> {
    pub nodes: &'c Names<'n>,
    pub names: &'c Names<'n>,
    pub places: &'c [Option<crate::Node>],
    pub supports: &'c [Option<Support>],
    pub elements: &'c [Option<Element>],
    pub patterns: &'c [Option<Pattern>],
    pub members: &'c Members<'c, 'n>,
}

struct Reading<'c, 'n> {
    c: &'c Context<'c>,
    nodes: &'c Names<'n>,
    names: &'c Names<'n>,
    elements: &'c [Option<Element>],
    of: &'c Structure<'c, 'n>,
    /// Names and units of the outputs before.
    before: Vec<(String, Option<String>)>,
}

pub(super) fn outputs(
    c: &Context<'_>,
    entries: &[Entry],
    of: &Structure<'_, '_>,
) -> Vec<Option<Output>> {
    let Structure { nodes, names, elements, .. } = *of;
    let mut reading = Reading { c, nodes, names, elements, of, before: Vec::new() };
    let mut all = Vec::with_capacity(entries.len());
    for e in entries {
        let found = reading.output(e);
        reading.before.push((e.key.clone(), found.as_ref().map(|(_, unit)| unit.clone())));
        let hidden = reading.hidden(&e.value);
        let name = e.key.clone();
        all.push(found.zip(hidden).map(|((quantity, unit), hidden)| Output {
            name,
            unit,
            quantity,
            hidden,
        }));
    }
    all
}

impl Reading<'_, '_> {
    /// Whether an output says that it is hidden; any kind may.
    fn hidden(&self, node: &Node) -> Option<bool> {
        let Kind::Fields(_, entries) = &node.kind else { return Some(false) };
        let said = entries.iter().find(|e| e.key == schema::HIDDEN.name);
        said.map_or(Some(false), |e| self.c.flag(&e.value, schema::HIDDEN.name))
    }

    fn output(&self, e: &Entry) -> Option<(Quantity, String)> {
        let what = format!("output `{}`", e.key);
        let offered = e.value.name().and_then(|name| self.c.registry.find(name));
        if let Some((card, Reader::Output(read))) = offered {
            return derived::derived(self, &e.value, &what, card, read);
        }
        let mut names = schema::OUTPUTS.names();
        names.extend(self.c.registry.outputs().map(|card| card.kind));
        // Those of other crates have been looked for, as names.
        let found = self.c.choice(&e.value, "output", &names)?;
        let kind = *schema::OUTPUTS.blocks.get(found)?;
        match kind.name {
            "Displacement" => self.nodal(&e.value, &what, kind, 0),
            "Velocity" => self.nodal(&e.value, &what, kind, 1),
            "Acceleration" => self.nodal(&e.value, &what, kind, 2),
            "LinkForce" => self.link(&e.value, &what, kind, true),
            "LinkDeformation" => self.link(&e.value, &what, kind, false),
            "LinkHistory" => self.history(&e.value, &what, kind),
            "ElementForce" => self.element_force(&e.value, &what, kind),
            "MemberForce" => self.member_force(&e.value, &what, kind),
            "BaseShear" => self.base_shear(&e.value, &what, kind),
            "Overturning" => self.overturning(&e.value, &what, kind),
            "StoreyDrift" => self.storey_drift(&e.value, &what, kind),
            "Reaction" => self.reaction(&e.value, &what, kind),
            _ => combination::combination(self, &e.value, &what, kind),
        }
    }

    /// An output that stands before, by its name.
    fn output_before(&self, name: &Node) -> Option<usize> {
        let c = self.c;
        let Kind::Text(text) = &name.kind else {
            return c.wrong(name, "the name of an output in quotes");
        };
        let found = self.before.iter().position(|(n, _)| n == text);
        if found.is_none() {
            let all = self.before.iter().map(|(n, _)| n.as_str());
            let message = format!("there is no output `{text}` before this one");
            let mut d = c.diagnostic("E0106", message, name.span.clone());
            if c.suggests() {
                d = d.help(names_help(text, "outputs before it", all.clone()));
                if let Some(near) = closest(text, all) {
                    d = d.suggestion(name.span.clone(), format!("\"{near}\""));
                }
            }
            c.report(d);
        }
        found
    }

    fn nodal(
        &self,
        node: &Node,
        what: &str,
        kind: &'static Block,
        order: usize,
    ) -> Option<(Quantity, String)> {
        let c = self.c;
        let fields = c.block(node, what, kind)?;
        let absolute = if order == 2 { fields.flag(c, "absolute") } else { Some(false) };
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

    fn history(&self, node: &Node, what: &str, kind: &'static Block) -> Option<(Quantity, String)> {
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
}

//! What bare numbers of a file are measured in.

use super::context::Context;
use crate::schema;
use crate::tree::Node;
use crate::units::FileUnits;
use trilith_element::dimension as d;

/// `units: (length: "in", force: "kip", time: "s")`; mass may stand in place of force.
pub(super) fn file_units(c: &Context<'_>, node: &Node) -> Option<FileUnits> {
    let fields = c.block(node, "`units`", schema::UNITS.blocks[0])?;
    let one = |key: &'static str, dimension| match fields.get(key) {
        None => Some(1.0),
        Some(node) => base_unit(c, node, key, dimension),
    };
    if let (Some(force), Some(mass)) = (fields.get("force"), fields.get("mass")) {
        c.report(
            c.diagnostic("E0105", "`units` names both a force and a mass", mass.span.clone())
                .related(force.span.clone(), "the force")
                .help("keep one of the two; the other follows from length and time"),
        );
        return None;
    }
    let (length, time) = (one("length", d::LENGTH)?, one("time", d::TIME)?);
    let mass = match fields.get("force") {
        Some(node) => base_unit(c, node, "force", d::FORCE)? * time * time / length,
        None => one("mass", d::MASS)?,
    };
    Some(FileUnits { length, mass, time })
}

fn base_unit(
    c: &Context<'_>,
    node: &Node,
    what: &str,
    dimension: trilith_element::Dimension,
) -> Option<f64> {
    let name = c.text(node, what)?;
    let fitting = || crate::units::UNITS.iter().filter(|u| u.dimension.matches(dimension));
    if let Some(unit) = fitting().find(|u| u.name == name) {
        return Some(unit.factor);
    }
    let all: Vec<&str> = fitting().map(|u| u.name).collect();
    c.report(
        c.diagnostic("E0109", format!("`{name}` is no unit of {what}"), node.span.clone())
            .help(format!("one of {}", all.join(", "))),
    );
    None
}

//! How a dynamic case is solved.

use super::context::{Context, Fields};
use super::custom;
use super::elements::allowed;
use crate::check::LEAST_ALPHA;
use crate::named::Named;
use crate::plain::plain_fields;
use crate::registry::Reader;
use crate::schema;
use crate::tree::Node;
use crate::{Basis, BasisKind, Solution, SolverKind, StepControl};
use trilith_element::dimension::NONE;

plain_fields!(Solution: kernel, link_tolerance, energy_limit, substep_limit);
plain_fields!(Basis: vectors, adequacy, tolerance, enrich);

pub(super) fn solution(c: &Context<'_>, fields: &Fields<'_>) -> Option<Solution> {
    let plain = Solution::default();
    let solver = fields.get("solver").map_or(Some(plain.solver), |n| solver(c, n));
    let step = fields.get("step").map_or(Some(plain.step), |n| step(c, n));
    let mut solution = Solution::default();
    let read = solution.read(c, fields);
    let basis = fields.get("basis").map_or(Some(plain.basis), |n| basis(c, n));
    let alpha = fields.get("alpha").map_or(Some(plain.alpha), |n| alpha(c, n));
    read?;
    let (solver, step, basis, alpha) = (solver?, step?, basis?, alpha?);
    Some(Solution { solver, step, basis, alpha, ..solution })
}

/// `Fna`, or the kind of another crate with its fields.
fn solver(c: &Context<'_>, node: &Node) -> Option<SolverKind> {
    let offered = node.name().and_then(|name| c.registry.find(name));
    if let Some((card, Reader::Solver(read))) = offered {
        let what = format!("solver `{}`", card.kind);
        let fields = c.fields(node, &what, &allowed(card, &[]))?;
        return custom::solver(c, &fields, &node.name_span(), card, read);
    }
    let mut names = schema::SOLVERS.to_vec();
    names.extend(c.registry.solvers().map(|card| card.kind));
    // Those of other crates have been looked for, as names.
    c.choice(node, "solver", &names).and_then(|i| SolverKind::ALL.get(i).copied())
}

fn alpha(c: &Context<'_>, node: &Node) -> Option<f64> {
    let value = c.number(node, NONE)?;
    if (LEAST_ALPHA..=0.0).contains(&value) {
        return Some(value.max(-1.0 / 3.0));
    }
    let message = format!("`alpha` = {value}: must be between -1/3 and 0");
    c.report(c.diagnostic("E0112", message, node.span.clone()));
    None
}

fn step(c: &Context<'_>, node: &Node) -> Option<StepControl> {
    let kind = c.one_of(node, "step control", &schema::STEPS)?;
    let fields = c.block(node, &format!("`{}`", kind.name), kind)?;
    if kind.name == "Adaptive" {
        let tolerance = fields.number(c, "tolerance");
        return tolerance.map(|tolerance| StepControl::Adaptive { tolerance });
    }
    fields.count(c, "substeps").map(|substeps| StepControl::Fixed { substeps })
}

fn basis(c: &Context<'_>, node: &Node) -> Option<Basis> {
    let kind = c.choice(node, "basis", &schema::BASES.names())?;
    let block = schema::BASES.blocks[kind];
    let fields = c.block(node, &format!("`{}`", block.name), block)?;
    let mut basis = Basis { kind: BasisKind::ALL[kind], ..Basis::default() };
    if basis.kind != BasisKind::Complete {
        basis.read(c, &fields)?;
    }
    Some(basis)
}

//! How a dynamic case is solved.

use super::context::{Context, Fields};
use super::custom;
use super::elements::allowed;
use crate::check::{LEAST_ALPHA, TOLERANCE};
use crate::registry::Reader;
use crate::schema;
use crate::tree::Node;
use crate::{Basis, BasisKind, Kernel, Solution, SolverKind, StepControl};
use trilith_element::Range;
use trilith_element::dimension::NONE;

pub(super) fn solution(c: &Context<'_>, fields: &Fields<'_>) -> Option<Solution> {
    let plain = Solution::default();
    let solver = fields.get("solver").map_or(Some(plain.solver), |n| solver(c, n));
    let step = fields.get("step").map_or(Some(plain.step), |n| step(c, n));
    let kernel = fields.get("kernel").map_or(Some(plain.kernel), |n| {
        let all = [Kernel::Newton, Kernel::FixedPoint];
        c.choice(n, "kernel", &schema::KERNELS).map(|i| all[i])
    });
    let share =
        |name: &str, plain: f64| fields.get(name).map_or(Some(plain), |n| tolerance(c, n, name));
    let link_tolerance = share("link_tolerance", plain.link_tolerance);
    let energy_limit = share("energy_limit", plain.energy_limit);
    let substep_limit = fields
        .get("substep_limit")
        .map_or(Some(None), |n| c.count(n, "substep_limit", 1).map(Some));
    let basis = fields.get("basis").map_or(Some(plain.basis), |n| basis(c, n));
    let alpha = fields.get("alpha").map_or(Some(plain.alpha), |n| alpha(c, n));
    Some(Solution {
        solver: solver?,
        step: step?,
        kernel: kernel?,
        link_tolerance: link_tolerance?,
        energy_limit: energy_limit?,
        substep_limit: substep_limit?,
        basis: basis?,
        alpha: alpha?,
    })
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

fn tolerance(c: &Context<'_>, node: &Node, name: &str) -> Option<f64> {
    let value = c.number(node, NONE)?;
    if TOLERANCE.contains(value) {
        return Some(value);
    }
    let message = format!("`{name}` = {value}: must be > 0 and < 1");
    c.report(c.diagnostic("E0112", message, node.span.clone()));
    None
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
        let plain = StepControl::default();
        let Some(node) = fields.get("tolerance") else { return Some(plain) };
        return tolerance(c, node, "tolerance")
            .map(|tolerance| StepControl::Adaptive { tolerance });
    }
    let substeps = fields.get("substeps").map_or(Some(1), |n| c.count(n, "substeps", 1))?;
    Some(StepControl::Fixed { substeps })
}

fn basis(c: &Context<'_>, node: &Node) -> Option<Basis> {
    let plain = Basis::default();
    let kind = c.choice(node, "basis", &schema::BASES.names())?;
    let block = schema::BASES.blocks[kind];
    let fields = c.block(node, &format!("`{}`", block.name), block)?;
    let vectors = fields.get("vectors").map_or(Some(None), |n| c.count(n, "vectors", 1).map(Some));
    let adequacy = fields
        .get("adequacy")
        .map_or(Some(plain.adequacy), |n| c.ranged(n, "adequacy", NONE, Range::Within(0.0, 1.0)));
    let tolerance = fields
        .get("tolerance")
        .map_or(Some(plain.tolerance), |n| c.ranged(n, "tolerance", NONE, Range::Within(0.0, 1.0)));
    let enrich = fields.get("enrich").map_or(Some(plain.enrich), |n| c.flag(n, "enrich"));
    let kind = [BasisKind::Ritz, BasisKind::Eigen, BasisKind::Complete][kind];
    Some(Basis {
        kind,
        vectors: vectors?,
        adequacy: adequacy?,
        tolerance: tolerance?,
        enrich: enrich?,
    })
}

//! Static cases under displacement control.
//!
//! Where a structure has a single free direction, and every case pushes it and controls it, the control is nothing else
//! than an imposed displacement: the direction is held, and moves as each case says. Elsewhere such cases are lost.

use super::cases::{Before, Case, of};
use super::context::Context;
use super::supports::free;
use crate::draft::DOFS;
use crate::ron::Ron;
use std::collections::HashMap;

const TABLE: &str = "CASE - STATIC 2 - NONLINEAR LOAD APPLICATION";
/// Kinds whose forces hang on rates: a displacement in time is no statics for them.
const BY_RATE: [&str; 5] = [
    "MaxwellDamper",
    "BilinearDamper",
    "FrictionPendulum",
    "TensionCompressionFriction",
    "TriplePendulum",
];

/// The direction that all cases control, and how far it is at the end of each.
pub struct Control<'a> {
    node: usize,
    dof: usize,
    ends: HashMap<&'a str, f64>,
}

/// True where a case is under displacement control.
pub fn is_controlled(cx: &Context<'_>, case: &str) -> bool {
    of(cx, TABLE, case).iter().any(|row| row.text("LoadApp").is_some_and(|a| a != "Full Load"))
}

/// The only free direction, where all cases that could be written control it.
pub fn whole<'a>(cx: &mut Context<'a>, all: &[Case<'a>]) -> Option<Control<'a>> {
    let written = || all.iter().filter(|c| c.kind.ends_with("Static") || c.kind.ends_with("Hist"));
    let every = written().all(|c| c.kind == "NonStatic" && is_controlled(cx, c.name));
    if written().next().is_none() || !every || by_rate(cx) {
        return None;
    }
    let mut directions = (0..cx.draft.nodes.len()).flat_map(|n| {
        let dofs = free(cx, n);
        dofs.into_iter().map(move |dof| (n, dof)).collect::<Vec<_>>()
    });
    let (Some((node, dof)), None) = (directions.next(), directions.next()) else { return None };
    let dof = DOFS.iter().position(|d| *d == dof)?;
    cx.draft.supports.entry(node).or_default()[dof] = true;
    cx.watch(node);
    Some(Control { node, dof, ends: HashMap::new() })
}

fn by_rate(cx: &Context<'_>) -> bool {
    let sets = cx.draft.properties.iter().chain(&cx.draft.elements);
    sets.map(|(_, set)| set).any(|set| {
        let Ron::Block(kind, fields) = set else { return false };
        let damped = |name: &str| name == "damping" || name.starts_with('c') && name != "corners";
        BY_RATE.contains(&kind.as_str())
            || matches!(kind.as_str(), "Spring" | "LinearLink")
                && fields.iter().any(|(n, _)| damped(n))
    })
}

/// A case as an imposed displacement from where the one before it ended.
pub fn imposed<'a>(
    cx: &mut Context<'a>,
    control: &mut Control<'a>,
    case: &Case<'a>,
    before: &Before<'_>,
) -> Option<Ron> {
    let row = of(cx, TABLE, case.name).first().copied()?;
    let start = before.after.and_then(|a| control.ends.get(a)).copied().unwrap_or(0.0);
    let key = if control.dof < 3 { "TargetDispl" } else { "TargetRot" };
    let (way, target) = (row.text("DisplType").unwrap_or_default(), row.need_number(key));
    let at = row.text("MonitorJt").is_none_or(|j| cx.joints.get(j) == Some(&control.node));
    if !at || way == "Monitored" && start != 0.0 {
        return None;
    }
    let mut push = 0.0;
    for row in of(cx, "CASE - STATIC 1 - LOAD ASSIGNMENTS", case.name) {
        let forces = cx.patterns.get(row.need("LoadName")).and_then(|p| p.get(&control.node));
        push += row.number("LoadSF").unwrap_or(1.0) * forces.map_or(0.0, |f| f[control.dof]);
        row.text("LoadType");
    }
    if push == 0.0 {
        return None;
    }
    let end = start + target.abs() * push.signum();
    control.ends.insert(case.name, end);
    let path = format!("{} path", case.name);
    let points = Ron::List(vec![Ron::vector(&[0.0, start]), Ron::vector(&[1.0, end])]);
    let points =
        Ron::block("Points").with("points", points).with("interpolation", Ron::word("Cubic"));
    cx.draft.functions.push((path.clone(), points));
    let mut support = Ron::block("")
        .with("node", Ron::text(cx.name(control.node)))
        .with("dof", Ron::word(DOFS[control.dof]))
        .with("displacement", Ron::Text(path));
    if control.dof < 3 {
        support = support.with("factor", Ron::Text(format!("1 {}", cx.draft.units.0)));
    }
    let what =
        "displacement control of the only free direction is a displacement of it, over a second";
    cx.report.otherwise(TABLE, what, case.name);
    let block = Ron::block("Dynamic").maybe("after", before.after.map(Ron::text));
    let block = block.with("duration", 1.0).with("dt", 0.01);
    Some(block.with("supports", Ron::List(vec![support])))
}

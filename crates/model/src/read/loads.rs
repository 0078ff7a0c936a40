//! Load patterns and the lists of loads that cases apply.

use super::along::Members;
use super::context::Context;
use super::groups::several;
use super::names::Names;
use crate::schema;
use crate::tree::{Entry, Kind, Node};
use crate::{Load, NodalForce, Pattern};
use trilith_element::dimension::{FORCE, MOMENT};

pub(super) fn patterns(
    c: &Context<'_>,
    entries: &[Entry],
    nodes: &Names<'_>,
    members: &Members<'_, '_>,
) -> Vec<Option<Pattern>> {
    let one = |e: &Entry| {
        let items = e.value.items();
        let what = format!("load `{}`", e.key);
        let (along, at): (Vec<&Node>, Vec<&Node>) =
            items.iter().copied().partition(|n| n.name().is_some());
        let forces: Vec<_> = at.iter().map(|n| force(c, n, nodes, &what)).collect();
        let loads: Vec<_> = along.iter().map(|n| members.loads(c, n, &what)).collect();
        if items.is_empty() {
            let d =
                c.diagnostic("E0104", format!("load `{}` is empty", e.key), e.value.span.clone());
            c.report(d.help("write `[(node: \"…\", dof: Uz, force: …)]`"));
        }
        let forces = forces.into_iter().collect::<Option<Vec<_>>>();
        let loads = loads.into_iter().collect::<Option<Vec<_>>>();
        let (forces, members) = (forces?.concat(), loads?.concat());
        Some(Pattern { name: e.key.clone(), forces, members })
    };
    entries.iter().map(one).collect()
}

/// A force at a node, or at each of several.
fn force(c: &Context<'_>, item: &Node, nodes: &Names<'_>, what: &str) -> Option<Vec<NodalForce>> {
    let fields = c.block(item, what, &schema::FORCE)?;
    let at = fields.required(c, "node").and_then(|n| several(c, n, nodes));
    let dof = fields.required(c, "dof").and_then(|n| c.dof(n))?;
    let (key, other, dimension) =
        if dof.is_rotation() { ("moment", "force", MOMENT) } else { ("force", "moment", FORCE) };
    if let Some(wrong) = fields.get(other) {
        let message = format!("{what}: {} takes a `{key}`, not a `{other}`", dof.name());
        c.report(c.diagnostic("E0105", message, wrong.span.clone()));
        return None;
    }
    let value = c.number(fields.required(c, key)?, dimension)?;
    Some(at?.into_iter().map(|(node, _)| NodalForce { node, dof, value }).collect())
}

/// `[Gravity, Gravity(factor: 1), (load: "name", factor: 1)]`.
pub(super) fn list(c: &Context<'_>, node: &Node, loads: &Names<'_>) -> Option<Vec<Load>> {
    let all: Vec<_> = node.items().into_iter().map(|n| load(c, n, loads)).collect();
    all.into_iter().collect()
}

fn load(c: &Context<'_>, node: &Node, loads: &Names<'_>) -> Option<Load> {
    if node.name().is_some() {
        c.choice(node, "load", &[schema::GRAVITY.name])?;
        let fields = c.block(node, "`Gravity`", &schema::GRAVITY)?;
        let factor = fields.number(c, "factor")?;
        return Some(Load::Gravity { factor });
    }
    if let Kind::Text(_) = node.kind {
        return Some(Load::Pattern { pattern: loads.refer(c, node)?, factor: 1.0 });
    }
    let fields = c.block(node, "a load", &schema::LOAD)?;
    let pattern = fields.required(c, "load").and_then(|n| loads.refer(c, n));
    let factor = fields.number(c, "factor");
    Some(Load::Pattern { pattern: pattern?, factor: factor? })
}

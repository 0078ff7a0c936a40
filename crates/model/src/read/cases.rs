//! Analysis cases.

use super::context::{Context, Fields};
use super::names::Names;
use super::{dynamic, loads};
use crate::schema;
use crate::tree::{Entry, Kind, Node};
use crate::{Analysis, Case, Function, StaticCase, Support};

/// What cases refer to.
pub(super) struct Surroundings<'a, 'n> {
    pub nodes: &'a Names<'n>,
    pub supports: &'a [Option<Support>],
    pub functions: &'a Names<'n>,
    pub functions_read: &'a [Option<Function>],
    pub loads: &'a Names<'n>,
}

pub(super) fn cases(
    c: &Context<'_>,
    entries: &[Entry],
    about: &Surroundings<'_, '_>,
) -> Vec<Option<Case>> {
    let names = Names::new("case", "cases", entries);
    let one = |(i, e): (usize, &Entry)| {
        let what = format!("case `{}`", e.key);
        let kind = c.one_of(&e.value, "analysis", &schema::CASES)?;
        let fields = c.block(&e.value, &what, kind)?;
        let after = after(c, &fields, &names, i);
        let analysis = if kind.name == "Static" {
            let applied = fields.required(c, "loads").and_then(|n| loads::list(c, n, about.loads));
            let steps = fields.count(c, "steps");
            Analysis::Static(StaticCase { loads: applied?, steps: steps? })
        } else {
            Analysis::Dynamic(Box::new(dynamic::dynamic(c, &fields, about)?))
        };
        Some(Case { name: e.key.clone(), after: after?, analysis, span: e.key_span.clone() })
    };
    entries.iter().enumerate().map(one).collect()
}

/// `p_delta: "gravity"`: a static case that starts from nothing.
pub(super) fn p_delta(
    c: &Context<'_>,
    node: &Node,
    entries: &[Entry],
    cases: &[Option<Case>],
) -> Option<Option<usize>> {
    let found = Names::new("case", "cases", entries).refer(c, node)?;
    // A case that could not be read has been reported.
    let case = cases[found].as_ref()?;
    if matches!(case.analysis, Analysis::Static(_)) {
        return Some(Some(found));
    }
    let message = format!("`p_delta` names `{}`, which is a dynamic case", case.name);
    let d = c.diagnostic("E0118", message, node.span.clone());
    c.report(d.help("name the static case whose axial forces act, such as gravity"));
    None
}

/// The case before: only one that stands earlier in the file, so nothing can run in a circle.
fn after(
    c: &Context<'_>,
    fields: &Fields<'_>,
    names: &Names<'_>,
    own: usize,
) -> Option<Option<usize>> {
    let Some(node) = fields.get("after") else { return Some(None) };
    if matches!(&node.kind, Kind::Name(n) if n == "None") {
        return Some(None);
    }
    let found = names.refer(c, node)?;
    if found < own {
        return Some(Some(found));
    }
    let (name, this) = (names.name(found), names.name(own));
    let message = if found == own {
        format!("case `{this}` continues itself")
    } else {
        format!("case `{this}` continues `{name}`, which stands after it")
    };
    let d = c.diagnostic("E0118", message, node.span.clone());
    c.report(d.help("a case continues one that stands before it in the file"));
    None
}

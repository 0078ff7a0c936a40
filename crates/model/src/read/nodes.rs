//! Nodes and supports.

use super::context::Context;
use super::names::Names;
use crate::schema;
use crate::tree::{Entry, Kind};
use crate::{Node, Span, Support};
use std::collections::HashMap;
use trilith_element::Dof;

pub(super) fn nodes(c: &Context<'_>, entries: &[Entry]) -> Vec<Option<Node>> {
    let one = |e: &Entry| {
        let position = c.place(&e.value, &format!("node {}", e.key))?;
        Some(Node { name: e.key.clone(), position, span: e.key_span.clone() })
    };
    entries.iter().map(one).collect()
}

/// `Fixed`, `Pinned`, one direction, or a list of directions, of a node or of each of a group.
pub(super) fn supports(
    c: &Context<'_>,
    entries: &[Entry],
    nodes: &Names<'_>,
) -> Vec<Option<Support>> {
    let one = |e: &Entry| -> Vec<Option<Support>> {
        let name = crate::tree::Node { span: e.key_span.clone(), kind: Kind::Name(e.key.clone()) };
        let on = nodes.refer_to_all(c, &name);
        let mut fixed = [false; 6];
        match e.value.name() {
            Some("Fixed") => fixed = [true; 6],
            Some("Pinned") => fixed[..3].fill(true),
            _ => {
                let items = e.value.items();
                if items.is_empty() {
                    let d =
                        c.diagnostic("E0116", "this support fixes nothing", e.value.span.clone());
                    c.report(d.help("write `Fixed`, `Pinned` or directions such as `(Ux, Uz)`"));
                }
                for item in items {
                    let names = [&Dof::ALL.map(Dof::name)[..], &schema::SUPPORTS].concat();
                    match c.choice(item, "support direction", &names) {
                        Some(i) if i < 6 && !fixed[i] => fixed[i] = true,
                        Some(i) => {
                            let message = format!(
                                "`{}` does not belong here a second time or in a list",
                                names[i]
                            );
                            c.report(c.diagnostic("E0116", message, item.span.clone()));
                        }
                        None => {}
                    }
                }
            }
        }
        let Some(on) = on else { return vec![None] };
        on.into_iter().map(|node| Some(Support { node, fixed, span: e.key_span.clone() })).collect()
    };
    let all: Vec<Option<Support>> = entries.iter().flat_map(one).collect();
    let mut first: HashMap<usize, &Span> = HashMap::with_capacity(all.len());
    for s in all.iter().flatten() {
        if let Some(before) = first.insert(s.node, &s.span) {
            let message = format!("node `{}` has two supports", nodes.name(s.node));
            let d = c.diagnostic("E0116", message, s.span.clone());
            c.report(d.related(before.clone(), "the first").help("put them into one"));
        }
    }
    all
}

//! Nodes and supports.

use super::context::Context;
use super::names::Names;
use crate::schema;
use crate::tree::{Entry, Kind};
use crate::{Node, Support};
use trilith_element::Dof;

pub(super) fn nodes(c: &Context<'_>, entries: &[Entry]) -> Vec<Option<Node>> {
    let one = |e: &Entry| {
        let position = c.place(&e.value, &format!("node {}", e.key))?;
        Some(Node { name: e.key.clone(), position, span: e.key_span.clone() })
    };
    entries.iter().map(one).collect()
}

/// `Fixed`, `Pinned`, one direction, or a list of directions.
pub(super) fn supports(
    c: &Context<'_>,
    entries: &[Entry],
    nodes: &Names<'_>,
) -> Vec<Option<Support>> {
    let one = |e: &Entry| {
        let name = crate::tree::Node { span: e.key_span.clone(), kind: Kind::Name(e.key.clone()) };
        let node = nodes.refer(c, &name);
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
        Some(Support { node: node?, fixed, span: e.key_span.clone() })
    };
    entries.iter().map(one).collect()
}

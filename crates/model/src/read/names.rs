//! Names that other places of the file refer to.

use super::context::Context;
use crate::Span;
use crate::diagnostic::{closest, names_help};
use crate::tree::{Entry, Kind, Node};
use std::collections::HashMap;

/// The names of a section, in file order.
pub(crate) struct Names<'n> {
    one: &'static str,
    many: &'static str,
    names: Vec<(&'n str, Span)>,
    index: HashMap<&'n str, usize>,
}

impl<'n> Names<'n> {
    /// The keys of a section, called for instance `node` and `nodes` in messages.
    pub fn new(one: &'static str, many: &'static str, entries: &'n [Entry]) -> Self {
        let names: Vec<_> = entries.iter().map(|e| (e.key.as_str(), e.key_span.clone())).collect();
        let index = names.iter().enumerate().map(|(i, (n, _))| (*n, i)).collect();
        Self { one, many, names, index }
    }

    pub fn position(&self, name: &str) -> Option<usize> {
        self.index.get(name).copied()
    }

    pub fn name(&self, index: usize) -> &'n str {
        self.names.get(index).map_or("", |(n, _)| n)
    }

    /// The index that a value of the file refers to.
    pub fn refer(&self, c: &Context<'_>, node: &Node) -> Option<usize> {
        let name = match &node.kind {
            Kind::Text(name) | Kind::Name(name) => name,
            _ => {
                let message =
                    format!("the name of a {} is wanted here, not {}", self.one, node.describe());
                c.report(c.diagnostic("E0105", message, node.span.clone()));
                return None;
            }
        };
        if let Some(i) = self.position(name) {
            return Some(i);
        }
        let mut d = c
            .diagnostic("E0106", format!("there is no {} `{name}`", self.one), node.span.clone())
            .label("not defined");
        if !c.suggests() {
            c.report(d);
            return None;
        }
        let all = self.names.iter().map(|(n, _)| *n);
        d = d.help(names_help(name, self.many, all.clone()));
        if let Some(near) = closest(name, all) {
            let quoted = matches!(node.kind, Kind::Text(_));
            let near_text = if quoted { format!("\"{near}\"") } else { near.to_owned() };
            d = d.suggestion(node.span.clone(), near_text);
            if let Some(i) = self.position(near) {
                d = d.related(self.names[i].1.clone(), "similar name here");
            }
        }
        c.report(d);
        None
    }
}

//! Names that other places of the file refer to.

use super::context::Context;
use super::groups::Groups;
use crate::Span;
use crate::diagnostic::{closest, names_help};
use crate::tree::{Entry, Kind, Node};
use std::collections::HashMap;

/// What the names of nodes are called.
pub(crate) const NODE: &str = "node";

/// The names of a section, in file order.
pub(crate) struct Names<'n> {
    one: &'static str,
    many: &'static str,
    names: Vec<(&'n str, Span)>,
    index: HashMap<&'n str, usize>,
    /// Groups, where several may stand for one.
    groups: Option<&'n Groups>,
}

impl<'n> Names<'n> {
    /// The keys of a section, called for instance `node` and `nodes` in messages.
    pub fn new(one: &'static str, many: &'static str, entries: &'n [Entry]) -> Self {
        let names: Vec<_> = entries.iter().map(|e| (e.key.as_str(), e.key_span.clone())).collect();
        let index = names.iter().enumerate().map(|(i, (n, _))| (*n, i)).collect();
        Self { one, many, names, index, groups: None }
    }

    /// The same with groups, which may stand for several.
    pub fn with(self, groups: &'n Groups) -> Self {
        Self { groups: Some(groups), ..self }
    }

    /// Such as `a node`.
    pub fn one(&self) -> String {
        let article = if self.one.starts_with(['a', 'e', 'o']) { "an" } else { "a" };
        format!("{article} {}", self.one)
    }

    /// Such as `node`.
    pub fn one_word(&self) -> &'static str {
        self.one
    }

    pub fn len(&self) -> usize {
        self.names.len()
    }

    pub fn all(&self) -> impl Iterator<Item = &'n str> + Clone {
        self.names.iter().map(|(n, _)| *n)
    }

    /// Where a name is defined.
    pub fn span(&self, index: usize) -> Span {
        self.names[index].1.clone()
    }

    pub fn position(&self, name: &str) -> Option<usize> {
        self.index.get(name).copied()
    }

    pub fn name(&self, index: usize) -> &'n str {
        self.names.get(index).map_or("", |(n, _)| n)
    }

    /// The indices that a value of the file refers to: one, or those of a group.
    pub fn refer_to_all(&self, c: &Context<'_>, node: &Node) -> Option<Vec<usize>> {
        if let Some((members, true)) = self.group(node) {
            return Some(members.to_vec());
        }
        self.refer(c, node).map(|i| vec![i])
    }

    /// The members of the group that a value refers to, and whether they are of this kind.
    pub fn group(&self, node: &Node) -> Option<(&'n [usize], bool)> {
        let (Kind::Text(name) | Kind::Name(name)) = &node.kind else { return None };
        let (members, of_nodes) = self.groups?.get(name)?;
        self.position(name).is_none().then_some((members, of_nodes == (self.one == NODE)))
    }

    /// The index that a value of the file refers to.
    pub fn refer(&self, c: &Context<'_>, node: &Node) -> Option<usize> {
        let name = match &node.kind {
            Kind::Text(name) | Kind::Name(name) => name,
            _ => {
                let message =
                    format!("the name of {} is wanted here, not {}", self.one(), node.describe());
                c.report(c.diagnostic("E0105", message, node.span.clone()));
                return None;
            }
        };
        if let Some(i) = self.position(name) {
            return Some(i);
        }
        if let Some((members, own)) = self.group(node) {
            let of = if own == (self.one == NODE) { "nodes" } else { "elements" };
            let what = if own { "one name".to_owned() } else { self.one() };
            let message =
                format!("`{name}` is a group of {} {of}: {what} is wanted here", members.len());
            c.report(c.diagnostic("E0106", message, node.span.clone()).label("a group"));
            return None;
        }
        let mut d = c
            .diagnostic("E0106", format!("there is no {} `{name}`", self.one), node.span.clone())
            .label("not defined");
        if !c.suggests() {
            c.report(d);
            return None;
        }
        let of_nodes = self.one == NODE;
        let groups = self.groups.iter().flat_map(|groups| groups.names(of_nodes));
        let mut groups: Vec<&str> = groups.collect();
        groups.sort_unstable();
        let all = self.all().chain(groups);
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

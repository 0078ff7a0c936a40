//! Named groups of nodes or of elements.

use super::context::Context;
use super::names::Names;
use crate::Span;
use crate::diagnostic::names_help;
use crate::schema;
use crate::tree::{Entry, Kind, Node};
use std::collections::{HashMap, HashSet};

/// Nodes or elements that one name stands for.
pub(crate) struct Group {
    /// True for nodes, false for elements.
    of_nodes: bool,
    members: Vec<usize>,
}

/// Groups by name.
#[derive(Default)]
pub(crate) struct Groups(HashMap<String, Group>);

impl Groups {
    /// The members of a group, and whether they are nodes.
    pub fn get(&self, name: &str) -> Option<(&[usize], bool)> {
        self.0.get(name).map(|g| (g.members.as_slice(), g.of_nodes))
    }

    /// What is left of them in the model, in the order of these entries.
    pub fn kept(&self, entries: &[Entry]) -> Vec<crate::Group> {
        let one = |e: &Entry| {
            let (members, of_nodes) = self.get(&e.key)?;
            Some(crate::Group { name: e.key.clone(), of_nodes, members: members.to_vec() })
        };
        entries.iter().filter_map(one).collect()
    }

    /// Names of the groups of nodes, or of those of elements, in no order.
    pub fn names(&self, of_nodes: bool) -> impl Iterator<Item = &str> {
        let fits = move |(_, g): &(&String, &Group)| g.of_nodes == of_nodes;
        self.0.iter().filter(fits).map(|(name, _)| name.as_str())
    }
}

/// `"isolators": ["isolator *"]`, `"floor": Nodes(["a1", "b1"])`.
pub(super) fn groups(
    c: &Context<'_>,
    entries: &[Entry],
    nodes: &Names<'_>,
    elements: &Names<'_>,
) -> Groups {
    let reading = Reading { c, nodes, elements };
    let one = |e: &Entry| Some((e.key.clone(), reading.group(e)?));
    Groups(entries.iter().filter_map(one).collect())
}

struct Reading<'c, 'n> {
    c: &'c Context<'c>,
    nodes: &'c Names<'n>,
    elements: &'c Names<'n>,
}

impl Reading<'_, '_> {
    fn group(&self, e: &Entry) -> Option<Group> {
        let c = self.c;
        for names in [self.nodes, self.elements] {
            if let Some(i) = names.position(&e.key) {
                let message = format!("`{}` names a group and {}", e.key, names.one());
                let d = c.diagnostic("E0102", message, e.key_span.clone());
                c.report(
                    d.related(names.span(i), "the other").help("give one of them another name"),
                );
                return None;
            }
        }
        let kind = match e.value.name() {
            Some(_) => Some(c.choice(&e.value, "group", &schema::GROUP_KINDS)? == 0),
            None => None,
        };
        let items = match &e.value.kind {
            Kind::List(Some(_), items) => items.iter().flat_map(Node::items).collect(),
            Kind::Fields(Some(_), _) | Kind::Name(_) => Vec::new(),
            _ => e.value.items(),
        };
        if items.is_empty() {
            let d =
                c.diagnostic("E0104", format!("group `{}` is empty", e.key), e.value.span.clone());
            c.report(
                d.help("write names, such as `[\"a\", \"b\"]`, or a pattern, such as `[\"a *\"]`"),
            );
            return None;
        }
        let mut parts: Vec<(&Node, &str)> = Vec::with_capacity(items.len());
        for item in items {
            match &item.kind {
                Kind::Text(name) => parts.push((item, name)),
                _ => return c.wrong(item, "the name of a node or an element in quotes"),
            }
        }
        let of_nodes = match kind {
            Some(of_nodes) => of_nodes,
            None => self.kind(e, &parts)?,
        };
        let names = if of_nodes { self.nodes } else { self.elements };
        let members = self.members(names, &parts)?;
        Some(Group { of_nodes, members })
    }

    /// Whether names are those of nodes; refused where that cannot be told.
    fn kind(&self, e: &Entry, parts: &[(&Node, &str)]) -> Option<bool> {
        let c = self.c;
        let misfit = |names: &Names<'_>| parts.iter().find(|(_, part)| !fits_any(names, part));
        let (no_node, no_element) = match (misfit(self.nodes), misfit(self.elements)) {
            (None, Some(_)) => return Some(true),
            (Some(_), None) => return Some(false),
            (None, None) => {
                let message =
                    format!("group `{}`: these are names of nodes and of elements", e.key);
                let d = c.diagnostic("E0106", message, e.value.span.clone());
                c.report(d.help("write `Nodes([…])` or `Elements([…])`"));
                return None;
            }
            (Some(a), Some(b)) => (a, b),
        };
        let unknown = parts
            .iter()
            .find(|(_, part)| !fits_any(self.nodes, part) && !fits_any(self.elements, part));
        match unknown {
            Some((node, part)) => {
                let message = match part.contains('*') {
                    true => format!("no node and no element fits `{part}`"),
                    false => format!("there is no node and no element `{part}`"),
                };
                let mut d = c.diagnostic("E0106", message, node.span.clone());
                if c.suggests() {
                    let all: Vec<&str> = self.nodes.all().chain(self.elements.all()).collect();
                    d = d.help(names_help(part, "nodes and elements", all));
                }
                c.report(d);
            }
            None => {
                let (node, element) = (no_element.1, no_node.1);
                let message =
                    format!("group `{}` mixes nodes (`{node}`) and elements (`{element}`)", e.key);
                let d = c.diagnostic("E0106", message, no_node.0.span.clone());
                c.report(d.help("make two groups of them"));
            }
        }
        None
    }

    fn members(&self, names: &Names<'_>, parts: &[(&Node, &str)]) -> Option<Vec<usize>> {
        let c = self.c;
        let (mut members, mut seen) = (Vec::with_capacity(parts.len()), HashSet::new());
        for (node, part) in parts {
            if names.position(part).is_none() && part.contains('*') {
                let fitting = (0..names.len()).filter(|i| fits(part, names.name(*i)));
                let before = seen.len();
                let mut found = 0;
                members.extend(fitting.inspect(|_| found += 1).filter(|i| seen.insert(*i)));
                if found == 0 && before == seen.len() {
                    let message = format!("no {} fits `{part}`", names.one_word());
                    c.report(c.diagnostic("E0106", message, node.span.clone()));
                    return None;
                }
                continue;
            }
            let i = names.refer(c, node)?;
            if !seen.insert(i) {
                let message = format!("`{part}` is in the group twice");
                c.report(
                    c.diagnostic("E0102", message, node.span.clone()).help("keep one of the two"),
                );
                return None;
            }
            members.push(i);
        }
        Some(members)
    }
}

fn fits_any(names: &Names<'_>, part: &str) -> bool {
    names.position(part).is_some() || part.contains('*') && names.all().any(|n| fits(part, n))
}

/// True where a name fits a pattern in which `*` stands for anything.
#[must_use]
pub fn fits(pattern: &str, name: &str) -> bool {
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else { return false };
    let Some(last) = parts.next_back() else { return rest.is_empty() };
    for part in parts {
        match rest.find(part) {
            Some(at) => rest = &rest[at + part.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}

/// Names of several, one after the other: of a list, or of one value.
pub(super) fn several(
    c: &Context<'_>,
    node: &Node,
    names: &Names<'_>,
) -> Option<Vec<(usize, Span)>> {
    let mut all: Vec<(usize, Span)> = Vec::new();
    let mut good = true;
    let items = node.items();
    if items.is_empty() {
        return c.wrong(node, &format!("the name of {}", names.one()));
    }
    for item in items {
        match names.refer_to_all(c, item) {
            Some(found) => all.extend(found.iter().map(|i| (*i, item.span.clone()))),
            None => good = false,
        }
    }
    let mut first = HashMap::with_capacity(all.len());
    for (i, span) in &all {
        if let Some(before) = first.insert(*i, span) {
            let message = format!("`{}` comes twice", names.name(*i));
            let d = c.diagnostic("E0102", message, span.clone());
            c.report(if before == span { d } else { d.related(before.clone(), "first here") });
            good = false;
            break;
        }
    }
    good.then_some(all)
}

#[cfg(test)]
mod tests {
    use super::fits;

    #[test]
    fn a_star_stands_for_anything() {
        for (pattern, name) in [
            ("a*", "a"),
            ("a*", "abc"),
            ("*", ""),
            ("*1", "11"),
            ("a*b*c", "axxbxbc"),
            ("é *", "é 1"),
        ] {
            assert!(fits(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in
            [("a*", "b"), ("*1", "12"), ("a*a", "a"), ("a*b*c", "acb"), ("a", "ab")]
        {
            assert!(!fits(pattern, name), "{pattern} {name}");
        }
    }
}

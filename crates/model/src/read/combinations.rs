//! Combinations of cases.

use super::context::Context;
use super::names::Names;
use crate::diagnostic::names_help;
use crate::schema;
use crate::tree::{Entry, Kind, Node};
use crate::{Combination, CombinationTerm, CombineCases, Span};
use trilith_element::dimension::NONE;

/// `"design": Envelope(cases: ["quake 1", "quake 2"])`.
pub(super) fn combinations(
    c: &Context<'_>,
    entries: &[Entry],
    cases: &Names<'_>,
) -> Vec<Option<Combination>> {
    let reading = Reading { c, entries, cases };
    (0..entries.len()).map(|i| reading.combination(i)).collect()
}

struct Reading<'c, 'n> {
    c: &'c Context<'c>,
    entries: &'n [Entry],
    cases: &'c Names<'n>,
}

impl Reading<'_, '_> {
    fn combination(&self, own: usize) -> Option<Combination> {
        let (c, e) = (self.c, &self.entries[own]);
        if let Some(case) = self.cases.position(&e.key) {
            let message = format!("`{}` names a combination and a case", e.key);
            let d = c.diagnostic("E0102", message, e.key_span.clone());
            let d = d.related(self.cases.span(case), "the case");
            c.report(d.help("give one of them another name"));
        }
        let what = format!("combination `{}`", e.key);
        let kind = c.choice(&e.value, "combination", &schema::COMBINATIONS.names())?;
        let fields = c.block(&e.value, &what, schema::COMBINATIONS.blocks[kind])?;
        let list = fields.required(c, "cases")?;
        let terms: Vec<Option<(CombinationTerm, f64)>> = match &list.kind {
            Kind::Map(entries) | Kind::Fields(None, entries) => entries
                .iter()
                .map(|term| {
                    let found = self.term(&term.key, &term.key_span, own);
                    found.zip(c.number(&term.value, NONE))
                })
                .collect(),
            Kind::Text(_) | Kind::List(None, _) => {
                list.items().into_iter().map(|name| Some((self.named(name, own)?, 1.0))).collect()
            }
            _ => return c.wrong(list, "a map from names of cases to factors, or a list of names"),
        };
        if terms.is_empty() {
            let d = c.diagnostic("E0104", format!("{what} has no cases"), list.span.clone());
            c.report(d.help("name at least one: `cases: [\"quake\"]`"));
            return None;
        }
        let terms: Vec<_> = terms.into_iter().collect::<Option<_>>()?;
        let again = |i: &usize| terms[..*i].iter().any(|(term, _)| *term == terms[*i].0);
        if let Some(i) = (0..terms.len()).find(again) {
            let message = format!("{what} names `{}` twice", self.name(terms[i].0));
            let d = c.diagnostic("E0102", message, list.span.clone());
            c.report(d.help("keep one of the two, with the sum of their factors"));
            return None;
        }
        Some(Combination { name: e.key.clone(), how: CombineCases::ALL[kind], terms })
    }

    fn name(&self, term: CombinationTerm) -> &str {
        match term {
            CombinationTerm::Case(i) => self.cases.name(i),
            CombinationTerm::Combination(i) => &self.entries[i].key,
        }
    }

    fn named(&self, node: &Node, own: usize) -> Option<CombinationTerm> {
        match &node.kind {
            Kind::Text(name) => self.term(name, &node.span, own),
            _ => self.c.wrong(node, "the name of a case or of a combination in quotes"),
        }
    }

    /// A case, or a combination before this one.
    fn term(&self, name: &str, at: &Span, own: usize) -> Option<CombinationTerm> {
        let c = self.c;
        if let Some(case) = self.cases.position(name) {
            return Some(CombinationTerm::Case(case));
        }
        if let Some(i) = self.entries[..own].iter().position(|e| e.key == *name) {
            return Some(CombinationTerm::Combination(i));
        }
        let later = self.entries[own..].iter().any(|e| e.key == *name);
        let message = match later {
            true => format!("`{name}` is no combination before this one"),
            false => format!("there is no case and no combination `{name}`"),
        };
        let mut d = c.diagnostic("E0106", message, at.clone());
        if later {
            d = d.help("a combination takes those that stand before it: put it behind");
        } else if c.suggests() {
            let before = self.entries[..own].iter().map(|e| e.key.as_str());
            let all: Vec<&str> = self.cases.all().chain(before).collect();
            d = d.help(names_help(name, "cases and combinations", all));
        }
        c.report(d);
        None
    }
}

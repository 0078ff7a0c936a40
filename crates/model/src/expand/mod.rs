//! Repetition: `For` makes many entries of a map or items of a list, `{…}` in a text is a whole number.
//!
//! What the sections of a model hold is expanded once the parameters are known and before anything is read, so the
//! rest of the reader knows nothing of it. Every entry that is made has spans of its own, which [`Places`] leads back
//! to the text and the indices that it is made of.

mod condition;
mod repeat;
mod text;

use crate::Span;
use crate::expression::ExpressionError;
use crate::parameters::Evaluated;
use crate::places::Places;
use crate::read::{Context, Fields};
use crate::tree::{Entry, Kind, Node, twice};
use repeat::Repetition;

/// Most entries that the repetitions of a model make.
pub(crate) const MOST_ENTRIES: usize = 1_000_000;
/// Most values in them, long texts counted as several.
const MOST_VALUES: usize = 10_000_000;
/// Bytes of a text that count as a value.
const VALUE: usize = 32;

/// True where a value has something to expand.
pub(crate) fn has_templates(node: &Node) -> bool {
    let braces = |text: &str| text.contains(['{', '}']);
    match &node.kind {
        Kind::Text(text) => braces(text),
        Kind::List(_, items) => items.iter().any(has_templates),
        Kind::Fields(Some(name), _) if name == Repetition::NAME => true,
        Kind::Fields(_, entries) => entries.iter().any(|e| has_templates(&e.value)),
        Kind::Map(all) => all.iter().any(|e| braces(&e.key) || has_templates(&e.value)),
        Kind::Number(_) | Kind::Flag(_) | Kind::Name(_) => false,
    }
}

/// The fields of a model of these names, expanded; none where that cannot be done, which has been told.
pub(crate) fn expand(
    c: &mut Context<'_>,
    top: &Fields<'_>,
    names: &[String],
) -> Option<Vec<Entry>> {
    if names.is_empty() {
        return Some(Vec::new());
    }
    let places = c.places.clone();
    let mut it = Expander { c, places, entries: MOST_ENTRIES, values: MOST_VALUES, good: true };
    let mut made = Vec::with_capacity(names.len());
    let whole = Here { from: 0, to: 0 };
    for e in top.entries().iter().filter(|e| names.contains(&e.key)) {
        match it.value(&e.value, whole) {
            Ok(value) => {
                made.push(Entry { key: e.key.clone(), key_span: e.key_span.clone(), value })
            }
            Err(Stop::Here) => {}
            Err(Stop::All) => break,
        }
    }
    let (places, good) = (it.places, it.good);
    c.places = places;
    good.then_some(made)
}

/// Why something is not expanded, which has been told.
enum Stop {
    /// It is wrong.
    Here,
    /// It is too much.
    All,
}

type Expanded<T> = Result<T, Stop>;

/// Which repetition of a text this is: what stands at `from` in the text stands at `to` in it.
#[derive(Clone, Copy)]
struct Here {
    from: usize,
    to: usize,
}

impl Here {
    fn span(self, span: &Span) -> Span {
        // The text begins at `from`, so nothing in it stands before.
        let at = |x: usize| x - self.from + self.to;
        at(span.start)..at(span.end)
    }
}

struct Expander<'c, 'r> {
    c: &'c Context<'r>,
    places: Places,
    /// Entries and values that may still be made.
    entries: usize,
    values: usize,
    good: bool,
}

impl Expander<'_, '_> {
    /// Reports what is wrong with a part of the file.
    fn refuse<T>(
        &mut self,
        code: &'static str,
        message: String,
        help: &str,
        at: Span,
    ) -> Expanded<T> {
        self.good = false;
        self.c.report(self.c.diagnostic(code, message, at).help(help));
        Err(Stop::Here)
    }

    /// Reports what is wrong with an expression in a text, unless that has been told.
    fn refuse_expression<T>(
        &mut self,
        error: Option<ExpressionError>,
        at: &Span,
        text: &str,
    ) -> Expanded<T> {
        self.good = false;
        if let Some(error) = error {
            self.c.report(self.places.expression(error, at, text));
        }
        Err(Stop::Here)
    }

    /// What expressions at a place may refer to.
    fn scope(&self, at: usize) -> Evaluated<'_> {
        let suggests = self.c.suggests();
        Evaluated { parameters: self.c.parameters(), places: &self.places, at, suggests }
    }

    fn value(&mut self, node: &Node, here: Here) -> Expanded<Node> {
        let span = here.span(&node.span);
        let size = if let Kind::Text(text) = &node.kind { text.len() / VALUE } else { 0 };
        self.spend_values(1 + size, &span)?;
        let kind = match &node.kind {
            Kind::Text(text) => Kind::Text(self.fill(text, &span)?),
            Kind::List(name, items) => Kind::List(name.clone(), self.items(items, here)?),
            Kind::Fields(Some(name), _) if name == Repetition::NAME => {
                let message = "`For` cannot stand here".to_owned();
                let help = "it is the value of an entry of a map, or an item of a list";
                return self.refuse("E0105", message, help, span);
            }
            Kind::Fields(name, entries) => {
                let one = |e: &Entry| {
                    let value = self.value(&e.value, here)?;
                    let key_span = here.span(&e.key_span);
                    Ok(Entry { key: e.key.clone(), key_span, value })
                };
                Kind::Fields(name.clone(), entries.iter().map(one).collect::<Expanded<_>>()?)
            }
            Kind::Map(entries) => Kind::Map(self.map(entries, here)?),
            Kind::Number(_) | Kind::Flag(_) | Kind::Name(_) => node.kind.clone(),
        };
        Ok(Node { span, kind })
    }

    /// Items of a list, one after the other; `For` gives many.
    fn items(&mut self, items: &[Node], here: Here) -> Expanded<Vec<Node>> {
        let mut out = Vec::with_capacity(items.len());
        for item in items {
            self.item(item, &item.span, here, &mut out)?;
        }
        Ok(out)
    }

    fn item(&mut self, item: &Node, text: &Span, here: Here, out: &mut Vec<Node>) -> Expanded<()> {
        match self.repetition(item, here)? {
            None => out.push(self.value(item, here)?),
            Some(of) => {
                self.repeat(&of, text, here, &mut |me, here| me.item(of.of, text, here, out))?;
            }
        }
        Ok(())
    }

    /// Entries of a map. What is wrong with one of them does not keep the others from being told.
    fn map(&mut self, entries: &[Entry], here: Here) -> Expanded<Vec<Entry>> {
        let mut out = Vec::with_capacity(entries.len());
        for e in entries {
            let text = e.key_span.start.min(e.value.span.start)..e.value.span.end;
            match self.entry(e, &e.value, &text, here, &mut out) {
                Err(Stop::All) => return Err(Stop::All),
                Err(Stop::Here) | Ok(()) => {}
            }
        }
        self.check_twice(&out);
        Ok(out)
    }

    fn entry(
        &mut self,
        e: &Entry,
        value: &Node,
        text: &Span,
        here: Here,
        out: &mut Vec<Entry>,
    ) -> Expanded<()> {
        match self.repetition(value, here)? {
            None => {
                let key_span = here.span(&e.key_span);
                let key = self.fill(&e.key, &key_span)?;
                let value = self.value(value, here)?;
                out.push(Entry { key, key_span, value });
            }
            Some(of) => {
                let each = &mut |me: &mut Self, here| me.entry(e, of.of, text, here, out);
                self.repeat(&of, text, here, each)?;
            }
        }
        Ok(())
    }

    /// Reports names that come twice.
    fn check_twice(&mut self, entries: &[Entry]) {
        for (e, before) in twice(entries) {
            self.good = false;
            let mut d = self
                .c
                .diagnostic("E0102", format!("`{}` is given twice", e.key), e.key_span.clone())
                .related(before.clone(), "first given here");
            if self.places.find(before).span == self.places.find(&e.key_span).span {
                d = d.help("each index belongs into the name, as in `\"n{i}.{k}\"`");
            }
            self.c.report(d);
        }
    }

    fn spend_entries(&mut self, count: usize, at: &Span) -> Expanded<()> {
        match self.entries.checked_sub(count) {
            Some(left) => self.entries = left,
            None => return self.too_much(MOST_ENTRIES, "entries", at),
        }
        Ok(())
    }

    fn spend_values(&mut self, count: usize, at: &Span) -> Expanded<()> {
        match self.values.checked_sub(count) {
            Some(left) => self.values = left,
            None => return self.too_much(MOST_VALUES, "values", at),
        }
        Ok(())
    }

    fn too_much<T>(&mut self, most: usize, what: &str, at: &Span) -> Expanded<T> {
        let message = format!("the repetitions of this model make more than {most} {what}");
        let help = "a model of that size is written by a program, not by `For`";
        let _: Expanded<()> = self.refuse("E0112", message, help, at.clone());
        Err(Stop::All)
    }
}

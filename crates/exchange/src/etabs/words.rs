//! What is asked of lines.

use super::text::{Line, Section, Token, number};
use crate::report::Report;
use crate::sap2000::{Database, Field, Row};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, HashMap};
use trilith_model::Span;

/// A file that is read, and the tables that are made of it.
pub struct File<'a> {
    pub sections: &'a [Section],
    /// Where errors go.
    pub db: &'a Database,
    pub report: RefCell<Report>,
    pub rows: RefCell<BTreeMap<String, Vec<Row>>>,
}

/// All lines of a thing.
#[derive(Clone, Debug)]
pub struct Thing<'a> {
    db: &'a Database,
    pub names: Vec<&'a str>,
    pub lines: Vec<&'a Line>,
}

impl<'a> File<'a> {
    /// Lines of a keyword in sections whose names begin with a text.
    pub fn lines(&self, section: &str, keyword: &str) -> impl Iterator<Item = &'a Line> {
        let sections = self.sections.iter().filter(move |s| s.name.starts_with(section));
        sections.flat_map(|s| &s.lines).filter(move |l| l.keyword == keyword)
    }

    /// Things with this many names behind their keyword, in the order of their first lines.
    pub fn things(&self, section: &str, keyword: &str, names: usize) -> Vec<Thing<'a>> {
        let mut out: Vec<Thing<'a>> = Vec::new();
        let mut known: HashMap<Vec<&'a str>, usize> = HashMap::new();
        for line in self.lines(section, keyword) {
            let Some(own) = self.names(line, names) else { continue };
            let at = *known.entry(own.clone()).or_insert(out.len());
            match out.get_mut(at) {
                Some(thing) => thing.lines.push(line),
                None => out.push(Thing { db: self.db, names: own, lines: vec![line] }),
            }
        }
        out
    }

    /// One line each, whatever their names.
    pub fn each(&self, section: &str, keyword: &str, names: usize) -> Vec<Thing<'a>> {
        let lines = self.lines(section, keyword);
        let one = |line: &'a Line| {
            let names = self.names(line, names)?;
            Some(Thing { db: self.db, names, lines: vec![line] })
        };
        lines.filter_map(one).collect()
    }

    fn names(&self, line: &'a Line, count: usize) -> Option<Vec<&'a str>> {
        let own: Vec<&str> = line.tokens.iter().take(count).map(Token::read).collect();
        if own.len() < count || line.tokens.iter().take(count).any(|t| !t.quoted) {
            let what = if count == 1 { "a name" } else { "two names" };
            let message = format!("{what} in quotes is wanted behind {}", line.keyword);
            self.db.wrong(&line.span, &message, "such as \"C1\"  \"Story1\"");
            return None;
        }
        Some(own)
    }

    /// Begins a row of a table; where its error is shown.
    pub fn row(&self, table: &'static str, span: &Span) -> Maker<'_> {
        Maker { rows: &self.rows, table, row: Row { fields: Vec::new(), span: span.clone() } }
    }

    /// Notes a loss.
    pub fn lose(&self, place: &str, what: &str, which: &str) {
        self.report.borrow_mut().lose(place, what, which);
    }

    /// Notes what is said otherwise.
    pub fn otherwise(&self, place: &str, what: &str, which: &str) {
        self.report.borrow_mut().otherwise(place, what, which);
    }
}

impl<'a> Thing<'a> {
    pub fn span(&self) -> &'a Span {
        &self.lines[0].span
    }

    /// The value behind a key of any of its lines.
    pub fn token(&self, key: &str) -> Option<&'a Token> {
        for line in &self.lines {
            let at = line.tokens.iter().position(|t| t.is_word() && t.text == key);
            let Some(at) = at else { continue };
            let Some(value) = line.tokens.get(at + 1) else {
                let span = &line.tokens[at].span;
                self.db.wrong(span, &format!("`{key}` has no value"), "a value follows its key");
                line.tokens[at].used.set(true);
                return None;
            };
            line.tokens[at].used.set(true);
            value.used.set(true);
            return Some(value);
        }
        None
    }

    /// The same with one of its lines alone.
    pub fn line(&self, line: &'a Line) -> Self {
        Self { lines: vec![line], ..self.clone() }
    }

    pub fn text(&self, key: &str) -> Option<&'a str> {
        self.token(key).map(|t| t.text.as_str())
    }

    /// A text that must be there; empty where it is not.
    pub fn need(&self, key: &str) -> &'a str {
        self.text(key).unwrap_or_else(|| {
            let message = format!("this {} has no `{key}`", self.lines[0].keyword);
            self.db.wrong(self.span(), &message, &format!("`{key}` and its value belong to it"));
            ""
        })
    }

    pub fn number(&self, key: &str) -> Option<f64> {
        self.token(key).and_then(|t| value(self.db, t))
    }

    pub fn or_zero(&self, key: &str) -> f64 {
        self.number(key).unwrap_or(0.0)
    }

    /// A number that must be there; 0 where it is not.
    pub fn need_number(&self, key: &str) -> f64 {
        let text = self.need(key);
        if text.is_empty() { 0.0 } else { self.or_zero(key) }
    }

    /// Yes, in any letters; none where the key is not there.
    pub fn says(&self, key: &str) -> Option<bool> {
        self.token(key).map(|t| t.text.eq_ignore_ascii_case("yes"))
    }

    /// The nth token behind the keyword.
    pub fn at(&self, n: usize) -> Option<&'a Token> {
        self.lines[0].tokens.get(n).inspect(|t| t.used.set(true))
    }

    /// A number behind the names.
    pub fn number_at(&self, n: usize) -> Option<f64> {
        self.at(n).and_then(|t| value(self.db, t))
    }

    /// Takes all for asked.
    pub fn idle(&self) {
        self.lines.iter().flat_map(|l| &l.tokens).for_each(|t| t.used.set(true));
    }

    pub fn wrong(&self, message: &str, help: &str) {
        self.db.wrong(self.span(), message, help);
    }

    /// Notes an error of the value behind a key.
    pub fn wrong_at(&self, key: &str, message: &str, help: &str) {
        let span = self.token(key).map_or(self.span(), |t| &t.span);
        self.db.wrong(span, message, help);
    }
}

/// A finite number.
pub fn value(db: &Database, token: &Token) -> Option<f64> {
    let found = number(&token.text).filter(|x| x.is_finite());
    if found.is_none() {
        let message = format!("`{}` is no number", token.text);
        db.wrong(&token.span, &message, "a number such as 2.5 or 1E-05");
    }
    found
}

/// A row in the making.
pub struct Maker<'f> {
    rows: &'f RefCell<BTreeMap<String, Vec<Row>>>,
    table: &'static str,
    row: Row,
}

impl Maker<'_> {
    /// With a field.
    pub fn with(mut self, key: &str, value: impl Told) -> Self {
        let (value, span) = (value.told(), self.row.span.clone());
        let field = Field { key: key.into(), value, span, used: Cell::new(false) };
        self.row.fields.push(field);
        self
    }

    /// With a field where there is a value.
    pub fn maybe(self, key: &str, value: Option<impl Told>) -> Self {
        match value {
            Some(value) => self.with(key, value),
            None => self,
        }
    }

    /// With fields where the thing has their keys: ours and theirs.
    pub fn from(mut self, thing: &Thing<'_>, keys: &[(&str, &str)]) -> Self {
        for (ours, theirs) in keys {
            if let Some(token) = thing.token(theirs) {
                let value = number(&token.text).map_or(token.text.clone(), |x| x.told());
                let field = Field {
                    key: (*ours).into(),
                    value,
                    span: token.span.clone(),
                    used: Cell::new(false),
                };
                self.row.fields.push(field);
            }
        }
        self
    }

    /// Puts the row into its table.
    pub fn put(self) {
        self.rows.borrow_mut().entry(self.table.into()).or_default().push(self.row);
    }
}

/// What may stand in a field.
pub trait Told {
    fn told(&self) -> String;
}

impl Told for f64 {
    fn told(&self) -> String {
        crate::ron::number(*self)
    }
}

impl Told for bool {
    fn told(&self) -> String {
        if *self { "Yes".into() } else { "No".into() }
    }
}

impl Told for &str {
    fn told(&self) -> String {
        (*self).into()
    }
}

impl Told for &String {
    fn told(&self) -> String {
        (*self).clone()
    }
}

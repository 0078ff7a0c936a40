//! The text of a SAP2000 model: tables of rows of `Key=Value`.
//!
//! ```text
//! TABLE:  "JOINT COORDINATES"
//!    Joint=1   CoordSys=GLOBAL   XorR=0   Y=0 _
//!         Z=2.5
//!
//! END TABLE DATA
//! ```
//!
//! Values with blanks stand in double quotes; ` _` at the end of a line continues it.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::sync::Arc;
use trilith_model::{Diagnostic, Source, Span};

/// Most errors that are collected.
const MOST: usize = 1000;

/// A field of a row.
#[derive(Debug)]
pub struct Field {
    pub key: String,
    pub value: String,
    pub span: Span,
    /// Somebody has asked for it.
    pub used: Cell<bool>,
}

/// A row of a table.
#[derive(Debug)]
pub struct Row {
    pub fields: Vec<Field>,
    pub span: Span,
}

/// The tables of a file by name, and what is wrong with it.
#[derive(Debug)]
pub struct Database {
    pub source: Arc<Source>,
    pub tables: BTreeMap<String, Vec<Row>>,
    problems: RefCell<Vec<Diagnostic>>,
}

/// A row with the file it stands in.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    pub db: &'a Database,
    pub row: &'a Row,
}

impl Database {
    /// Reads the tables of a text.
    pub fn new(source: &Arc<Source>) -> Self {
        let mut db = Self::bare(source);
        db.scan();
        db
    }

    /// Tables that were made of a text of another kind, with what is wrong with it so far.
    pub fn made(bare: Self, tables: BTreeMap<String, Vec<Row>>) -> Self {
        Self { tables, ..bare }
    }

    /// No tables: where errors of a text of another kind go.
    pub fn bare(source: &Arc<Source>) -> Self {
        let problems = RefCell::default();
        Self { source: Arc::clone(source), tables: BTreeMap::new(), problems }
    }

    fn scan(&mut self) {
        let source = Arc::clone(&self.source);
        let (mut table, mut ended, mut open) = (None::<String>, false, None::<Row>);
        let mut start = 0;
        for (number, line) in source.text.split_inclusive('\n').enumerate() {
            let (at, end) = (start, start + line.trim_end().len());
            start += line.len();
            let text = line.trim();
            let left = at + (line.len() - line.trim_start().len());
            let span = left.min(end)..end;
            if text.is_empty() {
                continue;
            }
            if ended {
                self.wrong(&span, "there is something behind END TABLE DATA", "take it out");
                return;
            }
            if let Some(name) = text.strip_prefix("TABLE:") {
                self.close(&mut table, &mut open);
                let name = name.trim();
                match name.strip_prefix('"').and_then(|n| n.strip_suffix('"')) {
                    Some(name) if !name.is_empty() => {
                        let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
                        self.tables.entry(name.clone()).or_default();
                        table = Some(name);
                    }
                    _ => self.wrong(&span, "a table without a name", "TABLE:  \"NAME\""),
                }
            } else if text == "END TABLE DATA" {
                self.close(&mut table, &mut open);
                ended = true;
            } else if table.is_some() {
                let mut row = open.take().unwrap_or(Row { fields: Vec::new(), span: span.clone() });
                let more = self.fields(&source.text, span.clone(), &mut row.fields);
                row.span.end = span.end;
                open = Some(row);
                if !more {
                    self.take(&table, &mut open);
                }
            } else if text.starts_with('$') {
                let help = "its name ends in .e2k or .$et; SAP2000 writes .s2k with File > Export";
                self.wrong(&span, "this is a text file of ETABS", help);
                return;
            } else if number > 0 || text.contains('=') {
                let help = "a text model begins with the line TABLE:  \"NAME\"";
                self.wrong(&span, "this line stands in no table", help);
                return;
            }
        }
        if !ended {
            let end = self.source.text.trim_end().len();
            let last = self.source.text[..end].char_indices().next_back().map_or(0, |(i, _)| i);
            let help = "the file was cut: export it again";
            self.wrong(&(last..end), "the file ends without the line END TABLE DATA", help);
        }
    }

    /// A row that is still open where its table ends goes on nowhere.
    fn close(&mut self, table: &mut Option<String>, open: &mut Option<Row>) {
        if let Some(row) = open.take() {
            let last = row.span.end.saturating_sub(1)..row.span.end;
            self.wrong(&last, "the line that this one continues with is missing", "take ` _` out");
        }
        *table = None;
    }

    fn take(&mut self, table: &Option<String>, open: &mut Option<Row>) {
        if let (Some(name), Some(row)) = (table, open.take()) {
            self.tables.entry(name.clone()).or_default().push(row);
        }
    }

    /// Reads the fields of a line; true where it is continued.
    fn fields(&self, text: &str, line: Span, into: &mut Vec<Field>) -> bool {
        let mut at = line.start;
        loop {
            let rest = &text[at..line.end];
            at += rest.len() - rest.trim_start().len();
            let rest = &text[at..line.end];
            if rest.is_empty() {
                return false;
            }
            if rest == "_" {
                return true;
            }
            let stop = rest.find(|c: char| c == '=' || c.is_whitespace()).unwrap_or(rest.len());
            if !rest[stop..].starts_with('=') || stop == 0 {
                let span = at..at + stop.max(1).min(rest.len());
                self.wrong(&clip(text, span), "a key without a value", "Key=Value");
                return false;
            }
            let (key, behind) = (&rest[..stop], &rest[stop + 1..]);
            let (value, length) = match value(behind) {
                Ok(found) => found,
                Err(message) => {
                    let help = "Key=Value, with double quotes around a value with blanks";
                    self.wrong(&(at..line.end), message, help);
                    return false;
                }
            };
            let span = at..at + stop + 1 + length;
            at = span.end;
            if into.iter().any(|f| f.key == key) {
                self.wrong(&span, &format!("`{key}` stands twice in this row"), "keep one");
                return false;
            }
            into.push(Field { key: key.into(), value, span, used: Cell::new(false) });
        }
    }

    /// Notes an error.
    pub fn wrong(&self, span: &Span, message: &str, help: &str) {
        let mut problems = self.problems.borrow_mut();
        if problems.len() < MOST {
            let error = Diagnostic::new("E1001", message, span.clone(), &self.source);
            problems.push(if help.is_empty() { error } else { error.help(help) });
        }
    }

    /// All errors so far.
    pub fn problems(&self) -> Vec<Diagnostic> {
        self.problems.borrow().clone()
    }

    /// The rows of a table; none where it is not in the file.
    pub fn rows<'a>(&'a self, table: &str) -> impl Iterator<Item = Entry<'a>> + use<'a> {
        let rows = self.tables.get(table).map_or(&[][..], |rows| rows);
        rows.iter().map(move |row| Entry { db: self, row })
    }
}

/// A value and its length in the file.
fn value(behind: &str) -> Result<(String, usize), &'static str> {
    let Some(inside) = behind.strip_prefix('"') else {
        let length = behind.find(char::is_whitespace).unwrap_or(behind.len());
        return if length == 0 {
            Err("a key without a value")
        } else {
            Ok((behind[..length].into(), length))
        };
    };
    let (mut value, mut from) = (String::new(), 0);
    loop {
        let Some(end) = inside[from..].find('"') else { return Err("quotes that do not end") };
        value.push_str(&inside[from..from + end]);
        from += end + 1;
        if !inside[from..].starts_with('"') {
            return Ok((value, from + 1));
        }
        // Two quotes inside a text are one of it.
        value.push('"');
        from += 1;
    }
}

fn clip(text: &str, span: Span) -> Span {
    let mut end = span.end;
    while !text.is_char_boundary(end) {
        end += 1;
    }
    span.start..end
}

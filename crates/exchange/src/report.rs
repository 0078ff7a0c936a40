//! What became of every table and field of a file.

use std::fmt::Write;

/// What became of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fate {
    /// Read into the model.
    Read,
    /// Left out knowingly: why that changes nothing.
    Ignored(String),
    /// Left out although it carries the model.
    Lost(String),
}

/// What a report counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Things {
    /// Tables and their fields.
    #[default]
    Tables,
    /// Sections and their fields.
    Sections,
    /// Commands and their arguments.
    Commands,
}

impl Things {
    /// Their name, and that of their parts.
    fn names(self) -> [&'static str; 2] {
        match self {
            Self::Tables => ["tables", "fields"],
            Self::Sections => ["sections", "fields"],
            Self::Commands => ["commands", "arguments"],
        }
    }
}

/// A table of the file, or a command of a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableReport {
    /// Its name.
    pub name: String,
    /// Its rows.
    pub rows: usize,
    /// What became of it.
    pub fate: Fate,
}

/// Something that happened to what was read, and how often.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Where it stood: table, or table and field.
    pub place: String,
    /// What happened.
    pub what: String,
    /// Rows or things that it happened to, by their names; the first ones.
    pub which: Vec<String>,
    /// How many there were.
    pub count: usize,
}

/// Names that a note shows.
const SHOWN: usize = 8;

/// The loss report.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// A line on the file.
    pub file: String,
    /// What the file is made of.
    pub things: Things,
    /// What was written, by kind and number.
    pub written: Vec<(String, usize)>,
    /// Tables, in their order.
    pub tables: Vec<TableReport>,
    /// Losses that change results.
    pub lost: Vec<Note>,
    /// What is said otherwise, with the same meaning or nearly so.
    pub otherwise: Vec<Note>,
    /// Fields of tables that were read, left out knowingly.
    pub ignored: Vec<Note>,
}

impl Report {
    /// Notes a loss.
    pub fn lose(&mut self, place: &str, what: &str, which: &str) {
        add(&mut self.lost, place, what, which);
    }

    /// Notes what is said otherwise.
    pub fn otherwise(&mut self, place: &str, what: &str, which: &str) {
        add(&mut self.otherwise, place, what, which);
    }

    /// Notes a field that is left out knowingly.
    pub fn ignore(&mut self, place: &str, what: &str) {
        add(&mut self.ignored, place, what, "");
    }

    /// Tables that are lost, and notes of losses.
    #[must_use]
    pub fn losses(&self) -> usize {
        let tables = self.tables.iter().filter(|t| matches!(t.fate, Fate::Lost(_)));
        tables.count() + self.lost.len()
    }

    /// The report as text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = format!("{}\n\nwritten:", self.file);
        for (i, (what, count)) in self.written.iter().enumerate() {
            let _ = write!(out, "{} {count} {what}", if i == 0 { "" } else { "," });
        }
        let by = |wanted: fn(&Fate) -> bool| self.tables.iter().filter(move |t| wanted(&t.fate));
        let read = by(|f| *f == Fate::Read).count();
        let ignored = by(|f| matches!(f, Fate::Ignored(_))).count();
        let lost = by(|f| matches!(f, Fate::Lost(_))).count();
        let all = self.tables.len();
        let [things, parts] = self.things.names();
        let _ = writeln!(
            out,
            "\n{things}: {all}; {read} read, {ignored} ignored knowingly, {lost} lost\n"
        );
        let rows = by(|f| matches!(f, Fate::Lost(_))).map(|t| {
            let Fate::Lost(what) = &t.fate else { return Vec::new() };
            vec![t.name.clone(), t.rows.to_string(), what.clone()]
        });
        let notes = self.lost.iter().map(line);
        section(&mut out, "LOST: this changes results", rows.chain(notes).collect());
        section(&mut out, "said otherwise", self.otherwise.iter().map(line).collect());
        let rows = by(|f| *f == Fate::Read).map(|t| vec![t.name.clone(), t.rows.to_string()]);
        section(&mut out, &format!("{things} read"), rows.collect());
        section(
            &mut out,
            &format!("{parts} left out of {things} read"),
            self.ignored.iter().map(line).collect(),
        );
        let rows = by(|f| matches!(f, Fate::Ignored(_))).map(|t| {
            let Fate::Ignored(why) = &t.fate else { return Vec::new() };
            vec![t.name.clone(), t.rows.to_string(), why.clone()]
        });
        section(&mut out, &format!("{things} ignored knowingly"), rows.collect());
        while out.ends_with("\n\n") {
            out.pop();
        }
        out
    }
}

fn add(notes: &mut Vec<Note>, place: &str, what: &str, which: &str) {
    let at = notes.iter().position(|n| n.place == place && n.what == what);
    let note = match at {
        Some(at) => &mut notes[at],
        None => {
            let (place, what) = (place.into(), what.into());
            notes.push(Note { place, what, which: Vec::new(), count: 0 });
            notes.last_mut().expect("it was pushed just now")
        }
    };
    note.count += 1;
    if !which.is_empty() && note.which.len() < SHOWN && !note.which.iter().any(|w| w == which) {
        note.which.push(which.into());
    }
}

fn line(note: &Note) -> Vec<String> {
    let more = if note.count > note.which.len() { ", …" } else { "" };
    let which = match note.which.as_slice() {
        [] => String::new(),
        which => format!(" ({}{more})", which.join(", ")),
    };
    vec![note.place.clone(), note.count.to_string(), format!("{}{which}", note.what)]
}

fn section(out: &mut String, head: &str, rows: Vec<Vec<String>>) {
    if rows.is_empty() {
        return;
    }
    let width = |c: usize| rows.iter().filter_map(|r| r.get(c)).map(|s| s.chars().count()).max();
    let (first, second) = (width(0).unwrap_or(0), width(1).unwrap_or(0));
    let _ = writeln!(out, "{head}");
    for row in &rows {
        let cell = |c: usize| row.get(c).map_or("", |s| s.as_str());
        let space = " ".repeat(first.saturating_sub(cell(0).chars().count()));
        let line = format!("  {}{space}  {:>second$}  {}", cell(0), cell(1), cell(2));
        let _ = writeln!(out, "{}", line.trim_end());
    }
    out.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_note_is_counted_and_a_lost_table_is_a_loss() {
        let mut report = Report { file: "f".into(), ..Report::default() };
        for name in ["a", "b", "b"] {
            report.lose("T", "gone", name);
        }
        let fate = Fate::Lost("carries the model".into());
        report.tables.push(TableReport { name: "X".into(), rows: 3, fate });
        assert_eq!((report.losses(), report.lost[0].count), (2, 3));
        let text = report.text();
        assert!(text.contains("  T  3  gone (a, b, …)\n"), "{text}");
        assert!(text.contains("tables: 1; 0 read, 0 ignored knowingly, 1 lost"), "{text}");
    }
}

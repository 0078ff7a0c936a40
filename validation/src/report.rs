//! The verdict as a table, as `report.json`, as `REPORT.md` and as `report.html`.

use crate::{Outcome, Row};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// A line of the table: one quantity under all solvers of its case.
pub(crate) struct Line<'a> {
    rows: Vec<&'a Row>,
}

impl Line<'_> {
    fn first(&self) -> &Row {
        self.rows[0]
    }

    fn value(&self, solver: &str) -> String {
        let row = self.rows.iter().find(|r| r.solver == solver);
        match row.map(|r| r.value) {
            None => "–".into(),
            Some(None) => "none".into(),
            Some(Some(x)) => number(x),
        }
    }

    fn worst(&self) -> Option<f64> {
        let all: Option<Vec<f64>> = self.rows.iter().map(|r| r.error.map(f64::abs)).collect();
        all.map(|e| e.into_iter().fold(0.0, f64::max))
    }

    fn pass(&self) -> bool {
        self.rows.iter().all(|r| r.pass)
    }

    pub(crate) fn cells(&self) -> [String; 9] {
        let r = self.first();
        let quantity = if r.unit.is_empty() {
            r.quantity.clone()
        } else {
            format!("{} [{}]", r.quantity, r.unit)
        };
        // What is neither FNA nor HHT stands in the first of the two columns, with its name.
        let fna = match r.solver.as_str() {
            "fna" | "hht" => self.value("fna"),
            "modes" => self.value("modes"),
            other => format!("{} ({other})", self.value(other)),
        };
        let share = |x: f64| match r.measure.as_str() {
            "relative" => format!("{} %", short(100.0 * x)),
            "absolute" => short(x),
            bound => bound.to_owned(),
        };
        [
            r.id.clone(),
            quantity,
            number(r.reference),
            r.kind.clone(),
            fna,
            self.value("hht"),
            self.worst().map_or("none".into(), |e| if e == 0.0 { "0".into() } else { share(e) }),
            share(r.tolerance),
            if self.pass() { "pass" } else { "FAIL" }.into(),
        ]
    }
}

pub(crate) const HEADER: [&str; 9] =
    ["case", "quantity", "reference", "kind", "FNA", "HHT", "error", "tolerance", "verdict"];

/// Three digits, without a power of ten where it reads well.
fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let digits = 2 - x.abs().log10().floor() as i32;
    if !(0..=5).contains(&digits) {
        return format!("{x:.2e}");
    }
    let text = format!("{x:.*}", digits as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

fn number(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let digits = 6 - x.abs().log10().floor() as i32;
    if (0..=10).contains(&digits) {
        format!("{x:.*}", digits.max(0) as usize)
    } else {
        format!("{x:.6e}")
    }
}

pub(crate) fn lines(rows: &[Row]) -> Vec<Line<'_>> {
    let mut all: Vec<Line<'_>> = Vec::new();
    for row in rows {
        let same = |l: &&mut Line<'_>| l.first().id == row.id && l.first().quantity == row.quantity;
        match all.iter_mut().find(same) {
            Some(line) => line.rows.push(row),
            None => all.push(Line { rows: vec![row] }),
        }
    }
    all
}

/// How many cases and comparisons there are and how many of them fail.
pub(crate) fn totals(outcomes: &[Outcome]) -> String {
    let bad: Vec<&str> = outcomes.iter().filter(|o| o.fails()).map(|o| o.id).collect();
    let rows = || outcomes.iter().flat_map(|o| &o.rows);
    let mut out = format!(
        "{} cases and studies, {} comparisons: {} pass, {} fail ({} comparisons)",
        outcomes.len(),
        rows().count(),
        outcomes.iter().filter(|o| o.pass()).count(),
        bad.len(),
        rows().filter(|r| !r.pass).count(),
    );
    if !bad.is_empty() {
        let _ = write!(out, ": {}", bad.join(", "));
    }
    let missing: Vec<&str> =
        outcomes.iter().filter(|o| o.unavailable.is_some()).map(|o| o.id).collect();
    if !missing.is_empty() {
        let _ = write!(out, "; {} not run: {}", missing.len(), missing.join(", "));
    }
    out
}

pub(crate) fn notes(rows: &[Row]) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for r in rows {
        if let Some(note) = &r.note {
            let text = format!("{} ({}): {note}", r.id, r.solver);
            if !all.contains(&text) {
                all.push(text);
            }
        }
    }
    all
}

/// The table for the terminal, with a last line that sums up.
#[must_use]
pub fn text(outcomes: &[Outcome]) -> String {
    let mut table: Vec<[String; 9]> = vec![HEADER.map(str::to_owned)];
    table.extend(outcomes.iter().flat_map(|o| lines(&o.rows)).map(|l| l.cells()));
    let width =
        |c: usize| table.iter().map(|r: &[String; 9]| r[c].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..9).map(width).collect();
    let mut out = String::new();
    for row in &table {
        for (cell, w) in row.iter().zip(&widths) {
            let _ = write!(out, "{cell}{}  ", " ".repeat(w - cell.chars().count()));
        }
        out.truncate(out.trim_end().len());
        out.push('\n');
    }
    out.push('\n');
    for note in outcomes.iter().flat_map(|o| notes(&o.rows)) {
        let _ = writeln!(out, "note: {note}");
    }
    for o in outcomes {
        if let Some(reason) = &o.unavailable {
            let _ = writeln!(out, "not run: {} ({}): {reason}", o.id, o.title);
        }
    }
    out + &totals(outcomes) + "\n"
}

/// The report as Markdown.
#[must_use]
pub fn markdown(outcomes: &[Outcome]) -> String {
    let mut out = format!(
        "# Validation of Trilith\n\n{}.\n\nThe error is the larger one of the solvers; `%`: of the \
         reference, otherwise in the unit of the quantity. Frequencies stand under FNA: they are those \
         of its basis. The figures are in `report.html`.\n",
        totals(outcomes)
    );
    for o in outcomes {
        let _ = write!(out, "\n## {} {}\n\nSource: {}\n\n", o.id, o.title, o.source);
        for text in &o.text {
            let _ = write!(out, "{text}\n\n");
        }
        if o.unavailable.is_some() {
            continue;
        }
        for table in &o.tables {
            let columns = table.head.len();
            let _ = writeln!(out, "| {} |\n|{}", table.head.join(" | "), "---|".repeat(columns));
            for row in &table.rows {
                let _ = writeln!(out, "| {} |", row.join(" | "));
            }
            out.push('\n');
        }
        let _ = writeln!(out, "| {} |\n|{}", HEADER[1..].join(" | "), "---|".repeat(8));
        for line in lines(&o.rows) {
            let _ = writeln!(out, "| {} |", line.cells()[1..].join(" | "));
        }
        for note in notes(&o.rows) {
            let _ = writeln!(out, "\nNote: {note}");
        }
    }
    out
}

/// The folder of reports: `validation` in Cargo's target folder.
#[must_use]
pub fn folder() -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    target.join("validation")
}

/// Writes `report.json`, `REPORT.md` and `report.html`.
///
/// # Errors
/// Where a file cannot be written.
pub fn write(folder: &Path, outcomes: &[Outcome]) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let rows: Vec<&Row> = outcomes.iter().flat_map(|o| &o.rows).collect();
    let json = serde_json::to_string_pretty(&rows).map_err(std::io::Error::other)?;
    std::fs::write(folder.join("report.json"), json)?;
    std::fs::write(folder.join("REPORT.md"), markdown(outcomes))?;
    std::fs::write(folder.join("report.html"), crate::page::html(outcomes))
}

//! The verdict as a table, as `report.json` and as `REPORT.md`.

use crate::{Case, Row};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// A line of the table: one quantity under all solvers of its case.
struct Line<'a> {
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

    fn cells(&self) -> [String; 9] {
        let r = self.first();
        let quantity = if r.unit.is_empty() {
            r.quantity.clone()
        } else {
            format!("{} [{}]", r.quantity, r.unit)
        };
        let fna = if r.solver == "modes" { self.value("modes") } else { self.value("fna") };
        let share = |x: f64| {
            if r.measure == "relative" {
                format!("{:.2e} %", 100.0 * x)
            } else {
                format!("{x:.2e}")
            }
        };
        [
            r.id.clone(),
            quantity,
            number(r.reference),
            r.kind.clone(),
            fna,
            self.value("hht"),
            self.worst().map_or("none".into(), share),
            share(r.tolerance),
            if self.pass() { "pass" } else { "FAIL" }.into(),
        ]
    }
}

const HEADER: [&str; 9] =
    ["case", "quantity", "reference", "kind", "FNA", "HHT", "error", "tolerance", "verdict"];

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

fn lines(rows: &[Row]) -> Vec<Line<'_>> {
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
fn totals(cases: &[Case], rows: &[Row]) -> String {
    let bad: Vec<&str> = cases
        .iter()
        .filter(|c| rows.iter().any(|r| r.id == c.id && !r.pass))
        .map(|c| c.id)
        .collect();
    let failed = rows.iter().filter(|r| !r.pass).count();
    let mut out = format!(
        "{} cases, {} comparisons: {} cases pass, {} fail ({failed} comparisons)",
        cases.len(),
        rows.len(),
        cases.len() - bad.len(),
        bad.len(),
    );
    if !bad.is_empty() {
        let _ = write!(out, ": {}", bad.join(", "));
    }
    out
}

fn notes(rows: &[Row]) -> Vec<String> {
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
pub fn text(cases: &[Case], rows: &[Row]) -> String {
    let mut table: Vec<[String; 9]> = vec![HEADER.map(str::to_owned)];
    table.extend(lines(rows).iter().map(Line::cells));
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
    for note in notes(rows) {
        let _ = writeln!(out, "note: {note}");
    }
    out + &totals(cases, rows) + "\n"
}

/// The report as Markdown.
#[must_use]
pub fn markdown(cases: &[Case], rows: &[Row]) -> String {
    let mut out = format!(
        "# Validation of Trilith\n\n{}.\n\nThe error is the larger one of the solvers; `%`: of the \
         reference, otherwise in the unit of the quantity. Frequencies stand under FNA: they are those \
         of its basis.\n",
        totals(cases, rows)
    );
    let lines = lines(rows);
    for case in cases {
        let _ = write!(out, "\n## {} {}\n\nSource: {}\n\n", case.id, case.title, case.source);
        let _ = writeln!(out, "| {} |\n|{}", HEADER[1..].join(" | "), "---|".repeat(8));
        for line in lines.iter().filter(|l| l.first().id == case.id) {
            let _ = writeln!(out, "| {} |", line.cells()[1..].join(" | "));
        }
    }
    let notes = notes(rows);
    if !notes.is_empty() {
        let _ = write!(out, "\n## Notes\n\n");
        for note in notes {
            let _ = writeln!(out, "- {note}");
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

/// Writes `report.json` and `REPORT.md`.
///
/// # Errors
/// Where a file cannot be written.
pub fn write(folder: &Path, cases: &[Case], rows: &[Row]) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let json = serde_json::to_string_pretty(rows).map_err(std::io::Error::other)?;
    std::fs::write(folder.join("report.json"), json)?;
    std::fs::write(folder.join("REPORT.md"), markdown(cases, rows))
}

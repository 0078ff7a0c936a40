//! `study.html`.

mod runs;
mod statistics;

use crate::{Row, Study, figure};
use std::path::{Component, Path, PathBuf};
use trilith::report::{Block, Charts, Page, Section};

/// Rows that a table of a page shows.
const ROWS: usize = 40;

pub(crate) fn page(study: &Study, runs: &[Row<'_>], left_out: usize) -> String {
    let title = if study.title.is_empty() { "Study" } else { &study.title };
    let failed = runs.iter().filter(|r| !r.good()).count();
    let warned = runs.iter().filter(|r| !r.warnings().is_empty()).count();
    let told = match warned {
        0 => String::new(),
        n => format!(" {n} of them warned of something."),
    };
    let out = match left_out {
        0 => String::new(),
        n => format!(" {n} more lie beyond the first run of their series that met the limit."),
    };
    let mut page = Page::new(title)
        .lead(Block::text(format!(
            "{} runs of `{}` ({}), {failed} of them failed.{told}{out}",
            runs.len(),
            plain(&study.model_path).display(),
            study.model_title
        )))
        .lead(outcomes(runs));
    if !study.figures.is_empty() {
        page = page.entries(runs::entries(study, runs)).lead(Block::note(
            "Point at a run in a figure for its parameters and results; click it to keep them, with the folder of its \
             histories or the command that makes it again.",
        ));
    }
    for number in 0..study.figures.len() {
        page = page.section(figure::section(study, runs, number));
    }
    if study.has_groups() {
        page = page.section(statistics::section(study, runs));
    }
    if failed > 0 {
        let bad = runs.iter().copied().filter(|r| !r.good());
        page = page.section(Section::new("failed", "Runs that failed").block(list(study, bad)));
    }
    if warned > 0 {
        let all = runs.iter().copied().filter(|r| !r.warnings().is_empty());
        page = page.section(warnings(runs).block(list(study, all)));
    }
    if let Ok(text) = trilith::record::file::read_text(&study.path) {
        page = page.section(Section::new("file", "The study").block(Block::code(text)));
    }
    page.html()
}

/// The figures of a study for a page that computes the run where their cursor is.
#[must_use]
pub fn charts(study: &Study, runs: &[Row<'_>]) -> Charts {
    let figures: Vec<_> = figure::figures(study, runs).into_iter().map(|f| f.1).collect();
    Charts::new(&figures, &runs::entries(study, runs))
}

/// A path without the way up and down again: `models/studies/../block.ron` is `models/block.ron`.
fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        let last = out.components().next_back();
        match part {
            Component::ParentDir if matches!(last, Some(Component::Normal(_))) => {
                out.pop();
            }
            Component::CurDir => {}
            _ => out.push(part),
        }
    }
    out
}

/// How many runs ended how.
fn outcomes(runs: &[Row<'_>]) -> Block {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for r in runs {
        match counts.iter_mut().find(|c| c.0 == r.status()) {
            Some(c) => c.1 += 1,
            None => counts.push((r.status(), 1)),
        }
    }
    let share = |n: usize| format!("{:.1} %", 100.0 * n as f64 / runs.len().max(1) as f64);
    let rows = counts.iter().map(|(s, n)| vec![(*s).to_owned(), n.to_string(), share(*n)]);
    Block::Table {
        head: ["status", "runs", "share"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

/// What was warned of, each with the number of runs; numbers that differ make no other warning.
fn warnings(runs: &[Row<'_>]) -> Section {
    let mut counts: Vec<(String, &str, usize)> = Vec::new();
    for text in runs.iter().flat_map(|r| r.warnings()) {
        let kind: String = text.chars().filter(|c| !"0123456789.-+e".contains(*c)).collect();
        match counts.iter_mut().find(|c| c.0 == kind) {
            Some(c) => c.2 += 1,
            None => counts.push((kind, text, 1)),
        }
    }
    let rows = counts.iter().take(ROWS).map(|(_, text, n)| vec![n.to_string(), (*text).to_owned()]);
    let head = ["runs", "warning, or the first of several that differ in numbers"];
    let table = Block::Table { head: head.map(str::to_owned).to_vec(), rows: rows.collect() };
    Section::new("warnings", "Runs that warned of something").block(table)
}

/// Runs with their parameters, status and what they told.
fn list<'a>(study: &Study, runs: impl Iterator<Item = Row<'a>>) -> Block {
    let mut head = vec!["run".to_owned()];
    head.extend(study.varied.iter().cloned());
    head.extend(["status".to_owned(), "message".to_owned()]);
    let cell = |c| match c {
        crate::Cell::Number(x) => x.to_string(),
        crate::Cell::Text(t) => t,
        crate::Cell::Nothing => "–".into(),
    };
    let rows = runs.take(ROWS).map(|r| {
        let mut cells = vec![(r.run() + 1).to_string()];
        cells.extend(r.parameters().map(cell));
        cells.extend([r.status().to_owned(), r.told()]);
        cells
    });
    Block::Table { head, rows: rows.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_shown_without_detours() {
        for (path, shown) in [
            ("models/studies/../block.ron", "models/block.ron"),
            ("./studies/../a/../../block.ron", "../block.ron"),
            ("../block.ron", "../block.ron"),
            ("../../a/./b.ron", "../../a/b.ron"),
            ("/models/studies/../block.ron", "/models/block.ron"),
        ] {
            assert_eq!(plain(Path::new(path)), Path::new(shown));
        }
    }
}

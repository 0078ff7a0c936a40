//! `study.html`.

use crate::{Record, Study, figure};
use std::path::{Component, Path, PathBuf};
use trilith::report::{Block, Page, Section};

/// Rows that a table of a page shows.
const ROWS: usize = 40;

pub(crate) fn page(study: &Study, records: &[Record], left_out: usize) -> String {
    let title = if study.title.is_empty() { "Study" } else { &study.title };
    let failed = records.iter().filter(|r| !r.good).count();
    let out = match left_out {
        0 => String::new(),
        n => format!(" {n} more lie beyond the first run of their series that met the limit."),
    };
    let mut page = Page::new(title)
        .lead(Block::text(format!(
            "{} runs of `{}` ({}), {failed} of them failed.{out}",
            records.len(),
            plain(&study.model_path).display(),
            study.model_title
        )))
        .lead(outcomes(records));
    for number in 0..study.figures.len() {
        page = page.section(figure::section(study, records, number));
    }
    if study.has_groups() {
        page = page.section(statistics(study, records));
    }
    if failed > 0 {
        page = page.section(failures(study, records));
    }
    if let Ok(text) = std::fs::read_to_string(&study.path) {
        page = page.section(Section::new("file", "The study").block(Block::code(text)));
    }
    page.html()
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
fn outcomes(records: &[Record]) -> Block {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for r in records {
        match counts.iter_mut().find(|c| c.0 == r.status) {
            Some(c) => c.1 += 1,
            None => counts.push((&r.status, 1)),
        }
    }
    let share = |n: usize| format!("{:.1} %", 100.0 * n as f64 / records.len().max(1) as f64);
    let rows = counts.iter().map(|(s, n)| vec![(*s).to_owned(), n.to_string(), share(*n)]);
    Block::Table {
        head: ["status", "runs", "share"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

fn statistics(study: &Study, records: &[Record]) -> Section {
    let groups = study.groups(records);
    let counted = study.counted(records);
    let axes: Vec<usize> = (0..study.plan.axes.len()).filter(|i| !study.over.contains(i)).collect();
    let mut head: Vec<String> = axes.iter().map(|i| study.plan.axes[*i].name.clone()).collect();
    head.push("runs".into());
    for c in study.columns.iter().take(4) {
        head.push(study.label(&c.name) + ", median");
        head.push("16 % … 84 %".into());
    }
    head.extend(counted.iter().map(|(name, _)| format!("P({name}), 90 % interval")));
    let ensemble = study.plan.ensemble.is_some();
    if ensemble {
        head.push("scatter over that of the parameters".into());
        head.push("sensitive".into());
    }
    let number = |x: f64| format!("{x:.4}");
    let row =
        |g: &crate::statistics::Group<'_>| {
            let mut cells: Vec<String> =
                axes.iter().map(|i| study.plan.axes[*i].values[g.place.axes[*i]].clone()).collect();
            cells.push(g.records.len().to_string());
            for i in 0..study.columns.len().min(4) {
                match study.spread(g, i) {
                    Some(s) => {
                        cells.push(number(s.median));
                        cells.push(format!("{} … {}", number(s.low), number(s.high)));
                    }
                    None => cells.extend(["–".to_owned(), "–".to_owned()]),
                }
            }
            for (_, condition) in &counted {
                cells.push(study.share(g, condition).map_or("–".into(), |[p, low, high]| {
                    format!("{p:.3} ({low:.3} … {high:.3})")
                }));
            }
            if ensemble {
                let s = study.sensitivity(g);
                cells.push(s.map_or("–".into(), |s| format!("{:.1}", s.amplification)));
                cells.push(s.map_or("–".into(), |s| {
                    match (s.divided, s.sensitive) {
                        (true, _) => "yes: some overturn, some do not",
                        (false, true) => "yes",
                        _ => "no",
                    }
                    .to_owned()
                }));
            }
            cells
        };
    let rows: Vec<_> = groups.iter().take(ROWS).map(row).collect();
    let mut section = Section::new("statistics", "Statistics").block(Block::Table { head, rows });
    if ensemble {
        let all = groups.iter().filter_map(|g| study.sensitivity(g));
        let sensitive = all.filter(|s| s.sensitive).count();
        section = section.block(Block::text(format!(
            "{sensitive} of {} points are sensitive: their members part over overturning, or half the band of \
             16 % to 84 % of an output, over its median, is more than {} times the scatter of the parameters. \
             There a single run says little.",
            groups.len(),
            study.sensitive_above
        )));
    }
    let more = if groups.len() > ROWS {
        format!("The first {ROWS} of {} points. ", groups.len())
    } else {
        String::new()
    };
    section.block(Block::note(format!(
        "{more}All points and columns are in `statistics.csv`. Quantiles: type 7; intervals of probabilities: Wilson."
    )))
}

fn failures(study: &Study, records: &[Record]) -> Section {
    let mut head = vec!["run".to_owned()];
    head.extend(study.varied.iter().cloned());
    head.extend(["status".to_owned(), "message".to_owned()]);
    let cell = |c: &crate::Cell| match c {
        crate::Cell::Number(x) => x.to_string(),
        crate::Cell::Text(t) => t.clone(),
        crate::Cell::Nothing => "–".into(),
    };
    let bad = records.iter().filter(|r| !r.good);
    let rows = bad.take(ROWS).map(|r| {
        let mut cells = vec![(r.run + 1).to_string()];
        cells.extend(r.parameters.iter().map(cell));
        cells.extend([r.status.clone(), r.message.clone()]);
        cells
    });
    Section::new("failed", "Runs that failed").block(Block::Table { head, rows: rows.collect() })
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

//! Points with several runs.

use super::ROWS;
use crate::statistics::{Group, Sensitivity};
use crate::{Row, Study};
use trilith::report::{Block, Section, short};

/// Longest number of an axis that is shown as it is, letters.
const LONG: usize = 8;
/// Digits of a longer one.
const DIGITS: usize = 6;
/// Columns whose quantiles a table shows side by side.
const SIDE_BY_SIDE: usize = 4;

pub(super) fn section(study: &Study, runs: &[Row<'_>]) -> Section {
    let groups = study.groups(runs);
    let shown = &groups[..groups.len().min(ROWS)];
    let mut section = Section::new("statistics", "Statistics");
    let columns: Vec<usize> = (0..study.columns.len()).collect();
    for part in columns.chunks(SIDE_BY_SIDE).take(2) {
        section = section.block(quantiles(study, shown, part));
    }
    if let Some(block) = shares(study, shown, runs) {
        section = section.block(block);
    }
    let all: Vec<Sensitivity> = groups.iter().filter_map(|g| study.sensitivity(g)).collect();
    if !all.is_empty() {
        let cases: usize = all.iter().map(|s| s.cases).sum();
        let sensitive: usize = all.iter().map(|s| s.sensitive).sum();
        section = section.block(Block::text(format!(
            "{sensitive} of {cases} nominal cases are sensitive: their members part over overturning, or half the \
             band of 16 % to 84 % of an output, over its median, is more than {} times the scatter of the \
             parameters. There a single run says little.",
            study.sensitive_above
        )));
    }
    let more = if groups.len() > ROWS {
        format!("The first {ROWS} of {} points. ", groups.len())
    } else {
        String::new()
    };
    let beyond = if study.stop.is_some() {
        "Quantiles are those of the runs that were made; what happened in every run that met the limit of its \
         series counts for the runs left out beyond it as well. "
    } else {
        ""
    };
    section.block(Block::note(format!(
        "{more}{beyond}All points and columns are in `statistics.csv`. Quantiles: type 7; intervals of \
         probabilities: Wilson."
    )))
}

/// What tells points apart.
fn axes(study: &Study) -> Vec<usize> {
    (0..study.plan.axes.len()).filter(|i| !study.over.contains(i)).collect()
}

fn head(study: &Study) -> Vec<String> {
    let mut head: Vec<String> =
        axes(study).into_iter().map(|i| study.plan.axes[i].name.replace('_', " ")).collect();
    if study.plan.rows.len() > 1 {
        head.push("point".into());
    }
    head.push("runs".into());
    if study.stop.is_some() {
        head.push("left out".into());
    }
    head
}

/// A value of an axis to be read: a number of more digits than anybody compares with fewer of them, its unit as it is.
fn legible(value: &str) -> String {
    let (number, unit) = value.split_once(' ').unwrap_or((value, ""));
    match number.parse::<f64>() {
        Ok(x) if number.len() > LONG => {
            let number = short(x, DIGITS);
            if unit.is_empty() { number } else { format!("{number} {unit}") }
        }
        _ => value.to_owned(),
    }
}

fn point(study: &Study, g: &Group<'_>) -> Vec<String> {
    let value = |i: usize| legible(&study.plan.axes[i].values[g.place.axes[i]]);
    let mut cells: Vec<String> = axes(study).into_iter().map(value).collect();
    if study.plan.rows.len() > 1 {
        cells.push((g.place.row + 1).to_string());
    }
    cells.push(g.runs.len().to_string());
    if study.stop.is_some() {
        cells.push(g.stopped.len().to_string());
    }
    cells
}

fn quantiles(study: &Study, groups: &[Group<'_>], columns: &[usize]) -> Block {
    let mut head = head(study);
    head.extend(
        columns.iter().map(|i| study.label(&study.columns[*i].name) + ": median (16 % … 84 %)"),
    );
    let number = |x: f64| short(x, 3);
    let row = |g: &Group<'_>| {
        let mut cells = point(study, g);
        cells.extend(columns.iter().map(|i| {
            study.spread(g, *i).map_or("–".to_owned(), |s| {
                format!("{} ({} … {})", number(s.median), number(s.low), number(s.high))
            })
        }));
        cells
    };
    Block::Table { head, rows: groups.iter().map(row).collect() }
}

/// Probabilities of events and sensitivity; none where there is neither.
fn shares(study: &Study, groups: &[Group<'_>], runs: &[Row<'_>]) -> Option<Block> {
    let counted = study.counted(runs);
    let ensemble = study.plan.ensemble.is_some();
    if counted.is_empty() && !ensemble {
        return None;
    }
    let mut head = head(study);
    head.extend(counted.iter().map(|(name, _)| format!("P({name}), 90 % interval")));
    if ensemble {
        head.push("largest scatter over that of the parameters".into());
        head.push("sensitive".into());
    }
    let row =
        |g: &Group<'_>| {
            let mut cells = point(study, g);
            for (_, condition) in &counted {
                cells.push(study.share(g, condition).map_or("–".into(), |[p, low, high]| {
                    format!("{p:.3} ({low:.3} … {high:.3})")
                }));
            }
            if ensemble {
                let s = study.sensitivity(g);
                cells.push(s.map_or("–".into(), |s| short(s.amplification, 3)));
                cells.push(s.map_or("–".into(), sensitive));
            }
            cells
        };
    Some(Block::Table { head, rows: groups.iter().map(row).collect() })
}

fn sensitive(s: Sensitivity) -> String {
    match s {
        Sensitivity { sensitive: 0, .. } => "no".to_owned(),
        Sensitivity { cases: 1, divided: true, .. } => "yes: some overturn, some do not".to_owned(),
        Sensitivity { cases: 1, .. } => "yes".to_owned(),
        s => format!("{} of {}", s.sensitive, s.cases),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_are_shortened_and_all_else_stays() {
        assert_eq!(legible("0.13642616018213657"), "0.136426");
        assert_eq!(legible("0.13642616018213657 m/s"), "0.136426 m/s");
        for value in
            ["0.275", "1200", "0.35 g", "record of the north", "records/synthetic_1.csv", "1e-3"]
        {
            assert_eq!(legible(value), value);
        }
    }
}

//! The runs behind the points of the figures: what each was, where its histories are, or the command that makes it.

use super::plain;
use crate::number::written;
use crate::{Cell, Row, Study};
use trilith::report::{Entries, Entry, short};

/// More runs than this are not told one by one.
const RUNS: usize = 10_000;
/// Digits of the values that are told.
const DIGITS: usize = 5;

pub(super) fn entries(study: &Study, runs: &[Row<'_>]) -> Entries {
    let named = |name: &String| {
        let unit = study.unit(name);
        (name.clone(), if unit == "1" { String::new() } else { unit })
    };
    let mut head: Vec<(String, String)> = study.varied.iter().map(named).collect();
    head.extend(study.columns.iter().map(|c| named(&c.name)));
    head.extend(
        ["status", "leaves rest by", "message"].map(|what| (what.to_owned(), String::new())),
    );
    let model = plain(&study.model_path);
    let verb = if study.combination.is_some() { "combine" } else { "run" };
    let mut command = format!("trilith {verb} {}", quoted(&model.to_string_lossy()));
    if let Some(combination) = &study.combination {
        command += &format!(" --of {}", quoted(combination));
    }
    if let Some(case) = &study.case_named {
        command += &format!(" --case {}", quoted(case));
    }
    if let Some(solver) = study.solver {
        command += &format!(" --solver {}", solver.name());
    }
    let one = |r| Entry { cells: cells(r), place: kept(study, r), set: settings(study, r) };
    let mut rows: Vec<Entry> = runs.iter().copied().take(RUNS).map(one).collect();
    // What all runs set is said once.
    let mut common = rows.first().map(|r| r.set.clone()).unwrap_or_default();
    common.retain(|pair| rows.iter().all(|r| r.set.contains(pair)));
    rows.iter_mut().for_each(|r| r.set.retain(|pair| !common.contains(pair)));
    Entries { name: "run".into(), command, common, head, rows }
}

fn cells(r: Row<'_>) -> Vec<String> {
    let parameter = |c: Cell| match c {
        Cell::Number(x) => short(x, DIGITS),
        Cell::Text(text) => text,
        Cell::Nothing => String::new(),
    };
    let value = |v: Option<f64>| v.map_or(String::new(), |x| short(x, DIGITS));
    let mut all: Vec<String> = r.parameters().map(parameter).collect();
    all.extend(r.values().map(value));
    all.push(r.status().to_owned());
    all.push(r.initial_mode().unwrap_or_default().to_owned());
    all.push(r.told());
    all
}

/// Where the histories of a run are, beneath the page.
fn kept(study: &Study, r: Row<'_>) -> Vec<String> {
    let kept = r.good() && study.histories.as_ref().is_some_and(|c| c.holds(&study.columns, r));
    if kept { vec!["runs".into(), format!("{:06}", r.run() + 1)] } else { Vec::new() }
}

/// What a run sets, as `trilith run` takes it.
fn settings(study: &Study, r: Row<'_>) -> Vec<(String, String)> {
    let place = study.plan.place(r.run());
    let mut set = study.plan.nominal(&place);
    // Members of an ensemble have the values they came to.
    for (name, _) in study.plan.factors(place.member) {
        let Some(i) = study.varied.iter().position(|n| n == name) else { continue };
        if let (Some(Cell::Number(x)), Some(dimension)) = (r.parameter(i), study.kinds[i]) {
            set.retain(|(n, _)| n != name);
            set.push((name.to_owned(), written(x, dimension)));
        }
    }
    set
}

/// A word of a command line as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_=./,:+%@".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

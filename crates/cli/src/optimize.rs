//! `trilith optimize`: values of parameters that make a goal smallest.

use crate::args::OptimizeArguments;
use crate::gradient::failure as of_gradient;
use crate::interrupt::{Ear, INTERRUPTED};
use crate::text::{number, row, significant, table};
use crate::{Answer, Failure, case, diagnostics, model_text, names, output, place, solver};
use serde::Serialize;
use std::io::IsTerminal;
use std::path::Path;
use trilith::Registry;
use trilith::model::visible_line;
use trilith::optimize::{Evaluation, HOLDS, OptimizeError, Optimum, Stop, Wanted, optimize_with};
use trilith::results::{Folder, Writer};

/// The table of all runs in the folder of the results.
const RUNS: &str = "optimize.csv";
/// The same as JSON, with all there is to say.
const ALL: &str = "optimize.json";
/// Goals that are named one by one; of more, the number is told.
const NAMED: usize = 3;

pub(crate) fn optimize(registry: &Registry, args: &OptimizeArguments) -> Result<Answer, Failure> {
    let text = model_text(&args.model)?;
    let model = text.read(registry, &args.model.set).map_err(|e| Failure::diagnostics(&e))?;
    let chosen = case(&model, args.case.as_deref())?;
    let named = args.solver.as_deref().map(|name| solver(&model, chosen, name));
    let solver = named.transpose()?;
    let wanted = Wanted {
        case: Some(model.cases[chosen].name.clone()),
        solver,
        dt: args.dt,
        set: args.model.set.clone(),
        by: args.by.clone(),
        minimise: names::parts(&args.minimise),
        limits: args.limit.clone(),
        max_runs: args.max_runs,
    };
    // Looked at before the runs: nothing that was found is lost for want of a place.
    let folder = args.out.as_ref().map(|dir| open(dir, model.inputs())).transpose()?;
    let ear = Ear::open("the search ends, and the best so far is shown");
    let on_terminal = std::io::stderr().is_terminal();
    let mut on_run = |i: usize, run: &Evaluation| {
        if on_terminal {
            output::tell(&format!("run {}: {}\n", i + 1, said(run)));
        }
    };
    let found = optimize_with(&text, registry, &wanted, &mut on_run, ear.flag());
    let found = found.map_err(|e| match e {
        OptimizeError::Gradient(e) => of_gradient(e, &model),
        e => Failure::input(&e.to_string(), help(&e)),
    })?;
    drop(ear);
    let status = match found.stop {
        Stop::Interrupted => INTERRUPTED,
        _ if !found.holds() => 1,
        _ => 0,
    };
    let command = command(args, &found);
    let told = told(&model.title, &model.cases[chosen].name, &found, &command);
    let json = serde_json::to_string_pretty(&told).unwrap_or_default() + "\n";
    let mut text = if args.json { json.clone() } else { page(&told, &found, args.max_runs) };
    if let Some(folder) = folder {
        let files = [(RUNS.into(), csv(&found)), (ALL.into(), json)];
        for path in place::write(folder, &files)? {
            if !args.json {
                text += &format!("  written: {path}\n");
            }
        }
    }
    Ok(Answer { text, status })
}

fn open(dir: &Path, inputs: Vec<std::path::PathBuf>) -> Result<Folder, Failure> {
    let writes = vec![RUNS.into(), ALL.into()];
    place::open(dir, Writer { name: "optimize", own: &[RUNS, ALL], writes, inputs })
}

fn help(error: &OptimizeError) -> Option<&'static str> {
    match error {
        OptimizeError::NoVariable => Some("such as `--by mu=0.02..0.2`"),
        OptimizeError::NoGoal => Some("such as `--minimise roof`, with the name of an output"),
        OptimizeError::NothingMoves(_) => Some("choose other parameters, or another goal"),
        _ => None,
    }
}

/// A run in a few words.
fn said(run: &Evaluation) -> String {
    match &run.failed {
        Some(reason) => format!("failed: {}", visible_line(reason)),
        None if run.broken() > HOLDS => {
            format!("goal {}, a limit broken by {:.2} %", number(run.goal), 100.0 * run.broken())
        }
        None => format!("goal {}", number(run.goal)),
    }
}

/// All that is told, as JSON has it.
#[derive(Serialize)]
pub(crate) struct Told<'a> {
    title: &'a str,
    case: &'a str,
    goal: &'a [String],
    unit: &'a str,
    /// Why the search ended: smallest, kink, limits, spent, interrupted.
    stop: &'static str,
    restarts: usize,
    /// Number of the best run, from 1.
    best: usize,
    parameters: Vec<Parameter<'a>>,
    limits: Vec<Limit<'a>>,
    runs: Vec<Run<'a>>,
    bends: Vec<Bent<'a>>,
    /// The best run as a command.
    command: &'a str,
}

#[derive(Serialize)]
struct Parameter<'a> {
    name: &'a str,
    unit: &'a str,
    value: f64,
    first: f64,
    low: f64,
    high: f64,
}

#[derive(Serialize)]
struct Limit<'a> {
    limit: &'a str,
    value: f64,
    bound: f64,
    unit: &'a str,
    /// Share of the bound; below zero where it holds.
    beyond: f64,
    holds: bool,
    multiplier: f64,
}

#[derive(Serialize)]
struct Run<'a> {
    run: usize,
    goal: Option<f64>,
    /// The norm that stands for the largest of several goals.
    norm: Option<f64>,
    limits: Vec<f64>,
    values: &'a [f64],
    substeps: usize,
    failed: Option<&'a str>,
}

/// A link whose law bends.
#[derive(Serialize)]
struct Bent<'a> {
    link: &'a str,
    t: f64,
    substeps: usize,
}

/// What is told of an optimum.
pub(crate) fn told<'a>(
    title: &'a str,
    case: &'a str,
    found: &'a Optimum,
    command: &'a str,
) -> Told<'a> {
    let parameter = |i: usize| Parameter {
        name: &found.parameters[i],
        unit: &found.units[i],
        value: found.best().x[i],
        first: found.runs[0].x[i],
        low: found.bounds[i][0],
        high: found.bounds[i][1],
    };
    let limit = |l: &'a trilith::optimize::Limited| Limit {
        limit: &l.text,
        value: l.value,
        bound: l.bound,
        unit: &l.unit,
        beyond: l.beyond,
        holds: l.beyond <= HOLDS,
        multiplier: l.multiplier,
    };
    let run = |(i, r): (usize, &'a Evaluation)| Run {
        run: i + 1,
        goal: r.failed.is_none().then_some(r.goal),
        norm: r.failed.is_none().then_some(r.smooth),
        limits: r.sides.iter().map(|[left, _]| *left).collect(),
        values: &r.x,
        substeps: r.substeps,
        failed: r.failed.as_deref(),
    };
    let bent =
        |b: &'a trilith::solvers::gradient::Bend| Bent { link: &b.link, t: b.t, substeps: b.count };
    Told {
        title,
        case,
        goal: &found.goal,
        unit: &found.goal_unit,
        stop: found.stop.name(),
        restarts: found.restarts,
        best: found.best + 1,
        parameters: (0..found.parameters.len()).map(parameter).collect(),
        limits: found.limits.iter().map(limit).collect(),
        runs: found.runs.iter().enumerate().map(run).collect(),
        bends: found.bends.iter().map(bent).collect(),
        command,
    }
}

/// The best run as a command.
fn command(args: &OptimizeArguments, found: &Optimum) -> String {
    let mut line = format!("trilith run {}", word(&args.model.model.display().to_string()));
    if let Some(case) = &args.case {
        line += &format!(" --case {}", word(case));
    }
    if let Some(solver) = &args.solver {
        line += &format!(" --solver {}", word(solver));
    }
    if let Some(dt) = args.dt {
        line += &format!(" --dt {dt}");
    }
    let mut set = args.model.set.clone();
    set.retain(|(name, _)| !found.parameters.contains(name));
    for (name, value) in set.into_iter().chain(found.set()) {
        line += &format!(" --set {}", word(&format!("{name}={value}")));
    }
    line
}

/// A word of a command line, as a shell takes it.
fn word(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./=+,:@".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        return text.to_owned();
    }
    format!("'{}'", text.replace('\'', "'\\''"))
}

fn goal(found: &Optimum) -> String {
    match &found.goal[..] {
        [one] => one.clone(),
        all if all.len() <= NAMED => format!("the largest of {}", all.join(", ")),
        all => {
            format!("the largest of {} … {} ({} of them)", all[0], all[all.len() - 1], all.len())
        }
    }
}

/// What the program prints.
pub(crate) fn page(told: &Told<'_>, found: &Optimum, most: usize) -> String {
    let mut out = format!("{}\n\n", visible_line(told.title));
    out += &format!("to be smallest: {}, in case \"{}\"\n", visible_line(&goal(found)), told.case);
    let mut head = row(["run", "goal"]);
    head.extend(told.limits.iter().map(|l| l.limit.to_owned()));
    head.extend(told.parameters.iter().map(|p| p.name.to_owned()));
    let mut rows = vec![head];
    for run in &told.runs {
        let mut cells = vec![run.run.to_string()];
        match run.failed {
            Some(_) => {
                cells.push("failed".into());
                cells.extend(told.limits.iter().map(|_| "–".to_owned()));
            }
            None => {
                cells.push(run.goal.map_or("–".into(), number));
                cells.extend(run.limits.iter().map(|x| significant(*x, 4)));
            }
        }
        cells.extend(run.values.iter().map(|x| significant(*x, 4)));
        rows.push(cells);
    }
    out += &table(&rows, &[]);
    for (i, run) in found.runs.iter().enumerate() {
        if let Some(reason) = &run.failed {
            out += &format!("  run {} failed: {}\n", i + 1, visible_line(reason));
        }
    }
    out += "\n";
    let (first, best) = (&found.runs[0], found.best());
    out += &format!("best: run {}, goal {} {}", found.best + 1, number(best.goal), told.unit);
    if first.goal != 0.0 && found.best > 0 {
        let change = 100.0 * (best.goal / first.goal - 1.0);
        out += &format!(
            ", {:.1} % {} that of the first run",
            change.abs(),
            if change < 0.0 { "below" } else { "above" }
        );
    }
    out += "\n";
    let mut rows = vec![row(["parameter", "best", "first", "from", "to", "unit", ""])];
    for p in &told.parameters {
        let near = |bound: f64| (p.value - bound).abs() <= 2e-3 * (p.high - p.low);
        let note = match () {
            () if near(p.low) => "at its lower bound",
            () if near(p.high) => "at its upper bound",
            () => "",
        };
        let mut cells = vec![p.name.to_owned()];
        cells.extend([p.value, p.first, p.low, p.high].map(number));
        cells.extend([p.unit.to_owned(), note.to_owned()]);
        rows.push(cells);
    }
    out += &table(&rows, &[0, 5, 6]);
    if !told.limits.is_empty() {
        let mut rows = vec![row(["limit", "value", "bound", "unit", "", "1 % more of it"])];
        for l in &told.limits {
            let state = match l.beyond {
                x if x > HOLDS => format!("broken by {:.2} %", 100.0 * x),
                x if x > -HOLDS => format!("reached within {:.3} %", 100.0 * x.abs()),
                x => format!("holds, {:.1} % away", -100.0 * x),
            };
            let worth = match l.multiplier {
                m if m > 0.0 => format!(
                    "{:+.3} % of the first goal",
                    -m * if l.limit.contains(['≥']) || l.limit.contains(">=") {
                        -1.0
                    } else {
                        1.0
                    }
                ),
                _ => "no matter".into(),
            };
            let cells = [l.limit, &number(l.value), &number(l.bound), l.unit, &state, &worth];
            rows.push(row(cells));
        }
        out += &table(&rows, &[0, 3, 4, 5]);
    }
    out += &format!(
        "ended after {} of at most {most} runs: {}\n",
        found.runs.len(),
        ended(found.stop)
    );
    if found.restarts > 0 {
        out += &format!(
            "  {} the search began anew along the steepest way: goals have kinks where a peak moves to another time or place\n",
            times(found.restarts)
        );
    }
    for (name, at) in &found.moved {
        out += &format!(
            "  the search began with {name} = {}: its own value is beyond its bounds, or on one\n",
            number(*at)
        );
    }
    for Bent { link, t, substeps } in &told.bends {
        out += &format!(
            "  warning: in the best run the law of \"{link}\" bends at the end of {substeps} of the substeps, first at t = {} s: there derivatives are those of one side\n",
            number(*t)
        );
    }
    if !found.holds() {
        out += &diagnostics::warning("not all limits hold: nothing better was found");
    }
    if !told.command.is_empty() {
        out += &format!("run it:\n{}\n", told.command);
    }
    out
}

fn times(n: usize) -> String {
    match n {
        1 => "once".into(),
        2 => "twice".into(),
        n => format!("{n} times"),
    }
}

fn ended(stop: Stop) -> &'static str {
    match stop {
        Stop::Smallest => "the derivatives are zero, within the bounds and on the limits",
        Stop::Kink => {
            "nothing around is better: a kink, where a peak moves to another time or place, or a gain below what steps make of a run"
        }
        Stop::Limits => "no values of the parameters were found with which all limits hold",
        Stop::Spent => "all runs are made; `--max-runs` gives it more",
        Stop::Interrupted => "interrupted",
        _ => "for another reason",
    }
}

/// All runs, comma-separated.
fn csv(found: &Optimum) -> String {
    let mut head = vec!["run".to_owned(), format!("goal [{}]", found.goal_unit)];
    head.extend(found.limits.iter().map(|l| format!("{} [{}]", l.text, l.unit)));
    let parameters = found.parameters.iter().zip(&found.units);
    head.extend(parameters.map(|(name, unit)| format!("{name} [{unit}]")));
    let cell = |text: &str| match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    };
    let line =
        |cells: &[String]| cells.iter().map(|c| cell(c)).collect::<Vec<_>>().join(",") + "\n";
    let mut out = line(&head);
    for (i, run) in found.runs.iter().enumerate() {
        let mut cells = vec![(i + 1).to_string()];
        match run.failed.is_some() {
            true => cells.resize(2 + found.limits.len(), String::new()),
            false => {
                cells.push(run.goal.to_string());
                cells.extend(run.sides.iter().map(|[left, _]| left.to_string()));
            }
        }
        cells.extend(run.x.iter().map(f64::to_string));
        out += &line(&cells);
    }
    out
}

//! `trilith sweep`.

use crate::args::SweepArguments;
use crate::interrupt::{Ear, INTERRUPTED};
use crate::progress::Steps;
use crate::text::{row, shown, table};
use crate::{Answer, Failure, figure_files, made_by, output, study_folder};
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;
use trilith::Registry;
use trilith::model::visible_line;
use trilith::report::Drawing;
use trilith_study::{How, Part, Results, Study, StudyError, execute, is_study_folder, status};

/// Failed runs that are told one by one.
const TOLD: usize = 5;

pub(crate) fn sweep(registry: &Registry, args: &SweepArguments) -> Result<Answer, Failure> {
    figure_files::check(&args.figure_format)?;
    let mut study =
        Study::read(&args.study, registry, &args.set).map_err(|e| Failure::diagnostics(&e))?;
    // Runs with other laws are those of another program.
    study.identity.build += &crate::laws::digest()?;
    if !args.figure_format.is_empty() && study.figures.is_empty() {
        let help = "`figures: [Points(x: \"mu\", y: \"slide\")]` in the study file asks for one";
        return Err(Failure::input("the study has no figures to write", Some(help)));
    }
    if args.dry_run {
        return Ok(plan(&study, registry).into());
    }
    let stem = args.study.file_stem().unwrap_or("study".as_ref());
    let folder = args.out.clone().unwrap_or_else(|| Path::new("out").join(stem));
    if args.status {
        return how_far(&study, &folder);
    }
    if args.gather && !is_study_folder(&folder) {
        let message = format!("there are no runs in {}", shown(&folder));
        let help = "`--shard I/N` makes them, one part after the other or many at once";
        return Err(Failure::input(&message, Some(help)));
    }
    study_folder::look(&study, &folder, &args.figure_format)?;
    let threads = args.threads.map_or_else(cores, usize::from);
    let inputs = made_by::Inputs::of_study(&study)?;
    let start = Instant::now();
    let part = match args.shard {
        Some(shard) => Part::Shard(shard),
        None if args.gather => Part::Gather,
        None => Part::All,
    };
    let store = args.store.as_deref();
    let how = How { threads, part, retry_failed: args.retry_failed, store };
    let results = executed(&study, registry, &folder, how)?;
    let mut text = report(&study, &results, start.elapsed().as_secs_f64(), &folder);
    match args.shard {
        Some(shard) => {
            text += &format!(
                "part {shard} is done, in {}; once all are, `--gather` writes the tables\n",
                shown(&folder)
            );
        }
        None => made_by::write_study(&folder, &inputs, &args.set, &study)?,
    }
    if !args.figure_format.is_empty() {
        for (name, figure) in trilith_study::figures(&study, &results.records.rows()) {
            for path in
                figure_files::write(&folder, &name, &Drawing::from(&figure), &args.figure_format)?
            {
                text += &format!("figure: {}\n", shown(&path));
            }
        }
    }
    let warned = results.warned();
    if warned > 0 {
        let message = format!(
            "{warned} of {} runs warned of something: the column `message` of the table says of what",
            results.records.len()
        );
        output::tell(&crate::diagnostics::warning(&message));
    }
    let failed = results.failed();
    if failed > 0 {
        let help = "they are rows of the table with their status and message";
        let message = format!("{failed} of {} runs failed", results.records.len());
        output::tell(&crate::diagnostics::plain(&message, Some(help)));
    }
    crate::browser::show(args.open, &folder.join("study.html"));
    Ok(Answer { text, status: i32::from(failed > 0) })
}

/// As many threads as there are cores.
pub(crate) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// Runs a study, shows how far it is, and can be stopped.
pub(crate) fn executed(
    study: &Study,
    registry: &Registry,
    folder: &Path,
    how: How<'_>,
) -> Result<Results, Failure> {
    let again = format!(
        "finished runs are kept in {}: stopped at any time, the same command goes on",
        shown(folder)
    );
    let bar = Mutex::new(Steps::new(&study.title, again));
    let show = |p: trilith_study::Progress| {
        if let Ok(mut bar) = bar.lock() {
            bar.show(p.done, p.total, p.failed);
        }
    };
    let ear = Ear::open("the study ends, and its finished runs are kept");
    execute(study, registry, folder, how, &show, ear.flag()).map_err(|e| {
        let failure = Failure::input(&e.to_string(), Some(e.help()));
        match e {
            StudyError::Interrupted { .. } => Failure { status: INTERRUPTED, ..failure },
            _ => failure,
        }
    })
}

/// How far the parts of a study are.
fn how_far(study: &Study, folder: &Path) -> Result<Answer, Failure> {
    if !is_study_folder(folder) {
        return Ok(format!("no part has begun: there are no runs in {}\n", shown(folder)).into());
    }
    let found = status(study, folder);
    let (parts, open) = found.map_err(|e| Failure::input(&e.to_string(), Some(e.help())))?;
    let mut rows = vec![row(["part", "runs", "of", "failed", "series to go"])];
    for part in &parts {
        let name = match part.part {
            Part::Shard(shard) => shard.to_string(),
            Part::All | Part::Gather => "whole".into(),
        };
        let numbers = [part.done, part.of, part.failed, part.open].map(|n| n.to_string());
        let [done, of, failed, open] = &numbers;
        rows.push(row([&name, done, of, failed, open]));
    }
    let mut text = table(&rows, &[0]);
    text += &match open {
        0 => "\nall runs are there: `--gather` writes the tables\n".to_owned(),
        n => format!("\n{n} series of runs to go: parts that are not listed have not begun\n"),
    };
    Ok(text.into())
}

/// What would be run.
fn plan(study: &Study, registry: &Registry) -> String {
    let mut out = String::new();
    for (name, value) in [("study", study.title.as_str()), ("model", &study.model_title)] {
        out += &format!("{name:7} {}\n", visible_line(value));
    }
    let mut rows = vec![row(["", "parameter", "values"])];
    if study.plan.rows.len() > 1 {
        rows.push(row(["points", "", &study.plan.rows.len().to_string()]));
    }
    for axis in &study.plan.axes {
        let values = match axis.values.as_slice() {
            all if all.len() <= 6 => all.join(", "),
            all => format!("{}, {} … {} ({})", all[0], all[1], all[all.len() - 1], all.len()),
        };
        rows.push(row(["axis", &axis.name, &values]));
    }
    if let Some(samples) = &study.plan.samples {
        rows.push(row(["samples", &samples.names.join(", "), &samples.values.len().to_string()]));
    }
    if let Some(ensemble) = &study.plan.ensemble {
        let members = format!("{} members", ensemble.factors.len());
        rows.push(row(["ensemble", &ensemble.names.join(", "), &members]));
    }
    out += &format!("\n{}", table(&rows, &[0, 1, 2]));
    let columns: Vec<&str> = study.columns.iter().map(|c| c.name.as_str()).collect();
    out += &format!("\ncolumns: {}\n", visible_line(&columns.join(", ")));
    if let Some(stop) = &study.stop {
        out += &format!("a series ends where: {}\n", visible_line(&stop.text()));
    }
    let how = study.alone(registry).map_or_else(|| SIDE_BY_SIDE.into(), |why| one_by_one(&why));
    out + &format!("runs: {}, {how}\n", study.identity.runs)
}

/// Said of runs that share cores.
const SIDE_BY_SIDE: &str = "side by side in vector lanes";

fn one_by_one(why: &str) -> String {
    format!("one by one ({})", visible_line(why))
}

fn report(study: &Study, results: &Results, seconds: f64, folder: &Path) -> String {
    let [title, model] = [&study.title, &study.model_title].map(|text| visible_line(text));
    let mut out = format!("study   {title}\nmodel   {model}\n");
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for r in results.records.iter() {
        match counts.iter_mut().find(|c| c.0 == r.status()) {
            Some(c) => c.1 += 1,
            None => counts.push((r.status(), 1)),
        }
    }
    let mut rows = vec![row(["status", "runs"])];
    rows.extend(counts.iter().map(|(status, n)| row([status, &n.to_string()])));
    if results.left_out > 0 {
        rows.push(row(["left out beyond the limit", &results.left_out.to_string()]));
    }
    out += &format!("\n{}", table(&rows, &[0]));
    for r in results.records.iter().filter(|r| !r.good()).take(TOLD) {
        out += &format!("  run {}: {}: {}\n", r.run() + 1, r.status(), visible_line(r.message()));
    }
    let new = results.records.len().saturating_sub(results.resumed + results.reused);
    out += &format!("\nnew runs: {new} in {} s", crate::text::significant(seconds, 3));
    if new > 0 {
        out += &format!(", {} a second", crate::text::significant(new as f64 / seconds, 3));
    }
    match &results.alone {
        Some(why) if new > 0 => out += &format!(", {}", one_by_one(why)),
        None if results.beside == new && new > 0 => out += &format!(", {SIDE_BY_SIDE}"),
        None if new > 0 => out += &format!(", {} of them {SIDE_BY_SIDE}", results.beside),
        _ => {}
    }
    if results.reused > 0 {
        out += &format!("; {} from the store", results.reused);
    }
    if results.resumed > 0 {
        out += &format!("; {} were on disk", results.resumed);
    }
    if results.torn > 0 {
        out += &format!("; {} torn line(s) of the journal run again", results.torn);
    }
    out += "\n";
    for file in &results.files {
        out += &format!("file: {}\n", shown(file));
    }
    if study.histories.is_some() {
        out += &format!("histories: {}\n", shown(&folder.join("runs")));
    }
    out
}

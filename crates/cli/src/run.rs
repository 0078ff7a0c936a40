//! `trilith run`.

use crate::args::{ModelArguments, ReportArguments, RunArguments};
use crate::interrupt::{Ear, INTERRUPTED, is_wanted};
use crate::progress::Progress;
use crate::text::{exact, shown};
use crate::{
    Answer, Failure, browser, case, design_spectrum, diagnostics, figure_files, figures, long,
    made_by, names, output, path, place, read, solver,
};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use trilith::model::{Body, Element};
use trilith::record::design::DesignSpectrum;
use trilith::report::{RunData, Sections};
use trilith::results::{Folder, OF_RUN, Summary, Writer};
use trilith::solvers::Status;
use trilith::{Analysis, Checkpoint, Model, Registry, Run, RunOptions};

/// Deformed shapes kept for ParaView.
const FRAMES: usize = 200;
const CHECKPOINT: &str = "checkpoint.json";

/// `stale`: what becomes true once nobody wants the run any more, by whom interrupts have to be heard as well; nothing is
/// written then, and there is no answer.
pub(crate) fn run(
    registry: &Registry,
    args: RunArguments,
    stale: Option<&AtomicBool>,
) -> Result<Option<Answer>, Failure> {
    let model = read(registry, &args.model)?;
    let case = case(&model, args.case.as_deref())?;
    let solver = args.solver.as_deref().map(|name| solver(&model, case, name)).transpose()?;
    let from = args.restart.as_deref().map(checkpoint).transpose()?;
    check_stops(&model, case, &args)?;
    check_links(&model, &names::flat(&args.loops))?;
    figures::check(&model, &names::flat(&args.figure))?;
    figure_files::check(&args.figure_format)?;
    let spectrum = args.spectrum.as_deref().map(design_spectrum::read).transpose()?;
    if spectrum.is_some() && args.no_report && args.figure.is_empty() {
        let help = "leave `--no-report` out, or ask for `--figure ground`";
        return Err(Failure::input("there is nothing to lay `--spectrum` over", Some(help)));
    }
    if !args.no_files {
        let from = from.as_ref().map(|checkpoint| checkpoint.state.time);
        long::refuse(&model, &model.cases[case], args.dt, [from, args.checkpoint_at])?;
    }
    // Looked at before the analysis: nothing that was computed is lost for want of a place.
    let folder = if args.no_files {
        None
    } else {
        Some((open(&model, case, &args, from.as_ref())?, made_by::Inputs::of_run(&model, &args)?))
    };
    let other_build = from.as_ref().and_then(Checkpoint::warning);
    if !args.no_files
        && let Some(warning) = long::warning(&model, &model.cases[case], args.dt)
    {
        output::tell(&warning);
    }
    let (analysis, run) = {
        let mut bar = Progress::new(&model.cases[case].name);
        let mut show = |share| bar.show(share);
        let ear = Ear::open("the run ends at the next output step, and what there is will be kept");
        let options = RunOptions {
            case,
            solver,
            dt: args.dt,
            until: args.checkpoint_at,
            vectors: None,
            substeps: None,
            step_errors: true,
            from: from.map(|checkpoint| checkpoint.state),
            progress: Some(&mut show),
            interrupt: Some(stale.unwrap_or(ear.flag())),
        };
        let mut analysis = Analysis::new(&model).map_err(|e| Failure::of(&e, &model))?;
        if args.no_files {
            analysis = analysis.without_histories();
        } else {
            analysis = analysis.with_frames(FRAMES);
            if !args.no_report || !args.figure.is_empty() {
                analysis = analysis.with_loops();
            }
        }
        let mut run = analysis.run(options).map_err(|e| Failure::of(&e, &model))?;
        if stale.is_some_and(|stale| stale.load(Ordering::SeqCst)) && !is_wanted() {
            return Ok(None);
        }
        run.result.warnings.extend(other_build);
        (analysis, run)
    };
    let summary = run.summary(&model);
    for w in &summary.warnings {
        output::tell(&diagnostics::warning(w));
    }
    let mut text = crate::report::text(&model, &summary);
    let page =
        folder.as_ref().map(|(folder, _)| folder.published(&folder.path().join("report.html")));
    let files = match folder {
        Some((folder, inputs)) => {
            write(folder, &inputs, &args, spectrum.as_ref(), &analysis, &run, &summary)
        }
        None => Ok(String::new()),
    };
    match files {
        Ok(written) => {
            text += &written;
            page.iter().for_each(|page| browser::show(args.open, page));
        }
        // What was found is on the screen all the same.
        Err(failure) => {
            output::tell(&failure.text);
            return Ok(Some(Answer { text, status: failure.status }));
        }
    }
    let status = match &run.result.status {
        status if status.is_good() => 0,
        status => {
            output::tell(&diagnostics::plain(&status.text(), None));
            if matches!(status, Status::Interrupted { .. }) { INTERRUPTED } else { 1 }
        }
    };
    Ok(Some(Answer { text, status }))
}

/// Takes the folder of the results.
fn open(
    model: &Model,
    case: usize,
    args: &RunArguments,
    from: Option<&Checkpoint>,
) -> Result<Folder, Failure> {
    let dir = args.out.clone().unwrap_or_else(|| default_folder(args, from));
    let mut inputs = model.inputs();
    inputs.extend(args.restart.clone());
    let written = |name: &&str| match *name {
        "spectra.csv" => !model.spectra.is_empty(),
        "envelopes.csv" => !model.envelopes.is_empty(),
        "report.json" | "report.html" => !args.no_report,
        _ => true,
    };
    let mut writes: Vec<String> = OF_RUN.into_iter().filter(written).map(str::to_owned).collect();
    writes.extend(figures::files(model, &names::flat(&args.figure), &args.figure_format));
    // Where the case has a time to stop at: an interrupt asks for no leave.
    if let trilith::model::Analysis::Dynamic(_) = &model.cases[case].analysis {
        writes.push(CHECKPOINT.into());
    }
    let writer = Writer { name: "run", own: &OF_RUN, writes, inputs };
    place::open(&dir, writer)
}

/// Writes the results; what is there now, as lines.
fn write(
    folder: Folder,
    inputs: &made_by::Inputs,
    args: &RunArguments,
    spectrum: Option<&DesignSpectrum>,
    analysis: &Analysis<&Model>,
    run: &Run,
    summary: &Summary,
) -> Result<String, Failure> {
    let (model, dir) = (analysis.model(), folder.path());
    let show = |what: &str, path: &Path| format!("{what}: {}\n", shown(&folder.published(path)));
    let mut text = show("files", dir);
    run.write(model, dir).map_err(|e| Failure::of(&e, model))?;
    made_by::write_run(dir, inputs, &args.model.set, summary, run.result.end.dt)?;
    let mut laid = Ok(());
    if !args.no_report {
        let loops = names::flat(&args.loops);
        let mut data = run.report_of(analysis, summary, &args.model.set, &loops, &Sections::all());
        laid = over(&mut data, args, spectrum);
        let page = trilith::write_report(dir, &data).map_err(|e| Failure::of(&e, model))?;
        text += &show("report", &page);
    }
    let names = names::flat(&args.figure);
    let figures = (!names.is_empty()).then(|| {
        let mut data = figures::data(analysis, run, &names);
        laid = over(&mut data, args, spectrum);
        figures::write(&data, dir, &names, &args.figure_format)
    });
    let figures = figures.unwrap_or(Ok(Vec::new()));
    for path in figures.iter().flatten() {
        text += &show("figure", path);
    }
    let interrupted = matches!(run.result.status, Status::Interrupted { .. });
    if args.checkpoint_at.is_some() || interrupted {
        let path = dir.join(CHECKPOINT);
        let checkpoint = Checkpoint::new(run.result.end.clone());
        checkpoint.write(&path).map_err(|e| Failure::unwritable(&e.path, &e.cause))?;
        text += &show("checkpoint", &path);
        if interrupted {
            text += "the same command with `--restart` and this checkpoint goes on";
            text += if args.out.is_some() { " (with `--out` for another folder)\n" } else { "\n" };
        }
    }
    folder.publish().map_err(|e| Failure::folder(&e))?;
    // A figure that cannot be drawn takes nothing else with it.
    figures.and(laid).map(|()| text)
}

/// With the design spectrum, where one is asked for.
fn over(
    data: &mut RunData,
    args: &RunArguments,
    spectrum: Option<&DesignSpectrum>,
) -> Result<(), Failure> {
    let asked = args.spectrum.as_deref().zip(spectrum);
    asked.map_or(Ok(()), |(text, spectrum)| design_spectrum::lay_over(data, text, spectrum))
}

/// `trilith report`: the page again.
pub(crate) fn report(args: &ReportArguments) -> Result<Answer, Failure> {
    let page = trilith::rebuild_report(&args.dir).map_err(|e| {
        let help = "`trilith run MODEL --out DIR` writes such a folder";
        Failure::input(&e.to_string(), Some(help))
    })?;
    Ok(format!("report: {}\n", shown(&page)).into())
}

/// A run that is to stop on its way must have one.
fn check_stops(model: &Model, case: usize, args: &RunArguments) -> Result<(), Failure> {
    let case = &model.cases[case];
    match (&case.analysis, args.checkpoint_at) {
        (trilith::model::Analysis::Static(_), Some(_)) => {
            let help = "leave `--checkpoint-at` out, or name a dynamic case with `--case`";
            let message = format!("the case {} is static: it has no time to stop at", case.name);
            Err(Failure::input(&message, Some(help)))
        }
        _ => Ok(()),
    }
}

/// Names of links that the model must have.
fn check_links(model: &Model, names: &[String]) -> Result<(), Failure> {
    let links = || {
        let is_link = |e: &&Element| matches!(e.body, Body::Link(..));
        model.elements.iter().filter(is_link).map(|e| e.name.as_str())
    };
    match names.iter().find(|n| !links().any(|l| l == n.as_str())) {
        None => Ok(()),
        Some(name) => {
            let links = links().collect::<Vec<_>>().into_iter();
            let help = names::help(name, "links", "--loops", links);
            Err(Failure::input(&format!("there is no link \"{name}\""), Some(&help)))
        }
    }
}

/// `out/<name of the model file>`, and below it what was set: of all that changes the answer, each has its own.
pub(crate) fn default_folder(args: &RunArguments, from: Option<&Checkpoint>) -> PathBuf {
    let ModelArguments { set, .. } = &args.model;
    let dir = Path::new("out").join(path(&args.model).file_stem().unwrap_or("model".as_ref()));
    let options = [
        ("case", args.case.clone()),
        ("solver", args.solver.clone()),
        ("dt", args.dt.map(exact)),
        ("checkpoint-at", args.checkpoint_at.map(exact)),
        ("restart", from.map(|checkpoint| exact(checkpoint.state.time))),
    ];
    let mut all: Vec<String> = set.iter().map(|(name, value)| format!("{name}={value}")).collect();
    let given = |(name, value): (&str, Option<String>)| value.map(|v| format!("{name}={v}"));
    all.extend(options.into_iter().filter_map(given));
    if all.is_empty() {
        return dir;
    }
    let plain = |c: char| if c.is_alphanumeric() || "-+_.=,".contains(c) { c } else { '_' };
    dir.join(all.join(",").chars().map(plain).collect::<String>())
}

fn checkpoint(path: &Path) -> Result<Checkpoint, Failure> {
    Checkpoint::read(path)
        .map_err(|e| Failure::input(&e.to_string(), Some("`--checkpoint-at T` writes one")))
}

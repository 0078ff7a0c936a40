//! `made_by.json`: what made a folder of results, from which files, and when. All that is the same in a repetition of
//! the run stands in other files as well; the date and the command line stand here alone.

use crate::Failure;
use crate::args::RunArguments;
use crate::date::date;
use serde::Serialize;
use std::path::Path;
use trilith::model::Source;
use trilith::results::{Named, ParameterSummary, Summary, sha256};
use trilith::{BUILD, Model, VERSION};
use trilith_study::{Identity, Study};

const NAME: &str = "made_by.json";

/// What is known before anything runs: files may change in the meantime.
pub(crate) struct Inputs {
    date: String,
    files: Vec<Input>,
}

/// A file that was read.
#[derive(Serialize)]
struct Input {
    /// `model`, `include` (what the model includes), `data` (records and tables), `checkpoint`, `study`, or `laws` (libraries).
    what: &'static str,
    /// Its path as it was asked for.
    file: String,
    /// SHA-256 of it, hexadecimal.
    sha256: String,
}

impl Input {
    fn read(what: &'static str, path: &Path) -> Result<Self, Failure> {
        let bytes = trilith::record::file::read(path).map_err(|e| {
            Failure::input(&format!("{} cannot be read: {e}", path.display()), None)
        })?;
        Ok(Self { what, file: path.display().to_string(), sha256: sha256(&bytes) })
    }

    /// A model file and those that it includes.
    fn texts<'s>(sources: impl Iterator<Item = &'s Source>) -> Vec<Self> {
        let one = |(i, s): (usize, &Source)| Self {
            what: if i == 0 { "model" } else { "include" },
            file: s.path.display().to_string(),
            sha256: s.sha256.clone(),
        };
        sources.enumerate().map(one).collect()
    }
}

impl Input {
    /// Libraries whose laws were taken.
    fn laws() -> Result<Vec<Self>, Failure> {
        crate::laws::opened().iter().map(|path| Self::read("laws", path)).collect()
    }
}

impl Inputs {
    /// Of a run.
    pub fn of_run(model: &Model, args: &RunArguments) -> Result<Self, Failure> {
        let mut files = Input::texts(std::iter::once(&model.source).chain(model.included()));
        for (i, path) in model.files.iter().enumerate() {
            if !model.files[..i].contains(path) {
                files.push(Input::read("data", path)?);
            }
        }
        if let Some(path) = &args.restart {
            files.push(Input::read("checkpoint", path)?);
        }
        files.extend(Input::laws()?);
        Ok(Self { date: date()?, files })
    }

    /// Of a study. The motions of its runs are in its identity.
    pub fn of_study(study: &Study) -> Result<Self, Failure> {
        let mut files = vec![Input::read("study", &study.path)?];
        files.extend(Input::texts(study.sources()));
        files.extend(Input::laws()?);
        Ok(Self { date: date()?, files })
    }
}

/// The file.
#[derive(Serialize)]
struct MadeBy<'a, T> {
    program: &'static str,
    version: &'static str,
    build: &'static str,
    /// Architecture and system.
    machine: [&'static str; 2],
    /// What `TRILITH_VECTORS` says, which the last bits hang on; `null` where it is not set.
    vectors: Option<String>,
    /// When it was started, UTC.
    date: &'a str,
    command: Vec<String>,
    files: &'a [Input],
    /// `NAME=VALUE`, as on the command line.
    set: Vec<String>,
    #[serde(flatten)]
    what: T,
}

#[derive(Serialize)]
struct OfRun<'a> {
    parameters: &'a Named<ParameterSummary>,
    case: &'a str,
    solver: &'static str,
    /// Output step, s; `null` for static cases.
    dt: Option<f64>,
    run_sha256: &'a str,
}

#[derive(Serialize)]
struct OfStudy<'a> {
    study: &'a Identity,
}

/// Writes it into the folder of a run. `dt`: output step, s; 0 for static cases.
pub(crate) fn write_run(
    dir: &Path,
    inputs: &Inputs,
    set: &[(String, String)],
    summary: &Summary,
    dt: f64,
) -> Result<(), Failure> {
    let what = OfRun {
        parameters: &summary.parameters,
        case: &summary.case,
        solver: summary.solver,
        dt: Some(dt).filter(|dt| *dt > 0.0),
        run_sha256: &summary.run_sha256,
    };
    write(dir, inputs, set, what)
}

/// Writes it into the folder of a study; of one that was resumed it tells the last start.
pub(crate) fn write_study(
    dir: &Path,
    inputs: &Inputs,
    set: &[(String, String)],
    study: &Study,
) -> Result<(), Failure> {
    write(dir, inputs, set, OfStudy { study: &study.identity })
}

fn write(
    dir: &Path,
    inputs: &Inputs,
    set: &[(String, String)],
    what: impl Serialize,
) -> Result<(), Failure> {
    let made = MadeBy {
        program: "trilith",
        version: VERSION,
        build: BUILD,
        machine: [std::env::consts::ARCH, std::env::consts::OS],
        vectors: crate::vectors::asked(),
        date: &inputs.date,
        command: command(),
        files: &inputs.files,
        set: set.iter().map(|(name, value)| format!("{name}={value}")).collect(),
        what,
    };
    let path = dir.join(NAME);
    serde_json::to_string_pretty(&made)
        .map_err(std::io::Error::from)
        .and_then(|text| std::fs::write(&path, text + "\n"))
        .map_err(|e| Failure::unwritable(&path, &e))
}

/// The command line; of the program its name alone, wherever it lies.
fn command() -> Vec<String> {
    let mut all: Vec<String> =
        std::env::args_os().map(|a| a.to_string_lossy().into_owned()).collect();
    if let Some(first) = all.first_mut()
        && let Some(name) = Path::new(&*first).file_name().map(|n| n.to_string_lossy().into_owned())
    {
        *first = name;
    }
    all
}

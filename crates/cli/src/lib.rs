//! The program `trilith` as a library, so that an application with links of its own is
//!
//! ```no_run
//! # mod my_links { pub fn register(_: &mut impl trilith::Register) {} }
//! let mut registry = trilith::registry();
//! my_links::register(&mut registry);
//! trilith_cli::main_with(registry)
//! ```
//!
//! Results go to stdout, diagnostics and progress to stderr. Exit status: 0 done, 1 the run did not
//! converge or lost energy, or what it found could not be printed, 2 the input is wrong, 130 it was interrupted.

mod args;
mod browser;
mod calibrate;
mod check;
mod combine;
mod combine_page;
mod compare;
mod compare_page;
mod date;
mod design_spectrum;
mod diagnostics;
mod elements;
mod exercise;
mod export;
mod failure;
mod figure_files;
mod figures;
mod generate;
mod gradient;
mod import;
mod interrupt;
mod laws;
mod long;
mod lsp;
mod made_by;
mod manual;
mod modes;
mod names;
mod new;
mod optimize;
mod output;
mod peer;
mod place;
mod progress;
mod record;
mod reduce;
mod report;
mod run;
mod schema;
mod study_folder;
mod sweep;
mod text;
pub mod told;
mod vectors;
mod view;
mod watch;

use args::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::ffi::OsString;
use std::io::Read;
use std::path::Path;
use trilith::model::{ModelText, file};
use trilith::{Model, Registry, SolverKind};

/// What a command prints, and the exit status.
#[derive(Default)]
struct Answer {
    text: String,
    status: i32,
}

impl From<String> for Answer {
    fn from(text: String) -> Self {
        Self { text, status: 0 }
    }
}

/// Runs the program with the arguments of the process and the kinds of a registry, and ends it.
pub fn main_with(registry: Registry) -> ! {
    main_of(registry, std::env::args_os())
}

/// The same with other arguments than those of the process; the first is the name of the program.
pub fn main_of(registry: Registry, arguments: impl IntoIterator<Item = OsString>) -> ! {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(said) => std::process::exit(output::usage(&said)),
    };
    let Arguments { command, laws } = arguments;
    let registry = vectors::check().and_then(|()| laws::taken(registry, laws));
    let answer = registry.and_then(|registry| match command {
        Command::Run(a) => run::run(&registry, a, None).map(Option::unwrap_or_default),
        Command::Watch(a) => watch::watch(&registry, &a),
        Command::Check(a) => check::check(&registry, &a),
        Command::Modes(a) => modes::modes(&registry, &a),
        Command::New(a) => new::new(&a),
        Command::View(a) => view::view(&registry, &a),
        Command::Lsp => lsp::lsp(&registry),
        Command::Schema => schema::schema(&registry),
        Command::Elements(a) => elements::elements(&registry, &a),
        Command::Exercise(a) => exercise::exercise(&registry, a),
        Command::Report(a) => run::report(&a),
        Command::Combine(a) => combine::combine(&registry, &a),
        Command::Compare(a) => compare::compare(&registry, &a),
        Command::Sweep(a) => sweep::sweep(&registry, &a),
        Command::Gradient(a) => gradient::gradient(&registry, &a),
        Command::Optimize(a) => optimize::optimize(&registry, &a),
        Command::Reduce(a) => reduce::reduce(&registry, &a),
        Command::Generate(a) => generate::generate(a),
        Command::Import(a) => import::import(&a),
        Command::Export(a) => export::export(&registry, &a),
        Command::Calibrate(a) => calibrate::calibrate(&registry, &a),
        Command::Record(a) => record::record(&a),
        Command::Completions { shell } => manual::completions(shell),
        Command::Manual { dir } => manual::manual(&dir),
    });
    let status = match answer {
        Ok(Answer { text, status }) => output::print(&text, status),
        Err(failure) => {
            output::tell(&failure.text);
            failure.status
        }
    };
    std::process::exit(status)
}

/// A model that comes from standard input.
const STDIN: &str = "-";

/// What a model from standard input is called; files that it names are looked for in this folder.
fn path(args: &args::ModelArguments) -> &Path {
    if args.model == Path::new(STDIN) { Path::new("stdin.ron") } else { &args.model }
}

/// The text of a model, understood.
fn model_text(args: &args::ModelArguments) -> Result<ModelText, Failure> {
    let text = if args.model == Path::new(STDIN) {
        let most = trilith::record::file::MOST_BYTES;
        let mut text = String::new();
        let read = std::io::stdin().take(most + 1).read_to_string(&mut text);
        let too_long = || std::io::Error::other(format!("it is larger than {} MiB", most >> 20));
        let read = read.and_then(|n| if n as u64 > most { Err(too_long()) } else { Ok(text) });
        read.map_err(|e| Failure::input(&format!("standard input gives no model: {e}"), None))?
    } else {
        file::open(&args.model, "model").map_err(|e| Failure::diagnostics(&e))?
    };
    ModelText::new(&text, path(args)).map_err(|e| Failure::diagnostics(&e))
}

fn read(registry: &Registry, args: &args::ModelArguments) -> Result<Model, Failure> {
    model_text(args)?.read(registry, &args.set).map_err(|e| Failure::diagnostics(&e))
}

/// The case of that name, or the last.
fn case(model: &Model, name: Option<&str>) -> Result<usize, Failure> {
    let Some(name) = name else {
        let last = model.cases.len().checked_sub(1);
        return last.ok_or_else(|| Failure::input("the model has no case", None));
    };
    model.case(name).ok_or_else(|| {
        let help = text::names_help(name, "cases", model.cases.iter().map(|c| c.name.as_str()));
        Failure::input(&format!("there is no case \"{name}\""), Some(&help))
    })
}

/// The solver of that name, built in or of another crate.
fn solver(model: &Model, case: usize, name: &str) -> Result<SolverKind, Failure> {
    model.solver(name, case).ok_or_else(|| {
        let help = text::names_help(name, "solvers", model.solver_names().into_iter());
        Failure::input(&format!("there is no solver `{name}`"), Some(&help))
    })
}

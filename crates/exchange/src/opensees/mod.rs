//! Scripts of OpenSees in Tcl (`.tcl`).
//!
//! A small Tcl of our own runs the script, without files, programs or time; what it asks of OpenSees is recorded as a
//! model. Sources: McKenna, Scott & Fenves 2010 and the command manual of OpenSees.

mod analysis;
mod args;
mod beams;
mod bearings;
mod commands;
mod damping;
pub mod export;
mod links;
mod loads;
mod materials;
mod nodes;
mod outputs;
pub mod peer;
mod recorder;
mod series;
mod tcl;

use crate::{Import, Options, Refused, Things};
use recorder::Recorder;
use std::sync::Arc;
use tcl::{Call, Host, Reply};
use trilith_model::{Diagnostic, Source};

/// What a result stands for that is not there yet.
const UNKNOWN: &str = "unknown result of";

/// Who answers what a script asks of its model while it is read.
pub trait Eigenvalues {
    /// The lowest squares of circular frequencies of a model file, at the end of one of its static cases or at rest.
    ///
    /// # Errors
    /// Why the model has none.
    fn eigenvalues(
        &self,
        model: &str,
        after: Option<&str>,
        count: usize,
    ) -> Result<Vec<f64>, String>;
}

/// Nobody answers: a script that asks for modes is refused.
pub struct NoAnswers;

impl Eigenvalues for NoAnswers {
    fn eigenvalues(&self, _: &str, _: Option<&str>, _: usize) -> Result<Vec<f64>, String> {
        Err("nobody is there to find them".into())
    }
}

/// Reads a script of OpenSees.
///
/// # Errors
/// The first error of the script, at its place: what is no Tcl, no number, no node, a loop that does not end.
pub fn import(
    bytes: &[u8],
    options: &Options,
    oracle: &(dyn Eigenvalues + Sync),
) -> Result<Import, Refused> {
    run(bytes, options, oracle, false).map(|(import, _)| import)
}

/// The same, with the commands of OpenSees that the script gives: each with its words as they have been evaluated, in their
/// order, without blocks, whose commands follow.
///
/// # Errors
/// As [`import`].
pub fn with_commands(
    bytes: &[u8],
    options: &Options,
    oracle: &(dyn Eigenvalues + Sync),
) -> Result<(Import, Vec<Vec<String>>), Refused> {
    run(bytes, options, oracle, true)
}

/// `keep`: the commands as well.
fn run(
    bytes: &[u8],
    options: &Options,
    oracle: &(dyn Eigenvalues + Sync),
    keep: bool,
) -> Result<(Import, Vec<Vec<String>>), Refused> {
    let text = match std::str::from_utf8(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|b| char::from(*b)).collect(),
    };
    let source = Arc::new(Source { path: options.path.clone(), text, sha256: String::new() });
    if let Some(at) = source.text.find('\0') {
        let error = Diagnostic::new("E1000", "a zero byte: this is no text", at..at + 1, &source);
        return Err(Refused(vec![error.help("save the file as text, in UTF-8")]));
    }
    // Bodies within bodies need a stack of their own.
    let read = std::thread::scope(|scope| {
        let run = || read(&source, options, oracle, keep);
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, run);
        thread.map(|t| t.join())
    });
    match read {
        Ok(Ok(out)) => out,
        _ => {
            let error = Diagnostic::new("E1105", "the script could not be run", 0..0, &source);
            Err(Refused(vec![error]))
        }
    }
}

/// Stack of the interpreter, in bytes.
const STACK: usize = 256 << 20;

fn read(
    source: &Arc<Source>,
    options: &Options,
    oracle: &dyn Eigenvalues,
    keep: bool,
) -> Result<(Import, Vec<Vec<String>>), Refused> {
    let mut recorder = Recorder::new(options, oracle);
    let (length, force) = options.units.clone().unwrap_or(("m".into(), "N".into()));
    recorder.draft.units = (length, force);
    let settings = tcl::Settings { folder: options.folder.clone(), budget: options.budget };
    let mut heard = Heard { recorder: &mut recorder, keep, commands: Vec::new() };
    let run = tcl::Interpreter::new(Arc::clone(source), settings, &mut heard).run();
    run.map_err(|e| Refused(vec![*e]))?;
    let commands = heard.commands;
    let refused = |message: &str, help: &str| {
        Err(Refused(vec![Diagnostic::new("E1106", message, 0..0, source).help(help)]))
    };
    if recorder.draft.nodes.is_empty() {
        return refused(
            "the script makes no nodes",
            "`model BasicBuilder -ndm 2 -ndf 3`, then `node 1 0 0`",
        );
    }
    recorder.changed();
    finish(&mut recorder, options);
    if let Some(name) = recorder.draft.beyond() {
        return refused(
            &format!("a number of \"{name}\" is beyond all bounds"),
            "coordinates and properties of that size are no model",
        );
    }
    if let Some(only) = &options.case {
        let names: Vec<String> = recorder.draft.cases.iter().map(|c| c.0.clone()).collect();
        let Some(at) = names.iter().position(|n| n == only) else {
            return refused(
                &format!("there is no case \"{only}\""),
                &format!("the cases are {}", names.join(", ")),
            );
        };
        // Each case continues the one before it.
        recorder.draft.cases.truncate(at + 1);
    }
    let Recorder { draft, mut report, files, .. } = recorder;
    report.things = Things::Commands;
    Ok((Import::new(draft, report, files, options, "OpenSees"), commands))
}

/// A recorder, and what it has been told.
struct Heard<'h, 'r> {
    recorder: &'h mut Recorder<'r>,
    keep: bool,
    commands: Vec<Vec<String>>,
}

impl Host for Heard<'_, '_> {
    fn call(&mut self, call: &Call<'_>, line: &str) -> Reply {
        let reply = self.recorder.call(call, line);
        let words = call.words.len() - usize::from(matches!(reply, Reply::Block(_)));
        if self.keep && !matches!(reply, Reply::Unknown | Reply::Wrong(..)) {
            let words = call.words[..words].iter().map(|word| word.str().to_owned());
            self.commands.push(words.collect());
        }
        reply
    }

    fn closed(&mut self) {
        self.recorder.closed();
    }

    fn left_out(&mut self, command: &str, what: &str, line: &str) {
        self.recorder.left_out(command, what, line);
    }

    fn names(&self) -> Vec<&'static str> {
        self.recorder.names()
    }
}

fn finish(recorder: &mut Recorder<'_>, options: &Options) {
    if options.units.is_none() {
        let what = "a script has no units: its numbers are written as m, N, kg and s (`--units in,kip` says others)";
        recorder.report.otherwise("the script", what, "");
    }
    recorder.write_damping();
    let mut draft = std::mem::take(&mut recorder.draft);
    // Names and positions of nodes are asked for while masses are written.
    recorder.draft.nodes = draft.nodes.clone();
    recorder.write_masses(&mut draft);
    recorder.write_loads(&mut draft);
    let file =
        options.path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let stem = options.path.file_stem().map(|n| n.to_string_lossy().into_owned());
    draft.title = stem.unwrap_or_default();
    draft.head = vec![
        format!("From {file} by `trilith import`."),
        format!("What was lost or is said otherwise: {}.import.txt", options.stem),
    ];
    recorder.settle();
    if draft.elements.iter().all(|(_, e)| e.name() == "Mass") {
        recorder.report.lose(
            "the script",
            "no element can be written: nothing is left that runs",
            "",
        );
    }
    if draft.cases.is_empty() {
        recorder.report.otherwise(
            "analyze",
            "no analysis is there: a case without loads stands for it",
            "",
        );
        let block = crate::ron::Ron::block("Dynamic").with("duration", 1.0).with("dt", 0.1);
        draft.cases.push(("no loads".into(), block));
    }
    recorder.draft = draft;
}

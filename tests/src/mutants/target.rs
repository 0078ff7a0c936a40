//! What reads a file.

use crate::{registry, root};
use serde_json::Value;
use trilith::RunOptions;
use trilith::exercise::{Coordinate, History};
use trilith::model::{Analysis, Model, quantity};
use trilith::record::{ReadOptions, parse};
use trilith::report::{RunData, run_page};
use trilith_element::dimension::LENGTH;
use trilith_exchange::{Import, Options, Refused, etabs, opensees, sap2000};
use trilith_model::{Diagnostic, read_matrix, read_text};
use trilith_solvers::{EndState, assemble};
use trilith_study::Study;

/// A reader of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Of a model, with what `trilith check` makes of it.
    Model,
    /// Of a model, whose last case is then run.
    Run,
    /// Of a model in JSON.
    Json,
    /// Of a file that a model includes: sections and materials.
    Sections,
    /// Of the table of a function of time that a model names.
    Table,
    /// Of a study and its model.
    Study,
    /// Of an acceleration record.
    Record,
    /// Of a text model of SAP2000, and of the model that comes of it.
    Import,
    /// Of a text model of ETABS, and of the model that comes of it.
    Etabs,
    /// Of a script of OpenSees in Tcl, and of the model that comes of it.
    Script,
    /// Of a matrix: Matrix Market.
    Market,
    /// Of a matrix: an archive of NumPy's.
    Npz,
    /// Of a matrix: `DMIG` entries.
    Dmig,
    /// Of a matrix: OUTPUT4.
    Op4,
    /// Of a matrix: what CalculiX stores.
    Calculix,
    /// Of a checkpoint, behind its checksum.
    Checkpoint,
    /// Of the data of a report, behind their checksum, with the page of them.
    Report,
    /// Of a history that a link is led along.
    History,
    /// Of a quantity on the command line.
    Quantity,
}

impl Target {
    /// All readers.
    pub const ALL: [Self; 18] = [
        Self::Model,
        Self::Run,
        Self::Json,
        Self::Sections,
        Self::Table,
        Self::Study,
        Self::Record,
        Self::Import,
        Self::Etabs,
        Self::Script,
        Self::Market,
        Self::Npz,
        Self::Dmig,
        Self::Op4,
        Self::Calculix,
        Self::Checkpoint,
        Self::Report,
        Self::History,
    ];

    /// Reads; true where the file is let through.
    ///
    /// # Errors
    /// Where something is let through that is not a number, or an error has no place.
    pub(super) fn read(self, bytes: &[u8]) -> Result<bool, &'static str> {
        let text = || String::from_utf8_lossy(bytes);
        match self {
            Self::Model => Ok(model(&text(), MODEL)?.is_some()),
            Self::Json => Ok(model(&text(), "models/mutant.json")?.is_some()),
            Self::Sections => beside(bytes, "sections.ron", INCLUDING),
            Self::Table => beside(bytes, "table.csv", FOLLOWING),
            Self::Run => match model(&text(), MODEL)? {
                Some(model) => run(&model),
                None => Ok(false),
            },
            Self::Study => {
                let path = root().join("models/studies/mutant.ron");
                let study = Study::read_text(&text(), path, &registry(), &[]);
                study.map_or_else(|all| placed(&all), |_| Ok(true))
            }
            Self::Record => {
                let Ok(records) = parse(bytes, "mutant", &ReadOptions::default()) else {
                    return Ok(false);
                };
                let mut values = records.iter().flat_map(|r| &r.acceleration);
                if values.any(|a| !a.is_finite()) { Err("an acceleration") } else { Ok(true) }
            }
            Self::Import => imported(sap2000::import(bytes, &Options::default())),
            Self::Etabs => imported(etabs::import(bytes, &Options::default())),
            Self::Script => {
                let options = Options { budget: COMMANDS, ..Options::default() };
                imported(opensees::import(bytes, &options, &opensees::NoAnswers))
            }
            Self::Market => matrix(bytes, "mutant.mtx"),
            Self::Npz => matrix(bytes, "mutant.npz"),
            Self::Dmig => matrix(bytes, "mutant.pch"),
            Self::Op4 => matrix(bytes, "mutant.op4"),
            Self::Calculix => matrix(bytes, "mutant.sti"),
            Self::Checkpoint => Ok(serde_json::from_slice::<EndState>(bytes).is_ok()),
            Self::Report => {
                let Ok(data) = serde_json::from_slice::<RunData>(bytes) else { return Ok(false) };
                Ok(!run_page(&Value::Null, &data, &Value::Null).is_empty())
            }
            Self::History => {
                let u1 = Coordinate { name: "U1".into(), rotation: false };
                let Ok(history) = History::parse(&text(), &[u1]) else { return Ok(false) };
                let all = history.time.iter().chain(&history.deformation[0]);
                if all.copied().all(f64::is_finite) { Ok(true) } else { Err("a history") }
            }
            Self::Quantity => match quantity(&text(), LENGTH) {
                Ok(x) if !x.is_finite() => Err("a quantity"),
                answer => Ok(answer.is_ok()),
            },
        }
    }
}

/// Where a spoiled model would lie.
const MODEL: &str = "models/mutant.ron";
/// Commands that a script may run.
const COMMANDS: u64 = 20_000;

/// A model that takes in the file beside it.
const INCLUDING: &str = r#"(
    include: ["sections.ron"],
    nodes: { "a": (0, 0, 0), "b": (0, 0, 3) },
    supports: { "a": Fixed },
    elements: { "m": Mass(node: "b", mass: "1 t"), "c": Beam(nodes: ("a", "b"), use: "IPE 300") },
    cases: { "gravity": Static(loads: [Gravity]) },
)"#;

/// A model whose function of time is the file beside it.
const FOLLOWING: &str = r#"(
    nodes: { "a": (0, 0, 0) },
    supports: { "a": (Uy, Uz, Rx, Ry, Rz) },
    elements: { "m": Mass(node: "a", mass: "1 t"), "s": Spring(node: "a", k1: "1 kN/m", axis1: (1, 0, 0)) },
    functions: { "f": Table(file: "table.csv", value: "U1", after_end: Zero) },
    loads: { "push": [(node: "a", dof: Ux, force: "1 kN")] },
    cases: { "push": Dynamic(duration: 1, dt: 0.1, forces: [(load: "push", function: "f")]) },
)"#;

/// A model with the file beside it, in a folder of this process.
fn beside(bytes: &[u8], name: &str, text: &str) -> Result<bool, &'static str> {
    let thread = format!("{:?}", std::thread::current().id());
    let number: String = thread.chars().filter(char::is_ascii_digit).collect();
    let folder = format!("trilith-mutants-{}-{number}", std::process::id());
    let folder = std::env::temp_dir().join(folder);
    let written =
        std::fs::create_dir_all(&folder).and_then(|()| std::fs::write(folder.join(name), bytes));
    let read = written.map(|()| read_text(text, folder.join("model.ron"), &registry(), &[]));
    // Whatever came of it, nothing stays.
    let gone = std::fs::remove_dir_all(&folder);
    match read {
        Ok(Ok(_)) => gone.map(|()| true).map_err(|_| "a folder that stays"),
        Ok(Err(all)) => placed(&all),
        Err(_) => Err("a folder that cannot be written"),
    }
}

/// False where a file was refused as it should be: with reasons that stand in it.
fn placed(all: &[Diagnostic]) -> Result<bool, &'static str> {
    let within = |d: &Diagnostic| {
        let (text, span) = (&d.source.text, &d.span);
        span.start <= span.end
            && span.end <= text.len()
            && text.is_char_boundary(span.start)
            && text.is_char_boundary(span.end)
    };
    if all.is_empty() {
        return Err("a refusal without a reason");
    }
    if all.iter().any(|d| d.code == "E1105") {
        return Err("a script that breaks its interpreter");
    }
    let good = all.iter().all(|d| within(d) && !d.message.is_empty());
    if good { Ok(false) } else { Err("an error outside of its file") }
}

/// A model that came of a file of another program.
fn imported(import: Result<Import, Refused>) -> Result<bool, &'static str> {
    match import {
        Ok(import) => Ok(model(&import.draft.to_ron(), MODEL)?.is_some()),
        Err(refused) => placed(&refused.0),
    }
}

/// A matrix by itself.
fn matrix(bytes: &[u8], name: &str) -> Result<bool, &'static str> {
    match read_matrix(bytes, name) {
        Ok(a) => {
            let inside = |(i, j, x): &(u32, u32, f64)| {
                (*i as usize) < a.size && (*j as usize) < a.size && x.is_finite()
            };
            if a.entries.iter().all(inside) { Ok(true) } else { Err("an entry of a matrix") }
        }
        Err(e) if e.message.is_empty() || e.file.is_empty() => Err("a refusal without a reason"),
        Err(_) => Ok(false),
    }
}

/// A model as `trilith check` lets it through.
fn model(text: &str, path: &str) -> Result<Option<Model>, &'static str> {
    let model = match read_text(text, root().join(path), &registry(), &[]) {
        Ok(model) => model,
        Err(all) => return placed(&all).map(|_| None),
    };
    let Ok(system) = assemble(&model) else { return Ok(None) };
    for (matrix, place) in [(&system.stiffness, "a stiffness"), (&system.mass, "a mass")] {
        if matrix.entries().any(|(_, _, x)| !x.is_finite()) {
            return Err(place);
        }
    }
    let is_static = |a: &Analysis| matches!(a, Analysis::Static(_));
    for with_mass in [false, true] {
        if model.cases.iter().any(|c| is_static(&c.analysis) != with_mass)
            && system.check_supported(&model, with_mass).is_err()
        {
            return Ok(None);
        }
    }
    Ok(Some(model))
}

/// Substeps that a run may take.
const WORK: usize = 500;

/// Runs the last case, within its budget; true where it came to its end.
fn run(model: &Model) -> Result<bool, &'static str> {
    let Some(case) = model.cases.len().checked_sub(1) else { return Ok(false) };
    let Ok(analysis) = trilith::Analysis::new(model) else { return Ok(false) };
    let options = RunOptions { case, substeps: Some(WORK), ..RunOptions::default() };
    let Ok(run) = analysis.without_histories().run(options) else { return Ok(false) };
    let good = run.result.status.is_good();
    let mut peaks = run.record.peaks().iter().flat_map(|p| [p.max, p.min, p.last]);
    let finite = peaks.all(f64::is_finite);
    if good && !finite { Err("a result") } else { Ok(good) }
}

//! `cargo benchmark`: what a run costs.

use clap::{Args, Parser, Subcommand};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use trilith::SolverKind;
use trilith_bench::report::{self, Results};
use trilith_bench::{
    BlockSweep, Effort, Endurance, Measurement, Programs, SIZES, Size, Subject, Task, WHOLE,
    block_beside, child, commands, endure, export, find, grow, measure, program, side_by_side,
    sweep_block,
};

/// Measures what runs of Trilith cost: a frame on isolators in six sizes, growth, long runs, other
/// programs beside it, a sweep of a block. Writes report.html and results.json under target/benchmark.
#[derive(Parser)]
#[command(name = "benchmark", max_term_width = 100, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    suite: Suite,
}

#[derive(Subcommand)]
enum Command {
    /// Measure one frame under one solver and print it as JSON
    One(One),
    /// Run one frame for long and print its memory as JSON
    Long(One),
    /// Print the model of a frame as plain numbers for other programs
    Export(Part),
    /// Sweep a rigid block through many parameters and print what it costs as JSON
    Block,
}

#[derive(Args)]
struct Suite {
    /// Frames [default: P1e2 P1e3 P1e4s P1e4]
    #[arg(value_parser = size)]
    sizes: Vec<&'static Size>,
    /// All six frames, growth, the run of an hour and the sweep
    #[arg(long, conflicts_with = "sizes")]
    all: bool,
    /// Solvers
    #[arg(long, value_parser = solver, value_delimiter = ',', default_value = "fna,hht")]
    solvers: Vec<SolverKind>,
    /// Vectors of FNA [default: 24, 96, 96, 200, 160, 200 by size]
    #[arg(long)]
    vectors: Option<usize>,
    /// Steps [default: 4000, the whole motion; fewer for direct integration of the two largest]
    #[arg(long)]
    steps: Option<usize>,
    /// Show how the cost grows as well
    #[arg(long)]
    growth: bool,
    /// Run the smallest frame for an hour of motion as well
    #[arg(long)]
    hour: bool,
    /// Sweep a rigid block through many parameters as well, by the library and by the program
    #[arg(long)]
    sweep: bool,
    /// A Python with OpenSeesPy: runs both programs in turn, nothing else
    #[arg(long, value_name = "PYTHON")]
    peers: Option<PathBuf>,
    /// Put the tables into the marked block of this file, such as README.md
    #[arg(long, value_name = "FILE")]
    update: Option<PathBuf>,
    /// How often both programs run in turn, at least
    #[arg(long, default_value_t = 3)]
    pairs: usize,
}

#[derive(Args)]
struct Part {
    /// Frame
    #[arg(value_parser = size)]
    size: &'static Size,
    /// Steps
    #[arg(long, default_value_t = WHOLE)]
    steps: usize,
    /// Where the motion starts, s
    #[arg(long, default_value_t = 0.0)]
    offset: f64,
}

#[derive(Args)]
struct One {
    #[command(flatten)]
    part: Part,
    /// Solver
    #[arg(long, value_parser = solver)]
    solver: SolverKind,
    /// Vectors of FNA
    #[arg(long)]
    vectors: Option<usize>,
    /// Fixed steps in an output step of 5 ms
    #[arg(long, default_value_t = 1)]
    substeps: usize,
    /// Most runs behind a median
    #[arg(long, default_value_t = Effort::default().runs)]
    runs: usize,
}

impl One {
    fn task(&self) -> Task {
        let Part { steps, offset, .. } = self.part;
        Task { solver: self.solver, vectors: self.vectors, steps, substeps: self.substeps, offset }
    }
}

fn size(text: &str) -> Result<&'static Size, String> {
    find(text).ok_or_else(|| format!("one of {} is wanted", SIZES.map(|s| s.name).join(", ")))
}

fn solver(text: &str) -> Result<SolverKind, String> {
    let names = || SolverKind::ALL.map(SolverKind::name).join(", ");
    let found = SolverKind::ALL.into_iter().find(|s| s.name() == text);
    found.ok_or_else(|| format!("one of {} is wanted", names()))
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match &arguments.command {
        Some(Command::One(one)) => one_json(one),
        Some(Command::Long(one)) => long_json(one),
        Some(Command::Export(part)) => export_json(part),
        Some(Command::Block) => print(&sweep_block(SIDE)),
        None => suite(&arguments.suite),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::from(2)
        }
    }
}

fn print(value: &impl serde::Serialize) -> Result<bool, String> {
    println!("{}", serde_json::to_string(value).map_err(|e| e.to_string())?);
    Ok(true)
}

fn one_json(one: &One) -> Result<bool, String> {
    let size = one.part.size;
    let effort = Effort { runs: one.runs, ..Effort::default() };
    print(&measure(size.name, &size.frame().to_ron(), one.task(), effort)?)
}

fn long_json(one: &One) -> Result<bool, String> {
    let size = one.part.size;
    print(&endure(size.name, &size.frame().to_ron(), one.task())?)
}

fn export_json(part: &Part) -> Result<bool, String> {
    let Part { size, steps, offset } = *part;
    let task = Task { solver: SolverKind::Hht, vectors: None, steps, substeps: 1, offset };
    print(&export(&Subject::new(&size.frame().to_ron(), task)?)?)
}

/// Frictions, and amplitudes, of the sweep.
const SIDE: usize = 8;

/// An hour at 5 ms.
const HOUR: usize = 720_000;

fn suite(suite: &Suite) -> Result<bool, String> {
    let own = std::env::current_exe().map_err(|e| e.to_string())?;
    let folder = report::folder();
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let sizes: Vec<&Size> = match (&suite.sizes[..], suite.all) {
        (_, true) => SIZES.iter().collect(),
        ([], _) => SIZES[..4].iter().collect(),
        (chosen, _) => chosen.to_vec(),
    };
    // Asked for at once, before anything is measured.
    let trilith = if suite.sweep || suite.all { Some(program(&own)?) } else { None };
    let mut results = Results::default();
    if let Some(python) = &suite.peers {
        for size in sizes {
            eprintln!("{} beside OpenSees …", size.name);
            let programs = Programs { own: &own, python, folder: &folder, pairs: suite.pairs };
            results.peers.push(side_by_side(size, programs)?);
            finish(&folder, &results)?;
        }
        if suite.sweep || suite.all {
            eprintln!("the block beside OpenSees and Exudyn …");
            let programs = Programs { own: &own, python, folder: &folder, pairs: suite.pairs };
            results.blocks = block_beside(programs)?;
            finish(&folder, &results)?;
        }
    } else {
        for size in sizes {
            for solver in &suite.solvers {
                eprintln!("{} under {} …", size.name, solver.name());
                results.frames.push(frame(&own, suite, size, *solver)?);
            }
        }
        if suite.growth || suite.all {
            eprintln!("growth …");
            let threads = std::thread::available_parallelism().map_or(1, usize::from);
            results.growth = grow(threads.min(16))?;
        }
        if suite.hour || suite.all {
            eprintln!("an hour …");
            let words = ["long", SIZES[0].name, "--solver", "fna", "--steps", &HOUR.to_string()];
            results.endurance.push(child::json::<Endurance>(&own, &words.map(str::to_owned))?);
        }
        if suite.sweep || suite.all {
            eprintln!("a sweep …");
            results.sweep = Some(child::json::<BlockSweep>(&own, &["block".to_owned()])?);
        }
    }
    if let Some(trilith) = trilith {
        eprintln!("the program …");
        results.commands = Some(commands(&trilith, &folder)?);
    }
    finish(&folder, &results)?;
    if let Some(file) = &suite.update {
        report::update(file, &results)?;
    }
    print!("{}", results.text());
    println!("report: {}", folder.join("report.html").display());
    Ok(results.good())
}

fn finish(folder: &Path, results: &Results) -> Result<(), String> {
    report::write(folder, results)
        .map_err(|e| format!("the report cannot be written to {}: {e}", folder.display()))
}

/// In a process of its own.
fn frame(
    own: &Path,
    suite: &Suite,
    size: &Size,
    solver: SolverKind,
) -> Result<Measurement, String> {
    let usual = if solver == SolverKind::Hht { size.hht_steps } else { WHOLE };
    let steps = suite.steps.unwrap_or(usual).to_string();
    let mut words = ["one", size.name, "--solver", solver.name(), "--steps", &steps]
        .map(str::to_owned)
        .to_vec();
    if let Some(vectors) = suite.vectors {
        words.extend(["--vectors".to_owned(), vectors.to_string()]);
    }
    child::json(own, &words)
}

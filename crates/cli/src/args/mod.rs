//! Arguments of the program.

mod exchange;
mod generate;
mod modes;
mod reduce;
mod values;

use crate::figure_files::Format;
use crate::names::{self, Names};
use clap::{Args, Parser, Subcommand};
pub(crate) use exchange::{ExportArguments, ImportArguments, PeerArguments, ScriptArguments};
pub(crate) use generate::{FrameArguments, GenerateArguments, Generated};
pub(crate) use modes::{Combination, DirectionRule, LinksAs, ModesArguments};
pub(crate) use reduce::{ReduceArguments, Written};
use std::path::PathBuf;
use trilith_study::Shard;
pub(crate) use values::{Kept, pair};
use values::{alpha, assignment, count, factor, frequency, length, rocking, share, time};

/// Small finite-element models with nonlinear links: fast nonlinear analysis and direct integration.
#[derive(Parser)]
#[command(
    name = "trilith",
    version,
    long_version = trilith::LONG_VERSION,
    max_term_width = 100,
    arg_required_else_help = true
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
    /// Take the laws of a shared library as kinds of links (several times if need be); its code runs as the program's own
    #[arg(long, global = true, value_name = "LIBRARY")]
    pub laws: Vec<PathBuf>,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Write a model to begin with, or list those there are
    New(NewArguments),
    /// Run a case of a model and write its results
    Run(RunArguments),
    /// Run a model again whenever it is saved; its page follows
    Watch(WatchArguments),
    /// Validate a model and print it in figures, or with every default filled in
    Check(CheckArguments),
    /// Periods, participation and adequacy of the basis
    Modes(ModesArguments),
    /// Make a page with a model, or a study of one, and the engine in it: what is changed there runs again
    View(ViewArguments),
    /// The JSON Schema of models in JSON
    Schema,
    /// Tell an editor of errors in models, complete names and units, explain them: a language server on stdin and stdout
    Lsp,
    /// The kinds of elements, constraints and links, or the card of one
    Elements(ElementsArguments),
    /// Lead a link through a cyclic deformation and draw its loop
    Exercise(ExerciseArguments),
    /// Make the report of a run again from its folder
    Report(ReportArguments),
    /// Run the cases of the combinations of a model: sums and envelopes of their extremes
    Combine(CombineArguments),
    /// Run the same case under two or more solvers and show the differences
    Compare(CompareArguments),
    /// Run a study: a model with many values of its parameters, on all cores, into one table
    Sweep(SweepArguments),
    /// Exact derivatives of outputs by parameters of the model
    Gradient(GradientArguments),
    /// Values of parameters of the model that make a goal smallest, within limits
    Optimize(OptimizeArguments),
    /// Put a superelement of few rows in place of a part of a model (Craig–Bampton)
    Reduce(ReduceArguments),
    /// Make a model file from a few numbers
    Generate(GenerateArguments),
    /// Make a model file of a text model of SAP2000 or ETABS or a script of OpenSees, with a report of every loss
    Import(ImportArguments),
    /// Write a case as a script for OpenSees, with a report of what has no counterpart
    Export(ExportArguments),
    /// Find contact and rotational dashpots from coefficients of restitution
    Calibrate(CalibrateArguments),
    /// Intensities and spectra of ground motion records; synthetic motions
    Record(Box<crate::record::Arguments>),
    /// Print what lets a shell complete commands and options
    Completions {
        /// The shell: bash, elvish, fish, powershell or zsh
        shell: clap_complete::Shell,
    },
    /// Write a man page for each command; pages that are there are replaced
    Manual {
        /// Folder for the pages, such as `~/.local/share/man/man1`
        dir: PathBuf,
    },
}

#[derive(Args, Clone)]
pub(crate) struct ModelArguments {
    /// Model file: RON, or JSON by its ending; `-`: RON from standard input
    pub model: PathBuf,
    /// Give a parameter of the model another value, such as `mu=0.4` or `kn="2 MN/m"`
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
}

#[derive(Args)]
pub(crate) struct NewArguments {
    /// Name of the model [default: all are listed]
    pub template: Option<String>,
    /// Model file to write; records that it reads go beside it [default: its name in this folder]
    #[arg(long, value_name = "FILE", requires = "template")]
    pub out: Option<PathBuf>,
}

#[derive(Args)]
pub(crate) struct CheckArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Print the model instead: in SI, repetitions expanded, every default filled in; it reads back as a model
    #[arg(long)]
    pub resolved: bool,
}

#[derive(Args)]
pub(crate) struct ViewArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Case that the page begins with [default: the last of the file]
    #[arg(long)]
    pub case: Option<String>,
    /// Folder of the runs of a study; what it has not is run [default: out/NAME]
    #[arg(long, value_name = "DIR")]
    pub runs: Option<PathBuf>,
    /// Page to write [default: the name of the file with `.html`, in this folder]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Open the page in a browser
    #[arg(long)]
    pub open: bool,
    /// Engine for pages, a WebAssembly module [default: the one beside the program]
    #[arg(long, value_name = "FILE")]
    pub engine: Option<PathBuf>,
}

#[derive(Args, Clone)]
pub(crate) struct RunArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Case to run [default: the last of the file]
    #[arg(long)]
    pub case: Option<String>,
    /// Solver: fna, hht, ritz-hht or full-newton, or one of another crate [default: that of the case]
    #[arg(long)]
    pub solver: Option<String>,
    /// Output step, such as `10 ms` or 0.01 (seconds) [default: that of the case]
    #[arg(long, value_parser = time)]
    pub dt: Option<f64>,
    /// Folder for the results [default: out/<name of the model file>, and below it what was set, such as
    /// mu=0.4,solver=hht: by `--set`, `--case`, `--solver`, `--dt`, `--checkpoint-at` and `--restart`]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Links whose hysteresis loops the report shows; the option may come several times, and double quotes hold a
    /// name with a comma together, such as `'"stop, left"'` [default: those that dissipate most]
    #[arg(long, value_name = "LINK,LINK", value_parser = names::list)]
    pub loops: Vec<Names>,
    /// Lay a design spectrum over that of the ground motion: `EC8(ground: B, ag: "0.25 g")`, `ASCE7(sds: "1 g",
    /// sd1: "0.6 g", tl: "8 s")`, or a file with the columns `T [s],Sa [g]`
    #[arg(long, conflicts_with = "no_files")]
    pub spectrum: Option<String>,
    /// Write figures into the folder: of outputs and links by name, `energy`, `ground` (motion and its spectrum),
    /// `spectra` (of floors), `model` (where it has moved most); several times, and names with commas, as for `--loops`
    #[arg(long, value_name = "NAME,NAME", value_parser = names::list)]
    pub figure: Vec<Names>,
    /// What these figures are written as, such as `svg,png`
    #[arg(
        long,
        value_name = "FORMAT,FORMAT",
        value_delimiter = ',',
        default_value = "svg",
        requires = "figure"
    )]
    pub figure_format: Vec<Format>,
    /// Write no report (`report.html` and its data `report.json`)
    #[arg(long, conflicts_with = "loops")]
    pub no_report: bool,
    /// Open the report in a browser
    #[arg(long, conflicts_with_all = ["no_report", "no_files"])]
    pub open: bool,
    /// Write no files; no histories are kept then, and memory does not grow with the length of the run
    #[arg(long, conflicts_with_all = ["out", "checkpoint_at", "loops", "figure"])]
    pub no_files: bool,
    /// Stop at this time (s) and write `checkpoint.json` into the folder
    #[arg(long, value_name = "T", value_parser = time)]
    pub checkpoint_at: Option<f64>,
    /// Continue from a checkpoint of the same model and case
    #[arg(long, value_name = "FILE")]
    pub restart: Option<PathBuf>,
}

#[derive(Args)]
pub(crate) struct WatchArguments {
    #[command(flatten)]
    pub run: RunArguments,
}

#[derive(Args)]
pub(crate) struct ReportArguments {
    /// Folder of a run, with its `summary.json` and `report.json`
    pub dir: PathBuf,
}

#[derive(Args)]
pub(crate) struct CombineArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Combinations; several times if need be, and double quotes hold a name with a comma together [default: all]
    #[arg(long, value_name = "NAME,NAME", value_parser = names::list)]
    pub of: Vec<Names>,
    /// Folder for `combinations.csv` and `combinations.html`: every output of all cases and combinations
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Open the page in a browser
    #[arg(long, requires = "out")]
    pub open: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Args)]
pub(crate) struct GradientArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Case to run [default: the last of the file]
    #[arg(long)]
    pub case: Option<String>,
    /// Solver: fna, hht or ritz-hht [default: that of the case]
    #[arg(long)]
    pub solver: Option<String>,
    /// Output step, such as `10 ms` or 0.01 (seconds) [default: that of the case]
    #[arg(long, value_parser = time)]
    pub dt: Option<f64>,
    /// Parameters; several times if need be [default: all that are numbers other than zero and leave
    /// the times of the case as they are]
    #[arg(long, value_name = "NAME,NAME", value_parser = names::list)]
    pub by: Vec<Names>,
    /// Outputs; several times if need be, and double quotes hold a name with a comma together; `heat` is what all links
    /// have turned into heat until the end, `"heat of NAME"` what one link has, `input` what loads and moving supports have
    /// put in [default: all outputs]
    #[arg(long, value_name = "NAME,NAME", value_parser = names::list)]
    pub of: Vec<Names>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Args)]
pub(crate) struct OptimizeArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Case to run [default: the last of the file]
    #[arg(long)]
    pub case: Option<String>,
    /// Solver: fna, hht or ritz-hht [default: that of the case]
    #[arg(long)]
    pub solver: Option<String>,
    /// Output step, such as `10 ms` or 0.01 (seconds) [default: that of the case]
    #[arg(long, value_parser = time)]
    pub dt: Option<f64>,
    /// Parameters and their bounds, such as `mu=0.02..0.2` or `"c1=10 kN*s/m..2 MN*s/m"`; `c*` stands for all parameters
    /// whose names begin so, ` log` behind the bounds for steps that are shares of the value; several times if need be
    #[arg(long, value_name = "NAME=LOW..HIGH", value_delimiter = ',', required = true)]
    pub by: Vec<trilith::optimize::Variable>,
    /// What is made smallest: an output, which stands for its largest magnitude, or an expression such as
    /// `"roof + 0.1*base"`; of several, with commas between them, the largest. `drift*` stands for all outputs whose
    /// names begin so, `final(slide)` for a value at the end
    #[arg(long, visible_alias = "minimize", value_name = "GOAL", required = true)]
    pub minimise: Vec<String>,
    /// A limit on outputs or parameters, such as `"base_x <= 20 cm"` or `"c1 + c2 <= 3 MN*s/m"`; several times if need be
    #[arg(long, value_name = "LIMIT")]
    pub limit: Vec<String>,
    /// Runs at most
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = count)]
    pub max_runs: usize,
    /// Folder for `optimize.csv` with all runs and `optimize.json` with all that was found [default: no files]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Args)]
pub(crate) struct ElementsArguments {
    /// Kind to be shown in full
    pub name: Option<String>,
    /// Write the catalogue of all kinds: HTML with the loops of the links, or Markdown, by the ending
    #[arg(long, value_name = "FILE", conflicts_with = "name")]
    pub page: Option<PathBuf>,
}

#[derive(Args)]
pub(crate) struct ExerciseArguments {
    /// Kind of link; its parameters are those of the example on its card (`trilith elements KIND`)
    pub kind: String,
    /// Give a parameter of the link another value, such as `k="2 MN/m"`; `none` takes it away
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
    /// Amplitudes of the last cycle: one for each coordinate, such as `2 mm,0,1 mrad`, or by name, such as
    /// `U2=2 mm` [default: those of the card]
    #[arg(long, value_name = "AMPLITUDES", allow_hyphen_values = true)]
    pub amplitude: Option<String>,
    /// Constant parts of the deformation, given like amplitudes [default: those of the card]
    #[arg(long, value_name = "MEANS", allow_hyphen_values = true)]
    pub mean: Option<String>,
    /// Cycles in a second, such as `0.5 Hz` [default: that of the card]
    #[arg(long, value_parser = frequency)]
    pub frequency: Option<f64>,
    /// How many cycles, growing evenly
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub cycles: u16,
    /// Lead it along a measured history instead: comma-separated values whose first line names the columns, `t` and
    /// coordinates, with units, such as `t [s],U1 [mm]`
    #[arg(long, value_name = "FILE", conflicts_with_all = ["amplitude", "mean", "frequency", "cycles"])]
    pub history: Option<PathBuf>,
    /// Tell how long its answers take on this machine, alone and in the lanes of a study
    #[arg(long, conflicts_with = "history")]
    pub speed: bool,
    /// Folder for `loop.svg` and `path.csv` [default: out/exercise_<kind>]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write no files
    #[arg(long, conflicts_with = "out")]
    pub no_files: bool,
}

#[derive(Args)]
pub(crate) struct CompareArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Case to run [default: the last of the file]
    #[arg(long)]
    pub case: Option<String>,
    /// Solvers; differences are relative to the first variant [default: hht,fna, or that of the case where
    /// another list is given]
    #[arg(long, value_delimiter = ',')]
    pub solvers: Vec<String>,
    /// Output step, such as `10 ms` or 0.01 (seconds) [default: that of the case]
    #[arg(long, value_parser = time)]
    pub dt: Option<f64>,
    /// Several output steps in seconds, such as `0.01,0.005`
    #[arg(long, value_name = "DT,DT", value_parser = time, value_delimiter = ',', conflicts_with = "dt")]
    pub dts: Vec<f64>,
    /// Several sizes of the basis of FNA, such as `10,20,40`
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = count)]
    pub vectors: Vec<usize>,
    /// Several sizes of the dummies of FNA, as multiples of the stiffness of the engaged links, such as `0.001,0.1`
    #[arg(long, value_name = "K,K", value_parser = factor, value_delimiter = ',')]
    pub dummies: Vec<f64>,
    /// Several values of HHT's α, such as `0,-0.1`
    #[arg(long, value_name = "A,A", value_parser = alpha, value_delimiter = ',', allow_hyphen_values = true)]
    pub alphas: Vec<f64>,
    /// Do not look for the causes of differences, which takes several runs more
    #[arg(long)]
    pub no_cause: bool,
    /// Folder for `compare.html` with the histories over each other
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Open the page in a browser
    #[arg(long, requires = "out")]
    pub open: bool,
    #[command(flatten)]
    pub peer: PeerArguments,
}

#[derive(Args)]
pub(crate) struct SweepArguments {
    /// Study file (RON)
    pub study: PathBuf,
    /// Give a parameter of the model one value in all runs, in place of its axis if it has one
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
    /// Folder for the results; a study that was stopped goes on there [default: out/<name of the study file>]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Open the page of the study in a browser
    #[arg(long, conflicts_with_all = ["shard", "status", "dry_run"])]
    pub open: bool,
    /// Runs at the same time; the results are the same to the bit [default: one for each core]
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Write the figures of the study as files beside `study.html`, as `svg`, `png` or `svg,png`
    #[arg(long, value_name = "FORMAT,FORMAT", value_delimiter = ',')]
    pub figure_format: Vec<Format>,
    /// Run one part of several, such as `3/20`, in a folder that all machines see; parts need nothing of each other,
    /// in no order
    #[arg(long, value_name = "I/N", conflicts_with_all = ["gather", "figure_format"])]
    pub shard: Option<Shard>,
    /// Write the tables of what the parts have made, and run nothing
    #[arg(long)]
    pub gather: bool,
    /// Folder of finished runs that any study takes from and adds to: the same run of the same model by the same build of
    /// the program is made once, whatever the study around it
    #[arg(long, value_name = "DIR", conflicts_with_all = ["gather", "status", "dry_run"])]
    pub store: Option<PathBuf>,
    /// Tell how far the parts are
    #[arg(long, conflicts_with_all = ["gather", "shard", "retry_failed"])]
    pub status: bool,
    /// Run those once more that have failed
    #[arg(long, conflicts_with = "gather")]
    pub retry_failed: bool,
    /// Check the study and show what would be run
    #[arg(long, conflicts_with_all = ["gather", "shard", "status"])]
    pub dry_run: bool,
}

#[derive(Args)]
pub(crate) struct CalibrateArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Speed after over speed before a flat drop [default: the dashpots of the model]
    #[arg(long, value_name = "E", value_parser = share)]
    pub restitution: Option<f64>,
    /// Height of the drop that checks it, such as `1 m` or `149.7 in`
    #[arg(long, default_value = "1 m", value_parser = length)]
    pub height: f64,
    /// Uplift that a swing keeps: `housner` for rigid theory, or a number such as 0.57
    #[arg(long, value_name = "RATIO", value_parser = rocking)]
    pub rocking: Option<Kept>,
    /// Uplift of a corner that rocking starts from [default: a tenth of that of balance]
    #[arg(long, value_parser = length)]
    pub uplift: Option<f64>,
    /// Horizontal direction of the plane of motion: X or Y [default: that of a plane model, or X]
    #[arg(long, value_parser = ["X", "Y"], ignore_case = true)]
    pub along: Option<String>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }
}

//! Arguments of what goes from and to other programs.

use super::ModelArguments;
use super::values::{count, time, units};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
pub(crate) struct ImportArguments {
    /// Text model of SAP2000 (`.s2k` or `.$2k`) or ETABS (`.e2k` or `.$et`), or script of OpenSees (`.tcl`)
    pub file: PathBuf,
    /// Model file to write; the report of losses goes beside it as `<name>.import.txt`, records as CSV files
    /// [default: no files, the model is printed]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write one case with those that it continues, and give the model its damping
    #[arg(long)]
    pub case: Option<String>,
    /// Units of length and force of a script, such as `in,kip` [default: m,N]
    #[arg(long, value_name = "LENGTH,FORCE", value_parser = units)]
    pub units: Option<(String, String)>,
}

/// Programs that models are written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Program {
    /// OpenSeesPy
    Opensees,
}

/// How a model becomes a script.
#[derive(Args)]
pub(crate) struct ScriptArguments {
    /// Steps of OpenSees, which has no control of the error of a step, in an output step [default: 1, and 10 for a comparison]
    #[arg(long, value_name = "N", value_parser = count)]
    pub substeps: Option<usize>,
    /// Write the nearest law where none is the same; the report says what differs
    #[arg(long)]
    pub near: bool,
    /// Leave out what has no counterpart; the report names it
    #[arg(long)]
    pub leave_out: bool,
}

#[derive(Args)]
pub(crate) struct ExportArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Program that the script is for
    #[arg(long, value_name = "PROGRAM")]
    pub to: Program,
    /// Case to write, with those that it continues [default: the last of the file]
    #[arg(long)]
    pub case: Option<String>,
    /// Script to write, such as `model.py`; the files that it writes are named after it [default: it is printed]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub script: ScriptArguments,
}

#[derive(Args)]
pub(crate) struct PeerArguments {
    /// Run the case in another program as well: `opensees`, by a Python interpreter that has openseespy. Solvers here are
    /// hht unless `--solvers` names others
    #[arg(long, value_name = "PROGRAM", conflicts_with_all = ["dts", "vectors", "dummies", "alphas", "out"])]
    pub peer: Option<Program>,
    /// The Python interpreter [default: that of TRILITH_OPENSEES, `python3` or `python`]
    #[arg(long, value_name = "FILE", requires = "peer")]
    pub python: Option<PathBuf>,
    /// The longest that the other program may take, in seconds
    #[arg(long, value_name = "S", default_value_t = 600.0, value_parser = time, requires = "peer")]
    pub time_limit: f64,
    #[command(flatten)]
    pub script: ScriptArguments,
    /// Print JSON
    #[arg(long, requires = "peer")]
    pub json: bool,
}

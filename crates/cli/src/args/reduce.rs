//! Arguments of `trilith reduce`.

use super::ModelArguments;
use super::values::{frequency, modes};
use crate::names::{self, Names};
use clap::Args;
use std::path::PathBuf;
use trilith::reduce::FixedModes;

#[derive(Args)]
pub(crate) struct ReduceArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Linear elements, or groups of them, that the superelement stands for; `*` stands for anything, such as
    /// `'wall *'`; the option may come several times, and double quotes hold a name with a comma together
    #[arg(long, required = true, value_name = "NAME,NAME", value_parser = names::list)]
    pub part: Vec<Names>,
    /// Nodes, or groups of them, that are kept beside those that other elements, supports and initial values touch
    /// [default: those that loads and outputs name]
    #[arg(long, value_name = "NODE,NODE", value_parser = names::list)]
    pub keep: Vec<Names>,
    /// Nodes inside, or groups of them, that outputs, loads and links of the reduced model may name
    #[arg(long, value_name = "NODE,NODE", value_parser = names::list)]
    pub recover: Vec<Names>,
    /// All nodes inside
    #[arg(long, conflicts_with = "recover")]
    pub recover_all: bool,
    /// How many modes with the kept nodes held, or `all`
    #[arg(long, value_name = "N", value_parser = modes, required_unless_present = "up_to", conflicts_with = "up_to")]
    pub modes: Option<FixedModes>,
    /// All such modes up to a frequency, such as `30 Hz`
    #[arg(long, value_name = "FREQUENCY", value_parser = frequency)]
    pub up_to: Option<f64>,
    /// Folder for `model.ron` and the files that it reads
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// How matrices are written: for SciPy, Matrix Market, or Nastran's DMIG or OUTPUT4
    #[arg(long, value_enum, default_value = "npz")]
    pub format: Written,
    /// How many frequencies of both models are compared; 0: none
    #[arg(long, value_name = "N", default_value_t = 10)]
    pub compare: usize,
}

/// How matrices are written.
#[derive(Clone, Copy, clap::ValueEnum)]
pub(crate) enum Written {
    Npz,
    Mtx,
    Dmig,
    Op4,
}

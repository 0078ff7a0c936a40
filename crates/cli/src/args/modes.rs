//! Arguments of `trilith modes`.

use super::ModelArguments;
use super::values::{count, directions, length, share};
use crate::names::{self, Names};
use clap::Args;

#[derive(Args)]
pub(crate) struct ModesArguments {
    #[command(flatten)]
    pub model: ModelArguments,
    /// Case whose basis is shown, or from whose start links are taken [default: the last dynamic one]
    #[arg(long)]
    pub case: Option<String>,
    /// Count links with a stiffness: as stiff as they are when closed, sticking and elastic (`engaged`), by the tangents of
    /// their laws (`tangent`), or by secants of cycles with damping ratios (`secant`)
    #[arg(long)]
    pub links: Option<LinksAs>,
    /// State in which laws are asked: the end of this case, or `rest` [default: of the case that the chosen one continues]
    #[arg(long, value_name = "CASE", requires = "links")]
    pub after: Option<String>,
    /// Amplitude of the cycles of `--links secant`, such as `20 cm`: along U2 and U3 of every link that has them
    #[arg(long, value_name = "LENGTH", value_parser = length, required_if_eq("links", "secant"), requires = "links")]
    pub amplitude: Option<f64>,
    /// Links that are led through cycles; `*` stands for anything, such as `'bearing *'` [default: all with U2 or U3]
    #[arg(long, value_name = "LINK,LINK", value_parser = names::list, requires = "amplitude")]
    pub of: Vec<Names>,
    /// How many modes
    #[arg(long, default_value_t = 12, value_parser = count, requires = "links")]
    pub count: usize,
    /// Peaks of the outputs under a response spectrum: `EC8(ground: B, ag: "0.25 g")`, `ASCE7(sds: "1 g", sd1: "0.6 g",
    /// tl: "8 s")`, or a file of comma-separated values headed such as `T [s],Sa [g]`
    #[arg(long, value_name = "SPECTRUM", requires = "links")]
    pub spectrum: Option<String>,
    /// Directions of the ground, such as `x`, `x,y` or `x,y=0.85`
    #[arg(long, value_name = "DIRECTIONS", default_value = "x,y", value_parser = directions, requires = "spectrum")]
    pub along: [f64; 3],
    /// Damping ratio of the structure, to which that of cycles is added, such as `0.02`
    #[arg(long, value_name = "RATIO", default_value_t = 0.05, value_parser = share, requires = "spectrum")]
    pub damping: f64,
    /// How peaks of modes are put together
    #[arg(long, default_value = "cqc", requires = "spectrum")]
    pub combine: Combination,
    /// How peaks of directions are put together: root of the sum of squares, or one and 30 % of the others
    #[arg(long, default_value = "srss", requires = "spectrum")]
    pub directions: DirectionRule,
}

/// How links count in modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum LinksAs {
    Open,
    Engaged,
    Tangent,
    Secant,
}

/// How modes are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Combination {
    Cqc,
    Srss,
}

/// How directions are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum DirectionRule {
    Srss,
    Thirty,
}

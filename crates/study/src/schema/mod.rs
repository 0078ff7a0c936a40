//! What a study file may hold: blocks, their fields, defaults.
//!
//! As with models (`trilith::model::schema`), the reader takes the names from here, and the reference of the
//! guide is written from here. Fields whose name is a number stand at that position: `Above("slide", "10 cm")`.

mod kept;
mod runs;
mod shown;

pub use kept::{
    ABOVE, ALL, ANY, BELOW, CONDITIONS, DURATION, ENERGY, ENERGY_ERROR, FAILED, FINAL, MAX,
    MEASURES, MIN, MODE, MODES, OVERTURNED, PEAK, RESIDUAL_SLIP, RMS, SLIP, TIME_OF_PEAK, UPLIFT,
};
pub use runs::{
    AXES, DISTRIBUTIONS, ENSEMBLE, LOG, LOG_NORMAL, LOG_UNIFORM, NORMAL, RANGE, SAMPLES, STOP,
    UNIFORM,
};
pub use shown::{FIGURES, FRAGILITY, HAZARD, IDA, MODE_CHART, OVERTURNING, POINTS, SPREAD};
use trilith::SolverKind;
use trilith::element::Range::Positive;
use trilith::element::dimension as d;
use trilith::model::schema::Takes::{Choice, Count, List, Map, Name, Number, One, Text, Words};
use trilith::model::schema::{Block, Group, absent, groups_of, needed, plain};

/// Solvers as the command line names them.
pub static SOLVERS: [&str; 4] = {
    let all = SolverKind::ALL;
    [all[0].name(), all[1].name(), all[2].name(), all[3].name()]
};

/// The file.
pub static STUDY: Group = Group {
    name: "study",
    meaning: "The file is one block without a name.",
    blocks: &[&Block {
        name: "",
        meaning: "Which model, which values of its parameters, what is kept of a run, what is drawn.",
        example: r#"(model: "model.ron", axes: { "mu": [0.3, 0.6] })"#,
        fields: &[
            plain("title", Text, r#""""#, "Shown above results."),
            needed("model", Words("a path from the folder of the study"), "The model file."),
            absent("case", Name("case"), "the last of the model", "The dynamic case that runs."),
            absent(
                "combination",
                Name("combination"),
                "one case runs",
                "A combination of the model in place of a case: the cases that it needs run, each with its own solver, and `Peak`, `Max` and `Min` take its extremes.",
            ),
            absent("solver", Choice(&SOLVERS), "as the case says", "Solver of all runs."),
            absent(
                "set",
                Words("a map from parameters to values, as `--set` takes them"),
                "none",
                "Values that all runs have; `--set` on the command line comes first.",
            ),
            absent(
                "points",
                Words("a list of maps from parameters to values"),
                "one point",
                "Values point by point; every point sets the same parameters.",
            ),
            absent(
                "axes",
                Map(&AXES),
                "none",
                "A grid: every value of every axis with every other. A list `[value, …]` of numbers, expressions or texts (records) stands for an axis as well.",
            ),
            absent(
                "samples",
                One(&SAMPLES),
                "none",
                "Random values; every sample with every point of the grid.",
            ),
            absent("ensemble", One(&ENSEMBLE), "none", "Small deviations about every point."),
            plain(
                "seed",
                Count(0),
                "1",
                "Start of the random numbers, which hang on it and the name of the parameter alone.",
            ),
            absent(
                "stop",
                One(&STOP),
                "no run is left out",
                "Ends series of runs early, such as at collapse.",
            ),
            absent(
                "columns",
                Map(&MEASURES),
                "`peak_…` of every output",
                "Columns of the table. A text is an expression in parameters and columns before it, such as `\"tilt/balance\"`.",
            ),
            absent(
                "histories",
                One(&CONDITIONS),
                "none",
                "Runs whose histories are kept, in `runs/NNNNNN`.",
            ),
            absent("events", Map(&CONDITIONS), "none", "What is counted in `statistics.csv`."),
            absent(
                "over",
                Words("a list of names of axes"),
                "samples and ensemble",
                "Axes that statistics are taken over as well, such as the records.",
            ),
            plain(
                "sensitive_above",
                Number(d::NONE, Positive),
                "10",
                "A point counts as sensitive where its response scatters this many times as much as the parameters of its ensemble.",
            ),
            absent("figures", List(&FIGURES), "none", "Figures of `study.html`."),
        ],
    }],
};

/// All groups in the order in which a reader wants them.
#[must_use]
pub fn groups() -> Vec<&'static Group> {
    groups_of(&STUDY)
}

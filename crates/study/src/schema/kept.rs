//! What is kept of a run, and conditions on it.

use trilith::model::schema::Takes::{Choice, Name, One, Words};
use trilith::model::schema::{Block, Field, Group, needed};
use trilith::results::ENERGIES;

/// Modes of response.
pub static MODES: [&str; 5] = ["rest", "slide", "rock", "slide-rock", "flight"];

const OUTPUT: &[Field] = &[needed("1", Name("output"), "The output.")];
const LIMIT: &[Field] = &[
    needed("1", Name("column"), "The column."),
    needed("2", Words("a number in the dimension of the column"), "The limit."),
];

const fn of_output(name: &'static str, meaning: &'static str, example: &'static str) -> Block {
    Block { name, meaning, example, fields: OUTPUT }
}

const fn bare(name: &'static str, meaning: &'static str) -> Block {
    Block { name, meaning, example: name, fields: &[] }
}

/// Largest magnitude.
pub static PEAK: Block =
    of_output("Peak", "Largest magnitude of an output, in its unit.", r#"Peak("slide")"#);
/// Largest value.
pub static MAX: Block =
    of_output("Max", "Largest value of an output, in its unit.", r#"Max("slide")"#);
/// Smallest value.
pub static MIN: Block =
    of_output("Min", "Smallest value of an output, in its unit.", r#"Min("slide")"#);
/// Time of the peak.
pub static TIME_OF_PEAK: Block = of_output(
    "TimeOfPeak",
    "Time of the largest magnitude of an output, s.",
    r#"TimeOfPeak("slide")"#,
);
/// Value at the end.
pub static FINAL: Block = of_output(
    "Final",
    "Value of an output at the end of the run, in its unit.",
    r#"Final("slide")"#,
);
/// Root of the mean square.
pub static RMS: Block = of_output(
    "Rms",
    "Root of the mean square of an output over the run, in its unit.",
    r#"Rms("slide")"#,
);
/// Time above a limit.
pub static DURATION: Block = Block {
    name: "Duration",
    meaning: "Time during which an output is above a limit, s.",
    example: r#"Duration(output: "slide", above: "1 mm")"#,
    fields: &[
        needed("output", Name("output"), "The output."),
        needed("above", Words("a number in the dimension of the output"), "The limit."),
    ],
};
/// An energy at the end.
pub static ENERGY: Block = Block {
    name: "Energy",
    meaning: "An energy at the end of the run, J.",
    example: r#"Energy("input")"#,
    fields: &[needed("1", Choice(&ENERGIES), "Which.")],
};
/// Energy that is unaccounted for.
pub static ENERGY_ERROR: Block =
    bare("EnergyError", "Energy that is unaccounted for over the largest energy of the run.");
/// Largest uplift.
pub static UPLIFT: Block =
    bare("Uplift", "Largest uplift: how high any point of contact was above what it touches, m.");
/// Largest slip.
pub static SLIP: Block = bare("Slip", "Largest slip of a contact, m.");
/// Slip at the end.
pub static RESIDUAL_SLIP: Block = bare("ResidualSlip", "Slip of a contact at the end, m.");
/// What a column may be.
pub static MEASURES: Group = Group {
    name: "columns",
    meaning: "What is kept of each run. In a run that failed nothing is.",
    blocks: &[
        &PEAK,
        &MAX,
        &MIN,
        &TIME_OF_PEAK,
        &FINAL,
        &RMS,
        &DURATION,
        &ENERGY,
        &ENERGY_ERROR,
        &UPLIFT,
        &SLIP,
        &RESIDUAL_SLIP,
    ],
};

/// Every run.
pub static ALL: Block = bare("All", "Every run.");
/// A fall.
pub static OVERTURNED: Block = bare("Overturned", "A body has fallen over.");
/// A failure.
pub static FAILED: Block = bare("Failed", "The run did not come to a trusted end.");
/// Above a limit.
pub static ABOVE: Block = Block {
    name: "Above",
    meaning: "A column is above a limit; true of every run that overturned.",
    example: r#"Above("peak_slide", "10 cm")"#,
    fields: LIMIT,
};
/// Below a limit.
pub static BELOW: Block = Block {
    name: "Below",
    meaning: "A column is below a limit; true of no run that overturned.",
    example: r#"Below("peak_slide", "10 cm")"#,
    fields: LIMIT,
};
/// A mode of response.
pub static MODE: Block = Block {
    name: "Mode",
    meaning: "The mode of response over the whole run.",
    example: r#"Mode("slide")"#,
    fields: &[needed("1", Choice(&MODES), "The mode.")],
};
/// One of several.
pub static ANY: Block = Block {
    name: "Any",
    meaning: "One of several conditions, `Any(condition, condition, …)`.",
    example: r#"Any(Overturned, Above("peak_slide", "10 cm"))"#,
    fields: &[needed("1", One(&CONDITIONS), "The first; more may follow.")],
};
/// Conditions.
pub static CONDITIONS: Group = Group {
    name: "conditions",
    meaning: "A condition on a run.",
    blocks: &[&ALL, &OVERTURNED, &FAILED, &ABOVE, &BELOW, &MODE, &ANY],
};

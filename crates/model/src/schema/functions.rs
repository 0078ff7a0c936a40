//! Functions of time.

use super::Takes::{Choice, Count, Name, Number, Quantity, Text, Words};
use super::{Block, Field, Group, RECORD, SYNTHETIC, absent, needed, plain};
use crate::named::Named;
use crate::{AfterEnd, Interpolation};
use trilith_element::Range::{Any, Positive};
use trilith_element::dimension as d;

/// Interpolation of tables.
pub static INTERPOLATIONS: &[&str] = Interpolation::NAMES;
/// What holds after a table.
pub static AFTER_END: &[&str] = AfterEnd::NAMES;

/// What any function of another crate takes beside its card.
pub const AMPLITUDE: Field =
    needed("amplitude", Quantity, "Largest value; its unit is the unit of the function.");
const START: Field =
    plain("start", Number(d::TIME, Any), "0", "Time at which it begins; zero before.");
const INTERPOLATION: Field = plain(
    "interpolation",
    Choice(INTERPOLATIONS),
    "Linear",
    "Between samples: straight lines, or a natural cubic spline.",
);
const END: Field = plain(
    "after_end",
    Choice(AFTER_END),
    "Error",
    "After the last sample: no case may last longer, zero, or the last value.",
);
const FREQUENCY: Field = needed("frequency", Number(d::FREQUENCY, Positive), "Cycles per second.");
const HARMONIC: &[Field] = &[
    AMPLITUDE,
    FREQUENCY,
    absent(
        "cycles",
        Number(d::NONE, Positive),
        "no end",
        "Cycles after which it is zero; 0.5 is a half sine.",
    ),
    START,
    plain("phase", Number(d::NONE, Any), "0", "Phase at the start, an angle."),
];

/// Always the same.
pub static CONSTANT: Block = Block {
    name: "Constant",
    meaning: "The same value at all times; `Constant(3)` will do.",
    example: r#"Constant(value: "1 m/s^2")"#,
    fields: &[needed("value", Quantity, "The value.")],
};
/// On and off.
pub static STEP: Block = Block {
    name: "Step",
    meaning: "A value from a time on, or between two times.",
    example: r#"Step(amplitude: "1 m/s^2")"#,
    fields: &[
        AMPLITUDE,
        START,
        absent("end", Number(d::TIME, Any), "no end", "Time after which it is zero."),
    ],
};
/// Rising, then constant.
pub static RAMP: Block = Block {
    name: "Ramp",
    meaning: "A straight rise, then constant.",
    example: r#"Ramp(amplitude: "1 m/s^2", rise: "1 s")"#,
    fields: &[AMPLITUDE, START, needed("rise", Number(d::TIME, Positive), "Time of the rise.")],
};
/// Sine.
pub static SINE: Block = Block {
    name: "Sine",
    meaning: "amplitude · sin(2π frequency (t − start) + phase).",
    example: r#"Sine(amplitude: "1 m/s^2", frequency: "2 Hz")"#,
    fields: HARMONIC,
};
/// Cosine.
pub static COSINE: Block = Block {
    name: "Cosine",
    meaning: "amplitude · cos(2π frequency (t − start) + phase).",
    example: r#"Cosine(amplitude: "1 m/s^2", frequency: "2 Hz")"#,
    fields: HARMONIC,
};
/// Half sine.
pub static HALF_SINE: Block = Block {
    name: "HalfSine",
    meaning: "A single half wave.",
    example: r#"HalfSine(amplitude: "1 m/s^2", duration: "50 ms")"#,
    fields: &[
        AMPLITUDE,
        needed("duration", Number(d::TIME, Positive), "Length of the half wave."),
        START,
    ],
};
/// Ricker wavelet.
pub static RICKER: Block = Block {
    name: "Ricker",
    meaning: "Ricker wavelet: amplitude · (1 − 2a) e^(−a), a = (π frequency (t − center))².",
    example: r#"Ricker(amplitude: "1 m/s^2", frequency: "2 Hz")"#,
    fields: &[
        AMPLITUDE,
        FREQUENCY,
        plain("center", Number(d::TIME, Any), "0", "Time of the peak."),
    ],
};
/// Columns of a file.
pub static TABLE: Block = Block {
    name: "Table",
    meaning: "Two columns of a CSV file: time and value. Lines that begin with # are comments; a header row may name the columns.",
    example: r#"Table(file: "record.csv")"#,
    fields: &[
        needed(
            "file",
            Words(
                "a path from the folder of the model, or `Parameter(\"name\")` of a text parameter",
            ),
            "The file.",
        ),
        plain(
            "time",
            Words("a position, from 0, or the name of a column"),
            "0",
            "Column of times.",
        ),
        plain(
            "value",
            Words("a position, from 0, or the name of a column"),
            "1",
            "Column of values.",
        ),
        absent("unit", Text, "plain numbers", "Unit of the values."),
        plain("scale", Quantity, "1", "Factor of the values."),
        plain("skip", Count(0), "0", "Rows to skip at the top."),
        INTERPOLATION,
        END,
    ],
};
/// Points in the model file.
pub static POINTS: Block = Block {
    name: "Points",
    meaning: "Samples given in the model file.",
    example: r#"Points(points: [(0, "0 m/s^2"), ("1 s", "1 m/s^2")])"#,
    fields: &[
        needed("points", Words("a list of pairs `(time, value)`, times rising"), "The samples."),
        INTERPOLATION,
        END,
    ],
};
/// Another function times a factor.
pub static SCALED: Block = Block {
    name: "Scaled",
    meaning: "Another function times a factor.",
    example: r#"Scaled(function: "shake", factor: 2)"#,
    fields: &[
        needed("function", Name("function"), "The function."),
        needed("factor", Quantity, "The factor, with or without unit."),
    ],
};
/// Functions of time.
pub static FUNCTIONS: Group = Group {
    name: "functions",
    meaning: "Functions of time. The unit of the values decides where a function may be used.",
    blocks: &[
        &CONSTANT, &STEP, &RAMP, &SINE, &COSINE, &HALF_SINE, &RICKER, &TABLE, &POINTS, &SCALED,
        &RECORD, &SYNTHETIC,
    ],
};

//! Ground motion records, synthetic motions, floor spectra.

use super::Takes::{Choice, Count, Flag, Name, Number, One, Text, Words};
use super::{AFTER_END, Block, DIRECTIONS, Field, Group, absent, needed, plain};
use trilith_element::Range::{Any, Positive, Within};
use trilith_element::dimension as d;

/// Formats of records.
pub static FORMATS: [&str; 6] = ["AT2", "COSMOS", "CSMIP", "KNET", "ESM", "Columns"];
/// What a filter does with the zeros that it puts around a record.
pub static PADDINGS: [&str; 3] = ["None", "Strip", "Keep"];

/// Baselines.
pub static BASELINE: Group = Group {
    name: "baseline",
    meaning: "What is taken off the acceleration.",
    blocks: &[
        &Block { name: "Mean", meaning: "Its mean.", example: "Mean", fields: &[] },
        &Block { name: "Linear", meaning: "A straight line.", example: "Linear", fields: &[] },
        &POLYNOMIAL,
        &Block {
            name: "Rest",
            meaning: "What leaves the ground at rest at the end.",
            example: "Rest",
            fields: &[],
        },
    ],
};
/// A polynomial baseline.
pub static POLYNOMIAL: Block = Block {
    name: "Polynomial",
    meaning: "A polynomial.",
    example: "Polynomial(order: 2)",
    fields: &[needed("order", Count(0), "Its order, 20 at most.")],
};
/// Filters.
pub static FILTER: Group =
    Group { name: "filter", meaning: "Filter of a record.", blocks: &[&BUTTERWORTH] };
/// The filter of Butterworth.
pub static BUTTERWORTH: Block = Block {
    name: "Butterworth",
    meaning: "Butterworth filter; with both corners a band-pass.",
    example: r#"Butterworth(highpass: "0.2 Hz")"#,
    fields: &[
        absent(
            "highpass",
            Number(d::FREQUENCY, Positive),
            "for `lowpass` alone",
            "Corner below which motion is taken out.",
        ),
        absent(
            "lowpass",
            Number(d::FREQUENCY, Positive),
            "none",
            "Corner above which motion is taken out.",
        ),
        plain("order", Count(1), "4", "Order."),
        plain(
            "causal",
            Flag,
            "false",
            "Forward only; else forward and backward, without shift of phase.",
        ),
        plain(
            "padding",
            Choice(&PADDINGS),
            "Strip",
            "Zeros around the record: none, taken off again, or kept.",
        ),
    ],
};
const STEP: Field = needed("dt", Number(d::TIME, Positive), "The new step.");
/// Resampling.
pub static RESAMPLE: Group = Group {
    name: "resample",
    meaning: "Another time step; a time alone, as `\"5 ms\"`, is `BandLimited`.",
    blocks: &[
        &Block {
            name: "BandLimited",
            meaning: "Band-limited: frequencies that the new step cannot hold are taken out.",
            example: r#"BandLimited(dt: "20 ms")"#,
            fields: &[STEP],
        },
        &Block {
            name: "Linear",
            meaning: "Straight lines between samples.",
            example: r#"Linear(dt: "20 ms")"#,
            fields: &[STEP],
        },
    ],
};
const END: Field = plain(
    "after_end",
    Choice(AFTER_END),
    "Zero",
    "After the last sample: no case may last longer, zero, or the last value.",
);
const SCALE: Field = plain("scale", Number(d::NONE, Any), "1", "Factor.");

/// A record.
pub static RECORD: Block = Block {
    name: "Record",
    meaning: "An accelerogram in any of the known formats, processed in the order of the fields from `trim` to `scale`.",
    example: r#"Record(file: "record.csv", unit: "g")"#,
    fields: &[
        needed(
            "file",
            Words(
                "a path from the folder of the model, or `Parameter(\"name\")` of a text parameter",
            ),
            "The file.",
        ),
        absent(
            "component",
            Words("a number, from 1, or a name"),
            "the only one",
            "Component of a file with several.",
        ),
        absent("format", Choice(&FORMATS), "told from the file", "Format."),
        absent("unit", Text, "for files that say it", "Unit of the samples."),
        absent("dt", Number(d::TIME, Positive), "as the file says", "Time step."),
        absent("trim", Words("a pair `(from, to)` of times"), "none", "Part that is kept."),
        absent("baseline", One(&BASELINE), "none", "Baseline correction."),
        plain(
            "taper",
            Number(d::NONE, Within(0.0, 0.5)),
            "0",
            "Share of the record that is faded in and out.",
        ),
        absent("filter", One(&FILTER), "none", "Filter."),
        absent("resample", One(&RESAMPLE), "none", "Another time step."),
        absent(
            "scale_to",
            Number(d::ACCELERATION, Positive),
            "none",
            "Peak to which it is scaled.",
        ),
        SCALE,
        plain("start", Number(d::TIME, Any), "0", "Time of the first sample."),
        END,
    ],
};

/// Envelopes.
pub static ENVELOPE: Group = Group {
    name: "envelope",
    meaning: "Strength of a synthetic motion in time.",
    blocks: &[
        &Block {
            name: "Stationary",
            meaning: "The same all the time.",
            example: "Stationary",
            fields: &[],
        },
        &Block {
            name: "Jennings",
            meaning: "A parabolic rise, a strong phase, an exponential decay.",
            example: r#"Jennings(rise: "2 s", strong: "8 s", decay: "0.3 1/s")"#,
            fields: &[
                needed("rise", Number(d::TIME, Positive), "Time of the rise."),
                needed("strong", Number(d::TIME, Positive), "Time of the strong phase."),
                needed("decay", Number(d::FREQUENCY, Positive), "Rate of the decay."),
            ],
        },
        &Block {
            name: "SaragoniHart",
            meaning: "A smooth rise and fall.",
            example: "SaragoniHart",
            fields: &[
                plain(
                    "peak_at",
                    Number(d::NONE, Positive),
                    "0.2",
                    "Share of the duration at which it peaks.",
                ),
                plain(
                    "end",
                    Number(d::NONE, Positive),
                    "0.05",
                    "What is left of the peak at the end.",
                ),
            ],
        },
    ],
};
/// A synthetic motion.
pub static SYNTHETIC: Block = Block {
    name: "Synthetic",
    meaning: "A synthetic motion: white noise through the filters of Kanai, Tajimi, Clough and Penzien, under an envelope; or, with `spectrum`, brought to a response spectrum.",
    example: r#"Synthetic(seed: 1, peak: "0.3 g")"#,
    fields: &[
        needed("seed", Count(0), "Another seed is another motion."),
        plain("duration", Number(d::TIME, Positive), r#""20 s""#, "Length."),
        plain("dt", Number(d::TIME, Positive), r#""10 ms""#, "Time step."),
        absent(
            "peak",
            Number(d::ACCELERATION, Positive),
            "for `spectrum`",
            "Largest acceleration.",
        ),
        plain(
            "frequency",
            Number(d::FREQUENCY, Positive),
            r#""2.5 Hz""#,
            "Frequency of the ground.",
        ),
        plain(
            "damping",
            Number(d::NONE, Positive),
            "0.6",
            "Damping of the ground, share of critical.",
        ),
        plain(
            "highpass",
            Number(d::FREQUENCY, Positive),
            r#""0.25 Hz""#,
            "Frequency of the high-pass of Clough and Penzien.",
        ),
        plain("highpass_damping", Number(d::NONE, Positive), "0.6", "Its damping."),
        plain("envelope", One(&ENVELOPE), "SaragoniHart", "Strength in time."),
        absent(
            "spectrum",
            Words("a list of `(period, acceleration)`"),
            "none",
            "Response spectrum that the motion meets, in place of `peak`.",
        ),
        plain("spectrum_damping", Number(d::NONE, Positive), "0.05", "Damping of that spectrum."),
        SCALE,
        END,
    ],
};

/// Even steps of the logarithm.
pub static SERIES: Group = Group {
    name: "series",
    meaning: "Numbers in even steps of the logarithm; a list of numbers will do as well.",
    blocks: &[&Block {
        name: "",
        meaning: "From one number to another.",
        example: r#"(from: "1 Hz", to: "30 Hz")"#,
        fields: &[
            needed("from", Words("a period or a frequency"), "First."),
            needed("to", Words("a period or a frequency"), "Last."),
            plain("count", Count(2), "100", "How many."),
        ],
    }],
};
/// Floor spectra.
pub static SPECTRA: Group = Group {
    name: "spectra",
    meaning: "Response spectra of absolute accelerations of nodes; their curves are written into `spectra.csv`.",
    blocks: &[&Block {
        name: "",
        meaning: "The spectrum of one direction of a node.",
        example: r#"(node: "m", dof: Ux)"#,
        fields: &[
            needed("node", Name("node"), "The node."),
            needed("dof", Choice(&DIRECTIONS), "Direction, a translation."),
            plain(
                "damping",
                Words("a number or a list of numbers"),
                "0.05",
                "Damping of the oscillators.",
            ),
            absent("periods", One(&SERIES), "`frequencies`", "Their periods."),
            absent("frequencies", One(&SERIES), "100 from 0.2 Hz to 50 Hz", "Their frequencies."),
        ],
    }],
};

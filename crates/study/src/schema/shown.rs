//! Figures.

use super::CONDITIONS;
use trilith::element::Range::Within;
use trilith::element::dimension as d;
use trilith::model::schema::Takes::{Flag, Name, Number, One, Words};
use trilith::model::schema::{Block, Default, Field, Group, absent, needed, plain};

/// A column or a varied parameter that is a number.
const NUMBER: &str = "column or varied parameter";

const fn axis(name: &'static str, meaning: &'static str) -> Field {
    Field { name, takes: Name(NUMBER), default: Default::Required, meaning }
}

const INTENSITY: Field = axis("intensity", "Intensity of the motion, above 0.");
const DEMAND: Field = axis("demand", "What the motion does.");
const BY: Field =
    absent("by", Name(NUMBER), "all together", "A colour, or a curve, for each value of this.");

/// Modes of a rigid block.
pub static MODE_CHART: Block = Block {
    name: "ModeChart",
    meaning: "Response modes over friction and peak acceleration, with the closed forms of a rigid block.",
    example: r#"ModeChart(mu: "mu", acceleration: "ah", slenderness: "height/width")"#,
    fields: &[
        axis("mu", "Friction coefficient."),
        axis("acceleration", "Peak acceleration of the ground in g."),
        needed(
            "slenderness",
            Words("a pure number above 0, or an expression in parameters of the model"),
            "Height over width.",
        ),
    ],
};
/// Incremental dynamic analysis.
pub static IDA: Block = Block {
    name: "Ida",
    meaning: "Incremental dynamic analysis: intensity over demand, a line for each motion, with 16, 50 and 84 % fractiles.",
    example: r#"Ida(demand: "peak_slide", intensity: "ah")"#,
    fields: &[DEMAND, INTENSITY],
};
/// Fragility.
pub static FRAGILITY: Block = Block {
    name: "Fragility",
    meaning: "Share of runs in which something happens over intensity, with a lognormal curve by maximum likelihood and its confidence band.",
    example: r#"Fragility(intensity: "ah", event: Above("peak_slide", "1 mm"))"#,
    fields: &[
        INTENSITY,
        needed("event", One(&CONDITIONS), "What happens."),
        plain("confidence", Number(d::NONE, Within(0.5, 0.999)), "0.9", "Confidence of the band."),
        BY,
    ],
};
/// Overturning spectrum.
pub static OVERTURNING: Block = Block {
    name: "Overturning",
    meaning: "Survival and overturning over frequency and amplitude of a pulse.",
    example: r#"Overturning(frequency: "frequency", amplitude: "ah")"#,
    fields: &[
        axis("frequency", "Frequency of the pulse over that of the body, ω/p."),
        axis("amplitude", "Amplitude of the pulse over g tan α."),
        plain(
            "half_sine",
            Flag,
            "false",
            "Draws the closed form of the linearised block under a half sine as well.",
        ),
    ],
};
/// Hazard.
pub static HAZARD: Block = Block {
    name: "Hazard",
    meaning: "Probability that a demand is exceeded at each intensity, and how often in a year where `rates` is given.",
    example: r#"Hazard(demand: "peak_slide", intensity: "ah")"#,
    fields: &[
        DEMAND,
        INTENSITY,
        absent(
            "rates",
            Words("a list of pairs `(intensity, rate)`, rates in 1/year or with a unit"),
            "no rates",
            "Hazard curve: how often in a year each intensity is exceeded; intensities rise, rates fall.",
        ),
    ],
};
/// Medians and bands.
pub static SPREAD: Block = Block {
    name: "Spread",
    meaning: "Median and band of 16 % to 84 % of the runs of each point.",
    example: r#"Spread(x: "ah", y: "peak_slide")"#,
    fields: &[
        axis("x", "What distinguishes the points; may be a text."),
        axis("y", "What is shown."),
    ],
};
/// Marks.
pub static POINTS: Block = Block {
    name: "Points",
    meaning: "A mark for each run.",
    example: r#"Points(x: "ah", y: "peak_slide")"#,
    fields: &[axis("x", "Horizontal."), axis("y", "Vertical."), BY],
};
/// Figures.
pub static FIGURES: Group = Group {
    name: "figures",
    meaning: "Figures of the page.",
    blocks: &[&MODE_CHART, &IDA, &FRAGILITY, &OVERTURNING, &HAZARD, &SPREAD, &POINTS],
};

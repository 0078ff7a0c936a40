//! Which values the parameters take.

use super::CONDITIONS;
use trilith::element::Range::Positive;
use trilith::element::dimension as d;
use trilith::model::schema::Takes::{Count, Map, Name, Number, One, Quantity, Words};
use trilith::model::schema::{Block, Field, Group, absent, needed};

const FROM: Field = needed("from", Quantity, "First value.");
const TO: Field = needed("to", Quantity, "Last value.");
const LOWER: Field = needed("from", Quantity, "Lower end.");
const UPPER: Field = needed("to", Quantity, "Upper end.");
const CUT_BELOW: Field = absent("from", Quantity, "none", "Cut off below this.");
const CUT_ABOVE: Field = absent("to", Quantity, "none", "Cut off above this.");

/// Equal steps.
pub static RANGE: Block = Block {
    name: "Range",
    meaning: "Equal steps, both ends included.",
    example: r#"Range(from: 0.2, to: 0.8, count: 4)"#,
    fields: &[
        FROM,
        TO,
        absent("count", Count(1), "`step`", "Number of values."),
        absent(
            "step",
            Quantity,
            "`count`",
            "Distance of two values; a whole number of steps leads from one end to the other.",
        ),
    ],
};
/// Equal factors.
pub static LOG: Block = Block {
    name: "Log",
    meaning: "Equal factors from value to value, both ends included.",
    example: r#"Log(from: 0.1, to: 10, count: 5)"#,
    fields: &[FROM, TO, needed("count", Count(1), "Number of values.")],
};
/// Axes of a grid.
pub static AXES: Group = Group {
    name: "axes",
    meaning: "Values of a parameter one after the other.",
    blocks: &[&RANGE, &LOG],
};

/// Even.
pub static UNIFORM: Block = Block {
    name: "Uniform",
    meaning: "Even between two values.",
    example: "Uniform(from: 0.3, to: 0.7)",
    fields: &[LOWER, UPPER],
};
/// Even in the logarithm.
pub static LOG_UNIFORM: Block = Block {
    name: "LogUniform",
    meaning: "Even in the logarithm between two values above 0.",
    example: "LogUniform(from: 0.1, to: 1)",
    fields: &[LOWER, UPPER],
};
/// Normal.
pub static NORMAL: Block = Block {
    name: "Normal",
    meaning: "Normal; cut off outside `from` and `to` where they are given, the rest scaled up to 1.",
    example: "Normal(mean: 0.5, deviation: 0.1)",
    fields: &[
        needed("mean", Quantity, "Mean, before it is cut off."),
        needed("deviation", Quantity, "Standard deviation, before it is cut off; above 0."),
        CUT_BELOW,
        CUT_ABOVE,
    ],
};
/// Lognormal.
pub static LOG_NORMAL: Block = Block {
    name: "LogNormal",
    meaning: "The logarithm is normal; cut off outside `from` and `to` where they are given, the rest scaled up to 1.",
    example: "LogNormal(median: 0.5, dispersion: 0.2)",
    fields: &[
        needed("median", Quantity, "Median, before it is cut off; above 0."),
        needed(
            "dispersion",
            Number(d::NONE, Positive),
            "Standard deviation of the natural logarithm, before it is cut off.",
        ),
        CUT_BELOW,
        CUT_ABOVE,
    ],
};
/// Distributions.
pub static DISTRIBUTIONS: Group = Group {
    name: "distributions",
    meaning: "How a parameter is distributed.",
    blocks: &[&UNIFORM, &LOG_UNIFORM, &NORMAL, &LOG_NORMAL],
};

const DRAWN: &[Field] = &[
    needed("count", Count(1), "Number of samples, a million at most."),
    needed("of", Map(&DISTRIBUTIONS), "Parameters that are drawn, and how; independent."),
];
/// Random samples.
pub static SAMPLES: Group = Group {
    name: "samples",
    meaning: "Random values of several parameters.",
    blocks: &[
        &Block {
            name: "LatinHypercube",
            meaning: "One value in each of `count` parts of equal probability of every parameter, in random order.",
            example: r#"LatinHypercube(count: 2, of: { "mu": Uniform(from: 0.3, to: 0.7) })"#,
            fields: DRAWN,
        },
        &Block {
            name: "Random",
            meaning: "Independent draws.",
            example: r#"Random(count: 2, of: { "mu": Uniform(from: 0.3, to: 0.7) })"#,
            fields: DRAWN,
        },
    ],
};

/// Ensembles.
pub static ENSEMBLE: Group = Group {
    name: "ensemble",
    meaning: "Members about every point, to see whether a single run means anything.",
    blocks: &[&Block {
        name: "",
        meaning: "The first member is the nominal case; the parameters of the others are off by random factors.",
        example: r#"(members: 3, of: { "mu": 0.01 })"#,
        fields: &[
            needed(
                "members",
                Count(2),
                "Runs of a point, the nominal one included; a million at most.",
            ),
            needed(
                "of",
                Words("a map from parameters to dispersions, above 0"),
                "Standard deviation of the logarithm of the factor on each parameter; factors are lognormal with median 1, cut off at three dispersions.",
            ),
        ],
    }],
};

/// Series that stop.
pub static STOP: Group = Group {
    name: "stop",
    meaning: "Where a series of runs ends.",
    blocks: &[&Block {
        name: "",
        meaning: "Runs along an axis, in the order of its values, end with the first that meets a condition.",
        example: r#"(along: "ah", when: Overturned)"#,
        fields: &[
            needed("along", Name("axis"), "The axis."),
            needed("when", One(&CONDITIONS), "The condition."),
        ],
    }],
};

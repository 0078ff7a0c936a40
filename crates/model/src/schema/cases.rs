//! Cases: what acts, how long, how it is solved.

use super::Takes::{Choice, Count, Flag, List, Name, Number, One, Quantity};
use super::{Block, Field, Group, absent, needed, plain};
use crate::Kernel;
use crate::check::TOLERANCE as SHARE;
use crate::named::Named;
use trilith_element::Range::{Any, Positive, Within};
use trilith_element::dimension as d;

/// Directions of a node.
pub static DIRECTIONS: [&str; 6] = ["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"];
/// Directions of the base.
pub static BASE_DIRECTIONS: [&str; 6] = ["X", "Y", "Z", "Ux", "Uy", "Uz"];
/// Solvers.
pub static SOLVERS: [&str; 4] = ["Fna", "Hht", "RitzHht", "FullNewton"];
/// Ways to solve the link equations.
pub static KERNELS: &[&str] = Kernel::NAMES;

/// Own weight.
pub static GRAVITY: Block = Block {
    name: "Gravity",
    meaning: "The weight of all masses along −Z.",
    example: "Gravity",
    fields: &[plain("factor", Number(d::NONE, Any), "1", "Multiple of the weight.")],
};
/// A pattern of `loads`.
pub static LOAD: Block = Block {
    name: "",
    meaning: "A pattern of `loads`; its name alone will do where the factor is 1.",
    example: r#"(load: "push")"#,
    fields: &[
        needed("load", Name("load"), "The pattern."),
        plain("factor", Number(d::NONE, Any), "1", "Multiple of the pattern."),
    ],
};
/// Loads of a case.
pub static LOADS: Group = Group {
    name: "loads of a case",
    meaning: "What a list of loads in a case holds.",
    blocks: &[&GRAVITY, &LOAD],
};

/// Motion of the base.
pub static BASE_MOTION: Group = Group {
    name: "base",
    meaning: "Uniform acceleration of the ground; displacements are then relative to it.",
    blocks: &[&Block {
        name: "",
        meaning: "One component. Positive acceleration along +X acts as −M a on the relative displacement.",
        example: r#"(direction: X, function: "shake")"#,
        fields: &[
            needed("direction", Choice(&BASE_DIRECTIONS), "Direction."),
            needed("function", Name("function"), "Its history, an acceleration."),
            plain(
                "factor",
                Quantity,
                "1",
                "Multiple of the function; a plain function may get its unit here.",
            ),
        ],
    }],
};
/// Forces in time.
pub static FORCE_HISTORY: Group = Group {
    name: "forces",
    meaning: "Load patterns that vary in time.",
    blocks: &[&Block {
        name: "",
        meaning: "A pattern times a function.",
        example: r#"(load: "push", function: "unit")"#,
        fields: &[
            needed("load", Name("load"), "The pattern."),
            needed("function", Name("function"), "Its history, a pure number."),
            plain("factor", Quantity, "1", "Multiple."),
        ],
    }],
};
/// Motions of supports.
pub static SUPPORT_MOTION: Group = Group {
    name: "supports of a case",
    meaning: "Supports that move, each on its own.",
    blocks: &[&Block {
        name: "",
        meaning: "Imposed displacement of a direction that `supports` fixes.",
        example: r#"(node: "base", dof: Ux, displacement: "sway")"#,
        fields: &[
            needed("node", Name("node"), "The supported node."),
            needed("dof", Choice(&DIRECTIONS), "Direction."),
            needed(
                "displacement",
                Name("function"),
                "Its history, a length or an angle; a table needs `interpolation: Cubic`.",
            ),
            plain("factor", Quantity, "1", "Multiple."),
        ],
    }],
};
/// Initial values.
pub static INITIAL: Group = Group {
    name: "initial",
    meaning: "Values at the start in place of those of the case before.",
    blocks: &[&Block {
        name: "",
        meaning: "Displacement, velocity or both of one direction.",
        example: r#"(node: "m", dof: Ux, displacement: "1 cm", velocity: "1 m/s")"#,
        fields: &[
            needed("node", Name("node"), "The node."),
            needed("dof", Choice(&DIRECTIONS), "Direction."),
            absent(
                "displacement",
                super::Takes::Words("a length or an angle"),
                "as it is",
                "Displacement at the start.",
            ),
            absent(
                "velocity",
                super::Takes::Words("m/s or rad/s"),
                "as it is",
                "Velocity at the start.",
            ),
        ],
    }],
};

/// Steps by error control.
pub static ADAPTIVE: Block = Block {
    name: "Adaptive",
    meaning: "Substeps by error control: each is taken whole and in two halves.",
    example: "Adaptive",
    fields: &[plain(
        "tolerance",
        Number(d::NONE, SHARE),
        "1e-4",
        "Error of a step at most: in energy (as a square root), displacement and link force, each relative to the largest so far.",
    )],
};
/// Equal steps.
pub static FIXED: Block = Block {
    name: "Fixed",
    meaning: "Equal substeps, halved only where the link equations do not converge.",
    example: "Fixed",
    fields: &[plain("substeps", Count(1), "1", "Substeps in an output step.")],
};
/// Step control.
pub static STEPS: Group = Group {
    name: "step",
    meaning: "How the march chooses its substeps.",
    blocks: &[&ADAPTIVE, &FIXED],
};

const VECTORS: Field = absent("vectors", Count(1), "chosen by the program", "How many vectors.");
const ADEQUACY: Field = plain(
    "adequacy",
    Number(d::NONE, Within(0.0, 1.0)),
    "0.99",
    "Share of the exact flexibility at every link coordinate that the basis must hold; 0: no vectors for links.",
);
const TOLERANCE: Field = plain(
    "tolerance",
    Number(d::NONE, Within(0.0, 1.0)),
    "0.02",
    "Error that the reduction may make in any output, as share of its range; estimated in every run, but not where it is 1.",
);
const ENRICH: Field = plain(
    "enrich",
    Flag,
    "true",
    "A basis that makes a larger error is enlarged and the run made again; false: the run ends as inadequate.",
);
/// Load-dependent vectors.
pub static RITZ: Block = Block {
    name: "Ritz",
    meaning: "Load-dependent Ritz vectors, and a static vector for link coordinates that they hold badly.",
    example: "Ritz",
    fields: &[VECTORS, ADEQUACY, TOLERANCE, ENRICH],
};
/// Eigenvectors.
pub static EIGEN: Block = Block {
    name: "Eigen",
    meaning: "Exact eigenvectors, and a static vector for link coordinates that they hold badly.",
    example: "Eigen",
    fields: &[VECTORS, ADEQUACY, TOLERANCE, ENRICH],
};
/// All eigenvectors.
pub static COMPLETE: Block = Block {
    name: "Complete",
    meaning: "All eigenvectors: no reduction.",
    example: "Complete",
    fields: &[],
};
/// Bases.
pub static BASES: Group = Group {
    name: "basis",
    meaning: "The basis of the solvers `Fna` and `RitzHht`.",
    blocks: &[&RITZ, &EIGEN, &COMPLETE],
};

const AFTER: Field = absent(
    "after",
    Name("case"),
    "from rest, unloaded",
    "Earlier case whose end is the start: displacements, link histories and loads are carried on.",
);
/// Static case.
pub static STATIC: Block = Block {
    name: "Static",
    meaning: "Nonlinear statics: loads grow from nothing, or from the case before, to their value.",
    example: "Static(loads: [Gravity])",
    fields: &[
        AFTER,
        needed("loads", List(&LOADS), "Loads that are added."),
        plain(
            "steps",
            Count(1),
            "1",
            "Load steps at least; halved where they do not converge, and where laws bend inside them.",
        ),
    ],
};
/// Dynamic case.
pub static DYNAMIC: Block = Block {
    name: "Dynamic",
    meaning: "Motion in time.",
    example: r#"Dynamic(duration: "0.1 s", dt: "10 ms")"#,
    fields: &[
        AFTER,
        needed("duration", Number(d::TIME, Positive), "Length of the analysis."),
        needed(
            "dt",
            Number(d::TIME, Positive),
            "Output step; the march takes substeps in it by itself.",
        ),
        plain(
            "constant",
            List(&LOADS),
            "[]",
            "Loads that act unchanged from the start, beside those carried on.",
        ),
        plain("base", List(&BASE_MOTION), "[]", "Acceleration of the ground."),
        plain("forces", List(&FORCE_HISTORY), "[]", "Forces that vary."),
        plain("supports", List(&SUPPORT_MOTION), "[]", "Supports that move."),
        plain("initial", List(&INITIAL), "[]", "Values at the start."),
        plain("solver", Choice(&SOLVERS), "Fna", "Solver, where `--solver` names none."),
        plain("step", One(&STEPS), "Adaptive", "Step control."),
        plain(
            "kernel",
            Choice(KERNELS),
            "Newton",
            "Solution of the link equations: Newton with full tangents, or the constant-stiffness iteration of Wilson.",
        ),
        plain(
            "link_tolerance",
            Number(d::NONE, SHARE),
            "1e-9",
            "Share of the largest link force by which a link may miss equilibrium.",
        ),
        plain(
            "energy_limit",
            Number(d::NONE, SHARE),
            "1e-3",
            "Share of the energy that may be unaccounted for before the run says so.",
        ),
        absent(
            "substep_limit",
            Count(1),
            "1 000 000, or 200 for each output step",
            "Substeps that may be tried in all; a run that needs more ends there with what it has.",
        ),
        plain("basis", One(&BASES), "Ritz", "Basis of `Fna` and `RitzHht`."),
        plain(
            "alpha",
            Number(d::NONE, Within(-1.0 / 3.0, 0.0)),
            "0",
            "α of HHT; 0 is the average acceleration method.",
        ),
    ],
};
/// Cases.
pub static CASES: Group =
    Group { name: "cases", meaning: "Analysis cases.", blocks: &[&STATIC, &DYNAMIC] };

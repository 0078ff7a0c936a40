//! The model itself: sections, units, supports, loads, damping, fields of all elements.

use super::Takes::{Choice, Map, Name, Number, One, Text, Words};
use super::{
    Block, CASES, COMBINATIONS, ENVELOPES, FUNCTIONS, Field, Group, OUTPUTS, SPECTRA, absent,
    needed, plain,
};
use crate::Plane;
use crate::check::RATIO;
use crate::named::Named;
use trilith_element::Range::{NonNegative, Positive};
use trilith_element::dimension as d;

/// Coordinate planes.
pub static PLANES: &[&str] = Plane::NAMES;
/// Words for whole supports.
pub static SUPPORTS: [&str; 2] = ["Fixed", "Pinned"];

/// A model file.
pub static MODEL: Group = Group {
    name: "model",
    meaning: "The file is one block without a name.",
    blocks: &[&Block {
        name: "",
        meaning: "The sections of a model, in any order.",
        example: r#"(nodes: { "m": (0, 0, 0) }, elements: { "k": Spring(node: "m", k1: "1 kN/m"), "mass": Mass(node: "m", mass: "1 t") }, supports: { "m": (Ux, Uy, Rx, Ry, Rz) }, cases: { "own weight": Static(loads: [Gravity]) })"#,
        fields: &[
            absent(
                "include",
                Words("a list of files in quotes, see *Other files*"),
                "none",
                "Files with sections of the model. What they hold stands before what the model has itself.",
            ),
            plain("title", Text, r#""""#, "Shown above results."),
            absent("units", One(&UNITS), "SI", "What bare numbers are measured in."),
            absent(
                "plane",
                Choice(PLANES),
                "all of space",
                "Motion stays in this plane: the other three directions of every node are fixed.",
            ),
            plain(
                "gravity",
                Number(d::ACCELERATION, NonNegative),
                r#""9.80665 m/s^2""#,
                "Acceleration of gravity, which acts along −Z where a case loads `Gravity`.",
            ),
            absent(
                "parameters",
                Words(
                    "a map from names to numbers, expressions, `true` or `false`, or `Text(\"…\")`",
                ),
                "none",
                "Names that expressions, choices, flags and texts may use; `--set NAME=VALUE` changes them.",
            ),
            needed("nodes", Words("a map from names to positions `(x, y, z)`, lengths"), "Nodes."),
            absent(
                "supports",
                Words(
                    "a map from nodes to `Fixed`, `Pinned` (no translation), a direction, or a list of directions",
                ),
                "none",
                "Directions that do not move, or move as a case says.",
            ),
            absent(
                "properties",
                Words("a map from names to `Kind(…)` with parameters"),
                "none",
                "Sets of parameters that elements share with `use`.",
            ),
            needed(
                "elements",
                Words("a map from names to `Kind(…)`"),
                "Elements, constraints and links: see *Fields of all elements* and *Kinds*.",
            ),
            absent(
                "groups",
                Words(
                    "a map from names to lists of names, or of patterns such as `\"floor 1 *\"`; `Nodes([…])` or `Elements([…])` where both have these names",
                ),
                "none",
                "Nodes or elements that one name stands for: in `supports`, in `nodes` of elements and constraints, and as `node` of loads, initial values and support motions for each of them; as `link` or `element` of a force for their sum.",
            ),
            plain(
                "damping",
                One(&DAMPING),
                "None",
                "Damping of the structure; links damp by their own laws.",
            ),
            absent(
                "p_delta",
                Name("case"),
                "none",
                "Static case whose axial forces stiffen or soften beams and trusses (geometric stiffness).",
            ),
            absent("functions", Map(&FUNCTIONS), "none", "Functions of time."),
            absent(
                "loads",
                Words("a map from names to lists of *Forces of a load*"),
                "none",
                "Patterns of forces on nodes and along members.",
            ),
            needed(
                "cases",
                Map(&CASES),
                "Analysis cases; `trilith run` runs the last one, and those it continues, unless `--case` names another.",
            ),
            absent("combinations", Map(&COMBINATIONS), "none", "Combinations of cases."),
            absent(
                "outputs",
                Map(&OUTPUTS),
                "none",
                "Recorded quantities; their peaks are in the summary, their histories in files.",
            ),
            absent("spectra", Map(&SPECTRA), "none", "Floor spectra."),
            absent("envelopes", Map(&ENVELOPES), "none", "Envelopes of forces along members."),
        ],
    }],
};

/// Units of bare numbers.
pub static UNITS: Group = Group {
    name: "units",
    meaning: "Units of bare numbers of the file. Numbers with a unit of their own do not care.",
    blocks: &[&Block {
        name: "",
        meaning: "Give `force` or `mass`, not both: the other follows.",
        example: r#"(length: "in", force: "kip")"#,
        fields: &[
            plain("length", Text, r#""m""#, "Unit of length."),
            absent("force", Text, "from the mass", "Unit of force."),
            absent("mass", Text, "kg, or from the force", "Unit of mass."),
            plain("time", Text, r#""s""#, "Unit of time."),
        ],
    }],
};

/// No damping.
pub static NO_DAMPING: Block =
    Block { name: "None", meaning: "No damping of the structure.", example: "None", fields: &[] };
/// The same ratio in all modes.
pub static MODAL: Block = Block {
    name: "Modal",
    meaning: "The same ratio of critical damping in all modes of the structure without link stiffness.",
    example: "Modal(ratio: 0.02)",
    fields: &[needed("ratio", Number(d::NONE, RATIO), "Share of critical damping.")],
};
/// Ratio by frequency.
pub static MODAL_TABLE: Block = Block {
    name: "ModalTable",
    meaning: "Ratio by frequency, linear between points and constant beyond them.",
    example: r#"ModalTable(points: [("1 Hz", 0.02), ("10 Hz", 0.05)])"#,
    fields: &[needed(
        "points",
        Words("a list of `(frequency, ratio)`, frequencies rising"),
        "The ratios.",
    )],
};
/// Proportional to mass and stiffness.
pub static RAYLEIGH: Block = Block {
    name: "Rayleigh",
    meaning: "C = mass · M + stiffness · K, with K of the structure without links.",
    example: r#"Rayleigh(stiffness: "1 ms")"#,
    fields: &[
        plain("mass", Number(d::FREQUENCY, NonNegative), "0", "Factor of the mass matrix."),
        plain("stiffness", Number(d::TIME, NonNegative), "0", "Factor of the stiffness matrix."),
    ],
};
/// Rayleigh damping by two frequencies.
pub static RAYLEIGH_AT: Block = Block {
    name: "RayleighAt",
    meaning: "Rayleigh damping with the same ratio at two frequencies.",
    example: r#"RayleighAt(ratio: 0.05, f1: "1 Hz", f2: "10 Hz")"#,
    fields: &[
        needed("ratio", Number(d::NONE, RATIO), "Share of critical damping at both frequencies."),
        needed("f1", Number(d::FREQUENCY, Positive), "First frequency."),
        needed("f2", Number(d::FREQUENCY, Positive), "Second frequency."),
    ],
};
/// Damping statements.
pub static DAMPING: Group = Group {
    name: "damping",
    meaning: "One statement that all solvers realise alike. It acts on the structure, not on links \
              nor on their `effective_stiffness`.",
    blocks: &[&NO_DAMPING, &MODAL, &MODAL_TABLE, &RAYLEIGH, &RAYLEIGH_AT],
};

const NODES: Field = absent(
    "nodes",
    Words("a list of names of nodes; of a kind with `labels` also a map from labels to nodes"),
    "`node`",
    "The nodes.",
);
/// Where an element stands.
pub static PLACE: Block = Block {
    name: "",
    meaning: "Where an element stands; not in `properties`.",
    example: r#"Spring(nodes: ("base", "m"), k1: "1 kN/m")"#,
    fields: &[
        NODES,
        absent(
            "node",
            Name("node"),
            "`nodes`",
            "The only node: a link or spring between it and the ground.",
        ),
        absent(
            "use",
            Words("the name of a set of `properties` of the same kind"),
            "none",
            "Parameters from the set; those given beside it come first.",
        ),
    ],
};
/// Fields of every kind.
pub static ELEMENT: Block = Block {
    name: "",
    meaning: "Local axes of any kind that has them.",
    example: r#"Spring(node: "m", k1: "1 kN/m", axis1: (1, 0, 0))"#,
    fields: &[
        absent(
            "axis1",
            Words("a vector `(x, y, z)`"),
            "from the first node to the second; +Z for one node",
            "Direction of local axis 1.",
        ),
        absent(
            "axis2",
            Words("a vector `(x, y, z)`"),
            "the upward direction square to axis 1; +X for a vertical one",
            "Vector in the plane of local axes 1 and 2.",
        ),
    ],
};
/// Fields of every link.
pub static LINK: Block = Block {
    name: "",
    meaning: "What every link takes beside the parameters of its card.",
    example: r#"Gap(node: "m", k: "1 MN/m", effective_stiffness: "1 kN/m")"#,
    fields: &[
        absent(
            "effective_stiffness",
            Words(
                "a stiffness (moment about rotations), ≥ 0, or a list with one for each coordinate of the law",
            ),
            "0; the basis is made with a thousandth of the stiffness of the closed link",
            "Stiffness that stands for the link in the linear structure (K effective of FNA). The link equations take it out again.",
        ),
        absent(
            "p_delta_at",
            Words("two shares from 0 to 1, `(first node, second node)`, at most 1 in sum"),
            "no such moment",
            "Where the moment of the axial force over the shear of the link acts (P-Δ): its share at either end, the ground as the first for one node; the rest is a couple of shears, for which the nodes must be apart. `(1, 0)` for a bearing whose dish lies below. For laws with U1 and U2 or U3. With `p_delta` or without.",
        ),
        plain(
            "shear_at",
            Number(d::LENGTH, trilith_element::Range::Any),
            "0",
            "Distance from the second node at which the shear of a link with two nodes acts.",
        ),
    ],
};

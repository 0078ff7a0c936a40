//! Recorded quantities.

use super::Takes::{Choice, Count, Flag, List, Name, Quantity, Words};
use super::{Block, DIRECTIONS, Field, Group, absent, needed, plain};

/// Local axes of a link.
pub(super) static AXES: [&str; 6] = ["U1", "U2", "U3", "R1", "R2", "R3"];
/// Directions of what acts sideways.
pub static SIDEWAYS: [&str; 2] = ["X", "Y"];
/// Motions along these.
pub static ACROSS: [&str; 2] = ["Ux", "Uy"];
const FACTOR: Field = plain("factor", Quantity, "1", "Factor, with or without unit.");
/// What any output may say.
pub const HIDDEN: Field = plain(
    "hidden",
    Flag,
    "false",
    "Other outputs are made from it, and it is left out of files, report and summary.",
);
const ONE: Field = absent("node", Name("node"), "`terms`", "The node.");
const DIRECTION: Field = absent("dof", Choice(&DIRECTIONS), "`terms`", "Direction.");
const TERMS: Field = absent(
    "terms",
    List(&TERM),
    "a single term",
    "Several terms that are added, such as a drift; in place of `node` and `dof`.",
);
const LINK: Field = needed("link", Name("element"), "The link.");
const AXIS: Field = absent(
    "axis",
    Choice(&AXES),
    "`coordinate`",
    "Local axis of a link between two nodes or a node and the ground.",
);
const COORDINATE: Field =
    absent("coordinate", Count(0), "`axis`", "Coordinate of the law, from 0.");

/// A term of a sum.
pub static TERM: Group = Group {
    name: "terms",
    meaning: "Terms of a nodal output.",
    blocks: &[&Block {
        name: "",
        meaning: "The motion of one direction times a factor.",
        example: r#"(node: "m", dof: Ux)"#,
        fields: &[
            needed("node", Name("node"), "The node."),
            needed("dof", Choice(&DIRECTIONS), "Direction."),
            plain("factor", Quantity, "1", "Factor; a length brings a rotation to a displacement."),
        ],
    }],
};
/// Displacement.
pub static DISPLACEMENT: Block = Block {
    name: "Displacement",
    meaning: "Displacement or rotation, relative to the base.",
    example: r#"Displacement(node: "m", dof: Ux)"#,
    fields: &[ONE, DIRECTION, FACTOR, TERMS, HIDDEN],
};
/// Velocity.
pub static VELOCITY: Block = Block {
    name: "Velocity",
    meaning: "Velocity, relative to the base.",
    example: r#"Velocity(node: "m", dof: Ux)"#,
    fields: &[ONE, DIRECTION, FACTOR, TERMS, HIDDEN],
};
/// Acceleration.
pub static ACCELERATION: Block = Block {
    name: "Acceleration",
    meaning: "Acceleration, relative to the base or absolute.",
    example: r#"Acceleration(node: "m", dof: Ux)"#,
    fields: &[
        ONE,
        DIRECTION,
        FACTOR,
        TERMS,
        plain("absolute", Flag, "false", "With the acceleration of the base."),
        HIDDEN,
    ],
};
/// Force of a link.
pub static LINK_FORCE: Block = Block {
    name: "LinkForce",
    meaning: "Force or moment of a link.",
    example: r#"LinkForce(link: "link", axis: U1)"#,
    fields: &[LINK, AXIS, COORDINATE, FACTOR, HIDDEN],
};
/// Deformation of a link.
pub static LINK_DEFORMATION: Block = Block {
    name: "LinkDeformation",
    meaning: "Deformation of a link.",
    example: r#"LinkDeformation(link: "link", axis: U1)"#,
    fields: &[LINK, AXIS, COORDINATE, FACTOR, HIDDEN],
};
/// History variable of a link.
pub static LINK_HISTORY: Block = Block {
    name: "LinkHistory",
    meaning: "A history variable of a link, such as its plastic slip.",
    example: r#"LinkHistory(link: "link", variable: "slip")"#,
    fields: &[
        LINK,
        needed(
            "variable",
            Words("a name; a wrong one is answered with those there are"),
            "The variable.",
        ),
        HIDDEN,
    ],
};
/// End force of a linear element.
pub static ELEMENT_FORCE: Block = Block {
    name: "ElementForce",
    meaning: "Force of a linear element on one of its nodes, along global directions.",
    example: r#"ElementForce(element: "spring", end: 0, dof: Ux)"#,
    fields: &[
        needed("element", Name("element"), "The element."),
        needed("end", Count(0), "Its node, from 0."),
        needed("dof", Choice(&DIRECTIONS), "Direction."),
        FACTOR,
        HIDDEN,
    ],
};
/// The names of forces inside members.
pub static FORCES: [&str; 6] = crate::MemberForce::NAMES;
/// Force inside a member.
pub static MEMBER_FORCE: Block = Block {
    name: "MemberForce",
    meaning: "A force inside a beam or truss in its local axes, with the loads along it: axial force N (tension positive), \
              shear V2 and V3, torsion T, moments M2 and M3 (positive where they press on the side of positive local 3 and \
              2). A mass matrix that is `Lumped` brings inertia to the nodes; that of a `Consistent` one between them is \
              left out.",
    example: r#"MemberForce(element: "beam", force: M3, at: "50 %")"#,
    fields: &[
        needed("element", Name("element"), "The beam or truss."),
        needed("force", Choice(&FORCES), "Which force."),
        needed(
            "at",
            Words("a distance from the first node, or a share such as `\"50 %\"`"),
            "Where; at a point load, just before it.",
        ),
        FACTOR,
        HIDDEN,
    ],
};
/// Envelopes along members.
pub static ENVELOPES: Group = Group {
    name: "envelopes",
    meaning: "The largest and smallest forces over time along members: `envelopes.csv` has them station by station, the summary the \
              extremes of each envelope.",
    blocks: &[&Block {
        name: "",
        meaning: "Forces along a beam or truss, or along each of several.",
        example: r#"(element: "beam", stations: 5)"#,
        fields: &[
            needed(
                "element",
                Name("element"),
                "The member, a group of members or a list of members.",
            ),
            plain("stations", Count(2), "11", "How many places, evenly from end to end."),
            absent(
                "forces",
                Words("a list of `N`, `V2`, `V3`, `T`, `M2`, `M3`"),
                "all; in a plane model those in the plane",
                "Which forces.",
            ),
        ],
    }],
};
/// Horizontal force on supports and ground.
pub static BASE_SHEAR: Block = Block {
    name: "BaseShear",
    meaning: "Horizontal force that the structure passes to its supports and to the ground.",
    example: "BaseShear(direction: X)",
    fields: &[needed("direction", Choice(&SIDEWAYS), "Direction."), HIDDEN],
};
/// Overturning moment.
pub static OVERTURNING: Block = Block {
    name: "Overturning",
    meaning: "Moment about a point of what the structure passes to its supports and to the ground; positive as of a \
              force along `direction` above that point. Weights take part, and so does what an `EqualDof` passes on \
              between nodes at different heights.",
    example: r#"Overturning(direction: X, about: "0 m")"#,
    fields: &[
        needed("direction", Choice(&SIDEWAYS), "Direction in which it overturns."),
        needed(
            "about",
            Words("a point (x, y, z), or a height"),
            "The point; a height is that of a point at x = y = 0.",
        ),
        HIDDEN,
    ],
};
/// Storey drift.
pub static STOREY_DRIFT: Block = Block {
    name: "StoreyDrift",
    meaning: "Displacement of a node against one below it, over the height between them.",
    example: r#"StoreyDrift(of: ["base", "m"], dof: Ux)"#,
    fields: &[
        needed("of", Words("two nodes, the lower one first"), "The nodes."),
        needed("dof", Choice(&ACROSS), "Direction."),
        HIDDEN,
    ],
};
/// Force of supports.
pub static REACTION: Block = Block {
    name: "Reaction",
    meaning: "Force or moment of supports on the structure, in sum: of the elements and links at a direction that they \
              fix. Weight, inertia and damping by the mass of that direction itself go past the structure and are not \
              in it.",
    example: r#"Reaction(node: "base", dof: Uz)"#,
    fields: &[
        needed("node", Name("node"), "The node, a group of nodes or a list of nodes."),
        needed("dof", Choice(&DIRECTIONS), "Direction, along which supports fix all of them."),
        FACTOR,
        HIDDEN,
    ],
};
/// What an output of another crate is made of.
pub const OF: Field =
    needed("of", Words("names of outputs that stand before"), "The outputs it is made of.");
/// The fields of any output of another crate, beside those of its card.
pub const DERIVED: [Field; 2] = [OF, HIDDEN];
/// A part of a combination.
pub static PARTS: Group = Group {
    name: "parts",
    meaning: "Outputs that another is put together from; the name alone will do where the factor is 1.",
    blocks: &[&Block {
        name: "",
        meaning: "An output that stands before, times a factor.",
        example: r#"(output: "x")"#,
        fields: &[
            needed("output", Name("output"), "The output."),
            plain("factor", Quantity, "1", "Factor; all parts must come to one unit."),
        ],
    }],
};
const PARTS_OF: Field = needed("terms", List(&PARTS), "The outputs, each at the same time.");
/// Sum of outputs.
pub static SUM: Block = Block {
    name: "Sum",
    meaning: "Sum of other outputs.",
    example: r#"Sum(terms: ["x", "y"])"#,
    fields: &[PARTS_OF, plain("constant", Quantity, "0", "A number that is added."), HIDDEN],
};
/// Root of the sum of squares.
pub static NORM: Block = Block {
    name: "Norm",
    meaning: "Root of the sum of the squares of other outputs.",
    example: r#"Norm(terms: ["x", "y"])"#,
    fields: &[PARTS_OF, HIDDEN],
};
/// Largest of outputs.
pub static LARGEST: Block = Block {
    name: "Largest",
    meaning: "Largest of other outputs.",
    example: r#"Largest(terms: ["x", "y"])"#,
    fields: &[PARTS_OF, HIDDEN],
};
/// Smallest of outputs.
pub static SMALLEST: Block = Block {
    name: "Smallest",
    meaning: "Smallest of other outputs.",
    example: r#"Smallest(terms: ["x", "y"])"#,
    fields: &[PARTS_OF, HIDDEN],
};
/// Outputs.
pub static OUTPUTS: Group = Group {
    name: "outputs",
    meaning: "Recorded quantities.",
    blocks: &[
        &DISPLACEMENT,
        &VELOCITY,
        &ACCELERATION,
        &LINK_FORCE,
        &LINK_DEFORMATION,
        &LINK_HISTORY,
        &ELEMENT_FORCE,
        &MEMBER_FORCE,
        &BASE_SHEAR,
        &OVERTURNING,
        &STOREY_DRIFT,
        &REACTION,
        &SUM,
        &NORM,
        &LARGEST,
        &SMALLEST,
    ],
};

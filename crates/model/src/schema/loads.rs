//! What load patterns are made of.

use super::Takes::{Choice, Flag, Name, Number, Words};
use super::outputs::AXES;
use super::{Block, DIRECTIONS, Field, Group, absent, needed, plain};
use trilith_element::Range::Any;
use trilith_element::dimension as d;

/// A force at a node.
pub static FORCE: Block = Block {
    name: "",
    meaning: "One force or moment at a node, or at each node of a group.",
    example: r#"(node: "m", dof: Ux, force: "1 kN")"#,
    fields: &[
        needed("node", Name("node"), "Where it acts."),
        needed("dof", Choice(&DIRECTIONS), "Direction."),
        absent("force", Number(d::FORCE, Any), "for a rotation", "Force along Ux, Uy or Uz."),
        absent("moment", Number(d::MOMENT, Any), "for a translation", "Moment about Rx, Ry or Rz."),
    ],
};

const ELEMENT: Field =
    needed("element", Name("element"), "The beam or truss, or a group of them: each.");
const DOF: Field = absent("dof", Choice(&DIRECTIONS), "`axis`", "Global direction.");
const AXIS: Field = absent("axis", Choice(&AXES), "`dof`", "Local axis instead.");
const FORCE_ALONG: Field =
    absent("force", Number(d::STIFFNESS, Any), "for a rotation", "Force by length of the member.");
const MOMENT_ALONG: Field =
    absent("moment", Number(d::FORCE, Any), "for a translation", "Moment by length.");
const PROJECTED: Field = plain(
    "projected",
    Flag,
    "false",
    "By length as seen along `dof`, as snow lies: less on a member that is inclined.",
);
/// How a place along a member is given.
const PLACE: &str = "a distance from the first node, or a share such as `\"50 %\"`";

/// The same force all along.
pub static UNIFORM: Block = Block {
    name: "Uniform",
    meaning: "The same force, or moment, by length.",
    example: r#"Uniform(element: "beam", dof: Ux, force: "10 kN/m")"#,
    fields: &[
        ELEMENT,
        DOF,
        AXIS,
        FORCE_ALONG,
        MOMENT_ALONG,
        absent("from", Words(PLACE), "the first node", "Where it begins."),
        absent("to", Words(PLACE), "the second node", "Where it ends."),
        PROJECTED,
    ],
};
/// Straight between points.
pub static TRAPEZOID: Block = Block {
    name: "Trapezoid",
    meaning: "A force, or moment, by length that runs straight between points; nothing beyond them.",
    example: r#"Trapezoid(element: "beam", axis: U2, points: [("0 %", 0), ("100 %", "10 kN/m")])"#,
    fields: &[
        ELEMENT,
        DOF,
        AXIS,
        needed(
            "points",
            Words("a list of `(place, force by length)`, places rising"),
            "Places are distances from the first node, or shares such as `\"50 %\"`.",
        ),
        PROJECTED,
    ],
};
/// At a place.
pub static POINT: Block = Block {
    name: "Point",
    meaning: "A force or moment at a place of a member.",
    example: r#"Point(element: "beam", at: "50 %", dof: Ux, force: "10 kN")"#,
    fields: &[
        ELEMENT,
        needed("at", Words(PLACE), "Where."),
        DOF,
        AXIS,
        absent("force", Number(d::FORCE, Any), "for a rotation", "Force."),
        absent("moment", Number(d::MOMENT, Any), "for a translation", "Moment."),
    ],
};
/// Warmth.
pub static TEMPERATURE: Block = Block {
    name: "Temperature",
    meaning: "A member that is warmer than it was made, in kelvin. It has an `expansion`, its own or that of its `material`.",
    example: r#"Temperature(element: "beam", rise: "30 K")"#,
    fields: &[
        ELEMENT,
        plain("rise", Number(d::NONE, Any), "0", "On the axis."),
        plain("gradient_2", Number(PER_LENGTH, Any), "0", "By length towards positive local 2."),
        plain("gradient_3", Number(PER_LENGTH, Any), "0", "By length towards positive local 3."),
    ],
};
/// 1/m.
const PER_LENGTH: trilith_element::Dimension =
    trilith_element::Dimension { mass: 0.0, length: -1.0, time: 0.0 };

/// What a load pattern holds.
pub static LOADINGS: Group = Group {
    name: "forces of a load",
    meaning: "What a pattern of `loads` holds. Along members it acts on what the structure is, and on what is recorded of the \
              members: nothing is lumped but by the mass matrix.",
    blocks: &[&FORCE, &UNIFORM, &TRAPEZOID, &POINT, &TEMPERATURE],
};

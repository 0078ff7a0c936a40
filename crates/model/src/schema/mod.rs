//! What a model file may hold beside the parameters of elements: blocks, their fields, defaults.
//!
//! The reader takes from here which fields there are, what each takes and what holds without it, so a field that is not
//! here is refused in a file; the reference of the guide is written from here.

mod cases;
mod combinations;
mod functions;
mod loads;
mod many;
mod members;
mod outputs;
mod records;
mod structure;
mod unit_names;
mod words;

pub use cases::{
    ADAPTIVE, BASE_DIRECTIONS, BASE_MOTION, BASES, CASES, COMPLETE, DIRECTIONS, DYNAMIC, EIGEN,
    FIXED, FORCE_HISTORY, GRAVITY, INITIAL, KERNELS, LOAD, LOADS, RITZ, SOLVERS, STATIC, STEPS,
    SUPPORT_MOTION,
};
pub use combinations::COMBINATIONS;
pub use functions::{
    AFTER_END, AMPLITUDE, CONSTANT, COSINE, FUNCTIONS, HALF_SINE, INTERPOLATIONS, POINTS, RAMP,
    RICKER, SCALED, SINE, STEP, TABLE,
};
pub use loads::{FORCE, LOADINGS, POINT, TEMPERATURE, TRAPEZOID, UNIFORM};
pub use many::{AS_IT_STANDS, GROUP_KINDS, INCLUDED, REPETITION};
pub(crate) use members::is_member;
pub use members::{
    ALUMINIUM, BOX, CIRCLE, CONCRETE, I_SHAPE, MATERIALS, MEMBER, PIPE, RECTANGLE, ROLLED,
    SECTIONS, STEEL,
};
pub use outputs::{
    ACCELERATION, ACROSS, BASE_SHEAR, DERIVED, DISPLACEMENT, ELEMENT_FORCE, ENVELOPES, FORCES,
    HIDDEN, LARGEST, LINK_DEFORMATION, LINK_FORCE, LINK_HISTORY, MEMBER_FORCE, NORM, OF, OUTPUTS,
    OVERTURNING, PARTS, REACTION, SIDEWAYS, SMALLEST, STOREY_DRIFT, SUM, TERM, VELOCITY,
};
pub use records::{
    BASELINE, BUTTERWORTH, ENVELOPE, FILTER, FORMATS, PADDINGS, POLYNOMIAL, RECORD, RESAMPLE,
    SERIES, SPECTRA, SYNTHETIC,
};
pub use structure::{
    DAMPING, ELEMENT, LINK, MODAL, MODAL_TABLE, MODEL, NO_DAMPING, PLACE, PLANES, RAYLEIGH,
    RAYLEIGH_AT, SUPPORTS, UNITS,
};
use trilith_element::{Card, Category, Dimension, Range};
pub use unit_names::units_of;

/// Blocks that may stand at the same place of a file.
#[derive(Debug)]
pub struct Group {
    /// Name of the place, such as `functions`.
    pub name: &'static str,
    /// What stands there.
    pub meaning: &'static str,
    /// The blocks; where there are several, the file names the one it takes.
    pub blocks: &'static [&'static Block],
}

impl Group {
    /// Names of the blocks, in order.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        self.blocks.iter().map(|b| b.name).collect()
    }
}

/// `Name(field: value, …)`, or `(field: value, …)` where the name is empty.
#[derive(Debug)]
pub struct Block {
    /// Name as the file writes it; empty where it writes none.
    pub name: &'static str,
    /// One sentence.
    pub meaning: &'static str,
    /// How it looks with the fields that it must have; one line of RON.
    pub example: &'static str,
    /// The fields.
    pub fields: &'static [Field],
}

impl Block {
    /// Names of the fields, in order.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        self.fields.iter().map(|f| f.name).collect()
    }
}

/// One field of a block.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Name in the file.
    pub name: &'static str,
    /// What it takes.
    pub takes: Takes,
    /// What holds where the file says nothing.
    pub default: Default,
    /// One sentence of meaning.
    pub meaning: &'static str,
}

/// What a field takes.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// A text in quotes.
    Text,
    /// A number of a dimension, within a range.
    Number(Dimension, Range),
    /// A number whose dimension the file chooses, such as the amplitude of a function.
    Quantity,
    /// A whole number of at least this.
    Count(usize),
    /// `true` or `false`.
    Flag,
    /// One of these names.
    Choice(&'static [&'static str]),
    /// The name of a node, element, function, load or case.
    Name(&'static str),
    /// One block of a group.
    One(&'static Group),
    /// A list of blocks of a group.
    List(&'static Group),
    /// A map from names to blocks of a group.
    Map(&'static Group),
    /// Something else, in words.
    Words(&'static str),
}

/// What holds where a file says nothing.
#[derive(Clone, Copy, Debug)]
pub enum Default {
    /// The file must give it.
    Required,
    /// Nothing, or what these words say.
    Absent(&'static str),
    /// As if the file said this (RON).
    Value(&'static str),
}

/// A field that a file must give.
#[must_use]
pub const fn needed(name: &'static str, takes: Takes, meaning: &'static str) -> Field {
    Field { name, takes, default: Default::Required, meaning }
}

/// A field with a default, as the file would write it.
#[must_use]
pub const fn plain(
    name: &'static str,
    takes: Takes,
    default: &'static str,
    meaning: &'static str,
) -> Field {
    Field { name, takes, default: Default::Value(default), meaning }
}

/// A field that may be left out.
#[must_use]
pub const fn absent(
    name: &'static str,
    takes: Takes,
    without: &'static str,
    meaning: &'static str,
) -> Field {
    Field { name, takes, default: Default::Absent(without), meaning }
}

/// All groups, in the order in which a reader wants them: the model first, then what its fields hold.
#[must_use]
pub fn groups() -> Vec<&'static Group> {
    let mut all = groups_of(&MODEL);
    all.extend([&SECTIONS, &MATERIALS, &LOADINGS]);
    all
}

/// A group and all that its fields hold, and theirs.
#[must_use]
pub fn groups_of(first: &'static Group) -> Vec<&'static Group> {
    let mut found: Vec<&'static Group> = vec![first];
    let mut at = 0;
    while let Some(group) = found.get(at).copied() {
        for field in group.blocks.iter().flat_map(|b| b.fields) {
            if let Takes::One(g) | Takes::List(g) | Takes::Map(g) = field.takes
                && !found.iter().any(|known| std::ptr::eq(*known, g))
            {
                found.push(g);
            }
        }
        at += 1;
    }
    found
}

/// What a kind takes beside the parameters of its card and, of an element, its [`PLACE`].
#[must_use]
pub fn beside(card: &Card) -> Vec<&'static Block> {
    match card.category {
        Category::Function | Category::Output | Category::Solver => Vec::new(),
        Category::Link => vec![&ELEMENT, &LINK],
        Category::Linear if is_member(card) => vec![&ELEMENT, &MEMBER],
        Category::Linear | Category::Constraint => vec![&ELEMENT],
    }
}

/// Names and SI factors of all units, with the SI unit of their dimension.
#[must_use]
pub fn units() -> Vec<(&'static str, f64, String)> {
    crate::units::UNITS.iter().map(|u| (u.name, u.factor, u.dimension.unit())).collect()
}

/// Names of the functions of expressions.
#[must_use]
pub fn expression_functions() -> &'static [&'static str] {
    &crate::expression::FUNCTIONS
}

//! Random structures under the program against an independent oracle.
//!
//! | file | does |
//! |---|---|
//! | `generate/` | makes a structure, its motion and outputs from a seed |
//! | `spec` | its description, from which both sides are made |
//! | `text` | the model file |
//! | `matrices`, `assemble`, `modes`, `functions`, `laws/` | the equations, written from the textbook |
//! | `radau`, `march`, `problem`, `truth` | their solution by an implicit Runge–Kutta method of order 5 |
//! | `subject`, `judge` | the program's answer and the verdict on it |
//! | `shrink`, `campaign` | a smaller structure that fails alike, and many structures side by side |
//!
//! The oracle takes nothing from the program: no matrix, no basis, no law and no step is shared. What both
//! sides read is the description alone.

mod assemble;
pub mod campaign;
mod functions;
pub mod generate;
pub mod judge;
mod laws;
mod march;
mod matrices;
mod modes;
mod number;
mod problem;
mod radau;
mod rng;
pub mod shrink;
pub mod spec;
pub mod subject;
#[cfg(test)]
mod tests;
pub mod text;
pub mod truth;

//! What a parameter moves in a model: differences of models around its value.
//!
//! ```text
//! ∂x = (x(θ−2h) − 8 x(θ−h) + 8 x(θ+h) − x(θ+2h)) / 12h        off by h⁴ x⁗′/30
//! ```
//!
//! Laws that only tell values are moved by less, so that none of them changes its branch between the two sides.

use crate::error::SolveError;
use crate::run::assemble;
use trilith_model::Model;
use trilith_system::System;

/// Where the models of [`Around::near`] lie, in steps from the value.
pub const OFFSETS: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
/// Their weights over the step.
pub(super) const WEIGHTS: [f64; 4] = [1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0];
/// Where those of [`Around::close`] lie, in steps on both sides.
pub const SMALL: f64 = 1e-3;

/// A parameter by which derivatives are wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// Its name.
    pub name: String,
    /// Its value, SI.
    pub value: f64,
    /// Step h of the differences; a thousandth of the value is a good one.
    pub step: f64,
}

/// The model at values around that of a parameter.
#[derive(Debug)]
pub struct Around {
    /// The parameter.
    pub of: Varied,
    /// At the value and [these](OFFSETS) many steps.
    pub near: [Model; 4],
    /// At the value less, and more, [this](SMALL) part of a step.
    pub close: [Model; 2],
}

/// The same, assembled.
pub(super) struct Assembled<'a> {
    pub around: &'a Around,
    pub systems: [System; 4],
}

impl<'a> Assembled<'a> {
    pub(super) fn new(around: &'a Around) -> Result<Self, SolveError> {
        let [a, b, c, d] = &around.near;
        Ok(Self { around, systems: [assemble(a)?, assemble(b)?, assemble(c)?, assemble(d)?] })
    }

    pub(super) fn sides(&'a self) -> impl Iterator<Item = (&'a Model, &'a System)> {
        self.around.near.iter().zip(&self.systems)
    }
}

/// Σ of four values by their weights, one by one.
pub(super) fn weighted(step: f64, of: [&[f64]; 4]) -> Vec<f64> {
    let sum = |i: usize| (0..4).map(|side| WEIGHTS[side] * of[side][i]).sum::<f64>() / step;
    // What does not move at all has no rounding.
    let moves = |i: usize| of.iter().any(|x| x[i] != of[0][i]);
    (0..of[0].len()).map(|i| if moves(i) { sum(i) } else { 0.0 }).collect()
}

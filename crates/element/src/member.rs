//! Members: linear elements between two nodes that carry loads along their span.

use crate::{Geometry, ParameterError};
use std::fmt::Debug;

/// What acts along the span of a member, in its local axes: forces along 1, 2, 3 and moments about them. Places count from
/// the first node, m.
#[derive(Clone, Debug, PartialEq)]
pub enum SpanLoad {
    /// Forces (N/m) and moments (N·m/m), straight between two places.
    Spread {
        /// Where it begins.
        from: f64,
        /// Where it ends.
        to: f64,
        /// What acts where it begins.
        start: [f64; 6],
        /// What acts where it ends.
        end: [f64; 6],
    },
    /// A force (N) and a moment (N·m).
    Point {
        /// Where.
        at: f64,
        /// What.
        load: [f64; 6],
    },
    /// Warmer than at rest, all along.
    Warmth {
        /// On the axis, K.
        rise: f64,
        /// More with each metre along local 2 and local 3, K/m.
        gradients: [f64; 2],
    },
}

/// Points and weights of a rule on (0, 1) that is exact to the fifth degree. \[Gauss\]
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

impl SpanLoad {
    /// Sums `act(place, load)` over what acts between two places; exact where `act` goes with the fourth power of the
    /// place at most. What acts at a point counts where it lies before `to`, or at the very beginning.
    pub fn over(&self, between: [f64; 2], mut act: impl FnMut(f64, [f64; 6])) {
        match self {
            Self::Spread { from, to, start, end } => {
                let (a, b) = (from.max(between[0]), to.min(between[1]));
                let length = b - a;
                if length <= 0.0 {
                    return;
                }
                for (share, weight) in GAUSS {
                    let x = a + share * length;
                    let along = (x - from) / (to - from);
                    let load = std::array::from_fn(|i| {
                        weight * length * (start[i] + along * (end[i] - start[i]))
                    });
                    act(x, load);
                }
            }
            Self::Point { at, load } => {
                if *at >= between[0] && *at < between[1] {
                    act(*at, *load);
                }
            }
            Self::Warmth { .. } => {}
        }
    }
}

/// A linear element between two nodes that loads may act on between them.
pub trait Member: Debug {
    /// What a load is worth at the ends: forces and moments on both nodes in local axes, those at the first node first.
    /// They are what would hold the ends against the load, reversed, and do to all that is outside the member what the
    /// load does.
    ///
    /// # Errors
    /// [`ParameterError`] where the member cannot carry the load.
    fn end_loads(&self, at: &Geometry<'_>, load: &SpanLoad) -> Result<[f64; 12], ParameterError>;
}

//! Functions of time from other crates.
//!
//! A waveform is what a load does in time, without its size: the model file gives an `amplitude` with a unit beside the
//! parameters of the card, and the function is `amplitude · y(t)`. It is a pure function: the same `t` gives the same
//! value, in any order and on any thread.

use std::fmt;

/// Which limit to take where a function jumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Limit from earlier times: the end of a step.
    Before,
    /// Limit from later times: the start of a step.
    After,
}

impl Side {
    /// True where `t`, seen from this side, lies behind `edge`.
    #[must_use]
    pub fn is_past(self, t: f64, edge: f64) -> bool {
        match self {
            Self::Before => t > edge,
            Self::After => t >= edge,
        }
    }
}

/// A time in which a function is curved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// From, s.
    pub from: f64,
    /// To, s; may be infinite.
    pub to: f64,
    /// Longest step that follows it, s.
    pub step: f64,
}

impl Stretch {
    /// The steps h that follow a waveform of the peak 1 whose |y″| is at most `curvature` (1/s²): straight lines miss
    /// h²/8 · |y″| = 1.9 %, as in sixteen steps of the period of a sine.
    #[must_use]
    pub fn of_curvature(from: f64, to: f64, curvature: f64) -> Self {
        Self { from, to, step: std::f64::consts::PI / (8.0 * curvature.sqrt()) }
    }
}

/// A function of time, of the size 1.
pub trait Waveform: fmt::Debug + Send + Sync {
    /// Value y, first and second derivative (1/s, 1/s²) at `t` ≥ 0 (s from the start of the case).
    ///
    /// Where it jumps or bends, those of the branch on that side. A base motion that is given as displacement or as
    /// velocity is differentiated by these.
    fn at(&self, t: f64, side: Side) -> [f64; 3];

    /// Times (s) at which value or slope may jump; a step ends at each of them.
    fn breaks(&self) -> Vec<f64>;

    /// Where it is curved, and how short steps must be to follow it by straight lines; none where it is straight between
    /// its [`breaks`](Self::breaks).
    fn stretch(&self) -> Option<Stretch>;

    /// Largest |y| from 0 up to a time (s, may be infinite), or a bound a little above it.
    fn peak_until(&self, end: f64) -> f64;
}

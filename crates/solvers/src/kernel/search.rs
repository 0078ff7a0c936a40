//! How far a Newton correction goes.
//!
//! ```text
//! x = x_A + s p,    s = 1 where the correction p of Newton's method leads
//! g(s) = r(s)·w,    r: residual, w: what p moves; (1 − s) g(0) as long as no law leaves its tangent
//! ```
//!
//! A link that slips and has to turn back within the step sticks in a small part of p only, and a force like |v|^α with
//! α < ½ is steep in a small part of it: Newton's method goes to and fro between both sides. The part of p in which
//! g passes zero is found by bisection then.

/// Plain Newton iterations before the first line search.
pub(crate) const SEARCH_FROM: usize = 2;
/// Parts of a correction that are tried at most.
pub(crate) const TRIED: usize = 12;
/// A correction that leaves more than this share of the residual went too far.
pub(crate) const ENOUGH: f64 = 0.9;
/// Where g is less than this share of what either side has, a law changes over.
pub(crate) const CROSSES: f64 = 0.5;

/// Line search of a Newton iteration that does not converge.
#[derive(Default)]
pub(crate) struct Search {
    /// The last correction, the residual before it, and what it moves.
    pub step: Vec<f64>,
    residual: Vec<f64>,
    way: Vec<f64>,
    /// Largest residual before it.
    before: f64,
    /// Part of it that is made; the largest known as too little, and the smallest as too much; g at these.
    share: f64,
    ends: [f64; 2],
    g: [f64; 2],
    /// Parts tried.
    tried: usize,
}

impl Search {
    /// Before a new step.
    pub fn reset(&mut self) {
        self.step.clear();
        self.before = 0.0;
    }

    /// What more of the last correction is to be made, or less, where its residual is no better; `way`: what a correction
    /// moves.
    pub fn goes_on(
        &mut self,
        iteration: usize,
        residual: &[f64],
        size: f64,
        way: impl FnOnce(&[f64], &mut Vec<f64>),
    ) -> Option<f64> {
        let begins = self.tried == 0;
        let is_fine = iteration < SEARCH_FROM || (begins && size <= ENOUGH * self.before);
        if is_fine || self.tried == TRIED || self.step.is_empty() {
            self.before = size;
            return None;
        }
        let along = |way: &[f64], r: &[f64]| way.iter().zip(r).map(|(w, r)| w * r).sum::<f64>();
        if begins {
            way(&self.step, &mut self.way);
            self.g[0] = along(&self.way, &self.residual);
        }
        let g = along(&self.way, residual);
        let goes_on = !begins && g > 0.0;
        let of_side = match goes_on {
            true => self.g[0] * (1.0 - self.share),
            false => self.g[1].abs() * (self.share / self.ends[1]),
        };
        if !begins && g.abs() < CROSSES * of_side {
            self.before = size;
            return None;
        }
        if goes_on {
            self.ends[0] = self.share;
        } else {
            (self.ends[1], self.g[1]) = (self.share, g);
        }
        self.tried += 1;
        let share = 0.5 * (self.ends[0] + self.ends[1]);
        Some(share - std::mem::replace(&mut self.share, share))
    }

    /// Takes note of the residual before a correction.
    pub fn before(&mut self, residual: &[f64]) {
        self.residual.clear();
        self.residual.extend_from_slice(residual);
    }

    /// Takes note of a correction about to be made; nobody comes back to the first of a step.
    pub fn goes(&mut self, step: &[f64]) {
        self.step.clear();
        self.step.extend_from_slice(step);
        (self.share, self.ends, self.tried) = (1.0, [0.0, 1.0], 0);
    }
}

//! Coordinates that have neither mass nor damping, in direct integration.
//!
//! They follow loads and links at once, and Newmark's rule would let the rates of one step ring for ever in the next
//! ones: κ q = s leaves q̇ to `q̇₁ = 2 Δq/Δt − q̇₀`. Theirs are the mean ones of a step and half a step of the
//! acceleration before, as FNA's are: of second order, and errors die out. Where a load has jumped at the start of a
//! step, they are those before.

use crate::space::Space;

/// The acceleration of a coordinate without mass where its load has just jumped: too little to be one.
pub(crate) const JUMPED: f64 = f64::MIN_POSITIVE;

/// Accelerations after a change of the load that alone would make the others.
pub(crate) fn accelerate_at_once(accelerations: &mut [f64], change: &[f64]) {
    for (x, y) in accelerations.iter_mut().zip(change) {
        *x = if *y == JUMPED { JUMPED } else { *x + y };
    }
}

/// The coordinates.
#[derive(Clone, Debug, Default)]
pub(crate) struct Followers(Vec<usize>);

impl Followers {
    /// Those of a space; `damped`: active link coordinates of laws whose forces depend on rates.
    pub(crate) fn new(space: &Space, damped: &[usize]) -> Self {
        if space.rayleigh[1] != 0.0 {
            return Self::default();
        }
        let mut held: Vec<bool> = (space.mass.diagonal().iter().zip(space.damping.diagonal()))
            .map(|(m, c)| *m != 0.0 || c != 0.0)
            .collect();
        for a in damped {
            space.links.row(*a).filter(|(_, c)| *c != 0.0).for_each(|(i, _)| held[i] = true);
        }
        Self((0..held.len()).filter(|i| !held[*i]).collect())
    }

    /// Their rates and accelerations at the end of a step.
    pub(crate) fn settle(&self, from: &[f64], to: &mut [f64], dt: f64) {
        let n = from.len() / 3;
        for i in self.0.iter().copied() {
            let (rate, acceleration) = (from[n + i], from[2 * n + i]);
            let jumped = acceleration == JUMPED;
            let mean = (to[i] - from[i]) / dt;
            to[n + i] = if jumped { rate } else { mean + 0.5 * dt * acceleration };
            to[2 * n + i] = if jumped { 0.0 } else { (to[n + i] - rate) / dt };
        }
    }
}

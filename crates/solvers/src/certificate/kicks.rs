//! What straight link forces make of velocities in modes that swing within the steps.
//!
//! ```text
//! g = (BΦ)ⱼᵀ f̃,   κ = (ġ₁ − ġ₀)/ω²       kick of mode j where the straight line of g turns between two steps
//! |Σₖ κ e^{iωhk}| ≤ κ min(n, 1/|sin(ωh/2)|)   of n equal steps h
//! ```
//!
//! Where a step is about a whole number of periods the kicks of a smooth force add up: at the ends of the steps, which
//! are all that anybody sees, they look like a slow motion that lags behind. Steps twice as long do the same, so no
//! comparison with them shows it. Displacements take 1/ω of it, which is nothing.

use crate::record::Outputs;
use crate::step::State;
use crate::structure::ReducedSystem;

/// ω Δt from which on a mode swings within a step: half a period.
const WITHIN: f64 = std::f64::consts::PI;
/// Steps whose lengths differ by less than this share are equal.
const EQUAL: f64 = 1e-9;

/// A mode that swings within an output step.
struct Fast {
    omega: f64,
    /// (BΦ)ⱼ over the active link coordinates.
    links: Vec<f64>,
    /// g at the end of the last step, and its slope over it.
    force: f64,
    slope: Option<f64>,
    /// Largest velocity that its kicks may add up to.
    most: f64,
}

/// Follows the kicks of the fast modes of a run.
pub(crate) struct Kicks {
    modes: Vec<Fast>,
    /// What each output takes from the velocity of each of these modes.
    shares: Vec<Vec<f64>>,
    t: f64,
    length: f64,
    /// Steps of this length in a row.
    equal: usize,
}

impl Kicks {
    /// Of a run in output steps of a length, from a state; `omega`: of its modes. None where no output is a velocity of a
    /// fast mode.
    pub(crate) fn new(
        outputs: &Outputs,
        space: &ReducedSystem,
        omega: &[f64],
        dt: f64,
        (t, state): (f64, &State),
    ) -> Option<Self> {
        let fast: Vec<usize> = (0..omega.len()).filter(|j| omega[*j] * dt > WITHIN).collect();
        let shares: Vec<Vec<f64>> = outputs
            .shares(omega.len())
            .into_iter()
            .map(|[_, velocity, _]| fast.iter().map(|j| velocity[*j].abs()).collect())
            .collect();
        if shares.iter().flatten().all(|share| *share == 0.0) {
            return None;
        }
        let mut links = vec![vec![0.0; space.links.len()]; omega.len()];
        for a in 0..space.links.len() {
            for (j, share) in space.links.row(a).filter(|(j, _)| *j < omega.len()) {
                links[j][a] = share;
            }
        }
        let mode = |j: usize| {
            let links = std::mem::take(&mut links[j]);
            Fast { omega: omega[j], links, force: 0.0, slope: None, most: 0.0 }
        };
        let modes = fast.iter().copied().map(mode).collect();
        let mut it = Self { modes, shares, t, length: 0.0, equal: 0 };
        it.jump(t, state);
        Some(it)
    }

    /// The loads jump: link forces may turn there in truth.
    pub(crate) fn jump(&mut self, t: f64, state: &State) {
        self.t = t;
        for mode in &mut self.modes {
            mode.force = product(&mode.links, &state.pseudo);
            mode.slope = None;
        }
    }

    /// Takes note of an accepted step.
    pub(crate) fn follow(&mut self, t: f64, state: &State) {
        let length = t - self.t;
        if (length - self.length).abs() <= EQUAL * length {
            self.equal += 1;
        } else {
            (self.length, self.equal) = (length, 1);
        }
        self.t = t;
        for mode in &mut self.modes {
            let force = product(&mode.links, &state.pseudo);
            let slope = (force - mode.force) / length;
            if mode.omega * length > WITHIN
                && let Some(before) = mode.slope
            {
                let kick = (slope - before).abs() / (mode.omega * mode.omega);
                let sum = 1.0 / (0.5 * mode.omega * length).sin().abs();
                mode.most = mode.most.max(kick * sum.min(self.equal as f64));
            }
            mode.force = force;
            mode.slope = Some(slope);
        }
    }

    /// How far each output may be off by them.
    pub(crate) fn errors(&self) -> impl Iterator<Item = f64> + '_ {
        let of = |shares: &Vec<f64>| {
            shares.iter().zip(&self.modes).map(|(share, mode)| share * mode.most).sum()
        };
        self.shares.iter().map(of)
    }
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

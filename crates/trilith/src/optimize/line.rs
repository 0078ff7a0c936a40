//! How far to go along a direction: a line search for functions with kinks.
//!
//! ```text
//! f(x + t p) ≤ f(x) + c₁ t ∇f(x)·p        enough less          else t is too long
//! ∇f(x + t p)·p ≥ c₂ ∇f(x)·p              slope risen enough   else t is too short
//! ```
//!
//! By halving between the two \[Lewis & Overton 2013\]: unlike searches for the strong conditions, it ends where a peak moves to
//! another place or time and the slope jumps from one side to the other; the method of Broyden, Fletcher, Goldfarb and Shanno
//! converges on such functions with it, and yᵀs > 0, as it needs. A run that fails is one that went too far.

use argmin::core::{
    CostFunction, Error, Gradient, IterState, KV, LineSearch, Problem, Solver, State,
    TerminationReason,
};

const ENOUGH: f64 = 1e-4;
const RISEN: f64 = 0.9;
/// Runs of one search at most.
const MOST: usize = 6;
/// Longest step of a variable: a sine is about straight so far.
const LONGEST: f64 = 0.8;

/// No point along the direction is better.
#[derive(Clone, Copy, Debug, thiserror::Error)]
#[error("nothing along the direction is better")]
pub(super) struct NothingBetter;

/// The search.
#[derive(Clone, Debug)]
pub(super) struct WeakWolfe {
    direction: Vec<f64>,
    first: f64,
}

impl Default for WeakWolfe {
    fn default() -> Self {
        Self { direction: Vec::new(), first: 1.0 }
    }
}

impl LineSearch<Vec<f64>, f64> for WeakWolfe {
    fn search_direction(&mut self, direction: Vec<f64>) {
        self.direction = direction;
    }

    fn initial_step_length(&mut self, length: f64) -> Result<(), Error> {
        self.first = length;
        Ok(())
    }
}

/// A state of a search over a line: variables and their derivatives.
pub(super) type LineState = IterState<Vec<f64>, Vec<f64>, (), (), (), f64>;

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl<O> Solver<O, LineState> for WeakWolfe
where
    O: CostFunction<Param = Vec<f64>, Output = f64>
        + Gradient<Param = Vec<f64>, Gradient = Vec<f64>>,
{
    fn name(&self) -> &str {
        "line search for functions with kinks"
    }

    /// All of it at once.
    fn next_iter(
        &mut self,
        problem: &mut Problem<O>,
        mut state: LineState,
    ) -> Result<(LineState, Option<KV>), Error> {
        let (Some(from), Some(slopes)) = (state.take_param(), state.take_gradient()) else {
            return Err(NothingBetter.into());
        };
        let (start, slope) = (state.get_cost(), dot(&slopes, &self.direction));
        if slope >= 0.0 || slope.is_nan() {
            return Err(NothingBetter.into());
        }
        let most = self.direction.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let (mut short, mut long) = (0.0, f64::INFINITY);
        let mut t = self.first.min(LONGEST / most);
        let mut best = None;
        for _ in 0..MOST {
            let at: Vec<f64> = from.iter().zip(&self.direction).map(|(x, p)| x + t * p).collect();
            let cost = problem.cost(&at)?;
            if cost <= start + ENOUGH * t * slope {
                let by = problem.gradient(&at)?;
                let there = dot(&by, &self.direction);
                short = t;
                best = Some((at, cost, by));
                // No further than a sine goes straight.
                if there >= RISEN * slope || t * most >= LONGEST {
                    break;
                }
                t = if long.is_finite() {
                    0.5 * (short + long)
                } else {
                    (2.0 * t).min(LONGEST / most)
                };
            } else {
                long = t;
                // The lowest point of the parabola through what is known, where that is the start alone.
                let parabola = -0.5 * slope * t * t / (cost - start - slope * t);
                t = match parabola {
                    p if short == 0.0 && p.is_finite() => p.clamp(0.1 * t, 0.5 * t),
                    _ => 0.5 * (short + long),
                };
            }
        }
        let (at, cost, by) = best.ok_or(NothingBetter)?;
        let state = state.param(at).cost(cost).gradient(by);
        Ok((state.terminate_with(TerminationReason::SolverConverged), None))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use argmin::core::Executor;

    /// |x − 1| + (x − 1)²/4: a kink at its least value.
    struct Kink;

    impl CostFunction for Kink {
        type Param = Vec<f64>;
        type Output = f64;
        fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
            Ok((x[0] - 1.0).abs() + 0.25 * (x[0] - 1.0).powi(2))
        }
    }

    impl Gradient for Kink {
        type Param = Vec<f64>;
        type Gradient = Vec<f64>;
        fn gradient(&self, x: &Vec<f64>) -> Result<Vec<f64>, Error> {
            Ok(vec![(x[0] - 1.0).signum() + 0.5 * (x[0] - 1.0)])
        }
    }

    fn search(from: f64, direction: f64) -> Result<f64, Error> {
        let mut line = WeakWolfe::default();
        line.search_direction(vec![direction]);
        let (at, by) = (vec![from], Kink.gradient(&vec![from])?);
        let cost = Kink.cost(&at)?;
        let set = |state: LineState| state.param(at).gradient(by).cost(cost);
        let done = Executor::new(Kink, line).configure(set).ctrlc(false).run()?;
        Ok(done.state.get_param().map_or(f64::NAN, |x| x[0]))
    }

    #[test]
    fn a_search_passes_a_kink_and_ends() {
        let x = search(0.5, 0.75).unwrap();
        assert!(x > 1.0 && x < 1.5, "{x}");
    }

    #[test]
    fn nothing_better_is_told() {
        assert!(search(0.5, -1.0).unwrap_err().is::<NothingBetter>());
        assert!(search(1.0, 1.0).unwrap_err().is::<NothingBetter>());
    }
}

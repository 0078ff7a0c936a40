//! The search: quasi-Newton steps on the augmented Lagrangian of goal and limits.
//!
//! ```text
//! L(y) = F/F₀ + Σ ρ/2 (max(0, gᵢ + λᵢ/ρ)² − (λᵢ/ρ)²)        gᵢ ≤ 0: limits, as shares of their bounds
//! λᵢ ← max(0, λᵢ + ρ gᵢ)                                    once L is small enough
//! ```
//!
//! The method of multipliers (Hestenes, Powell, Rockafellar; Nocedal & Wright 2006, ch. 17.3): limits come out met to the
//! tolerance, where a penalty alone leaves them broken by its own size. Steps are those of BFGS from the crate `argmin`; what it knows of the
//! curvature is kept when multipliers move.

use super::course::{Course, Made, Refusal};
use super::line::{NothingBetter, WeakWolfe, dot};
use super::terms::Valued;
use super::{OptimizeError, Stop};
use argmin::core::{CostFunction, Error, Executor, Gradient, IterState};
use argmin::solver::quasinewton::BFGS;
use std::cell::RefCell;

/// Derivatives of L by y that are none.
const FLAT: f64 = 3e-4;
/// Limits hold so well, as share of their bounds.
pub(super) const HOLDS: f64 = 1e-3;
/// Weight ρ at the start, and the largest one.
const WEIGHT: [f64; 2] = [10.0, 1e4];
/// The first step of a search that knows nothing of the curvature, in y.
const FIRST: f64 = 0.25;
/// Less of a gain is none, as share of the goal at the start: what the steps of runs make of a result is about that.
const GAIN: f64 = 5e-5;
/// Limits that are farther from their bounds at the start, as share of these, do not pull yet.
const NEAR: f64 = 0.05;
/// Steps between two changes of the multipliers at most.
const STEPS: usize = 8;

/// L, as the crate asks for it.
struct Lagrangian<'c, 'a> {
    course: &'c RefCell<Course<'a>>,
    multipliers: &'c [f64],
    weight: f64,
}

impl Lagrangian<'_, '_> {
    /// Its value and derivatives; infinite where a run fails.
    fn at(&self, y: &[f64]) -> Result<(f64, Vec<f64>), Refusal> {
        let mut course = self.course.borrow_mut();
        let Some(run) = course.at(y)? else {
            return Ok((f64::INFINITY, vec![0.0; y.len()]));
        };
        let (mut value, mut by) = (run.goal.value, run.goal.by.clone());
        for (limit, multiplier) in run.limits.iter().zip(self.multipliers) {
            let shift = multiplier / self.weight;
            let beyond = (limit.value + shift).max(0.0);
            value += 0.5 * self.weight * (beyond * beyond - shift * shift);
            by.iter_mut().zip(&limit.by).for_each(|(by, x)| *by += self.weight * beyond * x);
        }
        Ok((value, by))
    }
}

impl CostFunction for Lagrangian<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, y: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.at(y)?.0)
    }
}

impl Gradient for Lagrangian<'_, '_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;
    fn gradient(&self, y: &Vec<f64>) -> Result<Vec<f64>, Error> {
        Ok(self.at(y)?.1)
    }
}

/// How a search ended.
pub(super) struct Ended {
    pub stop: Stop,
    pub multipliers: Vec<f64>,
    /// How often it began anew along the steepest way.
    pub restarts: usize,
}

type Matrix = Vec<Vec<f64>>;

fn diagonal(n: usize, value: f64) -> Matrix {
    (0..n).map(|i| (0..n).map(|j| if i == j { value } else { 0.0 }).collect()).collect()
}

fn size(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// The state of a search between two steps.
struct Place {
    y: Vec<f64>,
    /// Inverse of the curvature; none where nothing is known of it.
    inverse: Option<Matrix>,
    /// Its size in the last step.
    scale: Option<f64>,
}

impl Place {
    /// Gives up what is known of the curvature: first its form, then its size; false where there is nothing left to give up.
    fn forget(&mut self) -> bool {
        self.inverse.take().is_some() || self.scale.take().is_some()
    }
}

/// One step of BFGS.
fn step(of: Lagrangian<'_, '_>, place: &Place, (value, by): (f64, &[f64])) -> Result<Place, Error> {
    let n = place.y.len();
    // A first step tells how large the curvature is; the crate knows no scale of its own.
    let known = place.inverse.is_some() || place.scale.is_some();
    let scale = place.scale.unwrap_or(FIRST / size(by));
    let inverse = place.inverse.clone().unwrap_or_else(|| diagonal(n, scale));
    let (course, multipliers, weight) = (of.course, of.multipliers, of.weight);
    let set = |state: IterState<Vec<f64>, Vec<f64>, (), Matrix, (), f64>| {
        let state = state.param(place.y.clone()).cost(value).gradient(by.to_vec());
        state.inv_hessian(inverse).max_iters(1)
    };
    let bfgs =
        BFGS::new(WeakWolfe::default()).with_tolerance_grad(0.0)?.with_tolerance_cost(0.0)?;
    let mut state = Executor::new(of, bfgs).configure(set).ctrlc(false).run()?.state;
    let y = state.take_param().ok_or(NothingBetter)?;
    let after = Lagrangian { course, multipliers, weight }.at(&y)?.1;
    let moved: Vec<f64> = y.iter().zip(&place.y).map(|(a, b)| a - b).collect();
    let bent: Vec<f64> = after.iter().zip(by).map(|(a, b)| a - b).collect();
    let along = dot(&moved, &bent);
    // Where a line search has been cut short, the slope need not have risen, and the curvature would come out wrong.
    let convex = along > 1e-12 * size(&moved) * size(&bent);
    let inverse = if known && convex { state.take_inv_hessian() } else { None };
    let scale = if convex { Some(along / dot(&bent, &bent)) } else { place.scale };
    Ok(Place { y, inverse, scale })
}

/// Multipliers of the limits that are near their bounds, with which the derivatives of goal and limits balance best.
fn balanced(run: &Made) -> Vec<f64> {
    let mut multipliers = vec![0.0; run.limits.len()];
    let near = |limit: &Valued| limit.value > -NEAR && limit.by.iter().any(|x| *x != 0.0);
    // Least squares without negative ones, one after the other.
    for _ in 0..20 {
        for i in (0..multipliers.len()).filter(|i| near(&run.limits[*i])) {
            let mut rest = run.goal.by.clone();
            for (j, limit) in run.limits.iter().enumerate().filter(|(j, _)| *j != i) {
                rest.iter_mut().zip(&limit.by).for_each(|(r, x)| *r += multipliers[j] * x);
            }
            let own = &run.limits[i].by;
            multipliers[i] = (-dot(&rest, own) / dot(own, own)).max(0.0);
        }
    }
    multipliers
}

/// Searches until there is no better place, or runs are spent.
///
/// # Errors
/// What is wrong with the goal or a limit in a run.
pub(super) fn search(
    course: &RefCell<Course<'_>>,
    start: Vec<f64>,
) -> Result<Ended, OptimizeError> {
    let limits = course.borrow().limits();
    let mut ended = Ended { stop: Stop::Smallest, multipliers: vec![0.0; limits], restarts: 0 };
    match seek(course, start, &mut ended) {
        Ok(stop) | Err(Refusal::Stopped(stop)) => Ok(Ended { stop, ..ended }),
        Err(Refusal::Wrong(error)) => Err(error),
    }
}

/// The search itself; why it came to its end.
fn seek(course: &RefCell<Course<'_>>, start: Vec<f64>, ended: &mut Ended) -> Result<Stop, Refusal> {
    let limits = ended.multipliers.len();
    if let Some(run) = course.borrow_mut().at(&start)? {
        ended.multipliers = balanced(run);
    }
    let mut weight = WEIGHT[0];
    let mut place = Place { y: start, inverse: None, scale: None };
    let mut flat = if limits == 0 { FLAT } else { 0.03 };
    // How far limits were broken at the end of the search before, and how often nothing could be done about that.
    let (mut worst_before, mut stalls) = (f64::INFINITY, 0);
    loop {
        let (mut kink, mut is_flat, mut won, mut quiet) = (false, false, 0.0, 0);
        for taken in 0.. {
            let of = Lagrangian { course, multipliers: &ended.multipliers, weight };
            let (value, by) = of.at(&place.y)?;
            is_flat = size(&by) <= flat;
            if is_flat || (limits > 0 && taken >= STEPS) {
                break;
            }
            let next = match step(of, &place, (value, &by)) {
                Ok(next) => next,
                Err(error) => {
                    // Nothing is better along the way, unless it was something else.
                    if let Ok(refusal) = error.downcast::<Refusal>() {
                        return Err(refusal);
                    }
                    if !place.forget() {
                        kink = true;
                        break;
                    }
                    ended.restarts += 1;
                    continue;
                }
            };
            let of = Lagrangian { course, multipliers: &ended.multipliers, weight };
            let gain = value - of.at(&next.y)?.0;
            place = next;
            won += gain;
            if gain >= GAIN {
                quiet = 0;
                continue;
            }
            // Slow as such steps are, one of another kind may still find a way.
            quiet += 1;
            if quiet > 1 {
                kink = true;
                break;
            }
            place.inverse = None;
            ended.restarts += 1;
        }
        if limits == 0 {
            return Ok(if kink { Stop::Kink } else { Stop::Smallest });
        }
        let beyond = match course.borrow_mut().at(&place.y)? {
            Some(run) => run.limits.iter().map(|l| l.value).collect::<Vec<_>>(),
            None => return Ok(Stop::Kink),
        };
        // How far a limit is beyond its bound, or pulls although it is not reached.
        let off = beyond.iter().zip(&ended.multipliers).map(|(g, m)| g.max(-m / weight).abs());
        let worst = off.fold(0.0, f64::max);
        if worst <= HOLDS && (kink || (is_flat && flat <= FLAT)) {
            return Ok(if kink { Stop::Kink } else { Stop::Smallest });
        }
        stalls = if won < GAIN && worst > 0.5 * worst_before { stalls + 1 } else { 0 };
        if stalls > 2 {
            return Ok(Stop::Limits);
        }
        for (multiplier, g) in ended.multipliers.iter_mut().zip(&beyond) {
            *multiplier = (*multiplier + weight * g).max(0.0);
        }
        if worst > 0.3 * worst_before && worst > HOLDS {
            weight = (4.0 * weight).min(WEIGHT[1]);
            place.inverse = None;
            place.scale = None;
        }
        worst_before = worst;
        flat = (0.2 * flat).max(FLAT);
    }
}

//! Directions that have neither mass nor damping, in direct integration.
//!
//! They follow loads and links at once, and Newmark's rule would let the rates of one step ring for ever in the next
//! ones: κ q = s leaves q̇ to `q̇₁ = 2 Δq/Δt − q̇₀`. Theirs are the mean ones of a step and half a step of the
//! acceleration before, as FNA's are: of second order, and errors die out. Where a load has jumped at the start of a
//! step, they are those before. Where one bends, the rate jumps, and the acceleration before says nothing of the step:
//! it goes on no further than the mean rate says it does, and not against it.

use super::reduced_system::ReducedSystem;
use std::collections::BTreeMap;
use trilith_linalg::{LinalgError, Sparse, Triplets};
use trilith_system::Massless;

/// The acceleration of a massless coordinate where its load has just jumped: too little to be one.
pub(crate) const JUMPED: f64 = f64::MIN_POSITIVE;

/// An acceleration as a number, which the mark of a jump is none of.
#[inline]
pub(crate) fn acceleration(a: f64) -> f64 {
    if a == JUMPED { 0.0 } else { a }
}

/// The rate at the end of a step from that at its start and the mean one; `more`: what the acceleration before would
/// add in half a step.
#[inline]
pub(crate) fn rate_at_end(start: f64, mean: f64, more: f64) -> f64 {
    let so_far = mean - start;
    match branch_at_end(start, mean, more) {
        Branch::Mean => mean,
        Branch::More => mean + more,
        Branch::Twice => mean + so_far,
    }
}

/// How far the mean rate is gone beyond at the end of a step.
enum Branch {
    /// Not at all.
    Mean,
    /// By what the acceleration before adds.
    More,
    /// As far as the rate has come to it.
    Twice,
}

#[inline]
fn branch_at_end(start: f64, mean: f64, more: f64) -> Branch {
    let so_far = mean - start;
    if more * so_far <= 0.0 {
        Branch::Mean
    } else if more.abs() < so_far.abs() {
        Branch::More
    } else {
        Branch::Twice
    }
}

/// Accelerations after a change of the load that alone would make the others.
pub(crate) fn accelerate_at_once(accelerations: &mut [f64], change: &[f64]) {
    for (x, y) in accelerations.iter_mut().zip(change) {
        *x = if *y == JUMPED { JUMPED } else { *x + y };
    }
}

/// The directions, orthonormal to each other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Followers(Vec<Vec<(usize, f64)>>);

impl Followers {
    /// Those of a space; `damped`: active link coordinates of laws whose forces depend on rates. A dashpot between two
    /// that hang together takes their difference out alone.
    pub(crate) fn new(space: &ReducedSystem, damped: &[usize]) -> Result<Self, LinalgError> {
        // Where no effective stiffnesses are, the stiffness holds every such direction, and Rayleigh's share of it damps it.
        if space.rayleigh[1] != 0.0 && space.effective_k.iter().all(|k| *k == 0.0) {
            return Ok(Self::default());
        }
        let massless = Massless::new(&space.mass)?;
        if massless.is_empty() {
            return Ok(Self::default());
        }
        let row = |a: &usize| massless.row(&space.links.row(*a).collect::<Vec<_>>());
        let rows: Vec<Vec<f64>> = damped.iter().map(row).collect();
        let own = massless.undamped(&damping(space, &massless), &rows)?;
        Ok(Self(orthonormal(own.directions.iter().map(<[_]>::to_vec).collect())))
    }

    /// Their rates and accelerations at the end of a step.
    pub(crate) fn complete(&self, from: &[f64], to: &mut [f64], dt: f64) {
        let n = from.len() / 3;
        for direction in &self.0 {
            let along = |x: &[f64]| -> f64 { direction.iter().map(|(i, c)| c * x[*i]).sum() };
            let jumped = direction.iter().any(|(i, _)| from[2 * n + i] == JUMPED);
            let rate = along(&from[n..2 * n]);
            let mean = (along(&to[..n]) - along(&from[..n])) / dt;
            let acceleration = along(&from[2 * n..]);
            let new = if jumped { rate } else { rate_at_end(rate, mean, 0.5 * dt * acceleration) };
            let of_new = if jumped { 0.0 } else { (new - rate) / dt };
            let more = [new - along(&to[n..2 * n]), of_new - along(&to[2 * n..])];
            for (i, c) in direction {
                to[n + i] += c * more[0];
                to[2 * n + i] += c * more[1];
            }
        }
    }
}

impl Followers {
    /// How their rates and accelerations at the end of a step move, where the ends of the step move so: the derivative of
    /// [`complete`](Self::complete) along the branch that the step took.
    pub(crate) fn complete_moves(
        &self,
        [from, to]: [&[f64]; 2],
        moves_from: &[f64],
        moves_to: &mut [f64],
        dt: f64,
    ) {
        let n = from.len() / 3;
        for direction in &self.0 {
            let along = |x: &[f64]| -> f64 { direction.iter().map(|(i, c)| c * x[*i]).sum() };
            let jumped = direction.iter().any(|(i, _)| from[2 * n + i] == JUMPED);
            let [rate, moved_rate] = [from, moves_from].map(|x| along(&x[n..2 * n]));
            let mean = (along(&to[..n]) - along(&from[..n])) / dt;
            let moved_mean = (along(&moves_to[..n]) - along(&moves_from[..n])) / dt;
            let [more, moved_more] = [from, moves_from].map(|x| 0.5 * dt * along(&x[2 * n..]));
            let new = match branch_at_end(rate, mean, more) {
                _ if jumped => moved_rate,
                Branch::Mean => moved_mean,
                Branch::More => moved_mean + moved_more,
                Branch::Twice => 2.0 * moved_mean - moved_rate,
            };
            let of_new = if jumped { 0.0 } else { (new - moved_rate) / dt };
            let add = [new - along(&moves_to[n..2 * n]), of_new - along(&moves_to[2 * n..])];
            for (i, c) in direction {
                moves_to[n + i] += c * add[0];
                moves_to[2 * n + i] += c * add[1];
            }
        }
    }
}

/// Damping of massless directions, Rayleigh's included.
fn damping(space: &ReducedSystem, massless: &Massless) -> Sparse {
    let rest = massless.project(&space.damping);
    let of_stiffness = space.rayleigh[1];
    if of_stiffness == 0.0 {
        return rest;
    }
    let k = massless.project(&space.stiffness);
    let sum = Sparse::combine(&[(1.0, &rest), (of_stiffness, &k)]);
    // What is left where effective stiffnesses cancel is rounding.
    let (own, rest, k) = (sum.diagonal(), rest.diagonal(), k.diagonal());
    let damps = |i: usize| own[i] > 1e-12 * (rest[i].abs() + of_stiffness * k[i]);
    let mut kept = Triplets::new(own.len(), own.len());
    let damped = sum.entries().filter(|(i, j, _)| damps(*i) && damps(*j));
    damped.for_each(|(i, j, v)| kept.add(i, j, v));
    kept.build()
}

/// Directions that share coordinates made square to each other, all of length one.
fn orthonormal(directions: Vec<Vec<(usize, f64)>>) -> Vec<Vec<(usize, f64)>> {
    let mut all: Vec<BTreeMap<usize, f64>> = Vec::with_capacity(directions.len());
    let mut of: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for direction in directions {
        let mut own: BTreeMap<usize, f64> = direction.into_iter().collect();
        let mut others: Vec<usize> =
            own.keys().flat_map(|i| of.get(i).into_iter().flatten().copied()).collect();
        others.sort_unstable();
        others.dedup();
        for other in others {
            let share: f64 = all[other].iter().filter_map(|(i, x)| Some(x * own.get(i)?)).sum();
            for (i, x) in &all[other] {
                *own.entry(*i).or_insert(0.0) -= share * x;
            }
        }
        let length = own.values().map(|x| x * x).sum::<f64>().sqrt();
        own.values_mut().for_each(|x| *x /= length);
        own.keys().for_each(|i| of.entry(*i).or_default().push(all.len()));
        all.push(own);
    }
    all.into_iter().map(|own| own.into_iter().collect()).collect()
}

//! Initial rates of massless directions, by those of the directions with mass.

use super::joints::{Followers, viscous_rows};
use crate::error::SolveError;
use crate::step::{LinksBefore, State};
use crate::vector::largest;
use trilith_linalg::{Ldlt, Sparse};
use trilith_model::Model;
use trilith_system::{System, Tangents};

/// Most iterations for the rates of what dashpots hold, and the share of the forces that they may leave.
const ITERATIONS: usize = 40;
const LEFT: f64 = 1e-10;

/// Rates of what has no mass. What dashpots hold, of elements or links, moves so that Nᵀ (K u + C v + Bᵀ f(d, v)) = 0, and
/// stays as it is where no such rates are found; the rest goes along as its springs and the tangents of its links say.
pub(crate) fn rates(
    model: &Model,
    system: &System,
    before: &LinksBefore,
    u: &[f64],
    v: &mut [f64],
) -> Result<(), SolveError> {
    if system.massless.is_empty() {
        return Ok(());
    }
    let balance = RateBalance::new(model, system, before, u);
    // At rest there is nothing to go along with.
    if balance.own.is_empty() && v.iter().all(|v| *v == 0.0) {
        return Ok(());
    }
    let mut at = v.to_vec();
    let mut found = balance.at(&at);
    for _ in 0..ITERATIONS {
        if largest(&found.left) <= LEFT * found.size {
            balance.go_along(&found.tangents.k, &mut at)?;
            v.copy_from_slice(&at);
            return Ok(());
        }
        let step = balance.correction(&found)?;
        let Some(shorter) = balance.search(&at, &found, &step) else { return Ok(()) };
        // In equilibrium nothing of the forces is left to measure by: the largest on the way.
        let size = found.size.max(shorter.1.size);
        (at, found) = shorter;
        found.size = size;
    }
    Ok(())
}

/// The balance of massless directions that dashpots hold, over their rates.
struct RateBalance<'a> {
    model: &'a Model,
    system: &'a System,
    before: &'a LinksBefore,
    /// Deformations of the links, flat, and −K u.
    d: Vec<f64>,
    rest: Vec<f64>,
    damping: Sparse,
    /// Rows of what is viscous in links, over the massless directions.
    rows: Vec<Vec<f64>>,
    /// The directions that dashpots hold.
    own: Vec<usize>,
}

/// What is left of the forces at some rates, the largest force there, and the tangents of the links.
struct Imbalance {
    left: Vec<f64>,
    size: f64,
    tangents: Tangents,
}

impl<'a> RateBalance<'a> {
    fn new(model: &'a Model, system: &'a System, before: &'a LinksBefore, u: &[f64]) -> Self {
        let (massless, links) = (&system.massless, &system.links);
        let damped = massless.project(&system.element_damping).diagonal();
        let mut held: Vec<bool> = damped.iter().map(|c| *c != 0.0).collect();
        let rows = viscous_rows(model, system);
        for row in &rows {
            held.iter_mut().zip(row).for_each(|(held, c)| *held |= *c != 0.0);
        }
        let own = (0..held.len()).filter(|i| held[*i]).collect();
        let mut d = vec![0.0; links.len()];
        links.deform(u, &vec![0.0; system.reduction.prescribed.len()], &mut d);
        let mut rest = system.stiffness.mul(u);
        rest.iter_mut().for_each(|x| *x = -*x);
        Self { model, system, before, d, rest, damping: system.damping(), rows, own }
    }

    /// What is left at these rates.
    fn at(&self, v: &[f64]) -> Imbalance {
        let (massless, links) = (&self.system.massless, &self.system.links);
        let mut rate = vec![0.0; links.len()];
        links.deform(v, &vec![0.0; self.system.reduction.prescribed.len()], &mut rate);
        let state = State::of_links(self.model, links, self.before, self.d.clone(), rate);
        let mut left = self.rest.clone();
        self.damping.mul_add(-1.0, v, &mut left);
        let force = massless.load(&left).iter().map(|x| x.abs()).fold(0.0, f64::max);
        links.spread(-1.0, &state.f, &mut left);
        let left = self.own.iter().map(|i| massless.load(&left)[*i]).collect();
        Imbalance { left, size: force.max(largest(&state.f)), tangents: state.tangents }
    }

    /// The Newton correction of the rates of the directions that dashpots hold.
    fn correction(&self, found: &Imbalance) -> Result<Vec<f64>, SolveError> {
        let links = &self.system.links;
        let mut of_links = vec![0.0; links.len()];
        for (flat, place) in links.active.iter().zip(&links.diagonal) {
            of_links[*flat] = found.tangents.c[*place];
        }
        let sum = Sparse::combine(&[(1.0, &self.damping), (1.0, &self.system.springs(&of_links))]);
        let block = self.system.massless.project(&sum).block(&self.own, &self.own);
        let mut step = found.left.clone();
        Ldlt::with_rigid_zeros(&block)?.solve(&mut step);
        Ok(step)
    }

    /// The largest part of a correction, by halving, that leaves less; none where that is next to nothing.
    fn search(&self, at: &[f64], found: &Imbalance, step: &[f64]) -> Option<(Vec<f64>, Imbalance)> {
        let massless = &self.system.massless;
        let mut all = vec![0.0; massless.len()];
        self.own.iter().zip(step).for_each(|(i, y)| all[*i] = *y);
        let mut share = 1.0;
        loop {
            let mut tried = at.to_vec();
            massless.expand(share, &all, &mut tried);
            let next = self.at(&tried);
            if largest(&next.left) < largest(&found.left) {
                return Some((tried, next));
            }
            share *= 0.5;
            if share < 1e-6 {
                return None;
            }
        }
    }

    /// Makes the others go along: of links that answer the way they are, of others what the structure gives them.
    fn go_along(&self, k: &[f64], v: &mut [f64]) -> Result<(), SolveError> {
        let links = &self.system.links;
        let mut stiff = links.effective.clone();
        for (flat, place) in links.active.iter().zip(&links.diagonal) {
            if k[*place] > 0.0 {
                stiff[*flat] = k[*place];
            }
        }
        let force = self.system.stiffness_with(&stiff).mul(v);
        Followers::new(self.system, &stiff, &self.rows)?.answer(-1.0, &force, v);
        Ok(())
    }
}

//! LDLᵀ with chosen equations eliminated last, solved in stages.
//!
//! ```text
//!     ┌ L        ┐        front: what nobody looks at before the solution is complete
//! L = │          │
//!     └ N    T   ┘        tail: the chosen equations; T D T ᵀ is their Schur complement
//!
//!   forward       y = L⁻¹ r                          the whole factor, once
//!   tail          x_t = T⁻ᵀ D⁻¹ y_t                  the tail alone
//!   (r changes on the tail: y_t += T⁻¹ Δr_t)         the tail alone
//!   finish        x_f = L⁻ᵀ (D⁻¹ y_f − Nᵀ x_t)       the whole factor, once more
//! ```
//!
//! So the solution at the tail is known after half of the work, and may still be changed by loads on the
//! tail before the other half. The matrices of a model have one pattern whatever the step size: the plan,
//! made once, holds all that does not depend on values.

use super::backend;
use super::failure::all_finite;
use super::numeric::{Elimination, Groups, Summed, factorise};
use super::ordering::{self, Pattern};
use super::packing::packed;
use super::substitution::{Node, Panels};
use super::subtrees::{self, Factor, Subtrees};
use super::together::BESIDE;
use crate::large::Large;
use crate::threads::share;
use crate::{LinalgError, Sparse};
use faer::Side;
use faer::perm::PermRef;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};
use std::sync::{Arc, Mutex, PoisonError};

/// Columns up to which supernodes are merged, and the share of zeros that may be stored for it.
const RELAX: &[(usize, f64)] = &[(4, 0.5), (16, 0.3), (48, 0.1), (usize::MAX, 0.02)];

/// Columns of a supernode at most: wider ones are cut, so that threads have parts of them.
const WIDEST: usize = 256;

/// Order of elimination and structure of the factor of all matrices of one pattern.
#[derive(Debug)]
pub struct StagedPlan {
    /// Equation of each place, and place of each equation.
    equations: Vec<u32>,
    places: Vec<u32>,
    /// First place of the tail.
    split: usize,
    front: Panels,
    /// Counted from `split`.
    tail: Panels,
    elimination: Elimination,
    /// Of a front without a tail.
    subtrees: Option<Subtrees>,
}

impl StagedPlan {
    /// A plan for sums of these symmetric matrices, with the equations `last` (sorted, each once) in the
    /// tail. Entries that are zero in all of them are left out.
    ///
    /// # Errors
    /// Where the backend refuses.
    pub fn new(parts: &[&Sparse], last: &[usize]) -> Result<Arc<Self>, LinalgError> {
        let pattern = union(parts);
        let n = pattern.order();
        let forward = ordering::order(&pattern, last)?;
        let mut inverse = vec![0; n];
        forward.iter().enumerate().for_each(|(place, i)| inverse[*i] = place);
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            supernodal_params: SymbolicSupernodalParams { relax: Some(RELAX) },
            ..Default::default()
        };
        let symbolic = factorize_symbolic_cholesky(
            SymbolicSparseColMatRef::new_checked(n, n, &pattern.offsets, None, &pattern.rows),
            Side::Lower,
            SymmetricOrdering::Custom(PermRef::new_checked(&forward, &inverse, n)),
            params,
        )
        .map_err(backend)?;
        let split = n - last.len();
        let (front, tail) = panels(&symbolic, split);
        let elimination = Elimination::new(Groups { front: &front, tail: &tail, split }, n);
        let narrow = |all: Vec<usize>| all.into_iter().map(|i| i as u32).collect();
        let (equations, places) = (narrow(forward), narrow(inverse));
        let mut plan = Self { equations, places, split, front, tail, elimination, subtrees: None };
        if last.is_empty() && plan.stored() >= subtrees::FROM {
            plan.subtrees = Subtrees::new(&plan.elimination, &plan.front);
        }
        Ok(Arc::new(plan))
    }

    fn groups(&self) -> Groups<'_> {
        Groups { front: &self.front, tail: &self.tail, split: self.split }
    }

    /// Equation of each place in the order of elimination; those of the tail come last.
    #[must_use]
    pub fn equations(&self) -> &[u32] {
        &self.equations
    }

    /// Number of equations before the tail.
    #[must_use]
    pub fn split(&self) -> usize {
        self.split
    }

    /// Number of values in a factor.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.front.nodes.iter().chain(&self.tail.nodes).map(Node::packed).sum()
    }

    /// Values that the substitutions need as workspace.
    #[must_use]
    pub fn workspace(&self) -> usize {
        self.front.height().max(self.tail.height())
    }
}

/// The lower triangle of the sum's pattern.
fn union(parts: &[&Sparse]) -> Pattern {
    let n = parts.first().map_or(0, |a| a.columns());
    let mut pattern = Pattern { offsets: vec![0], rows: Vec::new() };
    let mut seen = vec![usize::MAX; n];
    for j in 0..n {
        let start = pattern.rows.len();
        seen[j] = j;
        pattern.rows.push(j);
        for part in parts {
            let (rows, values) = part.column(j);
            for (i, v) in rows.iter().zip(values) {
                if *i > j && *v != 0.0 && seen[*i] != j {
                    seen[*i] = j;
                    pattern.rows.push(*i);
                }
            }
        }
        pattern.rows[start..].sort_unstable();
        pattern.offsets.push(pattern.rows.len());
    }
    pattern
}

/// The supernodes, cut where the tail begins and where they are wide.
fn panels(symbolic: &SymbolicCholesky<usize>, split: usize) -> (Panels, Panels) {
    let (mut front, mut tail) = (Panels::default(), Panels::default());
    let SymbolicCholeskyRaw::Supernodal(symbolic) = symbolic.raw() else {
        return (front, tail);
    };
    let mut stored = 0;
    for k in 0..symbolic.n_supernodes() {
        let (start, end) = (symbolic.supernode_begin()[k], symbolic.supernode_end()[k]);
        let below = symbolic.supernode(k).pattern();
        let cut = split.clamp(start, end);
        for (from, to, group, base) in [(start, cut, &mut front, 0), (cut, end, &mut tail, split)] {
            let pieces = (to - from).div_ceil(WIDEST).max(1);
            let width = (to - from).div_ceil(pieces).max(1);
            for from in (from..to).step_by(width) {
                let to = to.min(from + width);
                let node = Node {
                    start: (from - base) as u32,
                    columns: (to - from) as u32,
                    height: (end - from + below.len()) as u32,
                    values: stored,
                    rows: group.rows.len(),
                };
                stored += node.packed();
                group.nodes.push(node);
                let rows = (to..end).chain(below.iter().copied());
                group.rows.extend(rows.map(|r| (r - base) as u32));
            }
        }
    }
    (front, tail)
}

/// A factorised symmetric matrix, solved in stages. Vectors are in the order of elimination, see
/// [`StagedPlan::equations`].
#[derive(Debug)]
pub struct StagedLdlt {
    plan: Arc<StagedPlan>,
    values: Large,
    /// 1/D.
    reciprocal: Vec<f64>,
}

impl StagedLdlt {
    /// Factorises Σ factor · matrix; the matrices must be those of the plan.
    ///
    /// # Errors
    /// [`LinalgError::Singular`] at an exactly zero pivot, [`LinalgError::NotFinite`] where numbers overflow.
    pub fn new(plan: &Arc<StagedPlan>, parts: &[(f64, &Sparse)]) -> Result<Self, LinalgError> {
        for (_, part) in parts {
            all_finite(part)?;
        }
        let StagedPlan { equations, places, .. } = &**plan;
        let groups = plan.groups();
        let made = factorise(&plan.elimination, groups, Summed { parts, equations, places })?;
        let (values, reciprocal) = packed(&plan.elimination, groups, made);
        Ok(Self { plan: Arc::clone(plan), values, reciprocal })
    }

    /// Factorises Σ factor · matrix for solutions alone: without a tail, and without what other matrices of the
    /// pattern would need.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn alone(parts: &[(f64, &Sparse)]) -> Result<Self, LinalgError> {
        // What is not counted has no place in the plan.
        let parts: Vec<(f64, &Sparse)> = parts.iter().copied().filter(|(f, _)| *f != 0.0).collect();
        let of_pattern: Vec<&Sparse> = parts.iter().map(|(_, part)| *part).collect();
        let plan = StagedPlan::new(&of_pattern, &[])?;
        let mut factor = Self::new(&plan, &parts)?;
        drop(plan);
        if let Some(plan) = Arc::get_mut(&mut factor.plan) {
            plan.elimination = Elimination::default();
        }
        Ok(factor)
    }

    /// The plan it was made by.
    #[must_use]
    pub fn plan(&self) -> &StagedPlan {
        &self.plan
    }

    /// Number of values in the factor.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.values.len()
    }

    /// r → y of all equations, in place.
    pub fn forward(&self, x: &mut [f64], work: &mut [f64]) {
        self.plan.front.forward(&self.values, x, work);
        self.tail_forward(&mut x[self.plan.split..], work);
    }

    /// r → y on the tail, for a right-hand side that is zero before it, in place.
    pub fn tail_forward(&self, x: &mut [f64], work: &mut [f64]) {
        self.plan.tail.forward(&self.values, x, work);
    }

    /// y → x on the tail, in place.
    pub fn tail_backward(&self, x: &mut [f64], work: &mut [f64]) {
        self.plan.tail.backward(&self.values, &self.reciprocal[self.plan.split..], x, work);
    }

    /// y → x before the tail, where x is known at the tail already, in place.
    pub fn finish(&self, x: &mut [f64], work: &mut [f64]) {
        self.plan.front.backward(&self.values, &self.reciprocal, x, work);
    }

    /// The pivots of the tail.
    pub fn tail_pivots(&self) -> impl Iterator<Item = f64> + '_ {
        self.reciprocal[self.plan.split..].iter().map(|r| r.recip())
    }

    /// Shows equation and value of every pivot.
    pub fn pivots(&self, mut visit: impl FnMut(usize, f64)) {
        for (equation, r) in self.plan.equations.iter().zip(&self.reciprocal) {
            visit(*equation as usize, r.recip());
        }
    }

    /// Solves whole right-hand sides, one after the other, in the order of the equations, in place.
    pub fn solve(&self, x: &mut [f64]) {
        self.solve_all(x.chunks_mut(self.reciprocal.len().max(1)).collect());
    }

    /// The same of right-hand sides for themselves.
    pub fn solve_each(&self, x: &mut [Vec<f64>]) {
        self.solve_all(x.iter_mut().map(Vec::as_mut_slice).collect());
    }

    fn solve_all(&self, mut x: Vec<&mut [f64]>) {
        if let Some(subtrees) = &self.plan.subtrees {
            match &mut *x {
                [x] => return self.solve_by_subtrees(subtrees, [x]),
                [x, y] => return self.solve_by_subtrees(subtrees, [x, y]),
                _ => {}
            }
        }
        // Of two each is solved alone, which a second thread can do meanwhile.
        let beside = if x.len() > 2 { BESIDE } else { 1 };
        let pieces: Vec<&mut [&mut [f64]]> = x.chunks_mut(beside).collect();
        // What one piece has used serves the next: new memory comes page by page from the system.
        let rooms = Mutex::new(Vec::new());
        let room = || rooms.lock().unwrap_or_else(PoisonError::into_inner);
        // Twice each value of the factor times each right-hand side.
        share(4 * beside * self.values.len() * pieces.len(), pieces, |x| {
            let mut own = room().pop().unwrap_or_default();
            match x.len() {
                1 => self.solve_one(x[0]),
                _ => self.solve_beside(x, &mut own),
            }
            room().push(own);
        });
    }

    fn solve_by_subtrees<const K: usize>(&self, subtrees: &Subtrees, mut x: [&mut [f64]; K]) {
        let StagedPlan { equations, front, .. } = &*self.plan;
        let factor = Factor { panels: front, values: &self.values, reciprocal: &self.reciprocal };
        let mut ordered = x
            .each_ref()
            .map(|x| -> Vec<f64> { equations.iter().map(|i| x[*i as usize]).collect() });
        subtrees.solve(factor, ordered.each_mut().map(Vec::as_mut_slice));
        for (x, ordered) in x.iter_mut().zip(&ordered) {
            ordered.iter().zip(equations).for_each(|(y, i)| x[*i as usize] = *y);
        }
    }

    fn solve_one(&self, x: &mut [f64]) {
        let StagedPlan { equations, split, .. } = &*self.plan;
        let mut one: Vec<f64> = equations.iter().map(|i| x[*i as usize]).collect();
        let mut work = vec![0.0; self.plan.workspace()];
        self.forward(&mut one, &mut work);
        self.tail_backward(&mut one[*split..], &mut work);
        self.finish(&mut one, &mut work);
        one.iter().zip(equations).for_each(|(y, i)| x[*i as usize] = *y);
    }

    /// Several of them, side by side.
    fn solve_beside(&self, x: &mut [&mut [f64]], room: &mut Vec<f64>) {
        let StagedPlan { equations, front, tail, split, .. } = &*self.plan;
        let (n, of_tail) = (equations.len(), &self.reciprocal[*split..]);
        room.resize(room.len().max(BESIDE * n), 0.0);
        let (beside, _) = room[..BESIDE * n].as_chunks_mut::<BESIDE>();
        let mut work = vec![[0.0; BESIDE]; self.plan.workspace()];
        for (k, x) in x.iter().enumerate() {
            beside.iter_mut().zip(equations).for_each(|(y, i)| y[k] = x[*i as usize]);
        }
        // Nothing stands where there are fewer, whatever stood there before.
        beside.iter_mut().for_each(|y| y[x.len()..].fill(0.0));
        front.forward_each(&self.values, beside, &mut work);
        tail.forward_each(&self.values, &mut beside[*split..], &mut work);
        tail.backward_each(&self.values, of_tail, &mut beside[*split..], &mut work);
        front.backward_each(&self.values, &self.reciprocal, beside, &mut work);
        for (k, x) in x.iter_mut().enumerate() {
            beside.iter().zip(equations).for_each(|(y, i)| x[*i as usize] = y[k]);
        }
    }
}

#[cfg(test)]
#[path = "staged_tests.rs"]
mod tests;

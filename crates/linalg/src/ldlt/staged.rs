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

use super::ordering::{self, Pattern};
use super::substitution::{Node, Panels};
use super::{BLOCK, backend};
use crate::{LinalgError, Sparse};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use std::sync::Arc;

/// Columns up to which supernodes are merged, and the share of zeros that may be stored for it.
const RELAX: &[(usize, f64)] = &[(4, 0.5), (16, 0.3), (48, 0.1), (usize::MAX, 0.02)];

/// Order of elimination and structure of the factor of all matrices of one pattern.
#[derive(Debug)]
pub struct StagedPlan {
    pattern: Pattern,
    symbolic: SymbolicCholesky<usize>,
    /// Equation of each place.
    equations: Vec<u32>,
    /// First place of the tail.
    split: usize,
    front: Panels,
    /// Counted from `split`.
    tail: Panels,
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
        let equations = forward.into_iter().map(|i| i as u32).collect();
        Ok(Arc::new(Self { pattern, symbolic, equations, split, front, tail }))
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

fn panels(symbolic: &SymbolicCholesky<usize>, split: usize) -> (Panels, Panels) {
    let (mut front, mut tail) = (Panels::default(), Panels::default());
    let SymbolicCholeskyRaw::Supernodal(symbolic) = symbolic.raw() else { return (front, tail) };
    for k in 0..symbolic.n_supernodes() {
        let (start, end) = (symbolic.supernode_begin()[k], symbolic.supernode_end()[k]);
        let below = symbolic.supernode(k).pattern();
        let stride = end - start + below.len();
        let values = symbolic.col_ptr_for_val()[k];
        let cut = split.clamp(start, end);
        for (from, to, group, base) in [(start, cut, &mut front, 0), (cut, end, &mut tail, split)] {
            if from == to {
                continue;
            }
            let skipped = from - start;
            group.nodes.push(Node {
                start: (from - base) as u32,
                columns: (to - from) as u32,
                height: (stride - skipped) as u32,
                stride: stride as u32,
                values: values + skipped * stride + skipped,
                rows: group.rows.len(),
            });
            let rows = (to..end).chain(below.iter().copied());
            group.rows.extend(rows.map(|r| (r - base) as u32));
        }
    }
    (front, tail)
}

/// A factorised symmetric matrix, solved in stages. Vectors are in the order of elimination, see
/// [`StagedPlan::equations`].
#[derive(Debug)]
pub struct StagedLdlt {
    plan: Arc<StagedPlan>,
    values: Vec<f64>,
    /// 1/D.
    reciprocal: Vec<f64>,
}

impl StagedLdlt {
    /// Factorises Σ factor · matrix; the matrices must be those of the plan.
    ///
    /// # Errors
    /// [`LinalgError::Singular`] at an exactly zero pivot.
    pub fn new(plan: &Arc<StagedPlan>, parts: &[(f64, &Sparse)]) -> Result<Self, LinalgError> {
        let (n, pattern) = (plan.pattern.order(), &plan.pattern);
        let mut sum = Vec::with_capacity(pattern.rows.len());
        let mut column = vec![0.0; n];
        for j in 0..n {
            for (factor, part) in parts {
                let (rows, values) = part.column(j);
                for (i, v) in rows.iter().zip(values) {
                    column[*i] += factor * v;
                }
            }
            for i in &pattern.rows[pattern.offsets[j]..pattern.offsets[j + 1]] {
                sum.push(column[*i]);
            }
            for (_, part) in parts {
                part.column(j).0.iter().for_each(|i| column[*i] = 0.0);
            }
        }
        let symbolic = &plan.symbolic;
        let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        let mut work = MemBuffer::try_new(scratch).map_err(backend)?;
        let mut values = vec![0.0; symbolic.len_val()];
        let pattern =
            SymbolicSparseColMatRef::new_checked(n, n, &pattern.offsets, None, &pattern.rows);
        symbolic
            .factorize_numeric_ldlt(
                &mut values,
                SparseColMatRef::new(pattern, &sum),
                Side::Lower,
                LdltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut work),
                Default::default(),
            )
            .map_err(|LdltError::ZeroPivot { index }| LinalgError::Singular {
                equation: plan.equations.get(index).map_or(index, |i| *i as usize),
            })?;
        let mut reciprocal = Vec::with_capacity(n);
        for node in plan.front.nodes.iter().chain(&plan.tail.nodes) {
            let (first, step) = (node.values, node.stride as usize + 1);
            reciprocal.extend((0..node.columns as usize).map(|j| values[first + j * step].recip()));
        }
        Ok(Self { plan: Arc::clone(plan), values, reciprocal })
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

    /// Solves whole right-hand sides, one after the other, in the order of the equations, in place.
    ///
    /// # Errors
    /// Where there is no memory.
    pub fn solve(&self, x: &mut [f64]) -> Result<(), LinalgError> {
        let n = self.reciprocal.len();
        if n == 0 {
            return Ok(());
        }
        let scratch = self.plan.symbolic.solve_in_place_scratch::<f64>(BLOCK, Par::Seq);
        let mut work = MemBuffer::try_new(scratch).map_err(backend)?;
        let factor = LdltRef::new(&self.plan.symbolic, &self.values);
        for block in x.chunks_mut(n * BLOCK) {
            let columns = block.len() / n;
            factor.solve_in_place_with_conj(
                Conj::No,
                MatMut::from_column_major_slice_mut(block, n, columns),
                Par::Seq,
                MemStack::new(&mut work),
            );
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triplets;

    /// A grid of springs, some of them to the ground; numbers that repeat.
    fn grid(side: usize) -> Sparse {
        let n = side * side;
        let mut k = Triplets::new(n, n);
        let mut seed = 1u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            0.5 + (seed >> 40) as f64 / (1u64 << 24) as f64
        };
        for i in 0..n {
            k.add(i, i, 0.01 * random());
            for other in [i + 1, i + side] {
                if other < n && (other != i + 1 || !other.is_multiple_of(side)) {
                    let s = random();
                    for (a, b, v) in [(i, i, s), (other, other, s), (i, other, -s), (other, i, -s)]
                    {
                        k.add(a, b, v);
                    }
                    // A place that is stored and zero.
                    k.add(i, n - 1 - i, 0.0);
                }
            }
        }
        k.build()
    }

    fn staged(a: &Sparse, last: &[usize]) {
        let n = a.rows();
        let plan = StagedPlan::new(&[a], last).unwrap();
        let factor = StagedLdlt::new(&plan, &[(2.0, a), (-1.0, a)]).unwrap();
        let mut work = vec![0.0; plan.workspace()];
        let b: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let mut change = vec![0.0; n];
        last.iter().for_each(|i| change[*i] = (*i as f64).cos());
        let place =
            |v: &[f64]| -> Vec<f64> { plan.equations().iter().map(|i| v[*i as usize]).collect() };
        let solved = |b: &[f64]| {
            let mut x = b.to_vec();
            factor.solve(&mut x).unwrap();
            // Against the matrix itself.
            for (y, b) in a.mul(&x).iter().zip(b) {
                assert!((y - b).abs() < 1e-11, "{y} {b}");
            }
            place(&x)
        };
        let split = plan.split();
        assert_eq!(split + last.len(), n);
        let mut x = place(&b);
        factor.forward(&mut x, &mut work);
        let mut early = x[split..].to_vec();
        factor.tail_backward(&mut early, &mut work);
        let expected = solved(&b);
        for (x, y) in early.iter().zip(&expected[split..]) {
            assert!((x - y).abs() < 1e-10 * y.abs().max(1.0), "{x} {y}");
        }
        let mut more = place(&change)[split..].to_vec();
        factor.tail_forward(&mut more, &mut work);
        x[split..].iter_mut().zip(&more).for_each(|(x, y)| *x += y);
        factor.tail_backward(&mut x[split..], &mut work);
        factor.finish(&mut x, &mut work);
        let sum: Vec<f64> = b.iter().zip(&change).map(|(a, b)| a + b).collect();
        for (x, y) in x.iter().zip(&solved(&sum)) {
            assert!((x - y).abs() < 1e-10 * y.abs().max(1.0), "{x} {y}");
        }
    }

    #[test]
    fn a_solution_in_stages_is_the_solution() {
        let a = grid(23);
        let n = a.rows();
        for last in [
            vec![],
            vec![7],
            (0..n).collect(),
            (0..40).collect(),
            (0..n).step_by(9).collect(),
            (0..n - 1).collect::<Vec<_>>(),
        ] {
            staged(&a, &last);
        }
    }

    #[test]
    fn separate_parts_and_empty_matrices_are_solved() {
        let mut t = Triplets::new(30, 30);
        for i in 0..30 {
            t.add(i, i, 2.0 + i as f64);
            if !(i + 1usize).is_multiple_of(5) {
                t.add(i, i + 1, -1.0);
                t.add(i + 1, i, -1.0);
            }
        }
        let a = t.build();
        staged(&a, &[0, 7, 8, 29]);
        staged(&a, &(0..30).collect::<Vec<_>>());
        staged(&Triplets::new(0, 0).build(), &[]);
    }

    #[test]
    fn a_zero_pivot_is_named() {
        let mut t = Triplets::new(3, 3);
        t.add(0, 0, 1.0);
        t.add(2, 2, 1.0);
        let a = t.build();
        let plan = StagedPlan::new(&[&a], &[0]).unwrap();
        let error = StagedLdlt::new(&plan, &[(1.0, &a)]).unwrap_err();
        assert_eq!(error, LinalgError::Singular { equation: 1 });
    }
}

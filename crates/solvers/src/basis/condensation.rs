//! Static condensation of massless DOFs, loads and links.
//!
//! ```text
//!   M_s = 0,  p_s = 0,  B_s = 0:      K_ss u_s + K_sm u_m = 0
//!   u_s = −K_ss⁻¹ K_sm u_m            p̄ = p_m − K_ms K_ss⁻¹ p_s
//! ```
//!
//! All vectors of a basis satisfy the equation, as statics makes them of masses, loads and links: of each only the
//! rows u_m need be kept and made orthogonal, and nothing is lost. In frames whose nodes have no rotary inertia that
//! is half of them.
//!
//! Reference: \[Guyan 1965\], exact here.

use crate::error::SolveError;
use std::borrow::Cow;
use trilith_linalg::threads::share;
use trilith_linalg::{LinalgError, Sparse, StagedLdlt};
use trilith_system::System;

/// Up to this order all rows are kept: there is little to spare.
const WORTH_IT: usize = 300;

/// Which of the free DOFs are kept, and how the others follow.
#[derive(Debug)]
pub(crate) struct Condensation {
    order: usize,
    /// Those kept, rising; not looked at where all are.
    kept: Vec<usize>,
    rest: Option<Rest>,
}

/// What follows.
#[derive(Debug)]
struct Rest {
    /// Rising.
    dofs: Vec<usize>,
    /// K_sm.
    coupling: Sparse,
    /// Of K_ss.
    factor: StagedLdlt,
}

impl Condensation {
    /// All rows are kept.
    pub(crate) fn none(order: usize) -> Self {
        Self { order, kept: Vec::new(), rest: None }
    }

    /// Keeps what has mass, a dashpot, a link or one of the loads.
    pub(crate) fn new(system: &System, loads: &[(String, Vec<f64>)]) -> Result<Self, SolveError> {
        let (order, k) = (system.order(), &system.stiffness);
        if order <= WORTH_IT {
            return Ok(Self::none(order));
        }
        let mut follows = vec![false; order];
        massless_dofs(system, k).into_iter().for_each(|i| follows[i] = true);
        // What a dashpot acts on moves in its own time.
        follows.iter_mut().zip(system.element_damping.diagonal()).for_each(|(f, c)| *f &= c == 0.0);
        for (_, p) in loads {
            follows.iter_mut().zip(p).for_each(|(f, p)| *f &= *p == 0.0);
        }
        system.links.rows.iter().flatten().for_each(|(i, _)| follows[*i] = false);
        Self::of(k, &follows)
    }

    fn of(k: &Sparse, follows: &[bool]) -> Result<Self, SolveError> {
        let order = follows.len();
        let (dofs, kept): (Vec<usize>, _) = (0..order).partition(|i| follows[*i]);
        if dofs.is_empty() {
            return Ok(Self::none(order));
        }
        let factor = match StagedLdlt::alone(&[(1.0, &k.block(&dofs, &dofs))]) {
            // What nothing holds by itself does not follow.
            Err(LinalgError::Singular { .. }) => return Ok(Self::none(order)),
            other => other?,
        };
        let coupling = k.block(&dofs, &kept);
        Ok(Self { order, kept, rest: Some(Rest { dofs, coupling, factor }) })
    }

    /// Number of free DOFs.
    pub(crate) fn order(&self) -> usize {
        self.order
    }

    /// Number of rows that are kept.
    pub(crate) fn kept(&self) -> usize {
        self.rest.as_ref().map_or(self.order, |_| self.kept.len())
    }

    /// True where another one keeps the same rows.
    pub(crate) fn keeps_as(&self, other: &Self) -> bool {
        self.order == other.order && self.is_none() == other.is_none() && self.kept == other.kept
    }

    /// True where all rows are kept.
    pub(crate) fn is_none(&self) -> bool {
        self.rest.is_none()
    }

    /// The rows that are kept, of a vector over the free DOFs.
    pub(crate) fn gather<'a>(&self, u: &'a [f64]) -> Cow<'a, [f64]> {
        match self.rest {
            None => Cow::Borrowed(u),
            Some(_) => Cow::Owned(self.kept.iter().map(|i| u[*i]).collect()),
        }
    }

    /// A vector over the free DOFs with zeros at what is not kept, such as the image of one under the mass.
    pub(crate) fn scatter(&self, kept: &[f64], u: &mut [f64]) {
        match self.rest {
            None => u.copy_from_slice(kept),
            Some(_) => {
                u.fill(0.0);
                self.kept.iter().zip(kept).for_each(|(i, x)| u[*i] = *x);
            }
        }
    }

    /// As [`gather`](Self::gather) and [`scatter`](Self::scatter), of a vector that nobody else needs.
    pub(crate) fn gathered(&self, u: Vec<f64>) -> Vec<f64> {
        if self.is_none() { u } else { self.gather(&u).into_owned() }
    }

    pub(crate) fn scattered(&self, kept: Vec<f64>) -> Vec<f64> {
        if self.is_none() {
            return kept;
        }
        let mut u = vec![0.0; self.order];
        self.scatter(&kept, &mut u);
        u
    }

    /// The rows and columns of a matrix that are kept.
    pub(crate) fn block(&self, a: &Sparse) -> Sparse {
        match self.rest {
            None => a.clone(),
            Some(_) => a.block(&self.kept, &self.kept),
        }
    }

    /// Vectors over the free DOFs, one after the other, of their rows that are kept.
    pub(crate) fn complete(&self, kept: &[f64]) -> Vec<f64> {
        let mut all = Vec::new();
        self.complete_into(kept, &mut Vec::new(), &mut all);
        all
    }

    /// The same in room that is there, of which `others` is for what follows; threads share the vectors.
    pub(crate) fn complete_into(&self, kept: &[f64], others: &mut Vec<f64>, all: &mut Vec<f64>) {
        let Some(Rest { dofs, coupling, factor }) = &self.rest else {
            all.clear();
            return all.extend_from_slice(kept);
        };
        let (m, s) = (self.kept.len(), dofs.len());
        let count = kept.len() / m.max(1);
        others.clear();
        others.resize(s * count, 0.0);
        let pairs = kept.chunks(m).zip(others.chunks_mut(s)).collect();
        share(2 * coupling.stored() * count, pairs, |(x, y)| coupling.mul_add(-1.0, x, y));
        factor.solve(others);
        all.resize(self.order * count, 0.0);
        let each = all.chunks_mut(self.order).zip(kept.chunks(m)).zip(others.chunks(s));
        share(self.order * count, each.collect(), |((u, x), y)| {
            self.kept.iter().zip(x).for_each(|(i, x)| u[*i] = *x);
            dofs.iter().zip(y).for_each(|(i, y)| u[*i] = *y);
        });
    }

    /// Loads on the free DOFs, one after the other, as loads on the rows that are kept, with the same work on every
    /// vector.
    pub(crate) fn condense<'a>(&self, loads: &'a [f64]) -> Cow<'a, [f64]> {
        let Some(Rest { dofs, coupling, factor }) = &self.rest else {
            return Cow::Borrowed(loads);
        };
        let each = || loads.chunks(self.order);
        let mut kept: Vec<f64> = each().flat_map(|p| self.kept.iter().map(|i| p[*i])).collect();
        let mut others: Vec<f64> = each().flat_map(|p| dofs.iter().map(|i| p[*i])).collect();
        if others.iter().any(|p| *p != 0.0) {
            factor.solve(&mut others);
            for (p, y) in kept.chunks_mut(self.kept.len()).zip(others.chunks(dofs.len())) {
                coupling.transpose_mul_add(-1.0, y, p);
            }
        }
        Cow::Owned(kept)
    }

    /// A row over the free DOFs as one over those that are kept.
    pub(crate) fn row<'a>(&self, row: &'a [(usize, f64)]) -> Cow<'a, [(usize, f64)]> {
        if self.rest.is_none() {
            return Cow::Borrowed(row);
        }
        let place = |(i, c): &(usize, f64)| self.kept.binary_search(i).ok().map(|i| (i, *c));
        if let Some(own) = row.iter().map(place).collect() {
            return Cow::Owned(own);
        }
        let mut load = vec![0.0; self.order];
        row.iter().for_each(|(i, c)| load[*i] += c);
        let load = self.condense(&load);
        Cow::Owned(load.iter().copied().enumerate().filter(|(_, c)| *c != 0.0).collect())
    }
}

/// Free DOFs with a stiffness and without mass.
pub(super) fn massless_dofs(system: &System, k: &Sparse) -> Vec<usize> {
    // A zero on the diagonal of M, which is semi-definite, is a row of zeros.
    let (stiff, heavy) = (k.diagonal(), system.mass.diagonal());
    (0..system.order()).filter(|i| stiff[*i] > 0.0 && heavy[*i] == 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_linalg::{Triplets, dot};

    fn number(i: usize) -> f64 {
        ((i * 7919) % 1009) as f64 / 1009.0 - 0.5
    }

    /// A chain on the ground; of every five dofs the second, the fourth and the fifth follow.
    fn chain(n: usize) -> (Sparse, Condensation) {
        let mut t = Triplets::new(n, n);
        for i in 0..n {
            let k = 2.0 + number(i);
            t.add(i, i, k);
            if i > 0 {
                t.add(i - 1, i - 1, k);
                t.add(i - 1, i, -k);
                t.add(i, i - 1, -k);
            }
        }
        let k = t.build();
        let follows: Vec<bool> = (0..n).map(|i| [1, 3, 4].contains(&(i % 5))).collect();
        let rows = Condensation::of(&k, &follows).unwrap();
        (k, rows)
    }

    #[test]
    fn what_follows_is_in_equilibrium_and_what_is_kept_stays() {
        let n = 43;
        let (k, rows) = chain(n);
        let kept: Vec<f64> = (0..2 * rows.kept()).map(number).collect();
        let all = rows.complete(&kept);
        assert_eq!((rows.kept(), rows.order(), all.len()), (18, n, 2 * n));
        for (u, x) in all.chunks(n).zip(kept.chunks(rows.kept())) {
            assert_eq!(rows.gather(u), x);
            let force = k.mul(u);
            let left = (0..n).filter(|i| [1, 3, 4].contains(&(i % 5))).map(|i| force[i].abs());
            assert!(left.fold(0.0, f64::max) < 1e-14);
            // Only masses are where vectors are kept.
            let mut heavy = vec![1.0; n];
            rows.scatter(x, &mut heavy);
            assert!(heavy.iter().zip(u).enumerate().all(|(i, (h, u))| match i % 5 {
                0 | 2 => h == u,
                _ => *h == 0.0,
            }));
        }
    }

    #[test]
    fn loads_and_rows_do_the_same_work_wherever_they_are() {
        let n = 43;
        let (_, rows) = chain(n);
        let kept: Vec<f64> = (0..rows.kept()).map(number).collect();
        let u = rows.complete(&kept);
        let loads: Vec<f64> = (0..2 * n).map(|i| number(3 * i + 1)).collect();
        for (p, own) in loads.chunks(n).zip(rows.condense(&loads).chunks(rows.kept())) {
            assert!((dot(p, &u) - dot(own, &kept)).abs() < 1e-13);
        }
        // On kept rows, on others, on both.
        for row in [vec![(2, 3.0), (10, -1.0)], vec![(3, 2.0)], vec![(0, 1.0), (4, 5.0)]] {
            let work = |x: &[f64], row: &[(usize, f64)]| -> f64 {
                row.iter().map(|(i, c)| c * x[*i]).sum()
            };
            assert!((work(&u, &row) - work(&kept, &rows.row(&row))).abs() < 1e-14);
        }
    }

    #[test]
    fn what_nothing_holds_is_kept() {
        let mut t = Triplets::new(4, 4);
        for (i, j, v) in
            [(0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0), (1, 2, -1.0), (2, 1, -1.0), (3, 3, 1.0)]
        {
            t.add(i, j, v);
        }
        let rows = Condensation::of(&t.build(), &[false, true, true, false]).unwrap();
        assert!(rows.is_none() && rows.kept() == 4);
    }

    #[test]
    fn where_nothing_follows_all_is_as_it_was() {
        let rows = Condensation::of(&chain(5).0, &[false; 5]).unwrap();
        let x = [1.0, 2.0, 3.0, 4.0, 5.0];
        assert!(rows.is_none() && rows.kept() == 5);
        assert_eq!(
            (&*rows.gather(&x), &*rows.condense(&x), &*rows.complete(&x)),
            (&x[..], &x[..], &x[..])
        );
    }
}

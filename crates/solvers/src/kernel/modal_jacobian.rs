//! The link equations of many coordinates that few modes hold.
//!
//! ```text
//! J = I + K̂ G + c H,   K̂ = k − k_e,   G = S A_g Sᵀ,   H = S A_h Sᵀ
//! J Δ = r:   w = SᵀΔ:   (I + Sᵀ K̂ S A_g + Sᵀ c S A_h) w = Sᵀ r        of the order of the modes
//!            GΔ = S A_g w,   HΔ = S A_h w,   Δ = r − K̂ GΔ − c HΔ
//! ```
//!
//! so one correction takes two products with S, and deformations and rates follow it at no cost.

use super::compliance::ModalCompliance;
use super::layout::{Layout, Unknowns};
use crate::vector::add;
use std::sync::Arc;
use trilith_linalg::{Dense, DenseLu};
use trilith_system::Tangents;

/// Of a row of K̂ and c: the other coordinate, k and c.
type Term = (usize, f64, f64);

/// J⁻¹.
pub(crate) struct ModalJacobian {
    /// Sᵀ.
    columns: Arc<Dense>,
    /// From Sᵀ r to A_g w and A_h w.
    moves: [Dense; 2],
    /// K̂ and c, one row after the other, and where these begin.
    terms: Vec<Term>,
    first: Vec<usize>,
    rate_dependent: Vec<usize>,
    /// 1 + what is added to J's diagonal.
    diagonal: f64,
}

impl ModalJacobian {
    /// `hold`: added to J's diagonal.
    pub(crate) fn new(
        layout: &Layout<'_>,
        tangents: &Tangents,
        compliances: [&ModalCompliance; 2],
        hold: f64,
    ) -> Self {
        let (mut terms, mut first) = (Vec::new(), vec![0]);
        for a in 0..layout.effective_k.len() {
            terms.extend(layout.tangents_of(a, tangents));
            first.push(terms.len());
        }
        Self::of_terms(terms, first, layout.rate_dependent.clone(), compliances, hold)
    }

    fn of_terms(
        terms: Vec<Term>,
        first: Vec<usize>,
        rate_dependent: Vec<usize>,
        [g, h]: [&ModalCompliance; 2],
        hold: f64,
    ) -> Self {
        let columns = Arc::clone(&g.columns);
        let m = columns.rows();
        let row = |a: usize| &terms[first[a]..first[a + 1]];
        // J_w = (1 + hold) I + Sᵀ K̂ S A_g + Sᵀ c S A_h.
        let mut equations = Dense::zeros(m, m);
        (0..m).for_each(|i| equations[(i, i)] = 1.0 + hold);
        let by_d: fn(&Term) -> f64 = |term| term.1;
        let by_v: fn(&Term) -> f64 = |term| term.2;
        for (of, inner) in [(by_d, &g.inner), (by_v, &h.inner)] {
            let counts = |a: &usize| row(*a).iter().any(|term| of(term) != 0.0);
            let used: Vec<usize> = (0..columns.columns()).filter(counts).collect();
            let mut own = Dense::zeros(m, used.len());
            let mut held = Dense::zeros(m, used.len());
            for (i, a) in used.iter().enumerate() {
                own.column_mut(i).copy_from_slice(columns.column(*a));
                for term in row(*a) {
                    let pairs = held.column_mut(i).iter_mut().zip(columns.column(term.0));
                    pairs.for_each(|(x, s)| *x += of(term) * s);
                }
            }
            if !used.is_empty() {
                let more = own.times_transpose(&held).times(inner);
                add(equations.values_mut(), more.values());
            }
        }
        let mut inverse = Dense::identity(m);
        DenseLu::new(&equations).solve_columns(&mut inverse);
        let moves = [&g.inner, &h.inner].map(|inner| inner.times(&inverse));
        Self { columns, moves, terms, first, rate_dependent, diagonal: 1.0 + hold }
    }

    /// True where J is not singular.
    pub(crate) fn is_sound(&self) -> bool {
        self.moves.iter().all(|m| m.values().iter().all(|x| x.is_finite()))
    }

    /// The correction of these residuals, and how deformations and the rates that laws depend on follow, as in a row of
    /// [`Unknowns`].
    pub(super) fn correct(&self, residual: &[f64], row: &mut Vec<f64>) {
        let (n, rates) = (residual.len(), self.rate_dependent.len());
        row.clear();
        row.resize(Unknowns::length(n, rates), 0.0);
        let (follows, pseudo) = row.split_at_mut(Unknowns::place_of_pseudo(n, rates));
        let (d, v) = follows.split_at_mut(n);
        self.solve(residual, [d, v], &mut pseudo[..n]);
    }

    /// Residuals become corrections.
    pub(crate) fn solve_alone(&self, x: &mut [f64]) {
        let (mut d, mut v) = (vec![0.0; x.len()], vec![0.0; self.rate_dependent.len()]);
        let residual = x.to_vec();
        self.solve(&residual, [&mut d, &mut v], x);
    }

    /// Δ = J⁻¹ r; `d` and `v` become −GΔ and −HΔ, the latter of the coordinates whose laws depend on rates.
    fn solve(&self, r: &[f64], [d, v]: [&mut [f64]; 2], delta: &mut [f64]) {
        let m = self.columns.rows();
        let mut sources = vec![0.0; m];
        self.columns.mul_add(1.0, r, &mut sources);
        let [by_d, by_v] = self.moves.each_ref().map(|moves| {
            let mut moved = vec![0.0; m];
            moves.mul_add(1.0, &sources, &mut moved);
            moved
        });
        self.columns.transpose_mul_add(-1.0, &by_d, d);
        for (v, a) in v.iter_mut().zip(&self.rate_dependent) {
            *v = -self.columns.column_dot(*a, &by_v);
        }
        let mut rates = vec![0.0; r.len()];
        self.rate_dependent.iter().zip(&*v).for_each(|(a, v)| rates[*a] = *v);
        for (a, (to, r)) in delta.iter_mut().zip(r).enumerate() {
            let terms = &self.terms[self.first[a]..self.first[a + 1]];
            let follows: f64 = terms.iter().map(|(b, k, c)| k * d[*b] + c * rates[*b]).sum();
            *to = (r + follows) / self.diagonal;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::ComplianceMatrix;

    /// Numbers without a pattern between −1 and 1.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 0x2545_F491_4F6C_DD1D_u64;
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    fn close(a: &[f64], b: &[f64]) {
        let most = b.iter().fold(1e-300_f64, |most, x| most.max(x.abs()));
        assert_eq!(a.len(), b.len());
        a.iter().zip(b).for_each(|(a, b)| assert!((a - b).abs() < 1e-11 * most, "{a:e} {b:e}"));
    }

    /// Links of up to three coordinates with full tangents, one of three without rates.
    #[test]
    fn corrections_by_way_of_the_modes_are_those_of_all_equations_written_out() {
        let mut any = numbers();
        for (m, n) in [(1, 7), (3, 40), (12, 90)] {
            let mut dense = |rows: usize, columns: usize| {
                Dense::from_columns(rows, columns, (0..rows * columns).map(|_| any()).collect())
            };
            let columns = Arc::new(dense(m, n));
            let mut symmetric = || {
                let half = dense(m, m);
                half.times_transpose(&half)
            };
            let [g, h] = [symmetric(), symmetric()]
                .map(|inner| ModalCompliance::new(Arc::clone(&columns), inner));
            let (mut terms, mut first, mut rate_dependent) = (Vec::new(), vec![0], Vec::new());
            for a in 0..n {
                let (link, has_rate) = (a / 3, a / 3 % 3 != 0);
                for b in (3 * link..3 * link + 3).filter(|b| *b < n && (a + b) % 5 != 0) {
                    let own = if a == b { 3.0 } else { 0.0 };
                    terms.push((b, own + any(), if has_rate { own + any() } else { 0.0 }));
                }
                first.push(terms.len());
                if has_rate {
                    rate_dependent.push(a);
                }
            }
            let hold = 1e-3;
            // J, with G and H written out.
            let [all_g, all_h] =
                [&g, &h].map(|of| columns.transpose_times(&of.inner.times(&columns)));
            let mut jacobian = Dense::zeros(n, n);
            for a in 0..n {
                jacobian[(a, a)] += 1.0 + hold;
                for (b, k, c) in &terms[first[a]..first[a + 1]] {
                    for j in 0..n {
                        jacobian[(a, j)] += k * all_g[(*b, j)] + c * all_h[(*b, j)];
                    }
                }
            }
            let residual: Vec<f64> = (0..n).map(|_| any()).collect();
            let mut expected = residual.clone();
            DenseLu::new(&jacobian).solve(&mut expected);
            let (mut d, mut v) = (vec![0.0; n], vec![0.0; n]);
            all_g.mul_add(-1.0, &expected, &mut d);
            all_h.mul_add(-1.0, &expected, &mut v);
            let rates: Vec<f64> = rate_dependent.iter().map(|a| v[*a]).collect();

            let modal = ModalJacobian::of_terms(terms, first, rate_dependent, [&g, &h], hold);
            assert!(modal.is_sound());
            let mut row = Vec::new();
            modal.correct(&residual, &mut row);
            close(&row[..n], &d);
            close(&row[n..n + rates.len()], &rates);
            close(&row[n + rates.len()..2 * n + rates.len()], &expected);
            let mut alone = residual.clone();
            modal.solve_alone(&mut alone);
            close(&alone, &expected);

            // And the products with a compliance are those with the matrix.
            let of = ComplianceMatrix::Modal(g);
            close(of.all().values(), all_g.values());
            let (mut found, mut wanted) = (residual.clone(), residual.clone());
            of.mul_add(-0.5, &expected, &mut found);
            all_g.mul_add(-0.5, &expected, &mut wanted);
            close(&found, &wanted);
            let (some, mut found) = ([0, n / 2], [1.0, 2.0]);
            of.less_some(&expected, &some, &mut found);
            close(&found, &[1.0 + d[0], 2.0 + d[n / 2]]);
            (0..n).for_each(|a| close(&[of.own(a)], &[all_g[(a, a)]]));
            // A bound of the largest eigenvalue is above that of any vector.
            let root: Vec<f64> = (0..n).map(|_| any().abs()).collect();
            let x: Vec<f64> = root.iter().zip(&residual).map(|(k, x)| k * x).collect();
            let mut image = vec![0.0; n];
            all_g.mul_add(1.0, &x, &mut image);
            let energy: f64 = image.iter().zip(&x).map(|(a, b)| a * b).sum();
            let square: f64 = residual.iter().map(|x| x * x).sum();
            assert!(energy <= of.bound(&root) * square, "{m} {n}");
        }
    }
}

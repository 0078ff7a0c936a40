//! Lowest modes of large sparse systems: block Lanczos, inverted about a shift, proven complete by inertia.
//!
//! ```text
//!   A = (K − σM)⁻¹ M,  A φ = θ φ,  λ = σ + 1/θ        symmetric in the product of M
//!   A V = V T + Q R                                    VᵀMV = 1, the whole of V orthogonalised twice
//!   V s with T s = θ s:  ‖A V s − θ V s‖ = ‖R s_last‖
//!   negative pivots of K − μM = number of modes with λ < μ            (Sylvester)
//! ```
//!
//! Start vectors are scattered and lie in the range of A, so massless directions never enter. V grows until
//! the wanted pairs have converged, at the latest until it is complete; nothing is restarted. A search finds
//! modes down to a share of its largest θ alone, which is where rounding of T begins to show; the next one
//! starts anew, orthogonal to all that has been found, and so is as accurate for its own modes. Copies of a
//! multiple mode that a block does not hold come in later searches: inertia tells how many are missing.
//!
//! Reference: \[Grimes, Lewis & Simon 1994\], \[Wu & Simon 2000\].

use crate::{
    Columns, Dense, LinalgError, Sparse, StagedLdlt, StagedPlan, dot, symmetric_eigen, unsupported,
};
use std::sync::Arc;

/// Vectors of a block; more where so many are missing.
const BLOCK: usize = 4;
const WIDEST: usize = 32;
/// Residual of a pair, as share of its own θ, and of the largest one of its search.
const CONVERGED: f64 = 1e-11;
const ROUNDING: f64 = 1e-15;
/// Pairs below this share of the largest θ of a search are left to the next one.
const GRADE: f64 = 1e-4;
/// A vector of which orthogonalisation leaves less than this share is a combination of others.
const NOTHING: f64 = 1e-11;
/// Where a pass leaves this share of a vector, it is orthogonal to rounding.
/// \[Daniel, Gragg, Kaufman & Stewart 1976\]
const SETTLED: f64 = 0.5;
const PASSES: usize = 8;
/// Relative distance in λ − σ at which modes are counted below the last one, and told apart.
const MARGIN: f64 = 1e-6;
/// A pivot below this share of its diagonal makes a count doubtful.
const SOUND: f64 = 1e-9;
/// Searches that find none of the missing modes before the count is doubted.
const FRUITLESS: usize = 8;
const WHAT: &str = "the search for modes";

/// Lowest `count` modes of `(K − λ M) φ = 0` with the shift `sigma` ≤ 0 that makes `K − σ M` positive
/// definite. M is positive semi-definite, as singular as may be: a system has as many modes as M has rank,
/// and where it has fewer than `count`, all of them are returned. Returns λ (rising) and M-orthonormal vectors.
///
/// No mode whose λ − σ is smaller than the last one's by more than a millionth of it is missing: that many pivots
/// are negative. Where K is indefinite, the modes nearest to the shift are found.
///
/// # Errors
/// Where `K − σ M` is singular, or rounding hides the number of modes.
pub fn lowest_modes(
    k: &Sparse,
    m: &Sparse,
    count: usize,
    sigma: f64,
) -> Result<(Vec<f64>, Dense), LinalgError> {
    let target = count.min(m.rows());
    let rank = if target == 0 { 0 } else { m.rows() - unsupported(m)?.len() };
    let target = target.min(rank);
    if target == 0 {
        return Ok((Vec::new(), Dense::zeros(m.rows(), 0)));
    }
    let shifted = Sparse::combine(&[(1.0, k), (-sigma, m)]);
    let mut search = Search::new(&shifted, m, rank)?;
    let mut fruitless = 0;
    loop {
        while search.theta.len() < target {
            search.sweep(target - search.theta.len(), BLOCK)?;
        }
        let (below, distance) = search.gap(target, 2.0 * MARGIN);
        let counted = search.count(distance, MARGIN)?;
        if counted == below {
            break;
        }
        if counted < below || fruitless == FRUITLESS || search.theta.len() == rank {
            // Rounding may show in close modes: then a wide gap decides.
            let (below, distance, margin) = search.widest(target);
            let counted = search.count(distance, margin)?;
            if counted == below {
                break;
            }
            return Err(LinalgError::NotConverged { what: WHAT, iterations: search.solved });
        }
        let missing = counted - below;
        search.sweep(missing, missing.clamp(BLOCK, WIDEST))?;
        let nearer = search.distances().filter(|d| *d < distance * (1.0 - MARGIN)).count();
        fruitless = if nearer > below { 0 } else { fruitless + 1 };
    }
    Ok(search.finish(target, sigma))
}

struct Search<'a> {
    shifted: &'a Sparse,
    mass: &'a Sparse,
    plan: Arc<StagedPlan>,
    /// Of K − σM.
    factor: StagedLdlt,
    /// Number of its negative pivots.
    negative: usize,
    /// Rank of M.
    rank: usize,
    /// Size of the entries of start vectors: all places weigh the same.
    size: Vec<f64>,
    seed: u64,
    /// M-orthonormal modes, and their θ.
    found: Columns,
    theta: Vec<f64>,
    /// Vectors that A was applied to.
    solved: usize,
}

/// A block after its projection.
struct Projected {
    /// Shares in the vectors of the search, one's after the other's.
    shares: Vec<f64>,
    /// Images of what is left under M.
    images: Vec<Vec<f64>>,
    /// M-norms before and after.
    before: Vec<f64>,
    after: Vec<f64>,
}

impl<'a> Search<'a> {
    fn new(shifted: &'a Sparse, mass: &'a Sparse, rank: usize) -> Result<Self, LinalgError> {
        let plan = StagedPlan::new(&[shifted, mass], &[])?;
        let factor = StagedLdlt::new(&plan, &[(1.0, shifted)])?;
        let mut negative = 0;
        factor.pivots(|_, d| negative += usize::from(d < 0.0));
        let size = |d: f64| if d > 0.0 { d.sqrt().recip() } else { 0.0 };
        Ok(Self {
            shifted,
            mass,
            plan,
            factor,
            negative,
            rank,
            size: mass.diagonal().into_iter().map(size).collect(),
            seed: 0x9E37_79B9_7F4A_7C15,
            found: Columns::with_capacity(mass.rows(), 0),
            theta: Vec::new(),
            solved: 0,
        })
    }

    fn images(&self, x: &[Vec<f64>]) -> Vec<Vec<f64>> {
        self.mass.symmetric_images(x)
    }

    /// (K − σM)⁻¹ of vectors.
    fn solve(&self, y: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut x = y.to_vec();
        self.factor.solve_each(&mut x);
        x
    }

    /// Makes vectors orthogonal to all that is found, and to those of this search.
    fn project(&self, v: &Columns, x: &mut [Vec<f64>]) -> Projected {
        let mut images = self.images(x);
        let before = norms(x, &images);
        let mut after = before.clone();
        let mut shares = vec![0.0; v.len() * x.len()];
        for pass in 0..PASSES {
            self.found.take_out(0, x, &images);
            let more = v.take_out(0, x, &images);
            shares.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
            images = self.images(x);
            let earlier = std::mem::replace(&mut after, norms(x, &images));
            let done =
                |j: usize| after[j] >= SETTLED * earlier[j] || after[j] <= NOTHING * before[j];
            if pass > 0 && (0..x.len()).all(done) {
                break;
            }
        }
        Projected { shares, images, before, after }
    }

    /// Takes up a vector that is orthogonal to all before `start`, unless nothing is left of it.
    fn keep(&self, v: &mut Columns, start: usize, x: &[f64], before: f64) {
        let mut x = [x.to_vec()];
        let mut images = self.images(&x);
        let mut norm = norms(&x, &images)[0];
        let mut first = start;
        for _ in 0..PASSES {
            if norm <= NOTHING * before {
                return;
            }
            if first == v.len() {
                break;
            }
            let earlier = norm;
            if first == 0 {
                self.found.take_out(0, &mut x, &images);
            }
            v.take_out(first, &mut x, &images);
            images = self.images(&x);
            norm = norms(&x, &images)[0];
            if norm >= SETTLED * earlier {
                break;
            }
            // What was lost has brought shares in all others back to light.
            first = 0;
        }
        if norm > NOTHING * before && norm.is_finite() {
            x[0].iter_mut().for_each(|x| *x /= norm);
            v.push(&x[0]);
        }
    }

    /// Takes up a scattered vector in the range of A. False where there is none besides these.
    fn scatter(&mut self, v: &mut Columns) -> bool {
        if self.theta.len() + v.len() >= self.rank {
            return false;
        }
        let seed = &mut self.seed;
        let mut number = || {
            *seed ^= *seed << 13;
            *seed ^= *seed >> 7;
            *seed ^= *seed << 17;
            (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let mut x = vec![self.size.iter().map(|s| s * number()).collect::<Vec<f64>>()];
        let scale = |x: &mut [Vec<f64>], norm: f64| x[0].iter_mut().for_each(|x| *x /= norm);
        for _ in 0..4 {
            for inverted in [false, true] {
                if inverted {
                    x = self.solve(&self.images(&x));
                }
                let norm = self.project(v, &mut x).after[0];
                if !(norm > 0.0 && norm.is_finite()) {
                    return false;
                }
                scale(&mut x, norm);
            }
            let norm = self.project(v, &mut x).after[0];
            if norm >= SETTLED {
                scale(&mut x, norm);
                v.push(&x[0]);
                return true;
            }
            if !(norm > 0.0 && norm.is_finite()) {
                return false;
            }
            scale(&mut x, norm);
        }
        false
    }

    /// Finds up to `wanted` more modes, at least one, with blocks of `width` vectors.
    fn sweep(&mut self, wanted: usize, width: usize) -> Result<(), LinalgError> {
        let room = self.rank - self.theta.len();
        let (wanted, width) = (wanted.min(room), width.min(room));
        let most = (2 * wanted + 8 * width).min(room);
        let mut v = Columns::with_capacity(self.mass.rows(), most);
        while v.len() < width && self.scatter(&mut v) {}
        let mut t: Vec<Vec<f64>> = Vec::new();
        let (mut from, mut check) = (0, (wanted + 2 * width).min(room));
        loop {
            let to = v.len();
            if from == to {
                return Err(LinalgError::NotConverged { what: WHAT, iterations: self.solved });
            }
            self.solved += to - from;
            let block: Vec<_> = (from..to).map(|j| v.column(j).to_vec()).collect();
            let mut rest = self.solve(&self.images(&block));
            let Projected { shares, images, before, after } = self.project(&v, &mut rest);
            t.extend(shares.chunks(to).map(<[f64]>::to_vec));
            for (j, x) in rest.iter().enumerate() {
                if v.len() < room && after[j] > NOTHING * before[j] {
                    self.keep(&mut v, to, x, before[j]);
                }
            }
            // R: what the last block hangs on by.
            let kept = v.len() - to;
            let mut coupling = Dense::zeros(kept, to - from);
            for (j, image) in images.iter().enumerate() {
                for i in 0..kept {
                    coupling[(i, j)] = dot(v.column(to + i), image);
                }
            }
            while v.len() < to + width && self.scatter(&mut v) {}
            let complete = v.len() == to;
            if to >= check || complete {
                let pairs = Pairs::new(&t, from, &coupling)?;
                let goal = pairs.goal(wanted);
                if complete || pairs.converged() >= goal {
                    self.lock(&v, &pairs, goal);
                    return Ok(());
                }
                check = to + (2 * width).max(to / 6);
            }
            from = to;
        }
    }

    fn lock(&mut self, v: &Columns, pairs: &Pairs, count: usize) {
        let mut turn = Dense::zeros(pairs.vectors.rows(), count);
        for (j, from) in pairs.order[..count].iter().enumerate() {
            turn.column_mut(j).copy_from_slice(pairs.vectors.column(*from));
            self.theta.push(pairs.theta[*from]);
        }
        let modes = v.times(&turn);
        (0..count).for_each(|j| self.found.push(modes.column(j)));
    }

    /// |λ − σ| of all that is found.
    fn distances(&self) -> impl Iterator<Item = f64> + '_ {
        self.theta.iter().map(|t| t.abs().recip())
    }

    fn rising(&self) -> Vec<f64> {
        let mut all: Vec<f64> = self.distances().collect();
        all.sort_by(f64::total_cmp);
        all
    }

    /// Below the last wanted mode, or below those it is close to: how many have been found there, and |λ − σ| of
    /// the mode above.
    fn gap(&self, target: usize, relative: f64) -> (usize, f64) {
        let all = self.rising();
        let open = |i: &usize| *i == 0 || all[*i] - all[*i - 1] > relative * all[*i];
        let at = (0..target).rev().find(open).unwrap_or(0);
        (at, all[at])
    }

    /// The same where modes are farthest apart, and a margin that stays between them.
    fn widest(&self, target: usize) -> (usize, f64, f64) {
        const LAST: usize = 16;
        let all = self.rising();
        let gap = |i: usize| if i == 0 { 1.0 } else { 1.0 - all[i - 1] / all[i] };
        let near = target.saturating_sub(LAST)..target;
        let at = near.max_by(|i, j| gap(*i).total_cmp(&gap(*j))).unwrap_or(0);
        (at, all[at], 0.5 * gap(at))
    }

    /// Number of modes nearer to the shift than this, a little less by a share of the margin.
    fn count(&self, distance: f64, margin: f64) -> Result<usize, LinalgError> {
        let ahead = self.negative_at(distance, margin)?;
        if self.negative == 0 {
            return Ok(ahead);
        }
        Ok(ahead.saturating_sub(self.negative_at(-distance, margin)?))
    }

    /// Negative pivots of K − (σ + r) M, where none of them is next to nothing.
    fn negative_at(&self, r: f64, margin: f64) -> Result<usize, LinalgError> {
        const SHARES: [f64; 5] = [1.0, 0.7, 1.3, 0.5, 1.5];
        let (stiff, heavy) = (self.shifted.diagonal(), self.mass.diagonal());
        let mut best: Option<(f64, usize)> = None;
        for share in SHARES {
            let r = r * (1.0 - share * margin);
            let factor = match StagedLdlt::new(&self.plan, &[(1.0, self.shifted), (-r, self.mass)])
            {
                Err(LinalgError::Singular { .. }) => continue,
                other => other?,
            };
            let (mut smallest, mut negative) = (f64::INFINITY, 0);
            factor.pivots(|i, d| {
                smallest = smallest.min(d.abs() / (stiff[i].abs() + r.abs() * heavy[i]));
                negative += usize::from(d < 0.0);
            });
            if best.is_none_or(|(before, _)| smallest > before) {
                best = Some((smallest, negative));
            }
            if smallest > SOUND {
                break;
            }
        }
        let failed =
            LinalgError::NotConverged { what: "the count of modes", iterations: SHARES.len() };
        best.map(|(_, negative)| negative).ok_or(failed)
    }

    /// The nearest modes, once more through A, which leaves nothing on massless directions that does not follow
    /// from the others; λ = σ + zᵀ(K − σM)z / zᵀMz with (K − σM) A φ = M φ.
    fn finish(self, count: usize, sigma: f64) -> (Vec<f64>, Dense) {
        let n = self.mass.rows();
        let mut order: Vec<usize> = (0..self.theta.len()).collect();
        order.sort_by(|i, j| self.theta[*j].abs().total_cmp(&self.theta[*i].abs()));
        order.truncate(count);
        let mut modes = Columns::with_capacity(n, count);
        let mut values = Vec::with_capacity(count);
        for part in order.chunks(BLOCK) {
            let old: Vec<_> = part.iter().map(|j| self.found.column(*j).to_vec()).collect();
            let heavy = self.images(&old);
            for (z, heavy) in self.solve(&heavy).into_iter().zip(heavy) {
                let mut z = [z];
                for _ in 0..2 {
                    let images = self.images(&z);
                    modes.take_out(0, &mut z, &images);
                }
                let [z] = &mut z;
                let square = self.mass.bilinear(z, z);
                values.push(sigma + dot(z, &heavy) / square);
                z.iter_mut().for_each(|x| *x /= square.sqrt());
                modes.push(z);
            }
        }
        let mut rising: Vec<usize> = (0..values.len()).collect();
        rising.sort_by(|i, j| values[*i].total_cmp(&values[*j]));
        let vectors = rising.iter().flat_map(|j| modes.column(*j).to_vec()).collect();
        let values: Vec<f64> = rising.iter().map(|j| values[*j]).collect();
        (values, Dense::from_columns(n, rising.len(), vectors))
    }
}

fn norms(x: &[Vec<f64>], images: &[Vec<f64>]) -> Vec<f64> {
    x.iter().zip(images).map(|(x, m)| dot(x, m).max(0.0).sqrt()).collect()
}

/// Eigenpairs of T.
struct Pairs {
    theta: Vec<f64>,
    vectors: Dense,
    /// By falling |θ|.
    order: Vec<usize>,
    residuals: Vec<f64>,
}

impl Pairs {
    /// Columns of T down to the end of the block of each; the last block starts at `from`.
    fn new(t: &[Vec<f64>], from: usize, coupling: &Dense) -> Result<Self, LinalgError> {
        let n = t.len();
        let mut all = Dense::zeros(n, n);
        for (j, column) in t.iter().enumerate() {
            for i in 0..=j {
                let other = t[i].get(j).unwrap_or(&column[i]);
                let mean = 0.5 * (column[i] + other);
                (all[(i, j)], all[(j, i)]) = (mean, mean);
            }
        }
        let (theta, vectors) = symmetric_eigen(&all)?;
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|i, j| theta[*j].abs().total_cmp(&theta[*i].abs()));
        let residual = |s: &[f64]| {
            let mut left = vec![0.0; coupling.rows()];
            coupling.mul_add(1.0, &s[from..], &mut left);
            dot(&left, &left).sqrt()
        };
        let residuals = (0..n).map(|j| residual(vectors.column(j))).collect();
        Ok(Self { theta, vectors, order, residuals })
    }

    fn largest(&self) -> f64 {
        self.order.first().map_or(0.0, |i| self.theta[*i].abs())
    }

    /// How many pairs a search with these is for.
    fn goal(&self, wanted: usize) -> usize {
        let largest = self.largest();
        let counts = |i: &&usize| self.theta[**i].abs() >= GRADE * largest;
        self.order.iter().take(wanted).take_while(counts).count().max(1)
    }

    /// How many pairs from the largest on have converged.
    fn converged(&self) -> usize {
        let rounding = ROUNDING * self.largest();
        let settled =
            |i: &&usize| self.residuals[**i] <= CONVERGED * self.theta[**i].abs() + rounding;
        self.order.iter().take_while(settled).count()
    }
}

#[cfg(test)]
#[path = "lanczos_tests.rs"]
mod tests;

//! Craig–Bampton reduction of matrices: static shapes of what is kept, and modes with all of it held.
//!
//! Knows matrices alone, and uses no other room.
//!
//! ```text
//!   Ψ = −K_ii⁻¹ K_ik            constraint modes: one kept row moved, all others held    (i: inner, k: kept)
//!   K_ii φ = ω² M_ii φ          fixed-interface normal modes, φᵀ M_ii φ = 1
//!
//!   | u_k |   | 1  0 | | u_k |
//!   |     | = |      | |     |        T: the matrix
//!   | u_i |   | Ψ  Φ | | q   |
//!
//!   TᵀKT = | K_kk + K_ki Ψ   0 |      TᵀMT = | M_kk + …   Lᵀ |      L = Φᵀ (M_ik + M_ii Ψ)
//!          | 0              ω² |             | L           1 |
//! ```
//!
//! A rigid motion r of what hangs together and stands on nothing has Ψ r_k = r_i, so its modal coordinates are zero:
//! weight and ground motion act with TᵀMT (r_k, 0) = TᵀM r.
//!
//! Reference: \[Craig & Bampton 1968\], \[Hurty 1965\].

use std::f64::consts::TAU;
use trilith_linalg::{Dense, Ldlt, LinalgError, Sparse, lowest_modes, unsupported};

/// Solutions of a right-hand side: the second takes out what the first one leaves.
const REFINED: usize = 2;
/// Right-hand sides that are solved together: the factor is read once for them.
const TOGETHER: usize = 16;
/// Modes above a limit are found no worse than that: a mode at it counts.
const MARGIN: f64 = 1e-9;
/// Share of the stiffness at kept rows below which a sum of what is inside is rounding.
const ROUNDING: f64 = 1e-13;
/// Share of its row's stiffness above which a negative pivot is no rounding.
const NEGATIVE: f64 = 1e-8;
/// What a pivot that is none is replaced by: [`Ldlt::with_rigid_zeros`].
const LOOSE: f64 = 1e29;

/// Which fixed-interface modes are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FixedModes {
    /// So many of the lowest, or all that there are.
    Count(usize),
    /// All up to a frequency, Hz.
    UpTo(f64),
    /// All: the reduction is exact.
    All,
}

/// Why matrices cannot be reduced.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReductionError {
    /// Inner rows that move while all that is kept stands still; rows of the matrices.
    #[error("{} rows move freely while those that are kept stand still", .0.len())]
    Loose(Vec<usize>),
    /// A row whose stiffness, with the others, is negative.
    #[error(
        "the stiffness is not positive definite where all that is kept stands still, at row {0}"
    )]
    Negative(usize),
    /// A factorisation or an eigenproblem failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
}

/// A structure by few coordinates: the kept rows in their order, and behind them modal coordinates.
#[derive(Clone, Debug)]
pub struct CraigBampton {
    /// Rows that are kept, rising.
    pub kept: Vec<usize>,
    /// T: every row by the coordinates.
    pub shapes: Dense,
    /// Circular frequencies of the fixed-interface modes, rad/s, rising.
    pub omega: Vec<f64>,
    /// Number of fixed-interface modes that there are; those of massless directions are none.
    pub available: usize,
    /// TᵀKT.
    pub stiffness: Dense,
    /// TᵀMT.
    pub mass: Dense,
    /// TᵀCT.
    pub damping: Dense,
}

impl CraigBampton {
    /// Reduces K, M and C to the kept rows, rising, and modes of the rest.
    ///
    /// # Errors
    /// [`ReductionError::Loose`] where the kept rows do not hold the others.
    pub fn new(
        [k, m, c]: [&Sparse; 3],
        kept: &[usize],
        modes: FixedModes,
    ) -> Result<Self, ReductionError> {
        let rows = k.rows();
        let mut is_kept = vec![false; rows];
        kept.iter().for_each(|i| is_kept[*i] = true);
        let inner: Vec<usize> = (0..rows).filter(|i| !is_kept[*i]).collect();
        if inner.is_empty() {
            return Ok(Self::of_all([k, m, c]));
        }
        let [k_inner, m_inner] = [k, m].map(|a| a.block(&inner, &inner));
        if let Some(row) = negative(&k_inner)? {
            return Err(ReductionError::Negative(inner[row]));
        }
        let loose = unsupported(&k_inner)?;
        if !loose.is_empty() {
            return Err(ReductionError::Loose(loose.into_iter().map(|i| inner[i]).collect()));
        }
        let mut factor = Ldlt::new(&k_inner)?;
        let psi = constraint_modes(&k_inner, &mut factor, &k.block(&inner, kept));
        drop(factor);
        let available = inner.len() - unsupported(&m_inner)?.len();
        let (omega2, phi) = fixed_modes(&k_inner, &m_inner, modes, available)?;
        let (own, count) = (kept.len(), omega2.len());
        let mut shapes = Dense::zeros(rows, own + count);
        for (j, row) in kept.iter().enumerate() {
            shapes[(*row, j)] = 1.0;
        }
        for j in 0..own + count {
            let of = if j < own { psi.column(j) } else { phi.column(j - own) };
            let column = shapes.column_mut(j);
            inner.iter().zip(of).for_each(|(row, x)| column[*row] = *x);
        }
        drop((psi, phi));
        let [mut stiffness, mut mass, damping] =
            [k, m, c].map(|a| shapes.congruence(a, own + count));
        let diagonal = k.diagonal();
        for (j, of_j) in kept.iter().enumerate() {
            for (i, of_i) in kept.iter().enumerate() {
                if stiffness[(i, j)].abs() < ROUNDING * (diagonal[*of_i] * diagonal[*of_j]).sqrt() {
                    stiffness[(i, j)] = 0.0;
                }
            }
        }
        // What is zero and one by its making.
        for (q, w) in omega2.iter().enumerate() {
            for j in 0..own + count {
                for (i, j) in [(own + q, j), (j, own + q)] {
                    stiffness[(i, j)] = 0.0;
                    if i.min(j) >= own {
                        mass[(i, j)] = 0.0;
                    }
                }
            }
            stiffness[(own + q, own + q)] = *w;
            mass[(own + q, own + q)] = 1.0;
        }
        let omega = omega2.iter().map(|w| w.sqrt()).collect();
        Ok(Self { kept: kept.to_vec(), shapes, omega, available, stiffness, mass, damping })
    }

    /// Of matrices whose rows are kept, all of them.
    fn of_all(matrices: [&Sparse; 3]) -> Self {
        let rows = matrices[0].rows();
        let mut shapes = Dense::zeros(rows, rows);
        (0..rows).for_each(|i| shapes[(i, i)] = 1.0);
        let [stiffness, mass, damping] = matrices.map(|a| {
            let mut dense = Dense::zeros(rows, rows);
            a.entries().for_each(|(i, j, v)| dense[(i, j)] += v);
            dense
        });
        let (kept, omega) = ((0..rows).collect(), Vec::new());
        Self { kept, shapes, omega, available: 0, stiffness, mass, damping }
    }

    /// What a motion that the kept rows lead, all of them by these amounts, asks of the modes: for each L², its
    /// effective mass, and behind them what all modes together would have.
    ///
    /// # Errors
    /// Where the masses of the inner rows cannot be factorised.
    pub fn effective_mass(
        &self,
        m: &Sparse,
        motion: &[f64],
    ) -> Result<(Vec<f64>, f64), ReductionError> {
        let own = self.kept.len();
        let (rows, modes) = (self.shapes.rows(), self.omega.len());
        let mut u = vec![0.0; rows];
        for (j, x) in motion.iter().enumerate() {
            self.shapes.column(j).iter().zip(&mut u).for_each(|(s, u)| *u += s * x);
        }
        let force = m.mul(&u);
        let own_share = |q| self.shapes.column_dot(own + q, &force).powi(2);
        let mut is_kept = vec![false; rows];
        self.kept.iter().for_each(|i| is_kept[*i] = true);
        let inner: Vec<usize> = (0..rows).filter(|i| !is_kept[*i]).collect();
        if inner.is_empty() {
            return Ok((Vec::new(), 0.0));
        }
        let f: Vec<f64> = inner.iter().map(|i| force[*i]).collect();
        let mut x = f.clone();
        Ldlt::with_rigid_zeros(&m.block(&inner, &inner))?.solve(&mut x);
        let all = f.iter().zip(&x).map(|(f, x)| f * x).sum();
        Ok(((0..modes).map(own_share).collect(), all))
    }
}

/// A row whose pivot is negative, and no rounding.
fn negative(k: &Sparse) -> Result<Option<usize>, LinalgError> {
    let (diagonal, mut found) = (k.diagonal(), None);
    Ldlt::with_rigid_zeros(k)?.pivots(|row, d| {
        // What takes the place of a pivot of rounding is larger than anything, and has its sign.
        if d < -NEGATIVE * diagonal[row].abs() && d > -LOOSE {
            found = found.or(Some(row));
        }
    });
    Ok(found)
}

/// −K_ii⁻¹ K_ik.
fn constraint_modes(k_inner: &Sparse, factor: &mut Ldlt, coupling: &Sparse) -> Dense {
    let (rows, columns) = (coupling.rows(), coupling.columns());
    let mut psi = Dense::zeros(rows, columns);
    let mut right = vec![0.0; rows * TOGETHER.min(columns)];
    for start in (0..columns).step_by(TOGETHER) {
        let width = TOGETHER.min(columns - start);
        let right = &mut right[..rows * width];
        for _ in 0..REFINED {
            right.fill(0.0);
            for (j, right) in (start..).zip(right.chunks_mut(rows)) {
                let (places, values) = coupling.column(j);
                places.iter().zip(values).for_each(|(i, v)| right[*i] = -v);
                k_inner.mul_add(-1.0, psi.column(j), right);
            }
            factor.solve(right);
            let own = &mut psi.values_mut()[rows * start..];
            own.iter_mut().zip(&*right).for_each(|(x, more)| *x += more);
        }
    }
    psi
}

/// Modes with all that is kept held: ω² and M-orthonormal vectors.
fn fixed_modes(
    k: &Sparse,
    m: &Sparse,
    modes: FixedModes,
    available: usize,
) -> Result<(Vec<f64>, Dense), ReductionError> {
    let limit = match modes {
        FixedModes::Count(count) => return Ok(lowest_modes(k, m, count.min(available), 0.0)?),
        FixedModes::All => return Ok(lowest_modes(k, m, available, 0.0)?),
        FixedModes::UpTo(frequency) => (TAU * frequency).powi(2) * (1.0 + MARGIN),
    };
    // As many as pivots of K − μM are negative, and one more that shows that none is missing.
    let mut count = Ldlt::with_rigid_zeros(&Sparse::combine(&[(1.0, k), (-limit, m)]))?
        .negative_pivots()
        .min(available);
    loop {
        let (omega2, vectors) = lowest_modes(k, m, (count + 1).min(available), 0.0)?;
        let below = omega2.iter().filter(|w| **w <= limit).count();
        if below < omega2.len() || omega2.len() == available {
            let values = vectors.values()[..below * k.rows()].to_vec();
            return Ok((omega2[..below].to_vec(), Dense::from_columns(k.rows(), below, values)));
        }
        count = below + 1;
    }
}

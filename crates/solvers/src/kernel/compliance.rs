//! The compliances of a step: what pseudo-forces of the links do to their deformations and rates.
//!
//! ```text
//! G = S A_g Sᵀ        H = S A_h Sᵀ        S = B Φ: link coordinates × modes        A: what s₁ does to q₁ and q̇₁
//! ```
//!
//! Few link coordinates have all of it as one matrix. Where they are many and the modes are few, the product of the three
//! takes a fraction of the memory that this matrix fills, and a product with it a fraction of the time.

use super::affine::StepKey;
use std::borrow::Cow;
use std::sync::Arc;
use trilith_linalg::{Dense, dot};

/// Link coordinates from which on a product of three is thought of, and how many times the modes they must be: one
/// iteration takes two products with S then, else two with what is as large as G.
const FROM: usize = 256;
const TIMES: usize = 4;

/// Compliance of the links over a step: d = d* − G f̃, ḋ = v* − H f̃.
pub(crate) struct Compliance {
    pub g: ComplianceMatrix,
    pub h: ComplianceMatrix,
    /// Identity of the step.
    pub key: StepKey,
}

impl Compliance {
    /// Of whole matrices.
    pub(crate) fn full(g: Dense, h: Dense, key: StepKey) -> Self {
        Self { g: ComplianceMatrix::Full(g), h: ComplianceMatrix::Full(h), key }
    }

    /// Number of values it holds.
    pub(crate) fn stored(&self) -> usize {
        let of = |matrix: &ComplianceMatrix| match matrix {
            ComplianceMatrix::Full(all) => all.values().len(),
            ComplianceMatrix::Modal(modal) => modal.inner.values().len() + modal.diagonal.len(),
        };
        of(&self.g) + of(&self.h)
    }
}

/// A compliance, active × active, symmetric.
pub(crate) enum ComplianceMatrix {
    /// As it is.
    Full(Dense),
    /// Of many coordinates and few modes.
    Modal(ModalCompliance),
}

/// S A Sᵀ.
pub(crate) struct ModalCompliance {
    /// Sᵀ: a column for each link coordinate.
    pub columns: Arc<Dense>,
    /// A, modes × modes, symmetric.
    pub inner: Dense,
    diagonal: Vec<f64>,
}

impl ModalCompliance {
    /// True for so many coordinates on so few modes.
    pub(crate) fn serves(coordinates: usize, modes: usize) -> bool {
        coordinates >= FROM && coordinates >= TIMES * modes
    }

    pub(crate) fn new(columns: Arc<Dense>, inner: Dense) -> Self {
        let mut image = vec![0.0; inner.rows()];
        let mut share = |a: usize| {
            image.fill(0.0);
            inner.mul_add(1.0, columns.column(a), &mut image);
            dot(columns.column(a), &image)
        };
        let diagonal = (0..columns.columns()).map(&mut share).collect();
        Self { columns, inner, diagonal }
    }

    /// A Sᵀ x.
    fn modal(&self, x: &[f64]) -> Vec<f64> {
        let mut sources = vec![0.0; self.inner.columns()];
        self.columns.mul_add(1.0, x, &mut sources);
        let mut answer = vec![0.0; self.inner.rows()];
        self.inner.mul_add(1.0, &sources, &mut answer);
        answer
    }
}

impl ComplianceMatrix {
    /// Number of link coordinates.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Full(all) => all.columns(),
            Self::Modal(modal) => modal.columns.columns(),
        }
    }

    /// `y += s · G x`.
    #[inline]
    pub(crate) fn mul_add(&self, s: f64, x: &[f64], y: &mut [f64]) {
        match self {
            Self::Full(all) => all.mul_add(s, x, y),
            Self::Modal(modal) => modal.columns.transpose_mul_add(s, &modal.modal(x), y),
        }
    }

    /// `y += s · G x` for all pairs (x, y).
    pub(crate) fn mul_add_each(&self, s: f64, pairs: &mut [(&[f64], &mut [f64])]) {
        match self {
            Self::Full(all) => all.mul_add_each(s, pairs),
            Self::Modal(_) => pairs.iter_mut().for_each(|(x, y)| self.mul_add(s, x, y)),
        }
    }

    /// `y −= G x` at some coordinates, one after the other.
    pub(crate) fn less_some(&self, x: &[f64], some: &[usize], y: &mut [f64]) {
        if some.len() == self.len() {
            return self.mul_add(-1.0, x, y);
        }
        match self {
            // It is symmetric.
            Self::Full(all) => {
                y.iter_mut().zip(some).for_each(|(y, a)| *y -= all.column_dot(*a, x));
            }
            Self::Modal(modal) => {
                let answer = modal.modal(x);
                y.iter_mut()
                    .zip(some)
                    .for_each(|(y, a)| *y -= modal.columns.column_dot(*a, &answer));
            }
        }
    }

    /// What a coordinate gives itself.
    pub(crate) fn own(&self, a: usize) -> f64 {
        match self {
            Self::Full(all) => all[(a, a)],
            Self::Modal(modal) => modal.diagonal[a],
        }
    }

    /// All of it.
    pub(crate) fn all(&self) -> Cow<'_, Dense> {
        match self {
            Self::Full(all) => Cow::Borrowed(all),
            Self::Modal(ModalCompliance { columns, inner, .. }) => {
                Cow::Owned(columns.transpose_times(&inner.times(columns)))
            }
        }
    }

    /// A bound of the largest eigenvalue of G diag(k), for `root` = √k: the row sums of √k |G| √k, or of more where it is
    /// a product.
    pub(crate) fn bound(&self, root: &[f64]) -> f64 {
        let held = root.iter().enumerate().filter(|(_, x)| **x > 0.0);
        match self {
            Self::Full(all) => held
                .map(|(a, x)| {
                    x * all.column(a).iter().zip(root).map(|(g, y)| g.abs() * y).sum::<f64>()
                })
                .fold(0.0, f64::max),
            Self::Modal(ModalCompliance { columns, inner, diagonal }) => {
                // Of what is symmetric and positive its trace is a bound as well.
                let trace: f64 = root.iter().zip(diagonal).map(|(x, g)| x * x * g).sum();
                // |S A Sᵀ| ≤ |S| |A| |Sᵀ|, element by element.
                let mut sources = vec![0.0; inner.columns()];
                for (a, x) in held.clone() {
                    let column = sources.iter_mut().zip(columns.column(a));
                    column.for_each(|(s, c)| *s += x * c.abs());
                }
                let mut answer = vec![0.0; inner.rows()];
                for (j, s) in sources.iter().enumerate() {
                    answer.iter_mut().zip(inner.column(j)).for_each(|(y, a)| *y += a.abs() * s);
                }
                let row = |(a, x): (usize, &f64)| {
                    x * columns.column(a).iter().zip(&answer).map(|(c, y)| c.abs() * y).sum::<f64>()
                };
                held.map(row).fold(0.0, f64::max).min(trace)
            }
        }
    }
}

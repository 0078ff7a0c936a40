//! Natural modes with mass, and the damping matrix they give.
//!
//! M = P diag P^T; directions without mass are condensed, K̂ = K_aa − K_an K_nn⁺ K_na; then
//! K̂ φ = ω² M̂ φ by Cholesky's factor of M̂. [Bathe 1996, ch. 10 and 11]

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Circular frequencies and M Φ with ΦᵀMΦ = 1.
#[derive(Clone, Debug)]
pub struct Modes {
    /// rad/s, rising.
    pub omega: Vec<f64>,
    /// M Φ: free directions over modes.
    pub image: DMatrix<f64>,
    /// Φ where there is mass.
    pub shapes: DMatrix<f64>,
}

/// Basis of the directions with mass, and of those without.
pub fn split(m: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let n = m.nrows();
    let size: Vec<f64> = (0..n).map(|i| m[(i, i)].max(0.0).sqrt()).collect();
    let (heavy, light): (Vec<usize>, Vec<usize>) = (0..n).partition(|i| size[*i] > 0.0);
    let at = |i: usize, x: f64| {
        let mut v = DVector::zeros(n);
        v[i] = x;
        v
    };
    let (mut with, mut without) = (Vec::new(), Vec::new());
    // Scaled to a unit diagonal, so that kg and kg·m² can be compared.
    let unit = DMatrix::from_fn(heavy.len(), heavy.len(), |i, j| {
        m[(heavy[i], heavy[j])] / (size[heavy[i]] * size[heavy[j]])
    });
    let full = unit.clone().cholesky().is_some_and(|l| l.l_dirty().diagonal().min() > 1e-3);
    if heavy.is_empty() || full {
        with.extend(heavy.iter().map(|i| at(*i, size[*i].recip())));
    } else {
        let (values, vectors) = eigen(&unit);
        for (j, value) in values.iter().enumerate() {
            let mut v = DVector::zeros(n);
            for (i, at) in heavy.iter().enumerate() {
                v[*at] = vectors[(i, j)] / size[*at];
            }
            if *value > 1e-11 { &mut with } else { &mut without }.push(v);
        }
    }
    without.extend(light.iter().map(|i| at(*i, 1.0)));
    let all = |x: Vec<DVector<f64>>| {
        if x.is_empty() { DMatrix::zeros(n, 0) } else { DMatrix::from_columns(&x) }
    };
    (all(with), all(without))
}

/// Eigenvalues and vectors of a symmetric matrix, part by part where parts of it do not hang together: solved as one
/// they would be mixed by rounding, and what moves one would move the others.
pub fn eigen(a: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let n = a.nrows();
    let (mut values, mut vectors) = (DVector::zeros(n), DMatrix::zeros(n, n));
    let mut free: Vec<usize> = (0..n).collect();
    let mut made = 0;
    while let Some(first) = free.pop() {
        let mut part = vec![first];
        let mut next = 0;
        while let Some(i) = part.get(next).copied() {
            let hangs = |j: &usize| a[(i, *j)] != 0.0 || a[(*j, i)] != 0.0;
            let (tied, rest): (Vec<usize>, Vec<usize>) = free.into_iter().partition(hangs);
            part.extend(tied);
            free = rest;
            next += 1;
        }
        part.sort_unstable();
        let own = DMatrix::from_fn(part.len(), part.len(), |i, j| a[(part[i], part[j])]);
        let own = SymmetricEigen::new(own);
        for j in 0..part.len() {
            values[made] = own.eigenvalues[j];
            for (i, at) in part.iter().enumerate() {
                vectors[(*at, made)] = own.eigenvectors[(i, j)];
            }
            made += 1;
        }
    }
    (values, vectors)
}

/// The modes of M and K.
#[must_use]
pub fn modes(m: &DMatrix<f64>, k: &DMatrix<f64>) -> Modes {
    let (p, q) = split(m);
    let mass = p.transpose() * m * &p;
    let mut stiff = p.transpose() * k * &p;
    if q.ncols() > 0 {
        let own = q.transpose() * k * &q;
        let tie = q.transpose() * k * &p;
        let scale: Vec<f64> = (0..own.nrows())
            .map(|i| if own[(i, i)] > 0.0 { own[(i, i)].sqrt().recip() } else { 0.0 })
            .collect();
        let unit =
            DMatrix::from_fn(own.nrows(), own.nrows(), |i, j| scale[i] * own[(i, j)] * scale[j]);
        let (values, vectors) = eigen(&unit);
        for (j, value) in values.iter().enumerate() {
            if *value > 1e-10 {
                let shape = vectors.column(j);
                let y = DVector::from_fn(shape.len(), |i, _| scale[i] * shape[i]);
                let push = tie.transpose() * y;
                stiff -= &push * push.transpose() / *value;
            }
        }
    }
    let Some(factor) = mass.cholesky() else {
        let none = DMatrix::zeros(m.nrows(), 0);
        return Modes { omega: Vec::new(), image: none.clone(), shapes: none };
    };
    let l = factor.l();
    let half = l.solve_lower_triangular(&stiff).unwrap_or_else(|| stiff.clone());
    let inner = l.solve_lower_triangular(&half.transpose()).unwrap_or(half);
    let inner = (&inner + inner.transpose()) * 0.5;
    let (values, vectors) = eigen(&inner);
    let shapes = l.transpose().solve_upper_triangular(&vectors).unwrap_or(vectors);
    let shapes = p * shapes;
    let image = m * &shapes;
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let omega = order.iter().map(|i| values[*i].max(0.0).sqrt()).collect();
    Modes { omega, image: image.select_columns(&order), shapes: shapes.select_columns(&order) }
}

impl Modes {
    /// M Φ diag(2 ζ ω) Φᵀ M.
    #[must_use]
    pub fn damping(&self, ratio: f64) -> DMatrix<f64> {
        let n = self.image.nrows();
        let mut c = DMatrix::zeros(n, n);
        let top = self.omega.last().copied().unwrap_or(0.0);
        for (j, w) in self.omega.iter().enumerate().filter(|(_, w)| **w > 1e-7 * top) {
            let x = self.image.column(j);
            c += x * x.transpose() * (2.0 * ratio * w);
        }
        c
    }
}

//! Sums over vectors.

/// Σ aᵢ bᵢ.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Largest magnitude; not a number where one of them is not, so that no comparison holds.
pub(crate) fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |a, b| if b.is_nan() || b.abs() > a { b.abs() } else { a })
}

//! The links of a lane on all its modes.

use crate::single_mode::Mode;

/// Spectral radius of G k: the exact rule is stable below 2.
pub(super) fn stiffness_ratio(rows: &[Vec<f64>], modes: &[Mode], engaged: &[f64]) -> f64 {
    let mut x = vec![1.0; rows.len()];
    let mut ratio = 0.0;
    for _ in 0..50 {
        let mut s = vec![0.0; modes.len()];
        for (row, (x, k)) in rows.iter().zip(x.iter().zip(engaged)) {
            for (s, b) in s.iter_mut().zip(row) {
                *s += b * x * k;
            }
        }
        for (s, c) in s.iter_mut().zip(modes) {
            *s *= c[1][3];
        }
        let y: Vec<f64> =
            rows.iter().map(|row| row.iter().zip(&s).map(|(b, s)| b * s).sum()).collect();
        let size = y.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        if size == 0.0 || !size.is_finite() {
            return size;
        }
        let settled = (size - ratio).abs() <= 1e-3 * size;
        ratio = size;
        x = y.into_iter().map(|v| v / size).collect();
        if settled {
            break;
        }
    }
    ratio
}

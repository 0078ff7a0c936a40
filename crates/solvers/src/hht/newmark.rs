//! The constants of HHT-α.

/// γ and β of an α.
pub(super) fn newmark(alpha: f64) -> (f64, f64) {
    (0.5 - alpha, 0.25 * (1.0 - alpha) * (1.0 - alpha))
}

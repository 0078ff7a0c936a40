//! The constants of HHT-α, and accelerations at the start of a motion.

use crate::error::SolveError;
use crate::structure::{JUMPED, ReducedSystem};
use trilith_linalg::Ldlt;

/// γ and β of an α.
pub(super) fn newmark(alpha: f64) -> (f64, f64) {
    (0.5 - alpha, 0.25 * (1.0 - alpha) * (1.0 - alpha))
}

/// M⁻¹ p where there is mass, zero elsewhere.
pub(super) fn mass_acceleration(
    space: &ReducedSystem,
    mut force: Vec<f64>,
) -> Result<Vec<f64>, SolveError> {
    for (p, m) in force.iter_mut().zip(space.mass.diagonal()) {
        if m <= 0.0 {
            *p = 0.0;
        }
    }
    let mut a = accelerate(space, force)?;
    a.iter_mut()
        .zip(space.mass.diagonal())
        .filter(|(_, m)| *m <= 0.0)
        .for_each(|(a, _)| *a = JUMPED);
    Ok(a)
}

/// M⁻¹ of a force on what has mass.
fn accelerate(space: &ReducedSystem, mut force: Vec<f64>) -> Result<Vec<f64>, SolveError> {
    if space.mass.entries().all(|(i, j, m)| i == j || m == 0.0) {
        for (p, m) in force.iter_mut().zip(space.mass.diagonal()).filter(|(_, m)| *m > 0.0) {
            *p /= m;
        }
        return Ok(force);
    }
    Ldlt::with_rigid_zeros(&space.mass)?.solve(&mut force);
    Ok(force)
}

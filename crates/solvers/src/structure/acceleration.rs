//! Accelerations at the start of a motion.

use super::followers::JUMPED;
use super::reduced_system::ReducedSystem;
use crate::error::SolveError;
use trilith_linalg::Ldlt;

/// M⁻¹ p where there is mass, zero elsewhere.
pub(crate) fn mass_acceleration(
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

//! P-Δ: the structure with the geometric stiffness of the axial forces of a static case.
//!
//! The axial forces depend on the stiffness, which depends on them: the static case is solved again until
//! they stay. From then on they are constants: the equations stay linear and serve every solver alike.

use super::case::{RunOptions, run};
use crate::error::SolveError;
use trilith_linalg::Ldlt;
use trilith_model::{Load, Model};
use trilith_system::System;

/// Change of the axial forces, relative to the largest, at which they are taken as found.
const CONVERGED: f64 = 1e-9;
const ROUNDS: usize = 30;

/// Assembles a model, with P-Δ where it says so.
///
/// # Errors
/// [`SolveError::System`] where elements, constraints or supports do not fit together;
/// [`SolveError::Buckles`] where the compression is beyond what the structure can carry; errors of the
/// static case.
pub fn assemble(model: &Model) -> Result<System, SolveError> {
    let mut system = System::without_axial_forces(model)?;
    let Some(case) = model.p_delta else { return Ok(system) };
    let mut change = f64::INFINITY;
    for _ in 0..ROUNDS {
        let result = run(model, &system, RunOptions { case, ..RunOptions::default() }, &mut [])?;
        let u = &result.end.displacement;
        let mut tension: Vec<f64> =
            (0..model.elements.len()).map(|e| system.axial_force(model, e, u)).collect();
        for load in model.held_loads(&model.cases[case]) {
            let Load::Pattern { pattern, factor } = load else { continue };
            for along in &model.patterns[pattern].members {
                tension[along.element] += factor * system.held_tension(model, along);
            }
        }
        let largest = tension.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        let moved =
            tension.iter().zip(&system.tension).fold(0.0_f64, |a, (x, y)| a.max((x - y).abs()));
        if moved <= CONVERGED * largest {
            return Ok(system);
        }
        change = moved / largest;
        system = System::with_tension(model, tension)?;
        stable(model, &system, case)?;
    }
    let case = &model.cases[case];
    Err(SolveError::AxialForces { case: case.name.clone(), change, span: case.span.clone() })
}

/// Refuses a structure that buckles; links count with the stiffness they have when engaged.
fn stable(model: &Model, system: &System, case: usize) -> Result<(), SolveError> {
    let k = system.stiffness_with(&system.links.engaged(model));
    if Ldlt::with_rigid_zeros(&k)?.negative_pivots() == 0 {
        return Ok(());
    }
    let force = |e: &usize| system.tension[*e];
    let worst = (0..system.tension.len()).min_by(|a, b| force(a).total_cmp(&force(b))).unwrap_or(0);
    let case = &model.cases[case];
    Err(SolveError::Buckles {
        case: case.name.clone(),
        worst: format!("\"{}\"", model.elements[worst].name),
        force: force(&worst),
        span: case.span.clone(),
    })
}

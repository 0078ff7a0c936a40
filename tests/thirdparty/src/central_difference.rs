//! Central differences, the explicit rule of crash codes, as a solver.
//!
//! ```text
//!   u₁ = u₀ + Δt v₀ + Δt²/2 a₀
//!   (M + Δt/2 C) a₁ = p₁ − K u₁ − C (v₀ + Δt/2 a₀)
//!   v₁ = v₀ + Δt/2 (a₀ + a₁)
//! ```
//!
//! Stable for steps up to 2/ω of the fastest vibration, links at their stiffest included; longer ones run away, and the
//! run says so. Every direction must have a mass.
//!
//! Reference: \[Belytschko, Liu & Moran, Nonlinear Finite Elements for Continua and Structures, 2000, 6.2\].

use serde::Deserialize;
use trilith_element::{
    Card, Category, Described, Exercise, Factor, Integrator, LinearStep, LinearStructure, Motion,
    MotionMut, NodeCount,
};

/// The rule; it has no parameters.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CentralDifference {}

impl Described for CentralDifference {
    const CARD: Card = Card::new(
        "CentralDifference",
        Category::Solver,
        "Explicit central differences; stable for short steps alone.",
    )
    .nodes(NodeCount::NONE)
    .parameters(&[])
    .law("u₁ = u₀ + Δt v₀ + Δt²/2 a₀,  (M + Δt/2 C) a₁ = p₁ − K u₁ − C (v₀ + Δt/2 a₀)")
    .source(
        "Belytschko, Liu & Moran, Nonlinear Finite Elements for Continua and Structures, 2000, 6.2",
    )
    .example(r#"solver: CentralDifference, step: Fixed(substeps: 10)"#)
    .exercise(Exercise::NONE);
}

impl Integrator for CentralDifference {
    fn step(
        &self,
        structure: &dyn LinearStructure,
        dt: f64,
    ) -> Result<Box<dyn LinearStep>, String> {
        let factor = structure.factorise(1.0, 0.5 * dt, 0.0)?;
        Ok(Box::new(Step { dt, factor, rate: vec![0.0; structure.order()] }))
    }
}

/// The step of one length.
struct Step {
    dt: f64,
    /// Of M + Δt/2 C.
    factor: Box<dyn Factor>,
    /// v₀ + Δt/2 a₀.
    rate: Vec<f64>,
}

impl LinearStep for Step {
    fn advance(
        &mut self,
        structure: &dyn LinearStructure,
        from: Motion<'_>,
        force: [&[f64]; 2],
        to: MotionMut<'_>,
    ) {
        let half = 0.5 * self.dt;
        for (i, rate) in self.rate.iter_mut().enumerate() {
            *rate = from.v[i] + half * from.a[i];
            to.u[i] = from.u[i] + self.dt * *rate;
        }
        to.a.copy_from_slice(force[1]);
        structure.stiffness(-1.0, to.u, to.a);
        structure.damping(-1.0, &self.rate, to.a);
        self.factor.solve(to.a);
        for (i, rate) in self.rate.iter().enumerate() {
            to.v[i] = rate + half * to.a[i];
        }
    }
}

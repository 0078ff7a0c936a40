//! Card and checks of the [`FrictionPendulum`].

use super::{FrictionModel, FrictionPendulum, Surface};
use crate::shared::sliding::Dish;
use trilith_element::{Card, Category, Described, Exercise, NodeCount, ParameterError, Stroke};

/// Largest coefficient of an `inclined` bearing: well below the one with which its steepest slope locks.
const ROUGHEST: f64 = 0.3;

impl Described for FrictionPendulum {
    const CARD: Card = Card::new(
        "FrictionPendulum",
        Category::Link,
        "Sliding bearing with one concave surface: friction by speed, force or pressure; rim.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f₁ = min(0, kₙ g + c ġ) where g = d₁ ≤ 0, else 0;  N = −f₁ (with `pull`: −kₙ g)\n\
          τ = kₛ (u − a) + cₛ (u̇ − ȧ), |τ| ≤ μ N (radial return);  u = (d₂, d₃)\n\
          fₜ = τ + N ∇h(u) + kₛₜ (|u| − D)⁺ u/|u|\n\
          Shallow: ∇h = u/R;  Spherical: ∇h = u/√(R² − u²)\n\
          with `rise`: g = d₁ − h(u)\n\
          with `inclined`: S τ in place of τ, |τ| ≤ μ P, P = N √(1 + |∇h|²) + ∇h·τ, S = I + ∇h ∇hᵀ/(1 + √(1 + |∇h|²));\n\
          u̇ in τ is S u̇: speeds, stretch and slip along the surface\n\
          Velocity: μ = μ_fast − (μ_fast − μ_slow) e^(−r x), slip rate x = |ȧ| (|u̇| where μ falls with it)\n\
          until it has slipped by s₀: more, from `mu_static` on, as an `NLink`\n\
          VelocityForce: μ_slow, μ_fast = a N^(n−1) ≤ μ_max, r = r₀ + r₁ N + r₂ N²\n\
          VelocityPressure: μ_fast − Δμ tanh(α N/A) in place of μ_fast")
    .source("Zayas, Low, Mahin 1990; Constantinou, Mokha, Reinhorn 1990 for μ(v); \
             Tsopelas et al. 1994 for μ(p)")
    .example(r#""bearing": FrictionPendulum(node: "base", kn: "2e9 N/m", ks: "1e8 N/m", radius: "1.5 m", friction_model: Velocity, mu_slow: 0.03, mu_fast: 0.06, rate: "20 s/m")"#)
    .exercise(Exercise::new(0.5, &[
            Stroke::about(-5e-4, 0.0),
            Stroke::about(0.0, 0.15),
            Stroke::about(0.0, 0.0),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        self.check_friction()?;
        let slow = self.mu_slow.or(self.mu).unwrap_or(0.0);
        match self.mu_static {
            Some(mu) if mu < slow => {
                let message = format!("a bearing breaks away at least at the {slow} of slow slip");
                return Err(ParameterError::inconsistent("mu_static", message));
            }
            None if self.static_slip > 0.0 => {
                let message = "`static_slip` belongs to `mu_static`: give both, or none";
                return Err(ParameterError::inconsistent("static_slip", message));
            }
            _ => {}
        }
        if self.stop.is_some() != self.stop_stiffness.is_some() {
            let message = "`stop` and `stop_stiffness` go together: give both, or none";
            return Err(ParameterError::inconsistent("stop", message));
        }
        if self.radius == 0.0 {
            if self.surface == Surface::Spherical {
                let message = "a spherical surface needs its `radius`";
                return Err(ParameterError::inconsistent("surface", message));
            }
            if self.rise {
                let message = "a flat bearing does not rise: give a `radius`, or leave `rise` out";
                return Err(ParameterError::inconsistent("rise", message));
            }
            if self.inclined {
                let message =
                    "a flat bearing has no slope: give a `radius`, or leave `inclined` out";
                return Err(ParameterError::inconsistent("inclined", message));
            }
        }
        if self.inclined {
            self.check_that_nothing_locks()?;
        }
        match self.stop {
            Some(stop) if self.surface == Surface::Spherical && stop >= self.radius => {
                let message = format!(
                    "the rim at {stop} m must be met before the radius of {} m",
                    self.radius
                );
                Err(ParameterError::inconsistent("stop", message))
            }
            _ => Ok(()),
        }
    }
}

impl FrictionPendulum {
    /// Refuses coefficients with which a slope may hold a slider under any force.
    fn check_that_nothing_locks(&self) -> Result<(), ParameterError> {
        let by_force = self.friction_model == FrictionModel::VelocityForce;
        let coefficients = [
            ("mu", self.mu),
            ("mu_slow", self.mu_slow),
            ("mu_fast", self.mu_fast),
            ("mu_static", self.mu_static),
            ("mu_max", by_force.then_some(self.mu_max)),
        ];
        for (name, value) in coefficients {
            if let Some(mu) = value
                && mu > ROUGHEST
            {
                let message = format!(
                    "`inclined` takes coefficients of at most {ROUGHEST}, not {mu}: from {:.3} on the slope of {:.2} at \
                     0.95 of the radius would hold the slider under any force",
                    1.0 / Dish::steepest(),
                    Dish::steepest()
                );
                return Err(ParameterError::inconsistent(name, message));
            }
        }
        Ok(())
    }

    fn check_friction(&self) -> Result<(), ParameterError> {
        use FrictionModel::{Coulomb, Velocity, VelocityForce, VelocityPressure};
        let model = self.friction_model;
        let by_speed: &[_] = &[Velocity, VelocityPressure];
        let all: [(&str, bool, &[FrictionModel]); 12] = [
            ("mu", self.mu.is_some(), &[Coulomb]),
            ("mu_slow", self.mu_slow.is_some(), by_speed),
            ("mu_fast", self.mu_fast.is_some(), by_speed),
            ("rate", self.rate.is_some(), by_speed),
            ("a_slow", self.a_slow.is_some(), &[VelocityForce]),
            ("n_slow", self.n_slow.is_some(), &[VelocityForce]),
            ("a_fast", self.a_fast.is_some(), &[VelocityForce]),
            ("n_fast", self.n_fast.is_some(), &[VelocityForce]),
            ("rate_0", self.rate_0.is_some(), &[VelocityForce]),
            ("area", self.area.is_some(), &[VelocityPressure]),
            ("delta_mu", self.delta_mu.is_some(), &[VelocityPressure]),
            ("pressure_rate", self.pressure_rate.is_some(), &[VelocityPressure]),
        ];
        let names: Vec<_> = all.iter().filter(|p| p.2.contains(&model)).map(|p| p.0).collect();
        let names = names.join("`, `");
        for (name, given, models) in all {
            if given != models.contains(&model) {
                let message = format!("`friction_model: {model:?}` takes `{names}`, all of them");
                return Err(ParameterError::inconsistent(name, message));
            }
        }
        let graded = [self.rate_1, self.rate_2].iter().any(|r| *r != 0.0);
        if graded && model != VelocityForce {
            let message = "`rate_1` and `rate_2` belong to `friction_model: VelocityForce`";
            return Err(ParameterError::inconsistent("rate_1", message));
        }
        match (self.mu_fast, self.delta_mu) {
            (Some(fast), Some(drop)) if drop > fast => {
                let message = format!("μ would be negative: at most `mu_fast` = {fast}");
                Err(ParameterError::inconsistent("delta_mu", message))
            }
            _ => Ok(()),
        }
    }
}

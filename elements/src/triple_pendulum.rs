//! TriplePendulum: a bearing with four concave surfaces, two outer ones and two on the inner slider.
//!
//! ```text
//!   ▔▔▔╲___________╱▔▔▔   surface 4: outer, top       Rᵢ* = Rᵢ − hᵢ          effective radius
//!       ╲_╲_____╱_╱       surface 3: inner, top       one after the other carry the shear F:
//!       ╱‾╱‾‾‾‾‾╲‾╲       surface 2: inner, bottom
//!   ▁▁▁╱‾‾‾‾‾‾‾‾‾‾‾╲▁▁▁   surface 1: outer, bottom    F = N wᵢ/R̄ᵢ + τᵢ + stop(wᵢ),   Σ wᵢ = (d₂, d₃)
//!
//!   τᵢ = kₛ (wᵢ − aᵢ), |τᵢ| ≤ μᵢ N            anchors aᵢ slip at the limit
//!   R̄₁ = R₁* − R₂*,  R̄₂ = R₂*,  R̄₃ = R₃*,  R̄₄ = R₄* − R₃*
//!   stops: D̄₁ = d₁ (1 − R₂*/R₁*),  D̄₂ = d₂ + d₁ R₂*/R₁*,  and 4, 3 in the same way
//!   μᵢ = μ_fast − (μ_fast − μ_slow) e^(−r vᵢ)
//!   f₁ = min(0, kₙ d₁ + c ḋ₁) closed, N = −f₁  (with `pull`: kₙ d₁ + c ḋ₁, N = −kₙ d₁)
//! ```
//!
//! Lists have four numbers, surfaces 1 to 4. The inner surfaces must be tighter than the outer ones of
//! their side (R₂* < R₁*, R₃* < R₄*) and slide before them (μ₂ ≤ μ₁, μ₃ ≤ μ₄). The displacement of the
//! real surface 1 is w₁ R₁*/R̄₁: an inner surface stands still while its outer neighbour slides, because
//! the slide plate tilts. In series the same shear results from surfaces of other radii which all go on,
//! so wᵢ, the history variables, are displacements of the series and not of the surfaces. This is exact
//! for all five regimes of \[Fenz & Constantinou 2008\] and their unloading:
//!
//! ```text
//!   I    2 and 3 slide    N/(R₂* + R₃*)          IV   1 at its rim, 2 and 4   N/(R₂* + R₄*)
//!   II   1 and 3          N/(R₁* + R₃*)          V    1 and 4 at their rims, 2 and 3   N/(R₂* + R₃*)
//!   III  1 and 4          N/(R₁* + R₄*)
//! ```
//!
//! Both directions are coupled on every surface. The friction of surface i sees the mean rate vᵢ at which
//! it slips in the step (its anchor, not its spring), for 1 and 4 times R*/R̄: it lags half a step behind a
//! speed that changes. The displacements of a step solve the equilibrium of the series, which has one
//! solution.
//!
//! Lifted, the bearing has no shear, and its parts share further motion in proportion of R̄ up to their
//! rims; all rims together hold it where every surface has one. Touching again, the friction starts new.
//!
//! **Energy.** Stored: ½ kₙ d₁² + Σ|τᵢ|²/(2kₛ) + rims + the work of the restoring forces so far
//! (history). Friction: Σ ½ (τᵢ₀ + τᵢ₁)·Δaᵢ.
//!
//! Reference: \[Fenz & Constantinou 2008, Spherical sliding isolation bearings with adaptive behavior\] for
//! the regimes, \[Fenz & Constantinou 2008, Modeling triple friction pendulum bearings\] for the series.

mod law;
mod series;
#[cfg(test)]
mod tests;

use crate::shared::parameters::none_negative;
use crate::shared::sliding::Stop;
use serde::Deserialize;
use series::SURFACES;
use trilith_element::{
    Card, Category, Described, Exercise, NodeCount, ParameterError, Parameters, Stroke,
};

/// Sliding bearing with four concave surfaces; the law is in `law.rs` beside this file.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct TriplePendulum {
    /// stiffness in compression
    #[parameter("kₙ", unit = "N/m", range = Positive)]
    pub kn: f64,
    /// dashpot along the axis, acts only while closed
    #[parameter("c", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub damping: f64,
    /// the dashpot may pull while closed; friction is of kₙ d₁ then
    #[parameter]
    pub pull: bool,
    /// stiffness before slip of each surface
    #[parameter("kₛ", unit = "N/m", range = Positive)]
    pub ks: f64,
    /// radii of surfaces 1 to 4
    #[parameter("R", unit = "m")]
    pub radii: [f64; SURFACES],
    /// distances of the surfaces from the pivot point, taken off the radii; none: 0
    #[parameter("h", unit = "m")]
    pub heights: Option<[f64; SURFACES]>,
    /// displacements at which the surfaces meet their rims; 0: no rim
    #[parameter("d", unit = "m")]
    pub capacities: Option<[f64; SURFACES]>,
    /// stiffness of each rim; required with `capacities`
    #[parameter("kₛₜ", unit = "N/m", range = Positive)]
    pub stop_stiffness: Option<f64>,
    /// friction coefficients
    #[parameter("μ", unit = "1")]
    pub mu: Option<[f64; SURFACES]>,
    /// instead of `mu`: at rest
    #[parameter("μ_slow", unit = "1")]
    pub mu_slow: Option<[f64; SURFACES]>,
    /// instead of `mu`: at speed
    #[parameter("μ_fast", unit = "1")]
    pub mu_fast: Option<[f64; SURFACES]>,
    /// how fast μ goes from slow to fast
    #[parameter("r", unit = "s/m")]
    pub rate: Option<[f64; SURFACES]>,
}

impl Described for TriplePendulum {
    const CARD: Card = Card::new(
        "TriplePendulum",
        Category::Link,
        "Sliding bearing with four concave surfaces and their rims.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("F = N wᵢ/R̄ᵢ + τᵢ + stop(wᵢ) for each surface i, Σ wᵢ = (d₂, d₃)\n\
          τᵢ = kₛ (wᵢ − aᵢ), |τᵢ| ≤ μᵢ N (radial return)\n\
          R* = R − h;  R̄₁ = R₁* − R₂*, R̄₂ = R₂*, R̄₃ = R₃*, R̄₄ = R₄* − R₃*\n\
          rims: D̄₁ = d₁ (1 − R₂*/R₁*), D̄₂ = d₂ + d₁ R₂*/R₁*; 4 and 3 in the same way\n\
          μᵢ = μ_fast − (μ_fast − μ_slow) e^(−r vᵢ)\n\
          f₁ = min(0, kₙ d₁ + c ḋ₁) closed, N = −f₁")
    .source("Fenz & Constantinou 2008, Earthquake Engng Struct. Dyn. 37: 163 and 185; \
             Modeling triple friction pendulum bearings, 37: 1401")
    .example(r#""bearing": TriplePendulum(node: "base", kn: "2e9 N/m", ks: "1e8 N/m", radii: ("2.2 m", "0.4 m", "0.4 m", "2.2 m"), heights: ("0.1 m", "0.05 m", "0.05 m", "0.1 m"), capacities: ("0.35 m", "0.05 m", "0.05 m", "0.35 m"), stop_stiffness: "2e7 N/m", mu: (0.05, 0.02, 0.02, 0.09))"#)
    .exercise(Exercise::new(0.1, &[
            Stroke::about(-5e-4, 0.0),
            Stroke::about(0.0, 0.76),
            Stroke::about(0.0, 0.0),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        for (name, list, unit) in [
            ("heights", self.heights, "m"),
            ("capacities", self.capacities, "m"),
            ("mu", self.mu, ""),
            ("mu_slow", self.mu_slow, ""),
            ("mu_fast", self.mu_fast, ""),
            ("rate", self.rate, "s/m"),
        ] {
            none_negative(name, &list.unwrap_or_default(), unit)?;
        }
        let r = self.effective();
        if r.iter().any(|r| *r <= 0.0) || r[1] >= r[0] || r[2] >= r[3] {
            let message = format!(
                "radius less height must be > 0, and less for 2 than for 1 and for 3 than for 4: \
                 they are {}, {}, {} and {} m",
                r[0], r[1], r[2], r[3]
            );
            return Err(ParameterError::inconsistent("radii", message));
        }
        let graded = [self.mu_slow, self.mu_fast, self.rate].map(|x| x.is_some());
        if self.mu.is_some() == graded.contains(&true) || (self.mu.is_none() && graded != [true; 3])
        {
            let message = "give `mu`, or all of `mu_slow`, `mu_fast` and `rate`";
            return Err(ParameterError::inconsistent("mu", message));
        }
        if let (Some(slow), Some(fast)) = (self.mu_slow, self.mu_fast)
            && (0..SURFACES).any(|i| slow[i] > fast[i])
        {
            let message = "friction that falls with speed has no unique share among the surfaces: \
                           `mu_slow` at most `mu_fast`";
            return Err(ParameterError::inconsistent("mu_slow", message));
        }
        for (name, mu) in [("mu", self.mu), ("mu_slow", self.mu_slow), ("mu_fast", self.mu_fast)] {
            if let Some(mu) = mu {
                self.check_order(name, mu)?;
            }
        }
        let rims = self.capacities.is_some_and(|d| d.iter().any(|d| *d > 0.0));
        if rims != self.stop_stiffness.is_some() {
            let message = "`capacities` and `stop_stiffness` go together: give both, or none";
            return Err(ParameterError::inconsistent("stop_stiffness", message));
        }
        Ok(())
    }
}

impl TriplePendulum {
    /// The inner surface of a side slides first, and not onto its rim before the outer one slides.
    fn check_order(&self, name: &str, mu: [f64; SURFACES]) -> Result<(), ParameterError> {
        let (r, capacities) = (self.effective(), self.capacities.unwrap_or_default());
        for (outer, inner) in [(0, 1), (3, 2)] {
            if mu[inner] > mu[outer] {
                let message = format!(
                    "the inner surface {} must not be rougher than the outer one {}: {} > {}",
                    inner + 1,
                    outer + 1,
                    mu[inner],
                    mu[outer]
                );
                return Err(ParameterError::inconsistent(name, message));
            }
            let needed = (mu[outer] - mu[inner]) * r[inner];
            if capacities[inner] > 0.0 && capacities[inner] < needed {
                let message = format!(
                    "the inner surface {} would meet its rim before the outer one {} slides: \
                     with `{name}` it moves {needed} m until then",
                    inner + 1,
                    outer + 1,
                );
                return Err(ParameterError::inconsistent("capacities", message));
            }
        }
        Ok(())
    }

    /// Effective radii R*.
    fn effective(&self) -> [f64; SURFACES] {
        let heights = self.heights.unwrap_or_default();
        std::array::from_fn(|i| self.radii[i] - heights[i])
    }

    /// Radii R̄ of the surfaces in series.
    fn radii_in_series(&self) -> [f64; SURFACES] {
        let r = self.effective();
        [r[0] - r[1], r[1], r[2], r[3] - r[2]]
    }

    /// Displacement of the real surface over that in series.
    fn slide_in_series(&self, i: usize) -> f64 {
        match i {
            0 | 3 => self.effective()[i] / self.radii_in_series()[i],
            _ => 1.0,
        }
    }

    /// Rims of the surfaces in series.
    fn stops(&self) -> [Option<Stop>; SURFACES] {
        let (Some(d), Some(stiffness)) = (self.capacities, self.stop_stiffness) else {
            return [None; SURFACES];
        };
        let r = self.effective();
        let tilt = [r[1] / r[0], r[2] / r[3]];
        let stop = |at: f64, exists: bool| exists.then_some(Stop { at, stiffness });
        [
            stop(d[0] * (1.0 - tilt[0]), d[0] > 0.0),
            stop(d[1] + d[0] * tilt[0], d[0] > 0.0 && d[1] > 0.0),
            stop(d[2] + d[3] * tilt[1], d[2] > 0.0 && d[3] > 0.0),
            stop(d[3] * (1.0 - tilt[1]), d[3] > 0.0),
        ]
    }
}

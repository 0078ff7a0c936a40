//! Viscoelastic damper with a loss factor that hardly depends on the frequency: a generalised Zener
//! (Maxwell–Wiechert) model.
//!
//! ```text
//!   f = k∞ d + Σ fᵢ,      ḟᵢ = kᵢ ḋ − fᵢ/τᵢ                 i = 1 … N
//!   K'(ω) = k∞ + Σ kᵢ (ωτᵢ)²/(1 + (ωτᵢ)²),   K''(ω) = Σ kᵢ ωτᵢ/(1 + (ωτᵢ)²),   η = K''/K'
//! ```
//!
//! A causal law with a constant loss factor stiffens with the frequency: the only one is the springpot
//! K (iω/ω₀)^β, β = (2/π) atan η, with K' = k (f/f₀)^β. Its spectrum of relaxation times is
//! h(ln τ) = k sin(πβ)/(π cos(πβ/2)) (ω₀τ)^(−β); the branches are its values at times spaced evenly in
//! ln τ, two for each factor of ten, over the band and a factor of three beyond both ends, and one branch
//! more at each end that stands for all beyond. In the band K' is within 0.2 % of the springpot and η
//! within 0.2 % of `loss_factor`.
//!
//! Steps are exact for a rate that is linear in them. In a static analysis the branches keep their force.
//!
//! Reference: \[Bland 1960\] for the model, \[Bagley & Torvik 1983\] for the springpot.

mod branches;

use crate::shared::relaxation::relax;
use branches::{Branch, Branches};
use serde::Deserialize;
use std::borrow::Cow;
use std::sync::OnceLock;
use trilith_element::lanes::LaneAt;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, Kinematics, Link, NodeCount,
    ParameterError, Parameters, Response, Stroke,
};

/// Springs and Maxwell branches with a near-constant loss factor.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct FrequencyIndependentViscoelastic {
    /// storage stiffness at √(f_min f_max)
    #[parameter("k", unit = "N/m", about = "N·m/rad", range = Positive)]
    pub k: Option<f64>,
    /// loss factor in the band
    #[parameter("η", unit = "1", range = Above(0.0, 2.0))]
    pub loss_factor: Option<f64>,
    /// lower end of the band
    #[parameter("f_min", unit = "Hz", range = Positive)]
    pub f_min: Option<f64>,
    /// upper end of the band
    #[parameter("f_max", unit = "Hz", range = Positive)]
    pub f_max: Option<f64>,
    /// instead: stiffness beside the branches
    #[parameter("k∞", unit = "N/m", about = "N·m/rad", range = NonNegative)]
    pub k_inf: Option<f64>,
    /// instead: stiffnesses of the branches
    #[parameter("kᵢ", unit = "N/m", about = "N·m/rad", range = NonNegative)]
    pub stiffness: Option<Vec<f64>>,
    /// instead: relaxation times of the branches
    #[parameter("τᵢ", unit = "s", range = Positive)]
    pub time: Option<Vec<f64>>,
    /// local axis
    #[parameter(choices = Axis::NAMES, default = "U1")]
    pub axis: Axis,
    /// Worked out once.
    #[serde(skip)]
    branches: OnceLock<Branches>,
}

impl Described for FrequencyIndependentViscoelastic {
    const CARD: Card = Card::new(
        "FrequencyIndependentViscoelastic",
        Category::Link,
        "Viscoelastic damper with a near-constant loss factor: springs and Maxwell branches.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = k∞ d + Σ fᵢ, ḟᵢ = kᵢ ḋ − fᵢ/τᵢ\n\
          fitted: K' = k (f/f₀)^β, K'' = η K', β = (2/π) atan η, f₀ = √(f_min f_max)")
    .source("Bland, The Theory of Linear Viscoelasticity, 1960; Bagley & Torvik 1983 (springpot)")
    .example(r#""pad": FrequencyIndependentViscoelastic(nodes: ("a", "b"), k: "5 MN/m", loss_factor: 0.4, f_min: "0.1 Hz", f_max: "10 Hz")"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.02)]));

    fn check(&self) -> Result<(), ParameterError> {
        let fitted = [
            ("k", self.k),
            ("loss_factor", self.loss_factor),
            ("f_min", self.f_min),
            ("f_max", self.f_max),
        ];
        let given = self.stiffness.is_some() || self.time.is_some() || self.k_inf.is_some();
        let wrong = |name: &str, message: &str| Err(ParameterError::inconsistent(name, message));
        if given {
            if let Some((name, _)) = fitted.iter().find(|(_, x)| x.is_some()) {
                let message = "give either `k`, `loss_factor`, `f_min` and `f_max`, or `k_inf`, \
                               `stiffness` and `time`";
                return wrong(name, message);
            }
            let (Some(k), Some(t)) = (&self.stiffness, &self.time) else {
                return wrong("stiffness", "branches take both `stiffness` and `time`");
            };
            if k.len() != t.len() || k.is_empty() {
                return wrong("time", "each branch takes one `stiffness` and one `time`");
            }
            if t.iter().any(|t| *t <= 0.0) {
                return wrong("time", "relaxation times must be > 0");
            }
            return crate::shared::parameters::none_negative("stiffness", k, "N/m");
        }
        if let Some((name, _)) = fitted.iter().find(|(_, x)| x.is_none()) {
            let message = format!(
                "`{name}` is missing: a band takes `k`, `loss_factor`, `f_min` and `f_max`; given branches take `k_inf`, `stiffness` and `time`"
            );
            return wrong(name, &message);
        }
        if self.f_min >= self.f_max {
            return wrong("f_max", "`f_max` must be larger than `f_min`");
        }
        if self.f_max.unwrap_or(0.0) > 1e6 * self.f_min.unwrap_or(0.0) {
            return wrong("f_max", "the band may not be wider than six decades");
        }
        Ok(())
    }
}

impl FrequencyIndependentViscoelastic {
    fn branches(&self) -> &Branches {
        self.branches.get_or_init(|| match (&self.stiffness, &self.time) {
            (Some(k), Some(t)) => Branches {
                k_inf: self.k_inf.unwrap_or(0.0),
                branches: k.iter().zip(t).map(|(k, tau)| Branch { k: *k, tau: *tau }).collect(),
            },
            _ => {
                let [k, loss, low, high] =
                    [self.k, self.loss_factor, self.f_min, self.f_max].map(|x| x.unwrap_or(1.0));
                Branches::fitted(k, loss, low, high)
            }
        })
    }

    /// Storage and loss stiffness at a frequency in Hz, N/m or N·m/rad.
    #[must_use]
    pub fn moduli(&self, frequency: f64) -> [f64; 2] {
        self.branches().moduli(std::f64::consts::TAU * frequency)
    }
}

impl Link for FrequencyIndependentViscoelastic {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        let unit = if self.axis.index() > 2 { "N·m" } else { "N" };
        let field = |i| Field::named(format!("branch{i}"), unit);
        (1..=self.branches().branches.len()).map(field).collect()
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let all = self.branches();
        k[0] = all.k_inf + all.branches.iter().map(|b| b.k).sum::<f64>();
    }

    // A spring lies before all that is viscous: the force follows the deformation at once.
    fn damps(&self) -> bool {
        false
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let all = self.branches();
        let asked = LaneAt::new(at, committed, &[]);
        let (k, d) = (all.k_inf, at.d[0]);
        (out.f[0], out.k[0], out.energy.stored) = (k * d, k, 0.5 * k * d * d);
        for ((branch, f0), f) in all.branches.iter().zip(committed).zip(trial) {
            let end = relax(branch.k, branch.tau, *f0, &asked);
            *f = end.f;
            out.f[0] += end.f;
            out.k[0] += end.f_d;
            out.c[0] += end.f_v;
            if branch.k > 0.0 {
                out.energy.stored += 0.5 * end.f * end.f / branch.k;
                out.energy.viscous += end.viscous;
            }
        }
    }
}

#[cfg(test)]
mod tests;

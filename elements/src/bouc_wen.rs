//! BoucWen: smooth hysteretic spring whose strength and stiffness degrade with the energy it takes, along or
//! about one axis.
//!
//! ```text
//!   f = α k d + (1 − α) k d_y z
//!   ż = (ḋ/d_y) [A − ν |z|ⁿ (γ + β sgn(ḋ z))]/η            z = 0 at rest
//!   A = A₀ − δ_A ε (at least A₀/100),   ν = 1 + δ_ν ε,   η = 1 + δ_η ε
//!   ε = ∫ z dd/d_y                                         work of the part (1 − α) k, over (1 − α) k d_y²
//! ```
//!
//! z has no dimension, so that β, γ and δ have none. A deformation z̃ = d_y z with the work in J has β̃ = β/d_yⁿ,
//! γ̃ = γ/d_yⁿ and δ̃ = δ/((1 − α) k d_y²): these are the numbers of `BoucWen` in OpenSees, in the order α, k, n,
//! γ̃, β̃, A₀, δ̃_A, δ̃_ν, δ̃_η. ε is the whole work of z since rest, elastic part included, as in the source: it
//! falls a little on every return.
//!
//! A that fell to zero would leave a spring without stiffness and then one that pushes; it stays at A₀/100.
//! |γ| ≤ β is the condition that no part of a loop gives energy; β + γ > 0 that z has a limit,
//! (A/(ν (β + γ)))^(1/n). With δ = 0 and β = γ = ½ it is [`Wen`](crate::Wen). The integration over the straight
//! path of a step is of order 4 (`bouc_wen/integration.rs`).
//!
//! **Energy.** Stored ½ α k d² and, of ε, what an elastic return ż = (A/η) ḋ/d_y would give back; the rest θ of
//! ε is hysteretic, all in (1 − α) k d_y². Both follow from z and ε, and θ never falls:
//!
//! ```text
//!   ∫_θ^ε A/η dε = ½ z²         θ̇ = η(θ)/A(θ) · ν/η |z|ⁿ⁺¹ (β |ḋ| + γ ḋ sgn z)/d_y ≥ 0
//! ```
//!
//! Reference: \[Bouc 1967\], \[Wen 1976\]; degradation \[Baber & Wen 1981\], \[Baber & Noori 1985\]; bounds of β
//! and γ \[Erlicher & Point 2004\].

mod energy;
mod integration;
#[cfg(test)]
mod tests;

use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Kinematics, Link,
    NodeCount, ParameterError, Parameters, Response, Stroke, history,
};

/// A never falls below this share of A₀.
const LEAST: f64 = 0.01;

/// Smooth hysteretic spring that degrades.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct BoucWen {
    /// stiffness at rest (where A₀ = 1)
    #[parameter("k", unit = "N/m", about = "N·m/rad", range = Positive)]
    pub k: f64,
    /// deformation that z counts in; at yield where β + γ = A₀ = 1
    #[parameter("d_y", unit = "m", about = "rad", range = Positive)]
    pub dy: f64,
    /// stiffness after yielding over `k`
    #[parameter("α", unit = "1", range = Within(0.0, 1.0))]
    pub alpha: f64,
    /// sharpness of yielding
    #[parameter("n", unit = "1", range = Within(1.0, 50.0), default = 2.0)]
    pub n: f64,
    /// shape: loading against β + γ, return with β − γ
    #[parameter("β", unit = "1", range = Positive, default = 0.5)]
    pub beta: f64,
    /// shape, −β < γ ≤ β; at γ = β the return is elastic
    #[parameter("γ", unit = "1", default = 0.5)]
    pub gamma: f64,
    /// stiffness of z at rest
    #[parameter("A₀", unit = "1", range = Positive, default = 1.0)]
    pub a0: f64,
    /// loss of stiffness and strength with ε
    #[parameter("δ_A", unit = "1", range = NonNegative, default = 0.0)]
    pub delta_a: f64,
    /// loss of strength with ε
    #[parameter("δ_ν", unit = "1", range = NonNegative, default = 0.0)]
    pub delta_nu: f64,
    /// loss of stiffness with ε
    #[parameter("δ_η", unit = "1", range = NonNegative, default = 0.0)]
    pub delta_eta: f64,
    /// local axis
    #[parameter(choices = Axis::NAMES, default = "U1")]
    pub axis: Axis,
}

history! {
    /// History of a [`BoucWen`].
    pub struct BoucWenHistory {
        /// z.
        pub z: "1",
        /// Work of z so far ε, over (1 − α) k d_y².
        pub work: "1",
        /// The part of it that became heat, θ.
        pub heat: "1",
    }
}

impl Described for BoucWen {
    const CARD: Card = Card::new(
        "BoucWen",
        Category::Link,
        "Smooth hysteretic spring that loses strength and stiffness (Bouc, Wen, Baber).",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = α k d + (1 − α) k d_y z\n\
          ż = (ḋ/d_y) [A − ν |z|ⁿ (γ + β sgn(ḋ z))]/η\n\
          A = A₀ − δ_A ε (at least A₀/100), ν = 1 + δ_ν ε, η = 1 + δ_η ε, ε = ∫ z dd/d_y")
    .source("Baber & Wen, Random Vibration of Hysteretic Degrading Systems, 1981; Erlicher & Point 2004")
    .example(r#""wall": BoucWen(nodes: ("a", "b"), axis: U2, k: "40 MN/m", dy: "5 mm", alpha: 0.05, n: 1.5, beta: 0.8, gamma: 0.2, delta_nu: 0.02, delta_eta: 0.08)"#)
    .exercise(Exercise::new(0.5, &[Stroke::about(0.0, 0.04)]));

    fn check(&self) -> Result<(), ParameterError> {
        let Self { beta, gamma, .. } = *self;
        if beta + gamma <= 0.0 {
            let message = format!(
                "β + γ = {} gives z no limit: `gamma` must lie above −`beta` = {}",
                beta + gamma,
                -beta
            );
            return Err(ParameterError::inconsistent("gamma", message));
        }
        if gamma > beta {
            let message = format!(
                "γ = {gamma} above β = {beta} would give energy on a return: `gamma` must be at most `beta`"
            );
            return Err(ParameterError::inconsistent("gamma", message));
        }
        Ok(())
    }
}

impl Link for BoucWen {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        BoucWenHistory::FIELDS.into()
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k * (self.alpha + (1.0 - self.alpha) * self.a0);
    }

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
        let Self { k, dy, alpha, .. } = *self;
        let old = BoucWenHistory::load(committed);
        let u = (at.d[0] - at.d0[0]) / dy;
        let end = integration::advance(self, old.z, old.work, u, at.v[0], integration::STEPS);
        let (z, work) = (end.z, end.work);
        let heat = self.heat(old.heat, work, z);
        BoucWenHistory { z, work, heat }.store(trial);
        let (d, plastic) = (at.d[0], 1.0 - alpha);
        out.f[0] = k * (alpha * d + plastic * dy * z);
        out.k[0] = k * (alpha + plastic * end.slope);
        let size = plastic * k * dy * dy;
        out.energy.stored = 0.5 * alpha * k * d * d + size * (work - heat);
        out.energy.hysteretic = size * (heat - old.heat);
    }
}

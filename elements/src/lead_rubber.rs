//! LeadRubber: lead-rubber bearing whose core softens as it heats up.
//!
//! ```text
//!   fᵢ = k_r dᵢ + Q(T) zᵢ,   i = 2, 3        f₁ = k_v d₁
//!   żᵢ = ωᵢ − zᵢ |z|^(η−2) Σⱼ ωⱼ zⱼ (γ + β sⱼ),   ω = ḋ/Y      sⱼ = sgn(ωⱼ zⱼ) (`Axes`) or sgn(ω·z) (`Direction`)
//!   Q  = A σ₀ e^(−E T),   A = π a²           T: temperature rise of the core, a = D/2
//!   ρ c A h Ṫ = Q Y Σᵢ zᵢ (ωᵢ − żᵢ) − ρ c A h g(t) T
//!   g  = k_s/(a ρ c h) (1/F(τ) + 1.274 (t_s/a) τ^(−1/3)),   τ = α_s t/a²     (F: lead_rubber/cooling.rs)
//! ```
//!
//! z is that of [`RubberIsolator`](crate::RubberIsolator); OpenSees' *LeadRubberX* has `beta: 0.9, gamma: 0.1`. The core is
//! heated by what it dissipates (published forms count |z| |ḋ|, which is more by the elastic part of the
//! motion). t counts from the first heating. In a step: half of the loss to the steel, the heating in
//! closed form, the other half; second order. A static step is slow and does not heat. The axial spring is
//! linear: neither cavitation nor buckling, nor the dependence of k_v on the displacement.
//!
//! **Energy.** The elastic stretch of the core holds up to ½ Q Y |z|². As Q falls, what it can no longer hold
//! becomes heat; as Q rises in cooling nothing is added.
//!
//! Reference: \[Kalpakidis & Constantinou 2009\]; \[Kumar, Whittaker & Constantinou 2014\].

mod cooling;
mod law;
#[cfg(test)]
mod tests;

use crate::shared::bouc_wen_plane::{Coupling, Shape};
use crate::shared::written::{Written, answers_by_law};
use law::Law;
use serde::Deserialize;
use std::borrow::Cow;
use std::f64::consts::PI;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Link, NodeCount,
    ParameterError, Parameters, Stroke, history,
};

/// Lead-rubber bearing with heating of its core.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct LeadRubber {
    /// shear stiffness of the rubber, its modulus · area/thickness
    #[parameter("k_r", unit = "N/m", range = NonNegative)]
    pub kr: f64,
    /// diameter of the core
    #[parameter("D", unit = "m", range = Positive)]
    pub lead_diameter: f64,
    /// height of the core, rubber and shims
    #[parameter("h", unit = "m", range = Positive)]
    pub lead_height: f64,
    /// yield stress of the cold core
    #[parameter("σ₀", unit = "Pa", range = Positive, default = 10000000.0)]
    pub lead_strength: f64,
    /// displacement at which the core yields
    #[parameter("Y", unit = "m", range = Positive)]
    pub yield_displacement: f64,
    /// thickness of all steel shims together
    #[parameter("t_s", unit = "m", range = NonNegative, default = 0.0)]
    pub shim_thickness: f64,
    /// the core heats up
    #[parameter(default = true)]
    pub heating: bool,
    /// axial stiffness, both ways
    #[parameter("k_v", unit = "N/m", range = NonNegative, default = 0.0)]
    pub kv: f64,
    /// loss of strength with temperature, per K
    #[parameter("E", unit = "1/K", range = Positive, default = 0.0069)]
    pub softening: f64,
    /// density of lead
    #[parameter("ρ", unit = "kg/m³", range = Positive, default = 11200.0)]
    pub lead_density: f64,
    /// specific heat of lead, J/(kg K)
    #[parameter("c", unit = "J/(kg·K)", range = Positive, default = 130.0)]
    pub lead_heat: f64,
    /// thermal conductivity of steel, W/(m K)
    #[parameter("k_s", unit = "W/(m·K)", range = NonNegative, default = 50.0)]
    pub steel_conductivity: f64,
    /// thermal diffusivity of steel
    #[parameter("α_s", unit = "m²/s", range = Positive, default = 1.41e-5)]
    pub steel_diffusivity: f64,
    /// how unloading is told: axis by axis, or by the direction of the motion
    #[parameter(choices = Coupling::NAMES, default = "Axes")]
    pub coupling: Coupling,
    /// shape: loading against β + γ, return with γ − β
    #[parameter("β", unit = "1", range = Positive, default = 0.5)]
    pub beta: f64,
    /// shape, −β < γ ≤ β; at γ = β the return is elastic
    #[parameter("γ", unit = "1", default = 0.5)]
    pub gamma: f64,
    /// sharpness of yielding
    #[parameter("η", unit = "1", range = Within(1.0, 20.0), default = 2.0)]
    pub eta: f64,
}

history! {
    /// History of a [`LeadRubber`].
    pub struct LeadHistory {
        /// Share of the core's force along U2.
        pub z2: "1",
        /// Share of the core's force along U3.
        pub z3: "1",
        /// Temperature rise of the core.
        pub temperature: "K",
        /// Time since the first heating.
        pub heated: "s",
        /// Energy in the elastic stretch of the core.
        pub stretch: "J",
    }
}

// Temperature has no dimension of its own: per kelvin is per 1.
impl Described for LeadRubber {
    const CARD: Card = Card::new(
        "LeadRubber",
        Category::Link,
        "Lead-rubber bearing whose core softens as it heats up.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("fᵢ = k_r dᵢ + Q zᵢ, i = 2, 3;  f₁ = k_v d₁;  Q = π D²/4 σ₀ e^(−E T)\n\
          żᵢ = ωᵢ − zᵢ |z|^(η−2) Σⱼ ωⱼ zⱼ (γ + β sⱼ),  ω = ḋ/Y\n\
          Axes: sⱼ = sgn(ωⱼ zⱼ);  Direction: sⱼ = sgn(ω·z)\n\
          ρ c A h Ṫ = Q Y Σᵢ zᵢ (ωᵢ − żᵢ) − loss to end plates and shims")
    .source("Kalpakidis & Constantinou 2009; Kumar, Whittaker & Constantinou 2014")
    .example(r#""bearing": LeadRubber(nodes: ("ground", "slab"), kr: "1.5 MN/m", lead_diameter: "160 mm", lead_height: "300 mm", yield_displacement: "10 mm", shim_thickness: "60 mm", kv: "1500 MN/m")"#)
    .exercise(Exercise::new(0.4, &[
            Stroke::about(-0.001, 0.0),
            Stroke::about(0.0, 0.2),
            Stroke::about(0.0, 0.1).with_phase(0.25),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        self.shape().check()
    }
}

impl LeadRubber {
    fn shape(&self) -> Shape {
        let by_direction = self.coupling == Coupling::Direction;
        Shape { by_direction, beta: self.beta, gamma: self.gamma, eta: self.eta }
    }

    /// Force of the cold core.
    fn strength(&self) -> f64 {
        0.25 * PI * self.lead_diameter.powi(2) * self.lead_strength
    }

    /// Heat that warms the core by one kelvin, J.
    fn capacity(&self) -> f64 {
        let area = 0.25 * PI * self.lead_diameter.powi(2);
        self.lead_density * self.lead_heat * area * self.lead_height
    }

    /// Parameters of the law; see there.
    fn numbers(&self) -> [f64; law::PARAMETERS] {
        let a = 0.5 * self.lead_diameter;
        let per_area = self.lead_density * self.lead_heat * self.lead_height;
        let [how, beta, gamma, eta, limit] = self.shape().numbers();
        [
            self.kr,
            self.yield_displacement,
            self.kv,
            self.strength(),
            self.softening,
            f64::from(u8::from(self.heating)),
            self.capacity(),
            self.steel_conductivity / (a * per_area),
            self.steel_diffusivity / (a * a),
            self.shim_thickness / a,
            how,
            beta,
            gamma,
            eta,
            limit,
        ]
    }
}

impl Link for LeadRubber {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1, Axis::U2, Axis::U3])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        LeadHistory::FIELDS.into()
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let shear = self.kr + self.strength() / self.yield_displacement;
        (k[0], k[4], k[8]) = (self.kv, shear, shear);
    }

    fn damps(&self) -> bool {
        false
    }

    answers_by_law!();
}

impl LeadRubber {
    fn law(&self) -> Written {
        if self.shape().is_closed() {
            Written::of::<Law<true>>()
        } else {
            Written::of::<Law<false>>()
        }
    }
}

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
//! | parameter            | symbol | unit     | range | default | meaning                                  |
//! |----------------------|--------|----------|-------|---------|------------------------------------------|
//! | `kr`                 | k_r    | N/m      | ≥ 0   | –       | shear stiffness of the rubber, G A_r/T_r |
//! | `lead_diameter`      | D      | m        | > 0   | –       | diameter of the core                     |
//! | `lead_height`        | h      | m        | > 0   | –       | height of the core, rubber and shims     |
//! | `lead_strength`      | σ₀     | N/m²     | > 0   | 10 MPa  | yield stress of the core when cold       |
//! | `yield_displacement` | Y      | m        | > 0   | –       | displacement at which the core yields    |
//! | `shim_thickness`     | t_s    | m        | ≥ 0   | 0       | thickness of all steel shims together    |
//! | `heating`            |        |          |       | true    | the core heats up                        |
//! | `kv`                 | k_v    | N/m      | ≥ 0   | 0       | axial stiffness, both ways               |
//! | `softening`          | E      | 1/K      | > 0   | 0.0069  | loss of strength with temperature        |
//! | `lead_density`       | ρ      | kg/m³    | > 0   | 11200   | density of lead                          |
//! | `lead_heat`          | c      | J/(kg K) | > 0   | 130     | specific heat of lead                    |
//! | `steel_conductivity` | k_s    | W/(m K)  | ≥ 0   | 50      | thermal conductivity of steel            |
//! | `steel_diffusivity`  | α_s    | m²/s     | > 0   | 1.41e-5 | thermal diffusivity of steel             |
//! | `coupling`           |        |          |       | Axes    | how unloading is told: `Axes`, `Direction` |
//! | `beta`               | β      | 1        | > 0   | 0.5     | shape: loading against β + γ, return with γ − β |
//! | `gamma`              | γ      | 1        | −β … β | 0.5    | shape; at γ = β the return is elastic    |
//! | `eta`                | η      | 1        | 1 … 20 | 2      | sharpness of yielding                    |
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

use crate::shared::bouc_wen_plane::{Coupling, PARAMETERS, Shape};
use law::Law;
use serde::Deserialize;
use std::borrow::Cow;
use std::f64::consts::PI;
use trilith_element::dimension::{AREA, DENSITY, FREQUENCY, LENGTH, NONE, STIFFNESS, STRESS};
use trilith_element::lanes::{LaneAt, LaneForce, LaneForm, LaneLaw};
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Dimension, Exercise, Field, History, Kinematics,
    Link, NodeCount, Parameter, ParameterError, Range, Response, Stroke, history,
};

/// Lead-rubber bearing with heating of its core.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeadRubber {
    /// Shear stiffness of the rubber k_r, N/m.
    pub kr: f64,
    /// Diameter of the lead core D, m.
    pub lead_diameter: f64,
    /// Height of the lead core h, m.
    pub lead_height: f64,
    /// Yield stress of the cold core σ₀, N/m².
    pub lead_strength: f64,
    /// Yield displacement Y, m.
    pub yield_displacement: f64,
    /// Thickness of all shims t_s, m.
    pub shim_thickness: f64,
    /// The core heats up.
    pub heating: bool,
    /// Axial stiffness k_v, N/m.
    pub kv: f64,
    /// Loss of strength with temperature E, 1/K.
    pub softening: f64,
    /// Density of lead ρ, kg/m³.
    pub lead_density: f64,
    /// Specific heat of lead c, J/(kg K).
    pub lead_heat: f64,
    /// Thermal conductivity of steel k_s, W/(m K).
    pub steel_conductivity: f64,
    /// Thermal diffusivity of steel α_s, m²/s.
    pub steel_diffusivity: f64,
    /// How unloading is told.
    pub coupling: Coupling,
    /// Shape β.
    pub beta: f64,
    /// Shape γ.
    pub gamma: f64,
    /// Sharpness of yielding η.
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
const SPECIFIC_HEAT: Dimension = Dimension { mass: 0.0, length: 2.0, time: -2.0 };
const CONDUCTIVITY: Dimension = Dimension { mass: 1.0, length: 1.0, time: -3.0 };
const DIFFUSIVITY: Dimension = Dimension { mass: 0.0, length: AREA.length, time: FREQUENCY.time };

const fn positive(
    name: &'static str,
    symbol: &'static str,
    dimension: Dimension,
    default: f64,
    meaning: &'static str,
) -> Parameter {
    Parameter::number(name, symbol, dimension, Range::Positive, default, meaning)
}

impl Described for LeadRubber {
    const CARD: Card = Card::new(
        "LeadRubber",
        Category::Link,
        "Lead-rubber bearing whose core softens as it heats up.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(&[
        Parameter::required(
            "kr",
            "k_r",
            STIFFNESS,
            Range::NonNegative,
            "shear stiffness of the rubber",
        ),
        Parameter::required(
            "lead_diameter",
            "D",
            LENGTH,
            Range::Positive,
            "diameter of the core",
        ),
        Parameter::required("lead_height", "h", LENGTH, Range::Positive, "height of the core"),
        positive("lead_strength", "σ₀", STRESS, 1e7, "yield stress of the cold core"),
        Parameter::required(
            "yield_displacement",
            "Y",
            LENGTH,
            Range::Positive,
            "displacement at which the core yields",
        ),
        Parameter::number(
            "shim_thickness",
            "t_s",
            LENGTH,
            Range::NonNegative,
            0.0,
            "thickness of all steel shims together",
        ),
        Parameter::flag("heating", true, "the core heats up"),
        Parameter::number(
            "kv",
            "k_v",
            STIFFNESS,
            Range::NonNegative,
            0.0,
            "axial stiffness, both ways",
        ),
        positive("softening", "E", NONE, 0.0069, "loss of strength with temperature, per K"),
        positive("lead_density", "ρ", DENSITY, 11_200.0, "density of lead"),
        positive("lead_heat", "c", SPECIFIC_HEAT, 130.0, "specific heat of lead, J/(kg K)"),
        Parameter::number(
            "steel_conductivity",
            "k_s",
            CONDUCTIVITY,
            Range::NonNegative,
            50.0,
            "thermal conductivity of steel, W/(m K)",
        ),
        positive(
            "steel_diffusivity",
            "α_s",
            DIFFUSIVITY,
            1.41e-5,
            "thermal diffusivity of steel",
        ),
        PARAMETERS[0],
        PARAMETERS[1],
        PARAMETERS[2],
        PARAMETERS[3],
    ])
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

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let numbers = self.numbers();
        let asked = LaneAt::new(at, committed, &numbers);
        let mut force = LaneForce { f: out.f, k: out.k, c: out.c };
        let step = if self.shape().is_closed() {
            Law::<true>::respond(&asked, &mut force, trial)
        } else {
            Law::<false>::respond(&asked, &mut force, trial)
        };
        *out.energy = step.into();
    }

    fn lanes(&self, _: &[bool]) -> Option<LaneForm> {
        let (at, numbers) = (vec![0, 1, 2], self.numbers().to_vec());
        Some(if self.shape().is_closed() {
            LaneForm::of::<Law<true>>(at, numbers)
        } else {
            LaneForm::of::<Law<false>>(at, numbers)
        })
    }
}

//! MultilinearPlastic: plastic spring whose first loading follows a curve through points, along or about one
//! axis, with a choice of the rule for everything after.
//!
//! ```text
//!   f │     ___●───      first loading: the curve, f⁺(d) upwards and f⁻(d) downwards
//!     │  ●‾‾             K₀ = slope of its first line (each side its own)
//!     │ /
//!   ──●───────── d
//! ```
//!
//! | rule        | unloading                       | reloading                                      |
//! |-------------|---------------------------------|------------------------------------------------|
//! | `Kinematic` | the lines loaded before, each with its counterpart | the same; closes on the point it left |
//! | `Iwan`      | springs with sliders, side by side | the same; closes on the point it left       |
//! | `Isotropic` | K₀ over the range of both sides | goes on where the curve stands for the plastic path so far |
//! | `Takeda`    | K₀ to zero force                | straight to the largest deformation on that side, then the curve |
//! | `Pivot`     | towards a pivot at −α f_y       | to β f_y on the line of K₀ (pinching), on to the largest deformation, then the curve |
//!
//! `Kinematic` and `Iwan` are the same where both sides of the curve are alike: the path back is the curve doubled
//! (Masing). Where they differ, the path back of `Kinematic` is that of CSI's programs: parallel to the first line as
//! far as that was loaded, then to the first line of the other side and as long as that, then the same with the second
//! lines, and so on, until it meets the curve of the other side. `Iwan` has elements of which each takes the stiffness
//! of the side it is stretched to.
//!
//! What a rule needs of the curve: `Iwan` lines that get no steeper away from the origin; `Kinematic` besides none
//! steeper than those before it on the other side; the others none steeper than K₀ (`Pivot`: than the line to its
//! pivot). The path in a step is straight and each rule follows it exactly from corner to corner.
//!
//! **Energy.** Stored is what unloading to zero force gives back: ½ k e² of every elastic part
//! (`Kinematic`, `Iwan`, `Isotropic`), f²/(2 Kᵤ) with the slope Kᵤ of unloading (`Takeda`, `Pivot`). The rest of the
//! work is hysteretic and never falls: ∫ f (1 − Kₜ/Kᵤ) dd, times 1 − f/(2 (f + α f_y)) for `Pivot`, with
//! the tangent Kₜ ≤ Kᵤ.
//!
//! Reference: \[Masing 1926\], \[CSI Analysis Reference Manual, multi-linear kinematic plasticity property\]
//! (`Kinematic`); \[Iwan 1966\]; \[Takeda, Sozen & Nielsen 1970\] with the slope of
//! unloading kept, as CSI does; \[Dowell, Seible & Wilson 1998\] (`Pivot`, without the softening of
//! the elastic slopes that CSI calls η).

mod branch;
mod isotropic;
mod iwan;
mod kinematic;
mod pivot;
mod reloading;
mod takeda;
#[cfg(test)]
mod tests;

use crate::shared::multilinear::Curve;
use branch::Branch;
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::{
    Axis, Card, Category, Choices, Coordinates, Described, Exercise, Field, Kinematics, Link,
    NodeCount, ParameterError, Parameters, Response, Stroke,
};

/// What a [`MultilinearPlastic`] does after its first loading.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Rule {
    /// Back along the lines loaded before, each with its counterpart of the other side.
    Kinematic,
    /// Springs with sliders side by side.
    Iwan,
    /// The elastic range grows with the plastic path.
    Isotropic,
    /// Reloading towards the largest deformation.
    Takeda,
    /// The same with pivots for unloading and pinching.
    Pivot,
}

/// Plastic spring along a curve through points.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct MultilinearPlastic {
    /// deformations of the points, ascending
    #[parameter("dᵢ", unit = "m", about = "rad")]
    pub deformation: Vec<f64>,
    /// forces of the points, none against its deformation
    #[parameter("fᵢ", unit = "N", about = "N·m")]
    pub force: Vec<f64>,
    /// hysteresis; `Kinematic` is CSI's, also where the sides differ
    #[parameter(choices = Rule::NAMES, default = "Kinematic")]
    pub rule: Rule,
    /// Pivot: unloading from positive force goes towards −α₁ f_y (10)
    #[parameter("α₁", unit = "1", range = Positive)]
    pub alpha1: Option<f64>,
    /// Pivot: the same from negative force (α₁)
    #[parameter("α₂", unit = "1", range = Positive)]
    pub alpha2: Option<f64>,
    /// Pivot: loading to positive force goes through β₁ f_y (0.7)
    #[parameter("β₁", unit = "1", range = Within(0.0, 1.0))]
    pub beta1: Option<f64>,
    /// Pivot: the same to negative force (β₁)
    #[parameter("β₂", unit = "1", range = Within(0.0, 1.0))]
    pub beta2: Option<f64>,
    /// local axis
    #[parameter(choices = Axis::NAMES, default = "U1")]
    pub axis: Axis,
}

/// A straight step, for the rules.
#[derive(Clone, Copy)]
struct Step {
    /// Deformation at its start.
    d0: f64,
    /// Deformation at its end.
    d: f64,
    /// Sign of the motion, 0 at rest.
    direction: f64,
}

/// What a rule answers.
#[derive(Clone, Copy, Default)]
struct Answer {
    f: f64,
    k: f64,
    stored: f64,
    heat: f64,
}

impl Described for MultilinearPlastic {
    const CARD: Card = Card::new(
        "MultilinearPlastic",
        Category::Link,
        "Plastic spring along a curve through points: kinematic, Iwan, isotropic, Takeda or pivot.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("first loading: the curve through the points\n\
          Kinematic: back along the lines loaded before, each as far as it was loaded and followed by its counterpart \
          of the other side (both alike: the curve doubled, Masing)\n\
          Iwan: f = Σ kⱼ eⱼ + k_end d, the kⱼ of the side eⱼ is on, −dⱼ⁻ ≤ eⱼ ≤ dⱼ⁺ (both alike: the same as Kinematic)\n\
          Isotropic: K₀ over a range that grows with the plastic path\n\
          Takeda: back with K₀, then straight to the largest deformation on the other side\n\
          Pivot: back towards −α f_y on the line of K₀, then through β f_y on it to the largest deformation")
    .source("Masing 1926; CSI Analysis Reference Manual (Kinematic); Iwan 1966; Takeda, Sozen & Nielsen 1970; Dowell, Seible & Wilson 1998")
    .example(r#""hinge": MultilinearPlastic(nodes: ("a", "b"), axis: R3, deformation: [-0.04, -0.004, 0, 0.004, 0.04], force: ["-360 kN*m", "-300 kN*m", "0 kN*m", "300 kN*m", "360 kN*m"], rule: Takeda)"#)
    .exercise(Exercise::new(0.5, &[Stroke::about(0.0, 0.03)]));

    fn check(&self) -> Result<(), ParameterError> {
        self.curve().check()?;
        let wrong = |name: &str, message: &str| Err(ParameterError::inconsistent(name, message));
        let inside = 1..self.deformation.len() - 1;
        if !inside.contains(&self.origin()) || self.deformation[self.origin()] != 0.0 {
            let message = "the points must hold (0, 0) and points on both sides of it";
            return wrong("deformation", message);
        }
        for sign in [1.0, -1.0] {
            if self.branch(sign).slope(0) <= 0.0 {
                return wrong("force", "the lines on both sides of (0, 0) must rise");
            }
            match self.rule {
                Rule::Iwan => self.branch(sign).no_steeper_outwards("`Iwan`")?,
                Rule::Kinematic => {}
                Rule::Isotropic | Rule::Takeda => self.branch(sign).no_steeper_than_at_first()?,
                Rule::Pivot => pivot::Pivot::of(self).check(self.branch(sign))?,
            }
        }
        if self.rule == Rule::Kinematic {
            kinematic::check(self)?;
        }
        let given = [
            ("alpha1", self.alpha1),
            ("alpha2", self.alpha2),
            ("beta1", self.beta1),
            ("beta2", self.beta2),
        ];
        match given.iter().find(|(_, x)| x.is_some()) {
            Some((name, _)) if self.rule != Rule::Pivot => {
                wrong(name, &format!("`{name}` belongs to `rule: Pivot`"))
            }
            _ => Ok(()),
        }
    }
}

impl MultilinearPlastic {
    fn curve(&self) -> Curve<'_> {
        Curve { d: &self.deformation, f: &self.force }
    }

    /// The point (0, 0).
    fn origin(&self) -> usize {
        self.deformation.partition_point(|d| *d < 0.0)
    }

    fn branch(&self, sign: f64) -> Branch<'_> {
        Branch { curve: self.curve(), origin: self.origin(), sign }
    }
}

impl Link for MultilinearPlastic {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        let rotational = self.axis.index() > 2;
        let (length, force) = if rotational { ("rad", "N·m") } else { ("m", "N") };
        Cow::Owned(match self.rule {
            Rule::Kinematic | Rule::Iwan => iwan::fields(self, length),
            Rule::Isotropic => isotropic::fields(length),
            Rule::Takeda | Rule::Pivot => reloading::fields(length, force),
        })
    }

    fn at_rest(&self, at: &mut [f64]) {
        if matches!(self.rule, Rule::Takeda | Rule::Pivot) {
            reloading::at_rest(self, at);
        }
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.curve().stiffest();
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
        let (d0, d) = (at.d0[0], at.d[0]);
        let motion = if d == d0 { at.v[0] } else { d - d0 };
        let direction = if motion == 0.0 { 0.0 } else { motion.signum() };
        let step = Step { d0, d, direction };
        let answer = match self.rule {
            Rule::Kinematic => kinematic::respond(self, step, committed, trial),
            Rule::Iwan => iwan::respond(self, step, committed, trial),
            Rule::Isotropic => isotropic::respond(self, step, committed, trial),
            Rule::Takeda => reloading::respond(self, &takeda::Takeda, step, committed, trial),
            Rule::Pivot => {
                reloading::respond(self, &pivot::Pivot::of(self), step, committed, trial)
            }
        };
        (out.f[0], out.k[0]) = (answer.f, answer.k);
        out.energy.stored = answer.stored;
        out.energy.hysteretic = answer.heat.max(0.0);
    }
}

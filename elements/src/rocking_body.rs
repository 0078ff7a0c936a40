//! RockingBody: a rigid body that stands on the ground by its base points, in finite rotation.
//!
//! ```text
//!        n ↖                 x(t)  = u(t) + R(t) rᵢ          where base point i is
//!     ┌────┐╲                dᵢ    = u + R rᵢ − rᵢ           its displacement
//!     │ cg ● ╲               vᵢ    = u̇ + R (Ω × rᵢ)
//!     │   rᵢ╲ ╲              fᵢ    = contact law (dᵢ, vᵢ)    gap, friction and dashpot of an NLink
//!     └──────╲ ╲             F     = Σ fᵢ                    force on the node, global axes
//!   ══════════●══════        M     = Σ rᵢ × Rᵀ fᵢ + Ω × J Ω  moment, axes of the body
//! ```
//!
//! | parameter     | symbol | unit  | range | default | meaning                                            |
//! |---------------|--------|-------|-------|---------|----------------------------------------------------|
//! | `base`        | rᵢ     | m     |       | –       | base points, from the centre of gravity, body upright |
//! | `kn`          | kₙ     | N/m   | > 0   | –       | contact stiffness of each point                    |
//! | `damping`     | c      | N·s/m | ≥ 0   | 0       | contact dashpot of each point, acts only while closed |
//! | `pull`        |        |       |       | false   | the dashpot may pull while the point is closed     |
//! | `mu`          | μ      | 1     | ≥ 0   | 0       | friction coefficient                               |
//! | `ks`          | kₛ     | N/m   | > 0   | –       | pre-slip stiffness of each point; required with friction |
//! | `inertia`     | J      | kg·m² | ≥ 0   | –       | moments of inertia about the body's axes X, Y, Z; required where it can rock in space |
//! | `overturned`  |        | rad   | > 0   | π/2     | tilt at which the body counts as overturned        |
//!
//! The node is the **centre of gravity**; its `Mass` holds mass and moments of inertia, without eccentricity.
//! Its translations are those of the body. Its rotations are the integrals of the angular velocity Ω in
//! the axes of the body; for motion in a plane that is the angle itself, however large. With them the
//! equations of motion, m ü = ΣF and J Ω̇ + Ω × J Ω = ΣM, keep a constant mass matrix, and gravity stays a
//! constant force: everything that changes with the geometry is in this law. So the restoring moment
//! falls with the tilt and the body overturns, under every solver, FNA included.
//!
//! The ground is the horizontal plane through the lowest base points. Points above it are contacts as
//! well: with all corners of a block it falls onto its side. The run ends when the tilt of the body's
//! vertical axis reaches `overturned`.
//!
//! In a step the rotation is R₀ exp(θ − θ₀): exact in a plane and about a fixed axis, of second order
//! otherwise. Other elements at the node see its rotations as small; attach none that matter when it tilts.
//!
//! Reference: Euler's equations with exact rotations \[Simo & Vu-Quoc 1988\]; rocking \[Housner 1963\].

mod law;
mod rotation;
#[cfg(test)]
mod tests;

use crate::NLink;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_2;
use trilith_element::dimension::{DAMPING, INERTIA, NONE, STIFFNESS};
use trilith_element::{
    Card, Category, Default, Described, Exercise, Form, NodeCount, Parameter, ParameterError,
    Range, Stroke, Vector3,
};

/// A rigid body on base points, in finite rotation; the law is in `law.rs` beside this file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RockingBody {
    /// Base points rᵢ from the centre of gravity, body upright, m.
    pub base: Vec<Vector3>,
    /// Contact stiffness kₙ of each point, N/m.
    pub kn: f64,
    /// Contact dashpot c of each point, N·s/m.
    pub damping: f64,
    /// The dashpot may pull while the point is closed.
    pub pull: bool,
    /// Friction coefficient μ.
    pub mu: f64,
    /// Pre-slip stiffness kₛ of each point, N/m.
    pub ks: Option<f64>,
    /// Moments of inertia J about the body's axes, kg·m².
    pub inertia: Option<Vector3>,
    /// Tilt at which the body counts as overturned, rad.
    pub overturned: f64,
}

impl Described for RockingBody {
    const CARD: Card = Card {
        kind: "RockingBody",
        category: Category::Link,
        summary: "Rigid body standing on base points, in finite rotation: slides, rocks, overturns.",
        nodes: NodeCount::exactly(1),
        parameters: &[
            Parameter::new(
                "base",
                "rᵢ",
                Form::Points,
                Default::Required,
                "base points, from the centre of gravity, body upright",
            ),
            Parameter::required("kn", "kₙ", STIFFNESS, Range::Positive, "contact stiffness of each point"),
            Parameter::number(
                "damping",
                "c",
                DAMPING,
                Range::NonNegative,
                0.0,
                "contact dashpot of each point, acts only while closed",
            ),
            Parameter::flag("pull", false, "the dashpot may pull while the point is closed"),
            Parameter::number("mu", "μ", NONE, Range::NonNegative, 0.0, "friction coefficient"),
            Parameter::optional(
                "ks",
                "kₛ",
                STIFFNESS,
                Range::Positive,
                "pre-slip stiffness of each point; required with friction",
            ),
            Parameter::new(
                "inertia",
                "J",
                Form::Numbers { dimension: INERTIA, count: Some(3) },
                Default::Absent,
                "moments of inertia about X, Y, Z of the body, as in its `Mass`; required where it can rock in space",
            )
            .within(Range::NonNegative),
            Parameter::number(
                "overturned",
                "",
                NONE,
                Range::Positive,
                FRAC_PI_2,
                "tilt at which the body counts as overturned, rad",
            ),
        ],
        law: "dᵢ = u + R rᵢ − rᵢ, vᵢ = u̇ + R (Ω × rᵢ): base point i, R = R₀ exp(θ − θ₀)\n\
              fᵢ as NLink: gap kₙ with dashpot c, friction μ with pre-slip stiffness kₛ\n\
              F = Σ fᵢ (global axes), M = Σ rᵢ × Rᵀ fᵢ + Ω × J Ω (axes of the body)\n\
              overturned where the body's vertical axis tilts by `overturned`",
        source: "Euler's equations with exact rotations, Simo & Vu-Quoc 1988; Housner, Bull. Seism. Soc. Am. 53, 1963",
        example: r#""cask": RockingBody(node: "cg", base: [("-0.5 m", 0, "-1 m"), ("0.5 m", 0, "-1 m")], kn: "1e9 N/m", ks: "1e9 N/m", mu: 0.5)"#,
        exercise: Exercise {
            frequency: 0.5,
            strokes: &[
                Stroke::about(0.0, 0.0),
                Stroke::about(0.0, 0.0),
                Stroke::about(-1e-4, 0.0),
                Stroke::about(0.0, 0.0),
                Stroke::about(0.0, 2e-4),
                Stroke::about(0.0, 0.0),
            ],
        },
    };

    fn check(&self) -> Result<(), ParameterError> {
        let wrong = |name, message: String| Err(ParameterError::inconsistent(name, message));
        if self.base.len() < 2 {
            let given = self.base.len();
            return wrong(
                "base",
                format!("`base` has {given} points: a body stands on two at least"),
            );
        }
        let lowest = self.lowest();
        if lowest >= 0.0 {
            let message = format!(
                "the lowest base point is {lowest} m above the centre of gravity: base points are given from the centre of gravity, so their z is negative"
            );
            return wrong("base", message);
        }
        if self.mu > 0.0 && self.ks.is_none() {
            let message =
                "a body with friction needs the pre-slip stiffness `ks`, such as the value of `kn`";
            return wrong("ks", message.into());
        }
        if self.inertia.is_none() && !self.is_plane() {
            let message = "base points outside one vertical plane through the centre of gravity need `inertia`, the three moments that the node's `Mass` has: a body that rocks in space turns its axes";
            return wrong("inertia", message.into());
        }
        Ok(())
    }
}

impl RockingBody {
    /// Height of the ground above the centre of gravity (negative), m.
    fn lowest(&self) -> f64 {
        self.base.iter().map(|r| r[2]).fold(f64::INFINITY, f64::min)
    }

    /// True where all base points are in a vertical plane through the centre of gravity along X or Y.
    fn is_plane(&self) -> bool {
        let size = self.base.iter().flatten().fold(0.0f64, |a, x| a.max(x.abs()));
        (0..2).any(|i| self.base.iter().all(|r| r[i].abs() <= 1e-9 * size))
    }

    /// The contact of one base point, in the axes of a link on the ground: Z, X, Y.
    fn contact(&self, point: Vector3) -> NLink {
        NLink {
            opening: point[2] - self.lowest(),
            damping: self.damping,
            pull: self.pull,
            mu: Some(self.mu),
            ks: self.ks,
            ..NLink::new(self.kn)
        }
    }
}

//! RockingBody: a rigid body that stands on the ground or on a node by its base points, in finite rotation.
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
//! The (last) node is the **centre of gravity**; its `Mass` holds mass and moments of inertia, without eccentricity.
//! Its translations are those of the body. Its rotations are the integrals of the angular velocity Ω in
//! the axes of the body; for motion in a plane that is the angle itself, however large. With them the
//! equations of motion, m ü = ΣF and J Ω̇ + Ω × J Ω = ΣM, keep a constant mass matrix, and gravity stays a
//! constant force: everything that changes with the geometry is in this law. So the restoring moment
//! falls with the tilt and the body overturns, under every solver, FNA included.
//!
//! With **two nodes**, `nodes: [support, body]`, it stands on the first: a floor, a pad, a shaking table, or another body's
//! centre of gravity. The plane through the lowest base points then moves and turns with that node, as a rigid body and
//! finitely, and has no edge (see `BodyContact` for a face with edges); forces act on both nodes at one place, see
//! `two_bodies.rs` in `shared/`.
//!
//! The ground is the horizontal plane through the lowest base points. Points above it are contacts as
//! well: with all corners of a block it falls onto its side. The run ends when the tilt of the body's
//! vertical axis reaches `overturned`.
//!
//! A **circular base** rolls on its rim: see `rim.rs` beside this file. Its dashpots may pull (`pull: true`).
//! A tilted rim that turns about the vertical drills on the arc that is pressed: friction resists with μ N times the
//! mean distance of the arc from its centre (see `drilling.rs`). A point would not resist, so this moment is as
//! much a matter of the stiffness as the arc is: it falls with k^(−1/3), by 2.15 for ten times the stiffness.
//! `arc_stiffness` gives the arc that of the real edge where `kn` is chosen for the computation; a very large one makes the
//! contact a point. Slip and drilling have their limits each for itself: a rim that slips at the same time resists drilling less in
//! truth.
//!
//! In a step the rotation is R₀ exp(θ − θ₀): exact in a plane and about a fixed axis, of second order
//! otherwise. Other elements at the node see its rotations as small; attach none that matter when it tilts.
//!
//! Reference: Euler's equations with exact rotations \[Simo & Vu-Quoc 1988\]; rocking \[Housner 1963\].

mod drilling;
mod lanes;
mod law;
mod moment;
mod outline;
mod rim;
#[cfg(test)]
mod tests;

use crate::NLink;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_2;
use trilith_element::{
    Card, Category, Described, Exercise, NodeCount, ParameterError, Parameters, Stroke, Vector3,
};

/// A rigid body on base points, in finite rotation; the law is in `law.rs` beside this file.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct RockingBody {
    /// base points, from the centre of gravity, body upright
    #[parameter("rᵢ", form = Points)]
    #[serde(default)]
    pub base: Vec<Vector3>,
    /// instead of `base`: radius of a circular base
    #[parameter("ρ", unit = "m", range = Positive)]
    pub rim_radius: Option<f64>,
    /// depth of the circular base below the centre of gravity
    #[parameter("h", unit = "m", range = Positive)]
    pub rim_depth: Option<f64>,
    /// contact stiffness of each point, or of the whole rim
    #[parameter("kₙ", unit = "N/m", range = Positive)]
    pub kn: f64,
    /// contact dashpot of each point or the whole rim, acts only where closed
    #[parameter("c", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub damping: f64,
    /// the dashpot may pull while the point is closed
    #[parameter]
    pub pull: bool,
    /// friction coefficient
    #[parameter("μ", unit = "1", range = NonNegative, default = 0.0)]
    pub mu: f64,
    /// pre-slip stiffness of each point or the rim; required with friction
    #[parameter("kₛ", unit = "N/m", range = Positive)]
    pub ks: Option<f64>,
    /// stiffness of the whole rim that the arc of drilling friction follows from; none: `kn`
    #[parameter("k_a", unit = "N/m", range = Positive)]
    pub arc_stiffness: Option<f64>,
    /// moments of inertia about X, Y, Z of the body, as in its `Mass`; required where it can rock in space
    #[parameter("J", unit = "kg·m²", range = NonNegative)]
    pub inertia: Option<Vector3>,
    /// tilt at which the body counts as overturned, rad
    #[parameter(unit = "rad", range = Positive, default = FRAC_PI_2)]
    pub overturned: f64,
    /// From the node that it stands on to its centre of gravity, at rest, m; none: it stands on the ground.
    #[serde(skip)]
    pub above: Option<Vector3>,
}

impl Described for RockingBody {
    const CARD: Card = Card::new(
        "RockingBody",
        Category::Link,
        "Rigid body standing on the ground or a node by base points or a rim, in finite rotation: slides, rocks, rolls, overturns.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("dᵢ = u + R rᵢ − rᵢ, vᵢ = u̇ + R (Ω × rᵢ): base point i, R = R₀ exp(θ − θ₀)\n\
          rim: penetration δ(ψ) = a + b cos ψ, springs kₙ/2π and dashpots c/2π along it, friction at the centre of pressure\n\
          drilling of a rim: at most μ N m ρ, mρ: mean distance of what presses from its centre; a tilted rim presses on an arc: m = 3/8 ψ꜀, ψ꜀ = (3π N/(k_a ρ sin tilt))^⅓, which goes to 0 as k_a grows\n\
          fᵢ as NLink: gap kₙ with dashpot c, friction μ with pre-slip stiffness kₛ\n\
          F = Σ fᵢ (global axes), M = Σ rᵢ × Rᵀ fᵢ + Ω × J Ω (axes of the body)\n\
          two nodes: the same law of the body as the first node, its support, sees it; −F and its moment on the support\n\
          overturned where the body's vertical axis tilts by `overturned`")
    .source("Euler's equations with exact rotations, Simo & Vu-Quoc 1988; Housner, Bull. Seism. Soc. Am. 53, 1963")
    .example(r#""cask": RockingBody(node: "cg", base: [("-0.5 m", 0, "-1 m"), ("0.5 m", 0, "-1 m")], kn: "1e9 N/m", ks: "1e9 N/m", mu: 0.5)"#)
    .exercise(Exercise::new(0.5, &[
            Stroke::about(0.0, 0.0),
            Stroke::about(0.0, 0.0),
            Stroke::about(-1e-4, 0.0),
            Stroke::about(0.0, 0.0),
            Stroke::about(0.0, 2e-4),
            Stroke::about(0.0, 0.0),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        let wrong = |name, message: String| Err(ParameterError::inconsistent(name, message));
        if self.mu > 0.0 && self.ks.is_none() {
            let message =
                "a body with friction needs the pre-slip stiffness `ks`, such as the value of `kn`";
            return wrong("ks", message.into());
        }
        if self.rim_radius.is_some() || self.rim_depth.is_some() {
            return self.check_rim();
        }
        if self.arc_stiffness.is_some() {
            let message = "`arc_stiffness` belongs to a rim: give `rim_radius` and `rim_depth`";
            return wrong("arc_stiffness", message.into());
        }
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
        if self.inertia.is_none() && !self.is_plane() {
            let message = "base points outside one vertical plane through the centre of gravity need `inertia`, the three moments that the node's `Mass` has: a body that rocks in space turns its axes";
            return wrong("inertia", message.into());
        }
        Ok(())
    }
}

impl RockingBody {
    fn check_rim(&self) -> Result<(), ParameterError> {
        let (name, message) = if self.rim_radius.is_none() || self.rim_depth.is_none() {
            ("rim_radius", "`rim_radius` and `rim_depth` go together: give both, or `base`")
        } else if !self.base.is_empty() {
            (
                "base",
                "a body has base points or a rim: give `base`, or `rim_radius` and `rim_depth`",
            )
        } else if self.inertia.is_none() {
            (
                "inertia",
                "a body on a rim needs `inertia`, the three moments that the node's `Mass` has: it turns its axes as it rolls",
            )
        } else if self.damping > 0.0 && !self.pull {
            ("pull", "the dashpots of a rim may pull: add `pull: true`, or leave `damping` out")
        } else {
            return Ok(());
        };
        Err(ParameterError::inconsistent(name, message))
    }

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

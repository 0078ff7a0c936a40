//! BodyContact: two bodies in finite rotation touch, press, slide and part.
//!
//! ```text
//!    points on a face                          round bodies side by side
//!        ┌───────┐                                 ___        ___
//!        │ ● 2   │  points of the second          /   \ gap  /   \
//!        └•─────•┘                               │ ● 1 │<-->│ ● 2 │   ● axis: the body's own Z
//!    ━━━━━━━▲━━━━━━━  face of the first, its      \___/      \___/
//!        ● 1  normal  middle and half widths        r₁         r₂
//! ```
//!
//! Nodes are `[first, second]`, mostly the centres of gravity of two bodies; either may be a node of a structure. Rotations
//! of both are those of a [`RockingBody`](crate::RockingBody): integrals of the angular velocity in the body's own
//! axes. Forces are opposite and act at one place, so that both bodies together keep momentum and moment of momentum.
//! Where a body flies or rolls freely in space its gyroscopic moment Ω × J Ω is a matter of its `RockingBody`.
//!
//! **Points on a face**: every point is a contact with friction, as under a `RockingBody`. The face moves and turns with the
//! first body. Its axes are those of a link along `normal`: the second leans up, or along X where the normal is
//! vertical. With `extent` it ends: a point that comes from beside passes it, and one that slips over the edge is held by
//! nothing until it has been in front again; what its spring held is lost as heat. For two boxes side by side give two
//! links, corners of each on a face of the other.
//!
//! **Round bodies**: gap = distance of the second's axis, at each height, from the first's axis, less both radii. The first
//! has no end along its axis. The edge of the second is taken as round along its axis as well, so that an angle ϑ
//! between the axes moves the touch by r₂ (1 − cos ϑ) at most. Friction follows the way of the material that is there:
//! one rolls on the other without slip. For what touches at the height of the first give a second link, nodes exchanged.
//!
//! The history variable `gap` is the smallest distance of all points or heights from what they touch: its smallest
//! value over a run is the closest approach.
//!
//! Reference: relative motion of rigid bodies, \[Goldstein, Classical Mechanics, ch. 4\]; contact as in
//! [`NLink`].

mod law;
mod round;
#[cfg(test)]
mod tests;

use crate::NLink;
use crate::shared::plane_contact::{Edge, Foot, Plane};
use nalgebra::Matrix3;
use serde::Deserialize;
use trilith_element::{
    Card, Category, Described, Exercise, Frame, NodeCount, ParameterError, Parameters, Stroke,
    Vector3, dot, sub,
};

/// Two bodies that touch; the law is in `law.rs` beside this file.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct BodyContact {
    /// points of the second body, from its node, at rest
    #[parameter("rᵢ", form = Points)]
    #[serde(default)]
    pub points: Vec<Vector3>,
    /// a point of the first body's face (its middle), from its node
    #[parameter("a", unit = "m")]
    pub face: Option<Vector3>,
    /// direction out of the face; none: upwards, (0, 0, 1)
    #[parameter("n", unit = "1")]
    pub normal: Option<Vector3>,
    /// half widths of the face along its two axes; none: it has no edge
    #[parameter(unit = "m", range = Positive)]
    pub extent: Option<[f64; 2]>,
    /// instead of points and face: radii of the first and of the second body
    #[parameter("r", unit = "m", range = Positive)]
    pub radii: Option<[f64; 2]>,
    /// where the second round body touches, from its node along its axis
    #[parameter("z", unit = "m")]
    #[serde(default)]
    pub heights: Vec<f64>,
    /// contact stiffness of each point or height
    #[parameter("kₙ", unit = "N/m", range = Positive)]
    pub kn: f64,
    /// contact dashpot of each point or height, acts only where closed
    #[parameter("c", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub damping: f64,
    /// the dashpot may pull while closed
    #[parameter]
    pub pull: bool,
    /// friction coefficient
    #[parameter("μ", unit = "1", range = NonNegative, default = 0.0)]
    pub mu: f64,
    /// pre-slip stiffness of each point or height; required with friction
    #[parameter("kₛ", unit = "N/m", range = Positive)]
    pub ks: Option<f64>,
    /// From the first node to the second at rest, m.
    #[serde(skip)]
    pub offset: Vector3,
}

impl Described for BodyContact {
    const CARD: Card = Card::new(
        "BodyContact",
        Category::Link,
        "Contact of two bodies in finite rotation: points on a face, or round bodies side by side.",
    )
    .nodes(NodeCount::exactly(2))
    .parameters(Self::PARAMETERS)
    .law("s = R₁ᵀ (X + u₂ − u₁), R = R₁ᵀ R₂: the second body as the first sees it\n\
          points: gapᵢ = n·(s + R rᵢ − a), friction in the face\n\
          round: gap = |(s + R z e₃)₁₂| − r₁ − r₂, friction across and along the axis\n\
          forces as NLink: gap kₙ with dashpot c, friction μ with pre-slip stiffness kₛ\n\
          F₂ = R₁ f, M₂ = m (axes of the second); F₁ = −R₁ f, M₁ = −s × f − R m (axes of the first)")
    .source("relative motion of rigid bodies, Goldstein, Classical Mechanics, ch. 4")
    .example(r#""casks": BodyContact(nodes: ("cask 1", "cask 2"), radii: ("0.49 m", "0.49 m"), heights: ("-0.8 m", "0.8 m"), kn: "1e8 N/m", ks: "1e8 N/m", mu: 0.2)"#)
    .exercise(Exercise::new(0.5, &[
            Stroke::about(0.0, 0.0),
            Stroke::about(0.0, 0.0),
            Stroke::about(0.0, 0.0),
            Stroke::about(0.0, 0.0),
            Stroke::about(0.0, 0.0),
            Stroke::about(0.0, 0.0),
            Stroke::about(-0.022, 0.004),
            Stroke::about(0.0, 1e-3),
            Stroke::about(0.0, 0.0),
            Stroke::about(0.0, 0.0),
            Stroke::about(0.0, 1e-4),
            Stroke::about(0.0, 0.0),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        let (name, message) = if self.mu > 0.0 && self.ks.is_none() {
            (
                "ks",
                "contact with friction needs the pre-slip stiffness `ks`, such as the value of `kn`",
            )
        } else if self.radii.is_some() {
            if self.heights.is_empty() {
                (
                    "heights",
                    "round bodies touch at `heights`: give at least one, from the second's node",
                )
            } else if !self.points.is_empty() || self.face.is_some() || self.normal.is_some() {
                (
                    "points",
                    "bodies are round or touch by points on a face: give `radii` and `heights`, or `points` and `face`",
                )
            } else if self.extent.is_some() {
                ("extent", "`extent` belongs to a face: give `points` and `face`")
            } else {
                return Ok(());
            }
        } else if !self.heights.is_empty() {
            ("heights", "`heights` belong to round bodies: give their `radii`")
        } else if self.points.is_empty() {
            ("points", "give `points` and the `face` they touch, or `radii` and `heights`")
        } else if self.face.is_none() {
            ("face", "points touch a face: give a point of it, `face: (x, y, z)`")
        } else if self.normal.is_some_and(|n| n == [0.0; 3]) {
            ("normal", "the direction out of the face must not be zero")
        } else {
            return Ok(());
        };
        Err(ParameterError::inconsistent(name, message))
    }
}

impl BodyContact {
    /// Normal and axes of the face as rows; those of a face that looks up where the normal is no direction.
    fn frame(&self) -> Frame {
        let upwards = [0.0, 0.0, 1.0];
        let of = |normal| Frame::of_nodes(&[], Some(normal), None);
        of(self.normal.unwrap_or(upwards)).unwrap_or(Frame([
            upwards,
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
        ]))
    }

    fn plane(&self) -> Plane {
        let [n, x, y] = self.frame().0;
        Plane(Matrix3::from_row_slice(&[n, x, y].concat()))
    }

    /// From the middle of the face to a point of the second body at rest, m.
    fn seen_from_face(&self, point: Vector3) -> Vector3 {
        let face = self.face.unwrap_or_default();
        [0, 1, 2].map(|i| self.offset[i] + point[i] - face[i])
    }

    /// The points of the second body.
    fn feet(&self) -> impl Iterator<Item = Foot> {
        let frame = self.frame();
        self.points.iter().map(move |r| {
            let [opening, x, y] = frame.to_local(self.seen_from_face(*r));
            let edge = self.extent.map(|half| Edge { half, from: [x, y] });
            Foot { r: (*r).into(), contact: self.contact(opening), edge }
        })
    }

    fn contact(&self, opening: f64) -> NLink {
        NLink {
            opening,
            damping: self.damping,
            pull: self.pull,
            mu: Some(self.mu),
            ks: self.ks,
            ..NLink::new(self.kn)
        }
    }

    /// It begins with its bodies apart or touching.
    fn check_place(&self) -> Result<(), ParameterError> {
        // What is rounding of sums of such lengths.
        let rounding = |lengths: &[f64]| 1e-12 * lengths.iter().map(|x| x.abs()).sum::<f64>();
        let wrong = |name, message: String| Err(ParameterError::inconsistent(name, message));
        let shown = |length: f64| (1e12 * length).round() / 1e12;
        if let Some([r1, r2]) = self.radii {
            let apart = self.offset[0].hypot(self.offset[1]);
            if apart < r1 + r2 - rounding(&[r1, r2, apart]) || apart == 0.0 {
                let message = format!(
                    "the axes of the bodies are {} m apart and their `radii` add up to {} m: they begin inside each other",
                    shown(apart),
                    shown(r1 + r2)
                );
                return wrong("radii", message);
            }
        }
        let n = self.frame().0[0];
        for (i, point) in self.points.iter().enumerate() {
            let depth = -dot(n, self.seen_from_face(*point));
            let beside = self.extent.is_some_and(|half| {
                let [_, x, y] = self.frame().to_local(self.seen_from_face(*point));
                x.abs() > half[0] || y.abs() > half[1]
            });
            let lengths = [self.offset, *point, self.face.unwrap_or_default()].concat();
            if depth > rounding(&lengths) && !beside {
                let message = format!(
                    "point {} begins {} m behind the face: points are given from the second node, the face from the first",
                    i + 1,
                    shown(depth)
                );
                return wrong("points", message);
            }
        }
        Ok(())
    }

    /// Takes note of both nodes.
    fn set_places(&mut self, nodes: &[Vector3]) -> Result<(), ParameterError> {
        if let [first, second] = nodes {
            self.offset = sub(*second, *first);
        }
        self.check_place()
    }
}

//! The body and its feet, read off the equations.

use super::CalibrationError;
use crate::{Error, Model};
use trilith_element::Vector3;
use trilith_system::{ImpactMass, System};

/// The horizontal direction of the vertical plane in which the body moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Horizontal {
    /// X; rocking turns about Y.
    X,
    /// Y; rocking turns about X.
    Y,
}

impl Horizontal {
    /// Name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::X => "X",
            Self::Y => "Y",
        }
    }

    /// Index of the direction, and of the rotation in that plane with the sign that lifts its far end.
    pub(super) fn directions(self) -> (usize, usize, f64) {
        match self {
            Self::X => (0, 4, -1.0),
            Self::Y => (1, 3, 1.0),
        }
    }
}

/// A foot: a contact that carries the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Foot {
    /// Name of the link.
    pub name: String,
    /// Index of the link among the model's elements.
    pub element: usize,
    /// Position along the horizontal direction, m.
    pub x: f64,
    /// Height, m.
    pub z: f64,
    /// Clearance at rest, m.
    pub opening: f64,
    /// Contact stiffness, N/m.
    pub stiffness: f64,
    /// Contact dashpot, N·s/m.
    pub damping: f64,
    /// Mass that it stops in a flat drop, or as the model says, kg.
    pub mass: f64,
    /// Mass that it stops when it is struck alone, as in rocking, kg.
    pub alone: f64,
}

/// A body that stands free on feet.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The horizontal direction in which it moves.
    pub horizontal: Horizontal,
    /// Mass, kg.
    pub mass: f64,
    /// Centre of gravity along the horizontal direction, m.
    pub x: f64,
    /// Height of the centre of gravity, m.
    pub z: f64,
    /// Moment of inertia about the centre of gravity, kg·m².
    pub inertia: f64,
    /// Acceleration of gravity, m/s².
    pub gravity: f64,
    /// The feet, in the order of the model.
    pub feet: Vec<Foot>,
    /// True where all feet can be struck at once.
    pub flat: bool,
}

/// A rigid displacement: a lift, and a rotation about a point of the plane that lifts what is beyond it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pose {
    pub lift: f64,
    pub rotation: f64,
    pub about: [f64; 2],
}

impl Pose {
    /// Displacement of a node at a position in one of its six directions.
    pub fn at(self, horizontal: Horizontal, position: Vector3, direction: usize) -> f64 {
        let (along, turn, sign) = horizontal.directions();
        if direction == along {
            -self.rotation * (position[2] - self.about[1])
        } else if direction == 2 {
            self.lift + self.rotation * (position[along] - self.about[0])
        } else if direction == turn {
            sign * self.rotation
        } else {
            0.0
        }
    }
}

impl Body {
    pub(super) fn new(
        model: &Model,
        system: &System,
        horizontal: Horizontal,
    ) -> Result<Self, Error> {
        if !system.inner.is_empty() {
            return Err(CalibrationError::InnerRows.into());
        }
        let field = |pose: Pose| -> Vec<f64> {
            let at = |full: &usize| pose.at(horizontal, model.nodes[full / 6].position, full % 6);
            system.reduction.free.iter().map(at).collect()
        };
        let lift = field(Pose { lift: 1.0, ..Pose::default() });
        let turn = field(Pose { rotation: 1.0, ..Pose::default() });
        for (u, motion) in [(&lift, "a vertical lift"), (&turn, "rocking")] {
            if is_held(system, u) {
                return Err(CalibrationError::Held { motion }.into());
            }
        }
        let along = horizontal.directions().0;
        let contacts = system.impact_masses(model)?;
        let row = |c: &ImpactMass, u: &[f64]| -> f64 {
            let flat = system.links.links[c.link].range.start + c.impact.coordinate;
            system.links.rows[flat].iter().map(|(j, b)| b * u[*j]).sum()
        };
        // A foot opens as the body is lifted, by as much.
        let feet: Vec<&ImpactMass> =
            contacts.iter().filter(|c| (row(c, &lift) - 1.0).abs() < 1e-9).collect();
        if feet.is_empty() {
            return Err(CalibrationError::NoFeet.into());
        }
        let flat = feet.iter().all(|c| c.together.is_some());
        let feet: Vec<Foot> = feet
            .into_iter()
            .map(|c| {
                let link = &system.links.links[c.link];
                let element = &model.elements[link.element];
                let position = element.nodes.last().map_or([0.0; 3], |n| model.nodes[*n].position);
                let waits = c.impact.restitution.is_some();
                let law = system.links.law(model, link);
                let settled = law.and_then(|l| l.impact()).filter(|_| waits);
                Foot {
                    name: element.name.clone(),
                    element: link.element,
                    x: position[along],
                    z: position[2],
                    opening: opening(system, model, c),
                    stiffness: c.impact.stiffness,
                    damping: settled.map_or(c.impact.damping, |i| i.damping),
                    mass: c.mass(),
                    alone: c.alone,
                }
            })
            .collect();
        let mass = system.mass.bilinear(&lift, &lift);
        let x = system.mass.bilinear(&lift, &turn) / mass;
        let pushed = &system.inertia[along];
        let z = -pushed.iter().zip(&turn).map(|(p, u)| p * u).sum::<f64>() / mass;
        let inertia = system.mass.bilinear(&turn, &turn) - mass * (x * x + z * z);
        Ok(Self { horizontal, mass, x, z, inertia, gravity: model.gravity, feet, flat })
    }

    /// The outer feet: indices of those at the smaller and at the larger end.
    pub(super) fn ends(&self) -> Result<[Vec<usize>; 2], CalibrationError> {
        let xs = || self.feet.iter().map(|f| f.x);
        let (from, to) =
            (xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max));
        let near = 1e-6 * (to - from);
        if to - from < 1e-9 * (1.0 + to.abs()) {
            return Err(CalibrationError::OneFoot { along: self.horizontal.name() });
        }
        if self.x <= from || self.x >= to {
            return Err(CalibrationError::Falls { center: self.x, from, to });
        }
        let at = |x: f64| {
            (0..self.feet.len()).filter(|i| (self.feet[*i].x - x).abs() <= near).collect::<Vec<_>>()
        };
        Ok([at(from), at(to)])
    }
}

/// True where a rigid motion meets stiffness of the structure, links apart.
fn is_held(system: &System, u: &[f64]) -> bool {
    let resisting = system.stiffness.bilinear(u, u);
    let scale: f64 =
        system.stiffness.entries().map(|(i, j, k)| (k * u[i] * u[j]).abs()).sum::<f64>();
    resisting.abs() > 1e-9 * scale
}

fn opening(system: &System, model: &Model, contact: &ImpactMass) -> f64 {
    let link = &system.links.links[contact.link];
    let n = link.range.len();
    let zeros = vec![0.0; n];
    let at = trilith_element::Kinematics::still(&zeros, &zeros);
    let mut history = vec![0.0; link.history.len()];
    let law = system.links.law(model, link);
    law.and_then(|l| {
        l.at_rest(&mut history);
        let mut contacts = Vec::new();
        l.contacts(&at, &history, &zeros, &mut contacts);
        contacts.first().map(|c| c.gap)
    })
    .unwrap_or(0.0)
}

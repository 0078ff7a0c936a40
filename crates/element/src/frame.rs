//! Directions, local frames and the geometry of an element.

use crate::ParameterError;

/// A point or vector in space, m.
pub type Vector3 = [f64; 3];

/// A global degree of freedom of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Dof {
    /// Displacement along X.
    Ux,
    /// Displacement along Y.
    Uy,
    /// Displacement along Z.
    Uz,
    /// Rotation about X.
    Rx,
    /// Rotation about Y.
    Ry,
    /// Rotation about Z.
    Rz,
}

impl Dof {
    /// All six, in order.
    pub const ALL: [Self; 6] = [Self::Ux, Self::Uy, Self::Uz, Self::Rx, Self::Ry, Self::Rz];

    /// Position 0 … 5.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    /// Name in model files.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"][self.index()]
    }

    /// True for Rx, Ry, Rz.
    #[must_use]
    pub fn is_rotation(self) -> bool {
        self.index() > 2
    }
}

/// A local axis of a link: U1 along it, U2 and U3 across it, R1 … R3 the rotations about them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Deserialize)]
pub enum Axis {
    /// Axial deformation; positive is extension.
    U1,
    /// Shear along local 2.
    U2,
    /// Shear along local 3.
    U3,
    /// Torsion.
    R1,
    /// Bending about local 2.
    R2,
    /// Bending about local 3.
    R3,
}

impl Axis {
    /// All six, in order.
    pub const ALL: [Self; 6] = [Self::U1, Self::U2, Self::U3, Self::R1, Self::R2, Self::R3];
    /// The names, as a card needs them.
    pub const NAMES: &'static [&'static str] = &["U1", "U2", "U3", "R1", "R2", "R3"];

    /// Position 0 … 5.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    /// Name in model files.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES[self.index()]
    }
}

/// Three orthonormal local axes: row `i` holds local axis `i + 1` in global components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame(pub [Vector3; 3]);

impl Frame {
    /// The local frame of an element from i to j.
    ///
    /// Local 1 runs from i to j, or along +Z where there is no j or the nodes coincide, unless `axis1`
    /// says otherwise. Local 2 is in the plane of local 1 and +Z, pointing upwards; for a vertical
    /// local 1 it is +X. `axis2`, where given, replaces +Z (or +X) as the direction that local 2 leans
    /// to. Local 3 = 1 × 2. (The convention of SAP2000.)
    ///
    /// # Errors
    /// [`ParameterError::Geometry`] for a zero or parallel direction.
    pub fn of_nodes(
        nodes: &[Vector3],
        axis1: Option<Vector3>,
        axis2: Option<Vector3>,
    ) -> Result<Self, ParameterError> {
        let span = match nodes {
            [i, j] => sub(*j, *i),
            _ => [0.0; 3],
        };
        let first = match axis1 {
            Some(a) => unit(a).ok_or_else(|| {
                ParameterError::geometry("the direction of local axis 1 must not be zero")
            })?,
            None => unit(span).unwrap_or([0.0, 0.0, 1.0]),
        };
        let vertical = first[0].hypot(first[1]) < 1e-3;
        let lean = axis2.unwrap_or(if vertical { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] });
        let across = sub(lean, scale(first, dot(lean, first)));
        if norm(across) < 1e-6 * norm(lean) {
            return Err(ParameterError::geometry(
                "the direction of local axis 2 must not be zero nor parallel to local axis 1",
            ));
        }
        let second = unit(across)
            .ok_or_else(|| ParameterError::geometry("the direction of local axis 2 is zero"))?;
        Ok(Self([first, second, cross(first, second)]))
    }

    /// A global vector in local components.
    #[must_use]
    pub fn to_local(&self, v: Vector3) -> Vector3 {
        [dot(self.0[0], v), dot(self.0[1], v), dot(self.0[2], v)]
    }
}

/// Where an element stands.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Geometry<'a> {
    /// Positions of its nodes, m.
    pub nodes: &'a [Vector3],
    /// Its local frame.
    pub frame: Frame,
    /// Axial force that it carries while it is analysed, N, tension positive; 0 without P-Δ. An element
    /// with a geometric stiffness adds it.
    pub tension: f64,
}

impl<'a> Geometry<'a> {
    /// Nodes in their places, and a local frame; no axial force.
    #[must_use]
    pub const fn new(nodes: &'a [Vector3], frame: Frame) -> Self {
        Self { nodes, frame, tension: 0.0 }
    }

    /// With an axial force, N, tension positive.
    #[must_use]
    pub const fn with_tension(mut self, tension: f64) -> Self {
        self.tension = tension;
        self
    }

    /// Distance of the first two nodes, m; 0 for one node.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self.nodes {
            [i, j, ..] => norm(sub(*j, *i)),
            _ => 0.0,
        }
    }
}

/// `a − b`.
#[must_use]
pub fn sub(a: Vector3, b: Vector3) -> Vector3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
/// `a · b`.
#[must_use]
pub fn dot(a: Vector3, b: Vector3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
/// `a × b`.
#[must_use]
pub fn cross(a: Vector3, b: Vector3) -> Vector3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
/// `|a|`.
#[must_use]
pub fn norm(a: Vector3) -> f64 {
    dot(a, a).sqrt()
}
fn scale(a: Vector3, s: f64) -> Vector3 {
    a.map(|x| x * s)
}
fn unit(a: Vector3) -> Option<Vector3> {
    let n = norm(a);
    (n > 0.0).then(|| scale(a, 1.0 / n))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grounded_link_stands_upright_with_local_2_along_x() {
        let frame = Frame::of_nodes(&[[1.0, 2.0, 3.0]], None, None).unwrap();
        assert_eq!(frame.0, [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    }

    #[test]
    fn a_horizontal_link_has_local_2_upwards() {
        let frame = Frame::of_nodes(&[[0.0; 3], [2.0, 0.0, 0.0]], None, None).unwrap();
        assert_eq!(frame.0, [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]);
    }

    #[test]
    fn a_parallel_second_axis_is_refused() {
        let parallel = Some([0.0, 0.0, 2.0]);
        assert!(Frame::of_nodes(&[[0.0; 3]], None, parallel).is_err());
    }
}

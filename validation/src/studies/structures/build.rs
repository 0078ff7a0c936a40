//! What the structures are written with.

use crate::oracle::spec::{Beam, Kind, Law, Member, Output, Spec, V3};

/// Held in no direction.
pub(super) const FREE: [bool; 6] = [false; 6];
/// Held in all.
pub(super) const HELD: [bool; 6] = [true; 6];
/// Moves along X alone.
pub(super) const ALONG_X: [bool; 6] = [false, true, true, true, true, true];
/// Directions.
pub(super) const X: V3 = [1.0, 0.0, 0.0];
pub(super) const Y: V3 = [0.0, 1.0, 0.0];
pub(super) const Z: V3 = [0.0, 0.0, 1.0];
/// Directions of a node.
pub(super) const UX: usize = 0;
pub(super) const UZ: usize = 2;
pub(super) const RY: usize = 4;

/// A structure and what its outputs are called.
#[derive(Clone, Debug, Default)]
pub(super) struct Structure {
    /// What both sides are made from.
    pub spec: Spec,
    /// A name for every output.
    pub names: Vec<String>,
    /// Outputs with a figure.
    pub shown: Vec<usize>,
}

impl Structure {
    /// In the plane XZ.
    pub(super) fn plane() -> Self {
        Self { spec: Spec { plane: true, ..Spec::default() }, ..Self::default() }
    }

    /// Adds a node.
    pub(super) fn node(&mut self, at: V3, fixed: [bool; 6]) -> usize {
        self.spec.nodes.push(at);
        self.spec.fixed.push(fixed);
        self.spec.nodes.len() - 1
    }

    fn member(&mut self, nodes: &[usize], axis1: Option<V3>, kind: Kind) -> usize {
        self.spec.members.push(Member { nodes: nodes.to_vec(), axis1, kind });
        self.spec.members.len() - 1
    }

    /// Adds a member with its own axes.
    pub(super) fn add(&mut self, nodes: &[usize], kind: Kind) -> usize {
        self.member(nodes, None, kind)
    }

    /// Adds a member with its local axis 1 along a direction.
    pub(super) fn along(&mut self, nodes: &[usize], axis1: V3, kind: Kind) -> usize {
        self.member(nodes, Some(axis1), kind)
    }

    /// Adds a point mass.
    pub(super) fn mass(&mut self, node: usize, mass: f64) {
        self.add(&[node], Kind::Mass(mass, [0.0; 3]));
    }

    /// Records.
    pub(super) fn record(&mut self, name: impl Into<String>, output: Output) {
        self.names.push(name.into());
        self.spec.outputs.push(output);
    }

    /// Records with a figure.
    pub(super) fn show(&mut self, name: impl Into<String>, output: Output) {
        self.shown.push(self.names.len());
        self.record(name, output);
    }

    /// Records forces and deformations of a link on the local axes of its law that move.
    pub(super) fn record_link(&mut self, name: &str, link: usize) {
        let Kind::Link(law, axis) = &self.spec.members[link].kind else { return };
        let axes = law.axes(*axis);
        // Local 3 lies across the plane.
        let moving: Vec<usize> =
            axes.into_iter().filter(|a| !(self.spec.plane && *a == 2)).collect();
        for axis in moving {
            let n = axis + 1;
            self.record(format!("{name}: force {n}"), Output::LinkForce(link, axis));
            self.record(format!("{name}: deformation {n}"), Output::LinkDeformation(link, axis));
        }
    }
}

/// A link on a local axis, from 0.
pub(super) fn link(law: Law, axis: usize) -> Kind {
    Kind::Link(law, axis)
}

/// Springs and dashpots given as (axis, k, c).
pub(super) fn springs(of: &[(usize, f64, f64)]) -> Kind {
    let (mut k, mut c) = ([0.0; 6], [0.0; 6]);
    for (axis, stiff, dashpot) in of {
        (k[*axis], c[*axis]) = (*stiff, *dashpot);
    }
    Kind::Spring(k, c)
}

/// A rectangular section, without mass.
pub(super) fn rectangle(young: f64, width: f64, depth: f64) -> Beam {
    let (i3, i2) = (width * depth.powi(3) / 12.0, depth * width.powi(3) / 12.0);
    Beam {
        young,
        shear: young / 2.4,
        area: width * depth,
        i2,
        i3,
        torsion: 0.5 * (i2 + i3),
        kappa: 0.0,
        density: 0.0,
        consistent: false,
    }
}

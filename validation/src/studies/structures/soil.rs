//! Columns on footings without mass on soil springs with dashpots.

use super::build::{ALONG_X, FREE, RY, Structure, UX, UZ, X, Z, rectangle, springs};
use super::motion::{Along, first};
use crate::oracle::spec::{Kind, Law, Output};

/// Two columns: one whose footing slides on its soil, one whose footing rocks on it and lifts off.
pub(super) fn columns() -> Structure {
    let mut it = Structure::plane();
    let (k, mass) = (4e7, 2e5);
    // A joint between springs and a dashpot, without mass.
    let foot = it.node([0.0; 3], ALONG_X);
    let top = it.node([0.0, 0.0, 4.0], ALONG_X);
    it.mass(top, mass);
    let soil = it.along(&[foot], Z, springs(&[(1, 2e7, 4e6)]));
    // Along X from a point beside it, so that it is no lever.
    let column = it.along(&[foot, top], X, springs(&[(0, k, 0.0)]));
    it.show("footing", Output::Displacement(foot, UX));
    it.show("mass", Output::Displacement(top, UX));
    it.record("column: drift", Output::Drift(top, foot, UX));
    it.record("column: shear", Output::End(column, 1, UX));
    it.record("soil: force", Output::End(soil, 0, UX));
    it.record("mass: acceleration", Output::Acceleration(top, UX));
    it.record("mass: velocity", Output::Velocity(top, UX));

    let height: f64 = 4.0;
    let bar = {
        // 3 E I/h³ = k.
        let side = (12.0 * k * height.powi(3) / (3.0 * 3e10)).powf(0.25);
        rectangle(3e10, side, side)
    };
    let centre = it.node([20.0, 0.0, 0.0], FREE);
    let head = it.node([20.0, 0.0, height], FREE);
    it.mass(head, mass);
    let column = it.add(&[centre, head], Kind::Beam(bar));
    let soil = it.along(&[centre], Z, springs(&[(1, 2e7, 4e6), (5, 5e7, 2e6)]));
    let mut edges = Vec::new();
    for side in [-1.5, 1.5] {
        let edge = it.node([20.0 + side, 0.0, 0.0], FREE);
        it.add(&[centre, edge], Kind::RigidLink);
        // Soil pushes and does not pull.
        let bed = it.add(&[edge], Kind::Link(Law::Gap(3e8, 0.0), 0));
        it.along(&[edge], Z, springs(&[(0, 1e6, 5e5)]));
        edges.push((edge, bed));
    }
    it.show("rocking: mass", Output::Displacement(head, UX));
    it.record("rocking: footing", Output::Displacement(centre, UX));
    it.show("rocking: rotation", Output::Displacement(centre, RY));
    it.record("rocking: settlement", Output::Displacement(centre, UZ));
    it.record("rocking: shear", Output::End(column, 1, UX));
    it.record("rocking: moment", Output::End(column, 0, RY));
    it.record("rocking: soil force", Output::End(soil, 0, UX));
    it.record("rocking: soil moment", Output::End(soil, 0, RY));
    it.record("rocking: acceleration", Output::Acceleration(head, UX));
    for (i, (edge, bed)) in edges.into_iter().enumerate() {
        it.record(format!("edge {}", i + 1), Output::Displacement(edge, UZ));
        it.record_link(&format!("bed {}", i + 1), bed);
    }
    it.spec.gravity = true;
    it.spec.base = vec![(0, first(Along::X, 0.4))];
    (it.spec.duration, it.spec.dt) = (12.0, 0.01);
    it
}

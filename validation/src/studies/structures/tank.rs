//! A liquid tank of Housner's masses on friction pendulums.

use super::build::{FREE, RY, Structure, UX, UZ, X, link, springs};
use super::motion::{Along, second};
use crate::oracle::spec::{Kind, Law, Output, Pendulum};
use std::f64::consts::TAU;

/// Slab, tank and liquid: 400 t, 900 t that move with the wall at 5 Hz, 1100 t that slosh in 5 s.
pub(super) fn tank() -> Structure {
    let mut it = Structure::plane();
    let slab = it.node([0.0; 3], FREE);
    it.add(&[slab], Kind::Mass(4e5, [0.0, 6e6, 0.0]));
    let bearing = Pendulum { kn: 4e9, ks: 1e8, radius: 1.8, slow: 0.06, fast: 0.06, rate: 0.0 };
    let mut bearings = Vec::new();
    for x in [-6.0, 0.0, 6.0] {
        let under = it.node([x, 0.0, -0.5], FREE);
        it.add(&[slab, under], Kind::RigidLink);
        bearings.push(it.add(&[under], link(Law::Pendulum(bearing), 0)));
    }
    let liquid = [("impulsive", 9e5, 5.0, 0.02, 3.5), ("convective", 1.1e6, 0.2, 0.005, 5.5)];
    for (name, mass, frequency, ratio, height) in liquid {
        let arm = it.node([0.0, 0.0, height], FREE);
        it.add(&[slab, arm], Kind::RigidLink);
        let body = it.node([0.0, 0.0, height], [false, true, false, true, true, true]);
        it.mass(body, mass);
        // It moves up and down with the slab.
        it.add(&[arm, body], Kind::EqualDof(vec![UZ]));
        let w = TAU * frequency;
        let spring = springs(&[(0, mass * w * w, 2.0 * ratio * mass * w)]);
        let wall = it.along(&[arm, body], X, spring);
        it.show(format!("{name}: displacement"), Output::Displacement(body, UX));
        it.record(format!("{name}: against the slab"), Output::Drift(body, arm, UX));
        it.record(format!("{name}: force"), Output::End(wall, 1, UX));
        it.record(format!("{name}: acceleration"), Output::Acceleration(body, UX));
    }
    it.show("slab", Output::Displacement(slab, UX));
    it.record("slab: up", Output::Displacement(slab, UZ));
    it.record("slab: rotation", Output::Displacement(slab, RY));
    it.record("slab: acceleration", Output::Acceleration(slab, UX));
    for (i, bearing) in bearings.into_iter().enumerate() {
        it.record_link(&format!("isolator {}", i + 1), bearing);
    }
    it.spec.gravity = true;
    it.spec.base = vec![(0, second(Along::X, 0.5)), (2, second(Along::Z, 0.25))];
    (it.spec.duration, it.spec.dt) = (14.0, 0.01);
    it
}

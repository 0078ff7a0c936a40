//! The rigid block of `models/rigid_block.ron`: two contacts with friction, small rotations.

use super::build::{FREE, RY, Structure, UX, UZ, link};
use crate::oracle::spec::{Contact, Function, Kind, Law, Output};

/// The block under one sine of 5 Hz, with a coefficient of friction and an amplitude in g.
pub(super) fn block(mu: f64, ah: f64) -> Structure {
    let mut it = Structure::plane();
    let (width, height, mass) = (2.0, 4.0, 1e4);
    let cg = it.node([0.0, 0.0, 0.5 * height], FREE);
    let left = it.node([-0.5 * width, 0.0, 0.0], FREE);
    let right = it.node([0.5 * width, 0.0, 0.0], FREE);
    it.add(&[cg, left, right], Kind::RigidBody);
    let inertia = mass * (height * height + width * width) / 12.0;
    it.add(&[cg], Kind::Mass(mass, [0.0, inertia, 0.0]));
    let foot = Contact {
        kn: 5e8,
        opening: 0.0,
        c: 1.276_651_82e6,
        pull: true,
        slow: mu,
        fast: mu,
        rate: 0.0,
        ks: 5e8,
    };
    let feet = [left, right].map(|n| it.add(&[n], link(Law::Contact(foot), 0)));
    it.show("slide", Output::Displacement(left, UX));
    it.show("uplift left", Output::Displacement(left, UZ));
    it.show("uplift right", Output::Displacement(right, UZ));
    it.record("rotation", Output::Displacement(cg, RY));
    it.record("top of the block", Output::Displacement(cg, UX));
    it.record("velocity", Output::Velocity(cg, UX));
    for (name, foot) in ["foot left", "foot right"].into_iter().zip(feet) {
        it.record_link(name, foot);
    }
    it.spec.gravity = true;
    it.spec.base = vec![(0, Function::Sine(ah * 9.80665, 5.0, 1.0))];
    (it.spec.duration, it.spec.dt) = (2.0, 0.001);
    it
}

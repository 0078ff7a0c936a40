//! A missile on a cantilever, and a stop under its tip.

use super::build::{HELD, RY, Structure, UZ, Z, link, rectangle};
use crate::oracle::spec::{Beam, Contact, Damping, Kind, Law, Output};

/// Beams of the cantilever.
const PARTS: usize = 120;

/// 500 kg at 5 m/s on a cantilever of 6 m, two thirds out.
pub(super) fn missile() -> Structure {
    let mut it = Structure::plane();
    let beam = Beam { density: 7850.0, ..rectangle(2.1e11, 0.2, 0.3) };
    // It bends and does nothing else.
    let bends = [true, true, false, true, false, true];
    let mut nodes = vec![it.node([0.0; 3], HELD)];
    let mut bars = Vec::new();
    for i in 1..=PARTS {
        nodes.push(it.node([6.0 * i as f64 / PARTS as f64, 0.0, 0.0], bends));
        bars.push(it.add(&nodes[i - 1..=i], Kind::Beam(beam)));
    }
    let (struck, tip) = (nodes[2 * PARTS / 3], nodes[PARTS]);
    let missile = it.node([4.0, 0.0, 0.0], [true, true, false, true, true, true]);
    it.mass(missile, 500.0);
    it.spec.initial.push((missile, UZ, 0.01, -5.0));
    let nose = Contact {
        kn: 2e7,
        opening: 0.0,
        c: 1e4,
        pull: false,
        slow: 0.0,
        fast: 0.0,
        rate: 0.0,
        ks: 0.0,
    };
    let nose = it.along(&[struck, missile], Z, link(Law::Contact(nose), 0));
    let stop = it.add(&[tip], link(Law::Gap(5e7, 0.01), 0));
    it.show("missile", Output::Displacement(missile, UZ));
    it.record("missile: velocity", Output::Velocity(missile, UZ));
    it.show("tip", Output::Displacement(tip, UZ));
    it.record("tip: velocity", Output::Velocity(tip, UZ));
    it.record("struck", Output::Displacement(struck, UZ));
    it.record("struck: velocity", Output::Velocity(struck, UZ));
    for i in [PARTS / 4, PARTS / 2] {
        it.record(format!("node {i}"), Output::Displacement(nodes[i], UZ));
        it.record(format!("node {i}: rotation"), Output::Displacement(nodes[i], RY));
        it.record(format!("node {i}: moment"), Output::End(bars[i], 0, RY));
    }
    it.show("missile: force", Output::LinkForce(nose, 0));
    it.record("missile: distance", Output::LinkDeformation(nose, 0));
    it.show("stop: force", Output::LinkForce(stop, 0));
    it.record("stop: deformation", Output::LinkDeformation(stop, 0));
    it.record("support: shear", Output::End(bars[0], 0, UZ));
    it.record("support: moment", Output::End(bars[0], 0, RY));
    it.spec.damping = Damping::Modal(0.02);
    (it.spec.duration, it.spec.dt) = (0.15, 0.5e-3);
    it
}

//! A shear building with inerters in its dampers, and an oscillator on one.

use super::build::{ALONG_X, Structure, UX, X, link, springs};
use super::motion::{Along, first};
use crate::oracle::spec::{Damping, Kind, Law, Output};

/// Four storeys; tuned viscous mass dampers in two of them, an inerter under a roof mass.
pub(super) fn building() -> Structure {
    let mut it = Structure::plane();
    let mut floors = vec![it.node([0.0; 3], [true; 6])];
    let (mass, k) = (2e5, [1.6e8, 1.4e8, 1.2e8, 1e8]);
    for (i, k) in k.into_iter().enumerate() {
        let floor = it.node([0.0, 0.0, 3.5 * (i + 1) as f64], ALONG_X);
        it.mass(floor, mass);
        let storey = it.along(&[floors[i], floor], X, springs(&[(0, k, 0.0)]));
        let n = i + 1;
        it.record(format!("floor {n}"), Output::Displacement(floor, UX));
        it.record(format!("drift {n}"), Output::Drift(floor, floors[i], UX));
        it.record(format!("storey {n}: shear"), Output::End(storey, 1, UX));
        it.record(format!("floor {n}: acceleration"), Output::Acceleration(floor, UX));
        floors.push(floor);
    }
    // A spring, and behind a joint without weight an inerter beside a dashpot.
    for (storey, inertance, c, exponent) in [(1, 6e5, 4e5, 0.5), (2, 3e5, 3e6, 1.0)] {
        let z = it.spec.nodes[floors[storey]][2];
        let joint = it.node([1.0, 0.0, z - 0.5], ALONG_X);
        let brace = it.along(&[floors[storey - 1], joint], X, springs(&[(0, 4e7, 0.0)]));
        it.along(&[joint, floors[storey]], X, Kind::Inerter(inertance, 0));
        let dashpot = it.along(&[joint, floors[storey]], X, link(Law::Dashpot(c, exponent), 0));
        let name = format!("damper {storey}");
        it.show(format!("{name}: joint"), Output::Displacement(joint, UX));
        it.record(format!("{name}: brace force"), Output::End(brace, 1, UX));
        it.record_link(&name, dashpot);
    }
    // A mass on the roof against the storey below.
    let (roof, below) = (floors[4], floors[3]);
    let tuned = it.node([2.0, 0.0, 14.0], ALONG_X);
    it.mass(tuned, 2e4);
    it.along(&[roof, tuned], X, springs(&[(0, 4e6, 5e4)]));
    it.along(&[below, tuned], X, Kind::Inerter(3e4, 0));
    it.show("roof mass", Output::Displacement(tuned, UX));
    it.record("roof mass: stroke", Output::Drift(tuned, roof, UX));
    // An oscillator on a yielding spring, with an inerter to the ground.
    let alone = it.node([8.0, 0.0, 0.0], ALONG_X);
    it.mass(alone, 5e4);
    it.along(&[alone], X, Kind::Inerter(1e5, 0));
    let spring = it.along(&[alone], X, link(Law::Wen(6e6, 6e4, 0.1, 2.0), 0));
    it.show("oscillator", Output::Displacement(alone, UX));
    it.record("oscillator: acceleration", Output::Acceleration(alone, UX));
    it.record_link("oscillator", spring);
    it.spec.damping = Damping::Modal(0.02);
    it.spec.base = vec![(0, first(Along::X, 0.4))];
    (it.spec.duration, it.spec.dt) = (12.0, 0.01);
    it
}

//! A bridge of two decks that pound, over supports that move each in its own way.

use super::build::{FREE, HELD, RY, Structure, UX, UZ, X, Z, link, rectangle, springs};
use crate::oracle::spec::{Contact, Damping, Function, Kind, Law, Output};

/// The wave passes at this speed, m/s.
const SPEED: f64 = 400.0;

/// A ground displacement that arrives at x.
fn wave(x: f64, size: f64) -> Function {
    Function::Ricker(0.09 * size, 0.6, 2.6 + x / SPEED)
}

/// Four spans of 40 m, an expansion joint in the middle, abutments at both ends.
pub(super) fn bridge() -> Structure {
    let mut it = Structure::plane();
    let deck = rectangle(3.4e10, 6.0, 1.6);
    let (mut first, mut last) = (Vec::new(), Vec::new());
    for i in 0..=4 {
        first.push(it.node([20.0 * f64::from(i) - 0.1, 0.0, 10.0], FREE));
        last.push(it.node([80.1 + 20.0 * f64::from(i), 0.0, 10.0], FREE));
    }
    for row in [&first, &last] {
        for pair in row.windows(2) {
            it.add(pair, Kind::Beam(deck));
        }
        for (i, n) in row.iter().enumerate() {
            it.mass(*n, if i % 4 == 0 { 2.4e5 } else { 4.8e5 });
        }
    }
    let mut piers = Vec::new();
    for (i, (x, size)) in [(40.0, 1.0), (80.0, 1.15), (120.0, 0.85)].into_iter().enumerate() {
        let foot = it.node([x, 0.0, 0.0], HELD);
        it.spec.moved.push((foot, UX, wave(x, size)));
        let top = it.node([x, 0.0, 9.0], FREE);
        it.mass(top, 6e4);
        let pier = it.add(&[foot, top], Kind::Beam(rectangle(3e10, 4.0, 1.8)));
        it.record(format!("pier {}: top", i + 1), Output::Displacement(top, UX));
        it.record(format!("pier {}: drift", i + 1), Output::Drift(top, foot, UX));
        it.record(format!("pier {}: shear", i + 1), Output::End(pier, 0, UX));
        it.record(format!("pier {}: moment", i + 1), Output::End(pier, 0, RY));
        piers.push(top);
    }
    // Fixed bearings in the middle of each deck.
    for (top, on) in [(piers[0], first[2]), (piers[2], last[2])] {
        it.along(&[top, on], Z, springs(&[(0, 5e9, 0.0), (1, 8e8, 0.0)]));
    }
    // Sliding ones under the joint and at the abutments.
    let ends = [(0.0, 0.9, first[0]), (160.0, 1.1, last[4])].map(|(x, size, on)| {
        let sill = it.node([x, 0.0, 10.0], HELD);
        it.spec.moved.push((sill, UX, wave(x, size)));
        (sill, on)
    });
    let sliding = [(piers[1], first[4]), (piers[1], last[0]), ends[0], ends[1]];
    for (i, (under, on)) in sliding.into_iter().enumerate() {
        it.along(&[under, on], Z, springs(&[(0, 5e9, 0.0)]));
        let rubber = it.along(&[under, on], X, link(Law::Wen(3e7, 1.5e5, 0.1, 2.0), 0));
        it.record_link(&format!("bearing {}", i + 1), rubber);
    }
    let impact = |kn: f64, opening: f64, c: f64| {
        let law = Contact { kn, opening, c, pull: false, slow: 0.0, fast: 0.0, rate: 0.0, ks: 0.0 };
        link(Law::Contact(law), 0)
    };
    let joint = it.along(&[first[4], last[0]], X, impact(4e8, 0.03, 4e6));
    let left = it.along(&[ends[0].0, ends[0].1], X, impact(2e8, 0.05, 2e6));
    let right = it.along(&[ends[1].1, ends[1].0], X, impact(2e8, 0.05, 2e6));
    for (name, gap) in [("joint", joint), ("left end", left), ("right end", right)] {
        it.show(format!("{name}: force"), Output::LinkForce(gap, 0));
        it.record(format!("{name}: opening"), Output::LinkDeformation(gap, 0));
    }
    for (name, n) in [("first deck", first[4]), ("second deck", last[0])] {
        it.show(name, Output::Displacement(n, UX));
        it.record(format!("{name}: velocity"), Output::Velocity(n, UX));
        it.record(format!("{name}: up"), Output::Displacement(n, UZ));
    }
    it.record("first deck: middle, up", Output::Displacement(first[1], UZ));
    it.spec.damping = Damping::Rayleigh(0.1, 0.002);
    (it.spec.duration, it.spec.dt) = (8.0, 0.005);
    it
}

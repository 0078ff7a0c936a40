//! A pipe in space with stops on both sides, supports that lift off, and snubbers.

use super::build::{FREE, HELD, Structure, UX, UZ, X, Y, Z, link};
use super::motion::{Along, first};
use crate::oracle::spec::{Beam, Damping, Force, Function, Kind, Law, Output};
use std::f64::consts::PI;

/// Up, along and down again between two anchors, with a valve; shaken, and hit by a water hammer.
pub(super) fn piping() -> Structure {
    let mut it = Structure::default();
    let (outer, wall): (f64, f64) = (0.219, 0.008);
    let inner = outer - 2.0 * wall;
    let area = PI / 4.0 * (outer * outer - inner * inner);
    let second = PI / 64.0 * (outer.powi(4) - inner.powi(4));
    let pipe = Beam {
        young: 2e11,
        shear: 7.7e10,
        area,
        i2: second,
        i3: second,
        torsion: 2.0 * second,
        kappa: 0.5,
        // With its water.
        density: 7850.0 + 1000.0 * inner * inner * PI / 4.0 / area,
        consistent: true,
    };
    let places = [
        [0.0, 0.0, 0.0],
        [2.5, 0.0, 0.0],
        [5.0, 0.0, 0.0],
        [5.0, 0.0, 2.0],
        [5.0, 0.0, 4.0],
        [5.0, 2.5, 4.0],
        [5.0, 5.0, 4.0],
        [7.5, 5.0, 4.0],
        [10.0, 5.0, 4.0],
    ];
    let last = places.len() - 1;
    let nodes: Vec<usize> = places
        .into_iter()
        .enumerate()
        .map(|(i, at)| it.node(at, if i == 0 || i == last { HELD } else { FREE }))
        .collect();
    let pipes: Vec<usize> = nodes.windows(2).map(|n| it.add(n, Kind::Beam(pipe))).collect();
    let valve = nodes[5];
    it.add(&[valve], Kind::Mass(400.0, [20.0, 20.0, 20.0]));
    let mut links = Vec::new();
    // Stops with clearance on both sides, and a support that lets the pipe lift off.
    for (name, n, axis) in [
        ("stop +y at 1", nodes[1], Y),
        ("stop -y at 1", nodes[1], Y.map(|x| -x)),
        ("stop +x at 4", nodes[4], X),
        ("stop -x at 4", nodes[4], X.map(|x| -x)),
    ] {
        links.push((name, it.along(&[n], axis, link(Law::Gap(2e7, 0.004), 0)), 0));
    }
    links.push(("rest at 2", it.along(&[nodes[2]], Z, link(Law::Gap(1e8, 0.0), 0)), 0));
    // A hydraulic snubber locks with rate; one with a relief valve lets go.
    let snubber = Law::Maxwell(1e7, 2e5, 1.0);
    links.push(("snubber x", it.along(&[valve], X, link(snubber, 0)), 0));
    let relief = Law::Bilinear(1e7, 3e5, 2e4, 6e3);
    links.push(("snubber z", it.along(&[nodes[6]], Z, link(relief, 0)), 0));
    for (name, id, axis) in links {
        it.record(format!("{name}: force"), Output::LinkForce(id, axis));
        it.record(format!("{name}: deformation"), Output::LinkDeformation(id, axis));
        if name.starts_with("stop") {
            it.shown.push(it.names.len() - 2);
        }
    }
    for (i, n) in nodes.iter().enumerate().take(last).skip(1) {
        for (d, axis) in ["x", "y", "z"].iter().enumerate() {
            it.record(format!("{i}: {axis}"), Output::Displacement(*n, d));
        }
    }
    for (d, axis) in ["x", "y", "z"].iter().enumerate() {
        it.record(format!("valve: acceleration {axis}"), Output::Acceleration(valve, d));
    }
    for d in 0..6 {
        let what = ["force x", "force y", "force z", "moment x", "moment y", "moment z"][d];
        it.record(format!("first anchor: {what}"), Output::End(pipes[0], 0, d));
        it.record(format!("last anchor: {what}"), Output::End(pipes[last - 1], 1, d));
    }
    let (hammer, corner) = (Function::HalfSine(1.0, 3.0, 0.05), nodes[4]);
    it.spec.forces.push(Force { node: corner, dof: UZ, value: 8e3, function: hammer.clone() });
    it.spec.forces.push(Force { node: nodes[2], dof: UX, value: 1.2e4, function: hammer });
    it.spec.damping = Damping::Modal(0.03);
    it.spec.gravity = true;
    it.spec.base =
        vec![(0, first(Along::X, 0.5)), (1, first(Along::Y, 0.5)), (2, first(Along::Z, 0.3))];
    (it.spec.duration, it.spec.dt) = (6.0, 0.005);
    it
}

//! Nodes along X, each tied to those before it or to the ground.

use super::links::{ALONG_X, HELD, Size, along, axial, between, law, node};
use crate::oracle::rng::{Rng, figures};
use crate::oracle::spec::{Kind, Law, Spec};

fn size(rng: &mut Rng) -> (Size, f64) {
    let (mass, f) = (rng.log(100.0, 1e5), rng.log(0.5, 8.0));
    let w = std::f64::consts::TAU * f;
    (Size { k: figures(mass * w * w), u: figures(3.0 / (w * w)), w }, mass)
}

/// Something axial between two nodes, or a node and the ground.
fn tie(spec: &mut Spec, rng: &mut Rng, nodes: &[usize], s: Size, holds: bool) {
    let k = figures(s.k * rng.log(0.2, 5.0));
    let c = figures(s.k / s.w * rng.log(0.02, 1.0));
    let kind = match rng.weighted(&[3.0, 1.5, 1.0, 0.8, 5.0, if holds { 0.0 } else { 0.3 }]) {
        0 => axial(k, 0.0),
        1 => axial(k, c),
        2 => axial(0.0, c),
        3 if nodes.len() == 2 => {
            let (a, b) = (spec.nodes[nodes[0]], spec.nodes[nodes[1]]);
            let area = figures(k * (b[0] - a[0]).abs() / 2e11);
            let density = if rng.chance(0.5) { 0.0 } else { 7850.0 };
            Kind::Truss(2e11, area, density, rng.chance(0.5))
        }
        3 => axial(k, 0.0),
        5 => Kind::Inerter(figures(s.k / (s.w * s.w) * rng.log(0.05, 0.5)), 0),
        _ => {
            let law = law(rng, s, holds);
            let law = if matches!(law, Law::Linear(..)) {
                Law::Wen(k, figures(k * s.u), 0.1, 2.0)
            } else {
                law
            };
            Kind::Link(law, 0)
        }
    };
    spec.members.push(match nodes {
        [one] => along(&[*one], [1.0, 0.0, 0.0], kind),
        _ => between(nodes, kind),
    });
}

/// A chain.
pub fn chain(rng: &mut Rng) -> Spec {
    let mut spec = Spec { family: "chain", ..Spec::default() };
    let (s, mass) = size(rng);
    let count = rng.whole(1, 10);
    node(&mut spec, [0.0; 3], HELD);
    let light = rng.pick(&[0.0, 0.3, 0.5]);
    for i in 1..=count {
        let n = node(&mut spec, [i as f64 * 1.5, 0.0, 0.0], ALONG_X);
        let heavy = !rng.chance(light) || n == count;
        tie(&mut spec, rng, &[n - 1, n], s, !heavy);
        if rng.chance(0.3) {
            tie(&mut spec, rng, &[n - 1, n], s, false);
        }
        if rng.chance(0.25) {
            tie(&mut spec, rng, &[n], s, false);
        }
        if n >= 2 && rng.chance(0.15) {
            tie(&mut spec, rng, &[n - 2, n], s, false);
        }
        if heavy {
            let m = figures(mass * rng.log(0.3, 2.0));
            spec.members.push(between(&[n], Kind::Mass(m, [0.0; 3])));
        }
    }
    if count > 3 && rng.chance(0.15) {
        let (a, b) = (rng.whole(1, count - 1), count);
        if a != b {
            spec.members.push(between(&[a, b], Kind::EqualDof(vec![0])));
        }
    }
    if rng.chance(0.4) {
        let end = node(&mut spec, [(count + 1) as f64 * 1.5, 0.0, 0.0], HELD);
        tie(&mut spec, rng, &[count, end], s, false);
    }
    spec
}

/// One mass on a spring: what is left where nothing else stands.
pub fn oscillator() -> Spec {
    let mut spec = Spec { family: "oscillator", duration: 2.0, dt: 0.01, ..Spec::default() };
    let n = node(&mut spec, [0.0; 3], ALONG_X);
    spec.members.push(between(&[n], Kind::Mass(1.0, [0.0; 3])));
    spec.members.push(along(&[n], [1.0, 0.0, 0.0], axial(40.0, 0.0)));
    spec.initial.push((n, 0, 0.1, 0.0));
    spec.outputs.push(crate::oracle::spec::Output::Displacement(n, 0));
    spec
}

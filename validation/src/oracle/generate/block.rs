//! A rigid body, or a point, on contacts with friction.

use super::links::{FREE, along, axial, between, node, sliding, tension};
use crate::oracle::rng::{Rng, figures};
use crate::oracle::spec::{Contact, Kind, Law, Rocking, Spec};

/// A body in XZ that stands by gravity and friction.
pub fn block(rng: &mut Rng) -> Spec {
    let mut spec = Spec { family: "block", plane: true, gravity: true, ..Spec::default() };
    let mass = rng.log(100.0, 1e5);
    let f = rng.log(15.0, 60.0);
    let kn = figures(mass * (std::f64::consts::TAU * f).powi(2) / 2.0);
    let mu = figures(rng.even(0.1, 0.7));
    let rate = if rng.chance(0.3) { figures(rng.log(5.0, 50.0)) } else { 0.0 };
    let fast = if rate > 0.0 { figures(mu * rng.even(1.0, 2.0)) } else { mu };
    let c = if rng.chance(0.7) { figures(rng.log(0.02, 0.3) * (kn * mass).sqrt()) } else { 0.0 };
    let ks = figures(kn * rng.log(0.3, 1.0));
    let contact = Contact { kn, opening: 0.0, c, pull: rng.chance(0.3), slow: mu, fast, rate, ks };
    if rng.chance(0.35) {
        // A point that slides, tied to the ground by a spring.
        spec.plane = rng.chance(0.5);
        let fixed = [false, false, false, true, true, true];
        let n = node(&mut spec, [0.0, 0.0, 1.0], fixed);
        spec.members.push(between(&[n], Kind::Mass(mass, [0.0; 3])));
        let law = match rng.all_kinds && rng.chance(0.6) {
            true => sliding(rng, kn),
            false => Law::Contact(contact),
        };
        spec.members.push(between(&[n], Kind::Link(law, 0)));
        if rng.chance(0.7) {
            let k = figures(mass * (std::f64::consts::TAU * rng.log(0.3, 2.0)).powi(2));
            spec.members.push(along(&[n], [1.0, 0.0, 0.0], axial(k, 0.0)));
        }
        if rng.chance(0.4) {
            // A second mass on top.
            let top = node(&mut spec, [0.0, 0.0, 2.0], fixed);
            let k = figures(mass * (std::f64::consts::TAU * rng.log(1.0, 6.0)).powi(2));
            spec.members.push(between(&[top], Kind::Mass(figures(mass * 0.5), [0.0; 3])));
            let all = [figures(20.0 * k), k, k, 0.0, 0.0, 0.0];
            spec.members.push(between(&[n, top], Kind::Spring(all, [0.0; 6])));
        }
        return spec;
    }
    let (w, h) = (rng.log(0.5, 2.0), rng.log(0.3, 2.0));
    let centre = node(&mut spec, [0.0, 0.0, figures(0.5 * h)], FREE);
    if rng.rocking && rng.chance(0.5) {
        return rocking(spec, centre, [w, h], mass, contact, rng);
    }
    let left = node(&mut spec, [figures(-0.5 * w), 0.0, 0.0], FREE);
    let right = node(&mut spec, [figures(0.5 * w), 0.0, 0.0], FREE);
    let inertia = figures(mass * (w * w + h * h) / 12.0);
    spec.members.push(between(&[centre], Kind::Mass(mass, [0.0, inertia, 0.0])));
    if rng.chance(0.5) {
        spec.members.push(between(&[centre, left, right], Kind::RigidBody));
    } else {
        spec.members.push(between(&[centre, left], Kind::RigidLink));
        spec.members.push(between(&[centre, right], Kind::RigidLink));
    }
    let law = match rng.all_kinds && rng.chance(0.3) {
        true => tension(rng, kn),
        false => Law::Contact(contact),
    };
    for n in [left, right] {
        spec.members.push(between(&[n], Kind::Link(law.clone(), 0)));
    }
    spec
}

/// The same as one link at its centre, which turns as far as it likes; some fall onto their sides.
fn rocking(
    mut spec: Spec,
    centre: usize,
    [w, h]: [f64; 2],
    mass: f64,
    contact: Contact,
    rng: &mut Rng,
) -> Spec {
    let inertia = figures(mass * (w * w + h * h) / 12.0);
    spec.members.push(between(&[centre], Kind::Mass(mass, [0.0, inertia, 0.0])));
    let (x, z) = (figures(0.5 * w), figures(0.5 * h));
    let mut points = vec![[-x, -z], [x, -z]];
    if rng.chance(0.3) {
        points.extend([[-x, z], [x, z]]);
    }
    // Its friction has one coefficient.
    let contact = Contact { fast: contact.slow, rate: 0.0, ..contact };
    spec.members.push(between(&[centre], Kind::Link(Law::Rocking(Rocking { points, contact }), 0)));
    spec
}

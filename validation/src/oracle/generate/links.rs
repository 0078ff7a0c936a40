//! Random laws for a stiffness and a deformation that are typical.

use crate::oracle::rng::{Rng, figures};
use crate::oracle::spec::{
    Beam, Degrading, Hertz, Kelvin, Kind, Law, Member, Pendulum, Ring, Shear, Spec, Tension,
    Triple, V3,
};

/// What a structure is made around: k N/m, deformation u m, rate ω rad/s.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// Stiffness.
    pub k: f64,
    /// Deformation.
    pub u: f64,
    /// Circular frequency.
    pub w: f64,
}

/// A law on one axis that holds its ends together at all times, or not.
pub fn law(rng: &mut Rng, s: Size, holds: bool) -> Law {
    if rng.all_kinds && rng.chance(0.5) {
        return other(rng, s, holds);
    }
    let k = figures(s.k * rng.log(0.1, 3.0));
    let u = figures(s.u * rng.log(0.2, 1.5));
    let c = figures(s.k / s.w * rng.log(0.05, 1.0));
    // A force of size k u at a rate of u ω.
    let power = |c: f64, p: f64| figures(c * (s.u * s.w).powf(1.0 - p));
    let from = if holds { 3 } else { 0 };
    match rng.weighted(&[1.2, 1.2, 0.0, 2.0, 2.0, 1.0, 1.0, 2.0, 1.5, 2.0][from..]) + from {
        0 => Law::Gap(figures(k * rng.log(1.0, 30.0)), u),
        1 => Law::Hook(figures(k * rng.log(1.0, 30.0)), u),
        3 => {
            let p = if rng.chance(0.5) { 1.0 } else { figures(rng.even(0.3, 2.0)) };
            Law::Dashpot(power(c, p), p)
        }
        4 => {
            let p = if rng.chance(0.5) { 1.0 } else { figures(rng.even(0.4, 1.6)) };
            Law::Maxwell(figures(k * rng.log(0.5, 10.0)), power(c, p), p)
        }
        5 => {
            let fl = figures(c * s.u * s.w * rng.even(0.2, 0.8));
            Law::Bilinear(figures(k * rng.log(0.5, 10.0)), c, figures(c * rng.log(0.05, 0.5)), fl)
        }
        6 => {
            let (a, b) = (u, figures(u * rng.even(1.5, 3.0)));
            let (fa, fb) = (figures(k * a), figures(k * a + k * rng.log(0.1, 4.0) * (b - a)));
            Law::Elastic(vec![-b, -a, 0.0, a, b], vec![-fb, -fa, 0.0, fa, fb])
        }
        7 => {
            let (a, b, e) = (figures(u * 0.5), figures(u), figures(u * 3.0));
            let fa = k * a;
            let fb = fa + k * rng.even(0.2, 0.6) * (b - a);
            let fe = fb + k * rng.even(0.02, 0.15) * (e - b);
            Law::Plastic(vec![0.0, a, b, e], vec![0.0, figures(fa), figures(fb), figures(fe)])
        }
        8 => Law::Linear([[k, figures(0.2 * k)], [figures(-0.2 * k), k]], [[c, 0.0], [0.0, c]]),
        _ => {
            let n = rng.pick(&[1.0, 2.0, 2.0, 3.0, 5.0]);
            Law::Wen(k, figures(k * u), figures(rng.log(0.02, 0.5)), n)
        }
    }
}

/// One of the kinds that came later.
fn other(rng: &mut Rng, s: Size, holds: bool) -> Law {
    let k = figures(s.k * rng.log(0.1, 3.0));
    let u = figures(s.u * rng.log(0.2, 1.5));
    let mass = s.k / (s.w * s.w);
    let from = if holds { 2 } else { 0 };
    match rng.weighted(&[1.0, 1.5, 1.2, 1.5, 1.0][from..]) + from {
        0 => {
            let k = figures(k * rng.log(1.0, 30.0));
            let c = figures(rng.log(0.02, 1.0) * (k * mass).sqrt());
            let (approach, pull) = (rng.chance(0.5), rng.chance(0.2));
            Law::Kelvin(Kelvin { k, c, opening: u, approach, pull: pull && !approach })
        }
        1 => {
            let n = rng.pick(&[1.5, 1.5, 1.2, 2.0]);
            let slowest = if rng.chance(0.5) { 1e-3 } else { 0.0 };
            Law::Hertz(Hertz {
                k: figures(k * rng.log(1.0, 30.0) * (0.1 * u).powf(1.0 - n)),
                n,
                xi: figures(if slowest > 0.0 { rng.log(0.1, 2.0) } else { rng.log(0.03, 0.6) }),
                mass: figures(mass),
                opening: u,
                slowest,
            })
        }
        2 => Law::Ring(Ring {
            k: figures(5.0 * k),
            k1: k,
            k2: figures(k * rng.even(0.2, 0.9)),
            u0: if rng.chance(0.7) { figures(u * rng.log(0.1, 2.0)) } else { 0.0 },
            us: if rng.chance(0.3) { figures(u * rng.log(1.0, 4.0)) } else { f64::INFINITY },
        }),
        3 => {
            let beta = figures(rng.even(0.4, 0.9));
            let wears = rng.chance(0.6);
            let loss = |rng: &mut Rng, most: f64| {
                if wears && rng.chance(0.6) { figures(rng.log(0.1, 1.0) * most) } else { 0.0 }
            };
            Law::Degrading(Degrading {
                k,
                dy: u,
                alpha: figures(rng.log(0.02, 0.5)),
                n: rng.pick(&[1.0, 1.5, 2.0, 3.0]),
                beta,
                gamma: figures((1.0 - beta) * rng.even(0.3, 1.0)).min(beta),
                a0: 1.0,
                delta_a: loss(rng, 0.01),
                delta_nu: loss(rng, 0.1),
                delta_eta: loss(rng, 0.1),
            })
        }
        _ => {
            let count = rng.whole(1, 3);
            let stiff = (0..count).map(|_| figures(k * rng.log(0.2, 2.0))).collect();
            let time = (0..count).map(|_| figures(rng.log(0.05, 5.0) / s.w)).collect();
            Law::Branches(figures(k * rng.log(0.1, 1.0)), stiff, time)
        }
    }
}

/// A bearing with smooth plastic shear of a stiffness, along local 2 and 3.
pub fn shear(rng: &mut Rng, k: f64, s: Size) -> Law {
    let axial = if rng.chance(0.5) { figures(s.k * 5.0) } else { 0.0 };
    let own = |rng: &mut Rng, k: f64| {
        let (r, y) = (rng.even(0.05, 0.4), figures(s.u * rng.log(0.2, 1.0)));
        (figures(r * k), figures((1.0 - r) * k * y), y)
    };
    let (elastic, strength, y) = own(rng, k);
    let lead = rng.chance(0.4).then_some(0.15);
    let (elastic3, strength3, y3) = match lead {
        None if rng.chance(0.4) => own(rng, 1.5 * k),
        _ => (elastic, strength, y),
    };
    Law::Shear(Shear {
        axial,
        elastic: [elastic, elastic3],
        strength: [strength, strength3],
        yields: [y, y3],
        lead,
    })
}

/// A friction coefficient: slow, fast, rate.
fn friction(rng: &mut Rng) -> [f64; 3] {
    let slow = figures(rng.even(0.02, 0.15));
    let fast = figures(slow * rng.even(1.0, 2.0));
    [slow, fast, figures(rng.log(5.0, 50.0))]
}

/// A bearing that slides pressed and pulled.
pub fn tension(rng: &mut Rng, kn: f64) -> Law {
    let by_rate = rng.chance(0.5);
    let of = |rng: &mut Rng| {
        let [slow, fast, rate] = friction(rng);
        if by_rate { [slow, fast, rate] } else { [slow, slow, 0.0] }
    };
    Law::Tension(Tension {
        stiff: [kn, figures(kn * rng.log(0.1, 1.0))],
        gaps: [0.0, if rng.chance(0.5) { figures(rng.log(1e-4, 5e-3)) } else { 0.0 }],
        c: 0.0,
        ks: figures(kn * rng.log(0.3, 1.0)),
        radius: if rng.chance(0.5) { figures(rng.log(0.5, 4.0)) } else { 0.0 },
        friction: [of(rng), of(rng)],
    })
}

/// A bearing that slides under a weight.
pub fn sliding(rng: &mut Rng, kn: f64) -> Law {
    let ks = figures(kn * rng.log(0.3, 1.0));
    match rng.whole(0, 2) {
        0 => {
            let ([slow, fast, rate], radius) = (friction(rng), figures(rng.log(0.5, 4.0)));
            Law::Pendulum(Pendulum { kn, ks, radius, slow, fast, rate })
        }
        1 => tension(rng, kn),
        _ => {
            let (inner, outer) = (figures(rng.log(0.2, 0.5)), figures(rng.log(1.0, 3.0)));
            let by_rate = rng.chance(0.4);
            let inside = figures(rng.even(0.01, 0.04));
            let (low, high) = (figures(rng.even(0.04, 0.1)), figures(rng.even(0.06, 0.15)));
            let all = [low, inside, inside, high];
            let rate = figures(rng.log(5.0, 50.0));
            let friction =
                all.map(|m| if by_rate { [m, figures(1.5 * m), rate] } else { [m, m, 0.0] });
            let rims = rng.chance(0.5);
            let capacities = if rims { [0.15, 0.06, 0.06, 0.15] } else { [0.0; 4] };
            let stop = if rims { figures(0.3 * kn) } else { 0.0 };
            let radii = [outer, inner, inner, outer];
            Law::Triple(Triple { kn, ks, radii, capacities, stop, friction })
        }
    }
}

/// A member between nodes.
pub fn between(nodes: &[usize], kind: Kind) -> Member {
    Member { nodes: nodes.to_vec(), axis1: None, kind }
}

/// A member along a direction.
pub fn along(nodes: &[usize], axis1: V3, kind: Kind) -> Member {
    Member { nodes: nodes.to_vec(), axis1: Some(axis1), kind }
}

/// Springs along the first axis.
pub fn axial(k: f64, c: f64) -> Kind {
    Kind::Spring([k, 0.0, 0.0, 0.0, 0.0, 0.0], [c, 0.0, 0.0, 0.0, 0.0, 0.0])
}

/// A beam with a second moment that gives 12 E I/L³ = k.
pub fn section(rng: &mut Rng, k: f64, l: f64, mass: f64) -> Beam {
    let young = 2e11;
    let i = k * l.powi(3) / (12.0 * young);
    // A section some times as stiff along as across.
    let area = i * 12.0 / (l / rng.log(8.0, 25.0)).powi(2);
    Beam {
        young,
        shear: 8e10,
        area: figures(area),
        i2: figures(i * rng.log(0.5, 2.0)),
        i3: figures(i),
        torsion: figures(i * 1.3),
        kappa: if rng.chance(0.2) { 0.85 } else { 0.0 },
        density: figures(mass / (area * l)),
        consistent: rng.chance(0.3),
    }
}

/// A node.
pub fn node(spec: &mut Spec, at: V3, fixed: [bool; 6]) -> usize {
    spec.nodes.push(at.map(figures));
    spec.fixed.push(fixed);
    spec.nodes.len() - 1
}

/// Held but along X.
pub const ALONG_X: [bool; 6] = [false, true, true, true, true, true];
/// Held.
pub const HELD: [bool; 6] = [true; 6];
/// Free.
pub const FREE: [bool; 6] = [false; 6];

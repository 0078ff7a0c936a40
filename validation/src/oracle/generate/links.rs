//! Random laws for a stiffness and a deformation that are typical.

use crate::oracle::rng::{Rng, figures};
use crate::oracle::spec::{Beam, Kind, Law, Member, Spec, V3};

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

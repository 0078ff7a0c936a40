//! What moves a structure: ground, forces, supports, initial values; how long, and how it is solved.

use super::outputs;
use crate::oracle::assemble::Assembled;
use crate::oracle::modes::Modes;
use crate::oracle::problem::{Problem, engaged};
use crate::oracle::rng::{Rng, figures};
use crate::oracle::spec::{Basis, Damping, Force, Function, Kind, Law, Spec};
use nalgebra::{DMatrix, SymmetricEigen};
use std::f64::consts::TAU;

/// The structure with loads, or none where it cannot stand.
pub fn drive(mut spec: Spec, rng: &mut Rng) -> Option<Spec> {
    let a = Assembled::new(&spec).ok()?;
    if a.k.nrows() == 0 || !held(&a) {
        return None;
    }
    let modes = engaged(&a);
    let omega = &modes.omega;
    // A structure that is free to move has no period of its own.
    let top = omega.last().copied()?;
    let low = omega.iter().copied().find(|w| *w > 1e-6 * top)?;
    let block = spec.family == "block";
    let period = if block { rng.log(0.3, 1.0) } else { TAU / low };
    spec.duration = figures(period * rng.log(1.5, if block { 4.0 } else { 8.0 }));
    spec.tolerance = if rng.chance(0.25) { Some(1e-6) } else { None };
    if !block && rng.chance(0.25) && stands(&a) {
        spec.gravity = true;
    }
    damp(&mut spec, &a, rng, low, top);
    loads(&mut spec, &a, rng, period);
    if spec.base.is_empty()
        && spec.forces.is_empty()
        && spec.moved.is_empty()
        && spec.initial.is_empty()
    {
        spec.base.push((0, Function::Sine(2.0, figures(1.0 / period), 2.0)));
    }
    // No more than so many cycles of what moves.
    let fast = fastest(&spec, &a, &modes).max(low);
    spec.duration = figures(spec.duration.min(CYCLES * TAU / fast));
    let good = period / 50.0;
    let dt = good * if rng.chance(0.6) { rng.log(0.3, 3.0) } else { rng.log(0.1, 100.0) };
    // A whole number of output steps.
    let steps = (spec.duration / dt).round().clamp(1.0, 4000.0);
    spec.dt = figures(spec.duration / steps);
    spec.duration = spec.dt * steps;
    spec.basis = match rng.weighted(&[8.0, 0.7, 0.7, 1.0]) {
        1 => Basis::RitzOf(rng.whole(3, 15)),
        2 => Basis::EigenOf(rng.whole(3, 15)),
        3 => Basis::Complete,
        _ => Basis::Ritz,
    };
    // Damping against the motion of supports needs a structure that follows them.
    if !spec.moved.is_empty() && Problem::new(&spec, TAU / period).is_err() {
        spec.damping = Damping::None;
    }
    let a = Assembled::new(&spec).ok()?;
    outputs::choose(&mut spec, &a, rng);
    (!spec.outputs.is_empty()).then_some(spec)
}

/// Cycles of the fastest motion that counts.
const CYCLES: f64 = 60.0;

/// Circular frequency of the fastest mode that the loads push with more than a small share of the energy.
fn fastest(spec: &Spec, a: &Assembled, modes: &Modes) -> f64 {
    let mut pushes = Vec::new();
    pushes.extend(spec.base.iter().map(|b| a.inertia.column(b.0).into_owned()));
    pushes.extend(spec.forces.iter().map(|f| a.t.row(6 * f.node + f.dof).transpose()));
    pushes.extend((0..a.k_s.ncols()).map(|j| a.k_s.column(j).into_owned()));
    for (n, d, ..) in &spec.initial {
        let row = a.t.row(6 * n + d).transpose();
        pushes.push(&a.k * &row);
        pushes.push(&a.m * row);
    }
    if spec.gravity {
        pushes.push(a.inertia.column(2).into_owned());
    }
    let top = modes.omega.last().copied().unwrap_or(0.0);
    let mut fast = 0.0_f64;
    for p in pushes {
        let shares = modes.shapes.transpose() * p;
        let energy = |j: usize| (shares[j] / modes.omega[j].max(1e-6 * top)).powi(2);
        let all: f64 = (0..modes.omega.len()).map(energy).sum();
        for j in (0..modes.omega.len()).filter(|j| energy(*j) > 1e-4 * all) {
            fast = fast.max(modes.omega[j]);
        }
    }
    fast
}

/// Stiffness of the links, where they hold.
fn with_links(a: &Assembled, start: DMatrix<f64>, hold: impl Fn(&Law) -> bool) -> DMatrix<f64> {
    let mut k = start;
    for link in a.links.iter().filter(|l| hold(&l.law)) {
        for (i, stiff) in link.law.stiffness(1.0).iter().enumerate() {
            let row = a.b.row(link.first + i);
            k += row.transpose() * row * *stiff;
        }
    }
    k
}

/// No direction is without anything that holds it at all times.
fn regular(k: &DMatrix<f64>) -> bool {
    let n = k.nrows();
    if (0..n).any(|i| k[(i, i)] <= 0.0) {
        return false;
    }
    let unit = DMatrix::from_fn(n, n, |i, j| k[(i, j)] / (k[(i, i)] * k[(j, j)]).sqrt());
    SymmetricEigen::new((&unit + unit.transpose()) * 0.5).eigenvalues.min() > 1e-9
}

/// Every direction is held by mass, stiffness, damping or a link that never opens.
fn held(a: &Assembled) -> bool {
    let mean = |x: &DMatrix<f64>| x.diagonal().sum() / x.nrows() as f64;
    let unit = |x: &DMatrix<f64>| if mean(x) > 0.0 { x / mean(x) } else { x.clone() };
    let opens = |law: &Law| {
        matches!(
            law,
            Law::Gap(..)
                | Law::Hook(..)
                | Law::Contact(_)
                | Law::Kelvin(_)
                | Law::Hertz(_)
                | Law::Tension(_)
        )
    };
    let closed = |law: &Law| !opens(law);
    let links = with_links(a, a.k.clone() * 0.0, closed);
    regular(&(unit(&a.m) + unit(&a.k) + unit(&a.c) + unit(&links)))
}

/// It carries its weight by linear members and links that carry weight for ever.
fn stands(a: &Assembled) -> bool {
    let steady = |law: &Law| {
        matches!(
            law,
            Law::Elastic(..)
                | Law::Wen(..)
                | Law::Elastomeric(..)
                | Law::Linear(..)
                | Law::Plastic(..)
                | Law::Shear(_)
                | Law::Ring(_)
                | Law::Degrading(_)
                | Law::Branches(..)
        )
    };
    regular(&with_links(a, a.k.clone(), steady))
}

fn damp(spec: &mut Spec, a: &Assembled, rng: &mut Rng, low: f64, top: f64) {
    let ratio = figures(rng.log(0.01, 0.1));
    spec.damping = match rng.weighted(&[4.0, 3.0, 2.0]) {
        1 => Damping::Modal(ratio),
        2 => {
            let high = (low * 5.0).min(top);
            let share = 2.0 * ratio / (low + high);
            let of_mass = if rng.chance(0.7) { figures(share * low * high) } else { 0.0 };
            Damping::Rayleigh(of_mass, figures(share))
        }
        _ => Damping::None,
    };
    let _ = a;
}

fn course(rng: &mut Rng, size: f64, period: f64, duration: f64) -> Function {
    let size = figures(size * rng.sign());
    let f = figures(rng.log(0.4, 2.5) / period);
    match rng.weighted(&[3.0, 1.5, 1.0, 1.0, 1.5, 2.0]) {
        0 => Function::Sine(size, f, rng.pick(&[0.5, 1.0, 2.0, 3.5, 50.0])),
        1 => Function::HalfSine(size, figures(rng.even(0.0, 0.3) * duration), figures(0.5 / f)),
        2 => Function::Step(
            figures(size * 0.5),
            if rng.chance(0.5) { 0.0 } else { figures(0.2 * duration) },
        ),
        3 => Function::Ramp(
            figures(size * 0.7),
            figures(rng.even(0.0, 0.2) * duration),
            figures(rng.log(0.1, 1.0) * period),
        ),
        4 => Function::Ricker(size, f, figures(1.3 / f)),
        _ => {
            let step = figures(period / rng.log(3.0, 40.0));
            let count = ((duration / step).ceil() as usize).clamp(2, 120);
            let count = if rng.chance(0.5) { (count / 2).max(2) } else { count };
            let mut points = vec![(0.0, 0.0)];
            points.extend(
                (1..=count)
                    .map(|i| (figures(step * i as f64), figures(size * rng.even(-1.0, 1.0)))),
            );
            Function::Points(points)
        }
    }
}

fn loads(spec: &mut Spec, a: &Assembled, rng: &mut Rng, period: f64) {
    let block = spec.family == "block";
    let flat = spec.plane;
    let w = TAU / period;
    let duration = spec.duration;
    if block || rng.chance(0.6) {
        let count = if rng.chance(0.3) { 2 } else { 1 };
        for i in 0..count {
            let direction = match (i, spec.family) {
                (0, "chain" | "block") | (1, "chain") => 0,
                (_, "long beam") => 2,
                (_, "block") => {
                    if flat {
                        2
                    } else {
                        rng.pick(&[1, 2])
                    }
                }
                (_, "plane frame") => rng.pick(&[0, 0, 2]),
                _ => rng.pick(&[0, 1, 1, 2]),
            };
            let size = if block {
                9.81 * rng.log(0.15, 0.9) * if i > 0 { 0.4 } else { 1.0 }
            } else {
                rng.log(0.5, 5.0)
            };
            spec.base.push((direction, course(rng, size, period, duration)));
        }
    }
    let free: Vec<(usize, usize)> = (0..spec.nodes.len())
        .flat_map(|n| (0..6).map(move |d| (n, d)))
        .filter(|(n, d)| {
            let row = a.t.row(6 * n + d);
            row.iter().filter(|x| **x != 0.0).count() == 1 && row.amax() == 1.0
        })
        .collect();
    let mass: f64 =
        spec.members.iter().map(|m| if let Kind::Mass(m, _) = m.kind { m } else { 0.0 }).sum();
    let typical = if mass > 0.0 { mass / spec.nodes.len() as f64 } else { a.inertia.amax() };
    if rng.chance(if spec.base.is_empty() { 0.6 } else { 0.25 }) && !free.is_empty() && !block {
        for _ in 0..rng.whole(1, 2) {
            let (node, dof) = rng.pick(&free);
            let size = figures(typical * rng.log(0.3, 3.0));
            let function = course(rng, 1.0, period, duration);
            spec.forces.push(Force { node, dof, value: size, function });
        }
    }
    if !spec.gravity
        && rng.chance(if spec.base.is_empty() && spec.forces.is_empty() { 0.8 } else { 0.1 })
    {
        let own: Vec<_> = free
            .iter()
            .copied()
            .filter(|(n, d)| {
                let row = a.t.row(6 * n + d);
                *d < 3
                    && !follows(spec, *n)
                    && (0..row.len()).any(|j| row[j] == 1.0 && a.m[(j, j)] > 0.0)
            })
            .collect();
        if !own.is_empty() {
            let (node, dof) = rng.pick(&own);
            let u = figures(2.0 / (w * w) * rng.even(-1.0, 1.0));
            let v = figures(2.0 / w * rng.even(-1.0, 1.0));
            spec.initial.push(match rng.whole(0, 2) {
                0 => (node, dof, u, 0.0),
                1 => (node, dof, 0.0, v),
                _ => (node, dof, u, v),
            });
        }
    }
    if !block && !spec.gravity && rng.chance(0.12) {
        let held: Vec<(usize, usize)> = (0..spec.nodes.len())
            .filter(|n| spec.fixed[*n] == [true; 6])
            .map(|n| (n, if spec.family == "long beam" { 2 } else { 0 }))
            .collect();
        if !held.is_empty() {
            let (n, d) = rng.pick(&held);
            let f = figures(rng.log(0.3, 1.5) / period);
            let size = figures(2.0 / (w * w));
            let function = if rng.chance(0.7) {
                Function::Ricker(size, f, figures(1.7 / f))
            } else {
                Function::Ramp(size, figures(0.05 * duration), figures(period))
            };
            spec.moved.push((n, d, function));
        }
    }
}

/// The node is tied to another by a constraint.
fn follows(spec: &Spec, node: usize) -> bool {
    spec.members.iter().any(|m| {
        matches!(m.kind, Kind::RigidLink | Kind::RigidBody | Kind::Diaphragm | Kind::EqualDof(_))
            && m.nodes.contains(&node)
    })
}

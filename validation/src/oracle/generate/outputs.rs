//! What is compared: some displacements, velocities, link forces and deformations.

use crate::oracle::assemble::Assembled;
use crate::oracle::rng::Rng;
use crate::oracle::spec::{Kind, Output, Spec};

/// Chooses.
pub fn choose(spec: &mut Spec, a: &Assembled, rng: &mut Rng) {
    let moving: Vec<(usize, usize)> = (0..spec.nodes.len())
        .flat_map(|n| (0..6).map(move |d| (n, d)))
        .filter(|(n, d)| a.t.row(6 * n + d).iter().any(|x| *x != 0.0))
        .collect();
    let heavy = |(n, d): (usize, usize)| {
        let row = a.t.row(6 * n + d);
        row.iter().enumerate().all(|(j, x)| *x == 0.0 || a.m[(j, j)] > 0.0)
    };
    let mut all: Vec<Output> = Vec::new();
    for _ in 0..4 {
        let (n, d) = rng.pick(&moving);
        all.push(Output::Displacement(n, d));
    }
    for _ in 0..2 {
        let (n, d) = rng.pick(&moving);
        if heavy((n, d)) {
            all.push(Output::Velocity(n, d));
        }
    }
    let links: Vec<(usize, usize)> = spec
        .members
        .iter()
        .enumerate()
        .flat_map(|(i, m)| {
            let axes =
                if let Kind::Link(law, axis) = &m.kind { law.axes(*axis) } else { Vec::new() };
            axes.into_iter().map(move |x| (i, x))
        })
        .collect();
    if !links.is_empty() {
        for _ in 0..2 {
            let (e, x) = rng.pick(&links);
            all.push(Output::LinkForce(e, x));
        }
        let (e, x) = rng.pick(&links);
        all.push(Output::LinkDeformation(e, x));
    }
    for output in all {
        if !spec.outputs.contains(&output) {
            spec.outputs.push(output);
        }
    }
}

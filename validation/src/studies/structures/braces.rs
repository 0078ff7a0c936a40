//! A frame with dampers in its braces: nonlinear dashpots, Maxwell chains, joints without mass.

use super::build::{FREE, HELD, RY, Structure, UX, UZ, link, rectangle, springs};
use super::motion::{Along, second};
use crate::oracle::spec::{Damping, Kind, Law, Output};

const BAY: f64 = 7.0;
const STOREY: f64 = 3.5;

/// The point at a share of the way between two nodes.
fn between(it: &Structure, a: usize, b: usize, share: f64) -> [f64; 3] {
    let (a, b) = (it.spec.nodes[a], it.spec.nodes[b]);
    [0, 1, 2].map(|i| a[i] + share * (b[i] - a[i]))
}

/// Steel, four storeys, two bays.
pub(super) fn frame() -> Structure {
    let mut it = Structure::plane();
    let steel = 2.05e11;
    let (column, beam) = (rectangle(steel, 0.12, 0.3), rectangle(steel, 0.08, 0.3));
    let brace = rectangle(steel, 0.1, 0.1);
    let mut levels: Vec<Vec<usize>> = Vec::new();
    for level in 0..=4_usize {
        let row: Vec<usize> = (0..3)
            .map(|i| {
                let at = [BAY * f64::from(i), 0.0, STOREY * level as f64];
                it.node(at, if level == 0 { HELD } else { FREE })
            })
            .collect();
        if let Some(below) = levels.last().cloned() {
            row.iter().for_each(|n| it.mass(*n, 3e4));
            row.windows(2).for_each(|pair| {
                it.add(pair, Kind::Beam(beam));
            });
            for (i, (low, top)) in below.iter().zip(&row).enumerate() {
                let bar = it.add(&[*low, *top], Kind::Beam(column));
                it.record(format!("column {i}-{level}: axial"), Output::End(bar, 0, UZ));
                it.record(format!("column {i}-{level}: shear"), Output::End(bar, 0, UX));
                it.record(format!("column {i}-{level}: moment"), Output::End(bar, 0, RY));
            }
            it.record(format!("floor {level}"), Output::Displacement(row[0], UX));
            it.record(format!("drift {level}"), Output::Drift(row[0], below[0], UX));
            it.record(format!("floor {level}: acceleration"), Output::Acceleration(row[0], UX));
        }
        levels.push(row);
    }
    it.shown.push(it.names.len() - 3);
    // A brace, and a dashpot between its end and the next joint of the frame.
    let single = [(1, 0, 6e5, 0.3), (2, 1, 5e5, 0.4), (3, 0, 4e5, 0.5)];
    for (storey, bay, c, exponent) in single {
        let (low, top) = (levels[storey - 1][bay], levels[storey][bay + 1]);
        let joint = it.node(between(&it, low, top, 0.85), FREE);
        it.add(&[low, joint], Kind::Beam(brace));
        let damper = it.add(&[joint, top], link(Law::Dashpot(c, exponent), 0));
        let name = format!("dashpot {storey}");
        it.record_link(&name, damper);
        it.show(format!("{name}: joint"), Output::Displacement(joint, UX));
    }
    // Brace, Maxwell damper, joint, dashpot or second Maxwell damper, in tubes that guide them.
    let chains = [
        (2, 0, Law::Maxwell(4e7, 3e6, 1.0), Law::Dashpot(5e5, 0.4)),
        (4, 1, Law::Maxwell(4e7, 4e5, 0.5), Law::Maxwell(3e7, 2e6, 1.0)),
    ];
    for (storey, bay, near, far) in chains {
        let (low, top) = (levels[storey - 1][bay], levels[storey][bay + 1]);
        let a = it.node(between(&it, low, top, 0.5), FREE);
        let b = it.node(between(&it, low, top, 0.7), FREE);
        it.add(&[low, a], Kind::Beam(brace));
        let tube = springs(&[(1, 5e7, 0.0), (5, 5e7, 0.0)]);
        let name = format!("chain {storey}");
        for (part, ends, law) in [(1, [a, b], near), (2, [b, top], far)] {
            it.add(&ends, tube.clone());
            let damper = it.add(&ends, link(law, 0));
            it.record_link(&format!("{name}, {part}"), damper);
        }
        it.show(format!("{name}: joint"), Output::Displacement(b, UX));
    }
    it.spec.damping = Damping::Rayleigh(0.2, 0.001);
    it.spec.base = vec![(0, second(Along::X, 0.5))];
    // Later on the oracle needs hours for dashpots of small powers that come to rest.
    (it.spec.duration, it.spec.dt) = (4.0, 0.01);
    it
}

//! Isolated frames: friction pendulums that feel the overturning, and hysteretic isolators.

use super::build::{FREE, Structure, UX, UZ, Z, link, rectangle, springs};
use super::motion::{Along, first, second};
use crate::oracle::spec::{Damping, Kind, Law, Output, Pendulum};

/// A frame on isolators: places of its columns, m, storeys, their height, mass of a node, sections.
struct Frame {
    columns: Vec<f64>,
    storeys: usize,
    height: f64,
    mass: f64,
    column: (f64, f64),
    beam: (f64, f64),
}

impl Frame {
    /// The frame with its outputs, and the feet that isolators go under.
    fn build(&self) -> (Structure, Vec<usize>) {
        let mut it = Structure::plane();
        let concrete = 3e10;
        let column = rectangle(concrete, self.column.0, self.column.1);
        let beam = rectangle(concrete, self.beam.0, self.beam.1);
        let mut levels: Vec<Vec<usize>> = Vec::new();
        for level in 0..=self.storeys {
            let z = self.height * level as f64;
            let row: Vec<usize> =
                self.columns.iter().map(|x| it.node([*x, 0.0, z], FREE)).collect();
            row.iter().for_each(|n| it.mass(*n, self.mass));
            for pair in row.windows(2) {
                it.add(pair, Kind::Beam(beam));
            }
            if let Some(below) = levels.last() {
                for (low, top) in below.iter().zip(&row) {
                    let bar = it.add(&[*low, *top], Kind::Beam(column));
                    let name = format!("column {}-{level}", it.spec.nodes[*low][0]);
                    it.record(format!("{name}: axial"), Output::End(bar, 0, UZ));
                    it.record(format!("{name}: shear"), Output::End(bar, 0, UX));
                    it.record(format!("{name}: moment"), Output::End(bar, 0, 4));
                }
            }
            levels.push(row);
        }
        for (level, row) in levels.iter().enumerate() {
            it.record(format!("displacement {level}"), Output::Displacement(row[0], UX));
            it.record(format!("acceleration {level}"), Output::Acceleration(row[0], UX));
            if level > 0 {
                let below = levels[level - 1][0];
                it.record(format!("drift {level}"), Output::Drift(row[0], below, UX));
            }
        }
        let top = levels[self.storeys][0];
        it.show("roof", Output::Displacement(top, UX));
        it.record("roof, up", Output::Displacement(top, UZ));
        it.spec.gravity = true;
        it.spec.damping = Damping::Modal(0.02);
        it.spec.dt = 0.01;
        (it, levels.swap_remove(0))
    }
}

/// Two bays of five storeys on friction pendulums, shaken along and upwards.
pub(super) fn five_storeys() -> Structure {
    let frame = Frame {
        columns: vec![0.0, 6.0, 12.0],
        storeys: 5,
        height: 3.5,
        mass: 25e3,
        column: (0.6, 0.6),
        beam: (0.3, 0.6),
    };
    let (mut it, feet) = frame.build();
    let bearing = Pendulum { kn: 2e9, ks: 5e7, radius: 2.0, slow: 0.05, fast: 0.05, rate: 0.0 };
    for (i, foot) in feet.into_iter().enumerate() {
        let bearing = it.add(&[foot], link(Law::Pendulum(bearing), 0));
        it.record_link(&format!("isolator {}", i + 1), bearing);
        if i == 0 {
            it.show("isolator 1: shear", Output::LinkForce(bearing, 1));
        }
    }
    it.spec.base = vec![(0, first(Along::X, 0.4)), (2, first(Along::Z, 0.2))];
    it.spec.duration = 12.0;
    it
}

/// A slender frame of twenty storeys on lead-rubber isolators.
pub(super) fn twenty_storeys() -> Structure {
    let frame = Frame {
        columns: vec![0.0, 8.0],
        storeys: 20,
        height: 3.2,
        mass: 40e3,
        column: (1.0, 1.2),
        beam: (0.6, 1.0),
    };
    let (mut it, feet) = frame.build();
    for (i, foot) in feet.into_iter().enumerate() {
        it.along(&[foot], Z, springs(&[(0, 4e9, 0.0)]));
        let bearing = it.along(&[foot], Z, link(Law::Elastomeric(4e7, 4e5, 0.1), 1));
        it.record_link(&format!("isolator {}", i + 1), bearing);
        if i == 0 {
            it.show("isolator 1: shear", Output::LinkForce(bearing, 1));
        }
    }
    it.spec.base = vec![(0, second(Along::X, 0.5))];
    it.spec.duration = 12.0;
    it
}

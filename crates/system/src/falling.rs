//! Bodies that nothing but contacts holds against gravity: they stand on them, or fall onto them.

use crate::System;
use crate::parts::{join, root};
use trilith_model::Model;

/// A part of the structure falls where moving it down costs less than this share of what its stiffness could ask.
const ROUNDING: f64 = 1e-9;

/// Direction of gravity among the six of a node.
const DOWN: usize = 2;

impl System {
    /// For each link: true where it acts on a part of the structure that would fall without links, but for those
    /// that `hold` (by index), which count as elastic. A stop between two frames does not, nor does one beside a
    /// structure on bearings that hold.
    #[must_use]
    pub fn on_falling_parts(&self, model: &Model, hold: impl Fn(usize) -> bool) -> Vec<bool> {
        let n = self.order();
        // By how much each equation moves when all parts move along gravity.
        let down: Vec<f64> =
            self.reduction.free.iter().map(|full| self.inner.shift(*full, DOWN)).collect();
        let falls = |i: usize| down[i] != 0.0;
        let mut part: Vec<usize> = (0..n).collect();
        // K t for a unit motion t of all parts along gravity, and the size of its terms.
        let (mut force, mut size, mut moves) = (vec![0.0; n], vec![0.0; n], vec![false; n]);
        for (i, j, k) in self.stiffness.entries().filter(|(_, _, k)| *k != 0.0) {
            join(&mut part, i, j);
            if falls(j) {
                force[i] += k * down[j];
                size[i] += (k * down[j]).abs();
            }
        }
        let links = &self.links;
        let holding = links.links.iter().enumerate().filter(|(i, _)| hold(*i));
        for (_, link) in holding {
            let coordinates = link.range.len();
            let mut k = vec![0.0; coordinates * coordinates];
            if let Some(law) = links.law(model, link) {
                law.engaged_stiffness(&mut k);
            }
            let rows = &links.rows[link.range.clone()];
            let stretch = |row: &[(usize, f64)]| -> f64 {
                row.iter().filter(|(i, _)| falls(*i)).map(|(i, c)| c * down[*i]).sum()
            };
            for (row, own) in rows.iter().zip(k.chunks(coordinates)) {
                let pull: f64 = own.iter().zip(rows).map(|(k, other)| k * stretch(other)).sum();
                let most: f64 = own.iter().map(|k| k.abs()).sum();
                for (i, c) in row {
                    force[*i] += c * pull;
                    size[*i] += c.abs() * most;
                }
            }
            let mut all = rows.iter().flatten().map(|(i, _)| *i);
            if let Some(first) = all.next() {
                all.for_each(|i| join(&mut part, first, i));
            }
        }
        let (mut held, mut most) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n {
            let own = root(&mut part, i);
            held[own] += force[i].abs();
            most[own] += size[i];
            moves[own] |= falls(i);
        }
        let mut free = |i: usize| {
            let own = root(&mut part, i);
            moves[own] && held[own] <= ROUNDING * most[own]
        };
        let mut acts = |a: usize| links.rows[a].iter().any(|(i, _)| free(*i));
        links.links.iter().map(|l| l.range.clone().any(&mut acts)).collect()
    }
}

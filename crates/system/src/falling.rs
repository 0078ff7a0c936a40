//! Bodies that nothing but links holds against gravity: they stand on their contacts, or fall onto them.

use crate::System;

/// A part of the structure falls where moving it down costs less than this share of what its stiffness could ask.
const ROUNDING: f64 = 1e-9;

/// Direction of gravity among the six of a node.
const DOWN: usize = 2;

impl System {
    /// For each link: true where it acts on a part of the structure that would fall without links. A stop between
    /// two frames does not, nor does a bearing under a structure that springs carry.
    #[must_use]
    pub fn on_falling_parts(&self) -> Vec<bool> {
        let n = self.order();
        let falls = |i: usize| self.reduction.free[i] % 6 == DOWN;
        let mut part: Vec<usize> = (0..n).collect();
        for (i, j, _) in self.stiffness.entries().filter(|(_, _, k)| *k != 0.0) {
            let (a, b) = (root(&mut part, i), root(&mut part, j));
            part[a.max(b)] = a.min(b);
        }
        // K t for a unit motion t of all parts along gravity, and the size of its terms.
        let (mut force, mut size, mut moves) = (vec![0.0; n], vec![0.0; n], vec![false; n]);
        for (i, _, k) in self.stiffness.entries().filter(|(_, j, _)| falls(*j)) {
            force[i] += k;
            size[i] += k.abs();
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
        let links = self.links.links.iter();
        links
            .map(|l| l.range.clone().any(|a| self.links.rows[a].iter().any(|(i, _)| free(*i))))
            .collect()
    }
}

/// The first equation of the part that this one belongs to.
fn root(part: &mut [usize], mut i: usize) -> usize {
    while part[i] != i {
        part[i] = part[part[i]];
        i = part[i];
    }
    i
}

//! Nested dissection: an order of elimination that cuts a structure in two, and each half again.
//!
//! ```text
//!   ┌ half │ half ┐      the halves have nothing in common but what is between them,
//!   └──────┼──────┘      which comes last: fill of one never meets that of the other
//!      separator
//! ```
//!
//! Where to cut is seen from the distances to an equation at the end of the structure: a layer in the middle. What is
//! small enough is ordered by minimum degree.
//!
//! References: \[George 1973\]; \[George & Liu 1978\].

use super::ordering::{Pattern, minimum_degree};
use crate::LinalgError;

/// Searches for an equation at the end: each starts where the one before ended.
const SEARCHES: usize = 3;
/// Share of the equations before the layer that cuts.
const MIDDLE: std::ops::Range<f64> = 0.4..0.6;
/// Of no layer.
const NONE: u32 = u32::MAX;

/// Some equations, and how far each is from the first one found.
struct Layers {
    /// In the order in which they were found.
    found: Vec<u32>,
    most: u32,
}

/// The graph, and which equations are looked at.
struct Search<'a> {
    neighbours: &'a Pattern,
    /// Of the set looked at now; others have other numbers.
    set: Vec<u32>,
    layer: Vec<u32>,
    now: u32,
}

/// The order for sets of this many equations at most that are ordered by minimum degree.
pub(super) fn nested(neighbours: &Pattern, smallest: usize) -> Result<Vec<usize>, LinalgError> {
    let n = neighbours.order();
    let mut search = Search { neighbours, set: vec![0; n], layer: vec![NONE; n], now: 0 };
    let mut reversed = Vec::with_capacity(n);
    let mut sets = vec![(0..n as u32).collect::<Vec<u32>>()];
    while let Some(all) = sets.pop() {
        search.look_at(&all);
        if all.len() <= smallest {
            let order = minimum_degree(&search.pattern(&all))?;
            reversed.extend(order.iter().rev().map(|i| all[*i] as usize));
            continue;
        }
        let layers = search.layers_of(&all);
        if layers.found.len() < all.len() {
            let apart = |i: &&u32| search.layer[**i as usize] == NONE;
            sets.push(all.iter().filter(apart).copied().collect());
            sets.push(layers.found);
            continue;
        }
        let [near, cut, far] = search.cut(&layers);
        reversed.extend(cut.iter().map(|i| *i as usize));
        sets.extend([near, far].into_iter().filter(|half| !half.is_empty()));
    }
    reversed.reverse();
    Ok(reversed)
}

impl Search<'_> {
    fn look_at(&mut self, all: &[u32]) {
        self.now += 1;
        for i in all {
            self.set[*i as usize] = self.now;
        }
    }

    fn around(&self, i: u32) -> impl Iterator<Item = u32> {
        let inside = |j: &&usize| self.set[**j] == self.now;
        self.neighbours.column(i as usize).iter().filter(inside).map(|j| *j as u32)
    }

    /// What of the set hangs together with its first equation, by layers from one at its end.
    fn layers_of(&mut self, all: &[u32]) -> Layers {
        let mut found = vec![all[0]];
        let mut most = 0;
        for _ in 0..SEARCHES {
            for i in all {
                self.layer[*i as usize] = NONE;
            }
            let start = found[found.len() - 1];
            found.clear();
            found.push(start);
            (self.layer[start as usize], most) = (0, 0);
            let mut at = 0;
            while let Some(i) = found.get(at).copied() {
                most = self.layer[i as usize];
                for j in self.neighbours.column(i as usize) {
                    if self.set[*j] == self.now && self.layer[*j] == NONE {
                        self.layer[*j] = most + 1;
                        found.push(*j as u32);
                    }
                }
                at += 1;
            }
        }
        Layers { found, most }
    }

    /// What is nearer than the smallest layer in the middle, what of that layer holds both together, and what is beyond it.
    fn cut(&self, layers: &Layers) -> [Vec<u32>; 3] {
        let mut sizes = vec![0_usize; layers.most as usize + 1];
        layers.found.iter().for_each(|i| sizes[self.layer[*i as usize] as usize] += 1);
        let (mut before, mut best) = (0, (usize::MAX, layers.most / 2));
        for (layer, size) in sizes.iter().enumerate() {
            let middle = (before as f64 + 0.5 * *size as f64) / layers.found.len() as f64;
            if MIDDLE.contains(&middle) && *size < best.0 {
                best = (*size, layer as u32);
            }
            before += size;
        }
        let mut parts = [const { Vec::new() }; 3];
        for i in &layers.found {
            let layer = self.layer[*i as usize];
            let holds = || self.around(*i).any(|j| self.layer[j as usize] == best.1 + 1);
            let part = match layer.cmp(&best.1) {
                std::cmp::Ordering::Less => 0,
                std::cmp::Ordering::Equal if holds() => 1,
                std::cmp::Ordering::Equal => 0,
                std::cmp::Ordering::Greater => 2,
            };
            parts[part].push(*i);
        }
        // Where all are one layer nothing is cut.
        if parts[1].is_empty() {
            let [near, _, far] = parts;
            parts = [Vec::new(), [near, far].concat(), Vec::new()];
        }
        parts
    }

    /// The set as a matrix of its own.
    fn pattern(&mut self, all: &[u32]) -> Pattern {
        // Layers are of no use here any more: the place of each.
        for (place, i) in all.iter().enumerate() {
            self.layer[*i as usize] = place as u32;
        }
        let mut own = Pattern { offsets: vec![0], rows: Vec::new() };
        for (place, i) in all.iter().enumerate() {
            let start = own.rows.len();
            own.rows.push(place);
            let after = self.around(*i).map(|j| self.layer[j as usize] as usize);
            own.rows.extend(after.filter(|j| *j > place));
            own.rows[start..].sort_unstable();
            own.offsets.push(own.rows.len());
        }
        own
    }
}

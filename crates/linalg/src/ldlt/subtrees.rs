//! Substitution through a factor that no cache holds: subtrees by threads, each for all right-hand sides.
//!
//! ```text
//!   forward     subtrees, each by itself        what they add to the rows above them, in their order; the nodes above
//!   backward    the nodes above                 subtrees, each by itself
//! ```
//!
//! Such a factor comes from memory, which two threads share: with one right-hand side each both read all of it. A subtree
//! reads its panels once for both, and nobody else reads them. Sums are taken in an order of their own, the same on any
//! number of threads.

use super::numeric::Elimination;
use super::substitution::Panels;
use crate::threads::share;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Values of a factor from which on it is worth it: more than caches hold.
pub(super) const FROM: usize = 1 << 24;

/// Subtrees of all nodes, and the nodes above them.
#[derive(Debug)]
pub(super) struct Subtrees {
    all: Vec<Subtree>,
    above: Vec<Range<usize>>,
}

#[derive(Debug)]
struct Subtree {
    nodes: Range<usize>,
    columns: Range<usize>,
    /// Rows of its nodes above it, rising.
    rows: Vec<u32>,
}

/// The factor of all nodes.
#[derive(Clone, Copy)]
pub(super) struct Factor<'a> {
    pub panels: &'a Panels,
    pub values: &'a [f64],
    pub reciprocal: &'a [f64],
}

/// What one thread needs: vectors of all places, and room for a panel.
struct Room<const K: usize> {
    x: [Vec<f64>; K],
    work: Vec<f64>,
}

/// A subtree, its columns of all vectors, and values of the rows above it.
type Piece<'s, 'x, const K: usize> = (&'s Subtree, [&'x mut [f64]; K], [Vec<f64>; K]);

impl Subtrees {
    /// Those of a factorisation, where there are several. Nodes of a subtree follow each other in a postorder.
    pub(super) fn new(of: &Elimination, panels: &Panels) -> Option<Self> {
        let columns = |nodes: &Range<usize>| {
            let (first, last) = (&panels.nodes[nodes.start], &panels.nodes[nodes.end - 1]);
            first.start as usize..(last.start + last.columns) as usize
        };
        let (mut all, mut above) = (Vec::new(), Vec::<Range<usize>>::new());
        for piece in &of.pieces {
            let (first, last) = (*piece.nodes.first()? as usize, *piece.nodes.last()? as usize);
            let nodes = first..last + 1;
            if nodes.len() != piece.nodes.len() {
                return None;
            }
            if piece.is_above {
                match above.last_mut() {
                    Some(before) if before.end == first => before.end = last + 1,
                    _ => above.push(nodes),
                }
                continue;
            }
            let columns = columns(&nodes);
            let mut rows: Vec<u32> = (panels.nodes[nodes.clone()].iter())
                .flat_map(|node| &panels.rows[node.rows..][..(node.height - node.columns) as usize])
                .copied()
                .filter(|row| *row as usize >= columns.end)
                .collect();
            rows.sort_unstable();
            rows.dedup();
            all.push(Subtree { nodes, columns, rows });
        }
        all.sort_by_key(|subtree| subtree.nodes.start);
        (all.len() > 1).then_some(Self { all, above })
    }

    /// Solves right-hand sides in the order of elimination, in place.
    pub(super) fn solve<const K: usize>(&self, of: Factor<'_>, mut x: [&mut [f64]; K]) {
        let Factor { panels, values, reciprocal } = of;
        let n = reciprocal.len();
        let height = panels.height();
        let rooms: Mutex<Vec<Room<K>>> = Mutex::new(Vec::new());
        let rooms = || rooms.lock().unwrap_or_else(PoisonError::into_inner);
        let new_room = || Room { x: [(); K].map(|()| vec![0.0; n]), work: vec![0.0; K * height] };
        let operations = 2 * K * values.len();

        let mut pieces = self.pieces(&mut x, |_, _| 0.0);
        share(operations, pieces.iter_mut().collect(), |(subtree, own, outside)| {
            let mut room = rooms().pop().unwrap_or_else(new_room);
            subtree.enter(&mut room.x, own, outside);
            let all = room.x.each_mut().map(Vec::as_mut_slice);
            let nodes = &panels.nodes[subtree.nodes.clone()];
            panels.forward_of(nodes, values, all, &mut room.work);
            subtree.leave(&room.x, own, outside);
            rooms().push(room);
        });
        let outside: Vec<[Vec<f64>; K]> = pieces.into_iter().map(|(_, _, rest)| rest).collect();
        let each = x.iter_mut().enumerate().collect();
        share(operations, each, |(k, x)| {
            let mut room = rooms().pop().unwrap_or_else(new_room);
            for (subtree, outside) in self.all.iter().zip(&outside) {
                subtree.rows.iter().zip(&outside[k]).for_each(|(i, more)| x[*i as usize] += more);
            }
            for nodes in &self.above {
                let nodes = &panels.nodes[nodes.clone()];
                panels.forward_of(nodes, values, [&mut **x], &mut room.work);
            }
            for nodes in self.above.iter().rev() {
                let nodes = &panels.nodes[nodes.clone()];
                panels.backward_of(nodes, values, reciprocal, [&mut **x], &mut room.work);
            }
            rooms().push(room);
        });
        let mut pieces = self.pieces(&mut x, |x, i| x[i]);
        share(operations, pieces.iter_mut().collect(), |(subtree, own, outside)| {
            let mut room = rooms().pop().unwrap_or_else(new_room);
            subtree.enter(&mut room.x, own, outside);
            let all = room.x.each_mut().map(Vec::as_mut_slice);
            let nodes = &panels.nodes[subtree.nodes.clone()];
            panels.backward_of(nodes, values, reciprocal, all, &mut room.work);
            subtree.leave(&room.x, own, outside);
            rooms().push(room);
        });
    }

    /// Of each subtree its own columns of all vectors, and values of the rows above it.
    fn pieces<'a, const K: usize>(
        &self,
        x: &'a mut [&mut [f64]; K],
        value: impl Fn(&[f64], usize) -> f64,
    ) -> Vec<Piece<'_, 'a, K>> {
        let outside = |subtree: &Subtree, x: &[f64]| -> Vec<f64> {
            subtree.rows.iter().map(|i| value(x, *i as usize)).collect()
        };
        let values: Vec<[Vec<f64>; K]> =
            self.all.iter().map(|one| x.each_ref().map(|x| outside(one, x))).collect();
        let mut rest = x.each_mut().map(|x| &mut **x);
        let mut at = 0;
        let mut pieces = Vec::with_capacity(self.all.len());
        for (subtree, values) in self.all.iter().zip(values) {
            let Range { start, end } = subtree.columns;
            let skipped = start - at;
            at = end;
            let mut own: [&mut [f64]; K] = [(); K].map(|()| &mut [][..]);
            for (own, rest) in own.iter_mut().zip(&mut rest) {
                let (_, from) = std::mem::take(rest).split_at_mut(skipped);
                let (columns, others) = from.split_at_mut(end - start);
                (*own, *rest) = (columns, others);
            }
            pieces.push((subtree, own, values));
        }
        pieces
    }
}

impl Subtree {
    /// Brings its columns and rows to where its nodes look for them.
    fn enter<const K: usize>(
        &self,
        all: &mut [Vec<f64>; K],
        own: &[&mut [f64]; K],
        outside: &[Vec<f64>; K],
    ) {
        for (all, (own, outside)) in all.iter_mut().zip(own.iter().zip(outside)) {
            all[self.columns.clone()].copy_from_slice(own);
            self.rows.iter().zip(outside).for_each(|(i, x)| all[*i as usize] = *x);
        }
    }

    /// Takes them back.
    fn leave<const K: usize>(
        &self,
        all: &[Vec<f64>; K],
        own: &mut [&mut [f64]; K],
        outside: &mut [Vec<f64>; K],
    ) {
        for (all, (own, outside)) in all.iter().zip(own.iter_mut().zip(outside)) {
            own.copy_from_slice(&all[self.columns.clone()]);
            self.rows.iter().zip(outside).for_each(|(i, x)| *x = all[*i as usize]);
        }
    }
}

//! Where a lane ends as no model is meant to: the ordinary engine then has something to say of it.

use super::uncoupled::turned;
use crate::checks::{FAR, PRESSED, size};
use crate::structure::ReducedSystem;
use trilith_linalg::Dense;
use trilith_model::Model;
use trilith_system::System;

/// The place of every node over the modes of a lane, and the size of the model.
#[derive(Debug)]
pub(super) struct Watch {
    /// Largest extent of the model, m; none of a point.
    size: Option<f64>,
    /// Displacements of each node along the axes.
    places: Vec<[Vec<f64>; 3]>,
}

impl Watch {
    /// `turn`: modes of the space over those of the lane.
    pub fn new(model: &Model, system: &System, space: &ReducedSystem, turn: &Dense) -> Self {
        let order = system.order();
        let along = |full: usize| {
            let free = system.reduction.expand(full).iter().filter(|(j, _)| *j < order);
            let mut row = vec![0.0; space.order()];
            space.row(&free.copied().collect::<Vec<_>>()).iter().for_each(|(j, c)| row[*j] += c);
            turned(turn, &row)
        };
        let place = |node: usize| [0, 1, 2].map(|axis| along(6 * node + axis));
        Self { size: size(model), places: (0..model.nodes.len()).map(place).collect() }
    }

    /// True where a node has left, or a contact was pressed in deeper than the size of the model explains; `q`: modes
    /// at the end, `depth`: of the deepest contact, m.
    pub fn notices(&self, q: &[f64], depth: f64) -> bool {
        let along = |row: &Vec<f64>| row.iter().zip(q).map(|(c, q)| c * q).sum::<f64>();
        let moved = |place: &[Vec<f64>; 3]| place.iter().map(|row| along(row).powi(2)).sum::<f64>();
        let farthest = self.places.iter().map(moved).fold(0.0, f64::max).sqrt();
        match self.size {
            Some(size) => farthest > size || depth > PRESSED * size,
            None => farthest > FAR,
        }
    }
}

//! What a run shows while it goes on.

use super::energy::EnergyTotals;
use trilith_element::{Contact, Vector3};

/// A moment of a run, shown after every accepted substep.
pub struct Sample<'a> {
    /// Time, s.
    pub t: f64,
    /// Index of the output step where `t` is an output time (0 = start of the case).
    pub output_step: Option<usize>,
    /// Values of the model's outputs, in its order, SI.
    pub values: &'a [f64],
    /// Their time derivatives where they are known (displacements), NaN elsewhere.
    pub rates: &'a [f64],
    /// Energies so far.
    pub energy: &'a EnergyTotals,
    /// What every contact does: (index of the element in the model, contact).
    pub contacts: &'a [(usize, Contact)],
    /// Index of the element of a body that has fallen over.
    pub overturned: Option<usize>,
    /// Deformations of all links, coordinates of link after link in the model's order, m or rad.
    pub deformation: &'a [f64],
    /// Their forces in the same order, N or N·m.
    pub force: &'a [f64],
    /// Horizontal force on supports and ground along X and Y, N; not numbers where no observer wants it.
    pub base_shear: [f64; 2],
    /// Displacements of the structure on request.
    pub shape: &'a dyn Shape,
}

/// Displacements of all nodes.
pub trait Shape {
    /// What the displacements come from at this moment: coordinates of a solver and moved supports, as many at every moment
    /// of a run.
    fn pose(&self) -> Vec<f64>;

    /// Six displacements of every node, node after node (m, rad), for each of some poses of this run, one after the other;
    /// `u` has 6 · nodes values for each. A basis is read once for all of them: in a large model many cost little more
    /// than one.
    fn displacements(&self, poses: &[Vec<f64>], u: &mut [f64]);

    /// Adds where the points of the outlines of links are, link after link in the model's order: global
    /// axes, m, each from the place of the link's first node without displacement.
    fn outlines(&self, _points: &mut Vec<Vector3>) {}
}

/// Watches a run.
pub trait Observer {
    /// Called once before the first sample: at most so many output steps follow that one.
    fn start(&mut self, _steps: usize) {}

    /// Called at the start and after every accepted substep, in time order.
    fn sample(&mut self, sample: &Sample<'_>);

    /// Called between two samples for moments inside a long step, in time order, with the outputs and their rates
    /// there: for extremes.
    fn between(&mut self, _t: f64, _values: &[f64], _rates: &[f64]) {}

    /// Called once where the run ends, wherever that is, with the last sample again.
    fn end(&mut self, _sample: &Sample<'_>) {}

    /// False where it never looks at the rates of a sample: where no observer does, nobody makes them, and they
    /// are not numbers.
    fn wants_rates(&self) -> bool {
        true
    }

    /// True where it looks at the base shear of a sample.
    fn wants_base_shear(&self) -> bool {
        false
    }
}

//! Deformed shapes, evenly spaced over a run.

use crate::spacing::Spacing;
use trilith_element::Vector3;
use trilith_solvers::Shape;

/// A deformed shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Time, s.
    pub t: f64,
    /// Six displacements of every node, node after node (m, rad).
    pub displacements: Vec<f32>,
    /// Places of the points of the outlines of links, link after link, each from the first node of its link
    /// without displacement, m.
    pub outlines: Vec<[f32; 3]>,
}

/// Keeps so many deformed shapes at most, those of the start and of the end among them. No others are asked for: in a
/// large model a shape costs more than a step.
#[derive(Clone, Debug)]
pub struct Frames {
    limit: usize,
    spacing: Spacing,
    kept: Vec<Frame>,
    buffer: Vec<f64>,
    points: Vec<Vector3>,
}

impl Frames {
    /// Keeps up to `limit` shapes of `nodes` nodes; fewer than two, start and end, are none.
    #[must_use]
    pub fn new(nodes: usize, limit: usize) -> Self {
        let buffer = vec![0.0; 6 * nodes];
        Self { limit, spacing: Spacing::new(limit), kept: Vec::new(), buffer, points: Vec::new() }
    }

    /// The shapes kept, in time order, evenly spaced but for the last.
    pub fn iter(&self) -> impl Iterator<Item = &Frame> {
        self.kept.iter()
    }

    /// A run of so many output steps starts.
    pub(crate) fn start(&mut self, steps: usize) {
        self.spacing.start(steps);
    }

    /// The next output time.
    pub(crate) fn take(&mut self, t: f64, shape: &dyn Shape) {
        if self.spacing.picks() {
            self.keep(t, shape);
        }
    }

    /// The run ends there.
    pub(crate) fn end(&mut self, t: f64, shape: &dyn Shape) {
        if self.kept.last().is_none_or(|last| last.t != t) {
            self.keep(t, shape);
        }
    }

    fn keep(&mut self, t: f64, shape: &dyn Shape) {
        if self.limit < 2 {
            return;
        }
        shape.displacements(&mut self.buffer);
        self.points.clear();
        shape.outlines(&mut self.points);
        self.kept.push(Frame {
            t,
            displacements: self.buffer.iter().map(|u| *u as f32).collect(),
            outlines: self.points.iter().map(|p| p.map(|x| x as f32)).collect(),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[derive(Default)]
    struct Still {
        asked: Cell<usize>,
    }

    impl Shape for Still {
        fn displacements(&self, u: &mut [f64]) {
            self.asked.set(self.asked.get() + 1);
            u.fill(0.5);
        }
    }

    fn times(limit: usize, steps: usize, made: usize) -> Vec<f64> {
        let (mut frames, shape) = (Frames::new(1, limit), Still::default());
        frames.start(steps);
        (0..=made).for_each(|step| frames.take(step as f64, &shape));
        frames.end(made as f64, &shape);
        let times: Vec<f64> = frames.iter().map(|f| f.t).collect();
        assert_eq!(shape.asked.get(), times.len(), "no shape is made that is not kept");
        times
    }

    #[test]
    fn frames_are_evenly_spaced_and_hold_start_and_end() {
        for (limit, steps) in [(10, 1003), (10, 1000), (10, 9), (10, 4), (2, 7), (200, 4000)] {
            let times = times(limit, steps, steps);
            assert!((limit.min(steps + 1) / 2..=limit).contains(&times.len()), "{times:?}");
            assert_eq!((times[0], *times.last().unwrap()), (0.0, steps as f64));
            let even = &times[..times.len() - 1];
            assert!(even.windows(3).all(|w| w[1] - w[0] == w[2] - w[1]), "{times:?}");
        }
    }

    #[test]
    fn a_run_that_stops_on_the_way_shows_where() {
        assert_eq!(times(5, 8, 5), [0.0, 2.0, 4.0, 5.0]);
        assert_eq!(times(5, 0, 0), [0.0]);
    }

    #[test]
    fn no_frames_cost_nothing() {
        assert!(times(0, 10, 10).is_empty() && times(1, 10, 10).is_empty());
    }
}

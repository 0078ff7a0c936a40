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

/// Shapes made together: as many as fit into so many bytes, and at most so many.
const TOGETHER: usize = 64 << 20;
const MOST: usize = 16;

/// Keeps so many deformed shapes at most, those of the start and of the end among them. No others are asked for: in a
/// large model a shape costs more than a step.
#[derive(Clone, Debug)]
pub struct Frames {
    limit: usize,
    spacing: Spacing,
    /// The last of them, as many as there are poses, have no displacements yet.
    kept: Vec<Frame>,
    poses: Vec<Vec<f64>>,
    /// Displacements of a shape.
    directions: usize,
    points: Vec<Vector3>,
}

impl Frames {
    /// Keeps up to `limit` shapes of `nodes` nodes; fewer than two, start and end, are none.
    #[must_use]
    pub fn new(nodes: usize, limit: usize) -> Self {
        let (kept, poses, points) = (Vec::new(), Vec::new(), Vec::new());
        let spacing = Spacing::new(limit);
        Self { limit, spacing, kept, poses, directions: 6 * nodes, points }
    }

    /// The shapes kept, in time order, evenly spaced but for the last. While a run goes on the latest may not be made yet.
    pub fn iter(&self) -> impl Iterator<Item = &Frame> {
        self.kept[..self.kept.len() - self.poses.len()].iter()
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
        self.make(shape);
    }

    fn keep(&mut self, t: f64, shape: &dyn Shape) {
        if self.limit < 2 {
            return;
        }
        self.points.clear();
        shape.outlines(&mut self.points);
        let outlines = self.points.iter().map(|p| p.map(|x| x as f32)).collect();
        self.kept.push(Frame { t, displacements: Vec::new(), outlines });
        self.poses.push(shape.pose());
        let room = TOGETHER / (size_of::<f64>() * self.directions.max(1));
        if self.poses.len() >= room.clamp(1, MOST) {
            self.make(shape);
        }
    }

    /// Displacements of those that have none yet.
    fn make(&mut self, shape: &dyn Shape) {
        if self.poses.is_empty() {
            return;
        }
        let poses = std::mem::take(&mut self.poses);
        let mut all = vec![0.0; self.directions * poses.len()];
        shape.displacements(&poses, &mut all);
        let first = self.kept.len() - poses.len();
        let each = all.chunks(self.directions.max(1));
        for (frame, u) in self.kept[first..].iter_mut().zip(each) {
            frame.displacements = u.iter().map(|u| *u as f32).collect();
        }
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
        fn pose(&self) -> Vec<f64> {
            self.asked.set(self.asked.get() + 1);
            vec![self.asked.get() as f64]
        }

        fn displacements(&self, poses: &[Vec<f64>], u: &mut [f64]) {
            u.chunks_mut(6).zip(poses).for_each(|(u, pose)| u.fill(pose[0]));
        }
    }

    fn times(limit: usize, steps: usize, made: usize) -> Vec<f64> {
        let (mut frames, shape) = (Frames::new(1, limit), Still::default());
        frames.start(steps);
        (0..=made).for_each(|step| frames.take(step as f64, &shape));
        frames.end(made as f64, &shape);
        let times: Vec<f64> = frames.iter().map(|f| f.t).collect();
        assert_eq!(shape.asked.get(), times.len(), "no shape is made that is not kept");
        let has_own = |(i, frame): (usize, &Frame)| frame.displacements == [(i + 1) as f32; 6];
        assert!(frames.iter().enumerate().all(has_own), "each shape has its own displacements");
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

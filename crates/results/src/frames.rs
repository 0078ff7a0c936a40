//! Deformed shapes, evenly thinned while a run goes on.

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

/// Keeps at most so many deformed shapes: when they become too many, every second one goes and from
/// then on only every second comes. Memory is bounded whatever the length of the run.
#[derive(Clone, Debug)]
pub struct Frames {
    limit: usize,
    stride: usize,
    kept: Vec<Frame>,
    last: Option<Frame>,
    buffer: Vec<f64>,
    points: Vec<Vector3>,
}

impl Frames {
    /// Keeps up to `limit` shapes of `nodes` nodes; 0 keeps none.
    #[must_use]
    pub fn new(nodes: usize, limit: usize) -> Self {
        let buffer = vec![0.0; 6 * nodes];
        // The last moment is kept beside the evenly spaced ones.
        Self {
            limit: limit.saturating_sub(1),
            stride: 1,
            kept: Vec::new(),
            last: None,
            buffer,
            points: Vec::new(),
        }
    }

    /// The shapes kept, in time order; the last output time is always among them.
    pub fn iter(&self) -> impl Iterator<Item = &Frame> {
        let t = self.kept.last().map(|f| f.t);
        self.kept.iter().chain(self.last.iter().filter(move |f| Some(f.t) != t))
    }

    pub(crate) fn take(&mut self, step: usize, t: f64, shape: &dyn Shape) {
        if self.limit == 0 {
            return;
        }
        shape.displacements(&mut self.buffer);
        self.points.clear();
        shape.outlines(&mut self.points);
        let last = self.last.get_or_insert_with(|| Frame {
            t,
            displacements: Vec::new(),
            outlines: Vec::new(),
        });
        last.t = t;
        last.displacements.clear();
        last.displacements.extend(self.buffer.iter().map(|u| *u as f32));
        last.outlines.clear();
        last.outlines.extend(self.points.iter().map(|p| p.map(|x| x as f32)));
        if step.is_multiple_of(self.stride) {
            if self.kept.len() == self.limit {
                let mut even = false;
                self.kept.retain(|_| {
                    even = !even;
                    even
                });
                self.stride *= 2;
            }
            if step.is_multiple_of(self.stride) {
                self.kept.push(last.clone());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Still;
    impl Shape for Still {
        fn displacements(&self, u: &mut [f64]) {
            u.fill(0.5);
        }
    }

    #[test]
    fn frames_are_evenly_thinned_and_keep_start_and_end() {
        let mut frames = Frames::new(1, 10);
        for step in 0..=1003 {
            frames.take(step, step as f64, &Still);
        }
        let times: Vec<f64> = frames.iter().map(|f| f.t).collect();
        assert!((5..=10).contains(&times.len()), "{times:?}");
        assert_eq!((times[0], *times.last().unwrap()), (0.0, 1003.0));
        let steps: Vec<f64> = times[..times.len() - 1].windows(2).map(|w| w[1] - w[0]).collect();
        assert!(steps.iter().all(|s| *s == steps[0]), "{times:?}");
    }

    #[test]
    fn no_frames_cost_nothing() {
        let mut frames = Frames::new(1, 0);
        frames.take(0, 0.0, &Still);
        assert_eq!(frames.iter().count(), 0);
    }
}

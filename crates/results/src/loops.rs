//! Deformation and force of the links, kept for their hysteresis loops.

use crate::spacing::Spacing;
use trilith_model::{Body, Model};

/// Numbers kept at most.
const ROOM: usize = 4_000_000;
/// Moments kept at most, and at least whatever the number of links.
const MOMENTS: (usize, usize) = (500, 20_000);

/// A moment of a link coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopPoint {
    /// Time, s.
    pub t: f64,
    /// Deformation, m or rad.
    pub d: f64,
    /// Force, N or N·m.
    pub f: f64,
}

/// Keeps deformation and force of every link coordinate at output times, all or, in long runs, evenly spaced ones:
/// memory is bounded whatever the length of the run. Single precision.
#[derive(Clone, Debug)]
pub struct Loops {
    /// (element, first coordinate in the flat arrays, number of coordinates).
    links: Vec<(usize, usize, usize)>,
    /// Coordinates of all links.
    width: usize,
    spacing: Spacing,
    t: Vec<f64>,
    /// Deformations, then forces, moment after moment.
    values: Vec<f32>,
}

impl Loops {
    /// For the links of a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let (mut links, mut width) = (Vec::new(), 0);
        for (element, e) in model.elements.iter().enumerate() {
            if let Body::Link(law, _) = &e.body {
                let n = law.coordinates().len();
                links.push((element, width, n));
                width += n;
            }
        }
        let limit = (ROOM / (2 * width).max(1)).clamp(MOMENTS.0, MOMENTS.1);
        Self::of(links, width, limit)
    }

    /// None.
    pub(crate) fn none() -> Self {
        Self::of(Vec::new(), 0, 0)
    }

    fn of(links: Vec<(usize, usize, usize)>, width: usize, limit: usize) -> Self {
        Self { links, width, spacing: Spacing::new(limit), t: Vec::new(), values: Vec::new() }
    }

    /// Elements that are links, with the number of their coordinates.
    pub fn links(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.links.iter().map(|(element, _, n)| (*element, *n))
    }

    /// Output steps from one moment to the next: 1 where nothing was left out.
    #[must_use]
    pub fn stride(&self) -> usize {
        self.spacing.stride()
    }

    /// The moments of a coordinate of a link, by the index of the element; none for other elements.
    pub fn coordinate(
        &self,
        element: usize,
        coordinate: usize,
    ) -> impl Iterator<Item = LoopPoint> + '_ {
        let link = self.links.iter().find(|l| l.0 == element && coordinate < l.2);
        let at = link.map(|l| l.1 + coordinate);
        let moments = self.t.iter().zip(self.values.chunks(2 * self.width.max(1)));
        at.into_iter().flat_map(move |at| {
            moments.clone().map(move |(t, x)| LoopPoint {
                t: *t,
                d: x.get(at).copied().map_or(f64::NAN, f64::from),
                f: x.get(self.width + at).copied().map_or(f64::NAN, f64::from),
            })
        })
    }

    /// A run of so many output steps starts.
    pub(crate) fn start(&mut self, steps: usize) {
        self.spacing.start(steps);
    }

    /// The next output time.
    pub(crate) fn take(&mut self, t: f64, deformation: &[f64], force: &[f64]) {
        if self.width == 0 || deformation.len() != self.width || !self.spacing.picks() {
            return;
        }
        self.t.push(t);
        self.values.extend(deformation.iter().chain(force).map(|x| *x as f32));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_run_keeps_every_nth_moment() {
        let mut loops = Loops::of(vec![(3, 0, 2)], 2, 10);
        loops.start(1003);
        for step in 0..=1003_u32 {
            let x = f64::from(step);
            loops.take(x, &[x, 2.0 * x], &[3.0 * x, 4.0 * x]);
        }
        let kept: Vec<LoopPoint> = loops.coordinate(3, 1).collect();
        assert!((5..=10).contains(&kept.len()), "{kept:?}");
        let steps: Vec<f64> = kept.windows(2).map(|w| w[1].t - w[0].t).collect();
        assert!(steps.iter().all(|s| *s == loops.stride() as f64), "{steps:?}");
        assert!(kept.iter().all(|p| p.d == 2.0 * p.t && p.f == 4.0 * p.t), "{kept:?}");
        assert_eq!(loops.coordinate(3, 2).count() + loops.coordinate(0, 0).count(), 0);
    }
}

//! How far bearings travel.

use serde::{Deserialize, Serialize};
use trilith_element::Contact;

/// What the bearings of a model saw.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BearingSummary {
    /// Number of bearings.
    pub bearings: usize,
    /// Largest distance of one of them from its centre, m.
    pub max_travel: f64,
    /// When that was, s.
    pub time: f64,
    /// The link that had it; none where none moved.
    pub farthest: Option<String>,
    /// Largest distance from the centre at the end, m.
    pub residual_travel: f64,
    /// Largest gap of one of them, m; 0 where none was lifted.
    pub max_uplift: f64,
}

/// What was seen of bearings so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Bearings {
    count: usize,
    largest: f64,
    time: f64,
    /// Index of its element.
    farthest: Option<usize>,
    last: f64,
    uplift: f64,
}

impl Bearings {
    /// What the bearings do at a time, each with the index of its element; always the same ones.
    pub(crate) fn enter(&mut self, t: f64, now: impl Iterator<Item = (usize, Contact)>) {
        (self.count, self.last) = (0, 0.0);
        for (element, c) in now {
            let travel = c.position[0].hypot(c.position[1]);
            self.count += 1;
            self.last = self.last.max(travel);
            self.uplift = self.uplift.max(c.gap);
            if travel > self.largest {
                (self.largest, self.time, self.farthest) = (travel, t, Some(element));
            }
        }
    }

    /// The summary; none for a model without bearings.
    pub(crate) fn summary(&self, name: impl Fn(usize) -> Option<String>) -> Option<BearingSummary> {
        (self.count > 0).then(|| BearingSummary {
            bearings: self.count,
            max_travel: self.largest,
            time: self.time,
            farthest: self.farthest.and_then(name),
            residual_travel: self.last,
            max_uplift: self.uplift,
        })
    }
}

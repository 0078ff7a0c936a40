//! How often and how hard stops are hit.

use serde::{Deserialize, Serialize};
use trilith_element::Contact;

/// What the stops of a model saw.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StopSummary {
    /// Number of stops.
    pub stops: usize,
    /// How often one of them was hit: pressed after it had stood open.
    pub hits: usize,
    /// Largest force that pressed one of them, N.
    pub largest_force: f64,
    /// When that was, s.
    pub time: f64,
    /// The link that had it; none where none was pressed.
    pub hardest: Option<String>,
}

/// What was seen of stops so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Stops {
    hits: usize,
    largest: f64,
    time: f64,
    /// Index of its element.
    hardest: Option<usize>,
    /// For each stop: true where it has stood open since it was last pressed.
    open: Vec<bool>,
}

impl Stops {
    /// What the contacts of stops do at a time, each with the index of its element; always the same ones, those of one
    /// element behind each other, which are one stop.
    pub(crate) fn enter(&mut self, t: f64, now: impl Iterator<Item = (usize, Contact)>) {
        let mut now = now.peekable();
        let mut i = 0;
        while let Some((element, Contact { mut gap, mut normal, .. })) = now.next() {
            while let Some((_, beside)) = now.next_if(|(other, _)| *other == element) {
                (gap, normal) = (gap.min(beside.gap), normal + beside.normal);
            }
            if i == self.open.len() {
                self.open.push(false);
            }
            if gap > 0.0 {
                self.open[i] = true;
            } else if self.open[i] && normal > 0.0 {
                self.open[i] = false;
                self.hits += 1;
            }
            if normal > self.largest {
                (self.largest, self.time, self.hardest) = (normal, t, Some(element));
            }
            i += 1;
        }
    }

    /// The summary; none for a model without stops.
    pub(crate) fn summary(&self, name: impl Fn(usize) -> Option<String>) -> Option<StopSummary> {
        (!self.open.is_empty()).then(|| StopSummary {
            stops: self.open.len(),
            hits: self.hits,
            largest_force: self.largest,
            time: self.time,
            hardest: self.hardest.and_then(name),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hit_is_what_presses_after_it_stood_open() {
        let mut stops = Stops::default();
        // Pressed from the start, off and on, off and on again while it touches without force on the way.
        let path = [
            (-0.1, 5.0),
            (-0.2, 9.0),
            (0.1, 0.0),
            (0.0, 0.0),
            (-0.1, 4.0),
            (-0.3, 7.0),
            (0.2, 0.0),
        ];
        for (i, (gap, normal)) in path.into_iter().enumerate() {
            let stop = Contact::new(gap, normal);
            stops.enter(i as f64, [(3, stop), (8, Contact::new(1.0, normal))].into_iter());
        }
        let summary = stops.summary(|element| Some(format!("e{element}"))).unwrap();
        let StopSummary { stops, hits, largest_force, time, hardest } = summary;
        assert_eq!((stops, hits, largest_force, time), (2, 1, 9.0, 1.0));
        assert_eq!(hardest.as_deref(), Some("e3"));
    }

    #[test]
    fn contacts_of_one_element_are_one_stop() {
        let mut stops = Stops::default();
        for (i, [a, b]) in [[1.0, 1.0], [-0.1, 0.2], [-0.2, -0.1]].into_iter().enumerate() {
            let of = |gap: f64| Contact::new(gap, (-10.0 * gap).max(0.0));
            stops.enter(i as f64, [(3, of(a)), (3, of(b))].into_iter());
        }
        let summary = stops.summary(|element| Some(format!("e{element}"))).unwrap();
        assert_eq!((summary.stops, summary.hits, summary.largest_force), (1, 1, 3.0));
    }
}

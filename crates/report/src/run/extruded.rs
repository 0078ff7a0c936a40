//! Members as solids: the outlines of their sections, put up in space.

use trilith_element::Vector3;
use trilith_model::Element;

/// Outlines told at most; members beyond stay lines.
const OUTLINES: usize = 400;

/// Distinct outlines, each as its corners from the axis of a member, m, in global axes.
#[derive(Debug, Default)]
pub(super) struct Outlines {
    pub all: Vec<Vec<Vector3>>,
    /// Sections and axes met last: neighbours have the same ones.
    last: Option<usize>,
}

impl Outlines {
    /// Index of the outline of a member, where it has a section that says what it looks like.
    pub(super) fn of(&mut self, e: &Element) -> Option<usize> {
        let [_, two, three] = e.frame.0;
        let place = |[y, z]: [f64; 2]| [0, 1, 2].map(|i| round(two[i] * y + three[i] * z));
        let outline: Vec<Vector3> = e.section?.outline().into_iter().map(place).collect();
        let found = self.last.filter(|i| self.all[*i] == outline);
        let found = found.or_else(|| self.all.iter().position(|o| *o == outline));
        self.last = found.or_else(|| {
            let room = self.all.len() < OUTLINES;
            room.then(|| self.all.push(outline)).map(|()| self.all.len() - 1)
        });
        self.last
    }
}

/// To a hundredth of a millimetre: finer than any picture, and short.
fn round(x: f64) -> f64 {
    // Adding zero makes −0 a zero.
    (x * 1e5).round() / 1e5 + 0.0
}

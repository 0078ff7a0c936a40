//! Nodes and members of a frame, in the order of the file.

use super::Frame;
use std::fmt;

/// A joint by its grid lines and level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Joint {
    pub i: usize,
    pub j: usize,
    pub k: usize,
}

impl fmt::Display for Joint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.i, self.j, self.k)
    }
}

/// Which section a member has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    Column,
    Beam,
    BaseBeam,
}

impl Use {
    pub fn name(self) -> &'static str {
        match self {
            Self::Column => "column",
            Self::Beam => "beam",
            Self::BaseBeam => "base beam",
        }
    }
}

/// A member from joint to joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    pub start: Joint,
    pub end: Joint,
    pub section: Use,
}

impl Member {
    fn letter(&self) -> char {
        if self.section == Use::Column {
            'z'
        } else if self.start.i < self.end.i {
            'x'
        } else {
            'y'
        }
    }

    /// Name of the member, or of its part `cut` of several.
    pub fn name(&self, cut: usize, cuts: usize) -> String {
        let (letter, start) = (self.letter(), self.start);
        if cuts == 1 {
            format!("{letter} {start}")
        } else {
            format!("{letter} {start} part {}", cut + 1)
        }
    }

    /// Name of the node after `cut` parts of several.
    pub fn node(&self, cut: usize, cuts: usize) -> String {
        match cut {
            0 => self.start.to_string(),
            n if n == cuts => self.end.to_string(),
            n => format!("{} {} {n}", self.letter(), self.start),
        }
    }
}

impl Frame {
    /// All joints, level after level.
    pub(super) fn all_joints(&self) -> impl Iterator<Item = Joint> + use<> {
        let ([x, y], storeys) = (self.bays, self.storeys);
        (0..=storeys)
            .flat_map(move |k| (0..=y).flat_map(move |j| (0..=x).map(move |i| Joint { i, j, k })))
    }

    /// Columns storey after storey, then the beams of each level along X and along Y.
    pub(super) fn all_members(&self) -> Vec<Member> {
        let [x, y] = self.bays;
        let mut all = Vec::with_capacity(self.members());
        for start in self.all_joints().filter(|at| at.k < self.storeys) {
            let end = Joint { k: start.k + 1, ..start };
            all.push(Member { start, end, section: Use::Column });
        }
        for k in 0..=self.storeys {
            let section = if k == 0 { Use::BaseBeam } else { Use::Beam };
            for j in 0..=y {
                for i in 0..x {
                    let (start, end) = (Joint { i, j, k }, Joint { i: i + 1, j, k });
                    all.push(Member { start, end, section });
                }
            }
            for j in 0..y {
                for i in 0..=x {
                    let (start, end) = (Joint { i, j, k }, Joint { i, j: j + 1, k });
                    all.push(Member { start, end, section });
                }
            }
        }
        all
    }

    /// Place of a joint, m.
    pub(super) fn place(&self, at: Joint) -> [f64; 3] {
        [at.i as f64 * self.bay, at.j as f64 * self.bay, at.k as f64 * self.storey]
    }
}

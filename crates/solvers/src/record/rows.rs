//! Recorded quantities as rows over the coordinates of a solver.

use crate::structure::ReducedSystem;
use trilith_model::{Combine, LinkTerm, Model, NodalTerm, Quantity};
use trilith_system::{LinkInstance, System};

/// One output, ready to be evaluated.
pub(crate) enum Row {
    /// Σ on displacements (0), velocities (1) or accelerations (2).
    Nodal {
        order: usize,
        own: Vec<(usize, f64)>,
        support: Vec<(usize, f64)>,
        base: [f64; 3],
    },
    Deformation {
        flat: usize,
        factor: f64,
    },
    /// Σ on forces of links.
    Force {
        terms: Vec<(usize, f64)>,
    },
    History {
        at: usize,
    },
    Element {
        stiffness: Split,
        damping: Split,
    },
    /// Of the rows before.
    Combination {
        how: Combine,
        constant: f64,
        terms: Vec<(usize, f64)>,
    },
}

/// Terms (index, factor) on the coordinates of the solver and on prescribed displacements.
pub(super) type Split = (Vec<(usize, f64)>, Vec<(usize, f64)>);

impl Row {
    /// True where it needs moving supports.
    pub(super) fn is_supported(&self) -> bool {
        match self {
            Self::Nodal { support, .. } => !support.is_empty(),
            Self::Element { stiffness, damping } => {
                !(stiffness.1.is_empty() && damping.1.is_empty())
            }
            _ => false,
        }
    }
}

/// Makes rows of quantities.
pub(super) struct Maker<'a> {
    pub model: &'a Model,
    pub system: &'a System,
    pub space: &'a ReducedSystem,
}

impl Maker<'_> {
    pub(super) fn row(&self, quantity: &Quantity) -> Row {
        match quantity {
            Quantity::Displacement(terms) => self.nodal(terms, 0, false),
            Quantity::Velocity(terms) => self.nodal(terms, 1, false),
            Quantity::Acceleration { terms, absolute } => self.nodal(terms, 2, *absolute),
            Quantity::LinkDeformation { element, coordinate, factor } => {
                Row::Deformation { flat: self.flat(*element, *coordinate), factor: *factor }
            }
            Quantity::LinkForce(terms) => {
                let term = |t: &LinkTerm| (self.flat(t.element, t.coordinate), t.factor);
                Row::Force { terms: terms.iter().map(term).collect() }
            }
            Quantity::LinkHistory { element, field } => {
                Row::History { at: self.link(*element).map_or(0, |l| l.history.start + field) }
            }
            Quantity::Combination { how, constant, terms } => {
                Row::Combination { how: *how, constant: *constant, terms: terms.clone() }
            }
            Quantity::ElementForce { elements, end, dof, factor } => {
                let (mut stiffness, mut damping) = (Vec::new(), Vec::new());
                for element in elements {
                    let row = self.system.end_force(self.model, *element, *end, *dof);
                    stiffness.extend(row.stiffness.iter().map(|(i, c)| (*i, factor * c)));
                    damping.extend(row.damping.iter().map(|(i, c)| (*i, factor * c)));
                }
                Row::Element { stiffness: self.split(&stiffness), damping: self.split(&damping) }
            }
        }
    }

    fn nodal(&self, terms: &[NodalTerm], order: usize, absolute: bool) -> Row {
        let mut full = Vec::new();
        let mut base = [0.0; 3];
        for t in terms {
            let expanded = self.system.reduction.expand(6 * t.node + t.dof.index());
            full.extend(expanded.iter().map(|(i, c)| (*i, t.factor * c)));
            if absolute && !t.dof.is_rotation() {
                base[t.dof.index()] += t.factor;
            }
        }
        let (own, support) = self.split(&full);
        Row::Nodal { order, own, support, base }
    }

    /// Terms on free and on prescribed DOFs.
    fn split(&self, terms: &[(usize, f64)]) -> Split {
        let n = self.system.order();
        let free: Vec<_> = terms.iter().filter(|(i, _)| *i < n).copied().collect();
        let support: Vec<_> =
            terms.iter().filter(|(i, _)| *i >= n).map(|(i, c)| (i - n, *c)).collect();
        (self.space.row(&free), support)
    }

    fn link(&self, element: usize) -> Option<&LinkInstance> {
        self.system.links.links.iter().find(|l| l.element == element)
    }

    /// Flat index of a link coordinate.
    fn flat(&self, element: usize, coordinate: usize) -> usize {
        self.link(element).map_or(0, |l| l.range.start + coordinate)
    }

    /// What a deformation of a link takes from the motion; nothing for other rows.
    pub(super) fn stretch(&self, row: &Row) -> Vec<(usize, f64)> {
        let Row::Deformation { flat, factor } = row else { return Vec::new() };
        let active = self.system.links.active.iter().position(|i| i == flat);
        active.map_or_else(Vec::new, |a| {
            self.space.links.row(a).map(|(j, c)| (j, factor * c)).collect()
        })
    }
}

//! Recorded quantities as rows over the coordinates of a solver.

use super::base_shear;
use crate::structure::ReducedSystem;
use std::sync::Arc;
use trilith_element::{DerivedOutput, Dof, Vector3, sub};
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
    /// Of elements, and Σ on forces of links.
    Internal(Internal),
    /// Of the rows before.
    Combination {
        how: Combine,
        constant: f64,
        terms: Vec<(usize, f64)>,
    },
    /// Of the rows before, by another crate.
    Derived {
        output: Arc<dyn DerivedOutput>,
        of: Vec<usize>,
    },
}

/// Terms (index, factor) on the coordinates of the solver and on prescribed displacements.
pub(crate) type Split = (Vec<(usize, f64)>, Vec<(usize, f64)>);

/// A force inside the structure.
#[derive(Default)]
pub(crate) struct Internal {
    pub(crate) stiffness: Split,
    pub(crate) damping: Split,
    /// (flat index, share).
    pub(crate) links: Vec<(usize, f64)>,
    /// What loads along members have a share in: (index of a pattern, or behind them the weight; share).
    pub(crate) loads: Vec<(usize, f64)>,
}

impl Internal {
    /// True where moving supports have a share.
    pub(super) fn is_supported(&self) -> bool {
        !(self.stiffness.1.is_empty() && self.damping.1.is_empty())
    }

    /// At displacements and velocities of the structure, of moving supports, forces of links, and as many times as
    /// patterns act, where loads have a share.
    pub(super) fn at(
        &self,
        motion: [&[f64]; 2],
        supports: Option<&[Vec<f64>; 3]>,
        f: &[f64],
        loads: &[f64],
    ) -> f64 {
        let [u, v] = motion;
        let mut force = sum(&self.stiffness.0, u) + sum(&self.damping.0, v);
        if let Some([u, v, _]) = supports {
            force += sum(&self.stiffness.1, u) + sum(&self.damping.1, v);
        }
        force + sum(&self.links, f) + sum(&self.loads, loads)
    }
}

pub(super) fn sum(row: &[(usize, f64)], x: &[f64]) -> f64 {
    row.iter().map(|(i, c)| c * x[*i]).sum()
}

impl Row {
    /// The forces of links that it is a sum of, by flat coordinate.
    pub(crate) fn link_forces(&self) -> &[(usize, f64)] {
        match self {
            Self::Force { terms } | Self::Internal(Internal { links: terms, .. }) => terms,
            _ => &[],
        }
    }

    /// True where loads along members have a share in it.
    pub(crate) fn is_loaded(&self) -> bool {
        matches!(self, Self::Internal(force) if !force.loads.is_empty())
    }

    /// True where it needs moving supports.
    pub(super) fn is_supported(&self) -> bool {
        match self {
            Self::Nodal { support, .. } => !support.is_empty(),
            Self::Internal(force) => force.is_supported(),
            _ => false,
        }
    }
}

/// Motion of a place at an arm from the point about which all turns by one unit as it overturns along X or Y.
fn overturned(direction: Dof, arm: Vector3, dof: Dof) -> f64 {
    let (along, turns) = if direction == Dof::Ux { (0, Dof::Ry) } else { (1, Dof::Rx) };
    let sign = if turns == Dof::Ry { 1.0 } else { -1.0 };
    match dof {
        Dof::Uz => -arm[along],
        _ if dof == direction => arm[2],
        _ if dof == turns => sign,
        _ => 0.0,
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
            Quantity::Derived(derived) => {
                Row::Derived { output: Arc::clone(&derived.output), of: derived.of.clone() }
            }
            Quantity::ElementForce { elements, end, dof, factor } => {
                let (mut stiffness, mut damping) = (Vec::new(), Vec::new());
                for element in elements {
                    let row = self.system.end_force(self.model, *element, *end, *dof);
                    stiffness.extend(row.stiffness.iter().map(|(i, c)| (*i, factor * c)));
                    damping.extend(row.damping.iter().map(|(i, c)| (*i, factor * c)));
                }
                self.internal(&stiffness, &damping, Vec::new(), Vec::new())
            }
            Quantity::BaseShear { direction } => {
                let unit = |full: usize| self.system.inner.shift(full, direction.index());
                Row::Internal(base_shear::row(self.model, self.system, self.space, unit))
            }
            Quantity::Overturning { direction, about } => {
                let inner = &self.system.inner;
                let turned = |full: usize| match inner.node(full) {
                    Some(node) => {
                        let place = self.model.nodes[node].position;
                        overturned(*direction, sub(place, *about), Dof::ALL[full % 6])
                    }
                    None if *direction == Dof::Ux => inner.turn(self.model, full, 1, *about),
                    None => -inner.turn(self.model, full, 0, *about),
                };
                Row::Internal(base_shear::row(self.model, self.system, self.space, turned))
            }
            Quantity::Reaction { nodes, dof, factor } => {
                let (mut stiffness, mut damping) = (Vec::new(), Vec::new());
                let (mut links, mut loads) = (Vec::new(), Vec::new());
                let by = |(i, c): (usize, f64)| (i, factor * c);
                for node in nodes {
                    let row = self.system.reaction(self.model, *node, *dof);
                    stiffness.extend(row.stiffness.into_iter().map(by));
                    damping.extend(row.damping.into_iter().map(by));
                    links.extend(row.links.into_iter().map(by));
                    loads.extend(row.loads.into_iter().map(by));
                }
                self.internal(&stiffness, &damping, links, loads)
            }
            Quantity::MemberForce { element, force, at, factor } => {
                let row = self.system.member_force(self.model, *element, *force, *at);
                let by = |terms: Vec<(usize, f64)>| -> Vec<(usize, f64)> {
                    terms.into_iter().map(|(i, c)| (i, factor * c)).collect()
                };
                self.internal(&by(row.stiffness), &[], Vec::new(), by(row.loads))
            }
        }
    }

    fn internal(
        &self,
        stiffness: &[(usize, f64)],
        damping: &[(usize, f64)],
        links: Vec<(usize, f64)>,
        loads: Vec<(usize, f64)>,
    ) -> Row {
        let [stiffness, damping] = [stiffness, damping].map(|terms| self.split(terms));
        Row::Internal(Internal { stiffness, damping, links, loads })
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

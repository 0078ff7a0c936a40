//! The reduced basis: Ritz vectors or eigenvectors, attachment vectors of massless DOFs, and modal damping.
//!
//! Vectors and modes in their span, what they hold of masses, loads and links, and the damping that acts on them.
//! May use no other room: it knows the assembled system alone.
//!
//! ```text
//! K̂ x₁ = p        K̂ xᵢ₊₁ = M xᵢ, each M-orthonormalised twice        (p: every load direction)
//! K̂ x  = bᵀ                                                          (one for every link coordinate)
//! ```
//!
//! The ground recursion carries the structure, one static vector for each link coordinate carries the
//! local flexibility; what carries next to no mass of its own is no mode, but a static shape beside the
//! modes (see `attachment`). K̂ holds small effective stiffnesses
//! of the links (and a mass shift where the structure can move freely), so that it is regular; the span
//! is then turned into modes of the structure itself, without the automatic effective stiffnesses, so these never
//! enter the dynamics. ω = 0 is an ordinary mode.
//!
//! Reference: \[Wilson 2002, ch. 14 and 18\].

mod attachment;
mod block;
mod condensation;
mod damping;
mod drag;
mod link_shapes;
mod orthonormal;
mod recursion;
mod report;
mod ritz;
mod shapes;
mod solvable;

pub(crate) use damping::{LowRank, ModalDamping, is_modal, modal_damping};
pub(crate) use drag::follow_supports;
pub(crate) use report::at_nodes;
pub use report::{Adequacy, BasisReport, ModeShape};
pub(crate) use shapes::{Shapes, expand};

use crate::error::SolveError;
use attachment::AttachmentVectors;
use condensation::Condensation;
use report::report;
use ritz::{Enriched, enriched};
use solvable::{PIVOT, Solvable, held, solvable};
use std::sync::Arc;
use trilith_linalg::{Dense, Sparse, all_modes, symmetric_eigen};
use trilith_model::{Basis, BasisKind, Model};
use trilith_system::System;

/// Largest model for which a complete basis is made.
const COMPLETE_LIMIT: usize = 1500;
/// Up to this order the complete basis is the automatic choice.
const COMPLETE_AUTOMATIC: usize = 300;
/// A strain energy below this share of the sum of its terms is rounding: the motion is free.
const ROUNDING: f64 = 1e-13;
/// How much more than the terms of what is kept of a motion those of all of it may be, before a closer look.
const DOUBT: f64 = 1e4;

/// M-orthonormal modes in the span of a basis.
#[derive(Clone, Debug)]
pub(crate) struct RitzBasis {
    /// The modes, and after them shapes of massless directions.
    pub shapes: Arc<Shapes>,
    pub omega2: Vec<f64>,
    /// The latter.
    pub statics: AttachmentVectors,
}

impl RitzBasis {
    /// Number of modes, the first columns of the shapes.
    pub(crate) fn modes(&self) -> usize {
        self.omega2.len()
    }

    /// Number of static shapes.
    pub(crate) fn statics(&self) -> usize {
        self.statics.len()
    }
}

/// A basis in two forms of one span.
pub(crate) struct Bases {
    /// Modes of the structure with the user's effective stiffnesses: the coordinates of FNA.
    pub stepping: Arc<RitzBasis>,
    /// Modes of the structure alone: what modal damping acts on.
    pub structural: Arc<RitzBasis>,
    /// The same of a span that holds this one and the next vectors of the same sequence.
    pub wider: Option<Box<Bases>>,
    pub report: BasisReport,
}

/// What a run asks of a basis, over the free DOFs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Demands {
    /// Directions of loads, by name.
    pub loads: Vec<(String, Vec<f64>)>,
    /// Displacements and velocities at the start.
    pub starts: Vec<Vec<f64>>,
    /// True where a wider basis is wanted as well, which tells what this one lacks.
    pub wider: bool,
}

impl Demands {
    /// Of loads, and of a displacement beyond equilibrium and a velocity at the start. The force that a displacement at the start asks for is a load as well: it moves what
    /// dashpots hold.
    pub(crate) fn new(
        system: &System,
        mut loads: Vec<(String, Vec<f64>)>,
        [displacement, velocity]: [&Vec<f64>; 2],
    ) -> Self {
        let moves = |u: &&Vec<f64>| u.iter().any(|x| *x != 0.0);
        if moves(&displacement) && !system.massless.is_empty() {
            let force = system.stiffness_with(&system.links.effective).mul(displacement);
            loads.push(("initial displacement".into(), force));
        }
        let starts = [displacement, velocity].into_iter().filter(moves).cloned().collect();
        Self { loads, starts, wider: false }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.loads.is_empty() && self.starts.is_empty()
    }

    /// Number of directions that each block of a recursion has.
    fn count(&self) -> usize {
        self.loads.len() + self.starts.len()
    }
}

/// Makes the basis for loads given as vectors on the free DOFs. A structure that can move without stiffness
/// and mass is refused. With `adequacy` the report tells how well every link coordinate is held, which takes a
/// solution for each.
pub(crate) fn build(
    model: &Model,
    system: &System,
    settings: &Basis,
    demands: &Demands,
    adequacy: bool,
) -> Result<Bases, SolveError> {
    let (order, loads) = (system.order(), &*demands.loads);
    let complete = settings.kind == BasisKind::Complete
        || match settings.vectors {
            None => order <= COMPLETE_AUTOMATIC,
            Some(n) => n >= order - system.massless.len() && order <= COMPLETE_LIMIT,
        };
    let hat = solvable(model, system)?;
    let Enriched { span, wider, known } = if complete {
        if order > COMPLETE_LIMIT {
            return Err(SolveError::BasisTooLarge { order, limit: COMPLETE_LIMIT });
        }
        let all = all_modes(&Sparse::combine(&hat.parts(system)), &system.mass)?.1;
        let span = Shapes::new(Arc::new(Condensation::none(order)), all);
        Enriched { span, wider: None, known: None }
    } else {
        enriched(system, settings, demands, &hat)?
    };
    if span.len() == 0 {
        return Err(SolveError::NoMass);
    }
    // The factor is not needed any longer, and weighs as much as many vectors.
    let exact = hat.flexibility(system, loads, known.or((!adequacy).then(Vec::new)));
    let Solvable { effective: held, shift, factor, .. } = hat;
    drop(factor);
    let forms = Forms::new(system, loads)?;
    let mut bases =
        forms.of(system, span.len(), wider.unwrap_or(span), is_modal(&model.damping))?;
    bases.report = report(model, system, &bases, loads, &held, shift, &exact);
    Ok(bases)
}

/// The bases of a structure in the span that another one of the same directions has its modes in; none where its massless
/// directions are others.
pub(crate) fn in_span(
    system: &System,
    loads: &[(String, Vec<f64>)],
    of: &RitzBasis,
) -> Result<Option<Bases>, SolveError> {
    let before = of.shapes.rows();
    let rows = match before.is_none() {
        true => Condensation::none(system.order()),
        false => Condensation::new(system, loads)?,
    };
    if !rows.keeps_as(before) {
        return Ok(None);
    }
    let span = of.shapes.with_rows(Arc::new(rows));
    // Orthonormal in the masses that there are here.
    let (sizes, mut turn) = symmetric_eigen(&span.congruence(&system.mass))?;
    for (j, size) in sizes.iter().enumerate() {
        turn.column_mut(j).iter_mut().for_each(|x| *x /= size.sqrt());
    }
    let span = span.turned(&turn);
    Ok(Some(Forms::new(system, loads)?.of(system, span.len(), span, false)?))
}

/// A stiffness whose modes a span is turned into, and the static shapes for it.
struct Form {
    stiffness: Sparse,
    effective: Vec<f64>,
    statics: AttachmentVectors,
}

impl Form {
    fn new(
        system: &System,
        effective: Vec<f64>,
        loads: &[(String, Vec<f64>)],
    ) -> Result<Self, SolveError> {
        let stiffness = system.stiffness_with(&effective);
        let statics = AttachmentVectors::new(system, &stiffness, loads)?;
        Ok(Self { stiffness, effective, statics })
    }

    /// Turns M-orthonormal vectors into modes, with the static shapes beside them; for each of these counts, of so many
    /// of the first.
    fn modes_in(
        &self,
        system: &System,
        span: Shapes,
        counts: &[usize],
    ) -> Result<Vec<RitzBasis>, SolveError> {
        let span = self.statics.out_of(&self.stiffness, span);
        let reduced = span.stiffness_of_vectors(&self.stiffness);
        let sums = self.stiffness.row_sums();
        let sums = span.rows().gather(&sums);
        let bounds: Vec<f64> = span.vectors().map(|x| bound(x, &sums)).collect();
        let of = |count: &usize| {
            let (first, reduced) = (span.first(*count), reduced.leading(*count, *count));
            self.modes_of(system, first, &reduced, &sums, bounds[..*count].iter().sum())
        };
        counts.iter().map(of).collect()
    }

    /// The same of vectors with their stiffness Vᵀ K V; `sums`: of the magnitudes in the rows of K that are kept, and
    /// `most` what they bound the strain energies of all vectors together by.
    fn modes_of(
        &self,
        system: &System,
        vectors: Shapes,
        reduced: &Dense,
        sums: &[f64],
        most: f64,
    ) -> Result<RitzBasis, SolveError> {
        let Self { stiffness: k, effective, statics } = self;
        let (mut omega2, modes) = graded_modes(vectors, reduced, k)?;
        // Most modes need no closer look: none has more than what all together have.
        let doubtful = omega2.iter().take_while(|w| **w <= DOUBT * ROUNDING * most).count();
        for (w, kept) in omega2[..doubtful].iter_mut().zip(modes.each_kept()) {
            if w.abs() > DOUBT * ROUNDING * bound(&kept, sums) {
                continue;
            }
            let x = modes.rows().complete(&kept);
            let terms: f64 = k.entries().map(|(i, l, a)| (a * x[i] * x[l]).abs()).sum();
            if w.abs() <= ROUNDING * terms {
                *w = 0.0;
            }
        }
        let statics = statics.beside(system, k, effective, &modes);
        let shapes = Arc::new(modes.beside(&statics.psi));
        Ok(RitzBasis { shapes, omega2, statics })
    }
}

/// What the sums of magnitudes in the rows of K bound xᵀ K x by.
fn bound(x: &[f64], sums: &[f64]) -> f64 {
    x.iter().zip(sums).map(|(x, s)| x * x * s).sum()
}

/// The structure with the user's effective stiffnesses, and without where there are any.
struct Forms {
    stepping: Form,
    structural: Option<Form>,
}

impl Forms {
    fn new(system: &System, loads: &[(String, Vec<f64>)]) -> Result<Self, SolveError> {
        let effective = &system.links.effective;
        let alone = effective.iter().all(|k| *k == 0.0);
        let structural = || Form::new(system, vec![0.0; effective.len()], loads);
        let structural = if alone { None } else { Some(structural()?) };
        Ok(Self { stepping: Form::new(system, effective.clone(), loads)?, structural })
    }

    /// The first of some vectors in them, and all where they are more. Of the wider basis nobody asks for modes of the
    /// structure alone but modal damping.
    fn of(
        &self,
        system: &System,
        count: usize,
        all: Shapes,
        is_modal: bool,
    ) -> Result<Bases, SolveError> {
        let counts = if all.len() > count { vec![count, all.len()] } else { vec![count] };
        let of_structure = if is_modal { &*counts } else { &counts[..1] };
        let alone = self.structural.as_ref();
        let alone =
            alone.map(|form| form.modes_in(system, all.clone(), of_structure)).transpose()?;
        let mut alone = alone.unwrap_or_default().into_iter();
        let mut bases = self.stepping.modes_in(system, all, &counts)?.into_iter().map(|stepping| {
            let stepping = Arc::new(stepping);
            let structural = alone.next().map_or_else(|| Arc::clone(&stepping), Arc::new);
            Bases { structural, stepping, wider: None, report: BasisReport::default() }
        });
        let first = bases.next();
        let wider = bases.next().map(Box::new);
        first.map(|first| Bases { wider, ..first }).ok_or(SolveError::NoMass)
    }
}

/// Modes in a span of M-orthonormal vectors with this stiffness, rising. An eigenvalue is found no better than the
/// rounding of the largest one, so the slow modes are found once more among themselves, until there is no such gap.
fn graded_modes(
    mut modes: Shapes,
    reduced: &Dense,
    k: &Sparse,
) -> Result<(Vec<f64>, Shapes), SolveError> {
    const GAP: f64 = 1e-5;
    let (mut omega2, rotation) = symmetric_eigen(reduced)?;
    modes.turn(&rotation);
    let mut count = omega2.len();
    loop {
        let largest = omega2[..count].last().copied().unwrap_or(0.0);
        let slow = omega2[..count].iter().filter(|w| **w < GAP * largest).count();
        if slow == 0 || slow == count {
            return Ok((omega2, modes));
        }
        count = slow;
        let (again, rotation) = symmetric_eigen(&modes.stiffness(k, count))?;
        modes.turn(&rotation);
        omega2[..count].copy_from_slice(&again);
    }
}

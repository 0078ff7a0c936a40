//! The basis of FNA: load-dependent Ritz vectors, or eigenvectors, with a check of adequacy.
//!
//! ```text
//! K̂ x₁ = p        K̂ xᵢ₊₁ = M xᵢ, each M-orthonormalised twice        (p: every load direction)
//! K̂ x  = bᵀ                                                          (one for every link coordinate)
//! ```
//!
//! The ground recursion carries the structure, one static vector for each link coordinate carries the
//! local flexibility; what carries next to no mass of its own is no mode, but a static shape beside the
//! modes (see `massless`). K̂ holds small dummies
//! of the links (and a mass shift where the structure can move freely), so that it is regular; the span
//! is then turned into modes of the structure itself, without the automatic dummies, so these never
//! enter the dynamics. ω = 0 is an ordinary mode.
//!
//! Reference: \[Wilson 2002, ch. 14 and 18\].

use crate::condensation::Condensation;
use crate::error::SolveError;
use crate::massless::{Following, StaticShapes};
use crate::observe::{Adequacy, BasisReport, ModeShape};
use crate::shapes::Shapes;
use crate::span::{Origin, Span, Speed};
use crate::start::Initial;
use crate::vector::dot;
use std::sync::Arc;
use trilith_linalg::{
    Dense, DenseLu, LinalgError, Sparse, StagedLdlt, all_modes, lowest_modes, symmetric_eigen,
    unsupported,
};
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
/// A pivot below this share of its diagonal is rounding: nothing holds the equation.
const HELD: f64 = 1e-11;
/// Right-hand sides solved together.
const BLOCK: usize = 16;
/// One vector in so many is added to make the wider basis, and so many at least.
const WIDER: usize = 4;
const AT_LEAST: usize = 8;
/// Automatic dummies as a share of the engaged stiffness of a link.
const DUMMY_SHARE: f64 = 1e-3;
/// Modes shown in pictures.
const SHAPES: usize = 6;

/// M-orthonormal modes in the span of a basis.
#[derive(Clone, Debug)]
pub(crate) struct RitzBasis {
    /// The modes, and after them shapes of directions without mass.
    pub shapes: Arc<Shapes>,
    pub omega2: Vec<f64>,
    /// The latter.
    pub statics: StaticShapes,
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
    /// Modes of the structure with the user's dummies: the coordinates of FNA.
    pub stepping: Arc<RitzBasis>,
    /// Modes of the structure alone: what modal damping acts on.
    pub structural: Arc<RitzBasis>,
    /// The same of a span that holds this one and the next vectors of the same sequence.
    pub wider: Option<Box<Bases>>,
    pub report: BasisReport,
}

/// K̂ = K + Bᵀ diag(dummies) B + shift M + rate C and its factor.
struct Solvable {
    dummies: Vec<f64>,
    /// Bᵀ diag(dummies) B.
    springs: Sparse,
    /// Of the mass where the structure can move freely, 1/s².
    shift: f64,
    /// Of the dashpots where they alone hold a direction without mass, 1/s.
    rate: f64,
    factor: StagedLdlt,
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
    /// Of loads and a start. The force that a displacement at the start asks for is a load as well: it moves what
    /// dashpots hold.
    pub(crate) fn new(
        system: &System,
        mut loads: Vec<(String, Vec<f64>)>,
        initial: &Initial,
    ) -> Self {
        let moves = |u: &&Vec<f64>| u.iter().any(|x| *x != 0.0);
        let Initial { beyond_equilibrium: displacement, velocity, .. } = initial;
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

/// What the report needs of K̂⁻¹: p K̂⁻¹ p of the loads, and b K̂⁻¹ bᵀ of the active link coordinates.
struct Flexibility {
    loads: Vec<f64>,
    links: Vec<f64>,
}

impl Solvable {
    /// K̂ as a sum; made, it would weigh as much as K.
    fn parts<'a>(&'a self, system: &'a System) -> [(f64, &'a Sparse); 4] {
        [
            (1.0, &system.stiffness),
            (1.0, &self.springs),
            (self.shift, &system.mass),
            (self.rate, &system.element_damping),
        ]
    }

    /// `known`: of the links, where they have been found already.
    fn flexibility(
        &self,
        system: &System,
        loads: &[(String, Vec<f64>)],
        known: Option<Vec<f64>>,
    ) -> Flexibility {
        let of_loads = loads.iter().map(|(_, p)| {
            let mut x = p.clone();
            self.factor.solve(&mut x);
            dot(p, &x)
        });
        let loads = of_loads.collect();
        let links = known.unwrap_or_else(|| {
            let mut links = Vec::new();
            self.static_shapes(system, &system.links.active, |_, flexibility| {
                links.push(flexibility);
            });
            links
        });
        Flexibility { loads, links }
    }

    /// K̂⁻¹ bᵀ of link coordinates, and b of them.
    fn static_shapes(&self, system: &System, flat: &[usize], mut visit: impl FnMut(&[f64], f64)) {
        let order = system.order();
        for block in flat.chunks(BLOCK) {
            let mut shapes = vec![0.0; order * block.len()];
            for (column, flat) in shapes.chunks_mut(order).zip(block) {
                system.links.rows[*flat].iter().for_each(|(i, c)| column[*i] += c);
            }
            self.factor.solve(&mut shapes);
            for (x, flat) in shapes.chunks(order).zip(block) {
                visit(x, system.links.rows[*flat].iter().map(|(i, c)| c * x[*i]).sum());
            }
        }
    }
}

fn solvable(model: &Model, system: &System) -> Result<Solvable, SolveError> {
    let links = &system.links;
    let engaged = links.engaged(model);
    let pairs = || engaged.iter().zip(&links.effective);
    let dummies: Vec<f64> =
        pairs().map(|(e, user)| if *user > 0.0 { *user } else { DUMMY_SHARE * e }).collect();
    let springs = system.springs(&dummies);
    let held_by = [(1.0, &system.stiffness), (1.0, &springs)];
    // What dummies hold, the links hold when engaged, unless the user's stand where they never do.
    let as_links = pairs().all(|(e, user)| *user <= 0.0 || *e > 0.0);
    if as_links && let Some(factor) = held(&held_by)? {
        return Ok(Solvable { dummies, springs, shift: 0.0, rate: 0.0, factor });
    }
    system.check_supported(model, true)?;
    let k = Sparse::combine(&held_by);
    let (mut shift, mut rate) = (0.0, 0.0);
    if !unsupported(&k)?.is_empty() {
        let sum = |a: &Sparse| a.diagonal().iter().sum::<f64>();
        let (stiff, heavy) = (sum(&k), sum(&system.mass));
        // A mass shift makes regular what can move freely, dashpots what they alone hold.
        shift = if stiff > 0.0 && heavy > 0.0 { 1e-6 * stiff / heavy } else { 1.0 };
        let viscous = sum(&system.element_damping);
        let by_mass = || Sparse::combine(&[(1.0, &k), (shift, &system.mass)]);
        if viscous > 0.0 && !unsupported(&by_mass())?.is_empty() {
            rate = if stiff > 0.0 { stiff / viscous } else { 1.0 };
        }
    }
    let parts = [(1.0, &k), (shift, &system.mass), (rate, &system.element_damping)];
    let factor = StagedLdlt::alone(&parts)?;
    Ok(Solvable { dummies, springs, shift, rate, factor })
}

/// The factor of a sum, where no pivot is rounding. Scaling to a unit diagonal would divide each pivot by its
/// diagonal entry, so this is the test of [`unsupported`] without a second factorisation.
pub(crate) fn held(parts: &[(f64, &Sparse)]) -> Result<Option<StagedLdlt>, SolveError> {
    let mut diagonal = vec![0.0; parts.first().map_or(0, |(_, a)| a.rows())];
    for (factor, part) in parts {
        diagonal.iter_mut().zip(part.diagonal()).for_each(|(sum, d)| *sum += factor * d);
    }
    if diagonal.iter().any(|d| *d <= 0.0) {
        return Ok(None);
    }
    let factor = match StagedLdlt::alone(parts) {
        Err(LinalgError::Singular { .. }) => return Ok(None),
        other => other?,
    };
    let mut all = true;
    factor.pivots(|equation, pivot| all &= pivot > HELD * diagonal[equation]);
    Ok(all.then_some(factor))
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
    let Solvable { dummies: held, shift, factor, .. } = hat;
    drop(factor);
    let mut bases = in_both_forms(system, span, loads)?;
    if let Some(wider) = wider {
        bases.wider = Some(Box::new(in_both_forms(system, wider, loads)?));
    }
    bases.report = report(model, system, &bases, loads, &held, shift, &exact);
    Ok(bases)
}

/// A span as modes with and without the user's dummies.
fn in_both_forms(
    system: &System,
    span: Shapes,
    loads: &[(String, Vec<f64>)],
) -> Result<Bases, SolveError> {
    let dummies = &system.links.effective;
    let report = BasisReport::default();
    if dummies.iter().all(|k| *k == 0.0) {
        let both = Arc::new(modes_in(system, span, &system.stiffness, dummies, loads)?);
        return Ok(Bases { structural: Arc::clone(&both), stepping: both, wider: None, report });
    }
    let none = vec![0.0; dummies.len()];
    let structural = Arc::new(modes_in(system, span.clone(), &system.stiffness, &none, loads)?);
    let with = system.stiffness_with(dummies);
    let stepping = Arc::new(modes_in(system, span, &with, dummies, loads)?);
    Ok(Bases { structural, stepping, wider: None, report })
}

/// Turns a span of M-orthonormal vectors into modes of `k`, which has these dummies, with the static shapes beside
/// them.
fn modes_in(
    system: &System,
    span: Shapes,
    k: &Sparse,
    dummies: &[f64],
    loads: &[(String, Vec<f64>)],
) -> Result<RitzBasis, SolveError> {
    let statics = StaticShapes::new(system, k, loads)?;
    let span = statics.out_of(k, span);
    let (mut omega2, vectors) = graded_modes(span, k)?;
    // Most modes need no closer look.
    let sums = k.row_sums();
    let sums = vectors.rows().gather(&sums);
    for (j, w) in omega2.iter_mut().enumerate() {
        let bound: f64 = vectors.kept(j).iter().zip(&*sums).map(|(x, s)| x * x * s).sum();
        if w.abs() > DOUBT * ROUNDING * bound {
            continue;
        }
        let x = vectors.column(j);
        let terms: f64 = k.entries().map(|(i, l, a)| (a * x[i] * x[l]).abs()).sum();
        if w.abs() <= ROUNDING * terms {
            *w = 0.0;
        }
    }
    let statics = statics.beside(system, k, dummies, &vectors);
    let shapes = Arc::new(vectors.beside(&statics.psi));
    Ok(RitzBasis { shapes, omega2, statics })
}

/// Modes in a span of M-orthonormal vectors, rising. An eigenvalue is found no better than the rounding of
/// the largest one, so the slow modes are found once more among themselves, until there is no such gap.
fn graded_modes(mut vectors: Shapes, k: &Sparse) -> Result<(Vec<f64>, Shapes), SolveError> {
    const GAP: f64 = 1e-5;
    let mut count = vectors.len();
    let mut omega2 = vec![0.0; count];
    loop {
        let (again, rotation) = symmetric_eigen(&vectors.stiffness(k, count))?;
        vectors.kept_mut().turn(&rotation);
        omega2[..count].copy_from_slice(&again);
        let largest = again.last().copied().unwrap_or(0.0);
        let slow = again.iter().filter(|w| **w < GAP * largest).count();
        if slow == 0 || slow == count {
            return Ok((omega2, vectors));
        }
        count = slow;
    }
}

/// A span, one that holds more, and the flexibility of the links where it has been found on the way.
struct Enriched {
    span: Shapes,
    wider: Option<Shapes>,
    known: Option<Vec<f64>>,
}

fn enriched(
    system: &System,
    settings: &Basis,
    demands: &Demands,
    hat: &Solvable,
) -> Result<Enriched, SolveError> {
    let loads = &*demands.loads;
    // Who asks for no flexibility of the links gets no vectors for them.
    let links: &[usize] = if settings.adequacy > 0.0 { &system.links.active } else { &[] };
    let automatic = 20 * demands.count().max(2);
    // Links and what drives the structure share what there is: neither takes from the half of the other.
    let (ground, of_links) = match settings.vectors {
        None => (automatic, links.len()),
        Some(n) => {
            let of_links = links.len().min(n / 2);
            (n - of_links, of_links)
        }
    };
    let total = ground + of_links;
    let more = if demands.wider { total.div_ceil(WIDER).max(AT_LEAST) } else { 0 };
    let parts = hat.parts(system);
    let rows = Condensation::new(system, loads)?;
    // What follows without mass is beside the modes: in vectors it would look like modes that are far too fast, and
    // come with what is taken out of others.
    let statics = StaticShapes::new(system, &Sparse::combine(&parts), loads)?;
    let following = Following::new(system, &parts, &rows)?;
    let mut span = Span::new(&rows, &system.mass, &parts, following, total + more);
    let own = |u: &Vec<f64>| rows.gather(u).into_owned();
    let mut block: Vec<Vec<f64>> = Vec::new();
    let mut modes: Vec<Vec<f64>> = Vec::new();
    block.extend(loads.iter().map(|(_, p)| own(p)));
    // What the run starts from must be there itself; masses in motion go on as loads.
    let start = |u: &Vec<f64>| {
        let (mut u, mut p) = (u.clone(), vec![0.0; u.len()]);
        parts.iter().for_each(|(factor, part)| part.mul_add(*factor, &u, &mut p));
        statics.out_of_answer(|psi| dot(psi, &p), &mut u);
        own(&u)
    };
    let mut starts: Vec<Vec<f64>> = demands.starts.iter().map(start).collect();
    if settings.kind == BasisKind::Eigen {
        let count = (ground + more).min(system.order());
        let (_, vectors) =
            lowest_modes(&Sparse::combine(&hat.parts(system)), &system.mass, count, 0.0)?;
        modes = (0..vectors.columns()).map(|j| own(&vectors.column(j).to_vec())).collect();
        let beyond = modes.split_off(ground.min(modes.len()));
        span.take(std::mem::replace(&mut modes, beyond), Origin::Anywhere, Speed::Any);
    } else {
        starts.truncate(ground);
        let starts = std::mem::take(&mut starts);
        block.extend(span.take(starts, Origin::Anywhere, Speed::OfModes));
        block = recurse(&mut span, &rows, hat, &statics, block, ground, Speed::OfModes);
    }
    // A chain ends where its next vector is too fast; what loads and starts set in motion does not.
    let mut fast = Fast { left: span.left_out(), block: Vec::new() };
    let mut known = Vec::with_capacity(links.len());
    // Where there is no room for all, those taken are spread over all.
    let is_taken = |i: usize| (i + 1) * of_links / links.len() > i * of_links / links.len();
    let row = |i: usize| &system.links.rows[i];
    let beside = |i: usize, x: &[f64]| {
        let mut x = x.to_vec();
        statics.out_of_answer(|psi| row(i).iter().map(|(j, c)| c * psi[*j]).sum(), &mut x);
        rows.gather(&x).into_owned()
    };
    hat.static_shapes(system, links, |x, flexibility| {
        let i = known.len();
        known.push(flexibility);
        if span.len() < total && is_taken(i) {
            span.take(vec![beside(links[i], x)], Origin::Anywhere, Speed::OfModes);
        }
    });
    let known = (settings.adequacy > 0.0).then_some(known);
    if settings.vectors.is_some() {
        // So many were asked for, by the user or by an error that fewer made.
        fast.go_on(&mut span, &rows, hat, &statics, total);
    }
    let count = span.len();
    if more > 0 {
        if settings.kind == BasisKind::Eigen {
            // No few modes more hold what all that are left answer to slow loads.
            starts.truncate(more / 2);
            block.extend(span.take(starts, Origin::Anywhere, Speed::OfModes));
            block =
                recurse(&mut span, &rows, hat, &statics, block, count + more / 2, Speed::OfModes);
            fast.left.extend(span.left_out());
        }
        modes.truncate((count + more).saturating_sub(span.len()));
        span.take(modes, Origin::Anywhere, Speed::Any);
        // Links that were not taken are the first to lack something; where loads have shown all they can, links
        // and what they set in motion are all that is left.
        let untaken = system.links.active.len() - of_links;
        let mut of_links = beyond(system, hat, &mut span, &beside, count + untaken.min(more / 2));
        // Those of links are static shapes of places with next to no mass.
        drop(span.left_out());
        recurse(&mut span, &rows, hat, &statics, block, count + more, Speed::OfModes);
        fast.left.extend(span.left_out());
        of_links.extend(beyond(system, hat, &mut span, &beside, count + more));
        recurse(&mut span, &rows, hat, &statics, of_links, count + more, Speed::OfModes);
        // Only what is here is seen as missing.
        fast.go_on(&mut span, &rows, hat, &statics, count + more);
    }
    let all = span.into_dense();
    let rows = Arc::new(rows);
    if all.columns() == count {
        return Ok(Enriched { span: Shapes::new(rows, all), wider: None, known });
    }
    let first = all.values()[..count * all.rows()].to_vec();
    let first = Shapes::new(Arc::clone(&rows), Dense::from_columns(all.rows(), count, first));
    Ok(Enriched { span: first, wider: Some(Shapes::new(rows, all)), known })
}

/// Of a link coordinate and its static shape, what goes into the span.
type OfLink<'a> = dyn Fn(usize, &[f64]) -> Vec<f64> + 'a;

/// Takes static shapes of links until `count` vectors are there, and returns their images under M.
fn beyond(
    system: &System,
    hat: &Solvable,
    span: &mut Span<'_>,
    beside: &OfLink<'_>,
    count: usize,
) -> Vec<Vec<f64>> {
    let mut images = Vec::new();
    for block in system.links.active.chunks(BLOCK) {
        if span.len() >= count {
            break;
        }
        let mut links = block.iter();
        hat.static_shapes(system, block, |x, _| {
            if let Some(link) = links.next()
                && span.len() < count
            {
                images.extend(span.take(vec![beside(*link, x)], Origin::Anywhere, Speed::OfModes));
            }
        });
    }
    images
}

/// What a recursion was about to go on with, but that is too fast for modes of interest.
struct Fast {
    /// Vectors that were left out.
    left: Vec<Vec<f64>>,
    /// Right-hand sides of what follows from those taken in the end.
    block: Vec<Vec<f64>>,
}

impl Fast {
    /// Takes them, and what follows from them, until `count` vectors are there.
    fn go_on(
        &mut self,
        span: &mut Span<'_>,
        rows: &Condensation,
        hat: &Solvable,
        statics: &StaticShapes,
        count: usize,
    ) {
        let room = count.saturating_sub(span.len()).min(self.left.len());
        let taken = self.left.drain(..room).collect();
        self.block.extend(span.take(taken, Origin::Anywhere, Speed::Any));
        let block = std::mem::take(&mut self.block);
        self.block = recurse(span, rows, hat, statics, block, count, Speed::Any);
    }
}

/// The load-dependent recursion from right-hand sides until `count` vectors are there or nothing new comes; returns
/// those it would go on with.
fn recurse(
    span: &mut Span<'_>,
    rows: &Condensation,
    hat: &Solvable,
    statics: &StaticShapes,
    mut block: Vec<Vec<f64>>,
    count: usize,
    speed: Speed,
) -> Vec<Vec<f64>> {
    let order = rows.order();
    while span.len() < count && !block.is_empty() {
        let mut next = Vec::new();
        span.next_block();
        while !block.is_empty() && span.len() < count {
            let rest = block.split_off(block.len().min(count - span.len()).min(BLOCK));
            let mut x = vec![0.0; order * block.len()];
            x.chunks_mut(order).zip(&block).for_each(|(x, p)| rows.scatter(p, x));
            drop(block);
            let p = if statics.len() > 0 { x.clone() } else { Vec::new() };
            hat.factor.solve(&mut x);
            for (p, x) in p.chunks(order).zip(x.chunks_mut(order)) {
                statics.out_of_answer(|psi| dot(psi, p), x);
            }
            let solved = x.chunks(order).map(|x| rows.gather(x).into_owned()).collect();
            drop(x);
            // Where the loads have shown all they can, what is left of a vector is rounding.
            next.extend(span.take(solved, Origin::Recursion, speed));
            block = rest;
        }
        block.extend(next);
    }
    block
}

/// Participation of masses and loads, and the flexibility of every link coordinate that the basis holds;
/// `dummies` and `shift` are those of K̂.
fn report(
    model: &Model,
    system: &System,
    bases: &Bases,
    loads: &[(String, Vec<f64>)],
    dummies: &[f64],
    shift: f64,
    exact: &Flexibility,
) -> BasisReport {
    // With the dummies, which hold what links alone do.
    let basis = &bases.stepping;
    let m = basis.modes();
    let phi = &*basis.shapes;
    let rows = &system.links.rows;
    // K̂ in the basis: K is diagonal there, with κ for the static shapes, which have no mass.
    let mut reduced = Dense::zeros(phi.len(), phi.len());
    for j in 0..phi.len() {
        // What dashpots alone hold has no flexibility to be told.
        let of_static = || basis.statics.stiffness[j - m].max(1e-9);
        reduced[(j, j)] = basis.omega2.get(j).map_or_else(of_static, |w| w + shift);
    }
    let there = &system.links.effective;
    let more = dummies.iter().zip(there).map(|(all, there)| all - there);
    for (row, dummy) in rows.iter().zip(more).filter(|(_, k)| *k != 0.0) {
        let q = phi.row(row);
        for (j, b) in q.iter().enumerate() {
            for (a, sum) in q.iter().zip(reduced.column_mut(j)) {
                *sum += dummy * a * b;
            }
        }
    }
    let reduced = DenseLu::new(&reduced);
    let share = |whole: f64, q: &[f64]| -> f64 {
        let mut y = q.to_vec();
        reduced.solve(&mut y);
        if whole > 0.0 { (dot(q, &y) / whole).min(1.0) } else { 1.0 }
    };
    let mut static_participation = Vec::with_capacity(loads.len());
    for ((name, p), whole) in loads.iter().zip(&exact.loads) {
        static_participation.push((name.clone(), share(*whole, &phi.load(p))));
    }
    let mut adequacy = Vec::with_capacity(exact.links.len());
    for (flat, whole) in system.links.active.iter().zip(&exact.links) {
        let coordinate = system.links.name(model, *flat);
        adequacy.push(Adequacy { coordinate, share: share(*whole, &phi.row(&rows[*flat])) });
    }
    adequacy.sort_by(|a, b| a.share.total_cmp(&b.share));
    let basis = &bases.structural;
    let phi = &*basis.shapes;
    let mass = |axis: usize| -> Vec<f64> {
        let total: f64 = {
            let mut r = vec![0.0; system.order()];
            for (i, full) in system.reduction.free.iter().enumerate() {
                r[i] = f64::from(u8::from(full % 6 == axis));
            }
            dot(&r, &system.inertia[axis])
        };
        let shares = phi.load(&system.inertia[axis]);
        shares[..m].iter().map(|l| if total > 0.0 { l * l / total } else { 0.0 }).collect()
    };
    let [x, y, z] = [mass(0), mass(1), mass(2)];
    BasisReport {
        vectors: m,
        static_shapes: bases.stepping.statics(),
        omega: basis.omega2.iter().map(|w| w.max(0.0).sqrt()).collect(),
        mass_participation: (0..m).map(|j| [x[j], y[j], z[j]]).collect(),
        static_participation,
        adequacy,
        shapes: shapes(model, system, basis),
    }
}

/// The lowest modes that deform the structure, at its nodes.
fn shapes(model: &Model, system: &System, basis: &RitzBasis) -> Vec<ModeShape> {
    let bends = basis.omega2.iter().enumerate().filter(|(_, w)| **w > 0.0).take(SHAPES);
    let shape = |mode: usize| {
        let column = basis.shapes.column(mode);
        let full = 0..6 * model.nodes.len();
        // Supports stand still.
        let at = |i: usize| -> f64 {
            let terms = system.reduction.expand(i).iter();
            terms.filter_map(|(j, c)| column.get(*j).map(|x| c * x)).sum()
        };
        ModeShape { mode, displacements: full.map(|i| at(i) as f32).collect() }
    };
    bends.map(|(mode, _)| shape(mode)).collect()
}

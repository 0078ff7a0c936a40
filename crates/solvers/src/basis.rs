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
use crate::massless;
use crate::observe::{Adequacy, BasisReport, ModeShape};
use crate::shapes::Shapes;
use crate::span::{Origin, Span, Speed};
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
/// Automatic dummies as a share of the engaged stiffness of a link.
const DUMMY_SHARE: f64 = 1e-3;
/// Modes shown in pictures.
const SHAPES: usize = 6;

/// M-orthonormal modes in the span of a basis.
#[derive(Clone, Debug)]
pub(crate) struct RitzBasis {
    /// The modes, and after them static shapes of places without mass.
    pub shapes: Arc<Shapes>,
    pub omega2: Vec<f64>,
    /// Images of the static shapes under the stiffness.
    pub images: Dense,
}

impl RitzBasis {
    /// Number of modes, the first columns of the shapes.
    pub(crate) fn modes(&self) -> usize {
        self.omega2.len()
    }

    /// Number of static shapes.
    pub(crate) fn statics(&self) -> usize {
        self.images.columns()
    }
}

/// A basis in two forms of one span.
pub(crate) struct Bases {
    /// Modes of the structure with the user's dummies: the coordinates of FNA.
    pub stepping: Arc<RitzBasis>,
    /// Modes of the structure alone: what modal damping acts on.
    pub structural: Arc<RitzBasis>,
    pub report: BasisReport,
}

/// K̂ = K + Bᵀ diag(dummies) B + shift M and its factor.
struct Solvable {
    dummies: Vec<f64>,
    /// Bᵀ diag(dummies) B.
    springs: Sparse,
    shift: f64,
    factor: StagedLdlt,
}

/// What the report needs of K̂⁻¹: p K̂⁻¹ p of the loads, and b K̂⁻¹ bᵀ of the active link coordinates.
struct Flexibility {
    loads: Vec<f64>,
    links: Vec<f64>,
}

impl Solvable {
    /// K̂ as a sum; made, it would weigh as much as K.
    fn parts<'a>(&'a self, system: &'a System) -> [(f64, &'a Sparse); 3] {
        [(1.0, &system.stiffness), (1.0, &self.springs), (self.shift, &system.mass)]
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
        return Ok(Solvable { dummies, springs, shift: 0.0, factor });
    }
    system.check_supported(model, true)?;
    let k = Sparse::combine(&held_by);
    let mut shift = 0.0;
    if !unsupported(&k)?.is_empty() {
        let sum = |a: &Sparse| a.diagonal().iter().sum::<f64>();
        let (stiff, heavy) = (sum(&k), sum(&system.mass));
        // A mass shift makes regular what can move freely.
        shift = if stiff > 0.0 && heavy > 0.0 { 1e-6 * stiff / heavy } else { 1.0 };
    }
    let factor = StagedLdlt::alone(&[(1.0, &k), (shift, &system.mass)])?;
    Ok(Solvable { dummies, springs, shift, factor })
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
    loads: &[(String, Vec<f64>)],
    adequacy: bool,
) -> Result<Bases, SolveError> {
    let order = system.order();
    let complete = settings.kind == BasisKind::Complete
        || (settings.vectors.is_none() && order <= COMPLETE_AUTOMATIC);
    let hat = solvable(model, system)?;
    let (span, known) = if complete {
        if order > COMPLETE_LIMIT {
            return Err(SolveError::BasisTooLarge { order, limit: COMPLETE_LIMIT });
        }
        let all = all_modes(&Sparse::combine(&hat.parts(system)), &system.mass)?.1;
        (Shapes::new(Arc::new(Condensation::none(order)), all), None)
    } else {
        enriched(system, settings, loads, &hat)?
    };
    if span.len() == 0 {
        return Err(SolveError::NoMass);
    }
    // The factor is not needed any longer, and weighs as much as many vectors.
    let exact = hat.flexibility(system, loads, known.or((!adequacy).then(Vec::new)));
    let Solvable { dummies: held, shift, factor, .. } = hat;
    drop(factor);
    let dummies = &system.links.effective;
    let (structural, stepping) = if dummies.iter().all(|k| *k == 0.0) {
        let both = Arc::new(modes_in(system, span, &system.stiffness, loads)?);
        (Arc::clone(&both), both)
    } else {
        let structural = modes_in(system, span.clone(), &system.stiffness, loads)?;
        let stepping = modes_in(system, span, &system.stiffness_with(dummies), loads)?;
        (Arc::new(structural), Arc::new(stepping))
    };
    let report = report(model, system, &structural, loads, &held, shift, &exact);
    Ok(Bases { stepping, structural, report })
}

/// Turns a span of M-orthonormal vectors into modes of `k`, with the static shapes beside them.
fn modes_in(
    system: &System,
    span: Shapes,
    k: &Sparse,
    loads: &[(String, Vec<f64>)],
) -> Result<RitzBasis, SolveError> {
    let statics = massless::shapes(system, k, loads)?;
    let span = massless::without(&statics, k, span);
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
    let statics = massless::uncoupled(statics, system, &vectors);
    let mut images = Dense::zeros(statics.rows(), statics.columns());
    for j in 0..images.columns() {
        k.mul_add(1.0, statics.column(j), images.column_mut(j));
    }
    let shapes = Arc::new(vectors.beside(&statics));
    Ok(RitzBasis { shapes, omega2, images })
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

fn enriched(
    system: &System,
    settings: &Basis,
    loads: &[(String, Vec<f64>)],
    hat: &Solvable,
) -> Result<(Shapes, Option<Vec<f64>>), SolveError> {
    // Who asks for no flexibility of the links gets no vectors for them.
    let links: &[usize] = if settings.adequacy > 0.0 { &system.links.active } else { &[] };
    let automatic = 20 * loads.len().max(2);
    let ground = match settings.vectors {
        None => automatic,
        Some(n) if n >= links.len() + 2 * loads.len().max(1) => n - links.len(),
        Some(n) => n,
    };
    let total = settings.vectors.unwrap_or(ground + links.len());
    let parts = hat.parts(system);
    let rows = Condensation::new(system, loads)?;
    let mut span = Span::new(&rows, &system.mass, &parts, total);
    match settings.kind {
        BasisKind::Eigen => {
            let count = ground.min(system.order());
            let (_, vectors) =
                lowest_modes(&Sparse::combine(&hat.parts(system)), &system.mass, count, 0.0)?;
            let kept = |j| rows.gather(vectors.column(j)).into_owned();
            let all = (0..vectors.columns()).map(kept).collect();
            span.take(all, Origin::Anywhere, Speed::Any);
        }
        _ => recurse(&mut span, &rows, hat, loads, ground),
    }
    let mut known = Vec::with_capacity(links.len());
    hat.static_shapes(system, links, |x, flexibility| {
        known.push(flexibility);
        if span.len() < total {
            span.take(vec![rows.gather(x).into_owned()], Origin::Anywhere, Speed::OfModes);
        }
    });
    let known = (settings.adequacy > 0.0).then_some(known);
    let kept = span.into_dense();
    Ok((Shapes::new(Arc::new(rows), kept), known))
}

/// The load-dependent recursion until `count` vectors are there or nothing new comes.
fn recurse(
    span: &mut Span<'_>,
    rows: &Condensation,
    hat: &Solvable,
    loads: &[(String, Vec<f64>)],
    count: usize,
) {
    let order = rows.order();
    let mut block: Vec<Vec<f64>> = loads.iter().map(|(_, p)| rows.gather(p).into_owned()).collect();
    while span.len() < count && !block.is_empty() {
        let mut next = Vec::new();
        span.next_block();
        while !block.is_empty() && span.len() < count {
            let rest = block.split_off(block.len().min(count - span.len()).min(BLOCK));
            let mut x = vec![0.0; order * block.len()];
            x.chunks_mut(order).zip(&block).for_each(|(x, p)| rows.scatter(p, x));
            drop(block);
            hat.factor.solve(&mut x);
            let solved = x.chunks(order).map(|x| rows.gather(x).into_owned()).collect();
            drop(x);
            // Where the loads have shown all they can, what is left of a vector is rounding.
            next.extend(span.take(solved, Origin::Recursion, Speed::OfModes));
            block = rest;
        }
        block = next;
    }
}

/// Participation of masses and loads, and the flexibility of every link coordinate that the basis holds;
/// `dummies` and `shift` are those of K̂.
fn report(
    model: &Model,
    system: &System,
    basis: &RitzBasis,
    loads: &[(String, Vec<f64>)],
    dummies: &[f64],
    shift: f64,
    exact: &Flexibility,
) -> BasisReport {
    let m = basis.modes();
    let phi = &*basis.shapes;
    let rows = &system.links.rows;
    // K̂ in the basis: K is diagonal there, with ones for the static shapes, which have no mass.
    let mut reduced = Dense::zeros(phi.len(), phi.len());
    for j in 0..phi.len() {
        reduced[(j, j)] = basis.omega2.get(j).map_or(1.0, |w| w + shift);
    }
    for (row, dummy) in rows.iter().zip(dummies).filter(|(_, k)| **k != 0.0) {
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
        static_shapes: basis.statics(),
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

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

use crate::error::SolveError;
use crate::massless;
use crate::observe::{Adequacy, BasisReport};
use crate::space::congruence;
use crate::vector::dot;
use trilith_linalg::{Dense, Ldlt, Sparse, all_modes, lowest_modes, symmetric_eigen, unsupported};
use trilith_model::{Basis, BasisKind, Model};
use trilith_system::System;

/// Largest model for which a complete basis is made.
const COMPLETE_LIMIT: usize = 1500;
/// Up to this order the complete basis is the automatic choice.
const COMPLETE_AUTOMATIC: usize = 300;
/// Share of its M-norm that a new vector must keep to be more than rounding. It may be small: on soft
/// dummies every static shape is mostly a rigid motion, which the vectors before it hold already.
const KEEP: f64 = 1e-8;
/// A static shape of a place with next to no mass is not a mode: faster than this (rad/s) it would only
/// spoil the digits of the slow ones.
const FASTEST: f64 = 1e6;
/// A strain energy below this share of the sum of its terms is rounding: the motion is free.
const ROUNDING: f64 = 1e-13;
/// Automatic dummies as a share of the engaged stiffness of a link.
const DUMMY_SHARE: f64 = 1e-3;

/// M-orthonormal modes in the span of a basis.
#[derive(Clone, Debug)]
pub(crate) struct RitzBasis {
    pub vectors: Dense,
    pub omega2: Vec<f64>,
    /// Static shapes of places without mass, and their images under the stiffness.
    pub statics: Dense,
    pub images: Dense,
}

/// A basis in two forms of one span.
pub(crate) struct Bases {
    /// Modes of the structure with the user's dummies: the coordinates of FNA.
    pub stepping: RitzBasis,
    /// Modes of the structure alone: what modal damping acts on.
    pub structural: RitzBasis,
    pub report: BasisReport,
}

/// K̂ and its factor.
struct Solvable {
    k: Sparse,
    factor: Ldlt,
}

fn solvable(model: &Model, system: &System) -> Result<Solvable, SolveError> {
    let links = &system.links;
    let dummies: Vec<f64> = links
        .engaged(model)
        .iter()
        .zip(&links.effective)
        .map(|(e, user)| if *user > 0.0 { *user } else { DUMMY_SHARE * e })
        .collect();
    let mut k = system.stiffness_with(&dummies);
    if !unsupported(&k)?.is_empty() {
        let sum = |a: &Sparse| a.diagonal().iter().sum::<f64>();
        let (stiff, heavy) = (sum(&k), sum(&system.mass));
        // A mass shift makes regular what can move freely.
        let shift = if stiff > 0.0 && heavy > 0.0 { 1e-6 * stiff / heavy } else { 1.0 };
        k = Sparse::combine(&[(1.0, &k), (shift, &system.mass)]);
    }
    let factor = Ldlt::new(&k)?;
    Ok(Solvable { k, factor })
}

/// Makes the basis for loads given as vectors on the free DOFs.
pub(crate) fn build(
    model: &Model,
    system: &System,
    settings: &Basis,
    loads: &[(String, Vec<f64>)],
) -> Result<Bases, SolveError> {
    let order = system.order();
    let complete = settings.kind == BasisKind::Complete
        || (settings.vectors.is_none() && order <= COMPLETE_AUTOMATIC);
    let mut hat = solvable(model, system)?;
    let span = if complete {
        if order > COMPLETE_LIMIT {
            return Err(SolveError::BasisTooLarge { order, limit: COMPLETE_LIMIT });
        }
        all_modes(&hat.k, &system.mass)?.1
    } else {
        enriched(system, settings, loads, &mut hat)?
    };
    if span.columns() == 0 {
        return Err(SolveError::NoMass);
    }
    let structural = modes_in(system, span.clone(), &system.stiffness, loads)?;
    let stepping = if system.links.effective.iter().all(|k| *k == 0.0) {
        structural.clone()
    } else {
        modes_in(system, span, &system.stiffness_with(&system.links.effective), loads)?
    };
    let report = report(model, system, &structural, loads, &mut hat);
    Ok(Bases { stepping, structural, report })
}

/// Turns a span of M-orthonormal vectors into modes of `k`, with the static shapes beside them.
fn modes_in(
    system: &System,
    span: Dense,
    k: &Sparse,
    loads: &[(String, Vec<f64>)],
) -> Result<RitzBasis, SolveError> {
    let statics = massless::shapes(system, k, loads)?;
    let span = massless::without(&statics, k, span);
    let (mut omega2, vectors) = graded_modes(span, k)?;
    for (j, w) in omega2.iter_mut().enumerate() {
        let x = vectors.column(j);
        let terms: f64 = k.entries().map(|(i, l, a)| (a * x[i] * x[l]).abs()).sum();
        if w.abs() <= ROUNDING * terms {
            *w = 0.0;
        }
    }
    let statics = massless::uncoupled(&statics, &system.damping, &vectors);
    let mut images = statics.clone();
    for j in 0..images.columns() {
        images.column_mut(j).copy_from_slice(&k.mul(statics.column(j)));
    }
    Ok(RitzBasis { vectors, omega2, statics, images })
}

/// Modes in a span of M-orthonormal vectors, rising. An eigenvalue is found no better than the rounding of
/// the largest one, so the slow modes are found once more among themselves, until there is no such gap.
fn graded_modes(span: Dense, k: &Sparse) -> Result<(Vec<f64>, Dense), SolveError> {
    const GAP: f64 = 1e-5;
    let (mut omega2, rotation) = symmetric_eigen(&congruence(k, &span))?;
    let mut vectors = span.times(&rotation);
    let mut count = omega2.len();
    loop {
        let largest = omega2[..count].last().copied().unwrap_or(0.0);
        let slow = omega2[..count].iter().filter(|w| **w < GAP * largest).count();
        if slow == 0 || slow == count {
            return Ok((omega2, vectors));
        }
        count = slow;
        let values = vectors.values()[..count * vectors.rows()].to_vec();
        let part = Dense::from_columns(vectors.rows(), count, values);
        let (again, rotation) = symmetric_eigen(&congruence(k, &part))?;
        let part = part.times(&rotation);
        let length = part.values().len();
        vectors.values_mut()[..length].copy_from_slice(part.values());
        omega2[..count].copy_from_slice(&again);
    }
}

fn enriched(
    system: &System,
    settings: &Basis,
    loads: &[(String, Vec<f64>)],
    hat: &mut Solvable,
) -> Result<Dense, SolveError> {
    // Who asks for no flexibility of the links gets no vectors for them.
    let links: &[usize] = if settings.adequacy > 0.0 { &system.links.active } else { &[] };
    let automatic = 20 * loads.len().max(2);
    let ground = match settings.vectors {
        None => automatic,
        Some(n) if n >= links.len() + 2 * loads.len().max(1) => n - links.len(),
        Some(n) => n,
    };
    let total = settings.vectors.unwrap_or(ground + links.len());
    let mut span = Span::new(system);
    match settings.kind {
        BasisKind::Eigen => {
            let count = ground.min(system.order());
            let (_, vectors) = lowest_modes(&hat.k, &system.mass, count, 0.0)?;
            for j in 0..vectors.columns() {
                span.take(vectors.column(j).to_vec(), None);
            }
        }
        _ => span.recurse(hat, loads, ground),
    }
    let order = system.order();
    let mut statics = Dense::zeros(order, links.len());
    for (j, flat) in links.iter().enumerate() {
        for (i, c) in &system.links.rows[*flat] {
            statics[(*i, j)] += c;
        }
    }
    hat.factor.solve(statics.values_mut());
    for j in 0..links.len() {
        if span.len() < total {
            span.take(statics.column(j).to_vec(), Some(&hat.k));
        }
    }
    Ok(span.vectors)
}

/// M-orthonormal vectors under construction.
struct Span<'a> {
    system: &'a System,
    vectors: Dense,
    images: Vec<Vec<f64>>,
}

impl<'a> Span<'a> {
    fn new(system: &'a System) -> Self {
        Self { system, vectors: Dense::zeros(system.order(), 0), images: Vec::new() }
    }

    fn len(&self) -> usize {
        self.images.len()
    }

    /// Orthonormalises and keeps a vector, unless nothing of it is left, or, where a stiffness is given,
    /// what is left would be faster than any mode of interest.
    fn take(&mut self, mut x: Vec<f64>, stiffness: Option<&Sparse>) -> bool {
        let largest = x.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        if largest == 0.0 || !largest.is_finite() {
            return false;
        }
        x.iter_mut().for_each(|v| *v /= largest);
        let norm = |x: &[f64], m: &[f64]| dot(x, m).max(0.0).sqrt();
        let before = norm(&x, &self.system.mass.mul(&x));
        for _ in 0..2 {
            for (j, image) in self.images.iter().enumerate() {
                let share = dot(image, &x);
                for (a, b) in x.iter_mut().zip(self.vectors.column(j)) {
                    *a -= share * b;
                }
            }
        }
        let image = self.system.mass.mul(&x);
        let after = norm(&x, &image);
        if before == 0.0 || after <= KEEP * before {
            return false;
        }
        x.iter_mut().for_each(|v| *v /= after);
        if stiffness.is_some_and(|k| k.bilinear(&x, &x) > FASTEST * FASTEST) {
            return false;
        }
        self.images.push(image.into_iter().map(|v| v / after).collect());
        let mut values = self.vectors.values().to_vec();
        values.extend(&x);
        self.vectors = Dense::from_columns(x.len(), self.images.len(), values);
        true
    }

    /// The load-dependent recursion until `count` vectors are there or nothing new comes.
    fn recurse(&mut self, hat: &mut Solvable, loads: &[(String, Vec<f64>)], count: usize) {
        let mut block: Vec<Vec<f64>> = loads.iter().map(|(_, p)| p.clone()).collect();
        while self.len() < count && !block.is_empty() {
            let mut next = Vec::new();
            for mut x in block {
                if self.len() >= count {
                    break;
                }
                hat.factor.solve(&mut x);
                // Where the loads have shown all they can, what is left of a vector is rounding.
                if self.take(x, Some(&hat.k)) {
                    next.push(self.images[self.len() - 1].clone());
                }
            }
            block = next;
        }
    }
}

/// Participation of masses and loads, and the flexibility of every link coordinate that the basis holds.
fn report(
    model: &Model,
    system: &System,
    basis: &RitzBasis,
    loads: &[(String, Vec<f64>)],
    hat: &mut Solvable,
) -> BasisReport {
    let m = basis.vectors.columns();
    let phi = &massless::beside(&basis.vectors, &basis.statics);
    let reduced = trilith_linalg::DenseLu::new(&congruence(&hat.k, phi));
    let mut share = |p: &[f64]| -> f64 {
        let mut exact = p.to_vec();
        hat.factor.solve(&mut exact);
        let mut q = vec![0.0; phi.columns()];
        phi.transpose_mul_add(1.0, p, &mut q);
        let mut y = q.clone();
        reduced.solve(&mut y);
        let whole = dot(p, &exact);
        if whole > 0.0 { (dot(&q, &y) / whole).min(1.0) } else { 1.0 }
    };
    let static_participation = loads.iter().map(|(n, p)| (n.clone(), share(p))).collect();
    let mut adequacy: Vec<Adequacy> = system
        .links
        .active
        .iter()
        .map(|flat| {
            let mut b = vec![0.0; system.order()];
            for (i, c) in &system.links.rows[*flat] {
                b[*i] += c;
            }
            Adequacy { coordinate: system.links.name(model, *flat), share: share(&b) }
        })
        .collect();
    adequacy.sort_by(|a, b| a.share.total_cmp(&b.share));
    let mass = |axis: usize| -> Vec<f64> {
        let total: f64 = {
            let mut r = vec![0.0; system.order()];
            for (i, full) in system.reduction.free.iter().enumerate() {
                r[i] = f64::from(u8::from(full % 6 == axis));
            }
            dot(&r, &system.inertia[axis])
        };
        (0..m)
            .map(|j| {
                let l = dot(phi.column(j), &system.inertia[axis]);
                if total > 0.0 { l * l / total } else { 0.0 }
            })
            .collect()
    };
    let [x, y, z] = [mass(0), mass(1), mass(2)];
    BasisReport {
        vectors: m,
        static_shapes: basis.statics.columns(),
        omega: basis.omega2.iter().map(|w| w.max(0.0).sqrt()).collect(),
        mass_participation: (0..m).map(|j| [x[j], y[j], z[j]]).collect(),
        static_participation,
        adequacy,
    }
}

//! What a model is before anything is run: how much it weighs, what holds it, how it swings at rest.
//!
//! The structure stands once with its links as stiff as they are when engaged, and once with them open, or with the
//! `effective_stiffness` that the model gives them. May use `run` and what that uses.

use crate::error::SolveError;
use std::f64::consts::TAU;
use trilith_linalg::{Ldlt, Sparse, lowest_modes, unsupported};
use trilith_model::{Analysis, Body, Load, Model};
use trilith_system::{MassSum, RIGID, System};

/// Periods that are told of each state of the links.
const PERIODS: usize = 3;
/// Eigenvalues below this share of the lowest of the engaged structure are zero.
const FREE: f64 = 1e-8;
/// Directions that are named.
const NAMED: usize = 6;

/// A model in figures.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// Members that add to M, C and K; links; constraints.
    pub members: [usize; 3],
    /// Directions that are solved for.
    pub equations: usize,
    /// Of these, directions without mass.
    pub massless: usize,
    /// Directions that cases lead.
    pub led: usize,
    /// Masses.
    pub mass: MassSum,
    /// Vertical force on supports and ground under the weight of all that is free, N, links engaged; `None` where nothing
    /// holds the structure.
    pub reaction: Option<f64>,
    /// What links alone hold.
    pub freedoms: Freedoms,
    /// Lowest periods with the links engaged.
    pub engaged: Periods,
    /// Lowest periods with the links open, or at their effective stiffness; `None` without links.
    pub open: Option<Periods>,
    /// True where links have an effective stiffness of the model's.
    pub effective: bool,
    /// Sum of the forces along X, Y and Z that every case holds or adds, in the order of the model, N.
    pub loads: Vec<[f64; 3]>,
}

/// Directions in which the structure moves without stiffness where its links are open.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Freedoms {
    /// How many there are.
    pub count: usize,
    /// As motions of a rigid body: `X`, `about Z`, …
    pub rigid: Vec<&'static str>,
    /// Node and direction of the first ones, as the elimination meets them.
    pub at: Vec<(String, &'static str)>,
    /// How many are left with the links engaged: mass alone answers there.
    pub engaged: usize,
}

/// Periods of a structure at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Periods {
    /// The longest ones, s, falling.
    pub periods: Vec<f64>,
    /// Motions without stiffness, which have none.
    pub free: usize,
    /// Why there are none.
    pub reason: Option<String>,
}

/// Surveys a model.
///
/// # Errors
/// [`SolveError::Linalg`] where the stiffness has numbers beyond all bounds.
pub fn survey(model: &Model, system: &System) -> Result<Survey, SolveError> {
    let mut members = [0; 3];
    for e in &model.elements {
        members[match e.body {
            Body::Linear(_) => 0,
            Body::Link(..) => 1,
            Body::Constraint(_) => 2,
        }] += 1;
    }
    let links = &system.links;
    let held = system.links.engaged(model);
    let engaged = system.stiffness_with(&held);
    // What the assembly gave links that alone hold a place without mass is none of the model's.
    let stated = stated(model, system);
    let open = system.stiffness_with(&stated);
    let mass = system.mass_sum(model);
    let freedoms = freedoms(model, system, &engaged, &mass)?;
    let (first, lowest) = periods(&engaged, system, freedoms.engaged, None);
    let second = (!links.is_empty()).then(|| {
        let loose = unsupported(&open).map_or(0, |found| found.len());
        periods(&open, system, loose, lowest).0
    });
    Ok(Survey {
        members,
        equations: if system.idle { 0 } else { system.order() },
        massless: system.massless.directions.len(),
        led: system.reduction.prescribed.len(),
        reaction: if freedoms.engaged == 0 {
            reaction(model, system, &engaged, &held)
        } else {
            None
        },
        mass,
        freedoms,
        engaged: first,
        open: second,
        effective: stated.iter().any(|k| *k > 0.0),
        loads: model.cases.iter().map(|c| sum_of(model, system, loads(&c.analysis))).collect(),
    })
}

/// Effective stiffness of the flat link coordinates as the model gives it.
fn stated(model: &Model, system: &System) -> Vec<f64> {
    let mut all = vec![0.0; system.links.len()];
    for link in &system.links.links {
        if let Body::Link(_, options) = &model.elements[link.element].body
            && let Some(own) = &options.effective_stiffness
        {
            all[link.range.clone()].iter_mut().zip(own).for_each(|(x, k)| *x = *k);
        }
    }
    all
}

fn freedoms(
    model: &Model,
    system: &System,
    engaged: &Sparse,
    mass: &MassSum,
) -> Result<Freedoms, SolveError> {
    if system.idle {
        return Ok(Freedoms::default());
    }
    // Without links: an effective stiffness holds nothing.
    let alone = &system.stiffness;
    let loose = unsupported(alone)?;
    let rigid = match loose.is_empty() {
        true => Vec::new(),
        false => system.rigid_freedoms(model, alone, mass.centre),
    };
    let left = if loose.is_empty() { 0 } else { unsupported(engaged)?.len() };
    Ok(Freedoms {
        count: loose.len(),
        rigid: rigid.into_iter().map(|i| RIGID[i]).collect(),
        at: loose.iter().take(NAMED).map(|i| system.direction(model, *i)).collect(),
        engaged: left,
    })
}

/// Periods of K and M where so many motions have no stiffness, and the lowest eigenvalue; `scale`: that of a stiffer
/// structure.
fn periods(k: &Sparse, system: &System, free: usize, scale: Option<f64>) -> (Periods, Option<f64>) {
    let none = |reason: String| (Periods { reason: Some(reason), ..Periods::default() }, None);
    if system.idle || system.mass.diagonal().iter().all(|m| *m <= 0.0) {
        return none("no mass".into());
    }
    let sum = |a: &Sparse| a.diagonal().iter().sum::<f64>();
    let rough = 1e-6 * sum(k) / sum(&system.mass);
    let scale = scale.unwrap_or(rough);
    let sigma = if free == 0 { 0.0 } else { -scale.max(f64::MIN_POSITIVE) };
    match lowest_modes(k, &system.mass, PERIODS + free, sigma) {
        Err(error) => none(error.to_string()),
        Ok((lambda, _)) => {
            let moves = |l: &&f64| **l > FREE * scale.abs() || free == 0;
            let swinging: Vec<f64> = lambda.iter().filter(moves).copied().collect();
            let free = lambda.len() - swinging.len();
            let periods = swinging.iter().take(PERIODS).map(|l| TAU / l.max(0.0).sqrt()).collect();
            (Periods { periods, free, reason: None }, swinging.first().copied())
        }
    }
}

/// The lowest frequencies with the links as stiff as they are when engaged, Hz, rising; 0 for motions without stiffness.
///
/// # Errors
/// [`SolveError::Linalg`] where they cannot be found.
pub fn frequencies(model: &Model, system: &System, count: usize) -> Result<Vec<f64>, SolveError> {
    let sum = |a: &Sparse| a.diagonal().iter().sum::<f64>();
    let k = system.stiffness_with(&system.links.engaged(model));
    let heavy = sum(&system.mass);
    if system.idle || heavy <= 0.0 {
        return Ok(Vec::new());
    }
    let sigma = if unsupported(&k)?.is_empty() { 0.0 } else { -1e-6 * sum(&k) / heavy };
    let (lambda, _) = lowest_modes(&k, &system.mass, count, sigma.min(0.0))?;
    let still = FREE * sigma.abs();
    let frequency = |l: &f64| if *l > still { l.sqrt() / TAU } else { 0.0 };
    Ok(lambda.iter().map(frequency).collect())
}

/// Vertical force on supports and ground under the weight of all that is free, N.
fn reaction(model: &Model, system: &System, engaged: &Sparse, held: &[f64]) -> Option<f64> {
    let mut u = system.load_vector(model, &Load::Gravity { factor: 1.0 });
    Ldlt::new(engaged).ok()?.solve(&mut u);
    // tᵀ (K u + Bᵀ k B u), t: all that is free moved up.
    let mut force = system.stiffness.mul(&u);
    let (mut d, still) = (vec![0.0; held.len()], vec![0.0; system.reduction.prescribed.len()]);
    system.links.deform(&u, &still, &mut d);
    d.iter_mut().zip(held).for_each(|(d, k)| *d *= k);
    system.links.spread(1.0, &d, &mut force);
    let up = system.reduction.free.iter().zip(&force);
    Some(-up.map(|(full, f)| system.inner.shift(*full, 2) * f).sum::<f64>())
}

fn loads(analysis: &Analysis) -> &[Load] {
    match analysis {
        Analysis::Static(s) => &s.loads,
        Analysis::Dynamic(d) => &d.constant,
    }
}

/// Sum of the forces of loads, N.
fn sum_of(model: &Model, system: &System, loads: &[Load]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for load in loads {
        match load {
            Load::Gravity { factor } => sum[2] -= factor * model.gravity * system.total_mass,
            Load::Pattern { pattern, factor } => {
                for f in &model.patterns[*pattern].forces {
                    if !f.dof.is_rotation() {
                        sum[f.dof.index()] += factor * f.value;
                    }
                }
                for load in &model.patterns[*pattern].members {
                    for (full, force) in system.member_load(model, load) {
                        if full % 6 < 3 {
                            sum[full % 6] += factor * force;
                        }
                    }
                }
            }
        }
    }
    sum
}

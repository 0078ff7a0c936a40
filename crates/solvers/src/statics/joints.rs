//! Where initial values of the directions with mass put those without.
//!
//! What neither a mass nor a dashpot holds follows statically: initial velocities as the linear structure says,
//! initial displacements in equilibrium with the links, which are led there slowly along a straight path of the
//! directions that hold. What dashpots hold stays where it is, at the rate with which they carry what else acts there.

use super::{Equilibrium, Path, along, columns_of_links};
use crate::error::SolveError;
use crate::step::{LinksBefore, State, untouched};
use crate::vector::largest;
use trilith_linalg::{Dense, Ldlt, Sparse, Triplets};
use trilith_model::{Model, Span};
use trilith_system::{Massless, System};

/// Steps of the path.
const STEPS: usize = 64;

/// What no link and no spring holds stays where it is: springs of this share of the linear structure's.
const STAY: f64 = 1e-8;

/// What leads back to where it was put what nothing else holds: springs of this share of the structure's with its links
/// engaged. Of what links hold they take no more than the steps behind the path give back.
const BACK: f64 = 1e-6;

/// The directions that follow, among those without mass, and their stiffness.
pub(super) struct Followers {
    own: Massless,
    factor: Ldlt,
}

impl Followers {
    /// `links`: stiffness of the link coordinates, flat; `held`: rows over the massless directions, on which links
    /// act as dashpots do.
    pub(super) fn new(
        system: &System,
        links: &[f64],
        held: &[Vec<f64>],
    ) -> Result<Self, SolveError> {
        let massless = &system.massless;
        let own = massless.undamped(&massless.project(&system.element_damping), held)?;
        let k = own.project(&system.stiffness_with(links));
        let mut stay = Triplets::new(own.len(), own.len());
        k.diagonal().iter().enumerate().for_each(|(i, k)| stay.add(i, i, STAY * k));
        let factor = Ldlt::with_rigid_zeros(&Sparse::combine(&[(1.0, &k), (1.0, &stay.build())]))?;
        Ok(Self { own, factor })
    }

    /// What forces on the free DOFs make of them, times `s`: `to += s · N A⁻¹ Nᵀ p`.
    pub(super) fn answer(&mut self, s: f64, p: &[f64], to: &mut [f64]) {
        let mut y = self.own.load(p);
        self.factor.solve(&mut y);
        self.own.expand(s, &y, to);
    }
}

/// Makes a displacement (or velocity) follow as the structure with its effective stiffnesses says.
pub(crate) fn follow(system: &System, u: &mut [f64]) -> Result<(), SolveError> {
    if system.massless.is_empty() || u.iter().all(|x| *x == 0.0) {
        return Ok(());
    }
    let links = &system.links.effective;
    let force = system.stiffness_with(links).mul(u);
    Followers::new(system, links, &[])?.answer(-1.0, &force, u);
    Ok(())
}

/// Makes a displacement follow in equilibrium with the links, from where these were: none where no link acts on
/// what follows.
///
/// # Errors
/// [`SolveError::JointNotHeld`] where no equilibrium is found.
pub(crate) fn lead(
    model: &Model,
    system: &System,
    start: State,
    before: &[f64],
    to: &[f64],
) -> Result<Option<(Vec<f64>, LinksBefore)>, SolveError> {
    let (massless, links) = (&system.massless, &system.links);
    let engaged = links.engaged(model);
    let acting = links.active.iter().filter(|flat| massless.is_touched(&links.rows[**flat]));
    let acting: Vec<usize> = acting.copied().collect();
    if acting.is_empty() || before == to {
        return Ok(None);
    }
    // What is viscous holds as a dashpot does.
    let held = viscous_rows(model, system);
    let mut followers = Followers::new(system, &engaged, &held)?;
    let mut by: Vec<f64> = to.iter().zip(before).map(|(u, b)| u - b).collect();
    let force = system.stiffness_with(&engaged).mul(&by);
    followers.answer(-1.0, &force, &mut by);
    let columns = columns_of_links(system);
    let mut image = Dense::zeros(system.order(), links.active.len());
    for j in 0..links.active.len() {
        followers.answer(1.0, columns.column(j), image.column_mut(j));
    }
    let pseudo = links.active.iter().map(|i| start.f[*i] - engaged[*i] * start.d[*i]);
    let mut from = before.to_vec();
    image.mul_add(1.0, &pseudo.collect::<Vec<f64>>(), &mut from);
    // What hardly anything holds goes far with little force.
    let path = Path { engaged, image, from, by, tolerance: 1e-5 * STAY };
    let Equilibrium { mut u, state, .. } =
        along(model, system, start, &path, STEPS).map_err(|e| {
            let link = links.links.iter().find(|link| link.range.contains(&e.worst));
            SolveError::JointNotHeld {
                percent: 100.0 * e.reached,
                worst: links.name(model, e.worst),
                residual: e.residual,
                span: link.map_or_else(Span::default, |l| model.elements[l.element].span.clone()),
            }
        })?;
    stay(system, &path.engaged, &held, &state, to, &mut u)?;
    let state = polish(model, system, &held, &LinksBefore::of(&state), &mut u)?;
    Ok(Some((u, LinksBefore::of(&state))))
}

/// What no link acts on at the end of the path goes back to where it was put: the springs that let it stay are so soft
/// that it has gone wherever rounding pushed it.
fn stay(
    system: &System,
    engaged: &[f64],
    held: &[Vec<f64>],
    state: &State,
    put: &[f64],
    u: &mut [f64],
) -> Result<(), SolveError> {
    let (massless, links) = (&system.massless, &system.links);
    let own = massless.undamped(&massless.project(&system.element_damping), held)?;
    let mut acting = vec![0.0; links.len()];
    for (flat, k) in links.active.iter().zip(links.stiffness(&state.tangents)) {
        if k != 0.0 || state.f[*flat] != 0.0 {
            acting[*flat] = engaged[*flat];
        }
    }
    let away: Vec<f64> = u.iter().zip(put).map(|(u, p)| u - p).collect();
    let mut y = own.load(&away);
    let springs = own.project(&system.stiffness_with(engaged)).diagonal();
    let mut back = Triplets::new(own.len(), own.len());
    for (i, (y, k)) in y.iter_mut().zip(&springs).enumerate() {
        back.add(i, i, BACK * k);
        *y *= -BACK * k;
    }
    let k = own.project(&system.stiffness_with(&acting));
    Ldlt::with_rigid_zeros(&Sparse::combine(&[(1.0, &k), (1.0, &back.build())]))?.solve(&mut y);
    own.expand(1.0, &y, u);
    Ok(())
}

/// Most steps of Newton's method behind the path: they take out what the springs that let joints stay have left. Links
/// that slip tell the stiffness with which they would go back, so that it takes more than two.
const POLISH: usize = 40;

/// What a step leaves at most of what was left before it, for another one to be made.
const WORTH: f64 = 0.8;

/// These steps, as long as they leave less; what nothing holds stays. Links go from where they were at the end of the
/// path straight to where they are in the end: what the steps pass on the way they would remember.
fn polish(
    model: &Model,
    system: &System,
    held: &[Vec<f64>],
    path: &LinksBefore,
    u: &mut Vec<f64>,
) -> Result<State, SolveError> {
    let (massless, links) = (&system.massless, &system.links);
    let supports = vec![0.0; system.reduction.prescribed.len()];
    let own = massless.undamped(&massless.project(&system.element_damping), held)?;
    // The links there, what is left of all forces, and of those on what follows the largest.
    let evaluate = |u: &[f64]| {
        let mut d = vec![0.0; links.len()];
        links.deform(u, &supports, &mut d);
        let state = State::of_links(model, links, path, d, vec![0.0; links.len()]);
        let mut left = system.stiffness.mul(u);
        links.spread(1.0, &state.f, &mut left);
        let most = largest(&own.load(&left));
        (state, left, most)
    };
    let (mut state, mut left, mut most) = evaluate(u);
    for _ in 0..POLISH {
        let mut tangents = vec![0.0; links.len()];
        for (flat, k) in links.active.iter().zip(links.stiffness(&state.tangents)) {
            tangents[*flat] = k.max(0.0);
        }
        let mut tried = u.clone();
        Followers::new(system, &tangents, held)?.answer(-1.0, &left, &mut tried);
        let next = evaluate(&tried);
        let worth = next.2 < WORTH * most;
        if next.2 < most {
            *u = tried;
            (state, left, most) = next;
        }
        if !worth {
            break;
        }
    }
    Ok(state)
}

/// Link coordinates with a force of their rate at rest, or of nothing but their rate, flat.
fn viscous(model: &Model, system: &System) -> Vec<bool> {
    let links = &system.links;
    let c = untouched(model, system).tangents.c;
    let mut viscous = links.viscous(model);
    for (flat, at) in links.active.iter().zip(&links.diagonal) {
        viscous[*flat] |= c[*at] != 0.0;
    }
    viscous
}

/// Rows of these over the massless directions on which they act.
pub(super) fn viscous_rows(model: &Model, system: &System) -> Vec<Vec<f64>> {
    let (massless, links) = (&system.massless, &system.links);
    let viscous = viscous(model, system);
    let acting = links.active.iter().filter(|flat| viscous[**flat]);
    let rows = acting.map(|flat| (massless.row(&links.rows[*flat]), &links.rows[*flat]));
    // What is left of a row that acts on others is rounding.
    let counts = |(own, row): &(Vec<f64>, &Vec<(usize, f64)>)| {
        let most = row.iter().map(|(_, c)| c.abs()).fold(0.0, f64::max);
        largest(own) > 1e-9 * most
    };
    rows.filter(counts).map(|(own, _)| own).collect()
}

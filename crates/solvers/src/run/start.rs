//! Where a dynamic case starts: from rest, from the case before, or from a checkpoint.

use super::end_state::{EndState, Initial};
use crate::error::SolveError;
use crate::march::{StepControlState, constant_force, potential};
use crate::record::Ledger;
use crate::statics;
use crate::step::{
    DisplacementNorms, LinksBefore, State, Stepper, kinetic_and_strain, not_finite, untouched,
};
use crate::structure::ReducedSystem;
use trilith_element::Energy;
use trilith_model::{DynamicCase, Model, Side};
use trilith_system::{LoadSet, System, Track};

/// Share of the energy that stands in springs at the start which counts as motion: rounding moves as much.
const RESTS: f64 = 1e-6;

/// Energies below this share of what stands in springs, those of effective stiffnesses among them, are rounding.
const ROUNDING: f64 = 1e-12;

/// Deformations below this share of the largest at the start are rounding.
const NOISE: f64 = 1e-10;

/// Forces of links below this share of the loads are not looked at from near.
const FORCE: f64 = 1e-3;

/// State, control, ledger, and the output step it belongs to.
pub(crate) type Start = (State, StepControlState, Ledger, usize);

impl Initial {
    /// From rest or from the end of the case before, with initial values in their place; what has no mass and no
    /// dashpot follows them.
    pub(crate) fn new(
        model: &Model,
        system: &System,
        analysis: &DynamicCase,
        before: Option<&EndState>,
    ) -> Result<Self, SolveError> {
        let order = system.order();
        let (mut u, mut v) = match before {
            Some(end) => (end.displacement.clone(), end.velocity.clone()),
            None => (vec![0.0; order], vec![0.0; order]),
        };
        let from = u.clone();
        let is_static = before.is_some_and(|end| v.iter().all(|x| *x == 0.0) && end.dt == 0.0);
        let held = if is_static { u.clone() } else { vec![0.0; order] };
        for initial in &analysis.initial {
            let full = 6 * initial.node + initial.dof.index();
            match system.reduction.expand(full) {
                [(j, c)] if *j < order && *c == 1.0 => {
                    u[*j] = initial.displacement.unwrap_or(u[*j]);
                    v[*j] = initial.velocity.unwrap_or(v[*j]);
                }
                _ => {
                    return Err(SolveError::InitialNotFree {
                        node: model.nodes[initial.node].name.clone(),
                        direction: initial.dof.name(),
                        span: model.nodes[initial.node].span.clone(),
                    });
                }
            }
        }
        let mut links = before.map(|end| LinksBefore::of(&end.state));
        if !analysis.initial.is_empty() {
            statics::follow(system, &mut v)?;
            let resting = before.map_or_else(|| untouched(model, system), |end| end.state.clone());
            match statics::lead(model, system, resting, &from, &u)? {
                Some((led, at)) => (u, links) = (led, Some(at)),
                None => statics::follow(system, &mut u)?,
            }
            let at = links.clone().unwrap_or_else(|| LinksBefore::rest(model, &system.links));
            statics::rates(model, system, &at, &u, &mut v)?;
        }
        let beyond_equilibrium = u.iter().zip(&held).map(|(u, h)| u - h).collect();
        Ok(Self { displacement: u, velocity: v, beyond_equilibrium, links })
    }
}

/// The state of a start of a case with this output step and duration, s.
pub(crate) fn start(
    model: &Model,
    system: &System,
    initial: &Initial,
    loads: &LoadSet,
    stepper: &mut dyn Stepper,
    [dt, duration]: [f64; 2],
) -> Result<Start, SolveError> {
    let before = initial.links.clone();
    let before = before.unwrap_or_else(|| LinksBefore::rest(model, &system.links));
    let Initial { displacement: u, velocity: v, .. } = initial;
    let amplitudes: Vec<f64> =
        loads.channels.iter().map(|c| c.track.at(0.0, Side::After)).collect();
    let state = stepper.start(u, v, &before, &amplitudes)?;
    let energy: Vec<Energy> =
        state.stored.iter().map(|stored| Energy::new(*stored, 0.0, 0.0)).collect();
    if let Some(culprit) = not_finite(&system.links, (&state, &state), 0.0, Some(&energy)) {
        return Err(culprit.error(model, system, "at t = 0 s".into()));
    }
    let (kinetic, strain) = kinetic_and_strain(stepper.space(), &state.motion);
    let own = strain - effective_energy(system, stepper.space(), &state);
    let level = potential(&constant_force(stepper.space(), loads), &state);
    let stored: f64 = state.stored.iter().sum();
    // From rest there is nothing to compare with: a hundredth of the velocity that the loads could
    // give the whole mass in one output step, and that of the motion that sets in. Loads that come after
    // the end of the case give none.
    let push: f64 = loads
        .channels
        .iter()
        .map(|c| peak_until(&c.track, duration) * c.force.iter().map(|x| x * x).sum::<f64>().sqrt())
        .sum();
    let mass = if system.total_mass > 0.0 { system.total_mass } else { 1.0 };
    let n = stepper.space().order();
    let acceleration = &state.motion[2 * n..];
    let sets_in = stepper.space().mass.bilinear(acceleration, acceleration);
    let floor = 0.5e-4 * (push * push / mass + sets_in) * dt * dt;
    let standing = RESTS * (strain.abs() + stored.abs());
    let reference = (kinetic + standing).max(floor).max(f64::MIN_POSITIVE);
    // As far as that goes in an output step; rotations by the size of the model.
    let far = (2.0 * reference).sqrt() * dt;
    let translation = far / mass.sqrt();
    let mut reached =
        DisplacementNorms { motion: far, deformation: [translation, translation / extent(model)] };
    reached.reach(&stepper.displacement_norms(&state, None));
    let least = FORCE * push;
    let (forces, energy) = noise(model, system, &reached);
    let push = [least.max(forces[0]), (least * extent(model)).max(forces[1])];
    let reference = reference.max(energy);
    // Effective stiffnesses that stand far out leave more.
    let rounding = energy.max(ROUNDING * (strain.abs() + stored.abs()));
    let ledger = Ledger::new(&state, kinetic, own, level, rounding);
    Ok((state, StepControlState { level: 0, reference, standing, reached, push }, ledger, 0))
}

/// What rounding of deformations makes of the forces of engaged links, N and N·m, and of their energy, J.
fn noise(model: &Model, system: &System, reached: &DisplacementNorms) -> ([f64; 2], f64) {
    let links = &system.links;
    let mut stiffest = [0.0_f64; 2];
    for (k, rotational) in links.engaged(model).into_iter().zip(&links.rotational) {
        let of = &mut stiffest[usize::from(*rotational)];
        *of = of.max(k);
    }
    let off = reached.deformation.map(|d| NOISE * d);
    let energy = (0..2).map(|kind| 0.5 * stiffest[kind] * off[kind].powi(2)).sum();
    ([stiffest[0] * off[0], stiffest[1] * off[1]], energy)
}

/// Largest extent of a model along an axis, m; 1 m for a point.
fn extent(model: &Model) -> f64 {
    let along = |axis: usize| {
        let at = model.nodes.iter().map(|node| node.position[axis]);
        let whole = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = at.fold(whole, |(low, high): (f64, f64), x| (low.min(x), high.max(x)));
        high - low
    };
    let most = (0..3).map(along).fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}

/// Largest |amplitude| up to a time; 0 of derivatives.
fn peak_until(track: &Track, end: f64) -> f64 {
    match track {
        // What is held from the start and not balanced sets a motion in.
        Track::Constant | Track::Rate { .. } | Track::Curvature { .. } => 0.0,
        Track::Value { function, factor } => (factor * function.peak_until(end)).abs(),
    }
}

/// Largest |amplitude|; 0 of derivatives.
pub(crate) fn peak(track: &Track) -> f64 {
    match track {
        // What is held from the start and not balanced sets a motion in.
        Track::Constant => 0.0,
        Track::Value { function, factor } => (factor * function.peak()).abs(),
        Track::Rate { .. } | Track::Curvature { .. } => 0.0,
    }
}

fn effective_energy(system: &System, space: &ReducedSystem, state: &State) -> f64 {
    let n = space.order();
    let mut d = vec![0.0; system.links.active.len()];
    space.links.deform(&state.motion[..n], &mut d);
    d.iter().zip(&space.effective_k).map(|(d, k)| 0.5 * k * d * d).sum()
}

/// Takes up a checkpoint that was checked.
pub(super) fn resume(mut end: EndState, stepper: &mut dyn Stepper) -> Result<Start, SolveError> {
    if end.state.motion.len() != 3 * stepper.space().order() {
        return Err(SolveError::Checkpoint {
            reason: format!(
                "it holds {} coordinates, the basis of this run has {}",
                end.state.motion.len() / 3,
                stepper.space().order()
            ),
        });
    }
    stepper.recall(end.memory, end.time, &mut end.state)?;
    Ok((end.state, end.control, end.ledger, end.step))
}

//! Where a dynamic case starts: from rest, from the case before, or from a checkpoint.

use crate::case::EndState;
use crate::error::SolveError;
use crate::ledger::Ledger;
use crate::march::Pace;
use crate::propagator::kinetic_and_strain;
use crate::space::Space;
use crate::stepper::{State, Stepper};
use trilith_model::{Case, DynamicCase, Model, Side, SolverKind};
use trilith_system::{LoadSet, System, Track};

/// State, pace, ledger, and the output step it belongs to.
pub(crate) type Start = (State, Pace, Ledger, usize);

/// From rest or from the end of the case before, with initial values in their place.
pub(crate) fn start(
    model: &Model,
    system: &System,
    analysis: &DynamicCase,
    before: Option<EndState>,
    loads: &LoadSet,
    stepper: &mut dyn Stepper,
    dt: f64,
) -> Result<Start, SolveError> {
    let order = system.order();
    let (mut u, mut v, history) = match before {
        Some(end) => (end.displacement, end.velocity, end.state.history),
        None => (vec![0.0; order], vec![0.0; order], system.links.at_rest(model)),
    };
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
    let amplitudes: Vec<f64> =
        loads.channels.iter().map(|c| c.track.at(0.0, Side::After)).collect();
    let state = stepper.start(&u, &v, history, &amplitudes)?;
    let (kinetic, strain) = kinetic_and_strain(stepper.space(), &state.motion);
    let own = strain - dummy_energy(system, stepper.space(), &state);
    let level = potential(&constant_force(stepper.space(), loads), &state);
    let ledger = Ledger::new(&state, kinetic, own, level);
    let stored: f64 = state.stored.iter().sum();
    // From rest there is no energy to compare with: a hundredth of the velocity that the loads could
    // give the whole mass in one output step.
    let push: f64 = loads
        .channels
        .iter()
        .map(|c| peak(&c.track) * c.force.iter().map(|x| x * x).sum::<f64>().sqrt())
        .sum();
    let mass = if system.total_mass > 0.0 { system.total_mass } else { 1.0 };
    let floor = 0.5e-4 * push * push * dt * dt / mass;
    let reference = (kinetic + strain + stored).max(floor).max(f64::MIN_POSITIVE);
    Ok((state, Pace { level: 0, reference }, ledger, 0))
}

fn peak(track: &Track) -> f64 {
    match track {
        Track::Constant => 1.0,
        Track::Value { function, factor } => (factor * function.peak()).abs(),
        Track::Rate { .. } | Track::Curvature { .. } => 0.0,
    }
}

fn dummy_energy(system: &System, space: &Space, state: &State) -> f64 {
    let n = space.order();
    let mut d = vec![0.0; system.links.active.len()];
    space.deform(&state.motion[..n], &mut d);
    d.iter().zip(&space.dummy_k).map(|(d, k)| 0.5 * k * d * d).sum()
}

/// From a checkpoint of the same model, case and solver.
pub(crate) fn resume(
    model: &Model,
    case: &Case,
    kind: SolverKind,
    end: EndState,
    stepper: &mut dyn Stepper,
) -> Result<Start, SolveError> {
    let wanted = [
        ("model", model.source.sha256.as_str(), end.model.as_str()),
        ("case", case.name.as_str(), end.case.as_str()),
        ("solver", kind.name(), end.solver.as_str()),
    ];
    for (what, here, there) in wanted {
        if here != there {
            return Err(SolveError::Checkpoint {
                reason: format!("its {what} is {there}, this run's is {here}"),
            });
        }
    }
    stepper.recall(end.memory)?;
    Ok((end.state, end.pace, end.ledger, end.step))
}

/// Σ of constant loads in the coordinates of the solver.
pub(crate) fn constant_force(space: &Space, loads: &LoadSet) -> Vec<f64> {
    let amplitudes: Vec<f64> =
        loads.channels.iter().map(|c| f64::from(u8::from(c.conservative))).collect();
    space.force(&amplitudes)
}

/// Potential of the constant loads.
pub(crate) fn potential(constant: &[f64], state: &State) -> f64 {
    -constant.iter().zip(&state.motion).map(|(p, u)| p * u).sum::<f64>()
}

//! A run over the steps of another one: what derivatives are held against.

use super::course::{GradientOptions, prepare};
use super::outputs::Gradient;
use crate::error::SolveError;
use crate::march::{constant_force, jump, potential};
use crate::record::{Outputs, needs_rates};
use crate::step::{State, StepEnergy};
use trilith_model::{Model, Side};
use trilith_system::{StepLoads, System};

/// What a run has done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Step {
    /// Loads have jumped at this time, s.
    Jump(f64),
    /// A substep of a length (s) to a time (s).
    To { t: f64, dt: f64, output: bool },
}

/// Outputs of a run over the steps of another one.
#[derive(Clone, Debug, Default)]
pub struct Replay {
    /// Values at the output times, output by output.
    pub histories: Vec<Vec<f64>>,
    /// Of each output, what it has where the other run had its largest and its smallest value.
    pub extremes: Vec<[f64; 2]>,
    /// What every link has turned into heat until the end, J.
    pub heat: Vec<f64>,
    /// What loads and moving supports have put in until the end, J.
    pub input: f64,
}

/// Runs a model over the steps of a run of another one that differs in its parameters: what comes out is as smooth in
/// them as the laws are, without the noise of steps that change.
///
/// # Errors
/// [`SolveError`] where it has no equilibrium over such a step.
pub fn replay(
    model: &Model,
    system: &System,
    options: GradientOptions,
    like: &Gradient,
) -> Result<Replay, SolveError> {
    let prepared = prepare(model, system, options)?;
    let mut stepper = prepared.equations(needs_rates(model, system, true)).stepper()?;
    let (state, ..) = prepared.set_out(None, stepper.as_mut())?;
    let outputs = Outputs::new(model, system, stepper.space());
    let mut values = vec![0.0; model.outputs.len()];
    let mut found = Replay {
        histories: vec![Vec::new(); values.len()],
        extremes: vec![[0.0; 2]; values.len()],
        ..Replay::default()
    };
    let constant = constant_force(stepper.space(), &prepared.loads);
    let level = potential(&constant, &state);
    let mut heat = vec![0.0; system.links.links.len()];
    let mut see = |t: f64, count: usize, state: &State, whole: bool| {
        outputs.at((t, Side::Before), state, &prepared.loads).values(&mut values);
        for (o, x) in values.iter().enumerate() {
            for (i, extreme) in [&like.outputs[o].max, &like.outputs[o].min].into_iter().enumerate()
            {
                if extreme.step == count {
                    found.extremes[o][i] = *x;
                }
            }
            if whole {
                found.histories[o].push(*x);
            }
        }
    };
    see(0.0, 0, &state, true);
    let (mut state, mut next) = (Box::new(state), Box::new(State::default()));
    let (mut loads, mut energy) = (StepLoads::default(), StepEnergy::default());
    let (mut at, mut count, mut input) = (0.0, 0, 0.0);
    for step in &like.steps {
        match *step {
            Step::Jump(t) => {
                loads.cut();
                if let Some(change) = jump(&prepared.loads, t) {
                    stepper.jump(&mut state, &change)?;
                }
                at = t;
            }
            Step::To { t, dt, output } => {
                prepared.loads.step(at, t, &mut loads);
                let made = stepper.step(&state, &mut next, &loads, dt, &mut energy);
                made.map_err(|_| SolveError::NoGradient {
                    reason: format!(
                        "beside the value of a parameter there is no equilibrium at t = {t:.6} s over a step of the run"
                    ),
                })?;
                input += energy.work.external + energy.support;
                let did = energy.links.iter().map(|e| e.hysteretic + e.viscous);
                heat.iter_mut().zip(did).for_each(|(h, x)| *h += x);
                std::mem::swap(&mut state, &mut next);
                (at, count) = (t, count + 1);
                see(t, count, &state, output);
            }
        }
    }
    found.heat = heat;
    found.input = input + potential(&constant, &state) - level;
    Ok(found)
}

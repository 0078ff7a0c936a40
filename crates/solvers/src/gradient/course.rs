//! A run with its derivatives.

use super::around::{Around, Assembled};
use super::influence::{Influence, Pieces};
use super::moving::MovingBasis;
use super::outputs::{Follower, Gradient, HeatGradient, OutputGradient};
use super::replay::Step;
use super::sides::Sides;
use super::step::Moves;
use crate::error::SolveError;
use crate::march::{March, Moment, Moving, Stop, constant_force, jump, output_step};
use crate::record::{Ledger, LinkEnergy, Outputs, needs_rates};
use crate::run::{Prepared, RunOptions, Setup, before};
use crate::step::State;
use std::sync::atomic::{AtomicBool, Ordering};
use trilith_model::{Analysis, Model, SolverKind, StepControl};
use trilith_system::{LinkInstance, System};

/// What to differentiate.
#[derive(Clone, Copy, Debug, Default)]
pub struct GradientOptions {
    /// Index of the case, a dynamic one.
    pub case: usize,
    /// Solver; `None`: the case's own.
    pub solver: Option<SolverKind>,
    /// Output step in s; `None`: the case's own.
    pub dt: Option<f64>,
    /// Whether the energy that loads and moving supports put in is wanted too: it costs about a tenth of a run for each parameter.
    pub input: bool,
}

impl GradientOptions {
    pub(super) fn of_run<'a>(self) -> RunOptions<'a> {
        let Self { case, solver, dt, .. } = self;
        RunOptions { case, solver, dt, ..RunOptions::default() }
    }
}

fn refused(reason: &str) -> SolveError {
    SolveError::NoGradient { reason: reason.into() }
}

/// A case of a model, ready to be stepped.
pub(super) fn prepare<'a>(
    model: &'a Model,
    system: &'a System,
    options: GradientOptions,
) -> Result<Prepared<'a>, SolveError> {
    let case = model.cases.get(options.case).ok_or_else(|| refused("there is no such case"))?;
    let Analysis::Dynamic(analysis) = &case.analysis else {
        let reason = format!("case \"{}\" is static: they go with a motion", case.name);
        return Err(SolveError::NoGradient { reason });
    };
    let chain = std::iter::successors(case.after, |c| model.cases[*c].after);
    for earlier in chain.map(|c| &model.cases[c]) {
        if matches!(earlier.analysis, Analysis::Dynamic(_)) {
            let reason = format!(
                "case \"{}\" continues the motion of \"{}\", whose steps would move; give the loads of both to one case",
                case.name, earlier.name
            );
            return Err(SolveError::NoGradient { reason });
        }
    }
    let before = before(model, system, case, options.solver, None)?;
    Prepared::new(Setup { model, system, case, analysis, before }, &options.of_run())
}

/// Runs a case, and finds the derivatives of all outputs by parameters.
///
/// # Errors
/// [`SolveError::NoGradient`] where a parameter moves what must stay; errors of the run itself.
pub fn gradient(
    model: &Model,
    system: &System,
    options: GradientOptions,
    by: &[Around],
) -> Result<Gradient, SolveError> {
    gradient_until(model, system, options, by, None)
}

/// The same; a flag ends it at the next output step once it is true.
///
/// # Errors
/// As [`gradient`], and [`SolveError::Interrupted`].
pub fn gradient_until(
    model: &Model,
    system: &System,
    options: GradientOptions,
    by: &[Around],
    interrupt: Option<&AtomicBool>,
) -> Result<Gradient, SolveError> {
    let prepared = prepare(model, system, options)?;
    let watched = needs_rates(model, system, true);
    let equations = prepared.equations(watched);
    let Some(propagator) = equations.propagator() else {
        let reason = match prepared.kind {
            SolverKind::Custom { name, .. } => format!(
                "they go through the steps of built-in solvers, not of {name}; give `--solver fna` or `--solver hht`"
            ),
            _ => "full-newton has no linear step to make them with; `--solver hht` has the same equations".into(),
        };
        return Err(SolveError::NoGradient { reason });
    };
    if !propagator.is_linear() {
        return Err(refused(
            "the basis has static shapes that nothing damps, which follow their loads in ways that bend; `--solver hht` knows which way they go",
        ));
    }
    let mut stepper = equations.stepper()?;
    let (state, control, ledger, _) = prepared.set_out(None, stepper.as_mut())?;
    let assembled = by.iter().map(Assembled::new).collect::<Result<Vec<_>, _>>()?;
    let pieces = Pieces { prepared: &prepared, space: propagator.space(), watched };
    let sides = assembled.iter().map(|a| Sides::new(a, &prepared, &options.of_run()));
    let mut sides = sides.collect::<Result<Vec<_>, _>>()?;
    let reduced: Vec<_> = sides.iter_mut().map(|s| s.reduced.take()).collect();
    let moving = by.iter().zip(&reduced).map(|(around, of)| {
        of.as_ref().map(|of| MovingBasis::new(around, of, &prepared, watched)).transpose()
    });
    let moving = moving.collect::<Result<Vec<_>, _>>()?;
    let influences = assembled.iter().zip(&mut sides).zip(&moving);
    let influences = influences
        .map(|((a, sides), moving)| Influence::new(a, sides, moving.as_ref(), &pieces))
        .collect::<Result<Vec<_>, _>>()?;
    let outputs = Outputs::new(model, system, propagator.space());
    let mut follower = Follower::new(outputs, &prepared.loads, &influences);
    let mut moves = Moves::new(&prepared, &influences, moving, propagator, &state)?;
    if options.input {
        moves.follow_input();
    }
    let mut found = Gradient {
        parameters: by.iter().map(|a| a.of.name.clone()).collect(),
        values: by.iter().map(|a| a.of.value).collect(),
        outputs: model.outputs.iter().map(|o| OutputGradient::new(&o.name, by.len())).collect(),
        ..Gradient::default()
    };
    follower.see((0.0, 0), &state, moves.now(), true, &mut found);
    let timeline = prepared.timeline();
    let solution = &prepared.analysis.solution;
    let constant = constant_force(stepper.space(), &prepared.loads);
    let parts = match solution.step {
        StepControl::Fixed { substeps } => substeps.max(1) as f64,
        StepControl::Adaptive { .. } => 1.0,
    };
    let mut march = March::new(stepper.as_mut(), &prepared.loads, solution.step);
    march.budget = solution.substep_limit(timeline.steps);
    let mut moving = Moving { state: Box::new(state), control, ledger };
    let mut failed = None;
    for step in 0..timeline.steps {
        if interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            let (case, t) = (model.cases[options.case].name.clone(), timeline.time(step));
            return Err(SolveError::Interrupted { case, t });
        }
        let end = timeline.time(step + 1);
        let mut report = |moment: Moment, t: f64, state: &State, _: &Ledger| {
            let done = match moment {
                Moment::Jump => {
                    found.steps.push(Step::Jump(t));
                    let change = jump(&prepared.loads, t).unwrap_or_default();
                    moves.jump(t, &change, state)
                }
                Moment::Substep(segment) => {
                    let dt = length(segment.length / parts, t - moves.time());
                    found.steps.push(Step::To { t, dt, output: t >= end });
                    found.substeps += 1;
                    moves.step(state, t, dt)
                }
            };
            if let (Err(e), None) = (&done, &failed) {
                failed = Some(e.clone());
            }
            if let (Moment::Substep(_), None) = (moment, &failed) {
                let at = (t, found.substeps);
                follower.see(at, state, moves.now(), t >= end, &mut found);
            }
        };
        let made = output_step(&timeline, step, &mut march, &constant, &mut moving, &mut report);
        if let Err(stop) = made {
            return Err(stopped(stop, model, system));
        }
        if let Some(e) = failed.take() {
            return Err(e);
        }
    }
    found.bends = moves.bends();
    found.input = moves.input(&moving.state).map(|by| (moving.ledger.totals.input, by));
    let links = moving.ledger.links.iter().zip(moves.heat()).zip(&system.links.links);
    let heat = |((energy, by), link): ((&LinkEnergy, &Vec<f64>), &LinkInstance)| HeatGradient {
        link: model.elements[link.element].name.clone(),
        heat: energy.hysteretic + energy.viscous,
        by: by.clone(),
    };
    found.heat = links.map(heat).collect();
    Ok(found)
}

/// The length of a substep to the bit: a part by a power of two of what a segment is cut into.
fn length(whole: f64, about: f64) -> f64 {
    let exact = whole * (-(whole / about).log2().round()).exp2();
    if (exact - about).abs() <= 1e-6 * about { exact } else { about }
}

/// Why a run that came to no end has no derivatives.
fn stopped(stop: Stop, model: &Model, system: &System) -> SolveError {
    let reason = match stop {
        Stop::Fatal(e) => return e,
        Stop::NoEquilibrium { t, worst, .. } => {
            let worst = system.links.name(model, worst);
            format!("the run found no equilibrium at t = {t:.6} s: {worst} is farthest off")
        }
        Stop::Spent { t } => format!("the run had spent its substeps at t = {t:.6} s"),
        Stop::Law { t, culprit } => {
            let (link, fault) = culprit.named(model, system);
            fault.text(&link, &format!("at t = {t:.6} s"))
        }
    };
    SolveError::NoGradient { reason }
}

impl OutputGradient {
    fn new(name: &str, count: usize) -> Self {
        Self {
            name: name.to_owned(),
            history: Vec::new(),
            by: vec![Vec::new(); count],
            max: Default::default(),
            min: Default::default(),
        }
    }
}

//! A dynamic case: prepare it, march through it with what runs beside it, judge what it leaves.

use super::arrival::Arrival;
use super::case::RunOptions;
use super::clock::Clock;
use super::companion::Companion;
use super::marching::{Beside, Course, Ended, Watch, march_beside, output_errors};
use super::prepared::{Prepared, Setup};
use super::result::{CaseResult, Status, Work};
use crate::certificate::{Certificate, OutputError};
use crate::checks;
use crate::error::SolveError;
use crate::march::{Counts, March, Moving, StepControlState, Stop, Timeline, constant_force};
use crate::record::{Ledger, Observer, Viewer, needs_rates};
use crate::step::Stepper;
use trilith_model::{Model, StepControl};
use trilith_system::System;

/// Runs the case.
pub(crate) fn run(
    setup: Setup<'_>,
    options: RunOptions<'_>,
    observers: &mut [&mut dyn Observer],
) -> Result<CaseResult, SolveError> {
    let clock = Clock::start();
    let prepared = Prepared::new(setup, &options)?;
    let Prepared { model, system, analysis, loads, .. } = &prepared;
    let solution = &analysis.solution;
    let wants_rates = observers.iter().any(|o| o.wants_rates());
    let equations = prepared.equations(needs_rates(model, system, wants_rates));
    let mut stepper = equations.stepper()?;
    let timeline = prepared.timeline();
    let warnings = prepared.adequacy_warnings();
    let RunOptions { from, until, substeps, step_errors, progress, vectors, interrupt, .. } =
        options;
    let set_out = |stepper: &mut dyn Stepper| prepared.set_out(from.as_ref(), stepper);
    let (state, control, ledger, first) = set_out(stepper.as_mut())?;
    let mut moving = Moving { state: Box::new(state), control, ledger };
    let steps = first..last_step(until, &timeline);
    let mut viewer = Viewer::new(model, system, loads, stepper.space(), observers);
    let largest = from.as_ref().map(|end| end.largest.clone()).unwrap_or_default();
    viewer.look_inside(stepper.closed_form(), timeline.dt, largest);
    let wider = prepared.wider(from.as_ref(), timeline.time(first), &moving.state);
    let (shadow, listener) = wider.unzip();
    let judged = !model.outputs.is_empty() && (step_errors || shadow.is_some());
    let mut certificate = judged.then(|| {
        let (stepper, state) = (stepper.as_ref(), &moving.state);
        prepared.certificate(stepper, &timeline, steps.clone(), state, shadow, step_errors)
    });
    viewer.start(steps.len());
    viewer.show(timeline.time(first), Some(first), &moving.state, &moving.ledger);
    let setup_cpu = clock.cpu();
    let constant = constant_force(stepper.space(), loads);
    let mut march = March::new(stepper.as_mut(), loads, solution.step);
    march.budget = substeps.unwrap_or_else(|| solution.substep_limit(steps.len()));
    let companion = match solution.step {
        StepControl::Adaptive { tolerance } if step_errors && judged => {
            Some(Companion::new(equations, &timeline, tolerance, steps.clone(), march.budget))
        }
        _ => None,
    };
    let watch =
        Watch { viewer: &mut viewer, certificate: certificate.as_mut(), progress, interrupt };
    let course = Course { timeline: &timeline, steps, constant: &constant };
    let beside = Beside { companion: companion.as_ref(), listener, outputs: model.outputs.len() };
    let (ended, found) = march_beside(course, &mut march, &mut moving, watch, beside, &set_out);
    let errors = certificate.as_ref().map(|certificate| {
        // A law that has ended this run would end that one as well.
        let broken = matches!(ended.stop, Some(Stop::Law { .. }));
        let companion = companion.as_ref().filter(|_| !ended.interrupted && !broken);
        output_errors(certificate, companion, found, model, analysis.duration, &set_out)
    });
    viewer.end(&moving.state, &moving.ledger);
    let marched = Marched { first, counts: march.counts, moving, setup_cpu, clock };
    let certified = certificate.as_ref().zip(errors);
    let leaves = Leaves { prepared: &prepared, timeline: &timeline, viewer: &viewer, certified };
    let compared = companion.is_some();
    let mut result = leaves.result(ended, marched, stepper.as_ref(), compared, warnings)?;
    result.end.vectors = vectors;
    Ok(result)
}

/// A march that has ended, and what it has cost.
struct Marched {
    /// The output step that it started from.
    first: usize,
    counts: Counts,
    moving: Moving,
    clock: Clock,
    /// CPU time until the first step, s.
    setup_cpu: f64,
}

impl Marched {
    fn work(&self, made: usize, stepper: &dyn Stepper) -> Work {
        let Self { first, counts, clock, setup_cpu, .. } = self;
        let (iterations, factorizations) = stepper.work();
        Work {
            steps: made - first,
            substeps: counts.substeps,
            iterations,
            rejected: counts.rejected,
            factorizations,
            forced: counts.forced,
            wall_s: clock.wall(),
            setup_cpu_s: *setup_cpu,
            march_cpu_s: clock.cpu() - setup_cpu,
            ..Work::default()
        }
    }
}

/// What a result is made of beside the march.
struct Leaves<'r, 'a, 'b, 'c> {
    prepared: &'r Prepared<'a>,
    timeline: &'r Timeline,
    viewer: &'r Viewer<'b, 'c>,
    /// What followed the errors of the outputs, and these.
    certified: Option<(&'r Certificate<'r>, Vec<OutputError>)>,
}

impl Leaves<'_, '_, '_, '_> {
    /// The result of a march; `compared`: whether a companion went beside it.
    fn result(
        self,
        ended: Ended,
        marched: Marched,
        stepper: &dyn Stepper,
        compared: bool,
        mut warnings: Vec<String>,
    ) -> Result<CaseResult, SolveError> {
        let Self { prepared, timeline, viewer, certified } = self;
        let Prepared {
            model, system, case, analysis, kind, loads, constant, initial, bases, ..
        } = prepared;
        if let Some(Stop::Fatal(e)) = ended.stop {
            return Err(e);
        }
        let counts = marched.counts;
        let work = marched.work(ended.made, stepper);
        let Moving { state, control, ledger } = marched.moving;
        let solution = &analysis.solution;
        warnings.extend(march_warnings(solution.step, &control, &ledger, counts, stepper));
        let arrival = Arrival {
            timeline,
            made: ended.made,
            state: *state,
            control,
            ledger,
            constant: constant.clone(),
            initial: initial.clone(),
            fallen: ended.fallen,
            largest: viewer.largest(),
        };
        let (space, memory) = (stepper.space(), stepper.memory());
        let mut result = arrival.result(model, system, case, *kind, space, memory, work);
        note_stop(&mut result, &ended, counts, model, system);
        if let Some((certificate, errors)) = certified {
            result.errors = errors;
            let allowed = solution.basis.tolerance;
            warnings.extend(judge(&mut result, certificate, model, compared, allowed));
        }
        let (of, noticed) = ((*case, &**analysis), viewer.noticed());
        let place = &result.place();
        warnings.extend(checks::of_dynamic((model, system), of, loads, noticed, place));
        // Where nothing is free, there are no modes to speak of.
        let basis = bases.as_ref().filter(|_| kind.is_reduced() && !system.idle);
        result.basis = basis.map(|b| b.report.clone());
        result.warnings = warnings;
        Ok(result)
    }
}

/// The output step at which a run ends that goes on to a time, s.
fn last_step(until: Option<f64>, timeline: &Timeline) -> usize {
    let last = match until {
        Some(t) => ((t / timeline.dt) - 1e-9).ceil().max(0.0) as usize,
        None => timeline.steps,
    };
    last.min(timeline.steps)
}

/// What the user should know of the steps.
fn march_warnings(
    step: StepControl,
    control: &StepControlState,
    ledger: &Ledger,
    counts: Counts,
    stepper: &dyn Stepper,
) -> Vec<String> {
    let mut warnings = Vec::new();
    if matches!(step, StepControl::Adaptive { .. }) && control.is_lost() && ledger.moves() {
        warnings.push(LOST.into());
    }
    if counts.forced > 0 {
        warnings.push(format!(
            "{} substeps were accepted at the smallest size although their error was above the tolerance",
            counts.forced
        ));
    }
    if let (StepControl::Fixed { .. }, Some(ratio)) = (step, stepper.beyond_exact()) {
        warnings.push(format!(
            "fixed steps were too long for the exact rule at the stiffest link (ω Δt = {:.2}; limit of stability 3.46): they were made by average acceleration, and nothing watched their error; `step: Adaptive(…)` does",
            (6.0 * ratio).sqrt()
        ));
    }
    warnings
}

/// The status of a run that has not come to its end.
fn note_stop(
    result: &mut CaseResult,
    ended: &Ended,
    counts: Counts,
    model: &Model,
    system: &System,
) {
    match &ended.stop {
        Some(Stop::NoEquilibrium { t, worst, residual }) => {
            let worst = system.links.name(model, *worst);
            result.status = Status::NotConverged { t: *t, worst, residual: *residual };
        }
        Some(Stop::Spent { t }) => {
            result.status = Status::Spent { t: *t, tried: counts.substeps + counts.rejected };
        }
        Some(Stop::Law { t, culprit }) => {
            let (link, fault) = culprit.named(model, system);
            result.status = Status::Law { t: *t, link, fault };
        }
        None if ended.interrupted && result.status.is_good() && ended.fallen.is_none() => {
            result.status = Status::Interrupted { t: result.end.time };
        }
        Some(Stop::Fatal(_)) | None => {}
    }
}

/// What the errors of the outputs say of a run: warnings, and its status where the basis does not hold the motion as well
/// as `allowed`; `compared`: whether a companion went beside it.
fn judge(
    result: &mut CaseResult,
    certificate: &Certificate<'_>,
    model: &Model,
    compared: bool,
    allowed: f64,
) -> Vec<String> {
    let mut warnings: Vec<String> = certificate.doubt(model, &result.errors).into_iter().collect();
    let unknown = result.errors.iter().any(|e| e.step.is_nan());
    if compared && unknown && result.status.is_good() {
        warnings.push(UNKNOWN.into());
    }
    if let Some((output, share)) = certificate.worst(model).filter(|(_, e)| *e > allowed)
        && result.status.is_good()
    {
        let output = model.outputs[output].name.clone();
        result.status = Status::Inadequate { output, share, allowed };
    }
    warnings
}

/// Said where the companion of a run has found no end.
const UNKNOWN: &str = "how far the steps are off is not known: the same run at twice the tolerance, which is made beside it to learn that, came to no end; another `tolerance` of the steps, or a shorter `dt`, may help";

/// Said where all motion is small beside what stands in springs.
const LOST: &str = "all motion is below a thousandth of what loads before it have done, and steps follow it no better than a motion of that size: a smaller tolerance, `step: Adaptive(tolerance: …)`, makes them finer";

//! A dynamic case: start state, basis, solver, output steps.

use crate::aside::aside;
use crate::basis::Bases;
use crate::case::{EndState, RunOptions, SoFar, constant_load, parameters};
use crate::certificate::Certificate;
use crate::clock::Clock;
use crate::companion::Companion;
use crate::damping::modal_damping;
use crate::defect::Defect;
use crate::drag::follow_supports;
use crate::equations::{Equations, bases, is_reduced, modes};
use crate::error::SolveError;
use crate::kernel::Remembered;
use crate::kicks::Kicks;
use crate::ledger::Ledger;
use crate::march::{March, Pace, Stop};
use crate::observe::{CaseResult, Observer, Status, Work};
use crate::output_step::{Moment, Moving, at_least, output_step};
use crate::outputs::Outputs;
use crate::plausible;
use crate::samples::Samples;
use crate::shadow::Shadow;
use crate::space::Space;
use crate::start::{Initial, check, constant_force, resume, start};
use crate::stepper::{State, Stepper};
use crate::timeline::Timeline;
use crate::view::{Viewer, looks_at_rates};
use std::sync::atomic::Ordering;
use trilith_model::{
    Analysis, Case, DynamicCase, MOST_OUTPUT_STEPS, Model, SolverKind, StepControl, output_steps,
};
use trilith_system::System;

/// A dynamic case and what it starts from.
pub(crate) struct Setup<'a> {
    pub model: &'a Model,
    pub system: &'a System,
    pub case: &'a Case,
    pub analysis: &'a DynamicCase,
    pub before: Option<EndState>,
}

/// Share of the static response to a load that a basis must hold without a warning.
const LOADS_HELD: f64 = 0.95;

/// Runs the case.
pub(crate) fn run(
    setup: Setup<'_>,
    options: RunOptions<'_>,
    observers: &mut [&mut dyn Observer],
) -> Result<CaseResult, SolveError> {
    let clock = Clock::start();
    let Setup { model, system, case, analysis, before } = setup;
    let mut widened;
    let analysis = match options.vectors {
        None => analysis,
        Some(vectors) => {
            widened = analysis.clone();
            widened.solution.basis.vectors = Some(vectors);
            &widened
        }
    };
    let solution = &analysis.solution;
    let kind = options.solver.unwrap_or(solution.solver);
    let dt = options.dt.unwrap_or(analysis.dt);
    let steps = output_steps(analysis.duration, dt);
    if steps > MOST_OUTPUT_STEPS as f64 {
        let (case, span) = (case.name.clone(), case.span.clone());
        return Err(SolveError::TooManySteps { case, steps, dt, span });
    }
    if let Some(end) = &options.from {
        check(model, system, case, kind, dt, end)?;
    }
    let constant = match &options.from {
        Some(end) => end.load.clone(),
        None => held_load(model, system, analysis, before.as_ref()),
    };
    let mut loads = system.dynamic_loads(model, analysis, constant.clone());
    let reduced = is_reduced(kind);
    let initial = match &options.from {
        Some(end) => end.initial.clone(),
        None => Initial::new(model, system, analysis, before.as_ref())?,
    };
    let judged = reduced && solution.basis.tolerance < 1.0 && !model.outputs.is_empty();
    let bases = bases(model, system, analysis, kind, &loads, &initial, judged)?;
    let damping = bases.as_ref().and_then(|b| modal_damping(model, system, b));
    follow_supports(model, system, damping.as_ref(), reduced, &mut loads)?;
    let equations = Equations {
        model,
        system,
        solution,
        kind,
        loads: &loads,
        bases: bases.as_ref(),
        damping: damping.as_ref(),
        watched: looks_at_rates(model, system, observers.iter().any(|o| o.wants_rates())),
    };
    let mut stepper = equations.stepper()?;
    let timeline = Timeline::new(dt, analysis.duration, &loads, at_least(solution.step));
    let mut warnings = Vec::new();
    if let (Some(b), true) = (&bases, reduced) {
        adequacy_warning(b, solution.basis.adequacy, &mut warnings);
    }
    let moves_at = match &options.from {
        Some(end) => (end.displacement.clone(), end.velocity.clone()),
        None => (initial.displacement.clone(), initial.velocity.clone()),
    };
    let RunOptions { from, until, substeps, step_errors, mut progress, vectors, interrupt, .. } =
        options;
    let largest = from.as_ref().map(|end| end.largest.clone()).unwrap_or_default();
    let set_out = |stepper: &mut dyn Stepper| match from.clone() {
        Some(end) => resume(end, stepper),
        None => start(model, system, &initial, &loads, stepper, [dt, analysis.duration]),
    };
    let (state, pace, ledger, first) = set_out(stepper.as_mut())?;
    let mut moving = Moving { state: Box::new(state), pace, ledger };
    let mut viewer = Viewer::new(model, system, &loads, stepper.space(), observers);
    viewer.look_inside(stepper.closed_form(), dt, largest);
    let wider = bases.as_ref().and_then(|b| b.wider.as_deref());
    let shadow = wider.map(|wider| {
        let modes = modes(model, system, &loads, wider);
        let at = (&*moves_at.0, &*moves_at.1);
        let t = timeline.time(first);
        aside(Shadow::new(model, system, &loads, modes, at, t, &moving.state))
    });
    let (shadow, listener) = shadow.unzip();
    let last = match until {
        Some(t) => ((t / dt) - 1e-9).ceil().max(0.0) as usize,
        None => timeline.steps,
    }
    .min(timeline.steps);
    let judged = !model.outputs.is_empty() && (step_errors || shadow.is_some());
    let steps = first..last;
    let mut certificate = judged.then(|| {
        let (space, state) = (stepper.space(), &moving.state);
        let samples = Samples::new(model, system, &loads, space, &timeline, steps.clone(), state);
        let few = Defect::is_worth(&timeline, steps.clone());
        let exact = bases.as_ref().filter(|_| step_errors && kind == SolverKind::Fna && few);
        let defect = exact.map(|bases| {
            let modes = modes(model, system, &loads, bases);
            Defect::new(model, system, &loads, modes, timeline.time(first), &moving.state)
        });
        let kicks = stepper.closed_form().filter(|_| step_errors).and_then(|form| {
            let (space, at) = (stepper.space(), (timeline.time(first), &*moving.state));
            let outputs = Outputs::new(model, system, space);
            Kicks::new(&outputs, space, &form.omega, timeline.dt, at)
        });
        let links = &system.links;
        let tolerance = solution.link_tolerance;
        Certificate::new(model, links, samples, shadow, defect, kicks, tolerance)
    });
    viewer.start(last.saturating_sub(first));
    viewer.show(timeline.time(first), Some(first), &moving.state, &moving.ledger);
    let setup_cpu = clock.cpu();
    let constant_force = constant_force(stepper.space(), &loads);
    let mut march = March::new(stepper.as_mut(), &loads, solution.step);
    march.budget = substeps.unwrap_or_else(|| solution.substep_limit(last.saturating_sub(first)));
    let companion = match solution.step {
        StepControl::Adaptive { tolerance } if step_errors && judged => {
            Some(Companion::new(equations, &timeline, tolerance, steps.clone(), march.budget))
        }
        _ => None,
    };
    let (mut stop, mut fallen, mut interrupted) = (None, None, false);
    let mut made = first;
    let outputs = model.outputs.len();
    let (beside, reduction) = std::thread::scope(|scope| {
        let beside = companion.as_ref().map(|companion| scope.spawn(|| companion.march(&set_out)));
        let shadow = listener.map(|listener| scope.spawn(move || listener.follow(outputs)));
        let mut way = |made: &mut usize| -> Result<(), Stop> {
            for step in steps.clone() {
                let end = timeline.time(step + 1) - 1e-12 * dt;
                let mut tell = |moment: Moment, t: f64, s: &State, l: &Ledger| match moment {
                    Moment::Jump => {
                        if let Some(certificate) = &mut certificate {
                            certificate.jump(t, s);
                        }
                        viewer.show_behind(t, s, l);
                    }
                    Moment::Substep(piece) => {
                        if let Some(certificate) = &mut certificate {
                            certificate.follow(piece, t, s);
                        }
                        if t < end {
                            viewer.show(t, None, s, l);
                        }
                    }
                };
                output_step(&timeline, step, &mut march, &constant_force, &mut moving, &mut tell)?;
                *made = step + 1;
                let Moving { state, ledger, .. } = &moving;
                viewer.show(timeline.time(*made), Some(*made), state, ledger);
                if let Some(tell) = progress.as_deref_mut() {
                    tell((*made - first) as f64 / (last - first) as f64);
                }
                fallen = viewer.overturned(state);
                interrupted = *made < last && interrupt.is_some_and(|i| i.load(Ordering::Relaxed));
                if fallen.is_some() || interrupted {
                    break;
                }
            }
            Ok(())
        };
        stop = way(&mut made).err();
        if let Some(companion) = &companion {
            companion.end(made);
        }
        if let Some(certificate) = &mut certificate {
            certificate.end();
        }
        // Where the companion finds no start, the run finds none either.
        let beside = beside.and_then(|thread| thread.join().ok()).and_then(Result::ok);
        (beside, shadow.map(|thread| thread.join().ok()))
    });
    if let (Some(certificate), Some(reduction)) = (&mut certificate, reduction) {
        certificate.reduce(reduction);
    }
    let mut beside: Vec<Samples> = beside.into_iter().collect();
    let mut errors = certificate.as_ref().map(|c| c.errors(model, &beside, analysis.duration));
    if let (Some(certificate), Some(errors), Some(companion)) = (&certificate, &mut errors, &companion)
        && !interrupted
        && certificate.is_unsure(model, errors)
        && let Ok(second) = companion.second().march(&set_out)
        // One that has broken off says nothing.
        && beside.iter().all(|first| second.reach(first))
    {
        beside.push(second);
        *errors = certificate.errors(model, &beside, analysis.duration);
    }
    let Moving { state, pace, ledger } = moving;
    if matches!(solution.step, StepControl::Adaptive { .. }) && pace.is_lost() && ledger.moves() {
        warnings.push(LOST.into());
    }
    viewer.end(&state, &ledger);
    let (largest, noticed) = (viewer.largest(), viewer.noticed());
    let counts = march.counts;
    if let Some(Stop::Fatal(e)) = stop {
        return Err(e);
    }
    if counts.forced > 0 {
        warnings.push(format!(
            "{} substeps were accepted at the smallest size although their error was above the tolerance",
            counts.forced
        ));
    }
    if let (StepControl::Fixed { .. }, Some(ratio)) = (solution.step, stepper.beyond_exact()) {
        warnings.push(format!(
            "fixed steps were too long for the exact rule at the stiffest link (ω Δt = {:.2}; limit of stability 3.46): they were made by average acceleration, and nothing watched their error; `step: Adaptive(…)` does",
            (6.0 * ratio).sqrt()
        ));
    }
    let (iterations, factorizations) = stepper.work();
    let work = Work {
        steps: made - first,
        substeps: counts.substeps,
        iterations,
        rejected: counts.rejected,
        factorizations,
        forced: counts.forced,
        wall_s: clock.wall(),
        setup_cpu_s: setup_cpu,
        march_cpu_s: clock.cpu() - setup_cpu,
        ..Work::default()
    };
    let state = *state;
    let arrival = Arrival {
        timeline: &timeline,
        made,
        state,
        pace,
        ledger,
        constant,
        initial,
        fallen,
        largest,
    };
    let mut result =
        arrival.result(model, system, case, kind, stepper.space(), stepper.memory(), work);
    match stop {
        Some(Stop::NoEquilibrium { t, worst, residual }) => {
            let worst = system.links.name(model, worst);
            result.status = Status::NotConverged { t, worst, residual };
        }
        Some(Stop::Spent { t }) => {
            result.status = Status::Spent { t, tried: counts.substeps + counts.rejected };
        }
        None if interrupted && result.status.is_good() && fallen.is_none() => {
            result.status = Status::Interrupted { t: result.end.time };
        }
        Some(Stop::Fatal(_)) | None => {}
    }
    if let (Some(certificate), Some(errors)) = (&certificate, errors) {
        result.errors = errors;
        warnings.extend(certificate.doubt(model, &result.errors));
        let unknown = result.errors.iter().any(|e| e.step.is_nan());
        if companion.is_some() && unknown && result.status.is_good() {
            warnings.push(UNKNOWN.into());
        }
        let allowed = solution.basis.tolerance;
        if let Some((output, share)) = certificate.worst(model).filter(|(_, e)| *e > allowed)
            && result.status.is_good()
        {
            let output = model.outputs[output].name.clone();
            result.status = Status::Inadequate { output, share, allowed };
        }
    }
    let case = (case, analysis);
    warnings.extend(plausible::of_dynamic((model, system), case, &loads, noticed, &result));
    result.end.vectors = vectors;
    // Where nothing is free, there are no modes to speak of.
    result.basis = bases.as_ref().filter(|_| reduced && !system.idle).map(|b| b.report.clone());
    result.warnings = warnings;
    Ok(result)
}

/// Said where the companion of a run has found no end.
const UNKNOWN: &str = "how far the steps are off is not known: the same run at twice the tolerance, which is made beside it to learn that, came to no end; another `tolerance` of the steps, or a shorter `dt`, may help";

/// Said where all motion is small beside what stands in springs.
const LOST: &str = "all motion is below a thousandth of what loads before it have done, and steps follow it no better than a motion of that size: a smaller tolerance, `step: Adaptive(tolerance: …)`, makes them finer";

/// Where a run ended, and what it carries there.
pub(crate) struct Arrival<'a> {
    pub timeline: &'a Timeline,
    /// Output steps made since the start of the case.
    pub made: usize,
    pub state: State,
    pub pace: Pace,
    pub ledger: Ledger,
    /// Constant loads on the free DOFs.
    pub constant: Vec<f64>,
    /// What it started from.
    pub initial: Initial,
    /// Index of the element of a body that has fallen over.
    pub fallen: Option<usize>,
    /// Largest values of the outputs, where looks inside steps hang on them.
    pub largest: Vec<f64>,
}

impl Arrival<'_> {
    /// What the run leaves; basis and warnings still missing.
    pub(crate) fn result(
        self,
        model: &Model,
        system: &System,
        case: &Case,
        kind: SolverKind,
        space: &Space,
        memory: Vec<Remembered>,
        work: Work,
    ) -> CaseResult {
        let Self { timeline, made, state, pace, ledger, constant, initial, fallen, largest } = self;
        // Where the links were led from, nobody asks at the end.
        let initial = Initial { links: None, ..initial };
        let share = ledger.totals.error_relative;
        let limit = match &case.analysis {
            Analysis::Dynamic(analysis) => analysis.solution.energy_limit,
            Analysis::Static(_) => f64::INFINITY,
        };
        let status = if share > limit {
            Status::EnergyError { share, limit }
        } else {
            fallen.map_or(Status::Converged, |element| Status::Overturned {
                t: timeline.time(made),
                body: model.elements[element].name.clone(),
            })
        };
        let n = space.order();
        let totals = ledger.totals;
        let links = system.links.links.iter().zip(&ledger.links);
        let link_energy = links.map(|(l, e)| (l.element, *e)).collect();
        let end = EndState {
            model: model.sha256(),
            case: case.name.clone(),
            solver: kind.name().into(),
            parameters: parameters(model),
            dt: timeline.dt,
            time: timeline.time(made),
            step: made,
            displacement: space.expand(&state.motion[..n]),
            velocity: space.expand(&state.motion[n..2 * n]),
            load: constant,
            initial,
            vectors: None,
            pace,
            memory,
            ledger,
            state,
            largest,
            seen: SoFar::default(),
        };
        CaseResult {
            case: case.name.clone(),
            solver: kind.name(),
            status,
            work,
            energy: totals,
            link_energy,
            basis: None,
            warnings: Vec::new(),
            errors: Vec::new(),
            end,
        }
    }
}

/// Constant loads on the free DOFs: the case's own and those of the case before.
pub(crate) fn held_load(
    model: &Model,
    system: &System,
    analysis: &DynamicCase,
    before: Option<&EndState>,
) -> Vec<f64> {
    let mut constant = constant_load(model, system, &analysis.constant);
    if let Some(end) = before {
        constant.iter_mut().zip(&end.load).for_each(|(x, y)| *x += y);
    }
    constant
}

fn adequacy_warning(bases: &Bases, wanted: f64, warnings: &mut Vec<String>) {
    let poor: Vec<_> = bases.report.adequacy.iter().filter(|a| a.share < wanted).collect();
    if let Some(worst) = poor.first() {
        warnings.push(format!(
            "the basis of {} vectors holds only {:.1} % of the flexibility at {} (wanted {:.1} %; {} coordinates below): use more vectors",
            bases.report.vectors,
            100.0 * worst.share,
            worst.coordinate,
            100.0 * wanted,
            poor.len()
        ));
    }
    // Where no basis was asked for that holds the links, loads are the user's business as well.
    let loads = bases.report.static_participation.iter().filter(|_| wanted > 0.0);
    for (name, share) in loads.filter(|(_, share)| *share < LOADS_HELD) {
        warnings.push(format!(
            "the basis of {} vectors holds only {:.1} % of the static response to {name}: displacements near that load are too small",
            bases.report.vectors,
            100.0 * share
        ));
    }
}

//! A dynamic case: start state, basis, solver, output steps.

use crate::basis::{self, Bases, Demands};
use crate::case::{EndState, RunOptions, SoFar, constant_load, parameters};
use crate::certificate::{Certificate, Shadow};
use crate::clock::Clock;
use crate::damping::modal_damping;
use crate::drag::follow_supports;
use crate::error::SolveError;
use crate::full_newton::FullNewton;
use crate::hht::Hht;
use crate::kernel::{LinkKernel, Remembered};
use crate::ledger::Ledger;
use crate::link_side::LinkSide;
use crate::march::{March, Pace, Stop};
use crate::modal::{Modal, Modes};
use crate::observe::{CaseResult, Observer, Status, Work};
use crate::space::Space;
use crate::start::{Initial, check, constant_force, potential, resume, start};
use crate::stepper::{LinkStepper, State, StepEnergy, Stepper};
use crate::timeline::Timeline;
use crate::view::{Viewer, looks_at_rates};
use trilith_model::{
    Analysis, Case, Damping, DynamicCase, Model, Side, Solution, SolverKind, StepControl,
};
use trilith_system::{Channel, LoadSet, System, Track};

/// A dynamic case and what it starts from.
pub(crate) struct Setup<'a> {
    pub model: &'a Model,
    pub system: &'a System,
    pub case: &'a Case,
    pub analysis: &'a DynamicCase,
    pub before: Option<EndState>,
}

/// Load directions that a basis must hold: name and vector on the free DOFs.
pub(crate) fn basis_loads(
    model: &Model,
    analysis: &DynamicCase,
    loads: &LoadSet,
) -> Vec<(String, Vec<f64>)> {
    let mut names: Vec<String> = Vec::new();
    if loads.channels.iter().any(|c| matches!(c.track, Track::Constant)) {
        names.push("constant loads".into());
    }
    for b in &analysis.base {
        names.push(format!("base {}", &b.direction.name()[1..].to_uppercase()));
    }
    for f in &analysis.forces {
        names.push(format!("load {}", model.patterns[f.pattern].name));
    }
    for s in &analysis.supports {
        for kind in ["displacement", "velocity", "acceleration"] {
            names.push(format!("{kind} of \"{}\" {}", model.nodes[s.node].name, s.dof.name()));
        }
    }
    names
        .into_iter()
        .zip(&loads.channels)
        .filter(|(_, c)| c.force.iter().any(|x| *x != 0.0))
        .map(|(n, c)| (n, c.force.clone()))
        .collect()
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
    let judged = reduced && solution.basis.tolerance < 1.0;
    let bases = bases(model, system, analysis, kind, &loads, &initial, judged)?;
    let damping = bases.as_ref().and_then(|b| modal_damping(model, system, b));
    follow_supports(model, system, damping.as_ref(), reduced, &mut loads)?;
    let none = vec![0.0; system.links.len()];
    let effective = if kind == SolverKind::FullNewton { &none } else { &system.links.effective };
    let watched = looks_at_rates(model, system, observers.iter().any(|o| o.wants_rates()));
    let side = |order: usize| link_side(model, system, solution, &loads, order, watched);
    let mut stepper: Box<dyn Stepper + '_> = match (kind, &bases) {
        (SolverKind::Fna, Some(b)) => {
            let modes = modes(model, system, &loads, b);
            let side = side(modes.space.order());
            Box::new(LinkStepper::new(Modal::new(modes), side))
        }
        (SolverKind::RitzHht, Some(b)) => {
            let space = Space::reduced(system, &loads, effective, damping.as_ref(), &b.stepping);
            let side = side(space.order());
            Box::new(LinkStepper::new(Hht::new(space, solution.alpha), side))
        }
        (SolverKind::FullNewton, _) => Box::new(FullNewton {
            model,
            system,
            loads: &loads,
            space: Space::physical(system, &loads, effective, damping),
            alpha: solution.alpha,
            iterations: 0,
            factorizations: 0,
        }),
        _ => {
            let space = Space::physical(system, &loads, effective, damping);
            let side = side(space.order());
            Box::new(LinkStepper::new(Hht::new(space, solution.alpha), side))
        }
    };
    let timeline = Timeline::new(dt, analysis.duration, &loads, at_least(solution.step));
    let mut warnings = Vec::new();
    if let (Some(b), true) = (&bases, reduced) {
        adequacy_warning(b, solution.basis.adequacy, &mut warnings);
    }
    let moves_at = match &options.from {
        Some(end) => (end.displacement.clone(), end.velocity.clone()),
        None => (initial.displacement.clone(), initial.velocity.clone()),
    };
    let largest = options.from.as_ref().map(|end| end.largest.clone()).unwrap_or_default();
    let (state, mut pace, mut ledger, first) = match options.from {
        Some(end) => resume(end, stepper.as_mut())?,
        None => start(model, system, &initial, &loads, stepper.as_mut(), dt)?,
    };
    let mut state = Box::new(state);
    let mut viewer = Viewer::new(model, system, &loads, stepper.space(), observers);
    viewer.look_inside(stepper.closed_form(), dt, largest);
    let wider = bases.as_ref().and_then(|b| b.wider.as_deref());
    let shadow = wider.map(|wider| {
        let modes = modes(model, system, &loads, wider);
        let at = (&*moves_at.0, &*moves_at.1);
        Shadow::new(model, system, &loads, modes, at, timeline.time(first), &state)
    });
    let adaptive = matches!(solution.step, StepControl::Adaptive { .. });
    let mut certificate = (!model.outputs.is_empty() && (adaptive || shadow.is_some()))
        .then(|| Certificate::new(model, system, &loads, stepper.space(), shadow));
    let last = match options.until {
        Some(t) => ((t / dt) - 1e-9).ceil().max(0.0) as usize,
        None => timeline.steps,
    }
    .min(timeline.steps);
    viewer.start(last.saturating_sub(first));
    viewer.show(timeline.time(first), Some(first), &state, &ledger);
    let setup_cpu = clock.cpu();
    let mut progress = options.progress;
    let constant_force = constant_force(stepper.space(), &loads);
    let mut march = March::new(stepper.as_mut(), &loads, solution.step);
    march.budget = options.substeps.unwrap_or(usize::MAX);
    let (mut stop, mut fallen) = (None, None);
    let mut made = first;
    for step in first..last {
        let outcome = output_step(
            &timeline,
            step,
            &mut march,
            &constant_force,
            &mut state,
            &mut pace,
            &mut ledger,
            &mut viewer,
            &mut certificate,
        );
        if let Err(e) = outcome {
            stop = Some(e);
            break;
        }
        made = step + 1;
        viewer.show(timeline.time(made), Some(made), &state, &ledger);
        if let Some(certificate) = &mut certificate {
            certificate.look(timeline.time(made), &state);
        }
        if let Some(tell) = progress.as_deref_mut() {
            tell((made - first) as f64 / (last - first) as f64);
        }
        fallen = viewer.overturned(&state);
        if fallen.is_some() {
            break;
        }
    }
    viewer.end(&state, &ledger);
    let largest = viewer.largest();
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
        step_error: counts.error(),
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
        Some(Stop::Fatal(_)) | None => {}
    }
    if let Some(certificate) = &certificate {
        // Nobody watches fixed steps.
        result.errors = certificate.errors(if adaptive { counts.error() } else { f64::NAN });
        let allowed = solution.basis.tolerance;
        if let Some((output, share)) = certificate.worst(model).filter(|(_, e)| *e > allowed)
            && result.status.is_good()
        {
            let output = model.outputs[output].name.clone();
            result.status = Status::Inadequate { output, share, allowed };
        }
    }
    result.end.vectors = options.vectors;
    result.basis = if reduced { bases.map(|b| b.report) } else { None };
    result.warnings = warnings;
    Ok(result)
}

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
            model: model.source.sha256.clone(),
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

fn is_reduced(kind: SolverKind) -> bool {
    matches!(kind, SolverKind::Fna | SolverKind::RitzHht)
}

/// The bases that a solver or modal damping needs.
pub(crate) fn bases(
    model: &Model,
    system: &System,
    analysis: &DynamicCase,
    kind: SolverKind,
    loads: &LoadSet,
    initial: &Initial,
    wider: bool,
) -> Result<Option<Bases>, SolveError> {
    let modal = matches!(model.damping, Damping::Modal { .. } | Damping::ModalTable { .. });
    if !modal && !is_reduced(kind) {
        system.check_supported(model, true)?;
        return Ok(None);
    }
    let mut demands = Demands::new(system, basis_loads(model, analysis, loads), initial);
    demands.wider = wider;
    let settings = &analysis.solution.basis;
    // Who asks for no flexibility of the links needs no report of it.
    let adequacy = is_reduced(kind) && settings.adequacy > 0.0;
    Ok(Some(basis::build(model, system, settings, &demands, adequacy)?))
}

/// The structure of FNA on its basis.
pub(crate) fn modes(model: &Model, system: &System, loads: &LoadSet, bases: &Bases) -> Modes {
    let links = &system.links;
    let engaged = links.engaged(model);
    let engaged = links.active.iter().map(|i| engaged[*i]).collect();
    let damping = modal_damping(model, system, bases);
    let stepping = &bases.stepping;
    let space = Space::reduced(system, loads, &links.effective, damping.as_ref(), stepping);
    Modes::new(space, engaged)
}

/// The link side of a motion with this many coordinates; `watched` as [`looks_at_rates`] says.
pub(crate) fn link_side<'a>(
    model: &'a Model,
    system: &'a System,
    solution: &Solution,
    loads: &'a LoadSet,
    order: usize,
    watched: bool,
) -> LinkSide<'a> {
    let links = &system.links;
    let dummies = links.active.iter().map(|i| links.effective[*i]).collect();
    let kernel = LinkKernel::new(model, links, solution, dummies);
    LinkSide::new(model, system, loads, kernel, order, watched)
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

/// Steps that are made of a piece of the timeline at least.
pub(crate) fn at_least(step: StepControl) -> usize {
    match step {
        StepControl::Fixed { substeps } => substeps,
        StepControl::Adaptive { .. } => 1,
    }
}

/// How the amplitudes of the loads jump at a time; none where they do not.
pub(crate) fn jump(loads: &LoadSet, t: f64) -> Option<Vec<f64>> {
    let jump = |c: &Channel| c.track.at(t, Side::After) - c.track.at(t, Side::Before);
    let change: Vec<f64> = loads.channels.iter().map(jump).collect();
    change.iter().any(|x| *x != 0.0).then_some(change)
}

/// One output step: its pieces, with loads that jump between them.
fn output_step(
    timeline: &Timeline,
    step: usize,
    march: &mut March<'_>,
    constant: &[f64],
    state: &mut Box<State>,
    pace: &mut Pace,
    ledger: &mut Ledger,
    viewer: &mut Viewer<'_, '_>,
    certificate: &mut Option<Certificate<'_>>,
) -> Result<(), Stop> {
    let end = timeline.time(step + 1);
    for piece in timeline.pieces(step) {
        let t0 = piece.start;
        if t0 > 0.0 && timeline.is_jump(t0) {
            march.cut();
            if let Some(change) = jump(march.loads, t0) {
                march.stepper.jump(state, &change).map_err(Stop::Fatal)?;
                viewer.show_behind(t0, state, ledger);
            }
        }
        let mut accept = |t: f64, s: &State, e: &StepEnergy| -> f64 {
            let energy = ledger.enter(e, potential(constant, s));
            if let Some(certificate) = certificate {
                certificate.follow(t, s);
            }
            if t < end - 1e-12 * timeline.dt {
                viewer.show(t, None, s, ledger);
            }
            energy
        };
        march.segment(state, pace, piece, &mut accept)?;
    }
    Ok(())
}

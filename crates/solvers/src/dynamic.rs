//! A dynamic case: start state, basis, solver, output steps.

use crate::basis::{self, Bases};
use crate::case::{EndState, RunOptions, constant_load};
use crate::clock::{Clock, peak_rss_mb};
use crate::error::SolveError;
use crate::full_newton::FullNewton;
use crate::hht::Hht;
use crate::kernel::LinkKernel;
use crate::ledger::Ledger;
use crate::march::{Counts, March, Pace, Stop};
use crate::modal::Modal;
use crate::observe::{CaseResult, Observer, Sample, Shape, Status, Work};
use crate::outputs::Outputs;
use crate::propagator::kinetic_and_strain;
use crate::space::{LowRank, Space};
use crate::stepper::{LinkStepper, State, StepEnergy, Stepper};
use trilith_element::{Contact, Kinematics, Link};
use trilith_linalg::Dense;
use trilith_model::{Case, Damping, DynamicCase, Model, Side, SolverKind, StepControl};
use trilith_system::{LoadSet, System, Track};

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

/// Ratio of modal damping at a circular frequency.
fn damping_ratio(damping: &Damping, omega: f64) -> f64 {
    match damping {
        Damping::Modal { ratio } => *ratio,
        Damping::ModalTable { points } => {
            let f = omega / std::f64::consts::TAU;
            let after = points.iter().position(|(x, _)| *x >= f).unwrap_or(points.len());
            match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
                (Some((x0, y0)), Some((x1, y1))) => y0 + (y1 - y0) * (f - x0) / (x1 - x0),
                (Some((_, y)), None) | (None, Some(&(_, y))) => y,
                (None, None) => 0.0,
            }
        }
        _ => 0.0,
    }
}

fn modal_damping(model: &Model, system: &System, bases: &Bases) -> Option<LowRank> {
    let modes = &bases.structural;
    let rates: Vec<f64> = modes
        .omega2
        .iter()
        .map(|w2| {
            let omega = w2.max(0.0).sqrt();
            2.0 * damping_ratio(&model.damping, omega) * omega
        })
        .collect();
    let kept: Vec<usize> = (0..rates.len()).filter(|j| rates[*j] > 0.0).collect();
    if kept.is_empty() {
        return None;
    }
    let mut u = Dense::zeros(system.order(), kept.len());
    for (new, old) in kept.iter().enumerate() {
        system.mass.mul_add(1.0, modes.vectors.column(*old), u.column_mut(new));
    }
    Some(LowRank { u, rate: kept.iter().map(|j| rates[*j]).collect() })
}

/// Displacements of all nodes of one state.
struct Figure<'a> {
    system: &'a System,
    space: &'a Space,
    state: &'a State,
    prescribed: Vec<f64>,
}

impl Shape for Figure<'_> {
    fn displacements(&self, u: &mut [f64]) {
        let free = self.space.expand(&self.state.motion[..self.space.order()]);
        for (full, x) in u.iter_mut().enumerate() {
            *x = self
                .system
                .reduction
                .expand(full)
                .iter()
                .map(|(j, c)| c * free.get(*j).unwrap_or_else(|| &self.prescribed[j - free.len()]))
                .sum();
        }
    }
}

/// Shows accepted substeps to the observers.
struct Viewer<'a, 'b> {
    model: &'a Model,
    system: &'a System,
    loads: &'a LoadSet,
    outputs: Outputs,
    values: Vec<f64>,
    rates: Vec<f64>,
    observers: &'a mut [&'b mut dyn Observer],
}

impl Viewer<'_, '_> {
    fn show(&mut self, t: f64, step: Option<usize>, state: &State, space: &Space, ledger: &Ledger) {
        if self.observers.is_empty() {
            return;
        }
        self.outputs.evaluate(t, state, self.loads, &mut self.values, &mut self.rates);
        let contacts = contacts(self.model, self.system, state);
        let count = self.system.reduction.prescribed.len();
        let [prescribed, _, _] = self.loads.prescribed(t, Side::Before, count);
        let shape = Figure { system: self.system, space, state, prescribed };
        for observer in self.observers.iter_mut() {
            observer.sample(&Sample {
                t,
                output_step: step,
                values: &self.values,
                rates: &self.rates,
                energy: &ledger.totals,
                contacts: &contacts,
                shape: &shape,
            });
        }
    }
}

fn contacts(model: &Model, system: &System, state: &State) -> Vec<(usize, Contact)> {
    let links = &system.links;
    links
        .links
        .iter()
        .filter_map(|link| {
            let r = link.range.clone();
            let (d, v) = (&state.d[r.clone()], &state.v[r.clone()]);
            let at = Kinematics { d, v, d0: d, v0: v, dt: 0.0 };
            let law: &dyn Link = links.law(model, link)?;
            law.contact(&at, &state.history[link.history.clone()], &state.f[r])
                .map(|c| (link.element, c))
        })
        .collect()
}

/// Output times and, between them, the pieces that end where a load jumps.
struct Timeline {
    dt: f64,
    steps: usize,
    duration: f64,
    breaks: Vec<f64>,
}

impl Timeline {
    fn time(&self, step: usize) -> f64 {
        (step as f64 * self.dt).min(self.duration)
    }

    /// (start, length) of the pieces of an output step.
    fn pieces(&self, step: usize) -> Vec<(f64, f64)> {
        let (t0, t1) = (self.time(step), self.time(step + 1));
        let near = 1e-9 * self.dt;
        let inside: Vec<f64> =
            self.breaks.iter().copied().filter(|t| *t > t0 + near && *t < t1 - near).collect();
        if inside.is_empty() && step + 1 < self.steps {
            return vec![(t0, self.dt)];
        }
        let mut ends = inside;
        ends.push(t1);
        let mut start = t0;
        ends.into_iter()
            .map(|end| {
                let piece = (start, end - start);
                start = end;
                piece
            })
            .collect()
    }
}

/// Runs the case.
pub(crate) fn run(
    setup: Setup<'_>,
    options: RunOptions<'_>,
    observers: &mut [&mut dyn Observer],
) -> Result<CaseResult, SolveError> {
    let clock = Clock::start();
    let Setup { model, system, case, analysis, before } = setup;
    system.check_supported(model, true)?;
    let solution = &analysis.solution;
    let kind = options.solver.unwrap_or(solution.solver);
    let mut constant = constant_load(model, system, &analysis.constant);
    if let Some(end) = &before {
        for (x, y) in constant.iter_mut().zip(&end.load) {
            *x += y;
        }
    } else if let Some(end) = &options.from {
        constant.clone_from(&end.load);
    }
    let loads = system.dynamic_loads(model, analysis, constant.clone());
    let modal = matches!(model.damping, Damping::Modal { .. } | Damping::ModalTable { .. });
    let reduced = matches!(kind, SolverKind::Fna | SolverKind::RitzHht);
    let bases = if modal || reduced {
        let directions = basis_loads(model, analysis, &loads);
        Some(basis::build(model, system, &solution.basis, &directions)?)
    } else {
        None
    };
    let damping = bases.as_ref().and_then(|b| modal_damping(model, system, b));
    let none = vec![0.0; system.links.len()];
    let effective = if kind == SolverKind::FullNewton { &none } else { &system.links.effective };
    let physical = Space::physical(system, &loads, effective, damping);
    let kernel = LinkKernel::new(
        &system.links,
        solution.kernel,
        physical.dummy_k.clone(),
        physical.dummy_c.clone(),
    );
    let mut stepper: Box<dyn Stepper + '_> = match (kind, &bases) {
        (SolverKind::Fna, Some(b)) => {
            let propagator = Modal::new(Space::reduced(&physical, &b.stepping));
            Box::new(LinkStepper { model, system, loads: &loads, propagator, kernel })
        }
        (SolverKind::RitzHht, Some(b)) => {
            let propagator = Hht::new(Space::reduced(&physical, &b.stepping), solution.alpha);
            Box::new(LinkStepper { model, system, loads: &loads, propagator, kernel })
        }
        (SolverKind::FullNewton, _) => Box::new(FullNewton {
            model,
            system,
            loads: &loads,
            space: physical,
            alpha: solution.alpha,
            iterations: 0,
            factorizations: 0,
        }),
        _ => {
            let propagator = Hht::new(physical, solution.alpha);
            Box::new(LinkStepper { model, system, loads: &loads, propagator, kernel })
        }
    };
    let dt = options.dt.unwrap_or(analysis.dt);
    let timeline = Timeline {
        dt,
        steps: ((analysis.duration / dt) - 1e-9).ceil().max(1.0) as usize,
        duration: analysis.duration,
        breaks: loads.breaks(analysis.duration),
    };
    let mut warnings = Vec::new();
    if let (Some(b), true) = (&bases, reduced) {
        adequacy_warning(b, solution.basis.adequacy, &mut warnings);
    }
    if let StepControl::Fixed { substeps } = solution.step {
        let size = dt / substeps as f64;
        let ratio = stepper.stiffness_ratio(size, &system.links.engaged(model))?;
        if ratio > 2.0 {
            warnings.push(format!(
                "fixed steps of {size:.3e} s are beyond the stability limit of the exact rule for the stiffest link (ω Δt = {:.2}, limit 3.46): use `step: Adaptive(…)`, more substeps or the solver ritz-hht",
                (6.0 * ratio).sqrt()
            ));
        }
    }
    let (mut state, mut pace, mut ledger, first) = match options.from {
        Some(end) => resume(model, case, kind, end, stepper.as_mut())?,
        None => start(model, system, analysis, before, &loads, stepper.as_mut(), dt)?,
    };
    let outputs = Outputs::new(model, system, stepper.space());
    let count = model.outputs.len();
    let mut viewer = Viewer {
        model,
        system,
        loads: &loads,
        outputs,
        values: vec![0.0; count],
        rates: vec![0.0; count],
        observers,
    };
    viewer.show(timeline.time(first), Some(first), &state, stepper.space(), &ledger);
    let setup_cpu = clock.cpu();
    let last = match options.until {
        Some(t) => ((t / dt) - 1e-9).ceil().max(0.0) as usize,
        None => timeline.steps,
    }
    .min(timeline.steps);
    let mut progress = options.progress;
    let mut counts = Counts::default();
    let mut stop = None;
    let mut made = first;
    for step in first..last {
        let outcome = output_step(
            &timeline,
            step,
            stepper.as_mut(),
            &loads,
            solution.step,
            &mut state,
            &mut pace,
            &mut ledger,
            &mut viewer,
            &mut counts,
        );
        if let Err(e) = outcome {
            stop = Some(e);
            break;
        }
        made = step + 1;
        viewer.show(timeline.time(made), Some(made), &state, stepper.space(), &ledger);
        if let Some(tell) = progress.as_deref_mut() {
            tell((made - first) as f64 / (last - first) as f64);
        }
    }
    let status = match stop {
        Some(Stop::Fatal(e)) => return Err(e),
        Some(Stop::NoEquilibrium { t, worst, residual }) => {
            Status::NotConverged { t, worst: system.links.name(model, worst), residual }
        }
        None if ledger.totals.error_relative > solution.energy_limit => Status::EnergyError {
            share: ledger.totals.error_relative,
            limit: solution.energy_limit,
        },
        None => Status::Converged,
    };
    if counts.forced > 0 {
        warnings.push(format!(
            "{} substeps were accepted at the smallest size although their error was above the tolerance",
            counts.forced
        ));
    }
    let (iterations, factorizations) = stepper.work();
    let n = stepper.space().order();
    let end = EndState {
        model: model.source.sha256.clone(),
        case: case.name.clone(),
        solver: kind.name().into(),
        time: timeline.time(made),
        step: made,
        displacement: stepper.space().expand(&state.motion[..n]),
        velocity: stepper.space().expand(&state.motion[n..2 * n]),
        load: constant,
        pace,
        memory: stepper.memory(),
        ledger: ledger.clone(),
        state,
    };
    Ok(CaseResult {
        case: case.name.clone(),
        solver: kind.name(),
        status,
        work: Work {
            steps: made - first,
            substeps: counts.substeps,
            iterations,
            rejected: counts.rejected,
            factorizations,
            forced: counts.forced,
            wall_s: clock.wall(),
            setup_cpu_s: setup_cpu,
            march_cpu_s: clock.cpu() - setup_cpu,
            peak_rss_mb: peak_rss_mb(),
        },
        energy: ledger.totals,
        link_energy: system
            .links
            .links
            .iter()
            .zip(&ledger.links)
            .map(|(l, e)| (l.element, *e))
            .collect(),
        basis: if reduced { bases.map(|b| b.report) } else { None },
        warnings,
        end,
    })
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
}

/// One output step: its pieces, with loads that jump between them.
fn output_step(
    timeline: &Timeline,
    step: usize,
    stepper: &mut dyn Stepper,
    loads: &LoadSet,
    control: StepControl,
    state: &mut State,
    pace: &mut Pace,
    ledger: &mut Ledger,
    viewer: &mut Viewer<'_, '_>,
    counts: &mut Counts,
) -> Result<(), Stop> {
    let end = timeline.time(step + 1);
    for (t0, length) in timeline.pieces(step) {
        if t0 > 0.0 {
            let change: Vec<f64> = loads
                .channels
                .iter()
                .map(|c| c.track.at(t0, Side::After) - c.track.at(t0, Side::Before))
                .collect();
            if change.iter().any(|x| *x != 0.0) {
                stepper.jump(state, &change).map_err(Stop::Fatal)?;
            }
        }
        let mut accepted: Vec<(f64, State, Ledger)> = Vec::new();
        let keep = !viewer.observers.is_empty();
        let constant = constant_force(stepper.space(), loads);
        let mut accept = |t: f64, s: &State, e: &StepEnergy| -> f64 {
            let energy = ledger.enter(e, potential(&constant, s));
            if keep && t < end - 1e-12 * timeline.dt {
                accepted.push((t, s.clone(), ledger.clone()));
            }
            energy
        };
        let mut march = March { stepper, loads, control, counts: *counts };
        let outcome = march.segment(state, pace, t0, length, &mut accept);
        *counts = march.counts;
        for (t, s, l) in &accepted {
            viewer.show(*t, None, s, stepper.space(), l);
        }
        outcome?;
    }
    Ok(())
}

/// Σ of constant loads in the coordinates of the solver.
fn constant_force(space: &Space, loads: &LoadSet) -> Vec<f64> {
    let amplitudes: Vec<f64> =
        loads.channels.iter().map(|c| f64::from(u8::from(c.conservative))).collect();
    space.force(&amplitudes)
}

fn potential(constant: &[f64], state: &State) -> f64 {
    -constant.iter().zip(&state.motion).map(|(p, u)| p * u).sum::<f64>()
}

type Start = (State, Pace, Ledger, usize);

fn start(
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

fn resume(
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

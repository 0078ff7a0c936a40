//! Cases: static ones, dynamic ones, and chains of them.

use super::checkpoint::{check_static, parameters};
use super::clock::{Clock, peak_rss_mb};
use super::dynamic;
use super::end_state::{EndState, Initial};
use super::prepared::Setup;
use super::result::{CaseResult, Status, Work};
use crate::basis::{BasisReport, Demands};
use crate::checks;
use crate::error::SolveError;
use crate::record::{EnergyTotals, LinkEnergy, Observer, show_static};
use crate::statics::{self, Equilibrium};
use crate::step::{Culprit, untouched};
use std::sync::atomic::AtomicBool;
use trilith_model::{Analysis, Case, Load, Model, SolverKind, StaticCase};
use trilith_system::{System, catch};

/// What to run.
#[derive(Default)]
pub struct RunOptions<'a> {
    /// Index of the case.
    pub case: usize,
    /// Solver; `None`: the case's own.
    pub solver: Option<SolverKind>,
    /// Output step in s; `None`: the case's own.
    pub dt: Option<f64>,
    /// Stop at the first output time not before this, s.
    pub until: Option<f64>,
    /// Vectors of the basis; `None`: as the case says.
    pub vectors: Option<usize>,
    /// Stop when so many substeps have been tried; `None`: go on.
    pub substeps: Option<usize>,
    /// Find out what the steps make of the errors of the outputs: the case is run a second time, beside, at a looser
    /// tolerance. Fixed steps have none.
    pub step_errors: bool,
    /// Continue the case from where an earlier run stopped.
    pub from: Option<EndState>,
    /// Receives the finished share of the run, 0 … 1.
    pub progress: Option<&'a mut dyn FnMut(f64)>,
    /// Stop at the next output time once this is true; a case that is continued is not begun then.
    pub interrupt: Option<&'a AtomicBool>,
}

/// Runs a case and, before it, the cases that it continues.
///
/// # Errors
/// [`SolveError`] where the run cannot be made. A run that stops on the way is no error: its
/// [`Status`] says so and the observers keep what they saw.
pub fn run(
    model: &Model,
    system: &System,
    options: RunOptions<'_>,
    observers: &mut [&mut dyn Observer],
) -> Result<CaseResult, SolveError> {
    let before = match options.from {
        None => {
            before(model, system, &model.cases[options.case], options.solver, options.interrupt)?
        }
        Some(_) => None,
    };
    let mut result = one(model, system, before, options, observers)?;
    // Only here: a look at the memory of the process costs more than a small static case.
    result.work.peak_rss_mb = peak_rss_mb();
    Ok(result)
}

/// Runs one case from the end of the case before it.
fn one(
    model: &Model,
    system: &System,
    before: Option<EndState>,
    options: RunOptions<'_>,
    observers: &mut [&mut dyn Observer],
) -> Result<CaseResult, SolveError> {
    let case = &model.cases[options.case];
    let run = || match &case.analysis {
        Analysis::Static(analysis) => {
            if let Some(end) = &options.from {
                check_static(model, case, end)?;
            }
            run_static(model, system, case, analysis, before, observers)
        }
        Analysis::Dynamic(analysis) => {
            let setup = Setup { model, system, case, analysis, before };
            dynamic::run(setup, options, observers)
        }
    };
    // A law that panics in a march ends that alone; here are those that do so before or behind it, or where no time goes
    // on.
    catch(run).unwrap_or_else(|panicked| {
        let when = format!("outside the steps of case \"{}\"", case.name);
        Err(Culprit::from(panicked).error(model, system, when))
    })
}

/// The end of the case that a case continues. Cases that continue each other are run from the first to the last, one
/// after the other: a chain of thousands needs no more room on the stack than one case.
pub(crate) fn before(
    model: &Model,
    system: &System,
    case: &Case,
    solver: Option<SolverKind>,
    interrupt: Option<&AtomicBool>,
) -> Result<Option<EndState>, SolveError> {
    let earlier: Vec<usize> =
        std::iter::successors(case.after, |case| model.cases[*case].after).collect();
    let mut end = None;
    for case in earlier.into_iter().rev() {
        end = Some(end_of(model, system, case, end, solver, interrupt)?);
    }
    Ok(end)
}

/// The end of a case that another one continues, from the end of the case before it.
fn end_of(
    model: &Model,
    system: &System,
    case: usize,
    before: Option<EndState>,
    solver: Option<SolverKind>,
    interrupt: Option<&AtomicBool>,
) -> Result<EndState, SolveError> {
    let mut vectors = None;
    let mut round = 0;
    let result = loop {
        let options = RunOptions { case, solver, vectors, interrupt, ..RunOptions::default() };
        // A case whose basis is too small starts again from there.
        let result = one(model, system, before.clone(), options, &mut [])?;
        match result.enlarged(model, round) {
            Some(n) => vectors = Some(n),
            None => break result,
        }
        round += 1;
    };
    if let Status::Interrupted { t } = result.status {
        return Err(SolveError::Interrupted { case: result.case, t });
    }
    if let Status::NotConverged { .. }
    | Status::Law { .. }
    | Status::Spent { .. }
    | Status::Overturned { .. }
    | Status::Inadequate { .. } = result.status
    {
        let reason = result.status.text();
        return Err(SolveError::Predecessor { case: result.case, reason });
    }
    Ok(result.end)
}

/// The end of a case, and of those before it that it continues.
pub(crate) fn end_at(model: &Model, system: &System, case: usize) -> Result<EndState, SolveError> {
    let before = before(model, system, &model.cases[case], None, None)?;
    end_of(model, system, case, before, None, None)
}

/// Modes of the structure without links in the basis that a case would use, with participation and the
/// flexibility that the basis holds of every link coordinate. Without a dynamic case, of the last one.
///
/// # Errors
/// [`SolveError`] where the structure cannot be solved.
pub fn modes(
    model: &Model,
    system: &System,
    case: Option<usize>,
) -> Result<BasisReport, SolveError> {
    if system.idle {
        return Err(SolveError::NoMass);
    }
    let dynamic = |c: &Case| match &c.analysis {
        Analysis::Dynamic(d) => Some((**d).clone()),
        Analysis::Static(_) => None,
    };
    let chosen = case
        .and_then(|c| dynamic(&model.cases[c]))
        .or_else(|| model.cases.iter().rev().find_map(dynamic));
    let directions = || -> Vec<(String, Vec<f64>)> {
        ["X", "Y", "Z"]
            .iter()
            .zip(&system.inertia)
            .map(|(n, p)| (format!("acceleration {n}"), p.clone()))
            .collect()
    };
    let (settings, mut demands) = match chosen {
        Some(analysis) => {
            let constant = constant_load(model, system, &analysis.constant);
            let set = system.dynamic_loads(model, &analysis, constant);
            let initial = Initial::new(model, system, &analysis, None)?;
            let loads = super::equations::basis_loads(model, &analysis, &set);
            (analysis.solution.basis.clone(), Demands::new(system, loads, initial.to_hold()))
        }
        None => (trilith_model::Basis::default(), Demands::default()),
    };
    if demands.is_empty() {
        demands.loads = directions();
    }
    Ok(crate::basis::build(model, system, &settings, &demands, true)?.report)
}

/// Sum of loads on the free DOFs.
pub(super) fn constant_load(model: &Model, system: &System, loads: &[Load]) -> Vec<f64> {
    let mut p = vec![0.0; system.order()];
    for load in loads {
        for (x, y) in p.iter_mut().zip(system.load_vector(model, load)) {
            *x += y;
        }
    }
    p
}

fn run_static(
    model: &Model,
    system: &System,
    case: &Case,
    analysis: &StaticCase,
    before: Option<EndState>,
    observers: &mut [&mut dyn Observer],
) -> Result<CaseResult, SolveError> {
    let clock = Clock::start();
    let added = constant_load(model, system, &analysis.loads);
    let (start, carried) = match before {
        Some(end) => (end.state, end.load),
        None => (untouched(model, system), vec![0.0; system.order()]),
    };
    let found = statics::equilibrium(model, system, start, &carried, &added, analysis.steps)?;
    let Equilibrium { u, mut state, iterations, steps, rejected } = found.map_err(|e| {
        let percent = 100.0 * e.reached;
        if let Some(culprit) = e.culprit {
            let when =
                format!("beyond {percent:.1} % of the loads of static case \"{}\"", case.name);
            return culprit.error(model, system, when);
        }
        SolveError::StaticNotConverged {
            case: case.name.clone(),
            percent,
            worst: system.links.name(model, e.worst),
            residual: e.residual,
            span: case.span.clone(),
        }
    })?;
    let load: Vec<f64> = carried.iter().zip(&added).map(|(a, b)| a + b).collect();
    let zero = vec![0.0; u.len()];
    state.motion = [&u[..], &zero, &zero].concat();
    let stored: f64 = state.stored.iter().sum();
    let potential: f64 = -load.iter().zip(&u).map(|(p, x)| p * x).sum::<f64>();
    let energy = EnergyTotals {
        strain: 0.5 * system.stiffness.bilinear(&u, &u),
        link_stored: stored,
        potential,
        ..EnergyTotals::default()
    };
    let noticed = show_static(model, system, &state, energy, model.held_loads(case), observers);
    let cpu = clock.cpu();
    Ok(CaseResult {
        case: case.name.clone(),
        solver: "static",
        status: Status::Converged,
        work: Work {
            steps,
            substeps: steps,
            iterations,
            rejected,
            factorizations: 1,
            wall_s: clock.wall(),
            march_cpu_s: cpu,
            ..Work::default()
        },
        energy,
        link_energy: system
            .links
            .links
            .iter()
            .zip(&state.stored)
            .map(|(l, s)| (l.element, LinkEnergy { stored: *s, ..LinkEnergy::default() }))
            .collect(),
        basis: None,
        warnings: checks::of_static(model, system, &state, noticed, &u),
        errors: Vec::new(),
        end: EndState {
            model: model.sha256(),
            case: case.name.clone(),
            solver: "static".into(),
            parameters: parameters(model),
            displacement: u,
            velocity: zero,
            load,
            state,
            ..EndState::default()
        },
    })
}

//! What a dynamic case is made of before its first step: start, loads, basis, damping.

use super::case::{RunOptions, constant_load};
use super::checkpoint::check;
use super::end_state::{EndState, Initial};
use super::equations::{Equations, bases, demands, fna_modes};
use super::start::{Start, resume, start};
use crate::basis::{Bases, ModalDamping, follow_supports, in_span, modal_damping};
use crate::certificate::{Certificate, Defect, Kicks, Listener, Reporter, Samples, Shadow, beside};
use crate::error::SolveError;
use crate::march::{Timeline, at_least};
use crate::record::Outputs;
use crate::step::{State, Stepper};
use std::borrow::Cow;
use std::ops::Range;
use trilith_model::{Case, DynamicCase, MOST_OUTPUT_STEPS, Model, SolverKind, output_steps};
use trilith_system::{LoadSet, System};

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

/// A case that is ready to be stepped.
pub(crate) struct Prepared<'a> {
    pub model: &'a Model,
    pub system: &'a System,
    pub case: &'a Case,
    /// Its settings, with as many vectors as the run was told.
    pub analysis: Cow<'a, DynamicCase>,
    pub kind: SolverKind,
    /// Output step, s.
    pub dt: f64,
    /// Constant loads on the free DOFs.
    pub constant: Vec<f64>,
    pub initial: Initial,
    pub loads: LoadSet,
    pub bases: Option<Bases>,
    damping: Option<ModalDamping>,
}

impl<'a> Prepared<'a> {
    /// Loads, start, basis and damping of a case, from a checkpoint where there is one.
    pub(crate) fn new(setup: Setup<'a>, options: &RunOptions<'_>) -> Result<Self, SolveError> {
        Self::on(None, setup, options)
    }

    /// The same on a basis in the span of another one, where one is given; without a basis where it has other massless
    /// directions.
    pub(crate) fn on(
        span: Option<&Bases>,
        setup: Setup<'a>,
        options: &RunOptions<'_>,
    ) -> Result<Self, SolveError> {
        let Setup { model, system, case, analysis, before } = setup;
        let analysis = with_vectors(analysis, options.vectors);
        let solution = &analysis.solution;
        let kind = options.solver.unwrap_or(solution.solver);
        let dt = options.dt.unwrap_or(analysis.dt);
        check_length(case, analysis.duration, dt)?;
        if let Some(end) = &options.from {
            check(model, system, case, kind, dt, end)?;
        }
        let constant = match &options.from {
            Some(end) => end.load.clone(),
            None => held_load(model, system, &analysis, before.as_ref()),
        };
        let mut loads = system.dynamic_loads(model, &analysis, constant.clone());
        loads.held = model.held_loads(case);
        let reduced = kind.is_reduced();
        let initial = match &options.from {
            Some(end) => end.initial.clone(),
            None => Initial::new(model, system, &analysis, before.as_ref())?,
        };
        let judged = reduced && solution.basis.tolerance < 1.0 && !model.outputs.is_empty();
        let bases = match span {
            Some(of) => {
                let demands = demands(model, system, &analysis, &loads, &initial);
                in_span(system, &demands.loads, &of.stepping)?
            }
            None => bases(model, system, &analysis, kind, &loads, &initial, judged)?,
        };
        let damping = bases.as_ref().and_then(|b| modal_damping(model, system, b));
        follow_supports(model, system, damping.as_ref(), reduced, &mut loads)?;
        Ok(Self {
            model,
            system,
            case,
            analysis,
            kind,
            dt,
            constant,
            initial,
            loads,
            bases,
            damping,
        })
    }

    /// What its motion obeys; `watched`: whether somebody needs rates.
    pub(crate) fn equations(&self, watched: bool) -> Equations<'_> {
        Equations {
            model: self.model,
            system: self.system,
            solution: &self.analysis.solution,
            kind: self.kind,
            loads: &self.loads,
            bases: self.bases.as_ref(),
            damping: self.damping.as_ref(),
            watched,
        }
    }

    /// Modal damping.
    pub(crate) fn damping(&self) -> Option<&ModalDamping> {
        self.damping.as_ref()
    }

    pub(crate) fn timeline(&self) -> Timeline {
        let DynamicCase { duration, solution, .. } = &*self.analysis;
        Timeline::new(self.dt, *duration, &self.loads, at_least(solution.step))
    }

    /// The state that a stepper starts from.
    pub(crate) fn set_out(
        &self,
        from: Option<&EndState>,
        stepper: &mut dyn Stepper,
    ) -> Result<Start, SolveError> {
        match from {
            Some(end) => resume(end.clone(), stepper),
            None => {
                let times = [self.dt, self.analysis.duration];
                start(self.model, self.system, &self.initial, &self.loads, stepper, times)
            }
        }
    }

    /// Both ends of the wider structure beside a run from a state at `t`, where the basis has one.
    pub(super) fn wider(
        &self,
        from: Option<&EndState>,
        t: f64,
        state: &State,
    ) -> Option<(Reporter, Listener<'_>)> {
        let wider = self.bases.as_ref().and_then(|b| b.wider.as_deref())?;
        let at = match from {
            Some(end) => (&*end.displacement, &*end.velocity),
            None => (&*self.initial.displacement, &*self.initial.velocity),
        };
        let modes = fna_modes(self.model, self.system, &self.loads, wider);
        Some(beside(Shadow::new(self.model, self.system, &self.loads, modes, at, t, state)))
    }

    /// What follows the errors of the outputs of a run over output steps from a state.
    pub(super) fn certificate<'s>(
        &'s self,
        stepper: &dyn Stepper,
        timeline: &Timeline,
        steps: Range<usize>,
        state: &State,
        shadow: Option<Reporter>,
        step_errors: bool,
    ) -> Certificate<'s> {
        let Self { model, system, loads, kind, .. } = self;
        let (space, t) = (stepper.space(), timeline.time(steps.start));
        let samples = Samples::new(model, system, loads, space, timeline, steps.clone(), state);
        let few = Defect::is_worth(timeline, steps);
        let exact = self.bases.as_ref().filter(|_| step_errors && *kind == SolverKind::Fna && few);
        let defect = exact.map(|bases| {
            let modes = fna_modes(model, system, loads, bases);
            Defect::new(model, system, loads, modes, t, state)
        });
        let kicks = stepper.closed_form().filter(|_| step_errors).and_then(|form| {
            let outputs = Outputs::new(model, system, space);
            Kicks::new(&outputs, space, &form.omega, timeline.dt, (t, state))
        });
        let tolerance = self.analysis.solution.link_tolerance;
        Certificate::new(model, &system.links, samples, shadow, defect, kicks, tolerance)
    }

    /// What the user should know of a basis that is too small.
    pub(super) fn adequacy_warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if let (Some(b), true) = (&self.bases, self.kind.is_reduced()) {
            adequacy_warning(b, self.analysis.solution.basis.adequacy, &mut warnings);
        }
        warnings
    }
}

/// The settings of a case, with as many vectors of the basis as the run is told.
fn with_vectors(analysis: &DynamicCase, vectors: Option<usize>) -> Cow<'_, DynamicCase> {
    let mut analysis = Cow::Borrowed(analysis);
    if vectors.is_some() {
        analysis.to_mut().solution.basis.vectors = vectors;
    }
    analysis
}

/// Refuses more output steps than can be kept.
fn check_length(case: &Case, duration: f64, dt: f64) -> Result<(), SolveError> {
    if !(dt > 0.0 && dt.is_finite()) {
        let (case, span) = (case.name.clone(), case.span.clone());
        return Err(SolveError::OutputStep { case, dt, span });
    }
    let steps = output_steps(duration, dt);
    if steps > MOST_OUTPUT_STEPS as f64 {
        let (case, span) = (case.name.clone(), case.span.clone());
        return Err(SolveError::TooManySteps { case, steps, dt, span });
    }
    Ok(())
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

//! The equations of a dynamic case: basis, damping, and the solver that steps them.

use super::end_state::Initial;
use crate::basis::{self, Bases, Demands, ModalDamping, is_modal, modal_damping};
use crate::custom::CustomRule;
use crate::error::SolveError;
use crate::fna::{Modal, Modes};
use crate::hht::{FullNewton, Hht};
use crate::kernel::LinkKernel;
use crate::step::{LinkEquations, LinkStepper, Propagator, Stepper};
use crate::structure::{Followers, ReducedSystem};
use trilith_model::{DynamicCase, Model, Solution, SolverKind};
use trilith_system::{LoadSet, System, Track};

/// What a motion obeys.
#[derive(Clone, Copy)]
pub(crate) struct Equations<'a> {
    pub model: &'a Model,
    pub system: &'a System,
    pub solution: &'a Solution,
    pub kind: SolverKind,
    pub loads: &'a LoadSet,
    pub bases: Option<&'a Bases>,
    pub damping: Option<&'a ModalDamping>,
    /// Whether somebody needs rates, as [`needs_rates`](crate::record::needs_rates) says.
    pub watched: bool,
}

impl<'a> Equations<'a> {
    /// What steps them.
    ///
    /// # Errors
    /// Where the linear algebra fails.
    pub(crate) fn stepper(&self) -> Result<Box<dyn Stepper + 'a>, SolveError> {
        let Self { model, system, solution, kind, loads, bases, damping, watched } = *self;
        let none = vec![0.0; system.links.len()];
        let effective =
            if kind == SolverKind::FullNewton { &none } else { &system.links.effective };
        let side = |order: usize| link_equations(model, system, solution, loads, order, watched);
        Ok(match (kind, bases) {
            (SolverKind::Fna, Some(b)) => {
                let modes = fna_modes(model, system, loads, b);
                let side = side(modes.space.order());
                Box::new(LinkStepper::new(Modal::new(modes), side)?)
            }
            (SolverKind::RitzHht, Some(b)) => {
                let space = ReducedSystem::reduced(system, loads, effective, damping, &b.stepping);
                let side = side(space.order());
                Box::new(LinkStepper::new(Hht::new(space, solution.alpha), side)?)
            }
            (SolverKind::FullNewton, _) => {
                let space = ReducedSystem::physical(system, loads, effective, damping.cloned());
                let side = &link_equations(model, system, solution, loads, 0, watched);
                let damped = &side.kernel.layout().damped;
                Box::new(FullNewton {
                    model,
                    system,
                    loads,
                    followers: Followers::new(&space, damped)?,
                    space,
                    alpha: solution.alpha,
                    iterations: 0,
                    factorizations: 0,
                })
            }
            (SolverKind::Custom { name, at, reduced }, _) => {
                let Some(solver) = model.solvers.get(at) else {
                    let reason = "the model has no such solver".into();
                    return Err(SolveError::Integrator { kind: name, reason });
                };
                let space = match bases.filter(|_| reduced) {
                    Some(b) => {
                        ReducedSystem::reduced(system, loads, effective, damping, &b.stepping)
                    }
                    None => ReducedSystem::physical(system, loads, effective, damping.cloned()),
                };
                let side = side(space.order());
                let rule = CustomRule::new(solver, (model, system), space);
                Box::new(LinkStepper::new(rule, side)?)
            }
            (SolverKind::Fna | SolverKind::Hht | SolverKind::RitzHht, _) => {
                let space = ReducedSystem::physical(system, loads, effective, damping.cloned());
                let side = side(space.order());
                Box::new(LinkStepper::new(Hht::new(space, solution.alpha), side)?)
            }
        })
    }
}

impl<'a> Equations<'a> {
    /// The linear step alone; none of a solver that has no such step.
    pub(crate) fn propagator(&self) -> Option<Box<dyn Propagator + 'a>> {
        let Self { system, solution, kind, loads, bases, damping, .. } = *self;
        let effective = &system.links.effective;
        let hht = |space: ReducedSystem| Box::new(Hht::new(space, solution.alpha));
        match (kind, bases) {
            (SolverKind::Fna, Some(b)) => {
                Some(Box::new(Modal::new(fna_modes(self.model, system, loads, b))))
            }
            (SolverKind::RitzHht, Some(b)) => {
                Some(hht(ReducedSystem::reduced(system, loads, effective, damping, &b.stepping)))
            }
            (SolverKind::FullNewton | SolverKind::Custom { .. }, _) => None,
            _ => Some(hht(ReducedSystem::physical(system, loads, effective, damping.cloned()))),
        }
    }
}

/// Load directions that a basis must hold: name and vector on the free DOFs.
pub(super) fn basis_loads(
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

/// What a case asks of a basis.
pub(super) fn demands(
    model: &Model,
    system: &System,
    analysis: &DynamicCase,
    loads: &LoadSet,
    initial: &Initial,
) -> Demands {
    Demands::new(system, basis_loads(model, analysis, loads), initial.to_hold())
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
    if !is_modal(&model.damping) && !kind.is_reduced() {
        system.check_supported(model, true)?;
        return Ok(None);
    }
    let mut demands = demands(model, system, analysis, loads, initial);
    demands.wider = wider;
    let mut settings = analysis.solution.basis.clone();
    if !kind.is_reduced() {
        // Modal damping is the structure's: a basis that the file cuts for FNA is no part of it.
        settings.vectors = None;
    }
    // Who asks for no flexibility of the links needs no report of it.
    let adequacy = kind.is_reduced() && settings.adequacy > 0.0;
    Ok(Some(basis::build(model, system, &settings, &demands, adequacy)?))
}

/// The structure of FNA on its basis.
pub(crate) fn fna_modes(model: &Model, system: &System, loads: &LoadSet, bases: &Bases) -> Modes {
    let links = &system.links;
    let engaged = links.engaged(model);
    let engaged = links.active.iter().map(|i| engaged[*i]).collect();
    let damping = modal_damping(model, system, bases);
    let stepping = &bases.stepping;
    let space = ReducedSystem::reduced(system, loads, &links.effective, damping.as_ref(), stepping);
    Modes::new(space, engaged)
}

/// The link equations of a motion with this many coordinates; `watched` as [`needs_rates`](crate::record::needs_rates) says.
pub(crate) fn link_equations<'a>(
    model: &'a Model,
    system: &'a System,
    solution: &Solution,
    loads: &'a LoadSet,
    order: usize,
    watched: bool,
) -> LinkEquations<'a> {
    let links = &system.links;
    let effective = links.active.iter().map(|i| links.effective[*i]).collect();
    let kernel = LinkKernel::new(model, links, solution, effective);
    LinkEquations::new(model, system, loads, kernel, order, watched)
}

//! A case in the models around the value of a parameter.

use super::around::{Assembled, Varied};
use super::structure::Structure;
use crate::basis::Bases;
use crate::error::SolveError;
use crate::run::{Equations, Prepared, RunOptions, Setup, before};
use crate::step::{LinksBefore, State};
use crate::structure::ReducedSystem;
use trilith_model::{Analysis, DynamicCase, Model, Side, SolverKind};
use trilith_system::System;

/// The case in the models around, ready to be stepped.
pub(super) struct Sides<'a> {
    /// With the physical displacements as coordinates.
    pub physical: [Prepared<'a>; 4],
    /// What the parameter moves of the structure.
    pub structure: Option<Structure>,
    /// On the span of the basis of the run, where the structure moves and the solver has one.
    pub reduced: Option<[Prepared<'a>; 4]>,
}

impl<'a> Sides<'a> {
    /// Of a parameter of a run.
    pub(super) fn new(
        assembled: &'a Assembled<'a>,
        base: &Prepared<'_>,
        options: &RunOptions<'_>,
    ) -> Result<Self, SolveError> {
        let Varied { name, step, .. } = &assembled.around.of;
        let refuse = |why: &str| SolveError::NoGradient { reason: format!("`{name}` {why}") };
        let prepared =
            |span: Option<&Bases>, solver: SolverKind| -> Result<[Prepared<'a>; 4], SolveError> {
                let all =
                    assembled.sides().map(|(model, s)| prepare(model, s, options, (span, solver)));
                let all = all.collect::<Result<Vec<_>, _>>()?;
                all.try_into().map_err(|_| refuse("has no models around"))
            };
        let physical = prepared(None, SolverKind::Hht)?;
        if physical.iter().any(|p| !same_course(&p.analysis, &base.analysis)) {
            return Err(refuse(
                "changes the times or the solution of the case, which stay as they are",
            ));
        }
        if physical.iter().any(|p| p.loads.channels.len() != base.loads.channels.len()) {
            return Err(refuse("makes loads come and go"));
        }
        if assembled.sides().any(|(model, s)| {
            s.links.active != base.system.links.active
                || s.links.history_len != base.system.links.history_len
                || model.outputs.len() != base.model.outputs.len()
        }) {
            return Err(refuse("changes what links the model has"));
        }
        let spaces = [0, 1, 2, 3].map(|i| in_physical(&physical[i]));
        let structure = Structure::new(*step, &spaces).map_err(|e| refuse(&e))?;
        let moves = base.kind.is_reduced() && structure.is_some();
        let span = base.bases.as_ref().filter(|_| moves);
        let reduced = span.map(|_| prepared(span, base.kind)).transpose()?;
        Ok(Self { physical, structure, reduced })
    }
}

/// The space of physical displacements.
pub(super) fn in_physical(of: &Prepared<'_>) -> ReducedSystem {
    let none = vec![0.0; of.system.links.len()];
    ReducedSystem::physical(of.system, &of.loads, &none, of.damping().cloned())
}

/// A model around, ready to be stepped by a solver, on the span of a basis where one is given.
fn prepare<'a>(
    model: &'a Model,
    system: &'a System,
    options: &RunOptions<'_>,
    (span, solver): (Option<&Bases>, SolverKind),
) -> Result<Prepared<'a>, SolveError> {
    let case = model.cases.get(options.case);
    let Some((case, Analysis::Dynamic(analysis))) = case.map(|c| (c, &c.analysis)) else {
        return Err(SolveError::NoGradient { reason: "the case is gone beside its value".into() });
    };
    let before = before(model, system, case, None, None)?;
    let own = RunOptions {
        case: options.case,
        solver: Some(solver),
        dt: options.dt,
        ..RunOptions::default()
    };
    Prepared::on(span, Setup { model, system, case, analysis, before }, &own)
}

/// True for cases of one length and one solution.
fn same_course(a: &DynamicCase, b: &DynamicCase) -> bool {
    a.duration == b.duration
        && a.dt == b.dt
        && a.solution.step == b.solution.step
        && a.solution.alpha == b.solution.alpha
}

/// The state that a model around starts from; on the structure of `on`, where that is given.
pub(super) fn start(
    of: &Prepared<'_>,
    on: Option<&Prepared<'_>>,
    watched: bool,
) -> Result<State, SolveError> {
    let own = of.equations(watched);
    let equations = match on {
        None => own,
        Some(base) => Equations { model: of.model, loads: &of.loads, ..base.equations(watched) },
    };
    let before = of.initial.links.clone();
    let before = before.unwrap_or_else(|| LinksBefore::rest(of.model, &of.system.links));
    let amplitudes: Vec<f64> =
        of.loads.channels.iter().map(|c| c.track.at(0.0, Side::After)).collect();
    let (u, v) = (&of.initial.displacement, &of.initial.velocity);
    equations.stepper()?.start(u, v, &before, &amplitudes)
}

//! Where a dynamic case has arrived, and the result that it leaves.

use super::checkpoint::parameters;
use super::end_state::{EndState, Initial, SoFar};
use super::result::{CaseResult, Status, Work};
use crate::kernel::Remembered;
use crate::march::{StepControlState, Timeline};
use crate::record::Ledger;
use crate::step::State;
use crate::structure::ReducedSystem;
use trilith_model::{Analysis, Case, Model, SolverKind};
use trilith_system::System;

/// Where a run ended, and what it carries there.
pub(crate) struct Arrival<'a> {
    pub timeline: &'a Timeline,
    /// Output steps made since the start of the case.
    pub made: usize,
    pub state: State,
    pub control: StepControlState,
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
        space: &ReducedSystem,
        memory: Vec<Remembered>,
        work: Work,
    ) -> CaseResult {
        let Self { timeline, made, state, control, ledger, constant, initial, fallen, largest } =
            self;
        // Where the links were led from, nobody asks at the end.
        let initial = Initial { links: None, ..initial };
        let share = ledger.totals.error_relative;
        let limit = match &case.analysis {
            Analysis::Dynamic(analysis) => analysis.solution.energy_limit,
            Analysis::Static(_) => f64::INFINITY,
        };
        // A share that is no number is within no limit.
        let status = if share > limit || share.is_nan() {
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
            control,
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

//! The state at the end of a run, from which the next case or a restart goes on.

use crate::kernel::Remembered;
use crate::march::StepControlState;
use crate::record::{BaseShearSummary, ContactMemory, Ledger, Peak};
use crate::step::{LinksBefore, State};
use serde::{Deserialize, Serialize};

/// The state at the end of a run: what the next case continues, or a checkpoint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EndState {
    /// SHA-256 of the model text.
    pub model: String,
    /// Name of the case.
    pub case: String,
    /// Name of the solver.
    pub solver: String,
    /// Parameters of the model with their values.
    pub parameters: Vec<(String, String)>,
    /// Output step, s.
    pub dt: f64,
    /// Time in the case, s.
    pub time: f64,
    /// Output steps made.
    pub step: usize,
    /// Displacements of the free DOFs, m or rad.
    pub displacement: Vec<f64>,
    /// Their velocities.
    pub velocity: Vec<f64>,
    /// Constant loads on the free DOFs, N or N·m.
    pub load: Vec<f64>,
    /// The state of the solver.
    pub state: State,
    /// Vectors of the basis where the run was told how many.
    pub vectors: Option<usize>,
    /// What the case started from, which its basis is made for.
    pub(crate) initial: Initial,
    #[serde(rename = "pace")]
    pub(crate) control: StepControlState,
    pub(crate) memory: Vec<Remembered>,
    pub(crate) ledger: Ledger,
    /// Largest values of the outputs so far, where the looks inside long steps hang on them.
    #[serde(default)]
    pub(crate) largest: Vec<f64>,
    /// What the observers of the case had seen until then, for a run that continues it.
    #[serde(default)]
    pub seen: SoFar,
}

/// What was seen of a case until a checkpoint, so that the extremes of a continued run are those of all of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SoFar {
    /// Extremes of the outputs in the model's order; empty where nobody took them.
    pub peaks: Vec<Peak>,
    /// What the contacts had done.
    pub contact: Option<ContactMemory>,
    /// The largest base shear until then; none where nobody looked.
    #[serde(default)]
    pub base_shear: Option<BaseShearSummary>,
    /// Since when, s: 0 for all of the case.
    pub since: f64,
}

/// Displacements and velocities of the free DOFs at the start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Initial {
    pub displacement: Vec<f64>,
    pub velocity: Vec<f64>,
    /// The displacement but for that of a static case before, which loads and links hold in equilibrium.
    pub beyond_equilibrium: Vec<f64>,
    /// Where the links are led from; of no use where a run goes on from a checkpoint.
    #[serde(skip)]
    pub links: Option<LinksBefore>,
}

impl Initial {
    /// What a basis must hold of a start: the displacement beyond equilibrium, and the velocity.
    pub(crate) fn to_hold(&self) -> [&Vec<f64>; 2] {
        [&self.beyond_equilibrium, &self.velocity]
    }
}

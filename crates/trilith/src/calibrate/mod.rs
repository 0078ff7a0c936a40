//! Dashpots from coefficients of restitution, without trial and error.
//!
//! A body that stands free on contacts, as its model says, is dropped flat and rocked by experiment, on
//! the model's own equations:
//!
//! - *Drop.* The contact dashpots follow from e in closed form (see `NLink`), which leaves gravity out. A
//!   [`drop`](Calibrator::drop) measures what comes out, [`tune_drop`](Calibrator::tune_drop) finds the
//!   dashpots that give e in that drop exactly.
//! - *Rocking.* Angular momentum about the struck corner alone gives Housner's restitution when contacts
//!   are stiff, nearly plastic and stiff in shear (kₛ ≈ 30 kₙ). [`rocking`](Calibrator::rocking) measures
//!   the uplift after one swing over the uplift before, [`tune_rocking`](Calibrator::tune_rocking) finds
//!   the rotational dashpot that lowers it to a wanted value. That dashpot is right at one amplitude only.
//!
//! ```
//! use trilith::calibrate::{Calibrator, Horizontal};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/rigid_block_rocking.ron");
//! let model = trilith::read(file, &trilith::registry(), &[]).map_err(|e| e[0].to_string())?;
//! let mut block = Calibrator::new(model, Horizontal::X)?;
//! block.set_restitution(0.25)?;
//! let (dashpot, swing) = block.tune_rocking(0.45, 0.13)?;
//! assert!(dashpot > 0.0 && (swing.ratio() - 0.45).abs() < 1e-3);
//! # Ok(())
//! # }
//! ```

mod body;
mod drop;
mod error;
mod rocking;
mod root;

pub use body::{Body, Foot, Horizontal};
pub use drop::Drop;
pub use error::CalibrationError;
pub use rocking::{Rocking, Swing};

use crate::{Analysis, Error, Model, RunOptions, SolverKind};
use std::sync::Arc;
use trilith_element::{Dof, Link};
use trilith_model as model;
use trilith_solvers::{Observer, Sample, Status};

/// Output step as share of what an experiment lasts.
const OUTPUT_SHARE: f64 = 1e-3;
/// Tolerance of the steps: what is measured must not jump with the choice of steps.
const TOLERANCE: f64 = 1e-6;

/// Experiments on a model. Its own cases and outputs are not used and its loads do not act.
#[derive(Debug)]
pub struct Calibrator {
    model: Model,
    body: Body,
    solver: SolverKind,
}

/// What the feet do in an experiment: (time, gap of each foot).
#[derive(Debug, Default)]
struct Gaps {
    elements: Vec<usize>,
    seen: Vec<(f64, Vec<f64>)>,
}

impl Observer for Gaps {
    fn sample(&mut self, s: &Sample<'_>) {
        let gap = |e: &usize| s.contacts.iter().find(|(i, _)| i == e).map_or(f64::NAN, |c| c.1.gap);
        self.seen.push((s.t, self.elements.iter().map(gap).collect()));
    }

    fn wants_rates(&self) -> bool {
        false
    }
}

impl Calibrator {
    /// Looks at a model as a body on feet that moves in the vertical plane of a horizontal direction.
    ///
    /// # Errors
    /// Where the structure cannot be assembled, or is no body that stands free on contacts.
    pub fn new(model: Model, horizontal: Horizontal) -> Result<Self, Error> {
        let body = Body::new(&model, &trilith_solvers::assemble(&model)?, horizontal)?;
        Ok(Self { model, body, solver: SolverKind::Fna })
    }

    /// With another solver.
    #[must_use]
    pub fn with_solver(self, solver: SolverKind) -> Self {
        Self { solver, ..self }
    }

    /// The body and its feet.
    #[must_use]
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Sets the dashpots of all feet for a coefficient of restitution in a flat drop, in closed form,
    /// and returns them, N·s/m.
    ///
    /// # Errors
    /// [`CalibrationError::Range`] outside 0 < e ≤ 1.
    pub fn set_restitution(&mut self, e: f64) -> Result<Vec<f64>, Error> {
        check_restitution(e)?;
        for foot in &mut self.body.feet {
            let law = law(&self.model, foot.element).and_then(|l| l.restituting(e, foot.mass));
            foot.damping = law.as_ref().and_then(|l| l.impact()).map_or(0.0, |i| i.damping);
            set_law(&mut self.model, foot.element, law);
        }
        Ok(self.body.feet.iter().map(|f| f.damping).collect())
    }

    /// Lets the body go at rest from a rigid displacement, under its weight alone.
    fn release(&mut self, pose: body::Pose, duration: f64) -> Result<Gaps, Error> {
        let system = trilith_solvers::assemble(&self.model)?;
        let initial = system.reduction.free.iter().map(|full| {
            let position = self.model.nodes[full / 6].position;
            model::Initial {
                node: full / 6,
                dof: Dof::ALL[full % 6],
                displacement: Some(pose.at(self.body.horizontal, position, full % 6)),
                velocity: Some(0.0),
            }
        });
        let case = model::DynamicCase {
            duration,
            dt: duration * OUTPUT_SHARE,
            constant: vec![model::Load::Gravity { factor: 1.0 }],
            base: Vec::new(),
            forces: Vec::new(),
            supports: Vec::new(),
            initial: initial.collect(),
            solution: model::Solution {
                step: model::StepControl::Adaptive { tolerance: TOLERANCE },
                ..model::Solution::default()
            },
        };
        self.model.cases = vec![model::Case {
            name: "calibration".into(),
            after: None,
            analysis: model::Analysis::Dynamic(Box::new(case)),
            span: 0..0,
        }];
        self.model.outputs.clear();
        let elements = self.body.feet.iter().map(|f| f.element).collect();
        let mut gaps = Gaps { elements, seen: Vec::new() };
        let options = RunOptions { case: 0, solver: Some(self.solver), ..RunOptions::default() };
        let analysis = Analysis::new(&self.model)?;
        let status = analysis.observed(options, &mut [&mut gaps])?.result.status;
        match status {
            Status::Converged => Ok(gaps),
            other => Err(CalibrationError::Run { reason: other.text() }.into()),
        }
    }
}

fn check_restitution(e: f64) -> Result<(), CalibrationError> {
    let what = "coefficient of restitution";
    if e > 0.0 && e <= 1.0 { Ok(()) } else { Err(CalibrationError::Range { what, value: e }) }
}

fn law(model: &Model, element: usize) -> Option<&dyn Link> {
    match &model.elements[element].body {
        model::Body::Link(law, _) => Some(law.as_ref()),
        _ => None,
    }
}

fn set_law(model: &mut Model, element: usize, new: Option<Box<dyn Link>>) {
    if let (model::Body::Link(law, _), Some(new)) = (&mut model.elements[element].body, new) {
        *law = Arc::from(new);
    }
}

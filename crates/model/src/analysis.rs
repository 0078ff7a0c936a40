//! Analysis cases: what is loaded, how it moves, how it is solved.

use crate::{Load, SolverKind, Span};
use trilith_element::Dof;

/// An analysis case.
#[derive(Clone, Debug)]
pub struct Case {
    /// Name.
    pub name: String,
    /// The case whose end state it continues: displacements, link history and loads are carried on.
    pub after: Option<usize>,
    /// What is analysed.
    pub analysis: Analysis,
    /// Where the file defines it.
    pub span: Span,
}

/// What a case does.
#[derive(Clone, Debug)]
pub enum Analysis {
    /// Nonlinear static analysis.
    Static(StaticCase),
    /// Dynamic analysis.
    Dynamic(Box<DynamicCase>),
}

/// Nonlinear static analysis: loads grow from zero (or from the case before) to their value.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticCase {
    /// Loads added in this case.
    pub loads: Vec<Load>,
    /// Load steps asked for; halved where they do not converge.
    pub steps: usize,
}

/// Dynamic analysis in time.
#[derive(Clone, Debug)]
pub struct DynamicCase {
    /// Length, s.
    pub duration: f64,
    /// Output step, s; the march substeps inside it by itself.
    pub dt: f64,
    /// Loads held constant from the start, beside those carried on from the case before.
    pub constant: Vec<Load>,
    /// Uniform base acceleration: displacements are then relative to the base.
    pub base: Vec<BaseMotion>,
    /// Patterns times functions.
    pub forces: Vec<ForceHistory>,
    /// Imposed displacements of supports.
    pub supports: Vec<SupportMotion>,
    /// Initial values at nodes, replacing those of the case before where given.
    pub initial: Vec<Initial>,
    /// How to solve it.
    pub solution: Solution,
}

/// Most output steps of a case: histories of a few outputs then take some gigabytes.
pub const MOST_OUTPUT_STEPS: usize = 50_000_000;

/// Number of output steps of a case of `duration` (s) at an output step `dt` (s), the last of them cut short where need
/// be: a whole number, which may be beyond all bounds.
#[must_use]
pub fn output_steps(duration: f64, dt: f64) -> f64 {
    (duration / dt - 1e-9).ceil().max(1.0)
}

/// One component of the uniform base acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseMotion {
    /// Direction of positive acceleration: Ux, Uy or Uz.
    pub direction: Dof,
    /// Index of the function, m/s².
    pub function: usize,
    /// Factor.
    pub factor: f64,
}

/// A pattern that varies in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceHistory {
    /// Index of the pattern.
    pub pattern: usize,
    /// Index of the function, a pure number.
    pub function: usize,
    /// Factor.
    pub factor: f64,
}

/// Imposed displacement of one supported DOF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportMotion {
    /// Index of the node.
    pub node: usize,
    /// Direction; must be fixed by a support.
    pub dof: Dof,
    /// Index of the function, m or rad.
    pub function: usize,
    /// Factor.
    pub factor: f64,
}

/// Initial displacement and velocity of one DOF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Initial {
    /// Index of the node.
    pub node: usize,
    /// Direction.
    pub dof: Dof,
    /// m or rad.
    pub displacement: Option<f64>,
    /// m/s or rad/s.
    pub velocity: Option<f64>,
}

/// How a dynamic case is solved.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Solver that runs where the command line names none.
    pub solver: SolverKind,
    /// Step control.
    pub step: StepControl,
    /// Solution of the link equations.
    pub kernel: Kernel,
    /// Share of the largest link force by which a link may be out of equilibrium.
    pub link_tolerance: f64,
    /// Largest share of the energy that may be unaccounted for before the run says so.
    pub energy_limit: f64,
    /// Substeps that may be tried in all before the run ends as it stands; `None`: see
    /// [`substep_limit`](Self::substep_limit).
    pub substep_limit: Option<usize>,
    /// Settings of FNA and of other solvers on a Ritz basis.
    pub basis: Basis,
    /// HHT parameter α ∈ [−1/3, 0].
    pub alpha: f64,
}

impl Default for Solution {
    fn default() -> Self {
        Self {
            solver: SolverKind::Fna,
            step: StepControl::default(),
            kernel: Kernel::Newton,
            link_tolerance: 1e-9,
            energy_limit: 1e-3,
            substep_limit: None,
            basis: Basis::default(),
            alpha: 0.0,
        }
    }
}

/// Substeps that a run may always try.
const SUBSTEPS: usize = 1_000_000;
/// Substeps that it may try for each of its equal ones, or for each output step.
const SUBSTEPS_EACH: usize = 200;

impl Solution {
    /// Substeps that a run of so many output steps may try: those stated, else a million, or 200 for each output step
    /// where that is more.
    #[must_use]
    pub fn substep_limit(&self, steps: usize) -> usize {
        let equal = match self.step {
            StepControl::Adaptive { .. } => 1,
            StepControl::Fixed { substeps } => substeps,
        };
        let of_steps = steps.saturating_mul(equal).saturating_mul(SUBSTEPS_EACH);
        self.substep_limit.unwrap_or(of_steps.max(SUBSTEPS))
    }
}

/// Step control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepControl {
    /// Substeps chosen so that the local error stays below the tolerance.
    Adaptive {
        /// Error of a step in the energy norm, relative to the largest energy so far (square root).
        tolerance: f64,
    },
    /// The output step cut into this many equal substeps; halved only where a step does not converge.
    Fixed {
        /// Substeps per output step.
        substeps: usize,
    },
}

impl Default for StepControl {
    fn default() -> Self {
        Self::Adaptive { tolerance: 1e-4 }
    }
}

/// Solution of the link equations in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// Newton with the full tangents of the laws.
    Newton,
    /// Wilson's constant-stiffness iteration.
    FixedPoint,
}

/// Basis of FNA.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// Which vectors.
    pub kind: BasisKind,
    /// How many; `None`: chosen by the program.
    pub vectors: Option<usize>,
    /// Flexibility of every link coordinate that the basis must hold, as share of the exact one;
    /// 0: none, so no vector is made for the links.
    pub adequacy: f64,
    /// Error by reduction that is allowed in any output, as share of its range.
    pub tolerance: f64,
    /// True where a basis that is not good enough is enlarged.
    pub enrich: bool,
}

impl Default for Basis {
    fn default() -> Self {
        Self { kind: BasisKind::Ritz, vectors: None, adequacy: 0.99, tolerance: 0.02, enrich: true }
    }
}

/// Kind of basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BasisKind {
    /// Load-dependent Ritz vectors and one static vector per link coordinate.
    Ritz,
    /// Exact eigenvectors and one static vector per link coordinate.
    Eigen,
    /// All eigenvectors: the complete basis.
    Complete,
}

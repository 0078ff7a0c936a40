//! Ways to solve a case, and how they are put into a model and taken out again.

use std::fmt;
use trilith_model::{
    Analysis, BasisKind, Body, DynamicCase, Kernel, Model, SolverKind, StepControl,
};

/// Share of the loads that a nudge changes.
pub(crate) const NUDGE: f64 = 1e-6;
/// Substeps of a fixed step, and part of the tolerance of steps under error control, in a fine run.
const FINER: usize = 4;
const TIGHTER: f64 = 20.0;
/// Tolerance of the link equations in an exact run.
const EXACT: f64 = 1e-11;

/// One way to solve a case; `None`: as the case says.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// The solver.
    pub solver: SolverKind,
    /// Output step, s.
    pub dt: Option<f64>,
    /// Vectors of the basis, of solvers on a basis.
    pub vectors: Option<usize>,
    /// Dummies of all links as multiples of the stiffness of the engaged link.
    pub dummies: Option<f64>,
    /// HHT's α.
    pub alpha: Option<f64>,
}

impl Variant {
    /// The case as it is, with this solver.
    #[must_use]
    pub fn new(solver: SolverKind) -> Self {
        Self { solver, dt: None, vectors: None, dummies: None, alpha: None }
    }

    /// True for a solver on a basis.
    #[must_use]
    pub fn is_reduced(&self) -> bool {
        self.solver.is_reduced()
    }
}

impl fmt::Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.solver.name())?;
        self.dt.map_or(Ok(()), |dt| write!(f, ", dt {dt} s"))?;
        self.vectors.map_or(Ok(()), |n| write!(f, ", {n} vectors"))?;
        self.dummies.map_or(Ok(()), |k| write!(f, ", dummies × {k}"))?;
        self.alpha.map_or(Ok(()), |a| write!(f, ", α = {a:.3}"))
    }
}

/// A variant with what an experiment changes in it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Setup {
    pub variant: Variant,
    /// Shorter steps.
    pub fine: bool,
    /// All vectors, or this many.
    pub basis: Option<Wider>,
    /// α = 0.
    pub conserving: bool,
    /// The program's own dummies.
    pub own_dummies: bool,
    /// Link equations solved by Newton, exactly.
    pub exact_links: bool,
    /// Loads changed by a millionth.
    pub nudged: bool,
}

/// A wider basis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Wider {
    All,
    Vectors(usize),
}

impl Setup {
    pub(crate) fn of(variant: &Variant) -> Self {
        Self {
            variant: variant.clone(),
            fine: false,
            basis: None,
            conserving: false,
            own_dummies: false,
            exact_links: false,
            nudged: false,
        }
    }

    /// Puts the settings into a model; what was there before comes back.
    pub(crate) fn apply(&self, model: &mut Model, case: usize) -> Before {
        let before = Before {
            case: dynamic(model, case).map(|d| Box::new(d.clone())),
            dummies: model.elements.iter().map(|e| dummies(&e.body)).collect(),
        };
        if let Some(d) = dynamic(model, case) {
            self.solution(d);
        }
        if self.own_dummies || self.variant.dummies.is_some() {
            for e in &mut model.elements {
                let Body::Link(law, options) = &mut e.body else { continue };
                let n = law.coordinates().len();
                let mut k = vec![0.0; n * n];
                law.engaged_stiffness(&mut k);
                let share = self.variant.dummies.filter(|_| !self.own_dummies);
                let own = |factor: f64| (0..n).map(|i| factor * k[i * n + i]).collect();
                options.effective_stiffness = share.map(own);
            }
        }
        before
    }

    fn solution(&self, d: &mut DynamicCase) {
        let s = &mut d.solution;
        // A comparison shows what a basis makes of it.
        (s.basis.enrich, s.basis.tolerance) = (false, 1.0);
        s.basis.vectors = self.variant.vectors.or(s.basis.vectors);
        if self.variant.vectors.is_some() && s.basis.kind == BasisKind::Complete {
            s.basis.kind = BasisKind::Ritz;
        }
        match self.basis {
            None => {}
            Some(Wider::All) => (s.basis.kind, s.basis.vectors) = (BasisKind::Complete, None),
            Some(Wider::Vectors(n)) => s.basis.vectors = Some(n),
        }
        s.alpha = if self.conserving { 0.0 } else { self.variant.alpha.unwrap_or(s.alpha) };
        if self.fine {
            s.step = match s.step {
                StepControl::Adaptive { tolerance } => {
                    StepControl::Adaptive { tolerance: tolerance / TIGHTER }
                }
                StepControl::Fixed { substeps } => {
                    StepControl::Fixed { substeps: FINER * substeps }
                }
            };
        }
        if self.exact_links {
            (s.kernel, s.link_tolerance) = (Kernel::Newton, s.link_tolerance.min(EXACT));
        }
        if self.nudged {
            let more = 1.0 + NUDGE;
            d.base.iter_mut().for_each(|b| b.factor *= more);
            d.forces.iter_mut().for_each(|f| f.factor *= more);
            d.supports.iter_mut().for_each(|s| s.factor *= more);
            for i in &mut d.initial {
                i.displacement = i.displacement.map(|x| x * more);
                i.velocity = i.velocity.map(|x| x * more);
            }
        }
    }
}

impl fmt::Display for Setup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.variant)?;
        let words = [
            (self.fine, "shorter steps"),
            (self.basis.is_some(), "wider basis"),
            (self.conserving, "α = 0"),
            (self.own_dummies, "own dummies"),
            (self.exact_links, "exact links"),
            (self.nudged, "nudged"),
        ];
        words.iter().filter(|w| w.0).try_for_each(|w| write!(f, ", {}", w.1))
    }
}

/// What a setup replaced.
pub(crate) struct Before {
    case: Option<Box<DynamicCase>>,
    dummies: Vec<Option<Vec<f64>>>,
}

impl Before {
    pub(crate) fn restore(self, model: &mut Model, case: usize) {
        if let (Some(now), Some(before)) = (dynamic(model, case), self.case) {
            *now = *before;
        }
        for (e, dummies) in model.elements.iter_mut().zip(self.dummies) {
            if let Body::Link(_, options) = &mut e.body {
                options.effective_stiffness = dummies;
            }
        }
    }
}

fn dummies(body: &Body) -> Option<Vec<f64>> {
    match body {
        Body::Link(_, options) => options.effective_stiffness.clone(),
        _ => None,
    }
}

fn dynamic(model: &mut Model, case: usize) -> Option<&mut DynamicCase> {
    match &mut model.cases.get_mut(case)?.analysis {
        Analysis::Dynamic(d) => Some(d),
        Analysis::Static(_) => None,
    }
}

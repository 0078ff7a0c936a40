//! Cases, and how they are solved.

use super::{Check, ModelFault, Part, SHARE};
use crate::{
    Analysis, Basis, DynamicCase, Harmonic, Load, MOST_OUTPUT_STEPS, Solution, StepControl,
    TimeFunction, output_steps,
};
use trilith_element::{Dof, Range};

/// A tolerance: above zero, below one.
pub(crate) const TOLERANCE: Range = Range::Within(f64::MIN_POSITIVE, 1.0 - f64::EPSILON);

/// Least α of HHT: −1/3, rounding apart.
pub(crate) const LEAST_ALPHA: f64 = -1.0 / 3.0 - 1e-12;

impl Check<'_> {
    pub(super) fn cases(&mut self) {
        let m = self.model;
        for function in &m.functions {
            let part = Part::new("function", &function.name, &(0..0));
            self.function(&part, &function.function);
        }
        for (own, case) in m.cases.iter().enumerate() {
            let part = Part::new("case", &case.name, &case.span);
            if let Some(after) = case.after
                && self.index(&part, "case", after, m.cases.len())
                && after >= own
            {
                let after = m.cases[after].name.clone();
                self.report(&part, ModelFault::After { after });
            }
            match &case.analysis {
                Analysis::Static(analysis) => {
                    self.applied(&part, &analysis.loads);
                    self.at_least_one(&part, "steps", analysis.steps);
                }
                Analysis::Dynamic(analysis) => self.dynamic(&part, analysis),
            }
        }
        let whole = Part("the model".into(), 0..0);
        if let Some(case) = m.p_delta
            && self.index(&whole, "case of P-Δ", case, m.cases.len())
            && !matches!(m.cases[case].analysis, Analysis::Static(_))
        {
            let name = &m.cases[case].name;
            self.unsuitable(&whole, format!("P-Δ needs a static case, and \"{name}\" is dynamic"));
        }
    }

    fn at_least_one(&mut self, part: &Part, name: &'static str, count: usize) {
        self.number(part, name, count as f64, Range::Within(1.0, f64::MAX));
    }

    fn applied(&mut self, part: &Part, loads: &[Load]) {
        for load in loads {
            let factor = match load {
                Load::Gravity { factor } => *factor,
                Load::Pattern { pattern, factor } => {
                    self.index(part, "load", *pattern, self.model.patterns.len());
                    *factor
                }
            };
            self.number(part, "factor", factor, Range::Any);
        }
    }

    fn dynamic(&mut self, part: &Part, case: &DynamicCase) {
        let m = self.model;
        let DynamicCase { duration, dt, constant, base, forces, supports, initial, solution } =
            case;
        self.number(part, "duration", *duration, Range::Positive);
        self.number(part, "dt", *dt, Range::Positive);
        if *duration > 0.0 && *dt > 0.0 {
            let steps = output_steps(*duration, *dt);
            if steps > MOST_OUTPUT_STEPS as f64 {
                self.unsuitable(part, format!("`dt` = {dt} s makes {steps:.3e} output steps: at most {MOST_OUTPUT_STEPS} are kept"));
            }
            if *dt > duration * (1.0 + 1e-9) {
                self.unsuitable(
                    part,
                    format!("`dt` = {dt} s is longer than the case, {duration} s"),
                );
            }
        }
        self.applied(part, constant);
        let function = |check: &mut Self, function: usize, factor: f64| {
            check.index(part, "function", function, m.functions.len());
            check.number(part, "factor", factor, Range::Any);
        };
        for motion in base {
            function(self, motion.function, motion.factor);
            if !matches!(motion.direction, Dof::Ux | Dof::Uy | Dof::Uz) {
                self.unsuitable(part, "a motion of the base is along Ux, Uy or Uz");
            }
        }
        for force in forces {
            self.index(part, "load", force.pattern, m.patterns.len());
            function(self, force.function, force.factor);
        }
        for motion in supports {
            function(self, motion.function, motion.factor);
            let (node, dof) = (motion.node, motion.dof);
            let is_fixed = m.supports.iter().any(|s| s.node == node && s.fixed[dof.index()]);
            if self.node(part, node) && !is_fixed {
                let (name, dof) = (&m.nodes[node].name, dof.name());
                self.unsuitable(
                    part,
                    format!("{dof} of node \"{name}\" is moved and not fixed by a support"),
                );
            }
        }
        for value in initial {
            self.node(part, value.node);
            for x in [value.displacement, value.velocity].into_iter().flatten() {
                self.number(part, "initial value", x, Range::Any);
            }
        }
        self.solution(part, solution);
    }

    fn tolerance(&mut self, part: &Part, name: &'static str, value: f64) {
        if !TOLERANCE.contains(value) {
            let allowed = TOLERANCE.text();
            self.report(part, ModelFault::Number { name, value, allowed });
        }
    }

    fn solution(&mut self, part: &Part, solution: &Solution) {
        let Solution { step, link_tolerance, energy_limit, substep_limit, basis, alpha, .. } =
            solution;
        match step {
            StepControl::Adaptive { tolerance } => {
                self.tolerance(part, "tolerance of the steps", *tolerance);
            }
            StepControl::Fixed { substeps } => self.at_least_one(part, "substeps", *substeps),
        }
        self.tolerance(part, "link_tolerance", *link_tolerance);
        // In code one may let any error pass, to measure it.
        self.number(part, "energy_limit", *energy_limit, Range::Positive);
        if let Some(limit) = substep_limit {
            self.at_least_one(part, "substep_limit", *limit);
        }
        if !(LEAST_ALPHA..=0.0).contains(alpha) {
            let allowed = "between -1/3 and 0".into();
            self.report(part, ModelFault::Number { name: "alpha", value: *alpha, allowed });
        }
        let Basis { vectors, adequacy, tolerance, .. } = basis;
        if let Some(vectors) = vectors {
            self.at_least_one(part, "vectors of the basis", *vectors);
        }
        self.number(part, "adequacy of the basis", *adequacy, SHARE);
        self.number(part, "tolerance of the basis", *tolerance, SHARE);
    }

    fn function(&mut self, part: &Part, function: &TimeFunction) {
        let (any, positive) = (Range::Any, Range::Positive);
        let values: Vec<(&'static str, f64, Range)> = match function {
            // A table sees to itself where it is made.
            TimeFunction::Table(_) => Vec::new(),
            TimeFunction::Constant(value) => vec![("value", *value, any)],
            TimeFunction::Step { amplitude, start, end } => vec![
                ("amplitude", *amplitude, any),
                ("start", *start, any),
                ("end", end.unwrap_or(*start), any),
            ],
            TimeFunction::Ramp { amplitude, start, rise } => {
                vec![
                    ("amplitude", *amplitude, any),
                    ("start", *start, any),
                    ("rise", *rise, positive),
                ]
            }
            TimeFunction::HalfSine { amplitude, duration, start } => vec![
                ("amplitude", *amplitude, any),
                ("duration", *duration, positive),
                ("start", *start, any),
            ],
            TimeFunction::Ricker { amplitude, frequency, center } => vec![
                ("amplitude", *amplitude, any),
                ("frequency", *frequency, positive),
                ("center", *center, any),
            ],
            TimeFunction::Sine(h) | TimeFunction::Cosine(h) => {
                let Harmonic { amplitude, frequency, cycles, start, phase } = h;
                vec![
                    ("amplitude", *amplitude, any),
                    ("frequency", *frequency, positive),
                    ("cycles", cycles.unwrap_or(1.0), positive),
                    ("start", *start, any),
                    ("phase", *phase, any),
                ]
            }
            TimeFunction::Custom(custom) => vec![("amplitude", custom.amplitude, any)],
        };
        for (name, value, range) in values {
            self.number(part, name, value, range);
        }
    }
}

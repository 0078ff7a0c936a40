//! Cases of a resolved model.

use super::{custom, factor, text};
use crate::{
    Analysis, Basis, BasisKind, Combination, CombinationTerm, DynamicCase, Kernel, Load, Model,
    Solution, SolverKind, StepControl,
};
use trilith_element::Dimension;
use trilith_element::dimension::{ACCELERATION, LENGTH, NONE};

pub(super) fn case(model: &Model, c: &crate::Case) -> String {
    let after =
        c.after.map_or(String::new(), |i| format!("after: {}, ", text(&model.cases[i].name)));
    match &c.analysis {
        Analysis::Static(s) => {
            format!("Static({after}loads: {}, steps: {})", loads(model, &s.loads), s.steps)
        }
        Analysis::Dynamic(d) => format!("Dynamic({after}{})", dynamic(model, d)),
    }
}

fn loads(model: &Model, all: &[Load]) -> String {
    let one = |load: &Load| match load {
        Load::Gravity { factor } => format!("Gravity(factor: {factor:?})"),
        Load::Pattern { pattern, factor } => {
            format!("(load: {}, factor: {factor:?})", text(&model.patterns[*pattern].name))
        }
    };
    format!("[{}]", all.iter().map(one).collect::<Vec<_>>().join(", "))
}

fn list<T>(items: &[T], one: impl Fn(&T) -> String) -> String {
    format!("[{}]", items.iter().map(one).collect::<Vec<_>>().join(", "))
}

fn dynamic(model: &Model, d: &DynamicCase) -> String {
    // What function and factor must give together decides the unit of the factor.
    let history = |key: &str, function: usize, by: f64, wanted: Dimension| {
        let f = &model.functions[function];
        let unit = f.dimension.map_or(NONE, |own| wanted / own);
        format!("{key}: {}, factor: {}", text(&f.name), factor(by, unit))
    };
    let place = |node: usize, dof: trilith_element::Dof| {
        format!("node: {}, dof: {}", text(&model.nodes[node].name), dof.name())
    };
    let base = list(&d.base, |b| {
        let history = history("function", b.function, b.factor, ACCELERATION);
        format!("(direction: {}, {history})", ["X", "Y", "Z"][b.direction.index() % 3])
    });
    let forces = list(&d.forces, |f| {
        let history = history("function", f.function, f.factor, NONE);
        format!("(load: {}, {history})", text(&model.patterns[f.pattern].name))
    });
    let supports = list(&d.supports, |s| {
        let wanted = if s.dof.is_rotation() { NONE } else { LENGTH };
        let history = history("displacement", s.function, s.factor, wanted);
        format!("({}, {history})", place(s.node, s.dof))
    });
    let initial = list(&d.initial, |i| {
        let u = i.displacement.map_or(String::new(), |x| format!(", displacement: {x:?}"));
        let v = i.velocity.map_or(String::new(), |x| format!(", velocity: {x:?}"));
        format!("({}{u}{v})", place(i.node, i.dof))
    });
    format!(
        "duration: {:?}, dt: {:?}, constant: {}, base: {base}, forces: {forces}, \
         supports: {supports}, initial: {initial}, {}",
        d.duration,
        d.dt,
        loads(model, &d.constant),
        solution(model, &d.solution)
    )
}

fn solution(model: &Model, s: &Solution) -> String {
    let solver = match s.solver {
        SolverKind::Fna => "Fna".into(),
        SolverKind::Hht => "Hht".into(),
        SolverKind::RitzHht => "RitzHht".into(),
        SolverKind::FullNewton => "FullNewton".into(),
        SolverKind::Custom { name, at, .. } => {
            model.solvers.get(at).map_or_else(|| name.into(), |s| custom(s.card, &s.values, &[]))
        }
    };
    let step = match s.step {
        StepControl::Adaptive { tolerance } => format!("Adaptive(tolerance: {tolerance:?})"),
        StepControl::Fixed { substeps } => format!("Fixed(substeps: {substeps})"),
    };
    let kernel = match s.kernel {
        Kernel::Newton => "Newton",
        Kernel::FixedPoint => "FixedPoint",
    };
    let vectors = s.basis.vectors.map_or(String::new(), |n| format!("vectors: {n}, "));
    let Basis { adequacy, tolerance, enrich, .. } = s.basis;
    let fields =
        format!("{vectors}adequacy: {adequacy:?}, tolerance: {tolerance:?}, enrich: {enrich}");
    let basis = match s.basis.kind {
        BasisKind::Ritz => format!("Ritz({fields})"),
        BasisKind::Eigen => format!("Eigen({fields})"),
        BasisKind::Complete => "Complete".into(),
    };
    let limit = s.substep_limit.map_or(String::new(), |n| format!("substep_limit: {n}, "));
    format!(
        "solver: {solver}, step: {step}, kernel: {kernel}, link_tolerance: {:?}, energy_limit: {:?}, \
         {limit}basis: {basis}, alpha: {:?}",
        s.link_tolerance, s.energy_limit, s.alpha
    )
}

pub(super) fn combination(model: &Model, it: &Combination) -> String {
    let term = |(term, factor): &(CombinationTerm, f64)| {
        let name = match *term {
            CombinationTerm::Case(i) => &model.cases[i].name,
            CombinationTerm::Combination(i) => &model.combinations[i].name,
        };
        format!("{}: {factor:?}", text(name))
    };
    let terms: Vec<_> = it.terms.iter().map(term).collect();
    format!("{}(cases: {{ {} }})", it.how.name(), terms.join(", "))
}

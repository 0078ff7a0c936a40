//! How a case was solved, in words.

use super::units::{percent, short};
use std::collections::BTreeMap;
use trilith_model::{
    Analysis, BasisKind, Body, Damping, DynamicCase, Kernel, Model, ParameterValue, SolverKind,
    StepControl,
};

/// Parameters with the values they had.
pub(crate) fn parameters(model: &Model) -> Vec<(String, String)> {
    let value = |v: &ParameterValue| match v {
        ParameterValue::Number(x, d) if d.is_none() => short(*x, 6),
        ParameterValue::Number(x, d) => format!("{} {}", short(*x, 6), d.unit()),
        ParameterValue::Text(t) => t.clone(),
    };
    model.parameters.iter().map(|p| (p.name.clone(), value(&p.value))).collect()
}

/// What the case and the model say about the solution.
pub(crate) fn of_case(
    model: &Model,
    case: usize,
    solver: &str,
    dt: Option<f64>,
) -> Vec<(String, String)> {
    let mut out: Vec<(String, String)> = Vec::new();
    let mut say = |what: &str, value: String| out.push((what.to_owned(), value));
    say("model", counts(model));
    if let Some(plane) = model.plane {
        say("plane", format!("{plane:?}"));
    }
    say("gravity", format!("{} m/s²", short(model.gravity, 4)));
    let kind = model.solver(solver, case);
    let Some(case) = model.cases.get(case) else { return out };
    if let Some(before) = case.after.and_then(|c| model.cases.get(c)) {
        say("continues case", before.name.clone());
    }
    match &case.analysis {
        Analysis::Static(s) => say("load steps", s.steps.to_string()),
        Analysis::Dynamic(d) => dynamic(d, kind.unwrap_or(d.solution.solver), dt, &mut say),
    }
    say("structural damping", damping(&model.damping));
    if let Some(p) = model.p_delta.and_then(|c| model.cases.get(c)) {
        say("P-Δ", format!("axial forces of case \"{}\"", p.name));
    }
    out
}

fn dynamic(
    d: &DynamicCase,
    solver: SolverKind,
    dt: Option<f64>,
    say: &mut impl FnMut(&str, String),
) {
    let s = &d.solution;
    say("duration", format!("{} s", short(d.duration, 6)));
    say("output step", format!("{} s", short(dt.unwrap_or(d.dt), 4)));
    say(
        "steps",
        match s.step {
            StepControl::Adaptive { tolerance } => {
                format!("by error control, tolerance {}", short(tolerance, 3))
            }
            StepControl::Fixed { substeps } => format!("fixed, {substeps} in an output step"),
        },
    );
    say(
        "link equations",
        match s.kernel {
            Kernel::Newton => "Newton with full tangents".into(),
            Kernel::FixedPoint => "constant-stiffness iteration (Wilson)".into(),
        },
    );
    say("tolerance of link forces", short(s.link_tolerance, 3));
    say("limit of energy unaccounted for", percent(s.energy_limit));
    if let Some(limit) = s.substep_limit {
        say("substeps at most", limit.to_string());
    }
    if solver.is_reduced() {
        let kind = match s.basis.kind {
            BasisKind::Ritz => "Ritz vectors",
            BasisKind::Eigen => "eigenvectors",
            BasisKind::Complete => "complete",
        };
        let count = s.basis.vectors.map_or("as many as it takes".into(), |n| n.to_string());
        say("basis asked for", format!("{kind}, {count}, adequacy {}", percent(s.basis.adequacy)));
    }
    if matches!(solver, SolverKind::Hht | SolverKind::RitzHht | SolverKind::FullNewton) {
        say("HHT α", short(s.alpha, 3));
    }
}

fn damping(d: &Damping) -> String {
    match d {
        Damping::None => "none".into(),
        Damping::Modal { ratio } => format!("{} in every mode", percent(*ratio)),
        Damping::ModalTable { points } => {
            let points: Vec<String> = points
                .iter()
                .map(|(f, r)| format!("{} at {} Hz", percent(*r), short(*f, 3)))
                .collect();
            format!("modal: {}", points.join(", "))
        }
        Damping::Rayleigh { mass, stiffness } => {
            format!("Rayleigh: {} 1/s · M + {} s · K", short(*mass, 4), short(*stiffness, 4))
        }
    }
}

fn counts(model: &Model) -> String {
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    let mut links = 0;
    for e in &model.elements {
        *kinds.entry(e.kind).or_insert(0) += 1;
        links += usize::from(matches!(e.body, Body::Link(..)));
    }
    let kinds: Vec<String> = kinds.iter().map(|(kind, n)| format!("{n} {kind}")).collect();
    let nodes = model.nodes.len();
    format!(
        "{nodes} nodes, {} elements ({}), of these {links} links",
        model.elements.len(),
        kinds.join(", ")
    )
}

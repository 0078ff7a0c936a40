//! P-Δ: what is refused, and that the resolved model keeps it.

use trilith_model::SolverKind;
use trilith_solvers::{SolveError, assemble};
use trilith_tests::{parse, registry, trace};

/// A clamped column with a weight on top.
const COLUMN: &str = r#"(
    plane: XZ,
    parameters: { "weight": "100 kN" },
    nodes: { "0": (0, 0, 0), "1": (0, 0, 2), "2": (0, 0, 4) },
    supports: { "0": Fixed },
    properties: { "part": Beam(young: "200 GPa", area: "100 cm^2", i2: "1000 cm^4", i3: "1000 cm^4") },
    elements: {
        "a": Beam(nodes: ("0", "1"), use: "part"), "b": Beam(nodes: ("1", "2"), use: "part"),
        "mass": Mass(node: "2", mass: "1 t"),
    },
    p_delta: "weight",
    loads: { "weight": [(node: "2", dof: Uz, force: "-weight")], "push": [(node: "2", dof: Ux, force: "1 kN")] },
    functions: { "step": Constant(1) },
    cases: {
        "weight": Static(loads: ["weight"]),
        "push": Dynamic(after: "weight", duration: "1 s", dt: "10 ms", forces: [(load: "push", function: "step")]),
    },
    outputs: { "u": Displacement(node: "2", dof: Ux) },
)"#;

/// Euler: π² EI/(4 L²) = 308.4 kN.
#[test]
fn a_column_buckles_at_its_euler_load_and_not_before() {
    for weight in ["250 kN", "307 kN"] {
        let (model, _) = parse(COLUMN, &[("weight", weight.to_owned())]);
        let system = assemble(&model).unwrap();
        let compression = system.tension.iter().fold(0.0, |a: f64, x| a.min(*x));
        let given: f64 = weight.split(' ').next().unwrap().parse().unwrap();
        assert!((compression + given * 1e3).abs() < 1e-6, "{compression}");
    }
    let heavy = [("weight".to_owned(), "310 kN".to_owned())];
    let model = trilith_model::read_text(COLUMN, "column.ron", &registry(), &heavy).unwrap();
    let error = assemble(&model).unwrap_err();
    let SolveError::Buckles { case, force, span, .. } = &error else { panic!("{error}") };
    assert_eq!(case, "weight");
    assert!((force + 310e3).abs() < 1e-3, "{force}");
    assert_eq!(&model.source.text[span.clone()], "weight");
}

#[test]
fn every_solver_sees_the_softer_column() {
    let (model, _) = parse(COLUMN, &[("weight", "150 kN".to_owned())]);
    let system = assemble(&model).unwrap();
    let peak = |solver| trace(&model, &system, solver).0.max[0];
    // Twice the static deflection, with the stability functions of a clamped column.
    let (ei, l, p): (f64, f64, f64) = (2e6, 4.0, 1.5e5);
    let k = (p / ei).sqrt();
    let static_u = 1e3 / (p * k) * ((k * l).tan() - k * l);
    for solver in SolverKind::ALL {
        let share = peak(solver) / (2.0 * static_u);
        assert!((share - 1.0).abs() < 3e-3, "{}: {share}", solver.name());
    }
}

#[test]
fn the_resolved_model_keeps_it() {
    let (model, _) = parse(COLUMN, &[]);
    let text = trilith_model::resolved(&model);
    let again = trilith_model::read_text(&text, "again.ron", &registry(), &[]).unwrap();
    assert_eq!(again.p_delta, Some(0));
}

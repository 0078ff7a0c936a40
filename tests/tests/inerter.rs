//! Inertance is inertia in the equation of motion and nowhere else.

use trilith_tests::parse;

const TEXT: &str = r#"(
    nodes: { "a": (0, 0, 0), "b": (1, 0, 0) },
    supports: { "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "b", mass: 2),
        "spring": Spring(nodes: ("a", "b"), k1: 500),
        "holder": Spring(node: "a", k2: 1e3),
        "between": Inerter(nodes: ("a", "b"), b: 3),
        "grounded": Inerter(node: "b", b: 4, axis: U2),
        "stop": ImpactKelvin(node: "b", k: 1e6, restitution: 0.5, axis: U2, opening: 1),
    },
    cases: { "rest": Static(loads: []) },
)"#;

#[test]
fn inertance_adds_to_the_mass_matrix_but_not_to_weight_and_ground_load() {
    let (model, system) = parse(TEXT, &[]);
    let node = |name: &str| model.nodes.iter().position(|n| n.name == name).unwrap();
    let free =
        |name: &str| system.reduction.free.iter().position(|f| *f == 6 * node(name)).unwrap();
    let (a, b) = (free("a"), free("b"));
    let m = |i: usize, j: usize| {
        let mut e = [vec![0.0; system.order()], vec![0.0; system.order()]];
        (e[0][i], e[1][j]) = (1.0, 1.0);
        system.mass.bilinear(&e[0], &e[1])
    };
    assert_eq!([m(a, a), m(a, b), m(b, a), m(b, b)], [3.0, -3.0, -3.0, 9.0]);
    assert_eq!(system.total_mass, 2.0);
    assert_eq!((system.inertia[0][a], system.inertia[0][b]), (0.0, 2.0));
}

/// What strikes the stop is all inertia behind it: the mass, the inerter to the ground, and of the one
/// between nothing, as its other end follows without mass.
#[test]
fn an_impact_meets_the_inertance() {
    let (model, system) = parse(TEXT, &[]);
    let masses = system.impact_masses(&model).unwrap();
    // The law has been settled with it and keeps the dashpot.
    assert!((masses[0].alone - 6.0).abs() < 1e-9, "{masses:?}");
}

//! Constraints are eliminated exactly: chains and shared nodes resolve, and no mass is lost.

use trilith_model::SolverKind;
use trilith_solvers::modes;
use trilith_tests::{parse, trace};

#[test]
fn a_chain_of_rigid_links_has_the_inertia_of_the_rigid_body() {
    let chain = |links: &str| {
        parse(
            &format!(
                r#"(
            nodes: {{ "a": (0, 0, 0), "b": (1, 0, 0), "c": (1, 2, 0), "d": (1, 2, 3) }},
            elements: {{
                "ma": Mass(node: "a", mass: 1), "mb": Mass(node: "b", mass: 2),
                "mc": Mass(node: "c", mass: 3), "md": Mass(node: "d", mass: 4),
                "ground": Spring(node: "a", k1: 1, k2: 1, k3: 1, r1: 1, r2: 1, r3: 1),
                {links}
            }},
            cases: {{ "swing": Dynamic(duration: 1, dt: 0.01) }},
        )"#
            ),
            &[],
        )
    };
    let chained = chain(
        r#""1": RigidLink(nodes: ("a", "b")), "3": RigidLink(nodes: ("c", "d")), "2": RigidLink(nodes: ("b", "c")),"#,
    );
    let body = chain(r#""1": RigidBody(nodes: ("a", "b", "c", "d")),"#);
    assert_eq!((chained.1.order(), body.1.order()), (6, 6));
    for (x, y) in chained.1.mass.entries().zip(body.1.mass.entries()) {
        assert_eq!((x.0, x.1), (y.0, y.1));
        assert!((x.2 - y.2).abs() < 1e-12);
    }
    // Σ m = 10; about X: Σ m (y² + z²) = 3·4 + 4·(4 + 9); about Z: Σ m (x² + y²) = 2 + 3·5 + 4·5.
    let m = chained.1.mass.diagonal();
    let expected = [10.0, 10.0, 10.0, 64.0, 2.0 + 3.0 + 4.0 * 10.0, 37.0];
    for (x, y) in m.iter().zip(expected) {
        assert!((x - y).abs() < 1e-12, "{m:?}");
    }
}

#[test]
fn two_bodies_that_share_a_node_move_as_one_and_keep_their_mass() {
    let (model, system) = parse(
        r#"(
        nodes: { "a": (0, 0, 0), "s": (1, 0, 0), "b": (2, 0, 0) },
        elements: {
            "ma": Mass(node: "a", mass: 1), "mb": Mass(node: "b", mass: 2),
            "ms": Mass(node: "s", mass: 4),
            "first": RigidBody(nodes: ("a", "s")), "second": RigidBody(nodes: ("b", "s")),
            "ground": Spring(node: "a", k1: 1, k2: 1, k3: 1, r1: 1, r2: 1, r3: 1),
        },
        cases: { "swing": Dynamic(duration: 1, dt: 0.01) },
    )"#,
        &[],
    );
    assert_eq!(system.order(), 6);
    assert!((system.total_mass - 7.0).abs() < 1e-12);
    // In a translation of the whole body the free DOFs along the axis move by one, the others rest.
    for (axis, inertia) in system.inertia.iter().enumerate() {
        let along = |i: &usize| system.reduction.free[*i] % 6 == axis;
        let total: f64 = (0..6).filter(along).map(|i| inertia[i]).sum();
        assert!((total - 7.0).abs() < 1e-12, "{inertia:?}");
    }
    // Motion along X is uncoupled: ω² = k2/Σm, local 2 being X.
    let report = modes(&model, &system, None).unwrap();
    assert!(report.omega.iter().any(|w| (w * w - 1.0 / 7.0).abs() < 1e-9), "{:?}", report.omega);
}

#[test]
fn a_support_under_a_constrained_node_holds_what_it_is_tied_to() {
    let (_, system) = parse(
        r#"(
        plane: XZ,
        nodes: { "a": (0, 0, 0), "b": (1, 0, 0) },
        supports: { "b": (Uz,) },
        elements: {
            "ma": Mass(node: "a", mass: 1, inertia: (1, 1, 1)), "tie": EqualDof(nodes: ("a", "b"), dofs: (Uz,)),
            "k": Spring(node: "a", k2: 1, r3: 1),
        },
        cases: { "swing": Dynamic(duration: 1, dt: 0.01) },
    )"#,
        &[],
    );
    // Ux and Ry of "a" are left; Uz is held through "b".
    assert_eq!(system.order(), 2);
}

/// A floor slab on four springs under its corners: translation √(4k/m), torsion √(4k r²/I) with the mass
/// at the corners, I = m r².
#[test]
fn a_diaphragm_turns_its_corner_springs_into_torsional_stiffness() {
    let (model, system) = parse(
        r#"(
        nodes: { "c": (0, 0, 0), "1": (3, 4, 0), "2": (-3, 4, 0), "3": (-3, -4, 0), "4": (3, -4, 0) },
        supports: { "c": (Uz, Rx, Ry) },
        properties: { "spring": Spring(k2: 100, k3: 100), "mass": Mass(masses: (1, 1, 0)) },
        elements: {
            "slab": Diaphragm(nodes: ("c", "1", "2", "3", "4")),
            "k1": Spring(node: "1", use: "spring"), "k2": Spring(node: "2", use: "spring"),
            "k3": Spring(node: "3", use: "spring"), "k4": Spring(node: "4", use: "spring"),
            "m1": Mass(node: "1", use: "mass"), "m2": Mass(node: "2", use: "mass"),
            "m3": Mass(node: "3", use: "mass"), "m4": Mass(node: "4", use: "mass"),
        },
        cases: { "push": Dynamic(duration: 0.6283185307179586, dt: 0.001,
            initial: [(node: "c", dof: Rz, displacement: 0.01), (node: "c", dof: Ux, displacement: 0.02)]) },
        outputs: { "turn": Displacement(node: "c", dof: Rz), "corner": Displacement(node: "1", dof: Ux) },
    )"#,
        &[],
    );
    assert_eq!(system.order(), 3);
    // All three modes have ω = 10 rad/s: the run is one period.
    for solver in SolverKind::ALL {
        let (t, _) = trace(&model, &system, solver);
        assert!((t.last[0] - 0.01).abs() < 1e-6, "{}: {}", solver.name(), t.last[0]);
        // u_corner = u_c − θ y = 0.02 − 0.01 · 4 at the start.
        assert!((t.history[0][1] + 0.02).abs() < 1e-12 && (t.last[1] + 0.02).abs() < 1e-5);
    }
}

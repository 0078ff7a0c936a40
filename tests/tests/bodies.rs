//! Bodies against bodies: momentum, energy, statics, and one frame of reference against another.

use trilith_model::{Model, SolverKind, read_text};
use trilith_solvers::{RunOptions, Status, warnings};
use trilith_system::System;
use trilith_tests::{Trace, output, parse, registry, trace, trace_with};

const SOLVERS: [SolverKind; 3] = [SolverKind::Fna, SolverKind::Hht, SolverKind::FullNewton];
const G: f64 = 9.81;

fn at_end(model: &Model, trace: &Trace, name: &str) -> f64 {
    trace.last[output(model, name)]
}

/// A ball of unit mass runs into an equal one at rest: they exchange their velocities.
#[test]
fn equal_bodies_exchange_their_velocities() {
    let touches = [
        r#"points: [(-0.5, 0, 0)], face: (0.5, 0, 0), normal: (1, 0, 0)"#,
        r#"radii: (0.5, 0.5), heights: (0)"#,
    ];
    for touch in touches {
        let touch = touch.replace("(0)", "[0]");
        let text = format!(
            r#"(
            nodes: {{ "a": (0, 0, 0), "b": (1.1, 0, 0) }},
            elements: {{
                "ma": Mass(node: "a", mass: 2, inertia: (1, 1, 1)),
                "mb": Mass(node: "b", mass: 2, inertia: (1, 1, 1)),
                "touch": BodyContact(nodes: ("a", "b"), {touch}, kn: 1e6),
            }},
            cases: {{ "hit": Dynamic(duration: 0.2, dt: 0.01, step: Adaptive(tolerance: 1e-7),
                initial: [(node: "a", dof: Ux, velocity: 1.5)]) }},
            outputs: {{ "a": Velocity(node: "a", dof: Ux), "b": Velocity(node: "b", dof: Ux) }},
        )"#
        );
        let (model, system) = parse(&text, &[]);
        for solver in SOLVERS {
            let (found, result) = trace(&model, &system, solver);
            assert_eq!(result.status, Status::Converged);
            let (a, b) = (at_end(&model, &found, "a"), at_end(&model, &found, "b"));
            let off = (a.abs().max((b - 1.5).abs())) / 1.5;
            assert!(off < 1e-3, "{} {touch}: {a} {b}", solver.name());
        }
    }
}

/// Two plates in a plane fly into each other off their middles, turn and rub: whatever happens, momentum and moment of
/// momentum stay, and without friction and dashpots the energy as well.
#[test]
fn momentum_and_energy_stay_what_they_are() {
    let (m, j) = ([3.0, 2.0], [0.4, 0.3]);
    for (mu, damping) in [(0.0, 0.0), (0.5, 40.0)] {
        let text = format!(
            r#"(
            plane: XZ,
            nodes: {{ "a": (0, 0, 0), "b": (1.2, 0, 0.3) }},
            elements: {{
                "ma": Mass(node: "a", mass: {}, inertia: (1, {}, 1)),
                "mb": Mass(node: "b", mass: {}, inertia: (1, {}, 1)),
                "touch": BodyContact(nodes: ("a", "b"),
                    points: [(-0.5, 0, -0.4), (-0.5, 0, 0.4)], face: (0.5, 0, 0), normal: (1, 0, 0),
                    kn: 1e5, ks: 1e5, mu: {mu}, damping: {damping}),
            }},
            cases: {{ "hit": Dynamic(duration: 0.6, dt: 0.01, step: Adaptive(tolerance: 1e-8), initial: [
                (node: "a", dof: Ux, velocity: 1.5), (node: "a", dof: Ry, velocity: -0.4),
                (node: "b", dof: Uz, velocity: -0.6), (node: "b", dof: Ry, velocity: 0.9)]) }},
            outputs: {{
                "xa": Displacement(node: "a", dof: Ux), "za": Displacement(node: "a", dof: Uz),
                "xb": Displacement(node: "b", dof: Ux), "zb": Displacement(node: "b", dof: Uz),
                "ua": Velocity(node: "a", dof: Ux), "wa": Velocity(node: "a", dof: Uz),
                "ub": Velocity(node: "b", dof: Ux), "wb": Velocity(node: "b", dof: Uz),
                "ra": Velocity(node: "a", dof: Ry), "rb": Velocity(node: "b", dof: Ry),
                "push": LinkForce(link: "touch", coordinate: 0),
            }},
        )"#,
            m[0], j[0], m[1], j[1]
        );
        let (model, system) = parse(&text, &[]);
        for solver in [SolverKind::Fna, SolverKind::Hht] {
            let (found, result) = trace(&model, &system, solver);
            assert_eq!(result.status, Status::Converged);
            let sums = |row: &[f64]| {
                let of = |name: &str| row[output(&model, name)];
                let (place_a, place_b) = ([of("xa"), of("za")], [1.2 + of("xb"), 0.3 + of("zb")]);
                let (a, b) = ([of("ua"), of("wa")], [of("ub"), of("wb")]);
                // About Y, which turns Z towards X.
                let turning =
                    |mass: f64, x: [f64; 2], v: [f64; 2]| mass * (x[1] * v[0] - x[0] * v[1]);
                let moment = turning(m[0], place_a, a)
                    + turning(m[1], place_b, b)
                    + j[0] * of("ra")
                    + j[1] * of("rb");
                let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
                let energy = 0.5
                    * (m[0] * square(a)
                        + m[1] * square(b)
                        + j[0] * of("ra").powi(2)
                        + j[1] * of("rb").powi(2));
                [m[0] * a[0] + m[1] * b[0], m[0] * a[1] + m[1] * b[1], moment, energy]
            };
            let (first, last) = (sums(&found.history[0]), sums(found.history.last().unwrap()));
            assert!(found.peak(output(&model, "push")) > 100.0, "they met");
            for (i, (before, after)) in first.iter().zip(last).enumerate().take(3) {
                let off = (before - after).abs();
                assert!(off < 2e-6 * 4.5, "{} {mu} {i}: {before} {after}", solver.name());
            }
            let lost = (first[3] - last[3]) / first[3];
            let range = if mu > 0.0 { 0.01..0.9 } else { -1e-3..1e-3 };
            assert!(range.contains(&lost), "{} {mu}: {lost}", solver.name());
        }
    }
}

/// Block on block on the ground; `more` in the case of the earthquake.
fn stack(more: &str) -> (Model, System) {
    let text = format!(
        r#"(
        plane: XZ,
        gravity: {G},
        nodes: {{ "low": (0, 0, 1), "high": (0, 0, 3) }},
        elements: {{
            "m low": Mass(node: "low", mass: 400, inertia: (200, 200, 200)),
            "m high": Mass(node: "high", mass: 100, inertia: (50, 50, 50)),
            "on ground": RockingBody(node: "low", base: [(-2, 0, -1), (2, 0, -1)],
                kn: 4e7, ks: 4e7, mu: 2, damping: 2e4, pull: true),
            "on low": RockingBody(nodes: ("low", "high"), base: [(-0.5, 0, -1), (0.5, 0, -1)],
                kn: 1e7, ks: 1e7, mu: 2, damping: 1e4, pull: true),
        }},
        functions: {{ "a": Points(points: [{more}], after_end: Zero) }},
        cases: {{
            "gravity": Static(loads: [Gravity]),
            "shake": Dynamic(after: "gravity", duration: 1, dt: 0.005, base: [(direction: X, function: "a")]),
        }},
        outputs: {{
            "z low": Displacement(node: "low", dof: Uz), "z high": Displacement(node: "high", dof: Uz),
            "tilt": LinkHistory(link: "on low", variable: "tilt"),
            "uplift": LinkHistory(link: "on low", variable: "uplift"),
            "on ground": LinkForce(link: "on ground", coordinate: 2),
            "on low": LinkForce(link: "on low", coordinate: 8),
            "under high": LinkForce(link: "on low", coordinate: 2),
        }},
    )"#
    );
    parse(&text, &[])
}

#[test]
fn a_stack_settles_as_its_weights_say() {
    let (model, system) = stack("(0, 0), (1, 0)");
    for solver in SOLVERS {
        let (found, _) = trace(&model, &system, solver);
        let of = |name| at_end(&model, &found, name);
        let (high, all) = (100.0 * G, 500.0 * G);
        let low = -all / 8e7;
        for (name, wanted) in [
            ("on ground", -all),
            ("on low", -high),
            ("under high", high),
            ("z low", low),
            ("z high", low - high / 2e7),
        ] {
            let found = of(name);
            assert!(
                (found / wanted - 1.0).abs() < 1e-8,
                "{} {name}: {found} {wanted}",
                solver.name()
            );
        }
    }
}

/// The upper block lifts off where the ground accelerates by more than g b/h, b half its width and h its half height; and
/// not before.
#[test]
fn the_upper_of_a_stack_lifts_off_where_statics_says() {
    let limit = G * 0.5;
    for (share, lifts) in [(0.97, false), (1.03, true)] {
        // Slowly up, so that nothing swings.
        let a = share * limit;
        let (model, system) = stack(&format!("(0, 0), (0.8, {a}), (1, {a})"));
        for solver in [SolverKind::Fna, SolverKind::Hht] {
            let (found, _) = trace(&model, &system, solver);
            let up = found.history.iter().map(|row| row[output(&model, "uplift")]);
            let most = up.fold(f64::NEG_INFINITY, f64::max);
            assert_eq!(most > 0.0, lifts, "{} {share}: {most}", solver.name());
        }
    }
}

/// A block on a floor that moves is a block on ground that accelerates.
#[test]
fn a_moving_floor_gives_what_base_acceleration_gives() {
    // d = A (1 − cos w t)
    let (size, w) = (0.15, 9.0);
    let points = |scale: f64, phase: f64| {
        let one = |k: u32| {
            let t = f64::from(k) * 5e-4;
            let x = if phase > 0.0 { scale * (w * t).cos() } else { scale * (1.0 - (w * t).cos()) };
            format!("({t}, {x:e})")
        };
        (0..=3000).map(one).collect::<Vec<_>>().join(", ")
    };
    let text = |floor: bool| {
        let (nodes, place) = if floor {
            (
                r#"nodes: ("floor", "cg")"#,
                r#"supports: [(node: "floor", dof: Ux, displacement: "d")]"#,
            )
        } else {
            (r#"node: "cg""#, r#"base: [(direction: X, function: "a")]"#)
        };
        let relative = if floor {
            r#""f": Displacement(node: "floor", dof: Ux), "x": Sum(terms: ["u", (output: "f", factor: -1)]),"#
        } else {
            r#""x": Sum(terms: ["u"]),"#
        };
        format!(
            r#"(
            plane: XZ, gravity: {G},
            nodes: {{ "floor": (0, 0, 0), "cg": (0.1, 0, 1) }},
            supports: {{ "floor": Fixed }},
            elements: {{
                "m": Mass(node: "cg", mass: 100, inertia: (40, 40, 40)),
                "base": RockingBody({nodes}, base: [(-0.4, 0, -1), (0.3, 0, -1)],
                    kn: 1e6, ks: 1e6, mu: 0.6, damping: 5e3, pull: true),
            }},
            functions: {{ "d": Points(points: [{}], interpolation: Cubic), "a": Points(points: [{}]) }},
            cases: {{
                "gravity": Static(loads: [Gravity]),
                "shake": Dynamic(after: "gravity", duration: 1.5, dt: 0.01, step: Adaptive(tolerance: 1e-7), {place}) }},
            outputs: {{ "u": Displacement(node: "cg", dof: Ux), {relative} "z": Displacement(node: "cg", dof: Uz),
                "turn": Displacement(node: "cg", dof: Ry) }},
        )"#,
            points(size, 0.0),
            points(size * w * w, 1.0)
        )
    };
    let (on_floor, its) = parse(&text(true), &[]);
    let (on_ground, own) = parse(&text(false), &[]);
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let (a, _) = trace(&on_floor, &its, solver);
        let (b, _) = trace(&on_ground, &own, solver);
        for name in ["x", "z", "turn"] {
            let (i, k) = (output(&on_floor, name), output(&on_ground, name));
            let size = b.peak(k);
            let apart = a.history.iter().zip(&b.history).map(|(a, b)| (a[i] - b[k]).abs());
            let most = apart.fold(0.0, f64::max);
            assert!(size > 1e-3, "{name} moves: {size}");
            assert!(most < 2e-4 * size, "{} {name}: {most} of {size}", solver.name());
        }
    }
}

/// A floor tilts slowly: the block on it slides where the slope passes the coefficient of friction.
#[test]
fn a_block_slides_down_a_floor_that_is_steeper_than_its_friction() {
    for (slope, slides) in [(0.29_f64, false), (0.32, true)] {
        let angle = slope.atan();
        let rise = |k: u32| {
            let t = 0.05 * f64::from(k);
            let share = 0.5 * (1.0 - (0.5 * std::f64::consts::PI * t.min(2.0)).cos());
            format!("({t}, {:e})", angle * share)
        };
        let rise = (0..=60).map(rise).collect::<Vec<_>>().join(", ");
        let text = format!(
            r#"(
            plane: XZ, gravity: {G},
            nodes: {{ "floor": (0, 0, 0), "cg": (0, 0, 0.2) }},
            supports: {{ "floor": Fixed }},
            elements: {{
                "m": Mass(node: "cg", mass: 100, inertia: (4, 4, 4)),
                "base": RockingBody(nodes: ("floor", "cg"), base: [(-0.5, 0, -0.2), (0.5, 0, -0.2)],
                    kn: 1e7, ks: 1e7, mu: 0.3, damping: 1e4, pull: true),
            }},
            functions: {{ "turn": Points(points: [{rise}], interpolation: Cubic) }},
            cases: {{
                "gravity": Static(loads: [Gravity]),
                "tilt": Dynamic(after: "gravity", duration: 3, dt: 0.01,
                    supports: [(node: "floor", dof: Ry, displacement: "turn")]) }},
            outputs: {{ "x": Displacement(node: "cg", dof: Ux), "turn": Displacement(node: "cg", dof: Ry) }},
        )"#
        );
        let (model, system) = parse(&text, &[]);
        for solver in [SolverKind::Fna, SolverKind::Hht] {
            let (found, _) = trace(&model, &system, solver);
            // Turned with the floor about its node, down along its slope.
            let along = at_end(&model, &found, "x") - 0.2 * angle.sin();
            let gone = along / angle.cos();
            if slides {
                // a = g (sin − μ cos) over the last second, and a little before.
                let least = 0.5 * G * (angle.sin() - 0.3 * angle.cos());
                assert!(gone > least && gone < 2.0 * least, "{}: {gone} {least}", solver.name());
            } else {
                assert!(gone.abs() < 1e-3, "{}: {gone}", solver.name());
            }
            let turned = at_end(&model, &found, "turn");
            assert!((turned - angle).abs() < 1e-3, "{}: {turned} {angle}", solver.name());
        }
    }
}

fn cask_with(more: &str) -> String {
    format!(
        r#"(
        gravity: {G},
        nodes: {{ "cg": (0, 0, 2), "top": (0, 0, 4) }},
        elements: {{
            "m": Mass(node: "cg", mass: 100, inertia: (200, 200, 50)),
            "base": RockingBody(node: "cg", rim_radius: 1, rim_depth: 2, kn: 1e7, ks: 1e7, mu: 0.5, inertia: (200, 200, 50)),
            {more}
        }},
        cases: {{ "gravity": Static(loads: [Gravity]) }},
    )"#
    )
}

/// What takes finite rotations for small ones is refused or named.
#[test]
fn small_rotations_of_a_tilting_body_are_refused_or_named() {
    let read = |more: &str| read_text(&cask_with(more), "cask.ron", &registry(), &[]).unwrap();
    for lever in [
        r#""lever": RigidLink(nodes: ("cg", "top")), "mt": Mass(node: "top", mass: 1),"#,
        r#""lever": RigidBody(nodes: ("cg", "top")), "mt": Mass(node: "top", mass: 1),"#,
        r#""lever": EqualDof(nodes: ("cg", "top"), dofs: [Rx]), "mt": Mass(node: "top", mass: 1, inertia: (1, 1, 1)),"#,
    ] {
        let told = System::without_axial_forces(&read(lever)).unwrap_err();
        let text = told.to_string();
        assert!(text.contains("\"lever\"") && text.contains("\"base\" turns"), "{text}");
        assert!(told.span().is_some());
    }
    let twice = r#""other": RockingBody(node: "cg", base: [(-1, 0, -2), (1, 0, -2)], kn: 1e6),"#;
    let told = System::without_axial_forces(&read(twice)).unwrap_err().to_string();
    assert!(told.contains("\"cg\" is the body of \"base\" already"), "{told}");
    // Translations may be tied.
    let tie =
        r#""tie": EqualDof(nodes: ("cg", "top"), dofs: [Ux]), "mt": Mass(node: "top", mass: 1),"#;
    assert!(System::without_axial_forces(&read(tie)).is_ok());

    let named = |more: &str| warnings(&read(more)).unwrap();
    assert!(named("").is_empty());
    let spring = named(r#""hold": Spring(node: "cg", r1: 10),"#);
    assert!(spring.len() == 1 && spring[0].contains("Spring \"hold\""), "{spring:?}");
    let beam = r#""beam": Beam(nodes: ("cg", "top"), young: 2e11, poisson: 0.3, area: 0.01, i2: 1e-5, i3: 1e-5, torsion: 1e-5),"#;
    assert_eq!(named(beam).len(), 1);
    // A spring that only pulls at the centre of gravity does not.
    assert!(named(r#""pull": Spring(node: "cg", k2: 10),"#).is_empty());
}

/// The row of casks that ships: under both solvers they strike with one force within what the runs say, and are pressed
/// together by no more than that.
#[test]
fn casks_in_a_row_strike_and_do_not_pass_through_each_other() {
    let set = [("duration", "3.6 s".to_owned())];
    let (model, system) = trilith_tests::shipped("cask_row.ron", &set);
    let case = model.cases.len() - 1;
    let found = [SolverKind::Fna, SolverKind::Hht].map(|solver| {
        let options = RunOptions { case, solver: Some(solver), ..RunOptions::default() };
        let (found, result) = trace_with(&model, &system, options);
        assert_eq!(result.status, Status::Converged);
        let least = |name: &str| {
            let i = output(&model, name);
            found.history.iter().map(|row| row[i]).fold(f64::INFINITY, f64::min)
        };
        let [gap, push] = [least("apart"), least("push 12").min(least("push 23"))];
        // Two heights of 1e9 N/m each and their dashpots carry the blow.
        assert!(gap < 0.0 && gap > -0.01, "{}: {gap}", solver.name());
        assert!(push < -1e5 && push > -1e9 * 2.0 * 0.01, "{}: {push}", solver.name());
        [gap, push, least("x 1"), least("x 3")]
    });
    for (a, b) in found[0].iter().zip(&found[1]).skip(2) {
        assert!((a / b - 1.0).abs() < 0.03, "{found:?}");
    }
}

//! Base shear, overturning moment, storey drift and forces of supports against closed forms and against the balance of
//! what acts on a structure.

use trilith_model::SolverKind;
use trilith_solvers::{RunOptions, run};
use trilith_tests::{Trace, output, parse, registry, trace};

/// A mast with a weight at its tip, pushed both ways.
const MAST: &str = r#"(
    parameters: { "height": "4 m", "i": 1e-4, "mass": "3 t", "f": "30 kN", "fy": "20 kN" },
    gravity: 10,
    nodes: { "foot": (1, 2, 0), "tip": (1, 2, "height") },
    supports: { "foot": Fixed },
    elements: {
        "mast": Beam(nodes: ("foot", "tip"), young: "200 GPa", poisson: 0.3, area: 0.01, i2: "i",
            i3: "i", torsion: 1e-4),
        "weight": Mass(node: "tip", mass: "mass"),
    },
    loads: { "push": [(node: "tip", dof: Ux, force: "f"), (node: "tip", dof: Uy, force: "fy")] },
    cases: { "pushed": Static(loads: [Gravity, "push"]) },
    outputs: {
        "shear x": BaseShear(direction: X),
        "shear y": BaseShear(direction: Y),
        "moment x": Overturning(direction: X, about: (1, 2, 0)),
        "moment y": Overturning(direction: Y, about: (1, 2, "1 m")),
        "moment off": Overturning(direction: X, about: "0 m"),
        "drift": StoreyDrift(of: ["foot", "tip"], dof: Ux),
        "rx": Reaction(node: "foot", dof: Ux),
        "rz": Reaction(node: "foot", dof: Uz),
        "ry": Reaction(node: "foot", dof: Ry),
    },
)"#;

/// A value by its name.
type Named<'a> = &'a dyn Fn(&str) -> f64;

#[test]
fn a_mast_stands_as_statics_say() {
    let (model, system) = parse(MAST, &[]);
    let mut seen = Trace::default();
    run(&model, &system, RunOptions::default(), &mut [&mut seen]).unwrap();
    let (h, f, fy, weight, ei) = (4.0, 30e3, 20e3, 30e3, 2e7);
    for (name, exact) in [
        ("shear x", f),
        ("shear y", fy),
        ("moment x", f * h),
        ("moment y", fy * (h - 1.0)),
        // The weight stands 1 m in front of the point.
        ("moment off", f * h + weight),
        ("rx", -f),
        ("rz", weight),
        ("ry", -f * h),
        ("drift", f * h * h / (3.0 * ei)),
    ] {
        let value = seen.last[output(&model, name)];
        assert!((value - exact).abs() < 1e-9 * exact.abs(), "{name}: {value} {exact}");
    }
}

/// Two floors on four bearings, two of which stand on nodes and two on the ground; a strut holds the upper floor.
const BUILDING: &str = r#"(
    plane: XZ,
    nodes: { "p": (0, 0, 0), "q": (6, 0, 0), "a": (0, 0, 0), "b": (6, 0, 0), "c": (0, 0, 3), "d": (6, 0, 3), "wall": (9, 0, 3) },
    supports: { "p": Fixed, "q": Fixed, "wall": Fixed },
    groups: { "feet": ["p", "q"] },
    properties: { "frame": Beam(young: "30 GPa", poisson: 0.2, width: "40 cm", depth: "40 cm") },
    elements: {
        "left": Beam(nodes: ("a", "c"), use: "frame"), "right": Beam(nodes: ("b", "d"), use: "frame"),
        "base": Beam(nodes: ("a", "b"), use: "frame"), "floor": Beam(nodes: ("c", "d"), use: "frame"),
        "strut": Spring(nodes: ("d", "wall"), k1: "2 MN/m", c1: "50 kN*s/m"),
        "ma": Mass(node: "a", mass: "20 t"), "mb": Mass(node: "b", mass: "20 t"),
        "mc": Mass(node: "c", mass: "15 t"), "md": Mass(node: "d", mass: "15 t"),
        "under a": RubberIsolator(nodes: ("p", "a"), axis1: (0, 0, 1), kv: "1 GN/m", k2: "8 MN/m", fy2: "40 kN", ratio2: 0.1),
        "under b": RubberIsolator(nodes: ("q", "b"), axis1: (0, 0, 1), kv: "1 GN/m", k2: "8 MN/m", fy2: "40 kN", ratio2: 0.1),
        "ground a": RubberIsolator(node: "a", kv: "1 GN/m", k2: "4 MN/m", fy2: "30 kN", ratio2: 0.1),
        "ground b": RubberIsolator(node: "b", kv: "1 GN/m", k2: "4 MN/m", fy2: "30 kN", ratio2: 0.1),
    },
    damping: Rayleigh(mass: 0.4, stiffness: "1 ms"),
    functions: { "pulse": Ricker(amplitude: "0.5 g", frequency: "1.5 Hz", center: "0.8 s") },
    cases: {
        "weight": Static(loads: [Gravity]),
        "shake": Dynamic(after: "weight", duration: "2 s", dt: "5 ms", base: [(direction: X, function: "pulse")]),
    },
    outputs: {
        "shear": BaseShear(direction: X),
        "moment": Overturning(direction: X, about: (3, 0, 0)),
        "under": LinkForce(link: ["under a", "under b"], axis: U2),
        "ground": LinkForce(link: ["ground a", "ground b"], axis: U2),
        "feet": Reaction(node: "feet", dof: Ux),
        "lift": Reaction(node: "feet", dof: Uz),
        "carried": LinkForce(link: ["under a", "under b"], axis: U1),
        "strut": Reaction(node: "wall", dof: Ux),
        // − Σ m a and what damps by mass, which acts from outside.
        "inertia": Acceleration(absolute: true, terms: [(node: "a", dof: Ux, factor: "-20 t"),
            (node: "b", dof: Ux, factor: "-20 t"), (node: "c", dof: Ux, factor: "-15 t"), (node: "d", dof: Ux, factor: "-15 t")]),
        "drag": Velocity(terms: [(node: "a", dof: Ux, factor: "-8 t/s"), (node: "b", dof: Ux, factor: "-8 t/s"),
            (node: "c", dof: Ux, factor: "-6 t/s"), (node: "d", dof: Ux, factor: "-6 t/s")]),
        "up left": LinkForce(link: ["under a", "ground a"], axis: U1),
        "up right": LinkForce(link: ["under b", "ground b"], axis: U1),
        "drift": StoreyDrift(of: ["a", "c"], dof: Ux),
        "sway": Displacement(terms: [(node: "c", dof: Ux), (node: "a", dof: Ux, factor: -1)]),
    },
)"#;

#[test]
fn a_building_on_bearings_balances_under_all_solvers() {
    let (model, system) = parse(BUILDING, &[]);
    for solver in [SolverKind::Fna, SolverKind::Hht, SolverKind::RitzHht, SolverKind::FullNewton] {
        let (seen, _) = trace(&model, &system, solver);
        let at = |name: &str| output(&model, name);
        let worst = |difference: &dyn Fn(Named<'_>) -> f64| {
            let all = seen.history.iter().map(|values| difference(&|name| values[at(name)]).abs());
            all.fold(0.0, f64::max)
        };
        let (shear, moment) = (seen.peak(at("shear")), seen.peak(at("moment")));
        assert!(shear > 1e5 && moment > 1e5 && seen.peak(at("strut")) > 1e4, "{solver:?}");
        // Every part of the base shear is recorded by itself as well; the strut passes its share to the wall.
        let parts = worst(&|of| of("shear") - of("under") - of("ground") + of("strut"));
        assert!(parts < 1e-12 * shear, "{solver:?}: {parts}");
        let feet = worst(&|of| of("feet") + of("under"));
        assert!(feet < 1e-12 * shear, "{solver:?}: {feet}");
        let lift = worst(&|of| of("lift") + of("carried"));
        assert!(lift < 1e-12 * seen.peak(at("lift")), "{solver:?}: {lift}");
        // The bearings stand 3 m to the left and to the right, the strut goes to a place 3 m above them.
        let about =
            worst(&|of| of("moment") + 3.0 * of("strut") - 3.0 * (of("up left") - of("up right")));
        assert!(about < 1e-9 * moment, "{solver:?}: {about} {moment}");
        let balance = worst(&|of| of("shear") - of("inertia") - of("drag"));
        assert!(balance < 1e-6 * shear, "{solver:?}: {balance}");
        let drift = worst(&|of| of("drift") - of("sway") / 3.0);
        assert!(drift < 1e-12 * seen.peak(at("drift")), "{solver:?}: {drift}");
    }
}

#[test]
fn the_resolved_text_gives_the_same_outputs() {
    for text in [MAST, BUILDING] {
        let (model, _) = parse(text, &[]);
        let (again, _) = parse(&trilith_model::resolved(&model), &[]);
        assert_eq!(model.outputs, again.outputs);
    }
}

#[test]
fn what_no_support_holds_alone_is_refused() {
    let tied = r#""tie": RigidLink(nodes: ("foot", "tip")), "weight": Mass("#;
    for (from, to, says) in [
        (
            r#""rx": Reaction(node: "foot""#,
            r#""rx": Reaction(node: "tip""#,
            "no support fixes Ux of node `tip`",
        ),
        (r#""weight": Mass("#, tied, "`tie` (RigidLink) ties node `foot`"),
        (r#"[(node: "tip", dof: Ux"#, r#"[(node: "foot", dof: Ux"#, "load `push` acts on Ux"),
        (r#"of: ["foot", "tip"]"#, r#"of: ["tip", "foot"]"#, "node `foot` is not above node `tip`"),
        (r#"of: ["foot", "tip"]"#, r#"of: ["tip"]"#, "two nodes"),
        (r#"BaseShear(direction: X)"#, r#"BaseShear(direction: Z)"#, "`Z`"),
    ] {
        let text = MAST.replacen(from, to, 1);
        assert_ne!(text, MAST, "{from}");
        let path = trilith_tests::root().join("models/test.ron");
        let errors = trilith_model::read_text(&text, &path, &registry(), &[]).unwrap_err();
        let all = errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
        assert!(all.contains(says), "{says} in\n{all}");
    }
}

/// Two storeys, the lower one on a post beside a brace that yields.
const BRACED: &str = r#"(
    plane: XZ,
    nodes: { "g": (0, 0, 0), "a": (0, 0, 3), "b": (0, 0, 6) },
    supports: { "g": Fixed, "a": (Uz, Ry), "b": (Uz, Ry) },
    elements: {
        "lower": Spring(nodes: ("g", "a"), k2: "4 MN/m"),
        "upper": Spring(nodes: ("a", "b"), k2: "3 MN/m"),
        "floor a": Mass(node: "a", mass: "20 t"),
        "floor b": Mass(node: "b", mass: "20 t"),
        "brace": Gap(nodes: ("g", "a"), axis: U2, k: "6 MN/m", opening: "5 mm"),
    },
    damping: Rayleigh(stiffness: "2 ms"),
    functions: { "pulse": Ricker(amplitude: "0.3 g", frequency: "1.5 Hz", center: "1 s") },
    cases: { "shake": Dynamic(duration: "2 s", dt: "2 ms", link_tolerance: 1e-12,
        base: [(direction: X, function: "pulse")]) },
    outputs: {
        "shear": BaseShear(direction: X),
        "moment": Overturning(direction: X, about: (0, 0, 0)),
        "foot": Reaction(node: "g", dof: Ux, factor: -1),
        "drift": StoreyDrift(of: ["g", "a"], dof: Ux),
    },
)"#;

#[test]
fn side_by_side_they_are_those_of_a_model_alone() {
    let (model, system) = parse(BRACED, &[]);
    let mut fixed = parse(BRACED, &[]).0;
    trilith_tests::set_step(&mut fixed, trilith_model::StepControl::Fixed { substeps: 4 });
    let (alone, _) = trace(&fixed, &system, SolverKind::Fna);
    let lanes = trilith::sweep::Lanes::new().run(&[(&model, 0), (&model, 0)], Some(4));
    for lane in lanes {
        let lane = lane.unwrap_or_else(|e| panic!("{e:?}"));
        for name in ["shear", "moment", "foot", "drift"] {
            let (peak, i) = (lane.outputs.get(name).unwrap(), output(&model, name));
            let size = alone.peak(i);
            // A peak between steps lies on a cubic there, and is no less than at their ends.
            assert!((peak.last - alone.last[i]).abs() < 1e-9 * size, "{name}");
            assert!((peak.max - alone.max[i]).abs() < 1e-3 * size, "{name}");
        }
        let of = |name: &str| lane.outputs.get(name).unwrap();
        assert!((of("shear").max - of("foot").max).abs() < 1e-9 * of("shear").max);
    }
}

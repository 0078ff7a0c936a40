//! Sweeps in lanes give what the ordinary engine gives, whoever the neighbours are.

mod by_lane;
mod in_a_row;

use trilith::model::{Analysis, StepControl};
use trilith::solvers::assemble;
use trilith::solvers::lanes::{Instructions, LaneSetup, Tables, march_by, prepare};
use trilith::sweep::{Combination, Engine, Outcome, Sweep};
use trilith::{Model, RunOptions};

/// A mass on a sliding foot between stops, with dashpots.
const FOOT: &str = r#"(
    plane: XZ, gravity: "1 g",
    parameters: { "mu": 0.3, "a": "2 m/s^2", "f": "2 Hz", "k": "4 kN/m", "c": "0.2 kN*s/m" },
    nodes: { "cg": (0, 0, 0) },
    elements: {
        "mass": Mass(node: "cg", mass: "1 t", inertia: (0, 1, 0)),
        "upright": Spring(node: "cg", k2: "k", r3: "1 MN*m", c1: "1 kN*s/m"),
        "foot": NLink(node: "cg", kn: "10 MN/m", ks: "5 MN/m", mu: "mu", damping: "10 kN*s/m"),
        "stop": Gap(node: "cg", k: "2 MN/m", opening: "8 mm", axis: U2),
        "cable": Hook(node: "cg", k: "1 MN/m", opening: "8 mm", axis: U2),
        "damper": Dashpot(node: "cg", c: "c", axis: U2),
    },
    functions: { "pulse": Sine(amplitude: "a", frequency: "f", cycles: 1.5) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "1.5 s", dt: "1 ms",
            base: [(direction: X, function: "pulse")]),
    },
    outputs: {
        "slide": Displacement(node: "cg", dof: Ux),
        "speed": Velocity(node: "cg", dof: Ux),
        "acceleration": Acceleration(node: "cg", dof: Ux, absolute: true),
        "press": LinkForce(link: "foot", axis: U1),
        "stretch": LinkDeformation(link: "cable", axis: U2),
    },
)"#;

fn set(values: &[(&str, &str)]) -> Combination {
    values.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect()
}

fn sweep(text: &str) -> Sweep {
    adaptive(text).fixed_steps(1)
}

/// With the steps of the case, which are adaptive.
fn adaptive(text: &str) -> Sweep {
    Sweep::new(text, "model.ron", trilith::registry()).case("shake")
}

fn outcomes(sweep: &Sweep, combinations: &[Combination]) -> Vec<Outcome> {
    sweep.run(combinations).into_iter().map(|o| o.expect("an outcome")).collect()
}

/// Everything in an outcome, digit by digit.
fn text(outcomes: &[Outcome]) -> String {
    format!("{outcomes:?}")
}

fn read(text: &str, combination: &Combination) -> Model {
    trilith::read_text(text, "model.ron", &trilith::registry(), combination).expect("a model")
}

/// The ordinary engine, by steps of a kind or those of the case.
fn ordinary(text: &str, combination: &Combination, step: Option<StepControl>) -> trilith::Run {
    let mut model = read(text, combination);
    let case = model.case("shake").expect("a case");
    if let (Analysis::Dynamic(dynamic), Some(step)) = (&mut model.cases[case].analysis, step) {
        dynamic.solution.step = step;
    }
    let analysis = trilith::Analysis::new(&model).expect("a structure");
    analysis.run(RunOptions { case, ..RunOptions::default() }).expect("a run")
}

/// Amplitudes, friction, stiffness and a frequency whose pulse ends between two steps.
fn combinations() -> Vec<Combination> {
    let mut all = Vec::new();
    for a in ["1 m/s^2", "3 m/s^2", "5 m/s^2"] {
        for (f, mu) in [("2 Hz", "0.1"), ("2.3456 Hz", "0.2"), ("1.7 Hz", "0.3")] {
            for k in ["4 kN/m", "0 N/m"] {
                all.push(set(&[("a", a), ("f", f), ("mu", mu), ("k", k)]));
            }
        }
    }
    all
}

/// A table on four feet whose friction grows with the speed of sliding, shaken in both directions.
const TABLE: &str = r#"(
    gravity: "9.81 m/s^2",
    parameters: { "mu": 0.2, "a": "5 m/s^2" },
    nodes: {
        "cg": (0, 0, 0.5),
        "a": (-0.4, -0.3, 0), "b": (0.4, -0.3, 0), "c": (0.4, 0.3, 0), "d": (-0.4, 0.3, 0),
    },
    properties: {
        "foot": NLink(kn: "10 MN/m", ks: "5 MN/m", mu_slow: "mu / 2", mu_fast: "mu", rate: "10 s/m",
            damping: "2 kN*s/m"),
    },
    elements: {
        "table": RigidBody(nodes: ("cg", "a", "b", "c", "d")),
        "inertia": Mass(node: "cg", mass: "1 t", inertia: (150, 150, 100)),
        "a": NLink(node: "a", use: "foot"), "b": NLink(node: "b", use: "foot"),
        "c": NLink(node: "c", use: "foot"), "d": NLink(node: "d", use: "foot"),
    },
    functions: { "sine": Sine(amplitude: "a", frequency: "3 Hz", cycles: 3) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "1.2 s", dt: "1 ms", base: [
            (direction: X, function: "sine"), (direction: Y, function: "sine", factor: 0.7),
        ]),
    },
    outputs: {
        "x": Displacement(node: "cg", dof: Ux), "y": Displacement(node: "cg", dof: Uy),
        "a": Displacement(node: "a", dof: Uz), "b": Displacement(node: "b", dof: Uz),
        "c": Displacement(node: "c", dof: Uz), "speed": Velocity(node: "cg", dof: Ux),
    },
)"#;

/// A mass between seven stops on one side and a cable on the other.
const STOPS: &str = r#"(
    plane: XZ, gravity: "1 g",
    parameters: { "a": "3 m/s^2", "k": "200 kN/m" },
    nodes: { "cg": (0, 0, 0) },
    elements: {
        "mass": Mass(node: "cg", mass: "1 t", inertia: (0, 1, 0)),
        "springs": Spring(node: "cg", k1: "10 MN/m", k2: "4 kN/m", r3: "1 MN*m"),
        "1": Gap(node: "cg", k: "k", opening: "1 mm", axis: U2),
        "2": Gap(node: "cg", k: "k", opening: "2 mm", axis: U2),
        "3": Gap(node: "cg", k: "k", opening: "3 mm", axis: U2),
        "4": Gap(node: "cg", k: "k", opening: "5 mm", axis: U2),
        "5": Gap(node: "cg", k: "k", opening: "8 mm", axis: U2),
        "6": Gap(node: "cg", k: "k", opening: "13 mm", axis: U2),
        "7": Gap(node: "cg", k: "k", opening: "21 mm", axis: U2),
        "cable": Hook(node: "cg", k: "1 MN/m", opening: "8 mm", axis: U2),
    },
    functions: { "pulse": Sine(amplitude: "a", frequency: "2 Hz", cycles: 1.5) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "1.5 s", dt: "1 ms",
            base: [(direction: X, function: "pulse")]),
    },
    outputs: { "x": Displacement(node: "cg", dof: Ux), "last": LinkForce(link: "7", axis: U2) },
)"#;

/// The widest registers that the machine has are not the only ones that are used: others must give the same. So must
/// links that go side by side, in pairs and in fours, where an analysis goes alone.
#[test]
fn all_instructions_with_fma_give_the_same_bits() {
    let amplitudes: Vec<Combination> =
        ["1 m/s^2", "3 m/s^2", "6 m/s^2"].map(|a| set(&[("a", a)])).into();
    let frictions = ["0.2", "0.5", "0.7"].map(|mu| set(&[("mu", mu), ("a", "0.6")]));
    for (name, text, chosen) in [
        ("foot", FOOT, combinations().into_iter().step_by(2).take(8).collect()),
        ("block", BLOCK, frictions.into()),
        ("table", TABLE, amplitudes.clone()),
        ("stops", STOPS, amplitudes),
    ] {
        for control in [StepControl::Fixed { substeps: 1 }, ADAPTIVE] {
            agree(name, text, &chosen, control);
        }
    }
}

const ADAPTIVE: StepControl = StepControl::Adaptive { tolerance: 1e-4 };

/// All instructions give the same bits, and in all combinations something happens.
fn agree(name: &str, text: &str, chosen: &[Combination], control: StepControl) {
    let tables = Tables::default();
    let setups: Vec<LaneSetup> = chosen
        .iter()
        .map(|combination| {
            let model = read(text, combination);
            let system = assemble(&model).expect("a structure");
            let case = model.case("shake").expect("a case");
            prepare(&model, &system, case, control, &tables).expect("a start").expect("a lane")
        })
        .collect();
    let setups: Vec<&LaneSetup> = setups.iter().collect();
    let all = Instructions::ALL.map(|i| (i, march_by(i, &setups, 8)));
    for (instructions, found) in &all {
        assert_eq!(found.is_some(), instructions.are_available(), "{name}: {instructions:?}");
        for outcome in found.iter().flatten() {
            assert_eq!(outcome.lost, None, "{name}: {instructions:?}");
            assert!(outcome.iterations > outcome.steps, "{name}: {instructions:?}");
        }
    }
    let fused: Vec<_> = all[1..]
        .iter()
        .filter_map(|(i, found)| Some((i, format!("{:?}", found.as_ref()?))))
        .collect();
    for two in fused.windows(2) {
        assert_eq!(two[0].1, two[1].1, "{name}: {:?} and {:?}", two[0].0, two[1].0);
    }
}

/// Both iterate to a tolerance so fine that what is left of the residual cannot be seen. With adaptive steps both make
/// the same ones, but for very few: where a link is at rest in a direction, rounding decides whether it turns there.
#[test]
fn lanes_give_what_the_ordinary_engine_gives() {
    let foot = &FOOT.replace(r#"dt: "1 ms""#, r#"dt: "1 ms", link_tolerance: 1e-12"#);
    // Long steps: some are halved more than once, and loads end inside of some.
    let long = foot.replace(r#"dt: "1 ms""#, r#"dt: "4 ms""#);
    let long = &long.replace(r#"r3: "1 MN*m""#, r#"r3: "10 kN*m""#);
    let fixed = Some(StepControl::Fixed { substeps: 1 });
    for (text, sweep, step) in
        [(foot, sweep(foot), fixed), (foot, adaptive(foot), None), (long, adaptive(long), None)]
    {
        let all = combinations();
        let mut others = 0;
        for (lane, values) in outcomes(&sweep, &all).iter().zip(&all) {
            assert_eq!(lane.engine, Engine::Lanes, "{values:?}");
            let run = ordinary(text, values, step);
            let is_same = lane.steps == run.result.work.substeps;
            let share = match (is_same, step) {
                (_, Some(_)) => 1e-9,
                (true, None) => 1e-7,
                // What steps of the tolerance leave.
                (false, None) => 1e-2,
            };
            others += usize::from(!is_same);
            same(lane, &run, values, share);
        }
        // How many hangs on the last bits, which are the processor's.
        let allowed = if step.is_some() { 0 } else { all.len() / 3 };
        assert!(others <= allowed, "{others} of {} have made other steps", all.len());
    }
}

/// Feet that rock, and feet in space whose friction hangs on the rate: where links turn inside steps, the errors of the
/// steps hang on it.
#[test]
fn adaptive_lanes_make_the_steps_of_the_ordinary_engine() {
    let fine = |text: &str| text.replace(r#"dt: "1 ms""#, r#"dt: "2 ms", link_tolerance: 1e-12"#);
    let (block, table) = (&fine(BLOCK), &fine(TABLE));
    let cv = ("cv", "20 kN*s/m");
    for (text, values) in [
        (block, set(&[("mu", "0.2"), ("a", "0.6"), ("duration", "1 s"), cv])),
        (block, set(&[("mu", "0.6"), ("a", "0.8"), ("duration", "0.4 s"), cv])),
        (table, set(&[("a", "4 m/s^2")])),
    ] {
        let found = outcomes(&adaptive(text), std::slice::from_ref(&values));
        assert_eq!(found[0].engine, Engine::Lanes, "{values:?}");
        let run = ordinary(text, &values, None);
        assert!(run.result.work.rejected > 10, "{values:?}: {:?}", run.result.work);
        let (steps, substeps) = (found[0].steps, run.result.work.substeps);
        assert!(steps.abs_diff(substeps) <= 4 + substeps / 500, "{values:?}: {steps} {substeps}");
        let share = if steps == substeps { 1e-6 } else { 1e-2 };
        for (name, lane) in &found[0].outputs.0 {
            let peak = run.peak(name).expect("one");
            let what = format!("{name} of {values:?}");
            assert!((lane.max - peak.max).abs() <= share * peak.magnitude(), "{what}");
            assert!((lane.min - peak.min).abs() <= share * peak.magnitude(), "{what}");
        }
    }
}

/// Everything in an outcome.
#[track_caller]
fn same(lane: &Outcome, run: &trilith::Run, values: &Combination, share: f64) {
    let near = |a: f64, b: f64, size: f64, what: &str| {
        assert!((a - b).abs() <= share * size, "{what}: {a} {b}");
    };
    for name in ["slide", "speed", "press", "stretch", "acceleration"] {
        let (a, b) = (lane.outputs.get(name).expect("an output"), run.peak(name).expect("one"));
        let what = format!("{name} of {values:?}");
        let size = b.magnitude();
        near(a.max, b.max, size, &what);
        near(a.min, b.min, size, &what);
        near(a.last, b.last, size, &what);
        if share < 1e-6 && size > 0.0 && b.max > 1e-9 * size {
            assert!((a.t_max - b.t_max).abs() < 1e-6, "{what}: {a:?} {b:?}");
        }
    }
    let (a, b) = (&lane.energy, &run.result.energy);
    for (x, y, what) in [
        (a.input, b.input, "input"),
        (a.kinetic, b.kinetic, "kinetic"),
        (a.strain, b.strain, "strain"),
        (a.potential, b.potential, "potential"),
        (a.modal_damping, b.modal_damping, "damping"),
        (a.link_stored, b.link_stored, "stored"),
        (a.link_hysteretic, b.link_hysteretic, "hysteretic"),
        (a.link_viscous, b.link_viscous, "viscous"),
        (a.error, b.error, "error"),
    ] {
        near(x, y, b.input.abs().max(1.0), &format!("{what} of {values:?}"));
    }
    near(a.error_relative, b.error_relative, 1.0, "share");
    let (a, b) = (lane.contact.as_ref().expect("feet"), run.contact.as_ref().expect("feet"));
    assert_eq!((a.initial_mode, a.mode), (b.initial_mode, b.mode));
    near(a.max_slip, b.max_slip, 1.0, "slip");
    near(a.max_uplift, b.max_uplift, 1.0, "uplift");
}

#[test]
fn an_outcome_does_not_depend_on_neighbours_or_threads() {
    let all = combinations();
    for sweep in [sweep, adaptive] {
        let lanes = text(&outcomes(&sweep(FOOT).threads(1), &all));
        assert_eq!(lanes, text(&outcomes(&sweep(FOOT).threads(1).width(1), &all)), "alone");
        assert_eq!(lanes, text(&outcomes(&sweep(FOOT).threads(1).width(5), &all)), "in fives");
        assert_eq!(lanes, text(&outcomes(&sweep(FOOT).threads(3), &all)), "by three threads");
        let mut backwards: Vec<Combination> = all.clone();
        backwards.reverse();
        let mut found = outcomes(&sweep(FOOT), &backwards);
        found.reverse();
        assert_eq!(lanes, text(&found), "backwards");
    }
}

#[test]
fn what_does_not_fit_runs_on_the_ordinary_engine_and_says_why() {
    let one = [set(&[])];
    let reason = |text: &str| match &outcomes(&sweep(text), &one)[0].engine {
        Engine::Ordinary(reason) => reason.clone(),
        other => panic!("{other:?}"),
    };
    let gap = |i: u32| format!(r#""{i}": Gap(node: "cg", k: 1, axis: U2), "#);
    let gaps: String = (1..=10).map(gap).collect();
    let many = FOOT.replace(r#""damper": "#, &format!(r#"{gaps} "damper": "#));
    let why = reason(&many);
    assert!(why.contains("too many modes or link coordinates"), "{why}");
    let stiff = FOOT.replace(r#"kn: "10 MN/m""#, r#"kn: "10e6 MN/m""#);
    assert!(reason(&stiff).contains("too long"), "{}", reason(&stiff));
    let hht = FOOT.replace(r#"dt: "1 ms""#, r#"dt: "1 ms", solver: Hht"#);
    assert!(reason(&hht).contains("fna"), "{}", reason(&hht));
    let found = outcomes(&adaptive(&many), &one);
    let run = trilith::run(&read(&many, &one[0]), "shake").expect("a run");
    assert_eq!(found[0].energy, run.result.energy);
}

#[test]
fn a_wrong_value_spoils_its_own_outcome_only() {
    let all = [set(&[("mu", "0.2")]), set(&[("mu", "0.2 m")]), set(&[("mu", "0.2")])];
    let found = sweep(FOOT).run(&all);
    assert!(found[0].is_ok() && found[1].is_err() && found[2].is_ok());
}

/// A block, 1 m × 2 m and 4 t, on two contacts with dashpots beside or inside them, under a sine of 5 Hz.
const BLOCK: &str = r#"(
    plane: XZ, gravity: "9.81 m/s^2",
    parameters: { "mu": 0.4, "a": 0.3, "c": "20 kN*s/m", "cv": "0 N*s/m", "duration": "1 s" },
    nodes: { "cg": (0, 0, 1), "left": (-0.5, 0, 0), "right": (0.5, 0, 0) },
    properties: {
        "foot": NLink(kn: "1e8 N/m", ks: "1e8 N/m", mu: "mu", damping: "cv"),
        "dashpot": Spring(c1: "c"),
    },
    elements: {
        "block": RigidBody(nodes: ("cg", "left", "right")),
        "inertia": Mass(node: "cg", mass: "4 t", inertia: (0, "4000 kg * 5 m^2 / 12", 0)),
        "rotation": Spring(node: "cg", cr3: "2 kN*m*s"),
        "dashpot left": Spring(node: "left", use: "dashpot"),
        "dashpot right": Spring(node: "right", use: "dashpot"),
        "foot left": NLink(node: "left", use: "foot"),
        "foot right": NLink(node: "right", use: "foot"),
    },
    functions: { "sine": Sine(amplitude: "a * 9.81 m/s^2", frequency: "5 Hz", cycles: 50) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "duration", dt: "1 ms",
            base: [(direction: X, function: "sine")]),
    },
    outputs: { "sway": Displacement(node: "cg", dof: Ux) },
)"#;

/// OpenSees: two flatSliderBearing elements and viscous dashpots, Newmark ¼ with steps of 0.02 ms. Largest
/// displacement of the centre of gravity, and the last. With steps of 0.05 ms it differs from itself by
/// 1e-4 of the largest where the block slides and by 4e-4 where it rocks; later the motion is chaotic
/// (rocking, 2 s: 0.0160 to 0.0179 m for steps of 0.05 to 1 ms).
#[test]
fn a_block_moves_as_opensees_says() {
    for (mu, a, duration, peak, last, share) in [
        ("0.4", "0.3", "1 s", 5.101e-4, f64::NAN, 1e-3),
        ("0.2", "0.6", "1 s", 0.019_638_77, -0.011_857_00, 1e-3),
        ("0.6", "0.8", "0.3 s", 0.013_477_84, -0.004_183_88, 1e-3),
    ] {
        let one = set(&[("mu", mu), ("a", a), ("duration", duration)]);
        let found = outcomes(&sweep(BLOCK).fixed_steps(50), &[one]);
        let sway = found[0].outputs.get("sway").expect("an output");
        let what = format!("mu {mu}, {a} g: {sway:?}, {:?}", found[0].engine);
        assert_eq!(found[0].engine, Engine::Lanes, "{what}");
        assert!((sway.max.max(-sway.min) - peak).abs() < share * peak, "{what}");
        assert!(last.is_nan() || (sway.last - last).abs() < share * peak, "{what}");
    }
}

/// A dashpot in a contact jumps to its force where the gap closes: a step may have no equilibrium, and
/// its halves have one.
#[test]
fn a_step_without_equilibrium_is_halved_in_its_lane() {
    let mut all = Vec::new();
    for mu in ["0.3", "0.5", "0.7"] {
        for a in ["0.5", "0.7", "0.8", "0.9", "1.0"] {
            let more = [("c", "0 N*s/m"), ("cv", "20 MN*s/m"), ("duration", "5 s")];
            all.push(set(&[&[("mu", mu), ("a", a)][..], &more].concat()));
        }
    }
    let lanes = outcomes(&sweep(BLOCK).threads(1), &all);
    let alone = outcomes(&sweep(BLOCK).threads(1).width(1), &all);
    assert_eq!(text(&lanes), text(&alone));
    assert!(lanes.iter().all(|o| o.engine == Engine::Lanes));
    let halved = lanes.iter().filter(|o| o.steps > 5000).count();
    assert!(halved > 0, "none of these had to be halved");
}

/// A coarser tolerance of the case asks the laws less often.
#[test]
fn the_tolerance_of_the_case_holds_in_lanes() {
    let coarse = FOOT.replace(r#"dt: "1 ms""#, r#"dt: "1 ms", link_tolerance: 1e-3"#);
    assert_ne!(coarse, FOOT);
    let iterations = |text: &str| -> usize {
        outcomes(&sweep(text), &combinations()).iter().map(|o| o.iterations).sum()
    };
    assert!(iterations(&coarse) < iterations(FOOT));
}

/// A stop that gives by more than the model is large, a node that leaves, without an output that shows it, and motion
/// that is lost beside a weight: lanes warn of nothing, so that such runs are made alone.
#[test]
fn what_ends_as_no_model_is_meant_to_is_run_alone_and_told() {
    let text = r#"(
        parameters: { "k": 1e5, "push": 1 },
        nodes: { "a": (0, 0, 0), "b": (1, 0, 0) },
        supports: { "a": (Uy, Uz, Rx, Ry, Rz), "b": Fixed },
        elements: {
            "mass": Mass(node: "a", mass: 1),
            "stop": Gap(nodes: ("a", "b"), k: "k", opening: 0.01),
        },
        functions: { "on": Step(amplitude: 1, start: 0, end: 9) },
        loads: { "push": [(node: "a", dof: Ux, force: "push")] },
        cases: { "shake": Dynamic(duration: 1, dt: 0.001, forces: [(load: "push", function: "on")]) },
        outputs: { "force": LinkForce(link: "stop", axis: U1) },
    )"#;
    let sets =
        [("1e5", "1"), ("10", "1"), ("1e5", "-10")].map(|(k, p)| set(&[("k", k), ("push", p)]));
    let all = outcomes(&adaptive(text), &sets);
    assert_eq!((&all[0].engine, all[0].warnings.len()), (&Engine::Lanes, 0));
    let gentle = outcomes(&adaptive(FOOT), &[set(&[("a", "1e-4 m/s^2")])]);
    for (odd, told) in [
        (&all[1], "\"stop\" was pressed in by"),
        (&all[2], "node \"a\" is 5 m away"),
        (&gentle[0], "all motion is below a thousandth"),
    ] {
        assert!(matches!(odd.engine, Engine::Ordinary(_)), "{:?}", odd.engine);
        assert!(odd.warnings.iter().any(|w| w.contains(told)), "{:?}", odd.warnings);
    }
}

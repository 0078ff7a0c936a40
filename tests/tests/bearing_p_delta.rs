//! Bearings on a pedestal that bends: the weight on them follows their shear, and the pedestal feels its moment.

use trilith::{Analysis, Run, RunOptions};
use trilith_model::SolverKind;
use trilith_tests::parse;

/// Height of the pedestal, m; bending stiffness, N·m²; stiffness of the bearing, N/m; mass on it, kg; push, N.
const H: f64 = 2.0;
const EI: f64 = 40e6;
const K: f64 = 1e6;
const M: f64 = 300e3;
const PUSH: f64 = 2e3;
const G: f64 = 9.806_65;

fn model(link: &str) -> String {
    format!(
        r#"(
        plane: XZ,
        nodes: {{ "g": (0, 0, 0), "t": (0, 0, {H}), "m": (0, 0, {H}) }},
        supports: {{ "g": Fixed, "m": Ry }},
        elements: {{
            "pedestal": Beam(nodes: ("g", "t"), young: 40e9, poisson: 0.2, area: 1, i2: 1e-3, i3: 1e-3, torsion: 1e-3),
            "mass": Mass(node: "m", mass: {M}),
            "bearing": {link}
        }},
        functions: {{ "shake": Sine(amplitude: "0.3 m/s^2", frequency: 0.4, cycles: 3) }},
        loads: {{
            "push": [(node: "m", dof: Ux, force: {PUSH})],
            "back": [(node: "m", dof: Ux, force: -{PUSH})],
        }},
        cases: {{
            "weight": Static(loads: [Gravity]),
            "push": Static(loads: [Gravity, "push"]),
            "let go": Dynamic(after: "push", constant: ["back"], duration: 8, dt: 0.01),
            "shaken": Dynamic(after: "weight", duration: 8, dt: 0.01, base: [(direction: X, function: "shake")]),
        }},
        outputs: {{
            "mass": Displacement(node: "m", dof: Ux), "top": Displacement(node: "t", dof: Ux),
            "turn": Displacement(node: "t", dof: Ry),
            "shear": LinkDeformation(link: "bearing", axis: U2),
        }},
    )"#
    )
}

fn rubber(options: &str) -> String {
    format!(
        r#"RubberIsolator(nodes: ("t", "m"), axis1: (0, 0, 1), axis2: (1, 0, 0), {options}
            kv: "5 GN/m", k2: {K}, k3: {K}, fy2: 1e12, fy3: 1e12, ratio2: 0.1, ratio3: 0.1)"#
    )
}

fn run(link: &str, case: &str, solver: SolverKind) -> Run {
    let (model, _) = parse(&model(link), &[]);
    let case = model.cases.iter().position(|c| c.name == case).unwrap();
    let options = RunOptions { case, solver: Some(solver), ..RunOptions::default() };
    Analysis::new(&model).unwrap().run(options).unwrap()
}

fn last(run: &Run, output: &str) -> f64 {
    *run.history(output).unwrap().last().unwrap()
}

/// Shear d of the bearing and tilt θ of the pedestal under a push Q:
///
/// ```text
/// K d − P θ = Q        EI θ = Q h²/2 + s P d h        s: share of the moment on the pedestal
/// ```
fn exact(share: f64) -> [f64; 2] {
    let p = M * G;
    // Where the moment is on the mass, which does not turn, nothing tilts the bearing.
    let lean = share * p;
    let own = PUSH * H * H / (2.0 * EI);
    let d = (PUSH + lean * own) / (K - lean * lean * H / EI);
    [d, own + lean * d * H / EI]
}

#[test]
fn the_weight_bends_the_pedestal_where_the_shear_has_carried_it() {
    for (options, share) in
        [("", 0.0), ("p_delta_at: (1, 0),", 1.0), ("p_delta_at: (0.5, 0.5),", 0.5)]
    {
        let run = run(&rubber(options), "push", SolverKind::Fna);
        let [d, turn] = exact(share);
        let (shear, tilt) = (last(&run, "shear"), last(&run, "turn"));
        assert!((shear / d - 1.0).abs() < 1e-6, "{options} {shear} {d}");
        assert!((tilt / turn - 1.0).abs() < 1e-6, "{options} {tilt} {turn}");
        // The top of the pedestal under its shear Q and the moment.
        let moment = share * M * G * d;
        let top = PUSH * H.powi(3) / (3.0 * EI) + moment * H * H / (2.0 * EI);
        assert!((last(&run, "top") / top - 1.0).abs() < 1e-6, "{options}");
    }
}

/// Stiffness against the push: of the bearing and the pedestal, less what the weight takes.
#[test]
fn it_swings_as_the_closed_form_says_under_every_solver() {
    let [d, turn] = exact(1.0);
    let top = PUSH * H.powi(3) / (3.0 * EI) + M * G * d * H * H / (2.0 * EI);
    let stiffness = PUSH / (top + d);
    let omega = (stiffness / M).sqrt();
    for solver in SolverKind::ALL {
        let run = run(&rubber("p_delta_at: (1, 0),"), "let go", solver);
        assert!(run.result.status.is_good(), "{:?}", run.result.status);
        let turns = run.history("turn").unwrap();
        for (i, x) in turns.iter().enumerate() {
            let exact = turn * (omega * 0.01 * i as f64).cos();
            // The pedestal has no mass; the second order is small.
            assert!((x - exact).abs() < 5e-3 * turn, "{solver:?} {i}: {x} {exact}");
        }
    }
}

#[test]
fn a_pendulum_on_a_pedestal_is_the_same_under_fna_and_direct_integration() {
    let pendulum = r#"FrictionPendulum(nodes: ("t", "m"), axis1: (0, 0, 1), axis2: (1, 0, 0), p_delta_at: (1, 0),
        kn: "5 GN/m", ks: "100 MN/m", radius: 2, mu: 0.02)"#;
    let [fna, hht] =
        [SolverKind::Fna, SolverKind::Hht].map(|solver| run(pendulum, "shaken", solver));
    for output in ["mass", "turn"] {
        let (a, b) = (fna.history(output).unwrap(), hht.history(output).unwrap());
        let size = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let off = a.iter().zip(b).fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
        assert!(size > 1e-3 && off < 0.01 * size, "{output}: {off} of {size}");
    }
}

#[test]
fn what_cannot_lean_is_refused() {
    let refused = |link: &str, words: &str| {
        let text =
            model(link).replace(r#""shear": LinkDeformation(link: "bearing", axis: U2),"#, "");
        let found = match trilith::read_text(&text, "m.ron", &trilith::registry(), &[]) {
            Err(diagnostics) => format!("{diagnostics:?}"),
            Ok(model) => match Analysis::new(&model) {
                Err(e) => e.to_string(),
                Ok(_) => String::new(),
            },
        };
        assert!(found.contains(words), "{words} in {found}");
    };
    refused(&rubber("p_delta_at: (0.5, 0.2),"), "0.7 in sum");
    refused(&rubber("p_delta_at: (0.8, 0.8),"), "1.6 in sum");
    refused(&rubber("p_delta_at: (1.5, 0),"), "p_delta_at");
    refused(&rubber("p_delta_at: 1,"), "two shares");
    let gap = r#"Gap(nodes: ("t", "m"), axis1: (0, 0, 1), k: 1, p_delta_at: (1, 0))"#;
    refused(gap, "needs a law with U1");
}

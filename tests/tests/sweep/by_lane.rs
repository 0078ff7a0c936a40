//! Links of every kind in lanes: those whose law is asked one lane after the other give what the others give.

use super::{ADAPTIVE, adaptive, agree, ordinary, outcomes, set, text};
use trilith::model::StepControl;
use trilith::sweep::{Combination, Engine};

/// A mass on springs, with a link beside them.
fn mass_with(link: &str) -> String {
    let text = r#"(
        plane: XZ, gravity: "1 g",
        parameters: { "a": "3 m/s^2", "k": "100 kN/m" },
        nodes: { "cg": (0, 0, 0) },
        elements: {
            "mass": Mass(node: "cg", mass: "1 t", inertia: (0, 1, 0)),
            "springs": Spring(node: "cg", k1: "2 MN/m", k2: "k", r3: "10 kN*m", c2: "0.5 kN*s/m"),
            "link": LINK,
        },
        functions: { "sine": Sine(amplitude: "a", frequency: "2 Hz", cycles: 2.5) },
        cases: {
            "gravity": Static(loads: [Gravity]),
            "shake": Dynamic(after: "gravity", duration: "1.5 s", dt: "2 ms", link_tolerance: 1e-12,
                base: [(direction: X, function: "sine")]),
        },
        outputs: {
            "x": Displacement(node: "cg", dof: Ux),
            "acceleration": Acceleration(node: "cg", dof: Ux, absolute: true),
            "force": LinkForce(link: "link", axis: U2),
        },
    )"#;
    text.replace("LINK", link)
}

/// Kinds of links that are asked one lane after the other, and others beside them.
const LINKS: [&str; 13] = [
    r#"MaxwellDamper(node: "cg", k: "5 MN/m", c: "20 kN*(s/m)^0.35", exponent: 0.35, axis: U2)"#,
    r#"BilinearDamper(node: "cg", k: "5 MN/m", c: "40 kN*s/m", cy: "4 kN*s/m", fl: "2 kN", axis: U2)"#,
    r#"FrequencyIndependentViscoelastic(node: "cg", k: "80 kN/m", loss_factor: 0.3, f_min: "0.5 Hz", f_max: "10 Hz", axis: U2)"#,
    r#"MultilinearElastic(node: "cg", deformation: ["-9 mm", "0 mm", "4 mm", "9 mm"], force: ["-3 kN", "0 kN", "1 kN", "3 kN"], axis: U2)"#,
    r#"MultilinearPlastic(node: "cg", deformation: ["-30 mm", "-5 mm", "0 mm", "5 mm", "30 mm"], force: ["-3 kN", "-2 kN", "0 kN", "2 kN", "3 kN"], axis: U2, rule: Takeda)"#,
    r#"MultilinearPlastic(node: "cg", deformation: ["-30 mm", "-5 mm", "0 mm", "5 mm", "30 mm"], force: ["-3 kN", "-2 kN", "0 kN", "2 kN", "3 kN"], axis: U2)"#,
    r#"ImpactKelvin(node: "cg", k: "2 MN/m", restitution: 0.7, opening: "5 mm", axis: U2)"#,
    r#"ImpactHertz(node: "cg", k: "1e8 N/m^1.5", restitution: 0.7, opening: "5 mm", axis: U2)"#,
    r#"FrictionSpring(node: "cg", k: "5 MN/m", k1: "300 kN/m", k2: "100 kN/m", u0: "5 mm", axis: U2)"#,
    r#"LinearLink(node: "cg", stiffness: [[2e6, 1e4, 0, 0, 0, 0], [-1e4, 1e5, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]])"#,
    r#"BoucWen(node: "cg", k: "400 kN/m", dy: "4 mm", alpha: 0.1, delta_eta: 0.05, axis: U2)"#,
    r#"TriplePendulum(node: "cg", kn: "2 MN/m", ks: "1 MN/m", radii: ("1 m", "0.3 m", "0.3 m", "1 m"), mu: (0.08, 0.02, 0.02, 0.1))"#,
    r#"Dashpot(node: "cg", c: "5 kN*(s/m)^0.5", exponent: 0.5, axis: U2)"#,
];

/// Lanes make the steps of the ordinary engine with every law, and the same bits whatever goes beside.
#[test]
fn every_kind_of_link_makes_the_steps_of_the_ordinary_engine() {
    let all: Vec<Combination> = ["1 m/s^2", "4 m/s^2"]
        .into_iter()
        .flat_map(|a| ["60 kN/m", "200 kN/m"].map(|k| set(&[("a", a), ("k", k)])))
        .collect();
    for link in LINKS {
        let text_of = mass_with(link);
        let found = outcomes(&adaptive(&text_of).threads(1), &all);
        for (lane, values) in found.iter().zip(&all) {
            assert_eq!(lane.engine, Engine::Lanes, "{link}");
            let run = ordinary(&text_of, values, None);
            let substeps = run.result.work.substeps;
            let what = format!("{link} {values:?}: {} {substeps}", lane.steps);
            assert!(lane.steps.abs_diff(substeps) <= 4 + substeps / 100, "{what}");
            let share = if lane.steps == substeps { 1e-7 } else { 1e-2 };
            for (name, lane) in &lane.outputs.0 {
                let peak = run.peak(name).expect("one");
                let size = peak.magnitude();
                assert!((lane.max - peak.max).abs() <= share * size, "{name}: {what}");
                assert!((lane.min - peak.min).abs() <= share * size, "{name}: {what}");
            }
            let (a, b) = (&lane.energy, &run.result.energy);
            for (x, y) in [
                (a.link_stored, b.link_stored),
                (a.link_hysteretic, b.link_hysteretic),
                (a.link_viscous, b.link_viscous),
            ] {
                assert!((x - y).abs() <= share * b.input.abs().max(1.0), "{x} {y}: {what}");
            }
        }
        assert_eq!(text(&found), text(&outcomes(&adaptive(&text_of).width(1), &all)), "{link}");
        agree(link, &text_of, &all, ADAPTIVE);
        agree(link, &text_of, &all, StepControl::Fixed { substeps: 4 });
    }
}

//! Sweeps of models with many modes and links, for which no loop is written out.

use super::{ADAPTIVE, adaptive, agree, ordinary, outcomes, set};
use trilith::sweep::{Combination, Engine};
use trilith_model::StepControl;

/// So many masses that slide, each on a link with two coordinates, springs between them; beside the first a damper, a
/// link with one.
fn row(masses: usize) -> String {
    let all = |of: &dyn Fn(usize) -> String| -> String { (0..masses).map(of).collect() };
    let nodes = all(&|i| format!("\"{i}\": ({}, 0, 0), ", 2 * i));
    let parts = all(&|i| {
        let mass = 800 + 70 * i;
        format!(
            "\"mass {i}\": Mass(node: \"{i}\", mass: \"{mass} kg\", inertia: (0, 1, 0)),
            \"upright {i}\": Spring(node: \"{i}\", r3: \"100 kN*m\"),
            \"foot {i}\": NLink(node: \"{i}\", kn: \"10 MN/m\", ks: \"5 MN/m\", mu: \"mu\", damping: \"4 kN*s/m\"), "
        )
    });
    let springs: String = (1..masses)
        .map(|i| {
            format!("\"spring {i}\": Spring(nodes: (\"{}\", \"{i}\"), k1: \"300 kN/m\"), ", i - 1)
        })
        .collect();
    format!(
        r#"(
        plane: XZ, gravity: "1 g", parameters: {{ "a": "3 m/s^2", "mu": 0.2 }},
        nodes: {{ {nodes} }},
        elements: {{ {parts} {springs}
            "damper": Dashpot(node: "0", axis: U2, c: 1000, exponent: 0.7) }},
        functions: {{ "sine": Sine(amplitude: "a", frequency: "2 Hz", cycles: 1.5) }},
        cases: {{
            "gravity": Static(loads: [Gravity]),
            "shake": Dynamic(after: "gravity", duration: "1 s", dt: "2 ms", link_tolerance: 1e-12,
                base: [(direction: X, function: "sine")]),
        }},
        outputs: {{ "first": Displacement(node: "0", dof: Ux), "last": Velocity(node: "{}", dof: Ux) }},
    )"#,
        masses - 1
    )
}

fn chosen() -> Vec<Combination> {
    [("2 m/s^2", "0.1"), ("3 m/s^2", "0.15"), ("5 m/s^2", "0.2")]
        .map(|(a, mu)| set(&[("a", a), ("mu", mu)]))
        .into()
}

/// Numbers of masses that fill the rows of a block, and that do not.
const MASSES: [usize; 4] = [2, 3, 5, 7];

#[test]
fn rows_move_as_on_the_ordinary_engine() {
    for masses in MASSES {
        let text = row(masses);
        for (lane, values) in outcomes(&adaptive(&text), &chosen()).iter().zip(chosen()) {
            assert_eq!(lane.engine, Engine::Lanes, "{masses}: {values:?}");
            let run = ordinary(&text, &values, None);
            assert!(run.result.work.rejected > 10, "{masses}: {:?}", run.result.work);
            let (steps, substeps) = (lane.steps, run.result.work.substeps);
            assert!(steps.abs_diff(substeps) <= 4 + substeps / 500, "{steps} {substeps}");
            let share = if steps == substeps { 1e-6 } else { 1e-2 };
            for (name, lane) in &lane.outputs.0 {
                let peak = run.peak(name).expect("one");
                let what = format!("{name} of {masses}, {values:?}");
                assert!((lane.max - peak.max).abs() <= share * peak.magnitude(), "{what}");
                assert!((lane.min - peak.min).abs() <= share * peak.magnitude(), "{what}");
            }
            let (heat, other) = (lane.energy.link_hysteretic, run.result.energy.link_hysteretic);
            assert!(other > 0.0 && (heat - other).abs() <= share * other, "{heat} {other}");
        }
    }
}

#[test]
fn rows_are_the_same_to_the_bit_with_all_instructions() {
    for masses in MASSES {
        for control in [StepControl::Fixed { substeps: 1 }, ADAPTIVE] {
            agree("row", &row(masses), &chosen(), control);
        }
    }
}

//! A law that looks at the clock does what a load does that grows in time.

use trilith::{Analysis, Checkpoint, Model, SolverKind};

/// A mass of 1 t on a spring of 100 kN/m, at rest under a static case before it is pushed.
fn model(push: &str, forces: &str) -> Model {
    let text = format!(
        r#"(
            plane: XZ,
            nodes: {{ "g": (0, 0, 0), "m": (0, 0, 1) }},
            supports: {{ "g": Fixed, "m": (Ux, Ry) }},
            elements: {{
                "mass": Mass(node: "m", mass: "1 t"),
                "spring": Spring(nodes: ("g", "m"), k1: "100 kN/m"),
                "stop": Gap(nodes: ("g", "m"), k: "1 MN/m", opening: "30 cm"),
                {push}
            }},
            loads: {{ "up": [(node: "m", dof: Uz, force: "20 kN")] }},
            functions: {{ "ramp": Points(points: [(0, 0), (0.503, 0), (0.703, 1), (10, 1)]) }},
            cases: {{
                "weight": Static(loads: [Gravity]),
                "push": Dynamic(after: "weight", duration: "2 s", dt: "20 ms", forces: [{forces}]),
            }},
            outputs: {{ "u": Displacement(node: "m", dof: Uz), "v": Velocity(node: "m", dof: Uz) }},
        )"#
    );
    let mut kinds = trilith::registry();
    trilith_thirdparty_example::register(&mut kinds);
    trilith::read_text(&text, "jack.ron", &kinds, &[]).expect("a model")
}

fn pair() -> [Model; 2] {
    let jack =
        r#""jack": Actuator(nodes: ("g", "m"), force: "20 kN", on: "0.503 s", rise: "0.2 s"),"#;
    [model(jack, ""), model("", r#"(load: "up", function: "ramp")"#)]
}

#[test]
fn it_pushes_as_a_load_does_under_every_solver() {
    let models = pair();
    for solver in [SolverKind::Fna, SolverKind::Hht, SolverKind::RitzHht, SolverKind::FullNewton] {
        let runs = models.each_ref().map(|model| {
            let analysis = Analysis::new(model).expect("a structure");
            analysis.case("push").and_then(|case| case.solver(solver).run()).expect("a run")
        });
        for output in ["u", "v"] {
            let [jack, load] =
                runs.each_ref().map(|run| run.history(output).expect("an output").to_vec());
            let size = load.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let off = jack.iter().zip(&load).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 2e-3 * size, "{output} under {solver:?}: {off} of {size}");
        }
        // What it has put in is told as what a link has given.
        let [jack, load] = runs.map(|run| run.result.energy);
        // The law takes the way of a step for straight.
        assert!(jack.error_relative < 1e-4, "{solver:?}: {}", jack.error_relative);
        let given = -jack.link_hysteretic;
        assert!((given / load.input - 1.0).abs() < 1e-2, "{solver:?}: {given} {}", load.input);
    }
}

/// A checkpoint has the clock in it.
#[test]
fn a_run_that_goes_on_knows_what_time_it_is() {
    let [model, _] = pair();
    let analysis = Analysis::new(&model).expect("a structure");
    let whole = analysis.case("push").and_then(|case| case.run()).expect("a run");
    let part = analysis.case("push").and_then(|case| case.until(0.6).run()).expect("a run");
    let folder = std::env::temp_dir().join(format!("trilith-clock-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("checkpoint.json");
    Checkpoint::new(part.result.end).write(&file).expect("written");
    let end = Checkpoint::read(&file).expect("a checkpoint").state;
    std::fs::remove_dir_all(&folder).expect("removed");
    let rest = analysis.case("push").and_then(|case| case.from(end).run()).expect("a run");
    let [whole, rest] = [&whole, &rest].map(|run| run.peak("u").expect("an output"));
    assert_eq!(whole.max.to_bits(), rest.max.to_bits());
}

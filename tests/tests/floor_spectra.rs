//! Floor spectra of a run against the spectrum of the record itself, and against oscillators that are part of the
//! model.

use trilith::record::measure::{periods, spectrum};
use trilith::record::synthetic::KanaiTajimi;
use trilith::{Analysis, Model, RunOptions, SolverKind};

const SEED: u64 = 11;

/// A storey of 2 Hz that carries light equipment (a millionth of its mass) of several periods; `fixed` stands on the
/// ground.
const EQUIPMENT: [(f64, f64); 3] = [(0.1, 0.05), (0.45, 0.05), (1.2, 0.02)];

fn text() -> String {
    let w = 2.0 * std::f64::consts::TAU;
    let mut nodes = String::new();
    let mut supports = String::new();
    let mut elements = String::new();
    let mut outputs = String::new();
    for (i, (period, z)) in EQUIPMENT.iter().enumerate() {
        let o = std::f64::consts::TAU / period;
        nodes += &format!("\"e{i}\": (0, 0, {}),", i + 1);
        supports += &format!("\"e{i}\": (Uz, Ry),");
        elements += &format!(
            "\"mass {i}\": Mass(node: \"e{i}\", mass: 1e-3),
             \"spring {i}\": Spring(nodes: (\"floor\", \"e{i}\"), k2: {}, c2: {}),",
            1e-3 * o * o,
            2e-3 * z * o
        );
        outputs += &format!("\"a{i}\": Acceleration(node: \"e{i}\", dof: Ux, absolute: true),");
    }
    format!(
        "(
    plane: XZ,
    parameters: {{ \"seed\": {SEED} }},
    nodes: {{ \"fixed\": (1, 0, 0), \"floor\": (0, 0, 0), {nodes} }},
    supports: {{ \"fixed\": (Ux, Uz, Ry), \"floor\": (Uz, Ry), {supports} }},
    elements: {{
        \"post\": Mass(node: \"fixed\", mass: 1),
        \"storey\": Mass(node: \"floor\", mass: 1000),
        \"columns\": Spring(node: \"floor\", k2: {}, c2: {}),
        {elements}
    }},
    functions: {{ \"shake\": Synthetic(seed: \"seed\", peak: \"0.3 g\", duration: \"10 s\") }},
    cases: {{
        \"run\": Dynamic(
            duration: \"12 s\", dt: \"2 ms\", base: [(direction: X, function: \"shake\")],
        ),
    }},
    outputs: {{ {outputs} }},
    spectra: {{
        \"ground\": (node: \"fixed\", dof: Ux, damping: [\"2 %\", 0.05], periods: (from: 0.05, to: 5, count: 40)),
        \"floor\": (node: \"floor\", dof: Ux, damping: [0.02, 0.05], periods: [0.1, 0.45, 1.2]),
        \"by default\": (node: \"floor\", dof: Ux),
    }},
)",
        1000.0 * w * w,
        2000.0 * 0.05 * w
    )
}

fn model() -> Model {
    trilith::read_text(&text(), "floor.ron", &trilith::registry(), &[]).unwrap_or_else(|all| {
        panic!("{}", all.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
    })
}

#[test]
fn spectra_are_those_of_the_record_and_of_oscillators_in_the_model() {
    let model = model();
    let k = KanaiTajimi { seed: SEED, duration: 10.0, ..KanaiTajimi::default() };
    let record = k.make().unwrap();
    let analysis = Analysis::new(&model).unwrap();
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let options = RunOptions { case: 0, solver: Some(solver), ..RunOptions::default() };
        let run = analysis.run(options).unwrap();
        assert!(run.result.status.is_good(), "{:?}", run.result.status);
        let summary = run.summary(&model);
        // A fixed base moves as the record does.
        let ground = summary.spectra.get("ground").unwrap();
        assert!((ground.zpa / k.peak - 1.0).abs() < 1e-9, "{}", ground.zpa);
        for s in &ground.spectra {
            let exact =
                spectrum(&record.acceleration, record.dt, &periods(0.05, 5.0, 40), s.damping);
            for (x, y) in s.responses.iter().zip(&exact.responses) {
                assert!((x.sa / y.sa - 1.0).abs() < 3e-3, "{solver:?} {} {}", x.sa, y.sa);
            }
        }
        // Light equipment does not change how the storey moves.
        let floor = summary.spectra.get("floor").unwrap();
        for (i, (_, z)) in EQUIPMENT.iter().enumerate() {
            let s = floor.spectra.iter().find(|s| s.damping == *z).unwrap();
            let peak = run.peak(&format!("a{i}")).unwrap();
            let direct = peak.max.max(-peak.min);
            let off = s.responses[i].sa / direct - 1.0;
            eprintln!("{solver:?} equipment {i}: floor spectrum off by {:.2e}", off);
            assert!(off.abs() < 0.01, "{solver:?} {i}: {} {direct}", s.responses[i].sa);
        }
        assert_eq!(summary.spectra.get("by default").unwrap().spectra[0].periods.len(), 100);
    }
}

#[test]
fn one_output_serves_all_spectra_of_a_place_and_the_resolved_model_reads_back() {
    let model = model();
    let names: Vec<&str> = model.outputs.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["a0", "a1", "a2", "ground acceleration", "floor acceleration"]);
    let again = trilith::read_text(
        &trilith::model::resolved(&model),
        "resolved.ron",
        &trilith::registry(),
        &[],
    );
    let again = again.unwrap_or_else(|all| panic!("{}", all[0]));
    assert_eq!(model.spectra, again.spectra);
    assert_eq!(model.outputs, again.outputs);
    assert_eq!(model.functions[0].function, again.functions[0].function);
}

/// What a study of seeds does.
#[test]
fn the_seed_is_a_parameter() {
    let read = |seed: &str| {
        let set = [("seed".to_owned(), seed.to_owned())];
        let model = trilith::read_text(&text(), "floor.ron", &trilith::registry(), &set).unwrap();
        model.functions[0].function.clone()
    };
    assert_eq!(read("4"), read("4"));
    assert_ne!(read("4"), read("5"));
}

#[test]
fn files_hold_the_curves_and_the_summary_the_peaks() {
    let model = model();
    let run = trilith::run(&model, "run").unwrap();
    let dir = std::env::temp_dir().join(format!("trilith_floor_spectra_{}", std::process::id()));
    let written = run.write(&model, &dir).unwrap();
    assert!(written.iter().any(|p| p.ends_with("spectra.csv")));
    let curves = std::fs::read_to_string(dir.join("spectra.csv")).unwrap();
    assert_eq!(curves.lines().count(), 1 + 2 * 40 + 2 * 3 + 100);
    let summary = std::fs::read_to_string(dir.join("summary.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let floor = &json["spectra"]["floor"];
    assert_eq!(floor["output"], "floor acceleration");
    assert_eq!(floor["peaks"].as_array().unwrap().len(), 2);
    assert_eq!(floor["peaks"][0]["damping"], 0.02);
    assert!(floor["peaks"][0]["sa"].as_f64().unwrap() > floor["peaks"][1]["sa"].as_f64().unwrap());
    std::fs::remove_dir_all(dir).unwrap();
}

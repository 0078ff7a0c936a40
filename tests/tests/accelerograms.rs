//! The time functions `Record` and `Synthetic`: what arrives in the model.
//!
//! The files are made up by a formula, see `crates/record/tests/files/README.md`.

use trilith::model::{Side, TimeFunction};
use trilith::{Diagnostic, Model};

fn read(function: &str, set: &[(&str, &str)]) -> Result<Model, Vec<Diagnostic>> {
    let text = format!(
        "(
    plane: XZ,
    parameters: {{ \"record\": Text(\"peer.at2\"), \"scale\": 1, \"where\": Text(\"Up\") }},
    nodes: {{ \"m\": (0, 0, 0) }},
    supports: {{ \"m\": (Uz, Ry) }},
    elements: {{ \"m\": Mass(node: \"m\", mass: 1), \"k\": Spring(node: \"m\", k2: 100) }},
    functions: {{ \"shake\": {function} }},
    cases: {{ \"run\": Dynamic(duration: 1, dt: 0.01, base: [(direction: X, function: \"shake\")]) }},
    outputs: {{ \"x\": Displacement(node: \"m\", dof: Ux) }},
)"
    );
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/record/tests/files/model.ron");
    let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    Ok(trilith::read_text(&text, folder, &trilith::registry(), &set)?)
}

fn function(function: &str, set: &[(&str, &str)]) -> TimeFunction {
    match read(function, set) {
        Ok(model) => model.functions[0].function.clone(),
        Err(all) => {
            panic!("{}", all.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
        }
    }
}

/// The formula of the files, m/s².
fn made(i: usize, k: f64) -> f64 {
    let i = i as f64;
    2.0 * k * (0.7 * i + 0.2 * (k - 1.0)).sin() * (-0.05 * i).exp()
}

#[test]
fn every_format_arrives_in_si_and_is_zero_after_its_end() {
    for (file, more, k) in [
        ("peer.at2", "", 1.0),
        ("older.at2", ", format: AT2", 1.0),
        ("esm.asc", "", 1.0),
        ("cosmos.v2", ", component: 2", 1.5),
        ("csmip.v2", ", component: \"up\"", 0.5),
        ("csmip.v1", ", component: Parameter(\"where\")", 0.5),
        ("columns.csv", ", component: \"north\"", 1.0),
        ("blanks.txt", ", dt: \"10 ms\", unit: \"cm/s^2\"", 1.0),
        ("one_column.txt", "", 1.0),
    ] {
        let f = function(&format!("Record(file: \"{file}\"{more})"), &[]);
        for i in 1..29 {
            let found = f.value(0.01 * i as f64, Side::Before);
            assert!((found - made(i, k)).abs() < 2e-5, "{file} {i}: {found} {}", made(i, k));
        }
        assert_eq!(f.value(0.9, Side::Before), 0.0);
    }
}

#[test]
fn file_and_scale_are_parameters() {
    let text = "Record(file: Parameter(\"record\"), scale: \"2*scale\", start: \"0.1 s\")";
    let f = function(text, &[("scale", "-1"), ("record", "esm.asc")]);
    assert!((f.value(0.15, Side::Before) + 2.0 * made(5, 1.0)).abs() < 1e-6);
    assert_eq!(f.value(0.05, Side::Before), 0.0);
}

#[test]
fn processing_follows_the_model() {
    let f = function("Record(file: \"peer.at2\", scale_to: \"0.5 g\")", &[]);
    assert!((f.peak() - 0.5 * 9.80665).abs() < 1e-9);
    let f = function("Record(file: \"peer.at2\", resample: Linear(dt: \"5 ms\"))", &[]);
    assert_eq!(f.table().unwrap().times().len(), 59);
    let f = function(
        "Record(file: \"peer.at2\", trim: (0.02, \"0.2 s\"), baseline: Polynomial(order: 2), taper: \"5 %\",
            filter: Butterworth(highpass: \"1 Hz\", lowpass: \"20 Hz\", order: 2, padding: Keep))",
        &[],
    );
    // 19 samples, and 1.5·2/1 Hz of zeros at each end.
    assert_eq!(f.table().unwrap().times().len(), 19 + 2 * 300);
    let f = function("Record(file: \"peer.at2\", baseline: Rest)", &[]);
    let a = f.table().unwrap().values().to_vec();
    let v = trilith::record::measure::velocity(&a, 0.01);
    assert!(v[29].abs() < 1e-12);
}

#[test]
fn a_synthetic_motion_meets_its_spectrum() {
    let f = function(
        "Synthetic(seed: 2, duration: \"15 s\", envelope: Jennings(rise: 2, strong: 9, decay: 0.4),
            spectrum: [(\"0.05 s\", \"0.5 g\"), (0.2, \"0.9 g\"), (\"0.6 s\", \"0.9 g\"), (3, \"0.18 g\")])",
        &[],
    );
    let a = f.table().unwrap().values();
    let s = trilith::record::measure::spectrum(a, 0.01, &[0.2, 0.35, 0.6], 0.05);
    for r in s.psa() {
        assert!((r / (0.9 * 9.80665) - 1.0).abs() < 0.1, "{r}");
    }
}

#[test]
fn a_name_of_no_file_tells_where_it_is_looked_for() {
    let all = read("Record(file: \"nowhere.at2\")", &[]).unwrap_err();
    assert_eq!(all[0].help.as_deref(), Some("the path counts from the folder of the model file"));
}

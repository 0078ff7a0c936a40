//! `trilith reduce`, as a user meets it.

mod common;

use common::trilith;
use serde_json::Value;

/// A mast of four beams on a yielding bearing, with a friction link at half its height.
const MAST: &str = r#"(
    title: "Mast",
    plane: XZ,
    nodes: { "a": (0, 0, 0), "b": (0, 0, 2), "c": (0, 0, 4), "d": (0, 0, 6), "e": (0, 0, 8) },
    supports: { "a": (Uz, Ry) },
    elements: {
        "1": Beam(nodes: ("a", "b"), young: "210 GPa", area: 0.01, i2: 1e-4, i3: 1e-4, density: 7850),
        "2": Beam(nodes: ("b", "c"), young: "210 GPa", area: 0.01, i2: 1e-4, i3: 1e-4, density: 7850),
        "3": Beam(nodes: ("c", "d"), young: "210 GPa", area: 0.01, i2: 1e-4, i3: 1e-4, density: 7850),
        "4": Beam(nodes: ("d", "e"), young: "210 GPa", area: 0.01, i2: 1e-4, i3: 1e-4, density: 7850),
        "bearing": Wen(node: "a", axis1: (0, 0, 1), axis2: (1, 0, 0), axis: U2, k: "2 MN/m", fy: "2 kN", ratio: 0.1),
    },
    groups: { "mast": ["1", "2", "3", "4"] },
    damping: Rayleigh(mass: 0.2, stiffness: 0.0005),
    functions: { "pulse": Sine(amplitude: "0.3 g", frequency: "2 Hz", cycles: 1) },
    cases: { "shaken": Dynamic(duration: "0.3 s", dt: "5 ms", base: [(direction: X, function: "pulse")]) },
    outputs: { "top": Displacement(node: "e", dof: Ux), "half": Displacement(node: "c", dof: Ux) },
)"#;

fn peaks(folder: &std::path::Path, model: &str, out: &str) -> Vec<f64> {
    let (status, text, err) = trilith(folder, &["run", model, "--no-report", "--out", out]);
    assert_eq!(status, 0, "{text}{err}");
    let summary = std::fs::read_to_string(folder.join(out).join("summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    let of = |name: &str, what: &str| summary["outputs"][name][what].as_f64().unwrap();
    ["top", "half"].iter().flat_map(|name| [of(name, "max"), of(name, "min")]).collect()
}

#[test]
fn a_reduced_model_runs_from_its_folder_and_does_what_the_whole_one_does() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mast.ron"), MAST).unwrap();
    let reduce = |more: &[&str]| {
        let args = [&["reduce", "mast.ron", "--part", "mast", "--out", "small"], more].concat();
        trilith(folder.path(), &args)
    };
    let (status, out, err) = reduce(&["--modes", "all", "--keep", "e"]);
    assert_eq!((status, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("4 elements with 15 directions"), "{out}");
    assert!(out.contains("kept       a, e\nfollow     c\n"), "{out}");
    assert!(out.contains("small/model.ron"), "{out}");
    let whole = peaks(folder.path(), "mast.ron", "whole");
    for (a, b) in whole.iter().zip(peaks(folder.path(), "small/model.ron", "all")) {
        assert!((a - b).abs() < 1e-8 * whole[0].abs(), "{a} and {b}");
    }
    // In place of what it has made, in another form.
    let (status, out, err) = reduce(&["--up-to", "60 Hz", "--format", "op4", "--compare", "0"]);
    assert_eq!((status, err.as_str()), (0, ""), "{out}");
    assert!(!out.contains("whole Hz"), "{out}");
    let mut files: Vec<_> = std::fs::read_dir(folder.path().join("small"))
        .unwrap()
        .map(|f| f.unwrap().file_name().into_string().unwrap())
        .filter(|name| !name.starts_with('.'))
        .collect();
    files.sort();
    assert_eq!(files, ["matrices.op4", "model.ron", "rows.csv"]);
    for (a, b) in whole.iter().zip(peaks(folder.path(), "small/model.ron", "few")) {
        assert!((a - b).abs() < 0.01 * whole[0].abs(), "{a} and {b}");
    }
}

#[test]
fn what_cannot_be_reduced_is_shown_in_the_model() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mast.ron"), MAST).unwrap();
    let told = |args: &[&str]| {
        let (status, out, err) =
            trilith(folder.path(), &[&["reduce", "mast.ron", "--out", "small"], args].concat());
        assert_eq!((status, out.as_str()), (2, ""), "{err}");
        assert!(!folder.path().join("small").exists());
        err
    };
    let err = told(&["--part", "mast,bearing", "--modes", "2"]);
    assert!(err.contains("mast.ron:11:10") && err.contains("\"bearing\" is a Wen"), "{err}");
    let err = told(&["--part", "mist", "--modes", "2"]);
    assert!(
        err.contains("no element or group of elements \"mist\"")
            && err.contains("did you mean `mast`?"),
        "{err}"
    );
    assert!(told(&["--part", "mast"]).contains("--modes <N>"));
    assert!(
        told(&["--part", "mast", "--modes", "two"]).contains("a whole number is wanted, or `all`")
    );
}

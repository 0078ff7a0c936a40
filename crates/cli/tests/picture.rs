//! What the page of a run is told of the look of a model: outlines of sections, groups, colours.

mod common;

use assert_cmd::Command;
use common::trilith;
use serde_json::Value;

#[test]
fn the_picture_knows_sections_groups_and_what_colours_it() {
    let folder = tempfile::tempdir().unwrap();
    let model = r#"(
    nodes: { "a": (0, 0, 0), "b": (0, 0, 3), "c": (4, 0, 3) },
    supports: { "a": Fixed },
    properties: { "steel": Beam(material: Steel, section: "HEB 300") },
    elements: {
        "column": Beam(nodes: ("a", "b"), use: "steel"),
        "beam": Beam(nodes: ("b", "c"), width: "20 cm", depth: "50 cm", young: "30 GPa", poisson: 0.2, density: "2500 kg/m^3"),
        "plain": Truss(nodes: ("a", "c"), area: "1 cm^2", young: "200 GPa"),
        "damper": Dashpot(nodes: ("a", "c"), c: "10 kN*s/m"),
    },
    groups: { "upper": ["b", "c"], "frame": ["column", "beam"] },
    functions: { "push": Sine(amplitude: 1, frequency: "2 Hz", cycles: 1) },
    loads: { "push": (node: "c", dof: Ux, force: "10 kN") },
    cases: { "push": Dynamic(forces: [(load: "push", function: "push")], dt: "10 ms", duration: "0.5 s") },
    outputs: { "u": Displacement(node: "c", dof: Ux), "force": LinkForce(link: "damper", axis: U1) },
)"#;
    std::fs::write(folder.path().join("frame.ron"), model).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_trilith"))
        .current_dir(folder.path())
        .args(["run", "frame.ron", "--out", "out"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    let text = std::fs::read_to_string(folder.path().join("out/report.json"));
    let data: Value = serde_json::from_str(&text.unwrap_or_else(|_| panic!("{said}"))).unwrap();
    let picture = &data["picture"];
    let line = |name: &str| {
        let all = picture["lines"].as_array().unwrap();
        all.iter().position(|l| l["name"] == name).unwrap_or_else(|| panic!("{name} in {all:?}"))
    };
    // Sides of the box about an outline, m: of the rolled section across a column, of a rectangle across a beam along X.
    let size = |name: &str| {
        let outline = picture["lines"][line(name)]["outline"].as_u64().unwrap() as usize;
        let corners = picture["outlines"][outline].as_array().unwrap();
        let side = |k: usize| corners.iter().map(|c| c[k].as_f64().unwrap()).fold(0.0, f64::max);
        (corners.len(), [0, 1, 2].map(|k| 2.0 * side(k)))
    };
    assert_eq!(size("column (Beam)"), (12, [0.3, 0.3, 0.0]));
    assert_eq!(size("beam (Beam)"), (4, [0.0, 0.2, 0.5]));
    assert!(picture["lines"][line("plain (Truss)")].get("outline").is_none());
    let group = |i: usize, of: &str| picture["groups"][i][of].as_array().unwrap().clone();
    assert_eq!(picture["groups"][0]["name"], "upper");
    assert_eq!((group(0, "nodes"), group(0, "lines").len()), (vec![1.into(), 2.into()], 0));
    assert_eq!(group(1, "lines"), [line("column (Beam)"), line("beam (Beam)")]);
    let tint = &data["tints"][0];
    assert_eq!(tint["quantity"], "Dashpot U1 force");
    assert_eq!(
        (&tint["of"][0]["figure"], &tint["of"][0]["links"][0]),
        (&"force".into(), &0.into())
    );
}

/// A pulse of the ground under a mass on a spring, in a plane.
const SHAKEN: &str = r#"(
    plane: XZ,
    nodes: { "base": (0, 0, 0), "mass": (0, 0, 3) },
    supports: { "base": Fixed, "mass": [Uz, Ry] },
    elements: {
        "m": Mass(node: "mass", mass: "1 t"),
        "k": Spring(nodes: ("base", "mass"), k1: "1 MN/m", k2: "40 kN/m"),
    },
    functions: { "pulse": Sine(amplitude: "2 m/s^2", frequency: "2 Hz", cycles: 2) },
    cases: { "shake": Dynamic(base: [(direction: X, function: "pulse")], dt: "5 ms", duration: "2 s") },
    outputs: { "u": Displacement(node: "mass", dof: Ux) },
)"#;

#[test]
fn the_model_where_it_has_moved_most_is_a_figure() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.ron"), SHAKEN).unwrap();
    let args = ["run", "m.ron", "--out", "o", "--figure", "model", "--no-report"];
    let (status, out, err) = trilith(folder.path(), &args);
    assert!(status == 0 && out.contains("model.svg"), "{out}{err}");
    let svg = std::fs::read_to_string(folder.path().join("o/model.svg")).unwrap();
    let peaks = std::fs::read_to_string(folder.path().join("o/summary.json")).unwrap();
    let peaks: Value = serde_json::from_str(&peaks).unwrap();
    let u = &peaks["outputs"]["u"];
    let of = |what: &str| u[what].as_f64().unwrap();
    let at = if of("max") > -of("min") { of("t_max") } else { of("t_min") };
    // Frames are fewer than output steps.
    let shown = svg.split("The model at ").nth(1).unwrap().split(' ').next().unwrap();
    let shown: f64 = shown.parse().unwrap();
    assert!((shown - at).abs() < 0.011, "{shown} {at}");
    assert!(svg.starts_with("<svg width=") && svg.contains("fill=\"#ffffff\""), "{svg}");
}

#[test]
fn a_design_spectrum_lies_over_that_of_the_ground() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.ron"), SHAKEN).unwrap();
    let run =
        |more: &[&str]| trilith(folder.path(), &[&["run", "m.ron", "--out", "o"], more].concat());
    let code = r#"EC8(ground: B, ag: "0.2 g")"#;
    let (status, out, err) = run(&["--spectrum", code, "--figure", "ground"]);
    assert_eq!(status, 0, "{out}{err}");
    let data = std::fs::read_to_string(folder.path().join("o/report.json")).unwrap();
    let data: Value = serde_json::from_str(&data).unwrap();
    let curves = data["ground_spectra"][0]["curves"].as_array().unwrap();
    assert_eq!((curves.len(), &curves[1]["name"]), (2, &Value::from(code)));
    let numbers = |of: &str| -> Vec<f64> {
        let step = curves[1][of]["step"].as_f64().unwrap();
        let all = curves[1][of]["n"].as_array().unwrap();
        all.iter().map(|n| n.as_f64().unwrap() * step).collect()
    };
    // On the plateau of EN 1998-1, 2.5 S a_g with S = 1.2; beyond 4 s it says nothing.
    let (period, y) = (numbers("period"), numbers("y"));
    let plateau = period.iter().zip(&y).find(|(t, _)| **t > 0.3).unwrap().1;
    assert!((plateau - 2.5 * 1.2 * 0.2 * 9.80665).abs() < 1e-3, "{plateau}");
    assert!(period.last().is_some_and(|t| *t > 3.5 && *t <= 4.0), "{period:?}");
    let drawn = std::fs::read_dir(folder.path().join("o")).unwrap();
    let drawn = drawn.map(|e| std::fs::read_to_string(e.unwrap().path()).unwrap_or_default());
    assert!(drawn.into_iter().any(|text| text.starts_with("<svg") && text.contains("EC8(ground")));

    for (more, wanted) in [
        (&["--spectrum", "EC8(ground: Q, ag: 1)"][..], "Q"),
        (&["--spectrum", code, "--no-report"][..], "nothing to lay"),
        (&["--spectrum", "absent.csv"][..], "absent.csv"),
    ] {
        let (status, _, err) = run(more);
        assert!(status == 2 && err.contains(wanted), "{err}");
    }
    let still = SHAKEN.replace("base: [(direction: X, function: \"pulse\")], ", "");
    std::fs::write(folder.path().join("m.ron"), still).unwrap();
    let (status, _, err) = run(&["--spectrum", code]);
    assert!(status == 2 && err.contains("no motion of the ground"), "{err}");
}

#[test]
fn forces_along_members_are_drawn_along_them() {
    let folder = tempfile::tempdir().unwrap();
    let model = r#"(
    plane: XZ,
    nodes: { "wall": (0, 0, 0), "tip": (4, 0, 0) },
    supports: { "wall": Fixed },
    elements: { "arm": Beam(nodes: ("wall", "tip"), material: Steel, section: "HEB 300") },
    loads: { "snow": Uniform(element: "arm", dof: Uz, force: "-5 kN/m") },
    cases: { "snow": Static(loads: [(load: "snow")]) },
    outputs: { "tip": Displacement(node: "tip", dof: Uz) },
    envelopes: { "arm": (element: "arm", stations: 9) },
)"#;
    std::fs::write(folder.path().join("arm.ron"), model).unwrap();
    let (status, out, err) = trilith(folder.path(), &["run", "arm.ron", "--out", "o"]);
    assert_eq!(status, 0, "{out}{err}");
    let data = std::fs::read_to_string(folder.path().join("o/report.json")).unwrap();
    let data: Value = serde_json::from_str(&data).unwrap();
    let members = data["members"].as_array().unwrap();
    let forces: Vec<_> = members.iter().map(|m| m["force"].as_str().unwrap()).collect();
    assert_eq!(forces, ["V2", "M3"], "no axial force, and nothing out of the plane");
    let numbers = |of: &str| -> Vec<f64> {
        let step = members[1][of]["step"].as_f64().unwrap();
        let all = members[1][of]["n"].as_array().unwrap();
        all.iter().map(|n| n.as_f64().unwrap() * step).collect()
    };
    // q (L − x)²/2, hogging.
    for ((x, max), min) in numbers("at").iter().zip(numbers("max")).zip(numbers("min")) {
        let moment = -0.5 * 5e3 * (4.0 - x) * (4.0 - x);
        assert!(
            (max - moment).abs() < 2.0 && (min - moment).abs() < 2.0,
            "{x} {max} {min} {moment}"
        );
    }
    let page = std::fs::read_to_string(folder.path().join("o/report.html")).unwrap();
    assert!(page.contains("<section id=\"members\">") && page.contains("from the first node [m]"));
}

//! What the page of a run is told of the look of a model: outlines of sections, groups, colours.

use assert_cmd::Command;
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

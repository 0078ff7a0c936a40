//! Models in JSON.

use super::kinds::registry;
use super::shown;
use crate::{Diagnostic, Model, read_text, resolved};

const RON: &str = r#"(
    title: "Gravity",
    plane: XZ,
    units: (length: "cm"),
    parameters: { "n": 2, "word": Text("None"), "k": "3 kN/m" },
    nodes: { "A {i}": For(i: "0 to n", of: ("100*i", 0, 0)), "top": (0, 0, 50) },
    supports: { "A 0": Fixed, "A 1": (Ux, Uz), "A 2": Pinned },
    elements: {
        "k {c}": For(c: { "x": (at: 0, to: 1), "y": (at: 1, to: 2) }, when: "at < n",
            of: Spring(nodes: ("A {at}", "A {to}"), stiffness: "k")),
    },
    damping: Modal(ratio: 0.02),
    functions: { "f": Sine(amplitude: "1 cm", frequency: 2) },
    loads: { "p": [(node: "top", dof: Ux, force: 1)] },
    cases: {
        "rest": Static(loads: [Gravity, Gravity(factor: 2), (load: "p", factor: -1.5)]),
        "go": Dynamic(after: "rest", duration: 1, dt: 0.1, basis: Complete, solver: Hht),
    },
    outputs: { "u": Displacement(node: "top", dof: Ux, hidden: true), "s": Sum(terms: ["u"]) },
)"#;

const JSON: &str = r#"{
    "title": "Gravity",
    "plane": "XZ",
    "units": {"length": "cm"},
    "parameters": {"n": 2, "word": {"Text": "None"}, "k": "3 kN/m"},
    "nodes": {"A {i}": {"For": {"i": "0 to n", "of": ["100*i", 0, 0]}}, "top": [0, 0, 50]},
    "supports": {"A 0": "Fixed", "A 1": ["Ux", "Uz"], "A 2": "Pinned"},
    "elements": {
        "k {c}": {"For": {"c": {"x": {"at": 0, "to": 1}, "y": {"at": 1, "to": 2}}, "when": "at < n",
            "of": {"Spring": {"nodes": ["A {at}", "A {to}"], "stiffness": "k"}}}}
    },
    "damping": {"Modal": {"ratio": 0.02}},
    "functions": {"f": {"Sine": {"amplitude": "1 cm", "frequency": 2}}},
    "loads": {"p": [{"node": "top", "dof": "Ux", "force": 1}]},
    "cases": {
        "rest": {"Static": {"loads": ["Gravity", {"Gravity": {"factor": 2}}, {"load": "p", "factor": -1.5}]}},
        "go": {"Dynamic": {"after": "rest", "duration": 1, "dt": 0.1, "basis": "Complete", "solver": "Hht"}}
    },
    "outputs": {"u": {"Displacement": {"node": "top", "dof": "Ux", "hidden": true}}, "s": {"Sum": {"terms": ["u"]}}}
}"#;

fn read(text: &str, path: &str) -> Result<Model, Vec<Diagnostic>> {
    read_text(text, path, &registry(), &[])
}

#[test]
fn a_model_in_json_is_that_in_ron() {
    let models = [(RON, "a.ron"), (JSON, "a.json"), (JSON, "a.JSON")];
    let [ron, json, capitals] = models.map(|(text, path)| {
        resolved(&read(text, path).unwrap_or_else(|e| panic!("{path}: {}", shown(&e))))
    });
    assert_eq!(ron, json);
    assert_eq!(json, capitals);
}

#[test]
fn errors_in_json_have_their_places() {
    let bad = JSON.replace("\"ratio\"", "\"rato\"").replace("\"Hht\"", "\"Hhht\"");
    let errors = read(&bad, "a.json").unwrap_err();
    let told = shown(&errors);
    assert!(told.contains("a.json:12:28") && told.contains("no field `rato`"), "{told}");
    assert!(told.contains("a.json:17:") && told.contains("did you mean `Hht`?"), "{told}");
    let cut = read(&JSON[..JSON.len() / 2], "a.json").unwrap_err();
    assert_eq!(cut[0].code, "E0101", "{}", shown(&cut));
    for end in (0..JSON.len()).filter(|i| JSON.is_char_boundary(*i)) {
        assert!(read(&JSON[..end], "a.json").is_err(), "{end}");
    }
}

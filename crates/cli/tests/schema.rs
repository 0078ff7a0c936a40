//! Models in JSON, and their schema.

mod common;

use common::trilith;
use serde_json::{Value, json};

/// As much of JSON Schema as the schema of models uses.
fn fits(value: &Value, schema: &Value, root: &Value) -> bool {
    if let Some(at) = schema["$ref"].as_str() {
        let target = root.pointer(at.trim_start_matches('#')).unwrap_or_else(|| panic!("no {at}"));
        return fits(value, target, root);
    }
    let is = |name: &str| match name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "boolean" => value.is_boolean(),
        other => panic!("no type {other}"),
    };
    let types = match &schema["type"] {
        Value::String(one) => is(one),
        Value::Array(all) => all.iter().any(|t| is(t.as_str().unwrap())),
        _ => true,
    };
    let alternatives = schema["anyOf"].as_array();
    let alternatives = alternatives.is_none_or(|all| all.iter().any(|s| fits(value, s, root)));
    let listed = schema["enum"].as_array().is_none_or(|all| all.contains(value));
    let constant = schema.get("const").is_none_or(|c| c == value);
    let parts = match value {
        Value::Object(fields) => {
            let needed = schema["required"].as_array();
            needed.is_none_or(|n| n.iter().all(|k| fields.contains_key(k.as_str().unwrap())))
                && fields.iter().all(|(k, v)| match schema["properties"].get(k) {
                    Some(s) => fits(v, s, root),
                    None => match &schema["additionalProperties"] {
                        Value::Bool(allowed) => *allowed,
                        Value::Null => true,
                        other => fits(v, other, root),
                    },
                })
        }
        Value::Array(items) => {
            let count = |key: &str| schema[key].as_u64().map(|n| n as usize);
            count("minItems").is_none_or(|n| items.len() >= n)
                && count("maxItems").is_none_or(|n| items.len() <= n)
                && schema.get("items").is_none_or(|s| items.iter().all(|v| fits(v, s, root)))
        }
        _ => true,
    };
    types && alternatives && listed && constant && parts
}

fn model() -> Value {
    json!({
        "title": "Beams in JSON",
        "parameters": { "n": 3, "span": "4 m" },
        "nodes": { "{i}": { "For": { "i": "0 to n", "of": ["i*span", 0, 0] } } },
        "supports": { "0": "Fixed", "3": ["Uz", "Uy"] },
        "properties": { "beam": { "Beam": { "section": "IPE 300", "material": "Steel" } } },
        "elements": {
            "b{i}": { "For": { "i": "1 to n", "of": { "Beam": { "nodes": ["{i-1}", "{i}"], "use": "beam" } } } },
            "stop": { "Gap": { "node": "2", "k": "1 MN/m", "opening": "1 mm" } },
            "extra": { "Truss": { "nodes": ["0", "3"], "section": { "Pipe": { "diameter": 0.1, "thickness": 0.005 } },
                "material": { "Concrete": "C30/37" } } },
        },
        "groups": { "all": ["b*"] },
        "damping": { "Modal": { "ratio": 0.02 } },
        "functions": { "push": { "Constant": 1 } },
        "loads": { "p": [
            { "Uniform": { "element": "all", "dof": "Uz", "force": "-5 kN/m" } },
            { "node": "1", "dof": "Ux", "force": 10 },
        ] },
        "cases": {
            "1 rest": { "Static": { "loads": ["Gravity", { "load": "p", "factor": 0.5 }] } },
            "2 push": { "Dynamic": { "after": "1 rest", "duration": 0.1, "dt": 0.01, "forces": [{ "load": "p", "function": "push" }] } },
        },
        "combinations": {
            "1 sum": { "LinearAdd": { "cases": { "1 rest": 1.35, "2 push": -1 } } },
            "2 most": { "Envelope": { "cases": ["1 rest", "1 sum"] } },
            "3 one": { "Srss": { "cases": { "2 push": 2 } } },
        },
        "outputs": {
            "m": { "MemberForce": { "element": "b2", "force": "M3", "at": "50 %" } },
            "twice": { "Sum": { "terms": [{ "output": "m", "factor": 2 }] } },
        },
        "envelopes": { "all": { "element": "all", "stations": 3 } },
    })
}

#[test]
fn the_schema_takes_models_and_refuses_wrong_ones() {
    let folder = tempfile::tempdir().unwrap();
    let (status, out, err) = trilith(folder.path(), &["schema"]);
    assert_eq!((status, err.as_str()), (0, ""));
    let schema: Value = serde_json::from_str(&out).unwrap();
    let good = model();
    assert!(fits(&good, &schema, &schema));
    for (at, wrong) in [
        ("/damping/Modal", json!({ "rato": 0.02 })),
        ("/nodes/{i}", json!([1, 2])),
        ("/properties/beam", json!({ "Beem": {} })),
        ("/outputs/m/MemberForce", json!({ "element": "b2", "force": "M3" })),
        ("/elements/stop/Gap", json!({ "node": "2", "k": true })),
        ("/loads/p/0", json!({ "Unifrom": { "element": "all" } })),
        ("/combinations/2 most", json!({ "Envelop": { "cases": ["1 rest"] } })),
        ("/title", json!(3)),
    ] {
        let mut bad = good.clone();
        *bad.pointer_mut(at).unwrap_or_else(|| panic!("no {at}")) = wrong;
        assert!(!fits(&bad, &schema, &schema), "{at}");
    }
}

#[test]
fn a_model_in_json_runs_and_its_errors_have_places() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let text = serde_json::to_string_pretty(&model()).unwrap();
    std::fs::write(here.join("beams.json"), &text).unwrap();
    let (status, out, err) = trilith(here, &["run", "beams.json", "--out", "out"]);
    assert_eq!(status, 0, "{out}{err}");
    let resolved = std::fs::read_to_string(here.join("out/model.resolved.ron")).unwrap();
    std::fs::write(here.join("same.ron"), &resolved).unwrap();
    let (_, first, _) = trilith(here, &["check", "beams.json"]);
    let (_, second, err) = trilith(here, &["check", "same.ron"]);
    assert_eq!(first, second, "{err}");
    std::fs::write(here.join("beams.json"), text.replace("IPE 300", "IPE 310")).unwrap();
    let (status, _, err) = trilith(here, &["run", "beams.json"]);
    assert!(status == 2 && err.contains("did you mean `IPE 300`?"), "{err}");
    assert!(err.contains("beams.json:"), "{err}");
}

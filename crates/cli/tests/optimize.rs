//! `trilith optimize` and `trilith gradient`, as a user meets them.

mod common;

use common::trilith as run;
use serde_json::Value;

/// A mass of 100 kg that strikes an isolator with 1 m/s.
const ISOLATOR: &str = r#"(
    title: "Struck mass",
    parameters: { "c": "200 N*s/m", "k": "10 kN/m" },
    plane: XZ,
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uz, Ry) },
    elements: {
        "mass": Mass(node: "m", mass: "100 kg"),
        "spring": Spring(node: "m", k2: "k"),
        "damper": Dashpot(node: "m", axis: U2, c: "c"),
    },
    cases: { "strike": Dynamic(
        duration: "0.3 s", dt: "2 ms", solver: Hht,
        initial: [(node: "m", dof: Ux, velocity: "1 m/s")],
    ) },
    outputs: { "x": Displacement(node: "m", dof: Ux), "acceleration": Acceleration(node: "m", dof: Ux) },
)"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("struck.ron"), ISOLATOR).unwrap();
    folder
}

const SEARCH: [&str; 6] =
    ["optimize", "struck.ron", "--by", "c=50 N*s/m..2000 N*s/m", "--minimise", "acceleration"];

#[test]
fn the_best_run_is_told_and_can_be_run() {
    let folder = folder();
    let (status, out, err) = run(folder.path(), &[&SEARCH[..], &["--out", "found"]].concat());
    assert_eq!((status, err.as_str()), (0, ""), "{out}");
    let line = out.lines().find(|l| l.starts_with("best: run ")).expect("the best");
    assert!(line.contains("% below that of the first run"), "{line}");
    assert!(out.contains("\nended after "), "{out}");
    let json = std::fs::read_to_string(folder.path().join("found/optimize.json")).unwrap();
    let json: Value = serde_json::from_str(&json).unwrap();
    let best = json["best"].as_u64().unwrap() as usize - 1;
    let goal = json["runs"][best]["goal"].as_f64().unwrap();
    let csv = std::fs::read_to_string(folder.path().join("found/optimize.csv")).unwrap();
    assert_eq!(csv.lines().next(), Some("run,goal [m/s²],c [N·s/m]"));
    assert_eq!(csv.lines().count(), json["runs"].as_array().unwrap().len() + 1);
    // The command, word by word as a shell would take it.
    let command = out.lines().skip_while(|l| *l != "run it:").nth(1).unwrap();
    assert_eq!(json["command"], command);
    let words: Vec<&str> = command.split('\'').collect();
    let mut arguments: Vec<&str> = words[0].split_whitespace().skip(1).collect();
    arguments.push(words[1]);
    arguments.extend(["--out", "best"]);
    let (status, out, _) = run(folder.path(), &arguments);
    assert_eq!(status, 0, "{command}\n{out}");
    let summary = std::fs::read_to_string(folder.path().join("best/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    let of = |key: &str| summary["outputs"]["acceleration"][key].as_f64().unwrap().abs();
    // Peaks of a run are looked for between its substeps as well.
    assert!((of("max").max(of("min")) / goal - 1.0).abs() < 1e-4, "{goal}");
}

#[test]
fn limits_and_json() {
    let folder = folder();
    let by = ["optimize", "struck.ron", "--by", "c=50..2000,k=1 kN/m..100 kN/m log"];
    let (status, out, _) = run(
        folder.path(),
        &[&by[..], &["--minimize", "x", "--limit", "acceleration <= 6 m/s^2", "--json"]].concat(),
    );
    assert_eq!(status, 0, "{out}");
    let json: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(json["limits"][0]["holds"], true);
    assert!(json["limits"][0]["multiplier"].as_f64().unwrap() > 0.1);
    // No search meets this one, and that is no success.
    let (status, out, _) =
        run(folder.path(), &[&SEARCH[..], &["--limit", "x <= 1 mm", "--max-runs", "12"]].concat());
    assert_eq!(status, 1, "{out}");
    assert!(out.contains("broken by") && out.contains("not all limits hold"), "{out}");
}

#[test]
fn what_is_wrong_is_told() {
    let folder = folder();
    let told = |arguments: &[&str], words: &[&str]| {
        let (status, out, err) = run(folder.path(), arguments);
        assert_eq!((status, out.as_str()), (2, ""), "{arguments:?}: {err}");
        words.iter().for_each(|word| assert!(err.contains(word), "{word} in {err}"));
    };
    told(&["optimize", "struck.ron", "--by", "c", "--minimise", "x"], &["NAME=LOW..HIGH"]);
    told(&["optimize", "struck.ron", "--by", "d=1..2", "--minimise", "x"], &["no parameter `d`"]);
    told(&["optimize", "struck.ron", "--by", "c=1..2", "--minimise", "y"], &["no parameter `y`"]);
    let long = [&SEARCH[..], &["--limit", "x < 1"]].concat();
    told(&long, &["`<=` or `>=`"]);
    let (status, _, err) = run(folder.path(), &["gradient", "struck.ron", "--of", "heat of dampr"]);
    assert_eq!(status, 2);
    assert!(err.contains("did you mean `damper`"), "{err}");
}

#[test]
fn heat_has_derivatives() {
    let folder = folder();
    let (status, out, err) = run(
        folder.path(),
        &["gradient", "struck.ron", "--by", "c", "--of", "heat,heat of damper", "--json"],
    );
    assert_eq!(status, 0, "{err}");
    let json: Value = serde_json::from_str(&out).unwrap();
    let of =
        |i: usize| (&json["derivatives"][i]["output"], json["derivatives"][i]["value"].as_f64());
    // There is one link alone, which takes most of ½ m v² = 50 J.
    assert_eq!((of(0).0, of(1).0), (&"heat".into(), &"heat of damper".into()));
    assert_eq!(of(0).1, of(1).1);
    assert!((20.0..50.0).contains(&of(0).1.unwrap()), "{out}");
    assert!(json["derivatives"][0]["by"][0]["derivative"].as_f64().unwrap() > 0.0);
}

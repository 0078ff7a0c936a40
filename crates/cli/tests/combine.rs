//! `trilith combine`, as a user meets it.

mod common;

use common::trilith;
use serde_json::Value;

/// A cantilever column under its load, under wind, and let go from 2 cm: k = 3 EI/L³.
const COLUMN: &str = r#"(
    title: "Column",
    plane: XZ,
    gravity: "10 m/s^2",
    parameters: { "duration": "1 s" },
    nodes: { "base": (0, 0, 0), "top": (0, 0, 4) },
    supports: { "base": Fixed },
    elements: {
        "column": Beam(nodes: ("base", "top"), young: "200 GPa", area: "0.02 m^2", i3: "8e-5 m^4"),
        "mass": Mass(node: "top", mass: "2 t"),
    },
    loads: { "wind": [(node: "top", dof: Ux, force: "3 kN")] },
    cases: {
        "dead": Static(loads: [Gravity]),
        "wind": Static(loads: ["wind"]),
        "left": Dynamic(duration: "duration", dt: "5 ms", initial: [(node: "top", dof: Ux, displacement: "-2 cm")]),
        "right": Dynamic(duration: "duration", dt: "5 ms", initial: [(node: "top", dof: Ux, displacement: "1 cm")]),
    },
    combinations: {
        "strength": LinearAdd(cases: { "dead": 1.35, "wind": -1.5 }),
        "shaken": Envelope(cases: { "left": 1, "right": 3 }),
        "both": Srss(cases: ["left", "right"]),
        "sizes": AbsoluteAdd(cases: ["left", "right"]),
        "design": Envelope(cases: ["strength", "shaken"]),
    },
    outputs: {
        "sway": Displacement(node: "top", dof: Ux),
        "foot": Reaction(node: "base", dof: Uz),
        "hidden": Displacement(node: "top", dof: Uz, hidden: true),
    },
)"#;

fn folder(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("column.ron"), text).unwrap();
    folder
}

fn close(a: &Value, b: f64) {
    let a = a.as_f64().unwrap();
    assert!((a - b).abs() <= 2e-4 * b.abs() + 1e-12, "{a} for {b}");
}

#[test]
fn sums_and_envelopes_are_those_of_the_cases() {
    let folder = folder(COLUMN);
    let (status, out, err) = trilith(folder.path(), &["combine", "column.ron", "--json"]);
    assert_eq!((status, err.as_str()), (0, ""), "{out}");
    let found: Value = serde_json::from_str(&out).unwrap();
    let all = found["combinations"].as_array().unwrap();
    let output = |combination: usize, output: usize| &all[combination]["outputs"][output];
    assert_eq!(all[0]["outputs"].as_array().unwrap().len(), 2, "none that is hidden");
    // u = F L³/3EI
    let wind = 3e3 * 64.0 / (3.0 * 200e9 * 8e-5);
    close(&output(0, 0)["max"], -1.5 * wind);
    close(&output(0, 0)["min"], -1.5 * wind);
    close(&output(0, 1)["max"], 1.35 * 20e3);
    close(&output(1, 0)["max"], 0.03);
    close(&output(1, 0)["min"], -0.03);
    assert_eq!(
        (&output(1, 0)["max_from"], &output(1, 0)["min_from"]),
        (&"right".into(), &"right".into())
    );
    close(&output(2, 0)["max"], 0.02_f64.hypot(0.01));
    close(&output(2, 0)["min"], -(0.02_f64.hypot(0.01)));
    close(&output(3, 0)["min"], -0.03);
    close(&output(4, 1)["max"], 27e3);
    assert_eq!(output(4, 1)["max_from"], "strength");
    assert!(output(0, 0).get("max_from").is_none());
    let cases: Vec<_> = found["cases"].as_array().unwrap().iter().map(|c| &c["name"]).collect();
    assert_eq!(cases, ["dead", "wind", "left", "right"]);
}

#[test]
fn those_that_are_named_are_told_and_no_other_case_runs() {
    // Motions that nobody asks for may be as long as they like.
    let folder = folder(&COLUMN.replace("\"1 s\" }", "\"1000 s\" }"));
    let (status, out, err) = trilith(folder.path(), &["combine", "column.ron", "--of", "strength"]);
    assert_eq!((status, err.as_str()), (0, ""));
    let lines: Vec<&str> = out.lines().map(str::trim_end).collect();
    let expected = [
        "Column",
        "",
        "strength: LinearAdd of 1.35 \"dead\", -1.5 \"wind\"",
        "  output  unit       value",
        "  sway    m     -0.0060000",
        "  foot    N          27000",
        "",
        "cases: \"dead\" (static), \"wind\" (static)",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn a_folder_has_all_values_and_a_page() {
    // Names that a table or a page might take for something else stay names.
    let text = COLUMN.replace("\"sizes\"", "\"=sizes <b>\"");
    let folder = folder(&text);
    let run = |more: &[&str]| {
        let all = [&["combine", "column.ron", "--out", "found"], more].concat();
        trilith(folder.path(), &all)
    };
    let (status, out, err) = run(&[]);
    assert_eq!((status, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("combinations.csv") && out.contains("combinations.html"), "{out}");
    // Its own folder may be written again.
    let (status, out, _) = run(&["--json"]);
    assert_eq!(status, 0, "{out}");
    let found: Value = serde_json::from_str(&out).unwrap();
    let read =
        |name: &str| std::fs::read_to_string(folder.path().join("found").join(name)).unwrap();
    let table = read("combinations.csv");
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0], ["what", "name", "output", "unit", "max", "max from", "min", "min from"]);
    let mut rows = lines[1..].iter();
    for (what, all) in [("case", &found["cases"]), ("combination", &found["combinations"])] {
        for one in all.as_array().unwrap() {
            for output in one["outputs"].as_array().unwrap() {
                let row = rows.next().unwrap();
                assert_eq!((row[0], row[2]), (what, output["output"].as_str().unwrap()));
                let value = |text: &str| text.parse::<f64>().unwrap();
                assert_eq!(Some(value(row[4])), output["max"].as_f64(), "{row:?}");
                assert_eq!(Some(value(row[6])), output["min"].as_f64(), "{row:?}");
                assert_eq!(row[5], output["max_from"].as_str().unwrap_or_default());
            }
        }
    }
    assert_eq!(rows.next(), None);
    assert!(!table.contains(",=sizes"), "{table}");
    let page = read("combinations.html");
    assert!(page.contains("strength") && page.contains("=sizes &lt;b&gt;"), "{page}");
    assert!(!page.contains("=sizes <b>"), "a name is no markup");
    // What another has put there stays.
    std::fs::create_dir(folder.path().join("mine")).unwrap();
    let notes = folder.path().join("mine/combinations.csv");
    std::fs::write(&notes, "notes").unwrap();
    let (status, _, err) = trilith(folder.path(), &["combine", "column.ron", "--out", "mine"]);
    assert!(status != 0 && err.contains("mine"), "{err}");
    assert_eq!(std::fs::read_to_string(notes).unwrap(), "notes");
}

#[test]
fn what_cannot_be_combined_is_told() {
    // A hard stop, and steps of one length that lose energy at it.
    let stop = r#""mass": Mass(node: "top", mass: "2 t"),
        "stop": Gap(node: "top", k: "50 MN/m", opening: "1 mm", axis1: (1, 0, 0)),"#;
    let broken = COLUMN.replace(r#""mass": Mass(node: "top", mass: "2 t"),"#, stop).replace(
        r#"displacement: "1 cm")]"#,
        r#"displacement: "1 cm")], step: Fixed(substeps: 1), energy_limit: 1e-6"#,
    );
    let folder = folder(&broken);
    let run = |of: &str| trilith(folder.path(), &["combine", "column.ron", "--of", of]);
    let (status, _, err) = run("strenth");
    assert!(status == 2 && err.contains("did you mean `strength`?"), "{err}");
    let (status, out, err) = run("both");
    assert!(status == 1 && out.is_empty() && err.contains("case \"right\""), "{status} {err}");
    let none = COLUMN.replace("combinations", "combination");
    std::fs::write(folder.path().join("column.ron"), none).unwrap();
    let (status, _, err) = run("both");
    assert!(status == 2 && err.contains("`combinations`"), "{err}");
    let cut = COLUMN.find("combinations").unwrap()..COLUMN.find("outputs").unwrap();
    let mut none = COLUMN.to_owned();
    none.replace_range(cut, "");
    std::fs::write(folder.path().join("column.ron"), none).unwrap();
    let (status, _, err) = run("both");
    assert!(status == 2 && err.contains("the model has no combination"), "{err}");
}

/// Where a body lies is no extreme of what it does, and no factor makes it one.
#[test]
fn a_body_that_overturns_ends_a_combination() {
    let models = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/rocking_body.ron");
    let text = std::fs::read_to_string(models).unwrap();
    let combined = text.replace(
        "outputs: {",
        "combinations: { \"c\": Envelope(cases: [\"pulse\"]) },\n    outputs: {",
    );
    let folder = folder(&combined);
    let run = |ah: &str| trilith(folder.path(), &["combine", "column.ron", "--set", ah]);
    let (status, out, err) = run("ah=1.2");
    assert!(status == 1 && out.is_empty(), "{out}");
    assert!(err.contains("case \"pulse\"") && err.contains("overturned at t ="), "{err}");
    assert_eq!(run("ah=0.35").0, 0);
}

#[test]
fn what_is_added_twice_is_said() {
    let text = COLUMN
        .replace(r#""right": Dynamic("#, r#""right": Dynamic(after: "wind", "#)
        .replace(r#"Srss(cases: ["left", "right"])"#, r#"LinearAdd(cases: ["strength", "right"])"#);
    let folder = folder(&text);
    let run = |of: &str| trilith(folder.path(), &["combine", "column.ron", "--of", of]).1;
    assert!(run("both").contains("warning: it adds \"wind\" and \"right\", which continues it"));
    // An envelope takes either, and these have no case in common.
    assert!(!run("shaken,design,sizes").contains("warning"));
}

//! Choices, flags and texts of a card from parameters of the model: by `--set`, and along an axis of a study.

use std::process::Command;
use trilith::{Model, Registry};

/// A direction of a gearing, an axis of a spring, and whether an `NLink` may pull.
const MODEL: &str = r#"(
    parameters: { "which": Text("Uz"), "along": Text("U1"), "pulls": true },
    nodes: { "a": (0, 0, 0), "b": (1, 0, 0) },
    elements: {
        "block": Mass(node: "a", mass: 100, inertia: (1, 1, 1)),
        "first": Spring(node: "a", k1: "10 kN/m", k2: "10 kN/m", k3: "10 kN/m", r1: 1, r2: 1, r3: 1),
        "second": Spring(node: "b", k1: "2 kN/m", k2: "2 kN/m", k3: "2 kN/m", r1: 1, r2: 1, r3: 1),
        "gears": Gearing(nodes: ("a", "b"), dof: "which", ratio: -3),
        "extra": CubicSpring(node: "a", k1: "1 kN/m", axis: Parameter("along")),
        "foot": NLink(node: "a", kn: 1e3, ks: 1e3, mu: 0, damping: 1, pull: "pulls"),
    },
    loads: { "push": [(node: "a", dof: Uz, force: "-1 kN")] },
    functions: { "on": Constant(value: 1) },
    cases: { "push": Dynamic(duration: 0.1, dt: 0.01, forces: [(load: "push", function: "on")]) },
    outputs: { "a": Displacement(node: "a", dof: Uz), "b": Displacement(node: "b", dof: Uz) },
)"#;

fn kinds() -> Registry {
    let mut kinds = trilith::registry();
    trilith_thirdparty_example::register(&mut kinds);
    kinds
}

fn read(set: &[(&str, &str)]) -> Result<Model, String> {
    let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    let told = |d: &trilith::model::Diagnostic| {
        let at = &d.source.text[d.span.clone()];
        format!("[{at}] {}: {}", d.message, d.help.as_deref().unwrap_or(""))
    };
    trilith::read_text(MODEL, "choices.ron", &kinds(), &set)
        .map_err(|all| all.iter().map(told).collect::<Vec<_>>().join("\n"))
}

/// The value of a parameter of an element, as the model is written out.
fn value(model: &Model, element: &str, parameter: &str) -> String {
    let e = model.elements.iter().find(|e| e.name == element).expect("an element");
    format!("{:?}", e.values.get(parameter).expect("a value"))
}

#[test]
fn parameters_choose() {
    let (before, after) = (
        read(&[]).unwrap(),
        read(&[("which", "Ux"), ("along", "U3"), ("pulls", "false")]).unwrap(),
    );
    assert_eq!(value(&before, "gears", "dof"), "Text(\"Uz\")");
    assert_eq!(value(&after, "gears", "dof"), "Text(\"Ux\")");
    assert_eq!(value(&before, "extra", "axis"), "Text(\"U1\")");
    assert_eq!(value(&after, "extra", "axis"), "Text(\"U3\")");
    assert_eq!(value(&before, "foot", "pull"), "Flag(true)");
    assert_eq!(value(&after, "foot", "pull"), "Flag(false)");
    assert_eq!(value(&read(&[("pulls", "0")]).unwrap(), "foot", "pull"), "Flag(false)");
}

#[test]
fn a_wrong_choice_names_those_that_there_are() {
    let told = |set: (&str, &str)| read(&[set]).expect_err("an error");
    let text = told(("which", "Uy2"));
    assert!(
        text.starts_with("[\"which\"] there is no dof `Uy2`, as parameter `which` says: "),
        "{text}"
    );
    assert!(text.ends_with(": did you mean `Uy`?"), "{text}");
    let text = told(("along", "R1"));
    assert!(text.starts_with("[Parameter] "), "{text}");
    assert!(text.contains("there is no axis `R1`, as parameter `along` says: "), "{text}");
    assert!(text.contains("U1"), "{text}");
    let text = told(("pulls", "perhaps"));
    assert!(text.starts_with("[perhaps] there is no parameter `perhaps`"), "{text}");
    let text = told(("pulls", "2"));
    assert!(text.contains("`pull` = 2: must be true or false"), "{text}");
}

#[test]
fn a_study_varies_them() {
    let folder = std::env::temp_dir().join(format!("trilith-choices-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let study = r#"(
        model: "model.ron",
        axes: { "which": ["Ux", "Uz"], "pulls": [true, false] },
        columns: { "a": Peak("a"), "b": Peak("b") },
    )"#;
    std::fs::write(folder.join("model.ron"), MODEL).expect("written");
    std::fs::write(folder.join("study.ron"), study).expect("written");
    let sweep = |study: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_trilith-thirdparty-example"));
        let done = command.current_dir(&folder).args(["sweep", study, "--out", "out"]).output();
        let done = done.expect("the program");
        let text = [done.stdout, done.stderr].map(|t| String::from_utf8_lossy(&t).into_owned());
        (done.status.success(), text.concat())
    };
    let (good, text) = sweep("study.ron");
    assert!(good, "{text}");
    let table = std::fs::read_to_string(folder.join("out/table.csv")).expect("a table");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    println!("{text}{table}");
    let [which, b] = ["which", "b"].map(|name| {
        rows[0].iter().position(|head| head.trim_matches('"').starts_with(name)).expect(&table)
    });
    for row in &rows[1..] {
        let moves: f64 = row[b].parse().expect(&table);
        assert_eq!(row[which] == "Uz", moves != 0.0, "{table}");
    }
    assert_eq!(rows.len(), 5);
    let page = std::fs::read_to_string(folder.join("out/study.html")).expect("a page");
    assert!(page.contains("Ux") && page.contains("Uz"));
    std::fs::write(folder.join("wrong.ron"), study.replace("\"Uz\"]", "\"Uzz\"]"))
        .expect("written");
    let (good, text) = sweep("wrong.ron");
    assert!(!good && text.contains("there is no dof `Uzz`"), "{text}");
    let _ = std::fs::remove_dir_all(&folder);
}

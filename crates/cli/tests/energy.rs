//! The table of energies as a user sees it: on the screen, on the page, in `summary.json`.

use assert_cmd::Command;

/// Let go from a displacement that holds ½ · 1 kN/m · (0.1 m)² = 5 J, with next to no velocity.
const MODEL: &str = r#"(
    nodes: { "a": (0, 0, 0) },
    supports: { "a": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "a", mass: "10 kg"),
        "spring": Spring(node: "a", k2: "1 kN/m", c2: "2 N*s/m"),
    },
    cases: {
        "free": Dynamic(
            duration: "0.4 s", dt: "2 ms",
            initial: [(node: "a", dof: Ux, displacement: "0.1 m", velocity: "1 cm/s")],
        ),
    },
    outputs: { "u": Displacement(node: "a", dof: Ux) },
)"#;

#[test]
fn shares_are_of_what_was_there_at_the_start_and_of_the_input() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("free.ron"), MODEL).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    let output = command.current_dir(folder.path()).args(["run", "free.ron"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let row = |name: &str| -> Vec<String> {
        let line = text.lines().map(str::trim).find(|l| l.starts_with(name));
        let rest = &line.unwrap_or_else(|| panic!("{name} in\n{text}"))[name.len()..];
        rest.split_whitespace().map(str::to_owned).collect()
    };
    assert!(text.contains("of start + input"), "{text}");
    assert_eq!(row("at the start: kinetic"), ["0.00050000", "0.01", "%"]);
    assert_eq!(row("at the start: strain"), ["5.0000", "99.99", "%"]);
    assert_eq!(row("input"), ["0", "0.00", "%"]);
    let shares = ["kinetic", "strain", "structural damping"].map(|name| -> f64 {
        let row = row(name);
        row[1].parse().unwrap_or_else(|_| panic!("{row:?}"))
    });
    assert!(shares.iter().all(|s| (0.0..=100.0).contains(s)), "{text}");
    assert!((shares.iter().sum::<f64>() - 100.0).abs() < 0.05, "{text}");

    let out = folder.path().join("out/free");
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("at the start: strain") && page.contains("of start + input"));
    let json = std::fs::read_to_string(out.join("summary.json")).unwrap();
    let start = json.find("\"start\"").map(|at| &json[at..]).unwrap();
    assert!(start.contains("\"kinetic\"") && start.contains("\"strain\""), "{json}");
}

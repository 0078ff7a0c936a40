//! Absurd input from outside: it is refused in words, at once, and nothing is allocated for it.

use assert_cmd::Command;
use std::path::Path;
use std::time::Duration;

/// A mass on springs and a stop; `{cases}` are to be put in.
const MODEL: &str = r#"(
    parameters: { "k": "1 kN/m" },
    nodes: { "a": (0, 0, 0) },
    elements: {
        "mass": Mass(node: "a", mass: "1 t"),
        "spring": Spring(node: "a", k1: "k", k2: "1 kN/m", k3: "1 kN/m"),
        "stop": Gap(node: "a", k: "1 kN/m", opening: "1 cm"),
    },
    cases: { {cases} },
    outputs: { "fall": Displacement(node: "a", dof: Uz) },
)"#;

const SHORT: &str = r#""shake": Dynamic(duration: 1, dt: 0.1)"#;

/// A folder with `model.ron` and `study.ron`.
fn folder(cases: &str, study: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.ron"), MODEL.replace("{cases}", cases)).unwrap();
    std::fs::write(folder.path().join("study.ron"), format!("(model: \"model.ron\", {study})"))
        .unwrap();
    folder
}

/// Exit status, stdout, stderr; a program that a signal has ended has no status.
fn trilith(folder: &Path, args: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    command.timeout(Duration::from_secs(60));
    let output = command.current_dir(folder).args(args).output().unwrap();
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[track_caller]
fn refused(folder: &Path, args: &[&str], parts: &[&str]) {
    let (status, out, err) = trilith(folder, args);
    assert_eq!((status, out.as_str()), (Some(2), ""), "{args:?}\n{err}");
    for part in parts {
        assert!(err.contains(part), "{part} in\n{err}");
    }
}

#[track_caller]
fn done(folder: &Path, args: &[&str]) -> (String, String) {
    let (status, out, err) = trilith(folder, args);
    assert_eq!(status, Some(0), "{args:?}\n{out}{err}");
    (out, err)
}

/// A rigid lever: its end `at` metres away with a mass in kg.
fn lever(kind: &str, at: &str, mass: &str) -> String {
    format!(
        r#"(
    nodes: {{ "a": (0, 0, 0), "b": ({at}, 0, 0) }},
    supports: {{ "a": (Ux, Uz, Rx, Rz) }},
    elements: {{
        "mass": Mass(node: "b", mass: {mass}),
        "rigid": {kind}(nodes: ("a", "b")),
        "spring": Spring(node: "b", k1: "1 MN/m", k2: "1 MN/m", k3: "1 MN/m"),
    }},
    cases: {{ "gravity": Static(loads: [Gravity]) }},
)"#
    )
}

#[test]
fn a_lever_that_overflows_is_shown_where_it_stands() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for kind in ["RigidLink", "RigidBody"] {
        std::fs::write(here.join("far.ron"), lever(kind, "1e200", "\"1 t\"")).unwrap();
        std::fs::write(here.join("heavy.ron"), lever(kind, "1e11", "1e290")).unwrap();
        std::fs::write(here.join("good.ron"), lever(kind, "10", "\"1 t\"")).unwrap();
        for command in ["check", "run", "modes"] {
            let far = ["error[E0112]", "far.ron:2:36", "1e200 m", "check its unit"];
            refused(here, &[command, "far.ron"], &far);
            let heavy = ["heavy.ron:2:15", "the mass of node \"a\" Ry is beyond all bounds"];
            refused(here, &[command, "heavy.ron"], &heavy);
        }
        done(here, &["check", "good.ron"]);
        done(here, &["run", "good.ron", "--no-files"]);
    }
}

#[test]
fn a_chain_of_hundreds_of_cases_runs_to_its_end() {
    let mut cases = String::from("\"c0\": Static(loads: [Gravity]),\n");
    for i in 1..400 {
        cases += &format!("\"c{i}\": Static(loads: [], after: \"c{}\"),\n", i - 1);
    }
    cases += r#""shake": Dynamic(after: "c399", duration: 1, dt: 0.1)"#;
    let folder = folder(&cases, r#"axes: { "k": ["1 kN/m", "2 kN/m", "3 kN/m"] }"#);
    done(folder.path(), &["check", "model.ron"]);
    let (out, _) = done(folder.path(), &["run", "model.ron", "--no-files"]);
    assert!(out.contains("converged"), "{out}");
    // The weight of the first case is carried through all others, on spring and stop: (m g + k 1 cm)/(2 k).
    let fall = out.lines().find(|l| l.contains("fall")).unwrap();
    assert!(fall.contains("-4.9083"), "{fall}");
    let (out, _) = done(folder.path(), &["sweep", "study.ron", "--threads", "2"]);
    assert!(out.contains("new runs: 3"), "{out}");
}

#[test]
fn studies_of_absurd_size_are_refused_before_anything_is_made() {
    let drawn = r#"of: { "k": Uniform(from: "1 kN/m", to: "2 kN/m") }"#;
    for (study, name) in [
        (format!("samples: Random(count: 1e9, {drawn})"), "`count`"),
        (format!("samples: LatinHypercube(count: 1e9, {drawn})"), "`count`"),
        (format!("samples: Random(count: 1e18, {drawn})"), "`count`"),
        ("ensemble: (members: 1000000000, of: { \"k\": 0.1 })".to_owned(), "`members`"),
        ("ensemble: (members: 1000001, of: { \"k\": 0.1 })".to_owned(), "`members`"),
    ] {
        let folder = folder(SHORT, &study);
        let parts = ["error[E0112]", "study.ron:1:", name, "at most 1000000"];
        refused(folder.path(), &["sweep", "study.ron", "--dry-run"], &parts);
        refused(folder.path(), &["sweep", "study.ron"], &parts);
    }
}

#[test]
fn frames_of_absurd_size_are_not_generated() {
    let folder = tempfile::tempdir().unwrap();
    for (args, part) in [
        (&["--duration", "1e18"][..], "too long: at most 1000000"),
        (&["--duration", "1e308", "--dt", "1e-300"], "too long"),
        (&["--dt", "1e-12"], "too long"),
        (&["--dt", "1000"], "must be at most the duration"),
        (&["--vectors", "18446744073709551615"], "a frame of 36 nodes has 216 directions"),
        (&["--bay", "1e200"], "the length along X comes out as 2e200 m"),
        (&["--storey", "1e200"], "the height comes out as"),
        (&["--radius", "1e-300"], "the stiffness of a pendulum"),
        (&["--bays", "100000000000,1"], "too large"),
        (&["--cuts", "18446744073709551615"], "too large"),
    ] {
        let all = [&["generate", "frame", "--out", "frame.ron"], args].concat();
        refused(folder.path(), &all, &[part]);
        assert!(!folder.path().join("frame.ron").exists());
    }
}

#[test]
fn thousands_of_errors_are_told_shortly() {
    let folder = tempfile::tempdir().unwrap();
    let unknown: Vec<String> = (0..5000).map(|i| format!("\"p{i}\": \"2*q{i}\"")).collect();
    let text = MODEL.replace("{cases}", SHORT).replace("\"k\": \"1 kN/m\"", &unknown.join(",\n"));
    std::fs::write(folder.path().join("model.ron"), text).unwrap();
    let parts = ["there is no parameter `q0`", "did you mean", "\n… and ", " more\n"];
    refused(folder.path(), &["check", "model.ron"], &parts);
    let (_, _, err) = trilith(folder.path(), &["check", "model.ron"]);
    assert!(err.matches("error[").count() == 50 && err.len() < 50_000, "{}", err.len());
}

#[test]
fn cases_of_too_many_steps_are_refused_and_long_ones_told() {
    let study = r#"axes: { "k": ["1 kN/m"] }"#;
    let at = folder(r#""shake": Dynamic(duration: 1e9, dt: "1 ms")"#, study);
    let parts = ["error[E0112]", "model.ron:9:", "1.000e12 output steps", "at least 20 s"];
    for args in [&["check", "model.ron"][..], &["run", "model.ron"], &["sweep", "study.ron"]] {
        refused(at.path(), args, &parts);
    }
    let at = folder(SHORT, study);
    let parts = ["model.ron:9:", "case \"shake\" has 1.000e9 output steps", "`--dt`"];
    refused(at.path(), &["run", "model.ron", "--dt", "1e-9", "--no-files"], &parts);
    let (_, err) = done(at.path(), &["check", "model.ron"]);
    assert_eq!(err, "");
    let at = folder(r#""shake": Dynamic(duration: 10000, dt: 0.01)"#, study);
    let (_, err) = done(at.path(), &["check", "model.ron"]);
    assert!(err.contains("warning") && err.contains("1000000 output steps"), "{err}");
    assert!(err.contains("96 MB") && err.contains("336 MB"), "{err}");
}

#[test]
fn brackets_nested_too_deeply_are_told_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let nested = format!("{}1{}", "[".repeat(3000), "]".repeat(3000));
    let model = MODEL.replace("{cases}", SHORT).replace("\"1 t\"", &nested);
    std::fs::write(folder.path().join("model.ron"), model).unwrap();
    std::fs::write(folder.path().join("study.ron"), &nested).unwrap();
    for (args, place) in
        [(["check", "model.ron"], "model.ron:5:"), (["sweep", "study.ron"], "study.ron:1:")]
    {
        refused(folder.path(), &args, &["error[E0101]", place, "nested too deeply"]);
        let (_, _, err) = trilith(folder.path(), &args);
        assert!(!err.contains("recursion") && !err.contains("serde"), "{err}");
    }
}

//! Ctrl-C and SIGTERM keep what there is.
#![cfg(unix)]

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

fn trilith(arguments: &[&str], folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    command.args(arguments).current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Waits until a file has some bytes or a folder is there.
fn wait_for(there: impl Fn() -> bool) {
    for _ in 0..600 {
        if there() {
            return;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    panic!("nothing came");
}

fn signalled(child: Child, signal: &str) -> Output {
    let id = child.id().to_string();
    assert!(Command::new("kill").args([signal, &id]).status().unwrap().success());
    child.wait_with_output().unwrap()
}

fn block() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.join("models/rigid_block.ron").to_string_lossy().into_owned()
}

/// Far longer than anybody waits.
const LONG: &str = "duration=2000 s";

#[test]
fn an_interrupted_run_keeps_what_there_is_and_goes_on() {
    for signal in ["-INT", "-TERM"] {
        let folder = tempfile::tempdir().unwrap();
        let block = block();
        let common = ["run", &block, "--no-report", "--set", LONG];
        let child =
            trilith(&[&common[..], &["--out", "a"]].concat(), folder.path()).spawn().unwrap();
        // The place of the results is taken before the run.
        wait_for(|| std::fs::read_dir(folder.path()).unwrap().next().is_some());
        std::thread::sleep(Duration::from_millis(1000));
        let output = signalled(child, signal);
        let (said, found) = (
            String::from_utf8_lossy(&output.stderr).into_owned(),
            String::from_utf8_lossy(&output.stdout).into_owned(),
        );
        assert_eq!(output.status.code(), Some(130), "{said}{found}");
        assert!(said.contains("ends at the next output step"), "{said}");
        assert!(said.contains("interrupted at t = "), "{said}");
        assert!(found.contains("interrupted") && found.contains("--restart"), "{found}");
        let summary = |of: &str| -> serde_json::Value {
            let text = std::fs::read(folder.path().join(of).join("summary.json")).unwrap();
            serde_json::from_slice(&text).unwrap()
        };
        let steps = summary("a")["work"]["steps"].as_u64().unwrap();
        assert_eq!(summary("a")["status"], "interrupted");
        assert!(steps > 0);
        let checkpoint = folder.path().join("a/checkpoint.json");
        let text = std::fs::read_to_string(&checkpoint).unwrap();
        let time: f64 = {
            let value: serde_json::Value = serde_json::from_str(&text).unwrap();
            let at = |v: &serde_json::Value| v.get("time").and_then(serde_json::Value::as_f64);
            at(&value).or_else(|| value.get("state").and_then(at)).expect("a time")
        };
        // It goes on from there, and is where a run without interruption is.
        let until = format!("{}", time + 0.5);
        let restart = checkpoint.to_string_lossy().into_owned();
        let on = ["--checkpoint-at", &until, "--out", "b", "--restart", &restart];
        let output = trilith(&[&common[..], &on].concat(), folder.path()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let whole = ["--checkpoint-at", &until, "--out", "c"];
        let output = trilith(&[&common[..], &whole].concat(), folder.path()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        // But for what the steps make of it, which a run that goes on knows of its own part.
        let peaks = |of: &str| {
            let mut outputs = summary(of)["outputs"].clone();
            for (_, output) in outputs.as_object_mut().unwrap() {
                output.as_object_mut().unwrap().remove("error");
            }
            outputs
        };
        assert_eq!(peaks("b"), peaks("c"));
    }
}

#[test]
fn an_interrupted_study_says_how_it_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let study = format!(
        "(title: \"Long\", model: {:?}, set: {{ \"duration\": \"60 s\" }}, axes: {{ \"mu\": Range(from: 0.2, to: 0.8, count: 400) }})",
        block()
    );
    std::fs::write(folder.path().join("long.ron"), study).unwrap();
    let arguments = ["sweep", "long.ron", "--out", "s"];
    let child = trilith(&arguments, folder.path()).spawn().unwrap();
    let journal = folder.path().join("s/runs.journal");
    wait_for(|| std::fs::metadata(&journal).is_ok_and(|m| m.len() > 0));
    let output = signalled(child, "-INT");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(said.contains("of 400 runs are kept in s") && said.contains("goes on"), "{said}");
}

/// Of the case that the command is for there is nothing yet.
#[test]
fn an_interrupt_in_the_case_before_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let text = r#"(
        nodes: { "a": (0.0, 0.0, 0.0) },
        supports: { "a": (Uy, Uz, Rx, Ry, Rz) },
        elements: {
            "spring": Spring(node: "a", k1: 1000.0),
            "mass": Mass(node: "a", mass: 1.0),
            "stop": Gap(node: "a", k: 1e5, opening: 0.001),
        },
        functions: { "shake": Sine(amplitude: "1 m/s^2", frequency: 3.0) },
        cases: {
            "first": Dynamic(duration: 90000.0, dt: 0.01, base: [(direction: X, function: "shake")]),
            "second": Dynamic(after: "first", duration: 1.0, dt: 0.01),
        },
        outputs: { "u": Displacement(node: "a", dof: Ux) },
    )"#;
    std::fs::write(folder.path().join("two.ron"), text).unwrap();
    let child = trilith(&["run", "two.ron", "--no-report", "--out", "a"], folder.path());
    let child = { child }.spawn().unwrap();
    wait_for(|| std::fs::read_dir(folder.path()).unwrap().count() > 1);
    std::thread::sleep(Duration::from_millis(1000));
    let output = signalled(child, "-INT");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(130), "{said}");
    assert!(said.contains("of case \"first\", which is continued"), "{said}");
}

#[test]
fn an_interrupted_comparison_shows_the_runs_that_are_done() {
    let folder = tempfile::tempdir().unwrap();
    let block = block();
    // The second step makes minutes of a run of a second.
    let arguments = ["compare", &block, "--no-cause", "--dts", "0.01,0.00001", "--set"];
    let child = trilith(&[&arguments[..], &["duration=200 s"]].concat(), folder.path()).spawn();
    std::thread::sleep(Duration::from_secs(3));
    let output = signalled(child.unwrap(), "-TERM");
    let (said, found) =
        (String::from_utf8_lossy(&output.stderr), String::from_utf8_lossy(&output.stdout));
    assert_eq!(output.status.code(), Some(130), "{said}{found}");
    assert!(said.contains("interrupted: 1 of 2 runs came to their end"), "{said}");
    assert!(found.contains("peaks") && found.contains("(converged)"), "{found}");
}

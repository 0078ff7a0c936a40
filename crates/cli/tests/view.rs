//! `trilith view` by the command: what the page carries, and what is refused.

use assert_cmd::Command;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// First bytes of a WebAssembly module, which is all that the program looks at.
const ENGINE: &[u8] = b"\0asm\x01\0\0\0";

fn models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models")
}

/// Status, stdout, stderr of the program in a folder with an engine and a file that is none.
fn view(arguments: &[&str]) -> (TempDir, Option<i32>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("engine.wasm"), ENGINE).unwrap();
    std::fs::write(folder.path().join("none.wasm"), "no engine").unwrap();
    let mut command = Command::cargo_bin("trilith").unwrap();
    let done = command.current_dir(folder.path()).arg("view").args(arguments).output().unwrap();
    let [out, told] = [done.stdout, done.stderr].map(|text| String::from_utf8(text).unwrap());
    (folder, done.status.code(), out, told)
}

#[test]
fn a_page_carries_the_model_its_records_and_the_engine() {
    let model = models().join("rigid_block_record.ron");
    let model = model.to_str().unwrap();
    let (folder, status, out, told) = view(&[model, "--engine", "engine.wasm", "--set", "mu=0.3"]);
    assert_eq!((status, &*out), (Some(0), "page: rigid_block_record.html\n"), "{told}");
    let page = std::fs::read_to_string(folder.path().join("rigid_block_record.html")).unwrap();
    for part in ["synthetic_040g.csv", "\"mu\"", "0.3"] {
        assert!(page.contains(part), "no {part} in it");
    }
    // Nothing is asked of a network.
    assert!(!page.contains("src=\"http") && !page.contains("href=\"http"));
}

/// A study of four runs.
const STUDY: &str = r#"(
    title: "Four blocks",
    model: "rigid_block.ron",
    set: { "duration": "0.1 s" },
    axes: { "mu": [0.2, 0.8], "ah": [0.3, 0.9] },
    columns: { "slip": Slip },
    figures: [Points(x: "mu", y: "ah")],
)"#;

#[test]
fn a_study_becomes_a_page_with_its_charts_and_makes_the_runs_that_are_not_there() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::copy(models().join("rigid_block.ron"), here.join("rigid_block.ron")).unwrap();
    std::fs::write(here.join("four.ron"), STUDY).unwrap();
    std::fs::write(here.join("bare.ron"), STUDY.replace("Points(x: \"mu\", y: \"ah\")", ""))
        .unwrap();
    std::fs::write(here.join("engine.wasm"), ENGINE).unwrap();
    let view = |arguments: &[&str]| {
        let mut command = Command::cargo_bin("trilith").unwrap();
        command.current_dir(here).arg("view").args(["--engine", "engine.wasm"]).args(arguments);
        let done = command.output().unwrap();
        (done.status.code(), String::from_utf8(done.stderr).unwrap())
    };
    let (status, told) = view(&["four.ron", "--set", "cv=0", "--runs", "runs"]);
    assert_eq!(status, Some(0), "{told}");
    assert!(here.join("runs/table.csv").is_file());
    let page = std::fs::read_to_string(here.join("four.html")).unwrap();
    // What all runs set is there once, and so are the names of what one sets; values stand in the cells of its row.
    for part in [
        r#"["duration","0.1 s"]"#,
        r#"["cv","0"]"#,
        r#""names":["mu","ah"]"#,
        r#"{"at":[0,0,1,1],"of":["0.2","0.8"]},{"at":[0,1,0,1],"of":["0.3","0.9"]}"#,
        r#""settings":[["mu",""],["ah",""]]"#,
        "Four blocks",
    ] {
        assert!(page.contains(part), "no {part} in it");
    }
    assert!(!page.contains("src=\"http") && !page.contains("href=\"http"));
    for (arguments, words) in [
        (&["bare.ron"][..], "no figures to ask"),
        (&["four.ron", "--case", "pulse"], "a case of its own"),
        (&["rigid_block.ron", "--runs", "runs"], "no runs of a model"),
        (&["four.ron", "--set", "nu=1"], "nu"),
    ] {
        let (status, told) = view(arguments);
        assert!(status == Some(2) && told.contains(words), "{arguments:?}: {told}");
    }
}

#[test]
fn what_cannot_be_a_page_is_refused() {
    let model = models().join("rigid_block.ron");
    let model = model.to_str().unwrap();
    for (arguments, words) in [
        (&[model, "--engine", "none.wasm"][..], "none.wasm is no WebAssembly module"),
        (&[model, "--engine", "gone.wasm"], "gone.wasm cannot be read"),
        (&[model, "--engine", "engine.wasm", "--case", "fall"], "there is no case \"fall\""),
        (&[model, "--engine", "engine.wasm", "--set", "nu=1"], "nu"),
        (&[model, "--engine", "engine.wasm", "--out", "gone/x.html"], "gone/x.html"),
        (&["gone.ron", "--engine", "engine.wasm"], "gone.ron"),
    ] {
        let (_folder, status, out, told) = view(arguments);
        assert_eq!((status, &*out), (Some(2), ""), "{arguments:?}: {told}");
        assert!(told.contains(words), "{arguments:?}: {told}");
    }
}

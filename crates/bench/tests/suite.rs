//! That the suite runs and says what it promises. No time is asserted.

use serde_json::Value;
use std::process::{Command, Output};

fn benchmark(target: &std::path::Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_benchmark"))
        .env("CARGO_TARGET_DIR", target)
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn the_smallest_frame_gives_a_table_a_page_and_numbers() {
    let target = tempfile::tempdir().unwrap();
    let run = benchmark(target.path(), &["P1e2", "--steps", "300"]);
    let text = String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success(), "{text}{}", String::from_utf8_lossy(&run.stderr));
    for word in
        ["P1e2", "FNA", "HHT", "step µs", "set-up ms", "memory MB", "iterations", "isolator error"]
    {
        assert!(text.contains(word), "{word} in {text}");
    }
    let folder = target.path().join("benchmark");
    let page = std::fs::read_to_string(folder.join("report.html")).unwrap();
    assert!(page.contains("<svg") && page.contains("What a run costs"));
    let json = std::fs::read_to_string(folder.join("results.json")).unwrap();
    let json: Value = serde_json::from_str(&json).unwrap();
    let frames = json["frames"].as_array().unwrap();
    assert_eq!(frames.len(), 2);
    for frame in frames {
        for key in [
            "parse_s",
            "assembly_s",
            "factor_s",
            "setup_s",
            "step_s",
            "bare_step_s",
            "whole_s",
            "iterations",
            "isolator",
            "roof",
        ] {
            let value = frame[key].as_f64().unwrap_or_else(|| panic!("{key} in {frame}"));
            assert!(value.is_finite() && value > 0.0, "{key} = {value}");
        }
        assert_eq!((frame["steps"].as_u64(), frame["unconverged"].as_u64()), (Some(300), Some(0)));
        assert_eq!(frame["dof"], 96);
    }
    assert_eq!((&frames[0]["vectors"], &frames[1]["vectors"]), (&24.into(), &0.into()));
}

#[test]
fn the_whole_motion_gives_the_peaks_of_another_program() {
    let target = tempfile::tempdir().unwrap();
    let run = benchmark(target.path(), &["P1e2"]);
    let text = String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success() && text.matches(" pass").count() == 2, "{text}");
    // Too few vectors do not, and the suite says so.
    let run = benchmark(target.path(), &["P1e2", "--solvers", "fna", "--vectors", "4"]);
    assert!(String::from_utf8_lossy(&run.stdout).contains("FAIL"));
    assert_eq!(run.status.code(), Some(1));
}

#[test]
fn memory_of_a_long_run_is_reported() {
    let target = tempfile::tempdir().unwrap();
    let run = benchmark(target.path(), &["long", "P1e2", "--solver", "fna", "--steps", "20000"]);
    let json: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(
        (json["steps"].as_u64(), json["status"].as_str()),
        (Some(20_000), Some("converged"))
    );
    assert!(json["memory"].as_array().unwrap().len() >= 100 && json["growth_mb"].is_number());
}

#[test]
fn a_frame_that_is_none_is_refused() {
    let target = tempfile::tempdir().unwrap();
    let run = benchmark(target.path(), &["P1e9"]);
    assert_eq!(run.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&run.stderr).contains("P1e2, P1e3"));
}

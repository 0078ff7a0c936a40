//! Pages in a browser: where that is asked for, and nowhere else.
#![cfg(target_os = "linux")]

use assert_cmd::Command;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::time::{Duration, Instant};

const MODEL: &str = r#"(
    title: "Oscillator",
    plane: XZ,
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uz, Ry) },
    elements: {
        "mass": Mass(node: "m", mass: "100 kg"),
        "spring": Spring(node: "m", k2: "4 kN/m"),
    },
    cases: { "swing": Dynamic(
        duration: "1 s", dt: "10 ms", initial: [(node: "m", dof: Ux, velocity: "1 m/s")],
    ) },
    outputs: { "sway": Displacement(node: "m", dof: Ux) },
)"#;

/// Runs the program where what opens pages only writes down which.
fn run(folder: &Path, args: &[&str]) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    let path = format!("{}:/usr/bin:/bin", folder.join("bin").display());
    command.current_dir(folder).env("PATH", path).args(args).assert().success();
}

#[test]
fn a_page_is_opened_where_that_is_asked_for_alone() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::create_dir(folder.join("bin")).unwrap();
    let opener = folder.join("bin/xdg-open");
    let opened = folder.join("opened");
    let script = format!("#!/bin/sh\necho \"$1\" >> '{}'\n", opened.display());
    std::fs::write(&opener, script).unwrap();
    std::fs::set_permissions(&opener, std::fs::Permissions::from_mode(0o755)).unwrap();
    std::fs::write(folder.join("a.ron"), MODEL).unwrap();
    let study = r#"(title: "A", model: "a.ron", columns: { "sway": Max("sway") })"#;
    std::fs::write(folder.join("study.ron"), study).unwrap();
    run(folder, &["run", "a.ron", "--out", "quiet"]);
    run(folder, &["sweep", "study.ron", "--out", "swept"]);
    run(folder, &["run", "a.ron", "--out", "shown", "--open"]);
    let begin = Instant::now();
    while !opened.exists() {
        assert!(begin.elapsed() < Duration::from_secs(30), "nothing was opened");
        std::thread::sleep(Duration::from_millis(20));
    }
    // What would be opened beside it has had its time as well.
    std::thread::sleep(Duration::from_millis(500));
    let all = std::fs::read_to_string(&opened).unwrap();
    let all: Vec<&str> = all.lines().collect();
    assert!(matches!(all[..], [one] if one.ends_with("shown/report.html")), "{all:?}");
}

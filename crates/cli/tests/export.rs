//! `trilith export` and `trilith compare --peer`.

use assert_cmd::Command;
use std::path::{Path, PathBuf};

fn trilith(arguments: &[&str], python: &str, status: i32) -> (String, String) {
    let mut program = Command::cargo_bin("trilith").unwrap();
    let run = program.env("TRILITH_OPENSEES", python).args(arguments).assert().code(status);
    let text = |b: &[u8]| String::from_utf8_lossy(b).into_owned();
    (text(&run.get_output().stdout), text(&run.get_output().stderr))
}

fn model(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models").join(name);
    path.to_str().unwrap().to_owned()
}

const NONE: &str = "no-such-python";

#[test]
fn a_script_is_printed_or_written_with_its_report() {
    let (script, said) =
        trilith(&["export", &model("rigid_block.ron"), "--to", "opensees"], NONE, 0);
    assert!(script.contains("import openseespy.opensees as ops"), "{script}");
    assert!(said.contains("written: 1 Mass, 1 Spring, 2 NLink, 1 RigidBody"), "{said}");
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new/block.py");
    let (told, _) = trilith(
        &["export", &model("rigid_block.ron"), "--to", "opensees", "--out", out.to_str().unwrap()],
        NONE,
        0,
    );
    assert!(told.contains("block.py"), "{told}");
    let written = std::fs::read_to_string(&out).unwrap();
    assert!(written.contains("OUTPUTS = \"block.csv\""), "{written}");
    let (_, said) = trilith(
        &[
            "export",
            &model("rigid_block.ron"),
            "--to",
            "opensees",
            "--out",
            &model("rigid_block.ron"),
        ],
        NONE,
        2,
    );
    assert!(said.contains("is what is read"), "{said}");
}

#[test]
fn what_has_no_counterpart_is_refused_and_left_out_or_near_on_request() {
    let frame = model("isolated_frame.ron");
    let (_, said) = trilith(&["export", &frame, "--to", "opensees"], NONE, 2);
    assert!(said.contains("NLink \"isolator a\"") && said.contains("`--near`"), "{said}");
    let (script, said) = trilith(&["export", &frame, "--to", "opensees", "--near"], NONE, 1);
    assert!(
        script.contains("singleFPBearing") && said.contains("NEAR: this changes results"),
        "{said}"
    );
    let pounding = model("pounding_frames.ron");
    let (script, said) =
        trilith(&["export", &pounding, "--to", "opensees", "--leave-out"], NONE, 1);
    assert!(said.contains("LEFT OUT: this changes results\n  Dashpot \"dashpot 1\""), "{said}");
    assert!(
        script.contains("Left out:\n  Dashpot 'dashpot 1'")
            && said.contains("output \"impact3_dashpot\""),
        "{said}"
    );
    let (_, said) = trilith(&["export", &model("rocking_body.ron"), "--to", "opensees"], NONE, 2);
    assert!(said.contains("RockingBody"), "{said}");
}

#[test]
fn without_opensees_a_comparison_says_what_to_install() {
    let (_, said) = trilith(&["compare", &model("rigid_block.ron"), "--peer", "opensees"], NONE, 2);
    assert!(said.contains("`no-such-python`") && said.contains("pip install openseespy"), "{said}");
}

#[cfg(unix)]
mod stand_ins {
    use super::*;
    use std::os::unix::fs::PermissionsExt;

    /// A shell that stands for an interpreter with openseespy; it answers whether it has it, and does this instead of a run.
    fn interpreter(folder: &Path, does: &str) -> PathBuf {
        let path = folder.join("python");
        std::fs::write(&path, format!("#!/bin/sh\n[ \"$1\" = -c ] && exit 0\n{does}\n")).unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
        path
    }

    const OSCILLATOR: &str = "(title: \"o\", nodes: { \"m\": (0, 0, 0) }, supports: { \"m\": (Uy, Uz, Rx, Ry, Rz) }, elements: { \
        \"mass\": Mass(node: \"m\", mass: 1000), \"k\": Spring(node: \"m\", axis1: (1, 0, 0), k1: 39478.4176) }, \
        cases: { \"run\": Dynamic(duration: 1, dt: 0.5, solver: Hht, initial: [(node: \"m\", dof: Ux, displacement: 0.1)]) }, \
        outputs: { \"x\": Displacement(node: \"m\", dof: Ux) })";

    #[test]
    fn peaks_and_periods_of_both_are_printed() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("o.ron");
        std::fs::write(&file, OSCILLATOR).unwrap();
        let does = "printf 't,x\\n0,0.1\\n0.5,-0.1\\n1,0.1\\n' > model.csv\n\
                    printf 'output,max,t,min,t,final\\nx,0.11,0,-0.1,0.5,0.1\\n' > model.peaks.csv\n\
                    printf 'mode,period\\n1,1.001\\n' > model.periods.csv";
        let python = interpreter(folder.path(), does);
        let (file, python) = (file.to_str().unwrap(), python.to_str().unwrap());
        let (told, _) = trilith(&["compare", file, "--peer", "opensees"], python, 0);
        let line = |of: &str, start: &str| {
            of.lines().find(|l| l.trim().starts_with(start)).unwrap_or_default().to_owned()
        };
        assert!(line(&told, "x ").contains("0.11000  +10.00 %"), "{told}");
        assert!(line(&told, "1 ").contains("1.000000  1.001000  +1.0e-3"), "{told}");
        let (told, _) = trilith(&["compare", file, "--peer", "opensees", "--json"], NONE, 2);
        assert!(told.is_empty(), "{told}");
        let (told, _) = trilith(
            &["compare", file, "--peer", "opensees", "--json", "--python", python],
            NONE,
            0,
        );
        let all: serde_json::Value = serde_json::from_str(&told).unwrap();
        assert_eq!(all["outputs"]["x"]["opensees"]["max"], 0.11);
        let apart = all["outputs"]["x"]["difference"]["max"].as_f64().unwrap();
        assert!((apart - 0.1).abs() < 1e-6, "{told}");
        assert_eq!(all["periods"]["opensees"][0], 1.001);
    }

    #[test]
    fn a_peer_that_fails_or_takes_too_long_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("o.ron");
        std::fs::write(&file, OSCILLATOR).unwrap();
        let file = file.to_str().unwrap();
        let python = interpreter(folder.path(), "echo no equilibrium behind t = 0.25 >&2; exit 1");
        let (_, said) =
            trilith(&["compare", file, "--peer", "opensees"], python.to_str().unwrap(), 1);
        assert!(
            said.contains("no equilibrium behind t = 0.25") && said.contains("`--substeps N`"),
            "{said}"
        );
        let python = interpreter(folder.path(), "exec sleep 60");
        let (_, said) = trilith(
            &["compare", file, "--peer", "opensees", "--time-limit", "0.2"],
            python.to_str().unwrap(),
            1,
        );
        assert!(said.contains("200ms") && said.contains("`--time-limit S`"), "{said}");
    }
}

/// Extremes of an output in a folder of results.
fn extremes(folder: &Path, output: &str) -> [f64; 2] {
    let text = std::fs::read_to_string(folder.join("summary.json")).unwrap();
    let all: serde_json::Value = serde_json::from_str(&text).unwrap();
    ["max", "min"].map(|end| all["outputs"][output][end].as_f64().unwrap())
}

/// There and back: the script is recorded by the package for Python, which stands where it looks for OpenSees, and imported.
#[test]
fn an_exported_block_comes_back_as_the_same_block() {
    if std::process::Command::new("python3").arg("--version").output().is_err() {
        eprintln!("there is no python3");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let text = |name: &str| at(name).to_str().unwrap().to_owned();
    let set = ["--set", "duration=0.8"];
    let (script, block) = (text("block.py"), model("rigid_block.ron"));
    let arguments = [&["export", &block, "--to", "opensees", "--out", &script][..], &set].concat();
    trilith(&arguments, NONE, 0);
    // What it records are results, which are not there.
    let written = std::fs::read_to_string(&script).unwrap();
    let recorded = written.replace("values = recorded(", "values = (lambda t: [])(");
    assert_ne!(written, recorded);
    std::fs::write(&script, recorded).unwrap();
    let recorder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../python/python/trilith/opensees.py");
    // The script writes where it is run.
    let done = std::process::Command::new("python3")
        .current_dir(folder.path())
        .arg("-B")
        .arg(recorder)
        .args([&script, "--out", &text("back.ron"), "--program"])
        .arg(assert_cmd::cargo::cargo_bin("trilith"))
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let back = std::fs::read_to_string(at("back.ron")).unwrap();
    let end = back.rfind(')').unwrap();
    let outputs = "    outputs: { \"slide\": Displacement(node: \"2\", dof: Ux), \
                   \"rotation\": Displacement(node: \"1\", dof: Ry, factor: -1) },\n)\n";
    std::fs::write(at("back.ron"), format!("{}{outputs}", &back[..end])).unwrap();
    let (there, here) = (text("there"), text("here"));
    let own =
        [&["run", &block, "--solver", "hht", "--no-report", "--out", &there][..], &set].concat();
    trilith(&own, NONE, 0);
    trilith(&["run", &text("back.ron"), "--no-report", "--out", &here], NONE, 0);
    for output in ["slide", "rotation"] {
        let (a, b) = (extremes(&at("there"), output), extremes(&at("here"), output));
        let size = a[0].abs().max(a[1].abs());
        assert!(size > 1e-3, "{output} is {a:?}");
        for (a, b) in a.iter().zip(&b) {
            assert!((a - b).abs() < 2e-3 * size, "{output}: {a} and {b}");
        }
    }
}

//! Laws of shared libraries in the program; where there is no C compiler, the tests say so and pass.

mod common;

use common::trilith;
use std::path::Path;
use std::process::Command;

const MODEL: &str = r#"(
    plane: XZ,
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uz, Ry) },
    elements: {
        "mass": Mass(node: "m", mass: "1 t"),
        "link": Yielding(node: "m", k: "100 kN/m", fy: "FY", c: "200 N*s/m", torn: "TORN", axis1: (1, 0, 0)),
    },
    cases: { "kick": Dynamic(duration: "0.2 s", dt: "5 ms", initial: [(node: "m", dof: Ux, velocity: "1 m/s")]) },
    outputs: { "x": Displacement(node: "m", dof: Ux) },
)"#;

/// The library of the law, and a model of it; nothing without a compiler.
fn prepared(folder: &Path) -> Option<()> {
    let foreign = Path::new(env!("CARGO_MANIFEST_DIR")).join("../foreign");
    let compiler = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
    let done = Command::new(&compiler)
        .args(["-shared", "-fPIC", "-o", "libyielding.so", "-I"])
        .arg(foreign.join("include"))
        .arg(foreign.join("tests/yielding.c"))
        .arg("-lm")
        .current_dir(folder)
        .output();
    let done = match done {
        Ok(done) => done,
        Err(e) => {
            eprintln!("skipped: there is no C compiler here ({}: {e})", compiler.display());
            return None;
        }
    };
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let model = |fy: &str, torn: &str| MODEL.replace("FY", fy).replace("TORN", torn);
    std::fs::write(folder.join("m.ron"), model("2 kN", "1 m")).unwrap();
    std::fs::write(folder.join("torn.ron"), model("2 kN", "50 mm")).unwrap();
    Some(())
}

#[test]
fn a_model_is_run_with_the_law_of_a_library() {
    let folder = tempfile::tempdir().unwrap();
    let Some(()) = prepared(folder.path()) else { return };
    let (status, out, err) =
        trilith(folder.path(), &["run", "m.ron", "--laws", "libyielding.so", "--no-report"]);
    assert_eq!(status, 0, "{out}{err}");
    let read =
        |file: &str| std::fs::read_to_string(folder.path().join("out/m").join(file)).unwrap();
    let summary = read("summary.json");
    assert!(summary.contains("\"status\": \"converged\""), "{summary}");
    let made_by = read("made_by.json");
    assert!(
        made_by.contains("\"what\": \"laws\"") && made_by.contains("libyielding.so"),
        "{made_by}"
    );

    // The kind is described as any other, and exercised.
    let (status, out, _) =
        trilith(folder.path(), &["elements", "Yielding", "--laws", "./libyielding.so"]);
    assert!(status == 0 && out.contains("Spring that yields") && out.contains("N/m"), "{out}");
    let set = ["--set", "k=100 kN/m", "--set", "fy=2 kN"];
    let all = [
        &[
            "--laws",
            "libyielding.so",
            "exercise",
            "Yielding",
            "--amplitude",
            "U1=5 cm",
            "--no-files",
        ],
        &set[..],
    ];
    let (status, out, err) = trilith(folder.path(), &all.concat());
    assert!(status == 0 && out.contains("hysteretic"), "{out}{err}");
}

#[test]
fn a_law_that_is_torn_ends_the_run_with_its_words() {
    let folder = tempfile::tempdir().unwrap();
    let Some(()) = prepared(folder.path()) else { return };
    let args = ["run", "torn.ron", "--laws", "libyielding.so", "--no-report"];
    let (status, out, err) = trilith(folder.path(), &args);
    assert_eq!(status, 1, "{out}{err}");
    let told = out + &err;
    assert!(
        told.contains("the law of \"link\" has no answer at t = 0.0") && told.contains(": torn"),
        "{told}"
    );
}

#[test]
fn libraries_that_cannot_be_taken_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let (status, _, err) = trilith(folder.path(), &["elements", "--laws", "libnone.so"]);
    assert!(status == 2 && err.contains("libnone.so cannot be opened"), "{err}");
    let Some(()) = prepared(folder.path()) else { return };
    let (status, _, err) = trilith(folder.path(), &["check", "m.ron"]);
    assert!(status == 2 && err.contains("Yielding"), "{err}");
    let twice = ["check", "m.ron", "--laws", "libyielding.so", "--laws", "libyielding.so"];
    let (status, _, err) = trilith(folder.path(), &twice);
    assert!(status == 2 && err.contains("there is a kind of that name"), "{err}");
}

#[test]
fn a_study_does_not_go_on_with_another_library() {
    let folder = tempfile::tempdir().unwrap();
    let Some(()) = prepared(folder.path()) else { return };
    let study = r#"(title: "kicks", model: "m.ron", axes: { "x": [1, 2] }, columns: { "most": Peak("x") })"#;
    let model = std::fs::read_to_string(folder.path().join("m.ron")).unwrap();
    let model = model
        .replace("plane: XZ,", "plane: XZ, parameters: { \"x\": 1 },")
        .replace("\"1 t\"", "\"x * 1 t\"");
    std::fs::write(folder.path().join("m.ron"), model).unwrap();
    std::fs::write(folder.path().join("s.ron"), study).unwrap();
    let sweep = || trilith(folder.path(), &["sweep", "s.ron", "--laws", "libyielding.so"]);
    let (status, out, err) = sweep();
    assert_eq!(status, 0, "{out}{err}");
    let (status, out, err) = sweep();
    assert_eq!(status, 0, "the same goes on: {out}{err}");
    // As if it were compiled again, of another source.
    let library = folder.path().join("libyielding.so");
    let mut bytes = std::fs::read(&library).unwrap();
    bytes.push(0);
    std::fs::remove_file(&library).unwrap();
    std::fs::write(&library, bytes).unwrap();
    let (status, _, err) = sweep();
    assert!(status == 2 && err.contains("the build of the program"), "{err}");
}

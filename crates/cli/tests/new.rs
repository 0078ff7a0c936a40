//! Models to begin with, and models from standard input.

mod common;

use common::trilith;
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn every_model_of_the_project_can_be_begun_with_and_is_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let (status, list, _) = trilith(folder.path(), &["new"]);
    assert_eq!(status, 0);
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let models = std::fs::read_dir(models).expect("models").map(|e| e.expect("an entry").path());
    let models = models.filter(|path| path.extension().is_some_and(|e| e == "ron"));
    let mut names = BTreeSet::new();
    for path in models {
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        assert!(list.contains(&name), "{name} is missing in\n{list}");
        let (status, told, said) = trilith(folder.path(), &["new", &name]);
        assert_eq!(status, 0, "{said}");
        assert!(told.contains(&format!("model: {name}.ron")), "{told}");
        let file = format!("{name}.ron");
        let (status, _, said) = trilith(folder.path(), &["check", &file]);
        assert_eq!(status, 0, "{name}: {said}");
        let same = std::fs::read(folder.path().join(&file)).ok() == std::fs::read(&path).ok();
        assert!(same, "{name} is another one");
        names.insert(name);
    }
    assert!(names.len() > 10, "{names:?}");
}

#[test]
fn what_is_there_is_not_written_over_and_a_wrong_name_is_told_with_the_right_one() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("rigid_block.ron"), "mine").expect("a file");
    let (status, _, said) = trilith(folder.path(), &["new", "rigid_block"]);
    assert!(status == 2 && said.contains("rigid_block.ron is there already"), "{status} {said}");
    let kept = std::fs::read_to_string(folder.path().join("rigid_block.ron")).expect("a file");
    assert_eq!(kept, "mine");
    let out = ["new", "rigid_block", "--out", "models/mine.ron"];
    assert_eq!(trilith(folder.path(), &out).0, 0);
    assert!(folder.path().join("models/mine.ron").is_file());
    let (status, _, said) = trilith(folder.path(), &["new", "rigid_blok"]);
    assert!(status == 2 && said.contains("rigid_block"), "{said}");
}

#[test]
fn a_model_comes_from_standard_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = r#"(
        nodes: { "m": (0, 0, 0) }, plane: XZ, supports: { "m": (Uz, Ry) },
        elements: { "mass": Mass(node: "m", mass: "100 kg"), "spring": Spring(node: "m", k2: "4 kN/m") },
        cases: { "swing": Dynamic(duration: "0.5 s", dt: "5 ms", solver: Hht,
            initial: [(node: "m", dof: Ux, velocity: "1 m/s")]) },
        outputs: { "sway": Displacement(node: "m", dof: Ux) },
    )"#;
    let run = |text: &str, args: &[&str]| {
        let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_trilith"));
        let done =
            command.current_dir(&folder).args(args).write_stdin(text).output().expect("a run");
        let [out, said] =
            [done.stdout, done.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
        (done.status.code(), out, said)
    };
    let (status, told, said) = run(text, &["run", "-", "--no-report"]);
    assert_eq!(status, Some(0), "{said}");
    assert!(told.contains("sway"), "{told}");
    assert!(folder.path().join("out/stdin/summary.json").is_file(), "{told}");
    let (status, _, said) = run(&text.replace("100 kg", "100 m"), &["check", "-"]);
    assert!(status == Some(2) && said.contains("stdin.ron:3:"), "{status:?} {said}");
}

//! `trilith import` from the command line.

use assert_cmd::Command;
use std::path::{Path, PathBuf};

fn trilith(args: &[&str], status: i32) -> (String, String) {
    let mut command = Command::cargo_bin("trilith").unwrap();
    let run = command.args(args).assert().code(status);
    let text = |b: &[u8]| String::from_utf8_lossy(b).into_owned();
    (text(&run.get_output().stdout), text(&run.get_output().stderr))
}

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../exchange/tests/files").join(name)
}

#[test]
fn an_import_writes_the_model_and_its_report_and_the_model_runs() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new/side.ron");
    let (source, out) = (file("cantilevers.s2k"), out.to_str().unwrap());
    let (told, _) = trilith(&["import", source.to_str().unwrap(), "--out", out], 0);
    assert!(told.contains("25 read, 0 ignored knowingly, 0 lost"), "{told}");
    let report = std::fs::read_to_string(folder.path().join("new/side.import.txt")).unwrap();
    assert!(told.starts_with(&report), "{told}");
    let (checked, _) = trilith(&["check", out, "--resolved"], 0);
    assert!(checked.contains("offsets_stiffen"), "{checked}");
    trilith(&["run", out, "--case", "TIP", "--no-files"], 0);
    // Without a file the model is the answer.
    let (model, said) = trilith(&["import", source.to_str().unwrap()], 0);
    assert!(
        model.contains("\"frame 1\": Beam(") && said.contains("said otherwise"),
        "{model}{said}"
    );
}

#[test]
fn a_loss_ends_with_status_one_and_a_wrong_file_with_two() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.s2k");
    std::fs::copy(file("oscillators.s2k"), &path).unwrap();
    let (source, out) = (path.to_str().unwrap(), folder.path().join("m.ron"));
    let (told, said) = trilith(&["import", source, "--out", out.to_str().unwrap()], 1);
    assert!(told.contains("LOST: this changes results"), "{told}");
    assert!(said.contains("2 losses change results"), "{said}");
    trilith(&["check", out.to_str().unwrap()], 0);
    trilith(&["import", source, "--case", "STEP"], 0);
    let (_, said) = trilith(&["import", source, "--case", "NONE"], 2);
    assert!(said.contains("the cases are AFTER, HOLD, MODAL, STEP, FILE"), "{said}");
    let (_, said) = trilith(&["import", source, "--out", source], 2);
    assert!(said.contains("is what is read"), "{said}");
    assert!(std::fs::read(&path).unwrap() == std::fs::read(file("oscillators.s2k")).unwrap());
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replace("TransKE=4000", "TransKE=stiff")).unwrap();
    let (_, said) = trilith(&["import", source], 2);
    assert!(said.contains("`stiff` is no number") && said.contains("model.s2k:"), "{said}");
    std::fs::write(&path, &text[..text.len() / 2]).unwrap();
    let (_, said) = trilith(&["import", source], 2);
    assert!(said.contains("END TABLE DATA"), "{said}");
    let (_, said) = trilith(&["import", "nowhere.s2k"], 2);
    assert!(said.contains("nowhere.s2k cannot be read"), "{said}");
}

#[test]
fn a_building_of_etabs_is_imported_by_its_ending_and_runs() {
    let folder = tempfile::tempdir().unwrap();
    let source = file("../etabs/building.e2k");
    let out = folder.path().join("building.ron");
    let out = out.to_str().unwrap();
    let (told, _) = trilith(&["import", source.to_str().unwrap(), "--out", out], 0);
    assert!(told.starts_with("building.e2k: ETABS 21.1.0, kN, m"), "{told}");
    assert!(told.contains(" 0 lost"), "{told}");
    trilith(&["run", out, "--case", "Push", "--no-files"], 0);
    // The copy that the program keeps beside its model has another ending.
    let copy = folder.path().join("building.$et");
    std::fs::copy(&source, &copy).unwrap();
    let (model, _) = trilith(&["import", copy.to_str().unwrap()], 0);
    assert!(model.contains("\"frame C1@Roof\": Beam("), "{model}");
    let (_, said) = trilith(&["import", copy.to_str().unwrap(), "--units", "in,kip"], 2);
    assert!(said.contains("`--units` of a text model of SAP2000 or ETABS"), "{said}");
}

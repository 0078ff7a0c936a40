//! Files that are imported and run.

#![allow(dead_code, reason = "each test uses a part")]

pub mod spoiled;

use std::path::{Path, PathBuf};
use trilith::{Analysis, Model, RunOptions, SolverKind};
use trilith_exchange::{Import, Options, sap2000};

/// A file of these tests.
pub fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)
}

/// Imports a file, with records from its folder.
pub fn import(path: &Path, case: Option<&str>) -> Import {
    let options = Options {
        path: path.into(),
        folder: path.parent().map(Into::into),
        case: case.map(Into::into),
        ..Options::default()
    };
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    sap2000::import(&bytes, &options).unwrap_or_else(|e| panic!("{}:\n{e}", path.display()))
}

/// The model of an import, which reads its records from a folder of its own.
pub fn model(import: &Import) -> Model {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in &import.files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let text = import.draft.to_ron();
    let read =
        trilith::read_text(&text, folder.path().join("model.ron"), &trilith::registry(), &[]);
    read.unwrap_or_else(|all| {
        let said: Vec<String> = all.iter().map(ToString::to_string).collect();
        panic!("{}\n{text}", said.join("\n"))
    })
}

/// What an output of a case comes to at its end, in SI.
pub fn last(model: &Model, case: &str, outputs: &[&str]) -> Vec<f64> {
    let run = run(model, case, None);
    let value = |o: &&str| run.peak(o).unwrap_or_else(|e| panic!("{o}: {e}")).last;
    outputs.iter().map(value).collect()
}

/// Runs a case.
pub fn run(model: &Model, case: &str, solver: Option<SolverKind>) -> trilith::Run {
    let case = model.case(case).unwrap_or_else(|| panic!("no case {case}"));
    let options = RunOptions { case, solver, ..RunOptions::default() };
    Analysis::new(model).and_then(|a| a.run(options)).unwrap_or_else(|e| panic!("{e}"))
}

/// Both within a share of the second.
pub fn close(a: f64, b: f64, share: f64, what: &str) {
    assert!((a - b).abs() <= share * b.abs().max(1e-30), "{what}: {a} is not {b}");
}

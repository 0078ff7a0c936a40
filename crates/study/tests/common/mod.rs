//! What tests of studies share.

use std::path::Path;
use std::sync::atomic::AtomicBool;
use trilith::model::Diagnostic;
use trilith_study::{How, Results, Study, StudyError, execute};

/// A mass that slides on friction under one sine; `k` a spring that holds it, `f` makes the model fail.
pub const MODEL: &str = r#"(
    title: "Sliding mass",
    plane: XZ, gravity: "9.81 m/s^2",
    parameters: {
        "mu": 0.3, "a": "1 m/s^2", "k": "0 N/m", "record": Text("quiet.csv"), "mass": "1 t",
        "limit": 0.5,
    },
    nodes: { "cg": (0, 0, 0) },
    elements: {
        "mass": Mass(node: "cg", mass: "mass", inertia: (0, 1, 0)),
        "upright": Spring(node: "cg", k1: "k", r3: "1 MN*m"),
        "foot": NLink(node: "cg", kn: "10 MN/m", ks: "10 MN/m", mu: "mu", damping: "10 kN*s/m"),
    },
    functions: {
        "pulse": Sine(amplitude: "a", frequency: "2 Hz", cycles: 1),
        "more": Table(file: Parameter("record"), after_end: Zero, scale: "1 m/s^2"),
    },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "0.6 s", dt: "10 ms",
            base: [(direction: X, function: "pulse"), (direction: X, function: "more")],
            energy_limit: "limit"),
    },
    outputs: { "slide": Displacement(node: "cg", dof: Ux) },
)"#;

pub fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mass.ron"), MODEL).unwrap();
    std::fs::write(folder.path().join("quiet.csv"), "0,0\n1,0\n").unwrap();
    std::fs::write(folder.path().join("loud.csv"), "0,2\n0.2,2\n0.21,0\n1,0\n").unwrap();
    folder
}

pub fn read(folder: &Path, body: &str) -> Result<Study, Vec<Diagnostic>> {
    let text = format!("(model: \"mass.ron\", {body})");
    Study::read_text(&text, folder.join("study.ron"), &trilith::registry(), &[])
}

pub fn run(study: &Study, out: &Path, threads: usize) -> Result<Results, StudyError> {
    let how = How::threads(threads);
    execute(study, &trilith::registry(), out, how, &|_| {}, &AtomicBool::new(false))
}

pub fn bytes(out: &Path, name: &str) -> Vec<u8> {
    std::fs::read(out.join(name)).unwrap()
}

/// What sends the runs of a study one by one: histories, which no run is worth.
pub const ALONE: &str = r#"histories: Above("slide", "100 m"),"#;

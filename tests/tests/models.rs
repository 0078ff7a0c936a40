//! Every model that ships can be read and is a structure that stands.

use std::path::{Path, PathBuf};
use trilith_model::{Analysis, ParameterValue, Registry, read};
use trilith_system::System;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../models")
}

fn registry() -> Registry {
    let mut registry = Registry::new();
    trilith_elements::register(&mut registry);
    registry
}

fn files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder()).unwrap().map(|e| e.unwrap().path());
    let mut all: Vec<_> = entries.filter(|p| p.extension().is_some_and(|x| x == "ron")).collect();
    all.sort();
    all
}

fn model(path: &Path, overrides: &[(&str, &str)]) -> trilith_model::Model {
    let overrides: Vec<_> =
        overrides.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    read(path, &registry(), &overrides).unwrap_or_else(|all| {
        let told: Vec<_> = all.iter().map(ToString::to_string).collect();
        panic!("{}", told.join("\n"))
    })
}

#[test]
fn every_model_is_read_and_stands() {
    assert!(files().len() >= 6);
    for path in files() {
        let model = model(&path, &[]);
        let system = System::without_axial_forces(&model)
            .unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        if let Err(e) = system.check_supported(&model, false) {
            panic!("{}: {e}", path.display());
        }
        assert!(!model.outputs.is_empty(), "{}: nothing is recorded", path.display());
        let last = &model.cases.last().unwrap().analysis;
        assert!(matches!(last, Analysis::Dynamic(_)), "{}", path.display());
    }
}

#[test]
fn every_model_says_at_its_top_what_it_shows_in_which_units_and_how_long_it_runs() {
    for path in files() {
        let text = std::fs::read_to_string(&path).unwrap();
        let comment: Vec<&str> = text.lines().take_while(|l| l.starts_with("//")).collect();
        let comment = comment.join("\n");
        for word in ["Units:", "Run time:"] {
            assert!(comment.contains(word), "{}: no `{word}` at the top", path.display());
        }
    }
}

#[test]
fn the_readme_lists_every_model() {
    let readme = std::fs::read_to_string(folder().join("README.md")).unwrap();
    for path in files() {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        assert!(readme.contains(&format!("`{name}`")), "models/README.md has no {name}");
    }
}

const BLOCK: &[&str] =
    &["width", "height", "mass", "g", "mu", "kn", "ks", "cv", "cr", "pull", "duration"];

#[test]
fn the_block_family_keeps_the_names_that_scripts_rely_on() {
    let pulses = ["ah", "av", "frequency", "cycles", "frequency_v", "cycles_v"];
    let family: [(&str, &[&str]); 4] = [
        ("rigid_block.ron", &pulses),
        ("rigid_block_record.ron", &["record", "scale"]),
        ("rigid_block_drop.ron", &["lift", "hold"]),
        ("rigid_block_rocking.ron", &["uplift0"]),
    ];
    for (file, own) in family {
        let model = model(&folder().join(file), &[]);
        for name in BLOCK.iter().chain(own) {
            assert!(model.parameters.iter().any(|p| p.name == *name), "{file}: no `{name}`");
        }
        let outputs: Vec<_> = model.outputs.iter().map(|o| (&*o.name, &*o.unit)).collect();
        let expected =
            [("slide", "m"), ("uplift_left", "m"), ("uplift_right", "m"), ("rotation", "rad")];
        assert_eq!(outputs, expected, "{file}");
    }
    let block = model(&folder().join("rigid_block.ron"), &[]);
    assert_eq!(block.parameters.len(), BLOCK.len() + pulses.len());
}

#[test]
fn the_block_takes_bare_numbers_in_si() {
    let set = [("cv", "1.27665182e7"), ("mass", "9e3"), ("pull", "0"), ("cycles", "0.5")];
    let block = model(&folder().join("rigid_block.ron"), &set);
    let mass = block.parameters.iter().find(|p| p.name == "mass").unwrap();
    assert!(matches!(mass.value, ParameterValue::Number(x, _) if (x - 9e3).abs() < 1e-9));
}

#[test]
fn the_rocking_block_starts_on_its_left_corner_with_the_right_one_at_the_given_uplift() {
    let model = model(&folder().join("rigid_block_rocking.ron"), &[]);
    let Analysis::Dynamic(case) = &model.cases.last().unwrap().analysis else { panic!("static") };
    let at = |dof| {
        let initial = case.initial.iter().find(|i| i.dof == dof).unwrap();
        initial.displacement.unwrap()
    };
    use trilith_element::Dof;
    let [x, z, turn] = [Dof::Ux, Dof::Uz, Dof::Ry].map(at);
    // u = u_cg + θ × r with corners at (∓1, −2) from the centre of gravity.
    let corner = |rx: f64| (x + turn * -2.0, z - turn * rx);
    let compression = 1e4 * 9.81 / 2.0 / 5e8;
    let ((slide, left), (_, right)) = (corner(-1.0), corner(1.0));
    assert!(slide.abs() < 1e-15);
    assert!((left + compression).abs() < 1e-15);
    assert!((right - 0.12954).abs() < 1e-15);
}

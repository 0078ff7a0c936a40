//! Link laws of another crate, by their names in model files.

use std::path::{Path, PathBuf};
use trilith_model::{Registry, SolverKind};
use trilith_tests::{parse, root, trace};

/// The kinds of the example crate.
fn foreign() -> Vec<&'static str> {
    kinds().cards().map(|c| c.kind).collect()
}

fn kinds() -> Registry {
    let mut kinds = Registry::new();
    trilith_thirdparty_example::register(&mut kinds);
    kinds
}

/// All files of the project that are read by people or compilers, without what is built.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            if !name.starts_with('.') && name != "target" && name != "out" {
                files(&path, found);
            }
        } else if [".rs", ".ron", ".toml"].iter().any(|end| name.ends_with(end)) {
            found.push(path);
        }
    }
}

/// A link of another crate costs one line: outside its crate no source names it or its crate, but
/// the registry of these tests and the manifests.
#[test]
fn a_foreign_link_changes_one_line_outside_its_crate() {
    let mut all = Vec::new();
    for folder in ["crates", "elements", "models", "validation", "tests"] {
        files(&root().join(folder), &mut all);
    }
    let own = root().join("tests/thirdparty");
    let tests = root().join("tests/tests");
    let mut lines = Vec::new();
    for path in all.iter().filter(|p| !p.starts_with(&own) && !p.starts_with(&tests)) {
        let text = std::fs::read_to_string(path).unwrap();
        let names = |line: &&str| {
            line.contains("trilith_thirdparty_example")
                || foreign().iter().any(|k| line.contains(k))
        };
        lines.extend(text.lines().filter(names).map(|l| l.trim().to_owned()));
    }
    assert_eq!(lines, ["trilith_thirdparty_example::register(to);"]);
    assert!(all.len() > 150, "{} files", all.len());
}

#[test]
fn foreign_kinds_stand_beside_the_built_in_ones() {
    let (all, built_in) = (trilith_tests::registry(), trilith::registry());
    assert!(all.duplicates().is_empty());
    for kind in foreign() {
        assert!(built_in.card(kind).is_none());
        let category = kinds().card(kind).map(|c| c.category);
        assert!(category.is_some() && all.card(kind).map(|c| c.category) == category, "{kind}");
    }
}

/// The diagonals yield and take a good part of the energy.
#[test]
fn the_model_of_the_example_crate_runs_alike_under_both_solvers() {
    let path = root().join("tests/thirdparty/models/braced_frame.ron");
    let (model, system) = parse(&std::fs::read_to_string(path).unwrap(), &[]);
    let [(a, ra), (b, rb)] = [SolverKind::Fna, SolverKind::Hht].map(|s| trace(&model, &system, s));
    for (i, output) in model.outputs.iter().enumerate() {
        assert!((a.peak(i) - b.peak(i)).abs() < 0.005 * a.peak(i), "{}", output.name);
    }
    for energy in [&ra.energy, &rb.energy] {
        assert!(energy.error_relative < 1e-3 && energy.link_hysteretic > 0.1 * energy.input);
    }
    assert!(a.peak(1) > 2e5, "the diagonals yield");
}

/// The Duffing oscillator m ü + k1 u + k3 u³ = 0 released from A: T = 4 K(k) / √((k1 + k3 A²)/m) with
/// k² = k3 A² / (2 (k1 + k3 A²)). For k1 = 2, k3 = 4, A = 1, m = 2.588e-3: 0.1440439 s.
#[test]
fn a_third_party_spring_swings_with_the_period_of_the_duffing_oscillator() {
    let text = r#"(
        nodes: { "m": (0, 0, 0) },
        supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
        elements: {
            "mass": Mass(node: "m", mass: 2.588e-3),
            "spring": CubicSpring(node: "m", k1: 2, k3: 4, axis1: (1, 0, 0), axis2: (0, 0, 1)),
        },
        cases: { "swing": Dynamic(
            duration: 0.1440439, dt: 0.0001440439,
            initial: [(node: "m", dof: Ux, displacement: 1)],
            step: Adaptive(tolerance: 1e-6),
        ) },
        outputs: { "u": Displacement(node: "m", dof: Ux), "v": Velocity(node: "m", dof: Ux) },
    )"#;
    let (model, system) = parse(text, &[]);
    for solver in SolverKind::ALL {
        let (t, _) = trace(&model, &system, solver);
        assert!((t.last[0] - 1.0).abs() < 1e-3, "{}: {} after a period", solver.name(), t.last[0]);
        assert!(t.last[1].abs() < 0.02 * t.peak(1), "{}", solver.name());
        assert!((t.history[500][0] + 1.0).abs() < 1e-3, "{}: half a period", solver.name());
    }
}

//! Studies whose runs go side by side, beside the same one by one.

mod common;

use common::{ALONE, MODEL, bytes, folder, read, run};
use std::path::Path;

/// The model with fixed steps, whose runs go side by side.
fn with_fixed_steps(folder: &Path) {
    let fixed = "energy_limit: \"limit\", step: Fixed(substeps: 20)";
    let text = MODEL.replace("energy_limit: \"limit\"", fixed);
    std::fs::write(folder.join("mass.ron"), text).unwrap();
}

#[test]
fn small_models_go_side_by_side_and_give_the_same_numbers() {
    let folder = folder();
    // Adaptive steps are cut for the fast rotation in lanes, so that they are others.
    side_by_side(&folder.path().join("adaptive"), 1e-3);
    with_fixed_steps(folder.path());
    side_by_side(&folder.path().join("fixed"), 1e-6);
}

/// Runs a study side by side and one by one; `share`: how far they may be apart.
fn side_by_side(out: &Path, share: f64) {
    let folder = out.parent().unwrap();
    let body = r#"
        axes: { "mu": [0.1, 0.2, 0.3], "a": Range(from: "1 m/s^2", to: "8 m/s^2", count: 8) },
        stop: (along: "a", when: Above("slide", "30 mm")),
        columns: { "slide": Peak("slide"), "t": TimeOfPeak("slide"), "end": Final("slide"),
            "slip": Slip, "heat": Energy("link_hysteretic"), "lost": EnergyError,
            "rms": Rms("slide"), "long": Duration(output: "slide", above: "5 mm") },"#;
    let beside = read(folder, body).unwrap();
    let alone = read(folder, &format!("{body} {ALONE}")).unwrap();
    let registry = trilith::registry();
    assert_eq!(beside.alone(&registry), None);
    assert!(alone.alone(&registry).unwrap().contains("histories"));
    let [at, there] = ["beside", "alone"].map(|name| out.join(name));
    let (found, expected) = (run(&beside, &at, 2).unwrap(), run(&alone, &there, 2).unwrap());
    assert_eq!((found.beside, expected.beside), (found.records.len(), 0));
    assert!(found.left_out > 0 && found.left_out == expected.left_out);
    for (own, other) in found.records.iter().zip(expected.records.iter()) {
        assert_eq!(
            (own.run(), own.status(), own.mode()),
            (other.run(), other.status(), other.mode())
        );
        assert_eq!(own.initial_mode(), other.initial_mode());
        for ((x, y), column) in own.values().zip(other.values()).zip(&beside.columns) {
            let (x, y) = (x.unwrap(), y.unwrap());
            // Straight lines between other moments cross a value elsewhere, by a small share of an output step of 10 ms.
            let least = match &*column.name {
                "lost" => share,
                "long" => 0.2 * share,
                _ => 1e-9,
            };
            assert!((x - y).abs() <= share * y.abs() + least, "{} {x} {y}", column.name);
        }
    }
    // Whoever the neighbours are, and whatever was on disk.
    let again = out.join("again");
    std::fs::create_dir(&again).unwrap();
    let journal = bytes(&at, "runs.journal");
    std::fs::write(again.join("runs.journal"), &journal[..journal.len() / 3]).unwrap();
    assert!(run(&beside, &again, 1).unwrap().resumed > 0);
    assert_eq!(bytes(&again, "table.csv"), bytes(&at, "table.csv"));
}

#[test]
fn what_fails_beside_others_says_so_as_alone() {
    let folder = folder();
    with_fixed_steps(folder.path());
    let body = r#"points: [
        { "mu": 0.3, "limit": 0.5, "mass": "1 t" }, { "mu": 0.2, "limit": 1e-300, "mass": "1 t" },
        { "mu": 0.1, "limit": 0.5, "mass": "0 t" },
    ], columns: { "slide": Peak("slide") },"#;
    let made = |more: &str| {
        let study = read(folder.path(), &format!("{body} {more}")).unwrap();
        run(&study, &folder.path().join(format!("out{}", more.len())), 1).unwrap()
    };
    let (beside, alone) = (made(""), made(ALONE));
    // One without mass does not fit, and goes by itself.
    assert_eq!((beside.beside, alone.beside), (2, 0));
    assert_eq!((beside.failed(), beside.records.len()), (1, 3));
    for (own, other) in beside.records.iter().zip(alone.records.iter()) {
        assert_eq!((own.status(), own.good()), (other.status(), other.good()));
        // But for the digits of the share.
        let words = |text: &str| text.split_once('%').map(|(_, rest)| rest.to_owned());
        assert_eq!(words(own.message()), words(other.message()));
        assert_eq!(own.message().is_empty(), own.good());
    }
    // Friction below zero is refused, among others that run.
    let random =
        r#"seed: 2, samples: Random(count: 12, of: { "mu": Normal(mean: 0.1, deviation: 0.2) })"#;
    let study = read(folder.path(), random).unwrap();
    let results = run(&study, &folder.path().join("random"), 2).unwrap();
    let refused = results.records.iter().filter(|r| r.status() == "model error").count();
    assert!(refused > 0 && results.beside == 12 - refused, "{refused} {}", results.beside);
}

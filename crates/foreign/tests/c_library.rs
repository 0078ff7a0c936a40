//! Laws of libraries that a C compiler makes here; where there is none, the tests say so and pass.

use std::path::{Path, PathBuf};
use std::process::Command;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, LawFailed, Link};
use trilith_foreign::{ForeignError, Kind, Library};
use trilith_model::{Body, Diagnostic, Registry, read_text};

/// A library of a source in this folder; none without a compiler.
fn compiled(source: &str, flags: &[&str], to: &Path) -> Option<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let library = to.join(format!("lib{}.so", flags.concat().replace(['-', '='], "") + source));
    let compiler = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
    let done = Command::new(&compiler)
        .args([
            "-shared",
            "-fPIC",
            "-std=c99",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-O2",
            "-ffp-contract=off",
            "-o",
        ])
        .arg(&library)
        .arg("-I")
        .arg(here.join("include"))
        .arg(here.join("tests").join(source))
        .args(flags)
        .arg("-lm")
        .output();
    match done {
        Ok(done) => {
            let told = String::from_utf8_lossy(&done.stderr);
            assert!(done.status.success(), "{source}: {told}");
            Some(library)
        }
        Err(e) => {
            eprintln!("skipped: there is no C compiler here ({}: {e})", compiler.display());
            None
        }
    }
}

fn registry(kinds: &[Kind]) -> Registry {
    let mut registry = Registry::new();
    kinds.iter().for_each(|kind| kind.register(&mut registry));
    registry
}

/// The law of a model with that link alone.
fn law(kinds: &[Kind], link: &str) -> Result<std::sync::Arc<dyn Link>, Vec<Diagnostic>> {
    let text = format!(
        "(nodes: {{ \"a\": (0, 0, 0) }}, elements: {{ \"link\": {link} }}, cases: {{ \"rest\": Static(loads: []) }})"
    );
    let mut model = read_text(&text, "m.ron", &registry(kinds), &[])?;
    match model.elements.pop().map(|e| e.body) {
        Some(Body::Link(law, _)) => Ok(law),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_law_in_c_is_read_by_its_name_and_conforms() {
    let folder = tempfile::tempdir().unwrap();
    let Some(library) = compiled("yielding.c", &[], folder.path()) else { return };
    let kinds = Library::open(&library).unwrap();
    let [kind] = &kinds[..] else { panic!("{kinds:?}") };
    let card = kind.card();
    assert_eq!((card.kind, card.parameters.len()), ("Yielding", 4));
    assert!(kind.accounts() && kind.has_tangent());

    let text = r#"Yielding(node: "a", k: "100 kN/m", fy: "0.5 kN", c: "200 N*s/m")"#;
    let link = law(&kinds, text).unwrap();
    let report = Kit::new(&[0.01], 1.0).check(&*link).unwrap();
    assert!(report.tangents > 100, "{report:?}");
    let mut driver = Driver::new(&*link);
    // 5 mm elastic, 15 mm slip.
    assert_eq!(driver.to(&[0.02]), [500.0]);
    assert!((driver.history[0] - 0.015).abs() < 1e-15 && driver.k == [0.0]);
    assert!((driver.energy.hysteretic - 7.5).abs() < 1e-12);
    let beyond = driver.toward(&[1.5], &[0.0], 0.0);
    assert!(driver.ask(&beyond).f[0].is_nan());
    assert_eq!(driver.refusal(&beyond).as_deref(), Some("torn"));

    let refused = |text: &str, words: &str| {
        let told =
            law(&kinds, text).unwrap_err().iter().map(ToString::to_string).collect::<String>();
        assert!(told.contains(words), "{told}");
    };
    refused(r#"Yielding(node: "a", k: "1 MN", fy: "1 kN")"#, "N/m");
    refused(r#"Yielding(node: "a", k: -1, fy: "1 kN")"#, "must be > 0");
    refused(r#"Yielding(node: "a", k: 1, fy: 3)"#, "`torn` must be more than the elongation");
    refused(r#"Yielding(node: "a", k: 1)"#, "no `fy`, which Yielding needs");
    refused(r#"Yielding(node: "a", k: 1, fy: 3, d: 1)"#, "no field `d`");
}

#[test]
fn a_law_lives_as_long_as_a_link_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let Some(library) = compiled("yielding.c", &[], folder.path()) else { return };
    let link =
        law(&Library::open(&library).unwrap(), r#"Yielding(node: "a", k: 1e5, fy: 500)"#).unwrap();
    assert_eq!(Driver::new(&*link).to(&[0.001]), [100.0]);
}

#[test]
fn libraries_that_are_none_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let missing = Library::open(&folder.path().join("libnone.so")).unwrap_err();
    assert!(matches!(missing, ForeignError::Open { .. }), "{missing}");
    let text = folder.path().join("libtext.so");
    std::fs::write(&text, "no library").unwrap();
    assert!(matches!(Library::open(&text), Err(ForeignError::Open { .. })));
    for (wrong, words) in [
        ("-DWRONG=0", "does not export `trilith_law_at`"),
        ("-DWRONG=1", "made for the contract 2 of trilith_link.h, and this program knows 1"),
        ("-DWRONG=2", "its flags are 0x40"),
        ("-DWRONG=3", "`lower` is no name of a kind"),
        ("-DWRONG=4", "its coordinates `U1 U7` must be"),
        ("-DWRONG=5", "the history variable `a` is there twice"),
        ("-DWRONG=6", "it has 3 parameters, and where they are: nowhere"),
        ("-DWRONG=7", "it has no function `respond`"),
    ] {
        let Some(library) = compiled("wrong.c", &[wrong], folder.path()) else { return };
        let told = Library::open(&library).unwrap_err().to_string();
        assert!(told.contains(words) && told.contains("libDWRONG"), "{told}");
    }
}

#[test]
fn a_law_that_fails_unwinds_with_its_status() {
    let folder = tempfile::tempdir().unwrap();
    let Some(library) = compiled("wrong.c", &["-DWRONG=8"], folder.path()) else { return };
    let link = law(&Library::open(&library).unwrap(), r#"Fails(node: "a")"#).unwrap();
    let mut driver = Driver::new(&*link);
    assert_eq!(driver.to(&[-1.0]), [0.0]);
    let asked = std::panic::AssertUnwindSafe(|| driver.to(&[1.0]).to_vec());
    let payload = std::panic::catch_unwind(asked).unwrap_err();
    assert_eq!(payload.downcast_ref(), Some(&LawFailed("Fails returned -7".into())));
}

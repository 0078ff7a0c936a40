//! The studies that ship.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use trilith::theory;
use trilith_study::{Drawing, How, Study, execute};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../models/studies")
}

#[test]
fn every_study_can_be_read_and_says_at_its_top_what_it_shows() {
    let mut count = 0;
    for entry in std::fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        let study = Study::read(&path, &trilith::registry(), &[]).unwrap_or_else(|all| {
            let told: Vec<_> = all.iter().map(ToString::to_string).collect();
            panic!("{}", told.join("\n"))
        });
        assert!(!study.figures.is_empty() && !study.title.is_empty(), "{}", path.display());
        let text = std::fs::read_to_string(&path).unwrap();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let command = format!("trilith sweep models/studies/{name}");
        assert!(text.starts_with("// ") && text.contains(&command), "{name}");
        assert!(text.contains("Run time:"), "{name}");
        count += 1;
    }
    assert!(count >= 5);
}

/// The chart with a tenth of its runs: every point off the borders has the mode of the closed form.
#[test]
fn the_mode_chart_agrees_with_the_closed_form() {
    let path = folder().join("mode_chart.ron");
    let text = std::fs::read_to_string(&path).unwrap().replace("count: 40", "count: 14");
    let study = Study::read_text(&text, &path, &trilith::registry(), &[]).unwrap();
    let out = tempfile::tempdir().unwrap();
    let results = execute(
        &study,
        &trilith::registry(),
        out.path(),
        How::threads(2),
        &|_| {},
        &AtomicBool::new(false),
    )
    .unwrap();
    assert_eq!((results.records.len(), results.failed()), (196, 0));
    let Drawing::ModeChart { x, y, slenderness } = &study.figures[0] else { panic!("a chart") };
    let mut modes = Vec::new();
    for r in results.records.iter() {
        let number = |name: &str| r.number(&study.varied, &study.columns, name).unwrap();
        let (mu, a) = (number(x), number(y));
        let mode = |f: f64, g: f64| theory::initial_mode(a * f, mu * g, *slenderness);
        let sides = [0.98, 1.02];
        let here = mode(1.0, 1.0);
        if sides.iter().all(|f| sides.iter().all(|g| mode(*f, *g) == here)) {
            assert_eq!(r.initial_mode(), Some(here), "µ = {mu}, A = {a}");
            modes.push(here);
        }
    }
    for mode in ["rest", "slide", "rock", "slide-rock"] {
        assert!(modes.contains(&mode), "{mode}");
    }
    let html = std::fs::read_to_string(out.path().join("study.html")).unwrap();
    assert!(html.contains("0 differ"));
}

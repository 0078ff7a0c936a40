//! Oscillators: masses, damping, functions, the chain of cases.

mod common;

use common::{close, file, import, last, model, run};
use trilith::SolverKind;

#[test]
fn a_step_of_the_ground_swings_a_damped_oscillator_as_in_books() {
    let import = import(&file("oscillators.s2k"), Some("STEP"));
    let model = model(&import);
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let run = run(&model, "STEP", Some(solver));
        let history = run.history("mass Ux").unwrap();
        // 9 added, half of the 2 of the link; 0.5 m/s² to −X.
        let (w, z) = (20.0_f64, 0.05_f64);
        let wd = w * (1.0 - z * z).sqrt();
        let share = if solver == SolverKind::Fna { 1e-8 } else { 1e-3 };
        for (t, u) in run.time().iter().zip(history) {
            let swing = (-z * w * t).exp() * ((wd * t).cos() + z * w / wd * (wd * t).sin());
            let expected = 0.5 / (w * w) * (1.0 - swing);
            assert!((u - expected).abs() < share * 0.5 / (w * w), "{t}: {u} is not {expected}");
        }
    }
}

#[test]
fn a_slow_loading_is_statics_and_the_next_case_begins_where_it_ends() {
    let import = import(&file("oscillators.s2k"), Some("AFTER"));
    let names: Vec<&str> = import.draft.cases.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["HOLD", "AFTER"]);
    let model = model(&import);
    close(last(&model, "HOLD", &["alone Ux"])[0], 2.0 * 100.0 / 80_000.0, 1e-9, "held");
    let run = run(&model, "AFTER", Some(SolverKind::Fna));
    let (w, z) = (20.0_f64, 0.05_f64);
    let wd = w * (1.0 - z * z).sqrt();
    for (t, u) in run.time().iter().zip(run.history("alone Ux").unwrap()) {
        let swing = (-z * w * t).exp() * ((wd * t).cos() + z * w / wd * (wd * t).sin());
        assert!((u - 0.0025 * swing).abs() < 1e-8, "{t}: {u}");
    }
    let ron = import.draft.to_ron();
    assert!(ron.contains("alpha: -0.05") && ron.contains("damping: Rayleigh(mass: 2)"), "{ron}");
    assert_eq!(import.report.losses(), 0, "{}", import.report.text());
}

#[test]
fn a_record_is_found_beside_the_model_and_goes_into_a_file_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("oscillators.s2k");
    std::fs::copy(file("oscillators.s2k"), &path).unwrap();
    let mut text = String::from("made by hand\n3 in a line\n");
    for k in 0..100 {
        let x = |i: usize| (0.2 * (3 * k + i) as f64).sin();
        text += &format!("# {} {}\t{},7777\n", x(0), x(1), x(2));
    }
    std::fs::write(folder.path().join("quake.txt"), text).unwrap();
    let import = import(&path, Some("FILE"));
    assert_eq!(import.report.losses(), 0, "{}", import.report.text());
    let (name, csv) = &import.files[0];
    assert_eq!(name, "model.QUAKE_from_0.1.csv");
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!((lines.len(), lines[0], lines[1]), (302, "t,value", "0,0"));
    assert!(lines[3].starts_with("0.11,0.19866"), "{}", lines[3]);
    let model = model(&import);
    let [fna, hht] = [SolverKind::Fna, SolverKind::Hht].map(|s| {
        let peak = run(&model, "FILE", Some(s)).peak("mass Ux").unwrap();
        peak.max.max(-peak.min)
    });
    assert!(fna > 1e-3, "{fna}");
    close(hht, fna, 2e-3, "hht");
}

#[test]
fn a_record_that_is_missing_loses_its_case_by_name() {
    let import = import(&file("oscillators.s2k"), None);
    let names: Vec<&str> = import.draft.cases.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["HOLD", "AFTER", "STEP"]);
    let text = import.report.text();
    for words in [
        "does not lie beside the model (QUAKE: C:\\somewhere\\Quake.TXT)",
        "a case without one of its functions is not written (FILE)",
        "near-critical damping is a static case (HOLD)",
        "modes are shown by `trilith modes` (MODAL)",
    ] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
    assert_eq!(import.report.losses(), 2);
    model(&import);
}

//! Runs that another study, or the same one before it was edited, has made.

mod common;

use common::{ALONE, MODEL, bytes, folder, read, run};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use trilith_study::{How, Part, Results, Shard, Study, StudyError, execute};

const COLUMNS: &str = r#"columns: { "slide": Peak("slide"), "ratio": "slide*mu*9.81/a" },"#;

fn grid(a: &str, mu: &str, more: &str) -> String {
    format!(r#"axes: {{ "a": [{a}], "mu": [{mu}] }}, {COLUMNS} {more}"#)
}

fn run_with(study: &Study, out: &Path, store: &Path) -> Result<Results, StudyError> {
    let how = How { store: Some(store), ..How::threads(2) };
    execute(study, &trilith::registry(), out, how, &|_| {}, &AtomicBool::new(false))
}

/// Lines of runs in all segments.
fn kept(store: &Path) -> usize {
    let all = std::fs::read_dir(store).unwrap().map(|e| e.unwrap().path());
    let segments = all.filter(|path| path.extension().is_some_and(|e| e == "segment"));
    let runs = |path| std::fs::read_to_string(path).unwrap().lines().count() - 1;
    segments.map(runs).sum()
}

#[test]
fn an_edited_study_makes_what_is_new_and_has_the_bits_of_one_without_a_store() {
    let folder = folder();
    let here = folder.path();
    let store = here.join("store");
    for (form, more) in [("beside", ""), ("alone", ALONE)] {
        let before = if store.exists() { kept(&store) } else { 0 };
        let first = read(here, &grid("1, 4", "0.1, 0.3", more)).unwrap();
        let results = run_with(&first, &here.join(format!("first {form}")), &store).unwrap();
        assert_eq!((results.reused, results.resumed, kept(&store) - before), (0, 0, 4), "{form}");
        // Another point, another column, in another order.
        let more = format!("{more} seed: 3,");
        let edited = grid("6, 4, 1", "0.1, 0.3", &more)
            .replace("\"ratio\"", "\"last\": Final(\"slide\"), \"ratio\"");
        let edited = read(here, &edited).unwrap();
        let out = here.join(format!("edited {form}"));
        let results = run_with(&edited, &out, &store).unwrap();
        assert_eq!(
            (results.reused, results.records.len(), kept(&store) - before),
            (4, 6, 6),
            "{form}"
        );
        let without = here.join(format!("without {form}"));
        run(&edited, &without, 2).unwrap();
        for name in ["table.parquet", "table.csv", "study.html"] {
            assert_eq!(bytes(&out, name), bytes(&without, name), "{name} {form}");
        }
    }
}

#[test]
fn another_run_is_not_taken_for_one_that_is_there() {
    let folder = folder();
    let here = folder.path();
    let store = here.join("store");
    let one = r#"axes: { "a": [4] }, columns: { "slide": Peak("slide") },"#;
    let mut outs = 0;
    let mut reused = |body: &str| {
        outs += 1;
        let study = read(here, body).unwrap();
        run_with(&study, &here.join(format!("out{outs}")), &store).unwrap().reused
    };
    assert_eq!((reused(one), reused(one)), (0, 1));
    // A value of a parameter that all runs have, the solver, what is taken over time.
    for more in [r#"set: { "mu": 0.31 },"#, "solver: hht,"] {
        let other = format!("{one} {more}");
        assert_eq!((reused(&other), reused(&other)), (0, 1), "{more}");
    }
    assert_eq!(reused(&one.replace("Peak", "Rms")), 0);
    // Written in another way it is the same.
    assert_eq!(reused(&one.replace("[4]", r#"["400 cm/s^2"]"#)), 1);
    // What stands in a file that the model names, and then the model.
    std::fs::write(here.join("quiet.csv"), "0,0\n1,0.1\n").unwrap();
    assert_eq!((reused(one), reused(one)), (0, 1));
    std::fs::write(here.join("mass.ron"), MODEL.replace("10 ms", "5 ms")).unwrap();
    assert_eq!((reused(one), reused(one)), (0, 1));
    std::fs::write(here.join("mass.ron"), MODEL).unwrap();
    std::fs::write(here.join("quiet.csv"), "0,0\n1,0\n").unwrap();
    assert_eq!(reused(one), 1);
}

#[test]
fn failed_runs_are_kept_too_until_they_are_to_be_made_again() {
    let folder = folder();
    let here = folder.path();
    let store = here.join("store");
    let body = r#"points: [{ "mu": 0.3, "limit": 0.5 }, { "mu": 0.2, "limit": 1e-300 }]"#;
    let study = read(here, body).unwrap();
    assert_eq!(run_with(&study, &here.join("one"), &store).unwrap().failed(), 1);
    let again = run_with(&study, &here.join("two"), &store).unwrap();
    assert_eq!((again.reused, again.failed()), (2, 1));
    assert_eq!(bytes(&here.join("one"), "table.csv"), bytes(&here.join("two"), "table.csv"));
    let how = How { store: Some(&store), retry_failed: true, ..How::threads(1) };
    let never = AtomicBool::new(false);
    let out = here.join("three");
    let third = execute(&study, &trilith::registry(), &out, how, &|_| {}, &never).unwrap();
    assert_eq!((third.reused, third.failed(), kept(&store)), (1, 1, 3));
}

#[test]
fn histories_are_made_for_runs_that_are_kept_without() {
    let folder = folder();
    let here = folder.path();
    let store = here.join("store");
    let body = r#"axes: { "a": [1, 8] }, histories: Above("peak_slide", "1 mm")"#;
    let study = read(here, body).unwrap();
    run_with(&study, &here.join("one"), &store).unwrap();
    let two = here.join("two");
    assert_eq!(run_with(&study, &two, &store).unwrap().reused, 1);
    assert!(!two.join("runs/000001").exists() && two.join("runs/000002/histories.csv").is_file());
}

/// Parts on machines that do not see the folder: what is known goes there, what is made comes back.
#[test]
fn parts_that_were_run_elsewhere_are_gathered_to_the_same_bits() {
    let folder = folder();
    let here = folder.path();
    let body = format!(
        r#"axes: {{ "mu": [0.1, 0.2, 0.3, 0.4, 0.5], "a": [1, 2, 4, 8] }}, {COLUMNS}
           stop: (along: "a", when: Above("slide", "20 mm")),"#
    );
    let study = read(here, &body).unwrap();
    let (whole, out) = (here.join("whole"), here.join("out"));
    run(&study, &whole, 2).unwrap();
    let part_of = |folder: &Path, part: Part| {
        let how = How { part, ..How::threads(1) };
        execute(&study, &trilith::registry(), folder, how, &|_| {}, &AtomicBool::new(false))
    };
    // A part of another number is there already: none of its runs is made again.
    let first = part_of(&out, Part::Shard(Shard::new(1, 5).unwrap())).unwrap().records.len();
    let open = study.open_parts(&out, 3, false).unwrap();
    // What that has made is all of the first of three.
    assert_eq!(open.len(), 2);
    let mut made = 0;
    for (shard, known) in open.into_iter().rev() {
        let elsewhere = here.join(format!("elsewhere {shard}").replace('/', " of "));
        std::fs::create_dir(&elsewhere).unwrap();
        std::fs::write(elsewhere.join("runs.journal"), known).unwrap();
        let results = part_of(&elsewhere, Part::Shard(shard)).unwrap();
        made += results.records.len() - results.resumed;
        let (index, of) = (shard.index(), shard.of());
        let journal = bytes(&elsewhere, &format!("runs.{index}-of-{of}.journal"));
        study.take_part(&out, shard, &journal).unwrap();
        // Twice is as good as once.
        study.take_part(&out, shard, &journal).unwrap();
    }
    assert!(study.open_parts(&out, 3, false).unwrap().is_empty());
    let gathered = part_of(&out, Part::Gather).unwrap();
    assert_eq!(gathered.records.len(), first + made);
    for name in ["table.parquet", "table.csv", "study.html"] {
        assert_eq!(bytes(&out, name), bytes(&whole, name), "{name}");
    }
    // What another study made is not taken.
    let other = read(here, &body.replace("0.5]", "0.6]")).unwrap();
    let shard = Shard::new(2, 3).unwrap();
    let journal = bytes(&out, "runs.2-of-3.journal");
    let error = other.take_part(&here.join("other"), shard, &journal).unwrap_err();
    assert!(matches!(error, StudyError::OtherStudy { .. }), "{error}");
}

//! Where results go, and that nothing of anybody else is lost there.

use std::path::Path;
use std::process::Command;

/// A mass on a spring, shaken by a record.
const MODEL: &str = r#"(
    title: "A swinging mass",
    plane: XZ,
    parameters: { "k": "40 N/m", "record": Text("shake.csv") },
    nodes: { "top": (0, 0, 1), "base": (0, 0, 0) },
    supports: { "base": Fixed },
    elements: {
        "mass": Mass(node: "top", mass: "1 kg"),
        "spring": Spring(nodes: ("base", "top"), k1: "1 kN/m", k2: "k", r2: 1, r3: 1),
        "stop": Gap(nodes: ("base", "top"), k: "1 kN/m", opening: "1 cm", axis1: (1, 0, 0)),
    },
    functions: { "shake": Table(file: Parameter("record"), scale: "1 m/s^2", after_end: Zero) },
    cases: {
        "nudge": Dynamic(
            duration: "1 s", dt: "0.01 s",
            initial: [(node: "top", dof: Ux, displacement: "1 cm")],
        ),
        "swing": Dynamic(duration: "1 s", dt: "0.01 s", base: [(direction: X, function: "shake")]),
    },
    outputs: { "sway": Displacement(node: "top", dof: Ux) },
)"#;
const RECORD: &str = "t,a\n0,0\n0.2,1\n0.4,0\n";
const MOTION: &str = "t [s],a [g]\n0,0\n0.1,0.2\n0.2,0\n0.3,0\n";
const STUDY: &str = r#"(model: "swing.ron", axes: { "k": [30, 40] })"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in
        [("swing.ron", MODEL), ("shake.csv", RECORD), ("in.txt", MOTION), ("study.ron", STUDY)]
    {
        put(folder.path(), name, text);
    }
    folder
}

fn put(folder: &Path, name: &str, text: &str) {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, text).unwrap();
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap_or_default()
}

/// Exit status, stdout, stderr.
fn trilith(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    let output = command.current_dir(folder).args(args).output().unwrap();
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// What a command that must succeed prints.
fn good(folder: &Path, args: &[&str]) -> String {
    let (status, out, err) = trilith(folder, args);
    assert_eq!(status, 0, "{args:?}\n{out}{err}");
    out
}

/// Holds that a command is refused because of a file, which stays as it is.
fn refused(folder: &Path, args: &[&str], name: &str, why: &str) {
    let before = read(folder, name);
    let (status, out, err) = trilith(folder, args);
    assert_eq!((status, out.as_str()), (2, ""), "{args:?}\n{err}");
    let name = name.to_owned();
    for part in [&*name, why, "--out DIR"] {
        assert!(err.contains(part), "{args:?}: {part} in\n{err}");
    }
    assert_eq!(read(folder, &name), before, "{args:?}");
}

const FOREIGN: &str = "is in the way";
const INPUT: &str = "is an input, and would be overwritten";

#[test]
fn a_run_replaces_nothing_that_no_run_has_made() {
    let folder = folder();
    let here = folder.path();
    let run = ["run", "swing.ron", "--out", "proj"];
    let drawn = ["run", "swing.ron", "--out", "proj", "--figure", "sway,stop"];
    for (args, name) in [
        (&run[..], "report.html"),
        (&run, "summary.json"),
        (&run, "peaks.csv"),
        (&run, "frames/0000.vtu"),
        (&run, "checkpoint.json"),
        (&run, "model.pvd/mine.txt"),
        (&drawn, "sway.svg"),
        (&drawn, "stop_U1.svg"),
    ] {
        put(here, &format!("proj/{name}"), "{}");
        let told = format!("proj/{}", name.strip_suffix("/mine.txt").unwrap_or(name));
        refused(here, args, &told, FOREIGN);
        assert_eq!(read(here, &format!("proj/{name}")), "{}");
        assert_eq!(std::fs::read_dir(here.join("proj")).unwrap().count(), 1, "{name}");
        std::fs::remove_dir_all(here.join("proj")).unwrap();
    }
    // What is not in the way stays, from run to run.
    let beside =
        ["proj/frames/photo.jpg", "proj/spectra.csv", "proj/sway_old.svg", "proj/report/a.html"];
    beside.iter().for_each(|name| put(here, name, "mine"));
    for args in [&drawn, &drawn[..], &run] {
        good(here, args);
        assert!(
            here.join("proj/frames/0000.vtu").is_file() && here.join("proj/sway.svg").is_file()
        );
    }
    good(here, &[&run[..], &["--no-report"]].concat());
    assert!(!here.join("proj/report.html").exists());
    put(here, "proj/report.html", "mine");
    good(here, &[&run[..], &["--no-report"]].concat());
    refused(here, &run, "proj/report.html", FOREIGN);
    for name in beside.iter().chain(&["proj/report.html"]) {
        assert_eq!(read(here, name), "mine", "{name}");
    }
}

#[test]
fn a_run_knows_the_folder_of_one_before_by_its_summary() {
    let folder = folder();
    let here = folder.path();
    let run = ["run", "swing.ron", "--out", "a"];
    good(here, &run);
    // As from a copy without hidden files.
    std::fs::remove_file(here.join("a/.trilith.files")).unwrap();
    good(here, &run);
    std::fs::remove_file(here.join("a/.trilith.files")).unwrap();
    put(here, "a/summary.json", "{}");
    refused(here, &run, "a/summary.json", FOREIGN);
}

#[test]
fn commands_do_not_replace_the_files_of_each_other() {
    let folder = folder();
    let here = folder.path();
    good(here, &["sweep", "study.ron", "--out", "of_study"]);
    refused(here, &["run", "swing.ron", "--out", "of_study"], "of_study/made_by.json", FOREIGN);
    good(here, &["run", "swing.ron", "--out", "of_run"]);
    refused(here, &["sweep", "study.ron", "--out", "of_run"], "of_run/made_by.json", FOREIGN);
    put(here, "peaks.txt", MOTION);
    refused(here, &["record", "peaks.txt", "--out", "of_run"], "of_run/peaks.csv", FOREIGN);
}

#[test]
fn records_replace_nothing_but_those_before() {
    let folder = folder();
    let here = folder.path();
    let args = ["record", "in.txt", "--out", "."];
    put(here, "in.csv", "mine");
    refused(here, &args, "in.csv", FOREIGN);
    assert!(!here.join("record.html").exists());
    std::fs::remove_file(here.join("in.csv")).unwrap();
    good(here, &args);
    good(here, &args);
    // What was made of one is the input of another, and of the same name.
    refused(here, &["record", "in.csv", "--out", "."], "in.csv", INPUT);
    assert!(read(here, "in.csv").contains("0.1"));
}

#[test]
fn studies_replace_nothing_but_those_before() {
    let folder = folder();
    let here = folder.path();
    put(here, "study.html", STUDY);
    refused(here, &["sweep", "study.html", "--out", "."], "study.html", INPUT);
    put(here, "table.csv", MODEL);
    put(here, "of_table.ron", &STUDY.replace("swing.ron", "table.csv"));
    std::fs::remove_file(here.join("study.html")).unwrap();
    refused(here, &["sweep", "of_table.ron", "--out", "."], "table.csv", INPUT);
    // A record, and something else.
    put(here, "table.csv", RECORD);
    let of_record = r#"(model: "swing.ron", axes: { "record": ["shake.csv", "table.csv"] })"#;
    put(here, "of_record.ron", of_record);
    refused(here, &["sweep", "of_record.ron", "--out", "."], "table.csv", FOREIGN);
    refused(here, &["sweep", "study.ron", "--out", "."], "table.csv", FOREIGN);
    let drawn = STUDY.replace("axes", "figures: [Points(x: \"k\", y: \"sway\")], axes");
    let drawn = drawn.replace(")]", ")], columns: { \"sway\": Peak(\"sway\") }");
    put(here, "drawn.ron", &drawn);
    put(here, "d/figure_1_runs.svg", "mine");
    let args = ["sweep", "drawn.ron", "--out", "d", "--figure-format", "svg"];
    refused(here, &args, "d/figure_1_runs.svg", FOREIGN);
    put(here, "d/runs/mine.txt", "mine");
    let kept = drawn.replace("figures:", "histories: Above(\"sway\", \"1 mm\"), figures:");
    put(here, "kept.ron", &kept);
    refused(here, &["sweep", "kept.ron", "--out", "d"], "d/runs", FOREIGN);
    assert!(!here.join("runs.journal").exists() && !here.join("d/runs.journal").exists());
    // Without them nothing is in the way, also of the same study again.
    for _ in 0..2 {
        good(here, &["sweep", "drawn.ron", "--out", "d"]);
    }
    assert_eq!(read(here, "d/figure_1_runs.svg") + &read(here, "d/runs/mine.txt"), "minemine");
}

#[test]
fn exercises_and_comparisons_keep_what_they_read() {
    let folder = folder();
    let here = folder.path();
    put(here, "path.csv", "t [s],U1 [mm]\n0,0\n1,1\n2,0\n");
    let follow = ["exercise", "Hook", "--history", "path.csv", "--out", "."];
    refused(here, &follow, "path.csv", INPUT);
    refused(here, &["exercise", "Hook", "--out", "."], "path.csv", FOREIGN);
    assert!(!here.join("loop.svg").exists());
    let compare = ["--solvers", "fna,hht", "--no-cause", "--out"];
    put(here, "compare.html", MODEL);
    let args = [&["compare", "compare.html"], &compare[..], &["."]].concat();
    refused(here, &args, "compare.html", INPUT);
    let args = [&["compare", "swing.ron"], &compare[..], &["."]].concat();
    refused(here, &args, "compare.html", FOREIGN);
    let into = [&["compare", "swing.ron"], &compare[..], &["c"]].concat();
    for args in [&["exercise", "Hook"][..], &into] {
        good(here, args);
        good(here, args);
    }
    assert!(here.join("c/compare.html").is_file());
    assert!(here.join("out/exercise_Hook/loop.svg").is_file());
}

/// The folder is looked at before the runs, which have something to say here.
#[test]
fn a_comparison_looks_at_its_folder_first() {
    let folder = folder();
    let here = folder.path();
    put(here, "beyond.ron", &MODEL.replace("scale: \"1 m/s^2\"", "scale: \"1e300 m/s^2\""));
    let args = ["compare", "beyond.ron", "--no-cause"];
    let (_, _, said) = trilith(here, &args);
    assert!(said.contains("no finite number"), "{said}");
    let (status, out, err) = trilith(here, &[&args[..], &["--out", "in.txt"]].concat());
    assert_eq!((status, out.as_str()), (2, ""), "{err}");
    assert!(err.contains("in.txt is a file, no folder") && !err.contains("finite"), "{err}");
}

#[test]
fn runs_that_answer_otherwise_have_folders_of_their_own() {
    let folder = folder();
    let here = folder.path();
    for (args, place) in [
        (&[][..], "out/swing"),
        (&["--solver", "hht"], "out/swing/solver=hht"),
        (&["--dt", "0.020"], "out/swing/dt=0.02"),
        (&["--case", "nudge"], "out/swing/case=nudge"),
        (&["--solver", "hht", "--set", "k=9.87 N/m"], "out/swing/k=9.87_N_m,solver=hht"),
        (&["--checkpoint-at", "0.5"], "out/swing/checkpoint-at=0.5"),
        (&["--restart", "out/swing/checkpoint-at=0.5/checkpoint.json"], "out/swing/restart=0.5"),
        // What is shown beside the answer does not change it.
        (&["--figure", "sway", "--loops", "stop"], "out/swing"),
        (&["--no-report"], "out/swing"),
    ] {
        let out = good(here, &[&["run", "swing.ron"], args].concat());
        assert!(out.contains(&format!("files: {place}\n")), "{args:?}\n{out}");
        assert!(here.join(place).join("summary.json").is_file(), "{place}");
    }
    let (_, help, _) = trilith(here, &["run", "--help"]);
    let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("below it what was set, such as mu=0.4,solver=hht"), "{help}");
    // A run that goes on keeps the checkpoint that it comes from.
    let args = ["run", "swing.ron", "--restart", "out/swing/checkpoint-at=0.5/checkpoint.json"];
    let args = [&args[..], &["--out", "out/swing/checkpoint-at=0.5"]].concat();
    refused(here, &args, "out/swing/checkpoint-at=0.5/checkpoint.json", INPUT);
}

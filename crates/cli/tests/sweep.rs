//! Studies from outside: killed at any moment, refused, on a full disk.

#[path = "common/sliding.rs"]
mod sliding;

use std::collections::HashSet;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

fn folder(side: usize) -> tempfile::TempDir {
    sliding::folder(side, "0.6 s", "")
}

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    command.current_dir(folder).args(["sweep", "study.ron"]).args(args);
    command
}

/// Exit status, stdout, stderr.
fn sweep(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let output = command(folder, args).output().unwrap();
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn lines(journal: &Path) -> usize {
    std::fs::read(journal).map_or(0, |b| b.iter().filter(|b| **b == b'\n').count())
}

/// Kills a study again and again, each time after some further runs, and lets it end.
fn killed_and_resumed(side: usize, kills: usize) {
    let folder = folder(side);
    let here = folder.path();
    let (status, _, err) = sweep(here, &["--out", "whole", "--threads", "2"]);
    assert_eq!(status, 0, "{err}");
    let journal = here.join("broken/runs.journal");
    let all = side * side;
    let mut seed = 12_345u64;
    for kill in 0..kills {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let before = lines(&journal);
        // A kill at any moment: after a random number of runs, then after a random part of a millisecond.
        let more = (seed >> 40) as usize % (all / (kills + 1)).max(1);
        let mut child = command(here, &["--out", "broken", "--threads", "2"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let start = Instant::now();
        while lines(&journal) < before + more && start.elapsed() < Duration::from_secs(120) {
            std::thread::sleep(Duration::from_micros(300));
        }
        std::thread::sleep(Duration::from_micros((seed >> 20) % 2000));
        child.kill().unwrap();
        child.wait().unwrap();
        eprintln!("kill {kill}: {} lines", lines(&journal));
    }
    let before = lines(&journal);
    assert!(before > 1 && before < all + 1, "killed too early or too late: {before}");
    let (status, out, err) = sweep(here, &["--out", "broken", "--threads", "1"]);
    assert_eq!(status, 0, "{err}");
    assert!(out.contains("were on disk"), "{out}");
    for name in ["table.parquet", "table.csv", "study.html"] {
        let read = |folder: &str| std::fs::read(here.join(folder).join(name)).unwrap();
        assert!(read("whole") == read("broken"), "{name} differs");
    }
    // No run is in the journal twice: only runs in flight were made again.
    let text = std::fs::read_to_string(&journal).unwrap();
    let run = |l: &str| l.split("\"run\":").nth(1).unwrap().split(',').next().unwrap().to_owned();
    let runs: Vec<String> = text.lines().skip(1).map(run).collect();
    assert_eq!(runs.len(), all);
    assert_eq!(runs.iter().collect::<HashSet<_>>().len(), all);
}

#[test]
fn a_study_killed_at_random_moments_ends_with_the_same_table() {
    killed_and_resumed(20, 4);
}

#[test]
fn ten_thousand_runs_killed_at_random_moments_end_with_the_same_table() {
    killed_and_resumed(100, 6);
}

#[test]
fn a_study_prints_what_it_did_and_a_dry_run_does_nothing() {
    let folder = folder(3);
    let here = folder.path();
    let (status, out, err) = sweep(here, &["--dry-run"]);
    assert_eq!(status, 0, "{err}");
    for part in ["Sliding mass", "axis", "mu", "runs: 9"] {
        assert!(out.contains(part), "{part} in\n{out}");
    }
    assert!(!here.join("out").exists());
    let (status, out, err) = sweep(here, &["--set", "mu=0.1"]);
    assert_eq!(status, 0, "{err}");
    assert!(out.contains("converged     3") || out.contains("converged  3"), "{out}");
    assert!(here.join("out/study/table.parquet").is_file());
    // The same folder with another value of the parameter is another study.
    let (status, _, err) = sweep(here, &["--set", "mu=0.2"]);
    assert!(status == 2 && err.contains("runs of another study") && err.contains("--out"), "{err}");
}

#[test]
fn wrong_studies_are_shown_with_their_lines() {
    let folder = folder(3);
    let here = folder.path();
    let text = std::fs::read_to_string(here.join("study.ron")).unwrap();
    std::fs::write(here.join("study.ron"), text.replace("\"mu\":", "\"mue\":")).unwrap();
    let (status, out, err) = sweep(here, &[]);
    assert_eq!((status, out.as_str()), (2, ""));
    for part in ["study.ron:5:", "no parameter `mue`", "did you mean `mu`?", "^"] {
        assert!(err.contains(part), "{part} in\n{err}");
    }
    let (status, _, err) = sweep(here, &["--set", "nu=1"]);
    assert!(status == 2 && err.contains("--set nu=1"), "{err}");
}

/// A limit on the size of files stands for a disk without room: the last line is cut in two.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_and_the_study_goes_on_when_there_is_room() {
    let folder = folder(10);
    let here = folder.path();
    let script = "ulimit -f 8; trap '' XFSZ; exec \"$0\" sweep study.ron --out full";
    let limited = ["-c", script, env!("CARGO_BIN_EXE_trilith")];
    let output = Command::new("bash").current_dir(here).args(limited).output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{err}");
    assert!(err.contains("runs.journal cannot be written"), "{err}");
    let journal = std::fs::read(here.join("full/runs.journal")).unwrap();
    let kept = lines(&here.join("full/runs.journal"));
    assert!(kept > 10 && kept < 101 && journal.ends_with(b"\n"), "{kept}");
    let (status, out, err) = sweep(here, &["--out", "full"]);
    assert_eq!(status, 0, "{err}");
    assert!(out.contains(&format!("{} were on disk", kept - 1)), "{out}");
    sweep(here, &["--out", "whole"]);
    let table = |folder: &str| std::fs::read(here.join(folder).join("table.parquet")).unwrap();
    assert!(table("full") == table("whole"));
}

#[test]
fn figures_of_a_study_are_files_on_request() {
    let folder = folder(3);
    let path = folder.path().join("study.ron");
    let (status, _, err) = sweep(folder.path(), &["--figure-format", "svg"]);
    assert!(status == 2 && err.contains("no figures") && err.contains("figures: ["), "{err}");
    assert!(!folder.path().join("out").exists());
    let figures =
        r#"figures: [Points(x: "a", y: "slide", by: "mu"), Points(x: "mu", y: "heat")], columns:"#;
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replace("columns:", figures)).unwrap();
    let (status, out, err) = sweep(folder.path(), &["--figure-format", "svg"]);
    assert_eq!(status, 0, "{err}");
    let page = std::fs::read_to_string(folder.path().join("out/study/study.html")).unwrap();
    for name in ["figure_1_runs.svg", "figure_2_runs.svg"] {
        assert!(out.contains(name), "{out}");
        let svg = std::fs::read_to_string(folder.path().join("out/study").join(name)).unwrap();
        assert!(svg.starts_with("<svg") && page.contains(&svg), "{name} is not that of the page");
    }
    if !cfg!(feature = "png") {
        let (status, _, err) = sweep(folder.path(), &["--figure-format", "png"]);
        assert!(status == 2 && err.contains("--features png"), "{err}");
    }
}

/// Runs that do not come to a trusted end: their rows say why, the others are kept, the status is 1.
#[test]
fn runs_that_fail_are_rows_and_make_the_status_one() {
    let folder = folder(3);
    let here = folder.path();
    let model = sliding::model("0.6 s").replace("energy_limit: 0.5", "energy_limit: \"limit\"");
    let model = model.replace("\"mu\": 0.3,", "\"mu\": 0.3, \"limit\": 0.5,");
    std::fs::write(here.join("mass.ron"), model).unwrap();
    let study = r#"(model: "mass.ron", axes: { "a": [3, 4, 5], "limit": [0.5, 1e-300] })"#;
    std::fs::write(here.join("study.ron"), study).unwrap();
    let (status, out, err) = sweep(here, &[]);
    assert_eq!(status, 1, "{out}{err}");
    assert!(
        out.contains("run 2: energy error") && err.contains("3 of 6 runs failed"),
        "{out}{err}"
    );
    let table = std::fs::read_to_string(here.join("out/study/table.csv")).unwrap();
    assert_eq!(table.lines().filter(|l| l.contains("is unaccounted for")).count(), 3, "{table}");
    assert_eq!(table.lines().filter(|l| l.contains(",converged,")).count(), 3, "{table}");
}

/// Records that cannot be used are all told, at their place in the study, with the line of the record.
#[test]
fn bad_records_of_a_study_are_told_with_both_lines() {
    let folder = folder(3);
    let here = folder.path();
    let sine = "Sine(amplitude: \"a\", frequency: \"2 Hz\", cycles: 1)";
    let record = "Record(file: Parameter(\"record\"), scale_to: \"a\")";
    let model = sliding::model("0.6 s")
        .replace(sine, record)
        .replace("\"mu\": 0.3,", "\"mu\": 0.3, \"record\": Text(\"good.at2\"),");
    std::fs::write(here.join("mass.ron"), model).unwrap();
    // Made here: a sine of 100 samples in the layout of AT2 files.
    let at2 = |head: &str, unit: &str| {
        let numbers = (0..100).map(|i| format!("{:15.7E}", (0.2 * f64::from(i)).sin()));
        let numbers: Vec<String> = numbers.collect();
        let lines: Vec<String> = numbers.chunks(5).map(<[String]>::concat).collect();
        format!(
            "PEER\nMade for a test\nACCELERATION TIME SERIES{unit}\n{head}\n{}\n",
            lines.join("\n")
        )
    };
    let (head, unit) = ("NPTS=   100, DT=   .0100 SEC,", " IN UNITS OF G");
    let good = at2(head, unit);
    for (name, text) in [
        ("good", good.clone()),
        ("count", at2("NPTS=   105, DT=   .0100 SEC,", unit)),
        ("step", at2("NPTS=   100", unit)),
        ("unit", at2(head, "")),
        ("number", good.replacen("0.0000000E0", "        NaN", 1)),
        ("cut", good[..good.len() / 2].to_owned()),
        ("binary", "\0\u{1}\u{2}".repeat(99)),
    ] {
        std::fs::write(here.join(name.to_owned() + ".at2"), text).unwrap();
    }
    let study = r#"(
    model: "mass.ron",
    axes: { "record": [
        "good.at2",
        "count.at2",
        "step.at2",
        "unit.at2",
        "number.at2",
        "cut.at2",
        "binary.at2",
    ] },
)"#;
    std::fs::write(here.join("study.ron"), study).unwrap();
    let (status, out, err) = sweep(here, &[]);
    assert_eq!((status, out.as_str()), (2, ""));
    for (line, told) in [
        (5, "count.at2:24: the file ends after 100 of 105 values"),
        (6, "step.at2:4: the time step is stated nowhere"),
        (7, "unit.at2: the unit of the acceleration is stated nowhere"),
        (8, "number.at2:5:13: `NaN` is no finite number"),
        (9, "of 100 values"),
        (10, "binary.at2 is a binary file"),
    ] {
        assert!(
            err.contains(&format!("study.ron:{line}:9")) && err.contains(told),
            "{line} {told}\n{err}"
        );
    }
    assert!(
        err.contains("6 errors") && err.contains("met at") && err.contains("mass.ron:"),
        "{err}"
    );
}

/// Runs a part until its journal has some lines, and kills it.
fn kill_part(here: &Path, part: &str, journal: &Path) {
    let before = lines(journal);
    let mut child = command(here, &["--out", "parts", "--threads", "1", "--shard", part])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while lines(journal) < before + 20 && start.elapsed() < Duration::from_secs(120) {
        std::thread::sleep(Duration::from_micros(300));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Twenty parts in any order, some at the same time, three of them killed and begun again: the tables of one process.
#[test]
fn parts_that_run_on_their_own_make_the_same_tables() {
    let (side, of) = (100, 20);
    let folder = folder(side);
    let here = folder.path();
    let (status, out, err) = sweep(here, &["--out", "parts", "--status"]);
    assert!(status == 0 && out.contains("no part has begun"), "{out}{err}");
    let (status, _, err) = sweep(here, &["--out", "parts", "--gather"]);
    assert!(status == 2 && err.contains("there are no runs in"), "{err}");
    let journal = |i: usize| here.join(format!("parts/runs.{i}-of-{of}.journal"));
    for i in [4, 11, 17] {
        kill_part(here, &format!("{i}/{of}"), &journal(i));
        let found = lines(&journal(i));
        assert!(found > 1 && found < side * side / of + 1, "killed too early or too late: {found}");
    }
    let (status, out, _) = sweep(here, &["--out", "parts", "--status"]);
    assert!(status == 0 && out.contains("11/20") && out.contains("series of runs to go"), "{out}");
    let (status, _, err) = sweep(here, &["--out", "parts", "--gather"]);
    assert!(
        status == 2 && err.contains("runs are missing in") && err.contains("--status"),
        "{err}"
    );
    assert!(!here.join("parts/table.csv").exists());
    // 7 and 20 have no common divisor: all of them, in an order that is none.
    for two in (0..of).map(|i| 1 + 7 * i % of).collect::<Vec<_>>().chunks(2) {
        let start = |i: &usize| {
            let part = format!("{i}/{of}");
            let mut command =
                command(here, &["--out", "parts", "--threads", "1", "--shard", &part]);
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
        };
        for child in two.iter().map(start).collect::<Vec<_>>() {
            let output = child.wait_with_output().unwrap();
            let told = String::from_utf8(output.stdout).unwrap();
            assert!(output.status.success() && told.contains("--gather"), "{told}");
        }
    }
    let (status, out, _) = sweep(here, &["--out", "parts", "--status"]);
    assert!(status == 0 && out.contains("all runs are there"), "{out}");
    let (status, out, err) = sweep(here, &["--out", "parts", "--gather"]);
    assert!(status == 0 && out.contains("new runs: 0"), "{out}{err}");
    let (status, _, err) = sweep(here, &["--out", "whole", "--threads", "2"]);
    assert_eq!(status, 0, "{err}");
    for name in ["table.parquet", "table.csv", "study.html"] {
        let read = |folder: &str| std::fs::read(here.join(folder).join(name)).unwrap();
        assert!(read("whole") == read("parts"), "{name} differs");
    }
    // No finished run was made again.
    let all: usize = (1..=of).map(|i| lines(&journal(i)) - 1).sum();
    assert_eq!(all, side * side);
    // Other parts of the same study know of all of them.
    let (status, out, err) = sweep(here, &["--out", "parts", "--shard", "2/3"]);
    assert!(status == 0 && out.contains("new runs: 0"), "{out}{err}");
}

#[test]
fn a_part_that_is_none_is_refused() {
    let folder = folder(3);
    let here = folder.path();
    for wrong in ["0/4", "5/4", "x", "1/0"] {
        let (status, _, err) = sweep(here, &["--shard", wrong]);
        assert!(status == 2 && err.contains("such as `3/20`"), "{wrong}: {err}");
    }
    let (status, _, err) = sweep(here, &["--shard", "1/4", "--gather"]);
    assert!(status == 2 && err.contains("cannot be used with"), "{err}");
    // A part of another study in the same folder.
    assert_eq!(sweep(here, &["--shard", "1/4"]).0, 0);
    let (status, _, err) = sweep(here, &["--shard", "2/4", "--set", "mu=0.2"]);
    assert!(status == 2 && err.contains("runs of another study"), "{err}");
    // More parts than there are series: some have nothing to do.
    let (status, out, err) = sweep(here, &["--shard", "20/20"]);
    assert!(status == 0 && out.contains("part 20/20 is done"), "{out}{err}");
}

#[test]
fn runs_that_failed_are_made_once_more() {
    let folder = folder(3);
    let here = folder.path();
    let model = sliding::model("0.6 s").replace("energy_limit: 0.5", "energy_limit: \"limit\"");
    let model = model.replace("\"mu\": 0.3,", "\"mu\": 0.3, \"limit\": 0.5,");
    std::fs::write(here.join("mass.ron"), model).unwrap();
    let study = r#"(model: "mass.ron", axes: { "a": [3, 4, 5], "limit": [0.5, 1e-300] })"#;
    std::fs::write(here.join("study.ron"), study).unwrap();
    assert_eq!(sweep(here, &[]).0, 1);
    let read = || std::fs::read_to_string(here.join("out/study/table.csv")).unwrap();
    let (before, journal) = (read(), here.join("out/study/runs.journal"));
    assert_eq!(lines(&journal), 1 + 6);
    let (status, out, _) = sweep(here, &["--status"]);
    assert!(status == 0 && out.lines().any(|l| l.contains("whole") && l.contains('3')), "{out}");
    let (status, out, _) = sweep(here, &["--retry-failed"]);
    assert!(status == 1 && out.contains("new runs: 3"), "{out}");
    assert_eq!(lines(&journal), 1 + 9);
    assert_eq!(read(), before);
}

//! What the program says, where it goes, and what of it a terminal would obey.

use std::path::Path;
use std::process::{Command, Output, Stdio};

/// A swinging mass with names that are no plain ones.
const MODEL: &str = r#"(
    title: "A \u{1b}[31mred\u{7} mass\nstatus  converged",
    plane: XZ,
    nodes: { "top": (0, 0, 1), "base": (0, 0, 0) },
    supports: { "base": Fixed },
    elements: {
        "mass": Mass(node: "top", mass: "1 kg"),
        "spring": Spring(nodes: ("base", "top"), k1: "1 kN/m", k2: "40 N/m", r2: 1, r3: 1),
        "stop, left": Gap(nodes: ("base", "top"), k: "1 kN/m", opening: "1 cm"),
    },
    cases: {
        "swing": Dynamic(
            duration: "1 s", dt: "0.01 s",
            initial: [(node: "top", dof: Ux, displacement: "2 cm")],
        ),
    },
    outputs: {
        "sway": Displacement(node: "top", dof: Ux),
        "a, b": Velocity(node: "top", dof: Ux),
        "=c\u{1b}]0;x\u{9b}": Velocity(node: "top", dof: Ux),
    },
)"#;

/// A motion beyond all numbers, and no link.
const BEYOND: &str = r#"(
    plane: XZ,
    nodes: { "top": (0, 0, 1), "base": (0, 0, 0) },
    supports: { "base": Fixed },
    elements: {
        "mass": Mass(node: "top", mass: "1 kg"),
        "spring": Spring(nodes: ("base", "top"), k1: "1 kN/m", k2: "40 N/m", r2: 1, r3: 1),
    },
    functions: { "f": Sine(amplitude: "1e300 m/s^2", frequency: "2 Hz", cycles: 1) },
    cases: { "c": Dynamic(duration: "1 s", dt: "0.01 s", base: [(direction: X, function: "f")]) },
    outputs: { "sway": Displacement(node: "top", dof: Ux) },
)"#;

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("swing.ron", MODEL), ("beyond.ron", BEYOND)] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    command.current_dir(folder).args(args);
    command
}

/// Exit status, stdout, stderr.
fn said(output: Output) -> (i32, String, String) {
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn trilith(folder: &Path, args: &[&str]) -> (i32, String, String) {
    said(command(folder, args).output().unwrap())
}

/// A file that takes nothing.
#[cfg(target_os = "linux")]
fn full() -> Stdio {
    std::fs::File::options().write(true).open("/dev/full").unwrap().into()
}

#[cfg(target_os = "linux")]
#[test]
fn an_answer_that_cannot_be_printed_is_an_error() {
    let folder = folder();
    for args in [
        &["run", "swing.ron", "--no-files"][..],
        &["check", "swing.ron"],
        &["modes", "swing.ron"],
        &["elements"],
        &["generate", "frame"],
        &["--help"],
        &["run", "--help"],
        &["--version"],
    ] {
        let output = command(folder.path(), args).stdout(full()).stderr(Stdio::piped()).spawn();
        let (status, _, err) = said(output.unwrap().wait_with_output().unwrap());
        assert_eq!(status, 1, "{args:?}: {err}");
        assert!(err.contains("the answer cannot be printed: No space left"), "{args:?}: {err}");
    }
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = folder();
    for args in [&["elements"][..], &["--help"], &["run", "swing.ron", "--no-files"]] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let child = command(folder.path(), args).stdout(writer).stderr(Stdio::piped()).spawn();
        let (status, _, err) = said(child.unwrap().wait_with_output().unwrap());
        assert_eq!((status, err.as_str()), (0, ""), "{args:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn warnings_that_nobody_takes_end_no_run() {
    let folder = folder();
    let status = command(folder.path(), &["run", "beyond.ron", "--no-files"])
        .stdout(Stdio::null())
        .stderr(full())
        .status()
        .unwrap();
    assert_eq!(status.code(), Some(1));
}

/// True of a text that changes nothing but the letters on a terminal.
fn is_plain(text: &str) -> bool {
    !text.contains(|c: char| c.is_control() && c != '\n')
}

#[test]
fn a_terminal_obeys_nothing_that_names_hold() {
    let folder = folder();
    let here = folder.path();
    for args in [
        &["run", "swing.ron", "--out", "o\u{1b}ut", "--figure", "=c\u{1b}]0;x\u{9b}"][..],
        &["check", "swing.ron"],
        &["modes", "swing.ron"],
        &["compare", "swing.ron", "--no-cause"],
    ] {
        let (status, out, err) = trilith(here, args);
        assert_eq!(status, 0, "{args:?}: {out}{err}");
        assert!(is_plain(&out) && is_plain(&err), "{args:?}: {out:?}{err:?}");
        assert!(out.contains("A \\u{1b}[31mred\\u{7} mass\\nstatus"), "{args:?}: {out}");
    }
    let (_, out, _) = trilith(here, &["run", "swing.ron", "--no-files"]);
    assert_eq!(out.lines().filter(|l| l.starts_with("status")).count(), 1, "{out}");
    for args in [
        &["run", "no\u{1b}ne\u{9b}.ron"][..],
        &["run", "swing.ron", "--case", "\u{1b}[31m\u{9b}"],
        &["run", "swing.ron", "--set", "\u{1b}[31m\u{9b}=1"],
        &["run", "swing.ron", "--figure", "s\u{1b}way, x"],
        &["run", "swing.ron", "--solver", "\u{1b}[31m\u{9b}"],
    ] {
        let (status, out, err) = trilith(here, args);
        assert_eq!((status, out.as_str()), (2, ""), "{args:?}");
        assert!(is_plain(&err), "{args:?}: {err:?}");
    }
    let svgs = std::fs::read_dir(here.join("o\u{1b}ut")).unwrap().map(|e| e.unwrap().path());
    let pages = svgs.filter(|p| p.extension().is_some_and(|e| e == "svg" || e == "html"));
    let pages: Vec<String> = pages.map(|p| std::fs::read_to_string(p).unwrap()).collect();
    assert_eq!(pages.len(), 2);
    for page in pages {
        assert!(!page.contains(['\u{1b}', '\u{7}', '\u{9b}']) && page.contains("\\u{1b}]0;x"));
    }
}

#[test]
fn values_that_are_no_numbers_are_called_so() {
    let folder = folder();
    let (status, _, err) = trilith(folder.path(), &["run", "beyond.ron", "--no-files"]);
    assert_eq!(status, 1, "{err}");
    assert!(err.contains("the structure has values that are no finite numbers"), "{err}");
    assert!(!err.contains("NaN") && !err.contains('?'), "{err}");
}

#[test]
fn names_with_commas_are_named_in_quotes() {
    let folder = folder();
    let run = ["run", "swing.ron", "--figure", "\"a, b\",sway", "--figure", "energy"];
    let args = [&run[..], &["--loops", "\"stop, left\""]].concat();
    let (status, out, err) = trilith(folder.path(), &args);
    assert_eq!(status, 0, "{out}{err}");
    let figures = out.lines().filter(|l| l.starts_with("figure: ")).count();
    assert!(figures >= 3 && out.contains("sway.svg") && out.contains("energy.svg"), "{out}");
    for (option, name) in [("--loops", "stop, left"), ("--figure", "a, b")] {
        let (status, out, err) = trilith(folder.path(), &["run", "swing.ron", option, name]);
        assert_eq!((status, out.as_str()), (2, ""), "{err}");
        assert!(err.contains(&format!("`{option} '\"{name}\"'`")), "{err}");
    }
    let (_, help, _) = trilith(folder.path(), &["run", "--help"]);
    let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("double quotes hold a name with a comma together"), "{help}");
}

/// A study that a signal ends has said before how it goes on, and does.
#[cfg(unix)]
#[test]
fn a_study_that_is_told_to_end_goes_on_with_the_same_command() {
    use std::io::{BufRead, BufReader};
    let folder = folder();
    let here = folder.path();
    let model = MODEL.replace("duration: \"1 s\"", "duration: \"long\"");
    let model = model.replace("plane: XZ,", "plane: XZ, parameters: { \"long\": \"1 s\" },");
    std::fs::write(here.join("swing.ron"), model).unwrap();
    let study = r#"(
    model: "swing.ron",
    axes: { "long": Range(from: "4 s", to: "5 s", count: 3000) },
    columns: { "sway": Peak("sway") },
    histories: Above("sway", "1 km"), // which none is: the runs go one by one, and last
)"#;
    std::fs::write(here.join("study.ron"), study).unwrap();
    let args = ["sweep", "study.ron", "--threads", "1"];
    let mut child =
        command(here, &args).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(child.stderr.take().unwrap()).read_line(&mut line).unwrap();
    let told = "finished runs are kept in out/study: stopped at any time, the same command goes on";
    assert_eq!(line.trim_end(), told);
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-TERM", &id]).status().unwrap().success());
    assert!(!child.wait().unwrap().success());
    let (status, out, err) = trilith(here, &["sweep", "study.ron"]);
    assert_eq!(status, 0, "{out}{err}");
    assert!(out.contains("were on disk"), "{out}");
}

//! What the files of a run say of themselves, and what becomes of those that were altered or mixed up.

use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;

/// A mast under a record, with a case that nothing moves in and one that starts elsewhere.
const MODEL: &str = r#"(
    title: "A mast",
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
        "still": Static(loads: []),
        "nudge": Dynamic(
            duration: "1 s", dt: "0.01 s",
            initial: [(node: "top", dof: Ux, displacement: "1 cm")],
        ),
        "swing": Dynamic(
            duration: "1 s", dt: "0.01 s", base: [(direction: X, function: "shake")],
            initial: [(node: "top", dof: Ux, displacement: "2 cm")],
        ),
    },
    outputs: { "sway": Displacement(node: "top", dof: Ux) },
)"#;

const RECORD: &str = "t,a\n0,0\n0.2,1\n0.4,0\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mast.ron"), MODEL).unwrap();
    std::fs::write(folder.path().join("shake.csv"), RECORD).unwrap();
    folder
}

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    command.current_dir(folder).env_remove("SOURCE_DATE_EPOCH").args(args);
    command
}

/// Exit status, stdout, stderr.
fn done(mut command: Command) -> (i32, String, String) {
    let output = command.output().unwrap();
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn trilith(folder: &Path, args: &[&str]) -> (i32, String, String) {
    done(command(folder, args))
}

/// Runs what must succeed.
fn good(folder: &Path, args: &[&str]) {
    let (status, out, err) = trilith(folder, args);
    assert_eq!(status, 0, "{args:?}\n{out}{err}");
}

/// What is said against arguments that must be refused, without anything being printed as a result.
fn refused(folder: &Path, args: &[&str]) -> String {
    let (status, out, err) = trilith(folder, args);
    assert_eq!((status, out.as_str()), (2, ""), "{args:?}\n{err}");
    err
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

/// SHA-256 of a file, hexadecimal.
fn sha256(path: &Path) -> String {
    trilith::results::sha256(&std::fs::read(path).unwrap())
}

#[test]
fn an_altered_checkpoint_is_refused() {
    let folder = folder();
    let here = folder.path();
    good(here, &["run", "mast.ron", "--out", "half", "--checkpoint-at", "0.5"]);
    let text = std::fs::read_to_string(here.join("half/checkpoint.json")).unwrap();
    let whole: Value = serde_json::from_str(&text).unwrap();
    let digits: Vec<usize> =
        text.match_indices(|c: char| c.is_ascii_digit()).map(|d| d.0).collect();
    let mut tried = 0;
    for at in digits.iter().copied().step_by(digits.len() / 60) {
        let digit = (text.as_bytes()[at] - b'0' + 1) % 10;
        let altered = format!("{}{digit}{}", &text[..at], &text[at + 1..]);
        // The last digit of a number may say nothing.
        if serde_json::from_str::<Value>(&altered).is_ok_and(|value| value == whole) {
            continue;
        }
        std::fs::write(here.join("altered.json"), &altered).unwrap();
        let err = refused(here, &["run", "mast.ron", "--no-files", "--restart", "altered.json"]);
        assert!(err.contains("the checkpoint altered.json"), "digit {at}\n{err}");
        tried += 1;
    }
    assert!(tried > 40, "{tried}");
    for (from, to, told) in [
        ("\"time\":0.5", "\"time\":0.6", "is not as it was written: its `sha256` is"),
        ("\"format\":2", "\"format\":3", "has format 3, this program reads format 2"),
        ("\"format\":2,", "", "states no format"),
    ] {
        let altered = text.replacen(from, to, 1);
        assert_ne!(altered, text, "{from}");
        std::fs::write(here.join("altered.json"), &altered).unwrap();
        let err = refused(here, &["run", "mast.ron", "--no-files", "--restart", "altered.json"]);
        assert!(err.contains(told) && err.contains("--checkpoint-at"), "{from}\n{err}");
    }
}

#[test]
fn a_checkpoint_of_another_case_is_refused_whatever_the_case() {
    let folder = folder();
    let here = folder.path();
    good(here, &["run", "mast.ron", "--out", "half", "--checkpoint-at", "0.5"]);
    let restart = ["run", "mast.ron", "--no-files", "--restart", "half/checkpoint.json"];
    good(here, &restart);
    for case in ["still", "nudge"] {
        let err = refused(here, &[&restart[..], &["--case", case]].concat());
        let told = format!("its case is swing, this run's is {case}");
        assert!(err.contains(&told), "{err}");
    }
    let args = ["run", "mast.ron", "--case", "still", "--checkpoint-at", "0.5"];
    let err = refused(here, &args);
    assert!(err.contains("the case still is static: it has no time to stop at"), "{err}");
    assert!(!here.join("out").exists());
}

#[test]
fn a_report_is_made_of_files_that_belong_together_alone() {
    let folder = folder();
    let here = folder.path();
    good(here, &["run", "mast.ron", "--out", "one"]);
    good(here, &["run", "mast.ron", "--out", "two", "--set", "k=50 N/m"]);
    good(here, &["run", "mast.ron", "--out", "other", "--case", "nudge"]);
    let read = |name: &str| std::fs::read_to_string(here.join(name)).unwrap();
    let (summary, data) = (read("one/summary.json"), read("one/report.json"));
    let page = read("one/report.html");
    // What becomes of a summary and a `report.json` in one folder.
    let told = |summary: &str, data: &str| {
        std::fs::write(here.join("one/summary.json"), summary).unwrap();
        std::fs::write(here.join("one/report.json"), data).unwrap();
        refused(here, &["report", "one"])
    };
    let changed = |from: &str, to: &str| {
        assert!(summary.contains(from), "{from} in\n{summary}");
        summary.replacen(from, to, 1)
    };
    let version = format!("\"version\": \"{}\"", trilith::VERSION);
    let hash = sha256(&here.join("mast.ron"));
    for (summary, data, parts) in [
        (&*summary, &*read("other/report.json"), &["two runs: the case", "swing", "nudge"][..]),
        (&*summary, &*read("two/report.json"), &["two runs: the `run_sha256`"]),
        (&*changed(&version, "\"version\": \"9.9.9\""), &*data, &["the version", "is 9.9.9"]),
        (&*changed(&hash, "00"), &*data, &["the SHA-256 of the model", "is 00"]),
        (&*changed("\"max\": ", "\"max\": 1"), &*data, &["summary.json is not as it was"]),
        ("{}", &*data, &["summary.json is incomplete: it has no version, build"]),
        ("[", &*data, &["summary.json is not what this program writes"]),
        (&*summary, "{}", &["report.json is incomplete: it has no format"]),
        (&*summary, "{\"format\": 2}", &["report.json has format 2, this program reads format 6"]),
        (&*summary, "{\"format\": 6}", &["report.json is incomplete: it has no sha256"]),
        (&*summary, &data.replacen("\"n\":[", "\"n\":[1", 1), &["report.json is not as it was"]),
        (&*summary, &data.replacen("\"sha256\":\"", "\"sha256\":\"0", 1), &["its `sha256` is 0"]),
        (&*summary, &data[..data.len() / 2], &["report.json is not what this program writes"]),
    ] {
        let err = told(summary, data);
        for part in parts.iter().chain(&["trilith run"]) {
            assert!(err.contains(part), "{part} in\n{err}");
        }
    }
    assert_eq!(read("one/report.html"), page, "no page was made of them");
    std::fs::write(here.join("one/summary.json"), &summary).unwrap();
    std::fs::write(here.join("one/report.json"), &data).unwrap();
    good(here, &["report", "one"]);
    assert_eq!(read("one/report.html"), page);
}

#[test]
fn the_folder_of_a_run_says_what_made_it() {
    let folder = folder();
    let here = folder.path();
    let args = ["run", "mast.ron", "--out", "one", "--set", "k=50 N/m"];
    let mut fixed = command(here, &args);
    fixed.env("SOURCE_DATE_EPOCH", "1700000000");
    let (status, _, err) = done(fixed);
    assert_eq!(status, 0, "{err}");
    let summary = json(&here.join("one/summary.json"));
    let made = json(&here.join("one/made_by.json"));
    for of in [&summary, &made] {
        assert_eq!(
            (&of["version"], &of["build"]),
            (&trilith::VERSION.into(), &trilith::BUILD.into())
        );
        assert_eq!(of["parameters"]["k"]["value"], 50.0, "{of}");
        assert_eq!(of["parameters"]["k"]["unit"], "N/m", "{of}");
        assert_eq!(of["parameters"]["record"]["value"], "shake.csv", "{of}");
        assert_eq!((&of["case"], &of["solver"]), (&"swing".into(), &"fna".into()));
    }
    assert_eq!(made["run_sha256"], summary["run_sha256"]);
    assert_eq!(made["date"], "2023-11-14T22:13:20Z");
    assert_eq!(made["dt"], 0.01);
    assert_eq!(made["machine"][0], std::env::consts::ARCH);
    let line: Vec<&str> =
        made["command"].as_array().unwrap().iter().map(|a| a.as_str().unwrap()).collect();
    assert!(line[0].starts_with("trilith") && line[1..] == args, "{line:?}");
    assert_eq!(made["set"][0], "k=50 N/m");
    for (i, (what, file)) in [("model", "mast.ron"), ("data", "shake.csv")].into_iter().enumerate()
    {
        let input = &made["files"][i];
        assert_eq!((&input["what"], &input["file"]), (&what.into(), &file.into()));
        assert_eq!(input["sha256"], sha256(&here.join(file)));
    }
    // The date hangs on the day, nothing in the summary does but the work.
    good(here, &[&args[..3], &["two", "--set", "k=50 N/m"]].concat());
    let (again, later) =
        (json(&here.join("two/summary.json")), json(&here.join("two/made_by.json")));
    assert_eq!(again["run_sha256"], summary["run_sha256"]);
    assert!(later["date"].as_str().unwrap() > "2024" && later["date"] != made["date"], "{later}");
    let reports = ["one", "two"].map(|name| std::fs::read(here.join(name).join("report.json")));
    let [one, two] = reports.map(Result::unwrap);
    assert!(one == two, "the data of the report hang on the run alone");

    let mut wrong = command(here, &args);
    wrong.env("SOURCE_DATE_EPOCH", "yesterday");
    let (status, out, err) = done(wrong);
    assert_eq!((status, out.as_str()), (2, ""), "{err}");
    assert!(err.contains("SOURCE_DATE_EPOCH is `yesterday`") && err.contains("seconds"), "{err}");

    let mut wrong = command(here, &args);
    wrong.env("TRILITH_VECTORS", "128");
    let (status, out, err) = done(wrong);
    assert_eq!((status, out.as_str()), (2, ""), "{err}");
    assert!(err.contains("TRILITH_VECTORS is `128`") && err.contains("`none`"), "{err}");
}

#[test]
fn the_version_names_the_build() {
    let folder = folder();
    let (status, out, _) = trilith(folder.path(), &["--version"]);
    assert_eq!((status, out), (0, format!("trilith {}\n", trilith::LONG_VERSION)));
    assert!(trilith::LONG_VERSION.contains(trilith::BUILD));
}

#[test]
fn a_study_of_another_build_does_not_go_on() {
    let folder = folder();
    let here = folder.path();
    std::fs::write(here.join("study.ron"), r#"(model: "mast.ron", axes: { "k": [30, 40] })"#)
        .unwrap();
    good(here, &["sweep", "study.ron"]);
    let made = json(&here.join("out/study/made_by.json"));
    assert_eq!(
        (&made["build"], &made["study"]["build"]),
        (&trilith::BUILD.into(), &trilith::BUILD.into())
    );
    assert_eq!(made["files"][0]["sha256"], sha256(&here.join("study.ron")));
    assert_eq!(made["files"][1]["sha256"], sha256(&here.join("mast.ron")));
    good(here, &["sweep", "study.ron"]);

    // The first line of the journal as another build would have written it, with its sum.
    let path = here.join("out/study/runs.journal");
    let text = std::fs::read_to_string(&path).unwrap();
    let (first, rest) = text.split_once('\n').unwrap();
    let build = format!("\"build\":\"{}\"", trilith::BUILD);
    assert!(first.contains(&build), "{first}");
    let other = first[9..].replace(&build, "\"build\":\"0123456789abcdef\"");
    let sum = crc32(other.as_bytes());
    std::fs::write(&path, format!("{sum:08x} {other}\n{rest}")).unwrap();
    let err = refused(here, &["sweep", "study.ron"]);
    for part in ["the build of the program changed since", "--out"] {
        assert!(err.contains(part), "{part} in\n{err}");
    }
}

/// What a model includes is hashed with it: for the folder of a run, a restart and a study.
#[test]
fn what_a_model_includes_is_a_part_of_it() {
    let folder = folder();
    let here = folder.path();
    let parts = r#"(parameters: { "k": "40 N/m" }, loads: {})"#;
    let own = MODEL.replace(r#""k": "40 N/m", "#, "");
    let model = own.replace("plane: XZ,", r#"plane: XZ, include: ["parts.ron"],"#);
    std::fs::write(here.join("mast.ron"), &model).unwrap();
    std::fs::write(here.join("parts.ron"), parts).unwrap();
    std::fs::write(here.join("study.ron"), r#"(model: "mast.ron", axes: { "k": [30, 40] })"#)
        .unwrap();
    let run = ["run", "mast.ron", "--out", "one", "--checkpoint-at", "0.5"];
    good(here, &run);
    good(here, &["sweep", "study.ron"]);
    for (made, before) in [("one/made_by.json", 0), ("out/study/made_by.json", 1)] {
        let made = json(&here.join(made));
        for (i, (what, file)) in
            [("model", "mast.ron"), ("include", "parts.ron")].iter().enumerate()
        {
            let input = &made["files"][before + i];
            assert_eq!((&input["what"], &input["file"]), (&(*what).into(), &(*file).into()));
            assert_eq!(input["sha256"], sha256(&here.join(file)));
        }
    }
    let hash = |run: &str| json(&here.join(run).join("summary.json"))["model"]["sha256"].clone();
    let before = hash("one");
    assert_ne!(before, sha256(&here.join("mast.ron")));
    // An input is never overwritten.
    let err = refused(here, &["run", "mast.ron", "--out", "parts.ron"]);
    assert!(err.contains("parts.ron"), "{err}");

    // A comment is enough: what it says is nobody's business.
    std::fs::write(here.join("parts.ron"), format!("// changed\n{parts}")).unwrap();
    let err =
        refused(here, &["run", "mast.ron", "--out", "two", "--restart", "one/checkpoint.json"]);
    assert!(err.contains("its model is"), "{err}");
    let err = refused(here, &["sweep", "study.ron"]);
    assert!(err.contains("the model changed since"), "{err}");
    good(here, &["run", "mast.ron", "--out", "two"]);
    assert_ne!(hash("two"), before);

    // An error is shown in the file that it is in.
    std::fs::write(here.join("parts.ron"), parts.replace("N/m", "n/m")).unwrap();
    let err = refused(here, &["check", "mast.ron"]);
    assert!(err.contains("parts.ron:1:") && err.contains(r#""40 n/m""#), "{err}");
}

/// CRC-32 of a line of the journal.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, byte: &u8| {
        (0..8).fold(crc ^ u32::from(*byte), |c, _| (c >> 1) ^ (0xedb8_8320 * (c & 1)))
    };
    !bytes.iter().fold(!0, step)
}

//! Files that the program does not read: pipes and devices, and records with numbers beyond all numbers.

use std::path::Path;
use std::process::Command;

/// Exit status, stdout, stderr.
fn trilith(folder: &Path, args: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    let output = command.current_dir(folder).args(args).output().unwrap();
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn at2(dt: &str, values: &str) -> String {
    let count = values.split_whitespace().count();
    format!(
        "X\nEQ, STATION, 090\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {count}, DT= {dt} SEC\n{values}\n"
    )
}

#[test]
fn a_record_that_overflows_ends_with_an_error_and_prints_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for (dt, values, what) in [
        ("0.01", "0 1e308 0", "the acceleration is not finite, first at sample 2"),
        ("0.01", "0 1e160 0", "the Arias intensity is not finite"),
        ("1e308", "0 1 0", "a time step of 1e308 s"),
        ("0", "0 1 0", "a time step of 0.0 s"),
    ] {
        std::fs::write(folder.path().join("a.at2"), at2(dt, values)).unwrap();
        let (status, out, error) = trilith(folder.path(), &["record", "a.at2"]);
        assert_eq!((status, out.as_str()), (2, ""), "{error}");
        assert!(error.contains(what), "{error}");
    }
    std::fs::write(folder.path().join("a.at2"), at2("0.01", "0 1 0")).unwrap();
    let (status, _, error) = trilith(folder.path(), &["record", "a.at2", "--scale", "1e300"]);
    assert_eq!(status, 2, "{error}");
    assert!(error.contains("the Arias intensity is not finite after the processing"), "{error}");
    let (status, _, error) = trilith(folder.path(), &["record", "a.at2", "--periods", "1e-200"]);
    assert_eq!(status, 2, "{error}");
    assert!(error.contains("the pseudo-acceleration at a period of"), "{error}");
}

#[test]
fn a_decimal_comma_is_shown_with_its_column() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.at2"), at2("0.01", "-0,005 -0,4")).unwrap();
    let (status, out, error) = trilith(folder.path(), &["record", "a.at2"]);
    assert_eq!((status, out.as_str()), (2, ""), "{error}");
    assert!(error.contains("a.at2:5:1: `-0,005` has a comma within a number"), "{error}");
    assert!(error.contains("numbers have a decimal point and no commas"), "{error}");
}

#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused_by_every_command_that_reads() {
    let folder = tempfile::tempdir().unwrap();
    let said = |args: &[&str], words: &str| {
        let (status, _, error) = trilith(folder.path(), args);
        assert_eq!(status, 2, "{args:?}: {error}");
        assert!(error.contains(words), "{args:?}: {error}");
    };
    let device = "it is a device, not a regular file";
    for args in [
        &["record", "/dev/zero"][..],
        &["check", "/dev/zero"],
        &["run", "/dev/zero"],
        &["sweep", "/dev/zero"],
        &["record", "--synthetic", "1", "--spectrum", "/dev/zero", "--unit", "g"],
        &["exercise", "Hook", "--history", "/dev/zero"],
    ] {
        said(args, device);
    }
    std::fs::write(folder.path().join("study.ron"), "(model: \"/dev/zero\")").unwrap();
    said(&["sweep", "study.ron"], device);
    let made = Command::new("mkfifo").arg(folder.path().join("pipe")).status();
    if made.is_ok_and(|s| s.success()) {
        let pipe = "it is a pipe, not a regular file";
        for command in ["record", "check", "run", "sweep"] {
            said(&[command, "pipe"], pipe);
        }
        said(&["exercise", "Hook", "--history", "pipe"], pipe);
    }
}

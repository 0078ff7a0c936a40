//! A store of finished runs from outside: used by several studies and processes, killed, damaged.

#[path = "common/sliding.rs"]
mod sliding;

use std::collections::HashSet;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// One by one, so that a kill meets it in the middle.
fn folder(side: usize) -> tempfile::TempDir {
    sliding::folder(side, "0.1 s", "histories: Above(\"slide\", \"100 m\"),")
}

fn command(folder: &Path, out: &str, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trilith"));
    command.current_dir(folder).args(["sweep", "study.ron", "--out", out]).args(more);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Exit status, stdout, stderr.
fn sweep(folder: &Path, out: &str, more: &[&str]) -> (i32, String, String) {
    let output = command(folder, out, more).output().unwrap();
    let text = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// The keys of all runs in a store, as often as they were kept.
fn keys(store: &Path) -> Vec<String> {
    let Ok(all) = std::fs::read_dir(store) else { return Vec::new() };
    let paths = all.map(|e| e.unwrap().path());
    let mut keys = Vec::new();
    for path in paths.filter(|path| path.extension().is_some_and(|e| e == "segment")) {
        let text = String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned();
        let whole = text.split_inclusive('\n').filter(|l| l.ends_with('\n'));
        keys.extend(whole.filter_map(|l| Some(l.split_once("\"key\":\"")?.1[..64].to_owned())));
    }
    keys
}

fn same_tables(here: &Path, one: &str, other: &str) {
    for name in ["table.parquet", "table.csv", "study.html"] {
        let read = |folder: &str| std::fs::read(here.join(folder).join(name)).unwrap();
        assert!(read(one) == read(other), "{name} differs");
    }
}

/// Every start has a folder of its own, so that the store alone tells what is done.
#[test]
fn processes_killed_at_random_moments_make_no_finished_run_twice() {
    let side = 7;
    let folder = folder(side);
    let here = folder.path();
    let store = here.join("store");
    sweep(here, "whole", &[]);
    for kill in 0..2 {
        let before = keys(&store).len();
        // Two at once, of which one is killed as soon as it has kept something.
        let start = |i: usize| {
            let out = format!("killed{kill}{i}");
            command(here, &out, &["--store", "store", "--threads", "1"]).spawn().unwrap()
        };
        let mut both = [start(0), start(1)];
        let begun = Instant::now();
        while keys(&store).len() < before + 6 && begun.elapsed() < Duration::from_secs(120) {
            std::thread::sleep(Duration::from_millis(1));
        }
        for child in &mut both {
            child.kill().unwrap();
            child.wait().unwrap();
        }
    }
    let before = keys(&store);
    let distinct: HashSet<&String> = before.iter().collect();
    assert!(distinct.len() >= 6 && distinct.len() < side * side, "{}", distinct.len());
    let (status, out, err) = sweep(here, "last", &["--store", "store"]);
    assert_eq!(status, 0, "{err}");
    assert!(out.contains(&format!("; {} from the store", distinct.len())), "{out}");
    let after = keys(&store);
    assert_eq!(after.len() - before.len(), side * side - distinct.len());
    assert_eq!(after.iter().collect::<HashSet<_>>().len(), side * side);
    same_tables(here, "whole", "last");
    let files = std::fs::read_dir(&store).unwrap().count();
    assert!(files <= 6, "{files} files for two writers");
    // Nothing is left to do, and an edited study does what is new.
    let (_, out, _) = sweep(here, "again", &["--store", "store"]);
    assert!(out.contains("new runs: 0 in") && out.contains("; 49 from the store"), "{out}");
    same_tables(here, "whole", "again");
    let text = std::fs::read_to_string(here.join("study.ron")).unwrap();
    std::fs::write(here.join("study.ron"), text.replace("Peak(\"slide\")", "Final(\"slide\")"))
        .unwrap();
    let (_, out, _) = sweep(here, "edited", &["--store", "store", "--set", "mu=0.05"]);
    assert!(out.contains("; 7 from the store"), "{out}");
}

#[test]
fn damage_is_told_and_other_folders_are_left_alone() {
    let folder = folder(3);
    let here = folder.path();
    sweep(here, "one", &["--store", "store"]);
    let path = here.join("store/0001.segment");
    let mut bytes = std::fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&path, &bytes).unwrap();
    let (status, out, err) = sweep(here, "two", &["--store", "store"]);
    assert_eq!((status, out.as_str()), (2, ""));
    for part in ["0001.segment is damaged: the line at byte", "out of the store"] {
        assert!(err.contains(part), "{part} in\n{err}");
    }
    // As it says: without that segment its runs are made again.
    std::fs::rename(&path, here.join("damaged")).unwrap();
    let (status, out, err) = sweep(here, "three", &["--store", "store"]);
    assert!(status == 0 && !out.contains("from the store"), "{out}{err}");
    same_tables(here, "one", "three");
    std::fs::create_dir(here.join("other")).unwrap();
    std::fs::write(here.join("other/a.segment"), "of a line\nand another\n").unwrap();
    let (status, _, err) = sweep(here, "four", &["--store", "other"]);
    assert!(status == 2 && err.contains("a.segment is no segment of a store"), "{err}");
    let (status, _, err) = sweep(here, "five", &["--store", "mass.ron"]);
    assert!(status == 2 && err.contains("mass.ron cannot be written"), "{err}");
}

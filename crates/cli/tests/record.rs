//! `trilith record` from the command line.

use assert_cmd::Command;

fn trilith() -> Command {
    let mut command = Command::cargo_bin("trilith").unwrap();
    command.current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../record/tests/files"));
    command
}

fn out(args: &[&str], status: i32) -> String {
    let run = trilith().args(args).assert().code(status);
    let output = run.get_output();
    let text = if status == 0 { &output.stdout } else { &output.stderr };
    String::from_utf8_lossy(text).into_owned()
}

#[test]
fn a_file_of_three_components_shows_all_measures_and_the_rotated_spectrum() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().to_str().unwrap();
    let text = out(&["record", "csmip.v2", "--damping", "0.02,0.05", "--out", folder], 0);
    for words in ["360 Deg", "CSMIP", "PGA", "Arias", "D5-95", "CAV", "RotD50", "5.00 % damping"] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
    let page = std::fs::read_to_string(dir.path().join("record.html")).unwrap();
    assert!(page.contains("Husid") && page.contains("<svg"));
    // What it writes it reads.
    let csv = dir.path().join("csmip_Up.csv");
    let again = out(&["record", csv.to_str().unwrap(), "--scale-to", "0.5 g"], 0);
    assert!(again.contains("0.5000"), "{again}");
}

#[test]
fn a_synthetic_motion_is_that_of_its_seed() {
    let make = |seed: &str| {
        let dir = tempfile::tempdir().unwrap();
        let args = ["record", "--synthetic", seed, "--duration", "8", "--peak", "0.2 g", "--out"];
        out(&[&args[..], &[dir.path().to_str().unwrap()]].concat(), 0);
        std::fs::read_to_string(dir.path().join(format!("synthetic_{seed}.csv"))).unwrap()
    };
    assert_eq!(make("7"), make("7"));
    assert_ne!(make("7").lines().last(), make("8").lines().last());
}

#[test]
fn bad_input_ends_with_status_two_and_says_what_would_be_right() {
    let text = out(&["record", "nowhere.at2"], 2);
    assert!(text.contains("nowhere.at2 cannot be read"), "{text}");
    let text = out(&["record", "csmip.v2", "--component", "west"], 2);
    assert!(text.contains("no component `west`") && text.contains("`360 Deg`"), "{text}");
    let text = out(&["record", "peer.at2", "--lowpass", "80 Hz"], 2);
    assert!(text.contains("below 50 Hz"), "{text}");
    let text = out(&["record"], 2);
    assert!(text.contains("required"), "{text}");
}

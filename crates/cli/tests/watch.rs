//! `trilith watch`: saved files are run again, and an open page follows.

use assert_cmd::cargo::CommandCargoExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A program that ends with its test.
struct Watch {
    child: Child,
    folder: tempfile::TempDir,
}

impl Drop for Watch {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Watch {
    fn new(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("block.ron"), text).unwrap();
        let mut command = Command::cargo_bin("trilith").unwrap();
        command.current_dir(folder.path()).args(["watch", "block.ron", "--out", "seen"]);
        let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        Self { child, folder }
    }

    fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn save(&self, text: &str) {
        std::fs::write(self.file("block.ron"), text).unwrap();
    }

    /// What the script says once it is another one than before.
    fn told(&self, before: &str) -> String {
        let begin = Instant::now();
        loop {
            let told = std::fs::read_to_string(self.file("seen.watch.js")).unwrap_or_default();
            // Whole lines alone: it may be looked at while it is written.
            if told != before && told.ends_with(";\n") {
                return told;
            }
            assert!(begin.elapsed() < Duration::from_secs(120), "nothing but {told:?}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    fn slide(&self) -> f64 {
        let text = std::fs::read_to_string(self.file("seen/summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        summary["outputs"]["slide"]["min"].as_f64().unwrap()
    }
}

fn block() -> String {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(here.join("../../models/rigid_block.ron")).unwrap();
    assert!(text.contains("\"mu\": 0.6"));
    text
}

#[test]
fn a_saved_model_is_run_again_and_a_wrong_one_is_told() {
    let text = block();
    let watch = Watch::new(&text);
    let first = watch.told("");
    assert!(first.starts_with("trilithWatch(") && first.ends_with(", null);\n"), "{first}");
    let before = watch.slide();

    watch.save(&text.replace("\"mu\": 0.6", "\"mu\": 0.2"));
    let second = watch.told(&first);
    assert!(second.ends_with(", null);\n"), "{second}");
    assert!(watch.slide() < 1.1 * before, "{} {before}", watch.slide());

    watch.save(&text.replace("\"mu\": 0.6", "\"mu\": 0.6 </script>"));
    let wrong = watch.told(&second);
    assert!(wrong.contains("block.ron:") && !wrong.contains("</script>"), "{wrong}");

    watch.save(&text);
    let last = watch.told(&wrong);
    assert!(last.ends_with(", null);\n"), "{last}");
    assert_eq!(watch.slide().to_bits(), before.to_bits());
}

/// Whoever saves a model does not wait for the end of the run that it had.
#[test]
fn a_run_whose_model_is_saved_meanwhile_is_given_up() {
    // Some eight million output steps.
    let text = block();
    let long = text.replace("dt: \"1 ms\"", "dt: \"0.0005 ms\"");
    assert_ne!(text, long);
    let watch = Watch::new(&long);
    std::thread::sleep(Duration::from_secs(2));
    assert!(!watch.file("seen.watch.js").exists(), "the long run is still going on");
    watch.save(&text);
    let told = watch.told("");
    assert!(told.ends_with(", null);\n"), "{told}");
    let text = std::fs::read_to_string(watch.file("seen/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    let steps = summary["work"]["steps"].as_u64().unwrap();
    assert!(steps < 100_000, "what is told first is the short run: {steps} steps");
}

#[test]
fn a_page_follows_and_keeps_what_was_chosen() {
    if Command::new("node").arg("--version").output().is_err() {
        println!("not run: no Node.js found");
        return;
    }
    let watch = Watch::new(&block());
    watch.told("");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/watch.mjs");
    let mut drive = Command::new("node");
    drive.arg(script).args([watch.file("seen/report.html"), watch.file("block.ron")]);
    let done = drive.output().unwrap();
    let told = String::from_utf8_lossy(&done.stdout);
    print!("{told}");
    assert!(done.status.success(), "{told}{}", String::from_utf8_lossy(&done.stderr));
}

#[test]
fn what_cannot_be_watched_is_refused() {
    for (arguments, words) in [
        (["watch", "-", "--out", "x"], "is no file that can be watched"),
        (["watch", "nothing.ron", "--out", "x"], "is no file that can be watched"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let mut command = Command::cargo_bin("trilith").unwrap();
        let done = command.current_dir(folder.path()).args(arguments).output().unwrap();
        let told = String::from_utf8_lossy(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{told}");
        assert!(told.contains(words), "{told}");
    }
}

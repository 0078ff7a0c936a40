//! The commands in models/README.md that redraw the figures of the paper, and what these must show.

use assert_cmd::Command;
use std::path::Path;

/// The commands in backticks, as arguments.
fn commands() -> Vec<Vec<String>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let readme = std::fs::read_to_string(root.join("models/README.md")).unwrap();
    let lines = readme.lines().filter(|l| l.contains("| `trilith run models/"));
    lines
        .map(|line| {
            let command = line.split('`').rfind(|p| p.starts_with("trilith ")).unwrap();
            // Quotes hold a value with a space together.
            let parts = command.split('"').enumerate();
            let joined: String = parts
                .map(|(i, p)| if i % 2 == 1 { p.replace(' ', "\u{a0}") } else { p.to_owned() })
                .collect();
            joined.split(' ').skip(1).map(|a| a.replace('\u{a0}', " ")).collect()
        })
        .collect()
}

#[test]
fn every_figure_of_the_paper_is_redrawn_by_one_command() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folder = tempfile::tempdir().unwrap();
    let commands = commands();
    assert_eq!(commands.len(), 9);
    for command in &commands {
        let mut args = command.clone();
        args[1] = root.join(&args[1]).display().to_string();
        let run = Command::new(env!("CARGO_BIN_EXE_trilith"))
            .current_dir(folder.path())
            .args(&args)
            .output()
            .unwrap();
        let told = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{command:?}: {told}");
        let after = |flag: &str| &command[command.iter().position(|a| a == flag).unwrap() + 1];
        let dir = folder.path().join(after("--out"));
        for name in after("--figure").split(',') {
            let svg = std::fs::read_to_string(dir.join(format!("{name}.svg"))).unwrap();
            assert!(svg.starts_with("<svg") && svg.contains("<path"), "{command:?} {name}");
        }
        let text = std::fs::read_to_string(dir.join("summary.json")).unwrap();
        let s: serde_json::Value = serde_json::from_str(&text).unwrap();
        let of = |output: &str, what: &str| s["outputs"][output][what].as_f64().unwrap();
        let energy = |what: &str| {
            s["energy"][what].as_f64().unwrap() / s["energy"]["input"].as_f64().unwrap()
        };
        let uplift = of("uplift_left", "max").max(of("uplift_right", "max"));
        let mode = s["contact"]["initial_mode"].as_str().unwrap();
        // What the paper says of each figure; the numbers of figures 9 and 10 are printed in it.
        let shows = match after("--out").as_str() {
            "out/fig3" => mode == "slide" && uplift < 0.0 && of("slide", "min") < -0.06,
            "out/fig4" => mode == "slide-rock" && uplift > 0.02 && of("slide", "min") < -0.01,
            "out/fig6" => mode == "rock" && uplift > 0.01,
            "out/fig7" => mode == "rest" && uplift < 0.0,
            "out/fig8" => mode == "flight" && uplift > 0.007 && of("slide", "max").abs() < 1e-9,
            "out/fig9" => (uplift / 0.0254 / 149.7 - 1.0).abs() < 0.04,
            "out/fig10" => (of("uplift_left", "max") / 0.12954 - 0.57).abs() < 0.005,
            "out/fig11" => energy("link_hysteretic") > 0.95,
            "out/fig12" => energy("link_viscous") > 0.5,
            other => panic!("{other}"),
        };
        assert!(shows, "{command:?}: {text}");
    }
}

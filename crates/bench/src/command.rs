//! What the program `trilith` itself takes, started from a command line, with its files: the times of the library
//! beside it are of this only if nothing on the way costs as much again.

use crate::block::BLOCK;
use crate::clock::{children_cpu, least};
use crate::{SIZES, Size};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Values of friction, and of amplitude, in the sweeps.
const SIDE: usize = 16;
/// Every command is run so often; the fastest counts.
const TIMES: usize = 5;
/// Frames that are run.
const FRAMES: usize = 3;

/// CPU times on one thread, s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Commands {
    /// `trilith sweep` of the block: an analysis of 20 s at 1 ms, with fixed steps and with the usual ones.
    pub sweeps: [Swept; 2],
    /// `trilith run` of frames.
    pub runs: Vec<Ran>,
}

/// A sweep from the command line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Swept {
    /// How its steps are chosen.
    pub steps: String,
    /// Analyses.
    pub analyses: usize,
    /// All of the process, s for an analysis.
    pub each_s: f64,
}

/// A run from the command line, under FNA.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ran {
    /// Name of the frame.
    pub size: String,
    /// Output steps.
    pub steps: usize,
    /// A step of the march, with everything that is recorded, s.
    pub step_s: f64,
    /// All of the process, from reading the model to the last file, s.
    pub whole_s: f64,
}

/// The program beside this one.
///
/// # Errors
/// A sentence that says how to build it where it is not there.
pub fn program(own: &Path) -> Result<PathBuf, String> {
    let name = format!("trilith{}", std::env::consts::EXE_SUFFIX);
    let path = own.with_file_name(name);
    let missing =
        "the program `trilith` is not built: cargo build --release -p trilith-cli".to_owned();
    if path.is_file() { Ok(path) } else { Err(missing) }
}

/// Runs the program in a folder of its own.
///
/// # Errors
/// A sentence where a file cannot be written or the program fails.
pub fn commands(program: &Path, folder: &Path) -> Result<Commands, String> {
    let folder = folder.join("commands");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let [fixed, usual] = models();
    Ok(Commands {
        sweeps: [
            swept(program, &folder, ("fixed", &fixed))?,
            swept(program, &folder, ("adaptive, as usual", &usual))?,
        ],
        runs: SIZES[..FRAMES].iter().map(|s| ran(program, &folder, s)).collect::<Result<_, _>>()?,
    })
}

/// The block with fixed steps, whose energy nobody watches where it rocks, and with the usual ones.
fn models() -> [String; 2] {
    let fixed = ", step: Fixed(substeps: 1)";
    [format!("{fixed}, energy_limit: 0.9"), String::new()].map(|step| BLOCK.replace(fixed, &step))
}

/// The study of a sweep.
fn study() -> String {
    let axis = |name: &str, from: f64, to: f64| {
        format!("\"{name}\": Range(from: {from}, to: {to}, count: {SIDE})")
    };
    let outputs = ["sway", "slide", "uplift_left", "uplift_right"];
    let columns = outputs.map(|name| format!("\"{name}\": Max(\"{name}\")")).join(", ");
    format!(
        "(title: \"Block\", model: \"block.ron\", axes: {{ {}, {} }}, columns: {{ {columns} }})",
        axis("mu", 0.2, 0.8),
        axis("a", 0.2, 1.0)
    )
}

fn write(folder: &Path, name: &str, text: &str) -> Result<(), String> {
    let path = folder.join(name);
    std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
}

/// CPU time of the program with these words, s.
fn once(program: &Path, folder: &Path, words: &[&str]) -> Result<f64, String> {
    let out = folder.join("out");
    if out.exists() {
        std::fs::remove_dir_all(&out).map_err(|e| format!("{}: {e}", out.display()))?;
    }
    let before = children_cpu();
    let mut command = Command::new(program);
    command.args(words).args(["--out", "out"]).current_dir(folder).stdin(Stdio::null());
    let done = command
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .map_err(|e| format!("trilith cannot be started: {e}"))?;
    if !done.status.success() {
        let complaint = String::from_utf8_lossy(&done.stderr);
        return Err(format!("trilith {} failed: {}", words.join(" "), complaint.trim()));
    }
    Ok(children_cpu() - before)
}

fn swept(program: &Path, folder: &Path, (steps, model): (&str, &str)) -> Result<Swept, String> {
    write(folder, "block.ron", model)?;
    write(folder, "study.ron", &study())?;
    let words = ["sweep", "study.ron", "--threads", "1"];
    let times: Vec<f64> =
        (0..TIMES).map(|_| once(program, folder, &words)).collect::<Result<_, _>>()?;
    let analyses = SIDE * SIDE;
    Ok(Swept { steps: steps.to_owned(), analyses, each_s: least(&times) / analyses as f64 })
}

fn ran(program: &Path, folder: &Path, size: &Size) -> Result<Ran, String> {
    write(folder, "frame.ron", &size.frame().to_ron())?;
    let (mut whole, mut step, mut steps) = (Vec::new(), Vec::new(), 0);
    for _ in 0..TIMES {
        whole.push(once(program, folder, &["run", "frame.ron"])?);
        let summary = folder.join("out").join("summary.json");
        let text = std::fs::read_to_string(&summary).map_err(|e| e.to_string())?;
        let of = |key: &str| {
            let all: serde_json::Value = serde_json::from_str(&text).ok()?;
            all["work"][key].as_f64()
        };
        let (count, march) =
            of("steps").zip(of("march_cpu_s")).ok_or("summary.json has no work")?;
        steps = count as usize;
        step.push(march / count);
    }
    Ok(Ran { size: size.name.to_owned(), steps, step_s: least(&step), whole_s: least(&whole) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The program is another package, which a test of this one does not build.
    #[test]
    fn its_study_fits_its_models() {
        let registry = trilith::registry();
        let [fixed, usual] = models();
        assert!(fixed.contains("Fixed(") && !usual.contains("Fixed("));
        for text in [fixed, usual] {
            let model = trilith::read_text(&text, "block.ron", &registry, &[]).expect("a model");
            let named = |name: &str| model.outputs.iter().any(|o| o.name == name);
            assert!(model.outputs.iter().all(|o| study().contains(&o.name)) && named("sway"));
        }
        assert!(program(Path::new("nowhere/benchmark")).unwrap_err().contains("cargo build"));
    }
}

//! What was measured, and the files that tell it: `results.json`, `REPORT.md`, `report.html`.

mod page;
mod tables;

use crate::{BlockPair, BlockSweep, Commands, Endurance, Growth, Measurement, SideBySide, find};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Everything that was measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Results {
    /// The frames.
    pub frames: Vec<Measurement>,
    /// How the cost grows.
    pub growth: Vec<Growth>,
    /// Long runs.
    pub endurance: Vec<Endurance>,
    /// Other programs.
    pub peers: Vec<SideBySide>,
    /// The sweep of a block.
    pub sweep: Option<BlockSweep>,
    /// The program from the command line.
    pub commands: Option<Commands>,
    /// The sweep beside other programs.
    pub blocks: Vec<BlockPair>,
}

impl Results {
    /// False where a peak is off, a step did not converge, or memory grows.
    #[must_use]
    pub fn good(&self) -> bool {
        let verdicts = self.frames.iter().map(|m| self.verdict(m));
        verdicts
            .chain(self.endurance.iter().map(|e| if e.is_flat() { "pass" } else { "FAIL" }))
            .all(|v| v != "FAIL")
            && self.sweeps().all(BlockSweep::good)
    }

    fn sweeps(&self) -> impl Iterator<Item = &BlockSweep> {
        self.sweep.iter().chain(self.blocks.iter().map(|p| &p.own))
    }

    /// Errors of the peaks, against the known ones or against direct integration here over the same steps.
    fn errors(&self, m: &Measurement) -> Option<(f64, f64, bool, &'static str)> {
        if let Some(a) = find(&m.size).and_then(|s| m.accuracy(s)) {
            return Some((a.isolator, a.roof, a.pass(), a.against));
        }
        let other = self.frames.iter().find(|o| {
            o.size == m.size && o.solver == "hht" && o.steps == m.steps && m.solver != "hht"
        })?;
        let (isolator, roof) = (m.isolator / other.isolator - 1.0, m.roof / other.roof - 1.0);
        Some((isolator, roof, true, "HHT here"))
    }

    fn verdict(&self, m: &Measurement) -> &'static str {
        match self.errors(m) {
            _ if m.unconverged > 0 => "FAIL",
            Some((_, _, false, _)) => "FAIL",
            Some(_) => "pass",
            None => "–",
        }
    }
}

/// The folder of reports: `benchmark` in Cargo's target folder.
#[must_use]
pub fn folder() -> PathBuf {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from);
    target.join("benchmark")
}

/// Writes `results.json`, `REPORT.md` and `report.html`.
///
/// # Errors
/// Where a file cannot be written.
pub fn write(folder: &Path, results: &Results) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let json = serde_json::to_string_pretty(results).map_err(std::io::Error::other)?;
    std::fs::write(folder.join("results.json"), json)?;
    std::fs::write(folder.join("REPORT.md"), results.markdown())?;
    std::fs::write(folder.join("report.html"), results.html())
}

/// What the block of a file that [`update`] fills stands between.
const MARKS: [&str; 2] = ["<!-- cargo benchmark -->\n", "<!-- end of cargo benchmark -->\n"];

/// Puts the tables into the marked block of a file.
///
/// # Errors
/// A sentence where the file cannot be read or written, or has no such block.
pub fn update(file: &Path, results: &Results) -> Result<(), String> {
    let wrong = |e: std::io::Error| format!("{}: {e}", file.display());
    let text = trilith::record::file::read_text(file).map_err(wrong)?;
    let new = replaced(&text, &results.markdown())
        .ok_or_else(|| format!("{} has no block {}", file.display(), MARKS[0].trim()))?;
    std::fs::write(file, new).map_err(wrong)
}

fn replaced(text: &str, block: &str) -> Option<String> {
    let (before, rest) = text.split_once(MARKS[0])?;
    let (_, after) = rest.split_once(MARKS[1])?;
    Some(format!("{before}{}\n{}\n\n{}{after}", MARKS[0], block.trim(), MARKS[1]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::WHOLE;

    #[test]
    fn only_the_marked_block_is_replaced() {
        let text = format!("a\n{}old\n{}b\n", MARKS[0], MARKS[1]);
        let new = replaced(&text, "| new |\n").unwrap();
        assert!(
            new.starts_with("a\n")
                && new.ends_with("b\n")
                && new.contains("| new |")
                && !new.contains("old")
        );
        assert_eq!(replaced(&new, "| new |"), Some(new.clone()));
        assert_eq!(replaced("a", "b"), None);
    }

    #[test]
    fn an_unconverged_step_and_a_wrong_peak_fail() {
        let size = find("P1e2").unwrap();
        let truth = size.newmark.unwrap();
        let right = Measurement {
            size: "P1e2".into(),
            solver: "hht".into(),
            steps: WHOLE,
            isolator: truth.isolator,
            roof: truth.roof,
            ..Measurement::default()
        };
        let good = |m: Measurement| Results { frames: vec![m], ..Results::default() }.good();
        assert!(good(right.clone()));
        assert!(!good(Measurement { unconverged: 1, ..right.clone() }));
        assert!(!good(Measurement { isolator: 1.001 * truth.isolator, ..right }));
    }
}

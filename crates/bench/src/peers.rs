//! Other programs on the same machine in the same minute.

use crate::clock::median;
use crate::{Measurement, Size, Subject, Task, WHOLE, child, export};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Instant;
use trilith::SolverKind;

/// The motion starts there, s: strong from the first step on.
const OFFSET: f64 = 4.0;
/// Steps of the strong motion: from there to where it fades.
const STRONG: usize = 1600;
/// Steps that the other program makes before the measured ones: all isolators slide by then.
const WARM: usize = 100;

/// What the script `opensees.py` says. CPU times in s.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OpenSees {
    /// Its version.
    pub version: String,
    /// Its solver of linear equations.
    pub system: String,
    /// Building the model.
    pub build_s: f64,
    /// The first step, with the factorisation that a tuned run keeps.
    pub first_s: f64,
    /// A step in the strong motion: median.
    pub step_s: f64,
    /// Iterations in a step.
    pub iterations: f64,
    /// Steps made.
    pub steps: usize,
    /// Roof drift after them, m.
    pub probe: f64,
}

impl OpenSees {
    /// The whole motion, from the median step.
    #[must_use]
    pub fn whole_s(&self) -> f64 {
        self.build_s + self.first_s + WHOLE as f64 * self.step_s
    }
}

/// Both programs, one after the other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pair {
    /// FNA.
    pub fna: Measurement,
    /// Direct integration.
    pub hht: Measurement,
    /// OpenSees with Newton's method.
    pub newton: OpenSees,
    /// OpenSees with one factorisation.
    pub tuned: OpenSees,
}

/// One frame beside OpenSees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SideBySide {
    /// Name of the frame.
    pub size: String,
    /// The pairs.
    pub pairs: Vec<Pair>,
    /// Difference of the roof drift after the steps that OpenSees made, as share of its peak: direct
    /// integration here, Newton there.
    pub disagreement: f64,
}

/// Times here and there that make a ratio, s.
type Ratio = (&'static str, fn(&Pair) -> (f64, f64));

/// The ratios, by name: how often ours fits into theirs.
pub const RATIOS: [Ratio; 8] = [
    ("FNA step v. Newton", |p| (p.newton.step_s, p.fna.step_s)),
    ("FNA step v. tuned", |p| (p.tuned.step_s, p.fna.step_s)),
    ("FNA whole run v. Newton", |p| (p.newton.whole_s(), p.fna.whole_s)),
    ("the same with reading the file", |p| (p.newton.whole_s(), p.fna.parse_s + p.fna.whole_s)),
    ("FNA whole run v. tuned", |p| (p.tuned.whole_s(), p.fna.whole_s)),
    ("HHT step v. Newton", |p| (p.newton.step_s, p.hht.step_s)),
    ("HHT step v. tuned", |p| (p.tuned.step_s, p.hht.step_s)),
    ("FNA step v. HHT step", |p| (p.hht.step_s, p.fna.step_s)),
];

impl SideBySide {
    /// Median over the pairs.
    #[must_use]
    pub fn median(&self, of: impl Fn(&Pair) -> f64) -> f64 {
        median(self.pairs.iter().map(of).collect())
    }

    /// Median of a ratio.
    #[must_use]
    pub fn ratio(&self, times: fn(&Pair) -> (f64, f64)) -> f64 {
        self.median(|p| {
            let (theirs, ours) = times(p);
            theirs / ours
        })
    }
}

/// Where the scripts are: in the package, or under the folder of the workspace.
#[must_use]
pub fn scripts() -> PathBuf {
    let package = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    package.unwrap_or_else(|| Path::new("crates").join("bench")).join("peers")
}

/// Which programs, and how often.
#[derive(Clone, Copy, Debug)]
pub struct Programs<'a> {
    /// This program.
    pub own: &'a Path,
    /// A Python that has OpenSeesPy.
    pub python: &'a Path,
    /// Folder for the exported models.
    pub folder: &'a Path,
    /// Pairs at least.
    pub pairs: usize,
}

/// Wall clock for the pairs of a frame, s, and how many there are at most: small frames run for milliseconds, and the pace
/// of a shared machine changes from one to the next.
const PAIRING: f64 = 20.0;
const MOST_PAIRS: usize = 25;

/// Runs both programs in turn.
///
/// # Errors
/// A sentence where one of them fails.
pub fn side_by_side(size: &Size, programs: Programs<'_>) -> Result<SideBySide, String> {
    let Programs { own, python, folder, pairs } = programs;
    let task =
        Task { solver: SolverKind::Hht, vectors: None, steps: STRONG, substeps: 1, offset: OFFSET };
    let subject = Subject::new(&size.frame().to_ron(), task)?;
    let file = folder.join(format!("{}.json", size.name));
    let model = export(&subject)?;
    std::fs::write(&file, model.to_string()).map_err(|e| format!("{}: {e}", file.display()))?;
    let measured = match subject.model.nodes.len() {
        0..1000 => 200,
        1000..5000 => 20,
        _ => 10,
    };
    let mine = |solver: &str, steps: usize| {
        let (steps, offset) = (steps.to_string(), OFFSET.to_string());
        let words = ["one", size.name, "--solver", solver, "--steps", &steps, "--offset", &offset];
        child::json::<Measurement>(own, &words.map(str::to_owned))
    };
    let theirs = |algorithm: &str| {
        let script = scripts().join("opensees.py").display().to_string();
        let (model, warm, steps) =
            (file.display().to_string(), WARM.to_string(), measured.to_string());
        let words =
            ["-B", &script, &model, "--algorithm", algorithm, "--warm", &warm, "--steps", &steps];
        child::json::<OpenSees>(python, &words.map(str::to_owned))
    };
    let (mut all, start) = (Vec::new(), Instant::now());
    while all.len() < pairs.max(1)
        || (all.len() < MOST_PAIRS && start.elapsed().as_secs_f64() < PAIRING)
    {
        all.push(Pair {
            fna: mine("fna", STRONG)?,
            newton: theirs("newton")?,
            hht: mine("hht", STRONG.min(size.hht_steps))?,
            tuned: theirs("tuned")?,
        });
    }
    let there = &all[0].newton;
    let here = mine("hht", there.steps)?;
    let disagreement = (here.last - there.probe).abs() / here.roof;
    Ok(SideBySide { size: size.name.to_owned(), pairs: all, disagreement })
}

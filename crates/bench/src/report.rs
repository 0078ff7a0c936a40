//! The tables for the terminal, `results.json` and `report.html`.

use crate::peers::RATIOS;
use crate::table::{Table, percent, short};
use crate::{
    BlockPair, BlockSweep, Curve, Endurance, Growth, Measurement, SOURCE, SideBySide, WHOLE,
    block_ratios, find,
};
use serde::Serialize;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use trilith_report::{Block, Figure, Page, Section, Stroke};

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
    /// The same beside other programs.
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

    fn costs(&self) -> Table {
        let mut t = Table::new([
            "frame",
            "solver",
            "DOF",
            "links",
            "vectors",
            "read ms",
            "assembly ms",
            "set-up ms",
            "of it factor ms",
            "step µs",
            "unwatched µs",
            "whole run s",
            "memory MB",
        ]);
        for m in &self.frames {
            t.row([
                m.size.clone(),
                m.solver.to_uppercase(),
                m.dof.to_string(),
                m.links.to_string(),
                if m.vectors == 0 { "–".into() } else { m.vectors.to_string() },
                short(1e3 * m.parse_s),
                short(1e3 * m.assembly_s),
                short(1e3 * m.setup_s),
                short(1e3 * m.factor_s),
                short(1e6 * m.step_s),
                short(1e6 * m.bare_step_s),
                short(m.whole_s),
                short(m.peak_mb),
            ]);
        }
        t
    }

    fn quality(&self) -> Table {
        let mut t = Table::new([
            "frame",
            "solver",
            "steps",
            "iterations",
            "unconverged",
            "isolator m",
            "roof m",
            "isolator error",
            "roof error",
            "against",
            "energy error",
            "status",
            "verdict",
        ]);
        for m in &self.frames {
            let errors = self.errors(m);
            t.row([
                m.size.clone(),
                m.solver.to_uppercase(),
                m.steps.to_string(),
                format!("{:.2}", m.iterations),
                m.unconverged.to_string(),
                format!("{:.6}", m.isolator),
                format!("{:.6}", m.roof),
                errors.map_or("–".into(), |e| percent(e.0)),
                errors.map_or("–".into(), |e| percent(e.1)),
                errors.map_or("–", |e| e.3).into(),
                percent(m.energy_error),
                m.status.clone(),
                self.verdict(m).into(),
            ]);
        }
        t
    }

    fn times_beside(&self) -> Table {
        let mut t = Table::new([
            "frame",
            "vectors",
            "FNA µs",
            "HHT µs",
            "Newton ms",
            "iterations",
            "tuned ms",
            "iterations",
            "FNA whole s",
            "Newton whole s",
            "tuned whole s",
            "same motion",
        ]);
        for s in &self.peers {
            t.row([
                s.size.clone(),
                s.pairs.first().map_or(0, |p| p.fna.vectors).to_string(),
                short(1e6 * s.median(|p| p.fna.step_s)),
                short(1e6 * s.median(|p| p.hht.step_s)),
                short(1e3 * s.median(|p| p.newton.step_s)),
                format!("{:.2}", s.median(|p| p.newton.iterations)),
                short(1e3 * s.median(|p| p.tuned.step_s)),
                format!("{:.2}", s.median(|p| p.tuned.iterations)),
                short(s.median(|p| p.fna.whole_s)),
                short(s.median(|p| p.newton.whole_s())),
                short(s.median(|p| p.tuned.whole_s())),
                format!("{:.1e}", s.disagreement),
            ]);
        }
        t
    }

    fn ratios(&self) -> Table {
        let mut t = Table { head: vec![String::new()], rows: Vec::new() };
        t.head.extend(self.peers.iter().map(|s| s.size.clone()));
        for (name, times) in RATIOS {
            let mut row = vec![name.to_owned()];
            row.extend(self.peers.iter().map(|s| short(s.ratio(times))));
            t.rows.push(row);
        }
        t
    }

    fn exponents(&self) -> Table {
        let mut t = Table::new(["cost", "over", "exponent", "first", "last"]);
        for g in &self.growth {
            for c in &g.curves {
                let ends = |p: Option<&(f64, f64)>| {
                    p.map_or("–".into(), |(x, y)| format!("{} at {}", short(*y), short(*x)))
                };
                t.row([
                    format!("{} ({})", c.name, g.quantity),
                    g.cause.into(),
                    c.law.map_or("–".into(), |l| format!("{:.2}", l.exponent)),
                    ends(c.points.first()),
                    ends(c.points.last()),
                ]);
            }
        }
        t
    }

    fn long(&self) -> Table {
        let mut t = Table::new([
            "frame",
            "solver",
            "motion s",
            "steps",
            "CPU s",
            "memory MB",
            "growth MB",
            "status",
            "verdict",
        ]);
        for e in &self.endurance {
            let memory = e.memory.last();
            t.row([
                e.size.clone(),
                e.solver.to_uppercase(),
                short(memory.map_or(f64::NAN, |m| m.t)),
                e.steps.to_string(),
                short(e.cpu_s),
                short(memory.map_or(f64::NAN, |m| m.mb)),
                format!("{:.2}", e.growth_mb),
                e.status.clone(),
                if e.is_flat() { "pass" } else { "FAIL" }.into(),
            ]);
        }
        t
    }

    fn swept(&self) -> Table {
        let mut t = Table::new([
            "sweep",
            "analyses",
            "alone /s",
            "in lanes /s",
            "set-up µs",
            "threads",
            "speed-up",
            "iterations",
            "left lanes",
            "failed",
            "same bits",
            "error",
            "verdict",
        ]);
        for s in self.sweeps() {
            t.row([
                "block, 20 s at 1 ms".into(),
                s.analyses.to_string(),
                short(s.alone_s.recip()),
                short(s.lanes_s.recip()),
                short(1e6 * s.setup_s),
                s.threads.to_string(),
                format!("{:.2}", s.speedup),
                format!("{:.2}", s.iterations),
                s.left.to_string(),
                s.failed.to_string(),
                if s.same { "yes" } else { "no" }.into(),
                percent(s.error),
                if s.good() { "pass" } else { "FAIL" }.into(),
            ]);
        }
        t
    }

    fn swept_beside(&self) -> Table {
        let mut t = Table::new(["an analysis takes longer in", "than alone", "than in lanes"]);
        for (name, alone, lanes) in block_ratios(&self.blocks) {
            t.row([name.into(), short(alone), short(lanes)]);
        }
        t
    }

    fn parts(&self) -> Vec<(&'static str, String, Vec<Table>)> {
        let mut parts = Vec::new();
        if !self.frames.is_empty() {
            let note = format!(
                "CPU times, one thread. Step: mean over the march with the peaks of all isolators kept, one fixed step \
                 each 5 ms. Whole run: assembly, set-up and {WHOLE} steps (where fewer ran: {WHOLE} times the \
                 mean step). {SOURCE}. FNA must hold isolators to 0.1 % and roof to 1 %, HHT both to 1e-6."
            );
            parts.push(("What a run costs", note, vec![self.costs(), self.quality()]));
        }
        if !self.growth.is_empty() {
            let note = "Exponents of power laws through the points by least squares.".into();
            parts.push(("Growth", note, vec![self.exponents()]));
        }
        if !self.endurance.is_empty() {
            let note = "The motion is repeated; extremes are kept, histories are not.".into();
            parts.push(("Memory of a long run", note, vec![self.long()]));
        }
        if let Some(pair) = self.peers.first().and_then(|s| s.pairs.first()) {
            let note = format!(
                "OpenSeesPy {}, Newmark, CPU times in strong motion (the motion from 4 s on), one thread, both programs in \
                 turn; medians of {} pairs. Newton: tangent in every iteration. Tuned: initial tangent, one factorisation. \
                 Whole runs there: building, first step and {WHOLE} times the median step. Same motion: difference of the \
                 roof drift between HHT here and Newton there.",
                pair.newton.version,
                self.peers.iter().map(|s| s.pairs.len()).min().unwrap_or(0)
            );
            parts.push((
                "Side by side with OpenSees",
                note,
                vec![self.times_beside(), self.ratios()],
            ));
        }
        if self.sweeps().next().is_some() {
            let note = "A rigid block on two friction contacts, 20 s at 1 ms, friction 0.2 to 0.8 by sines of 0.2 to \
                        1 g: CPU time on one thread, reading and set-up included; speed-up of all threads on the clock of \
                        the wall. Error: largest sway against OpenSees at steps of 0.02 ms. The other programs run \
                        one combination, 0.4 and 0.8 g."
                .into();
            let mut tables = vec![self.swept()];
            if !self.blocks.is_empty() {
                tables.push(self.swept_beside());
            }
            parts.push(("Sweeps", note, tables));
        }
        parts
    }

    /// For the terminal.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = String::new();
        for (title, _, tables) in self.parts() {
            let _ = writeln!(out, "{title}\n");
            for table in tables {
                let _ = writeln!(out, "{}", table.text());
            }
        }
        out
    }

    /// For a page of text.
    #[must_use]
    pub fn markdown(&self) -> String {
        let mut out = String::new();
        for (title, note, tables) in self.parts() {
            let _ = writeln!(out, "### {title}\n\n{note}\n");
            for table in tables {
                let _ = writeln!(out, "{}", table.markdown());
            }
        }
        out
    }

    /// The page.
    #[must_use]
    pub fn html(&self) -> String {
        let mut page = Page::new("What a run of Trilith costs");
        for (title, note, tables) in self.parts() {
            let mut section = Section::new(title.to_lowercase().replace(' ', "-"), title);
            section = section.block(Block::note(note));
            for t in tables {
                section = section.block(Block::Table { head: t.head, rows: t.rows });
            }
            let figures = match title {
                "What a run costs" => self.sizes(),
                "Growth" => self.growth.iter().map(figure).collect(),
                "Memory of a long run" => self.endurance.iter().map(memory).collect(),
                _ => Vec::new(),
            };
            if !figures.is_empty() {
                section = section.block(figures);
            }
            page = page.section(section);
        }
        page.html()
    }

    /// Cost over size.
    fn sizes(&self) -> Vec<Figure> {
        let of = |solver: &str, read: fn(&Measurement) -> f64| -> Vec<(f64, f64)> {
            let own = self.frames.iter().filter(|m| m.solver == solver);
            own.map(|m| (m.dof as f64, read(m))).collect()
        };
        let pair = |title: &str, unit: &str, read: fn(&Measurement) -> f64| {
            let mut f = Figure::new(title, "degrees of freedom", unit).log_log();
            for solver in ["fna", "hht"] {
                f = drawn(f, &Curve::new(solver.to_uppercase(), of(solver, read)));
            }
            f.caption("Links and vectors differ between the frames.")
        };
        vec![
            pair("A step", "CPU time [µs]", |m| 1e6 * m.step_s),
            pair("Set-up, with reading and assembly", "CPU time [s]", |m| {
                m.parse_s + m.assembly_s + m.setup_s
            }),
            pair("The whole run", "CPU time [s]", |m| m.whole_s),
            pair("Memory", "largest resident memory [MB]", |m| m.peak_mb),
        ]
    }
}

/// Points and law of a curve.
fn drawn(figure: Figure, curve: &Curve) -> Figure {
    let name = match curve.law {
        Some(law) => format!("{} ~ x^{:.2}", curve.name, law.exponent),
        None => curve.name.clone(),
    };
    let used = figure.series.iter().filter(|s| !s.name.is_empty()).count();
    let color = trilith_report::Color::PALETTE[used % 6];
    let figure = figure.colored(name, Stroke::Squares, color, curve.points.iter().copied());
    match (curve.law, curve.points.first(), curve.points.last()) {
        (Some(law), Some(a), Some(b)) => {
            figure.colored("", Stroke::Line, color, [a.0, b.0].map(|x| (x, law.at(x))))
        }
        _ => figure,
    }
}

fn figure(g: &Growth) -> Figure {
    let empty = Figure::new(format!("Over {}", g.cause), g.cause, g.quantity).log_log();
    g.curves.iter().fold(empty, drawn).caption(g.fixed.clone())
}

fn memory(e: &Endurance) -> Figure {
    let top = e.memory.iter().fold(1.0, |a: f64, m| a.max(m.mb));
    let end = e.memory.last().map_or(1.0, |m| m.t);
    Figure::new(
        format!("{} under {}", e.size, e.solver.to_uppercase()),
        "motion [s]",
        "resident memory [MB]",
    )
    .line("", e.memory.iter().map(|m| (m.t, m.mb)))
    .ranges((0.0, end), (0.0, 1.2 * top))
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
    let text = std::fs::read_to_string(file).map_err(wrong)?;
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

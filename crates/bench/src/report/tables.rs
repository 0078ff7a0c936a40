//! The tables.

use super::Results;
use crate::peers::RATIOS;
use crate::table::{Table, percent, short};
use crate::{BlockSweep, block_ratios};

impl Results {
    pub(super) fn costs(&self) -> Table {
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

    pub(super) fn quality(&self) -> Table {
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

    pub(super) fn times_beside(&self) -> Table {
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

    pub(super) fn ratios(&self) -> Table {
        let mut t = Table { head: vec![String::new()], rows: Vec::new() };
        t.head.extend(self.peers.iter().map(|s| s.size.clone()));
        for (name, times) in RATIOS {
            let mut row = vec![name.to_owned()];
            row.extend(self.peers.iter().map(|s| short(s.ratio(times))));
            t.rows.push(row);
        }
        t
    }

    pub(super) fn exponents(&self) -> Table {
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

    pub(super) fn long(&self) -> Table {
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

    pub(super) fn swept(&self) -> Table {
        let mut t = Table::new([
            "sweep",
            "analyses",
            "alone /s (median)",
            "in lanes /s (median)",
            "set-up µs",
            "threads",
            "speed-up (median)",
            "of separate sweeps",
            "iterations",
            "left lanes",
            "failed",
            "same bits",
            "error",
            "verdict",
        ]);
        if let Some(s) = BlockSweep::median(self.sweeps()) {
            t.row([
                "block, 20 s at 1 ms".into(),
                s.analyses.to_string(),
                format!("{} ({})", short(s.fastest_s[0].recip()), short(s.alone_s.recip())),
                format!("{} ({})", short(s.fastest_s[1].recip()), short(s.lanes_s.recip())),
                short(1e6 * s.setup_s),
                s.threads.count.to_string(),
                format!("{:.2} ({:.2})", s.threads.speedup(), s.threads.median),
                percent(s.threads.of_separate),
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

    pub(super) fn commanded(&self) -> Vec<Table> {
        let Some(all) = &self.commands else { return Vec::new() };
        let mut sweeps = Table::new(["trilith sweep, steps", "analyses", "analyses /s"]);
        for s in &all.sweeps {
            sweeps.row([s.steps.clone(), s.analyses.to_string(), short(s.each_s.recip())]);
        }
        let mut runs = Table::new(["trilith run", "steps", "a step µs", "whole run s"]);
        for r in &all.runs {
            let (step, whole) = (short(1e6 * r.step_s), short(r.whole_s));
            runs.row([r.size.clone(), r.steps.to_string(), step, whole]);
        }
        vec![sweeps, runs]
    }

    pub(super) fn swept_beside(&self) -> Table {
        let mut t = Table::new(["an analysis takes longer in", "than alone", "than in lanes"]);
        for (name, alone, lanes) in block_ratios(&self.blocks) {
            t.row([name.into(), short(alone), short(lanes)]);
        }
        t
    }
}

//! The page, and the same as text.

use super::Results;
use crate::table::Table;
use crate::{Curve, Endurance, Growth, Measurement, SOURCE, WHOLE};
use std::fmt::Write as _;
use trilith_report::{Block, Figure, Page, Section, Stroke};

impl Results {
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
                 turn; medians of {} to {} pairs. Newton: tangent in every iteration. Tuned: initial tangent, one factorisation. \
                 Whole runs there: building, first step and {WHOLE} times the median step. Same motion: difference of the \
                 roof drift between HHT here and Newton there.",
                pair.newton.version,
                self.peers.iter().map(|s| s.pairs.len()).min().unwrap_or(0),
                self.peers.iter().map(|s| s.pairs.len()).max().unwrap_or(0)
            );
            parts.push((
                "Side by side with OpenSees",
                note,
                vec![self.times_beside(), self.ratios()],
            ));
        }
        if self.sweeps().next().is_some() {
            let note = "A rigid block on two friction contacts, 20 s at 1 ms, friction 0.2 to 0.8 by sines of 0.2 to \
                        1 g: analyses in a second of CPU time on one thread, reading and set-up included, by the fastest \
                        run and in the median, as cores of a shared machine change their pace. Speed-up of all threads \
                        on the clock of the wall, likewise; beside it the rate of the threads of one sweep over the sum \
                        of the rates of separate sweeps at once, one to a thread: 100 % where sharing out costs nothing. \
                        Error: largest sway against OpenSees at steps of 0.02 ms. The other programs run one \
                        combination, 0.4 and 0.8 g; ratios are of medians."
                .into();
            let mut tables = vec![self.swept()];
            if !self.blocks.is_empty() {
                tables.push(self.swept_beside());
            }
            parts.push(("Sweeps", note, tables));
        }
        if self.commands.is_some() {
            let note = "The program, started anew each time: CPU time of the whole process on one thread, with reading, \
                        set-up and all files; the fastest of several. Sweeps: the block above, 20 s at 1 ms. Runs: FNA, \
                        with everything that a run records; a step: of the march."
                .into();
            parts.push(("From the command line", note, self.commanded()));
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

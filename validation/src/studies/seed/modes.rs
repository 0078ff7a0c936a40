//! The paper's table of four cases: how the block leaves rest under 5 Hz pulses.

use super::chart::{COLORS, MODES, borders};
use super::{BLOCK, BOTH, PAPER, reference, run};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use trilith_report::{Figure, Stroke};

/// Case, peak acceleration (g), friction coefficient, anticipated mode.
const CASES: [(&str, f64, f64, usize); 4] =
    [("h1", 0.2, 0.4, 0), ("h2", 1.5, 0.2, 1), ("h3", 1.5, 0.6, 3), ("h4", 0.8, 0.8, 2)];
const PULSES: [(&str, &str); 3] =
    [("half", "half cycle"), ("full", "one cycle"), ("cont", "15 cycles")];

pub(super) fn studies() -> Vec<Study> {
    let title = "The four horizontal cases and their anticipated modes";
    vec![Study { id: "TAB-1", title, source: PAPER, work }]
}

fn work(f: &mut Findings) -> Result<(), String> {
    f.text(
        "0 rest, 1 slide, 2 rock, 3 slide-rock: the mode from rest to the first impact or slip \
         reversal. The paper does not say how long its sine pulses are; the modes are the same for a \
         half cycle, a full one and 15.",
    );
    let mut points = [const { Vec::new() }; 4];
    for (case, a, mu, expected) in CASES {
        for (pulse, name) in PULSES {
            let reference = reference::case(&format!("{case}_{pulse}"))?;
            for solver in BOTH {
                let trace = run(BLOCK, &reference.parameters(), solver, |_| {})?;
                let mode = trace.contact.as_ref().map(|c| c.initial_mode).unwrap_or_default();
                let found = MODES.iter().position(|m| *m == mode);
                if let Some(found) = found {
                    points[found].push((mu, a));
                }
                f.check(
                    format!("{a} g, μ {mu}, {name}: mode ({})", MODES[expected]),
                    "",
                    (expected as f64, Kind::Published),
                    Tolerance::Absolute(0.0),
                    solver.name(),
                    found.map_or(f64::NAN, |m| m as f64),
                );
            }
        }
    }
    let title = "The paper's four cases on the initiation chart, H/B = 2";
    let figure = Figure::new(title, "friction coefficient μ", "peak acceleration A [g]");
    let mut figure = borders(figure.ranges((0.0, 1.0), (0.0, 2.0)).sized(640, 480), 2.0);
    for ((name, color), points) in MODES.iter().zip(COLORS).zip(points) {
        figure = figure.colored(*name, Stroke::Squares, color, points);
    }
    f.figure(figure);
    Ok(())
}

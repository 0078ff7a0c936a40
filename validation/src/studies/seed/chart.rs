//! Figure 1: how a block leaves rest, over friction and peak acceleration.

use super::{BLOCK, run};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use trilith::SolverKind;
use trilith::model::{Analysis, StepControl};
use trilith_report::{Color, Figure, Stroke};

/// Points along each axis.
const POINTS: usize = 40;
/// Ends of the axes: friction coefficient, acceleration in g.
const MU: f64 = 1.0;
const A: f64 = 2.0;
/// Half width of the band about the borders in which a point is not judged.
const BAND: f64 = 0.02;

const MODES: [&str; 4] = ["rest", "slide", "rock", "slide-rock"];
const COLORS: [Color; 4] =
    [Color(200, 200, 200), Color::PALETTE[0], Color::PALETTE[1], Color::PALETTE[2]];

const SOURCE: &str = "Shenton 1996, J. Eng. Mech. 122(7), 690–693; the paper's figure 1";

/// A chart.
#[derive(Clone, Copy)]
struct Chart {
    slender: f64,
    solver: SolverKind,
}

/// Contact stiffness, N/m: a contact period of 0.2 ms. Where friction saturates the overturning moment has a
/// kink, and a softer block swings past it: at 0.6 ms it lifts within 6 % of the border.
const KN: f64 = 5e12;
/// Contact dashpot of the shipped model at a stiffness of 5e8 N/m; it goes with the root.
const CV: f64 = 1.27665182e6;
/// Tolerance of the steps: an uplift of micrometres decides.
const TOLERANCE: f64 = 1e-6;
/// Length of a run: the half of the 5 Hz cycle that holds the first peak, s.
const DURATION: f64 = 0.1;

pub(super) fn studies() -> Vec<Study> {
    let study = |id, title, work| Study { id, title, source: SOURCE, work };
    vec![
        study("FIG-1a", "Figure 1: boundaries of rest, slide, rock and slide-rock, H/B = 2", |f| {
            draw(f, Chart { slender: 2.0, solver: SolverKind::Fna })
        }),
        study("FIG-1b", "The same for H/B = 4", |f| {
            draw(f, Chart { slender: 4.0, solver: SolverKind::Fna })
        }),
        study("FIG-1c", "Figure 1 by direct integration", |f| {
            draw(f, Chart { slender: 2.0, solver: SolverKind::Hht })
        }),
    ]
}

/// Friction coefficient above which a rocking block of height/width `slender` does not slide.
fn critical(a: f64, slender: f64) -> f64 {
    (a * (4.0 + slender * slender) + 3.0 * slender)
        / (1.0 + 4.0 * slender * slender + 3.0 * a * slender)
}

/// The mode at acceleration `a` (g) and friction `mu`, as index into [`MODES`].
fn shenton(a: f64, mu: f64, slender: f64) -> usize {
    if a <= mu.min(1.0 / slender) {
        0
    } else if mu <= 1.0 / slender {
        1
    } else if mu >= critical(a, slender) {
        2
    } else {
        3
    }
}

/// True where the mode changes within the band.
fn at_border(a: f64, mu: f64, slender: f64) -> bool {
    let here = shenton(a, mu, slender);
    let sides = [1.0 - BAND, 1.0, 1.0 + BAND];
    sides.iter().any(|x| sides.iter().any(|y| shenton(a * x, mu * y, slender) != here))
}

/// The borders of the closed form as reference lines.
fn borders(figure: Figure, slender: f64) -> Figure {
    let corner = 1.0 / slender;
    let curve = (0..=100).map(|i| corner + (A - corner) * f64::from(i) / 100.0);
    figure
        .reference("closed form", [(0.0, 0.0), (corner, corner), (MU, corner)])
        .reference("", [(corner, corner), (corner, A)])
        .reference("", curve.map(|a| (critical(a, slender), a)).filter(|(mu, _)| *mu <= MU))
}

/// The mode in which a block leaves rest under half a 5 Hz sine of amplitude `a` (g).
fn mode(chart: Chart, a: f64, mu: f64) -> Result<usize, String> {
    let set = [
        ("height", 2.0 * chart.slender),
        ("ah", a),
        ("mu", mu),
        ("kn", KN),
        ("ks", KN),
        ("cv", CV * (KN / 5e8).sqrt()),
        ("cycles", 0.5),
        ("duration", DURATION),
    ];
    let trace = run(BLOCK, &set, chart.solver, |model| {
        for case in &mut model.cases {
            if let Analysis::Dynamic(d) = &mut case.analysis {
                d.solution.step = StepControl::Adaptive { tolerance: TOLERANCE };
            }
        }
    })?;
    let mode = trace.contact.map(|c| c.initial_mode).unwrap_or_default();
    MODES.iter().position(|m| *m == mode).ok_or_else(|| format!("mode `{mode}` at {a} g, μ {mu}"))
}

fn draw(f: &mut Findings, chart: Chart) -> Result<(), String> {
    let mut found = [const { Vec::new() }; 4];
    let (mut wrong, mut near, mut near_wrong) = (Vec::new(), 0, 0);
    for i in 0..POINTS {
        for j in 0..POINTS {
            let at = |k: usize, end: f64| (k as f64 + 0.5) * end / POINTS as f64;
            let (a, mu) = (at(i, A), at(j, MU));
            let mode = mode(chart, a, mu)?;
            found[mode].push((mu, a));
            let differs = mode != shenton(a, mu, chart.slender);
            if at_border(a, mu, chart.slender) {
                near += 1;
                near_wrong += usize::from(differs);
            } else if differs {
                wrong.push((mu, a));
            }
        }
    }
    let solver = chart.solver.name();
    let title = format!("Initiation, H/B = {}, {}", chart.slender, solver.to_uppercase());
    let mut figure = Figure::new(title, "friction coefficient μ", "peak acceleration A [g]")
        .ranges((0.0, MU), (0.0, A))
        .sized(640, 560);
    for ((name, color), points) in MODES.iter().zip(COLORS).zip(&found) {
        figure = figure.colored(*name, Stroke::Squares, color, points.iter().copied());
    }
    figure = borders(figure, chart.slender);
    if !wrong.is_empty() {
        figure = figure.colored("differs", Stroke::Crosses, Color::INK, wrong.iter().copied());
    }
    f.figure(figure);
    f.text(format!(
        "{} runs of half a cycle of 5 Hz. Shenton's borders are those of an acceleration that jumps to \
         A; a sine starts from zero, so that a slide-rock begins as rocking and slides a little later, \
         but what moves depends on the acceleration of the moment alone, and the borders stay where they \
         are, at the peak of the sine. {near} points lie within {} % of a border and are not judged; \
         {near_wrong} of them differ.",
        POINTS * POINTS,
        100.0 * BAND,
    ));
    let points = (POINTS * POINTS - near) as f64;
    f.check(
        "points off the borders in the mode of the closed form",
        "",
        (points, Kind::ClosedForm),
        Tolerance::Absolute(0.0),
        solver,
        points - wrong.len() as f64,
    );
    Ok(())
}

//! Figure 1: how a block leaves rest, over friction and peak acceleration.

use super::{BLOCK, replace, run, step};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use std::f64::consts::PI;
use trilith::SolverKind;
use trilith::model::{AfterEnd, Interpolation, Table, TimeFunction};
use trilith::theory;
use trilith_report::{Color, Figure, Stroke};

/// Points along each axis.
pub(super) const POINTS: usize = 40;
/// Ends of the axes: friction coefficient, acceleration in g.
const MU: f64 = 1.0;
const A: f64 = 2.0;
pub(super) const MODES: [&str; 4] = ["rest", "slide", "rock", "slide-rock"];
pub(super) const COLORS: [Color; 4] =
    [Color(200, 200, 200), Color::PALETTE[0], Color::PALETTE[1], Color::PALETTE[2]];

const SOURCE: &str = "Shenton 1996, J. Eng. Mech. 122(7), 690–693; the paper's figure 1";

/// Half width of the band about the borders in which a point is not judged, as share of acceleration
/// and friction.
const BAND: f64 = 0.02;

/// Base motion of a chart.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Motion {
    /// To the peak within [`RISE`], then held.
    Jump,
    /// One cycle of 5 Hz.
    Sine,
}

/// What a block stands on.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Contact {
    /// Static deflection 0.25 µm, dashpots that damp rocking on both feet critically: what the block
    /// does while it stands follows the acceleration, as it does on rigid ground.
    Stiff,
    /// As the shipped model has it: static deflection 0.1 mm, restitution 0.25.
    Shipped,
}

/// A chart.
#[derive(Clone, Copy)]
pub(super) struct Chart {
    pub(super) slender: f64,
    pub(super) motion: Motion,
    pub(super) contact: Contact,
    pub(super) solver: SolverKind,
}

/// A jump within less than the periods of the block on its contacts doubles the forces in them, which
/// are not those on rigid ground then. 10 ms are four of the stiff ones, and a fiftieth of the time
/// √(4R/3g) in which a rigid block rocks.
const RISE: f64 = 0.01;

pub(super) fn studies() -> Vec<Study> {
    const JUMP: Chart = Chart {
        slender: 2.0,
        motion: Motion::Jump,
        contact: Contact::Stiff,
        solver: SolverKind::Fna,
    };
    let study = |id, title, work| Study { id, title, source: SOURCE, work };
    vec![
        study("FIG-1a", "Initiation chart, H/B = 2, acceleration that jumps", |f| draw(f, JUMP)),
        study("FIG-1b", "Initiation chart, H/B = 4, acceleration that jumps", |f| {
            draw(f, Chart { slender: 4.0, ..JUMP })
        }),
        study("FIG-1c", "Initiation chart, H/B = 2, by direct integration", |f| {
            draw(f, Chart { solver: SolverKind::Hht, ..JUMP })
        }),
        study("FIG-1d", "Initiation chart, H/B = 2, 5 Hz sine", |f| {
            draw(f, Chart { motion: Motion::Sine, ..JUMP })
        }),
        study("FIG-1e", "Initiation chart, H/B = 4, 5 Hz sine", |f| {
            draw(f, Chart { slender: 4.0, motion: Motion::Sine, ..JUMP })
        }),
    ]
}

/// The mode at acceleration `a` (g) and friction `mu`, as index into [`MODES`].
pub(super) fn shenton(a: f64, mu: f64, slender: f64) -> usize {
    let mode = theory::initial_mode(a, mu, slender);
    MODES.iter().position(|m| *m == mode).unwrap_or_default()
}

/// True where the mode changes within the band.
fn at_border(a: f64, mu: f64, slender: f64) -> bool {
    let here = shenton(a, mu, slender);
    let sides = [1.0 - BAND, 1.0, 1.0 + BAND];
    sides.iter().any(|x| sides.iter().any(|y| shenton(a * x, mu * y, slender) != here))
}

/// The borders of the closed form as reference lines.
pub(super) fn borders(figure: Figure, slender: f64) -> Figure {
    let corner = 1.0 / slender;
    let curve = (0..=100).map(|i| corner + (A - corner) * f64::from(i) / 100.0);
    figure
        .reference("closed form", [(0.0, 0.0), (corner, corner), (MU, corner)])
        .reference("", [(corner, corner), (corner, A)])
        .reference(
            "",
            curve.map(|a| (theory::friction_to_rock(a, slender), a)).filter(|(mu, _)| *mu <= MU),
        )
}

/// From zero to `amplitude` along a half cosine, then held: no kink that would set the contacts ringing.
fn jump(amplitude: f64) -> Result<TimeFunction, String> {
    let share = || (0..=40).map(|i| f64::from(i) / 40.0);
    let values = share().map(|x| 0.5 * amplitude * (1.0 - (PI * x).cos())).collect();
    let times = share().map(|x| RISE * x).collect();
    let table = Table::new(times, values, Interpolation::Linear, AfterEnd::Hold);
    Ok(TimeFunction::Table(table.map_err(|e| e.to_string())?.into()))
}

/// The mode in which a block leaves rest.
pub(super) fn mode(chart: Chart, a: f64, mu: f64) -> Result<usize, String> {
    // Of the shipped model: gravity, width, mass.
    const G: f64 = 9.81;
    const WIDTH: f64 = 2.0;
    const MASS: f64 = 1e4;
    // Long enough for the movement at the edge of the band to show beyond the play of the contacts.
    let duration = if chart.motion == Motion::Jump { 0.04 } else { 0.1 };
    let height = WIDTH * chart.slender;
    let mut set = vec![("height", height), ("ah", a), ("mu", mu), ("duration", duration)];
    if chart.contact == Contact::Stiff {
        let kn = 2e11;
        // Rocking on both feet: I θ̈ + c B²/2 θ̇ + kₙ B²/2 θ, about the middle of the base.
        let inertia = MASS * (WIDTH * WIDTH + 4.0 * height * height) / 12.0;
        let cv = 2.0 * (2.0 * kn * inertia).sqrt() / WIDTH;
        set.extend([("kn", kn), ("ks", kn), ("cv", cv)]);
    }
    let motion = jump(a * G)?;
    let trace = run(BLOCK, &set, chart.solver, |model| {
        step(model, duration / 20.0);
        if chart.motion == Motion::Jump {
            replace(model, "horizontal", motion);
        }
    })?;
    let mode = trace.contact.map(|c| c.initial_mode).unwrap_or_default();
    MODES.iter().position(|m| *m == mode).ok_or_else(|| format!("mode `{mode}` at {a} g, μ {mu}"))
}

/// A square for each point in the colour of its mode, crosses where it differs from the closed form.
pub(super) fn picture(
    chart: Chart,
    found: &[Vec<(f64, f64)>; 4],
    differ: Vec<(f64, f64)>,
) -> Figure {
    let motion = match chart.motion {
        Motion::Jump => "acceleration that jumps",
        Motion::Sine => "5 Hz sine",
    };
    let solver = chart.solver.name().to_uppercase();
    let title = format!("Initiation, H/B = {}, {motion}, {solver}", chart.slender);
    let mut figure = Figure::new(title, "friction coefficient μ", "peak acceleration A [g]")
        .ranges((0.0, MU), (0.0, A))
        .sized(640, 560);
    for ((name, color), points) in MODES.iter().zip(COLORS).zip(found) {
        figure = figure.colored(*name, Stroke::Squares, color, points.iter().copied());
    }
    figure = borders(figure, chart.slender);
    if differ.is_empty() {
        return figure;
    }
    figure.colored("differs from the closed form", Stroke::Crosses, Color::INK, differ)
}

/// (friction coefficient, acceleration) of a point.
pub(super) fn point(i: usize, j: usize) -> (f64, f64) {
    let at = |k: usize, end: f64| (k as f64 + 0.5) * end / POINTS as f64;
    (at(j, MU), at(i, A))
}

fn draw(f: &mut Findings, chart: Chart) -> Result<(), String> {
    let mut found = [const { Vec::new() }; 4];
    let (mut judged, mut wrong, mut wrong_at_border) = (0, 0, 0);
    let mut differ = Vec::new();
    for i in 0..POINTS {
        for j in 0..POINTS {
            let (mu, a) = point(i, j);
            let mode = mode(chart, a, mu)?;
            found[mode].push((mu, a));
            let off = !at_border(a, mu, chart.slender);
            judged += usize::from(off);
            if mode != shenton(a, mu, chart.slender) {
                differ.push((mu, a));
                wrong += usize::from(off);
                wrong_at_border += usize::from(!off);
            }
        }
    }
    f.figure(picture(chart, &found, differ));
    f.text(match chart.motion {
        Motion::Jump => {
            "Shenton's borders hold for an acceleration that jumps to A and stays. Here it rises \
             within 10 ms: long for the contacts, whose forces a sudden jump would double, short for \
             the block."
        }
        Motion::Sine => {
            "A sine starts from zero, as in the paper's own four cases, so that a slide-rock begins as \
             rocking and slides a little later. With small rotations what moves depends on the \
             acceleration of the moment alone: the borders stay where they are, at the peak of the \
             sine."
        }
    });
    f.text(
        "The contacts are stiff (0.25 µm static deflection) and damped so that they hardly ring: softer or \
         less damped ones overshoot when the block begins to slide or rock, and move the borders (FIG-1f).",
    );
    let all = POINTS * POINTS;
    f.text(format!(
        "{all} runs; {} points lie within {} % of a border and are not judged: {wrong_at_border} of \
         them differ. Of the {judged} others {wrong} differ.",
        all - judged,
        100.0 * BAND,
    ));
    f.check(
        format!(
            "points in another mode than the closed form's, {} % off its borders",
            100.0 * BAND
        ),
        "",
        (0.0, Kind::ClosedForm),
        Tolerance::Absolute(0.0),
        chart.solver.name(),
        wrong as f64,
    );
    Ok(())
}

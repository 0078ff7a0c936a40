//! Links of Trilith beside the materials and bearings of OpenSees that they stand for, where OpenSees is installed.

mod bearings;
mod contacts;
pub(super) mod exported;
mod frames;
pub(super) mod imported;
mod leaning;
mod oscillators;
mod ours;
mod pair;
mod paths;
mod smooth;
mod springs;
mod structures;
mod theirs;

use crate::case::{Kind, Tolerance};
use crate::{Findings, Item, Outcome, Study};
use oscillators::{Oscillator, oscillators};
use pair::{Agree, KEPT, Pair};
use paths::{DURATION, sampled};
use serde_json::{Value, json};
use structures::Structure;
use trilith_report::{Color, Figure, Stroke};

const STUDY: Study = Study {
    id: "OP-1",
    title: "Links beside OpenSees",
    source: "OpenSeesPy, run beside; the table of the guide for users of OpenSees",
    work: compared,
};

/// The study, or why it cannot be made here.
pub(super) fn item() -> Item {
    let Study { id, title, source, .. } = STUDY;
    match theirs::missing() {
        None => Item::Study(STUDY),
        Some(reason) => Item::Missing(Outcome::unavailable(id, title, source, reason)),
    }
}

/// Pairs whose loops are drawn.
const DRAWN: [&str; 9] = [
    "Hardening, isotropic, irregular",
    "BoucWen, all losses, A₀ = 1.2, irregular",
    "SelfCentering, growing cycles",
    "Hertzdamp, irregular",
    "ViscousDamper, α = 0.3, irregular",
    "BilinearOilDamper, p = 0.2, growing cycles",
    "LeadRubberX, hot, one axis",
    "flatSliderBearing, N comes and goes, one axis",
    "TripleFrictionPendulum, one axis",
];

type Rows = Vec<Vec<f64>>;

/// A row of the comparison.
struct Compared {
    name: String,
    agree: Agree,
    /// Or why there is none.
    difference: Result<f64, String>,
}

impl Compared {
    /// Not a number where there is none.
    fn share(&self) -> f64 {
        self.difference.as_ref().map_or(f64::NAN, |share| *share)
    }
}

fn compared(found: &mut Findings) -> Result<(), String> {
    let pairs: Vec<Pair> =
        [springs::pairs(), smooth::pairs(), contacts::pairs(), bearings::pairs()]
            .into_iter()
            .flatten()
            .collect();
    let alone = oscillators();
    let mut tasks: Vec<Value> = pairs.iter().flat_map(tasks_of).collect();
    tasks.extend(alone.iter().map(Oscillator::task));
    let whole =
        [frames::structures(), leaning::structures()].into_iter().flatten().collect::<Vec<_>>();
    tasks.extend(whole.iter().map(Structure::task));
    let mut theirs = theirs::values(&tasks)?.into_iter();
    let mut rows = Vec::new();
    let mut loops = Vec::new();
    for pair in &pairs {
        let theirs = answer(pair, &mut theirs);
        let (d, v) = sampled(&pair.waves, pair.steps);
        let both = both(ours::forces(pair, &d, &v), theirs);
        // The axial force of a bearing is that of a spring, and large.
        let first = usize::from(pair.waves.len() > 1);
        if let Ok((ours, theirs)) = &both
            && DRAWN.contains(&pair.name.as_str())
        {
            loops.push(drawn(pair, &d[first], ours, theirs, first));
        }
        let difference = both.map(|(ours, theirs)| difference(&ours, &theirs, first));
        rows.push(Compared { name: pair.name.clone(), agree: pair.agree, difference });
    }
    for (it, theirs) in alone.iter().zip(theirs.by_ref()) {
        let both = both(it.displacements(), theirs);
        let difference = both.map(|(ours, theirs)| difference(&ours, &theirs, 0));
        rows.push(Compared { name: it.name.into(), agree: it.agree, difference });
    }
    for (it, theirs) in whole.iter().zip(theirs) {
        let both = both(it.displacements(), theirs);
        let difference = both.map(|(ours, theirs)| apart(&ours, &theirs));
        rows.push(Compared { name: it.name.into(), agree: it.agree, difference });
    }
    told(found, &rows);
    loops.into_iter().for_each(|figure| found.figure(figure));
    Ok(())
}

/// What both gave, or why one of them gave nothing.
fn both(ours: Result<Rows, String>, theirs: Result<Rows, String>) -> Result<(Rows, Rows), String> {
    let theirs = theirs.map_err(|e| format!("OpenSees: {e}"))?;
    Ok((ours?, theirs))
}

/// With the steps of the pair and, where an error is to be taken off, with twice as many.
fn tasks_of(pair: &Pair) -> Vec<Value> {
    let mut all = vec![task(pair, pair.steps)];
    if pair.extrapolated {
        all.push(task(pair, 2 * pair.steps));
    }
    all
}

fn task(pair: &Pair, steps: usize) -> Value {
    let (d, v) = sampled(&pair.waves, steps);
    json!({
        "what": "forces", "commands": pair.commands, "directions": pair.directions,
        "freedoms": pair.freedoms, "d": d, "v": v,
        "dt": DURATION / steps as f64, "every": steps / KEPT,
    })
}

/// What OpenSees gives for a pair, from the answers to its tasks.
fn answer(pair: &Pair, answers: &mut dyn Iterator<Item = theirs::Values>) -> Result<Rows, String> {
    let mut next = || answers.next().unwrap_or_else(|| Err("no answer".into()));
    let coarse = next();
    if !pair.extrapolated {
        return coarse;
    }
    // An error in proportion to the step is as large again as its half.
    let fine = next();
    let (coarse, fine) = (coarse?, fine?);
    let row = |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| 2.0 * b - a).collect();
    Ok(coarse.iter().zip(&fine).map(row).collect())
}

/// Largest difference over all times as share of the largest of theirs, both as lengths of vectors of the
/// entries from `first` on; not a number where one of both lacks a time.
fn difference(ours: &Rows, theirs: &Rows, first: usize) -> f64 {
    let length = |it: &mut dyn Iterator<Item = f64>| it.map(|x| x * x).sum::<f64>().sqrt();
    let peak =
        theirs.iter().fold(0.0_f64, |m, f| m.max(length(&mut f.iter().skip(first).copied())));
    if ours.len() != theirs.len() || peak == 0.0 {
        return f64::NAN;
    }
    let apart = ours
        .iter()
        .zip(theirs)
        .map(|(a, b)| length(&mut a.iter().zip(b).skip(first).map(|(a, b)| a - b)) / peak);
    super::runs::largest(apart)
}

/// The same for each entry by itself: the largest of all.
fn apart(ours: &Rows, theirs: &Rows) -> f64 {
    let Some(width) = theirs.first().map(Vec::len) else { return f64::NAN };
    let only = |rows: &Rows, i: usize| rows.iter().map(|row| vec![row[i]]).collect();
    super::runs::largest((0..width).map(|i| difference(&only(ours, i), &only(theirs, i), 0)))
}

/// Text, table, comparisons and the figure of all differences.
fn told(found: &mut Findings, rows: &[Compared]) {
    found.text(
        "The same motion is imposed on a material or bearing of OpenSees and on the links that the guide names for \
         it, with the same steps, and the forces are compared at 3000 times (elements that are no links: the \
         motion of a mass on them; structures: the displacements of nodes, each by its own largest). The difference is the largest over all times, as share of the largest force. \
         Where OpenSees integrates a law with an error in proportion to its step, two steps tell what it tends \
         to. Where laws differ, the limit says how far they are apart in this motion and the table says why.",
    );
    let table = rows.iter().map(|r| {
        let difference = match &r.difference {
            Ok(share) => format!("{share:.1e}"),
            Err(reason) => reason.clone(),
        };
        vec![r.name.clone(), difference, r.agree.words()]
    });
    found.table(&["law and motion", "difference", "agreement"], table.collect());
    for r in rows {
        let limit = (r.agree.limit(), Kind::OtherCode);
        let what = format!("{}: difference over peak", r.name);
        found.check(what, "", limit, Tolerance::AtMost, "trilith", r.share());
    }
    let points = |wanted: fn(Agree) -> bool| {
        let all = rows.iter().enumerate().filter(move |(_, r)| wanted(r.agree));
        // Rounding, and none at all, at the lower edge.
        all.map(|(i, r)| ((i + 1) as f64, r.share().max(LEAST))).collect::<Vec<_>>()
    };
    let limits = rows.iter().enumerate().map(|(i, r)| ((i + 1) as f64, r.agree.limit()));
    let figure = Figure::new("All differences", "row of the table", "difference / peak")
        .log_y()
        .whole_x()
        .series("same law", Stroke::Rings, points(|a| matches!(a, Agree::Same | Agree::Equal)))
        .series(
            "same law, steps of OpenSees",
            Stroke::Squares,
            points(|a| matches!(a, Agree::Stepped(..))),
        )
        .series("laws that differ", Stroke::Crosses, points(|a| matches!(a, Agree::Near(..))))
        .colored("limit", Stroke::Dashes, Color::INK, limits)
        .caption("Smaller differences stand at 1e-16.");
    found.figure(figure);
}

const LEAST: f64 = 1e-16;

/// Force over deformation.
fn drawn(pair: &Pair, d: &[f64], ours: &Rows, theirs: &Rows, axis: usize) -> Figure {
    let every = pair.steps / KEPT;
    let at = |i: usize| 1e3 * d[(i + 1) * every];
    let curve = |all: &Rows| -> Vec<(f64, f64)> {
        all.iter().enumerate().map(|(i, f)| (at(i), 1e-3 * f[axis])).collect()
    };
    Figure::new(pair.name.clone(), "deformation [mm]", "force [kN]")
        .line("Trilith", curve(ours))
        .reference("OpenSees", curve(theirs))
}

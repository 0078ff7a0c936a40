//! Whole models in OpenSees, by the scripts that are exported: periods and peaks.

use crate::case::{Kind, Tolerance};
use crate::studies::frames::{BLOCK, DROP, ROCKING};
use crate::studies::runs::{largest, solution};
use crate::{Findings, Item, Outcome, Study, Trace};
use std::path::Path;
use std::time::Duration;
use trilith::solvers::LinkStiffness;
use trilith::{Analysis, Model, SolverKind};
use trilith_exchange::opensees::export::{ExportOptions, export};
use trilith_exchange::opensees::peer::{Peer, PeerRun, STEM};

const STUDY: Study = Study {
    id: "OP-2",
    title: "Exported models in OpenSees",
    source: "OpenSeesPy, run beside by the scripts of `trilith export`",
    work: compared,
};

/// The longest that a model may take there.
const LIMIT: Duration = Duration::from_secs(900);

/// The study, or why it cannot be made here.
pub(in crate::studies) fn item() -> Item {
    let Study { id, title, source, .. } = STUDY;
    match super::theirs::missing() {
        None => Item::Study(STUDY),
        Some(reason) => Item::Missing(Outcome::unavailable(id, title, source, reason)),
    }
}

/// A model and how it is run there.
struct Exported {
    name: &'static str,
    text: String,
    set: &'static [(&'static str, &'static str)],
    /// Steps there in an output step: what is left of a difference falls with them.
    substeps: usize,
    /// Why periods are not those here, where they are not.
    periods: Option<&'static str>,
}

/// Below this (SI) an output is rounding.
const NOTHING: f64 = 1e-9;
/// Largest difference of a period, and of a peak as share of the larger peak of its output.
pub(super) const PERIODS: f64 = 1e-5;
pub(super) const PEAKS: f64 = 5e-3;

const DAMPED: &str = include_str!("../../../../models/damped_frame.ron");
const FLOORS: &str = include_str!("../../../../models/floor_spectra.ron");
const PORTAL: &str = include_str!("../../../../models/portal_frame.ron");
const BUILDING: &str = include_str!("../../../../models/isolated_building.ron");
const POUNDING: &str = include_str!("../../../../models/pounding_frames.ron");

fn models() -> Vec<Exported> {
    let model = |name, text: &str, set, substeps| Exported {
        name,
        text: text.to_owned(),
        set,
        substeps,
        periods: None,
    };
    let small = &[("duration", "5 s"), ("storeys", "2"), ("bays_x", "2"), ("bays_y", "1")];
    vec![
        model("damped_frame", DAMPED, &[("duration", "8 s")], 10),
        model("floor_spectra", FLOORS, &[("duration", "12 s")], 10),
        model("rigid_block", BLOCK, &[], 10),
        Exported {
            periods: Some("contacts that touch without a load stand between open and closed"),
            ..model("rigid_block_rocking", ROCKING, &[("duration", "2.5 s")], 80)
        },
        model("rigid_block_drop", DROP, &[("duration", "3 s")], 60),
        // Its dashpots may pull as they let go, as those there do. Their force jumps as the gap closes: at the end of a
        // step there, by which time they have braked it already.
        model(
            "pounding_frames",
            &POUNDING.replace("when: InContact,", "when: InContact, pull: true,"),
            &[("duration", "3 s")],
            60,
        ),
        Exported {
            periods: Some("the braces of Wen stand between loading and unloading under their load"),
            ..model("portal_frame", PORTAL, &[("duration", "6 s")], 20)
        },
        // Unloading by the direction of the motion, as there.
        model(
            "isolated_building",
            &BUILDING.replace("kv: \"1 GN/m\"", "kv: \"1 GN/m\", coupling: Direction"),
            small,
            30,
        ),
        Exported {
            periods: Some("Maxwell's branches are stiff in the modes there, and relaxed here"),
            ..model("laws of one direction", include_str!("exported/laws.ron"), &[], 20)
        },
        model("members in space", include_str!("exported/frame.ron"), &[], 10),
        model("bearings", include_str!("exported/bearings.ron"), &[], 40),
    ]
}

/// What both gave.
struct Both {
    ours: Trace,
    theirs: PeerRun,
    periods: Vec<f64>,
}

fn compared(found: &mut Findings) -> Result<(), String> {
    let peer = Peer::find(None, LIMIT).map_err(|e| e.to_string())?;
    found.text(
        "The models are written by `trilith export --to opensees`, run by OpenSees, and its peaks and periods compared \
         with those here (HHT, adaptive steps; α as the case says, Newmark's rule for cases of FNA). Nothing is left out and no \
         law is only near. Peaks are differences of the largest and of the smallest value over all steps of both, as share of the \
         larger magnitude. Periods are those with links by their tangents after the static cases.",
    );
    let mut rows = Vec::new();
    for m in models() {
        let both = both(&m, &peer);
        let (peak, output) = both.as_ref().map_or((f64::NAN, String::new()), Both::peaks);
        let period = both.as_ref().map_or(f64::NAN, Both::apart);
        let theirs = both.as_ref().map(|b| &b.theirs);
        rows.push(vec![
            m.name.to_owned(),
            theirs.map_or(String::new(), |t| t.names.len().to_string()),
            both.as_ref()
                .map_or_else(Clone::clone, |_| format!("{:.3} % ({output})", 100.0 * peak)),
            format!("{period:.1e}{}", m.periods.map_or(String::new(), |why| format!(" ({why})"))),
            m.substeps.to_string(),
            theirs.map_or(String::new(), |t| format!("{:.1}", t.seconds)),
        ]);
        let at_most = |limit| ((limit, Kind::OtherCode), Tolerance::AtMost);
        let (reference, tolerance) = at_most(PEAKS);
        found.check(format!("{}: peaks", m.name), "", reference, tolerance, "hht", peak);
        if m.periods.is_none() {
            let (reference, tolerance) = at_most(PERIODS);
            found.check(format!("{}: periods", m.name), "", reference, tolerance, "modes", period);
        }
    }
    found.table(
        &[
            "model",
            "outputs",
            "largest difference of a peak",
            "of a period",
            "steps there",
            "s there",
        ],
        rows,
    );
    Ok(())
}

/// Models that read records lie in the folder of the examples.
fn read(m: &Exported) -> Result<Model, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/exported.ron");
    let set: Vec<(String, String)> =
        m.set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    let read = trilith::read_text(&m.text, path, &trilith::registry(), &set);
    read.map_err(|all| all.first().map_or_else(String::new, ToString::to_string))
}

fn both(m: &Exported, peer: &Peer) -> Result<Both, String> {
    let mut model = read(m)?;
    let case = model.cases.len() - 1;
    let options =
        ExportOptions { substeps: m.substeps, stem: STEM.into(), ..ExportOptions::default() };
    let made = export(&model, case, &options).map_err(|e| e.to_string())?;
    if made.losses.matter() {
        return Err(made.losses.text());
    }
    let theirs = peer.run(&made.script, None).map_err(|e| e.to_string())?;
    solution(&mut model, |s| s.step = trilith::model::StepControl::Adaptive { tolerance: 1e-5 });
    let analysis = Analysis::new(&model).map_err(|e| e.to_string())?;
    let linear = analysis
        .linearised(&LinkStiffness::Tangent, model.cases[case].after)
        .map_err(|e| e.to_string())?;
    let modes = linear.modes(theirs.periods.len().max(1)).map_err(|e| e.to_string())?;
    let moving = modes.omega2.iter().filter(|w| **w > 0.0);
    let periods = moving.map(|w| std::f64::consts::TAU / w.sqrt()).collect();
    let ours = Trace::of(&model, &analysis, SolverKind::Hht, None)?;
    if let Some(complaint) = &ours.complaint {
        return Err(complaint.clone());
    }
    Ok(Both { ours, theirs, periods })
}

impl Both {
    /// Largest difference of a period; not a number where there is none on one side.
    fn apart(&self) -> f64 {
        if self.periods.len() < self.theirs.periods.len() {
            return f64::NAN;
        }
        largest(self.theirs.periods.iter().zip(&self.periods).map(|(a, b)| (a / b - 1.0).abs()))
    }

    /// Largest difference of a peak, and the output where it is.
    fn peaks(&self) -> (f64, String) {
        let mut worst = (0.0, String::new());
        for (name, theirs) in self.theirs.names.iter().zip(&self.theirs.peaks) {
            let extreme = |sign: f64| self.ours.extreme(name, sign, 0.0, f64::INFINITY).1;
            let (ours, theirs) = ([extreme(1.0), extreme(-1.0)], [theirs[0], theirs[2]]);
            let size = ours.iter().chain(&theirs).fold(0.0, |m: f64, x| m.max(x.abs()));
            let apart = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs() / size);
            let share = largest(apart);
            // What is not a number is the worst.
            if size > NOTHING && (share.is_nan() || share >= worst.0) {
                worst = (share, name.clone());
            }
        }
        worst
    }
}

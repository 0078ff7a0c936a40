//! Scripts of OpenSees, imported and run here, and given to OpenSees command by command: periods and peaks.

use super::exported::{PEAKS, PERIODS};
use super::theirs;
use crate::case::{Kind, Tolerance};
use crate::{Findings, Item, Outcome, Study};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::path::Path;
use trilith::solvers::LinkStiffness;
use trilith::{Analysis, Model, RunOptions};
use trilith_exchange::Options;
use trilith_exchange::opensees::{self, Eigenvalues};

const STUDY: Study = Study {
    id: "OP-3",
    title: "Imported scripts in OpenSees",
    source: "OpenSeesPy, given the commands of the scripts that `trilith import` reads; written after its command manual",
    work: compared,
};

/// The study, or why it cannot be made here.
pub(in crate::studies) fn item() -> Item {
    let Study { id, title, source, .. } = STUDY;
    match theirs::missing() {
        None => Item::Study(STUDY),
        Some(reason) => Item::Missing(Outcome::unavailable(id, title, source, reason)),
    }
}

/// A script, and how many periods are compared: none where a link stands between two stiffnesses.
struct Script {
    name: &'static str,
    text: &'static str,
    periods: usize,
}

macro_rules! script {
    ($name:literal, $periods:literal) => {
        Script {
            name: $name,
            text: include_str!(concat!("../../../../crates/exchange/tests/opensees/", $name)),
            periods: $periods,
        }
    };
}

const SCRIPTS: [Script; 10] = [
    script!("cantilever.tcl", 4),
    script!("diaphragm.tcl", 5),
    script!("gap.tcl", 0),
    script!("pendulum.tcl", 0),
    script!("portal.tcl", 4),
    script!("pounding.tcl", 0),
    script!("rubber.tcl", 0),
    script!("shear.tcl", 4),
    script!("sliders.tcl", 2),
    script!("truss.tcl", 0),
];

/// Below this share of the largest output an output is rounding.
const NOTHING: f64 = 1e-9;

/// Modes with links by their tangents, which scripts ask for.
struct Modes;

impl Eigenvalues for Modes {
    fn eigenvalues(
        &self,
        text: &str,
        after: Option<&str>,
        count: usize,
    ) -> Result<Vec<f64>, String> {
        let model = read(text, Path::new(""))?;
        omega2(&model, after.and_then(|name| model.case(name)), count)
    }
}

fn omega2(model: &Model, after: Option<usize>, count: usize) -> Result<Vec<f64>, String> {
    let analysis = Analysis::new(model).map_err(|e| e.to_string())?;
    let linear = analysis.linearised(&LinkStiffness::Tangent, after).map_err(|e| e.to_string())?;
    Ok(linear.modes(count).map_err(|e| e.to_string())?.omega2)
}

/// A model whose records lie in a folder.
fn read(text: &str, folder: &Path) -> Result<Model, String> {
    let read = trilith::read_text(text, folder.join("model.ron"), &trilith::registry(), &[]);
    read.map_err(|all| all.first().map_or_else(String::new, ToString::to_string))
}

/// What one side gives: largest and smallest value of each output, and periods.
struct Side {
    outputs: Vec<String>,
    peaks: Vec<[f64; 2]>,
    periods: Vec<f64>,
}

/// A script here, and what OpenSees is given.
fn ours(script: &Script) -> Result<(Side, Value), String> {
    let options = Options { path: script.name.into(), ..Options::default() };
    let (import, commands) = opensees::with_commands(script.text.as_bytes(), &options, &Modes)
        .map_err(|e| e.to_string())?;
    if import.report.losses() > 0 {
        return Err(import.report.text());
    }
    let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
    for (name, text) in &import.files {
        std::fs::write(folder.path().join(name), text).map_err(|e| e.to_string())?;
    }
    let model = read(&import.draft.to_ron(), folder.path())?;
    let case = model.cases.len() - 1;
    let analysis = Analysis::new(&model).map_err(|e| e.to_string())?;
    let run = analysis.run(RunOptions { case, ..RunOptions::default() });
    let run = run.map_err(|e| e.to_string())?;
    let of_nodes =
        |name: &&str| name.split(' ').next().is_some_and(|tag| tag.parse::<u32>().is_ok());
    let names = model.outputs.iter().map(|o| o.name.as_str()).filter(of_nodes);
    let outputs: Vec<String> = names.map(str::to_owned).collect();
    let peaks = outputs.iter().map(|o| run.peak(o).map(|p| [p.max, p.min]));
    let peaks = peaks.collect::<Result<Vec<_>, _>>().map_err(|e| e.to_string())?;
    let found = omega2(&model, model.cases[case].after, script.periods)?;
    let periods = found.iter().take(script.periods).map(|w| TAU / w.sqrt()).collect();
    let task = json!({ "commands": commands, "outputs": &outputs, "periods": script.periods });
    Ok((Side { outputs, peaks, periods }, task))
}

fn theirs(answer: &Value) -> Result<Side, String> {
    if let Some(problem) = answer["problem"].as_str() {
        return Err(problem.to_owned());
    }
    let of = |what: &str| answer[what].clone();
    Ok(Side {
        outputs: Vec::new(),
        peaks: serde_json::from_value(of("peaks")).map_err(|e| e.to_string())?,
        periods: serde_json::from_value(of("periods")).map_err(|e| e.to_string())?,
    })
}

/// Largest difference of a peak as share of the largest magnitude of its output, and the output where it is.
fn peaks(ours: &Side, theirs: &Side) -> (f64, String) {
    let size = |peak: &[f64; 2]| peak.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let most = ours.peaks.iter().map(size).fold(0.0, f64::max);
    let mut worst = (0.0, String::new());
    for ((name, a), b) in ours.outputs.iter().zip(&ours.peaks).zip(&theirs.peaks) {
        let own = size(a).max(size(b));
        let share = (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) / own;
        if own > NOTHING * most && (share.is_nan() || share >= worst.0) {
            worst = (share, name.clone());
        }
    }
    worst
}

fn compared(found: &mut Findings) -> Result<(), String> {
    found.text(
        "Each script is read by `trilith import`, which loses nothing of it, and the case that it ends with is run here. OpenSees is given \
         the same commands one by one. Peaks are differences of the largest and of the smallest value over the last analysis, as \
         share of the larger magnitude of the output; periods those before it, links by their tangents.",
    );
    let both: Vec<_> = SCRIPTS.iter().map(ours).collect();
    let tasks: Vec<&Value> = both.iter().flatten().map(|(_, task)| task).collect();
    let mut answers = theirs::answers(include_str!("commands.py"), &json!(tasks))?.into_iter();
    let mut rows = Vec::new();
    for (script, ours) in SCRIPTS.iter().zip(both) {
        let pair = ours.and_then(|(ours, _)| {
            let answer = answers.next().ok_or("OpenSees has not answered")?;
            Ok((ours, theirs(&answer)?))
        });
        let (peak, output) =
            pair.as_ref().map_or_else(|e| (f64::NAN, e.clone()), |(a, b)| peaks(a, b));
        let apart = |(a, b): &(Side, Side)| {
            let each = a.periods.iter().zip(&b.periods).map(|(x, y)| (x / y - 1.0).abs());
            each.fold(if a.periods.len() == b.periods.len() { 0.0 } else { f64::NAN }, f64::max)
        };
        let period = pair.as_ref().map_or(f64::NAN, apart);
        let is_told = script.periods > 0;
        rows.push(vec![
            script.name.to_owned(),
            pair.as_ref().map_or(String::new(), |(a, _)| a.outputs.len().to_string()),
            format!("{:.3} % ({output})", 100.0 * peak),
            if is_told { format!("{period:.1e}") } else { "–".into() },
        ]);
        let at_most = |limit| ((limit, Kind::OtherCode), Tolerance::AtMost);
        let (reference, tolerance) = at_most(PEAKS);
        found.check(format!("{}: peaks", script.name), "", reference, tolerance, "hht", peak);
        if is_told {
            let (reference, tolerance) = at_most(PERIODS);
            found.check(
                format!("{}: periods", script.name),
                "",
                reference,
                tolerance,
                "modes",
                period,
            );
        }
    }
    found.table(&["script", "outputs", "largest difference of a peak", "of a period"], rows);
    Ok(())
}

//! Runs a structure as it is under both solvers and compares every output with the oracle.

use super::build::Structure;
use crate::Findings;
use crate::case::{Kind, Tolerance};
use crate::oracle::spec::Output;
use crate::oracle::subject::{Ended, Shown, run};
use crate::oracle::text::text;
use crate::oracle::truth::{Truth, WINDOW, outside, truth_in_steps};
use trilith::SolverKind;
use trilith_report::Figure;

/// What an output may be off, over time and at its peaks, % of its largest value: under the solver that a case has
/// where it names none, and under direct integration, which lets high modes of stiff members lag.
const ALLOWED: [f64; 2] = [1.0, 2.0];
/// What the oracle may move by between its two tolerances, %.
const SURE: f64 = 0.25;
/// Multiplications that the oracle may make.
const WORK: f64 = 1e12;
/// Points of a reference curve.
const POINTS: usize = 800;

const SOLVERS: [SolverKind; 2] = [SolverKind::Fna, SolverKind::Hht];

/// Errors of an output, % of its largest value: over time, and of its largest and smallest value.
#[derive(Clone, Copy, Debug, Default)]
struct Off {
    over_time: f64,
    at: f64,
    peak: f64,
}

fn group(output: &Output) -> &'static str {
    match output {
        Output::Displacement(..) => "displacements",
        Output::Drift(..) => "drifts",
        Output::Velocity(..) => "velocities",
        Output::Acceleration(..) => "accelerations",
        Output::End(..) => "forces of members",
        Output::LinkForce(..) => "forces of links",
        Output::LinkDeformation(..) => "deformations of links",
    }
}

/// The larger one, where what is not a number is larger than all.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

fn off(it: &Structure, truth: &Truth, shown: &Shown, i: usize) -> Off {
    let duration = it.spec.duration;
    let width = WINDOW * duration;
    let mut all = Off::default();
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    // Samples at the start stand before the first step: there are no accelerations yet.
    for (t, row) in shown.time.iter().zip(&shown.values).filter(|(t, _)| **t > 0.0) {
        let (a, b) = truth.course.span(i, (t - width).max(0.0), (t + width).min(duration));
        let share = 100.0 * outside(row[i], a, b) / truth.scale[i];
        if share > all.over_time {
            (all.over_time, all.at) = (share, *t);
        }
        (low, high) = (low.min(row[i]), high.max(row[i]));
    }
    let first = shown.time.get(1).copied().unwrap_or(0.0);
    let (a, b) = truth.course.span(i, first, duration);
    all.peak = 100.0 * (low - a).abs().max((high - b).abs()) / truth.scale[i];
    all
}

/// Compares.
pub(super) fn compare(found: &mut Findings, it: &Structure) -> Result<(), String> {
    let start = std::time::Instant::now();
    let truth =
        truth_in_steps(&it.spec, WORK, it.spec.dt).map_err(|e| format!("no oracle: {e}"))?;
    let of_oracle = start.elapsed().as_secs_f64();
    let text = text(&it.spec);
    let mut runs: Vec<Shown> = Vec::new();
    for solver in SOLVERS {
        match run(&text, solver) {
            Ended::Shown(shown) => runs.push(shown),
            Ended::Refused(m) | Ended::Panicked(m) => {
                return Err(format!("{}: {m}", solver.name()));
            }
        }
    }
    let errors: Vec<Vec<Off>> = runs
        .iter()
        .map(|shown| (0..it.names.len()).map(|i| off(it, &truth, shown, i)).collect())
        .collect();
    found.text(
        "One description gives the text of the model, run as it is at default settings, and the equations \
         of an oracle that shares nothing with the program. The error of an output is the largest difference \
         over all samples of the run, as share of the largest value of the output, where times may be \
         off by 0.02 % of the duration; a peak is the largest and the smallest value.",
    );
    let mut groups: Vec<&str> = Vec::new();
    for name in it.spec.outputs.iter().map(group) {
        if !groups.contains(&name) {
            groups.push(name);
        }
    }
    for name in groups {
        let members = || (0..it.names.len()).filter(|i| group(&it.spec.outputs[*i]) == name);
        for ((solver, errors), allowed) in SOLVERS.iter().zip(&errors).zip(ALLOWED) {
            let limit = (allowed, Kind::OtherCode);
            let mut claim = |what: String, of: &dyn Fn(&Off) -> f64| {
                let value = members().map(|i| of(&errors[i])).fold(0.0, worse);
                found.check(what, "%", limit, Tolerance::AtMost, solver.name(), value);
            };
            claim(format!("error of {name} over time"), &|o| o.over_time);
            claim(format!("error of the peaks of {name}"), &|o| o.peak);
        }
    }
    let moves = truth.moves.iter().map(|m| 100.0 * m).fold(0.0, worse);
    let what = "the oracle between tolerances of 1e-5 and 1e-7";
    found.check(what, "%", (SURE, Kind::Theory), Tolerance::AtMost, "all", moves);
    tables(found, it, &truth, &runs, &errors, of_oracle);
    for i in &it.shown {
        found.figure(figure(it, &truth, &runs, *i));
    }
    Ok(())
}

fn tables(
    found: &mut Findings,
    it: &Structure,
    truth: &Truth,
    runs: &[Shown],
    errors: &[Vec<Off>],
    of_oracle: f64,
) {
    let mut rows: Vec<Vec<String>> = SOLVERS
        .iter()
        .zip(runs)
        .zip(errors)
        .map(|((solver, run), errors)| {
            let largest = (0..errors.len())
                .max_by(|a, b| errors[*a].over_time.total_cmp(&errors[*b].over_time))
                .unwrap_or(0);
            let worst = errors[largest];
            vec![
                solver.name().to_owned(),
                run.vectors.map_or("–".into(), |n| n.to_string()),
                run.substeps.to_string(),
                format!("{:.2}", run.seconds),
                format!("{:.3} % ({} at {:.3} s)", worst.over_time, it.names[largest], worst.at),
                run.warnings.join("; "),
            ]
        })
        .collect();
    rows.push(vec![
        "oracle".into(),
        "–".into(),
        truth.course.steps.to_string(),
        format!("{of_oracle:.2}"),
        "–".into(),
        String::new(),
    ]);
    found.table(&["solver", "vectors", "steps", "time [s]", "largest error", "warnings"], rows);
    let row = |i: usize| {
        let mut row = vec![it.names[i].clone(), format!("{:.4e}", truth.size[i])];
        row.extend(
            errors
                .iter()
                .flat_map(|e| [format!("{:.3}", e[i].over_time), format!("{:.3}", e[i].peak)]),
        );
        row.push(format!("{:.4}", 100.0 * truth.moves[i]));
        row
    };
    let head = [
        "output",
        "largest (SI)",
        "fna [%]",
        "fna, peak [%]",
        "hht [%]",
        "hht, peak [%]",
        "oracle [%]",
    ];
    found.table(&head, (0..it.names.len()).map(row).collect());
}

fn figure(it: &Structure, truth: &Truth, runs: &[Shown], i: usize) -> Figure {
    let mut figure = Figure::new(it.names[i].clone(), "time [s]", format!("{} (SI)", it.names[i]));
    for (solver, run) in SOLVERS.iter().zip(runs) {
        let points: Vec<(f64, f64)> =
            run.time.iter().zip(&run.values).map(|(t, v)| (*t, v[i])).collect();
        figure = figure.line(solver.name().to_uppercase(), points);
    }
    let times = (1..=POINTS).map(|j| it.spec.duration * j as f64 / POINTS as f64);
    figure.reference("oracle", times.map(|t| (t, truth.course.at(i, t))))
}

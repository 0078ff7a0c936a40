//! Fast nonlinear analysis against direct integration on the same models: peaks and cost.

use super::frames::{BLOCK, DROP, ISOLATED, POUNDING, PlaneFrame, ROCKING};
use super::runs::{Method, SOLVERS, difference, names, run, solution};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study, Trace};
use trilith_report::{Figure, Stroke};

pub(super) const STUDIES: [Study; 1] = [Study {
    id: "AG-1",
    title: "Fast nonlinear analysis against direct integration: peaks and cost",
    source: "Wilson, Static and Dynamic Analysis of Structures, 2002, ch. 18: same model and damping, \
             same peaks, less work",
    work: agreement,
}];

/// A model that all solvers run.
struct Subject {
    name: &'static str,
    text: String,
    set: Vec<(&'static str, f64)>,
    /// Vectors of the basis; none: chosen by the program.
    vectors: Option<usize>,
}

impl Subject {
    fn run(&self, method: Method) -> Result<Trace, String> {
        let set: Vec<(&str, &dyn ToString)> =
            self.set.iter().map(|(n, v)| (*n, v as &dyn ToString)).collect();
        run(&self.text, &set, method, |model| {
            solution(model, |s| s.basis.vectors = self.vectors);
        })
        .map_err(|e| format!("{}: {e}", self.name))
    }
}

fn subjects() -> Vec<Subject> {
    let shipped = |name, text: &str, set: &[(&'static str, f64)]| Subject {
        name,
        text: text.to_owned(),
        set: set.to_vec(),
        vectors: None,
    };
    vec![
        shipped("block, slides", BLOCK, &[("mu", 0.2), ("ah", 0.5)]),
        shipped("block, rocks", BLOCK, &[("mu", 2.0), ("ah", 0.8)]),
        shipped("block, slides and rocks", BLOCK, &[]),
        shipped("block, free rocking", ROCKING, &[]),
        shipped("block, drop", DROP, &[]),
        shipped("isolated frame", ISOLATED, &[]),
        shipped("pounding frames", POUNDING, &[]),
        Subject {
            name: "plane frame",
            text: PlaneFrame { bays: 8, storeys: 12, parts: 4 }.text(),
            set: Vec::new(),
            vectors: Some(120),
        },
    ]
}

fn agreement(found: &mut Findings) -> Result<(), String> {
    found.text(
        "Every model under every solver, with the same damping, the same laws and the same step control \
         (adaptive, tolerance 1e-4). The difference is the largest over the peaks of all outputs, each \
         as share of the larger peak of that output. Full-newton assembles and factorises the tangent in \
         every iteration: the textbook baseline. Times are CPU times of this run and carry no verdict; \
         the clock of a thread may tick in 4 ms, so those of the blocks tell little. The plane frame has \
         nine isolators and two stops; its basis is 120 Ritz vectors, enough by its own certificate.",
    );
    let subjects = subjects();
    let mut rows = Vec::new();
    let mut cost: Vec<Vec<(f64, f64)>> = vec![Vec::new(); SOLVERS.len()];
    for (i, subject) in subjects.iter().enumerate() {
        let runs: Vec<Trace> = SOLVERS.iter().map(|m| subject.run(*m)).collect::<Result<_, _>>()?;
        let outputs = names(&runs[0]);
        for (j, (method, run)) in SOLVERS.iter().zip(&runs).enumerate() {
            let w = &run.work;
            let (share, output) = difference(&runs[0], run, &outputs);
            let against = match j {
                0 => "–".into(),
                _ => format!("{:.3} % ({output})", 100.0 * share),
            };
            rows.push(vec![
                subject.name.to_owned(),
                run.equations.to_string(),
                run.basis.as_ref().map_or("–".into(), |b| b.vectors.to_string()),
                method.name.to_owned(),
                against,
                w.substeps.to_string(),
                w.iterations.to_string(),
                w.factorizations.to_string(),
                format!("{:.3}", w.setup_cpu_s),
                format!("{:.3}", w.march_cpu_s),
            ]);
            // A tick of the clock, so that what is faster than it has a place.
            cost[j].push((i as f64 + 1.0, (w.setup_cpu_s + w.march_cpu_s).max(0.004)));
            if j > 0 {
                let what = format!("{}: difference of peaks, {} − fna", subject.name, method.name);
                let limit = (0.5, Kind::Theory);
                let name = method.solver.name();
                found.check(what, "%", limit, Tolerance::AtMost, name, 100.0 * share);
            }
        }
        // Two ways to the solution of the same equations.
        let (share, _) = difference(&runs[1], &runs[3], &outputs);
        let what = format!("{}: difference of peaks, full-newton − hht", subject.name);
        let limit = (0.01, Kind::Theory);
        found.check(what, "%", limit, Tolerance::AtMost, "full-newton", 100.0 * share);
    }
    let head = [
        "model",
        "equations",
        "vectors",
        "solver",
        "difference to fna",
        "substeps",
        "iterations",
        "factorisations",
        "setup CPU [s]",
        "march CPU [s]",
    ];
    found.table(&head, rows);
    let listed: Vec<String> =
        subjects.iter().enumerate().map(|(i, s)| format!("{} {}", i + 1, s.name)).collect();
    let mut figure = Figure::new("Cost of a run", "model", "setup and march, CPU [s]")
        .log_y()
        .whole_x()
        .caption(format!("{}.", listed.join(", ")));
    let strokes = [Stroke::Rings, Stroke::Crosses, Stroke::Squares, Stroke::Rings];
    for ((method, stroke), points) in SOLVERS.iter().zip(strokes).zip(cost) {
        figure = figure.series(method.name, stroke, points);
    }
    found.figure(figure);
    Ok(())
}

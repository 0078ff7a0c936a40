//! How the cost grows, one cause at a time.

use crate::clock::median;
use crate::fit::Power;
use crate::{Effort, Measurement, Task, find, measure};
use serde::Serialize;
use std::time::Instant;
use trilith::generate::Frame;
use trilith::solvers::Observer;
use trilith::{Analysis, RunOptions, SolverKind};

/// One quantity over its cause.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// What it is.
    pub name: String,
    /// (cause, value).
    pub points: Vec<(f64, f64)>,
    /// The power law through the points.
    pub law: Option<Power>,
}

impl Curve {
    /// With its law.
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        let law = Power::through(&points);
        Self { name: name.into(), points, law }
    }
}

/// One cause.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Growth {
    /// Short name.
    pub id: &'static str,
    /// The cause, with its unit.
    pub cause: &'static str,
    /// The quantities, with their unit.
    pub quantity: &'static str,
    /// What is held fixed.
    pub fixed: String,
    /// The quantities.
    pub curves: Vec<Curve>,
}

/// Short: enough for an exponent.
const EFFORT: Effort = Effort { runs: 3, budget: 1.0 };

fn task(solver: SolverKind, vectors: usize, steps: usize) -> Task {
    Task { solver, vectors: Some(vectors), steps, substeps: 1, offset: 4.0 }
}

/// Measures the growth with degrees of freedom, links, basis, steps and threads.
///
/// # Errors
/// A sentence where a frame cannot be run.
pub fn grow(threads: usize) -> Result<Vec<Growth>, String> {
    let all = [unknowns()?, links()?, basis()?, steps()?, parallel(threads)?];
    Ok(all.into_iter().collect())
}

type Read = fn(&Measurement) -> f64;

fn curves(measured: &[(f64, Measurement)], wanted: &[(&str, SolverKind, Read)]) -> Vec<Curve> {
    wanted
        .iter()
        .map(|(name, solver, read)| {
            let of = measured.iter().filter(|(_, m)| m.solver == solver.name());
            Curve::new(*name, of.map(|(x, m)| (*x, read(m))).collect())
        })
        .collect()
}

fn unknowns() -> Result<Growth, String> {
    let mut measured = Vec::new();
    for cuts in [1, 2, 4, 8] {
        let frame = Frame { bays: [3, 3], storeys: 5, cuts, ..Frame::default() };
        for (solver, steps) in [(SolverKind::Fna, 1000), (SolverKind::Hht, 100)] {
            let m = measure("frame", &frame.to_ron(), task(solver, 48, steps), EFFORT)?;
            measured.push((m.dof as f64, m));
        }
    }
    Ok(Growth {
        id: "dof",
        cause: "degrees of freedom",
        quantity: "CPU time [ms]",
        fixed:
            "3 by 3 bays, 5 storeys, 16 isolators, 48 vectors; members cut in 1, 2, 4, 8 elements"
                .into(),
        curves: curves(
            &measured,
            &[
                ("FNA step", SolverKind::Fna, |m| 1e3 * m.step_s),
                ("HHT step", SolverKind::Hht, |m| 1e3 * m.step_s),
                ("FNA set-up", SolverKind::Fna, |m| 1e3 * m.setup_s),
                ("HHT set-up", SolverKind::Hht, |m| 1e3 * m.setup_s),
                ("reading and assembly", SolverKind::Fna, |m| 1e3 * (m.parse_s + m.assembly_s)),
            ],
        ),
    })
}

fn links() -> Result<Growth, String> {
    let mut measured = Vec::new();
    // 180 joints each time.
    for (bays, storeys) in [([2, 2], 19), ([3, 2], 14), ([5, 4], 5), ([9, 5], 2), ([9, 8], 1)] {
        let frame = Frame { bays, storeys, ..Frame::default() };
        for (solver, steps) in [(SolverKind::Fna, 1000), (SolverKind::Hht, 300)] {
            let m = measure("frame", &frame.to_ron(), task(solver, 64, steps), EFFORT)?;
            measured.push((m.links as f64, m));
        }
    }
    Ok(Growth {
        id: "links",
        cause: "link coordinates",
        quantity: "CPU time [µs]",
        fixed: "180 joints (1080 degrees of freedom), 64 vectors; from 9 columns of 19 storeys to 90 of 1".into(),
        curves: curves(
            &measured,
            &[
                ("FNA step", SolverKind::Fna, |m| 1e6 * m.step_s),
                ("HHT step", SolverKind::Hht, |m| 1e6 * m.step_s),
            ],
        ),
    })
}

/// The frame of about a thousand degrees of freedom.
fn thousand() -> Result<String, String> {
    find("P1e3").map(|s| s.frame().to_ron()).ok_or_else(|| "there is no P1e3".into())
}

fn basis() -> Result<Growth, String> {
    let text = thousand()?;
    let mut measured = Vec::new();
    for vectors in [12, 24, 48, 96, 192] {
        let m = measure("P1e3", &text, task(SolverKind::Fna, vectors, 1000), EFFORT)?;
        measured.push((m.vectors as f64, m));
    }
    Ok(Growth {
        id: "basis",
        cause: "vectors of the basis",
        quantity: "CPU time [µs]",
        fixed: "P1e3: 1080 degrees of freedom, 62 link coordinates".into(),
        curves: curves(
            &measured,
            &[
                ("FNA step", SolverKind::Fna, |m| 1e6 * m.step_s),
                ("FNA set-up", SolverKind::Fna, |m| 1e6 * m.setup_s),
            ],
        ),
    })
}

fn steps() -> Result<Growth, String> {
    let text = thousand()?;
    let mut all = Vec::new();
    for (solver, counts) in [
        (SolverKind::Fna, [500, 1000, 2000, 4000, 8000]),
        (SolverKind::Hht, [100, 200, 400, 800, 1600]),
    ] {
        let mut points = Vec::new();
        for steps in counts {
            // From the start, so that strong and weak motion have the same share.
            let task = Task { solver, vectors: None, steps, substeps: 1, offset: 4.0 };
            let m = measure("P1e3", &text, task, EFFORT)?;
            points.push((steps as f64, 1e3 * m.step_s * steps as f64));
        }
        all.push(Curve::new(format!("{} march", solver.name().to_uppercase()), points));
    }
    Ok(Growth {
        id: "steps",
        cause: "steps",
        quantity: "CPU time [ms]",
        fixed: "P1e3, 96 vectors; the motion from 4 s on, repeated from its end".into(),
        curves: all,
    })
}

/// Runs that have nothing to do with each other, on as many threads as there are.
fn parallel(most: usize) -> Result<Growth, String> {
    let text = thousand()?;
    let subject = crate::Subject::new(&text, task(SolverKind::Fna, 96, 1000))?;
    let analysis = Analysis::new(&subject.model).map_err(|e| e.to_string())?;
    let once = || {
        let options = RunOptions {
            case: subject.case,
            solver: Some(subject.solver),
            ..RunOptions::default()
        };
        let mut gauge = crate::Gauge::default();
        let observers: &mut [&mut dyn Observer] = &mut [&mut gauge];
        trilith::solvers::run(&subject.model, analysis.system(), options, observers).is_ok()
    };
    const RUNS: usize = 8;
    let mut points = Vec::new();
    for threads in 1..=most {
        let mut rates = Vec::new();
        for _ in 0..3 {
            let start = Instant::now();
            let good = std::thread::scope(|scope| {
                let workers: Vec<_> =
                    (0..threads).map(|_| scope.spawn(|| (0..RUNS).all(|_| once()))).collect();
                workers.into_iter().all(|w| w.join().unwrap_or(false))
            });
            if !good {
                return Err("a run among several failed".into());
            }
            rates.push((RUNS * threads) as f64 / start.elapsed().as_secs_f64());
        }
        points.push((threads as f64, median(rates)));
    }
    Ok(Growth {
        id: "threads",
        cause: "threads",
        quantity: "runs in a second of wall-clock time",
        fixed: "P1e3, 96 vectors, 1000 steps and the basis anew for every run".into(),
        curves: vec![Curve::new("FNA runs", points)],
    })
}

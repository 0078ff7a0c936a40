//! What must not matter: output step, dummy stiffness; and what the tolerance buys.

use super::frames::{BLOCK, ISOLATED};
use super::runs::{FNA, HHT, Method, difference, dynamic, largest, names, run, solution};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study, Trace};
use trilith::Model;
use trilith::model::{Body, StepControl};
use trilith_report::{Figure, Stroke};

pub(super) const STUDIES: [Study; 3] = [
    Study {
        id: "ST-1",
        title: "Peaks do not depend on the output step",
        source: "The step control cuts output steps until the local error is below its tolerance",
        work: output_step,
    },
    Study {
        id: "ST-2",
        title: "Peaks do not depend on the dummy stiffness",
        source: "With a complete basis the dummies are algebra: what they add to the structure the links \
                 take out again (Wilson 2002, ch. 18)",
        work: dummy,
    },
    Study {
        id: "ST-3",
        title: "What the tolerance buys",
        source: "The error of a run falls with the tolerance of its steps",
        work: tolerance,
    },
];

/// A model and what of it is compared: displacements, and forces and accelerations.
struct Subject {
    name: &'static str,
    text: &'static str,
    /// Long enough to hold the peaks, s.
    duration: f64,
    /// Output steps, finest first, s.
    steps: [f64; 4],
}

/// The block that slides and rocks, and the isolated frame.
const SUBJECTS: [Subject; 2] = [
    Subject { name: "block", text: BLOCK, duration: 1.0, steps: [1e-5, 1e-4, 1e-3, 1e-2] },
    Subject {
        name: "isolated frame",
        text: ISOLATED,
        duration: 4.0,
        steps: [2e-4, 1e-3, 5e-3, 2e-2],
    },
];

impl Subject {
    /// A run with a tolerance; energy it misses is no error here but what is looked at.
    fn run(
        &self,
        method: Method,
        tolerance: f64,
        change: impl FnOnce(&mut Model),
    ) -> Result<Trace, String> {
        run(self.text, &[("duration", &self.duration)], method, |model| {
            solution(model, |s| {
                s.step = StepControl::Adaptive { tolerance };
                s.energy_limit = 1e9;
            });
            change(model);
        })
    }
}

/// Differences of the peaks of displacements and of all others, in per cent.
fn differences(a: &Trace, b: &Trace) -> (f64, f64) {
    let force =
        |n: &&str| ["force", "shear", "compression", "acceleration"].iter().any(|w| n.contains(w));
    let (forces, displacements): (Vec<&str>, Vec<&str>) = names(a).into_iter().partition(force);
    (100.0 * difference(a, b, &displacements).0, 100.0 * difference(a, b, &forces).0)
}

fn both((a, b): (f64, f64)) -> f64 {
    largest([a, b])
}

/// A point for a logarithmic axis, where a difference of rounding only stands at the bottom.
fn shown(x: f64, y: f64) -> (f64, f64) {
    (x, y.max(1e-7))
}

fn output_step(found: &mut Findings) -> Result<(), String> {
    found.text(
        "Output steps of three and of two decades, tolerance 1e-6, against the finest output step of FNA. \
         At the finest ones the march cannot take longer steps than it is asked to show, so they are \
         also a check of its error control.",
    );
    let mut figure =
        Figure::new("Output step", "output step [s]", "difference of peaks [%]").log_log();
    for subject in &SUBJECTS {
        let finest = subject.run(FNA, 1e-6, |m| dynamic(m, |c| c.dt = subject.steps[0]))?;
        for (method, stroke) in [(FNA, Stroke::Rings), (HHT, Stroke::Crosses)] {
            let mut points = Vec::new();
            for dt in subject.steps {
                // The finest step of FNA is the reference itself.
                if method.name == FNA.name && dt == subject.steps[0] {
                    continue;
                }
                let r = subject.run(method, 1e-6, |m| dynamic(m, |c| c.dt = dt))?;
                points.push((dt, both(differences(&finest, &r))));
            }
            let worst = largest(points.iter().map(|p| p.1));
            let what = format!("{}, {}: difference of peaks", subject.name, method.name);
            let limit = (0.5, Kind::Theory);
            found.check(what, "%", limit, Tolerance::AtMost, method.solver.name(), worst);
            let label = format!("{}, {}", subject.name, method.name);
            figure = figure.series(label, stroke, points.into_iter().map(|(x, y)| shown(x, y)));
        }
    }
    found.figure(figure);
    Ok(())
}

/// Gives every link coordinate a dummy of this share of its engaged stiffness.
fn dummies(model: &mut Model, share: f64) {
    for element in &mut model.elements {
        if let Body::Link(law, options) = &mut element.body {
            let n = law.coordinates().len();
            let mut k = vec![0.0; n * n];
            law.engaged_stiffness(&mut k);
            options.effective_stiffness = Some((0..n).map(|i| share * k[i * (n + 1)]).collect());
        }
    }
}

fn dummy(found: &mut Findings) -> Result<(), String> {
    const SHARES: [f64; 6] = [1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.0];
    found.text(
        "FNA with dummies of a share of the stiffness of every link where it is engaged, against none at \
         all, on the complete basis, tolerance 1e-6. A stiff dummy costs no accuracy but steps: the \
         pseudo-force of an open contact is then large, and only linear in the step.",
    );
    let x = "dummy / engaged stiffness";
    let mut figure = Figure::new("Dummy stiffness", x, "difference of peaks [%]").log_log();
    let mut steps = Figure::new("Dummy stiffness", x, "substeps").log_log();
    for subject in &SUBJECTS {
        let none = subject.run(FNA, 1e-6, |_| {})?;
        let (mut points, mut substeps) = (Vec::new(), Vec::new());
        for share in SHARES {
            let r = subject.run(FNA, 1e-6, |m| dummies(m, share))?;
            points.push((share, both(differences(&none, &r))));
            substeps.push((share, r.work.substeps as f64));
        }
        let worst = largest(points.iter().map(|p| p.1));
        let what = format!("{}: difference of peaks", subject.name);
        found.check(what, "%", (0.5, Kind::Theory), Tolerance::AtMost, "fna", worst);
        let points = points.into_iter().map(|(x, y)| shown(x, y));
        figure = figure.series(subject.name, Stroke::Rings, points);
        steps = steps.series(subject.name, Stroke::Rings, substeps);
    }
    found.figure(figure);
    found.figure(steps);
    Ok(())
}

fn tolerance(found: &mut Findings) -> Result<(), String> {
    const TOLERANCES: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
    found.text(
        "Runs of rising accuracy against FNA with a tolerance of 1e-7. The default is 1e-4. On the frame \
         1e-3 and 1e-2 give the same run: no step is halved then, and the output step alone decides. \
         The local error of a rule of order two is dt³, so dt goes with the cube root of the tolerance \
         and the error of a run with its power 2/3: a factor of 4.6 from line to line. The forces of \
         dampers and isolators carry the fast modes and are four times as far off as displacements.",
    );
    let x = "tolerance";
    let mut steps = Figure::new("Work", x, "substeps").log_log();
    let mut rows = Vec::new();
    for subject in &SUBJECTS {
        let mut figure = Figure::new(subject.name, x, "difference of peaks [%]").log_log();
        let finest = subject.run(FNA, 1e-7, |_| {})?;
        for (method, stroke) in [(FNA, Stroke::Rings), (HHT, Stroke::Crosses)] {
            let (mut points, mut substeps) = (Vec::new(), Vec::new());
            for tolerance in TOLERANCES {
                let r = subject.run(method, tolerance, |_| {})?;
                let (displacements, forces) = differences(&finest, &r);
                points.push((tolerance, displacements, forces));
                substeps.push((tolerance, r.work.substeps as f64));
                rows.push(vec![
                    subject.name.to_owned(),
                    method.name.to_owned(),
                    format!("{tolerance:e}"),
                    format!("{displacements:.4}"),
                    if forces > 0.0 { format!("{forces:.4}") } else { "–".into() },
                    r.work.substeps.to_string(),
                    r.energies()
                        .last()
                        .map_or("–".into(), |e| format!("{:.1e}", e.1.error_relative)),
                ]);
            }
            let label = format!("{}, {}", subject.name, method.name);
            let solver = method.solver.name();
            let mut claim = |what: &str, unit, limit, value| {
                let what = format!("{label}: {what}");
                found.check(what, unit, (limit, Kind::Theory), Tolerance::AtMost, solver, value);
            };
            let at = |i: usize| (points[i].1, points[i].2);
            claim("displacements at the default tolerance", "%", 0.5, at(2).0);
            claim("all peaks at 1e-6", "%", 0.1, both(at(4)));
            claim("error at 1e-6 over that at 1e-3", "", 0.1, both(at(4)) / both(at(1)));
            claim("substeps at 1e-2 over those at 1e-6", "", 0.5, substeps[0].1 / substeps[4].1);
            figure = figure.series(
                format!("{}, displacements", method.name),
                stroke,
                points.iter().map(|p| shown(p.0, p.1)),
            );
            if points.iter().any(|p| p.2 > 0.0) {
                let forces = points.iter().map(|p| shown(p.0, p.2));
                figure = figure.series(format!("{}, forces", method.name), stroke, forces);
            }
            steps = steps.series(label, stroke, substeps);
        }
        found.figure(figure);
    }
    found.figure(steps);
    let head = [
        "model",
        "solver",
        "tolerance",
        "displacements [%]",
        "forces [%]",
        "substeps",
        "energy error",
    ];
    found.table(&head, rows);
    Ok(())
}

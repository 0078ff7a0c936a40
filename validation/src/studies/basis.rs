//! How many vectors a basis needs.

use super::frames::PlaneFrame;
use super::runs::{FNA, HHT, Method, RITZ_HHT, difference, run, solution};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study, Trace};
use trilith::model::{BasisKind, StepControl};
use trilith_report::{Figure, Stroke};

pub(super) const STUDIES: [Study; 1] = [Study {
    id: "BA-1",
    title: "Convergence of the basis: load-dependent Ritz vectors and eigenvectors",
    source: "Wilson, Yuan, Dickens 1982; Wilson 2002, ch. 14: Ritz vectors need fewer than eigenvectors",
    work: convergence,
}];

const FRAME: PlaneFrame = PlaneFrame { bays: 4, storeys: 8, parts: 2 };
const VECTORS: [usize; 13] = [4, 8, 12, 15, 18, 22, 26, 32, 40, 60, 90, 120, 150];
/// More Ritz vectors than the loads can show: those that would be rounding must not come in.
const TOO_MANY: usize = 150;

fn frame(text: &str, method: Method, basis: Option<(BasisKind, usize)>) -> Result<Trace, String> {
    run(text, &[], method, |model| {
        solution(model, |s| {
            s.step = StepControl::Fixed { substeps: 4 };
            s.energy_limit = 1e9;
            if let Some((kind, vectors)) = basis {
                (s.basis.kind, s.basis.vectors) = (kind, Some(vectors));
                // The study is about small bases.
                s.basis.tolerance = 1.0;
            }
        });
    })
}

/// What a basis of so many vectors gave.
struct Point {
    vectors: usize,
    kept: usize,
    adequacy: f64,
    drifts: f64,
    links: f64,
    /// The link output that is farthest off.
    worst: String,
    /// Drifts of FNA: basis and time rule together.
    fna: f64,
}

fn convergence(found: &mut Findings) -> Result<(), String> {
    let text = FRAME.text();
    let whole = frame(&text, HHT, None)?;
    let drifts: Vec<String> = (1..=FRAME.storeys).map(|k| format!("drift{k}")).collect();
    let drifts: Vec<&str> = drifts.iter().map(String::as_str).collect();
    let links = ["base", "isolator_shear", "isolator_compression", "stop_left", "stop_right"];
    let mut figure = Figure::new("Plane frame on isolators", "vectors", "difference of peaks")
        .log_log()
        .caption("Of all drifts, and of all link outputs, against direct integration on all DOFs.");
    let mut rows = Vec::new();
    for (name, kind) in [("Ritz", BasisKind::Ritz), ("eigen", BasisKind::Eigen)] {
        let mut points = Vec::new();
        for vectors in VECTORS.into_iter().filter(|n| kind == BasisKind::Ritz || *n < TOO_MANY) {
            let run = |method| frame(&text, method, Some((kind, vectors)));
            let (reduced, fna) = (run(RITZ_HHT)?, run(FNA)?);
            let basis = reduced.basis.as_ref().ok_or("a reduced run without basis")?;
            let (worst_link, worst) = difference(&whole, &reduced, &links);
            points.push(Point {
                vectors,
                kept: basis.vectors,
                adequacy: basis.adequacy.first().map_or(1.0, |a| a.share),
                drifts: difference(&whole, &reduced, &drifts).0,
                links: worst_link,
                worst,
                fna: difference(&whole, &fna, &drifts).0,
            });
        }
        let percent = |x: f64| format!("{:.3}", 100.0 * x);
        rows.extend(points.iter().map(|p| {
            vec![
                name.to_owned(),
                p.vectors.to_string(),
                p.kept.to_string(),
                percent(p.drifts),
                format!("{} ({})", percent(p.links), p.worst),
                percent(p.fna),
                format!("{:.4}", p.adequacy),
            ]
        }));
        let stroke = if kind == BasisKind::Ritz { Stroke::Line } else { Stroke::Dashes };
        let curve = |f: fn(&Point) -> f64| points.iter().map(move |p| (p.vectors as f64, f(p)));
        figure = figure.series(format!("{name}, drifts"), stroke, curve(|p| p.drifts)).series(
            format!("{name}, links"),
            stroke,
            curve(|p| p.links),
        );
        if kind == BasisKind::Ritz {
            claims(found, &points);
        }
    }
    figure = figure.reference("1 %", [(4.0, 0.01), (TOO_MANY as f64, 0.01)]);
    found.text(format!(
        "A frame of {} equations with twelve link coordinates, solved by HHT with fixed steps of 1.25 ms \
         on all DOFs and on bases of growing size, so that nothing but the basis differs; FNA on the same \
         bases beside it, with its own time rule. Both kinds of basis hold a static vector of every link \
         coordinate as soon as there is room for it (here from 16 vectors). Up to there they are few, and \
         what they take is missing for the frame: the drifts are worse with 18 vectors than with 15.",
        whole.equations
    ));
    found.text(
        "On this frame eigenvectors do as well as Ritz vectors and, beyond 30, better: its low modes are \
         all sway, so hardly one of them is wasted, while half of the Ritz recursion starts from gravity. \
         The classical advantage of Ritz vectors shows where many low modes are not excited; and they \
         need no search. The adequacy is the share of the flexibility at the links; it says nothing of \
         the drifts here, because the isolated structure moves on soft dummies as a rigid body. \
         An isolator that has lifted off lands on a contact of 1 GN/m: its force asks for the fast axial \
         modes of the columns and comes last.",
    );
    found.figure(figure);
    let head =
        ["basis", "asked for", "kept", "drifts [%]", "links [%]", "drifts of FNA [%]", "adequacy"];
    found.table(&head, rows);
    Ok(())
}

type Measure = fn(&Point) -> f64;

fn claims(found: &mut Findings, points: &[Point]) {
    let mut claim = |vectors: usize, method: Method, what: &str, limit: f64, value: Measure| {
        let value = points.iter().find(|p| p.vectors == vectors).map_or(f64::NAN, value);
        let what = format!("{what} of {} against hht, {vectors} Ritz vectors", method.name);
        let (limit, solver) = ((limit, Kind::Theory), method.solver.name());
        found.check(what, "%", limit, Tolerance::AtMost, solver, 100.0 * value);
    };
    claim(32, RITZ_HHT, "drifts", 2.0, |p| p.drifts);
    claim(60, RITZ_HHT, "drifts", 0.5, |p| p.drifts);
    claim(60, RITZ_HHT, "links", 1.0, |p| p.links);
    claim(60, FNA, "drifts", 0.5, |p| p.fna);
    claim(120, RITZ_HHT, "drifts", 0.05, |p| p.drifts);
    claim(120, RITZ_HHT, "links", 0.5, |p| p.links);
    claim(TOO_MANY, RITZ_HHT, "drifts", 0.05, |p| p.drifts);
    claim(TOO_MANY, RITZ_HHT, "links", 0.5, |p| p.links);
    claim(TOO_MANY, FNA, "drifts", 0.5, |p| p.fna);
}

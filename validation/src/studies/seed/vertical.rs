//! Figures 7 and 8: vertical sine pulses below and above gravity; stability far above it.

use super::reference;
use super::{BLOCK, BOTH, millimetres, run};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use trilith_report::Figure;

const SOURCE: &str = "The paper's figures 7 and 8; free flight of a rigid block; block of compliant \
                      contacts, event-driven (independent code)";

pub(super) fn studies() -> Vec<Study> {
    let study = |id, title, work| Study { id, title, source: SOURCE, work };
    vec![
        study("FIG-7", "Vertical 0.9 g: no uplift", below),
        study("FIG-8", "Vertical 1.5 g: free flight in every cycle", above),
        study("FIG-8b", "Vertical motion far above 1 g is stable", stable),
    ]
}

fn below(f: &mut Findings) -> Result<(), String> {
    uplift(f, "v0.9_cont")
}

fn above(f: &mut Findings) -> Result<(), String> {
    f.text(
        "The flight of a rigid block on rigid ground rises 8.023 mm, of this one on its contacts 8.247 mm; \
         on contacts a hundred times as stiff 8.046 mm (independent code).",
    );
    uplift(f, "v1.5_cont")?;
    // Lift-off at sin ωt = 1/1.5, ballistic from there on.
    let case = reference::case("v1.5_cont")?;
    for solver in BOTH {
        let trace = run(BLOCK, &case.stiffer(1e4), solver, |_| {})?;
        f.check(
            "uplift, contacts 10 000 times as stiff, against rigid flight",
            "mm",
            (8.023_06, Kind::ClosedForm),
            Tolerance::Relative(5e-3),
            solver.name(),
            1e3 * trace.max("uplift_right", 0.0, 0.24),
        );
    }
    Ok(())
}

fn uplift(f: &mut Findings, name: &str) -> Result<(), String> {
    let case = reference::case(name)?;
    let mut figure = Figure::new("Uplift at the base", "time [s]", "uplift [mm]");
    for solver in BOTH {
        let trace = run(BLOCK, &case.parameters(), solver, |_| {})?;
        let shown = trace.history("uplift_right").into_iter().filter(|(t, _)| *t <= 1.0);
        figure = figure.line(solver.name().to_uppercase(), millimetres(shown.collect()));
        let claim = |x: f64| (1e3 * x, Kind::OtherCode);
        let largest = trace.max("uplift_right", 0.0, f64::INFINITY);
        let limit = Tolerance::Relative(5e-3);
        f.check(
            "largest uplift",
            "mm",
            claim(case.peaks.up_r),
            limit,
            solver.name(),
            1e3 * largest,
        );
        let slide = 1e3 * trace.peak("slide", 0.0, f64::INFINITY);
        let none = (1e-6, Kind::Theory);
        f.check("slide, largest", "mm", none, Tolerance::AtMost, solver.name(), slide);
    }
    let history = reference::history(name)?.ok_or("no history")?;
    let marks = history.of("uplift_right").filter(|(t, _)| *t <= 1.0).collect();
    f.figure(figure.marks("independent code", millimetres(marks)));
    Ok(())
}

/// Largest uplift over a base of acceleration amplitude `a` (g) at `w` (rad/s). The speed v of a launch
/// holds at most that of the base, V = a g/ω, and what the contact returns of a landing at V + v, and of
/// its compression by (1 + a) g: v ≤ V + e (V + v) + 2 (1 + a) g/ω_c. The base may be 2 V/ω lower then.
fn highest(a: f64, w: f64) -> f64 {
    let (g, e, contact) = (9.81, 0.25, (2.0 * 5e8 / 10e3_f64).sqrt());
    let base = a * g / w;
    let launch = ((1.0 + e) * base + 2.0 * (1.0 + a) * g / contact) / (1.0 - e);
    launch * launch / (2.0 * g) + 2.0 * base / w
}

/// Continuous sines of 1.5, 2 and 3 g: bounded, and the energy balance holds.
fn stable(f: &mut Findings) -> Result<(), String> {
    f.text(
        "The block flies and lands at any phase of the base. The bound is that of a launch that the base, \
         the restitution of the landing and the contact's compression give together; an unstable run passes \
         it, and does not keep its energy.",
    );
    let mut figure = Figure::new("Uplift under vertical sines", "time [s]", "uplift [mm]");
    for av in [1.5, 2.0, 3.0] {
        let set = [("ah", 0.0), ("av", av), ("cycles_v", 1e3), ("mu", 0.4), ("duration", 10.0)];
        for solver in BOTH {
            // A run that misses its energy limit of 0.1 % is an error here.
            let trace = run(BLOCK, &set, solver, |_| {})?;
            f.check(
                format!("largest uplift in 10 s, {av} g"),
                "mm",
                (1e3 * highest(av, 10.0 * std::f64::consts::PI), Kind::Theory),
                Tolerance::AtMost,
                solver.name(),
                1e3 * trace.max("uplift_right", 0.0, f64::INFINITY),
            );
            let error = trace.energies().last().map_or(f64::NAN, |(_, e)| e.error_relative);
            f.check(
                format!("energy not accounted for, {av} g"),
                "%",
                (0.1, Kind::Theory),
                Tolerance::AtMost,
                solver.name(),
                100.0 * error,
            );
            if solver == BOTH[0] {
                let points = trace.history("uplift_right").into_iter().filter(|(t, _)| *t <= 2.0);
                figure = figure.line(format!("{av} g"), millimetres(points.collect()));
            }
        }
    }
    f.figure(figure);
    Ok(())
}

//! Figure 9: the block lifted, dropped and thrown back.

use super::plots::{Plot, Seen};
use super::{BOTH, DROP, PAPER, reference, replace, run};
use crate::case::{Kind, Tolerance};
use crate::unit::INCH;
use crate::{Findings, Study, Trace};
use trilith::model::{AfterEnd, Interpolation, Table, TimeFunction};

/// Of the shipped model: gravity, mass.
const G: f64 = 9.81;
const MASS: f64 = 1e4;
/// Time the force takes to drop, s: with it a rigid block rises to the 149.7 in of the paper.
const FALL: f64 = 0.0335;

pub(super) fn studies() -> Vec<Study> {
    let title = "Bounce-back in the free-fall test";
    vec![Study { id: "FIG-9", title, source: PAPER, work }]
}

/// Peak of the flight and of the first rebound, m.
fn heights(trace: &Trace) -> (f64, f64) {
    let crossing = |n| trace.crossing("uplift_left", 0.0, n);
    // It rises, lands, leaves and lands again.
    let peak = trace.max("uplift_left", crossing(0), crossing(1));
    (peak, trace.max("uplift_left", crossing(2), crossing(3)))
}

/// Rebound over drop height of a mass that falls on a spring and a dashpot under gravity and leaves
/// where it comes up to the level of touching.
fn ratio(height: f64, kn: f64, cv: f64) -> f64 {
    // Two feet.
    let omega = (2.0 * kn / MASS).sqrt();
    let zeta = cv / (2.0 * kn * MASS).sqrt();
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    let rest = G / (omega * omega);
    let v = (2.0 * G * height).sqrt();
    let (c, d) = (rest, (zeta * omega * rest - v) / damped);
    let decay = |t: f64| (-zeta * omega * t).exp();
    let at = |t: f64| decay(t) * (c * (damped * t).cos() + d * (damped * t).sin()) - rest;
    // It comes up before, and a little after, half a damped period.
    let (mut low, mut high) =
        (0.5 * std::f64::consts::PI / damped, 1.5 * std::f64::consts::PI / damped);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if at(middle) < 0.0 { low = middle } else { high = middle }
    }
    let (sin, cos) = (damped * low).sin_cos();
    let speed = decay(low)
        * ((d * damped - zeta * omega * c) * cos - (c * damped + zeta * omega * d) * sin);
    (speed / v).powi(2)
}

/// Height of a rigid block, m.
fn rigid(t: f64, restitution: f64) -> f64 {
    if t < 1.0 {
        return 0.25 * G * t * t;
    }
    let peak = 0.375 * G;
    let (mut landing, mut v) = (1.5 + (2.0 * peak / G).sqrt(), (2.0 * peak * G).sqrt());
    if t < landing {
        return peak - 0.5 * G * (t - 1.5) * (t - 1.5);
    }
    loop {
        v *= restitution;
        let flight = 2.0 * v / G;
        if t < landing + flight {
            let s = t - landing;
            return v * s - 0.5 * G * s * s;
        }
        if flight < 1e-3 {
            return 0.0;
        }
        landing += flight;
    }
}

fn work(f: &mut Findings) -> Result<(), String> {
    shipped(f)?;
    as_printed(f)
}

fn shipped(f: &mut Findings) -> Result<(), String> {
    f.text(
        "1.5 times the weight for 1 s throws a rigid block to 3/8 g (1 s)² = 144.8 in; with the \
         restitution 0.25 it rebounds to 6.25 % of that. On contacts of finite stiffness gravity takes \
         a little more: 6.07 % at 0.1 mm static deflection, 6.23 % at 1 µm.",
    );
    let (case, history) = (reference::case("drop")?, reference::history("drop")?);
    let mut seen: Vec<Seen> = Vec::new();
    for solver in BOTH {
        let name = solver.name();
        for (words, set, factor, other) in [
            ("", case.parameters(), 1.0, 0.060_659_7),
            ("kn × 100: ", case.stiffer(100.0), 100.0, 0.062_316),
        ] {
            let trace = run(DROP, &set, solver, |_| {})?;
            let (peak, rebound) = heights(&trace);
            let closed = ratio(peak, case.kn * factor, case.cv * f64::sqrt(factor)) * 100.0;
            let mut check = |what: &str, unit, reference, tolerance, value| {
                let tolerance = Tolerance::Relative(tolerance);
                f.check(format!("{words}{what}"), unit, reference, tolerance, name, value);
            };
            if factor > 1.0 {
                let reference = (0.375 * G / INCH.si, Kind::ClosedForm);
                check("peak", "in", reference, 1e-3, peak / INCH.si);
            } else {
                let reference = (case.peaks.up_l / INCH.si, Kind::OtherCode);
                check("peak", "in", reference, 1e-3, peak / INCH.si);
            }
            let found = rebound / peak * 100.0;
            // 0.1 % of the restitution.
            check("rebound / peak, with gravity", "%", (closed, Kind::ClosedForm), 2e-3, found);
            check("rebound / peak", "%", (other * 100.0, Kind::OtherCode), 2e-3, found);
            if factor > 1.0 {
                // The rest of the way to the rigid limit.
                check("rebound / peak, rigid", "%", (6.25, Kind::ClosedForm), 5e-3, found);
            } else {
                seen.push((name, trace));
            }
        }
    }
    let title = "Bounce-back under free fall, restitution 0.25".into();
    let plot =
        Plot { title, outputs: &[("uplift_left", "")], axis: "height", unit: INCH, end: 5.0 };
    let times = (0..=2000).map(|i| 2.5e-3 * f64::from(i));
    let curve = times.map(|t| (t, rigid(t, 0.25) / INCH.si));
    f.figure(plot.draw(&seen, Some(&history)).reference("rigid, restitution 0.25", curve));
    Ok(())
}

/// With the two numbers that the paper prints.
fn as_printed(f: &mut Findings) -> Result<(), String> {
    f.text(format!(
        "The paper prints 9.77 in / 149.7 in = 6.53 %, which is the restitution 0.2555, and a peak 3.4 % \
         above 144.8 in; it does not say why. A force that drops to zero within {FALL} s, as in one \
         coarse step of its function, throws the block that high. Dashpot and step are fitted to the two \
         printed numbers here: the run shows that the model can give both, not that the paper's did so.",
    ));
    let case = reference::case("drop")?;
    let mut set = case.stiffer(100.0);
    // The dashpot whose rebound in this drop is 6.526 %.
    set.push(("cv", 1.2588e7));
    let table = Table::new(
        vec![0.0, 1.0, 1.0 + FALL],
        vec![1.0, 1.0, 0.0],
        Interpolation::Linear,
        AfterEnd::Zero,
    )
    .map_err(|e| e.to_string())?;
    let mut seen: Vec<Seen> = Vec::new();
    let mut printed = Vec::new();
    for solver in BOTH {
        let function = TimeFunction::Table(table.clone().into());
        let trace = run(DROP, &set, solver, |model| replace(model, "hold", function))?;
        let (peak, rebound) = heights(&trace);
        let rows = [
            ("peak", "in", 149.7, peak / INCH.si),
            ("rebound", "in", 9.77, rebound / INCH.si),
            ("rebound / peak", "%", 9.77 / 149.7 * 100.0, rebound / peak * 100.0),
        ];
        for (what, unit, reference, value) in rows {
            let reference = (reference, Kind::Published);
            let quantity = format!("fitted to the paper: {what}");
            f.check(quantity, unit, reference, Tolerance::Relative(5e-3), solver.name(), value);
        }
        let top = |from, to| trace.extreme("uplift_left", 1.0, from, to).0;
        let crossing = |n| trace.crossing("uplift_left", 0.0, n);
        printed = vec![(top(0.0, crossing(1)), 149.7), (top(crossing(2), crossing(3)), 9.77)];
        seen.push((solver.name(), trace));
    }
    let title =
        "Bounce-back under free fall, restitution 0.2555, force dropping in one step".into();
    let plot =
        Plot { title, outputs: &[("uplift_left", "")], axis: "height", unit: INCH, end: 5.0 };
    f.figure(plot.draw(&seen, None).marks("printed in the paper", printed));
    Ok(())
}

//! Figures 3 to 6: sliding and uplift under horizontal 5 Hz pulses, four cases.

use super::reference::{self, Case};
use super::{BLOCK, BOTH, millimetres, run};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use trilith_report::Figure;

const SOURCE: &str = "The paper's table of cases and figures 3 to 6; block of compliant contacts, \
                      event-driven with exact steps (independent code)";

pub(super) fn studies() -> Vec<Study> {
    let study = |id, title, work| Study { id, title, source: SOURCE, work };
    vec![
        study(
            "FIG-3",
            "Case 2, 1.5 g, μ = 0.2: pure slide (and case 1, 0.2 g, μ = 0.4: at rest)",
            |f| {
                rest(f)?;
                sliding(f)
            },
        ),
        study("FIG-4", "Figures 4 and 5: case 3, 1.5 g, μ = 0.6: slide-rock", slide_rock),
        study("FIG-6", "Case 4, 0.8 g, μ = 0.8: pure rocking", rocking),
    ]
}

/// How far the peaks may be off: those of slide and uplift.
type Limits = (f64, f64);

/// Runs a case under both solvers, draws outputs over the reference and compares mode and peaks.
fn compare(
    f: &mut Findings,
    name: &str,
    mode: &str,
    outputs: &[(&'static str, &str)],
    limits: Limits,
) -> Result<(), String> {
    let case = reference::case(name)?;
    let history = reference::history(name)?;
    let mut figures: Vec<Figure> = outputs
        .iter()
        .map(|(_, title)| Figure::new(format!("{title}, {name}"), "time [s]", "[mm]"))
        .collect();
    for solver in BOTH {
        let trace = run(BLOCK, &case.parameters(), solver, |_| {})?;
        for (figure, (output, _)) in figures.iter_mut().zip(outputs) {
            let points = millimetres(trace.history(output));
            *figure = figure.clone().line(solver.name().to_uppercase(), points);
        }
        let contact = trace.contact.as_ref().ok_or("no contact carries the block")?;
        f.check(
            format!("{name}: initial mode is {mode}"),
            "",
            (1.0, Kind::Published),
            Tolerance::Absolute(0.0),
            solver.name(),
            f64::from(u8::from(contact.initial_mode == mode)),
        );
        peaks(f, &case, name, solver.name(), &trace, limits);
    }
    for (figure, (output, _)) in figures.into_iter().zip(outputs) {
        f.figure(match &history {
            Some(h) => figure.marks("independent code", millimetres(h.of(output).collect())),
            None => figure,
        });
    }
    Ok(())
}

fn peaks(
    f: &mut Findings,
    case: &Case,
    name: &str,
    solver: &str,
    trace: &crate::Trace,
    (slide, uplift): Limits,
) {
    let mut check = |what: &str, reference: f64, limit: f64, value: f64| {
        let claim = (1e3 * reference, Kind::OtherCode);
        let limit = Tolerance::Absolute(1e3 * limit);
        f.check(format!("{name}: {what}"), "mm", claim, limit, solver, 1e3 * value);
    };
    let p = &case.peaks;
    let end = f64::INFINITY;
    let largest = p.slide_max.abs().max(p.slide_min.abs());
    if slide > 0.0 {
        check("largest slide", largest, slide * largest, trace.peak("slide", 0.0, end));
        check("residual slide", p.residual, slide * largest, trace.last("slide"));
    }
    if uplift > 0.0 {
        for (output, reference) in [("uplift_left", p.up_l), ("uplift_right", p.up_r)] {
            let value = trace.max(output, 0.0, end);
            check(output, reference, uplift * reference.abs(), value);
        }
    }
}

/// Case 1: nothing but the play of the contacts, 0.1 mm.
fn rest(f: &mut Findings) -> Result<(), String> {
    let case = reference::case("h1_full")?;
    for solver in BOTH {
        let trace = run(BLOCK, &case.parameters(), solver, |_| {})?;
        let mode = trace.contact.as_ref().map(|c| c.initial_mode);
        f.check(
            "case 1: initial mode is rest",
            "",
            (1.0, Kind::Published),
            Tolerance::Absolute(0.0),
            solver.name(),
            f64::from(u8::from(mode == Some("rest"))),
        );
        peaks(f, &case, "case 1 (play of the contacts)", solver.name(), &trace, (0.02, 0.0));
    }
    Ok(())
}

fn sliding(f: &mut Findings) -> Result<(), String> {
    f.text(
        "Sliding occurs and nothing lifts, as the paper has it: friction is a function of μ alone.",
    );
    for name in ["h2_full", "h2_half", "h2_cont"] {
        compare(f, name, "slide", &[("slide", "Sliding at the base")], (0.005, 0.0))?;
    }
    Ok(())
}

fn slide_rock(f: &mut Findings) -> Result<(), String> {
    f.text(
        "The block slides and rocks. What it slides after the first impact is a property of the contact's \
         friction law, so the independent code with the same law is the reference.",
    );
    for name in ["h3_full", "h3_half"] {
        let outputs = [
            ("slide", "Sliding at the base"),
            ("uplift_left", "Uplift, left corner"),
            ("uplift_right", "Uplift, right corner"),
        ];
        compare(f, name, "slide-rock", &outputs, (0.03, 0.02))?;
    }
    Ok(())
}

fn rocking(f: &mut Findings) -> Result<(), String> {
    f.text(
        "The paper says that sliding is practically zero: 2.3 mm of slide here against 14.5 mm of uplift, \
         the bouncing corners throw the base sideways.",
    );
    for name in ["h4_full", "h4_half"] {
        let outputs = [
            ("uplift_left", "Uplift, left corner"),
            ("uplift_right", "Uplift, right corner"),
            ("slide", "Sliding at the base"),
        ];
        compare(f, name, "rock", &outputs, (0.05, 0.02))?;
    }
    Ok(())
}

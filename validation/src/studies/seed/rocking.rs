//! Figure 10: free rocking from 5.1 in.

use super::reference;
use super::{BOTH, ROCKING, run};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use trilith_report::Figure;

const INCH: f64 = 0.0254;

pub(super) fn studies() -> Vec<Study> {
    vec![Study {
        id: "FIG-10",
        title: "Rocking free vibration: the exit displacement",
        source: "The paper's figure 10 (2.9/5.1 = 0.57, expected 0.59); Housner 1963; block of compliant \
                 contacts, event-driven (independent code)",
        work: exit,
    }]
}

fn exit(f: &mut Findings) -> Result<(), String> {
    f.text(
        "Housner's theory for H/B = 2.34 expects 0.590, which the contact dashpots give without any \
         rotational dashpot; 0.57, the paper's final run, takes one of 6.8 kN·m·s.",
    );
    let mut figure = Figure::new("Uplift of the corners, H/B = 2.34", "time [s]", "uplift [in]");
    for (name, wanted, kind, what) in [
        ("rock_2.34", 0.5897, Kind::OtherCode, "without rotational dashpot"),
        ("rock_2.34_cth", 0.57, Kind::Published, "with rotational dashpot"),
    ] {
        let case = reference::case(name)?;
        for solver in BOTH {
            let trace = run(ROCKING, &case.parameters(), solver, |_| {})?;
            // The left corner rises after the first impact, before the second.
            let after = trace.max("uplift_left", 0.2, 0.9);
            let before = trace.at("uplift_right", 0.0);
            f.check(
                format!("exit displacement over uplift, {what}"),
                "",
                (wanted, kind),
                Tolerance::Relative(2e-3),
                solver.name(),
                after / before,
            );
            let shown = format!("{} {what}", solver.name().to_uppercase());
            if solver == BOTH[0] {
                for output in ["uplift_right", "uplift_left"] {
                    let points =
                        trace.history(output).into_iter().map(|(t, z)| (t, z.max(0.0) / INCH));
                    let label = if output == "uplift_right" { shown.as_str() } else { "" };
                    figure = figure.line(label, points);
                }
            }
        }
    }
    let history = reference::history("rock_2.34")?.ok_or("no history")?;
    let marks = |output: &'static str| {
        history.of(output).map(|(t, z)| (t, z.max(0.0) / INCH)).collect::<Vec<_>>()
    };
    figure =
        figure.marks("independent code", marks("uplift_right")).marks("", marks("uplift_left"));
    f.figure(figure.reference("the paper's 2.9 in", [(0.0, 2.9), (2.0, 2.9)]));
    Ok(())
}

//! Static loads by FNA: the weight, put on slowly, ends where the static case does.

use super::{BLOCK, BOTH, run};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use trilith::SolverKind;
use trilith::model::{Analysis, Load};
use trilith_report::Figure;

pub(super) fn studies() -> Vec<Study> {
    vec![Study {
        id: "FIG-S",
        title: "Static load by FNA",
        source: "The paper: structures under static loads can be solved by FNA too; u = W/(2 kn)",
        work: weight,
    }]
}

fn weight(f: &mut Findings) -> Result<(), String> {
    f.text(
        "The weight acts on the block at rest, at once and for good; the contact dashpots bring it to the \
         static compression, where the static case puts it in one step.",
    );
    let deflection = -1e3 * 10e3 * 9.81 / (2.0 * 5e8);
    let set = [("ah", 0.0), ("av", 0.0), ("duration", 0.2)];
    let mut figure = Figure::new("Compression under the weight", "time [s]", "uplift [mm]");
    for solver in BOTH {
        let trace = run(BLOCK, &set, solver, |model| {
            for case in &mut model.cases {
                if let Analysis::Dynamic(d) = &mut case.analysis {
                    case.after = None;
                    d.constant = vec![Load::Gravity { factor: 1.0 }];
                }
            }
        })?;
        let points = trace.history("uplift_left").into_iter().map(|(t, z)| (t, 1e3 * z));
        figure = figure.line(solver.name().to_uppercase(), points);
        for output in ["uplift_left", "uplift_right"] {
            f.check(
                format!("{output} at the end"),
                "mm",
                (deflection, Kind::ClosedForm),
                Tolerance::Relative(1e-6),
                solver.name(),
                1e3 * trace.last(output),
            );
        }
    }
    let statics = run(BLOCK, &set, SolverKind::Fna, |model| model.cases.truncate(1))?;
    f.check(
        "static case",
        "mm",
        (deflection, Kind::ClosedForm),
        Tolerance::Relative(1e-9),
        "static",
        1e3 * statics.last("uplift_left"),
    );
    f.figure(figure.reference("static case", [(0.0, deflection), (0.2, deflection)]));
    Ok(())
}

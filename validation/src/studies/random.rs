//! Random structures against the oracle, and how the certificates of their runs hold.

use crate::case::{Kind, Tolerance};
use crate::oracle::campaign::{Campaign, Result as Found};
use crate::oracle::judge::{NO_ERROR, WORK};
use crate::{Findings, Study};
use std::time::Duration;
use trilith::SolverKind;
use trilith_report::{Color, Figure, Stroke};

const SOURCE: &str = "Equations of motion and laws written anew, integrated by Radau IIA of order 5 (independent code); \
                      a run holds where it is within 2 % (0.5 % at a tolerance of 1e-6), or within what it says of itself";

pub(super) const STUDIES: [Study; 2] = [
    Study {
        id: RANDOM_FNA,
        title: "Two thousand random structures under FNA",
        source: SOURCE,
        work: |found| compare(found, &[SolverKind::Fna], 2000),
    },
    Study {
        id: "RS-2",
        title: "Random structures under direct integration and on a basis",
        source: SOURCE,
        work: |found| {
            compare(found, &[SolverKind::Hht, SolverKind::RitzHht, SolverKind::FullNewton], 60)
        },
    },
];

/// Name of the longest study, some minutes of all processors.
pub const RANDOM_FNA: &str = "RS-1";
/// First of the seeds with links of all kinds, bodies in finite rotation among them; see
/// [`Rng`](crate::oracle::generate).
const SEED: u64 = 3_000_001;
/// Share of estimates that must hold, %.
const HOLD: f64 = 99.9;
/// Estimates on the median over errors, at most.
const MEDIAN: f64 = 10.0;

fn compare(found: &mut Findings, solvers: &[SolverKind], count: usize) -> Result<(), String> {
    let campaign = Campaign {
        seed: SEED,
        count,
        solvers: solvers.to_vec(),
        // Of a fifth of the structures nothing is compared, of half of them the first part.
        work: WORK / 300.0,
        budget: Duration::from_secs(1800),
        aloud: false,
    };
    let all = campaign.run();
    found.text(format!(
        "Chains, frames, long beams and blocks of springs, beams, bodies, masses, joints without mass and links of 22 kinds, under \
         ground motion, forces, moved supports and initial values, with all kinds of damping and output steps from \
         0.1 to 100 times the good one: {} structures, of which {} are compared, over as long as the oracle's work lasts.",
        all.structures,
        all.structures - all.skipped.len()
    ));
    for solver in solvers {
        claims(found, &all, *solver);
    }
    Ok(())
}

fn claims(found: &mut Findings, all: &Found, solver: SolverKind) {
    let name = solver.name();
    let wrong = all.failures().into_iter().filter(|f| f.solver == solver);
    let seeds: Vec<String> = wrong.map(|f| f.seed.to_string()).collect();
    let what = match &*seeds {
        [] => "structures wrong in silence".into(),
        some => format!("structures wrong in silence (seeds {})", some.join(", ")),
    };
    let none = (0.0, Kind::Theory);
    found.check(what, "", none, Tolerance::Absolute(0.0), name, seeds.len() as f64);
    let runs = all.runs.iter().filter(|f| f.solver == solver);
    let pairs: Vec<_> = runs.flat_map(|f| &f.pairs).filter(|p| !p.estimate().is_nan()).collect();
    let held = pairs.iter().filter(|p| p.holds()).count();
    let share = 100.0 * held as f64 / pairs.len() as f64;
    let what = format!("of {} estimates of an output's error hold", pairs.len());
    if solver == SolverKind::Fna {
        found.check(what, "%", (HOLD, Kind::Theory), Tolerance::AtLeast, name, share);
        let mut over: Vec<f64> =
            pairs.iter().map(|p| p.estimate().max(NO_ERROR) / p.off.max(NO_ERROR)).collect();
        over.sort_by(f64::total_cmp);
        let median = over.get(over.len() / 2).copied().unwrap_or(f64::NAN);
        let limit = (MEDIAN, Kind::Theory);
        found.check("estimate over error, median", "", limit, Tolerance::AtMost, name, median);
    } else {
        found.text(format!("{name}: {share:.2} % {what}."));
    }
    // A picture needs no more.
    let some = pairs.iter().step_by(pairs.len() / 1500 + 1);
    let points = some.map(|p| (p.off.max(NO_ERROR), p.estimate().max(NO_ERROR)));
    found.figure(
        Figure::new(
            format!("What runs say and what is: {name}"),
            "error / size",
            "estimate / size",
        )
        .log_log()
        .series("outputs", Stroke::Crosses, points)
        .colored(
            "estimate = error",
            Stroke::Line,
            Color(150, 150, 150),
            [(NO_ERROR, NO_ERROR), (1.0, 1.0)],
        ),
    );
}

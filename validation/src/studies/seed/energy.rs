//! Figures 11 and 12: where the energy of the base motion goes.

use super::{BLOCK, BOTH, reference, run};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use trilith::SolverKind;
use trilith::solvers::EnergyTotals;
use trilith_report::Figure;

const SOURCE: &str = "independent event-driven program (tests/data/block_reference.json); the paper's \
                      figures 11 and 12 show the same without numbers";

pub(super) fn studies() -> Vec<Study> {
    let study = |id, title, work| Study { id, title, source: SOURCE, work };
    vec![
        study("FIG-11", "Energy, sliding-dominant problem (1.5 g, μ = 0.2)", |f| {
            balance(f, "h2_full", &Limits { input: 0.005, share: 0.005, most: Most::Friction })
        }),
        study("FIG-12", "Energy, rocking-dominant problem (0.8 g, μ = 0.8)", |f| {
            balance(f, "h4_full", &Limits { input: 0.01, share: 0.02, most: Most::Dashpots })
        }),
    ]
}

/// What is asked of the energies.
struct Limits {
    /// Tolerance of the input, as share of it.
    input: f64,
    /// Tolerance of what becomes heat, as share of the input.
    share: f64,
    /// What takes the majority.
    most: Most,
}

enum Most {
    Friction,
    Dashpots,
}

/// Name in the paper, energy.
type Term = (&'static str, fn(&EnergyTotals) -> f64);

/// As the paper names them.
const TERMS: [Term; 6] = [
    ("input", |e| e.input),
    ("kinetic", |e| e.kinetic),
    ("potential", stored),
    ("NLlink (friction)", |e| e.link_hysteretic),
    ("Ndamp (dashpots)", dashpots),
    ("error", |e| e.error),
];

/// Since the start.
fn stored(e: &EnergyTotals) -> f64 {
    e.strain - e.start.strain + e.potential + e.link_stored - e.start.link_stored
}

fn dashpots(e: &EnergyTotals) -> f64 {
    e.link_viscous + e.modal_damping
}

fn balance(f: &mut Findings, name: &str, limits: &Limits) -> Result<(), String> {
    /// Last time shown, s: all is at rest.
    const END: f64 = 2.0;
    let case = reference::case(name)?;
    let expected = &case.energy;
    let lost = expected.dash_v + expected.dash_th;
    for solver in BOTH {
        let trace = run(BLOCK, &case.parameters(), solver, |_| {})?;
        let energies = trace.energies();
        let last = energies.last().map(|(_, e)| *e).ok_or("no energies")?;
        let mut check = |what: &str, unit, reference, tolerance, value| {
            f.check(what, unit, reference, tolerance, solver.name(), value);
        };
        let other = |x: f64| (x, Kind::OtherCode);
        check("input", "J", other(expected.input), Tolerance::Relative(limits.input), last.input);
        let percent = |x: f64| 100.0 * x / last.input;
        let tolerance = Tolerance::Absolute(100.0 * limits.share);
        let reference = other(100.0 * expected.friction / expected.input);
        check("friction, of the input", "%", reference, tolerance, percent(last.link_hysteretic));
        let reference = other(100.0 * lost / expected.input);
        check("dashpots, of the input", "%", reference, tolerance, percent(dashpots(&last)));
        let (taker, value) = match limits.most {
            Most::Friction => ("friction", last.link_hysteretic),
            Most::Dashpots => ("dashpots", dashpots(&last)),
        };
        let quantity = format!("{taker}: the majority, of the input");
        check(&quantity, "%", (50.0, Kind::Published), Tolerance::AtLeast, percent(value));
        let error = energies.iter().map(|(_, e)| e.error.abs()).fold(0.0, f64::max);
        let reference = (0.1, Kind::Theory);
        check(
            "largest energy error, of the input",
            "%",
            reference,
            Tolerance::AtMost,
            percent(error),
        );
        if solver == SolverKind::Fna {
            let title = "Energies by category, FNA";
            let mut figure = Figure::new(title, "time [s]", "energy [kJ]").sized(640, 420);
            for (term, of) in TERMS {
                let shown = energies.iter().filter(|(t, _)| *t <= END);
                figure = figure.line(term, shown.map(|(t, e)| (*t, of(e) / 1e3)));
            }
            let marks = [expected.input, expected.friction, lost].map(|e| (END, e / 1e3));
            f.figure(figure.marks("event-driven program, at the end", marks));
        }
    }
    Ok(())
}

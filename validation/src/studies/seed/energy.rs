//! Figures 11 and 12: where the energy goes.

use super::reference;
use super::{BLOCK, BOTH, run};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study, Trace};
use trilith::solvers::EnergyTotals;
use trilith_report::Figure;

const SOURCE: &str = "The paper's figures 11 and 12; block of compliant contacts, event-driven \
                      (independent code)";

pub(super) fn studies() -> Vec<Study> {
    let study = |id, title, work| Study { id, title, source: SOURCE, work };
    vec![
        study("FIG-11", "Energy of a sliding-dominated problem: case 2", |f| shares(f, "h2_full")),
        study("FIG-12", "Energy of a rocking-dominated problem: case 4", |f| shares(f, "h4_full")),
    ]
}

/// Friction takes the input of a sliding block (the paper's Nllink energy), the dashpots that of a rocking
/// one (Ndamp).
fn shares(f: &mut Findings, name: &str) -> Result<(), String> {
    let case = reference::case(name)?;
    for solver in BOTH {
        let trace = run(BLOCK, &case.parameters(), solver, |_| {})?;
        let end = trace.energies().last().map(|(_, e)| *e).ok_or("no energies")?;
        let input = case.energy.input;
        let mut check = |what: &str, reference: f64, limit: f64, value: f64| {
            let claim = (reference, Kind::OtherCode);
            let limit = Tolerance::Absolute(limit * input);
            f.check(what, "J", claim, limit, solver.name(), value);
        };
        check("input", input, 0.02, end.input);
        check("friction", case.energy.friction, 0.02, end.link_hysteretic);
        let dashpots = case.energy.dash_v + case.energy.dash_th;
        check("dashpots", dashpots, 0.02, end.link_viscous + end.modal_damping);
        f.check(
            "not accounted for",
            "%",
            (0.1, Kind::Theory),
            Tolerance::AtMost,
            solver.name(),
            100.0 * end.error_relative,
        );
        if solver == BOTH[0] {
            f.figure(plot(&trace, name));
        }
    }
    Ok(())
}

fn plot(trace: &Trace, name: &str) -> Figure {
    type Part = (&'static str, fn(&EnergyTotals) -> f64);
    const PARTS: [Part; 5] = [
        ("input", |e| e.input),
        ("kinetic", |e| e.kinetic),
        ("potential and stored", |e| e.potential + e.link_stored + e.strain),
        ("friction (Nllink)", |e| e.link_hysteretic),
        ("dashpots (Ndamp)", |e| e.link_viscous + e.modal_damping),
    ];
    let energies = trace.energies();
    let mut figure = Figure::new(format!("Energies, {name}, FNA"), "time [s]", "energy [J]");
    for (label, part) in PARTS {
        let points = energies.iter().filter(|(t, _)| *t <= 1.0).map(|(t, e)| (*t, part(e)));
        figure = figure.line(label, points);
    }
    figure
        .reference("error", energies.iter().filter(|(t, _)| *t <= 1.0).map(|(t, e)| (*t, e.error)))
}

//! Energies of cases that start displaced, moving or loaded: what was there and what was put in is what is there.

use trilith_model::{Model, SolverKind};
use trilith_solvers::{CaseResult, EndState, EnergyTotals, Observer, RunOptions, Sample, run};
use trilith_system::System;
use trilith_tests::{parse, shipped};

/// A mass on a spring and a yielding link, shaken, let go with a displacement and a velocity.
const SWING: &str = r#"(
    nodes: { "a": (0, 0, 0) },
    supports: { "a": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "a", mass: 10),
        "spring": Spring(node: "a", k2: 500, c2: 2),
        "link": Wen(node: "a", axis1: (1, 0, 0), k: 1000, fy: 10, ratio: 0.1, axis: U1),
    },
    functions: { "shake": Sine(amplitude: "2 m/s^2", frequency: "1.4 Hz", cycles: 3) },
    cases: {
        "free": Dynamic(
            duration: 1, dt: 0.005, base: [(direction: X, function: "shake")],
            initial: [(node: "a", dof: Ux, displacement: 0.03, velocity: 0.2)],
        ),
    },
    outputs: { "u": Displacement(node: "a", dof: Ux) },
)"#;

#[derive(Default)]
struct Energies(Vec<EnergyTotals>);

impl Observer for Energies {
    fn sample(&mut self, sample: &Sample<'_>) {
        self.0.push(*sample.energy);
    }

    fn wants_rates(&self) -> bool {
        false
    }
}

/// Energies of the last case over time.
fn energies((model, system): &(Model, System), solver: SolverKind) -> Vec<EnergyTotals> {
    let mut seen = Energies::default();
    let case = model.cases.len() - 1;
    let options = RunOptions { case, solver: Some(solver), ..RunOptions::default() };
    run(model, system, options, &mut [&mut seen]).unwrap();
    seen.0
}

/// By how much both sides differ, as share of the largest energy.
fn off(energy: &EnergyTotals) -> f64 {
    let balance = energy.balance();
    let sources: f64 = balance.sources.iter().map(|(_, e)| e).sum();
    let uses: f64 = balance.uses.iter().map(|(_, e)| e).sum();
    (sources - uses).abs() / balance.largest()
}

#[test]
fn a_displaced_and_moving_start_is_what_feeds_the_motion_with_the_input() {
    let text = parse(SWING, &[]);
    for solver in SolverKind::ALL {
        let name = solver.name();
        let all = energies(&text, solver);
        let start = all[0].start;
        // ½ m v² and ½ k u².
        assert!((start.kinetic - 0.2).abs() < 1e-9, "{name}: {start:?}");
        assert!((start.strain - 0.225).abs() < 1e-9, "{name}: {start:?}");
        assert!(start.link_stored > 0.01, "{name}: {start:?}");
        let first = EnergyTotals {
            start,
            kinetic: start.kinetic,
            strain: start.strain,
            link_stored: start.link_stored,
            ..EnergyTotals::default()
        };
        assert_eq!(all[0], first, "{name}");
        for energy in &all {
            assert_eq!(energy.start, start, "{name}");
            assert!(energy.strain > -1e-9 && off(energy) < 1e-9, "{name}: {energy:?}");
        }
        let last = all.last().unwrap();
        let whole = last.balance().whole().unwrap();
        let uses = last.balance().uses;
        assert!(whole > last.input && uses.iter().all(|(_, e)| *e < whole), "{name}");
    }
}

#[test]
fn what_the_weight_has_pressed_in_is_there_at_the_start() {
    let of = shipped("rigid_block.ron", &[("duration", "0.3".into())]);
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let all = energies(&of, solver);
        // Two contacts, each with half the weight: (W/2)²/2k.
        let expected = 49050.0_f64.powi(2) / 5e8;
        let start = all[0].start;
        assert!((start.link_stored / expected - 1.0).abs() < 1e-6, "{start:?}");
        assert!(start.kinetic == 0.0 && all.iter().all(|e| off(e) < 1e-9), "{}", solver.name());
    }
}

#[test]
fn a_body_that_falls_lives_on_the_potential_that_it_releases() {
    let of = shipped("rigid_block_rocking.ron", &[("duration", "0.25".into())]);
    let all = energies(&of, SolverKind::Fna);
    let balance = all.last().unwrap().balance();
    let (what, released) = balance.sources[3];
    assert_eq!(what, "potential released");
    let whole = balance.whole().unwrap();
    assert!(released > 100.0 && released <= whole, "{balance:?}");
    assert!(balance.uses.iter().all(|(_, e)| *e < 1.001 * whole), "{balance:?}");
}

#[test]
fn a_checkpoint_knows_what_was_there_at_the_start() {
    let (model, system) = parse(SWING, &[]);
    let part = |from: Option<EndState>, until: Option<f64>| -> CaseResult {
        let solver = Some(SolverKind::Fna);
        let options = RunOptions { solver, from, until, ..RunOptions::default() };
        run(&model, &system, options, &mut []).unwrap()
    };
    let (whole, first) = (part(None, None), part(None, Some(0.5)));
    let written = serde_json::to_string(&first.end).unwrap();
    let rest = part(Some(serde_json::from_str(&written).unwrap()), None);
    assert!(rest.energy.start.strain > 0.2);
    assert_eq!(rest.energy, whole.energy);
}

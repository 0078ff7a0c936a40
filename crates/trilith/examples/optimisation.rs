//! Finds the spring and the dashpot of an isolator that travels least while what stands on it is accelerated by no more
//! than 6 m/s².
//!
//! ```console
//! cargo run --release -p trilith --example optimisation
//! ```

use std::error::Error;
use std::sync::atomic::AtomicBool;
use trilith::Diagnostics;
use trilith::model::ModelText;
use trilith::optimize::{Evaluation, Variable, Wanted, optimize_with};

/// A machine of 100 kg that is struck: it sets out with 1 m/s.
const MODEL: &str = r#"(
    title: "Struck machine",
    parameters: { "k": "10 kN/m", "c": "200 N*s/m" },
    plane: XZ,
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uz, Ry) },
    elements: {
        "machine": Mass(node: "m", mass: "100 kg"),
        "spring": Spring(node: "m", k2: "k"),
        "damper": Dashpot(node: "m", axis: U2, c: "c"),
    },
    cases: { "strike": Dynamic(
        duration: "0.4 s", dt: "1 ms", solver: Hht,
        initial: [(node: "m", dof: Ux, velocity: "1 m/s")],
    ) },
    outputs: {
        "travel": Displacement(node: "m", dof: Ux),
        "acceleration": Acceleration(node: "m", dof: Ux),
    },
)"#;

/// Searches, and prints every run.
pub fn main() -> Result<(), Box<dyn Error>> {
    // A text that is read many times, with other values of its parameters each time.
    let text = ModelText::new(MODEL, "struck.ron").map_err(Diagnostics::from)?;
    let k = Variable { logarithmic: true, ..Variable::new("k", "1 kN/m", "100 kN/m") };
    let wanted = Wanted {
        by: vec![k, Variable::new("c", "50 N*s/m", "2 kN*s/m")],
        minimise: vec!["travel".into()],
        limits: vec!["acceleration <= 6 m/s^2".into()],
        ..Wanted::default()
    };
    // Whoever sets the flag, as upon Ctrl-C, ends the search with what it has found.
    let interrupt = AtomicBool::new(false);
    let mut on_run = |i: usize, run: &Evaluation| {
        println!(
            "run {:2}: {:.5} m, k = {:6.0} N/m, c = {:5.1} N·s/m",
            i + 1,
            run.goal,
            run.x[0],
            run.x[1]
        );
    };
    let found = optimize_with(&text, &trilith::registry(), &wanted, &mut on_run, &interrupt)?;

    let best = found.best();
    println!("best: {:.5} m, limit reached within {:.2e}", best.goal, best.beyond[0].abs());
    // Spring and dashpot can do no better than x a/v² = 0.5206.
    println!("x a/v² = {:.4}", best.goal * best.sides[0][0]);
    Ok(())
}

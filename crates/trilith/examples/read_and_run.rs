//! Reads a model with other values of its parameters, runs its last case, and prints the largest values of its outputs.
//!
//! ```console
//! cargo run --release -p trilith --example read_and_run
//! ```

use std::error::Error;
use trilith::{Values, registry};

/// A block that stands free, 2 m wide and 4 m high, under a pulse.
const MODEL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/rigid_block.ron");

/// Reads, runs, and prints what came of it.
pub fn main() -> Result<(), Box<dyn Error>> {
    // Everything that is wrong with a model is one error: `?` hands all of it on.
    let values = Values::new().with("mu", 0.2).with("duration", (1.0, "s"));
    let model = trilith::read(MODEL, &registry(), &values)?;

    let case = &model.cases.last().ok_or("the model has no case")?.name;
    let run = trilith::run(&model, case)?;

    println!("{}: {:?}", model.title, run.result.status);
    for output in &model.outputs {
        let peak = run.peak(&output.name)?;
        println!("  {:14} {:10.6} {} at {:.3} s", output.name, peak.max, output.unit, peak.t_max);
    }
    // Histories are slices, beside the times that they belong to.
    let slide = run.history("slide")?;
    println!("  {} values of slide until {:?} s", slide.len(), run.time().last());
    Ok(())
}

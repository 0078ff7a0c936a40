//! Runs a model with many values of two parameters, several runs side by side on every core.
//!
//! ```console
//! cargo run --release -p trilith --example sweep
//! ```

use std::error::Error;
use trilith::Values;
use trilith::sweep::Sweep;

const MODEL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/rigid_block.ron");

/// Runs the grid, and prints it as a table.
pub fn main() -> Result<(), Box<dyn Error>> {
    let friction = [0.2, 0.4, 0.6, 0.8];
    let ground = [0.3, 0.9, 1.5];
    let grid: Vec<_> = (friction.iter())
        .flat_map(|mu| ground.map(|ah| (*mu, ah)))
        .map(|(mu, ah)| {
            Values::new().with("mu", mu).with("ah", ah).with("duration", "1 s").to_vec()
        })
        .collect();

    let sweep = Sweep::new(std::fs::read_to_string(MODEL)?, MODEL, trilith::registry());
    let outcomes = sweep.run(&grid);

    println!("largest sliding, m; across: peak of the ground motion, g");
    println!("    mu {}", ground.map(|ah| format!("{ah:9}")).concat());
    for (mu, row) in friction.iter().zip(outcomes.chunks(ground.len())) {
        print!("  {mu:4} ");
        for outcome in row {
            // One run that fails is no end to the others.
            match outcome {
                Ok(run) => {
                    print!("{:9.4}", run.outputs.get("slide").map_or(f64::NAN, |p| p.magnitude()))
                }
                Err(error) => print!("  {error}"),
            }
        }
        println!();
    }
    Ok(())
}

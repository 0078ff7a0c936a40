//! Makes models in Rust: a chain of as many masses as one likes, whose numbers are then changed in place.
//!
//! ```console
//! cargo run --release -p trilith --example model_in_rust
//! ```

use std::error::Error;
use trilith::model::{Analysis as Case, TimeFunction};
use trilith::{ModelBuilder, block, registry, word};

/// A chain of masses of 1 t on springs of 10 MN/m, the lowest of which stands on the ground.
///
/// What a program makes goes through the same reader as a file: names instead of numbers, units, all errors at once.
fn chain(masses: usize) -> ModelBuilder {
    let mut chain = ModelBuilder::new(&format!("Chain of {masses} masses"))
        .field("plane", word("XZ"))
        .node("n0", [0.0; 3])
        .support("n0", word("Fixed"));
    for i in 1..=masses {
        let (above, below) = (format!("n{i}"), format!("n{}", i - 1));
        let mass = block("Mass").with("node", &*above).with("mass", (1.0, "t"));
        let spring = block("Spring")
            .with("nodes", [&*below, &*above])
            .with("k1", (1.0, "GN/m"))
            .with("k2", (10.0, "MN/m"))
            .with("r2", "1 GN*m")
            .with("r3", "1 GN*m");
        chain = chain
            .node(&above, [0.0, 0.0, i as f64])
            .element(&format!("mass {i}"), mass)
            .element(&format!("spring {i}"), spring);
    }
    let shaking = block("Sine").with("amplitude", "1 m/s^2").with("frequency", "2 Hz");
    let base = block("").with("direction", word("X")).with("function", "shaking");
    let shake = block("Dynamic").with("duration", "2 s").with("dt", "5 ms");
    chain
        .function("shaking", shaking.with("cycles", 3))
        .case("shake", shake.with("base", vec![base]))
        .output(
            "top",
            block("Displacement").with("node", format!("n{masses}")).with("dof", word("Ux")),
        )
}

/// Makes the model, runs it, changes it, and runs it again.
pub fn main() -> Result<(), Box<dyn Error>> {
    let mut model = chain(5).build(&registry())?;
    let top = trilith::run(&model, "shake")?.peak("top")?;
    println!("{}: the top moves by {:.5} m", model.title, top.magnitude());

    // A model is a value in SI: what is public may be changed, and is checked again before it runs.
    model.functions[0].function = TimeFunction::Constant(1.0);
    if let Case::Dynamic(case) = &mut model.cases[0].analysis {
        case.duration = 4.0;
    }
    let top = trilith::run(&model, "shake")?.peak("top")?;
    println!("under a steady acceleration by {:.5} m", top.magnitude());

    // And it can be written as the file that it would have been read from.
    let lines = trilith::model::resolved(&model).lines().count();
    println!("as a file it has {lines} lines");
    Ok(())
}

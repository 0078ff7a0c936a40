//! Makes models in Rust: a chain of as many masses as one likes as a text, whose numbers are then changed in place.
//!
//! ```console
//! cargo run --release -p trilith --example model_in_rust
//! ```

use std::error::Error;
use std::fmt::Write;
use trilith::model::{Analysis as Case, Model, TimeFunction};
use trilith::registry;

/// A chain of masses of 1 t on springs of 10 MN/m, the lowest of which stands on the ground.
///
/// What a program makes goes through the same reader as a file: names instead of numbers, units, all errors at once.
fn chain(masses: usize) -> Result<Model, Box<dyn Error>> {
    let (mut nodes, mut elements) = (String::new(), String::new());
    for i in 0..=masses {
        write!(nodes, r#""n{i}": (0, 0, {i}), "#)?;
        if i > 0 {
            write!(elements, r#""mass {i}": Mass(node: "n{i}", mass: "1 t"), "#)?;
            let below = i - 1;
            write!(
                elements,
                r#""spring {i}": Spring(nodes: ("n{below}", "n{i}"), k1: "1 GN/m", k2: "10 MN/m", r2: "1 GN*m", r3: "1 GN*m"), "#
            )?;
        }
    }
    let text = format!(
        r#"(
            title: "Chain of {masses} masses",
            plane: XZ,
            nodes: {{ {nodes} }},
            supports: {{ "n0": Fixed }},
            elements: {{ {elements} }},
            functions: {{ "shaking": Sine(amplitude: "1 m/s^2", frequency: "2 Hz", cycles: 3) }},
            cases: {{ "shake": Dynamic(
                duration: "2 s", dt: "5 ms", base: [(direction: X, function: "shaking")],
            ) }},
            outputs: {{ "top": Displacement(node: "n{masses}", dof: Ux) }},
        )"#
    );
    Ok(trilith::read_text(&text, "chain.ron", &registry(), &[])?)
}

/// Makes the model, runs it, changes it, and runs it again.
pub fn main() -> Result<(), Box<dyn Error>> {
    let mut model = chain(5)?;
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

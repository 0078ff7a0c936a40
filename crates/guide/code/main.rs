//! Writes the parts of the guide that are made by programs.

mod figures;

use std::path::Path;

const USAGE: &str = "trilith-guide reference   writes src/reference.md from the schema\n\
                     trilith-guide figures     runs the examples and draws src/figures/*.svg\n";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    match std::env::args().nth(1).as_deref() {
        Some("reference") => {
            std::fs::write(folder.join("reference.md"), trilith_guide::reference())?
        }
        Some("figures") => figures::draw(&folder)?,
        _ => {
            eprint!("{USAGE}");
            std::process::exit(2);
        }
    }
    Ok(())
}

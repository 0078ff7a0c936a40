//! Writes the parts of the guide that are made by programs.

mod figures;

use std::path::Path;

const USAGE: &str = "trilith-guide reference   writes src/reference.md and src/study_reference.md from the schemas\n\
                     trilith-guide gallery     writes src/gallery.md from the list of models\n\
                     trilith-guide figures     runs the examples, the models and the studies, and draws src/figures/**.svg\n";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    match std::env::args().nth(1).as_deref() {
        Some("reference") => {
            std::fs::write(folder.join("reference.md"), trilith_guide::reference())?;
            std::fs::write(folder.join("study_reference.md"), trilith_guide::study_reference())?;
        }
        Some("gallery") => std::fs::write(folder.join("gallery.md"), trilith_guide::gallery()?)?,
        Some("figures") => figures::draw(&folder)?,
        _ => {
            eprint!("{USAGE}");
            std::process::exit(2);
        }
    }
    Ok(())
}

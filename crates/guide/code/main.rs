//! Writes the parts of the guide that are made by programs.

mod figures;
mod site;

use std::path::Path;

const USAGE: &str = "trilith-guide reference   writes src/reference.md and src/study_reference.md from the schemas\n\
                     trilith-guide gallery     writes src/gallery.md from the list of models\n\
                     trilith-guide figures     runs the examples, the models and the studies, and draws src/figures/**.svg\n\
                     trilith-guide site ENGINE [SITE]\n                               \
                     makes the examples of a site run that mdBook has made, in target/guide/book\n";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    match std::env::args().nth(1).as_deref() {
        Some("reference") => {
            std::fs::write(folder.join("reference.md"), trilith_guide::reference())?;
            std::fs::write(folder.join("study_reference.md"), trilith_guide::study_reference())?;
        }
        Some("gallery") => std::fs::write(folder.join("gallery.md"), trilith_guide::gallery()?)?,
        Some("figures") => figures::draw(&folder)?,
        Some("site") => {
            let mut paths = std::env::args_os().skip(2);
            let Some(engine) = paths.next() else {
                eprint!("{USAGE}");
                std::process::exit(2);
            };
            let root = folder.join("../../..");
            let site = paths.next().map_or_else(|| root.join("target/guide/book"), Into::into);
            let pages = site::enliven(&site, Path::new(&engine), &root)?;
            println!("{pages} pages with examples that run");
        }
        _ => {
            eprint!("{USAGE}");
            std::process::exit(2);
        }
    }
    Ok(())
}

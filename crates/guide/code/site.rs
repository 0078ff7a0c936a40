//! What makes the examples of the site run in their pages: a live page for any model with the engine beside it, and a
//! script that opens it below an example.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use trilith_live::AnyModel;

/// Opens the live page below the examples.
const RUN: &str = include_str!("../theme/run.js");
/// Folders with files that models of the guide read, as they name them.
const FOLDERS: [&str; 2] = ["models/sections", "models/records"];
/// Where a page of the site ends.
const END: &str = "</body>";

/// Adds them to a site that mdBook has made; returns how many of its pages have examples that run.
///
/// # Errors
/// Where the site, the engine or a file that models read is missing.
pub fn enliven(site: &Path, engine: &Path, root: &Path) -> Result<usize, Box<dyn Error>> {
    let read = |path: &Path| std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()));
    let mut files = BTreeMap::new();
    for folder in FOLDERS {
        for entry in std::fs::read_dir(root.join(folder))? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            files.insert(format!("{folder}/{name}"), String::from_utf8(read(&path)?)?);
        }
    }
    let any = AnyModel::new(files, &read(engine)?)?;
    let parts = [("run.html", &any.page), (AnyModel::ENGINE, &any.engine), ("run.js", &RUN.into())];
    for (name, content) in parts {
        std::fs::write(site.join(name), content)?;
    }
    let mut pages = 0;
    for entry in std::fs::read_dir(site)? {
        let path = entry?.path();
        if path.extension().is_none_or(|e| e != "html") {
            continue;
        }
        let html = String::from_utf8(read(&path)?)?;
        let script = "<script src=\"run.js\"></script>\n";
        let Some(end) = html.rfind(END).filter(|_| runs(&html) && !html.contains(script)) else {
            continue;
        };
        std::fs::write(&path, format!("{}{script}{}", &html[..end], &html[end..]))?;
        pages += 1;
    }
    Ok(pages)
}

/// True for a page with a whole model among its examples.
fn runs(html: &str) -> bool {
    html.contains("class=\"language-ron file=")
}

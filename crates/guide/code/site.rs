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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_with_models_open_them_and_others_stay_as_they_are() {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path();
        let write = |name: &str, html: &str| std::fs::write(site.join(name), html).unwrap();
        let read = |name: &str| std::fs::read_to_string(site.join(name)).unwrap();
        let model = "<pre><code class=\"language-ron file=wall.ron\">(…)</code></pre>";
        write("model.html", &format!("<html><body>{model}</body></html>"));
        write("words.html", "<html><body>words</body></html>");
        let engine = site.join("engine.wasm");
        std::fs::write(&engine, b"\0asm and so on").unwrap();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        assert_eq!(enliven(site, &engine, &root).unwrap(), 1);
        let lively = read("model.html");
        assert!(lively.ends_with("<script src=\"run.js\"></script>\n</body></html>"), "{lively}");
        assert_eq!(read("words.html"), "<html><body>words</body></html>");
        let run = read("run.html");
        assert!(run.contains("src=\"engine.js\"") && run.contains("models/sections/steel.ron"));
        assert!(
            read("engine.js").starts_with("document.getElementById(\"engine\").textContent = \"")
        );
        // Once is enough.
        assert_eq!(enliven(site, &engine, &root).unwrap(), 0);
        assert_eq!(read("model.html"), lively);
        let missing = enliven(site, Path::new("no such engine"), &root).unwrap_err();
        assert!(missing.to_string().contains("no such engine"), "{missing}");
    }
}

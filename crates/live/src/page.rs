//! The page: a model with the engine in it, as one file without network.

use crate::digits::{DIGITS, digits};
use flate2::Compression;
use flate2::write::GzEncoder;
use maud::{DOCTYPE, PreEscaped, html};
use serde_json::json;
use std::collections::BTreeMap;
use std::io::{Result, Write};
use trilith::report::Charts;

const STYLE: &str = include_str!("page/live.css");
const WORKER: &str = include_str!("page/worker.js");
/// Of the page, in the order in which its parts build on each other.
const SCRIPT: [&str; 4] = [
    include_str!("page/engine.js"),
    include_str!("page/frames.js"),
    include_str!("page/controls.js"),
    include_str!("page/start.js"),
];

/// What a page is made of.
#[derive(Clone, Debug)]
pub struct Live<'a> {
    /// Title of the page.
    pub title: &'a str,
    /// Path of the model, as the commands that the page shows name it.
    pub path: &'a str,
    /// Text of the model.
    pub text: &'a str,
    /// Other files that it reads: text by path.
    pub files: BTreeMap<String, String>,
    /// Values of parameters that the page begins with.
    pub set: &'a [(String, String)],
    /// Case that the page begins with; the last one where none is named.
    pub case: Option<&'a str>,
    /// Solver that it begins with; that of the case where none is named.
    pub solver: Option<&'a str>,
    /// Charts of a study of the model: the page computes the run where their cursor is.
    pub charts: Option<&'a Charts>,
    /// The library of this crate, compiled for WebAssembly.
    pub engine: &'a [u8],
}

/// The page as HTML.
///
/// # Errors
/// None that a memory to write to could give.
pub fn page(live: &Live<'_>) -> Result<String> {
    Ok(html(live, Some(&packed(live.engine)?)))
}

/// A page for any model, and the engine beside it: many models of one site share them.
#[derive(Clone, Debug)]
pub struct AnyModel {
    /// The page. Its address says the model behind `#`: a JSON object with `title`, `path` and `text`, percent-encoded.
    pub page: String,
    /// The script with the engine, which the page looks for beside itself under the name [`AnyModel::ENGINE`].
    pub engine: String,
}

impl AnyModel {
    /// Name of the script with the engine.
    pub const ENGINE: &str = "engine.js";

    /// Such a page, with the files that models may read: text by path.
    ///
    /// # Errors
    /// None that a memory to write to could give.
    pub fn new(files: BTreeMap<String, String>, engine: &[u8]) -> Result<Self> {
        let (title, path, text) = ("Model", "model.ron", "");
        let live = Live {
            title,
            path,
            text,
            files,
            set: &[],
            case: None,
            solver: None,
            charts: None,
            engine,
        };
        let digits = packed(engine)?;
        let engine =
            format!("document.getElementById(\"engine\").textContent = {};\n", json!(digits));
        Ok(Self { page: html(&live, None), engine })
    }
}

/// An engine as text.
fn packed(engine: &[u8]) -> Result<String> {
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    packed.write_all(engine)?;
    Ok(digits(&packed.finish()?))
}

/// The page with the engine in it; without, for any model and with the engine beside it.
fn html(live: &Live<'_>, engine: Option<&str>) -> String {
    let model = json!({
        "any": engine.is_none(),
        "path": live.path,
        "text": live.text,
        "files": live.files,
        "set": live.set.iter().cloned().collect::<BTreeMap<_, _>>(),
        "case": live.case,
        "solver": live.solver,
        "worker": WORKER,
        "digits": DIGITS,
    });
    // Nothing in a text ends the script that it stands in.
    let model = model.to_string().replace('<', "\\u003c");
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (live.title) }
                style { @if let Some(c) = live.charts { (PreEscaped(c.style)) } (PreEscaped(STYLE)) }
                link rel="icon" href="data:,";
            }
            body {
                main class=[live.charts.map(|_| "study")] {
                    section.side aria-label="Model" {
                        h1 #title { (live.title) }
                        p.choices {
                            label { "case " select #case {} }
                            label { "solver " select #solver {} }
                        }
                        p #state role="status" { "The engine starts." }
                        pre #told role="alert" tabindex="0" hidden {}
                        @if let Some(c) = live.charts {
                            p.note {
                                "Drag the ring, or press where it is to go: the run there is computed in this page. \
                                 Arrows move it, with Shift in larger steps."
                            }
                            div #charts { (PreEscaped(&c.figures)) }
                        }
                        table #peaks hidden {
                            thead { tr { th { "peak" } th { "here" } th { "against the file" } } }
                            tbody {}
                        }
                        div #tabs role="tablist" {
                            button #tab-values type="button" role="tab" aria-selected="true" aria-controls="values" { "Parameters" }
                            button #tab-file type="button" role="tab" aria-selected="false" aria-controls="file" tabindex="-1" { "File" }
                        }
                        div #values role="tabpanel" aria-labelledby="tab-values" {}
                        div #file role="tabpanel" aria-labelledby="tab-file" hidden {
                            label { "file " select #which {} }
                            textarea #text spellcheck="false" autocapitalize="off" aria-label="Text of the file" {}
                            p { button type="button" #save { "Save a copy" } }
                        }
                        p.note { "The same from the program:" }
                        pre #command {}
                        p { button type="button" #back { "Back to the file's values" } }
                        p.note #version {}
                        noscript { "This page computes; it needs JavaScript." }
                    }
                    div #results {}
                }
                script type="application/gzip+base85" #engine { (PreEscaped(engine.unwrap_or_default())) }
                @if engine.is_none() { script src=(AnyModel::ENGINE) {} }
                script type="application/json" #model { (PreEscaped(model)) }
                script { (PreEscaped(SCRIPT.join("\n"))) }
                @if let Some(c) = live.charts { (PreEscaped(&c.script)) }
            }
        }
    };
    page.into_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn a_page_carries_model_files_and_engine_and_no_text_ends_a_script() {
        let hostile = "</script><script>alert(1)</script>";
        let files = BTreeMap::from([("records/a.csv".to_owned(), hostile.to_owned())]);
        let engine = b"\0asm and so on".repeat(50);
        let set = [("mu".to_owned(), hostile.to_owned())];
        let live = Live {
            title: hostile,
            path: "a.ron",
            text: hostile,
            files,
            set: &set,
            case: None,
            solver: None,
            charts: None,
            engine: &engine,
        };
        let html = page(&live).unwrap();
        // Those of the page itself: engine, model, script.
        assert_eq!(html.matches("</script>").count(), 3);
        assert!(!html.contains("alert(1)</script>"));
        assert!(!html.contains("http"));
        let between = |from: &str| {
            let start = html.find(from).unwrap() + from.len();
            let start = start + html[start..].find('>').unwrap() + 1;
            &html[start..start + html[start..].find("</script>").unwrap()]
        };
        let model: serde_json::Value =
            serde_json::from_str(between(r#"type="application/json""#)).unwrap();
        assert_eq!(model["text"], hostile);
        assert_eq!(model["files"]["records/a.csv"], hostile);
        let packed = crate::digits::bytes(between(r#"type="application/gzip+base85""#));
        let mut unpacked = Vec::new();
        flate2::read::GzDecoder::new(&packed[..]).read_to_end(&mut unpacked).unwrap();
        assert_eq!(unpacked, engine);
    }
}

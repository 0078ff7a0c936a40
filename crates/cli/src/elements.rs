//! `trilith elements`: the catalogue.

use crate::args::ElementsArguments;
use crate::text::{names_help, row, shown, table};
use crate::{Answer, Failure};
use std::path::Path;
use trilith::Registry;
use trilith::catalogue::{self, CATEGORIES, EVERY_LINK, HEADS, nodes, parameter};
use trilith::element::{Card, Category};

pub(crate) fn elements(registry: &Registry, args: &ElementsArguments) -> Result<Answer, Failure> {
    if let Some(path) = &args.page {
        return page(registry, path);
    }
    match args.name.as_deref().map(|name| card(registry, name)).transpose()? {
        Some(card) => Ok(full(registry, card).into()),
        None => Ok(list(registry).into()),
    }
}

/// The card of a kind.
fn card(registry: &Registry, name: &str) -> Result<&'static Card, Failure> {
    registry.card(name).ok_or_else(|| unknown(registry, name))
}

/// There is no such kind.
pub(crate) fn unknown(registry: &Registry, name: &str) -> Failure {
    let help = names_help(name, "kinds", registry.cards().map(|c| c.kind));
    Failure::input(&format!("there is no kind `{name}`"), Some(&help))
}

/// Writes the catalogue as HTML or Markdown.
fn page(registry: &Registry, path: &Path) -> Result<Answer, Failure> {
    let text = match path.extension().and_then(|e| e.to_str()) {
        Some("html" | "htm") => catalogue::html(registry),
        Some("md") => catalogue::markdown(registry),
        _ => {
            let message = format!("{} is neither HTML nor Markdown", path.display());
            return Err(Failure::input(&message, Some("end the name in `.html` or `.md`")));
        }
    };
    std::fs::write(path, text).map_err(|e| Failure::unwritable(path, &e))?;
    Ok(format!("catalogue: {}\n", shown(path)).into())
}

fn list(registry: &Registry) -> String {
    let mut out = String::new();
    for (category, title) in CATEGORIES {
        let rows: Vec<_> = registry
            .cards()
            .filter(|c| c.category == category)
            .map(|c| row([c.kind, &nodes(c.nodes), c.summary]))
            .collect();
        if !rows.is_empty() {
            out += &format!("{title}\n{}\n", table(&rows, &[0, 1, 2]));
        }
    }
    out + "`trilith elements NAME` shows a kind in full, `trilith exercise NAME` what a link does,\n\
           `trilith elements --page FILE.html` writes a catalogue.\n"
}

fn full(registry: &Registry, card: &Card) -> String {
    let category = catalogue::category(card.category);
    let mut out = format!("{} ({category}, {})\n{}\n", card.kind, nodes(card.nodes), card.summary);
    if !card.parameters.is_empty() {
        let mut rows = vec![row(HEADS)];
        rows.extend(card.parameters.iter().map(|p| parameter(p).to_vec()));
        out += &format!("\nparameters\n{}", table(&rows, &[0, 1, 2, 3, 4, 5]));
    }
    if card.category == Category::Link {
        out += &format!("\n{EVERY_LINK}\n");
    }
    let indented = |text: &str| text.lines().map(|l| format!("  {l}\n")).collect::<String>();
    let mut parts = vec![("law", card.law.to_owned()), ("source", card.source.to_owned())];
    parts.push(("example", card.example.to_owned()));
    if let Some([coordinates, history]) = catalogue::law_facts(registry, card) {
        parts.push(("coordinates of the example", coordinates));
        parts.push(("history variables", history));
    }
    for (title, text) in parts.iter().filter(|(_, text)| !text.is_empty()) {
        out += &format!("\n{title}\n{}", indented(text));
    }
    out
}

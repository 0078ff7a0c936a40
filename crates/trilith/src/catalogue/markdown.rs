//! The catalogue as Markdown.

use super::{CATEGORIES, EVERY_LINK, HEADS, law_facts, nodes, of, parameter};
use crate::element::{Card, Category};
use crate::model::Registry;

/// All kinds of a registry as one Markdown page, without figures.
#[must_use]
pub fn markdown(registry: &Registry) -> String {
    let mut out = String::from(
        "# Catalogue of elements, constraints and links\n\n\
         Made from the cards of the kinds by `trilith elements --page FILE.md`; `FILE.html` also draws \
         what the links do. Numbers without unit are SI.\n",
    );
    for (category, title) in CATEGORIES {
        let cards: Vec<_> = of(registry, category).collect();
        if cards.is_empty() {
            continue;
        }
        out += &format!("\n## {}\n\n| kind | nodes | |\n|---|---|---|\n", upper(title));
        for card in &cards {
            out += &row([
                &format!("[{}](#{})", card.kind, card.kind.to_lowercase()),
                &nodes(card.nodes),
                card.summary,
            ]);
        }
        if category == Category::Link {
            out += &format!("\n{EVERY_LINK}\n");
        }
        for card in cards {
            out += &kind(registry, card);
        }
    }
    out
}

fn kind(registry: &Registry, card: &Card) -> String {
    let mut out = format!("\n### {}\n\n{} Takes {}.\n", card.kind, card.summary, nodes(card.nodes));
    if !card.parameters.is_empty() {
        out += &format!("\n{}|---|---|---|---|---|---|\n", row(HEADS));
        for p in card.parameters {
            let [name, rest @ ..] = parameter(p);
            let name = format!("`{name}`");
            let [symbol, unit, range, default, meaning] = &rest;
            out += &row([&name, symbol, unit, range, default, meaning]);
        }
    }
    for (language, text) in [("text", card.law), ("ron", card.example)] {
        if !text.is_empty() {
            out += &format!("\n```{language}\n{text}\n```\n");
        }
    }
    if let Some([coordinates, history]) = law_facts(registry, card) {
        out += &format!(
            "\nCoordinates of the example: {coordinates}. History variables: {history}.\n"
        );
    }
    if !card.source.is_empty() {
        out += &format!("\nSource: {}\n", card.source);
    }
    out
}

fn row<const N: usize>(cells: [&str; N]) -> String {
    format!("| {} |\n", cells.map(|c| c.replace('|', "\\|")).join(" | "))
}

pub(super) fn upper(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |c| c.to_uppercase().chain(letters).collect())
}

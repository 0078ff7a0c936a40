//! The catalogue as a page with the loops of the links.

use super::markdown::upper;
use super::{CATEGORIES, EVERY_LINK, HEADS, law_facts, nodes, of, parameter};
use crate::element::{Card, Category};
use crate::exercise::{ExerciseError, Record, Specimen};
use crate::model::Registry;
use trilith_report::{Block, Figure, Page, Section};

/// All kinds of a registry as one self-contained HTML page.
#[must_use]
pub fn html(registry: &Registry) -> String {
    let mut page = Page::new("Elements, constraints and links").lead(Block::text(
        "What can stand in the elements of a model file, made from the cards of the kinds. Numbers \
         without unit are SI; any number may carry a unit or be an expression. Loops are those of the \
         example under a cyclic deformation that grows in three cycles: the last cycle dark, the way to \
         it light (`trilith exercise KIND`).",
    )).lead(Block::note(EVERY_LINK));
    for (category, title) in CATEGORIES {
        for card in of(registry, category) {
            page = page.section(section(registry, card, &upper(title)));
        }
    }
    page.html()
}

fn section(registry: &Registry, card: &Card, group: &str) -> Section {
    let mut section =
        Section::new(card.kind, card.kind).group(group).block(Block::text(card.summary));
    let figures = match loops(registry, card) {
        Some(Ok(figures)) => figures,
        Some(Err(error)) => {
            section = section.block(Block::note(format!("Not drawn: {error}.")));
            Vec::new()
        }
        None => Vec::new(),
    };
    if !card.law.is_empty() {
        section = section.block(Block::code(card.law));
    }
    if !figures.is_empty() {
        section = section.block(figures);
    }
    if !card.parameters.is_empty() {
        let row = |p| {
            let mut row = parameter(p).to_vec();
            row[0] = format!("`{}`", row[0]);
            row
        };
        let rows = card.parameters.iter().map(row).collect();
        let head = HEADS.map(str::to_owned).to_vec();
        section = section.block(Block::Table { head, rows });
    }
    if !card.example.is_empty() {
        section = section.block(Block::code(card.example));
    }
    let mut facts = format!("{}.", upper(&nodes(card.nodes)));
    if let Some([coordinates, history]) = law_facts(registry, card) {
        facts +=
            &format!(" Coordinates of the example: {coordinates}. History variables: {history}.");
    }
    section = section.block(Block::note(facts));
    if !card.source.is_empty() {
        section = section.block(Block::note(format!("Source: {}", card.source)));
    }
    section
}

/// The loops of a link; none for kinds without a law.
fn loops(registry: &Registry, card: &Card) -> Option<Result<Vec<Figure>, ExerciseError>> {
    (card.category == Category::Link)
        .then(|| record(registry, card.kind).map(|record| record.figures()))
}

fn record(registry: &Registry, kind: &str) -> Result<Record, ExerciseError> {
    let specimen = Specimen::new(registry, kind, &[])?;
    specimen.exercise(&specimen.motion()?)
}

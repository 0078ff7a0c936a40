//! The page: a section with table and figures for each case and study.

use crate::Outcome;
use crate::report::{HEADER, lines, notes, totals};
use crate::topic::{by_topic, summary, topic};
use trilith_report::{Block, Page, Section};

pub(crate) fn html(outcomes: &[Outcome]) -> String {
    let [topics, references] = summary(outcomes);
    let mut page = Page::new("Validation of Trilith")
        .lead(Block::text(format!("{}.", totals(outcomes))))
        .lead(topics)
        .lead(references)
        .lead(Block::note(
            "Half and 95 % of the comparisons that are told as a share of the reference are within these shares; the \
             others are told in their own units, or are bounds. Each has a tolerance of its own, which stands beside it.",
        ))
        .lead(Block::note(
            "Dark dashes and rings: reference. The error is the larger one of the solvers; %: of the \
             reference, otherwise in the unit of the quantity. Frequencies stand under FNA: they are \
             those of its basis.",
        ));
    for o in by_topic(outcomes) {
        let verdict = match () {
            () if o.pass() => "",
            () if o.fails() => " — FAILS",
            () => " — not run",
        };
        let mut section = Section::new(o.id, format!("{} {}{verdict}", o.id, o.title))
            .group(topic(o.id))
            .block(Block::note(format!("Source: {}", o.source)));
        for text in &o.text {
            section = section.block(Block::text(text.clone()));
        }
        if !o.figures.is_empty() {
            section = section.block(o.figures.clone());
        }
        if o.unavailable.is_some() {
            page = page.section(section);
            continue;
        }
        for table in &o.tables {
            let (head, rows) = (table.head.clone(), table.rows.clone());
            section = section.block(Block::Table { head, rows });
        }
        let lines = lines(&o.rows);
        let rows = lines.iter().enumerate().map(|(i, l)| {
            let number = std::iter::once((i + 1).to_string());
            number.chain(l.cells()[1..].iter().cloned()).collect()
        });
        let head = std::iter::once("#").chain(HEADER[1..].iter().copied());
        section = section
            .block(Block::Table { head: head.map(str::to_owned).collect(), rows: rows.collect() });
        for note in notes(&o.rows) {
            section = section.block(Block::note(format!("Note: {note}")));
        }
        page = page.section(section);
    }
    page.html()
}

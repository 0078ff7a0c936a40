//! The page: a section with table and figures for each case and study.

use crate::Outcome;
use crate::report::{HEADER, lines, notes, totals};
use trilith_report::{Block, Page, Section};

pub(crate) fn html(outcomes: &[Outcome]) -> String {
    let mut page = Page::new("Validation of Trilith")
        .lead(Block::text(format!("{}.", totals(outcomes))))
        .lead(Block::note(
            "Dark dashes and rings: reference. The error is the larger one of the solvers; %: of the \
             reference, otherwise in the unit of the quantity. Frequencies stand under FNA: they are \
             those of its basis.",
        ));
    for o in outcomes {
        let verdict = match () {
            () if o.pass() => "",
            () if o.fails() => " — FAILS",
            () => " — not run",
        };
        let mut section = Section::new(o.id, format!("{} {}{verdict}", o.id, o.title))
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

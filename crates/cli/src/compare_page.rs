//! A comparison as a page: the histories over each other.

use crate::compare::differences;
use crate::report::work;
use crate::text::{number, row};
use trilith::Model;
use trilith::compare::Compared;
use trilith::report::{Block, Figure, Page, Section};

/// One self-contained page.
pub(crate) fn page(model: &Model, case: &str, all: &[Compared]) -> String {
    let title = if model.title.is_empty() { "Comparison" } else { &model.title };
    let mut page = Page::new(title).lead(Block::text(format!(
        "Case \"{case}\" in {} ways; differences are from the first.",
        all.len()
    )));
    for finding in all.iter().filter_map(|c| Some((&c.variant, c.finding.as_ref()?))) {
        page = page.lead(Block::text(format!(
            "{}: likely cause of its difference: {}.",
            finding.0, finding.1
        )));
    }
    let mut table = vec![row(["variant", "status", "CPU set-up [s]", "CPU march [s]", "work"])];
    for c in all {
        let s = &c.outcome.summary;
        let [setup, march] = [s.work.setup_cpu_s, s.work.march_cpu_s].map(number);
        table.push(row([&c.variant.to_string(), s.status, &setup, &march, &work(&s.work)]));
    }
    page = page.section(Section::new("work", "Work and time").block(block(table)));
    let mut apart = Section::new("differences", "Differences");
    for c in &all[1..] {
        apart = apart.block(Block::text(format!("{} beside {}", c.variant, all[0].variant)));
        apart = apart.block(block(differences(c)));
    }
    page = page.section(apart);
    let figures: Vec<Figure> = model
        .outputs
        .iter()
        .enumerate()
        .map(|(i, o)| {
            let label = format!("{} [{}]", o.name, o.unit);
            let figure = Figure::new(o.name.clone(), "time [s]", label).sized(620, 340);
            all.iter().fold(figure, |f, c| {
                let points =
                    c.outcome.time.iter().copied().zip(c.outcome.histories[i].iter().copied());
                f.line(c.variant.to_string(), points)
            })
        })
        .collect();
    page.section(Section::new("histories", "Histories").block(figures)).html()
}

/// Rows, the first of which is the head.
fn block(mut rows: Vec<Vec<String>>) -> Block {
    let head = rows.remove(0);
    Block::Table { head, rows }
}

//! Every model, command and number of the book.

mod common;

use common::{Workshop, book, shows, value};
use std::collections::BTreeSet;

/// Whole models are run in all their cases.
#[test]
fn every_model_of_the_book_runs() {
    let mut seen = 0;
    for page in book() {
        let workshop = Workshop::of(&page);
        for fence in page.fences.iter().filter(|f| f.language() == "ron") {
            let marks = ["file", "study", "in", "study-in"];
            let marked = marks.iter().any(|a| fence.attribute(a).is_some());
            assert!(marked, "{}: a block of RON is no model, study or fragment", page.name);
            let Some(file) = fence.attribute("file") else { continue };
            let done = workshop.trilith(&format!("run {file}"));
            assert_eq!(done.status, 0, "{}: {file}\n{}", page.name, done.err);
            seen += 1;
        }
    }
    assert!(seen > 3, "only {seen} models");
}

/// Commands succeed and print what is shown.
#[test]
fn every_command_prints_what_the_book_shows() {
    let mut seen = 0;
    for page in book() {
        let workshop = Workshop::of(&page);
        for fence in page.fences.iter().filter(|f| f.language() == "console") {
            let mut blocks = fence.text.split("$ ");
            assert_eq!(blocks.next(), Some(""), "{}: a console block begins with `$ `", page.name);
            for block in blocks {
                let (line, shown) = block.split_once('\n').unwrap_or((block, ""));
                let Some(arguments) = line.strip_prefix("trilith ") else { continue };
                let done = workshop.trilith(arguments);
                let place = format!("{}: trilith {arguments}", page.name);
                assert_eq!(done.status, 0, "{place}\n{}{}", done.out, done.err);
                printed(shown, &format!("{}{}", done.err, done.out), &place);
                seen += 1;
            }
        }
    }
    assert!(seen > 10, "only {seen} commands");
}

/// The lines that are shown are printed in that order.
fn printed(shown: &str, all: &str, place: &str) {
    let mut rest = all.lines();
    for line in shown.lines().filter(|l| !l.trim().is_empty() && l.trim() != "…") {
        assert!(rest.any(|real| same(line, real)), "{place}\nprints no\n{line}\nbut\n{all}");
    }
}

/// Word by word; numbers within their digits, `…` for one word, or for the rest at the end.
fn same(shown: &str, real: &str) -> bool {
    let (shown, real): (Vec<_>, Vec<_>) =
        (shown.split_whitespace().collect(), real.split_whitespace().collect());
    let open = shown.last() == Some(&"…");
    let fits = if open { real.len() + 1 >= shown.len() } else { real.len() == shown.len() };
    fits && shown.iter().zip(&real).all(|(s, r)| {
        let bare = |t: &str| t.trim_end_matches([',', ';', ':', '%']).to_owned();
        *s == "…" || s == r || bare(r).parse().is_ok_and(|r: f64| shows(&bare(s), r))
    })
}

/// Numbers in the text are those of the runs that they name.
#[test]
fn every_measured_number_is_measured_again() {
    let mut seen = 0;
    let mut wrong = Vec::new();
    for page in book() {
        let mut workshop = Workshop::of(&page);
        for m in &page.measured {
            let v = value(workshop.summary(&m.run), &m.key)
                .unwrap_or_else(|e| panic!("{}: {e}", page.name));
            seen += 1;
            if !shows(&m.shown, v) {
                wrong.push(format!(
                    "{}: {} is {v:.6e}: trilith {}: {}",
                    page.name, m.shown, m.run, m.key
                ));
            }
        }
        for table in page.tables.iter().filter(|t| !t.columns.is_empty()) {
            assert!(
                !table.rows.is_empty(),
                "{}: the table of {} has no rows or another number of columns",
                page.name,
                table.run
            );
            for row in &table.rows {
                let mut run = table.run.clone();
                for (i, cell) in row.iter().enumerate() {
                    run = run.replace(&format!("{{{}}}", i + 1), cell);
                }
                for (cell, key) in row.iter().zip(&table.columns).filter(|(_, k)| *k != "-") {
                    let v = value(workshop.summary(&run), key)
                        .unwrap_or_else(|e| panic!("{}: {e}", page.name));
                    seen += 1;
                    if !shows(cell, v) {
                        wrong.push(format!(
                            "{}: {cell} is {v:.6e}: trilith {run}: {key}",
                            page.name
                        ));
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen > 40, "only {seen} numbers");
}

/// Pieces of source are in the files that they name, but for how far they are set in.
#[test]
fn every_piece_of_source_is_that_of_its_file() {
    let bare = |text: &str| -> String {
        let lines = text.lines().map(str::trim).filter(|l| !l.is_empty());
        lines.map(|l| format!("{l}\n")).collect()
    };
    let mut seen = 0;
    for page in book() {
        for fence in &page.fences {
            let Some(file) = fence.attribute("from") else { continue };
            let source = std::fs::read_to_string(common::root().join(file))
                .unwrap_or_else(|e| panic!("{}: {file}: {e}", page.name));
            let there = bare(&source).contains(&bare(&fence.text));
            assert!(there, "{}: {file} has no\n{}", page.name, fence.text);
            seen += 1;
        }
    }
    assert!(seen > 2, "only {seen} pieces");
}

/// Links lead to pages, figures and files that are there.
#[test]
fn every_link_leads_somewhere() {
    let folder = common::root().join("crates/guide/src");
    let mut listed: BTreeSet<String> = BTreeSet::new();
    for page in book() {
        listed.insert(page.name.clone());
        for link in page.links.iter().filter(|l| !l.starts_with("http")) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let path = if file.is_empty() { folder.join(&page.name) } else { folder.join(file) };
            assert!(path.exists(), "{}: {link} is not there", page.name);
            if !anchor.is_empty() {
                let text = std::fs::read_to_string(&path).unwrap();
                assert!(headings(&text).contains(anchor), "{}: no heading for {link}", page.name);
            }
        }
    }
    for entry in std::fs::read_dir(folder).unwrap() {
        let name = entry.unwrap().file_name().to_string_lossy().into_owned();
        let page = name.ends_with(".md") && name != "SUMMARY.md";
        assert!(!page || listed.contains(&name), "{name} is not in SUMMARY.md");
    }
}

/// Anchors of the headings of a page, as code hosts make them.
fn headings(text: &str) -> BTreeSet<String> {
    let anchor = |line: &str| -> String {
        let kept = line.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        kept.collect::<String>().trim().to_lowercase().replace(' ', "-")
    };
    text.lines().filter(|l| l.starts_with('#')).map(|l| anchor(l.trim_start_matches('#'))).collect()
}

#[test]
fn a_number_is_shown_within_its_last_digit() {
    assert!(shows("0.254", 0.2544) && shows("−1.2e3", -1.25e3) && shows("≈4000", 4100.0));
    assert!(shows("588584", 588_581.0) && !shows("588584", 588_570.0));
    assert!(!shows("0.254", 0.2562) && !shows("25.4", 25.6) && !shows("≈4000", 4300.0));
    assert!(
        same("slide m 0.25 …", "slide  m  0.2541 7 8") && !same("slide m 0.25", "slide m 0.27")
    );
}

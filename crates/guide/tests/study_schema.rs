//! The schema of studies against their reader.

mod common;

use common::{book, root};
use trilith::model::schema::{Block, Default};
use trilith_study::{Study, schema};

/// A study in which a block stands at its place.
fn study(place: &str, block: &str) -> String {
    let part = match place {
        "study" => return block.to_owned(),
        "axes" => format!(r#"axes: {{ "mu": {block} }}"#),
        "distributions" => {
            format!(r#"samples: Random(count: 2, of: {{ "height": {block} }})"#)
        }
        "samples" | "ensemble" | "stop" => format!("{place}: {block}"),
        "columns" => format!(r#"columns: {{ "c": {block} }}"#),
        "conditions" => format!("histories: {block}"),
        "figures" => format!("figures: [{block}]"),
        _ => panic!("tests/study_schema.rs knows no study around a block of `{place}`: add one"),
    };
    // Figures and conditions need something that varies.
    let axes = if matches!(place, "axes" | "samples") {
        ""
    } else {
        r#"axes: { "mu": [0.3, 0.6], "ah": [0.4, 0.8], "frequency": [4, 5] },"#
    };
    format!(r#"(model: "model.ron", {axes} {part})"#)
}

/// The study that is read, in all its parts; or its errors.
fn read(place: &str, block: &str) -> Result<String, Vec<String>> {
    let path = root().join("models/rigid_block.ron");
    let text = study(place, block).replace("model.ron", "rigid_block.ron");
    match Study::read_text(&text, path.with_file_name("study.ron"), &trilith::registry(), &[]) {
        Ok(study) => Ok(format!("{study:?}")),
        Err(errors) => Err(errors.iter().map(ToString::to_string).collect()),
    }
}

fn good(place: &str, block: &str) -> String {
    read(place, block).unwrap_or_else(|all| panic!("{place}: {block}\n{}", all.join("\n")))
}

fn blocks() -> Vec<(&'static str, &'static Block)> {
    let groups = schema::groups();
    groups.into_iter().flat_map(|g| g.blocks.iter().map(|b| (g.name, *b))).collect()
}

#[test]
fn defaults_are_those_of_the_reader() {
    let mut seen = 0;
    for (place, block) in blocks() {
        let plain = good(place, block.example);
        for f in block.fields {
            let given = block.example.contains(&format!("{}: ", f.name));
            if let (Default::Value(value), false) = (f.default, given) {
                let front = block.example.strip_suffix(')').unwrap();
                let said = good(place, &format!("{front}, {}: {value})", f.name));
                assert!(plain == said, "{place} {}: `{}` is not {value}", block.name, f.name);
                seen += 1;
            }
        }
    }
    assert!(seen >= 5, "only {seen} defaults");
}

#[test]
fn fields_that_must_be_given_are_missed() {
    let mut seen = 0;
    for (place, block) in blocks() {
        for f in block.fields.iter().filter(|f| f.name.parse::<u8>().is_err()) {
            let needed = matches!(f.default, Default::Required);
            let text = block.example.replace(&format!("{}: ", f.name), "no_such_field: ");
            if text == block.example {
                assert!(!needed, "{place} {}: no example of {}", block.name, f.name);
                continue;
            }
            let told = read(place, &text).unwrap_err();
            let all = told.join("\n");
            let what = format!("{place} {} {}:\n{all}", block.name, f.name);
            assert!(all.contains("no field `no_such_field`"), "{what}");
            let missed = all.contains(&format!("no `{}`", f.name));
            let either = matches!(f.default, Default::Absent(w) if w.starts_with('`'));
            assert!(either || missed == needed, "{what}");
            seen += 1;
        }
    }
    assert!(seen > 30, "only {seen} fields");
}

/// Measures and conditions without what stands in their parentheses are refused with their example.
#[test]
fn positions_that_must_be_given_are_missed() {
    let positional = |b: &Block| b.fields.iter().any(|f| f.name == "1");
    let all: Vec<_> = blocks().into_iter().filter(|(_, b)| positional(b)).collect();
    for (place, block) in &all {
        let told = read(place, block.name).unwrap_err().join("\n");
        assert!(told.contains(&format!("`{}` is wanted here", block.example)), "{told}");
    }
    assert!(all.len() > 8);
}

#[test]
fn every_fragment_of_the_book_is_read() {
    let mut seen = 0;
    for page in book() {
        for fence in &page.fences {
            if let Some(place) = fence.attribute("study-in") {
                good(place, fence.text.trim());
                seen += 1;
            }
        }
    }
    assert!(seen > 30, "only {seen} fragments");
}

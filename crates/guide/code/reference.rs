//! The references of model files and study files, written from the schemas.

use std::fmt::Write;
use trilith::element::Category;
use trilith::model::schema::{self, Block, Default, Field, Group, Takes};

/// The page.
#[must_use]
pub fn reference() -> String {
    let mut out = String::from(HEAD);
    for g in schema::groups() {
        group(&mut out, g, "in");
        if g.name == "model" {
            beside(&mut out);
            out.push_str(FILES);
            out.push_str(JSON);
            group(&mut out, &schema::REPETITION, "in");
            out.push_str(TEXTS);
        }
    }
    kinds(&mut out);
    units(&mut out);
    out
}

/// The page on study files.
#[must_use]
pub fn study_reference() -> String {
    let mut out = String::from(STUDY_HEAD);
    for g in trilith_study::schema::groups() {
        group(&mut out, g, "study-in");
    }
    out
}

const STUDY_HEAD: &str = "# Study file reference

This page is written from the tables that the reader of study files itself uses
(`cargo run --release -p trilith-guide -- reference`); a test compares the two. A study is
[RON](https://github.com/ron-rs/ron) like a [model](reference.md), with the same numbers, units and errors. A
value of a parameter is what `--set NAME=VALUE` takes: a number, an expression in the parameters of the model
in quotes, or a text for a text parameter such as a record. Random numbers hang on `seed` and the name of the
parameter alone. `trilith sweep STUDY --dry-run` checks a study and counts its runs.
";

const HEAD: &str = "# Model file reference

This page is written from the tables that the reader of model files itself uses
(`cargo run --release -p trilith-guide -- reference`); a test compares the two. The parameters of elements,
constraints and links are on their cards: `trilith elements NLink`, or all together in
the catalogue in [elements](../../../elements).

A model file is [RON](https://github.com/ron-rs/ron): `(field: value)` is a block, `Name(field: value)` a
block with a name, `[…]` or `(…)` a list, `{ \"name\": … }` a map. Every number may be a bare number (SI, or what
`units` says), a text with a unit such as `\"4 m\"`, or an expression such as `\"mu * mass * g\"`; expressions
have `+ - * / ^`, parentheses, the parameters of the file, and the functions listed under *Units*. Numbers
are checked for dimension. Unknown names are refused with a suggestion, all errors of a file at once.
`trilith check MODEL` prints what a model is in figures, `trilith check MODEL --resolved` the model with every default
filled in.
";

const FILES: &str = "
## Other files

`include: [\"sections.ron\"]` takes sections from other files, each a block such as `(properties: { … })`. A file may hold
`parameters`, `nodes`, `supports`, `properties`, `elements`, `groups`, `functions`, `loads`, `cases`, `outputs`,
`spectra` and `envelopes`, `units` of its own bare numbers (SI where it has none), and `include`. Its entries stand before those of the
model, in the order of the list; a name that comes twice is refused. A path counts from the file that it stands in, that
of a record as well, and an included file lies in the folder of the model or below. Two files may include the same one; it
is there once.
";

const JSON: &str = "
## JSON

A file whose name ends in `.json` holds the same in JSON: models, and files that they include. `Kind(field: value)` is
`{\"Kind\": {\"field\": value}}`, a block without a name an object, a list an array, a map an object; a name that stands alone is a
text, as in `\"supports\": {\"base\": \"Fixed\"}`. `trilith schema` prints a JSON Schema, with which editors complete names and show what
they mean; it knows less than the reader, which has the last word.
";

const TEXTS: &str = "
An index stands for its value in expressions, as in `\"k * 3.2 m\"`, and in braces in texts and names, as in
`\"n{i}.{k+1}\"`. Braces hold expressions in indices and parameters that give whole numbers, or an index or a text
parameter alone, whose value is put in as it stands; they are filled in in all texts of a model but `parameters`, `units`
and `include`. `{{` and `}}` stand for braces. An index has no name of a parameter, of a unit, or of an index around it.
`\"2 to 1\"` makes nothing. Values of a map may have several names each, as in `c: { \"a\": (x: 0, y: 5), \"b\": (x: 6, y: 5) }`:
`{c}` is then `a` or `b`, and `x` and `y` are indices like `c`. A model repeats at most a million times.
";

fn group(out: &mut String, g: &Group, within: &str) {
    let _ = write!(out, "\n## {}\n\n{}\n", title(g.name), g.meaning);
    for b in g.blocks {
        if !b.name.is_empty() {
            let _ = write!(out, "\n### {}\n", b.name);
        }
        block(out, b, (within, g.name));
    }
}

/// What the sections of a model hold that is no group of blocks.
fn beside(out: &mut String) {
    for (name, b, place) in [
        ("Place of an element", &schema::PLACE, "elements"),
        ("Fields of all elements", &schema::ELEMENT, "elements"),
        ("Fields of all links", &schema::LINK, "elements"),
        ("Fields of members", &schema::MEMBER, "elements"),
    ] {
        let _ = write!(out, "\n## {name}\n");
        block(out, b, ("in", place));
    }
}

fn block(out: &mut String, b: &Block, (within, place): (&str, &str)) {
    let place = anchor(place);
    let _ = write!(out, "\n{}\n\n```ron,{within}={place}\n{}\n```\n", b.meaning, b.example);
    if b.fields.is_empty() {
        return;
    }
    out.push_str("\n| field | takes | default | meaning |\n|---|---|---|---|\n");
    for f in b.fields {
        let Field { meaning, .. } = f;
        // A number is a position.
        let name = if f.name.parse::<u8>().is_ok() {
            format!("{}.", f.name)
        } else {
            format!("`{}`", f.name)
        };
        let _ =
            writeln!(out, "| {name} | {} | {} | {meaning} |", takes(f.takes), default(f.default));
    }
}

/// What a field takes, groups as links.
fn takes(t: Takes) -> String {
    t.words(|g| format!("[{}](#{})", title(g.name), anchor(g.name)))
}

fn default(d: Default) -> String {
    d.words().unwrap_or_else(|| "**must be given**".into())
}

fn title(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |c| c.to_uppercase().chain(letters).collect())
}

fn anchor(name: &str) -> String {
    name.replace(' ', "-")
}

fn kinds(out: &mut String) {
    out.push_str("\n## Kinds\n\nWhat `elements` and `properties` may hold.\n");
    let registry = trilith::registry();
    for (category, name) in [
        (Category::Linear, "Linear elements"),
        (Category::Constraint, "Constraints"),
        (Category::Link, "Links"),
    ] {
        let _ = write!(out, "\n### {name}\n\n| kind | is | parameters |\n|---|---|---|\n");
        for card in registry.cards().filter(|c| c.category == category) {
            let all: Vec<_> = card.parameters.iter().map(|p| format!("`{}`", p.name)).collect();
            let _ = writeln!(out, "| `{}` | {} | {} |", card.kind, card.summary, all.join(", "));
        }
    }
}

fn units(out: &mut String) {
    out.push_str("\n## Units\n\nA unit stands behind a number and may be a product such as `N*s/m` or `m/s^2`.\n\n| unit | of | in SI |\n|---|---|---|\n");
    for (name, factor, si) in schema::units() {
        let _ = writeln!(
            out,
            "| `{name}` | {} | {factor} |",
            if si == "1" { "pure number" } else { &si }
        );
    }
    let all: Vec<_> = schema::expression_functions().iter().map(|f| format!("`{f}`")).collect();
    let _ = write!(out, "\nFunctions of expressions: {}.\n", all.join(", "));
}

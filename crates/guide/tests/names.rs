//! Every command, option, kind and field that the book names is there.

mod common;

use common::{book, root, trilith_in};
use std::collections::BTreeSet;
use std::path::Path;
use trilith::model::schema::{self, Takes};

fn help(arguments: &[&str]) -> String {
    let all: Vec<String> = arguments.iter().map(|a| (*a).to_owned()).collect();
    let done = trilith_in(&root(), &[all, vec!["--help".to_owned()]].concat());
    assert_eq!(done.status, 0, "{arguments:?}: {}", done.err);
    done.out
}

/// Names of the commands in a help text.
fn commands(text: &str) -> Vec<String> {
    let list = text.split_once("Commands:\n").map_or("", |(_, rest)| rest);
    let lines = list.lines().take_while(|l| !l.trim().is_empty());
    let names = lines.filter(|l| l.starts_with("  ") && !l.starts_with("   "));
    names
        .filter_map(|l| l.split_whitespace().next())
        .filter(|n| *n != "help")
        .map(str::to_owned)
        .collect()
}

fn options(text: &str) -> BTreeSet<String> {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
    words.filter(|w| w.starts_with("--") && w.len() > 2).map(str::to_owned).collect()
}

/// All commands with their own commands, and the options of each.
fn program() -> Vec<(Vec<String>, BTreeSet<String>)> {
    let mut found = Vec::new();
    for command in commands(&help(&[])) {
        let text = help(&[&command]);
        for inner in commands(&text) {
            found.push((vec![command.clone(), inner.clone()], options(&help(&[&command, &inner]))));
        }
        found.push((vec![command], options(&text)));
    }
    found
}

#[test]
fn every_command_and_option_is_there() {
    let program = program();
    assert!(program.len() > 8, "{program:?}");
    let known: BTreeSet<&String> = program.iter().flat_map(|(_, o)| o).collect();
    let mut wrong = Vec::new();
    for page in book() {
        let blocks = page.fences.iter().filter(|f| f.language() == "console");
        let lines = blocks.flat_map(|f| f.text.lines()).filter_map(|l| l.strip_prefix("$ "));
        for text in lines.chain(page.words.iter().map(String::as_str)) {
            let foreign = ["cargo ", "mdbook "].iter().any(|p| text.starts_with(p));
            if foreign {
                continue;
            }
            if let Some(rest) = text.strip_prefix("trilith ") {
                let words: Vec<&str> = rest.split_whitespace().collect();
                let fits = |names: &[String]| {
                    names.iter().zip(&words).all(|(a, b)| a == b) && names.len() <= words.len()
                };
                let Some((names, own)) = program.iter().find(|(names, _)| fits(names)) else {
                    wrong.push(format!("{}: `{text}` is no command", page.name));
                    continue;
                };
                for o in options(rest).iter().filter(|o| !own.contains(*o)) {
                    wrong.push(format!("{}: {} has no option {o}", page.name, names.join(" ")));
                }
            } else {
                for o in options(text).iter().filter(|o| !known.contains(o)) {
                    wrong.push(format!("{}: no command has the option {o} of `{text}`", page.name));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Names of blocks, fields, choices, kinds and their parameters.
fn schema_names() -> BTreeSet<String> {
    let mut all: BTreeSet<String> = BTreeSet::new();
    let mut add = |names: &[&str]| all.extend(names.iter().map(|n| (*n).to_owned()));
    let groups = schema::groups().into_iter().chain(trilith_study::schema::groups());
    let blocks = groups.flat_map(|g| g.blocks.iter().copied());
    let beside = [&schema::PLACE, &schema::ELEMENT, &schema::LINK, &schema::MEMBER];
    let beside = beside.into_iter().chain(schema::REPETITION.blocks.iter().copied());
    for b in blocks.chain(beside) {
        add(&[b.name]);
        add(&b.names());
        for f in b.fields {
            if let Takes::Choice(names) = f.takes {
                add(names);
            }
        }
    }
    add(&schema::SUPPORTS);
    add(&schema::GROUP_KINDS);
    add(schema::expression_functions());
    add(&["Parameter", "Text", "true", "false"]);
    for (unit, ..) in schema::units() {
        add(&[unit]);
    }
    for card in trilith::registry().cards() {
        add(&[card.kind]);
        for p in card.parameters {
            add(&[p.name]);
            if let trilith::element::Form::Choice(names) | trilith::element::Form::Choices(names) =
                p.form
            {
                add(names);
            }
        }
    }
    all
}

/// What else the book may put in backticks: words of the program, of Rust, of results.
const OTHERS: &[&str] = &[
    // In the names of hollow sections.
    "cold",
    // solvers on the command line, status of a run, modes of response
    "fna",
    "hht",
    "ritz-hht",
    "full-newton",
    "converged",
    "overturned",
    "rest",
    "slide",
    "rock",
    "slide-rock",
    "flight",
    // words of examples and of the summary
    "trilith",
    "Link",
    "Kit",
    "conformance",
    "read_text",
    "Name",
    "Kind",
    "error_relative",
    "refused",
    // of the contract of laws, and of the example of a third party
    "refusal",
    "respond",
    "uses_rates",
    "damping_constant",
    "FileText",
    "Contents",
    "slip",
    "wrong_laws",
    // of laws in Python
    "force",
    "tangent",
    "energy",
    "energy_error",
    "engaged",
    "at_rest",
    "check",
    "step",
    "rates",
    "axes",
    "history",
    "compiled",
    "laws",
    "Hardening",
    "default",
    "range",
    "meaning",
    "example",
    "result",
    "self",
    "d",
    "v",
    // between comparisons
    "and",
    "or",
    "not",
    // of the environment
    "SOURCE_DATE_EPOCH",
    // of Nastran
    "DMIG",
    "EXTSEOUT",
];

/// A word in backticks that looks like a name of a model file.
fn looks_like_a_name(word: &str) -> Option<&str> {
    let end = word.find(['(', ':']).unwrap_or(word.len());
    let (name, rest) = word.split_at(end);
    let letters = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let first = name.chars().next()?;
    let plain = rest.is_empty() || rest.starts_with('(') || rest.starts_with(": ");
    (first.is_ascii_alphabetic() && name.chars().all(letters) && plain).then_some(name)
}

#[test]
fn every_kind_and_field_is_there() {
    let names = schema_names();
    let figures = [
        trilith::report::ENERGY,
        trilith::report::GROUND,
        trilith::report::MODEL,
        trilith::report::SPECTRA,
    ];
    let models = std::fs::read_dir(root().join("models")).unwrap().map(|e| e.unwrap().path());
    let models = models.filter(|p| p.extension().is_some_and(|e| e == "ron"));
    let shipped: Vec<String> = models.map(|p| std::fs::read_to_string(p).unwrap()).collect();
    let mut wrong = Vec::new();
    for page in book() {
        // Names that the models of the page or the shipped ones give themselves are their own.
        let blocks = page.fences.iter().filter(|f| f.language() == "ron").map(|f| &f.text);
        let texts: Vec<&String> = blocks.chain(&shipped).collect();
        let own = |word: &str| texts.iter().any(|t| t.contains(&format!("\"{word}\"")));
        for word in &page.words {
            let Some(name) = looks_like_a_name(word) else { continue };
            let other = OTHERS.contains(&name) || figures.contains(&name);
            if !names.contains(name) && !other && !own(name) {
                wrong.push(format!("{}: `{word}`", page.name));
            }
        }
    }
    assert!(wrong.is_empty(), "no such kind or field:\n{}", wrong.join("\n"));
}

/// Rust sources in a folder and below.
fn sources(folder: &Path) -> Vec<String> {
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            all.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            all.push(std::fs::read_to_string(path).unwrap());
        }
    }
    all
}

/// True where a source defines an item of this name.
fn defines(source: &str, name: &str) -> bool {
    ["struct", "enum", "trait", "fn", "type", "const", "mod"].iter().any(|kind| {
        source.match_indices(&format!("{kind} {name}")).any(|(at, found)| {
            let next = source[at + found.len()..].chars().next();
            !next.is_some_and(|c| c.is_ascii_alphanumeric() || c == '_')
        })
    })
}

#[test]
fn every_name_and_path_of_the_architecture_is_in_the_code() {
    let book = book();
    let page = book.iter().find(|p| p.name == "architecture.md").expect("a page on the code");
    let (mut names, mut paths, mut wrong) = (0, 0, Vec::new());
    for word in &page.words {
        if let Some((place, name)) = word.split_once("::") {
            let room = root().join("crates/solvers/src").join(place);
            let package = root().join("crates").join(place).join("src");
            let file = room.with_extension("rs");
            let texts = match (room.is_dir(), file.is_file()) {
                (true, _) => sources(&room),
                (_, true) => vec![std::fs::read_to_string(file).unwrap()],
                _ if package.is_dir() => sources(&package),
                _ => Vec::new(),
            };
            if place != "room" && !texts.iter().any(|text| defines(text, name)) {
                wrong.push(word.clone());
            }
            names += 1;
        } else if word.contains('/') {
            if !word.ends_with("/room") && !root().join(word).exists() {
                wrong.push(word.clone());
            }
            paths += 1;
        }
    }
    assert!(wrong.is_empty(), "not in the code: {wrong:?}");
    assert!(names > 30 && paths > 15, "only {names} names and {paths} paths");
}

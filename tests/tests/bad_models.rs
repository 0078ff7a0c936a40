//! Bad models: every one is refused, with the right code, words and place.
//!
//! Each file of `bad_models/` begins with lines
//!
//! ```text
//! // expect CODE at LINE:COLUMN `text there`: words of the message, and of the help after `; `
//! ```
//!
//! one for each error, in the order in which they are told. CODE is that of the diagnostic or, where
//! the file can be read but is no structure, the name of the `SystemError`.

use std::path::{Path, PathBuf};
use trilith_model::{Diagnostic, Model, Registry, line_column, read, read_text};
use trilith_system::{System, SystemError};

/// An error as told, or as wanted.
#[derive(Debug)]
struct Told {
    code: String,
    place: (usize, usize),
    at: String,
    words: String,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("bad_models")
}

fn registry() -> Registry {
    let mut registry = Registry::new();
    trilith_elements::register(&mut registry);
    registry
}

fn wanted(text: &str) -> Vec<Told> {
    let lines = text.trim_start_matches('\u{feff}').lines();
    lines.map_while(|l| l.strip_prefix("// expect ")).map(expectation).collect()
}

fn expectation(line: &str) -> Told {
    let parts = || {
        let (code, rest) = line.split_once(" at ")?;
        let (place, rest) = rest.split_once(" `")?;
        let (row, column) = place.split_once(':')?;
        let (at, words) = rest.split_once("`: ").or(rest.strip_suffix("`:").map(|at| (at, "")))?;
        let place = (row.parse().ok()?, column.parse().ok()?);
        Some(Told { code: code.into(), place, at: at.into(), words: words.into() })
    };
    parts().unwrap_or_else(|| panic!("not understood: {line}"))
}

fn told(d: &Diagnostic) -> Told {
    Told {
        code: d.code.into(),
        place: (d.line(), d.column()),
        at: d.source.text.get(d.span.start..).unwrap_or_default().into(),
        words: match &d.help {
            Some(help) => format!("{}; {help}", d.message),
            None => d.message.clone(),
        },
    }
}

fn told_of_structure(model: &Model, error: &SystemError) -> Told {
    let code = match error {
        SystemError::Element { .. } => "Element",
        SystemError::Cycle { .. } => "Cycle",
        SystemError::Overdetermined { .. } => "Overdetermined",
        SystemError::Unsupported { .. } => "Unsupported",
        SystemError::Overflow { .. } => "Overflow",
        _ => "other",
    };
    let place = model.places.find(&error.span().unwrap_or_default());
    let (text, start) = (&place.source.text, place.span.start);
    Told {
        code: code.into(),
        place: line_column(text, start),
        at: text[start..].into(),
        words: format!("{error}, with {}", place.indices()),
    }
}

/// All errors of a file: of reading, or else of the structure.
fn errors(path: &Path) -> Vec<Told> {
    let model = match read(path, &registry(), &[]) {
        Err(all) => return all.iter().map(told).collect(),
        Ok(model) => model,
    };
    let checked =
        System::without_axial_forces(&model).and_then(|s| s.check_supported(&model, false));
    checked.err().iter().map(|e| told_of_structure(&model, e)).collect()
}

fn files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder()).unwrap().map(|e| e.unwrap().path());
    let mut all: Vec<_> = entries.filter(|p| p.extension().is_some_and(|x| x == "ron")).collect();
    all.sort();
    all
}

/// What differs, in words; nothing where all is as wanted.
fn difference(path: &Path) -> Option<String> {
    let text = std::fs::read_to_string(path).unwrap();
    let (wanted, found) = (wanted(&text), errors(path));
    let same = |(w, f): (&Told, &Told)| {
        w.code == f.code
            && w.place == f.place
            && f.at.starts_with(&w.at)
            && f.words.contains(&w.words)
    };
    let good =
        !wanted.is_empty() && wanted.len() == found.len() && wanted.iter().zip(&found).all(same);
    let row = |t: &Told| {
        let at: String = t.at.lines().next().unwrap_or_default().chars().take(40).collect();
        format!("  {} at {}:{} `{at}`: {}", t.code, t.place.0, t.place.1, t.words)
    };
    let rows = |all: &[Told]| all.iter().map(row).collect::<Vec<_>>().join("\n");
    let name = path.file_name().unwrap_or_default().display();
    (!good).then(|| format!("{name}: wanted\n{}\nfound\n{}", rows(&wanted), rows(&found)))
}

#[test]
fn every_bad_model_is_refused_with_the_right_words_at_the_right_place() {
    let files = files();
    assert!(files.len() >= 40, "{} files", files.len());
    let wrong: Vec<_> = files.iter().filter_map(|p| difference(p)).collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), files.len(), wrong.join("\n\n"));
}

#[test]
fn every_span_lies_within_its_text() {
    for path in files() {
        let Err(all) = read(&path, &registry(), &[]) else { continue };
        for d in all {
            let inside = |s: &std::ops::Range<usize>| d.source.text.get(s.clone()).is_some();
            assert!(inside(&d.span), "{d}");
            assert!(d.related.iter().all(|(s, _)| inside(s)), "{d}");
            assert!(d.suggestion.iter().all(|(s, _)| inside(s)), "{d}");
            let included = d.source.path.parent().is_some_and(|p| p.ends_with("included"));
            let told = d.to_string().contains(&*path.file_name().unwrap().to_string_lossy());
            assert!(told || included, "{d}");
        }
    }
}

#[test]
fn a_suggestion_put_in_place_repairs_the_model() {
    let mut repaired = 0;
    for path in files() {
        let text = std::fs::read_to_string(&path).unwrap();
        let Err(all) = read(&path, &registry(), &[]) else { continue };
        let [Diagnostic { suggestion: Some((span, instead)), source, .. }] = all.as_slice() else {
            continue;
        };
        if source.path != path {
            continue;
        }
        let mut better = text.clone();
        better.replace_range(span.clone(), instead);
        let again = read_text(&better, &path, &registry(), &[]);
        let more: Vec<_> = again.err().iter().flatten().map(ToString::to_string).collect();
        assert!(more.is_empty(), "{}: {}", path.display(), more.join("\n"));
        repaired += 1;
    }
    assert!(repaired >= 5, "{repaired} repaired");
}

fn set(name: &str, value: &str) -> Vec<Diagnostic> {
    let block = folder().join("../../models/rigid_block.ron");
    let given = [(name.to_owned(), value.to_owned())];
    read(block, &registry(), &given).expect_err("must be refused")
}

#[track_caller]
fn refused(name: &str, value: &str, code: &str, words: &str, at: &str) {
    let all = set(name, value);
    assert_eq!(all.len(), 1, "{all:?}");
    let found = told(&all[0]);
    assert_eq!(found.code, code, "{found:?}");
    assert!(found.words.contains(words) && found.at.starts_with(at), "{found:?}");
}

#[test]
fn a_value_set_for_an_unknown_parameter_is_refused_with_the_near_name() {
    refused("heigth", "3", "E0119", "no parameter `heigth`; did you mean `height`?", "heigth=3");
}

#[test]
fn a_value_set_in_a_wrong_dimension_is_refused() {
    refused("mass", "3 m", "E0111", "`mass` is set to a value in m", "3 m");
    refused("ah", "1 m", "E0111", "`ah` is set to a value in m", "1 m");
}

#[test]
fn a_value_set_with_an_error_is_shown_where_it_is_wrong() {
    refused("mass", "2*mas", "E0110", "`mas`", "mas");
    refused("mass", "10 Kg", "E0109", "did you mean `kg`?", "Kg");
    refused("mass", "", "E0108", "", "");
    refused("mass", "mass", "E0113", "`mass`", "mass");
}

#[test]
fn a_value_set_out_of_range_is_refused_where_the_model_uses_it() {
    refused("kn", "-1", "E0112", "`kn` = -1 N/m: must be > 0", "\"kn\"");
    refused("pull", "2", "E0112", "must be true or false", "\"pull\"");
    refused("dt", "1", "E0119", "no parameter `dt`", "dt=1");
}

#[test]
fn a_model_file_that_is_not_there_is_told_with_its_path() {
    let all = read(folder().join("nowhere.ron"), &registry(), &[]).expect_err("no file");
    assert_eq!((all.len(), all[0].code), (1, "E0100"));
    assert!(all[0].to_string().contains("nowhere.ron"));
}

#[test]
fn an_empty_model_is_told_at_its_end() {
    for text in ["", "\u{feff}", "\r\n", "// nothing"] {
        let all = read_text(text, "empty.ron", &registry(), &[]).expect_err("nothing there");
        assert_eq!((all.len(), all[0].code), (1, "E0101"), "{text:?}");
        assert!(all[0].span.end <= text.len());
    }
}

#[test]
fn a_model_file_that_is_no_text_is_told() {
    let file = std::env::temp_dir().join(format!("trilith-no-text-{}.ron", std::process::id()));
    std::fs::write(&file, [0x28, 0xff, 0xfe, 0x29]).unwrap();
    let all = read(&file, &registry(), &[]).expect_err("no text");
    std::fs::remove_file(&file).unwrap();
    assert_eq!((all.len(), all[0].code), (1, "E0100"));
}

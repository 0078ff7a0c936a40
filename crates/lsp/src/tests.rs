//! Candidates and meanings at a cursor `|`.

use crate::complete::Candidate;
use crate::complete::{Asking, complete};
use crate::documents::{Document, Documents};
use crate::explain::outline;
use crate::looking::Looking;
use crate::names::File;
use crate::place::place;
use crate::position::Encoding;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// What `of` tells of the place of the cursor.
fn asked<T>(marked: &str, of: impl FnOnce(&Asking<'_>) -> T) -> T {
    let at = marked.find('|').expect("a cursor");
    let registry = trilith::registry();
    let files = [File::new("m.ron".into(), marked.replacen('|', "", 1).into())];
    let place = place(&registry, &files[0], at);
    of(&Asking { registry: &registry, files: &files, place: &place, at })
}

fn candidates(marked: &str) -> Vec<Candidate> {
    asked(marked, |it| complete(it).0)
}

fn labels(marked: &str) -> Vec<String> {
    candidates(marked).into_iter().map(|c| c.label).collect()
}

/// The text after a candidate was taken.
fn taken(marked: &str, label: &str) -> String {
    let all = candidates(marked);
    let Some(c) = all.iter().find(|c| c.label == label) else {
        panic!("{label} is not among {:?}", labels(marked));
    };
    let mut text = marked.replacen('|', "", 1);
    text.replace_range(c.span.clone(), &c.text);
    text
}

fn hover(marked: &str) -> String {
    asked(marked, |it| it.explain().map_or_else(String::new, |e| e.markdown))
}

/// A small model around a text for one of its sections.
fn model(section: &str) -> String {
    format!(
        r#"(
    parameters: {{ "width": "2 m", "mu": 0.5 }},
    nodes: {{ "fuß links": (0, 0, 0), "fuß 🦶": (1, 0, 0), "n {{i}}": For(i: "1 to 3", of: ("i", 0, 0)) }},
    functions: {{ "shake": Sine(amplitude: 1, frequency: "1 Hz") }},
    groups: {{ "feet": ["fuß *"] }},
    {section}
)"#
    )
}

#[track_caller]
fn has(marked: &str, all: &[&str], none: &[&str]) {
    let found = labels(marked);
    let there = |name: &&&str| found.iter().any(|f| f == **name);
    assert!(all.iter().all(|name| there(&name)), "{marked}: {found:?}");
    assert!(!none.iter().any(|name| there(&name)), "{marked}: {found:?}");
}

#[test]
fn kinds_stand_where_one_is_expected() {
    for value in ["|", "Spr|", "|Spring()"] {
        let text = model(&format!("elements: {{ \"a\": {value} }}"));
        has(&text, &["Spring", "Gap", "RigidBody", "For"], &["Static", "Sine", "Displacement"]);
    }
    has(&model("properties: { \"a\": | }"), &["NLink"], &["Sine"]);
    has(&model("cases: { \"a\": | }"), &["Static", "Dynamic"], &["Gap"]);
    has(&model("outputs: { \"a\": | }"), &["Displacement", "StoreyDrift"], &["Gap"]);
    has(&model("damping: |"), &["None", "Modal"], &["For", "Gap"]);
    has(&model("loads: { \"a\": [|] }"), &["Uniform", "Point", "For"], &["Gravity"]);
    has(&model("elements: { \"a\": Beam(section: |) }"), &["Pipe", "Box"], &["Beam"]);
    has(&model("elements: { \"a {i}\": For(i: \"1 to 2\", of: |) }"), &["Gap"], &["Sine"]);
    has(&model("functions: { \"a\": | }"), &["Sine", "Record"], &["Gap"]);
    assert_eq!(taken("(elements: { \"a\": Sp| })", "Spring"), "(elements: { \"a\": Spring( })");
    assert_eq!(
        taken("(elements: { \"a\": S|x(k: 1) })", "Spring"),
        "(elements: { \"a\": Spring(k: 1) })"
    );
    assert_eq!(taken("(damping: N|)", "None"), "(damping: None)");
}

#[test]
fn fields_are_those_that_are_not_given_yet() {
    let text = model("elements: { \"a\": NLink(node: \"x\", |, mu: 0.5) }");
    has(&text, &["kn", "ks", "use", "effective_stiffness"], &["node", "mu", "section", "nodse"]);
    has(&model("elements: { \"a\": Beam(|) }"), &["section", "axis1"], &["effective_stiffness"]);
    has(&model("properties: { \"a\": Beam(|) }"), &["section"], &["nodes", "use"]);
    // Those that must be given come first, and say so.
    let first = &candidates(&text)[0];
    assert!(first.detail.contains("must be given") && first.detail.contains("N/m"), "{first:?}");
    has(&model("|"), &["elements", "cases", "title"], &["nodes", "groups"]);
    has(
        &model("cases: { \"a\": Dynamic(base: [(|)]) }"),
        &["direction", "function"],
        &["duration"],
    );
    has(&model("cases: { \"a\": Dynamic(base: (|)) }"), &["direction", "function"], &["duration"]);
    has(&model("elements: { \"a\": Gap(node: \"x\", |\n \"b\": Gap() }"), &["k"], &["node"]);
    assert_eq!(taken("(elements: { \"a\": Gap(|) })", "k"), "(elements: { \"a\": Gap(k: ) })");
    assert_eq!(
        taken("(elements: { \"a\": Gap(o|p: 1) })", "opening"),
        "(elements: { \"a\": Gap(opening: 1) })"
    );
}

#[test]
fn choices_are_those_of_the_field() {
    let case = |field: &str| model(&format!("cases: {{ \"a\": Dynamic({field}) }}"));
    assert_eq!(labels(&case("solver: |")), ["Fna", "Hht", "RitzHht", "FullNewton"]);
    assert_eq!(labels(&case("initial: [(dof: U|)]"))[..2], ["Ux", "Uy"]);
    has(&case("loads: [|]"), &[], &["Fna"]);
    has(&model("cases: { \"a\": Static(loads: [|]) }"), &["Gravity"], &["Uniform"]);
    assert_eq!(labels(&model("plane: |")), ["XZ", "YZ", "XY"]);
    has(&model("supports: { \"fuß links\": | }"), &["Fixed", "Ux"], &["XZ"]);
    has(&model("supports: { \"fuß links\": (Ux, |) }"), &["Uy"], &["XZ"]);
    assert_eq!(labels(&model("outputs: { \"o\": Acceleration(absolute: |) }")), ["true", "false"]);
}

#[test]
fn names_are_those_that_the_model_gives() {
    let element = |field: &str| model(&format!("elements: {{ \"a\": Spring({field}) }}"));
    for field in ["node: \"|\"", "node: |", "nodes: (\"|\", \"b\")", "nodes: [\"fuß|"] {
        has(&element(field), &["fuß links", "fuß 🦶", "feet", "n {i}"], &["shake", "width"]);
    }
    let text = taken(&element("node: \"fu|\""), "fuß 🦶");
    assert!(text.contains("Spring(node: \"fuß 🦶\")"), "{text}");
    let text = taken(&element("node: |"), "fuß 🦶");
    assert!(text.contains("Spring(node: \"fuß 🦶\")"), "{text}");
    // Quotes without an end take nothing away.
    let text = taken(&element("node: \"fu|, k1: \"1 kN/m\""), "fuß 🦶");
    assert!(text.contains("node: \"fuß 🦶, k1: \"1 kN/m\""), "{text}");
    has(
        &model("properties: { \"p\": Gap() }, elements: { \"a\": Gap(use: \"|\") }"),
        &["p"],
        &["a"],
    );
    has(&model("cases: { \"c\": Static(), \"d\": Dynamic(after: \"|\") }"), &["c"], &["shake"]);
    has(&model("cases: { \"d\": Dynamic(base: [(function: \"|\")]) }"), &["shake"], &["d"]);
    has(&model("loads: { \"w\": [] }, cases: { \"c\": Static(loads: [\"|\"]) }"), &["w"], &["c"]);
    has(&model("outputs: { \"o\": Sum(), \"p\": Sum(terms: [\"|\"]) }"), &["o"], &["fuß links"]);
    let combined = |names: &str| {
        let cases = "cases: { \"wind\": Static() }, combinations: { \"both\": Srss(), \"all\": Envelope(cases: ";
        model(&format!("{cases}{names}) }}"))
    };
    for names in ["{ \"|\": 1 }", "{ | }", "[\"|\"]", "[|]", "(\"|\")"] {
        has(&combined(names), &["wind", "both"], &["shake", "fuß links"]);
    }
    has(
        &model("cases: { \"c\": Dynamic(after: \"|\") }, combinations: { \"x\": Srss() }"),
        &[],
        &["x"],
    );
    has(&model("supports: { \"|\": Fixed }"), &["fuß links"], &["shake"]);
    has(&model("supports: { | }"), &["fuß links"], &["Fixed"]);
}

#[test]
fn units_follow_a_number_and_parameters_stand_in_expressions() {
    let gap = |field: &str| model(&format!("elements: {{ \"a\": Gap({field}) }}"));
    for value in ["1 |", "1|", "1 k|", "2*1.5e3 |", "-2. |", "width*3 |"] {
        has(&gap(&format!("k: \"{value}\"")), &["kN/m", "kip/in"], &["width", "s", "kg"]);
        has(&gap(&format!("opening: \"{value}\"")), &["mm", "in"], &["width", "s", "kN/m"]);
    }
    for value in ["|", "wi|", "2*|", "2 * w|", "sqrt(|"] {
        has(&gap(&format!("k: \"{value}\"")), &["width", "mu", "sqrt"], &["kN/m", "a"]);
    }
    assert_eq!(labels(&gap("k: \"k1 |\"")).first().map(String::as_str), Some("width"));
    assert!(taken(&gap("k: \"12|\""), "kN/m").contains("k: \"12 kN/m\""));
    assert!(taken(&gap("k: \"12 k|\""), "kN/m").contains("k: \"12 kN/m\""));
    assert!(taken(&gap("k: \"12 |N/m\""), "kN/m").contains("k: \"12 kN/m\""));
    // Any unit where the file chooses it.
    has(&model("functions: { \"f\": Step(amplitude: \"1 |\") }"), &["m", "g", "kN"], &[]);
    has(&model("parameters: { \"p\": \"1 |\" }"), &["m", "g", "kN"], &[]);
    // Nothing in a comment or a title.
    assert!(labels(&model("// k|")).is_empty());
    assert!(labels(&model("title: \"1 |\",")).is_empty());
}

#[test]
fn hover_explains_kinds_fields_choices_units_and_names() {
    let told = [
        ("elements: { \"a\": Ga|p() }", "| `k` |"),
        ("elements: { \"a\": Ga|p() }", "Source:"),
        ("elements: { \"a\": Gap(ope|ning: 1) }", "**opening**: m"),
        ("cases: { \"a\": Dyn|amic() }", "Motion in time."),
        ("cases: { \"a\": Dynamic(d|t: 1) }", "Output step"),
        ("cases: { \"a\": Dynamic(solver: H|ht) }", "`FullNewton`"),
        ("elements: { \"a\": Gap(k: \"1 ki|p/in\") }", "`1 kip` = 4448"),
        ("elements: { \"a\": Gap(k: \"2*wid|th\") }", "\"width\": \"2 m\""),
        ("elements: { \"a\": Gap(node: \"fuß 🦶|\") }", "\"fuß 🦶\": (1, 0, 0)"),
        ("elements: { \"a\": Gap(node: \"n |2\") }", "\"n {i}\": For("),
        ("supports: { \"fuß |links\": Fixed }", "(0, 0, 0)"),
        ("elements: { \"a {i}\": F|or() }", "Repeats"),
        ("dam|ping: None", "**damping**"),
    ];
    for (section, part) in told {
        let found = hover(&model(section));
        assert!(found.contains(part), "{section}: {found}");
    }
    assert_eq!(hover(&model("elements: { \"a\": Nonsense|() }")), "");
    assert_eq!(hover("// (a|"), "");
}

#[test]
fn an_outline_has_the_entries_of_the_sections() {
    let text = model("elements: { \"a\": Gap(node: \"x\"), \"b\": Spring( }");
    let all = outline(&File::new("m.ron".into(), text.into()));
    let elements = all.iter().find(|o| o.name == "elements").expect("a section");
    let told: Vec<_> = elements.entries.iter().map(|o| (&*o.name, &*o.detail)).collect();
    assert_eq!(told, [("a", "Gap"), ("b", "Spring")]);
}

#[test]
fn of_a_study_nothing_is_said() {
    let study = "(model: \"../m.ron\", axes: [], title: |, nodes: 1, columns: {})";
    assert!(labels(study).is_empty() && hover(&study.replace("title: |", "ti|tle: 1")).is_empty());
    has("(title: \"\", nodse: {}, |)", &["nodes"], &[]);
}

/// The models of this project.
fn shipped() -> Vec<(PathBuf, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
    let mut all: Vec<PathBuf> = ["", "sections", "studies"]
        .iter()
        .flat_map(|f| std::fs::read_dir(folder.join(f)).expect("a folder"))
        .map(|e| e.expect("a file").path())
        .filter(|p| p.extension().is_some_and(|e| e == "ron"))
        .collect();
    all.sort();
    all.into_iter().map(|p| (p.clone(), std::fs::read_to_string(p).expect("a text"))).collect()
}

#[test]
fn every_place_of_every_model_has_an_answer() {
    let registry = trilith::registry();
    let models = shipped();
    assert!(models.len() > 15, "{}", models.len());
    let (mut explained, mut completed) = (0, 0);
    for (path, text) in models {
        let uri = crate::uri::of_path(&path).expect("a file");
        let mut documents = Documents::default();
        documents.open(uri.clone(), 1, text.clone());
        // The text as it is, and cut off there as while it is typed.
        for at in (0..text.len()).step_by(37).filter(|at| text.is_char_boundary(*at)) {
            let document = documents.get(&uri).expect("open");
            let looking = Looking::new(&registry, &documents, document, at);
            explained += usize::from(looking.hover().is_some());
            completed += usize::from(!looking.completion(true).items.is_empty());
            let _ = looking.definition();
            if at % (37 * 8) == 0 {
                let cut = Document::new(uri.clone(), 2, text[..at].into(), Encoding::Utf16);
                let looking = Looking::new(&registry, &documents, &cut, at);
                let _ = (looking.hover(), looking.completion(false), looking.definition());
            }
        }
    }
    assert!(explained > 300 && completed > 100, "{explained} {completed}");
}

#[test]
fn names_come_from_files_that_a_model_includes_and_from_models_that_include_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("a file");
        crate::uri::of_path(&folder.path().join(name)).expect("a URI")
    };
    let part = "(properties: { \"stütze\": Beam() }, elements: { \"x\": Gap(node: \"\") })";
    let part_uri = write("part.ron", part);
    let text = "(include: [\"part.ron\"], nodes: { \"oben\": (0, 0, 1) }, elements: { \"b\": Beam(use: \"\") })";
    let model_uri = write("m.ron", text);
    let registry = trilith::registry();
    let mut documents = Documents::default();
    documents.open(model_uri.clone(), 1, text.into());
    let labels = |documents: &Documents, uri: &lsp_types::Uri, behind: &str| {
        let document = documents.get(uri).expect("open");
        let at = document.file.text.find(behind).expect(behind) + behind.len();
        let all = Looking::new(&registry, documents, document, at).completion(false).items;
        all.into_iter().map(|i| i.label).collect::<Vec<_>>()
    };
    assert_eq!(labels(&documents, &model_uri, "use: \""), ["stütze"]);
    // The text in the editor counts, not that on the disk.
    documents.open(part_uri.clone(), 1, part.replace("stütze", "riegel"));
    assert_eq!(labels(&documents, &model_uri, "use: \""), ["riegel"]);
    assert_eq!(labels(&documents, &part_uri, "node: \""), ["oben"]);
    let document = documents.get(&model_uri).expect("open");
    let other = text.replace("use: \"\"", "use: \"riegel\"");
    let changed = Document::new(model_uri.clone(), 2, other.clone(), Encoding::Utf16);
    let at = other.find("riegel").expect("a name");
    let found = Looking::new(&registry, &documents, &changed, at).definition().expect("a place");
    assert_eq!((found.uri.as_str(), found.range.start.character), (part_uri.as_str(), 16));
    assert_eq!(document.version, 1);
    assert!(lsp_types::Uri::from_str(part_uri.as_str()).is_ok());
}

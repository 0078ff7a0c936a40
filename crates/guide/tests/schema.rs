//! The schema against the reader, and the reference against the schema.

mod common;

use common::{book, root};
use trilith::model::schema::{self, Block, Default};
use trilith::model::{read_text, resolved};

#[test]
fn the_reference_is_that_of_the_schema() {
    let made = [
        ("reference.md", trilith_guide::reference()),
        ("study_reference.md", trilith_guide::study_reference()),
    ];
    for (name, text) in made {
        let there = std::fs::read_to_string(root().join("crates/guide/src").join(name)).unwrap();
        assert!(there == text, "{name} is old: cargo run --release -p trilith-guide -- reference");
    }
}

/// A model in which a block stands at its place.
fn model(place: &str, block: &str) -> Option<String> {
    const HERE: &str = "nodes: (\"base\", \"m\")";
    let mut element = String::new();
    let (mut section, mut case) = (String::new(), r#"duration: "0.1 s", dt: "10 ms""#.to_owned());
    let mut push = |name: &str| case.push_str(&format!(", {name}: {block}"));
    match place {
        "model" => return Some(block.to_owned()),
        "units" | "damping" => section = format!("{place}: {block},"),
        "functions" => {
            section = format!("functions: {{ \"shake\": Constant(1), \"f\": {block} }},")
        }
        "outputs" | "parts" => {
            let of = |node| format!("Displacement(node: \"{node}\", dof: Ux)");
            let last =
                if place == "parts" { format!("Sum(terms: [{block}])") } else { block.to_owned() };
            section =
                format!("outputs: {{ \"x\": {}, \"y\": {}, \"o\": {last} }},", of("m"), of("base"));
        }
        "baseline" | "filter" | "resample" => {
            section = format!(
                "functions: {{ \"f\": Record(file: \"record.csv\", unit: \"g\", {place}: {block}) }},"
            );
        }
        "envelope" => {
            section =
                format!("functions: {{ \"f\": Synthetic(seed: 1, peak: 1, envelope: {block}) }},");
        }
        "spectra" => section = format!("spectra: {{ \"s\": {block} }},"),
        "series" => {
            section =
                format!("spectra: {{ \"s\": (node: \"m\", dof: Ux, frequencies: {block}) }},");
        }
        "terms" => section = format!("outputs: {{ \"o\": Displacement(terms: [{block}]) }},"),
        "repetition" => section = format!("outputs: {{ \"o {{i}} {{d}}\": {block} }},"),
        "elements" => {}
        "section" => element = format!("\"e\": Beam({HERE}, section: {block}, material: Steel),"),
        "material" => {
            element = format!("\"e\": Beam({HERE}, section: \"IPE 300\", material: {block}),")
        }
        "combinations" => section = format!("combinations: {{ \"all\": {block} }},"),
        "envelopes" => section = format!("envelopes: {{ \"e\": {block} }},"),
        "forces-of-a-load" => section = format!("loads: {{ \"p\": [{block}] }},"),
        "loads-of-a-case" => case.push_str(&format!(", constant: [{block}]")),
        "base" | "forces" | "initial" => case.push_str(&format!(", {place}: [{block}]")),
        "supports-of-a-case" => case.push_str(&format!(", supports: [{block}]")),
        "step" | "basis" => push(place),
        "cases" => case.clear(),
        _ => return None,
    }
    let last = if place == "cases" { block.to_owned() } else { format!("Dynamic({case})") };
    if place == "elements" {
        element = format!("\"e\": {block},");
    }
    let mut others = String::new();
    if place == "combinations" {
        let names = ["gravity", "wind", "along x", "along y", "quake 1", "quake 2", "quake 3"];
        others = names.map(|name| format!("\"{name}\": Static(loads: []),")).concat();
    }
    if !section.contains("functions") {
        section += r#"functions: {
            "shake": Constant("1 m/s^2"), "unit": Constant(1), "sway": Constant("1 mm"),
        },"#;
    }
    if place != "forces-of-a-load" {
        section += r#"loads: { "push": [(node: "m", dof: Ux, force: 1)] },"#;
    }
    Some(format!(
        r#"(
        nodes: {{ "base": (0, 0, 0), "m": (0, 0, 1), "beside": (4, 0, 0) }},
        supports: {{ "base": Fixed, "beside": Fixed }},
        elements: {{
            "spring": Spring(nodes: ("base", "m"), k1: 1, k2: 1, k3: 1, r1: 1, r2: 1, r3: 1),
            "mass": Mass(node: "m", mass: 1),
            "beam": Beam(nodes: ("base", "m"), section: "IPE 300", material: Steel),
            "link": NLink(node: "m", kn: 1, ks: 1, mu: 0.1, opening: 1),
            {element}
        }},
        {section}
        cases: {{ {others} "c": {last} }},
    )"#
    ))
}

/// Reads a block at its place and gives the model with all defaults filled in.
fn read(place: &str, block: &str) -> String {
    let Some(text) = model(place, block) else {
        panic!("tests/schema.rs knows no model around a block of `{place}`: add one");
    };
    let folder = tempfile::tempdir().unwrap();
    let samples = (0..500).map(|i| format!("{},{}\n", 0.01 * f64::from(i), f64::from(i % 7)));
    std::fs::write(folder.path().join("record.csv"), samples.collect::<String>()).unwrap();
    match read_text(&text, folder.path().join("model.ron"), &trilith::registry(), &[]) {
        Ok(model) => {
            let all = resolved(&model);
            all.lines().filter(|l| !l.starts_with("//")).collect()
        }
        Err(errors) => {
            let all: Vec<_> = errors.iter().map(ToString::to_string).collect();
            panic!("{place}: {block}\n{}", all.join("\n"))
        }
    }
}

/// A block with one more field.
fn with(block: &str, field: &str, value: &str) -> String {
    match block.strip_suffix(')') {
        Some(front) => format!("{front}, {field}: {value})"),
        None => format!("{block}({field}: {value})"),
    }
}

fn blocks() -> Vec<(String, &'static Block)> {
    let groups = schema::groups();
    let all = groups.iter().flat_map(|g| g.blocks.iter().map(|b| (g.name.replace(' ', "-"), *b)));
    let beside = [
        ("elements", &schema::PLACE),
        ("elements", &schema::ELEMENT),
        ("elements", &schema::LINK),
        ("elements", &schema::MEMBER),
    ];
    all.chain(beside.map(|(place, b)| (place.to_owned(), b))).collect()
}

/// The example of every block is read, and a default that is written out changes nothing.
#[test]
fn defaults_are_those_of_the_reader() {
    let mut seen = 0;
    for (place, block) in blocks() {
        let plain = read(&place, block.example);
        for f in block.fields {
            let given = block.example.contains(&format!("{}: ", f.name));
            if let (Default::Value(value), false) = (f.default, given) {
                let said = read(&place, &with(block.example, f.name, value));
                assert_eq!(
                    plain, said,
                    "{place} {}: `{}` is not {value} by default",
                    block.name, f.name
                );
                seen += 1;
            }
        }
    }
    assert!(seen > 30, "only {seen} defaults");
}

/// Without a field of its example a block is refused where the schema says that the field must be given, and
/// only there.
#[test]
fn fields_that_must_be_given_are_missed() {
    let mut seen = 0;
    for (place, block) in blocks() {
        if place == "model" {
            continue;
        }
        for f in block.fields {
            let text = block.example.replace(&format!("{}: ", f.name), "no_such_field: ");
            if text == block.example {
                assert!(
                    !matches!(f.default, Default::Required),
                    "{place} {}: no example of {}",
                    block.name,
                    f.name
                );
                continue;
            }
            // In place of what another field says.
            let either = matches!(f.default, Default::Absent(w) if w.starts_with(['`', 'f']));
            let needed = matches!(f.default, Default::Required);
            let text = model(&place, &text).unwrap();
            let errors = read_text(&text, "model.ron", &trilith::registry(), &[]).unwrap_err();
            let all: Vec<_> = errors.iter().map(ToString::to_string).collect();
            let all = all.join("\n");
            assert!(
                all.contains("no field `no_such_field`"),
                "{place} {} {}:\n{all}",
                block.name,
                f.name
            );
            let missed = errors.len() > 1;
            assert!(either || missed == needed, "{place} {} {}:\n{all}", block.name, f.name);
            seen += 1;
        }
    }
    assert!(seen > 20, "only {seen} fields");
}

/// The reader takes names of fields and choices from the schema and from cards, so that the reference has them all.
#[test]
fn the_reader_knows_no_names_of_its_own() {
    let files = |folder: &str| std::fs::read_dir(root().join(folder)).unwrap();
    for entry in files("crates/model/src/read").chain(files("crates/study/src/read")) {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if !name.ends_with(".rs") || ["context.rs", "declared.rs"].contains(&&*name) {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        for call in [".fields(", ".choice("] {
            for at in text.match_indices(call).map(|(i, _)| i) {
                let arguments: String = text[at..].lines().take(4).collect::<Vec<_>>().join(" ");
                let arguments = arguments.split(';').next().unwrap_or_default();
                let fine = [
                    "schema::",
                    "allowed(card",
                    "Axis::NAMES",
                    "p.name, names",
                    "item, name, names",
                    "\"support direction\", &names",
                    "\"case\", &names",
                    "\"combination\", &names",
                    "\"energy\", &ENERGIES",
                    // As the schema declares the field.
                    ".choice(c, ",
                    // Those of the schema, and behind them those of other crates.
                    "\"output\", &names",
                    "\"solver\", &names",
                ];
                assert!(
                    fine.iter().any(|f| arguments.contains(f)),
                    "{name}: {arguments}\nput these names into the schema of the crate and call `block`, `one_of` or \
                     `choice` with what is there: the reference of the guide is written from it"
                );
            }
        }
    }
}

/// Fragments in the book stand at a place of a model, and are read.
#[test]
fn every_fragment_of_the_book_is_read() {
    let mut seen = 0;
    for page in book() {
        for fence in &page.fences {
            if let Some(place) = fence.attribute("in") {
                read(place, fence.text.trim());
                seen += 1;
            }
        }
    }
    assert!(seen > 30, "only {seen} fragments");
}

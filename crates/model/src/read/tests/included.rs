use super::*;
use crate::{read, resolved};
use std::path::PathBuf;

/// A folder with files, which goes when it is done.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let path =
            std::env::temp_dir().join(format!("trilith-include-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        for (file, text) in files {
            let file = path.join("model").join(file);
            std::fs::create_dir_all(file.parent().unwrap()).unwrap();
            std::fs::write(file, text).unwrap();
        }
        Self(path)
    }

    fn read(&self) -> Result<Model, Vec<Diagnostic>> {
        read(self.0.join("model/m.ron"), &registry(), &[])
    }

    #[track_caller]
    fn model(&self) -> Model {
        self.read().unwrap_or_else(|e| panic!("{}", shown(&e)))
    }

    /// The only error: file, line and column, and what is told.
    #[track_caller]
    fn error(&self) -> (String, Diagnostic) {
        let mut all = self.read().map(|_| ()).expect_err("the model should be refused");
        assert_eq!(all.len(), 1, "{}", shown(&all));
        let d = all.remove(0);
        let path = d.source.path.strip_prefix(self.0.join("model")).unwrap_or(&d.source.path);
        (format!("{}:{}:{}", path.display(), d.line(), d.column()), d)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn with(include: &str) -> String {
    small(&format!("include: {include},")).replace(r#"stiffness: "1 kN/m""#, r#"use: "soft""#)
}

const SOFT: &str =
    r#"(parameters: { "k": "1 kN/m" }, properties: { "soft": Spring(stiffness: "k") })"#;

#[test]
fn sections_come_from_other_files() {
    let folder = Folder::new(
        "sections",
        &[
            ("m.ron", &with(r#"["lib/sections.ron", "more.ron"]"#)),
            (
                "lib/sections.ron",
                &format!(
                    "// a library\n{}",
                    SOFT.replace("(param", r#"(include: ["inner.ron"], param"#)
                ),
            ),
            // Both include it, and it is there once; its path counts from the file that names it.
            (
                "lib/inner.ron",
                r#"(nodes: { "c": (1, 0, 0) }, outputs: { "u": Displacement(node: "a", dof: Ux) })"#,
            ),
            (
                "more.ron",
                r#"(include: ["lib/../lib/inner.ron"], loads: { "p": [(node: "c", dof: Ux, force: "k*1 m")] })"#,
            ),
        ],
    );
    let m = folder.model();
    let names: Vec<&str> = m.nodes.iter().map(|n| n.name.as_str()).collect();
    assert_eq!(names, ["c", "a", "b"]);
    assert_eq!(m.patterns[0].forces[0].value, 1e3);
    let files: Vec<_> = m.included().map(|s| s.path.file_name().unwrap().to_owned()).collect();
    assert_eq!(files, ["sections.ron", "inner.ron", "more.ron"]);
    let place = m.places.find(&m.nodes[0].span);
    assert_eq!(&place.source.text[place.span], "c");
    assert!(place.source.path.ends_with("lib/inner.ron"));
    // The text that is printed needs no other file.
    assert!(read_text(&resolved(&m), "x.ron", &registry(), &[]).is_ok());
    // What tells the model from others hangs on all files.
    let before = m.sha256();
    assert_ne!(before, m.source.sha256);
    std::fs::write(folder.0.join("model/more.ron"), "()").unwrap();
    assert_ne!(folder.model().sha256(), before);
    let alone = model(&small(""));
    assert_eq!(alone.sha256(), alone.source.sha256);
}

#[test]
fn bare_numbers_are_in_the_units_of_their_file() {
    let inches = r#"units: (length: "in", force: "kip"), nodes: { "a": (10, 0, 0), "#;
    let folder = Folder::new(
        "units",
        &[
            (
                "m.ron",
                &with(r#"["soft.ron", "mm.ron"]"#)
                    .replace("nodes: {", inches)
                    .replace(r#""a": (0, 0, 0),"#, ""),
            ),
            ("soft.ron", &SOFT.replace(r#""k")"#, "5)")),
            ("mm.ron", r#"(units: (length: "mm"), nodes: { "c": (10, 0, 0) })"#),
        ],
    );
    let m = folder.model();
    assert_eq!(m.nodes[0].position[0], 0.01);
    assert_eq!(m.nodes[1].position[0], 0.254);
    assert_eq!(m.elements[0].values.number("stiffness"), Some(5.0));
}

#[test]
fn files_that_a_file_names_count_from_its_folder() {
    let folder = Folder::new(
        "tables",
        &[
            (
                "m.ron",
                &small(r#"include: ["lib/motions.ron"], parameters: { "file": Text("own.csv") }"#),
            ),
            ("own.csv", "0,0\n1,7\n"),
            (
                "lib/motions.ron",
                r#"(functions: { "f": Table(file: "t.csv"), "g": Table(file: Parameter("file")) })"#,
            ),
            ("lib/t.csv", "0,0\n1,5\n"),
        ],
    );
    let m = folder.model();
    let peaks: Vec<f64> = m.functions.iter().map(|f| f.function.peak()).collect();
    assert_eq!(peaks, [5.0, 7.0]);
}

#[test]
fn errors_stand_in_the_file_that_they_are_in() {
    let soft = |from: &str, to: &str| SOFT.replace(from, to);
    for (text, at, code, words) in [
        (soft("stiffness", "stifness"), "stifness", "E0103", "`stiffness`"),
        (soft("1 kN/m", "1 kn/m"), "kn", "E0109", "`kN`"),
        (soft(": \"k\"", ": \"kk\""), "kk", "E0110", "`k`"),
        (format!("\n{}", soft("}, prop", "}, } prop")), "}", "E0101", ""),
        (soft("properties", "property"), "property", "E0103", "did you mean `properties`?"),
        (
            "(gravity: 9, properties: {})".into(),
            "gravity",
            "E0103",
            "said once, in the model itself",
        ),
        ("(nodes: [])".into(), "[]", "E0105", "`nodes` must be a map"),
        ("[1]".into(), "[1]", "E0105", "a block `(…)`, not a list"),
        (
            soft("soft\"", "soft{i}\"").replace(
                "Spring(stiffness: \"k\")",
                "For(i: [\"\"], of: Spring(stiffness: \"j\"))",
            ),
            "j",
            "E0110",
            "`j`, with i = ",
        ),
    ] {
        let folder =
            Folder::new("errors", &[("m.ron", &with(r#"["soft.ron"]"#)), ("soft.ron", &text)]);
        let all = folder.read().map(|_| ()).expect_err("wrong");
        let told = |d: &&Diagnostic| {
            let told = format!("{} {}", d.message, d.help.as_deref().unwrap_or_default());
            let there = d.source.path.ends_with("soft.ron") && d.source.text == text;
            d.code == code && told.contains(words) && there && text[d.span.clone()].starts_with(at)
        };
        assert!(all.iter().any(|d| told(&d)), "{code} {words} at {at} not in\n{}", shown(&all));
    }
}

#[test]
fn what_is_in_two_files_is_refused_with_both() {
    let folder = Folder::new(
        "twice",
        &[
            ("m.ron", &with(r#"["soft.ron", "other.ron"]"#)),
            ("soft.ron", SOFT),
            ("other.ron", "(properties: {\n \"soft\": Spring(stiffness: 1) })"),
        ],
    );
    let (at, d) = folder.error();
    assert_eq!((at.as_str(), d.code), ("other.ron:2:3", "E0102"));
    assert!(
        d.help.as_ref().unwrap().contains("first given here: ")
            && d.help.as_ref().unwrap().contains("soft.ron:1:48")
    );
    let own = with(r#"["soft.ron"]"#).replace("nodes:", r#"parameters: { "k": 1 }, nodes:"#);
    let folder = Folder::new("twice", &[("m.ron", &own), ("soft.ron", SOFT)]);
    assert_eq!(folder.error().0, "m.ron:2:20");
}

#[test]
fn files_that_include_each_other_are_refused_with_the_chain() {
    let folder = Folder::new(
        "circle",
        &[
            ("m.ron", &with(r#"["a.ron"]"#)),
            ("a.ron", r#"(include: ["lib/b.ron"])"#),
            ("lib/b.ron", "(\n include: [\"../a.ron\"])"),
        ],
    );
    let (at, d) = folder.error();
    assert_eq!((at.as_str(), d.code), ("lib/b.ron:2:12", "E0120"));
    let chain: Vec<&str> = d.message.split(['/', ' ']).filter(|w| w.ends_with(".ron")).collect();
    assert_eq!(chain, ["a.ron", "b.ron", "a.ron"], "{}", d.message);
    let folder = Folder::new("circle", &[("m.ron", &with(r#"["m.ron"]"#))]);
    assert!(folder.error().1.message.contains("m.ron → "));
    let names: Vec<String> = (0..20).map(|i| format!("{i}.ron")).collect();
    let texts: Vec<String> = (1..21).map(|i| format!("(include: [\"{i}.ron\"])")).collect();
    let mut files: Vec<(&str, &str)> =
        names.iter().zip(&texts).map(|(n, t)| (n.as_str(), t.as_str())).collect();
    let main = with(r#"["0.ron"]"#);
    files.push(("m.ron", &main));
    assert!(Folder::new("circle", &files).error().1.message.contains("chains of at most 16"));
}

#[test]
fn nothing_outside_of_the_folder_is_included() {
    let folder = Folder::new(
        "outside",
        &[("m.ron", ""), ("lib/x.ron", "()"), ("lib/up.ron", r#"(include: ["../../secret.ron"])"#)],
    );
    let secret = folder.0.join("secret.ron");
    std::fs::write(&secret, "(secret: \"word\")").unwrap();
    let absolute = secret.display().to_string();
    let mut names = vec![
        "../secret.ron",
        "lib/../../secret.ron",
        "./../model/../secret.ron",
        &absolute,
        "lib/up.ron",
    ];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&secret, folder.0.join("model/link.ron")).unwrap();
        std::os::unix::fs::symlink(&folder.0, folder.0.join("model/lib/out")).unwrap();
        names.extend(["link.ron", "lib/out/secret.ron"]);
    }
    for name in names {
        std::fs::write(folder.0.join("model/m.ron"), with(&format!("[{name:?}]"))).unwrap();
        let (_, d) = folder.error();
        assert!(
            d.code == "E0120" && d.message.contains("out of the folder")
                || d.message.contains("outside of the folder"),
            "{name}: {d}"
        );
        assert!(
            !shown(std::slice::from_ref(&d)).contains("word") && !d.source.text.contains("word")
        );
    }
    for (name, words) in [
        ("none.ron", "cannot be read"),
        ("lib", "cannot be read: it is a folder"),
        ("", "cannot be read"),
    ] {
        std::fs::write(folder.0.join("model/m.ron"), with(&format!("[{name:?}]"))).unwrap();
        let (at, d) = folder.error();
        assert!(d.message.contains(words) && d.code == "E0120" && at == "m.ron:5:15", "{at} {d}");
    }
    std::fs::write(folder.0.join("model/m.ron"), with("[1]")).unwrap();
    assert_eq!(folder.error().1.code, "E0105");
}

#[test]
fn a_text_that_is_open_counts_instead_of_the_file() {
    let folder = Folder::new("open", &[("m.ron", &with(r#"["a.ron"]"#)), ("a.ron", "(oops")]);
    let path = folder.0.join("model/m.ron");
    let text = std::fs::read_to_string(&path).unwrap();
    let included = folder.0.join("model/a.ron").canonicalize().unwrap();
    let open = [(included, SOFT.into())].into();
    let read = |open: crate::OpenTexts| {
        crate::ModelText::with_open(&text, &path, &open)?.read(&registry(), &[])
    };
    assert!(read(crate::OpenTexts::new()).is_err());
    assert!(read(open).is_ok());
}

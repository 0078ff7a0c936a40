//! Which crate may depend on which, and which folders there are.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Crates that may name a matrix library.
const BACKENDS: [&str; 3] = ["faer", "nalgebra-sparse", "sprs"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn text(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Folders of the workspace members.
fn members() -> Vec<String> {
    let manifest = text("Cargo.toml");
    let start = manifest.find("members = [").expect("a workspace has members");
    let list = &manifest[start..start + manifest[start..].find(']').unwrap()];
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The `name` of a package.
fn name(manifest: &str) -> String {
    let line = manifest.lines().find(|l| l.trim_start().starts_with("name")).unwrap();
    line.split('"').nth(1).unwrap().to_owned()
}

/// What the sections whose header `of` accepts name.
fn dependencies(manifest: &str, of: fn(&str) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    let mut inside = false;
    for line in manifest.lines().map(str::trim) {
        if let Some(header) = line.strip_prefix('[') {
            let header = header.trim_end_matches(']');
            // `[dependencies.name]` and `[target.'cfg(…)'.dependencies]` count as well.
            if let Some((section, name)) = header.rsplit_once('.')
                && of(section)
            {
                found.push(name.to_owned());
            }
            inside = of(header);
        } else if inside && let Some((key, _)) = line.split_once('=') {
            let key = key.trim().split('.').next().unwrap_or_default();
            if !key.starts_with('#') {
                found.push(key.to_owned());
            }
        }
    }
    found
}

fn normal(header: &str) -> bool {
    header.ends_with("dependencies")
        && !header.ends_with("dev-dependencies")
        && header != "workspace.dependencies"
}

fn any(header: &str) -> bool {
    header.ends_with("dependencies") && header != "workspace.dependencies"
}

/// Package name and its manifest.
fn manifests() -> BTreeMap<String, String> {
    let all = members().into_iter().map(|m| text(Path::new(&m).join("Cargo.toml")));
    all.map(|m| (name(&m), m)).collect()
}

fn own(dependencies: Vec<String>) -> Vec<String> {
    dependencies.into_iter().filter(|d| d.starts_with("trilith")).collect()
}

#[test]
fn dependencies_point_one_way() {
    const LAYERS: &[(&str, &[&str])] = &[
        ("trilith-derive", &[]),
        ("trilith-element", &["trilith-derive"]),
        ("trilith-record", &[]),
        ("trilith-linalg", &[]),
        ("trilith-elements", &["trilith-element"]),
        ("trilith-model", &["trilith-element", "trilith-record"]),
        ("trilith-system", &["trilith-element", "trilith-linalg", "trilith-model"]),
        (
            "trilith-solvers",
            &["trilith-element", "trilith-linalg", "trilith-model", "trilith-system"],
        ),
        (
            "trilith-results",
            &[
                "trilith-element",
                "trilith-linalg",
                "trilith-record",
                "trilith-model",
                "trilith-system",
                "trilith-solvers",
            ],
        ),
        (
            "trilith-report",
            &["trilith-element", "trilith-model", "trilith-solvers", "trilith-results"],
        ),
        ("trilith-study", &["trilith"]),
        ("trilith-exchange", &["trilith-element", "trilith-model"]),
        ("trilith-foreign", &["trilith-element", "trilith-model"]),
        ("trilith-diagnostics", &["trilith-model"]),
        ("trilith-live", &["trilith", "trilith-diagnostics"]),
        ("trilith-lsp", &["trilith"]),
        ("trilith-bench", &["trilith", "trilith-linalg", "trilith-report"]),
        ("trilith-guide", &["trilith", "trilith-cli", "trilith-live", "trilith-study"]),
        ("trilith-python", &["trilith", "trilith-cli", "trilith-foreign", "trilith-study"]),
        ("trilith-thirdparty-example", &["trilith-element", "trilith", "trilith-cli"]),
    ];
    let all = manifests();
    for (package, allowed) in LAYERS.iter().copied() {
        let Some(manifest) = all.get(package) else { continue };
        for d in own(dependencies(manifest, normal)) {
            assert!(allowed.contains(&d.as_str()), "{package} must not depend on {d}");
        }
    }
}

#[test]
fn nothing_leans_on_measurements_nor_on_the_guide() {
    for (package, manifest) in manifests() {
        for d in dependencies(&manifest, any) {
            let measures =
                ["trilith-bench", "trilith-validation", "trilith-guide"].contains(&d.as_str());
            assert!(!measures, "{package} must not depend on {d}");
        }
    }
}

#[test]
fn only_linalg_names_a_matrix_backend() {
    for (package, manifest) in manifests() {
        for d in dependencies(&manifest, any) {
            let backend = BACKENDS.contains(&d.as_str());
            assert!(!backend || package == "trilith-linalg", "{package} must not name {d}");
        }
    }
}

#[test]
fn packages_are_named_after_their_folders() {
    for member in members() {
        let folder = member.rsplit('/').next().unwrap().to_owned();
        let package = name(&text(Path::new(&member).join("Cargo.toml")));
        let expected = match folder.as_str() {
            "trilith" => folder,
            "thirdparty" => "trilith-thirdparty-example".into(),
            _ => format!("trilith-{folder}"),
        };
        assert_eq!(package, expected, "{member}");
    }
}

#[test]
fn every_crate_of_the_tree_is_a_member() {
    let members = members();
    for entry in std::fs::read_dir(root().join("crates")).unwrap() {
        let path = entry.unwrap().path();
        if path.join("Cargo.toml").is_file() {
            let member = format!("crates/{}", path.file_name().unwrap().to_string_lossy());
            assert!(members.contains(&member), "{member} is no member of the workspace");
        }
    }
}

/// Names in the first column of the table of rooms in the documentation of a crate.
fn rooms(documentation: &str) -> Vec<&str> {
    let lines = documentation.lines().skip_while(|l| !l.starts_with("//! | room |"));
    let rows = lines.skip(2).take_while(|l| l.starts_with("//! |"));
    rows.filter_map(|l| l.split('`').nth(1)).collect()
}

/// Files of Rust in a folder and below.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found
}

/// Names that a source takes from the root of its crate, comments aside.
fn taken_from_root(source: &str) -> Vec<String> {
    let code = source.lines().filter(|l| !l.trim_start().starts_with("//"));
    let paths = code.flat_map(|l| l.split("crate::").skip(1));
    let letters = |c: char| c.is_ascii_alphanumeric() || c == '_';
    paths.map(|rest| rest.chars().take_while(|c| letters(*c)).collect()).collect()
}

#[test]
fn rooms_of_the_solvers_depend_one_way() {
    let source = root().join("crates/solvers/src");
    let documentation = text("crates/solvers/src/lib.rs");
    let rooms = rooms(&documentation);
    assert!(rooms.len() > 10, "{rooms:?}");
    for path in sources(&source) {
        let inside = path.strip_prefix(&source).unwrap();
        let first = inside.iter().next().unwrap().to_string_lossy();
        let own = first.trim_end_matches(".rs");
        if own == "lib" {
            continue;
        }
        let place = |name: &str| rooms.iter().position(|room| *room == name);
        let here = place(own).unwrap_or_else(|| panic!("{own} is not in the table of rooms"));
        for name in taken_from_root(&std::fs::read_to_string(&path).unwrap()) {
            // Types and functions that the crate offers are in no room.
            if name.starts_with(char::is_uppercase) {
                continue;
            }
            let there = place(&name).unwrap_or_else(|| panic!("{}: {name}?", inside.display()));
            assert!(there <= here, "{}: {own} must not use {name}", inside.display());
        }
    }
}

/// Paths of a tree drawn by indentation or with `├──`, comments after two blanks.
fn tree(lines: &[&str]) -> Vec<PathBuf> {
    let mut stack: Vec<(usize, PathBuf)> = Vec::new();
    let mut found = Vec::new();
    for line in lines {
        let drawn = |c: char| c.is_whitespace() || "│├└─".contains(c);
        let Some(at) = line.chars().position(|c| !drawn(c)) else { continue };
        let rest: String = line.chars().skip(at).collect();
        let name = rest.split("  ").next().unwrap_or_default().trim();
        if name.contains(' ') || name == "." {
            continue;
        }
        stack.retain(|(depth, _)| *depth < at);
        let path = stack.last().map_or(PathBuf::new(), |(_, p)| p.clone()).join(name);
        if name.ends_with('/') {
            stack.push((at, path.clone()));
        }
        found.push(path);
    }
    found
}

#[test]
fn a_drawn_tree_is_understood() {
    let drawn = ["crates/", "  element/   the contract", "models/  what runs", "├── x.toml  more"];
    let expected = ["crates/", "crates/element/", "models/", "models/x.toml"];
    let found = tree(&drawn[..3]);
    assert_eq!(found, expected[..3].iter().map(PathBuf::from).collect::<Vec<_>>());
    assert_eq!(tree(&drawn[3..]), [PathBuf::from("x.toml")]);
}

#[test]
fn the_tree_of_the_readme_is_there() {
    let Ok(readme) = std::fs::read_to_string(root().join("README.md")) else { return };
    let mut blocks = readme.split("```").skip(1).step_by(2);
    let Some(block) = blocks.find(|b| b.contains("crates/") && b.contains("elements/")) else {
        panic!("README.md draws no tree of the folders");
    };
    let lines: Vec<&str> = block.lines().skip(1).collect();
    for path in tree(&lines) {
        assert!(root().join(&path).exists(), "README.md shows {}", path.display());
    }
}

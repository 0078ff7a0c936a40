//! Links of the guide hold where the book is read as Markdown, and where mdBook has made a site of it.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

fn pages() -> Vec<(PathBuf, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let all = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
    all.filter(|path| path.extension().is_some_and(|e| e == "md"))
        .map(|path| (path.clone(), std::fs::read_to_string(&path).unwrap()))
        .collect()
}

/// Targets of the links and pictures of a page, without those of the network; code is no link.
fn targets(text: &str) -> Vec<String> {
    let mut all = Vec::new();
    let mut code = false;
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            code = !code;
        }
        if code {
            continue;
        }
        // Between backticks a bracket is a bracket.
        let plain: String =
            line.split('`').enumerate().map(|(i, s)| if i % 2 == 0 { s } else { "x" }).collect();
        for rest in plain.split("](").skip(1) {
            let target = rest.split(')').next().unwrap_or_default();
            if !target.contains("://") {
                all.push(target.to_owned());
            }
        }
    }
    all
}

/// The anchors that mdBook gives to the heads of a page.
fn anchors(text: &str) -> BTreeSet<String> {
    let heads = text.lines().filter(|line| line.starts_with('#'));
    heads
        .map(|line| {
            let words = line.trim_start_matches('#').trim().to_lowercase();
            let kept = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
            words.chars().filter(kept).map(|c| if c == ' ' { '-' } else { c }).collect()
        })
        .collect()
}

/// A path without the way up and down again.
fn plain(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut out, part| {
        if part == Component::ParentDir {
            out.pop();
        } else {
            out.push(part);
        }
        out
    })
}

#[test]
fn every_link_leads_somewhere_in_the_book_and_in_the_site() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut wrong = Vec::new();
    let mut count = 0;
    for (path, text) in pages() {
        for target in targets(&text) {
            count += 1;
            let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
            let to = match file {
                "" => path.clone(),
                file => plain(&path.parent().unwrap().join(file)),
            };
            let name = path.file_name().unwrap().to_string_lossy();
            let inside = to.starts_with(here.join("src"));
            if !to.exists() {
                wrong.push(format!("{name}: {target} is not there"));
            } else if !inside && file.ends_with(".md") {
                wrong.push(format!("{name}: {target}: mdBook makes .html of it; name its folder"));
            } else if !anchor.is_empty()
                && !anchors(&std::fs::read_to_string(&to).unwrap()).contains(anchor)
            {
                wrong.push(format!("{name}: {target} has no such head"));
            }
        }
    }
    assert!(count > 100, "{count} links");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Links to models and sources count their way up from the pages: the site has to be as deep.
#[test]
fn the_site_lies_as_deep_as_its_pages() {
    let book = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("book.toml"));
    let book: String = book.unwrap();
    let line = book.lines().find_map(|line| line.strip_prefix("build-dir = \"")).unwrap();
    let of = |folder: &str| plain(&Path::new("crates/guide").join(folder)).components().count();
    assert_eq!(of(line.trim_end_matches('"')), of("src"));
}

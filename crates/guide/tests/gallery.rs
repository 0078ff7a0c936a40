//! The gallery shows all that is shipped.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use trilith_guide::{exhibits, gallery};

fn of(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)
}

fn models(folder: &str) -> BTreeSet<String> {
    let entries = std::fs::read_dir(of("../../models").join(folder)).unwrap();
    let names = entries.map(|e| e.unwrap().file_name().into_string().unwrap());
    names.filter(|n| n.ends_with(".ron")).map(|n| format!("{folder}{n}")).collect()
}

#[test]
fn every_model_and_every_study_hangs_there() {
    let shown: BTreeSet<String> = exhibits().unwrap().into_iter().map(|e| e.path).collect();
    let mut all = models("");
    all.extend(models("studies/"));
    assert_eq!(shown, all);
    for exhibit in exhibits().unwrap() {
        let picture = of("src/figures/gallery").join(format!("{}.svg", exhibit.name()));
        let svg = std::fs::read_to_string(&picture)
            .unwrap_or_else(|e| panic!("{}: {e}", picture.display()));
        assert!(svg.contains("<title>") && svg.len() < 200_000, "{}", picture.display());
    }
}

#[test]
fn the_page_is_the_one_that_is_written() {
    assert_eq!(std::fs::read_to_string(of("src/gallery.md")).unwrap(), gallery().unwrap());
}

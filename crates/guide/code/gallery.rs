//! The gallery: a picture and a line for each model and study that comes with the project.

use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A model or a study.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exhibit {
    /// From the folder `models`, such as `studies/mode_chart.ron`.
    pub path: String,
    /// What it shows, in a line.
    pub shows: String,
}

impl Exhibit {
    /// The name of the file without its ending.
    #[must_use]
    pub fn name(&self) -> &str {
        let file = self.path.rsplit('/').next().unwrap_or_default();
        file.strip_suffix(".ron").unwrap_or(file)
    }

    /// Whether it is a study.
    #[must_use]
    pub fn is_study(&self) -> bool {
        self.path.starts_with("studies/")
    }

    /// The file.
    #[must_use]
    pub fn file(&self) -> PathBuf {
        models().join(&self.path)
    }
}

/// The folder of the models.
fn models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models")
}

/// What `models/README.md` lists, in its order: the first cell of a row is the file, the second what it shows.
///
/// # Errors
/// Where there is no such page.
pub fn exhibits() -> std::io::Result<Vec<Exhibit>> {
    let text = std::fs::read_to_string(models().join("README.md"))?;
    let rows = text.lines().filter_map(|line| {
        let mut cells = line.strip_prefix("| `")?.split(" | ");
        let path = cells.next()?.strip_suffix('`')?;
        let shows = cells.next()?.trim_end_matches(" |").trim();
        path.ends_with(".ron").then(|| Exhibit { path: path.into(), shows: shows.into() })
    });
    Ok(rows.collect())
}

/// The page.
///
/// # Errors
/// As [`exhibits`].
pub fn gallery() -> std::io::Result<String> {
    let mut page = String::from(
        "# Gallery\n\n\
         <!-- Written by `trilith-guide gallery` from models/README.md; the pictures by `trilith-guide figures`. -->\n\n\
         What comes with the project, each model where it has moved most (where its motion could not be seen, enlarged) and\n\
         at rest in grey. Everything on this page runs as it is: `trilith run` for a model, `trilith sweep` for a study.\n",
    );
    let exhibits = exhibits()?;
    for (title, studies) in [("Models", false), ("Studies", true)] {
        let _ = write!(page, "\n## {title}\n\n| | |\n|---|---|\n");
        for e in exhibits.iter().filter(|e| e.is_study() == studies) {
            let (name, path, shows) = (e.name(), &e.path, &e.shows);
            let words = name.replace('_', " ");
            let _ = writeln!(
                page,
                "| <img src=\"figures/gallery/{name}.svg\" width=\"420\" alt=\"{words}\"> | **[{words}](../../../models/{path})**: {shows} |"
            );
        }
    }
    Ok(page)
}

//! `include`: sections of a model that stand in other files of its folder.

use crate::diagnostic::names_help;
use crate::places::Places;
use crate::read::parse;
use crate::schema;
use crate::tree::{Entry, Kind, Node, twice};
use crate::{Diagnostic, Source, Span};
use std::collections::{HashMap, HashSet};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use trilith_record::file::canonical;

const FIELD: &str = "include";
const UNITS: &str = "units";
/// Most files that a model includes, all together.
const MOST: usize = 256;
/// Longest chain of files that include each other.
const CHAIN: usize = 16;

/// A model with the files that it includes.
#[derive(Clone, Debug)]
pub(crate) struct Whole {
    /// Where the spans of the tree lead.
    pub places: Places,
    /// The model with the sections of all files. What is included stands before what the model has itself.
    pub root: Node,
    /// What the files after the first say of units, with their number.
    pub units: Vec<(usize, Node)>,
}

/// Texts that count instead of those of files, by the one path of each file.
pub type OpenTexts = HashMap<PathBuf, Arc<str>>;

/// Reads the files that a model includes, but for those that are open.
///
/// # Errors
/// What is wrong with them.
pub(crate) fn whole(
    source: &Arc<Source>,
    root: Node,
    open: &OpenTexts,
) -> Result<Whole, Vec<Diagnostic>> {
    let places = Places::new(Arc::clone(source));
    let Node { span, kind: Kind::Fields(name, mut own) } = root else {
        return Ok(Whole { places, root, units: Vec::new() });
    };
    let Some(list) = own.iter().position(|e| e.key == FIELD) else {
        let root = Node { span, kind: Kind::Fields(name, own) };
        return Ok(Whole { places, root, units: Vec::new() });
    };
    let list = own.remove(list);
    let folder = folder_of(&source.path);
    let mut it = Including {
        // Of a model without a folder every file is refused as missing.
        canonical: canonical(&folder).unwrap_or_else(|_| folder.clone()),
        folder,
        open,
        places,
        chain: Vec::new(),
        seen: HashSet::new(),
        sections: Vec::new(),
        units: Vec::new(),
        errors: Vec::new(),
    };
    if let Ok(path) = canonical(&source.path) {
        it.chain.push((path, source.path.clone()));
    }
    it.files(&list.value, Path::new(""));
    it.merge(&mut own);
    let Including { places, units, errors, .. } = it;
    if errors.is_empty() {
        return Ok(Whole { places, root: Node { span, kind: Kind::Fields(name, own) }, units });
    }
    Err(places.told(errors))
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

struct Including<'a> {
    open: &'a OpenTexts,
    /// Folder of the model, as it was given and as the system knows it.
    folder: PathBuf,
    canonical: PathBuf,
    places: Places,
    /// The files that include each other down to here, as the system knows them and as they were given.
    chain: Vec<(PathBuf, PathBuf)>,
    /// All files that were read.
    seen: HashSet<PathBuf>,
    sections: Vec<Entry>,
    units: Vec<(usize, Node)>,
    errors: Vec<Diagnostic>,
}

impl Including<'_> {
    fn refuse(&mut self, code: &'static str, message: String, help: &str, at: &Span) {
        let d = Diagnostic::new(code, message, at.clone(), self.places.main());
        self.errors.push(d.help(help));
    }

    /// The files of a list that stands in a file of this folder, which counts from that of the model.
    fn files(&mut self, list: &Node, folder: &Path) {
        for item in list.items() {
            match &item.kind {
                Kind::Text(name) => self.file(name, &item.span, folder),
                _ => {
                    let message = format!("a file is wanted here, not {}", item.describe());
                    self.refuse(
                        "E0105",
                        message,
                        "write `include: [\"sections.ron\"]`",
                        &item.span,
                    );
                }
            }
        }
    }

    fn file(&mut self, name: &str, at: &Span, folder: &Path) {
        let Some(path) = inside(&folder.join(name)).filter(|_| Path::new(name).is_relative())
        else {
            let message = format!("`{name}` lies outside of the folder of the model");
            let help = "an included file lies in the folder of the model or below; its path counts from \
                        the file that includes it";
            return self.refuse("E0120", message, help, at);
        };
        let shown = match self.folder == Path::new(".") {
            true => path.clone(),
            false => self.folder.join(&path),
        };
        let cannot = |error: std::io::Error| format!("{} cannot be read: {error}", shown.display());
        let canonical = match canonical(&shown) {
            Ok(canonical) if canonical.starts_with(&self.canonical) => canonical,
            Ok(_) => {
                let message =
                    format!("`{name}` is a link that leads out of the folder of the model");
                return self.refuse("E0120", message, "copy the file into that folder", at);
            }
            Err(error) => {
                let help = "the path counts from the file that includes it";
                return self.refuse("E0120", cannot(error), help, at);
            }
        };
        if let Some(first) = self.chain.iter().position(|(path, _)| *path == canonical) {
            let mut chain: Vec<String> =
                self.chain[first..].iter().map(|(_, p)| p.display().to_string()).collect();
            chain.push(shown.display().to_string());
            let message = format!("files include each other: {}", chain.join(" → "));
            return self.refuse("E0120", message, "take one of these out", at);
        }
        // What two files include is there once.
        if !self.seen.insert(canonical.clone()) {
            return;
        }
        if self.seen.len() > MOST || self.chain.len() > CHAIN {
            let message = format!(
                "too many files: a model includes at most {MOST}, in chains of at most {CHAIN}"
            );
            return self.refuse("E0120", message, "put some of them together", at);
        }
        let text = match self.open.get(&canonical) {
            Some(text) => Ok(text.to_string()),
            None => trilith_record::file::read_text(&canonical),
        };
        match text {
            Ok(text) => match parse(&text, &shown) {
                Ok((source, root)) => {
                    self.chain.push((canonical, shown.clone()));
                    self.take(source, root, path.parent().unwrap_or(Path::new("")));
                    self.chain.pop();
                }
                Err(errors) => self.errors.extend(errors),
            },
            Err(error) => {
                let help = "it must be a RON file with sections of a model";
                self.refuse("E0120", cannot(error), help, at);
            }
        }
    }

    /// Takes the sections of a file, those of files that it includes before.
    fn take(&mut self, source: Arc<Source>, mut root: Node, folder: &Path) {
        let number = self.places.files().count();
        root.shift(self.places.file(source));
        let Kind::Fields(_, entries) = root.kind else {
            let message = format!("an included file is a block `(…)`, not {}", root.describe());
            let help = "write `(properties: { … })`";
            return self.refuse("E0105", message, help, &root.span);
        };
        let (lists, entries): (Vec<_>, Vec<_>) = entries.into_iter().partition(|e| e.key == FIELD);
        for list in lists {
            self.files(&list.value, folder);
        }
        for e in entries {
            if e.key == UNITS {
                self.units.push((number, e.value));
            } else if !schema::INCLUDED.contains(&e.key.as_str()) {
                let (message, help) = if schema::MODEL.blocks[0].names().contains(&&*e.key) {
                    let message = format!("`{}` does not belong into an included file", e.key);
                    (message, "it is said once, in the model itself".to_owned())
                } else {
                    let message = format!("an included file has no field `{}`", e.key);
                    (message, names_help(&e.key, "fields", schema::INCLUDED))
                };
                self.refuse("E0103", message, &help, &e.key_span);
            } else if !matches!(e.value.kind, Kind::Map(_)) {
                let message = format!("`{}` must be a map, not {}", e.key, e.value.describe());
                let help = format!("write `{}: {{ \"name\": … }}`", e.key);
                self.refuse("E0105", message, &help, &e.value.span);
            } else {
                self.sections.push(e);
            }
        }
    }

    /// Puts the sections before those of the model itself.
    fn merge(&mut self, own: &mut Vec<Entry>) {
        let mut added: Vec<Entry> = Vec::new();
        for e in std::mem::take(&mut self.sections) {
            match (
                added.iter_mut().find(|a| a.key == e.key).map(|a| &mut a.value.kind),
                e.value.kind,
            ) {
                (Some(Kind::Map(all)), Kind::Map(more)) => all.extend(more),
                (_, kind) => added.push(Entry { value: Node { kind, ..e.value }, ..e }),
            }
        }
        for mut e in added {
            match own.iter_mut().find(|o| o.key == e.key) {
                Some(Entry { value: Node { kind: Kind::Map(own), .. }, .. }) => {
                    if let Kind::Map(all) = &mut e.value.kind {
                        all.append(own);
                        self.check_twice(all);
                        std::mem::swap(all, own);
                    }
                }
                // What is no map is refused where it is read.
                Some(_) => {}
                None => {
                    if let Kind::Map(all) = &e.value.kind {
                        self.check_twice(all);
                    }
                    own.push(e);
                }
            }
        }
    }

    fn check_twice(&mut self, entries: &[Entry]) {
        for (e, before) in twice(entries) {
            let message = format!("`{}` is given twice", e.key);
            let d = Diagnostic::new("E0102", message, e.key_span.clone(), self.places.main());
            let d = d.related(before.clone(), "first given here").help("keep one of the two");
            self.errors.push(d);
        }
    }
}

/// A path without `.` and `..`; none where it leads out of where it starts.
fn inside(path: &Path) -> Option<PathBuf> {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::Normal(name) => out.push(name),
            Component::CurDir => {}
            Component::ParentDir if out.pop() => {}
            Component::ParentDir | Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(out)
}

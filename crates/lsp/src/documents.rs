//! The texts that an editor has open, and the files that make a model with them.

use crate::names::File;
use crate::position::{Encoding, Lines};
use crate::uri;
use lsp_types::{TextDocumentContentChangeEvent, Uri};
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use trilith::record::file::{canonical, read_text};

/// Most files of a model that are looked at, as many as its reader takes.
const MOST: usize = 256;

/// An open text.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    pub uri: Uri,
    pub version: i32,
    /// Its path is the one that the system knows it by, where it is a file.
    pub file: File,
    pub lines: Arc<Lines>,
}

impl Document {
    pub fn new(uri: Uri, version: i32, text: String, encoding: Encoding) -> Self {
        let path = known(&uri::path(&uri));
        let lines = Arc::new(Lines::new(&text, encoding));
        Self { uri, version, file: File::new(path, text.into()), lines }
    }
}

/// The path that the system knows a file by; of a file that is not there yet, the same path.
pub(crate) fn known(path: &Path) -> PathBuf {
    canonical(path).unwrap_or_else(|_| path.to_owned())
}

/// The open texts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Documents {
    open: BTreeMap<String, Document>,
    pub encoding: Encoding,
}

impl Documents {
    pub fn open(&mut self, uri: Uri, version: i32, text: String) {
        let key = uri.as_str().to_owned();
        self.open.insert(key, Document::new(uri, version, text, self.encoding));
    }

    pub fn close(&mut self, uri: &Uri) {
        self.open.remove(uri.as_str());
    }

    /// Makes changes in a text one after the other.
    pub fn change(
        &mut self,
        uri: &Uri,
        version: i32,
        changes: Vec<TextDocumentContentChangeEvent>,
    ) {
        let Some(document) = self.open.get_mut(uri.as_str()) else { return };
        let mut text = document.file.text.to_string();
        let mut lines = Lines::clone(&document.lines);
        for change in changes {
            match change.range {
                None => text = change.text,
                Some(range) => {
                    let start = lines.byte(&text, range.start);
                    let end = lines.byte(&text, range.end).max(start);
                    text.replace_range(start..end, &change.text);
                }
            }
            lines = Lines::new(&text, self.encoding);
        }
        let file = File::new(document.file.path.clone(), text.into());
        *document = Document { version, file, lines: Arc::new(lines), uri: document.uri.clone() };
    }

    pub fn get(&self, uri: &Uri) -> Option<&Document> {
        self.open.get(uri.as_str())
    }

    pub fn all(&self) -> impl Iterator<Item = &Document> {
        self.open.values()
    }

    /// The open text of a file.
    pub fn at(&self, path: &Path) -> Option<&Document> {
        self.all().find(|d| d.file.path == path)
    }

    /// A file and those that it includes, all of them once. What cannot be read is left out: the reader of models tells it.
    pub fn with_included(&self, first: &File) -> Vec<File> {
        let mut found = vec![first.clone()];
        let mut at = 0;
        while at < found.len() && found.len() < MOST {
            let folder = found[at].path.parent().unwrap_or(Path::new("")).to_owned();
            let names: Vec<String> = found[at].includes().into_iter().map(str::to_owned).collect();
            for name in names.iter().take(MOST).filter(|name| is_below(name)) {
                let path = known(&folder.join(name));
                if found.iter().any(|f| f.path == path) {
                    continue;
                }
                match self.at(&path) {
                    Some(open) => found.push(open.file.clone()),
                    None => {
                        let text = read_text(&path).ok();
                        found.extend(text.map(|text| File::new(path, text.into())));
                    }
                }
            }
            at += 1;
        }
        found
    }

    /// The other open texts that include a file.
    pub fn including(&self, path: &Path) -> Vec<&Document> {
        let others = self.all().filter(|d| d.file.path != path);
        let some = others.filter(|d| !d.file.includes().is_empty());
        some.filter(|d| self.with_included(&d.file).iter().any(|f| f.path == path)).collect()
    }

    /// The files whose names count in a text: itself, what it includes, and the models that include it.
    pub fn around(&self, document: &Document) -> Vec<File> {
        let mut found = self.with_included(&document.file);
        for model in self.including(&document.file.path) {
            for file in self.with_included(&model.file) {
                if !found.iter().any(|f| f.path == file.path) {
                    found.push(file);
                }
            }
        }
        found
    }
}

/// True for a path that leads nowhere but down: no other is included.
fn is_below(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    parts
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir | Component::ParentDir))
}

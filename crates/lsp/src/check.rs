//! What the reader of models says of the open texts, beside the answers: a model may take a while to be read.

use crate::documents::{Document, Documents, known};
use crate::names::is_foreign;
use crate::position::{Encoding, Lines};
use crate::uri;
use lsp_types::{
    DiagnosticRelatedInformation, DiagnosticSeverity, Location, NumberOrString,
    PublishDiagnosticsParams, Uri,
};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use trilith::model::file::{Kind, parse, resembles_model};
use trilith::model::{ModelText, OpenTexts, schema};
use trilith::{Diagnostic, Registry};

/// Errors that are shown of a model; of more, the number is told.
const MOST: usize = 200;
const SOURCE: &str = "trilith";

/// What is to be looked at: the open texts, and which of them have changed or hang on one that has.
pub(crate) struct Job {
    pub documents: Documents,
    pub which: BTreeSet<String>,
}

/// What is said of each file, by the text from which it was found: that of a model and of the files that it includes.
#[derive(Default)]
pub(crate) struct Checker {
    told: BTreeMap<String, Found>,
}

/// Errors by the file that they stand in.
type Found = BTreeMap<String, (Uri, Vec<lsp_types::Diagnostic>)>;

impl Checker {
    /// Looks at the texts of a job; what is to be shown of the files about which there is something else to say.
    pub fn check(&mut self, registry: &Registry, job: &Job) -> Vec<PublishDiagnosticsParams> {
        let documents = &job.documents;
        let mut changed: BTreeMap<String, Uri> = BTreeMap::new();
        let mut note = |found: &Found| {
            changed.extend(found.iter().map(|(key, (uri, _))| (key.clone(), uri.clone())));
        };
        let open: BTreeSet<&str> = documents.all().map(|d| d.uri.as_str()).collect();
        self.told.retain(|model, found| {
            let stays = open.contains(model.as_str());
            if !stays {
                note(found);
            }
            stays
        });
        for document in documents.all().filter(|d| job.which.contains(d.uri.as_str())) {
            let looked = || found(registry, documents, document);
            let fresh = catch_unwind(AssertUnwindSafe(looked)).unwrap_or_else(|_| {
                let message =
                    "the program has met an error of its own in this file: please report it";
                let range = document.lines.range(&document.file.text, &(0..1));
                one(&document.uri, plain(range, DiagnosticSeverity::ERROR, message.into()))
            });
            note(&fresh);
            if let Some(before) = self.told.insert(document.uri.as_str().into(), fresh) {
                note(&before);
            }
        }
        changed.into_iter().map(|(key, uri)| self.published(documents, &key, uri)).collect()
    }

    /// All that is said of a file.
    fn published(&self, documents: &Documents, key: &str, uri: Uri) -> PublishDiagnosticsParams {
        let mut diagnostics: Vec<lsp_types::Diagnostic> = Vec::new();
        for (_, more) in self.told.values().filter_map(|found| found.get(key)) {
            for d in more {
                // Two models may include the same file.
                if !diagnostics.contains(d) {
                    diagnostics.push(d.clone());
                }
            }
        }
        let version = documents.get(&uri).map(|d| d.version);
        PublishDiagnosticsParams { uri, diagnostics, version }
    }
}

fn one(uri: &Uri, diagnostic: lsp_types::Diagnostic) -> Found {
    [(uri.as_str().to_owned(), (uri.clone(), vec![diagnostic]))].into()
}

/// What there is to say of a text and of the files that it includes. The text itself is always among them.
fn found(registry: &Registry, documents: &Documents, document: &Document) -> Found {
    let text = &*document.file.text;
    let mut found = Found::new();
    found.insert(document.uri.as_str().to_owned(), (document.uri.clone(), Vec::new()));
    if !documents.including(&document.file.path).is_empty() {
        // It is looked at with the model that includes it.
        return found;
    }
    let errors = match role(text, document) {
        Err(errors) => errors,
        Ok(Role::Model) => {
            let open: OpenTexts =
                documents.all().map(|d| (d.file.path.clone(), Arc::clone(&d.file.text))).collect();
            let model = ModelText::with_open(text, &document.file.path, &open);
            model.and_then(|model| model.read(registry, &[]).map(|_| ())).err().unwrap_or_default()
        }
        Ok(Role::Part) => {
            let message = "a file without `cases` is looked at as one that a model includes: its errors are shown \
                           when that model is open";
            let range = document.lines.range(text, &(0..1));
            return one(
                &document.uri,
                plain(range, DiagnosticSeverity::INFORMATION, message.into()),
            );
        }
        Ok(Role::Other) => return found,
    };
    let mut places = Shown { documents, files: HashMap::new() };
    let count = errors.len();
    for d in errors.into_iter().take(MOST) {
        let (uri, diagnostic) = places.diagnostic(document, &d);
        let key = uri.as_str().to_owned();
        found.entry(key).or_insert_with(|| (uri, Vec::new())).1.push(diagnostic);
    }
    if let (Some(more), Some((_, own))) =
        (count.checked_sub(MOST).filter(|more| *more > 0), found.get_mut(document.uri.as_str()))
    {
        let range = document.lines.range(text, &(0..1));
        own.push(plain(range, DiagnosticSeverity::ERROR, format!("… and {more} errors more")));
    }
    found
}

/// What a text is.
enum Role {
    Model,
    /// Sections that a model includes.
    Part,
    /// A study, or RON of somebody else.
    Other,
}

/// What a text is, as far as it can be told.
fn role(text: &str, document: &Document) -> Result<Role, Vec<Diagnostic>> {
    let (_, root) = parse(text, &document.file.path)?;
    let Kind::Fields(None, entries) = &root.kind else {
        return Ok(if resembles_model(text) { Role::Model } else { Role::Other });
    };
    let has = |name: &str| entries.iter().any(|e| e.key == name);
    let sections = |key: &str| schema::INCLUDED.contains(&key) || key == "units";
    if !entries.is_empty() && entries.iter().all(|e| sections(&e.key)) && !has("cases") {
        return Ok(Role::Part);
    }
    let foreign = is_foreign(entries.iter().map(|e| e.key.as_str()));
    Ok(if resembles_model(text) && !foreign { Role::Model } else { Role::Other })
}

fn plain(
    range: lsp_types::Range,
    severity: DiagnosticSeverity,
    message: String,
) -> lsp_types::Diagnostic {
    let (severity, source) = (Some(severity), Some(SOURCE.into()));
    lsp_types::Diagnostic { range, severity, source, message, ..Default::default() }
}

/// Where errors are shown.
struct Shown<'d> {
    documents: &'d Documents,
    /// URIs and lines of the files that errors stand in.
    files: HashMap<PathBuf, (Uri, Arc<Lines>)>,
}

impl Shown<'_> {
    /// The URI of the file of an error, and its lines.
    fn file(&mut self, main: &Document, d: &Diagnostic) -> (Uri, Arc<Lines>) {
        let encoding: Encoding = self.documents.encoding;
        let documents = self.documents;
        let make = || {
            let path = known(&d.source.path);
            let open = if path == main.file.path { Some(main) } else { documents.at(&path) };
            match open {
                Some(open) => (open.uri.clone(), Arc::clone(&open.lines)),
                None => {
                    let uri = uri::of_path(&path).unwrap_or_else(|| main.uri.clone());
                    (uri, Arc::new(Lines::new(&d.source.text, encoding)))
                }
            }
        };
        self.files.entry(d.source.path.clone()).or_insert_with(make).clone()
    }

    fn diagnostic(&mut self, main: &Document, d: &Diagnostic) -> (Uri, lsp_types::Diagnostic) {
        let (uri, lines) = self.file(main, d);
        let text = &d.source.text;
        let related = d.related.iter().map(|(span, message)| DiagnosticRelatedInformation {
            location: Location::new(uri.clone(), lines.range(text, span)),
            message: message.clone(),
        });
        let related: Vec<_> = related.collect();
        let mut message = d.message.clone();
        if let Some(help) = &d.help {
            message += &format!("\nhelp: {help}");
        }
        let diagnostic = lsp_types::Diagnostic {
            range: lines.range(text, &first_line(text, &d.span)),
            severity: Some(DiagnosticSeverity::ERROR),
            code: Some(NumberOrString::String(d.code.into())),
            source: Some(SOURCE.into()),
            message,
            related_information: (!related.is_empty()).then_some(related),
            ..Default::default()
        };
        (uri, diagnostic)
    }
}

/// A span as far as its first line: that a block lacks a field is no reason to underline all of it.
fn first_line(text: &str, span: &std::ops::Range<usize>) -> std::ops::Range<usize> {
    let shown = text.get(span.clone()).unwrap_or_default();
    let length = shown.find(['\n', '\r']).unwrap_or(span.len());
    span.start..span.start + length
}

//! Answers about a place of a text, as the protocol writes them.

use crate::complete::{Asking, Candidate, complete};
use crate::documents::{Document, Documents};
use crate::explain::{Outlined, outline};
use crate::names::File;
use crate::place::{Place, place};
use crate::position::Lines;
use crate::uri;
use lsp_types::{
    CompletionItem, CompletionItemKind, CompletionList, CompletionTextEdit, DocumentSymbol,
    Documentation, Hover, HoverContents, InsertTextFormat, Location, MarkupContent, MarkupKind,
    SymbolKind, TextEdit,
};
use trilith::Registry;

/// A place of a text that somebody asks about.
pub(crate) struct Looking<'s> {
    registry: &'s Registry,
    documents: &'s Documents,
    document: &'s Document,
    files: Vec<File>,
    place: Place,
    at: usize,
}

impl<'s> Looking<'s> {
    pub fn new(
        registry: &'s Registry,
        documents: &'s Documents,
        document: &'s Document,
        at: usize,
    ) -> Self {
        let files = documents.around(document);
        let place = place(registry, &document.file, at);
        Self { registry, documents, document, files, place, at }
    }

    fn asking(&self) -> Asking<'_> {
        Asking { registry: self.registry, files: &self.files, place: &self.place, at: self.at }
    }

    fn range(&self, span: &std::ops::Range<usize>) -> lsp_types::Range {
        self.document.lines.range(&self.document.file.text, span)
    }

    pub fn completion(&self, snippets: bool) -> CompletionList {
        let (all, whole) = complete(&self.asking());
        let item = |(i, c): (usize, Candidate)| {
            // The brackets of a kind with the cursor between them.
            let snippet =
                snippets && c.kind != CompletionItemKind::REFERENCE && c.text.ends_with('(');
            let new_text = if snippet { format!("{}$0)", c.text) } else { c.text };
            let range = self.range(&c.span);
            CompletionItem {
                label: c.label,
                kind: Some(c.kind),
                detail: (!c.detail.is_empty()).then_some(c.detail),
                documentation: (!c.meaning.is_empty())
                    .then(|| Documentation::MarkupContent(markdown(c.meaning))),
                sort_text: Some(format!("{i:04}")),
                insert_text_format: snippet.then_some(InsertTextFormat::SNIPPET),
                text_edit: Some(CompletionTextEdit::Edit(TextEdit { range, new_text })),
                ..Default::default()
            }
        };
        let items = all.into_iter().enumerate().map(item).collect();
        CompletionList { is_incomplete: !whole, items }
    }

    pub fn hover(&self) -> Option<Hover> {
        let found = self.asking().explain()?;
        let contents = markdown(found.markdown);
        Some(Hover {
            contents: HoverContents::Markup(contents),
            range: Some(self.range(&found.span)),
        })
    }

    pub fn definition(&self) -> Option<Location> {
        let asking = self.asking();
        let (d, _) = asking.definition()?;
        match self.documents.at(&d.file.path) {
            Some(open) => {
                Some(Location::new(open.uri.clone(), open.lines.range(&open.file.text, &d.key)))
            }
            None => {
                let lines = Lines::new(&d.file.text, self.documents.encoding);
                Some(Location::new(uri::of_path(&d.file.path)?, lines.range(&d.file.text, &d.key)))
            }
        }
    }
}

fn markdown(value: String) -> MarkupContent {
    MarkupContent { kind: MarkupKind::Markdown, value }
}

/// The outline of a text.
pub(crate) fn symbols(document: &Document) -> Vec<DocumentSymbol> {
    outline(&document.file)
        .into_iter()
        .map(|o| symbol(document, o, SymbolKind::NAMESPACE))
        .collect()
}

fn symbol(document: &Document, of: Outlined, kind: SymbolKind) -> DocumentSymbol {
    let range = |span| document.lines.range(&document.file.text, span);
    let children: Vec<_> =
        of.entries.into_iter().map(|o| symbol(document, o, SymbolKind::OBJECT)).collect();
    #[allow(deprecated)] // a field of the type that nobody fills any more
    DocumentSymbol {
        name: of.name,
        detail: (!of.detail.is_empty()).then_some(of.detail),
        kind,
        tags: None,
        deprecated: None,
        range: range(&of.span),
        selection_range: range(&of.key),
        children: (!children.is_empty()).then_some(children),
    }
}

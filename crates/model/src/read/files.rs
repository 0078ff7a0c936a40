//! Texts and files that parameters of a kind take.

use super::context::{Context, PARAMETER};
use super::tables::file_name;
use crate::matrices;
use crate::tree::{Kind, Node};
use std::path::Path;
use std::sync::Arc;
use trilith_element::{FileText, SparseMatrix};

/// What stands for a file that goes with the text of a model: its name and what it holds.
pub(crate) const CONTENTS: &str = "Contents";

/// `"a text"`, or `Parameter("name")` of a text parameter.
pub(super) fn text(c: &Context<'_>, node: &Node, name: &str) -> Option<String> {
    match &node.kind {
        Kind::Text(text) => Some(text.clone()),
        Kind::List(Some(kind), _) if kind == PARAMETER => file_name(c, node),
        _ => c.wrong(node, &format!("a text in quotes or `Parameter(\"name\")` for `{name}`")),
    }
}

/// `"file.csv"`, `Parameter("name")` of a text parameter, or `Contents("file.csv", "what it holds")`.
pub(super) fn file(c: &Context<'_>, node: &Node) -> Option<Arc<FileText>> {
    if let Some(inline) = contents(c, node) {
        return inline.map(Arc::new);
    }
    let name = file_name(c, node)?;
    let path = c.file(&name, node);
    let read = || match trilith_record::file::read_text(&path) {
        Ok(text) => Ok(FileText { name: name.clone(), text }),
        Err(error) => unreadable(c, node, &path, &error),
    };
    c.motions.texts.get(format!("{path:?} {name}"), read).ok()
}

/// A sparse matrix: `"file.mtx"` or another form, `"file.pch:KAAX"` for one of several, `Parameter("name")` of a text
/// parameter, or `Contents("file.mtx", "…")`.
pub(super) fn matrix(c: &Context<'_>, node: &Node) -> Option<Arc<SparseMatrix>> {
    let made = |bytes: &[u8], name: &str, path: &str| {
        matrices::read(bytes, name, path).map_err(|error| {
            c.report(c.diagnostic("E0117", error.to_string(), node.span.clone()));
        })
    };
    if let Some(inline) = contents(c, node) {
        let FileText { name, text } = inline?;
        return made(text.as_bytes(), &name, "").ok().map(Arc::new);
    }
    let name = file_name(c, node)?;
    let path = c.file(matrices::parted(&name).0, node);
    let read = || match trilith_record::file::read(&path) {
        Ok(bytes) => made(&bytes, &name, &path.to_string_lossy()),
        Err(error) => unreadable(c, node, &path, &error),
    };
    c.motions.matrices.get(format!("{path:?} {name}"), read).ok()
}

/// `Contents("file.csv", "what it holds")`; `None` for anything else.
fn contents(c: &Context<'_>, node: &Node) -> Option<Option<FileText>> {
    let Kind::List(Some(kind), items) = &node.kind else { return None };
    if kind != CONTENTS {
        return None;
    }
    let [name, text] = &items[..] else {
        return Some(c.wrong(node, "a name and what the file holds, `Contents(\"name\", \"…\")`,"));
    };
    let (name, text) = (c.text(name, CONTENTS), c.text(text, CONTENTS));
    Some(name.zip(text).map(|(name, text)| FileText { name, text }))
}

fn unreadable<T>(
    c: &Context<'_>,
    node: &Node,
    path: &Path,
    error: &std::io::Error,
) -> Result<T, ()> {
    let message = format!("{} cannot be read: {error}", path.display());
    let help = "the path counts from the folder of the file in which it stands";
    c.report(c.diagnostic("E0117", message, node.span.clone()).help(help));
    Err(())
}

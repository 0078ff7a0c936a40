//! Texts and files that parameters of a kind take.

use super::context::{Context, PARAMETER};
use super::tables::file_name;
use crate::tree::{Kind, Node};
use std::sync::Arc;
use trilith_element::FileText;

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
    if let Kind::List(Some(kind), items) = &node.kind
        && kind == CONTENTS
    {
        let [name, text] = &items[..] else {
            return c.wrong(node, "a name and what the file holds, `Contents(\"name\", \"…\")`,");
        };
        let (name, text) = (c.text(name, CONTENTS), c.text(text, CONTENTS));
        return Some(Arc::new(FileText { name: name?, text: text? }));
    }
    let name = file_name(c, node)?;
    let path = c.file(&name, node);
    let read = || match trilith_record::file::read_text(&path) {
        Ok(text) => Ok(FileText { name: name.clone(), text }),
        Err(error) => {
            let message = format!("{} cannot be read: {error}", path.display());
            let help = "the path counts from the folder of the file in which it stands";
            c.report(c.diagnostic("E0117", message, node.span.clone()).help(help));
            Err(())
        }
    };
    c.motions.texts.get(format!("{path:?} {name}"), read).ok()
}

//! The names that the files of a model give, and where.

use crate::scan::{Span, Tree, Value};
use crate::wanted::GROUPS;
use std::path::PathBuf;
use std::sync::Arc;
use trilith::model::schema;

/// A file as it is looked at: its text and its blocks.
#[derive(Clone, Debug)]
pub(crate) struct File {
    pub path: PathBuf,
    pub text: Arc<str>,
    pub tree: Arc<Tree>,
}

impl File {
    pub fn new(path: PathBuf, text: Arc<str>) -> Self {
        let tree = Arc::new(Tree::new(&text));
        Self { path, text, tree }
    }

    /// The names of a section, in order, without quotes.
    pub fn names(&self, section: &str) -> impl Iterator<Item = Definition<'_>> {
        let model = self.tree.model();
        let block = model.and_then(|m| self.tree.field(m, &self.text, section));
        block.into_iter().flat_map(|b| &b.entries).filter_map(|e| {
            let key = e.key.as_ref().filter(|k| k.quoted)?;
            let name = self.text.get(key.span.clone())?;
            Some(Definition { file: self, name, key: key.span.clone(), entry: e.span.clone() })
        })
    }

    /// True for RON that is no model.
    pub fn is_foreign(&self) -> bool {
        let model = self.tree.model();
        let entries = model.into_iter().flat_map(|m| &m.entries);
        is_foreign(entries.filter(|e| e.key.is_some()).filter_map(|e| e.key_text(&self.text)))
    }

    /// The files that it includes, as it names them.
    pub fn includes(&self) -> Vec<&str> {
        let model = self.tree.model();
        let block = model.and_then(|m| self.tree.field(m, &self.text, "include"));
        let entries = block.into_iter().flat_map(|b| &b.entries);
        let texts = entries.filter_map(|e| match &e.value {
            Some(Value::Text(span, true)) => self.text.get(span.clone()),
            _ => None,
        });
        texts.collect()
    }
}

/// True for the fields of a block that is no model: a study, RON of somebody else. A model may have wrong fields as well, but
/// hardly more than right ones.
pub(crate) fn is_foreign<'k>(keys: impl Iterator<Item = &'k str>) -> bool {
    let known = schema::MODEL.blocks[0].names();
    let (right, wrong): (Vec<&str>, Vec<&str>) = keys.partition(|key| known.contains(key));
    wrong.len() > right.len()
}

/// Where a name is given.
#[derive(Clone, Debug)]
pub(crate) struct Definition<'f> {
    pub file: &'f File,
    pub name: &'f str,
    pub key: Span,
    pub entry: Span,
}

/// Characters of a definition that is shown in one line.
const LINE: usize = 160;

impl Definition<'_> {
    /// The entry in one line.
    pub fn line(&self) -> String {
        let text = self.file.text.get(self.key.start..self.entry.end).unwrap_or_default();
        // The first part alone is looked at: an entry may be a map of thousands.
        let few: String = text.chars().take(4 * LINE).collect();
        let line = format!("\"{}", few.split_whitespace().collect::<Vec<_>>().join(" "));
        match line.char_indices().nth(LINE) {
            Some((end, _)) => format!("{} …", &line[..end]),
            None => line,
        }
    }
}

/// Sections whose names a value may have that names an entry of this one.
pub(crate) fn sections(section: &'static str) -> Vec<&'static str> {
    match section {
        "nodes" | "elements" => vec![section, GROUPS],
        // They take cases and each other.
        "combinations" => vec!["cases", section],
        _ => vec![section],
    }
}

/// Where a name of a section is given: by itself, or else by a repetition whose braces may stand for a part of it.
pub(crate) fn find<'f>(
    files: &'f [File],
    section: &'static str,
    name: &str,
) -> Option<Definition<'f>> {
    let all = || {
        let sections = sections(section);
        sections.into_iter().flat_map(|s| files.iter().flat_map(move |f| f.names(s)))
    };
    all().find(|d| d.name == name).or_else(|| all().find(|d| stands_for(d.name, name)))
}

/// True where a name with braces may stand for another one, which may have braces of its own.
fn stands_for(template: &str, name: &str) -> bool {
    let (fixed, open) = pieces(template);
    if !open {
        return false;
    }
    // Whatever braces of the name hold, it is one value.
    let (of_name, _) = pieces(name);
    let name = of_name.join("0");
    let Some(mut rest) = name.strip_prefix(&*fixed[0]) else { return false };
    let last = fixed.len() - 1;
    for piece in &fixed[1..last] {
        // A value has at least one character.
        let Some(at) = rest.char_indices().skip(1).find(|(i, _)| rest[*i..].starts_with(&**piece))
        else {
            return false;
        };
        rest = &rest[at.0 + piece.len()..];
    }
    rest.strip_suffix(&*fixed[last]).is_some_and(|value| !value.is_empty())
}

/// What stands around the braces of a name, and whether there are any.
fn pieces(name: &str) -> (Vec<String>, bool) {
    let mut found = vec![String::new()];
    let mut rest = name;
    while let Some(c) = rest.chars().next() {
        let last = found.len() - 1;
        if rest.starts_with("{{") || rest.starts_with("}}") {
            found[last].push(c);
            rest = &rest[2..];
        } else if let Some(end) = rest.find('}').filter(|_| c == '{') {
            found.push(String::new());
            rest = &rest[end + 1..];
        } else {
            found[last].push(c);
            rest = &rest[c.len_utf8()..];
        }
    }
    let open = found.len() > 1;
    (found, open)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_braces_stand_for_those_that_they_make() {
        for (template, name, yes) in [
            ("{i} {j} {k}", "1 0 6", true),
            ("{i} {j} {k}", "{i-1} {j} {k}", true),
            ("{i} {j} {k}", "1 0", false),
            ("centre {k}", "centre 12", true),
            ("centre {k}", "centre ", false),
            ("beam x {i}", "beam y 1", false),
            ("a{{b}}", "a{b}", false),
            ("fuß {n} 🦶", "fuß 3 🦶", true),
            ("plain", "plain", false),
        ] {
            assert_eq!(stands_for(template, name), yes, "{template} for {name}");
        }
    }

    #[test]
    fn a_definition_is_told_in_one_line() {
        let long = "x, ".repeat(200);
        let text = format!("(nodes: {{ \"größe\": (0,\n   0, 1) }}, loads: {{ \"a\": [{long}] }})");
        let file = File::new("m.ron".into(), text.as_str().into());
        let files = [file];
        let line = |section, name| find(&files, section, name).map(|d| d.line());
        assert_eq!(line("nodes", "größe").as_deref(), Some("\"größe\": (0, 0, 1)"));
        assert!(line("loads", "a").is_some_and(|l| l.ends_with('…') && l.chars().count() < 170));
        assert_eq!(line("nodes", "a"), None);
    }
}

//! What is under the cursor: its meaning, and where its name is given.

use crate::complete::{Asking, alone};
use crate::fields::{Field, of_block};
use crate::names::{Definition, File, find};
use crate::place::{Inside, Named, Part, named};
use crate::scan::Span;
use crate::wanted::Wanted;
use trilith::catalogue;
use trilith::element::Card;
use trilith::model::schema::{self, Block};

/// An explanation in Markdown, and the bytes that it is of.
pub(crate) struct Explained {
    pub markdown: String,
    pub span: Span,
}

impl<'a> Asking<'a> {
    /// What is under the cursor means.
    pub fn explain(&self) -> Option<Explained> {
        let file = &self.files[0];
        let told = |markdown: String, span: &Span| Explained { markdown, span: span.clone() };
        let word = |span: &(usize, usize)| file.text.get(span.0..span.1);
        match (&self.place.part, &self.place.inside) {
            (Part::Key { span, quoted: false }, Inside::Fields(all)) => {
                let f = all.iter().find(|f| Some(f.name) == word(span))?;
                Some(told(field(f), &(span.0..span.1)))
            }
            (Part::Word { span, .. }, _) => {
                let name = word(span)?;
                let wanted = self.wanted();
                let markdown = match named(self.registry, &wanted, name) {
                    Some(Named::Block(b)) => block(b),
                    Some(Named::Card(c)) => card(c),
                    None => self.choice(&wanted, name)?,
                };
                Some(told(markdown, &(span.0..span.1)))
            }
            _ => match self.definition() {
                Some((d, span)) => {
                    let from = match std::ptr::eq(d.file, file) {
                        true => String::new(),
                        false => format!("\n\nin `{}`", d.file.path.display()),
                    };
                    Some(told(format!("{}{from}", ron(&d.line())), &span))
                }
                None => self.unit(),
            },
        }
    }

    /// Where the name under the cursor is given, and the bytes of that name.
    pub fn definition(&self) -> Option<(Definition<'a>, Span)> {
        let text = &self.files[0].text;
        let (section, span) = match (&self.place.part, &self.place.inside) {
            (Part::Key { span, quoted: true }, Inside::Map(Some(section), _)) => {
                (*section, span.0..span.1)
            }
            (Part::Text { span, .. }, _) => match self.wanted().single() {
                Wanted::Name(section) => (section, span.0..span.1),
                Wanted::Members => {
                    let span = span.0..span.1;
                    let name = text.get(span.clone())?;
                    let found =
                        ["nodes", "elements"].iter().find_map(|s| find(self.files, s, name));
                    return found.map(|d| (d, span));
                }
                // Loads of a case and parts of an output may be a name alone.
                Wanted::Block(group) => (alone(group)?, span.0..span.1),
                Wanted::Number(_) | Wanted::Choice(_) | Wanted::Flag => {
                    ("parameters", self.identifier(&(span.0..span.1))?)
                }
                _ => return None,
            },
            _ => return None,
        };
        let d = find(self.files, section, text.get(span.clone())?)?;
        Some((d, span))
    }

    /// The name under the cursor in an expression.
    fn identifier(&self, content: &Span) -> Option<Span> {
        let text = &self.files[0].text;
        let part = |c: char| c.is_alphanumeric() || "_µ%".contains(c);
        let before = text.get(content.start..self.at)?;
        let start = before.rfind(|c| !part(c)).map_or(content.start, |i| {
            content.start + i + before[i..].chars().next().map_or(0, char::len_utf8)
        });
        let behind = text.get(self.at..content.end)?;
        let end = behind.find(|c| !part(c)).map_or(content.end, |i| self.at + i);
        (start < end).then_some(start..end)
    }

    /// A unit under the cursor.
    fn unit(&self) -> Option<Explained> {
        let (Part::Text { span, .. }, Wanted::Number(_)) = (&self.place.part, self.wanted()) else {
            return None;
        };
        let mut span = self.identifier(&(span.0..span.1))?;
        let text = &self.files[0].text;
        // `12kN` is a number and its unit.
        span.start += text[span.clone()].find(|c: char| !c.is_ascii_digit())?;
        let name = &text[span.clone()];
        let (_, factor, si) = schema::units().into_iter().find(|(unit, ..)| *unit == name)?;
        let si = if si == "1" { String::new() } else { format!(" {si}") };
        Some(Explained { markdown: format!("`1 {name}` = {factor}{si}"), span })
    }

    /// A choice: what is chosen.
    fn choice(&self, wanted: &Wanted, name: &str) -> Option<String> {
        let Wanted::Choice(all) = wanted else { return None };
        let known = all.contains(&name);
        let entry = self.entry()?;
        let key = entry.key_text(&self.files[0].text)?;
        match &self.place.inside {
            Inside::Fields(fields) if known => fields.iter().find(|f| f.name == key).map(field),
            _ => None,
        }
    }
}

/// A piece of a model file in Markdown.
pub(crate) fn ron(text: &str) -> String {
    // A fence longer than any in the text.
    let fence = "`".repeat(3.max(1 + text.split(|c| c != '`').map(str::len).max().unwrap_or(0)));
    format!("{fence}ron\n{text}\n{fence}")
}

fn field(f: &Field) -> String {
    let default = match &f.default {
        None => "must be given".to_owned(),
        Some(default) => format!("without it: {default}"),
    };
    format!("**{}**: {}\n\n{}\n\n{default}", f.name, f.takes, f.meaning)
}

fn table(fields: &[Field]) -> String {
    if fields.is_empty() {
        return String::new();
    }
    let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
    let mut out = String::from("\n\n| field | takes | default | meaning |\n|---|---|---|---|\n");
    for f in fields {
        let default = f.default.as_deref().unwrap_or("**must be given**");
        let [takes, default, meaning] = [&f.takes, default, f.meaning].map(cell);
        out += &format!("| `{}` | {takes} | {default} | {meaning} |\n", f.name);
    }
    out
}

fn block(b: &Block) -> String {
    format!("**{}**\n\n{}\n\n{}{}", b.name, b.meaning, ron(b.example), table(&of_block(b)))
}

fn card(c: &'static Card) -> String {
    let mut out = format!(
        "**{}** ({}, {})\n\n{}\n\n{}",
        c.kind,
        catalogue::category(c.category),
        catalogue::nodes(c.nodes),
        c.summary,
        ron(c.example)
    );
    out += &table(&crate::fields::of_card(c, true));
    if !c.law.is_empty() {
        out += &format!("\n```text\n{}\n```\n", c.law);
    }
    if !c.source.is_empty() {
        out += &format!("\nSource: {}\n", c.source);
    }
    out
}

/// A section and its entries, for an outline: names, what they are, and their bytes.
pub(crate) struct Outlined {
    pub name: String,
    pub detail: String,
    pub span: Span,
    pub key: Span,
    pub entries: Vec<Outlined>,
}

/// The outline of a file.
pub(crate) fn outline(file: &File) -> Vec<Outlined> {
    let text = &file.text;
    let model = file.tree.model();
    let sections = model.into_iter().flat_map(|m| &m.entries).filter_map(|e| {
        let key = e.key.as_ref()?;
        let name = text.get(key.span.clone())?;
        let entries = file.names(name).map(|d| Outlined {
            // An outline shows no entry without a name.
            name: if d.name.is_empty() { "\"\"".into() } else { d.name.into() },
            detail: kind(text, d.key.end..d.entry.end),
            span: d.key.start..d.entry.end,
            key: d.key,
            entries: Vec::new(),
        });
        Some(Outlined {
            name: name.into(),
            detail: String::new(),
            span: e.span.clone(),
            key: key.span.clone(),
            entries: entries.collect(),
        })
    });
    sections.filter(|s| !s.name.is_empty()).collect()
}

/// The name of the kind behind the colon of an entry.
fn kind(text: &str, behind: Span) -> String {
    let rest = text.get(behind).unwrap_or_default().trim_start_matches(['"', ':', ' ']);
    let name: String = rest.chars().take_while(|c| c.is_alphanumeric()).collect();
    if name.starts_with(char::is_uppercase) { name } else { String::new() }
}

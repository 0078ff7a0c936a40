//! What may stand at the cursor.

use crate::explain::ron;
use crate::fields::{Field, offered};
use crate::names::{File, sections};
use crate::place::{Inside, Part, Place};
use crate::scan::{Block, Entry, Span};
use crate::wanted::Wanted;
use lsp_types::CompletionItemKind as Kind;
use std::collections::HashSet;
use trilith::Registry;
use trilith::model::schema;

/// Most candidates of one answer: an editor asks again as more is typed.
pub(crate) const MOST: usize = 1000;

/// One candidate.
#[derive(Clone, Debug)]
pub(crate) struct Candidate {
    pub label: String,
    pub kind: Kind,
    pub detail: String,
    /// In Markdown.
    pub meaning: String,
    /// What takes the place of `span`.
    pub text: String,
    pub span: Span,
}

/// Where something is completed.
pub(crate) struct Asking<'a> {
    pub registry: &'a Registry,
    /// The files of the model; the one with the cursor first.
    pub files: &'a [File],
    pub place: &'a Place,
    pub at: usize,
}

/// The section of the names that may stand for a whole block of a group.
pub(crate) fn alone(group: &'static schema::Group) -> Option<&'static str> {
    let b = group.blocks.iter().find(|b| b.name.is_empty())?;
    let needed = |f: &&schema::Field| matches!(f.default, schema::Default::Required);
    match b.fields.iter().filter(needed).map(Wanted::field).collect::<Vec<_>>()[..] {
        [Wanted::Name(section)] => Some(section),
        _ => None,
    }
}

/// The candidates in the order in which they should be shown, and whether these are all.
pub(crate) fn complete(asking: &Asking<'_>) -> (Vec<Candidate>, bool) {
    let mut all = asking.candidates();
    let complete = all.len() <= MOST;
    all.truncate(MOST);
    (all, complete)
}

impl Asking<'_> {
    fn file(&self) -> &File {
        &self.files[0]
    }

    fn block(&self) -> &Block {
        &self.file().tree.blocks[self.place.block]
    }

    /// The entry that the cursor is in.
    pub fn entry(&self) -> Option<&Entry> {
        self.place.entry.map(|i| &self.block().entries[i])
    }

    /// What the value at the cursor may be.
    pub fn wanted(&self) -> Wanted {
        self.place.inside.value(self.entry(), &self.file().text)
    }

    fn candidates(&self) -> Vec<Candidate> {
        let here = self.at..self.at;
        let inside = &self.place.inside;
        match (&self.place.part, inside) {
            (Part::Comment | Part::Other, _) => Vec::new(),
            (Part::Key { span, quoted: false }, Inside::Fields(all)) => {
                self.fields(all, span.0..span.1)
            }
            (Part::Word { span, keyed: false }, Inside::Fields(all)) => {
                self.fields(all, span.0..span.1)
            }
            (Part::Fresh, Inside::Fields(all)) => self.fields(all, here),
            (Part::Key { span, quoted: true }, Inside::Map(Some(section), _))
            | (Part::Text { span, keyed: false }, Inside::Map(Some(section), _)) => {
                self.names(section, &(span.0..span.1), false)
            }
            (Part::Fresh, Inside::Map(Some(section), _)) => self.names(section, &here, true),
            (Part::Key { .. }, _) | (Part::Fresh, Inside::Map(None, _) | Inside::Unknown) => {
                Vec::new()
            }
            (Part::Text { keyed: false, .. }, Inside::Map(None, _)) => Vec::new(),
            (Part::Text { span, .. }, _) => self.in_quotes(&self.wanted(), span.0..span.1),
            (Part::Word { span, .. }, _) => self.value(&self.wanted(), &(span.0..span.1)),
            (Part::Empty | Part::Fresh, _) => self.value(&self.wanted(), &here),
        }
    }

    /// Fields that are not given yet, those that must be first.
    fn fields(&self, all: &[Field], span: Span) -> Vec<Candidate> {
        let text = &self.file().text;
        let block = self.block();
        let own = |key: &Span| key.start <= self.at && self.at <= key.end;
        let keys = block.entries.iter().filter_map(|e| e.key.as_ref());
        let given: HashSet<&str> =
            keys.filter(|k| !own(&k.span)).filter_map(|k| text.get(k.span.clone())).collect();
        let keyed = text[span.end..].trim_start().starts_with(':');
        // Such as the only value of `Constant(3)`: a position is no name.
        let named = |f: &&Field| !f.name.starts_with(|c: char| c.is_ascii_digit());
        let mut free: Vec<&Field> =
            all.iter().filter(named).filter(|f| !given.contains(f.name)).collect();
        free.sort_by_key(|f| f.default.is_some());
        let one = |f: &Field| Candidate {
            label: f.name.into(),
            kind: Kind::FIELD,
            detail: f.detail(),
            meaning: f.meaning.into(),
            text: if keyed { f.name.into() } else { format!("{}: ", f.name) },
            span: span.clone(),
        };
        free.into_iter().map(one).collect()
    }

    /// Names of a section, in quotes or as what stands in them.
    fn names(&self, section: &'static str, span: &Span, quoted: bool) -> Vec<Candidate> {
        let mut seen = HashSet::new();
        let sections = sections(section);
        let all = sections.iter().flat_map(|s| self.files.iter().flat_map(|f| f.names(s)));
        // An entry that is being written does not name itself.
        let other = all.filter(|d| {
            !(std::ptr::eq(d.file, self.file()) && d.key.start <= self.at && self.at <= d.key.end)
        });
        let one = |d: crate::names::Definition<'_>| {
            let quotes = if quoted { "\"" } else { "" };
            Candidate {
                label: d.name.into(),
                kind: Kind::REFERENCE,
                detail: d.line(),
                meaning: String::new(),
                text: format!("{quotes}{}{quotes}", d.name),
                span: span.clone(),
            }
        };
        other.filter(|d| seen.insert(d.name.to_owned())).take(MOST + 1).map(one).collect()
    }

    /// Values that stand without quotes.
    fn value(&self, wanted: &Wanted, span: &Span) -> Vec<Candidate> {
        let word = |name: &str, kind: Kind, meaning: &str, example: &str, fields: bool| {
            let open = self.file().text[span.end..].trim_start().starts_with('(');
            let example = if example.is_empty() { String::new() } else { ron(example) };
            Candidate {
                label: name.into(),
                kind,
                detail: String::new(),
                meaning: format!("{meaning}\n\n{example}").trim().into(),
                text: if fields && !open { format!("{name}(") } else { name.into() },
                span: span.clone(),
            }
        };
        let choice = |name: &&str| word(name, Kind::ENUM_MEMBER, "", "", false);
        let mut found: Vec<Candidate> = match wanted {
            Wanted::Choice(all) => {
                let custom = all[..] == schema::SOLVERS;
                let solvers = self.registry.solvers().filter(|_| custom);
                let solvers =
                    solvers.map(|c| word(c.kind, Kind::CLASS, c.summary, c.example, true));
                all.iter().map(choice).chain(solvers).collect()
            }
            Wanted::Flag => ["true", "false"].iter().map(choice).collect(),
            Wanted::Members => schema::GROUP_KINDS
                .iter()
                .map(|kind| word(kind, Kind::CLASS, "", "", true))
                .collect(),
            Wanted::Kind(_) => {
                let all = self.registry.elements();
                all.map(|c| word(c.kind, Kind::CLASS, c.summary, c.example, true)).collect()
            }
            Wanted::Block(group) => {
                let own = group.blocks.iter().filter(|b| !b.name.is_empty()).map(|b| {
                    // A name that needs no fields may stand alone.
                    let needs =
                        b.fields.iter().any(|f| matches!(f.default, schema::Default::Required));
                    word(b.name, Kind::CLASS, b.meaning, b.example, needs)
                });
                let other = offered(self.registry, group).into_iter();
                let names = alone(group).map(|section| self.names(section, span, true));
                let own =
                    own.chain(other.map(|c| word(c.kind, Kind::CLASS, c.summary, c.example, true)));
                own.chain(names.unwrap_or_default()).collect()
            }
            Wanted::Name(section) => self.names(section, span, true),
            Wanted::List(inner) => return self.value(inner, span),
            _ => Vec::new(),
        };
        // Anything in a list or a map may be repeated.
        if matches!(self.place.inside, Inside::Items(_) | Inside::Map(..))
            && !matches!(self.place.part, Part::Other)
        {
            let all = schema::REPETITION.blocks;
            found.extend(
                all.iter().map(|b| word(b.name, Kind::KEYWORD, b.meaning, b.example, true)),
            );
        }
        found
    }

    /// What stands in quotes.
    fn in_quotes(&self, wanted: &Wanted, content: Span) -> Vec<Candidate> {
        match wanted {
            Wanted::Name(section) => self.names(section, &self.until_end(&content), false),
            Wanted::Members => {
                let span = self.until_end(&content);
                let mut all = self.names("nodes", &span, false);
                all.extend(self.names("elements", &span, false));
                all
            }
            Wanted::List(inner) => self.in_quotes(inner, content),
            Wanted::Number(dimensions) => self.expression(dimensions, &content),
            // Loads of a case and parts of an output may be a name alone.
            Wanted::Block(group) => match alone(group) {
                Some(section) => self.names(section, &self.until_end(&content), false),
                None => Vec::new(),
            },
            // A choice or a flag may hang on a parameter.
            Wanted::Choice(_) | Wanted::Flag => {
                self.names("parameters", &self.until_end(&content), false)
            }
            _ => Vec::new(),
        }
    }

    /// The content of the quotes: all of it, or up to the cursor where what follows belongs to something else as the quotes
    /// lack their end.
    fn until_end(&self, content: &Span) -> Span {
        let behind = &self.file().text[self.at..content.end];
        let foreign = behind.contains([',', ':', '(', ')']);
        content.start..if foreign { self.at } else { content.end }
    }

    /// Units behind a number, or else names of an expression.
    fn expression(
        &self,
        dimensions: &[trilith::element::Dimension],
        content: &Span,
    ) -> Vec<Candidate> {
        let text = &self.file().text;
        let before = &text[content.start..self.at];
        let part = |c: char| c.is_alphanumeric() || "_%µ^".contains(c);
        let in_unit = |c: char| part(c) || "*/".contains(c);
        let behind_number = |head: &str| {
            let head = head.trim_end();
            let digits = |c: char| c.is_ascii_digit() || ".eE+-_".contains(c);
            let number = head.rsplit(|c: char| !digits(c)).next().unwrap_or_default();
            let before = head[..head.len() - number.len()].chars().next_back();
            head.ends_with(|c: char| c.is_ascii_digit() || c == '.')
                && number.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
                && !before.is_some_and(part)
        };
        let unit_start = before
            .rfind(|c: char| !in_unit(c))
            .map_or(0, |i| i + before[i..].chars().next().map_or(0, char::len_utf8));
        // `12kN`: the number and its unit are one piece.
        let glued = &before[unit_start..];
        let digits = glued.find(|c: char| c.is_alphabetic() || c == '%').unwrap_or(glued.len());
        let start = if glued[..digits].ends_with(|c: char| c.is_ascii_digit())
            && behind_number(&glued[..digits])
        {
            Some(unit_start + digits)
        } else if behind_number(&before[..unit_start]) && digits == 0 {
            Some(unit_start)
        } else {
            None
        };
        if let Some(start) = start {
            let end = text[self.at..content.end].find(|c: char| !in_unit(c));
            let end = end.map_or(content.end, |i| self.at + i);
            return self.units(
                dimensions,
                &(content.start + start..end),
                before[..start].ends_with(char::is_whitespace),
            );
        }
        let start = before
            .rfind(|c: char| !part(c))
            .map_or(0, |i| i + before[i..].chars().next().map_or(0, char::len_utf8));
        if before[start..].starts_with(|c: char| c.is_ascii_digit()) {
            return Vec::new();
        }
        let end = text[self.at..content.end].find(|c: char| !part(c));
        let span = content.start + start..end.map_or(content.end, |i| self.at + i);
        let mut all = self.names("parameters", &span, false);
        all.extend(schema::expression_functions().iter().map(|name| Candidate {
            label: (*name).into(),
            kind: Kind::FUNCTION,
            detail: "function of expressions".into(),
            meaning: String::new(),
            text: format!("{name}("),
            span: span.clone(),
        }));
        all
    }

    fn units(
        &self,
        dimensions: &[trilith::element::Dimension],
        span: &Span,
        blank: bool,
    ) -> Vec<Candidate> {
        let mut found: Vec<(String, String)> = Vec::new();
        if dimensions.is_empty() {
            found.extend(schema::units().into_iter().map(|(name, _, si)| (name.to_owned(), si)));
        }
        for dimension in dimensions {
            let si = dimension.unit();
            found.extend(schema::units_of(*dimension).into_iter().map(|u| (u, si.clone())));
        }
        let mut seen = HashSet::new();
        found.retain(|(name, _)| seen.insert(name.clone()));
        let one = |(name, si): (String, String)| Candidate {
            detail: format!("unit of {}", if si == "1" { "a pure number" } else { &si }),
            text: format!("{}{name}", if blank { "" } else { " " }),
            label: name,
            kind: Kind::UNIT,
            meaning: String::new(),
            span: span.clone(),
        };
        found.into_iter().map(one).collect()
    }
}

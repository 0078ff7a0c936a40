//! Where the cursor is: in which block, and what that block may hold there.

use crate::fields::{Field, of_block, of_card, offered};
use crate::names::File;
use crate::scan::{Block, Bracket, Entry, ROOT, Tree, Value};
use crate::wanted::Wanted;
use trilith::Registry;
use trilith::element::Card;
use trilith::element::dimension::NONE;
use trilith::model::schema;

/// What a block may hold.
#[derive(Clone, Debug)]
pub(crate) enum Inside {
    /// Fields by name; a value without a name stands for the first.
    Fields(Vec<Field>),
    /// Values one after the other.
    Items(Wanted),
    /// Names with values; the names may be those of a section.
    Map(Option<&'static str>, Wanted),
    /// Nothing is known of it.
    Unknown,
}

impl Inside {
    /// What the value of an entry may be.
    pub fn value(&self, entry: Option<&Entry>, text: &str) -> Wanted {
        match self {
            Self::Fields(all) => match entry.and_then(|e| e.key_text(text)) {
                Some(key) => {
                    let found = all.iter().find(|f| f.name == key);
                    found.map_or(Wanted::Anything, |f| f.wanted.clone())
                }
                None => all.first().map_or(Wanted::Anything, |f| f.wanted.clone()),
            },
            Self::Items(wanted) | Self::Map(_, wanted) => wanted.clone(),
            Self::Unknown => Wanted::Anything,
        }
    }
}

/// What a name stands for where a value of some sort is wanted.
#[derive(Clone, Debug)]
pub(crate) enum Named {
    Block(&'static schema::Block),
    Card(&'static Card),
}

/// The kind or block of that name that may stand there.
pub(crate) fn named(registry: &Registry, wanted: &Wanted, name: &str) -> Option<Named> {
    let repetition = schema::REPETITION.blocks[0];
    if name == repetition.name {
        return Some(Named::Block(repetition));
    }
    match wanted {
        Wanted::Kind(_) => registry.elements().find(|c| c.kind == name).map(Named::Card),
        Wanted::Block(group) => {
            let own = group.blocks.iter().find(|b| b.name == name).map(|b| Named::Block(b));
            let other = || offered(registry, group).into_iter().find(|c| c.kind == name);
            own.or_else(|| other().map(Named::Card))
        }
        Wanted::Choice(all) if all[..] == schema::SOLVERS => {
            registry.solvers().find(|c| c.kind == name).map(Named::Card)
        }
        Wanted::List(inner) => named(registry, inner, name),
        _ => None,
    }
}

/// What a block holds that stands where `wanted` is.
fn inside(registry: &Registry, wanted: &Wanted, block: &Block, text: &str) -> Inside {
    let name = block.name.as_ref().and_then(|span| text.get(span.clone())).unwrap_or_default();
    if !name.is_empty() {
        return match named(registry, wanted, name) {
            Some(Named::Block(b)) if std::ptr::eq(b, schema::REPETITION.blocks[0]) => {
                let mut fields = of_block(b);
                for f in fields.iter_mut().filter(|f| f.name == "of") {
                    // What is repeated is what would stand there.
                    f.wanted = match wanted {
                        Wanted::List(inner) => (**inner).clone(),
                        other => other.clone(),
                    };
                }
                Inside::Fields(fields)
            }
            Some(Named::Block(b)) => Inside::Fields(of_block(b)),
            Some(Named::Card(card)) => {
                Inside::Fields(of_card(card, matches!(wanted, Wanted::Kind(true))))
            }
            None => match (wanted, name) {
                (Wanted::Members, "Nodes") => Inside::Items(Wanted::Name("nodes")),
                (Wanted::Members, "Elements") => Inside::Items(Wanted::Name("elements")),
                (_, "Parameter") => Inside::Items(Wanted::Name("parameters")),
                _ => Inside::Unknown,
            },
        };
    }
    match (wanted, block.bracket) {
        (Wanted::Block(group), Bracket::Round) => {
            match group.blocks.iter().find(|b| b.name.is_empty()) {
                Some(b) => Inside::Fields(of_block(b)),
                None => Inside::Unknown,
            }
        }
        (Wanted::List(inner), Bracket::Round) => {
            // `(…)` may be one of them, or all of them.
            let alone = inside(registry, inner, block, text);
            let keyed = block.entries.iter().all(|e| e.key.is_some());
            if matches!(alone, Inside::Fields(_)) && keyed {
                alone
            } else {
                Inside::Items((**inner).clone())
            }
        }
        (Wanted::List(inner), Bracket::Square) => Inside::Items((**inner).clone()),
        (Wanted::Map(keys, values), Bracket::Curly) => Inside::Map(*keys, (**values).clone()),
        (Wanted::Factors(section), Bracket::Curly) => {
            Inside::Map(Some(section), Wanted::Number(vec![NONE]))
        }
        (Wanted::Factors(section), Bracket::Round | Bracket::Square) => {
            Inside::Items(Wanted::Name(section))
        }
        (
            Wanted::Number(_) | Wanted::Name(_) | Wanted::Choice(_) | Wanted::Members,
            Bracket::Round | Bracket::Square,
        ) => Inside::Items(wanted.clone()),
        _ => Inside::Unknown,
    }
}

/// What a block of a tree may hold.
pub(crate) fn inside_of(registry: &Registry, tree: &Tree, text: &str, block: usize) -> Inside {
    let mut now = Inside::Items(Wanted::Block(&schema::MODEL));
    for next in tree.path(block) {
        if next == ROOT {
            continue;
        }
        let block = &tree.blocks[next];
        let (parent, entry) = block.parent;
        let wanted = now.value(tree.blocks[parent].entries.get(entry), text);
        now = inside(registry, &wanted, block, text);
    }
    now
}

/// What is at the cursor.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    /// The innermost block.
    pub block: usize,
    pub inside: Inside,
    /// The entry that the cursor is in or behind, before a comma.
    pub entry: Option<usize>,
    pub part: Part,
}

/// The part of an entry that the cursor is in, with the bytes of the word or of the content in quotes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// A comment: nothing.
    Comment,
    /// Nothing yet: an entry may begin.
    Fresh,
    /// Behind the colon, where nothing is yet.
    Empty,
    /// A name before the colon.
    Key { span: (usize, usize), quoted: bool },
    /// A word; or the name of a block.
    Word { span: (usize, usize), keyed: bool },
    /// A text.
    Text { span: (usize, usize), keyed: bool },
    /// Within an entry, but on none of its names.
    Other,
}

/// Where a place between two bytes is.
pub(crate) fn place(registry: &Registry, file: &File, at: usize) -> Place {
    let (tree, text) = (&*file.tree, &*file.text);
    let block = tree.around(at);
    let inside = match file.is_foreign() {
        true => Inside::Unknown,
        false => inside_of(registry, tree, text, block),
    };
    if tree.in_comment(at) {
        return Place { block, inside, entry: None, part: Part::Comment };
    }
    let entries = &tree.blocks[block].entries;
    let last = entries.partition_point(|e| e.span.start <= at).checked_sub(1);
    let comma = |from: usize| {
        let between = text.get(from..at).unwrap_or_default();
        between.char_indices().any(|(i, c)| c == ',' && !tree.in_comment(from + i + 1))
    };
    let current = last.filter(|i| entries[*i].span.end >= at || !comma(entries[*i].span.end));
    let Some(i) = current else {
        return Place { block, inside, entry: None, part: Part::Fresh };
    };
    let part = part(tree, &entries[i], at);
    let entry = (part != Part::Fresh).then_some(i);
    Place { block, inside, entry, part }
}

fn part(tree: &Tree, e: &Entry, at: usize) -> Part {
    if let Some(key) = &e.key
        && at <= key.colon
    {
        let on = key.span.start <= at && at <= key.span.end;
        let span = (key.span.start, key.span.end);
        return if on { Part::Key { span, quoted: key.quoted } } else { Part::Other };
    }
    let keyed = e.key.is_some();
    match &e.value {
        None => Part::Empty,
        Some(Value::Word(span)) if span.start <= at && at <= span.end => {
            Part::Word { span: (span.start, span.end), keyed }
        }
        Some(Value::Text(span, _)) if span.start <= at && at <= span.end => {
            Part::Text { span: (span.start, span.end), keyed }
        }
        Some(Value::Block(b)) => match &tree.blocks[*b].name {
            Some(name) if name.start <= at && at <= name.end => {
                Part::Word { span: (name.start, name.end), keyed }
            }
            _ if at > e.span.end => Part::Fresh,
            _ => Part::Other,
        },
        // Between the colon and the value, or at its very end, where a comma comes first.
        Some(_) if at <= e.span.end => Part::Other,
        Some(_) => Part::Fresh,
    }
}

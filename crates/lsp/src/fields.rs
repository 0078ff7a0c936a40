//! The fields that a block takes, alike whether the schema or a card tells them.

use crate::wanted::Wanted;
use trilith::Registry;
use trilith::catalogue;
use trilith::element::{Card, Category, Default, Parameter};
use trilith::model::schema::{self, Block, Group};

/// A field in words.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub name: &'static str,
    /// Unit, range, choices.
    pub takes: String,
    /// What holds without it; none where it must be given.
    pub default: Option<String>,
    pub meaning: &'static str,
    pub wanted: Wanted,
}

impl Field {
    fn of_schema(f: &schema::Field) -> Self {
        Self {
            name: f.name,
            takes: f.takes.words(|g| g.name.into()),
            default: f.default.words(),
            meaning: f.meaning,
            wanted: Wanted::field(f),
        }
    }

    fn of_card(p: &'static Parameter) -> Self {
        let [_, symbol, unit, range, default, _] = catalogue::parameter(p);
        let known = |text: &&String| !matches!(text.as_str(), "" | "–" | "any");
        let takes: Vec<&str> = [&unit, &range].into_iter().filter(known).map(|t| &**t).collect();
        let mut takes = takes.join(", ");
        if takes.is_empty() {
            takes = "number".into();
        }
        if !symbol.is_empty() {
            takes += &format!(", {symbol} in the law");
        }
        Self {
            name: p.name,
            takes,
            default: (p.default != Default::Required).then_some(default),
            meaning: p.meaning,
            wanted: Wanted::parameter(p),
        }
    }

    /// In one line: what it takes and what holds without it.
    pub fn detail(&self) -> String {
        match &self.default {
            None => format!("{} (must be given)", self.takes),
            Some(default) => format!("{} (without it: {default})", self.takes),
        }
    }
}

/// The fields of a block of the schema.
pub(crate) fn of_block(block: &Block) -> Vec<Field> {
    block.fields.iter().map(Field::of_schema).collect()
}

/// The fields of a kind that has a card. In `properties` it has no place.
pub(crate) fn of_card(card: &'static Card, placed: bool) -> Vec<Field> {
    let mut all = Vec::new();
    let element = matches!(card.category, Category::Linear | Category::Constraint | Category::Link);
    if element && placed {
        all.extend(of_block(&schema::PLACE));
    }
    all.extend(card.parameters.iter().map(Field::of_card));
    match card.category {
        Category::Function => {
            // As those of the program.
            let own = schema::STEP.fields.iter().filter(|f| f.name == "amplitude");
            all.extend(own.map(Field::of_schema));
        }
        Category::Output => all.extend(schema::DERIVED.iter().map(Field::of_schema)),
        _ => {}
    }
    for block in schema::beside(card) {
        all.extend(of_block(block));
    }
    all
}

/// Kinds of other crates that may stand where a block of a group does.
pub(crate) fn offered(registry: &Registry, group: &Group) -> Vec<&'static Card> {
    if std::ptr::eq(group, &schema::FUNCTIONS) {
        registry.functions().collect()
    } else if std::ptr::eq(group, &schema::OUTPUTS) {
        registry.outputs().collect()
    } else {
        Vec::new()
    }
}

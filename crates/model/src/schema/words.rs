//! What fields take, and what holds without them, in words.

use super::{Default, Group, Takes};
use trilith_element::Range;

impl Takes {
    /// In words, with names in backticks; `group` says how a group of blocks is spoken of.
    #[must_use]
    pub fn words(self, group: impl Fn(&Group) -> String) -> String {
        match self {
            Self::Text => "text".into(),
            Self::Number(dimension, range) => {
                let unit = if dimension.is_none() { "number".into() } else { dimension.unit() };
                match range {
                    Range::Any => unit,
                    range => format!("{unit}, {}", bounds(range)),
                }
            }
            Self::Quantity => "number with any unit".into(),
            Self::Count(least) => format!("whole number ≥ {least}"),
            Self::Flag => "`true`, `false`".into(),
            Self::Choice(all) => {
                all.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ")
            }
            Self::Name(what) => {
                format!("name of a {what}").replace("a e", "an e").replace("a o", "an o")
            }
            Self::One(g) => format!("one of {}", group(g)),
            Self::List(g) => format!("list of {}", group(g)),
            Self::Map(g) => format!("map from names to {}", group(g)),
            Self::Words(words) => words.into(),
        }
    }
}

impl Default {
    /// In words, a value in backticks; none where the file must give the field.
    #[must_use]
    pub fn words(self) -> Option<String> {
        match self {
            Self::Required => None,
            Self::Absent(words) => Some(words.into()),
            Self::Value(text) => Some(format!("`{text}`")),
        }
    }
}

fn bounds(range: Range) -> String {
    match range {
        Range::Within(a, b) if (a + 1.0 / 3.0).abs() < 1e-9 => format!("−1/3 … {b}"),
        range => range.text(),
    }
}

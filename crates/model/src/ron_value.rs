//! Values of a model file and how they are written, for programs that make models.

use std::fmt::Write;

/// A value of a model file.
#[derive(Clone, Debug, PartialEq)]
pub enum Ron {
    /// A number in the units of the file.
    Number(f64),
    /// A text in quotes: names, quantities with a unit.
    Text(String),
    /// A word without quotes: directions, choices, flags.
    Word(String),
    /// `[…]`.
    List(Vec<Ron>),
    /// `(…)` without names.
    Tuple(Vec<Ron>),
    /// `Name(field: value, …)`; without a name where it is empty.
    Block(String, Vec<(String, Ron)>),
}

impl Ron {
    /// A text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// A word.
    pub fn word(word: impl Into<String>) -> Self {
        Self::Word(word.into())
    }

    /// A vector of numbers.
    pub fn vector(numbers: &[f64]) -> Self {
        Self::Tuple(numbers.iter().map(|x| Self::Number(*x)).collect())
    }

    /// A list of words.
    pub fn words<T: AsRef<str>>(words: &[T]) -> Self {
        Self::List(words.iter().map(|w| Self::word(w.as_ref())).collect())
    }

    /// A block.
    pub fn block(name: &str) -> Self {
        Self::Block(name.into(), Vec::new())
    }

    /// The block with a field more.
    #[must_use]
    pub fn with(mut self, name: &str, value: impl Into<Ron>) -> Self {
        if let Self::Block(_, fields) = &mut self {
            fields.push((name.into(), value.into()));
        }
        self
    }

    /// The block with a field more where there is a value.
    #[must_use]
    pub fn maybe(self, name: &str, value: Option<impl Into<Ron>>) -> Self {
        match value {
            Some(value) => self.with(name, value),
            None => self,
        }
    }

    /// True where no number in it is beyond all bounds.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Number(x) => x.is_finite(),
            Self::List(all) | Self::Tuple(all) => all.iter().all(Self::is_finite),
            Self::Block(_, fields) => fields.iter().all(|(_, v)| v.is_finite()),
            Self::Text(_) | Self::Word(_) => true,
        }
    }

    /// Name of a block.
    #[must_use]
    pub fn name(&self) -> &str {
        if let Self::Block(name, _) = self { name } else { "" }
    }
}

impl From<f64> for Ron {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}

impl From<i32> for Ron {
    /// A whole number, such as how many cycles.
    fn from(x: i32) -> Self {
        Self::Number(x.into())
    }
}

impl From<(f64, &str)> for Ron {
    /// A number and its unit.
    fn from((x, unit): (f64, &str)) -> Self {
        Self::Text(format!("{} {unit}", number(x)))
    }
}

impl From<&str> for Ron {
    /// A text: a name, or a quantity with its unit.
    fn from(text: &str) -> Self {
        Self::text(text)
    }
}

impl From<String> for Ron {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<bool> for Ron {
    fn from(yes: bool) -> Self {
        Self::word(if yes { "true" } else { "false" })
    }
}

impl<const N: usize> From<[f64; N]> for Ron {
    /// A place or a direction.
    fn from(numbers: [f64; N]) -> Self {
        Self::vector(&numbers)
    }
}

impl<const N: usize> From<[&str; N]> for Ron {
    /// Names, such as the nodes of an element.
    fn from(names: [&str; N]) -> Self {
        Self::Tuple(names.into_iter().map(Self::text).collect())
    }
}

impl From<Vec<Ron>> for Ron {
    fn from(all: Vec<Ron>) -> Self {
        Self::List(all)
    }
}

impl std::fmt::Display for Ron {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let joined = |f: &mut std::fmt::Formatter<'_>, all: &[Ron]| {
            for (i, value) in all.iter().enumerate() {
                write!(f, "{}{value}", if i == 0 { "" } else { ", " })?;
            }
            Ok(())
        };
        match self {
            Self::Number(x) => f.write_str(&number(*x)),
            Self::Text(text) => f.write_str(&quoted(text)),
            Self::Word(word) => f.write_str(word),
            Self::List(all) => {
                f.write_char('[')?;
                joined(f, all)?;
                f.write_char(']')
            }
            Self::Tuple(all) => {
                f.write_char('(')?;
                joined(f, all)?;
                f.write_char(')')
            }
            Self::Block(name, fields) => {
                f.write_str(name)?;
                if fields.is_empty() && !name.is_empty() {
                    return Ok(());
                }
                f.write_char('(')?;
                for (i, (field, value)) in fields.iter().enumerate() {
                    write!(f, "{}{field}: {value}", if i == 0 { "" } else { ", " })?;
                }
                f.write_char(')')
            }
        }
    }
}

/// A number with all its digits, in powers of ten where it is very large or small.
#[must_use]
pub fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".into(),
        size if (1e-4..1e9).contains(&size) => x.to_string(),
        _ => format!("{x:e}"),
    }
}

/// A text in quotes, with what cannot stand in them escaped.
#[must_use]
pub fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            // Braces of a text would be filled in when it is read.
            '{' | '}' => out.extend([c, c]),
            c if c.is_control() => out.extend(c.escape_unicode()),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_written_as_a_model_file_has_them() {
        let gap = Ron::block("Gap").with("node", Ron::text("a\"b")).with("k", 2e12);
        assert_eq!(gap.to_string(), r#"Gap(node: "a\"b", k: 2e12)"#);
        assert_eq!(Ron::block("Fixed").to_string(), "Fixed");
        let list = Ron::List(vec![Ron::vector(&[0.0, -1.5, 1e-7]), Ron::words(&["Ux"])]);
        assert_eq!(list.to_string(), "[(0, -1.5, 1e-7), [Ux]]");
        assert_eq!(quoted("a\nb"), "\"a\\u{a}b\"");
        assert_eq!(quoted("{i}"), "\"{{i}}\"");
    }
}

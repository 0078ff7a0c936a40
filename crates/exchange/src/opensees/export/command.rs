//! Commands of OpenSees on their way into a script.

use std::fmt::Write;

/// An argument.
#[derive(Clone, Debug, PartialEq)]
pub enum Word {
    /// A tag, a direction, a flag.
    Whole(i64),
    /// A number.
    Real(f64),
    /// A name or an option.
    Text(String),
}

impl From<i64> for Word {
    fn from(i: i64) -> Self {
        Self::Whole(i)
    }
}

impl From<f64> for Word {
    fn from(x: f64) -> Self {
        Self::Real(x)
    }
}

impl From<&str> for Word {
    fn from(s: &str) -> Self {
        Self::Text(s.into())
    }
}

/// A command with what it is about.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// Its name.
    pub name: &'static str,
    /// Its arguments.
    pub words: Vec<Word>,
    /// Remark behind it.
    pub remark: String,
}

impl Command {
    /// A command without a remark.
    pub fn new(name: &'static str, words: impl IntoIterator<Item = Word>) -> Self {
        Self { name, words: words.into_iter().collect(), remark: String::new() }
    }

    /// With one more argument.
    pub fn with(mut self, word: impl Into<Word>) -> Self {
        self.words.push(word.into());
        self
    }

    /// With more arguments of one kind.
    pub fn all<W: Into<Word>>(mut self, words: impl IntoIterator<Item = W>) -> Self {
        self.words.extend(words.into_iter().map(Into::into));
        self
    }

    /// With a remark, kept to one line.
    pub fn remark(mut self, text: impl Into<String>) -> Self {
        self.remark = trilith_model::visible_line(&text.into()).into_owned();
        self
    }

    /// As a line of Python.
    pub fn python(&self) -> String {
        let words: Vec<String> = self.words.iter().map(word).collect();
        let mut line = format!("ops.{}({})", self.name, words.join(", "));
        if !self.remark.is_empty() {
            let _ = write!(line, "  # {}", self.remark);
        }
        line
    }
}

fn word(word: &Word) -> String {
    match word {
        Word::Whole(i) => i.to_string(),
        Word::Real(x) => number(*x),
        Word::Text(s) => quoted(s),
    }
}

/// A number that Python reads back to the bit.
pub fn number(x: f64) -> String {
    // Minus nought means nothing in a model.
    format!("{:?}", if x == 0.0 { 0.0 } else { x })
}

/// A text of Python.
pub fn quoted(s: &str) -> String {
    let mut out = String::from("\"");
    for c in s.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() || ('\u{2028}'..='\u{2029}').contains(&c) => {
                let _ = write!(out, "\\U{:08x}", c as u32);
            }
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
    fn a_command_is_a_line_of_python() {
        let node = Command::new("node", [1.into(), 0.5.into(), (-0.0).into()]).with("-ndf").with(6);
        assert_eq!(
            node.remark("a \"b\"\n").python(),
            "ops.node(1, 0.5, 0.0, \"-ndf\", 6)  # a \"b\"\\n"
        );
        assert_eq!(quoted("a\"\\\n\u{1b}"), "\"a\\\"\\\\\\U0000000a\\U0000001b\"");
        assert_eq!([number(1e-9), number(5e8), number(2.0)], ["1e-9", "500000000.0", "2.0"]);
    }
}

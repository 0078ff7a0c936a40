//! Arguments of a command, taken one after the other.

use super::tcl::{Number, Value};

/// What is wrong with a command: at which word, what, and what would be right.
#[derive(Debug)]
pub struct Wrong {
    pub word: usize,
    pub message: String,
    pub help: String,
}

/// What a command gives, or what is wrong with it.
pub type Told<T> = Result<T, Wrong>;

/// An error at a word.
pub fn wrong<T>(word: usize, message: impl Into<String>, help: &str) -> Told<T> {
    Err(Wrong { word, message: message.into(), help: help.into() })
}

/// Arguments from a word on.
pub struct Args<'c> {
    words: &'c [Value],
    at: usize,
    usage: &'static str,
}

impl<'c> Args<'c> {
    /// Arguments behind the first `at` words; `usage` is how the command is written.
    pub fn new(words: &'c [Value], at: usize, usage: &'static str) -> Self {
        Self { words, at, usage }
    }

    /// Position of the next word.
    pub fn at(&self) -> usize {
        self.at
    }

    /// The next word, where there is one.
    pub fn peek(&self) -> Option<&'c str> {
        self.words.get(self.at).map(Value::str)
    }

    /// The next word with its place.
    pub fn value(&mut self, what: &str) -> Told<&'c Value> {
        let Some(value) = self.words.get(self.at) else {
            return wrong(
                0,
                format!("`{}` without {what}", self.name()),
                &format!("it is `{}`", self.usage),
            );
        };
        self.at += 1;
        Ok(value)
    }

    fn name(&self) -> String {
        let two = self.words.len() > 1 && self.usage.split(' ').nth(1) == Some(self.words[1].str());
        self.words[..=usize::from(two)].iter().map(Value::str).collect::<Vec<_>>().join(" ")
    }

    /// The next word.
    pub fn word(&mut self, what: &str) -> Told<&'c str> {
        Ok(self.value(what)?.str())
    }

    /// The next number.
    pub fn number(&mut self, what: &str) -> Told<f64> {
        let word = self.at;
        let text = self.word(what)?;
        match Number::read(text) {
            Some(n) => Ok(n.real()),
            None => wrong(
                word,
                format!("`{}` is no number: {what}", short(text)),
                &format!("it is `{}`", self.usage),
            ),
        }
    }

    /// The next whole number.
    pub fn whole(&mut self, what: &str) -> Told<i64> {
        let word = self.at;
        let text = self.word(what)?;
        match Number::read(text) {
            Some(Number::Whole(i)) => Ok(i),
            _ => wrong(
                word,
                format!("`{}` is no whole number: {what}", short(text)),
                &format!("it is `{}`", self.usage),
            ),
        }
    }

    /// A number above zero.
    pub fn positive(&mut self, what: &str) -> Told<f64> {
        let word = self.at;
        let x = self.number(what)?;
        if x <= 0.0 {
            return wrong(word, format!("{what} is not above zero"), "");
        }
        Ok(x)
    }

    /// So many numbers.
    pub fn numbers<const N: usize>(&mut self, what: &str) -> Told<[f64; N]> {
        let mut out = [0.0; N];
        for x in &mut out {
            *x = self.number(what)?;
        }
        Ok(out)
    }

    /// The next word where it is a number.
    pub fn maybe(&mut self) -> Option<f64> {
        let n = Number::read(self.peek()?)?;
        self.at += 1;
        Some(n.real())
    }

    /// The next word where it is a whole number.
    pub fn maybe_whole(&mut self) -> Option<i64> {
        match Number::read(self.peek()?)? {
            Number::Whole(i) => {
                self.at += 1;
                Some(i)
            }
            Number::Real(_) => None,
        }
    }

    /// All numbers that follow.
    pub fn all(&mut self) -> Vec<f64> {
        std::iter::from_fn(|| self.maybe()).collect()
    }

    /// All whole numbers that follow.
    pub fn wholes(&mut self) -> Vec<i64> {
        std::iter::from_fn(|| self.maybe_whole()).collect()
    }

    /// Takes the next word where it is this one, however its letters are written.
    pub fn flag(&mut self, name: &str) -> bool {
        let found = self.peek().is_some_and(|w| w.eq_ignore_ascii_case(name));
        self.at += usize::from(found);
        found
    }

    /// The next option, which begins with `-`.
    pub fn option(&mut self) -> Option<&'c str> {
        let word = self.peek()?;
        self.at += 1;
        Some(word)
    }
}

/// A text that is not too long for a message.
pub fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

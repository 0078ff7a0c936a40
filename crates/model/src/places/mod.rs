//! Where the spans of a model lead: the model file, files that it includes, entries that a repetition makes.
//!
//! A span counts bytes of the model file. Past the end of that text lie, one after the other, the texts of the files
//! that it includes, and behind these each repetition as often as it is repeated. So a span alone tells the file, the
//! place in it and the indices.

mod told;

use crate::expression::Quantity;
use crate::{Source, Span};
use std::sync::Arc;

/// Where spans lead.
#[derive(Clone, Debug)]
pub struct Places {
    /// Where each file starts, rising; the first is the model file.
    files: Vec<(usize, Arc<Source>)>,
    /// Rising by their starts.
    loops: Vec<Loop>,
    /// The first place that is free.
    end: usize,
}

/// A text that is repeated over one index.
#[derive(Clone, Debug)]
struct Loop {
    start: usize,
    /// Length of the text, and where it stands: in a file or in another repetition.
    length: usize,
    of: usize,
    index: Arc<str>,
    values: Values,
}

/// What an index runs through.
#[derive(Clone, Debug)]
pub(crate) enum Values {
    /// Whole numbers from the first on.
    Whole { first: i64, count: usize },
    /// As the file lists them, with names of the further values that each of them has.
    Listed(Arc<[Listed]>, Arc<[String]>),
}

/// A listed value: what stands for it in names, its number if it has one, and further values.
#[derive(Clone, Debug)]
pub(crate) struct Listed {
    pub name: String,
    pub number: Option<Quantity>,
    pub more: Vec<Listed>,
}

/// Where a span leads.
#[derive(Clone, Debug)]
pub struct Place {
    /// The file.
    pub source: Arc<Source>,
    /// Bytes of its text.
    pub span: Span,
    /// Names and values of the indices of the repetitions around it, the outermost first.
    pub indices: Vec<(String, String)>,
}

impl Place {
    /// Such as `i = 3, k = 0`; empty outside of repetitions.
    #[must_use]
    pub fn indices(&self) -> String {
        let one = |(name, value): &(String, String)| format!("{name} = {value}");
        self.indices.iter().map(one).collect::<Vec<_>>().join(", ")
    }
}

impl Values {
    pub fn count(&self) -> usize {
        match self {
            Self::Whole { count, .. } => *count,
            Self::Listed(all, _) => all.len(),
        }
    }

    /// What stands for the n-th in names.
    pub fn name(&self, n: usize) -> String {
        match self {
            Self::Whole { first, .. } => (first + n as i64).to_string(),
            Self::Listed(all, _) => all[n].name.clone(),
        }
    }
}

/// The value that an index has at a place.
pub(crate) enum Value<'p> {
    Whole(i64),
    Listed(&'p Listed),
}

impl Value<'_> {
    /// What stands for it in names.
    pub fn name(&self) -> String {
        match self {
            Self::Whole(i) => i.to_string(),
            Self::Listed(it) => it.name.clone(),
        }
    }

    /// Its number; none where it is a name alone.
    pub fn number(&self) -> Option<Quantity> {
        match self {
            Self::Whole(i) => Some(Quantity::bare(*i as f64)),
            Self::Listed(it) => it.number,
        }
    }
}

impl Loop {
    /// The n-th value of the index, or of a further name that its values have.
    fn value(&self, n: usize, name: &str) -> Option<Value<'_>> {
        let own = *self.index == *name;
        match &self.values {
            Values::Whole { first, count } if own && n < *count => {
                Some(Value::Whole(first + n as i64))
            }
            Values::Listed(all, _) if own => all.get(n).map(Value::Listed),
            Values::Listed(all, names) => {
                let column = names.iter().position(|other| other == name)?;
                all.get(n)?.more.get(column).map(Value::Listed)
            }
            Values::Whole { .. } => None,
        }
    }
}

impl Places {
    /// Those of a file.
    pub(crate) fn new(source: Arc<Source>) -> Self {
        let mut all = Self { files: Vec::new(), loops: Vec::new(), end: 0 };
        all.file(source);
        all
    }

    /// Adds a file; where it starts.
    pub(crate) fn file(&mut self, source: Arc<Source>) -> usize {
        let start = self.end;
        self.end += source.text.len() + 1;
        self.files.push((start, source));
        start
    }

    /// The files: the model file first.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Arc<Source>> {
        self.files.iter().map(|(_, source)| source)
    }

    /// The file of a place where that is not the model file.
    pub(crate) fn included(&self, at: usize) -> Option<&Source> {
        let number = self.file_of(at);
        (number > 0).then(|| &*self.files[number].1)
    }

    /// The file of a place, by its number.
    pub(crate) fn file_of(&self, mut at: usize) -> usize {
        while let Some((of, n)) = self.around(at) {
            at = of.of + (at - of.start) - n * of.length;
        }
        self.files.partition_point(|(start, _)| *start <= at).saturating_sub(1)
    }

    /// Adds a text that stands at `of` and is repeated over an index; where it starts and how long it is each time.
    /// None where there is no room.
    pub(crate) fn repeat(
        &mut self,
        of: Span,
        index: &Arc<str>,
        values: &Values,
    ) -> Option<(usize, usize)> {
        let (start, length) = (self.end, of.len() + 1);
        self.end = start.checked_add(length.checked_mul(values.count())?)?;
        let (index, values) = (Arc::clone(index), values.clone());
        self.loops.push(Loop { start, length, of: of.start, index, values });
        Some((start, length))
    }

    /// The innermost repetition around a place, and its how-manieth time that is.
    fn around(&self, at: usize) -> Option<(&Loop, usize)> {
        if at < self.loops.first()?.start {
            return None;
        }
        let last = self.loops.last().filter(|l| l.start <= at);
        let found = match last {
            Some(last) => last,
            None => &self.loops[self.loops.partition_point(|l| l.start <= at).checked_sub(1)?],
        };
        Some((found, (at - found.start) / found.length))
    }

    /// The value of an index at a place; none where there is no such index.
    pub(crate) fn index(&self, mut at: usize, name: &str) -> Option<Value<'_>> {
        while let Some((of, n)) = self.around(at) {
            if let Some(value) = of.value(n, name) {
                return Some(value);
            }
            at = of.of + (at - of.start) - n * of.length;
        }
        None
    }

    /// Names of the indices around a place, the innermost first.
    pub(crate) fn indices(&self, mut at: usize) -> Vec<&str> {
        let mut all = Vec::new();
        while let Some((of, n)) = self.around(at) {
            all.push(&*of.index);
            if let Values::Listed(_, names) = &of.values {
                all.extend(names.iter().map(String::as_str));
            }
            at = of.of + (at - of.start) - n * of.length;
        }
        all
    }

    /// Where a span leads.
    ///
    /// # Panics
    /// Never for a span of the model that these places belong to, or of any other model with a file.
    #[must_use]
    pub fn find(&self, span: &Span) -> Place {
        let mut at = span.start;
        let mut indices = Vec::new();
        while let Some((of, n)) = self.around(at) {
            let n = n.min(of.values.count().saturating_sub(1));
            indices.push((of.index.to_string(), of.values.name(n)));
            at = of.of + (at - of.start) - n * of.length;
        }
        indices.reverse();
        let (start, source) = &self.files[self.file_of(at)];
        let start = at - start;
        Place { source: Arc::clone(source), span: start..start + span.len(), indices }
    }

    /// The model file.
    pub(crate) fn main(&self) -> &Arc<Source> {
        &self.files[0].1
    }
}

//! What a law says of itself.

use crate::error::DeclarationError as Wrong;
use serde::{Deserialize, Serialize};
use trilith_element::{Axis, Dimension, Range};
use trilith_model::{quantity, si_dimension};

/// Most history variables.
pub(crate) const MOST_HISTORY: usize = 64;

/// A law as it describes itself: what the card of a built-in kind says, with texts that are made at run time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Declaration {
    /// Name in model files.
    pub kind: String,
    /// One sentence.
    pub summary: String,
    /// The law in words or formulae.
    pub law: String,
    /// Where it comes from.
    pub source: String,
    /// Its coordinates: local axes such as `U1`.
    pub axes: Vec<String>,
    /// Its parameters, in the order in which it sees them.
    pub parameters: Vec<DeclaredParameter>,
    /// Its history variables.
    pub history: Vec<DeclaredField>,
    /// Whether it looks at rates.
    pub rates: bool,
    /// Whether it gives tangents.
    pub tangent: bool,
    /// Whether it gives energies.
    pub energy: bool,
    /// Deformations at which it does what it is for, m or rad, one for each coordinate; empty: 0.01 each.
    pub amplitude: Vec<f64>,
    /// Cycles of such deformations in a second, Hz; 0: 1.
    pub frequency: f64,
}

/// A parameter, always a number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeclaredParameter {
    /// Name in model files.
    pub name: String,
    /// SI unit, `1` for a pure number.
    pub unit: String,
    /// One sentence.
    pub meaning: String,
    /// Admissible values.
    pub range: DeclaredRange,
    /// What holds where a model says nothing; none: it must say.
    pub default: Option<DeclaredValue>,
    /// A value for the example on the card, where there is no default.
    pub example: Option<DeclaredValue>,
}

/// A number in SI, or a text with a unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum DeclaredValue {
    /// In SI.
    Number(f64),
    /// Such as `5 mm`.
    Text(String),
}

/// Admissible values; see [`Range`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum DeclaredRange {
    /// Any finite number.
    #[default]
    Any,
    /// `> 0`.
    Positive,
    /// `≥ 0`.
    NonNegative,
    /// Both included.
    Within(f64, f64),
    /// Above the first, up to the second.
    Above(f64, f64),
}

/// A history variable.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeclaredField {
    /// Name, unique within the law.
    pub name: String,
    /// SI unit, or `1`.
    pub unit: String,
}

/// Words that stand for something else where a kind may stand: of RON, and of model files.
const WORDS: [&str; 6] = ["Some", "None", "For", "Parameter", "Text", "Contents"];

/// A name that a model file, a checkpoint and Python can write.
fn is_name(text: &str) -> bool {
    let mut letters = text.chars();
    letters.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
        && letters.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

impl Declaration {
    /// The coordinates.
    pub(crate) fn coordinates(&self) -> Result<Vec<Axis>, Wrong> {
        let kind = self.kind.clone();
        let wrong = || Wrong::Axes { kind: kind.clone(), axes: self.axes.join(" ") };
        let find = |name: &String| Axis::ALL.into_iter().find(|axis| axis.name() == name);
        let all: Option<Vec<Axis>> = self.axes.iter().map(find).collect();
        let all = all.filter(|axes| !axes.is_empty()).ok_or_else(wrong)?;
        self.unique("axis", self.axes.iter())?;
        Ok(all)
    }

    fn unique<'a>(
        &self,
        what: &'static str,
        names: impl Iterator<Item = &'a String>,
    ) -> Result<(), Wrong> {
        let mut seen: Vec<&String> = Vec::new();
        for name in names {
            if seen.contains(&name) {
                let (kind, name) = (self.kind.clone(), name.clone());
                return Err(Wrong::Twice { kind, what, name });
            }
            seen.push(name);
        }
        Ok(())
    }

    fn named<'a>(
        &self,
        what: &'static str,
        names: impl Iterator<Item = &'a String> + Clone,
    ) -> Result<(), Wrong> {
        if let Some(name) = names.clone().find(|name| !is_name(name)) {
            let (kind, name) = (self.kind.clone(), name.clone());
            return Err(Wrong::Name { kind, what, name });
        }
        self.unique(what, names)
    }

    /// Amplitudes and frequency, with what holds where nothing is said.
    pub(crate) fn motion(&self) -> Result<(Vec<f64>, f64), Wrong> {
        let count = self.axes.len();
        let amplitude =
            if self.amplitude.is_empty() { vec![1e-2; count] } else { self.amplitude.clone() };
        let frequency = if self.frequency == 0.0 { 1.0 } else { self.frequency };
        let is_size = |x: &f64| x.is_finite() && *x > 0.0;
        if amplitude.len() != count || !amplitude.iter().chain([&frequency]).all(is_size) {
            return Err(Wrong::Amplitude { kind: self.kind.clone(), count });
        }
        Ok((amplitude, frequency))
    }

    fn dimension(&self, name: &str, unit: &str) -> Result<Dimension, Wrong> {
        si_dimension(unit).ok_or_else(|| Wrong::Unit {
            kind: self.kind.clone(),
            name: name.to_owned(),
            unit: unit.to_owned(),
        })
    }

    /// Names, units, ranges and values; dimensions of the parameters, their ranges, defaults and values for the example.
    pub(crate) fn check(&self) -> Result<Vec<Understood>, Wrong> {
        if !is_name(&self.kind) || !self.kind.starts_with(|c: char| c.is_ascii_uppercase()) {
            return Err(Wrong::Kind { name: self.kind.clone() });
        }
        if WORDS.contains(&self.kind.as_str()) {
            return Err(Wrong::Reserved { name: self.kind.clone() });
        }
        self.coordinates()?;
        self.motion()?;
        self.named("parameter", self.parameters.iter().map(|p| &p.name))?;
        self.named("history variable", self.history.iter().map(|f| &f.name))?;
        if self.history.len() > MOST_HISTORY {
            let (kind, count) = (self.kind.clone(), self.history.len());
            return Err(Wrong::History { kind, count, most: MOST_HISTORY });
        }
        for field in &self.history {
            self.dimension(&field.name, &field.unit)?;
        }
        self.parameters.iter().map(|p| self.understand(p)).collect()
    }

    fn understand(&self, p: &DeclaredParameter) -> Result<Understood, Wrong> {
        let dimension = self.dimension(&p.name, &p.unit)?;
        let (low, high) = match p.range {
            DeclaredRange::Within(low, high) | DeclaredRange::Above(low, high) => (low, high),
            _ => (0.0, 1.0),
        };
        if !(low.is_finite() && high.is_finite() && low < high) {
            let [low, high] = [low, high].map(|x| x.to_string());
            let (kind, name) = (self.kind.clone(), p.name.clone());
            return Err(Wrong::Range { kind, name, low, high });
        }
        let range = match p.range {
            DeclaredRange::Any => Range::Any,
            DeclaredRange::Positive => Range::Positive,
            DeclaredRange::NonNegative => Range::NonNegative,
            DeclaredRange::Within(a, b) => Range::Within(a, b),
            DeclaredRange::Above(a, b) => Range::Above(a, b),
        };
        let number = |value: &DeclaredValue| {
            let wrong = |why: String| Wrong::Value {
                kind: self.kind.clone(),
                name: p.name.clone(),
                value: value.text(),
                why,
            };
            let x = match value {
                DeclaredValue::Number(x) => *x,
                DeclaredValue::Text(text) => quantity(text, dimension).map_err(wrong)?,
            };
            let fits = range.contains(x).then_some(x);
            fits.ok_or_else(|| wrong(format!("must be {}", range.text())))
        };
        let default = p.default.as_ref().map(number).transpose()?;
        let example = match &p.example {
            Some(example) => number(example).map(|_| Some(example.clone()))?,
            None => None,
        };
        Ok(Understood { dimension, range, default, example })
    }
}

impl DeclaredValue {
    /// As a model file writes it.
    pub(crate) fn text(&self) -> String {
        match self {
            Self::Number(x) => format!("{x:?}"),
            Self::Text(text) => format!("\"{text}\""),
        }
    }
}

/// A parameter, understood.
pub(crate) struct Understood {
    pub dimension: Dimension,
    pub range: Range,
    /// In SI.
    pub default: Option<f64>,
    pub example: Option<DeclaredValue>,
}

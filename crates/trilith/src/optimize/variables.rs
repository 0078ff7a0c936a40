//! Parameters between bounds, as variables that are free to move.
//!
//! ```text
//! x = m + h sin y        m, h: middle and half of the range, of x or of ln x;  y from −∞ to ∞
//! ```
//!
//! The methods of the crate that searches have no bounds. With a sine the whole line of y lies within them; a parameter whose best value
//! is a bound has an ordinary, smooth minimum in y there (James & Roos 1975, MINUIT), which a logistic function would put at
//! infinity. Only exactly at a bound does y not tell whether x had better go back: no search begins there.

use super::OptimizeError;
use std::str::FromStr;
use trilith_element::Dimension;

/// A parameter that is searched for, and between which values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Lower bound: a number with a unit, such as `10 kN*s/m`.
    pub low: String,
    /// Upper bound.
    pub high: String,
    /// Steps are shares of the value, for ranges over powers of ten; both bounds are above zero then.
    pub logarithmic: bool,
}

impl Variable {
    /// A parameter between two bounds.
    #[must_use]
    pub fn new(name: impl Into<String>, low: impl Into<String>, high: impl Into<String>) -> Self {
        Self { name: name.into(), low: low.into(), high: high.into(), logarithmic: false }
    }
}

impl FromStr for Variable {
    type Err = String;

    /// `NAME=LOW..HIGH`, or `NAME=LOW..HIGH log`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            "NAME=LOW..HIGH is wanted, such as `mu=0.02..0.2` or `damper=\"10 kN*s/m..1 MN*s/m log\"`"
                .to_owned()
        };
        let (name, range) = text.split_once('=').ok_or_else(wrong)?;
        let range = range.trim();
        let (range, logarithmic) = match range.strip_suffix("log") {
            Some(bare) if bare.ends_with(char::is_whitespace) => (bare, true),
            _ => (range, false),
        };
        let (low, high) = range.split_once("..").ok_or_else(wrong)?;
        let [name, low, high] = [name, low, high].map(str::trim);
        if name.is_empty() || low.is_empty() || high.is_empty() {
            return Err(wrong());
        }
        Ok(Self { logarithmic, ..Self::new(name, low, high) })
    }
}

/// A search begins so far from a bound, as share of the range.
const OFF_BOUND: f64 = 0.02;

/// A variable with its numbers.
#[derive(Clone, Debug)]
pub(super) struct Range {
    pub name: String,
    pub low: f64,
    pub high: f64,
    pub dimension: Dimension,
    logarithmic: bool,
}

impl Range {
    pub(super) fn new(of: &Variable, dimension: Dimension) -> Result<Self, OptimizeError> {
        let name = of.name.clone();
        let wrong = |reason: String| OptimizeError::Bounds { name: of.name.clone(), reason };
        let number = |text: &str| trilith_model::quantity(text, dimension).map_err(wrong);
        let (low, high) = (number(&of.low)?, number(&of.high)?);
        if low >= high {
            return Err(wrong(format!("{} is not below {}", of.low, of.high)));
        }
        if of.logarithmic && low <= 0.0 {
            return Err(wrong("where steps are shares of the value, both are above zero".into()));
        }
        Ok(Self { name, low, high, dimension, logarithmic: of.logarithmic })
    }

    fn scaled(&self, x: f64) -> f64 {
        if self.logarithmic { x.ln() } else { x }
    }

    fn middle_and_half(&self) -> (f64, f64) {
        let (low, high) = (self.scaled(self.low), self.scaled(self.high));
        (f64::midpoint(low, high), 0.5 * (high - low))
    }

    /// Where a search begins: at this value, or near it within the bounds.
    pub(super) fn start(&self, x: f64) -> f64 {
        let (middle, half) = self.middle_and_half();
        let most = 1.0 - 2.0 * OFF_BOUND;
        let share = (self.scaled(x.clamp(self.low, self.high)) - middle) / half;
        if share.abs() <= most {
            return ((1.0 - 2.0 * f64::EPSILON) * share).clamp(-1.0, 1.0).asin();
        }
        (most * share.signum()).asin()
    }

    /// The value at y.
    pub(super) fn at(&self, y: f64) -> f64 {
        let (middle, half) = self.middle_and_half();
        let s = middle + half * y.sin();
        let x = if self.logarithmic { s.exp() } else { s };
        x.clamp(self.low, self.high)
    }

    /// dx/dy.
    pub(super) fn slope(&self, y: f64) -> f64 {
        let (_, half) = self.middle_and_half();
        half * y.cos() * if self.logarithmic { self.at(y) } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_element::dimension::{LENGTH, NONE};

    fn range(text: &str) -> Range {
        Range::new(&text.parse().expect("a variable"), LENGTH).expect("a range")
    }

    #[test]
    fn values_stay_between_the_bounds_and_slopes_are_those_of_the_values() {
        for text in ["x=1 cm..2 m", "x=1 cm..2 m log", "x=-1..3"] {
            let range = range(text);
            for i in -20..=20 {
                let y = 0.37 * f64::from(i);
                let x = range.at(y);
                assert!(range.low <= x && x <= range.high);
                let h = 1e-5;
                let slope = (range.at(y + h) - range.at(y - h)) / (2.0 * h);
                assert!((range.slope(y) - slope).abs() < 1e-8 * range.high, "{text} at {y}");
            }
        }
    }

    #[test]
    fn a_search_begins_at_the_value_or_within_the_bounds() {
        let range = range("x=1..3");
        assert!((range.at(range.start(1.7)) - 1.7).abs() < 1e-14);
        assert!((range.at(range.start(3.0)) - 2.96).abs() < 1e-14);
        assert!((range.at(range.start(-5.0)) - 1.04).abs() < 1e-14);
    }

    #[test]
    fn what_is_no_range_is_told() {
        for text in ["x", "x=1", "x=1..", "=1..2", "x=..2 log"] {
            assert!(text.parse::<Variable>().is_err(), "{text}");
        }
        let told = |text: &str| {
            Range::new(&text.parse().unwrap(), NONE).map(|_| ()).unwrap_err().to_string()
        };
        assert!(told("x=2..1").contains("2 is not below 1"));
        assert!(told("x=0..1 log").contains("above zero"));
        assert!(told("x=1 m..2 m").contains("this is in m"));
    }
}

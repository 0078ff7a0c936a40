//! Expressions: numbers with units, parameters, `+ - * / ^`, functions.
//!
//! ```text
//! sum     = product { (+|-) product }
//! product = sign { (*|/) sign }
//! sign    = [-|+] sign | power
//! power   = atom [^ sign]
//! atom    = number [units] | name | name(sum, …) | (sum)
//! units   = unit [^ exponent] { [*|/|·] (unit [^ exponent] | (units) [^ exponent]) }
//! ```
//!
//! A unit stands only directly after a number; a name elsewhere is a parameter. A product of units
//! goes on while the next name is a unit and no parameter.

mod apply;
mod place;
mod unit_product;

use crate::Span;
use crate::diagnostic::names_help;
use crate::units;
pub(crate) use apply::{FUNCTIONS, compared};
use apply::{apply, common};
pub(crate) use place::diagnostic_within;
pub use place::expression_diagnostic;
use trilith_element::Dimension;
use trilith_element::dimension::NONE;
use unit_product::unknown_unit;

/// A value with its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// In SI; a bare number as it stands.
    pub value: f64,
    /// Its dimension.
    pub dimension: Dimension,
    /// True where a unit took part; a value without may stand for any dimension, in file units.
    pub measured: bool,
}

impl Quantity {
    /// A number without a unit.
    #[must_use]
    pub fn bare(value: f64) -> Self {
        Self { value, dimension: NONE, measured: false }
    }
}

/// An error within an expression; the span counts from the start of its text.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionError {
    /// Stable code, such as `E0108`.
    pub code: &'static str,
    /// What is wrong.
    pub message: String,
    /// What would be right.
    pub help: Option<String>,
    /// The part that is wrong.
    pub span: Span,
}

/// What an expression may refer to.
pub trait Scope {
    /// Names of all parameters.
    fn names(&self) -> Vec<&str>;
    /// True where there is a parameter of that name.
    fn has(&self, name: &str) -> bool;
    /// True where a wrong name is to be answered with the near one, for which all names are searched.
    fn suggests(&self) -> bool {
        true
    }
    /// Value of a parameter that there is, or code and message of why it has none; `Err(None)`
    /// where its own error has been told.
    ///
    /// # Errors
    /// As said.
    fn value(&mut self, name: &str) -> Result<Quantity, Option<(&'static str, String)>>;
}

pub(crate) type Parsed<T> = Result<T, Option<ExpressionError>>;

/// Evaluates an expression.
///
/// # Errors
/// What is wrong with it; none where the scope has told it already.
pub fn evaluate(text: &str, scope: &mut dyn Scope) -> Result<Quantity, Option<ExpressionError>> {
    let mut parser = Parser { text, at: 0, depth: 0, scope };
    parser.blanks();
    let value = parser.sum()?;
    if parser.at < text.len() {
        return parser.leftover();
    }
    if !value.value.is_finite() {
        let message = format!("`{text}` is {}: must be a finite number", value.value);
        return fail("E0112", message, None, 0..text.len());
    }
    Ok(value)
}

/// A quantity in SI from a text such as `5.1 in` or `2*0.3 m`; a bare number is SI. For arguments of
/// programs.
///
/// # Errors
/// A sentence that says what is wrong and what would be right.
pub fn quantity(text: &str, dimension: Dimension) -> Result<f64, String> {
    let q = match evaluate(text.trim(), &mut NoNames) {
        Ok(q) => q,
        Err(error) => {
            let whole = |e: ExpressionError| match e.help {
                Some(help) => format!("{}: {help}", e.message),
                None => e.message,
            };
            return Err(error.map_or_else(|| "not a quantity".into(), whole));
        }
    };
    if q.measured && !q.dimension.matches(dimension) {
        return Err(format!("this is in {}: must be in {}", q.dimension, dimension));
    }
    Ok(q.value)
}

/// A scope without parameters: numbers and units alone.
#[derive(Clone, Copy, Debug)]
pub struct NoNames;

impl Scope for NoNames {
    fn names(&self) -> Vec<&str> {
        Vec::new()
    }
    fn has(&self, _: &str) -> bool {
        false
    }
    fn value(&mut self, _: &str) -> Result<Quantity, Option<(&'static str, String)>> {
        Err(None)
    }
}

fn fail<T>(
    code: &'static str,
    message: impl Into<String>,
    help: Option<String>,
    span: Span,
) -> Parsed<T> {
    Err(Some(ExpressionError { code, message: message.into(), help, span }))
}

const DEPTH: usize = 64;

struct Parser<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    scope: &'a mut dyn Scope,
}

impl<'a> Parser<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn blanks(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn take(&mut self, c: char) -> bool {
        if self.peek() == Some(c) {
            self.at += c.len_utf8();
            self.blanks();
            return true;
        }
        false
    }

    /// The name at this place, without going on.
    fn name(&self) -> Option<&'a str> {
        let rest = self.rest();
        if !rest.starts_with(|c: char| c.is_alphabetic() || c == '_') {
            return None;
        }
        let end = rest
            .find(|c: char| !(c.is_alphanumeric() || c == '_') || "²³⁴".contains(c))
            .unwrap_or(rest.len());
        Some(&rest[..end])
    }

    fn skip(&mut self, bytes: usize) {
        self.at += bytes;
        self.blanks();
    }

    fn leftover<T>(&self) -> Parsed<T> {
        let here = self.at..self.text.len();
        if let Some(name) = self.name() {
            let span = self.at..self.at + name.len();
            if self.scope.has(name) || name == "pi" {
                let message = format!("an operator is missing before `{name}`");
                return fail("E0108", message, Some(format!("write `* {name}`")), span);
            }
            return unknown_unit(name, span);
        }
        let found = self.peek().unwrap_or(' ');
        fail("E0108", format!("`{found}` is not expected here"), None, here)
    }

    fn sum(&mut self) -> Parsed<Quantity> {
        let start = self.at;
        let mut a = self.product()?;
        loop {
            let sign = match self.peek() {
                Some('+') => 1.0,
                Some('-' | '−') => -1.0,
                _ => return Ok(a),
            };
            let operator = self.peek().unwrap_or('+');
            self.take(operator);
            let b = self.product()?;
            let dimension = common(&[a, b], start..self.at, "added or subtracted")?;
            let measured = a.measured || b.measured;
            a = Quantity { value: a.value + sign * b.value, dimension, measured };
        }
    }

    fn product(&mut self) -> Parsed<Quantity> {
        let mut a = self.sign()?;
        loop {
            let start = self.at;
            if self.take('*') || self.take('·') {
                let b = self.sign()?;
                a = Quantity {
                    value: a.value * b.value,
                    dimension: a.dimension * b.dimension,
                    measured: a.measured || b.measured,
                };
            } else if self.take('/') {
                let b = self.sign()?;
                if b.value == 0.0 {
                    return fail("E0112", "division by zero", None, start..self.at);
                }
                a = Quantity {
                    value: a.value / b.value,
                    dimension: a.dimension / b.dimension,
                    measured: a.measured || b.measured,
                };
            } else {
                return Ok(a);
            }
        }
    }

    fn deeper(&mut self) -> Parsed<()> {
        self.depth += 1;
        if self.depth > DEPTH {
            let message = format!("the expression is nested deeper than {DEPTH}");
            return fail("E0108", message, None, self.at..self.text.len());
        }
        Ok(())
    }

    fn sign(&mut self) -> Parsed<Quantity> {
        self.deeper()?;
        let value = if self.take('-') || self.take('−') {
            self.sign().map(|q| Quantity { value: -q.value, ..q })
        } else if self.take('+') {
            self.sign()
        } else {
            self.power()
        };
        self.depth -= 1;
        value
    }

    fn power(&mut self) -> Parsed<Quantity> {
        let base = self.atom()?;
        if !self.take('^') {
            return Ok(base);
        }
        let start = self.at;
        let e = self.sign()?;
        if !e.dimension.is_none() {
            let message =
                format!("an exponent must be a pure number, this one is in {}", e.dimension);
            return fail("E0111", message, None, start..self.at);
        }
        Ok(Quantity {
            value: base.value.powf(e.value),
            dimension: base.dimension.powf(e.value),
            measured: base.measured || e.measured,
        })
    }

    fn atom(&mut self) -> Parsed<Quantity> {
        let start = self.at;
        if self.take('(') {
            let value = self.sum()?;
            if !self.take(')') {
                let help = Some("close the parenthesis".to_owned());
                return fail("E0108", "`)` is missing", help, start..self.text.len());
            }
            return Ok(value);
        }
        if let Some(number) = self.number()? {
            return self.measure(number);
        }
        let Some(name) = self.name() else {
            let found = self.peek().map_or("the end".to_owned(), |c| format!("`{c}`"));
            let message = format!("a number, a parameter or `(` is wanted here, not {found}");
            return fail("E0108", message, None, start..self.text.len());
        };
        self.skip(name.len());
        let span = start..start + name.len();
        if self.peek() == Some('(') {
            return self.call(name, span);
        }
        if self.scope.has(name) {
            return self.scope.value(name).map_err(|told| {
                told.map(|(code, message)| ExpressionError { code, message, help: None, span })
            });
        }
        if name == "pi" {
            return Ok(Quantity::bare(std::f64::consts::PI));
        }
        let help = match units::find(name) {
            Some(_) => Some(format!("a unit stands directly after a number: `1 {name}`")),
            None if self.scope.suggests() => {
                Some(names_help(name, "parameters", self.scope.names()))
            }
            None => None,
        };
        fail("E0110", format!("there is no parameter `{name}`"), help, span)
    }

    fn call(&mut self, name: &str, span: Span) -> Parsed<Quantity> {
        if !FUNCTIONS.contains(&name) {
            let help = names_help(name, "functions", FUNCTIONS);
            return fail("E0108", format!("there is no function `{name}`"), Some(help), span);
        }
        self.take('(');
        let mut arguments = vec![self.sum()?];
        while self.take(',') {
            arguments.push(self.sum()?);
        }
        let closing = self.at + 1;
        if !self.take(')') {
            let message = format!("`)` is missing after `{name}(`");
            return fail("E0108", message, None, span.start..self.at);
        }
        apply(name, &arguments, span.start..closing)
    }
}

#[cfg(test)]
mod tests;

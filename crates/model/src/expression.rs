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

use crate::Span;
use crate::diagnostic::names_help;
use crate::units::{self, UNITS};
use trilith_element::Dimension;
use trilith_element::dimension::NONE;

/// A value with its dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Quantity {
    /// In SI; a bare number as it stands.
    pub value: f64,
    pub dimension: Dimension,
    /// True where a unit took part; a value without may stand for any dimension, in file units.
    pub measured: bool,
}

impl Quantity {
    pub fn bare(value: f64) -> Self {
        Self { value, dimension: NONE, measured: false }
    }
}

/// An error within an expression; the span counts from the start of its text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ExpressionError {
    pub code: &'static str,
    pub message: String,
    pub help: Option<String>,
    pub span: Span,
}

/// What an expression may refer to.
pub(crate) trait Scope {
    /// Names of all parameters.
    fn names(&self) -> Vec<&str>;
    /// True where there is a parameter of that name.
    fn has(&self, name: &str) -> bool;
    /// Value of a parameter that there is, or code and message of why it has none; `Err(None)`
    /// where its own error has been told.
    fn value(&mut self, name: &str) -> Result<Quantity, Option<(&'static str, String)>>;
}

type Parsed<T> = Result<T, Option<ExpressionError>>;

/// Evaluates an expression; `Err(None)` where the error has been told already.
pub(crate) fn evaluate(text: &str, scope: &mut dyn Scope) -> Parsed<Quantity> {
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

fn fail<T>(
    code: &'static str,
    message: impl Into<String>,
    help: Option<String>,
    span: Span,
) -> Parsed<T> {
    Err(Some(ExpressionError { code, message: message.into(), help, span }))
}

pub(crate) const FUNCTIONS: [&str; 13] = [
    "sqrt", "abs", "min", "max", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "ln",
];
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

    fn sign(&mut self) -> Parsed<Quantity> {
        self.depth += 1;
        if self.depth > DEPTH {
            let message = format!("the expression is nested deeper than {DEPTH}");
            return fail("E0108", message, None, self.at..self.text.len());
        }
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
        let mut help = names_help(name, "parameters", self.scope.names());
        if units::find(name).is_some() {
            help = format!("a unit stands directly after a number: `1 {name}`");
        }
        fail("E0110", format!("there is no parameter `{name}`"), Some(help), span)
    }

    /// A number without sign and unit.
    fn number(&mut self) -> Parsed<Option<f64>> {
        let bytes = self.rest().as_bytes();
        let digits = |mut i: usize| {
            while bytes.get(i).is_some_and(u8::is_ascii_digit) {
                i += 1;
            }
            i
        };
        let mut end = digits(0);
        let mut count = end;
        if bytes.get(end) == Some(&b'.') {
            let after = digits(end + 1);
            count += after - end - 1;
            end = after;
        }
        if count == 0 {
            return Ok(None);
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            let after = digits(end + 1 + sign);
            if after > end + 1 + sign {
                end = after;
            }
        }
        let word = &self.rest()[..end];
        let span = self.at..self.at + end;
        match word.parse::<f64>() {
            Ok(x) if x.is_finite() => {
                self.skip(end);
                Ok(Some(x))
            }
            _ => fail("E0112", format!("`{word}` is no finite number"), None, span),
        }
    }

    /// The units after a number, if any.
    fn measure(&mut self, number: f64) -> Parsed<Quantity> {
        let mut unit = Quantity::bare(1.0);
        let before = self.at;
        if let Some(name) = self.unit_name() {
            let span = self.at..self.at + name.len();
            match units::find(name) {
                Some(_) => unit = self.unit_power()?,
                None if self.scope.has(name) || name == "pi" => return self.leftover(),
                None => return unknown_unit(name, span),
            }
        } else {
            // `0.1 1/s` and `0.1/s`
            let one = self.rest().starts_with("1/");
            if one {
                self.at += 1;
            }
            let slash = self.peek() == Some('/');
            if slash {
                self.take('/');
            }
            if !slash || !self.unit_follows() {
                self.at = before;
                return Ok(Quantity::bare(number));
            }
            let u = self.unit_power()?;
            unit = divide(unit, u);
        }
        self.unit_product(&mut unit)?;
        Ok(Quantity { value: number * unit.value, dimension: unit.dimension, measured: true })
    }

    fn unit_name(&self) -> Option<&'a str> {
        if self.peek() == Some('%') { Some("%") } else { self.name() }
    }

    /// True where a unit follows that is no parameter.
    fn unit_follows(&self) -> bool {
        self.unit_name().is_some_and(|n| units::find(n).is_some() && !self.scope.has(n))
    }

    /// Goes on with `* unit`, `/ unit`, ` unit`, `/(units)` as far as they are units.
    fn unit_product(&mut self, unit: &mut Quantity) -> Parsed<()> {
        loop {
            let before = self.at;
            let over = self.take('/');
            let times = !over && (self.take('*') || self.take('·'));
            let factor = if self.unit_follows() {
                self.unit_power()?
            } else if let Some(group) = self.unit_group(over || times)? {
                group
            } else {
                self.at = before;
                return Ok(());
            };
            *unit = if over { divide(*unit, factor) } else { multiply(*unit, factor) };
        }
    }

    /// `(units) [^ exponent]`, where that is what follows.
    fn unit_group(&mut self, allowed: bool) -> Parsed<Option<Quantity>> {
        if !allowed || !self.take('(') || !self.unit_follows() {
            return Ok(None);
        }
        let mut unit = self.unit_power()?;
        self.unit_product(&mut unit)?;
        if !self.take(')') {
            return Ok(None);
        }
        self.exponent(unit).map(Some)
    }

    fn unit_power(&mut self) -> Parsed<Quantity> {
        let Some(name) = self.unit_name() else { return self.leftover() };
        let span = self.at..self.at + name.len();
        let Some(u) = units::find(name) else { return unknown_unit(name, span) };
        self.skip(name.len());
        self.exponent(Quantity { value: u.factor, dimension: u.dimension, measured: true })
    }

    fn exponent(&mut self, unit: Quantity) -> Parsed<Quantity> {
        for (sign, power) in [('²', 2.0), ('³', 3.0), ('⁴', 4.0)] {
            if self.take(sign) {
                return Ok(raise(unit, power));
            }
        }
        if !self.take('^') {
            return Ok(unit);
        }
        let start = self.at;
        let minus = self.take('-') || self.take('−');
        let power = match self.number()? {
            Some(x) => Quantity::bare(x),
            None => self.atom()?,
        };
        if !power.dimension.is_none() {
            return fail("E0111", "an exponent must be a pure number", None, start..self.at);
        }
        Ok(raise(unit, if minus { -power.value } else { power.value }))
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
        let whole = span.start..self.at;
        if !self.take(')') {
            return fail("E0108", format!("`)` is missing after `{name}(`"), None, whole);
        }
        apply(name, &arguments, whole)
    }
}

fn unknown_unit<T>(name: &str, span: Span) -> Parsed<T> {
    let help = if name == "lb" {
        "write `lbf` for the force or `lbm` for the mass".to_owned()
    } else {
        names_help(name, "units", UNITS.iter().map(|u| u.name))
    };
    fail("E0109", format!("there is no unit `{name}`"), Some(help), span)
}

fn multiply(a: Quantity, b: Quantity) -> Quantity {
    Quantity { value: a.value * b.value, dimension: a.dimension * b.dimension, measured: true }
}

fn divide(a: Quantity, b: Quantity) -> Quantity {
    Quantity { value: a.value / b.value, dimension: a.dimension / b.dimension, measured: true }
}

fn raise(a: Quantity, power: f64) -> Quantity {
    Quantity { value: a.value.powf(power), dimension: a.dimension.powf(power), measured: true }
}

/// The dimension that all have; an exact bare zero has any.
fn common(all: &[Quantity], span: Span, how: &str) -> Parsed<Dimension> {
    let zero = |q: &Quantity| q.value == 0.0 && !q.measured;
    let Some(first) = all.iter().find(|q| !zero(q)) else { return Ok(NONE) };
    match all.iter().find(|q| !zero(q) && !q.dimension.matches(first.dimension)) {
        None => Ok(first.dimension),
        Some(other) => {
            let (a, b) = (describe(*first), describe(*other));
            let help = "give both the same dimension, for instance with a unit after the number";
            fail("E0111", format!("{a} and {b} cannot be {how}"), Some(help.into()), span)
        }
    }
}

fn describe(q: Quantity) -> String {
    if q.dimension.is_none() {
        "a pure number".into()
    } else {
        format!("a value in {}", q.dimension)
    }
}

fn apply(name: &str, arguments: &[Quantity], span: Span) -> Parsed<Quantity> {
    let measured = arguments.iter().any(|q| q.measured);
    let count = match name {
        "min" | "max" => arguments.len().max(2),
        "atan2" => 2,
        _ => 1,
    };
    if arguments.len() != count {
        let message = format!("`{name}` takes {count} arguments, not {}", arguments.len());
        return fail("E0108", message, None, span);
    }
    let a = arguments[0];
    let values = arguments.iter().map(|q| q.value);
    let (value, dimension) = match name {
        "abs" => (a.value.abs(), a.dimension),
        "sqrt" => (a.value.sqrt(), a.dimension.powf(0.5)),
        "min" => {
            (values.fold(f64::INFINITY, f64::min), common(arguments, span.clone(), "compared")?)
        }
        "max" => {
            (values.fold(f64::NEG_INFINITY, f64::max), common(arguments, span.clone(), "compared")?)
        }
        "atan2" => {
            common(arguments, span.clone(), "compared")?;
            (a.value.atan2(arguments[1].value), NONE)
        }
        _ => {
            if !a.dimension.is_none() {
                let message = format!("`{name}` wants a pure number, not {}", describe(a));
                return fail("E0111", message, None, span);
            }
            let f: fn(f64) -> f64 = match name {
                "sin" => f64::sin,
                "cos" => f64::cos,
                "tan" => f64::tan,
                "asin" => f64::asin,
                "acos" => f64::acos,
                "atan" => f64::atan,
                "exp" => f64::exp,
                _ => f64::ln,
            };
            (f(a.value), NONE)
        }
    };
    if !value.is_finite() {
        return fail("E0112", format!("`{name}` is not defined at {}", a.value), None, span);
    }
    Ok(Quantity { value, dimension, measured })
}

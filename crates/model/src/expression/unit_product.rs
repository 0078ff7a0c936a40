//! Numbers and the units after them.

use super::{Parsed, Parser, Quantity, fail};
use crate::Span;
use crate::diagnostic::names_help;
use crate::units::{self, UNITS};

impl<'a> Parser<'a> {
    /// A number without sign and unit.
    pub(super) fn number(&mut self) -> Parsed<Option<f64>> {
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
    pub(super) fn measure(&mut self, number: f64) -> Parsed<Quantity> {
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
        self.deeper()?;
        let mut unit = self.unit_power()?;
        self.unit_product(&mut unit)?;
        self.depth -= 1;
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
}

pub(super) fn unknown_unit<T>(name: &str, span: Span) -> Parsed<T> {
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

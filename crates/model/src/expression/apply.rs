//! Functions, and sums of values with dimensions.

use super::{Parsed, Quantity, fail};
use crate::Span;
use trilith_element::Dimension;
use trilith_element::dimension::NONE;

/// The functions.
pub(crate) const FUNCTIONS: [&str; 13] = [
    "sqrt", "abs", "min", "max", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "ln",
];

/// The dimension that all have; an exact bare zero has any.
pub(super) fn common(all: &[Quantity], span: Span, how: &str) -> Parsed<Dimension> {
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

/// Refuses two values that cannot be compared.
pub(crate) fn compared(a: Quantity, b: Quantity, span: Span) -> Parsed<()> {
    common(&[a, b], span, "compared").map(|_| ())
}

fn describe(q: Quantity) -> String {
    if q.dimension.is_none() {
        "a pure number".into()
    } else {
        format!("a value in {}", q.dimension)
    }
}

pub(super) fn apply(name: &str, arguments: &[Quantity], span: Span) -> Parsed<Quantity> {
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

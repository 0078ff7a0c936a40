//! Functions in expressions.

use super::value::Number::{self, Real, Whole};

/// A function of numbers; none where it has no value.
pub fn function(name: &str, of: &[Number]) -> Result<Option<Number>, String> {
    let whole = |x: f64| (x.abs() < 9e18).then_some(Whole(x as i64));
    let count = |n: usize| {
        let said = format!("`{name}` takes {n} value{}", if n == 1 { "" } else { "s" });
        if of.len() == n { Ok(()) } else { Err(said) }
    };
    let one = |f: fn(f64) -> f64| count(1).map(|()| Some(Real(f(of[0].real()))));
    let two = |f: fn(f64, f64) -> f64| count(2).map(|()| Some(Real(f(of[0].real(), of[1].real()))));
    match name {
        "sin" => one(f64::sin),
        "cos" => one(f64::cos),
        "tan" => one(f64::tan),
        "asin" => one(f64::asin),
        "acos" => one(f64::acos),
        "atan" => one(f64::atan),
        "sinh" => one(f64::sinh),
        "cosh" => one(f64::cosh),
        "tanh" => one(f64::tanh),
        "exp" => one(f64::exp),
        "log" => one(f64::ln),
        "log10" => one(f64::log10),
        "sqrt" => one(f64::sqrt),
        "ceil" => one(f64::ceil),
        "floor" => one(f64::floor),
        "double" => one(|x| x),
        "pow" => two(f64::powf),
        "atan2" => two(f64::atan2),
        "hypot" => two(f64::hypot),
        "fmod" => two(|a, b| a % b),
        "abs" => count(1).map(|()| match of[0] {
            Whole(i) => i.checked_abs().map(Whole),
            Real(x) => Some(Real(x.abs())),
        }),
        "int" | "wide" | "entier" => count(1).map(|()| whole(of[0].real().trunc())),
        "round" => count(1).map(|()| whole(of[0].real().round())),
        "bool" => count(1).map(|()| Some(Whole(i64::from(of[0].real() != 0.0)))),
        "min" | "max" if !of.is_empty() => {
            let better = |a: Number, b: Number| {
                let less = b.real() < a.real();
                if less == (name == "min") { b } else { a }
            };
            Ok(of.iter().copied().reduce(better))
        }
        "rand" | "srand" => Err("a random number: the same script must give the same model".into()),
        _ => Err(format!("there is no function `{name}`")),
    }
}

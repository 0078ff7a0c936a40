//! Values of arguments, from text.

use trilith::element::{Dimension, dimension};
use trilith::reduce::FixedModes;

/// The uplift that a swing should keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kept {
    /// What rigid theory says.
    Housner,
    /// A share.
    Share(f64),
}

pub(super) fn rocking(text: &str) -> Result<Kept, String> {
    if text.eq_ignore_ascii_case("housner") {
        return Ok(Kept::Housner);
    }
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x < 1.0 => Ok(Kept::Share(x)),
        _ => Err("`housner` is wanted, or a number between 0 and 1".into()),
    }
}

pub(super) fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x <= 1.0 => Ok(x),
        _ => Err("a number above 0 and at most 1 is wanted".into()),
    }
}

/// Units of length and force, with a comma between them.
pub(super) fn units(text: &str) -> Result<(String, String), String> {
    const LENGTHS: [&str; 5] = ["m", "cm", "mm", "in", "ft"];
    const FORCES: [&str; 5] = ["N", "kN", "MN", "lbf", "kip"];
    match text.split(',').map(str::trim).collect::<Vec<_>>().as_slice() {
        [length, force] if LENGTHS.contains(length) && FORCES.contains(force) => {
            Ok(((*length).into(), (*force).into()))
        }
        _ => {
            Err("one of m, cm, mm, in, ft, a comma, and one of N, kN, MN, lbf, kip are wanted"
                .into())
        }
    }
}

/// Two values with a comma between them.
pub(crate) fn pair<T>(
    one: fn(&str) -> Result<T, String>,
) -> impl Fn(&str) -> Result<[T; 2], String> + Clone + Send + Sync + 'static
where
    T: 'static,
{
    move |text| match text.split(',').map(str::trim).collect::<Vec<_>>().as_slice() {
        [a, b] => Ok([one(a)?, one(b)?]),
        _ => Err("two values with a comma between them are wanted".into()),
    }
}

pub(super) fn whole(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "a whole number is wanted".into())
}

pub(super) fn length(text: &str) -> Result<f64, String> {
    above_nothing(text, dimension::LENGTH, "a length above 0 is wanted, such as `1 m`")
}

pub(super) fn stress(text: &str) -> Result<f64, String> {
    above_nothing(text, dimension::STRESS, "a stress above 0 is wanted, such as `30 GPa`")
}

pub(super) fn acceleration(text: &str) -> Result<f64, String> {
    above_nothing(
        text,
        dimension::ACCELERATION,
        "an acceleration above 0 is wanted, such as `0.4 g`",
    )
}

pub(super) fn frequency(text: &str) -> Result<f64, String> {
    above_nothing(text, dimension::FREQUENCY, "a frequency above 0 is wanted, such as `0.5 Hz`")
}

pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("NAME=VALUE is wanted, such as `mu=0.4`".into()),
    }
}

/// Factors along X, Y, Z of `x,y=0.85`.
pub(super) fn directions(text: &str) -> Result<[f64; 3], String> {
    let wrong =
        || "directions are wanted, each at most once, such as `x`, `x,y` or `x,y=0.85`".to_owned();
    let mut factors = [0.0; 3];
    for part in text.split(',') {
        let (name, factor) = part.split_once('=').unwrap_or((part, "1"));
        let axis = ["x", "y", "z"].iter().position(|n| name.trim().eq_ignore_ascii_case(n));
        let factor = factor.trim().parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0);
        match (axis, factor) {
            (Some(axis), Some(factor)) if factors[axis] == 0.0 => factors[axis] = factor,
            _ => return Err(wrong()),
        }
    }
    Ok(factors)
}

pub(super) fn count(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|n| *n > 0).ok_or_else(|| "a whole number above 0 is wanted".into())
}

/// So many modes, or all.
pub(super) fn modes(text: &str) -> Result<FixedModes, String> {
    if text.eq_ignore_ascii_case("all") {
        return Ok(FixedModes::All);
    }
    text.parse().map(FixedModes::Count).map_err(|_| "a whole number is wanted, or `all`".into())
}

pub(super) fn factor(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err("a factor above 0 is wanted, such as 0.001".into()),
    }
}

pub(super) fn alpha(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if (-1.0 / 3.0 - 1e-12..=0.0).contains(&x) => Ok(x.max(-1.0 / 3.0)),
        _ => Err("a number between -1/3 and 0 is wanted".into()),
    }
}

pub(super) fn time(text: &str) -> Result<f64, String> {
    above_nothing(
        text,
        dimension::TIME,
        "a time above 0 is wanted, such as `10 ms` or 0.01, in seconds",
    )
}

fn above_nothing(text: &str, of: Dimension, wanted: &str) -> Result<f64, String> {
    match trilith::model::quantity(text, of)? {
        x if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err(wanted.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_lengths_have_units_or_are_in_those_of_si() {
        assert_eq!([time("10 ms"), time("0.01"), length("50 cm")], [Ok(0.01), Ok(0.01), Ok(0.5)]);
        for wrong in ["0", "-1 s", "inf", "5 m", "soon"] {
            assert!(time(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn an_assignment_splits_at_the_first_equals_sign() {
        assert_eq!(assignment("mu = 0.4"), Ok(("mu".into(), "0.4".into())));
        assert_eq!(assignment("a=b=c"), Ok(("a".into(), "b=c".into())));
        assert!(assignment("mu").is_err() && assignment("=1").is_err());
    }
}

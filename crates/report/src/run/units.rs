//! Units and numbers as a reader likes them.

use super::data::Shown;

/// Below this size in SI: this unit and factor.
type Step = (f64, &'static str, f64);

/// SI units with their steps.
const STEPS: [(&str, &[Step]); 7] = [
    ("m", &[(1e-4, "µm", 1e6), (0.2, "mm", 1e3)]),
    ("rad", &[(1e-4, "µrad", 1e6), (0.1, "mrad", 1e3)]),
    ("m/s", &[(0.1, "mm/s", 1e3)]),
    ("N", &[(1e3, "N", 1.0), (1e6, "kN", 1e-3), (f64::INFINITY, "MN", 1e-6)]),
    ("N·m", &[(1e3, "N·m", 1.0), (1e6, "kN·m", 1e-3), (f64::INFINITY, "MN·m", 1e-6)]),
    ("J", &[(1e3, "J", 1.0), (1e6, "kJ", 1e-3), (f64::INFINITY, "MJ", 1e-6)]),
    ("Pa", &[(1e3, "Pa", 1.0), (1e6, "kPa", 1e-3), (f64::INFINITY, "MPa", 1e-6)]),
];

/// The unit in which values of this size are shown.
pub(crate) fn shown(unit: &str, size: f64) -> Shown {
    // A pure number has no unit.
    let unit = if unit == "1" { String::new() } else { unit.replace('*', "·") };
    let steps = STEPS.iter().find(|(si, _)| *si == unit).map_or(&[][..], |(_, s)| s);
    let step = steps.iter().find(|(below, _, _)| size < *below && size > 0.0);
    match step {
        Some((_, unit, factor)) => Shown { unit: (*unit).to_owned(), factor: *factor },
        None => Shown { unit, factor: 1.0 },
    }
}

/// A quantity and its unit in brackets, for an axis.
pub(crate) fn labelled(what: &str, shown: &Shown) -> String {
    match shown.unit.as_str() {
        "" => what.to_owned(),
        unit => format!("{what} [{unit}]"),
    }
}

/// A number with four significant digits.
pub(crate) fn number(x: f64) -> String {
    digits(x, 4)
}

/// A number with so many significant digits, in powers of ten where it is very large or small.
pub(crate) fn digits(x: f64, digits: usize) -> String {
    if x == 0.0 || !x.is_finite() {
        return if x == 0.0 { "0".into() } else { "–".into() };
    }
    let scientific = format!("{x:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let power: i32 = exponent.parse().unwrap_or(0);
    let text = match power {
        -3..=5 => format!("{x:.*}", usize::try_from(digits as i32 - 1 - power).unwrap_or(0)),
        _ => format!("{mantissa}e{power}"),
    };
    text.replace('-', "−")
}

/// A number with up to so many significant digits, without zeros at its end.
#[must_use]
pub fn short(x: f64, most: usize) -> String {
    let text = digits(x, most);
    let (mantissa, power) =
        text.split_once('e').map_or((text.as_str(), None), |(m, p)| (m, Some(p)));
    let trimmed = match mantissa.contains('.') {
        true => mantissa.trim_end_matches('0').trim_end_matches('.'),
        false => mantissa,
    };
    power.map_or(trimmed.to_owned(), |p| format!("{trimmed}e{p}"))
}

/// A share in percent.
pub(crate) fn percent(x: f64) -> String {
    // No sign before what is rounded to nothing.
    let x = if x.abs() < 5e-5 { 0.0 } else { x };
    if x.is_finite() { format!("{:.2} %", 100.0 * x).replace('-', "−") } else { "–".into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_lengths_are_millimetres_and_large_forces_kilonewtons() {
        for (unit, size, label, factor) in [
            ("m", 0.015, "mm", 1e3),
            ("m", 3.0, "m", 1.0),
            ("m", 0.0, "m", 1.0),
            ("N", 2.5e5, "kN", 1e-3),
            ("N*m", 2e7, "MN·m", 1e-6),
            ("m/s^2", 1e-9, "m/s^2", 1.0),
            ("1", 0.5, "", 1.0),
        ] {
            let s = shown(unit, size);
            assert_eq!((s.unit.as_str(), s.factor), (label, factor), "{unit} {size}");
        }
    }

    #[test]
    fn numbers_have_four_digits() {
        for (x, text) in [(12.345678, "12.35"), (-0.0012345, "−0.001234"), (1.5e-9, "1.500e−9")]
        {
            assert_eq!(number(x), text);
        }
        for (x, text) in
            [(10000.0, "10000"), (0.5, "0.5"), (5e8, "5e8"), (1.27665182e6, "1.27665e6")]
        {
            assert_eq!(short(x, 6), text);
        }
    }
}

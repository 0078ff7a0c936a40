//! Units of acceleration as the headers of records write them.

/// Standard gravity, m/s².
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// Spelling and value in m/s²; blanks and case do not count, `s²`, `s2`, `s^2`, `sec/sec` and `s/s` are
/// one.
pub(crate) const KNOWN: [(&str, f64); 10] = [
    ("g", STANDARD_GRAVITY),
    ("m/s^2", 1.0),
    ("cm/s^2", 0.01),
    ("gal", 0.01),
    ("mm/s^2", 0.001),
    ("mg", 1e-3 * STANDARD_GRAVITY),
    ("g/10", 0.1 * STANDARD_GRAVITY),
    ("in/s^2", 0.0254),
    ("ft/s^2", 0.3048),
    ("%g", 0.01 * STANDARD_GRAVITY),
];

/// The value of a unit in m/s², however it is spelt.
///
/// ```
/// assert_eq!(trilith_record::acceleration_unit("cm/sec/sec"), Some(0.01));
/// assert_eq!(trilith_record::acceleration_unit("(G)"), Some(9.80665));
/// assert_eq!(trilith_record::acceleration_unit("counts"), None);
/// ```
#[must_use]
pub fn acceleration_unit(text: &str) -> Option<f64> {
    let plain: String = text
        .to_lowercase()
        .chars()
        .filter(|c| !c.is_whitespace() && !"()[].".contains(*c))
        .collect();
    let plain = plain
        .replace("sec", "s")
        .replace('²', "^2")
        .replace("**", "^")
        .replace("/s/s", "/s^2")
        .replace("/s2", "/s^2")
        .replace("gals", "gal")
        .replace("*s^-2", "/s^2");
    KNOWN.iter().find(|(name, _)| *name == plain).map(|(_, value)| *value)
}

/// The value of a unit of time in s.
pub(crate) fn time_unit(text: &str) -> Option<f64> {
    match text.trim().to_lowercase().as_str() {
        "s" | "sec" | "second" | "seconds" => Some(1.0),
        "ms" | "msec" => Some(1e-3),
        "min" => Some(60.0),
        _ => None,
    }
}

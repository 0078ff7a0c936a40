//! Units in text, such as `N·s/m`, as exponents of mass, length and time.

/// Exponents of kilogram, metre and second.
pub(crate) type Exponents = [i32; 3];

/// What a unit of a field may be made of.
const ATOMS: [(&str, Exponents); 11] = [
    ("1", [0, 0, 0]),
    ("rad", [0, 0, 0]),
    ("K", [0, 0, 0]),
    ("kg", [1, 0, 0]),
    ("m", [0, 1, 0]),
    ("s", [0, 0, 1]),
    ("Hz", [0, 0, -1]),
    ("N", [1, 1, -2]),
    ("Pa", [1, -1, -2]),
    ("J", [1, 2, -2]),
    ("W", [1, 2, -3]),
];

/// The dimension of a unit of SI without prefixes: factors joined by `·`, and one `/` with a product after it.
///
/// # Errors
/// What is no unit, and what may be.
pub(crate) fn parse(text: &str) -> Result<Exponents, String> {
    let (above, below) = text.split_once('/').map_or((text, None), |(a, b)| (a, Some(b)));
    let mut sum = product(above, text)?;
    if let Some(below) = below {
        let inner = below.strip_prefix('(').and_then(|b| b.strip_suffix(')')).unwrap_or(below);
        for (total, e) in sum.iter_mut().zip(product(inner, text)?) {
            *total -= e;
        }
    }
    Ok(sum)
}

fn product(factors: &str, whole: &str) -> Result<Exponents, String> {
    let mut sum = [0; 3];
    for factor in factors.split('·') {
        let (name, power) = powered(factor);
        let Some((_, exponents)) = ATOMS.iter().find(|(atom, _)| *atom == name) else {
            let known: Vec<_> = ATOMS.iter().map(|(atom, _)| *atom).collect();
            return Err(format!(
                "`{factor}` in the unit `{whole}` is none of {}: a unit is a product such as `N·s/m` or `s/(m·N²)`",
                known.join(", ")
            ));
        };
        for (total, e) in sum.iter_mut().zip(exponents) {
            *total += power * e;
        }
    }
    Ok(sum)
}

/// `m²` as `m` and 2.
fn powered(factor: &str) -> (&str, i32) {
    const POWERS: [(char, i32); 3] = [('²', 2), ('³', 3), ('⁴', 4)];
    let found = POWERS.iter().find_map(|(sign, n)| Some((factor.strip_suffix(*sign)?, *n)));
    found.unwrap_or((factor, 1))
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn units_are_exponents() {
        assert_eq!(parse("N·s/m"), Ok([1, 0, -1]));
        assert_eq!(parse("s/(m·N²)"), Ok([-2, -3, 5]));
        assert_eq!(parse("1/Pa"), Ok([-1, 1, 2]));
        assert_eq!(parse("m⁴"), Ok([0, 4, 0]));
        assert_eq!(parse("N·m/rad"), Ok([1, 2, -2]));
    }

    #[test]
    fn what_is_no_unit_is_named() {
        for wrong in ["kN", "N s", "", "m/s/s", "N^2"] {
            let error = parse(wrong).unwrap_err();
            assert!(error.contains(wrong) && error.contains("kg"), "{error}");
        }
    }
}

//! How far something is from equilibrium, in words.

/// A part of a sentence: what is farthest off, and by how much, in N or N·m; `unit` follows the number as it is.
/// A residual that is no finite number says that the values themselves are none.
pub(crate) fn imbalance(worst: &str, residual: f64, unit: &str) -> String {
    if residual.is_finite() {
        return format!("{worst} is off by {residual:.3e}{unit}");
    }
    format!(
        "{worst} has values that are no finite numbers: a load, a motion, a mass or a stiffness is too large or too small to compute with"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_said_to_be_none() {
        assert_eq!(imbalance("\"foot\" U1", 12.5, " N"), "\"foot\" U1 is off by 1.250e1 N");
        for residual in [f64::NAN, f64::INFINITY] {
            let text = imbalance("the structure", residual, "");
            assert!(
                text.starts_with("the structure has values that are no finite numbers"),
                "{text}"
            );
        }
    }
}

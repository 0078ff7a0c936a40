//! Checks that several kinds share.

use trilith_element::ParameterError;

/// Refuses a list that holds a negative number.
pub(crate) fn none_negative(name: &str, values: &[f64], unit: &str) -> Result<(), ParameterError> {
    match values.iter().find(|x| **x < 0.0) {
        Some(value) => Err(ParameterError::OutOfRange {
            name: name.to_owned(),
            value: *value,
            unit: unit.to_owned(),
            allowed: "≥ 0".to_owned(),
        }),
        None => Ok(()),
    }
}

/// Reading of a kind from the numbers of a model file, for tests: defaults come from the card.
#[cfg(test)]
pub(crate) fn read<T: trilith_element::Described>(
    given: &[(&str, trilith_element::Value)],
) -> Result<T, ParameterError> {
    use trilith_element::{Default, Value, Values};
    let mut values: Vec<_> = given.iter().map(|(n, v)| ((*n).to_owned(), v.clone())).collect();
    for p in T::CARD.parameters {
        if given.iter().any(|(n, _)| *n == p.name) {
            continue;
        }
        let default = match p.default {
            Default::Required | Default::Absent => continue,
            Default::Number(x) => Value::Number(x),
            Default::Choice(c) => Value::Text(c.to_owned()),
            Default::Flag(b) => Value::Flag(b),
        };
        values.push((p.name.to_owned(), default));
    }
    let it: T = Values(values).read()?;
    it.check()?;
    Ok(it)
}

/// Shorthand for numbers of a model file, for tests.
#[cfg(test)]
pub(crate) fn numbers<'a>(given: &[(&'a str, f64)]) -> Vec<(&'a str, trilith_element::Value)> {
    given.iter().map(|(n, x)| (*n, trilith_element::Value::Number(*x))).collect()
}

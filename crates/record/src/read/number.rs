//! The one reader of numbers, for all formats.
//!
//! A number has a decimal point. What commas mean cannot be told in general: `0,005` may be five thousandths or
//! a nought and a five. So a comma parts two numbers only where both have a point; any other within a number is
//! an error.

use crate::error::Problem;

/// A finite number as Fortran and others write it: `1.0D-3` too.
pub(super) fn number(text: &str) -> Result<f64, Problem> {
    match parsed(text).filter(|x| x.is_finite()) {
        Some(x) => Ok(x),
        None if with_comma(text) => Err(Problem::DecimalComma(text.to_owned())),
        None => Err(Problem::NotANumber(text.to_owned())),
    }
}

/// True for a number, a finite one or not, and for what would be one without its commas.
pub(super) fn like_number(text: &str) -> bool {
    parsed(text).is_some() || with_comma(text)
}

fn parsed(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| text.replace(['d', 'D'], "e").parse().ok())
}

/// A number with commas in it, such as `0,005` or `1,234.5`.
pub(super) fn with_comma(text: &str) -> bool {
    text.contains(',')
        && text.contains(|c: char| c.is_ascii_digit())
        && text.chars().all(|c| c.is_ascii_digit() || ",.+-eEdD".contains(c))
}

/// The words of a line, parted by blanks, and by commas where these part numbers.
pub(super) fn words(line: &str) -> Vec<&str> {
    let mut all = Vec::new();
    for word in line.split([' ', '\t', '\r']) {
        let word = word.trim_matches(',');
        if word.split(',').all(|part| part.contains('.')) {
            all.extend(word.split(','));
        } else if !word.is_empty() {
            all.push(word);
        }
    }
    all
}

/// The first number at or behind a place of a text, with a point before or within it: ` .005 sec`; and what
/// stands behind it.
pub(super) fn first_number(text: &str) -> Result<Option<(f64, &str)>, Problem> {
    let Some(start) = text.find(|c: char| c.is_ascii_digit() || c == '-' || c == '.') else {
        return Ok(None);
    };
    let rest = &text[start..];
    let end = rest
        .char_indices()
        .find(|(i, c)| {
            let exponent = matches!(c, 'e' | 'E')
                && rest[i + 1..].starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+');
            let sign = (*c == '-' || *c == '+') && (*i == 0 || rest[..*i].ends_with(['e', 'E']));
            !(c.is_ascii_digit() || *c == '.' || exponent || sign)
        })
        .map_or(rest.len(), |(i, _)| i);
    let behind = &rest[end..];
    let fraction = behind.strip_prefix(',').unwrap_or_default();
    let digits = fraction.find(|c: char| !c.is_ascii_digit()).unwrap_or(fraction.len());
    if digits > 0 {
        return Err(Problem::DecimalComma(rest[..end + 1 + digits].to_owned()));
    }
    // A full stop behind the number is none of it.
    let found = rest[..end].parse().or_else(|_| rest[..end].trim_end_matches('.').parse());
    Ok(found.ok().map(|x: f64| (x, behind)))
}

/// Index of the first cell of a row parted by commas that shows that the commas are decimal ones: all cells are
/// digits without a point, and one begins with a nought that counts (`0,005`), or there are more of them than
/// names in the header.
pub(super) fn decimal_comma(cells: &[String], names: Option<usize>) -> Option<usize> {
    let plain = |c: &String| {
        let mantissa = c.split(['e', 'E']).next().unwrap_or_default();
        let digits = mantissa.strip_prefix(['-', '+']).unwrap_or(mantissa);
        !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
    };
    let filled = cells.iter().rposition(|c| !c.is_empty()).map_or(0, |i| i + 1);
    let cells = &cells[..filled];
    if cells.len() < 2 || !cells.iter().all(plain) {
        return None;
    }
    let nought = |c: &String| c.len() > 1 && c.starts_with('0') && c.as_bytes()[1].is_ascii_digit();
    let shown = (1..cells.len()).find(|i| nought(&cells[*i]));
    shown.or_else(|| names.filter(|n| *n < cells.len()).map(|_| 1)).map(|i| i - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_finite_and_has_a_point() {
        assert_eq!(number("1.0D-3"), Ok(1e-3));
        assert_eq!(number("-.5"), Ok(-0.5));
        for text in ["NaN", "inf", "1e400", "******", ""] {
            assert_eq!(number(text), Err(Problem::NotANumber(text.into())), "{text}");
        }
        for text in ["0,005", "-0,4", "1.234,5", "1,234.5", "1,2E-3", ",5"] {
            assert_eq!(number(text), Err(Problem::DecimalComma(text.into())), "{text}");
        }
    }

    #[test]
    fn commas_part_numbers_with_points_only() {
        assert_eq!(words(" 0.1,0.2, -3.,4 "), ["0.1", "0.2", "-3.,4"]);
        assert_eq!(words("0.1,\t1 2,"), ["0.1", "1", "2"]);
    }

    #[test]
    fn numbers_are_found_in_sentences() {
        let found = |text| first_number(text).map(|x| x.map(|x| x.0));
        assert_eq!(found("at  .005 sec, in"), Ok(Some(0.005)));
        assert_eq!(found("= -267.957 CM"), Ok(Some(-267.957)));
        assert_eq!(found("1.2E-03x"), Ok(Some(1.2e-3)));
        assert_eq!(found("12, then"), Ok(Some(12.0)));
        assert_eq!(found("none"), Ok(None));
        assert_eq!(found("at 0,005 sec"), Err(Problem::DecimalComma("0,005".into())));
    }

    #[test]
    fn rows_of_digits_show_decimal_commas() {
        let row = |text: &str| text.split(',').map(str::to_owned).collect::<Vec<_>>();
        let shown = |text: &str, names| decimal_comma(&row(text), names);
        assert_eq!(shown("0,01,0,5", None), Some(0));
        assert_eq!(shown("1,5,0,4", Some(2)), Some(0));
        assert_eq!(shown("1,5,0,4", Some(4)), None);
        assert_eq!(shown("1,5,0,4", None), None);
        assert_eq!(shown("0,005", None), Some(0));
        assert_eq!(shown("0.5,010,3", Some(2)), None);
        assert_eq!(shown("1,2,", Some(2)), None);
    }
}

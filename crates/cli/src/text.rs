//! Numbers and tables as text.

use trilith::model::visible_line;
pub(crate) use trilith_diagnostics::shown;

/// A number with five significant digits.
pub(crate) fn number(x: f64) -> String {
    significant(x, 5)
}

/// A number with so many significant digits, in powers of ten where it is very large or small.
pub(crate) fn significant(x: f64, digits: usize) -> String {
    if x == 0.0 || !x.is_finite() {
        return if x == 0.0 { "0".into() } else { x.to_string() };
    }
    let scientific = format!("{x:.*e}", digits - 1);
    let exponent: i32 = scientific.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
    if !(-4..6).contains(&exponent) {
        return scientific;
    }
    let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
    format!("{x:.decimals$}")
}

/// A number with all its digits, in powers of ten where it is very large or small.
pub(crate) fn exact(x: f64) -> String {
    match x.abs() {
        size if size == 0.0 || (1e-5..1e7).contains(&size) => x.to_string(),
        _ => format!("{x:e}"),
    }
}

/// A share in percent.
pub(crate) fn percent(x: f64) -> String {
    if x.is_finite() { format!("{:.2} %", 100.0 * x) } else { "–".into() }
}

/// Rows of cells, the first one a head; the columns named in `left` are flush left.
pub(crate) fn table(rows: &[Vec<String>], left: &[usize]) -> String {
    // Written out before it is measured: the columns line up.
    let cell = |cell: &String| visible_line(cell).into_owned();
    let rows: Vec<Vec<String>> = rows.iter().map(|r| r.iter().map(cell).collect()).collect();
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c: usize| {
        rows.iter().filter_map(|r| r.get(c)).map(|s| s.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut out = String::new();
    for row in &rows {
        let cells = row.iter().zip(&widths).enumerate().map(|(c, (cell, width))| {
            let space = " ".repeat(width - cell.chars().count());
            if left.contains(&c) { format!("{cell}{space}") } else { format!("{space}{cell}") }
        });
        let line = cells.collect::<Vec<_>>().join("  ");
        out += &format!("  {}\n", line.trim_end());
    }
    out
}

/// Cells of a row.
pub(crate) fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

/// `did you mean …?`, or the list of what there is.
pub(crate) fn names_help<'a>(
    name: &str,
    what: &str,
    candidates: impl Iterator<Item = &'a str> + Clone,
) -> String {
    let lower = name.to_lowercase();
    let near = candidates
        .clone()
        .map(|c| (strsim::damerau_levenshtein(&lower, &c.to_lowercase()), c))
        .filter(|(d, c)| *d <= (name.chars().count().max(c.chars().count()) / 3).max(1))
        .min_by_key(|(d, _)| *d);
    if let Some((_, c)) = near {
        return format!("did you mean `{c}`?");
    }
    let all: Vec<String> = candidates.map(|c| format!("`{c}`")).collect();
    format!("the {what} are {}", all.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_five_significant_digits() {
        let cases = [(0.0, "0"), (12.3456789, "12.346"), (0.00123456, "0.0012346")];
        for (x, text) in cases.into_iter().chain([(-123456.7, "-123457"), (1.5e-9, "1.5000e-9")]) {
            assert_eq!(number(x), text);
        }
    }

    #[test]
    fn all_digits_are_no_more_than_there_are() {
        let cases = [(0.0, "0"), (0.02, "0.02"), (1.0, "1"), (1e-300, "1e-300")];
        for (x, text) in cases.into_iter().chain([(-1.25e300, "-1.25e300"), (1e6, "1000000")]) {
            assert_eq!(exact(x), text);
        }
    }

    #[test]
    fn columns_of_a_table_line_up() {
        let rows = [row(["name", "max"]), row(["µ", "10.5"])];
        assert_eq!(table(&rows, &[0]), "  name   max\n  µ     10.5\n");
    }

    #[test]
    fn names_in_a_table_stay_in_their_cells() {
        let rows = [row(["name", "max"]), row(["a\u{1b}\nb", "1"])];
        assert_eq!(table(&rows, &[0]), "  name        max\n  a\\u{1b}\\nb    1\n");
    }
}

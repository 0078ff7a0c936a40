//! Tables of text.

use std::fmt::Write as _;

/// Rows with a head, for the terminal and for pages.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Table {
    pub head: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new<const N: usize>(head: [&str; N]) -> Self {
        Self { head: head.map(str::to_owned).to_vec(), rows: Vec::new() }
    }

    pub fn row<const N: usize>(&mut self, cells: [String; N]) {
        self.rows.push(cells.to_vec());
    }

    /// Aligned columns: the first to the left, the others to the right.
    pub fn text(&self) -> String {
        let lines = || std::iter::once(&self.head).chain(&self.rows);
        let width = |c: usize| {
            lines().filter_map(|l| l.get(c)).map(|s| s.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        let mut out = String::new();
        for line in lines() {
            for (c, (cell, w)) in line.iter().zip(&widths).enumerate() {
                let pad = " ".repeat(w - cell.chars().count());
                let _ =
                    if c == 0 { write!(out, "{cell}{pad}") } else { write!(out, "  {pad}{cell}") };
            }
            out.truncate(out.trim_end().len());
            out.push('\n');
        }
        out
    }

    /// As Markdown.
    pub fn markdown(&self) -> String {
        let mut out =
            format!("| {} |\n|{}\n", self.head.join(" | "), "---|".repeat(self.head.len()));
        for row in &self.rows {
            let _ = writeln!(out, "| {} |", row.join(" | "));
        }
        out
    }
}

/// Three digits.
pub(crate) fn short(x: f64) -> String {
    if !x.is_finite() {
        return "–".into();
    }
    if x == 0.0 {
        return "0".into();
    }
    let digits = 2 - x.abs().log10().floor() as i32;
    match digits {
        0..=6 => format!("{x:.*}", digits as usize),
        -4..0 => {
            let unit = 10_f64.powi(-digits);
            format!("{:.0}", (x / unit).round() * unit)
        }
        _ => format!("{x:.2e}"),
    }
}

/// In per cent.
pub(crate) fn percent(x: f64) -> String {
    if x.abs() < 1e-4 { format!("{:.1e} %", 100.0 * x) } else { format!("{} %", short(100.0 * x)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let all = [0.0, 1.0, 12.345, 123.45, 1234.5, 123_456.0, 0.001_234_5, 1.2345e-9, f64::NAN];
        let text = ["0", "1.00", "12.3", "123", "1230", "123000", "0.00123", "1.23e-9", "–"];
        assert_eq!(all.map(short), text);
        assert_eq!((percent(0.0123), percent(-1.5e-7)), ("1.23 %".into(), "-1.5e-5 %".into()));
    }

    #[test]
    fn columns_are_aligned() {
        let mut table = Table::new(["a", "µs"]);
        table.row(["long".into(), "1.0".into()]);
        assert_eq!(table.text(), "a      µs\nlong  1.0\n");
        assert_eq!(table.markdown(), "| a | µs |\n|---|---|\n| long | 1.0 |\n");
    }
}

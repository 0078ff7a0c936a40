//! Texts in tables that a spreadsheet may open.

use crate::visible;
use std::borrow::Cow;

/// A text for a cell of a CSV file. What a spreadsheet would take for a formula (it begins with `=`, `+`, `-` or `@`,
/// with a tab or the end of a line) gets an apostrophe in front, which says that it is a text; numbers stay numbers. What
/// a terminal would obey is written out, as [`visible`] does.
/// Quotes around cells with commas are left to who writes the file.
///
/// ```
/// assert_eq!(trilith_record::cell("=1+1 [m]"), "'=1+1 [m]");
/// assert_eq!(trilith_record::cell("-1.5"), "-1.5");
/// ```
#[must_use]
pub fn cell(text: &str) -> Cow<'_, str> {
    // The wide signs of East Asian keyboards count as the others.
    const SIGNS: [char; 11] =
        ['=', '+', '-', '@', '\t', '\r', '\n', '\u{ff1d}', '\u{ff0b}', '\u{ff0d}', '\u{ff20}'];
    if text.starts_with(SIGNS) && text.parse::<f64>().is_err() {
        return Cow::Owned(format!("'{}", visible(text)));
    }
    visible(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_begins_as_a_formula_is_marked_as_a_text() {
        for text in
            ["=cmd|'/c calc'!A1", "+a [m]", "-a", "@SUM(1)", "\t=1", "\n=1", "＝1", "+2 [m]"]
        {
            assert_eq!(cell(text), format!("'{text}"));
        }
        assert_eq!(cell("\r=1\u{1b}[2J"), "'\\r=1\\u{1b}[2J");
    }

    #[test]
    fn what_a_terminal_would_obey_is_written_out() {
        assert_eq!(cell("a\u{1b}]0;x\u{7}"), "a\\u{1b}]0;x\\u{7}");
    }

    #[test]
    fn numbers_and_plain_texts_stay() {
        for text in ["-1.5", "+2", "-2e-3", "-inf", "", "a = b", "slide [m]", "a-b", "'a"] {
            assert!(matches!(cell(text), Cow::Borrowed(t) if t == text), "{text}");
        }
    }
}

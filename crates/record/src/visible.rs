//! Names and other texts of a user, as a terminal or a page may show them.

use std::borrow::Cow;

/// A text of which nothing is obeyed where it is shown: control characters, and those that turn the direction of what
/// follows, are written as a model file writes them (`\u{1b}`). Ends of lines and tabs stay.
///
/// ```
/// assert_eq!(trilith_record::visible("a\u{1b}[31m\nb"), "a\\u{1b}[31m\nb");
/// ```
#[must_use]
pub fn visible(text: &str) -> Cow<'_, str> {
    escaped(text, |c| !matches!(c, '\n' | '\t') && acts(c))
}

/// The same for a text that has to stay within its line, such as a name: ends of lines and tabs are written, too.
///
/// ```
/// assert_eq!(trilith_record::visible_line("a\nb"), "a\\nb");
/// ```
#[must_use]
pub fn visible_line(text: &str) -> Cow<'_, str> {
    escaped(text, acts)
}

/// True of a character that a terminal obeys, or that turns the direction of writing.
fn acts(c: char) -> bool {
    c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

fn escaped(text: &str, which: fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(which) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match c {
            _ if !which(c) => out.push(c),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            _ => out.extend(c.escape_unicode()),
        }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_written_out() {
        let text = "µ\u{1b}]0;x\u{7}\u{9b}31m\u{202e}\r\u{7f} é";
        assert_eq!(visible(text), "µ\\u{1b}]0;x\\u{7}\\u{9b}31m\\u{202e}\\r\\u{7f} é");
        assert_eq!(visible_line("a\nb\tc"), "a\\nb\\tc");
    }

    #[test]
    fn other_texts_stay_as_they_are() {
        for text in ["", "foot left", "größe µ ½ → 🙂", "a\nb\tc", "שלום"] {
            assert!(matches!(visible(text), Cow::Borrowed(t) if t == text), "{text}");
        }
    }
}

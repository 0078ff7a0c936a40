//! Places of a text as the protocol counts them: lines, and within these bytes or units of UTF-16.

use lsp_types::{Position, PositionEncodingKind, Range};

/// In what the columns are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Encoding {
    Utf8,
    #[default]
    Utf16,
}

impl Encoding {
    /// UTF-8 where the client offers it; else what the protocol says.
    pub fn chosen(offered: Option<&[PositionEncodingKind]>) -> Self {
        let utf8 = offered.is_some_and(|all| all.contains(&PositionEncodingKind::UTF8));
        if utf8 { Self::Utf8 } else { Self::Utf16 }
    }

    pub fn kind(self) -> PositionEncodingKind {
        match self {
            Self::Utf8 => PositionEncodingKind::UTF8,
            Self::Utf16 => PositionEncodingKind::UTF16,
        }
    }

    fn width(self, c: char) -> usize {
        match self {
            Self::Utf8 => c.len_utf8(),
            Self::Utf16 => c.len_utf16(),
        }
    }
}

/// Where the lines of a text begin.
#[derive(Clone, Debug)]
pub(crate) struct Lines {
    starts: Vec<usize>,
    encoding: Encoding,
}

impl Lines {
    /// Lines end with `\n`, `\r\n` or `\r`.
    pub fn new(text: &str, encoding: Encoding) -> Self {
        let bytes = text.as_bytes();
        let ends = |i: &usize| match bytes[*i] {
            b'\n' => true,
            b'\r' => bytes.get(i + 1) != Some(&b'\n'),
            _ => false,
        };
        let starts = (0..bytes.len()).filter(ends).map(|i| i + 1);
        Self { starts: std::iter::once(0).chain(starts).collect(), encoding }
    }

    /// The byte of a position. Behind the end of a line lies its end, behind the last line that of the text; within a
    /// character, its beginning.
    pub fn byte(&self, text: &str, position: Position) -> usize {
        let line = position.line as usize;
        let Some(&start) = self.starts.get(line) else { return text.len() };
        let end = self.starts.get(line + 1).copied().unwrap_or(text.len());
        let content = text.get(start..end).unwrap_or_default().trim_end_matches(['\n', '\r']);
        let mut left = position.character as usize;
        for (i, c) in content.char_indices() {
            let width = self.encoding.width(c);
            if left < width {
                return start + i;
            }
            left -= width;
        }
        start + content.len()
    }

    /// The position of a byte; within a character, that of its beginning.
    pub fn position(&self, text: &str, byte: usize) -> Position {
        let mut byte = byte.min(text.len());
        while !text.is_char_boundary(byte) {
            byte -= 1;
        }
        let line = self.starts.partition_point(|start| *start <= byte).saturating_sub(1);
        let before = text.get(self.starts[line]..byte).unwrap_or_default();
        let character: usize = before.chars().map(|c| self.encoding.width(c)).sum();
        let counted = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Position::new(counted(line), counted(character))
    }

    /// The range of these bytes.
    pub fn range(&self, text: &str, span: &std::ops::Range<usize>) -> Range {
        Range::new(self.position(text, span.start), self.position(text, span.end.max(span.start)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_counted_as_agreed() {
        let text = "a\r\nfuß 🦶 b\rc\n";
        let foot = text.find("🦶").unwrap();
        let b = text.find('b').unwrap();
        for (encoding, at_foot, at_b) in [(Encoding::Utf16, 4, 7), (Encoding::Utf8, 5, 10)] {
            let lines = Lines::new(text, encoding);
            let at = |byte| lines.position(text, byte);
            assert_eq!(at(foot), Position::new(1, at_foot));
            assert_eq!(at(b), Position::new(1, at_b));
            assert_eq!(at(b + 2), Position::new(2, 0));
            assert_eq!(at(foot + 2), at(foot));
            assert_eq!(at(text.len() + 9), Position::new(3, 0));
            for (i, _) in text.char_indices().filter(|(_, c)| !c.is_control()) {
                assert_eq!(lines.byte(text, at(i)), i);
            }
            // In the middle of the foot, behind the line, behind the text.
            assert_eq!(lines.byte(text, Position::new(1, at_foot + 1)), foot);
            assert_eq!(lines.byte(text, Position::new(1, 99)), b + 1);
            assert_eq!(lines.byte(text, Position::new(9, 9)), text.len());
        }
    }
}

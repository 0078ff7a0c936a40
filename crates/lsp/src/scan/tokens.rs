//! Words, texts and brackets of a text.

/// Bytes of a text.
pub(crate) type Span = std::ops::Range<usize>;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Token {
    /// A name, a number, `true`.
    Word,
    /// In quotes; where its content stands, and whether the quotes end.
    Text {
        inner: (usize, usize),
        closed: bool,
    },
    /// `(`, `[` or `{`.
    Open(u8),
    /// `)`, `]` or `}`.
    Close(u8),
    Colon,
    Comma,
    /// A comment; one to the end of its line goes on at that end.
    Comment {
        line: bool,
    },
}

/// The tokens of a text, comments among them, blanks left out.
pub(crate) struct Tokens<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Tokens<'t> {
    pub fn new(text: &'t str) -> Self {
        Self { text, at: text.len() - text.trim_start_matches('\u{feff}').len() }
    }

    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    /// Length of the raw text that `rest` begins with, its content, and whether it ends.
    fn raw(rest: &str) -> Option<(usize, (usize, usize), bool)> {
        let hashes = rest.strip_prefix('r')?.bytes().take_while(|b| *b == b'#').count();
        let start = 1 + hashes + 1;
        if rest.as_bytes().get(start - 1) != Some(&b'"') {
            return None;
        }
        let end = format!("\"{}", "#".repeat(hashes));
        Some(match rest[start..].find(&end) {
            Some(length) => (start + length + end.len(), (start, start + length), true),
            None => (rest.len(), (start, rest.len()), false),
        })
    }

    /// The same of a plain text.
    fn plain(rest: &str) -> (usize, (usize, usize), bool) {
        let mut escaped = false;
        for (i, c) in rest.char_indices().skip(1) {
            match c {
                _ if escaped => escaped = false,
                '\\' => escaped = true,
                '"' => return (i + 1, (1, i), true),
                '\n' | '\r' => return (i, (1, i), false),
                _ => {}
            }
        }
        (rest.len(), (1, rest.len()), false)
    }

    fn block_comment(rest: &str) -> usize {
        let (bytes, mut depth, mut i) = (rest.as_bytes(), 0_usize, 0);
        while i + 1 < bytes.len() {
            match &bytes[i..i + 2] {
                b"/*" => (depth, i) = (depth + 1, i + 2),
                b"*/" => {
                    (depth, i) = (depth - 1, i + 2);
                    if depth == 0 {
                        return i;
                    }
                }
                _ => i += 1,
            }
        }
        rest.len()
    }
}

impl Iterator for Tokens<'_> {
    type Item = (Token, Span);

    fn next(&mut self) -> Option<Self::Item> {
        self.at += self.rest().len() - self.rest().trim_start().len();
        let rest = self.rest();
        let first = rest.chars().next()?;
        let start = self.at;
        let (token, length) = match first {
            '(' | '[' | '{' => (Token::Open(first as u8), 1),
            ')' | ']' | '}' => (Token::Close(first as u8), 1),
            ':' => (Token::Colon, 1),
            ',' => (Token::Comma, 1),
            _ if rest.starts_with("//") => {
                (Token::Comment { line: true }, rest.find('\n').unwrap_or(rest.len()))
            }
            _ if rest.starts_with("/*") => {
                (Token::Comment { line: false }, Self::block_comment(rest))
            }
            // What a file enables of RON.
            _ if rest.starts_with("#![") => {
                (Token::Comment { line: false }, rest.find(']').map_or(rest.len(), |i| i + 1))
            }
            _ => {
                let text = if first == '"' { Some(Self::plain(rest)) } else { Self::raw(rest) };
                match text {
                    Some((length, inner, closed)) => {
                        let inner = (start + inner.0, start + inner.1);
                        (Token::Text { inner, closed }, length)
                    }
                    None => {
                        let ends = |c: char| c.is_whitespace() || "()[]{}:,\"".contains(c);
                        let end = rest.find(ends).unwrap_or(rest.len());
                        let comment = rest[..end].find("//").or_else(|| rest[..end].find("/*"));
                        (Token::Word, comment.unwrap_or(end))
                    }
                }
            }
        };
        self.at += length;
        Some((token, start..start + length))
    }
}

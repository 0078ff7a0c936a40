//! Numbers and lists of plain numbers, read at once.
//!
//! What is not obviously one is left to `ron`, and with that every error.

use super::{Kind, Node};

/// Lists in lists deeper than this are left to `ron`.
const DEPTH: usize = 8;

/// The value, if `part` is a number or a list of numbers without comments; `at`: where it stands.
pub(super) fn read(part: &str, at: usize) -> Option<Node> {
    let mut cursor = Cursor { text: part, next: 0, at };
    let node = cursor.value(0)?;
    (cursor.next == part.len()).then_some(node)
}

/// The list of numbers that `text` begins with.
pub(super) fn list(text: &str, at: usize) -> Option<Node> {
    Cursor { text, next: 0, at }.value(0)
}

struct Cursor<'a> {
    text: &'a str,
    next: usize,
    at: usize,
}

impl Cursor<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.next).copied()
    }

    fn skip_blanks(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.next += 1;
        }
    }

    fn value(&mut self, depth: usize) -> Option<Node> {
        let start = self.next;
        let kind = match self.peek()? {
            b'[' if depth < DEPTH => self.list(b']', 1, depth)?,
            // Of no or one value it could be something else.
            b'(' if depth < DEPTH => self.list(b')', 2, depth)?,
            b'0'..=b'9' | b'-' | b'+' | b'.' => self.number()?,
            _ => return None,
        };
        Some(Node { span: self.at + start..self.at + self.next, kind })
    }

    fn number(&mut self) -> Option<Kind> {
        let start = self.next;
        while matches!(self.peek(), Some(b'0'..=b'9' | b'-' | b'+' | b'.' | b'e' | b'E')) {
            self.next += 1;
        }
        self.text[start..self.next].parse().ok().map(Kind::Number)
    }

    fn list(&mut self, close: u8, least: usize, depth: usize) -> Option<Kind> {
        let mut items = Vec::new();
        self.next += 1;
        loop {
            self.skip_blanks();
            if self.peek()? == close {
                break;
            }
            items.push(self.value(depth + 1)?);
            self.skip_blanks();
            match self.peek()? {
                b',' => self.next += 1,
                end if end == close => break,
                _ => return None,
            }
        }
        self.next += 1;
        (items.len() >= least).then_some(Kind::List(None, items))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_numbers_are_read_with_their_places() {
        let text = "[(0, 1.5e-3),\n ( -1 ,+2., ), 7,]";
        let node = read(text, 10).unwrap();
        assert_eq!(node.span, 10..10 + text.len());
        let items = node.items();
        let numbers = |n: &Node| -> Vec<f64> {
            let number = |n: &&Node| if let Kind::Number(x) = n.kind { x } else { f64::NAN };
            n.items().iter().map(number).collect()
        };
        assert_eq!(numbers(items[0]), [0.0, 1.5e-3]);
        assert_eq!(numbers(items[1]), [-1.0, 2.0]);
        let inner = items[0].items()[1];
        assert_eq!(&text[inner.span.start - 10..inner.span.end - 10], "1.5e-3");
        assert!(items[2].span == (10 + text.len() - 3..10 + text.len() - 2));
    }

    #[test]
    fn everything_else_is_left_to_ron() {
        let deep = format!("{}1{}", "[".repeat(99), "]".repeat(99));
        for text in [
            "",
            "()",
            "[]",
            "(1)",
            "[1 2]",
            "[1,,2]",
            "[1",
            "[1]]",
            "1_000",
            "0x1f",
            "inf",
            "1.5f64",
            "1.2.3",
            "-",
            "[,]",
            "[1, x]",
            "(a: 1)",
            "[1, /* two */ 2]",
            "\"1\"",
            "[\"1\"]",
            &deep,
        ] {
            assert!(read(text, 0).is_none(), "{text}");
        }
    }
}

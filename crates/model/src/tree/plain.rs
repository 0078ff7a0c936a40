//! Long lists of plain numbers, such as a record in a model file, read before everything else.
//!
//! Going down level by level, `ron` reads what is inside a value again at every level. In the text that it gets,
//! long lists of numbers are blank; all else stands where it stood.

use super::{Node, numeric};
use std::collections::HashMap;

/// Shorter lists are left where they are.
const LONG: usize = 256;

/// Lists by the byte that they begin at.
pub(super) type Lists = HashMap<usize, Node>;

/// The text with blanks in place of the numbers of long lists, and these lists.
pub(super) fn lift(text: &str) -> (String, Lists) {
    let mut lists = Lists::new();
    let mut bytes = text.as_bytes().to_vec();
    let mut at = 0;
    while let Some(&byte) = text.as_bytes().get(at) {
        let rest = &text[at..];
        at += match byte {
            b'[' => match numeric::list(rest, at) {
                Some(list) if list.span.len() >= LONG => {
                    let inside = &mut bytes[list.span.start + 1..list.span.end - 1];
                    inside.iter_mut().filter(|b| !b.is_ascii_whitespace()).for_each(|b| *b = b' ');
                    let length = list.span.len();
                    lists.insert(at, list);
                    length
                }
                _ => 1,
            },
            b'"' => quoted(rest, '"'),
            b'\'' => quoted(rest, '\''),
            b'/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            b'/' if rest.starts_with("/*") => super::block_comment(rest),
            b'a'..=b'z' | b'A'..=b'Z' | b'_' => word(rest),
            // The rest of a character of several bytes is none of these.
            _ => rest.chars().next().map_or(1, char::len_utf8),
        };
    }
    // Only whole characters of one byte have become blanks.
    String::from_utf8(bytes).map_or_else(|_| (text.to_owned(), Lists::new()), |text| (text, lists))
}

/// Length of a text in quotes, to the end where it does not close.
fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in text.char_indices().skip(1) {
        if !escaped && c == quote {
            return i + 1;
        }
        escaped = !escaped && c == '\\';
    }
    text.len()
}

/// Length of a name, or of a raw string such as `r#"a "b""#`.
fn word(text: &str) -> usize {
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len());
    if !matches!(&text[..end], "r" | "br") {
        return end;
    }
    let hashes = text[end..].find(|c| c != '#').unwrap_or(0);
    let start = end + hashes;
    if !text[start..].starts_with('"') {
        return end;
    }
    let close = format!("\"{}", "#".repeat(hashes));
    text[start + 1..].find(&close).map_or(text.len(), |i| start + 1 + i + close.len())
}

#[cfg(test)]
mod tests {
    use super::super::{Kind, parse};
    use super::*;

    fn long() -> String {
        let numbers: Vec<String> = (0..200).map(|i| format!("{}.5", i)).collect();
        format!("[{}]", numbers.join(",\n"))
    }

    #[test]
    fn long_lists_are_blank_and_everything_else_stays() {
        let list = long();
        let text = format!("(é: 'x', a: {list}, b: [1, 2], c: [[{list}], \"x\"])");
        let (blank, lists) = lift(&text);
        assert_eq!((blank.len(), lists.len()), (text.len(), 2));
        let lines = |s: &str| s.match_indices('\n').map(|(i, _)| i).collect::<Vec<_>>();
        assert_eq!(lines(&blank), lines(&text));
        assert!(!blank.contains(".5") && blank.contains("b: [1, 2], c: ["));
        for (start, node) in &lists {
            assert_eq!((*start, &text[node.span.clone()][..1]), (node.span.start, "["));
        }
    }

    #[test]
    fn what_is_no_list_of_the_file_is_left_alone() {
        let list = long();
        for text in [
            format!("(a: \"{list}\")"),
            format!("(a: \"\\\"{list}\")"),
            format!("(a: \"\\\\\", b: \"{list}\")"),
            format!("(a: r#\"\"{list}\"#)"),
            format!("(a: '\"', b: \"{list}\")"),
            format!("(a: 1, /* /* */ {list} */)"),
            format!("(a: 1, // {}\n)", list.replace('\n', " ")),
            format!("(a: {})", list.replace("7.5", "7.5 /* seven */")),
            format!("(a: {})", list.replace("7.5", "seven")),
            format!("(a: {}", list.replace(']', "")),
            format!("(a: \"{list}"),
        ] {
            let (blank, lists) = lift(&text);
            assert!(blank == text && lists.is_empty(), "{text}");
        }
    }

    #[test]
    fn a_tree_holds_lifted_lists_where_they_stand() {
        let list = long();
        let in_words = list.replace("199.5", "199.5 /* the last */");
        for (before, after) in
            [("", ""), ("(a: ", ")"), ("{\"x\": F(a: (", ", yes))}"), ("[1, ", "]")]
        {
            let lifted = parse(&format!("{before}{list}{after}")).unwrap();
            let plain = parse(&format!("{before}{in_words}{after}")).unwrap();
            assert_eq!(numbers(&lifted), numbers(&plain));
            let text = format!("{before}{list}{after}");
            let first = numbers(&lifted).into_iter().find(|(x, _)| *x == 0.5).unwrap();
            assert_eq!(&text[first.1..first.1 + 3], "0.5");
        }
    }

    /// All numbers with the places where they begin.
    fn numbers(node: &Node) -> Vec<(f64, usize)> {
        match &node.kind {
            Kind::Number(x) => vec![(*x, node.span.start)],
            Kind::List(_, items) => items.iter().flat_map(numbers).collect(),
            Kind::Fields(_, entries) | Kind::Map(entries) => {
                entries.iter().flat_map(|e| numbers(&e.value)).collect()
            }
            _ => Vec::new(),
        }
    }
}

//! The text of an ETABS model: sections of lines that begin with a keyword.
//!
//! ```text
//! $ FRAME SECTIONS
//!   FRAMESECTION  "C40"  MATERIAL "C30/37"  SHAPE "Concrete Rectangular"  D 0.4 B 0.4
//!
//! $ END OF MODEL FILE
//! ```
//!
//! Behind the keyword stand names in double quotes and numbers, then keys, each with its value. A thing may have several
//! lines: what they say belongs together.

use crate::sap2000::Database;
use std::cell::Cell;
use trilith_model::Span;

/// The line that ends a file.
const END: &str = "END OF MODEL FILE";

/// A word, a number or a text in quotes.
#[derive(Debug)]
pub struct Token {
    pub text: String,
    pub quoted: bool,
    pub span: Span,
    /// Somebody has asked for it.
    pub used: Cell<bool>,
}

impl Token {
    /// Its text, which is asked for.
    pub fn read(&self) -> &str {
        self.used.set(true);
        &self.text
    }

    /// True for a word that may be a key.
    pub fn is_word(&self) -> bool {
        !self.quoted && number(&self.text).is_none()
    }
}

/// A line of a section.
#[derive(Debug)]
pub struct Line {
    pub keyword: String,
    pub tokens: Vec<Token>,
    pub span: Span,
}

/// A section and its lines.
#[derive(Debug)]
pub struct Section {
    pub name: String,
    pub lines: Vec<Line>,
}

/// A number with a point or, as ETABS writes it under Windows of some countries, a comma.
pub fn number(text: &str) -> Option<f64> {
    let plain = text.parse::<f64>();
    let with_comma = || text.replacen(',', ".", 1).parse::<f64>();
    plain.or_else(|_| with_comma()).ok().filter(|_| !text.starts_with(|c: char| c.is_alphabetic()))
}

/// The sections of a text in their order; what is wrong with it goes to `db`.
pub fn sections(text: &str, db: &Database) -> Vec<Section> {
    let mut out: Vec<Section> = Vec::new();
    let (mut start, mut ended, mut comment) = (0, false, false);
    for line in text.split_inclusive('\n') {
        let end = start + line.trim_end().len();
        let left = (start + (line.len() - line.trim_start().len())).min(end);
        start += line.len();
        let (span, said) = (left..end, &text[left..end]);
        if said.is_empty() {
            continue;
        }
        if ended {
            db.wrong(&span, &format!("there is something behind $ {END}"), "take it out");
            return out;
        }
        if let (Some(name), false) = (said.strip_prefix('$'), comment) {
            let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
            ended = name == END;
            if !(ended || name.is_empty() || name.starts_with("File ")) {
                out.push(Section { name, lines: Vec::new() });
            }
            continue;
        }
        let Some(section) = out.last_mut() else {
            let help = "a text model of ETABS begins with $ File or $ PROGRAM INFORMATION";
            db.wrong(&span, "this line stands in no section", help);
            return out;
        };
        if section.name == "LOG" {
            // Free text between these two words.
            comment = !said.starts_with("ENDCOMMENTS") && (comment || said == "STARTCOMMENTS");
            section.lines.push(Line { keyword: "LOG".into(), tokens: Vec::new(), span });
            continue;
        }
        let tokens = tokens(said, left, db);
        let mut tokens = tokens.into_iter();
        let Some(first) = tokens.next() else { continue };
        if first.quoted || !first.is_word() {
            db.wrong(&first.span, "a line begins with a keyword", "such as STORY or LINE");
            continue;
        }
        if first.text == "END" && tokens.len() == 0 {
            continue;
        }
        section.lines.push(Line { keyword: first.text, tokens: tokens.collect(), span });
    }
    if !ended {
        let end = text.trim_end().len();
        let last = text[..end].char_indices().next_back().map_or(0, |(i, _)| i);
        let help = "the file was cut: export it again";
        db.wrong(&(last..end), &format!("the file ends without the line $ {END}"), help);
    }
    out
}

/// Words of a line; quotes inside a text are doubled.
fn tokens(line: &str, at: usize, db: &Database) -> Vec<Token> {
    let mut out = Vec::new();
    let mut from = 0;
    loop {
        from += line[from..].len() - line[from..].trim_start().len();
        let rest = &line[from..];
        if rest.is_empty() {
            return out;
        }
        let quoted = rest.starts_with('"');
        let (text, length) = match rest.strip_prefix('"') {
            None => {
                let stop = |c: char| c.is_whitespace() || c == '"';
                let length = rest.find(stop).unwrap_or(rest.len());
                (rest[..length].to_owned(), length)
            }
            Some(inside) => match closed(inside) {
                Some((text, length)) => (text, length + 1),
                None => {
                    let span = at + from..at + line.len();
                    db.wrong(&span, "quotes that do not end", "a text ends on its line");
                    return out;
                }
            },
        };
        let span = at + from..at + from + length;
        from += length;
        out.push(Token { text, quoted, span, used: Cell::new(false) });
    }
}

/// A text up to its closing quote, and the length with it.
fn closed(inside: &str) -> Option<(String, usize)> {
    let (mut text, mut from) = (String::new(), 0);
    loop {
        let end = inside[from..].find('"')?;
        text.push_str(&inside[from..from + end]);
        from += end + 1;
        if !inside[from..].starts_with('"') {
            return Some((text, from));
        }
        text.push('"');
        from += 1;
    }
}

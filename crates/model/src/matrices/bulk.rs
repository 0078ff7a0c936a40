//! Entries of Nastran's bulk data, taken apart into fields.
//!
//! ```text
//!   small   a name and 8 fields of 8 characters each
//!   large   NAME* and 4 fields of 16 characters each
//!   free    the same fields between commas
//!   goes on in lines that begin with +, * (large), a comma or blanks; $ begins a comment
//! ```
//!
//! Autodesk Nastran 2025 Reference Manual, Section 4, "Bulk Data"; Altair OptiStruct 2021, "Bulk Data Format".

/// An entry of bulk data.
pub(super) struct Card<'a> {
    pub line: usize,
    /// Those behind its name, line after line; a line that is cut short is filled with empty ones.
    pub fields: Vec<Field<'a>>,
    /// Line and sentence of what is wrong with its form.
    pub fault: Option<(usize, String)>,
}

#[derive(Clone, Copy)]
pub(super) struct Field<'a> {
    pub line: usize,
    pub text: &'a str,
}

/// The entries of the names, in the order of the file.
pub(super) fn cards<'a>(
    bytes: &'a [u8],
    names: &'a [&'a str],
) -> impl Iterator<Item = Card<'a>> + 'a {
    let mut lines = bytes.split(|b| *b == b'\n').enumerate().map(told).peekable();
    std::iter::from_fn(move || {
        loop {
            let (line, first) = lines.next()?;
            if !names.contains(&name_of(first).as_str()) {
                continue;
            }
            let mut card = Card { line, fields: Vec::new(), fault: None };
            card.take(line, first);
            // Behind a comment blanks begin something else, such as results that were punched as well.
            let mut parted = false;
            while let Some((at, more)) =
                lines.next_if(|(_, line)| line.is_empty() || goes_on(line, parted))
            {
                parted |= more.is_empty();
                if !more.is_empty() {
                    card.take(at, more);
                }
            }
            return Some(card);
        }
    })
}

/// A line by its number, from 1, without its comment.
fn told((i, line): (usize, &[u8])) -> (usize, &[u8]) {
    let line = line.split(|b| *b == b'$').next().unwrap_or_default();
    (i + 1, line.trim_ascii_end())
}

fn head(line: &[u8]) -> &[u8] {
    let end = line.iter().position(|b| *b == b',').unwrap_or(line.len().min(8));
    line[..end].trim_ascii()
}

fn name_of(line: &[u8]) -> String {
    let name = head(line).strip_suffix(b"*").unwrap_or(head(line));
    text(name.trim_ascii()).to_ascii_uppercase()
}

fn goes_on(line: &[u8], parted: bool) -> bool {
    match head(line).first() {
        Some(b) => b"+*".contains(b),
        None => !parted || line.starts_with(b","),
    }
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap_or("\u{fffd}").trim()
}

impl<'a> Card<'a> {
    fn take(&mut self, line: usize, bytes: &'a [u8]) {
        let first = head(bytes);
        let large = first.starts_with(b"*") || first.ends_with(b"*");
        let (count, width) = if large { (4, 16) } else { (8, 8) };
        let mut own = Vec::with_capacity(count);
        if bytes.contains(&b',') {
            own.extend(bytes.split(|b| *b == b',').skip(1).map(text));
            // The name of the line that follows.
            let is_mark = |last: &&str| match real(last) {
                Some(_) => false,
                None => last.starts_with(['+', '*']) || own.len() > count,
            };
            if own.last().is_some_and(is_mark) {
                own.pop();
            }
            if own.len() > count {
                let message = format!("{} fields in a line of at most {count}", own.len());
                self.fault.get_or_insert((line, message));
            }
        } else {
            if bytes.contains(&b'\t') {
                let message = format!(
                    "a tab among fields of {width} characters: blanks or commas are wanted"
                );
                self.fault.get_or_insert((line, message));
            }
            let fields = bytes.get(8..).unwrap_or_default().chunks(width).take(count);
            own.extend(fields.map(text));
        }
        own.resize(count, "");
        self.fields.extend(own.into_iter().map(|text| Field { line, text }));
    }
}

/// A number as Nastran writes it: `1.0`, `1.0E+3`, `1.0D+3`, or `1.0+3` without the letter.
pub(super) fn real(text: &str) -> Option<f64> {
    let is_sign = |c: char| c == '+' || c == '-';
    let split = text
        .find(['e', 'E', 'd', 'D'])
        .or_else(|| text.char_indices().skip(1).find(|(_, c)| is_sign(*c)).map(|(at, _)| at));
    let (mantissa, exponent) = match split {
        Some(at) => {
            let behind = &text[at..];
            (&text[..at], behind.strip_prefix(|c: char| c.is_ascii_alphabetic()).unwrap_or(behind))
        }
        None => (text, "0"),
    };
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let whole = mantissa.strip_prefix(is_sign).unwrap_or(mantissa).replacen('.', "", 1);
    let behind = exponent.strip_prefix(is_sign).unwrap_or(exponent);
    let value = (digits(&whole) && digits(behind)).then(|| format!("{mantissa}e{exponent}"))?;
    value.parse().ok().filter(|x: &f64| x.is_finite())
}

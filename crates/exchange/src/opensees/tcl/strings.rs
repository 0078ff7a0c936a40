//! Texts: `string`, `format`.

use super::interpreter::{Flow, Interpreter, Outcome};
use super::value::{Number, Value};

type Command = fn(&mut Interpreter<'_>, &[Value]) -> Outcome;

/// A command on texts.
pub fn find(name: &str) -> Option<Command> {
    Some(match name {
        "string" => string,
        "format" => format,
        _ => return None,
    })
}

/// A position: a number, `end`, `end-1`; that of the last item is `n` − 1.
pub fn position(i: &Interpreter<'_>, index: &Value, n: usize) -> Result<i64, Flow> {
    let last = n as i64 - 1;
    let text = index.str().trim();
    let read = match text.strip_prefix("end") {
        Some("") => Some(last),
        Some(rest) => match Number::read(rest) {
            Some(Number::Whole(k)) => last.checked_add(k),
            _ => None,
        },
        None => match Number::read(text) {
            Some(Number::Whole(k)) => Some(k),
            _ => None,
        },
    };
    read.ok_or_else(|| {
        i.wrong(
            &format!("`{}` is no position", text.chars().take(40).collect::<String>()),
            "a number from 0, end, or end-1",
        )
    })
}

/// True where a text fits a pattern of `*`, `?`, `[a-z]` and `\`.
pub fn matches(pattern: &str, text: &str) -> bool {
    let (p, t): (Vec<char>, Vec<char>) = (pattern.chars().collect(), text.chars().collect());
    let (mut i, mut k, mut star) = (0, 0, None);
    while k < t.len() {
        let step = match p.get(i) {
            Some('*') => {
                star = Some((i, k));
                i += 1;
                continue;
            }
            Some('?') => Some(i + 1),
            Some('\\') => (p.get(i + 1) == Some(&t[k])).then_some(i + 2),
            Some('[') => set(&p, i, t[k]),
            Some(c) => (*c == t[k]).then_some(i + 1),
            None => None,
        };
        match (step, star) {
            (Some(next), _) => (i, k) = (next, k + 1),
            (None, Some((at, from))) => {
                star = Some((at, from + 1));
                (i, k) = (at + 1, from + 1);
            }
            (None, None) => return false,
        }
    }
    p[i..].iter().all(|c| *c == '*')
}

/// Behind a set of letters that holds one.
fn set(p: &[char], open: usize, c: char) -> Option<usize> {
    let end = open + 1 + p[open + 1..].iter().position(|x| *x == ']')?;
    let inner = &p[open + 1..end];
    let mut found = false;
    let mut i = 0;
    while i < inner.len() {
        if inner.get(i + 1) == Some(&'-') && i + 2 < inner.len() {
            found |= (inner[i]..=inner[i + 2]).contains(&c);
            i += 3;
        } else {
            found |= inner[i] == c;
            i += 1;
        }
    }
    found.then_some(end + 1)
}

fn string(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 2, usize::MAX, "string length|range|equal|match|… text")?;
    // `-nocase` is the only option that is read.
    let nocase = w.iter().any(|v| v.str() == "-nocase");
    let words: Vec<&str> = w[2..].iter().map(|v| v.str()).filter(|t| *t != "-nocase").collect();
    i.spend(words.iter().map(|t| t.len()).sum())?;
    let text = words.first().copied().unwrap_or_default();
    let other = words.get(1).copied();
    let flag = |b: bool| Ok(Value::new(if b { "1" } else { "0" }));
    let low = |t: &str| if nocase { t.to_lowercase() } else { t.to_owned() };
    let chars = |c: Option<&str>| c.unwrap_or(" \t\n\r").to_owned();
    match (w[1].str(), other) {
        ("length", None) => Ok(Value::new(text.chars().count().to_string())),
        ("tolower", None) => Ok(Value::new(text.to_lowercase())),
        ("toupper", None) => Ok(Value::new(text.to_uppercase())),
        ("totitle", None) => {
            let mut all = text.chars();
            let first: String = all.next().map(|c| c.to_uppercase().collect()).unwrap_or_default();
            Ok(Value::new(first + &all.as_str().to_lowercase()))
        }
        ("trim", c) => Ok(Value::new(text.trim_matches(|x| chars(c).contains(x)))),
        ("trimleft", c) => Ok(Value::new(text.trim_start_matches(|x| chars(c).contains(x)))),
        ("trimright", c) => Ok(Value::new(text.trim_end_matches(|x| chars(c).contains(x)))),
        ("equal", Some(b)) => flag(low(text) == low(b)),
        ("compare", Some(b)) => Ok(Value::new((low(text).cmp(&low(b)) as i8).to_string())),
        ("match", Some(b)) => flag(matches(&low(text), &low(b))),
        ("first" | "last", Some(b)) => {
            let at = if w[1].str() == "first" { b.find(text) } else { b.rfind(text) };
            let at = at.filter(|_| !text.is_empty()).map_or(-1, |n| b[..n].chars().count() as i64);
            Ok(Value::new(at.to_string()))
        }
        ("index", Some(_)) => {
            let k = position(i, &w[3], text.chars().count())?;
            let c = usize::try_from(k).ok().and_then(|k| text.chars().nth(k));
            Ok(Value::new(c.map_or_else(String::new, |c| c.to_string())))
        }
        ("range", Some(_)) if w.len() == 5 => {
            let n = text.chars().count();
            let from = position(i, &w[3], n)?.clamp(0, n as i64) as usize;
            let to = position(i, &w[4], n)?.saturating_add(1).clamp(0, n as i64) as usize;
            Ok(Value::new(
                text.chars().skip(from).take(to.saturating_sub(from)).collect::<String>(),
            ))
        }
        ("repeat", Some(_)) => {
            let n = usize::try_from(i.whole(w, 3)?).unwrap_or(0);
            i.bounded(n.saturating_mul(text.len()))?;
            Ok(Value::new(text.repeat(n)))
        }
        ("map", Some(b)) => {
            let pairs = w[w.len() - 2].items().map_err(|e| i.wrong(&e, ""))?;
            let (mut out, mut rest) = (String::new(), b);
            'all: while !rest.is_empty() {
                for pair in pairs.chunks_exact(2).filter(|p| !p[0].str().is_empty()) {
                    if let Some(behind) = rest.strip_prefix(pair[0].str()) {
                        out += pair[1].str();
                        i.bounded(out.len())?;
                        rest = behind;
                        continue 'all;
                    }
                }
                let n = rest.chars().next().map_or(1, char::len_utf8);
                out += &rest[..n];
                rest = &rest[n..];
            }
            i.value(out)
        }
        ("is", Some(b)) => match text {
            "integer" | "wideinteger" => flag(matches!(Number::read(b), Some(Number::Whole(_)))),
            "double" => flag(Number::read(b).is_some()),
            "space" => flag(b.chars().all(char::is_whitespace)),
            "alpha" => flag(b.chars().all(char::is_alphabetic)),
            "digit" => flag(b.chars().all(|c| c.is_ascii_digit())),
            _ => Err(i.wrong(
                "this class of `string is` is not read",
                "integer, double, space, alpha or digit",
            )),
        },
        (what, _) => {
            let message = format!("`string {what}` with {} arguments is not read", w.len() - 2);
            Err(i.wrong(&message, ""))
        }
    }
}

fn format(i: &mut Interpreter<'_>, w: &[Value]) -> Outcome {
    i.count(w, 1, usize::MAX, "format pattern value …")?;
    let (mut out, mut next) = (String::new(), 2);
    let mut chars = w[1].str().chars().peekable();
    while let Some(c) = chars.next() {
        if c != '%' {
            out.push(c);
            continue;
        }
        if chars.next_if_eq(&'%').is_some() {
            out.push('%');
            continue;
        }
        let mut flags = String::new();
        while let Some(c) = chars.next_if(|c| "-+ 0#".contains(*c)) {
            flags.push(c);
        }
        let digits = |chars: &mut std::iter::Peekable<std::str::Chars<'_>>| {
            let mut n = None;
            while let Some(d) = chars.peek().and_then(|c| c.to_digit(10)) {
                n = Some((n.unwrap_or(0) * 10 + d as usize).min(1000));
                chars.next();
            }
            n
        };
        let width = digits(&mut chars).unwrap_or(0);
        let precision = chars.next_if_eq(&'.').map(|_| digits(&mut chars).unwrap_or(0));
        while chars.next_if(|c| "lhL".contains(*c)).is_some() {}
        let kind = chars.next();
        let Some(value) = w.get(next) else {
            return Err(i.wrong("`format` with too few values", "one for each %"));
        };
        next += 1;
        let plain = match kind {
            Some('s') => value.str().chars().take(precision.unwrap_or(usize::MAX)).collect(),
            Some('c') => {
                let code = i.whole(w, next - 1)?;
                u32::try_from(code)
                    .ok()
                    .and_then(char::from_u32)
                    .map_or_else(String::new, |c| c.to_string())
            }
            Some('d' | 'i' | 'u') => i.whole(w, next - 1)?.to_string(),
            Some('x') => format!("{:x}", i.whole(w, next - 1)?),
            Some(kind @ ('f' | 'e' | 'g' | 'E' | 'G')) => {
                let x = Number::read(value.str()).ok_or_else(|| i.no_number(value.str()))?.real();
                real(x, kind, precision.unwrap_or(6))
            }
            _ => {
                return Err(i.wrong_at(
                    1,
                    "a conversion of `format` that is not read",
                    "%s, %d, %f, %e, %g",
                ));
            }
        };
        let signed = match flags.contains('+') && kind != Some('s') && !plain.starts_with('-') {
            true => format!("+{plain}"),
            false => plain,
        };
        let fill = width.saturating_sub(signed.chars().count());
        if flags.contains('-') {
            out += &signed;
            out.extend(std::iter::repeat_n(' ', fill));
        } else if flags.contains('0') && kind != Some('s') {
            let (sign, rest) = signed.split_at(usize::from(signed.starts_with(['-', '+'])));
            out += sign;
            out.extend(std::iter::repeat_n('0', fill));
            out += rest;
        } else {
            out.extend(std::iter::repeat_n(' ', fill));
            out += &signed;
        }
        i.bounded(out.len())?;
    }
    i.value(out)
}

/// A number as `%f`, `%e` or `%g` writes it.
fn real(x: f64, kind: char, precision: usize) -> String {
    let scientific = |digits: usize| {
        let text = format!("{x:.digits$e}");
        let (front, power) = text.split_once('e').unwrap_or((&text, "0"));
        let (sign, size) = match power.strip_prefix('-') {
            Some(size) => ('-', size),
            None => ('+', power),
        };
        format!("{front}e{sign}{size:0>2}")
    };
    match kind {
        'f' => format!("{x:.precision$}"),
        'e' | 'E' => scientific(precision),
        _ => {
            let digits = precision.max(1);
            let power = if x == 0.0 {
                0
            } else {
                format!("{x:.*e}", digits - 1)
                    .split_once('e')
                    .and_then(|(_, p)| p.parse().ok())
                    .unwrap_or(0)
            };
            let trimmed = |text: &str| match text.contains('.') {
                true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
                false => text.to_owned(),
            };
            if power < -4 || power >= digits as i64 {
                let text = scientific(digits - 1);
                let (front, back) = text.split_once('e').unwrap_or((&text, "+00"));
                format!("{}e{back}", trimmed(front))
            } else {
                let decimals = (digits as i64 - 1 - power).max(0) as usize;
                trimmed(&format!("{x:.decimals$}"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_and_numbers_are_as_in_tcl() {
        for (pattern, text, fits) in [
            ("a*c", "abbc", true),
            ("a?c", "abbc", false),
            ("[a-c]x", "bx", true),
            ("*b", "abab", true),
            ("\\*", "*", true),
            ("*x*", "", false),
        ] {
            assert_eq!(matches(pattern, text), fits, "{pattern} {text}");
        }
        assert_eq!(real(0.1234567, 'g', 6), "0.123457");
        assert_eq!(real(1e-7, 'g', 6), "1e-07");
        assert_eq!(real(1234567.0, 'g', 6), "1.23457e+06");
        assert_eq!(real(-2.5, 'e', 3), "-2.500e+00");
        assert_eq!(real(2.0, 'f', 2), "2.00");
    }
}

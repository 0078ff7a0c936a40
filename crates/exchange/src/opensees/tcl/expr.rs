//! Expressions: numbers, comparisons, functions, with what they substitute only where it counts.

use super::functions::function;
use super::interpreter::{Flow, Interpreter, Outcome};
use super::value::{Number, Value, closing, escape};

/// A value of an expression.
#[derive(Clone, Debug)]
enum Term {
    Number(Number),
    Text(String),
}

use Number::{Real, Whole};

/// Deepest nesting of parentheses, of all expressions together that wait for the value of a bracket of theirs.
const DEEPEST: usize = 300;

struct Reader<'a, 'h> {
    interpreter: &'a mut Interpreter<'h>,
    text: &'a str,
    origin: Option<(usize, usize)>,
    at: usize,
    /// False where a part is only read over: the other side of `?:`, `&&`, `||`.
    live: bool,
}

/// Value of an expression.
pub fn evaluate(interpreter: &mut Interpreter<'_>, expression: &Value) -> Outcome {
    let around = interpreter.parentheses;
    let out = value(interpreter, expression);
    // Wherever it has ended.
    interpreter.parentheses = around;
    out
}

fn value(interpreter: &mut Interpreter<'_>, expression: &Value) -> Outcome {
    let text = expression.text.clone();
    let origin = expression.origin;
    let mut reader = Reader { interpreter, text: &text, origin, at: 0, live: true };
    let out = reader.ternary()?;
    reader.space();
    if reader.at < text.len() {
        return Err(reader.wrong(&format!("`{}` is not expected in an expression", reader.rest())));
    }
    Ok(match out {
        Term::Number(n) => Value::new(n.text()),
        Term::Text(text) => Value::new(text),
    })
}

/// Whether an expression holds.
pub fn holds(interpreter: &mut Interpreter<'_>, expression: &Value) -> Result<bool, Flow> {
    let value = evaluate(interpreter, expression)?;
    truth(value.str()).ok_or_else(|| {
        interpreter.wrong(
            &format!("`{}` is neither true nor false", value.str()),
            "a number, or a comparison",
        )
    })
}

fn truth(text: &str) -> Option<bool> {
    match text.trim().to_ascii_lowercase().as_str() {
        "true" | "yes" | "on" => Some(true),
        "false" | "no" | "off" => Some(false),
        _ => Number::read(text).map(|n| n.real() != 0.0),
    }
}

/// Operators of two operands by their levels, the weakest first.
const LEVELS: [&[&str]; 12] = [
    &["||"],
    &["&&"],
    &["|"],
    &["^"],
    &["&"],
    &["in", "ni"],
    &["eq", "ne"],
    &["==", "!="],
    &["<=", ">=", "<", ">"],
    &["<<", ">>"],
    &["+", "-"],
    &["*", "/", "%"],
];

impl Reader<'_, '_> {
    fn wrong(&mut self, message: &str) -> Flow {
        self.interpreter.wrong(message, "")
    }

    fn rest(&self) -> String {
        self.text[self.at..].chars().take(20).collect()
    }

    fn space(&mut self) {
        let bytes = self.text.as_bytes();
        while let Some(b) = bytes.get(self.at) {
            let joined = *b == b'\\' && matches!(bytes.get(self.at + 1), Some(b'\n' | b'\r'));
            if !b.is_ascii_whitespace() && !joined {
                return;
            }
            self.at += 1;
        }
    }

    fn take(&mut self, what: &str) -> bool {
        self.space();
        let found = self.text[self.at..].starts_with(what);
        if found {
            self.at += what.len();
        }
        found
    }

    fn deeper(&mut self) -> Result<(), Flow> {
        self.interpreter.parentheses += 1;
        if self.interpreter.parentheses > DEEPEST {
            return Err(self.wrong("an expression that is nested too deeply"));
        }
        Ok(())
    }

    fn ternary(&mut self) -> Result<Term, Flow> {
        self.deeper()?;
        let condition = self.binary(0)?;
        let out = if self.take("?") {
            let (live, yes) = (self.live, self.live && self.is_true(&condition)?);
            self.live = live && yes;
            let first = self.ternary()?;
            if !self.take(":") {
                return Err(self.wrong("`?` without its `:`"));
            }
            self.live = live && !yes;
            let second = self.ternary()?;
            self.live = live;
            if yes { first } else { second }
        } else {
            condition
        };
        self.interpreter.parentheses -= 1;
        Ok(out)
    }

    fn is_true(&mut self, term: &Term) -> Result<bool, Flow> {
        match term {
            Term::Number(n) => Ok(n.real() != 0.0),
            Term::Text(text) => truth(text).ok_or_else(|| {
                self.interpreter.wrong(
                    &format!("`{text}` is neither true nor false"),
                    "a number, or a comparison",
                )
            }),
        }
    }

    fn operator(&mut self, level: usize) -> Option<&'static str> {
        self.space();
        let rest = &self.text[self.at..];
        let found = LEVELS[level].iter().find(|op| rest.starts_with(**op))?;
        let next = rest[found.len()..].chars().next();
        let word = found.starts_with(|c: char| c.is_alphabetic());
        let other = match *found {
            "|" => next == Some('|'),
            "&" => next == Some('&'),
            "<" | ">" => next == Some(found.chars().next().unwrap_or('<')),
            "*" => next == Some('*'),
            _ => word && next.is_some_and(|c| c.is_alphanumeric() || c == '_'),
        };
        (!other).then(|| {
            self.at += found.len();
            *found
        })
    }

    fn binary(&mut self, level: usize) -> Result<Term, Flow> {
        if level == LEVELS.len() {
            return self.power();
        }
        let mut left = self.binary(level + 1)?;
        while let Some(op) = self.operator(level) {
            let live = self.live;
            if level < 2 {
                let decided = live && self.is_true(&left)? == (op == "||");
                self.live = live && !decided;
                let right = self.binary(level + 1)?;
                let value =
                    decided == (op == "||") && decided || self.live && self.is_true(&right)?;
                self.live = live;
                left = Term::Number(Whole(i64::from(value)));
                continue;
            }
            let right = self.binary(level + 1)?;
            if self.live {
                left = self.apply(op, left, right)?;
            }
        }
        Ok(left)
    }

    fn power(&mut self) -> Result<Term, Flow> {
        let base = self.unary()?;
        if !self.take("**") {
            return Ok(base);
        }
        self.deeper()?;
        let exponent = self.power()?;
        self.interpreter.parentheses -= 1;
        if !self.live {
            return Ok(base);
        }
        let out = match (self.number(&base)?, self.number(&exponent)?) {
            (Whole(a), Whole(b)) if b >= 0 => {
                let b = u32::try_from(b).ok();
                b.and_then(|b| a.checked_pow(b)).map(Whole)
            }
            (Whole(a), Whole(_)) => match a {
                0 => None,
                1 => Some(Whole(1)),
                -1 => Some(Real((-1.0_f64).powf(self.number(&exponent)?.real()))),
                _ => Some(Whole(0)),
            },
            (a, b) => Some(Real(a.real().powf(b.real()))),
        };
        self.finite(out)
    }

    fn unary(&mut self) -> Result<Term, Flow> {
        self.space();
        let op = self.text[self.at..].chars().next().filter(|c| "+-!~".contains(*c));
        let Some(op) = op else { return self.primary() };
        self.at += 1;
        self.deeper()?;
        let term = self.unary()?;
        self.interpreter.parentheses -= 1;
        if !self.live {
            return Ok(term);
        }
        if op == '!' {
            return Ok(Term::Number(Whole(i64::from(!self.is_true(&term)?))));
        }
        let out = match (op, self.number(&term)?) {
            ('+', n) => Some(n),
            ('-', Whole(i)) => i.checked_neg().map(Whole),
            ('-', Real(x)) => Some(Real(-x)),
            (_, Whole(i)) => Some(Whole(!i)),
            (_, Real(_)) => return Err(self.wrong("`~` of a number that is not whole")),
        };
        self.finite(out)
    }

    fn finite(&mut self, n: Option<Number>) -> Result<Term, Flow> {
        match n {
            Some(n) if n.real().is_finite() => Ok(Term::Number(n)),
            _ => Err(self.wrong("an expression without a finite value")),
        }
    }

    fn number(&mut self, term: &Term) -> Result<Number, Flow> {
        match term {
            Term::Number(n) => Ok(*n),
            Term::Text(text) => Number::read(text)
                .or(match text.as_str() {
                    "true" | "yes" | "on" => Some(Whole(1)),
                    "false" | "no" | "off" => Some(Whole(0)),
                    _ => None,
                })
                .ok_or_else(|| self.interpreter.no_number(text)),
        }
    }

    fn primary(&mut self) -> Result<Term, Flow> {
        self.space();
        let rest = &self.text[self.at..];
        let Some(c) = rest.chars().next() else {
            return Err(self.wrong("an expression that ends too early"));
        };
        match c {
            '(' => {
                self.at += 1;
                let out = self.ternary()?;
                if !self.take(")") {
                    return Err(self.wrong("a parenthesis that does not close in an expression"));
                }
                Ok(out)
            }
            '$' | '[' | '"' => self.substituted(c),
            '{' => {
                let end = closing(self.text, self.at);
                let end =
                    end.ok_or_else(|| self.wrong("a brace that does not close in an expression"))?;
                let text = self.text[self.at + 1..end].to_owned();
                self.at = end + 1;
                Ok(Term::Text(text))
            }
            c if c.is_ascii_digit() || c == '.' => self.literal(),
            c if c.is_alphabetic() || c == '_' => self.word(),
            _ => {
                let rest = self.rest();
                Err(self.wrong(&format!("`{rest}` is not expected in an expression")))
            }
        }
    }

    fn substituted(&mut self, c: char) -> Result<Term, Flow> {
        if c == '"' {
            self.at += 1;
            let mut out = String::new();
            loop {
                let Some(c) = self.text[self.at..].chars().next() else {
                    return Err(self.wrong("quotes that do not end in an expression"));
                };
                match c {
                    '"' => {
                        self.at += 1;
                        return Ok(Term::Text(out));
                    }
                    '$' | '[' => {
                        if let Term::Text(t) = self.substituted(c)? {
                            out += &t;
                        }
                    }
                    '\\' => {
                        let (t, used) = escape(&self.text[self.at..]);
                        out += &t;
                        self.at += used;
                    }
                    c => {
                        out.push(c);
                        self.at += c.len_utf8();
                    }
                }
            }
        }
        let (value, at) =
            self.interpreter.substitute(self.text, self.at, self.origin, self.live)?;
        self.at = at;
        Ok(Term::Text(value.text.to_string()))
    }

    fn literal(&mut self) -> Result<Term, Flow> {
        let bytes = self.text.as_bytes();
        let start = self.at;
        while let Some(b) = bytes.get(self.at) {
            let sign = matches!(b, b'+' | b'-')
                && self.at > start
                && matches!(bytes[self.at - 1], b'e' | b'E')
                && !self.text[start..].to_ascii_lowercase().starts_with("0x");
            if !b.is_ascii_alphanumeric() && *b != b'.' && !sign {
                break;
            }
            self.at += 1;
        }
        let text = &self.text[start..self.at];
        match Number::read(text) {
            Some(n) => Ok(Term::Number(n)),
            None => Err(self.interpreter.no_number(text)),
        }
    }

    fn word(&mut self) -> Result<Term, Flow> {
        let rest = &self.text[self.at..];
        if rest.starts_with(super::super::UNKNOWN) {
            return Err(self.interpreter.no_number(rest));
        }
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let name = rest[..end].to_owned();
        self.at += end;
        if !self.take("(") {
            if truth(&name).is_some() {
                return Ok(Term::Text(name));
            }
            return Err(self.interpreter.wrong(
                &format!("`{name}` is not expected in an expression"),
                &format!("a variable is `${name}`, a text stands in quotes"),
            ));
        }
        let mut of = Vec::new();
        if !self.take(")") {
            loop {
                let term = self.ternary()?;
                of.push(if self.live { self.number(&term)? } else { Whole(1) });
                if self.take(")") {
                    break;
                }
                if !self.take(",") {
                    return Err(self.wrong("a function whose parenthesis does not close"));
                }
            }
        }
        if !self.live {
            return Ok(Term::Number(Whole(1)));
        }
        match function(&name, &of) {
            Ok(n) => self.finite(n),
            Err(why) => Err(self.wrong(&why)),
        }
    }

    fn apply(&mut self, op: &str, left: Term, right: Term) -> Result<Term, Flow> {
        let said = |t: &Term| match t {
            Term::Number(n) => n.text(),
            Term::Text(t) => t.clone(),
        };
        let flag = |b: bool| Ok(Term::Number(Whole(i64::from(b))));
        match op {
            "eq" => return flag(said(&left) == said(&right)),
            "ne" => return flag(said(&left) != said(&right)),
            "in" | "ni" => {
                let all = Value::new(said(&right)).items().map_err(|e| self.wrong(&e))?;
                return flag(all.iter().any(|v| v.str() == said(&left)) == (op == "in"));
            }
            _ => {}
        }
        let reads = |t: &Term| match t {
            Term::Number(n) => Some(*n),
            Term::Text(t) => Number::read(t),
        };
        if LEVELS[7].contains(&op) || LEVELS[8].contains(&op) {
            let order = match (reads(&left), reads(&right)) {
                (Some(Whole(a)), Some(Whole(b))) => a.cmp(&b),
                (Some(a), Some(b)) => {
                    a.real().partial_cmp(&b.real()).unwrap_or(std::cmp::Ordering::Equal)
                }
                _ => said(&left).cmp(&said(&right)),
            };
            return flag(match op {
                "==" => order.is_eq(),
                "!=" => order.is_ne(),
                "<" => order.is_lt(),
                ">" => order.is_gt(),
                "<=" => order.is_le(),
                _ => order.is_ge(),
            });
        }
        let (a, b) = (self.number(&left)?, self.number(&right)?);
        let out = match (op, a, b) {
            ("/" | "%", Whole(_), Whole(0)) => return Err(self.wrong("a division by zero")),
            ("/", a, b) if b.real() == 0.0 => {
                return Err(self.wrong(&format!("a division of {} by zero", a.text())));
            }
            ("+", Whole(a), Whole(b)) => a.checked_add(b).map(Whole),
            ("-", Whole(a), Whole(b)) => a.checked_sub(b).map(Whole),
            ("*", Whole(a), Whole(b)) => a.checked_mul(b).map(Whole),
            // Whole numbers are divided downwards.
            ("/", Whole(a), Whole(b)) => {
                a.checked_div(b).map(|q| Whole(q - i64::from(a % b != 0 && (a < 0) != (b < 0))))
            }
            ("%", Whole(a), Whole(b)) => a
                .checked_rem(b)
                .map(|r| Whole(if r != 0 && (r < 0) != (b < 0) { r + b } else { r })),
            ("<<", Whole(a), Whole(b)) => u32::try_from(b)
                .ok()
                .filter(|b| *b < 62)
                .and_then(|b| a.checked_mul(1 << b))
                .map(Whole),
            (">>", Whole(a), Whole(b)) => Some(Whole(a >> b.clamp(0, 63))),
            ("&", Whole(a), Whole(b)) => Some(Whole(a & b)),
            ("|", Whole(a), Whole(b)) => Some(Whole(a | b)),
            ("^", Whole(a), Whole(b)) => Some(Whole(a ^ b)),
            ("+", a, b) => Some(Real(a.real() + b.real())),
            ("-", a, b) => Some(Real(a.real() - b.real())),
            ("*", a, b) => Some(Real(a.real() * b.real())),
            ("/", a, b) => Some(Real(a.real() / b.real())),
            _ => return Err(self.wrong(&format!("`{op}` of a number that is not whole"))),
        };
        self.finite(out)
    }
}

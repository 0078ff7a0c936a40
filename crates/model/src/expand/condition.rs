//! Conditions: `"i != k and k <= storeys"`.
//!
//! ```text
//! or         = and { "or" and }
//! and        = not { "and" not }
//! not        = ["not"] not | "(" or ")" | expression (==|!=|<=|>=|<|>) expression
//! ```
//!
//! The expressions on both sides of a comparison are those of numbers, with dimensions.

use super::{Expanded, Expander};
use crate::Span;
use crate::expression::{ExpressionError, compared, evaluate};
use crate::parameters::Evaluated;

const COMPARISONS: [&str; 6] = ["==", "!=", "<=", ">=", "<", ">"];
/// Parentheses in parentheses, and `not` of `not`.
const DEPTH: usize = 16;

type Told<T> = Result<T, Option<ExpressionError>>;

impl Expander<'_, '_> {
    /// True where a condition holds.
    pub(super) fn holds(&mut self, text: &str, span: &Span) -> Expanded<bool> {
        let mut scope = self.scope(span.start);
        match or(text, 0, 0, &mut scope) {
            Ok(holds) => Ok(holds),
            Err(error) => self.refuse_expression(error, span, text),
        }
    }
}

/// Parts of a condition between words that stand outside of parentheses, each with its place.
fn split<'t>(text: &'t str, word: &str) -> Vec<(usize, &'t str)> {
    let (mut depth, mut start) = (0_usize, 0);
    let mut parts = Vec::new();
    let part_of_name = |c: char| c.is_alphanumeric() || c == '_';
    let mut last = ' ';
    for (i, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ if depth == 0 && i >= start && !part_of_name(last) => {
                let behind = text[i..].strip_prefix(word);
                if behind.is_some_and(|b| !b.starts_with(part_of_name)) {
                    parts.push((start, &text[start..i]));
                    start = i + word.len();
                }
            }
            _ => {}
        }
        last = c;
    }
    parts.push((start, &text[start..]));
    parts
}

fn or(text: &str, at: usize, depth: usize, scope: &mut Evaluated<'_>) -> Told<bool> {
    // All parts are looked at: a wrong name is told whatever stands before it.
    let mut holds = false;
    for (start, part) in split(text, "or") {
        let mut all = true;
        for (inner, part) in split(part, "and") {
            all &= not(part, at + start + inner, depth, scope)?;
        }
        holds |= all;
    }
    Ok(holds)
}

fn not(text: &str, at: usize, depth: usize, scope: &mut Evaluated<'_>) -> Told<bool> {
    let trimmed = text.trim();
    let at = at + (text.len() - text.trim_start().len());
    let wrong = |message: String| {
        let help = "write for instance `i != k and k <= 4`".to_owned();
        let span = at..at + trimmed.len();
        Err(Some(ExpressionError { code: "E0108", message, help: Some(help), span }))
    };
    if depth > DEPTH {
        return wrong(format!("the condition is nested deeper than {DEPTH}"));
    }
    if let Some(rest) = trimmed.strip_prefix("not")
        && rest.starts_with([' ', '('])
    {
        return Ok(!not(rest, at + 3, depth + 1, scope)?);
    }
    // Parentheses around a comparison; those around a number belong to the expression.
    if let Some(inner) = enclosed(trimmed)
        && inner.contains(['<', '>', '=', '!'])
    {
        return or(inner, at + 1, depth + 1, scope);
    }
    let found = trimmed.find(['<', '>', '=', '!']);
    let found = found
        .and_then(|i| COMPARISONS.iter().find(|c| trimmed[i..].starts_with(**c)).map(|c| (i, *c)));
    let Some((i, sign)) = found else {
        return wrong(format!("`{trimmed}` compares nothing"));
    };
    let second = i + sign.len();
    let mut side = |part: Span| {
        evaluate(&trimmed[part.clone()], scope).map_err(|error| {
            error.map(|mut e| {
                e.span = e.span.start + at + part.start..e.span.end + at + part.start;
                e
            })
        })
    };
    let (a, b) = (side(0..i)?, side(second..trimmed.len())?);
    compared(a, b, at..at + trimmed.len())?;
    Ok(match sign {
        "==" => a.value == b.value,
        "!=" => a.value != b.value,
        "<=" => a.value <= b.value,
        ">=" => a.value >= b.value,
        "<" => a.value < b.value,
        _ => a.value > b.value,
    })
}

/// What stands in parentheses that enclose a text as a whole.
fn enclosed(text: &str) -> Option<&str> {
    let inner = text.strip_prefix('(')?.strip_suffix(')')?;
    let mut depth = 1_usize;
    for c in inner.chars() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return None;
        }
    }
    Some(inner)
}

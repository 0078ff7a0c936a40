//! `{…}` in texts: whole numbers, and what an index lists.

use super::{Expanded, Expander};
use crate::Span;
use crate::expression::{ExpressionError, evaluate};

/// Largest number that stands in a text.
const LARGEST: f64 = 1e15;

impl Expander<'_, '_> {
    /// A text with its braces filled in: `{k+1}` is a whole number, `{side}` a value of a listed index or a text
    /// parameter, `{{` and `}}` are braces.
    pub(super) fn fill(&mut self, text: &str, span: &Span) -> Expanded<String> {
        let Some(first) = text.find(['{', '}']) else { return Ok(text.to_owned()) };
        let mut out = String::with_capacity(text.len() + 8);
        out.push_str(&text[..first]);
        let mut at = first;
        while let Some(next) = text[at..].find(['{', '}']).map(|i| at + i) {
            out.push_str(&text[at..next]);
            let rest = &text[next..];
            if rest.starts_with("{{") || rest.starts_with("}}") {
                out.push_str(&rest[..1]);
                at = next + 2;
                continue;
            }
            let end = rest.find('}').filter(|_| rest.starts_with('{'));
            let Some(end) = end else {
                let what = if rest.starts_with('{') { "is not closed" } else { "closes nothing" };
                let error = ExpressionError {
                    code: "E0108",
                    message: format!("`{}` {what}", &rest[..1]),
                    help: Some("`{{` and `}}` stand for braces in a text".into()),
                    span: next..next + 1,
                };
                return self.refuse_expression(Some(error), span, text);
            };
            self.put(text, next + 1..next + end, span, &mut out)?;
            at = next + end + 1;
        }
        out.push_str(&text[at..]);
        self.spend_values(out.len() / super::VALUE, span)?;
        Ok(out)
    }

    /// What an expression in braces stands for.
    fn put(&mut self, text: &str, part: Span, span: &Span, out: &mut String) -> Expanded<()> {
        let inside = &text[part.clone()];
        let name = inside.trim();
        if let Some(value) = self.places.index(span.start, name) {
            out.push_str(&value.name());
            return Ok(());
        }
        if let Some(value) = self.c.parameters().text(name) {
            out.push_str(value);
            return Ok(());
        }
        let error = match evaluate(inside, &mut self.scope(span.start)) {
            Ok(q)
                if q.dimension.is_none() && q.value.fract() == 0.0 && q.value.abs() <= LARGEST =>
            {
                out.push_str(&(q.value as i64).to_string());
                return Ok(());
            }
            Ok(q) => {
                let unit = match q.dimension.unit().as_str() {
                    "1" => String::new(),
                    unit => format!(" {unit}"),
                };
                Some(ExpressionError {
                    code: "E0112",
                    message: format!("`{{{inside}}}` is {}{unit}: must be a whole number", q.value),
                    help: Some(
                        "braces in a text hold whole numbers, or a value that an index lists"
                            .into(),
                    ),
                    span: part,
                })
            }
            Err(error) => error.map(|mut e| {
                e.span = e.span.start + part.start..e.span.end + part.start;
                e
            }),
        };
        self.refuse_expression(error, span, text)
    }
}

//! What of a model a script for OpenSees says otherwise, or not at all.

use super::ExportOptions;
use std::fmt::Write;

/// A part of a model and what happens to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// What it is: a kind of element, a section of the model.
    pub kind: String,
    /// Names of the parts.
    pub names: Vec<String>,
    /// Why, or what is different.
    pub why: String,
}

/// All of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Losses {
    /// What keeps the script from being written.
    pub refused: Vec<Loss>,
    /// What was left out on request.
    pub left_out: Vec<Loss>,
    /// What was written by a law that is near, on request.
    pub near: Vec<Loss>,
    /// Outputs that are not recorded, and notes that change no result.
    pub notes: Vec<Loss>,
    leave_out: bool,
    allow_near: bool,
}

impl Losses {
    pub(super) fn new(options: &ExportOptions) -> Self {
        Self { leave_out: options.leave_out, allow_near: options.near, ..Self::default() }
    }

    /// A part without a counterpart.
    pub(super) fn lost(&mut self, kind: &str, name: &str, why: &str) {
        let to = if self.leave_out { &mut self.left_out } else { &mut self.refused };
        add(to, kind, name, why);
    }

    /// A part whose counterpart differs; false where that may not be written.
    pub(super) fn near(&mut self, kind: &str, name: &str, why: &str) -> bool {
        let to = match (self.allow_near, self.leave_out) {
            (true, _) => &mut self.near,
            (false, true) => &mut self.left_out,
            (false, false) => &mut self.refused,
        };
        let why = if self.allow_near { why.to_owned() } else { format!("only near: {why}") };
        add(to, kind, name, &why);
        self.allow_near
    }

    /// What changes no result.
    pub(super) fn note(&mut self, kind: &str, name: &str, why: &str) {
        add(&mut self.notes, kind, name, why);
    }

    /// True where results of the script are not those of the model.
    #[must_use]
    pub fn matter(&self) -> bool {
        !(self.left_out.is_empty() && self.near.is_empty() && self.refused.is_empty())
    }

    /// The report.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = String::new();
        for (head, all) in [
            ("NO COUNTERPART in OpenSees", &self.refused),
            ("LEFT OUT: this changes results", &self.left_out),
            ("NEAR: this changes results", &self.near),
            ("notes", &self.notes),
        ] {
            if all.is_empty() {
                continue;
            }
            let _ = writeln!(out, "{head}");
            for loss in all {
                let _ = writeln!(out, "  {}", loss.line());
            }
        }
        out
    }
}

impl Loss {
    /// Names that a line shows.
    const SHOWN: usize = 8;

    /// One line.
    #[must_use]
    pub fn line(&self) -> String {
        let shown: Vec<String> = self
            .names
            .iter()
            .take(Self::SHOWN)
            .map(|n| format!("\"{}\"", trilith_model::visible_line(n)))
            .collect();
        let more = self.names.len().saturating_sub(Self::SHOWN);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        let space = if shown.is_empty() { "" } else { " " };
        format!("{}{space}{}{more}: {}", self.kind, shown.join(", "), self.why)
    }
}

fn add(to: &mut Vec<Loss>, kind: &str, name: &str, why: &str) {
    match to.iter_mut().find(|l| l.kind == kind && l.why == why) {
        Some(known) if known.names.iter().any(|n| n == name) => {}
        Some(known) => known.names.push(name.into()),
        None => {
            let names = if name.is_empty() { Vec::new() } else { vec![name.into()] };
            to.push(Loss { kind: kind.into(), names, why: why.into() });
        }
    }
}

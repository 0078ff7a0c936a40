//! What a run finds wrong with the law of a link.

/// How the law of a link broke its [contract](trilith_element::Link) in a run, or why it has no answer there. The conformance kit
/// (`trilith_element::conformance`) finds the same, and more, without a run.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum LawFault {
    /// An answer that is no finite number.
    NotFinite {
        /// What it is, such as `force of U2`.
        quantity: String,
        /// Its value.
        value: f64,
        /// True where the law says that it does not look at rates, and so is given none.
        without_rates: bool,
    },
    /// It has no answer, and says why.
    Refuses {
        /// What is no number there, such as `force of U2`.
        quantity: String,
        /// Its own words.
        why: String,
    },
    /// What it stores and turns to heat is not the work that is done on it, however short the steps.
    Energies {
        /// From when on this was looked at, s; none where no time goes on.
        since: Option<f64>,
        /// Work done on it since then, J.
        work: f64,
        /// Change of its stored energy and its heat since then, J.
        accounted: f64,
    },
    /// Asked the same again, it answers otherwise.
    Changes {
        /// What it is, such as `force of U2`.
        quantity: String,
        /// The answer with which the step was made, N or N·m.
        first: f64,
        /// The answer now.
        again: f64,
    },
    /// Right after the start of a step its force is not that with which the last one ended.
    Jumps {
        /// What it is, such as `force of U2`.
        quantity: String,
        /// At the end of the step, N or N·m.
        end: f64,
        /// At the start of the next.
        start: f64,
    },
    /// Something went wrong in it, which it tells.
    Failed {
        /// What it says.
        message: String,
    },
    /// It panicked.
    Panicked {
        /// What the panic said.
        message: String,
    },
}

impl LawFault {
    /// A sentence about the law of a link; `when`: such as `at t = 0.1 s`.
    #[must_use]
    pub fn text(&self, link: &str, when: &str) -> String {
        let law = format!("the law of \"{link}\"");
        match self {
            Self::NotFinite { quantity, value, without_rates } => {
                let why = if *without_rates {
                    "; it says that it does not look at rates (`uses_rates`), so it is given NaN for them"
                } else {
                    ""
                };
                format!("{law} gives no finite number {when}: {quantity} is {value}{why}")
            }
            Self::Refuses { quantity, why } => {
                format!("{law} has no answer {when}: {why} ({quantity} is no number there)")
            }
            Self::Energies { since, work, accounted } => {
                let share = 100.0 * accounted / work;
                let share = if share.is_finite() && share.abs() < 1e6 {
                    format!("accounts for {share:.4} % of its work")
                } else {
                    "does not account for its work".into()
                };
                let since = match since {
                    Some(t) => format!("since t = {t:.6} s"),
                    None => "in the last step".into(),
                };
                format!(
                    "{law} {share} {when}: {since} it took {work:.4e} J, and what it stored and turned to heat comes to {accounted:.4e} J, however short the steps are"
                )
            }
            Self::Changes { quantity, first, again } => format!(
                "{law} does not answer the same twice {when}: {quantity} is {first:e}, and {again:e} when it is asked again; all that it remembers belongs in its history, and all forms of it must answer alike"
            ),
            Self::Jumps { quantity, end, start } => format!(
                "{law} does not go on from where it was {when}: {quantity} is {end:e} at the end of a step, and {start:e} right after the start of the next"
            ),
            Self::Failed { message } => format!("{law} failed {when}: {message}"),
            Self::Panicked { message } => format!("{law} panicked {when}: {message}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_told_where_there_are_some() {
        let fault = |work: f64| LawFault::Energies { since: Some(0.5), work, accounted: 3.0 };
        let text = fault(1.5).text("w", "at t = 1 s");
        assert!(
            text.starts_with("the law of \"w\" accounts for 200.0000 % of its work at t = 1 s: "),
            "{text}"
        );
        let text = fault(0.0).text("w", "at t = 1 s");
        assert!(text.starts_with("the law of \"w\" does not account for its work at"), "{text}");
    }
}

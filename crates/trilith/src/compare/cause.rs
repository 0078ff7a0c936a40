//! Why two runs differ, by experiment.

use super::measure::difference;
use super::setup::{NUDGE, Setup, Wider};
use super::{Comparison, Difference};
use crate::Error;
use std::fmt;
use trilith_model::{Analysis, Kernel, Model, SolverKind};
use trilith_solvers::SolveError;

/// Differences below this are agreement.
const AGREE: f64 = 1e-3;
/// An experiment that leaves this share of a difference, or less, shows its cause.
const LEFT: f64 = 0.5;
/// A nudge that makes this share of a difference shows that the response is sensitive.
const SENSITIVE: f64 = 0.3;
/// Largest structure that is solved with its complete basis.
const COMPLETE: usize = 1500;
/// Loose link equations, beyond this tolerance.
const LOOSE: f64 = 1e-8;

/// What makes two runs differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// They agree.
    None,
    /// Next to nothing changes the response as much: it is not repeatable in detail.
    Sensitive,
    /// The basis is too small.
    Basis,
    /// The steps are too long.
    Step,
    /// HHT's numerical damping.
    Algorithm,
    /// The dummies.
    Dummies,
    /// The link equations are not solved well enough.
    Links,
    /// Several of these together.
    Several,
    /// None of these.
    Unknown,
}

impl Cause {
    /// A word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::None => "agreement",
            Self::Sensitive => "sensitive response",
            Self::Basis => "basis",
            Self::Step => "step",
            Self::Algorithm => "numerical damping",
            Self::Dummies => "dummies",
            Self::Links => "link equations",
            Self::Several => "several causes",
            Self::Unknown => "cause unknown",
        }
    }
}

/// The cause of a difference with what shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The cause.
    pub cause: Cause,
    /// A sentence with the numbers.
    pub text: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.cause.word(), self.text)
    }
}

/// Something taken away from both runs.
struct Experiment {
    cause: Cause,
    words: String,
    pair: [Setup; 2],
}

/// A share in percent with two digits.
fn percent(x: f64) -> String {
    let x = 100.0 * x;
    let digits = if x == 0.0 { 0 } else { (1 - x.abs().log10().floor() as i32).clamp(0, 9) };
    format!("{x:.*} %", digits as usize)
}

/// Looks for the cause of the largest of the differences.
pub(crate) fn find(
    all: &mut Comparison<'_>,
    pair: [Setup; 2],
    differences: &[Difference],
) -> Result<Option<Finding>, Error> {
    let Some(worst) = differences.iter().max_by(|a, b| a.rms.total_cmp(&b.rms)) else {
        return Ok(None);
    };
    let (output, name, whole) = (worst.output, worst.name.as_str(), worst.rms);
    let found = |cause, text| Ok(Some(Finding { cause, text }));
    if whole < AGREE {
        let text = format!("no output differs by more than {} (rms; {name})", percent(whole));
        return found(Cause::None, text);
    }
    let [first, other] = pair.clone().map(|s| all.outcome(&s));
    let (first, other) = (first?, other?);
    // A response that a millionth of the load changes as much cannot be compared by value.
    let mut nudged = pair[0].clone();
    nudged.nudged = true;
    let by_nudge = match run(all, &nudged)? {
        Some(o) => difference(output, &first, &o).rms,
        None => 0.0,
    };
    if by_nudge > SENSITIVE * whole {
        let text = format!(
            "loads larger by {NUDGE:e} of themselves change {name} by {} in the first run alone; the two differ by {}",
            percent(by_nudge),
            percent(whole)
        );
        return found(Cause::Sensitive, text);
    }
    let vectors = [&first, &other].map(|o| o.summary.basis.as_ref().map(|b| b.vectors));
    let experiments = experiments(all.model, all.case, &pair, first.order, vectors);
    let mut best: Option<(f64, &Experiment)> = None;
    for e in &experiments {
        if let Some(left) = left(all, &e.pair, output)?
            && best.as_ref().is_none_or(|(b, _)| left < *b)
        {
            best = Some((left, e));
        }
    }
    let Some((rest, e)) = best else {
        return found(
            Cause::Unknown,
            format!("{name} differs by {}, and no setting is left to try", percent(whole)),
        );
    };
    let falls = |words: &str, left: f64| {
        format!(
            "{words} the difference of {name} falls from {} to {}",
            percent(whole),
            percent(left)
        )
    };
    if rest <= LEFT * whole {
        return found(e.cause, falls(&e.words, rest));
    }
    let mut joint = pair.clone();
    for (k, setup) in joint.iter_mut().enumerate() {
        for e in &experiments {
            join(setup, &e.pair[k]);
        }
    }
    if experiments.len() > 1
        && let Some(together) = left(all, &joint, output)?
        && together <= LEFT * whole
    {
        let words: Vec<&str> = experiments.iter().map(|e| e.words.as_str()).collect();
        return found(Cause::Several, falls(&words.join(" and "), together));
    }
    let text = format!(
        "{name} differs by {}; {} it still differs by {}, and no other setting takes more away",
        percent(whole),
        e.words,
        percent(rest)
    );
    found(Cause::Unknown, text)
}

/// What an experiment leaves of the difference; none where it cannot be made.
fn left(all: &mut Comparison<'_>, pair: &[Setup; 2], output: usize) -> Result<Option<f64>, Error> {
    let (Some(a), Some(b)) = (run(all, &pair[0])?, run(all, &pair[1])?) else { return Ok(None) };
    Ok(Some(difference(output, &a, &b).rms))
}

/// A run that may fail: an experiment then says nothing.
fn run(
    all: &mut Comparison<'_>,
    setup: &Setup,
) -> Result<Option<std::rc::Rc<super::Outcome>>, Error> {
    match all.outcome(setup) {
        Ok(outcome) => Ok(Some(outcome)),
        Err(Error::Solve(SolveError::BasisTooLarge { .. })) => Ok(None),
        Err(e) => Err(e),
    }
}

fn join(to: &mut Setup, from: &Setup) {
    to.fine |= from.fine;
    to.conserving |= from.conserving;
    to.own_dummies |= from.own_dummies;
    to.exact_links |= from.exact_links;
    to.basis = to.basis.or(from.basis);
}

fn experiments(
    model: &Model,
    case: usize,
    pair: &[Setup; 2],
    order: usize,
    vectors: [Option<usize>; 2],
) -> Vec<Experiment> {
    let Some(Analysis::Dynamic(d)) = model.cases.get(case).map(|c| &c.analysis) else {
        return Vec::new();
    };
    let mut all = Vec::new();
    let mut add = |cause, words: String, change: &dyn Fn(&mut Setup)| {
        let mut changed = pair.clone();
        changed.iter_mut().for_each(change);
        if changed != *pair {
            all.push(Experiment { cause, words, pair: changed });
        }
    };
    // Cheap and sharp causes first: of equal ones the first counts.
    let most = vectors.into_iter().flatten().max().unwrap_or(0);
    let least = vectors.into_iter().flatten().min().unwrap_or(0);
    let (wider, words) = match order <= COMPLETE {
        true => (Wider::All, format!("with all vectors instead of {least}")),
        false => {
            (Wider::Vectors(2 * most), format!("with {} instead of {least} vectors", 2 * most))
        }
    };
    if least < order && least > 0 {
        add(Cause::Basis, words, &|s| {
            if s.variant.is_reduced() {
                s.basis = Some(wider);
            }
        });
    }
    let alpha = |s: &Setup| s.variant.alpha.unwrap_or(d.solution.alpha);
    if pair.iter().any(|s| alpha(s) < 0.0) {
        add(Cause::Algorithm, "without numerical damping (α = 0)".into(), &|s| {
            s.conserving = s.variant.solver != SolverKind::Fna && alpha(s) < 0.0;
        });
    }
    add(Cause::Dummies, "with dummies chosen by the program".into(), &|s| {
        s.own_dummies = s.variant.is_reduced() && s.variant.dummies.is_some();
    });
    if d.solution.kernel == Kernel::FixedPoint || d.solution.link_tolerance > LOOSE {
        let words = "with link equations solved exactly (Newton, 1e-11)";
        add(Cause::Links, words.into(), &|s| s.exact_links = true);
    }
    add(Cause::Step, "with steps a fraction as long".into(), &|s| s.fine = true);
    all
}

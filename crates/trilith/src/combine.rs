//! Combinations of cases: what the extremes of several runs make together.
//!
//! ```
//! let text = r#"(
//!     nodes: { "base": (0, 0, 0), "top": (0, 0, 3) },
//!     supports: { "base": Fixed },
//!     elements: { "column": Beam(nodes: ("base", "top"), young: "200 GPa", poisson: 0.3, width: "20 cm", depth: "20 cm") },
//!     loads: { "wind": [(node: "top", dof: Ux, force: "1 kN")], "roof": [(node: "top", dof: Uz, force: "-10 kN")] },
//!     cases: { "dead": Static(loads: ["roof"]), "wind": Static(loads: ["wind"]) },
//!     combinations: {
//!         "strength": LinearAdd(cases: { "dead": 1.35, "wind": 1.5 }),
//!         "lifting": LinearAdd(cases: { "dead": 0.9, "wind": 1.5 }),
//!         "design": Envelope(cases: ["strength", "lifting"]),
//!     },
//!     outputs: { "N": Reaction(node: "base", dof: Uz), "M": Reaction(node: "base", dof: Ry) },
//! )"#;
//! let model = trilith::read_text(text, "column.ron", &trilith::registry(), &[])?;
//! let found = trilith::combine::combine(&model, &[])?;
//! let design = &found.combinations[2];
//! let n = &design.outputs[0];
//! assert!((n.max - 13.5e3).abs() < 1e-3 && (n.min - 9.0e3).abs() < 1e-3);
//! assert_eq!((n.max_from.as_deref(), n.min_from.as_deref()), (Some("strength"), Some("lifting")));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::{Analysis, Error};
use serde::Serialize;
use std::sync::atomic::AtomicBool;
use trilith_model::{
    Analysis as CaseAnalysis, Combination, CombinationTerm, CombineCases, Model, Output,
    visible_line,
};
use trilith_solvers::Status;

/// What was found.
#[derive(Clone, Debug, Serialize)]
pub struct Combinations {
    /// The cases that were run, in the order of the model.
    pub cases: Vec<CombinedCase>,
    /// The combinations, in the order of the model.
    pub combinations: Vec<Combined>,
}

/// A case that was run for combinations.
#[derive(Clone, Debug, Serialize)]
pub struct CombinedCase {
    /// Its name.
    pub name: String,
    /// Name of its solver.
    pub solver: &'static str,
    /// Its outputs; the largest and the smallest value of a static case are both that at its end.
    pub outputs: Vec<CombinedOutput>,
    /// What the user should know of the run.
    pub warnings: Vec<String>,
}

/// A combination.
#[derive(Clone, Debug, Serialize)]
pub struct Combined {
    /// Its name.
    pub name: String,
    /// How its terms are put together; in JSON as a file names it.
    #[serde(serialize_with = "named")]
    pub how: CombineCases,
    /// Names of its terms with their factors.
    pub terms: Vec<(String, f64)>,
    /// What it adds twice: a case, and one that continues it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub twice: Option<[String; 2]>,
    /// Its outputs, in the order of the model, without hidden ones.
    pub outputs: Vec<CombinedOutput>,
}

impl Combined {
    /// What it adds twice, in a sentence; none where that is nothing.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        let [earlier, later] = self.twice.as_ref()?.each_ref().map(|name| visible_line(name));
        Some(format!(
            "it adds \"{earlier}\" and \"{later}\", which continues it: what \"{earlier}\" does is in both"
        ))
    }
}

fn named<S: serde::Serializer>(how: &CombineCases, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(how.name())
}

/// An output of a case or of a combination.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CombinedOutput {
    /// Its name.
    pub output: String,
    /// Its SI unit.
    pub unit: String,
    /// Largest value.
    pub max: f64,
    /// Smallest value.
    pub min: f64,
    /// The term of an envelope that the largest value comes from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_from: Option<String>,
    /// The term of an envelope that the smallest value comes from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min_from: Option<String>,
}

/// Why there are no combinations.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CombineError {
    /// A combination that the model does not have.
    #[error("there is no combination \"{name}\"; the combinations are {}", .all.join(", "))]
    Unknown {
        /// The name asked for.
        name: String,
        /// The names there are.
        all: Vec<String>,
    },
    /// The model combines nothing.
    #[error("the model has no combination")]
    None,
    /// A case came to no good end.
    #[error("case \"{case}\": {reason}")]
    Case {
        /// Its name.
        case: String,
        /// How it ended.
        reason: String,
    },
    /// A case cannot be run.
    #[error(transparent)]
    Run(#[from] Error),
}

/// Runs the cases of some combinations, or of all where none are named, each with its own solver, and combines them.
///
/// # Errors
/// [`CombineError`].
pub fn combine(model: &Model, names: &[String]) -> Result<Combinations, CombineError> {
    combine_until(model, names, &mut |_, _| (), None)
}

/// The same; `tell` hears of the case that runs and the finished share of all, and a flag ends it once it is true.
///
/// # Errors
/// As [`combine`], and [`Error::Interrupted`].
pub fn combine_until(
    model: &Model,
    names: &[String],
    tell: &mut dyn FnMut(&str, f64),
    interrupt: Option<&AtomicBool>,
) -> Result<Combinations, CombineError> {
    let wanted = wanted(model, names)?;
    let needed = needed(model, &wanted);
    let analysis = Analysis::new(model)?.without_histories();
    let mut cases: Vec<Option<CombinedCase>> = vec![None; model.cases.len()];
    let count = needed.iter().filter(|needed| **needed).count() as f64;
    for i in (0..model.cases.len()).filter(|i| needed[*i]) {
        let done = cases.iter().flatten().count() as f64;
        let name = &model.cases[i].name;
        let mut progress = |share: f64| tell(name, (done + share) / count);
        let mut run = analysis.case(name)?.progress(&mut progress);
        if let Some(flag) = interrupt {
            run = run.interrupt(flag);
        }
        cases[i] = Some(case(model, i, &run.run()?)?);
    }
    let mut all: Vec<Option<Combined>> = Vec::with_capacity(model.combinations.len());
    for combination in &model.combinations {
        // Nobody wants those of cases that have not been run.
        let of = |(term, factor): &(CombinationTerm, f64)| {
            let term = match *term {
                CombinationTerm::Case(i) => cases[i].as_ref().map(|c| (&c.name, &c.outputs[..])),
                CombinationTerm::Combination(i) => {
                    all[i].as_ref().map(|c| (&c.name, &c.outputs[..]))
                }
            };
            Some((term?, *factor))
        };
        let terms: Option<Vec<_>> = combination.terms.iter().map(of).collect();
        let twice = twice(model, combination);
        let found = terms.map(|terms| Combined { twice, ..combined(combination, &terms) });
        all.push(found);
    }
    let combinations = wanted.into_iter().filter_map(|i| all[i].clone()).collect();
    Ok(Combinations { cases: cases.into_iter().flatten().collect(), combinations })
}

/// Indices of the combinations of these names; of all where there are none.
fn wanted(model: &Model, names: &[String]) -> Result<Vec<usize>, CombineError> {
    let all = &model.combinations;
    if all.is_empty() {
        return Err(CombineError::None);
    }
    if names.is_empty() {
        return Ok((0..all.len()).collect());
    }
    let of = |name: &String| {
        let unknown = || CombineError::Unknown {
            name: name.clone(),
            all: all.iter().map(|c| format!("\"{}\"", c.name)).collect(),
        };
        all.iter().position(|c| c.name == *name).ok_or_else(unknown)
    };
    names.iter().map(of).collect()
}

/// Which cases some combinations need.
fn needed(model: &Model, wanted: &[usize]) -> Vec<bool> {
    let mut cases = vec![false; model.cases.len()];
    let mut open = wanted.to_vec();
    let mut seen = vec![false; model.combinations.len()];
    while let Some(i) = open.pop() {
        if std::mem::replace(&mut seen[i], true) {
            continue;
        }
        for (term, _) in &model.combinations[i].terms {
            match *term {
                CombinationTerm::Case(case) => cases[case] = true,
                CombinationTerm::Combination(other) => open.push(other),
            }
        }
    }
    cases
}

/// What a run has to give.
fn case(model: &Model, index: usize, run: &crate::Run) -> Result<CombinedCase, CombineError> {
    let case = &model.cases[index];
    let status = &run.result.status;
    if matches!(status, Status::Interrupted { .. }) {
        return Err(Error::Interrupted.into());
    }
    // Where a body lies has nothing to do with what it bears.
    if !matches!(status, Status::Converged) {
        return Err(CombineError::Case { case: case.name.clone(), reason: status.text() });
    }
    let is_static = matches!(case.analysis, CaseAnalysis::Static(_));
    let output = |(_, output): (usize, &Output)| {
        let peak = run.peak(&output.name)?;
        let [max, min] = if is_static { [peak.last; 2] } else { [peak.max, peak.min] };
        let (output, unit) = (output.name.clone(), output.unit.clone());
        Ok(CombinedOutput { output, unit, max, min, max_from: None, min_from: None })
    };
    let summary = run.summary(model);
    Ok(CombinedCase {
        name: case.name.clone(),
        solver: summary.solver,
        outputs: model.shown().map(output).collect::<Result<_, Error>>()?,
        warnings: summary.warnings,
    })
}

/// A case that a sum has in one term, and one that continues it in another: what the first does is in both.
fn twice(model: &Model, combination: &Combination) -> Option<[String; 2]> {
    if combination.how == CombineCases::Envelope {
        return None;
    }
    let cases: Vec<Vec<usize>> =
        combination.terms.iter().map(|(t, _)| cases_of(model, *t)).collect();
    let continues = |later: usize, earlier: usize| {
        let before = |case: &usize| model.cases[*case].after;
        std::iter::successors(before(&later), before).any(|case| case == earlier)
    };
    for (i, own) in cases.iter().enumerate() {
        let others = || cases.iter().enumerate().filter(|(j, _)| *j != i).flat_map(|(_, c)| c);
        for earlier in own {
            if let Some(later) = others().find(|later| continues(**later, *earlier)) {
                return Some([*earlier, *later].map(|case| model.cases[case].name.clone()));
            }
        }
    }
    None
}

/// All cases that a term stands for.
fn cases_of(model: &Model, term: CombinationTerm) -> Vec<usize> {
    match term {
        CombinationTerm::Case(case) => vec![case],
        CombinationTerm::Combination(i) => {
            let needed = needed(model, &[i]);
            (0..needed.len()).filter(|case| needed[*case]).collect()
        }
    }
}

/// A term: its name and outputs, and its factor.
type Term<'a> = ((&'a String, &'a [CombinedOutput]), f64);

fn combined(combination: &Combination, terms: &[Term<'_>]) -> Combined {
    let output = |i: usize, one: &CombinedOutput| {
        let of: Vec<_> =
            terms.iter().map(|((_, of), factor)| ([of[i].min, of[i].max], *factor)).collect();
        let ([min, max], from) = combination.how.of(&of);
        let [min_from, max_from] = from.map(|term| term.map(|t| terms[t].0.0.clone()));
        let (output, unit) = (one.output.clone(), one.unit.clone());
        CombinedOutput { output, unit, max, min, max_from, min_from }
    };
    let outputs = terms.first().map_or(&[][..], |((_, outputs), _)| outputs);
    Combined {
        name: combination.name.clone(),
        how: combination.how,
        twice: None,
        terms: terms.iter().map(|((name, _), factor)| ((*name).clone(), *factor)).collect(),
        outputs: outputs.iter().enumerate().map(|(i, one)| output(i, one)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_end_that_somebody_wanted_is_told_as_such() {
        let text = r#"(
            nodes: { "m": (0, 0, 0) },
            supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
            elements: { "mass": Mass(node: "m", mass: 1), "spring": Spring(node: "m", k2: 1) },
            cases: { "go": Dynamic(duration: 1, dt: 0.01, initial: [(node: "m", dof: Ux, velocity: 1)]) },
            combinations: { "all": Envelope(cases: ["go"]) },
            outputs: { "x": Displacement(node: "m", dof: Ux) },
        )"#;
        let model = crate::read_text(text, "m.ron", &crate::registry(), &[]).expect("a model");
        let found = combine_until(&model, &[], &mut |_, _| (), Some(&AtomicBool::new(true)));
        assert!(matches!(found, Err(CombineError::Run(Error::Interrupted))), "{found:?}");
        let found = combine_until(&model, &[], &mut |_, _| (), Some(&AtomicBool::new(false)));
        assert!(found.is_ok_and(|found| found.combinations[0].how == CombineCases::Envelope));
    }
}

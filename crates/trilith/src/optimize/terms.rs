//! What is minimised and limited: expressions in outputs and parameters, with their derivatives.
//!
//! A name is that of an output, whose largest magnitude it stands for, that of a parameter, `input`, `heat`, or `heat of` a link. Expressions are those of model
//! files, units included; they are differentiated by differences of the expression alone, whose parts have exact derivatives.

use super::OptimizeError;
use crate::gradient::{HEAT, HEAT_OF, INPUT};
use std::collections::BTreeMap;
use trilith_element::Dimension;
use trilith_element::dimension::NONE;
use trilith_model::file::{NoNames, Quantity, Scope, evaluate, names_help};
use trilith_model::{Body, Model, ParameterValue};
use trilith_solvers::gradient::{Around, Gradient, OFFSETS, OutputGradient};

/// Step of differences of an expression, as share of what is moved.
const STEP: f64 = 1e-3;
const WEIGHTS: [f64; 4] = [1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0];
/// Exponent of the norm that stands for the largest of several values: at most by 6 % above the largest of ten.
const NORM: f64 = 40.0;
/// Extremes below this share of the largest are nothing in it.
const SHARE: f64 = 0.7;

/// A value with its derivatives by the variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Valued {
    pub value: f64,
    pub by: Vec<f64>,
}

/// What names of expressions stand for in a run.
pub(super) struct Values {
    all: BTreeMap<String, (Valued, Quantity)>,
    /// Of outputs: all large extremes of their histories.
    extremes: BTreeMap<String, Vec<Valued>>,
}

/// Where the magnitude of a history is larger than before and after, and large.
fn extremes(of: &OutputGradient) -> Vec<Valued> {
    let size = |i: usize| of.history[i].abs();
    let n = of.history.len();
    let most = (0..n).map(size).fold(0.0, f64::max);
    let is_one = |i: &usize| {
        let above = |j: Option<usize>| j.filter(|j| *j < n).is_none_or(|j| size(*i) >= size(j));
        size(*i) >= SHARE * most && above(i.checked_sub(1)) && above(Some(i + 1))
    };
    let valued = |i: usize| {
        let by = of.by.iter().map(|by| by[i] * of.history[i].signum());
        Valued { value: size(i), by: by.collect() }
    };
    (0..n).filter(is_one).map(valued).collect()
}

/// What stands in front of the name of an output for its value at the end.
const END: &str = "final_of_";

fn end_of(output: &str) -> String {
    format!("{END}{output}")
}

fn dimension(unit: &str) -> Dimension {
    evaluate(&format!("1 {unit}"), &mut NoNames).map_or(NONE, |q| q.dimension)
}

impl Values {
    /// Of a run: largest magnitudes of outputs, their values at the end, parameters.
    pub(super) fn new(model: &Model, found: &Gradient, around: &[Around]) -> Self {
        let mut all = BTreeMap::new();
        let own = found.outputs.iter().map(|of| (of.name.clone(), extremes(of)));
        let extremes = own.collect();
        let mut add = |name: String, of: Valued, dimension: Dimension| {
            let quantity = Quantity { value: of.value, dimension, measured: !dimension.is_none() };
            all.insert(name, (of, quantity));
        };
        for (i, p) in model.parameters.iter().enumerate() {
            let ParameterValue::Number(value, dimension) = p.value else { continue };
            // Of parameters that are made of others, too.
            let near = |around: &Around| {
                let of = |m: &Model| match m.parameters.get(i).map(|p| &p.value) {
                    Some(ParameterValue::Number(x, _)) => *x,
                    _ => value,
                };
                let sum: f64 = WEIGHTS.iter().zip(&around.near).map(|(w, m)| w * of(m)).sum();
                sum / around.of.step
            };
            let by = around.iter().map(near).collect();
            add(p.name.clone(), Valued { value, by }, dimension);
        }
        for (output, of) in model.outputs.iter().zip(&found.outputs) {
            let peak = of.peak();
            let dimension = dimension(&output.unit);
            add(output.name.clone(), Valued { value: peak.value, by: peak.by }, dimension);
            let (value, by) = of.last().unwrap_or_default();
            add(end_of(&output.name), Valued { value, by }, dimension);
        }
        let energy = dimension("J");
        let mut of_energy = |name: String, (value, by): (f64, Vec<f64>)| {
            let quantity = Quantity { value, dimension: energy, measured: true };
            all.entry(name).or_insert((Valued { value, by }, quantity));
        };
        if let Some(input) = &found.input {
            of_energy(INPUT.into(), input.clone());
        }
        of_energy(HEAT.into(), found.all_heat());
        for link in &found.heat {
            of_energy(format!("{HEAT_OF}{}", link.link), (link.heat, link.by.clone()));
        }
        Self { all, extremes }
    }
}

/// The values of a run, one of which may be another one.
struct Moved<'a> {
    values: &'a Values,
    known: &'a Known,
    other: Option<(&'a str, f64)>,
    used: Vec<String>,
}

impl Scope for Moved<'_> {
    fn names(&self) -> Vec<&str> {
        self.known.names.iter().map(String::as_str).collect()
    }

    fn has(&self, name: &str) -> bool {
        self.values.all.contains_key(self.known.meant(name))
    }

    fn value(&mut self, name: &str) -> Result<Quantity, Option<(&'static str, String)>> {
        let name = self.known.meant(name);
        let (_, quantity) = self.values.all.get(name).ok_or(None)?;
        if !self.used.iter().any(|n| n == name) {
            self.used.push(name.to_owned());
        }
        Ok(match self.other {
            Some((moved, value)) if moved == name => Quantity { value, ..*quantity },
            _ => *quantity,
        })
    }
}

/// Names of a model that may stand in expressions, and those in quotes, for which others stand.
#[derive(Clone, Debug, Default)]
struct Known {
    names: Vec<String>,
    quoted: Vec<(String, String)>,
}

impl Known {
    fn meant<'a>(&'a self, name: &'a str) -> &'a str {
        self.quoted.iter().find(|(stand_in, _)| stand_in == name).map_or(name, |(_, n)| n)
    }

    /// Puts a word of letters in place of `name`, and says which.
    fn stand_in(&mut self, name: String) -> String {
        let word = format!("name_in_quotes_{}", self.quoted.len());
        self.quoted.push((word.clone(), name));
        word
    }
}

/// An expression in outputs and parameters.
#[derive(Clone, Debug)]
pub(super) struct Term {
    /// As it was given.
    pub text: String,
    read: String,
    known: Known,
}

impl Term {
    pub(super) fn new(text: &str, model: &Model) -> Result<Self, OptimizeError> {
        let text = text.trim().to_owned();
        let outputs = model.outputs.iter().filter(|o| !o.hidden).map(|o| o.name.clone());
        let mut known = Known { names: outputs.collect(), quoted: Vec::new() };
        let both = known.names.iter().find(|n| model.parameters.iter().any(|p| p.name == **n));
        if let Some(name) = both.filter(|n| text.contains(n.as_str())) {
            let reason = format!("`{name}` is an output and a parameter: give one another name");
            return Err(OptimizeError::Expression { text, reason });
        }
        known.names.extend(model.parameters.iter().map(|p| p.name.clone()));
        let links = model.elements.iter().filter(|e| matches!(e.body, Body::Link(..)));
        known.names.extend(links.map(|e| format!("{HEAT_OF}{}", e.name)));
        known.names.extend([HEAT.into(), INPUT.into()]);
        let wrong =
            |reason: &str| OptimizeError::Expression { text: text.clone(), reason: reason.into() };
        // Names in quotes first, then values at the end.
        let mut read = String::new();
        for (i, part) in text.split('"').enumerate() {
            if i % 2 == 0 {
                read += part;
            } else if known.names.iter().any(|n| n == part) {
                read += &known.stand_in(part.to_owned());
            } else {
                let help = names_help(part, "outputs", known.names.iter().map(String::as_str));
                return Err(wrong(&format!("there is no output \"{part}\": {help}")));
            }
        }
        if text.matches('"').count() % 2 == 1 {
            return Err(wrong("the quotes of a name do not end"));
        }
        while let Some(at) = read.find("final(") {
            let rest = &read[at + "final(".len()..];
            let Some(end) = rest.find(')') else { return Err(wrong("`)` is missing")) };
            let name = known.meant(rest[..end].trim()).to_owned();
            if !model.outputs.iter().any(|o| o.name == name) {
                let all = model.outputs.iter().map(|o| o.name.as_str());
                let help = names_help(&name, "outputs", all);
                return Err(wrong(&format!("there is no output \"{name}\": {help}")));
            }
            let word = known.stand_in(end_of(&name));
            read.replace_range(at..at + "final(".len() + end + 1, &word);
        }
        Ok(Self { text, read, known })
    }

    /// Whether it may name the energy that loads and supports put in.
    pub(super) fn names_input(&self) -> bool {
        self.text.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == INPUT)
    }

    fn evaluate(
        &self,
        values: &Values,
        other: Option<(&str, f64)>,
    ) -> Result<(Quantity, Vec<String>), OptimizeError> {
        let mut scope = Moved { values, known: &self.known, other, used: Vec::new() };
        let found = evaluate(&self.read, &mut scope).map_err(|e| {
            let reason = e.map_or_else(
                || "it has no value".to_owned(),
                |e| match e.help {
                    Some(help) => format!("{}: {help}", e.message),
                    None => e.message,
                },
            );
            OptimizeError::Expression { text: self.text.clone(), reason }
        })?;
        Ok((found, scope.used))
    }

    /// Its value and derivatives in a run, and its dimension.
    pub(super) fn of(&self, values: &Values) -> Result<(Valued, Quantity), OptimizeError> {
        let wrong = |reason: String| OptimizeError::Expression { text: self.text.clone(), reason };
        let (quantity, used) = self.evaluate(values, None)?;
        let mut by: Vec<f64> = Vec::new();
        for name in used {
            let (of, _) = &values.all[&name];
            if of.by.iter().any(|x| x.is_nan()) {
                let output = name.strip_prefix(END).unwrap_or(&name);
                return Err(wrong(format!("`{output}` tells no derivatives")));
            }
            by.resize(of.by.len(), 0.0);
            if of.by.iter().all(|x| *x == 0.0) {
                continue;
            }
            // Of what is zero, its neighbours tell.
            let step = if of.value == 0.0 { STEP * STEP } else { STEP * of.value.abs() };
            let mut slope = 0.0;
            for (offset, weight) in OFFSETS.iter().zip(WEIGHTS) {
                let moved = self.evaluate(values, Some((&name, of.value + offset * step)))?;
                slope += weight * moved.0.value / step;
            }
            by.iter_mut().zip(&of.by).for_each(|(by, x)| *by += slope * x);
        }
        if by.iter().any(|x| x.is_nan()) {
            return Err(wrong("it has no derivatives at the values of a run".into()));
        }
        Ok((Valued { value: quantity.value, by }, quantity))
    }
}

/// What is made smallest: one term, or the largest magnitude of several.
#[derive(Clone, Debug)]
pub(super) struct Goal {
    pub terms: Vec<Term>,
}

impl Goal {
    pub(super) fn new(texts: &[String], model: &Model) -> Result<Self, OptimizeError> {
        let mut terms = Vec::new();
        for text in texts {
            let text = text.trim();
            let Some(begin) = text.strip_suffix('*').filter(|b| !b.is_empty()) else {
                terms.push(Term::new(text, model)?);
                continue;
            };
            // No product ends so: all outputs whose names begin so.
            let shown = model.outputs.iter().filter(|o| !o.hidden);
            let names: Vec<_> = shown.filter(|o| o.name.starts_with(begin)).collect();
            if names.is_empty() {
                let reason = format!("there is no output whose name begins with `{begin}`");
                return Err(OptimizeError::Expression { text: text.into(), reason });
            }
            for output in names {
                let term = Term::new(&format!("\"{}\"", output.name), model)?;
                terms.push(Term { text: output.name.clone(), ..term });
            }
        }
        if terms.is_empty() {
            return Err(OptimizeError::NoGoal);
        }
        Ok(Self { terms })
    }

    /// The goal as it is searched with, what it stands for, and its dimension.
    pub(super) fn of(&self, values: &Values) -> Result<(Valued, f64, Quantity), OptimizeError> {
        let all =
            self.terms.iter().map(|t| t.of(values)).collect::<Result<Vec<_>, OptimizeError>>()?;
        let (first, unit) = &all[0];
        if all.len() == 1 {
            return Ok((first.clone(), first.value, *unit));
        }
        let other = self.terms.iter().zip(&all).find(|(_, (_, u))| !same(u, unit));
        if let Some((term, (_, u))) = other {
            let reason =
                format!("it is in {}, and the first goal in {}", u.dimension, unit.dimension);
            return Err(OptimizeError::Expression { text: term.text.clone(), reason });
        }
        let largest = all.iter().fold(0.0_f64, |m, (v, _)| m.max(v.value.abs()));
        // Of outputs, all that may become their peaks: it makes no kink where one takes the place of another.
        let parts = self.terms.iter().zip(&all).flat_map(|(term, (value, _))| {
            let extremes = values.extremes.get(term.known.meant(&term.read));
            extremes.cloned().unwrap_or_else(|| vec![value.clone()])
        });
        Ok((norm(&parts.collect::<Vec<_>>(), first.by.len()), largest, *unit))
    }
}

/// (Σ xᵖ)^(1/p) with its derivatives.
fn norm(all: &[Valued], count: usize) -> Valued {
    let most = all.iter().fold(0.0_f64, |m, v| m.max(v.value.abs()));
    let mut by = vec![0.0; all.iter().map(|v| v.by.len()).max().unwrap_or(count)];
    if most == 0.0 {
        return Valued { value: 0.0, by };
    }
    let sum: f64 = all.iter().map(|v| (v.value.abs() / most).powf(NORM)).sum();
    for v in all {
        let share = v.value / most;
        let weight = share.signum() * share.abs().powf(NORM - 1.0) * sum.powf(1.0 / NORM - 1.0);
        by.iter_mut().zip(&v.by).for_each(|(by, x)| *by += weight * x);
    }
    Valued { value: most * sum.powf(1.0 / NORM), by }
}

/// True where one can be held against the other.
fn same(a: &Quantity, b: &Quantity) -> bool {
    a.dimension.matches(b.dimension) || !a.measured || !b.measured
}

/// A limit: `left <= bound` or `left >= bound`.
#[derive(Clone, Debug)]
pub(super) struct Limit {
    /// As it was given.
    pub text: String,
    left: Term,
    right: Term,
    /// 1: at most, −1: at least.
    sign: f64,
}

impl Limit {
    /// Whether it may name the energy that loads and supports put in.
    pub(super) fn names_input(&self) -> bool {
        self.left.names_input() || self.right.names_input()
    }

    pub(super) fn new(text: &str, model: &Model) -> Result<Self, OptimizeError> {
        let text = text.trim();
        let split = [("<=", 1.0), (">=", -1.0), ("≤", 1.0), ("≥", -1.0)]
            .into_iter()
            .find_map(|(mark, sign)| text.split_once(mark).map(|(a, b)| (a, b, sign)));
        let Some((left, right, sign)) = split else {
            return Err(OptimizeError::Expression {
                text: text.into(),
                reason: "a limit has `<=` or `>=`, such as `base_x <= 20 cm`".into(),
            });
        };
        let (left, right) = (Term::new(left, model)?, Term::new(right, model)?);
        Ok(Self { text: text.to_owned(), left, right, sign })
    }

    /// Both sides, and by how much of the bound the left one is beyond it: below zero where it holds.
    pub(super) fn of(
        &self,
        values: &Values,
    ) -> Result<([f64; 2], Valued, Quantity), OptimizeError> {
        let (left, unit) = self.left.of(values)?;
        let (right, bound) = self.right.of(values)?;
        if !same(&unit, &bound) {
            let reason = format!(
                "{} is in {}, and its bound in {}",
                self.left.text, unit.dimension, bound.dimension
            );
            return Err(OptimizeError::Expression { text: self.text.clone(), reason });
        }
        let size = if right.value == 0.0 { 1.0 } else { right.value.abs() };
        let n = left.by.len().max(right.by.len());
        let part = |by: &[f64], i: usize| by.get(i).copied().unwrap_or(0.0);
        let grow = if right.value == 0.0 { 0.0 } else { (left.value - right.value) / right.value };
        let by = (0..n).map(|i| {
            let own = part(&left.by, i) - part(&right.by, i) * (1.0 + grow);
            self.sign * own / size
        });
        let beyond =
            Valued { value: self.sign * (left.value - right.value) / size, by: by.collect() };
        Ok(([left.value, right.value], beyond, unit))
    }
}

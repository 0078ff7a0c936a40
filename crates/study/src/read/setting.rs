//! Where in the study each value of a parameter stands, so that what the model says about it is told there.

use crate::shape::Shape;
use crate::{Place, Plan};
use std::collections::{HashMap, HashSet};
use trilith::Registry;
use trilith::model::file::{Context, closest, names_help};
use trilith::model::{Diagnostic, Model, ModelText, ParameterValue, Span, line_column};

/// Values of an axis that are tried before the study begins.
const TRIED: usize = 2000;

/// A value of a parameter in the study.
struct Setting {
    name: String,
    value: String,
    name_span: Span,
    span: Span,
    /// Which part of the study sets it.
    part: &'static str,
}

/// All values of parameters in the study.
#[derive(Default)]
pub(super) struct Settings(Vec<Setting>);

impl Settings {
    pub fn add(
        &mut self,
        part: &'static str,
        (name, name_span): (&str, &Span),
        value: &str,
        span: &Span,
    ) {
        self.0.push(Setting {
            name: name.to_owned(),
            value: value.to_owned(),
            name_span: name_span.clone(),
            span: span.clone(),
            part,
        });
    }

    /// Reports parameters that two parts of the study set. An ensemble may perturb what another part sets.
    pub fn check_twice(&self, c: &Context<'_>) {
        let mut first: HashMap<&str, &Setting> = HashMap::new();
        let mut told: HashSet<&str> = HashSet::new();
        for s in self.0.iter().filter(|s| s.part != "ensemble") {
            let other = *first.entry(&s.name).or_insert(s);
            if other.part != s.part && told.insert(&s.name) {
                let message = format!("`{}` and `{}` both set `{}`", other.part, s.part, s.name);
                c.report(
                    c.diagnostic("E0102", message, s.name_span.clone())
                        .related(other.name_span.clone(), "first given here")
                        .help("keep one of the two"),
                );
            }
        }
    }

    /// Tells errors of the model: at the value of the study where they are about one.
    pub fn tell(
        &self,
        c: &Context<'_>,
        errors: Vec<Diagnostic>,
        only: Option<usize>,
        foreign: &mut Vec<Diagnostic>,
    ) {
        for d in errors {
            let path = d.source.path.to_string_lossy().into_owned();
            let given = path.strip_prefix("--set ").and_then(|t| t.split_once('='));
            let setting = given.and_then(|(name, value)| {
                let all = self.0.iter().enumerate();
                let of_name = |(i, s): &(usize, &Setting)| {
                    s.name == name && only.is_none_or(|only| only == *i)
                };
                let exact = all.clone().filter(of_name).find(|(_, s)| s.value == value);
                exact.or_else(|| all.clone().find(of_name)).map(|(_, s)| s)
            });
            let Some(s) = setting else {
                let told = |f: &Diagnostic| {
                    f.span == d.span && f.message == d.message && f.source.path == d.source.path
                };
                // What only this value brings about, such as a record that cannot be read, is told there.
                if let Some(s) = only.and_then(|i| self.0.get(i))
                    && !foreign.iter().any(told)
                {
                    let (line, column) = line_column(&d.source.text, d.span.start);
                    let place = format!("met at {}:{line}:{column}", d.source.path.display());
                    let help = match d.help {
                        Some(help) => format!("{help}; {place}"),
                        None => place,
                    };
                    c.report(c.diagnostic(d.code, d.message, s.span.clone()).help(help));
                    continue;
                }
                if !foreign.iter().any(told) {
                    foreign.push(d);
                }
                continue;
            };
            let about_name = d.code == "E0119";
            let span = if about_name { &s.name_span } else { &s.span };
            let mut own = c.diagnostic(d.code, d.message, span.clone());
            if let Some(help) = d.help {
                if about_name
                    && let Some(near) =
                        help.strip_prefix("did you mean `").and_then(|h| h.strip_suffix("`?"))
                    && closest(&s.name, [near]).is_some()
                {
                    own = own.suggestion(span.clone(), near);
                }
                own = own.help(help);
            }
            c.report(own);
        }
    }

    /// An ensemble multiplies numbers that the model has.
    pub fn check_perturbed(&self, c: &Context<'_>, model: &Model) {
        for s in self.0.iter().filter(|s| s.part == "ensemble") {
            let found = model.parameters.iter().find(|p| p.name == s.name);
            let at = s.name_span.clone();
            match found.map(|p| &p.value) {
                Some(ParameterValue::Number(..)) => {}
                Some(ParameterValue::Text(_)) => {
                    let message = format!("`{}` is a text: it has no scatter", s.name);
                    c.report(c.diagnostic("E0111", message, at));
                }
                None => {
                    let names = model.parameters.iter().map(|p| p.name.as_str());
                    let message = format!("the model has no parameter `{}`", s.name);
                    let mut d = c.diagnostic("E0119", message, at.clone());
                    if c.suggests() {
                        d = d.help(names_help(&s.name, "parameters", names.clone()));
                        if let Some(near) = closest(&s.name, names) {
                            d = d.suggestion(at, near);
                        }
                    }
                    c.report(d);
                }
            }
        }
    }

    /// The first value of everything; of what is drawn, the median.
    pub fn first(&self, plan: &Plan) -> Vec<(String, String)> {
        let place = Place { row: 0, sample: 0, axes: vec![0; plan.axes.len()], member: 0 };
        let mut set = plan.nominal(&place);
        for s in self.0.iter().filter(|s| s.part == "samples") {
            set.retain(|(name, _)| *name != s.name);
            set.push((s.name.clone(), s.value.clone()));
        }
        set
    }

    /// Tries every value on its own, so that a wrong one is told before anything runs.
    pub fn check_all(
        &self,
        c: &Context<'_>,
        (parsed, shape): (&ModelText, &Shape),
        plan: &Plan,
        registry: &Registry,
        foreign: &mut Vec<Diagnostic>,
    ) {
        let first = self.first(plan);
        for (i, s) in self.0.iter().enumerate().filter(|(_, s)| !s.value.is_empty()).take(TRIED) {
            let mut set = first.clone();
            // Not what a `--set` has replaced.
            let current = set.iter_mut().rev().find(|(name, _)| *name == s.name);
            match (s.part, current) {
                ("axes" | "points", Some(current)) if current.1 != s.value => {
                    current.1.clone_from(&s.value);
                }
                _ => continue,
            }
            match parsed.read(registry, &set) {
                Err(errors) => self.tell(c, errors, Some(i), foreign),
                Ok(model) => {
                    if let Some(message) = shape.misfit(&model) {
                        let help = "a study keeps the same of every run: the cases and outputs of the model must \
                                    not hang on a parameter that it varies";
                        c.report(c.diagnostic("E0118", message, s.span.clone()).help(help));
                    }
                }
            }
        }
    }
}

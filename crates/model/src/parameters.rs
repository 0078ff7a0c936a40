//! The named parameters of a model file and the `--set` arguments that change them.

use crate::diagnostic::{SEARCHED, names_help};
use crate::expression::{Quantity, Scope, evaluate};
use crate::places::Places;
use crate::tree::{Entry, Kind, Node};
use crate::units::FileUnits;
use crate::{Diagnostic, Parameter, ParameterValue, Source};
use std::collections::HashMap;
use std::sync::Arc;

/// Longest chain of parameters that depend on each other.
const CHAIN: usize = 64;

/// The parameters, all evaluated.
#[derive(Debug)]
pub(crate) struct Parameters {
    slots: Vec<Slot>,
    index: HashMap<String, usize>,
    units: FileUnits,
    places: Places,
    stack: Vec<usize>,
    errors: Vec<Diagnostic>,
}

#[derive(Debug)]
struct Slot {
    name: String,
    declared: Node,
    set: Option<String>,
    state: State,
}

#[derive(Clone, Debug)]
enum State {
    Open,
    Busy,
    Failed,
    Number(Quantity),
    Text(String),
}

impl Parameters {
    /// Evaluates the parameters of a file with the values of `--set` in place of the declared ones.
    pub fn new(
        entries: &[Entry],
        overrides: &[(String, String)],
        units: FileUnits,
        places: &Places,
    ) -> (Self, Vec<Diagnostic>) {
        let slots: Vec<Slot> = entries
            .iter()
            .map(|e| Slot {
                name: e.key.clone(),
                declared: e.value.clone(),
                set: None,
                state: State::Open,
            })
            .collect();
        let index = slots.iter().enumerate().map(|(i, s)| (s.name.clone(), i)).collect();
        let places = places.clone();
        let mut all = Self { slots, index, units, places, stack: Vec::new(), errors: Vec::new() };
        for entry in entries {
            all.check_name(entry);
        }
        for (name, value) in overrides {
            if let Some(&i) = all.index.get(name) {
                all.slots[i].set = Some(value.clone());
            } else {
                let mut d = Diagnostic::new(
                    "E0119",
                    format!("the model has no parameter `{name}`"),
                    0..name.len(),
                    &argument(name, value),
                );
                if all.suggests() {
                    d = d.help(names_help(name, "parameters", all.names()));
                }
                all.errors.push(d);
            }
        }
        for i in 0..all.slots.len() {
            all.resolve(i);
        }
        for (i, entry) in entries.iter().enumerate() {
            all.check_unit(i, entry);
        }
        let errors = std::mem::take(&mut all.errors);
        (all, errors)
    }

    /// The values in file order; nothing for those that failed.
    pub fn values(&self) -> Vec<Parameter> {
        self.slots
            .iter()
            .filter_map(|s| {
                let value = match &s.state {
                    State::Number(q) => ParameterValue::Number(q.value, q.dimension),
                    State::Text(t) => ParameterValue::Text(t.clone()),
                    _ => return None,
                };
                Some(Parameter { name: s.name.clone(), value })
            })
            .collect()
    }

    /// The text of a text parameter.
    pub fn text(&self, name: &str) -> Option<&str> {
        match &self.slots.get(*self.index.get(name)?)?.state {
            State::Text(t) => Some(t),
            _ => None,
        }
    }

    /// Names of the text parameters.
    pub fn text_names(&self) -> Vec<&str> {
        let texts = self.slots.iter().filter(|s| matches!(s.state, State::Text(_)));
        texts.map(|s| s.name.as_str()).collect()
    }

    fn check_name(&mut self, entry: &Entry) {
        let mut chars = entry.key.chars();
        let good = chars.next().is_some_and(|c| c.is_alphabetic() || c == '_')
            && chars.all(|c| c.is_alphanumeric() || c == '_')
            && entry.key != "pi";
        if !good {
            let message = format!("`{}` cannot name a parameter", entry.key);
            let help = "letters, digits and `_`, beginning with a letter, and not `pi`";
            let span = entry.key_span.clone();
            self.errors
                .push(Diagnostic::new("E0105", message, span, self.places.main()).help(help));
        }
    }

    /// Behind a number `h` is the hour, elsewhere the parameter `h`: only of the unit's own dimension, as `g`, can
    /// both be meant.
    fn check_unit(&mut self, i: usize, entry: &Entry) {
        let (Some(unit), State::Number(q)) = (crate::units::find(&entry.key), &self.slots[i].state)
        else {
            return;
        };
        if q.measured && q.dimension.matches(unit.dimension) {
            return;
        }
        let (name, dimension) = (unit.name, unit.dimension.unit());
        let is = match q.measured {
            true => format!("in {}", q.dimension),
            false => "a bare number".to_owned(),
        };
        let message = format!("`{name}` is a unit of {dimension}, and this parameter is {is}");
        let help = format!(
            "`2*{name}` and `2 {name}` would differ: choose another name, or give a value in {dimension}"
        );
        let span = entry.key_span.clone();
        self.errors.push(Diagnostic::new("E0105", message, span, self.places.main()).help(help));
    }

    fn resolve(&mut self, i: usize) {
        if !matches!(self.slots[i].state, State::Open) {
            return;
        }
        self.slots[i].state = State::Busy;
        self.stack.push(i);
        let declared = self.declared(i);
        let state = match (declared, self.slots[i].set.clone()) {
            (State::Text(_), Some(text)) => State::Text(text),
            (State::Number(q), Some(text)) => self.overridden(i, q, &text),
            (declared, _) => declared,
        };
        self.stack.pop();
        self.slots[i].state = state;
    }

    fn declared(&mut self, i: usize) -> State {
        let node = self.slots[i].declared.clone();
        match &node.kind {
            Kind::Number(x) if x.is_finite() => State::Number(Quantity::bare(*x)),
            Kind::Flag(b) => State::Number(Quantity::bare(f64::from(*b))),
            Kind::Text(text) => match evaluate(text, self) {
                Ok(q) => State::Number(q),
                Err(error) => {
                    if let Some(e) = error {
                        let d = self.places.expression(e, &node.span, text);
                        self.errors.push(d);
                    }
                    State::Failed
                }
            },
            Kind::List(Some(name), items) if name == "Text" => match items.as_slice() {
                [Node { kind: Kind::Text(text), .. }] => State::Text(text.clone()),
                _ => self.no_value(i, &node),
            },
            _ => self.no_value(i, &node),
        }
    }

    fn no_value(&mut self, i: usize, node: &Node) -> State {
        let name = &self.slots[i].name;
        let message = format!("parameter `{name}` is {}: must be a finite number", node.describe());
        let help = "write a number, `true` or `false`, an expression in quotes, or `Text(\"…\")` for a text: the \
                    name of a file or of a choice";
        let d = Diagnostic::new("E0105", message, node.span.clone(), self.places.main()).help(help);
        self.errors.push(d);
        State::Failed
    }

    fn overridden(&mut self, i: usize, declared: Quantity, text: &str) -> State {
        let name = self.slots[i].name.clone();
        let source = argument(&name, text);
        let before = name.len() + 1;
        // As a model file has it.
        if let Some(flag) = flag(text).filter(|_| !declared.measured && !self.has(text)) {
            return State::Number(Quantity::bare(flag));
        }
        match evaluate(text, self) {
            Err(None) => State::Failed,
            Err(Some(e)) => {
                let span = before + e.span.start..before + e.span.end;
                let mut d = Diagnostic::new(e.code, e.message, span, &source);
                d.help = e.help;
                self.errors.push(d);
                State::Failed
            }
            Ok(q) if !q.measured => {
                let value = q.value * self.units.scale(declared.dimension);
                State::Number(Quantity { value, ..declared })
            }
            Ok(q) if q.dimension.matches(declared.dimension) => State::Number(q),
            Ok(q) => {
                let (found, wanted) = (q.dimension, declared.dimension);
                let message = format!(
                    "`{name}` is set to a value in {found}, the model declares it in {wanted}"
                );
                let help = if declared.measured {
                    format!("give a value in {wanted}, or a bare number in the file's units")
                } else {
                    format!("the model declares `{name}` as a bare number: give a bare number")
                };
                let span = before..before + text.len();
                let d = Diagnostic::new("E0111", message, span, &source);
                self.errors.push(d.help(help));
                State::Failed
            }
        }
    }
}

/// 1 for `true`, 0 for `false`.
fn flag(text: &str) -> Option<f64> {
    match text {
        "true" => Some(1.0),
        "false" => Some(0.0),
        _ => None,
    }
}

fn argument(name: &str, value: &str) -> Arc<Source> {
    Arc::new(Source {
        path: format!("--set {name}={value}").into(),
        text: format!("{name}={value}"),
        sha256: String::new(),
    })
}

impl Scope for Parameters {
    fn names(&self) -> Vec<&str> {
        self.slots.iter().map(|s| s.name.as_str()).collect()
    }

    fn has(&self, name: &str) -> bool {
        self.index.contains_key(name)
    }

    fn suggests(&self) -> bool {
        self.errors.len() < SEARCHED
    }

    fn value(&mut self, name: &str) -> Result<Quantity, Option<(&'static str, String)>> {
        let Some(&i) = self.index.get(name) else { return Err(None) };
        if self.stack.len() >= CHAIN && matches!(self.slots[i].state, State::Open) {
            let message = format!("more than {CHAIN} parameters depend on each other in a chain");
            return Err(Some(("E0113", message)));
        }
        self.resolve(i);
        match &self.slots[i].state {
            State::Number(q) => Ok(*q),
            State::Text(_) => {
                Err(Some(("E0111", format!("parameter `{name}` is a text, not a number"))))
            }
            State::Busy => {
                let from = self.stack.iter().position(|&k| k == i).unwrap_or(0);
                let mut chain: Vec<String> = self.stack[from..]
                    .iter()
                    .map(|&k| format!("`{}`", self.slots[k].name))
                    .collect();
                chain.push(format!("`{name}`"));
                let chain = chain.join(" → ");
                Err(Some(("E0113", format!("parameters depend on each other: {chain}"))))
            }
            State::Open | State::Failed => Err(None),
        }
    }
}

/// A scope over parameters that are all evaluated.
pub(crate) struct Evaluated<'a> {
    pub parameters: &'a Parameters,
    /// Where indices are looked for, and the place that the expression stands at.
    pub places: &'a Places,
    pub at: usize,
    /// True where a wrong name is answered with the names that there are.
    pub suggests: bool,
}

impl Scope for Evaluated<'_> {
    fn names(&self) -> Vec<&str> {
        let mut all = self.parameters.names();
        all.extend(self.places.indices(self.at));
        all
    }
    fn has(&self, name: &str) -> bool {
        self.parameters.has(name) || self.places.index(self.at, name).is_some()
    }
    fn suggests(&self) -> bool {
        self.suggests
    }
    fn value(&mut self, name: &str) -> Result<Quantity, Option<(&'static str, String)>> {
        let told = |message| Err(Some(("E0111", message)));
        let Parameters { slots, index, .. } = self.parameters;
        let slot = index.get(name).and_then(|&i| slots.get(i));
        match (slot.map(|s| &s.state), self.places.index(self.at, name)) {
            (Some(State::Number(q)), _) => Ok(*q),
            (Some(State::Text(_)), _) => {
                told(format!("parameter `{name}` is a text, not a number"))
            }
            (None, Some(value)) => match value.number() {
                Some(q) => Ok(q),
                None => {
                    let text = value.name();
                    told(format!("the index `{name}` is the text \"{text}\", not a number"))
                }
            },
            _ => Err(None),
        }
    }
}

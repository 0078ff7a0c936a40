//! What every part of the reader needs: parameters, units, and a place for errors.

use super::motions::Motions;
use crate::diagnostic::{SEARCHED, closest, names_help};
use crate::expression::{Quantity, evaluate};
use crate::parameters::{Evaluated, Parameters};
use crate::places::Places;
use crate::schema::{Block, Group};
use crate::tree::{Entry, Kind, Node};
use crate::units::FileUnits;
use crate::{CustomSolver, Diagnostic, Registry, Source, Span};
use std::cell::RefCell;
use std::path::PathBuf;
use std::sync::Arc;
use trilith_element::{Dimension, Dof, Range};

/// What stands for a text parameter where a text in quotes would be a text.
pub(crate) const PARAMETER: &str = "Parameter";

/// The reader's surroundings. A method that returns `None` has reported why.
pub struct Context<'a> {
    pub(crate) source: Arc<Source>,
    pub(crate) folder: PathBuf,
    pub(crate) registry: &'a Registry,
    pub(crate) places: Places,
    /// Of each file.
    units: Vec<FileUnits>,
    pub(crate) motions: Arc<Motions>,
    /// Other files that were read.
    pub(crate) files: RefCell<Vec<PathBuf>>,
    /// Solvers of other crates that cases have named.
    pub(crate) solvers: RefCell<Vec<CustomSolver>>,
    parameters: Parameters,
    errors: RefCell<Vec<Diagnostic>>,
}

/// Fields in parentheses whose names have been checked.
pub struct Fields<'n> {
    what: String,
    span: Span,
    /// The block of the schema, where they are of one.
    pub(super) block: Option<&'static Block>,
    entries: &'n [Entry],
    /// What takes the place of some of them.
    instead: &'n [Entry],
}

impl<'n> Fields<'n> {
    /// No fields of a block, where a value stands for all of them.
    pub(crate) fn none(node: &Node, block: &'static Block) -> Self {
        let (what, span, block) = (node.describe(), node.span.clone(), Some(block));
        Self { what, span, block, entries: &[], instead: &[] }
    }

    /// The value of a field.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&'n Node> {
        let mut all = self.instead.iter().chain(self.entries);
        all.find(|e| e.key == key).map(|e| &e.value)
    }

    /// The same with other values of some fields.
    pub(crate) fn with(self, instead: &'n [Entry]) -> Self {
        Self { instead, ..self }
    }

    /// The value of a field; that it is missing is reported.
    pub fn required(&self, c: &Context<'_>, key: &str) -> Option<&'n Node> {
        let found = self.get(key);
        if found.is_none() {
            let message = format!("{} has no `{key}`", self.what);
            let d = c.diagnostic("E0104", message, self.span.clone());
            c.report(d.label(format!("`{key}` is missing")).help(format!("add `{key}: …`")));
        }
        found
    }

    /// All fields.
    #[must_use]
    pub fn entries(&self) -> &'n [Entry] {
        self.entries
    }
}

impl<'a> Context<'a> {
    /// For a file whose files are looked for in a folder.
    #[must_use]
    pub fn new(source: Arc<Source>, folder: PathBuf, registry: &'a Registry) -> Self {
        let (units, places) = (FileUnits::default(), Places::new(Arc::clone(&source)));
        let (parameters, _) = Parameters::new(&[], &[], units, &places);
        Self {
            source,
            folder,
            registry,
            places,
            units: vec![units],
            motions: Arc::default(),
            files: RefCell::default(),
            solvers: RefCell::default(),
            parameters,
            errors: RefCell::default(),
        }
    }

    /// The path of a file that a value names: it counts from the folder of the file in which the name stands.
    pub(crate) fn file(&self, name: &str, at: &Node) -> PathBuf {
        let included = match at.kind {
            Kind::Text(_) => self.places.included(at.span.start),
            _ => None,
        };
        let folder = included.and_then(|source| source.path.parent()).unwrap_or(&self.folder);
        let path = folder.join(name);
        self.files.borrow_mut().push(path.clone());
        path
    }

    /// What bare numbers of the file of a value are measured in.
    pub(crate) fn units_at(&self, node: &Node) -> FileUnits {
        match self.units[..] {
            [units] => units,
            _ => self.units[self.places.file_of(node.span.start)],
        }
    }

    /// Takes the places of all files of a model, whose bare numbers are in SI for the time being.
    pub(crate) fn set_places(&mut self, places: Places) {
        self.units = vec![FileUnits::default(); places.files().count()];
        self.places = places;
    }

    /// Sets the units of a file.
    pub(crate) fn set_units(&mut self, file: usize, units: FileUnits) {
        self.units[file] = units;
    }

    /// The file that is read.
    #[must_use]
    pub fn source(&self) -> &Arc<Source> {
        &self.source
    }

    pub(crate) fn set_parameters(&mut self, entries: &[Entry], overrides: &[(String, String)]) {
        let units = self.units[0];
        let (all, errors) = Parameters::new(entries, overrides, units, &self.places);
        self.parameters = all;
        self.errors.borrow_mut().extend(errors);
    }

    pub(crate) fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The errors in the order of the file; what was found twice is told once.
    #[must_use]
    pub fn into_errors(self) -> Vec<Diagnostic> {
        let mut errors = self.errors.into_inner();
        let mut told = std::collections::HashSet::new();
        errors.retain(|d| told.insert((d.source.path.clone(), d.span.clone(), d.message.clone())));
        self.places.told(errors)
    }

    /// True while a wrong name is answered with the names that there may be many of: up to the hundredth error.
    #[must_use]
    pub fn suggests(&self) -> bool {
        self.errors.borrow().len() < SEARCHED
    }

    /// True while there is no error.
    pub(crate) fn is_content(&self) -> bool {
        self.errors.borrow().is_empty()
    }

    /// Takes an error.
    pub fn report(&self, diagnostic: Diagnostic) {
        self.errors.borrow_mut().push(diagnostic);
    }

    /// An error at a place of the file.
    #[must_use]
    pub fn diagnostic(
        &self,
        code: &'static str,
        message: impl Into<String>,
        at: Span,
    ) -> Diagnostic {
        Diagnostic::new(code, message, at, &self.source)
    }

    /// Reports that a value has the wrong form.
    pub fn wrong<T>(&self, node: &Node, wanted: &str) -> Option<T> {
        let message = format!("{wanted} is wanted here, not {}", node.describe());
        self.report(self.diagnostic("E0105", message, node.span.clone()));
        None
    }

    /// Entries of a section of the model; empty where it is left out.
    pub fn section<'n>(&self, top: &Fields<'n>, key: &str, needed: bool) -> &'n [Entry] {
        let node = if needed { top.required(self, key) } else { top.get(key) };
        let Some(node) = node else { return &[] };
        let entries: &[Entry] = match &node.kind {
            Kind::Map(entries) => entries,
            _ => {
                let message = format!("`{key}` must be a map, not {}", node.describe());
                let help = format!("write `{key}: {{ \"name\": … }}`");
                self.report(self.diagnostic("E0105", message, node.span.clone()).help(help));
                return &[];
            }
        };
        if needed && entries.is_empty() {
            let d = self.diagnostic("E0104", format!("`{key}` is empty"), node.span.clone());
            self.report(d.help("a model needs at least one node, one element and one case"));
        }
        entries
    }

    /// The fields of a block of the schema. Unknown ones are reported.
    pub fn block<'n>(
        &self,
        node: &'n Node,
        what: &str,
        block: &'static Block,
    ) -> Option<Fields<'n>> {
        let fields = self.fields(node, what, &block.names())?;
        Some(Fields { block: Some(block), ..fields })
    }

    /// The block of a group that a value names.
    pub fn one_of(&self, node: &Node, what: &str, group: &Group) -> Option<&'static Block> {
        self.choice(node, what, &group.names()).map(|i| group.blocks[i])
    }

    /// The fields of `(…)` or `Name(…)`; a bare name has none. Unknown ones are reported.
    pub fn fields<'n>(&self, node: &'n Node, what: &str, allowed: &[&str]) -> Option<Fields<'n>> {
        let entries: &[Entry] = match &node.kind {
            Kind::Fields(_, entries) => entries,
            Kind::Name(_) => &[],
            _ => return self.wrong(node, &format!("{what} with fields `(name: value)`")),
        };
        for e in entries.iter().filter(|e| !allowed.contains(&e.key.as_str())) {
            let message = format!("{what} has no field `{}`", e.key);
            // What is there already is hardly meant, unless nothing else is near.
            let given = |name: &str| entries.iter().any(|e| e.key == name);
            let free: Vec<&str> = allowed.iter().copied().filter(|name| !given(name)).collect();
            let likely =
                if closest(&e.key, free.iter().copied()).is_some() { &free[..] } else { allowed };
            let help = names_help(&e.key, "fields", likely.iter().copied());
            let mut d = self.diagnostic("E0103", message, e.key_span.clone()).help(help);
            if let Some(near) = closest(&e.key, likely.iter().copied()) {
                d = d.suggestion(e.key_span.clone(), near);
            }
            self.report(d);
        }
        let (what, span) = (what.to_owned(), node.name_span());
        Some(Fields { what, span, block: None, entries, instead: &[] })
    }

    /// Which of these names a value has, as `Name`, `Name(…)` or a text, or as the text of a parameter: `"parameter"` or
    /// `Parameter("parameter")`.
    pub fn choice(&self, node: &Node, what: &str, names: &[&str]) -> Option<usize> {
        let (name, parameter) = match (&node.kind, node.name()) {
            (Kind::List(Some(kind), _), _) if kind == PARAMETER => {
                let parameter = self.text_parameter(node)?;
                (self.parameters.text(parameter)?, Some(parameter))
            }
            (_, Some(name)) => (name, None),
            (Kind::Text(text), _) if names.contains(&text.as_str()) => (text.as_str(), None),
            (Kind::Text(text), _) => match self.parameters.text(text) {
                Some(name) => (name, Some(text.as_str())),
                None => (text.as_str(), None),
            },
            _ => return self.wrong(node, &format!("a {what} ({})", names.join(", "))),
        };
        let found = names.iter().position(|n| *n == name);
        if found.is_none() {
            let at = node.name_span();
            let help = names_help(name, "choices", names.iter().copied());
            let through = parameter.map(|p| format!(", as parameter `{p}` says"));
            let message = format!("there is no {what} `{name}`{}", through.unwrap_or_default());
            let mut d = self.diagnostic("E0107", message, at.clone()).help(help);
            if parameter.is_some() {
                // The place to change is where the parameter has its value from.
            } else if let Some(near) = closest(name, names.iter().copied()) {
                let quoted = matches!(node.kind, Kind::Text(_));
                d = d.suggestion(at, if quoted { format!("\"{near}\"") } else { near.into() });
            }
            self.report(d);
        }
        found
    }

    /// The text parameter that `Parameter("name")` names.
    pub(crate) fn text_parameter<'n>(&self, node: &'n Node) -> Option<&'n str> {
        let items = if let Kind::List(_, items) = &node.kind { &items[..] } else { &[] };
        let [Node { kind: Kind::Text(name), span }] = items else {
            return self.wrong(node, "a text parameter, `Parameter(\"name\")`,");
        };
        if self.parameters.text(name).is_some() {
            return Some(name);
        }
        let message = format!("there is no text parameter `{name}`");
        let help = names_help(name, "text parameters", self.parameters.text_names());
        self.report(self.diagnostic("E0110", message, span.clone()).help(help));
        None
    }

    /// A direction.
    pub fn dof(&self, node: &Node) -> Option<Dof> {
        self.choice(node, "direction", &Dof::ALL.map(Dof::name)).map(|i| Dof::ALL[i])
    }

    /// A text in quotes.
    pub fn text(&self, node: &Node, what: &str) -> Option<String> {
        match &node.kind {
            Kind::Text(text) => Some(text.clone()),
            _ => self.wrong(node, &format!("a text in quotes for `{what}`")),
        }
    }

    /// A number with whatever dimension it has.
    pub fn quantity(&self, node: &Node) -> Option<Quantity> {
        match &node.kind {
            Kind::Number(x) if x.is_finite() => Some(Quantity::bare(*x)),
            Kind::Number(x) => {
                let message = format!("{x} is no finite number");
                self.report(self.diagnostic("E0112", message, node.span.clone()));
                None
            }
            Kind::Text(text) => {
                let (parameters, places, at) = (&self.parameters, &self.places, node.span.start);
                let suggests = self.suggests();
                match evaluate(text, &mut Evaluated { parameters, places, at, suggests }) {
                    Ok(q) => Some(q),
                    Err(error) => {
                        if let Some(e) = error {
                            self.report(self.places.expression(e, &node.span, text));
                        }
                        None
                    }
                }
            }
            _ => self.wrong(node, "a number, or an expression in quotes,"),
        }
    }

    /// A number of this dimension, in SI.
    pub fn number(&self, node: &Node, dimension: Dimension) -> Option<f64> {
        self.in_dimension(node, self.quantity(node)?, dimension)
    }

    /// A quantity as a number of this dimension, in SI.
    pub fn in_dimension(&self, node: &Node, q: Quantity, dimension: Dimension) -> Option<f64> {
        if !q.measured {
            return Some(q.value * self.units_at(node).scale(dimension));
        }
        if q.dimension.matches(dimension) {
            return Some(q.value);
        }
        let name = |d: Dimension| match d.unit().as_str() {
            "1" => "a pure number".to_owned(),
            unit => format!("a value in {unit}"),
        };
        let message = format!("this is {}: must be {}", name(q.dimension), name(dimension));
        self.report(
            self.diagnostic("E0111", message, node.span.clone())
                .label(format!("in {}", q.dimension))
                .help(format!("give {}, or a bare number in the file's units", name(dimension))),
        );
        None
    }

    /// A number of this dimension within a range, in SI.
    pub fn ranged(
        &self,
        node: &Node,
        name: &str,
        dimension: Dimension,
        range: Range,
    ) -> Option<f64> {
        let value = self.number(node, dimension)?;
        if range.contains(value) {
            return Some(value);
        }
        let unit = match dimension.unit().as_str() {
            "1" => String::new(),
            unit => format!(" {unit}"),
        };
        let message = format!("`{name}` = {value}{unit}: must be {}", range.text());
        let d = self.diagnostic("E0112", message, node.span.clone());
        self.report(d.label(format!("must be {}", range.text())));
        None
    }

    /// A whole number of at least `least`.
    pub fn count(&self, node: &Node, name: &str, least: usize) -> Option<usize> {
        self.count_up_to(node, name, least, 1_000_000_000)
    }

    /// A whole number of at least `least` and at most `most`.
    pub fn count_up_to(&self, node: &Node, name: &str, least: usize, most: usize) -> Option<usize> {
        let value = self.number(node, trilith_element::dimension::NONE)?;
        if value >= least as f64 && value <= most as f64 && value.fract() == 0.0 {
            return Some(value as usize);
        }
        let bound = match value > most as f64 {
            true => format!("at most {most}"),
            false => format!("{least} or more"),
        };
        let message = format!("`{name}` = {value}: must be a whole number, {bound}");
        self.report(self.diagnostic("E0112", message, node.span.clone()));
        None
    }

    /// True or false, or 1 or 0.
    pub fn flag(&self, node: &Node, name: &str) -> Option<bool> {
        if let Kind::Flag(b) = node.kind {
            return Some(b);
        }
        match self.number(node, trilith_element::dimension::NONE)? {
            0.0 => Some(false),
            1.0 => Some(true),
            x => {
                let message = format!("`{name}` = {x}: must be true or false (or 1 or 0)");
                self.report(self.diagnostic("E0112", message, node.span.clone()));
                None
            }
        }
    }

    /// Three numbers of one dimension.
    pub fn vector(&self, node: &Node, name: &str, dimension: Dimension) -> Option<[f64; 3]> {
        let items = node.items();
        if !node.is_list() || items.len() != 3 {
            let message = format!("`{name}` must be a list of three numbers `(x, y, z)`");
            self.report(self.diagnostic("E0105", message, node.span.clone()));
            return None;
        }
        let [x, y, z] = [0, 1, 2].map(|i| self.number(items[i], dimension));
        Some([x?, y?, z?])
    }
}

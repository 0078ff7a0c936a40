//! Whether a model can be one: indices that lead somewhere, numbers in their ranges, cases in order.
//!
//! The reader sees to all of that with line and column. A model that was made or changed in code has nothing but this.

mod cases;
mod combinations;
mod error;
mod members;

pub(crate) use cases::{LEAST_ALPHA, TOLERANCE};
pub use error::{ModelError, ModelFault};

use crate::{Body, Damping, Element, Model, Quantity, Span};
use std::collections::HashSet;
use trilith_element::{Coordinates, Dof, Range};

/// Damping as share of the critical.
pub(crate) const RATIO: Range = Range::Within(0.0, 0.999);

/// A share: from 0 to 1.
const SHARE: Range = Range::Within(0.0, 1.0);

impl Model {
    /// Looks at everything that a model refers to and every number that it holds: what has been read from a file passes,
    /// what was made in code may not. Whether its structure stands, the assembly tells.
    ///
    /// # Errors
    /// All that is wrong.
    pub fn check(&self) -> Result<(), Vec<ModelError>> {
        let mut check = Check { model: self, errors: Vec::new() };
        check.names();
        check.structure();
        check.loads();
        check.cases();
        check.combinations();
        check.outputs();
        check.envelopes();
        if check.errors.is_empty() { Ok(()) } else { Err(check.errors) }
    }
}

/// A model on its way, and what was found.
struct Check<'a> {
    model: &'a Model,
    errors: Vec<ModelError>,
}

/// A part of a model: what it is called, and where it stands in the file.
struct Part(String, Span);

impl Part {
    fn new(what: &str, name: &str, span: &Span) -> Self {
        Self(format!("{what} \"{name}\""), span.clone())
    }
}

impl Check<'_> {
    fn report(&mut self, part: &Part, fault: ModelFault) {
        self.errors.push(ModelError { place: part.0.clone(), fault, span: part.1.clone() });
    }

    /// True where an index leads somewhere.
    fn index(&mut self, part: &Part, what: &'static str, index: usize, count: usize) -> bool {
        if index >= count {
            self.report(part, ModelFault::Index { what, index, count });
        }
        index < count
    }

    fn node(&mut self, part: &Part, index: usize) -> bool {
        self.index(part, "node", index, self.model.nodes.len())
    }

    fn number(&mut self, part: &Part, name: &'static str, value: f64, range: Range) {
        if !range.contains(value) {
            let allowed = range.text();
            self.report(part, ModelFault::Number { name, value, allowed });
        }
    }

    fn unsuitable(&mut self, part: &Part, what: impl Into<String>) {
        self.report(part, ModelFault::Unsuitable(what.into()));
    }

    /// Every name once.
    fn names(&mut self) {
        fn all<T>(of: &[T], name: impl Fn(&T) -> (&str, Span)) -> Vec<(String, Span)> {
            of.iter().map(|one| (name(one).0.to_owned(), name(one).1)).collect()
        }
        let m = self.model;
        let none = || 0..0;
        let sections = [
            ("node", all(&m.nodes, |n| (&n.name, n.span.clone()))),
            ("element", all(&m.elements, |e| (&e.name, e.span.clone()))),
            ("function", all(&m.functions, |f| (&f.name, none()))),
            ("load", all(&m.patterns, |p| (&p.name, none()))),
            ("case", all(&m.cases, |c| (&c.name, c.span.clone()))),
            ("combination", all(&m.combinations, |c| (&c.name, none()))),
            ("output", all(&m.outputs, |o| (&o.name, none()))),
            ("spectrum", all(&m.spectra, |s| (&s.name, none()))),
        ];
        for (what, names) in sections {
            let mut seen = HashSet::new();
            for (name, span) in &names {
                let part = Part::new(what, name, span);
                if name.is_empty() {
                    self.report(&part, ModelFault::NoName);
                } else if !seen.insert(name.as_str()) {
                    self.report(&part, ModelFault::Twice);
                }
            }
        }
    }

    fn structure(&mut self) {
        let m = self.model;
        let whole = Part("the model".into(), 0..0);
        self.number(&whole, "gravity", m.gravity, Range::NonNegative);
        for node in &m.nodes {
            let part = Part::new("node", &node.name, &node.span);
            node.position.iter().for_each(|x| self.number(&part, "position", *x, Range::Any));
        }
        for (i, support) in m.supports.iter().enumerate() {
            let part = Part(format!("support {i}"), support.span.clone());
            self.node(&part, support.node);
        }
        m.elements.iter().for_each(|e| self.element(e));
        match &m.damping {
            Damping::None => {}
            Damping::Modal { ratio } => {
                self.number(&whole, "damping ratio", *ratio, RATIO);
            }
            Damping::ModalTable { points } => {
                for (f, ratio) in points {
                    self.number(&whole, "frequency of damping", *f, Range::NonNegative);
                    self.number(&whole, "damping ratio", *ratio, RATIO);
                }
                if points.is_empty() || points.windows(2).any(|p| p[1].0 <= p[0].0) {
                    self.unsuitable(&whole, "a table of damping needs frequencies that rise");
                }
            }
            Damping::Rayleigh { mass, stiffness } => {
                self.number(&whole, "Rayleigh damping of the mass", *mass, Range::NonNegative);
                let of_stiffness = "Rayleigh damping of the stiffness";
                self.number(&whole, of_stiffness, *stiffness, Range::NonNegative);
            }
        }
    }

    fn element(&mut self, e: &Element) {
        let part = Part::new("element", &e.name, &e.span);
        let known = e.nodes.iter().all(|node| self.node(&part, *node));
        if e.nodes.is_empty() {
            self.unsuitable(&part, "it has no nodes");
        }
        let mut nodes = e.nodes.clone();
        nodes.sort_unstable();
        if nodes.windows(2).any(|pair| pair[0] == pair[1]) {
            self.unsuitable(&part, "it has the same node twice");
        }
        let axes = e.frame.0;
        let dot = |i: usize, j: usize| -> f64 { (0..3).map(|k| axes[i][k] * axes[j][k]).sum() };
        let square = |i: usize, j: usize| {
            let wanted = if i == j { 1.0 } else { 0.0 };
            (dot(i, j) - wanted).abs() < 1e-6
        };
        if !(0..3).all(|i| (0..3).all(|j| square(i, j))) {
            self.unsuitable(&part, "its local axes are no unit vectors square to each other");
        }
        let Body::Link(law, options) = &e.body else { return };
        let coordinates = law.coordinates();
        match &coordinates {
            _ if coordinates.is_empty() => self.unsuitable(&part, "its law has no coordinates"),
            Coordinates::Local(_) if known && e.nodes.len() > 2 => {
                let given = e.nodes.len();
                self.unsuitable(&part, format!("a law in local axes is between two nodes, or a node and the ground, not {given}"));
            }
            _ => {}
        }
        self.number(&part, "shear_at", options.shear_at, Range::Any);
        options.p_delta_at.iter().flatten().for_each(|x| {
            self.number(&part, "p_delta_at", *x, Range::Any);
        });
        if let Some(k) = &options.effective_stiffness {
            k.iter().for_each(|k| {
                self.number(&part, "effective_stiffness", *k, Range::NonNegative);
            });
            if k.len() != coordinates.len() {
                let (name, wanted) = ("effective_stiffness", coordinates.len().to_string());
                self.report(&part, ModelFault::Count { name, given: k.len(), wanted });
            }
        }
    }

    fn loads(&mut self) {
        for pattern in &self.model.patterns {
            let part = Part::new("load", &pattern.name, &(0..0));
            for force in &pattern.forces {
                self.node(&part, force.node);
                self.number(&part, "force", force.value, Range::Any);
            }
            self.along(&part, &pattern.members);
        }
    }

    /// True where an element exists and is a link.
    fn link(&mut self, part: &Part, element: usize, coordinate: Option<usize>) {
        if !self.index(part, "element", element, self.model.elements.len()) {
            return;
        }
        let e = &self.model.elements[element];
        match (&e.body, coordinate) {
            (Body::Link(law, _), Some(coordinate)) => {
                self.index(part, "coordinate", coordinate, law.coordinates().len());
            }
            (Body::Link(..), None) => {}
            _ => self.unsuitable(part, format!("\"{}\" is not a link", e.name)),
        }
    }

    fn outputs(&mut self) {
        let m = self.model;
        for (own, output) in m.outputs.iter().enumerate() {
            let part = Part::new("output", &output.name, &(0..0));
            let factor = |check: &mut Self, x: f64| check.number(&part, "factor", x, Range::Any);
            match &output.quantity {
                Quantity::Displacement(terms)
                | Quantity::Velocity(terms)
                | Quantity::Acceleration { terms, .. } => {
                    for term in terms {
                        self.node(&part, term.node);
                        factor(self, term.factor);
                    }
                }
                Quantity::LinkDeformation { element, coordinate, factor: x } => {
                    self.link(&part, *element, Some(*coordinate));
                    factor(self, *x);
                }
                Quantity::LinkForce(terms) => {
                    for term in terms {
                        self.link(&part, term.element, Some(term.coordinate));
                        factor(self, term.factor);
                    }
                }
                Quantity::LinkHistory { element, field } => {
                    self.link(&part, *element, None);
                    if let Some(Element { body: Body::Link(law, _), .. }) = m.elements.get(*element)
                    {
                        self.index(&part, "history variable", *field, law.history().len());
                    }
                }
                Quantity::ElementForce { elements, end, factor: x, .. } => {
                    for element in elements {
                        if self.index(&part, "element", *element, m.elements.len()) {
                            let count = m.elements[*element].nodes.len();
                            self.index(&part, "end", *end, count);
                        }
                    }
                    factor(self, *x);
                }
                Quantity::MemberForce { element, at, factor, .. } => {
                    self.member_force(&part, *element, *at, *factor);
                }
                Quantity::BaseShear { direction } | Quantity::Overturning { direction, .. } => {
                    if !matches!(direction, Dof::Ux | Dof::Uy) {
                        self.unsuitable(&part, "its direction must be Ux or Uy");
                    }
                }
                Quantity::Reaction { nodes, factor: x, .. } => {
                    for node in nodes {
                        self.node(&part, *node);
                    }
                    factor(self, *x);
                }
                Quantity::Combination { constant, terms, .. } => {
                    self.number(&part, "constant", *constant, Range::Any);
                    for (output, x) in terms {
                        // Only those before it: nothing runs in a circle.
                        self.index(&part, "output before it", *output, own);
                        factor(self, *x);
                    }
                }
                Quantity::Derived(derived) => {
                    for output in &derived.of {
                        self.index(&part, "output before it", *output, own);
                    }
                }
            }
        }
        for spectrum in &m.spectra {
            let part = Part::new("spectrum", &spectrum.name, &(0..0));
            self.index(&part, "output", spectrum.output, m.outputs.len());
            for damping in &spectrum.damping {
                self.number(&part, "damping", *damping, SHARE);
            }
            for period in &spectrum.periods {
                self.number(&part, "period", *period, Range::NonNegative);
            }
        }
    }
}

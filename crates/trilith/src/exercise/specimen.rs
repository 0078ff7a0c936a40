//! A law as the example of its card has it, and the motion that shows it.

use super::example::Entry;
use super::{ExerciseError, History, Motion, Record};
use crate::element::{Card, Category, Coordinates, Dof, Link, Values};
use crate::model::{Body, Registry};
use std::sync::Arc;

/// Mass that strikes a contact whose restitution has to be turned into a dashpot, kg.
const STRIKING: f64 = 1000.0;
/// Cycles where nothing else is said.
const CYCLES: usize = 3;

/// A coordinate of a law by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// `U1` … `R3`, or `node.Ux` for laws that work on the displacements of their nodes.
    pub name: String,
    /// In rad and N·m instead of m and N.
    pub rotation: bool,
}

/// A link to be exercised.
#[derive(Debug)]
pub struct Specimen {
    /// Its card.
    pub card: &'static Card,
    /// Its law.
    pub law: Arc<dyn Link>,
    /// Its parameters in SI.
    pub values: Values,
    /// It as a line of a model file.
    pub line: String,
    /// What was assumed.
    pub notes: Vec<String>,
    entry: Entry,
}

impl Specimen {
    /// A link with the parameters of the example on its card, some of them changed: values as in
    /// model files, with units (`2 MN/m`); `none` takes one away.
    ///
    /// # Errors
    /// [`ExerciseError`] for a kind that there is not or that is no link, or with all that is wrong
    /// with the parameters.
    pub fn new(
        registry: &Registry,
        kind: &str,
        set: &[(String, String)],
    ) -> Result<Self, ExerciseError> {
        let unknown = || ExerciseError::UnknownKind(kind.to_owned());
        let card = registry.card(kind).ok_or_else(unknown)?;
        if card.category != Category::Link {
            return Err(ExerciseError::NotALink { kind: card.kind, category: card.category });
        }
        let mut entry = Entry::of(card).unwrap_or_else(|| Entry {
            name: "link".into(),
            kind: card.kind.into(),
            fields: vec![("node".into(), "\"a\"".into())],
        });
        for (name, value) in set {
            entry.set_parameter(card, name, value);
        }
        let path = format!("example of {}", card.kind);
        let mut model = crate::read_text(&entry.model(card), path, registry, &[])
            .map_err(|errors| ExerciseError::Parameters(errors.into_vec()))?;
        let element = model.elements.pop().ok_or_else(unknown)?;
        let Body::Link(law, _) = element.body else { return Err(unknown()) };
        let mut notes = Vec::new();
        let law = settled(law, &mut notes);
        let line = entry.line();
        Ok(Self { card, law, values: Arc::unwrap_or_clone(element.values), line, notes, entry })
    }

    /// The names of the nodes that it stands on, in order.
    #[must_use]
    pub fn nodes(&self) -> Vec<String> {
        self.entry.nodes()
    }

    /// It as an entry of a larger model: names begin with `prefix`, its axes are the global ones.
    #[must_use]
    pub fn placed(&self, prefix: &str) -> String {
        let mut entry = self.entry.renamed(prefix, self.card);
        entry.set("axis1", Some("(1, 0, 0)".into()));
        entry.set("axis2", Some("(0, 1, 0)".into()));
        entry.line()
    }

    /// The coordinates of the law.
    #[must_use]
    pub fn coordinates(&self) -> Vec<Coordinate> {
        match self.law.coordinates() {
            Coordinates::Local(axes) => axes
                .iter()
                .map(|a| Coordinate { name: a.name().to_owned(), rotation: a.index() > 2 })
                .collect(),
            Coordinates::Nodal { nodes } => {
                let names = self.nodes();
                let node = |i: usize| names.get(i).cloned().unwrap_or(format!("node {i}"));
                let six = |i| Dof::ALL.map(|dof| (node(i), dof));
                let all = (0..nodes).flat_map(six);
                all.map(|(node, dof)| Coordinate {
                    name: format!("{node}.{}", dof.name()),
                    rotation: dof.is_rotation(),
                })
                .collect()
            }
        }
    }

    /// The motion of the card.
    ///
    /// # Errors
    /// [`ExerciseError::NoStrokes`] where it does not fit the law.
    pub fn motion(&self) -> Result<Motion, ExerciseError> {
        let exercise = self.card.exercise;
        if exercise.strokes.len() != self.law.coordinates().len() {
            return Err(ExerciseError::NoStrokes {
                kind: self.card.kind,
                strokes: exercise.strokes.len(),
                coordinates: self.coordinates().into_iter().map(|c| c.name).collect(),
            });
        }
        let strokes = exercise.strokes.to_vec();
        Ok(Motion { frequency: exercise.frequency, strokes, cycles: CYCLES })
    }

    /// Leads the law along a motion with a stroke for each of its coordinates.
    ///
    /// # Errors
    /// [`ExerciseError::NotFinite`], and [`ExerciseError::NoStrokes`] for another number of strokes.
    pub fn exercise(&self, motion: &Motion) -> Result<Record, ExerciseError> {
        let coordinates = self.coordinates();
        if motion.strokes.len() != coordinates.len() {
            return Err(ExerciseError::NoStrokes {
                kind: self.card.kind,
                strokes: motion.strokes.len(),
                coordinates: coordinates.into_iter().map(|c| c.name).collect(),
            });
        }
        Record::new(self.law.as_ref(), coordinates, motion)
    }

    /// Leads the law along a measured history with a column for each of its coordinates. What happened before the
    /// first sample is not known: there the law is as it would be had nothing yielded or slipped.
    ///
    /// # Errors
    /// [`ExerciseError::NotFinite`], and [`ExerciseError::NoStrokes`] for another number of columns.
    pub fn follow(&self, history: &History) -> Result<Record, ExerciseError> {
        let coordinates = self.coordinates();
        if history.deformation.len() != coordinates.len() {
            return Err(ExerciseError::NoStrokes {
                kind: self.card.kind,
                strokes: history.deformation.len(),
                coordinates: coordinates.into_iter().map(|c| c.name).collect(),
            });
        }
        Record::along(self.law.as_ref(), coordinates, history)
    }
}

/// The law with the dashpot that its restitution asks for: there is no structure to take a mass from.
fn settled(law: Arc<dyn Link>, notes: &mut Vec<String>) -> Arc<dyn Link> {
    let Some(impact) = law.impact() else { return law };
    let Some(restitution) = impact.restitution else { return law };
    let mass = impact.mass.unwrap_or(STRIKING);
    let Some(complete) = law.restituting(restitution, mass) else { return law };
    if impact.mass.is_none() {
        notes.push(format!(
            "the dashpot is that of the restitution for a mass of {} t; `impact_mass` gives another",
            mass / 1000.0
        ));
    }
    Arc::from(complete)
}

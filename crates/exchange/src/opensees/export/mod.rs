//! Models as scripts for OpenSeesPy.
//!
//! What has the same law there is written, what has a law that is near or none at all is named: see [`Losses`]. The script
//! is in SI; node `i` of the model has the tag `i` + 1, and a link on the ground gets a node of its own that is held.

mod bearings;
mod cases;
mod command;
mod constraints;
mod freedoms;
mod functions;
mod laws;
mod links;
mod losses;
mod members;
mod outputs;
mod script;

use freedoms::Freedoms;
pub use losses::{Loss, Losses};
use std::collections::HashMap;
use trilith_model::{Body, Model, output_steps};

/// What an export is told.
#[derive(Clone, Debug)]
pub struct ExportOptions {
    /// Steps of OpenSees, which has no error control, in an output step.
    pub substeps: usize,
    /// Laws that are near are written where none is the same.
    pub near: bool,
    /// What has no counterpart is left out.
    pub leave_out: bool,
    /// Name of the model file, for the head of the script.
    pub file: String,
    /// Beginning of the names of the files that the script writes.
    pub stem: String,
}

impl Default for ExportOptions {
    fn default() -> Self {
        Self {
            substeps: 1,
            near: false,
            leave_out: false,
            file: "model.ron".into(),
            stem: "model".into(),
        }
    }
}

/// A script and what is not in it.
#[derive(Clone, Debug)]
pub struct Export {
    /// The script, in Python.
    pub script: String,
    /// What is said otherwise or not at all.
    pub losses: Losses,
    /// Parts of the model that were written: kinds and their numbers.
    pub written: Vec<(&'static str, usize)>,
}

/// Why there is no script.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// Parts without a counterpart, and no leave to go without them.
    #[error("the model says what OpenSees has no word for")]
    Refused(Box<Losses>),
    /// A part of the model that has no matrices or no equations.
    #[error("\"{name}\": {why}")]
    Part {
        /// Name of the element.
        name: String,
        /// What it says.
        why: String,
    },
    /// Nothing moves or bears.
    #[error("nothing is left that could be run")]
    Empty,
}

/// Writes a case of a model, with those that it continues, as a script for OpenSeesPy.
///
/// # Errors
/// [`ExportError::Refused`] where a part has no counterpart and the options do not say what then.
///
/// # Panics
/// Where `case` is not an index of a case of the model.
pub fn export(model: &Model, case: usize, options: &ExportOptions) -> Result<Export, ExportError> {
    let mut writer = Writer::new(model, options);
    writer.structure()?;
    writer.links();
    let freedoms = Freedoms::of(&mut writer)?;
    let stages = cases::stages(&mut writer, case, &freedoms);
    if !writer.losses.refused.is_empty() {
        return Err(ExportError::Refused(Box::new(writer.losses)));
    }
    let outputs = outputs::outputs(&mut writer, &freedoms);
    if writer.elements.is_empty() {
        return Err(ExportError::Empty);
    }
    let script = script::script(&writer, case, &freedoms, &stages, &outputs);
    Ok(Export { script, losses: writer.losses, written: writer.written })
}

/// Where the force of a link coordinate is found: an element, and its material or its basic force.
#[derive(Clone, Copy, Debug)]
enum Place {
    Material(i64, usize),
    Basic(i64, usize),
}

/// The script in the making.
struct Writer<'m> {
    model: &'m Model,
    options: &'m ExportOptions,
    losses: Losses,
    written: Vec<(&'static str, usize)>,
    /// Materials and elements of the structure, then those of links.
    structure: Vec<command::Command>,
    linked: Vec<command::Command>,
    /// Tags of elements by the index of the element of the model.
    elements: HashMap<usize, i64>,
    /// Forces of link coordinates, by element and local axis.
    forces: HashMap<(usize, usize), Vec<Place>>,
    /// Positions of nodes on the ground; their tags follow those of the model.
    ground: Vec<[f64; 3]>,
    transforms: Vec<([f64; 9], i64)>,
    tags: Tags,
    /// Elements whose stiffness is damped by Rayleigh's rule.
    rayleigh: bool,
}

/// The next tags.
#[derive(Default)]
struct Tags {
    material: i64,
    friction: i64,
    element: i64,
    pattern: i64,
}

impl<'m> Writer<'m> {
    fn new(model: &'m Model, options: &'m ExportOptions) -> Self {
        let rayleigh = matches!(model.damping, trilith_model::Damping::Rayleigh { .. });
        Self {
            model,
            options,
            losses: Losses::new(options),
            written: Vec::new(),
            structure: Vec::new(),
            linked: Vec::new(),
            elements: HashMap::new(),
            forces: HashMap::new(),
            ground: Vec::new(),
            transforms: Vec::new(),
            tags: Tags::default(),
            rayleigh,
        }
    }

    /// Tag of a node of the model.
    fn node(&self, node: usize) -> i64 {
        node as i64 + 1
    }

    fn material(&mut self) -> i64 {
        self.tags.material += 1;
        self.tags.material
    }

    fn element(&mut self) -> i64 {
        self.tags.element += 1;
        self.tags.element
    }

    fn count(&mut self, kind: &'static str) {
        match self.written.iter_mut().find(|w| w.0 == kind) {
            Some(known) => known.1 += 1,
            None => self.written.push((kind, 1)),
        }
    }

    /// Members and springs.
    fn structure(&mut self) -> Result<(), ExportError> {
        for i in 0..self.model.elements.len() {
            if matches!(self.model.elements[i].body, Body::Linear(_)) {
                self.member(i)?;
            }
        }
        Ok(())
    }

    fn links(&mut self) {
        for i in 0..self.model.elements.len() {
            if matches!(self.model.elements[i].body, Body::Link(..)) {
                self.link(i);
            }
        }
    }
}

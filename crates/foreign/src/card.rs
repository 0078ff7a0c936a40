//! Cards that are made at run time.
//!
//! A [`Card`] is of texts that live as long as the program: those of built-in kinds are in its code, and all that reads models
//! builds on that. So a declaration that is met for the first time is kept for good, and one that was met before gets the same
//! card again: memory grows by about a kilobyte for every *different* declaration, however many models, links and runs there
//! are.

use crate::declaration::{Declaration, Understood};
use crate::error::DeclarationError;
use crate::function::Sizes;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use trilith_element::{
    Axis, Card, Category, Default, Exercise, Field, Form, NodeCount, Parameter, Stroke,
};
use trilith_model::schema;

/// All that a declaration says, in the form in which laws use it.
#[derive(Debug)]
pub(crate) struct Shape {
    pub card: Card,
    pub axes: Vec<Axis>,
    pub fields: &'static [Field],
    pub sizes: Sizes,
    pub rates: bool,
    pub tangent: bool,
    pub energy: bool,
    /// Deformations that the law is for, one for each coordinate, and rates of such cycles.
    pub amplitude: Vec<f64>,
    pub rate: Vec<f64>,
}

/// Declarations that were met, each with what was made of it.
static MET: Mutex<BTreeMap<String, &'static Shape>> = Mutex::new(BTreeMap::new());

fn kept(text: &str) -> &'static str {
    Box::leak(text.to_owned().into_boxed_str())
}

/// The shape of a declaration: the same for equal ones.
pub(crate) fn shape(of: &Declaration) -> Result<&'static Shape, DeclarationError> {
    let parameters = of.check()?;
    // Numbers that are not finite have been refused, and nothing else has no form in JSON.
    let key = serde_json::to_string(of).unwrap_or_default();
    let mut met = MET.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(shape) = met.get(&key) {
        return Ok(shape);
    }
    let shape: &'static Shape = Box::leak(Box::new(made(of, &parameters)?));
    met.insert(key, shape);
    Ok(shape)
}

fn made(of: &Declaration, parameters: &[Understood]) -> Result<Shape, DeclarationError> {
    let axes = of.coordinates()?;
    let (amplitude, frequency) = of.motion()?;
    let card = Card::new(kept(&of.kind), Category::Link, kept(&of.summary))
        .nodes(NodeCount::GROUND_OR_TWO)
        .law(kept(&of.law))
        .source(kept(&of.source));
    let places = schema::beside(&card).into_iter().chain([&schema::PLACE]);
    let fields: Vec<&str> = places.flat_map(|block| block.fields).map(|field| field.name).collect();
    if let Some(p) = of.parameters.iter().find(|p| fields.contains(&p.name.as_str())) {
        return Err(DeclarationError::Taken { kind: of.kind.clone(), name: p.name.clone() });
    }
    let all: Vec<Parameter> = of
        .parameters
        .iter()
        .zip(parameters)
        .map(|(p, u)| {
            let name = kept(&p.name);
            let default = u.default.map_or(Default::Required, Default::Number);
            Parameter::new(name, name, Form::Number(u.dimension), default, kept(&p.meaning))
                .within(u.range)
        })
        .collect();
    let values = of.parameters.iter().zip(parameters).filter_map(|(p, u)| {
        u.example.as_ref().map(|value| format!(", {}: {}", p.name, value.text()))
    });
    let example = format!("\"link\": {}(node: \"a\"{})", of.kind, values.collect::<String>());
    let strokes: Vec<Stroke> = amplitude.iter().map(|a| Stroke::about(0.0, *a)).collect();
    let fields: Vec<Field> =
        of.history.iter().map(|f| Field::named(f.name.clone(), kept(&f.unit))).collect();
    let sizes = Sizes {
        parameters: of.parameters.len(),
        coordinates: axes.len(),
        history: of.history.len(),
    };
    Ok(Shape {
        card: card
            .parameters(Vec::leak(all))
            .example(kept(&example))
            .exercise(Exercise::new(frequency, Vec::leak(strokes))),
        axes,
        fields: Vec::leak(fields),
        sizes,
        rates: of.rates,
        tangent: of.tangent,
        energy: of.energy,
        rate: amplitude.iter().map(|a| a * std::f64::consts::TAU * frequency).collect(),
        amplitude,
    })
}

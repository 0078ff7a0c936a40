//! What a run is: a sum over all that its numbers hang on.
//!
//! | part | why |
//! |---|---|
//! | version and build of the program, architecture, system | other code |
//! | width of vectors, bits of sines, exponentials and so on | the last bits |
//! | texts of the model and of what it includes | all that is no parameter |
//! | values of all parameters, in SI | what a study varies |
//! | samples of functions of time, files and matrices of elements | what stands in other files |
//! | case or combination, solver, side by side or alone, what is taken over time | how it is run |
//!
//! Names of files and folders, and the study around it, do not count: the same run is found again from another study.

use crate::column::over_time;
use crate::{Study, StudyError};
use sha2::{Digest, Sha256};
use std::fmt::Debug;
use trilith::Registry;
use trilith::element::{Dimension, Value};
use trilith::model::{Model, ParameterValue, TimeFunction};

/// SHA-256 of what a run is.
pub(crate) type Key = [u8; 32];

/// Grows with the meaning of what is kept.
const FORM: &str = "trilith run 1";

/// Makes the keys of the runs of a study.
pub(crate) struct Keys {
    /// Over all that the runs of the study have alike.
    alike: Sha256,
}

impl Keys {
    /// `beside`: whether runs go side by side where they fit.
    ///
    /// # Errors
    /// [`StudyError::OwnKinds`] for a program with kinds of its own, whose code no build tells.
    pub fn of(study: &Study, registry: &Registry, beside: bool) -> Result<Self, StudyError> {
        let own = trilith::registry();
        let added = registry.cards().find(|card| own.card(card.kind).is_none());
        if let Some(card) = added {
            return Err(StudyError::OwnKinds { kind: card.kind.to_owned() });
        }
        let mut alike = Sha256::new();
        for text in [FORM, trilith::VERSION, trilith::BUILD] {
            told(&mut alike, text);
        }
        told(&mut alike, &machine());
        alike.update(fingerprint());
        for source in study.sources() {
            told(&mut alike, &source.sha256);
        }
        let histories = study.histories.is_some();
        let which = (study.case, &study.combination, study.solver);
        let how = (which, beside, histories, over_time(&study.columns));
        shown(&mut alike, &how);
        Ok(Self { alike })
    }

    /// Of the run of a model.
    pub fn key(&self, model: &Model) -> Key {
        let mut sum = self.alike.clone();
        for parameter in &model.parameters {
            told(&mut sum, &parameter.name);
            match &parameter.value {
                ParameterValue::Number(x, Dimension { mass, length, time }) => {
                    numbers(&mut sum, &[*x, *mass, *length, *time]);
                }
                ParameterValue::Text(text) => told(&mut sum, text),
            }
        }
        for function in &model.functions {
            told(&mut sum, &function.name);
            shown(&mut sum, &function.dimension);
            match &function.function {
                // Long ones are not written out.
                TimeFunction::Table(table) => {
                    shown(&mut sum, &(table.interpolation(), table.after_end()));
                    numbers(&mut sum, table.times());
                    numbers(&mut sum, table.values());
                }
                other => shown(&mut sum, other),
            }
        }
        model
            .elements
            .iter()
            .flat_map(|e| &e.values.0)
            .for_each(|(_, value)| of_files(&mut sum, value));
        sum.finalize().into()
    }
}

/// Adds what a value of an element has read.
fn of_files(sum: &mut Sha256, value: &Value) {
    match value {
        Value::File(file) => told(sum, &file.text),
        Value::Matrix(matrix) => told(sum, &matrix.sha256),
        Value::List(all) => all.iter().for_each(|value| of_files(sum, value)),
        Value::Number(_) | Value::Text(_) | Value::Flag(_) => {}
    }
}

/// What results hang on beside the program: architecture, system, width of vectors in bits, and a sum of what functions
/// such as the sine are to the bit. Machines that say the same come to the same bits.
#[must_use]
pub fn machine() -> String {
    let [used, own] = trilith::solvers::vectors();
    let (arch, system) = (std::env::consts::ARCH, std::env::consts::OS);
    format!(
        "{arch} {system}, vectors of {used} bits, {own} in matrices, functions {}",
        short(&fingerprint())
    )
}

fn short(sum: &Key) -> String {
    sum[..4].iter().map(|b| format!("{b:02x}")).collect()
}

/// Functions that the system brings may differ in the last bit between its versions, and between processors with and
/// without fused products.
fn fingerprint() -> Key {
    let mut sum = Sha256::new();
    for i in 1..=64 {
        let x = f64::from(i) * 0.217_3;
        let (sin, cos) = x.sin_cos();
        let values = [sin, cos, x.tan(), x.exp(), x.ln(), x.powf(1.37), (x / 16.0).tanh()];
        numbers(&mut sum, &values);
        let values =
            [x.atan2(3.1), (x / 16.0).asin(), (x / 16.0).acos(), x.cbrt(), (x / 16.0).sinh()];
        numbers(&mut sum, &values);
        numbers(&mut sum, &[x.hypot(1.1), (x / 16.0).cosh(), x.exp_m1(), x.ln_1p(), x.log10()]);
    }
    sum.finalize().into()
}

fn numbers(sum: &mut Sha256, all: &[f64]) {
    sum.update((all.len() as u64).to_le_bytes());
    all.iter().for_each(|x| sum.update(x.to_bits().to_le_bytes()));
}

/// A text with its length before it: no two lists of texts are taken for each other.
fn told(sum: &mut Sha256, text: &str) {
    sum.update((text.len() as u64).to_le_bytes());
    sum.update(text);
}

fn shown(sum: &mut Sha256, value: &impl Debug) {
    told(sum, &format!("{value:?}"));
}

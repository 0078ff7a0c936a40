//! What all runs of a study have alike: repetition may hang on parameters that a study varies.

use trilith::model::Model;

/// Names of cases, names and units of outputs, in order: a study refers to them by their place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    cases: Vec<String>,
    outputs: Vec<(String, String)>,
}

impl Shape {
    pub fn of(model: &Model) -> Self {
        Self {
            cases: model.cases.iter().map(|case| case.name.clone()).collect(),
            outputs: model.outputs.iter().map(|o| (o.name.clone(), o.unit.clone())).collect(),
        }
    }

    /// What another model has in another place, or not at all; none where it has the same.
    pub fn misfit(&self, model: &Model) -> Option<String> {
        let other = Self::of(model);
        if self.cases != other.cases {
            return Some("the model has other cases than in the first run".into());
        }
        let pairs = self.outputs.iter().zip(&other.outputs);
        let first = pairs.clone().find(|(a, b)| a != b).map(|(a, _)| a);
        let missing = self.outputs.get(other.outputs.len());
        match (first.or(missing), other.outputs.get(self.outputs.len())) {
            (Some((name, _)), _) => Some(format!(
                "the model has other outputs than in the first run: `{name}` is not in its place"
            )),
            (None, Some((name, _))) => {
                Some(format!("the model has an output more than in the first run: `{name}`"))
            }
            (None, None) => None,
        }
    }
}

//! Combinations of cases.

use crate::failure::Failure;
use crate::model::json;
use crate::work::Watch;
use trilith::Model;
use trilith::combine::{CombineError, combine_until};
use trilith_cli::told;

/// The program's text, and all that was found as JSON.
pub(crate) type CombinationFacts = (String, String);

/// Runs the cases of some combinations, or of all, and combines them.
pub(crate) fn combine(
    model: &Model,
    of: &[String],
    watch: &Watch,
) -> Result<CombinationFacts, Failure> {
    let mut tell = |_: &str, share: f64| watch.tell(share);
    let found = combine_until(model, of, &mut tell, Some(&watch.interrupt));
    let found = found.map_err(|e| refused(e, model))?;
    Ok((told::combinations(model, &found), json(&found)?))
}

fn refused(error: CombineError, model: &Model) -> Failure {
    match error {
        CombineError::Run(e) => Failure::of(&e, model),
        CombineError::Unknown { name, .. } => {
            let all = model.combinations.iter().map(|c| c.name.as_str());
            Failure::unknown("combination", &name, "combinations", all)
        }
        e @ CombineError::Case { .. } => Failure::Run(e.to_string()),
        e => Failure::argument(&e.to_string(), None),
    }
}

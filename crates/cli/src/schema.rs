//! `trilith schema`.

use crate::{Answer, Failure};
use trilith::Registry;

/// The JSON Schema of models.
pub(crate) fn schema(registry: &Registry) -> Result<Answer, Failure> {
    // Names and texts: nothing that JSON does not have.
    let text = serde_json::to_string_pretty(&trilith::json_schema(registry)).unwrap_or_default();
    Ok(format!("{text}\n").into())
}

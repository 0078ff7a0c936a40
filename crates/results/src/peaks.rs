//! `peaks.csv`: one line for each output.

use crate::{FileError, Named, OutputSummary};
use std::path::Path;
use trilith_record::cell;

/// Writes the extremes of all outputs, in the order of the model, in SI. Numbers read back to the same bits; those of
/// an output that was not recorded are left out.
pub(crate) fn write(path: &Path, outputs: &Named<OutputSummary>) -> Result<(), FileError> {
    let fail = |e: csv::Error| FileError::at(path)(e);
    let mut file = csv::Writer::from_path(path).map_err(fail)?;
    let head = ["output", "unit", "max", "t_max [s]", "min", "t_min [s]", "final"];
    file.write_record(head).map_err(fail)?;
    for (name, o) in &outputs.0 {
        let numbers = match &o.peak {
            Some(p) => [p.max, p.t_max, p.min, p.t_min, p.last].map(|x| format!("{x:?}")),
            None => Default::default(),
        };
        let row = [name, &o.unit].map(|text| cell(text).into_owned()).into_iter().chain(numbers);
        file.write_record(row).map_err(fail)?;
    }
    file.flush().map_err(FileError::at(path))
}

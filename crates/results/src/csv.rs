//! `histories.csv`: one line per output time.

use crate::recorder::ENERGIES;
use crate::{FileError, Recorder};
use std::path::Path;
use trilith_model::Model;
use trilith_record::cell;

/// Writes the histories with a header of names and units. Numbers read back to the same bits.
pub(crate) fn write(path: &Path, model: &Model, record: &Recorder) -> Result<(), FileError> {
    let fail = |e: csv::Error| FileError::at(path)(e);
    let mut file = csv::Writer::from_path(path).map_err(fail)?;
    let outputs = model.shown().map(|(_, o)| {
        let head = format!("{} [{}]", o.name, o.unit);
        cell(&head).into_owned()
    });
    let energies = ENERGIES.iter().map(|e| format!("energy {} [J]", e.replace('_', " ")));
    let header = std::iter::once("t [s]".to_owned()).chain(outputs).chain(energies);
    file.write_record(header).map_err(fail)?;
    let columns: Vec<&[f64]> = model
        .shown()
        .filter_map(|(i, _)| record.history(i))
        .chain(record.energy().iter().map(Vec::as_slice))
        .collect();
    for (i, t) in record.time().iter().enumerate() {
        let numbers = std::iter::once(*t).chain(columns.iter().map(|c| c[i]));
        file.serialize(numbers.collect::<Vec<f64>>()).map_err(fail)?;
    }
    file.flush().map_err(FileError::at(path))
}

//! The folder of a run.

use crate::{FileError, Recorder, Summary, csv, npz, vtk};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use trilith_model::Model;

/// What goes into the folder of a run.
///
/// | file | what |
/// |---|---|
/// | `summary.json` | the [`Summary`] |
/// | `peaks.csv` | extremes of all outputs |
/// | `histories.csv`, `histories.npz` | outputs and energies at the output times |
/// | `spectra.csv` | floor spectra, where the model asks for any |
/// | `envelopes.csv` | extremes of forces along members, where the model asks for any |
/// | `model.resolved.ron` | the model in SI with every default |
/// | `report.json`, `report.html` | beside these, what the report of a run is made from, and its page (`trilith_report`) |
/// | `made_by.json` | beside these, of the program: its build, the command line, the files read, the date |
/// | `model.pvd`, `frames/*.vtu` | deformed shapes, where the recorder kept any |
#[derive(Clone, Copy, Debug)]
pub struct Files<'a> {
    /// The model.
    pub model: &'a Model,
    /// What was recorded.
    pub record: &'a Recorder,
    /// The summary.
    pub summary: &'a Summary,
}

impl Files<'_> {
    /// Writes the folder, which is made where it does not exist, and returns the files written.
    ///
    /// # Errors
    /// [`FileError`] with the path that cannot be written.
    pub fn write(&self, dir: impl AsRef<Path>) -> Result<Vec<PathBuf>, FileError> {
        let dir = dir.as_ref();
        std::fs::create_dir_all(dir).map_err(FileError::at(dir))?;
        let mut written = Vec::new();
        let mut path = |name: &str| {
            written.push(dir.join(name));
            dir.join(name)
        };
        crate::peaks::write(&path("peaks.csv"), &self.summary.outputs)?;
        csv::write(&path("histories.csv"), self.model, self.record)?;
        npz::write(&path("histories.npz"), self.model, self.record)?;
        if !self.summary.spectra.0.is_empty() {
            crate::spectra::write(&path("spectra.csv"), &self.summary.spectra)?;
        }
        if !self.summary.envelopes.0.is_empty() {
            crate::envelopes::write(&path("envelopes.csv"), self.model, self.record.peaks())?;
        }
        let resolved = path("model.resolved.ron");
        std::fs::write(&resolved, trilith_model::resolved(self.model))
            .map_err(FileError::at(&resolved))?;
        if vtk::write(dir, self.model, self.record.frames())? {
            path("model.pvd");
        }
        // Last, so that a summary stands for a complete folder.
        json(&path("summary.json"), self.summary)?;
        Ok(written)
    }
}

fn json(path: &Path, summary: &Summary) -> Result<(), FileError> {
    let mut file = BufWriter::new(File::create(path).map_err(FileError::at(path))?);
    serde_json::to_writer_pretty(&mut file, summary).map_err(FileError::at(path))?;
    file.write_all(b"\n").and_then(|()| file.flush()).map_err(FileError::at(path))
}

//! The folder of a run.

use crate::{ENERGIES, FileError, Recorder, Summary, csv, npz, vtk};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use trilith_linalg::threads::share;
use trilith_model::Model;

/// What makes a file.
type Work<'a> = Box<dyn FnOnce(&Path) -> Result<(), FileError> + Send + 'a>;
/// Operations that writing a number takes, about.
const TO_WRITE: usize = 100;

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
        let (model, record, summary) = (self.model, self.record, self.summary);
        let mut files: Vec<(&str, Work<'_>)> = vec![
            ("peaks.csv", Box::new(|path| crate::peaks::write(path, &summary.outputs))),
            ("histories.csv", Box::new(|path| csv::write(path, model, record))),
            ("histories.npz", Box::new(|path| npz::write(path, model, record))),
        ];
        if !summary.spectra.0.is_empty() {
            let write = |path: &Path| crate::spectra::write(path, &summary.spectra);
            files.push(("spectra.csv", Box::new(write)));
        }
        if !summary.envelopes.0.is_empty() {
            let write = |path: &Path| crate::envelopes::write(path, model, record.peaks());
            files.push(("envelopes.csv", Box::new(write)));
        }
        let resolved = |path: &Path| {
            std::fs::write(path, trilith_model::resolved(model)).map_err(FileError::at(path))
        };
        files.push(("model.resolved.ron", Box::new(resolved)));
        vtk::clear(dir)?;
        if record.frames().iter().next().is_some() {
            let write = |path: &Path| vtk::write(path, model, record.frames());
            files.push(("model.pvd", Box::new(write)));
        }
        let mut written: Vec<PathBuf> = files.iter().map(|(name, _)| dir.join(name)).collect();
        let mut done: Vec<Result<(), FileError>> = written.iter().map(|_| Ok(())).collect();
        let works = files.into_iter().map(|(_, work)| work);
        let mut pieces: Vec<_> = works.zip(&written).zip(&mut done).collect();
        // The longest are last among the names, and are begun first.
        pieces.reverse();
        share(TO_WRITE * self.numbers(), pieces, |((work, path), done)| *done = work(path));
        done.into_iter().collect::<Result<(), _>>()?;
        // Last, so that a summary stands for a complete folder.
        written.push(dir.join("summary.json"));
        json(&dir.join("summary.json"), summary)?;
        Ok(written)
    }

    /// How many of them there are in all files, about.
    fn numbers(&self) -> usize {
        let times = self.record.time().len();
        let of_frames = self.record.frames().iter().map(|f| f.displacements.len()).sum::<usize>();
        (self.model.outputs.len() + ENERGIES.len()) * times + of_frames
    }
}

fn json(path: &Path, summary: &Summary) -> Result<(), FileError> {
    let mut file = BufWriter::new(File::create(path).map_err(FileError::at(path))?);
    serde_json::to_writer_pretty(&mut file, summary).map_err(FileError::at(path))?;
    file.write_all(b"\n").and_then(|()| file.flush()).map_err(FileError::at(path))
}

//! What a run leaves behind: histories, peaks and files.
//!
//! [`Recorder`] watches a run, [`Envelope`] keeps its extremes only. [`Summary`] is `summary.json`, [`Files`] writes it together with
//! `peaks.csv`, `histories.csv`, `histories.npz`, `spectra.csv` and frames for ParaView.
//!
//! Peaks are those of all accepted substeps, not of the output times only, and where the time
//! derivative of an output is known they are those of the cubic Hermite polynomial between substeps.

mod csv;
mod digest;
mod drift;
mod envelope;
mod envelopes;
mod error;
mod files;
mod folder;
mod frames;
mod ground;
mod loops;
mod npz;
mod peaks;
mod quiet;
mod recorder;
mod spacing;
mod spectra;
mod summary;
#[cfg(test)]
mod tests;
mod vtk;

pub use digest::{sha256, sha256_of_json};
pub use drift::DriftSummary;
pub use envelope::Envelope;
pub use envelopes::{AlongMember, Extreme, ForceEnvelope, along_members};
pub use error::FileError;
pub use files::Files;
pub use folder::{Folder, FolderError, OF_RUN, Writer};
pub use frames::{Frame, Frames};
pub use ground::{GROUND_DAMPING, GroundMotion, ground_motions};
pub use loops::{LoopPoint, Loops};
pub use npz::npy;
pub use recorder::{ENERGIES, Recorder};
pub use spectra::{FloorSpectrum, SpectrumPeak, spectrum_warnings};
pub use summary::{BasisSummary, ModelSummary, Named, OutputSummary, ParameterSummary, Summary};
pub use trilith_solvers::Peak;

//! Floor spectra: response spectra of recorded accelerations.

use crate::{FileError, Named, Recorder};
use serde::Serialize;
use std::path::Path;
use trilith_model::Model;
use trilith_record::measure::{Spectrum, peak, spectrum};

/// The response spectra of one place, for several damping ratios.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FloorSpectrum {
    /// SI unit of the accelerations.
    pub unit: &'static str,
    /// Name of the output that it is the spectrum of.
    pub output: String,
    /// Largest |acceleration| of the place itself at the output times, m/s²: that of a rigid oscillator.
    pub zpa: f64,
    /// The largest response for each damping ratio.
    pub peaks: Vec<SpectrumPeak>,
    /// The curves.
    #[serde(skip)]
    pub spectra: Vec<Spectrum>,
}

/// The largest response over all periods.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SpectrumPeak {
    /// Damping, share of critical.
    pub damping: f64,
    /// Largest absolute acceleration of an oscillator, m/s².
    pub sa: f64,
    /// Its period, s.
    pub period: f64,
}

/// The spectra that a model asks for, from the histories at the output times; none where no histories were kept.
pub(crate) fn all(model: &Model, record: &Recorder) -> Vec<(String, FloorSpectrum)> {
    let time = record.time();
    if time.len() < 3 {
        return Vec::new();
    }
    let dt = (time[time.len() - 2] - time[0]) / (time.len() - 2) as f64;
    // A last step that is cut short would not fit in.
    let short = time[time.len() - 1] - time[time.len() - 2] < dt * (1.0 - 1e-6);
    let count = time.len() - usize::from(short);
    let one = |s: &trilith_model::FloorSpectrum| {
        let history = record.history(s.output)?.get(..count)?;
        let spectra: Vec<Spectrum> =
            s.damping.iter().map(|z| spectrum(history, dt, &s.periods, *z)).collect();
        let peaks = spectra.iter().filter_map(|s| {
            s.peak().map(|(sa, period)| SpectrumPeak { damping: s.damping, sa, period })
        });
        let floor = FloorSpectrum {
            unit: "m/s²",
            output: model.outputs.get(s.output).map(|o| o.name.clone()).unwrap_or_default(),
            zpa: peak(history),
            peaks: peaks.collect(),
            spectra,
        };
        Some((s.name.clone(), floor))
    };
    model.spectra.iter().filter_map(one).collect()
}

/// `spectra.csv`: one line for each spectrum, damping ratio and period.
pub(crate) fn write(path: &Path, all: &Named<FloorSpectrum>) -> Result<(), FileError> {
    let fail = |e: csv::Error| FileError::at(path)(e);
    let mut file = csv::Writer::from_path(path).map_err(fail)?;
    let head = [
        "spectrum",
        "damping",
        "period [s]",
        "frequency [Hz]",
        "sa [m/s²]",
        "psa [m/s²]",
        "sd [m]",
    ];
    file.write_record(head).map_err(fail)?;
    for (name, floor) in &all.0 {
        for s in &floor.spectra {
            for (period, r) in s.periods.iter().zip(&s.responses) {
                let numbers = [s.damping, *period, 1.0 / period, r.sa, r.psa, r.sd];
                let row = std::iter::once(name.clone()).chain(numbers.map(|x| format!("{x:?}")));
                file.write_record(row).map_err(fail)?;
            }
        }
    }
    file.flush().map_err(FileError::at(path))
}

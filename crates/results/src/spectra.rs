//! Floor spectra: response spectra of recorded accelerations.
//!
//! Between output times a history is taken for straight. A sine of period T in steps of dt then keeps sinc²(dt/T)
//! of its amplitude, sinc x = sin(πx)/(πx) (the transform of a linear interpolation): 0.8 % are lost at T/20, 3.2 % at
//! T/10, 13 % at T/5, and an oscillator in resonance loses as much.

use crate::{FileError, Named, Recorder};
use serde::Serialize;
use std::path::Path;
use trilith_model::Model;
use trilith_record::cell;
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

/// Fewest output steps in the shortest period of a spectrum.
const FEWEST_STEPS: f64 = 10.0;

/// The output step of a history, and how many samples it has at that step.
fn steps(time: &[f64]) -> Option<(f64, usize)> {
    let [first, .., before, last] = time else { return None };
    let dt = (before - first) / (time.len() - 2) as f64;
    // A last step that is cut short would not fit in.
    let short = last - before < dt * (1.0 - 1e-6);
    Some((dt, time.len() - usize::from(short)))
}

/// Tells where the output step is too long for the shortest period of a spectrum.
#[must_use]
pub fn spectrum_warnings(model: &Model, record: &Recorder) -> Vec<String> {
    let Some((dt, _)) = steps(record.time()) else { return Vec::new() };
    let shortest = |s: &trilith_model::FloorSpectrum| {
        s.periods.iter().copied().filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min)
    };
    // A hair of tolerance: 2 ms are a tenth of 20 ms.
    let coarse = model.spectra.iter().filter(|s| shortest(s) < FEWEST_STEPS * dt * (1.0 - 1e-9));
    let names: Vec<String> = coarse.clone().map(|s| format!("`{}`", s.name)).collect();
    let period = coarse.map(shortest).fold(f64::INFINITY, f64::min);
    if names.is_empty() {
        return Vec::new();
    }
    let x = std::f64::consts::PI * dt / period;
    let kept = if 2.0 * dt < period { (x.sin() / x).powi(2) } else { 0.0 };
    vec![format!(
        "floor spectrum {}: {:.3} output steps of {} s in the shortest period of {} s; motion of that period loses \
         up to {:.0} %; give the case `dt` ≤ {} s, or the spectrum periods from {} s on",
        names.join(", "),
        period / dt,
        rounded(dt),
        rounded(period),
        100.0 * (1.0 - kept),
        rounded(period / FEWEST_STEPS),
        rounded(FEWEST_STEPS * dt),
    )]
}

/// With four significant digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// The spectra that a model asks for, from the histories at the output times; none where no histories were kept.
pub(crate) fn all(model: &Model, record: &Recorder) -> Vec<(String, FloorSpectrum)> {
    let Some((dt, count)) = steps(record.time()) else { return Vec::new() };
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
        let name = cell(name);
        for s in &floor.spectra {
            for (period, r) in s.periods.iter().zip(&s.responses) {
                let numbers = [s.damping, *period, 1.0 / period, r.sa, r.psa, r.sd];
                let row =
                    std::iter::once(name.to_string()).chain(numbers.map(|x| format!("{x:?}")));
                file.write_record(row).map_err(fail)?;
            }
        }
    }
    file.flush().map_err(FileError::at(path))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the warning says of a sine in resonance is what the spectrum loses.
    #[test]
    fn long_output_steps_lose_what_the_warning_says() {
        let (period, damping) = (0.1, 0.02);
        let at = |steps: usize| {
            let dt = period / steps as f64;
            let count = 40 * steps;
            let sine = |i: usize| (std::f64::consts::TAU * (i as f64 + 0.37) / steps as f64).sin();
            let history: Vec<f64> = (0..count).map(sine).collect();
            spectrum(&history, dt, &[period], damping).responses[0].sa
        };
        let exact = at(400);
        for (steps, lost) in [(20, 0.008), (10, 0.032), (5, 0.125)] {
            let found = 1.0 - at(steps) / exact;
            assert!((found - lost).abs() < 0.15 * lost, "{steps}: {found}");
        }
    }

    #[test]
    fn a_last_step_that_is_cut_short_is_left_out() {
        assert_eq!(steps(&[0.0, 0.5, 1.0, 1.5]), Some((0.5, 4)));
        assert_eq!(steps(&[0.0, 0.5, 1.0, 1.2]), Some((0.5, 3)));
        assert_eq!(steps(&[0.0, 0.5]), None);
    }
}

//! Processing: baseline, taper, filters, resampling, trimming, scaling.

mod baseline;
mod butterworth;
mod resample;
mod shape;

pub use baseline::{Baseline, correct};
pub use butterworth::{Filter, FilterError, Padding, filter};
pub use resample::{Resampling, resample};
pub use shape::{scaled, scaled_to, taper, trim};

use crate::{MOST_SAMPLES, NotFinite, Record};

/// What is to be done with a record, in this order: trimming, baseline, taper, filter, resampling, scaling to a
/// peak, scaling by a factor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Processing {
    /// Keep from one time to another, s.
    pub trim: Option<(f64, f64)>,
    /// Baseline to take away.
    pub baseline: Option<Baseline>,
    /// Share of the duration over which each end rises and falls with a half cosine.
    pub taper: f64,
    /// Butterworth filter.
    pub filter: Option<Filter>,
    /// New time step, s, and how.
    pub resample: Option<(f64, Resampling)>,
    /// Peak to scale to, m/s².
    pub scale_to: Option<f64>,
    /// Factor.
    pub scale: Option<f64>,
}

/// Why a record cannot be processed as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProcessError {
    /// The part to keep lies outside the record.
    #[error("the part from {from} s to {to} s does not lie within the record of {duration} s")]
    Trim {
        /// s.
        from: f64,
        /// s.
        to: f64,
        /// s.
        duration: f64,
    },
    /// A taper of more than half.
    #[error("a taper of {0} at each end: must be between 0 and 0.5")]
    Taper(f64),
    /// A filter that cannot be made.
    #[error(transparent)]
    Filter(#[from] FilterError),
    /// A step that is none.
    #[error(
        "a new time step of {0} s: must be above 0, shorter than the record, and make fewer than {most} samples",
        most = MOST_SAMPLES
    )]
    Step(f64),
    /// Nothing to scale.
    #[error("the record is zero throughout and cannot be scaled to a peak")]
    Zero,
    /// Too short for the baseline.
    #[error("a baseline of order {order} needs more than {samples} samples")]
    Baseline {
        /// Order of the polynomial.
        order: usize,
        /// Samples of the record.
        samples: usize,
    },
    /// The result overflows.
    #[error("{0} after the processing")]
    NotFinite(#[from] NotFinite),
    /// A result that is too long.
    #[error("{0} samples after the processing: a motion has at most {most}", most = MOST_SAMPLES)]
    TooLong(usize),
}

impl Processing {
    /// Processes a record.
    ///
    /// # Errors
    /// [`ProcessError`].
    pub fn apply(&self, record: &Record) -> Result<Record, ProcessError> {
        let mut r = record.clone();
        if let Some((from, to)) = self.trim {
            r.acceleration = trim(&r.acceleration, r.dt, from, to)?;
            r.notes.push(format!("kept from {from} s to {to} s"));
        }
        if let Some(baseline) = self.baseline {
            correct(&mut r.acceleration, r.dt, baseline)?;
            r.notes.push(format!("baseline: {}", baseline.words()));
        }
        if self.taper != 0.0 {
            taper(&mut r.acceleration, self.taper)?;
            r.notes.push(format!("taper of {} % at each end", 100.0 * self.taper));
        }
        if let Some(f) = &self.filter {
            r.acceleration = filter(&r.acceleration, r.dt, f)?;
            r.notes.push(f.words());
        }
        if let Some((dt, how)) = self.resample {
            r.acceleration = resample(&r.acceleration, r.dt, dt, how)?;
            r.notes.push(format!("resampled from {} s to {dt} s", r.dt));
            r.dt = dt;
        }
        if let Some(peak) = self.scale_to {
            r.acceleration = scaled_to(&r.acceleration, peak)?;
            r.notes.push(format!("scaled to a peak of {peak} m/s²"));
        }
        if let Some(factor) = self.scale {
            r.acceleration = scaled(&r.acceleration, factor);
            r.notes.push(format!("scaled by {factor}"));
        }
        if r.acceleration.len() > MOST_SAMPLES {
            return Err(ProcessError::TooLong(r.acceleration.len()));
        }
        r.check_finite()?;
        Ok(r)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_overflows_is_named() {
        let record = Record::new(vec![0.0, 1.0, -1.0, 0.0], 0.01);
        let told = |p: Processing| p.apply(&record).unwrap_err().to_string();
        let text = told(Processing { scale: Some(1e300), ..Processing::default() });
        assert_eq!(text, "the Arias intensity is not finite after the processing");
        let filter = Filter {
            highpass: Some(1e-9),
            lowpass: None,
            order: 4,
            causal: false,
            padding: Padding::Keep,
        };
        let text = told(Processing { filter: Some(filter), ..Processing::default() });
        assert!(text.contains("samples with its zeros: a motion has at most 2000000"), "{text}");
    }
}

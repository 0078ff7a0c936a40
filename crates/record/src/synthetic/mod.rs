//! Synthetic motions: filtered white noise under an envelope, and motions that meet a response spectrum.
//!
//! The random numbers are those of ChaCha with 12 rounds, whose key is the seed; normal ones come from them by the
//! rule of Box and Muller. The same seed gives the same motion.

mod compatible;
mod envelope;
mod kanai_tajimi;
mod normal;
mod wavelet;

pub use compatible::{Compatible, Fit, Target};
pub use envelope::Envelope;
pub use kanai_tajimi::KanaiTajimi;

use crate::{MOST_SAMPLES, NotFinite};

/// Why no motion can be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SyntheticError {
    /// A number outside its range.
    #[error("`{name}` = {value}: must be {range}")]
    Range {
        /// Name of the parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What would be right.
        range: &'static str,
    },
    /// Too long.
    #[error("{0} samples: a motion has at most {most}", most = MOST_SAMPLES)]
    TooLong(f64),
    /// Too long to meet a spectrum.
    #[error(
        "{samples} samples: a motion that meets a spectrum from a period of {shortest} s on has at most {most} at a step of {dt} s"
    )]
    TooMuch {
        /// Samples of the motion.
        samples: usize,
        /// Most samples at this step and these periods.
        most: usize,
        /// Shortest period of the spectrum, s.
        shortest: f64,
        /// Time step, s.
        dt: f64,
    },
    /// The parameters leave nothing of the noise.
    #[error("the motion is zero throughout: its frequencies leave nothing of the noise")]
    Zero,
    /// The motion overflows.
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    /// Too few points.
    #[error("a target spectrum needs at least two points, this one has {0}")]
    Points(usize),
    /// Periods do not rise.
    #[error("the periods of a target spectrum must rise: {period} s follows {before} s")]
    Order {
        /// s.
        period: f64,
        /// s.
        before: f64,
    },
}

/// A number that must be above 0.
fn positive(name: &'static str, value: f64) -> Result<(), SyntheticError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(SyntheticError::Range { name, value, range: "above 0" })
}

/// The number of samples from 0 to `duration`.
fn samples(duration: f64, dt: f64) -> Result<usize, SyntheticError> {
    positive("duration", duration)?;
    positive("dt", dt)?;
    let n = (duration / dt).round() + 1.0;
    if n > MOST_SAMPLES as f64 {
        return Err(SyntheticError::TooLong(n));
    }
    if n < 4.0 {
        return Err(SyntheticError::Range {
            name: "duration",
            value: duration,
            range: "three steps or more",
        });
    }
    Ok(n as usize)
}

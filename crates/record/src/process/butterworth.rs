//! Butterworth filters: second-order sections by the bilinear transform with prewarped corners.
//!
//! The poles of the analog low-pass of order n lie at e^(iπ(2k + n + 1)/(2n)) \[Butterworth 1930\]; low-pass, high-pass
//! and band-pass follow by s → s/ω_c, ω_c/s, (s² + ω₁ω₂)/(s(ω₂ − ω₁)), and z from s = (2/Δt)(z − 1)/(z + 1) with the
//! corners at (2/Δt) tan(πfΔt). A band-pass has twice the order.

use crate::MOST_SAMPLES;
use realfft::num_complex::Complex;
use std::f64::consts::PI;

type C = Complex<f64>;

/// Zeros that a filter runs over before and behind the record.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Padding {
    /// None.
    None,
    /// 1.5 order/corner at each end (causal: behind it only) for a high-pass or band-pass, and cut off again
    /// \[Converse & Brady 1992; Boore 2005\].
    #[default]
    Strip,
    /// The same, and kept: velocity and displacement then start and end at rest, and the record is longer.
    Keep,
}

/// A Butterworth filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filter {
    /// Corner below which it cuts, Hz.
    pub highpass: Option<f64>,
    /// Corner above which it cuts, Hz.
    pub lowpass: Option<f64>,
    /// Order, 1 to 10.
    pub order: usize,
    /// Once forward, with a shift of phase; otherwise forward and back without one, with the square of the
    /// transfer function (−6 dB at the corner).
    pub causal: bool,
    /// Zeros around the record.
    pub padding: Padding,
}

/// Why there is no such filter.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FilterError {
    /// No corner.
    #[error("a filter needs a corner: `highpass`, `lowpass` or both")]
    NoCorner,
    /// Corner outside the band of the record.
    #[error(
        "a corner at {corner} Hz: must be above 0 and below {nyquist} Hz, half the sampling rate"
    )]
    Corner {
        /// Hz.
        corner: f64,
        /// Hz.
        nyquist: f64,
    },
    /// The band is empty.
    #[error("the band from {highpass} Hz to {lowpass} Hz is empty")]
    Band {
        /// Hz.
        highpass: f64,
        /// Hz.
        lowpass: f64,
    },
    /// More zeros than a motion may have samples.
    #[error(
        "a corner at {corner} Hz needs {samples} samples with its zeros: a motion has at most {most}",
        most = MOST_SAMPLES
    )]
    Padding {
        /// Hz.
        corner: f64,
        /// Samples of the record with the zeros around it.
        samples: f64,
    },
    /// Order out of range.
    #[error("order {0}: must be 1 to 10")]
    Order(usize),
}

impl Filter {
    pub(crate) fn words(&self) -> String {
        let band = match (self.highpass, self.lowpass) {
            (Some(a), Some(b)) => format!("band-pass {a} Hz to {b} Hz"),
            (Some(a), None) => format!("high-pass {a} Hz"),
            (None, b) => format!("low-pass {} Hz", b.unwrap_or(f64::NAN)),
        };
        let way = if self.causal { "causal" } else { "forward and back" };
        format!("Butterworth {band}, order {}, {way}", self.order)
    }

    /// Sections b₀ b₁ b₂ a₁ a₂ for a time step.
    fn sections(&self, dt: f64) -> Result<Vec<[f64; 5]>, FilterError> {
        let nyquist = 0.5 / dt;
        if !(1..=10).contains(&self.order) {
            return Err(FilterError::Order(self.order));
        }
        for corner in [self.highpass, self.lowpass].into_iter().flatten() {
            if !(corner > 0.0 && corner < nyquist) {
                return Err(FilterError::Corner { corner, nyquist });
            }
        }
        let warp = |f: f64| 2.0 / dt * (PI * f * dt).tan();
        let n = self.order;
        let prototype =
            (0..n).map(|k| C::from_polar(1.0, PI * (2 * k + n + 1) as f64 / (2 * n) as f64));
        // Analog poles, and the number of zeros at s = 0 for each of them; `at`: where the gain is 1.
        let (poles, zeros, at): (Vec<C>, usize, f64) = match (self.highpass, self.lowpass) {
            (None, None) => return Err(FilterError::NoCorner),
            (None, Some(f)) => (prototype.map(|p| p * warp(f)).collect(), 0, 0.0),
            (Some(f), None) => (prototype.map(|p| warp(f) / p).collect(), n, nyquist),
            (Some(highpass), Some(lowpass)) => {
                if highpass >= lowpass {
                    return Err(FilterError::Band { highpass, lowpass });
                }
                let (w1, w2) = (warp(highpass), warp(lowpass));
                let both = prototype.flat_map(|p| {
                    let half = p * (0.5 * (w2 - w1));
                    let root = (half * half - w1 * w2).sqrt();
                    [half + root, half - root]
                });
                let center = ((w1 * w2).sqrt() * 0.5 * dt).atan() / (PI * dt);
                (both.collect(), n, center)
            }
        };
        let c = 2.0 / dt;
        let digital: Vec<C> = poles.into_iter().map(|p| (c + p) / (c - p)).collect();
        // Conjugates belong together; real poles make pairs or stand alone.
        let mut sections = Vec::new();
        let (real, complex): (Vec<C>, Vec<C>) =
            digital.iter().partition(|p| p.im.abs() < 1e-12 * p.norm().max(1e-300));
        let mut denominators: Vec<[f64; 2]> =
            complex.iter().filter(|p| p.im > 0.0).map(|p| [-2.0 * p.re, p.norm_sqr()]).collect();
        denominators.extend(real.chunks(2).map(|p| match p {
            [a, b] => [-(a.re + b.re), a.re * b.re],
            _ => [-p[0].re, 0.0],
        }));
        // Zeros: `zeros` at z = 1, the rest at z = −1.
        let (mut ones, mut minus) = (zeros, digital.len() - zeros);
        for a in denominators {
            let single = a[1] == 0.0;
            let mut take = || {
                if ones >= minus && ones > 0 {
                    ones -= 1;
                    Some(1.0)
                } else if minus > 0 {
                    minus -= 1;
                    Some(-1.0)
                } else {
                    None
                }
            };
            let first: f64 = take().unwrap_or(0.0);
            let second: f64 = if single { 0.0 } else { take().unwrap_or(0.0) };
            let b = [1.0, -(first + second), first * second];
            // Each section has the gain 1 where the whole has.
            let z = C::from_polar(1.0, -2.0 * PI * at * dt);
            let gain =
                (1.0 + z * a[0] + z * z * a[1]).norm() / (b[0] + z * b[1] + z * z * b[2]).norm();
            sections.push([gain * b[0], gain * b[1], gain * b[2], a[0], a[1]]);
        }
        Ok(sections)
    }
}

/// Filters an acceleration.
///
/// # Errors
/// [`FilterError`].
pub fn filter(a: &[f64], dt: f64, filter: &Filter) -> Result<Vec<f64>, FilterError> {
    let sections = filter.sections(dt)?;
    let pad = match (filter.padding, filter.highpass) {
        (Padding::None, _) | (_, None) => 0,
        (_, Some(f)) => {
            let zeros = (1.5 * filter.order as f64 / f / dt).ceil();
            let samples = a.len() as f64 + if filter.causal { zeros } else { 2.0 * zeros };
            if samples > MOST_SAMPLES as f64 {
                return Err(FilterError::Padding { corner: f, samples });
            }
            zeros as usize
        }
    };
    let before = if filter.causal { 0 } else { pad };
    let mut y = vec![0.0; before];
    y.extend_from_slice(a);
    y.resize(before + a.len() + pad, 0.0);
    run(&sections, &mut y);
    if !filter.causal {
        y.reverse();
        run(&sections, &mut y);
        y.reverse();
    }
    if filter.padding == Padding::Strip {
        y.truncate(before + a.len());
        y.drain(..before);
    }
    Ok(y)
}

/// Sections in a row, transposed direct form II.
fn run(sections: &[[f64; 5]], y: &mut [f64]) {
    for [b0, b1, b2, a1, a2] in sections {
        let (mut s1, mut s2) = (0.0, 0.0);
        for x in y.iter_mut() {
            let out = b0 * *x + s1;
            s1 = b1 * *x - a1 * out + s2;
            s2 = b2 * *x - a2 * out;
            *x = out;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::fourier;

    /// |H|² of a Butterworth filter through the bilinear transform, with w = tan(πfΔt).
    fn exact(f: f64, dt: f64, filter: &Filter) -> f64 {
        let w = |f: f64| (PI * f * dt).tan();
        let x = match (filter.highpass, filter.lowpass) {
            (None, Some(c)) => w(f) / w(c),
            (Some(c), None) => w(c) / w(f),
            (Some(a), Some(b)) => (w(f).powi(2) - w(a) * w(b)) / (w(f) * (w(b) - w(a))),
            _ => unreachable!(),
        };
        1.0 / (1.0 + x.powi(2 * filter.order as i32))
    }

    #[test]
    fn impulses_have_the_transfer_function_of_the_closed_form() {
        let dt = 0.01;
        for (highpass, lowpass) in [(None, Some(12.0)), (Some(3.0), None), (Some(1.0), Some(20.0))]
        {
            for order in [1, 2, 3, 4, 7] {
                for causal in [true, false] {
                    let f = Filter { highpass, lowpass, order, causal, padding: Padding::None };
                    let mut a = vec![0.0; 8192];
                    a[4096] = 1.0 / dt;
                    let out = fourier(&filter(&a, dt, &f).unwrap(), dt);
                    for k in [10, 100, 300, 1000, 2000, 4000] {
                        let square = exact(out.frequency[k], dt, &f);
                        let wanted = if causal { square.sqrt() } else { square };
                        let found = out.amplitude[k];
                        assert!((found - wanted).abs() < 1e-6, "{f:?} {k}: {found} {wanted}");
                    }
                }
            }
        }
    }

    #[test]
    fn forward_and_back_shifts_nothing() {
        let f = Filter {
            highpass: None,
            lowpass: Some(10.0),
            order: 4,
            causal: false,
            padding: Padding::None,
        };
        let mut a = vec![0.0; 1001];
        a[500] = 1.0;
        let out = filter(&a, 0.01, &f).unwrap();
        assert!((0..500).all(|i| (out[500 - i] - out[500 + i]).abs() < 1e-12));
    }

    #[test]
    fn pads_are_cut_or_kept() {
        let with = |padding| Filter {
            highpass: Some(0.5),
            lowpass: None,
            order: 4,
            causal: false,
            padding,
        };
        let a = vec![1.0; 300];
        assert_eq!(filter(&a, 0.01, &with(Padding::Strip)).unwrap().len(), 300);
        assert_eq!(filter(&a, 0.01, &with(Padding::Keep)).unwrap().len(), 300 + 2 * 1200);
    }

    #[test]
    fn impossible_filters_are_refused() {
        let f = |highpass, lowpass, order| Filter {
            highpass,
            lowpass,
            order,
            causal: true,
            padding: Padding::None,
        };
        let told = |x: Filter| filter(&[0.0; 10], 0.01, &x).unwrap_err();
        assert_eq!(told(f(None, None, 4)), FilterError::NoCorner);
        assert_eq!(
            told(f(None, Some(50.0), 4)),
            FilterError::Corner { corner: 50.0, nyquist: 50.0 }
        );
        assert_eq!(
            told(f(Some(9.0), Some(3.0), 4)),
            FilterError::Band { highpass: 9.0, lowpass: 3.0 }
        );
        assert_eq!(told(f(Some(9.0), None, 0)), FilterError::Order(0));
    }
}

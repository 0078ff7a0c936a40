//! Fourier amplitudes.

use realfft::RealFftPlanner;

/// Fourier amplitude spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct Fourier {
    /// Frequencies from 0 to that of Nyquist, Hz.
    pub frequency: Vec<f64>,
    /// |∫ a e^(−2πift) dt|, m/s.
    pub amplitude: Vec<f64>,
}

/// The Fourier amplitudes of an acceleration, padded with zeros to a length that is quick to transform.
#[must_use]
pub fn fourier(acceleration: &[f64], dt: f64) -> Fourier {
    let n = acceleration.len().next_power_of_two().max(2);
    let mut input = acceleration.to_vec();
    input.resize(n, 0.0);
    let spectrum = transform(&mut input);
    Fourier {
        frequency: (0..spectrum.len()).map(|k| k as f64 / (n as f64 * dt)).collect(),
        amplitude: spectrum.iter().map(|c| dt * c.norm()).collect(),
    }
}

/// Forward transform of real values, half of it.
pub(crate) fn transform(values: &mut [f64]) -> Vec<realfft::num_complex::Complex<f64>> {
    let plan = RealFftPlanner::<f64>::new().plan_fft_forward(values.len());
    let mut out = plan.make_output_vec();
    // The lengths are those of the plan, so it cannot fail.
    let _ = plan.process(values, &mut out);
    out
}

/// Inverse of [`transform`] with `n` values.
pub(crate) fn inverse(spectrum: &mut [realfft::num_complex::Complex<f64>], n: usize) -> Vec<f64> {
    let plan = RealFftPlanner::<f64>::new().plan_fft_inverse(n);
    // A real signal has real ends.
    if let Some(first) = spectrum.first_mut() {
        first.im = 0.0;
    }
    if n.is_multiple_of(2)
        && let Some(last) = spectrum.last_mut()
    {
        last.im = 0.0;
    }
    let mut out = plan.make_output_vec();
    let _ = plan.process(spectrum, &mut out);
    out.iter_mut().for_each(|x| *x /= n as f64);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rectangular pulse of height 1 and length D has |F(f)| = |sin(πfD)/(πf)|.
    #[test]
    fn a_pulse_has_its_sinc() {
        let (dt, d) = (1e-3, 0.5);
        let a: Vec<f64> = (0..8192).map(|i| f64::from((i as f64) * dt < d)).collect();
        let f = fourier(&a, dt);
        for k in [3, 10, 27] {
            let x = std::f64::consts::PI * f.frequency[k];
            let exact = ((x * d).sin() / x).abs();
            assert!((f.amplitude[k] - exact).abs() < 2e-5, "{k}: {} {exact}", f.amplitude[k]);
        }
    }

    #[test]
    fn back_and_forth_is_nothing() {
        for n in [7, 16] {
            let a: Vec<f64> = (0..n).map(|i| (i as f64 * 0.7).sin()).collect();
            let back = inverse(&mut transform(&mut a.clone()), n);
            assert!(a.iter().zip(&back).all(|(x, y)| (x - y).abs() < 1e-14));
        }
    }
}

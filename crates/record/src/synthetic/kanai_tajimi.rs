//! White noise through a soil layer and a high-pass, under an envelope.
//!
//! ```text
//! S(ω) = S₀ · (1 + 4ζ_g² x²)/((1 − x²)² + 4ζ_g² x²) · y⁴/((1 − y²)² + 4ζ_f² y²),   x = ω/ω_g, y = ω/ω_f
//! ```
//!
//! \[Kanai 1957, Tajimi 1960; Clough & Penzien 1975\].

use super::normal::Normal;
use super::{Envelope, SyntheticError, positive, samples};
use crate::Record;
use crate::finite::history;
use crate::measure::{inverse, transform};
use crate::process::{Baseline, correct, scaled_to};
use realfft::num_complex::Complex;

/// A motion of filtered white noise.
#[derive(Clone, Debug, PartialEq)]
pub struct KanaiTajimi {
    /// Frequency of the ground, Hz.
    pub frequency: f64,
    /// Damping of the ground, share of critical.
    pub damping: f64,
    /// Frequency of the high-pass of Clough and Penzien, Hz.
    pub highpass: f64,
    /// Its damping.
    pub highpass_damping: f64,
    /// Length, s.
    pub duration: f64,
    /// Time step, s.
    pub dt: f64,
    /// Envelope.
    pub envelope: Envelope,
    /// Largest |acceleration|, m/s².
    pub peak: f64,
    /// Seed.
    pub seed: u64,
}

impl Default for KanaiTajimi {
    /// Firm ground, 20 s at 10 ms, 0.3 g.
    fn default() -> Self {
        Self {
            frequency: 2.5,
            damping: 0.6,
            highpass: 0.25,
            highpass_damping: 0.6,
            duration: 20.0,
            dt: 0.01,
            envelope: Envelope::SaragoniHart { peak_at: 0.2, end: 0.05 },
            peak: 0.3 * crate::STANDARD_GRAVITY,
            seed: 1,
        }
    }
}

impl KanaiTajimi {
    /// The spectral density at a frequency (Hz) over that of the white noise.
    #[must_use]
    pub fn density(&self, frequency: f64) -> f64 {
        self.transfer(frequency).norm_sqr()
    }

    fn transfer(&self, f: f64) -> Complex<f64> {
        let i = Complex::new(0.0, 1.0);
        let (x, y) = (f / self.frequency, f / self.highpass);
        let ground =
            (1.0 + 2.0 * self.damping * x * i) / (1.0 - x * x + 2.0 * self.damping * x * i);
        ground * (-y * y) / (1.0 - y * y + 2.0 * self.highpass_damping * y * i)
    }

    /// The stationary motion whose two-sided spectral density in Hz is that of the formula with 1 (m/s²)²/Hz
    /// of white noise, without envelope, scaling and baseline; `seed` chooses it.
    ///
    /// # Errors
    /// [`SyntheticError`] for numbers outside their range.
    pub fn stationary(&self) -> Result<Vec<f64>, SyntheticError> {
        for (name, value) in [
            ("frequency", self.frequency),
            ("damping", self.damping),
            ("highpass", self.highpass),
            ("highpass_damping", self.highpass_damping),
        ] {
            positive(name, value)?;
        }
        let n = samples(self.duration, self.dt)?;
        // Behind the motion there is room for the filters to ring out.
        let whole = (2 * n).next_power_of_two();
        let mut normal = Normal::new(self.seed);
        let noise = (1.0 / self.dt).sqrt();
        let mut values: Vec<f64> = (0..whole).map(|_| noise * normal.next()).collect();
        let mut spectrum = transform(&mut values);
        for (k, c) in spectrum.iter_mut().enumerate() {
            *c *= self.transfer(k as f64 / (whole as f64 * self.dt));
        }
        let mut a = inverse(&mut spectrum, whole);
        a.truncate(n);
        Ok(a)
    }

    /// The motion under its envelope, brought to end at rest, scaled to its peak.
    ///
    /// # Errors
    /// [`SyntheticError`] for numbers outside their range, and for motions that are zero or not finite.
    pub fn make(&self) -> Result<Record, SyntheticError> {
        positive("peak", self.peak)?;
        self.envelope.check(self.duration)?;
        let mut a = self.stationary()?;
        for (i, x) in a.iter_mut().enumerate() {
            *x *= self.envelope.at(i as f64 * self.dt, self.duration);
        }
        // It has four samples or more, so it cannot fail.
        let _ = correct(&mut a, self.dt, Baseline::Rest);
        history("filtered noise", &a)?;
        let a = scaled_to(&a, self.peak).map_err(|_| SyntheticError::Zero)?;
        let mut record = Record::new(a, self.dt);
        record.component = format!("synthetic, seed {}", self.seed);
        record.event = format!(
            "Kanai–Tajimi {} Hz, {} damping, Clough–Penzien {} Hz",
            self.frequency, self.damping, self.highpass
        );
        record.check_finite()?;
        Ok(record)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{displacement, peak, velocity};

    /// Mean of the periodograms of many seeds against the formula, in bands of frequency.
    #[test]
    fn the_density_of_an_ensemble_is_that_of_the_formula() {
        let plain = KanaiTajimi { duration: 40.95, dt: 0.01, ..KanaiTajimi::default() };
        let runs = 60;
        let mut sum = vec![0.0; 2049];
        for seed in 0..runs {
            let mut a = KanaiTajimi { seed, ..plain.clone() }.stationary().unwrap();
            assert_eq!(a.len(), 4096);
            let mut power = 0.0;
            for (i, x) in a.iter_mut().enumerate() {
                // Hann, so that the strong part does not leak.
                let w = 0.5 - 0.5 * (std::f64::consts::TAU * i as f64 / 4096.0).cos();
                *x *= w;
                power += w * w;
            }
            let s = transform(&mut a);
            s.iter().zip(&mut sum).for_each(|(c, s)| *s += c.norm_sqr() * plain.dt / power);
        }
        for band in [8..16, 40..80, 90..120, 200..400, 800..1600] {
            let mean =
                |f: &dyn Fn(usize) -> f64| band.clone().map(f).sum::<f64>() / band.len() as f64;
            let found = mean(&|k| sum[k] / f64::from(runs as u32));
            let exact = mean(&|k| plain.density(k as f64 / 40.96));
            assert!((found / exact - 1.0).abs() < 0.08, "{band:?}: {found} {exact}");
        }
    }

    #[test]
    fn a_motion_has_its_peak_ends_at_rest_and_is_that_of_its_seed() {
        let k = KanaiTajimi { seed: 42, ..KanaiTajimi::default() };
        let r = k.make().unwrap();
        assert_eq!(r.acceleration.len(), 2001);
        assert!((peak(&r.acceleration) / k.peak - 1.0).abs() < 1e-12);
        assert!(velocity(&r.acceleration, r.dt)[2000].abs() < 1e-12);
        assert!(displacement(&r.acceleration, r.dt)[2000].abs() < 1e-11);
        let bits = |r: &Record| r.acceleration.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&r), bits(&k.make().unwrap()));
        assert_ne!(bits(&r), bits(&KanaiTajimi { seed: 43, ..k.clone() }.make().unwrap()));
        assert!(KanaiTajimi { damping: 0.0, ..k.clone() }.make().is_err());
        let long = KanaiTajimi { duration: 1e5, ..k.clone() }.make();
        assert_eq!(long.unwrap_err(), SyntheticError::TooLong(10_000_001.0));
        assert!(KanaiTajimi { dt: 1e-9, ..k }.make().is_err());
    }

    #[test]
    fn motions_that_overflow_or_vanish_are_refused() {
        let k = KanaiTajimi::default();
        let told = |k: KanaiTajimi| k.make().unwrap_err().to_string();
        let text = told(KanaiTajimi { peak: 1e308, ..k.clone() });
        assert!(text.ends_with("is not finite") || text.contains("not finite, first at"), "{text}");
        let text = told(KanaiTajimi { highpass: 1e200, ..k });
        assert!(text.contains("zero throughout") || text.contains("not finite"), "{text}");
    }
}

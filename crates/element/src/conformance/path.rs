//! Random smooth paths of deformation.

use std::f64::consts::TAU;

/// Marsaglia's xorshift64*, enough for test paths and the same everywhere.
pub(super) struct Random(u64);

impl Random {
    pub(super) fn new(seed: u64, stream: usize) -> Self {
        let mix = seed.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let mut it = Self((mix ^ (stream as u64 + 1).wrapping_mul(0xD1B5_4A32_D192_ED03)).max(1));
        for _ in 0..8 {
            it.next();
        }
        it
    }

    /// Uniform in −1 … 1.
    pub(super) fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// `dᵢ(t) = mᵢ r(t) + Σₖ aᵢₖ (sin(k ω t + φᵢₖ) − sin φᵢₖ)`: zero at the start, periodic once r has gone
/// smoothly from 0 to 1 in the first half of a cycle.
pub(super) struct Path {
    pub(super) number: usize,
    pub(super) omega: f64,
    pub(super) scale: Vec<f64>,
    mean: Vec<f64>,
    waves: Vec<[(f64, f64); 3]>,
}

impl Path {
    pub(super) fn random(
        scale: &[f64],
        mean: &[f64],
        frequency: f64,
        seed: u64,
        number: usize,
    ) -> Self {
        let mut random = Random::new(seed, number);
        let mut wave = |s: f64| [0; 3].map(|_| (0.6 * s * random.next(), TAU * random.next()));
        let waves = scale.iter().map(|s| wave(*s)).collect();
        let (omega, scale, mean) = (TAU * frequency, scale.to_vec(), mean.to_vec());
        Self { number, omega, scale, mean, waves }
    }

    pub(super) fn period(&self) -> f64 {
        TAU / self.omega
    }

    /// Time, deformation and rate at the ends of all steps, `steps` a cycle.
    pub(super) fn ends(
        &self,
        cycles: usize,
        steps: usize,
    ) -> impl Iterator<Item = (f64, Vec<f64>, Vec<f64>)> {
        let dt = self.period() / steps as f64;
        (1..=cycles * steps).map(move |number| {
            let time = number as f64 * dt;
            let (d, v) = self.at(time);
            (time, d, v)
        })
    }

    /// Deformation and rate.
    pub(super) fn at(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        // r = 3x² − 2x³ over half a cycle.
        let x = (2.0 * t / self.period()).clamp(0.0, 1.0);
        let (ramp, slope) = (x * x * (3.0 - 2.0 * x), 12.0 * x * (1.0 - x) / self.period());
        let value = |(wave, mean): (&[(f64, f64); 3], &f64)| {
            let (mut d, mut v) = (mean * ramp, mean * slope);
            for (k, (a, phase)) in wave.iter().enumerate() {
                let w = (k + 1) as f64 * self.omega;
                d += a * ((w * t + phase).sin() - phase.sin());
                v += a * w * (w * t + phase).cos();
            }
            (d, v)
        };
        self.waves.iter().zip(&self.mean).map(value).unzip()
    }
}

//! Normal random numbers of a seed.

use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use std::f64::consts::TAU;

/// Independent numbers of mean 0 and variance 1.
pub(super) struct Normal {
    rng: ChaCha12Rng,
    spare: Option<f64>,
}

impl Normal {
    pub fn new(seed: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        Self { rng: ChaCha12Rng::from_seed(key), spare: None }
    }

    /// Between 0 (not included) and 1, in steps of 2⁻⁵³.
    fn uniform(&mut self) -> f64 {
        ((self.rng.next_u64() >> 11) + 1) as f64 / (1u64 << 53) as f64
    }

    pub fn next(&mut self) -> f64 {
        if let Some(x) = self.spare.take() {
            return x;
        }
        let r = (-2.0 * self.uniform().ln()).sqrt();
        let (s, c) = (TAU * self.uniform()).sin_cos();
        self.spare = Some(r * s);
        r * c
    }
}

#[cfg(test)]
mod tests {
    use super::Normal;

    #[test]
    fn they_are_normal_and_those_of_the_seed() {
        let mut n = Normal::new(7);
        let all: Vec<f64> = (0..100_000).map(|_| n.next()).collect();
        let moment = |k: i32| all.iter().map(|x| x.powi(k)).sum::<f64>() / all.len() as f64;
        assert!(moment(1).abs() < 0.01 && (moment(2) - 1.0).abs() < 0.02);
        assert!(moment(3).abs() < 0.05 && (moment(4) - 3.0).abs() < 0.1);
        assert_eq!(Normal::new(7).next().to_bits(), all[0].to_bits());
        assert_ne!(Normal::new(8).next(), all[0]);
    }
}

//! Random numbers: each parameter has a stream of its own, named by the parameter, so that neither the number
//! of threads nor another parameter changes what is drawn.

use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use sha2::{Digest, Sha256};

fn stream(seed: u64, purpose: &str, name: &str) -> ChaCha12Rng {
    let digest = Sha256::digest(format!("{purpose}\n{name}"));
    let number = digest.iter().take(8).fold(0u64, |n, b| n << 8 | u64::from(*b));
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    rng.set_stream(number);
    rng
}

/// Evenly distributed above 0 and below 1.
fn uniform(rng: &mut ChaCha12Rng) -> f64 {
    ((rng.next_u64() >> 11) as f64 + 0.5) / (1u64 << 53) as f64
}

/// Independent numbers above 0 and below 1.
pub(crate) fn independent(seed: u64, purpose: &str, name: &str, count: usize) -> Vec<f64> {
    let mut rng = stream(seed, purpose, name);
    (0..count).map(|_| uniform(&mut rng)).collect()
}

/// Numbers above 0 and below 1, one in each of `count` equal parts, in random order (McKay, Beckman and
/// Conover 1979).
pub(crate) fn stratified(seed: u64, name: &str, count: usize) -> Vec<f64> {
    let mut rng = stream(seed, "latin hypercube", name);
    let mut all: Vec<usize> = (0..count).collect();
    for i in (1..count).rev() {
        // The bias of a product is below 1e-15 for any study.
        let j = (uniform(&mut rng) * (i + 1) as f64) as usize;
        all.swap(i, j.min(i));
    }
    all.into_iter().map(|part| (part as f64 + uniform(&mut rng)) / count as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_latin_hypercube_has_one_number_in_each_part() {
        for count in [1, 2, 7, 1000] {
            let all = stratified(3, "mu", count);
            let mut parts: Vec<usize> =
                all.iter().map(|u| (u * count as f64).floor() as usize).collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..count).collect::<Vec<_>>());
        }
    }

    #[test]
    fn two_parameters_are_not_correlated_and_seeds_differ() {
        let (a, b) = (stratified(3, "mu", 4000), stratified(3, "height", 4000));
        let product: f64 = a.iter().zip(&b).map(|(x, y)| (x - 0.5) * (y - 0.5)).sum();
        assert!((12.0 * product / 4000.0).abs() < 0.05, "{product}");
        assert_ne!(independent(1, "a", "mu", 3), independent(2, "a", "mu", 3));
        assert_eq!(independent(1, "a", "mu", 2), independent(1, "a", "mu", 3)[..2]);
    }

    #[test]
    fn independent_numbers_have_the_moments_of_an_even_distribution() {
        let all = independent(1, "a", "mu", 100_000);
        let mean = all.iter().sum::<f64>() / 1e5;
        let square = all.iter().map(|x| (x - 0.5).powi(2)).sum::<f64>() / 1e5;
        assert!((mean - 0.5).abs() < 4e-3 && (12.0 * square - 1.0).abs() < 0.02);
    }

    #[test]
    fn the_numbers_are_those_of_every_version() {
        let all = independent(1, "ensemble", "mu", 2);
        assert_eq!(all, [0.9726905199204956, 0.1555251916683535]);
    }
}

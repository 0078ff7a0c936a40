//! Random structures, the same for the same seed.

mod block;
mod chain;
mod frame;
mod links;
mod motion;
mod outputs;

use super::rng::Rng;
use super::spec::Spec;

/// The structure of a seed. Structures that stand on nothing are made again from the next number.
#[must_use]
pub fn generate(seed: u64) -> Spec {
    let mut rng = Rng::new(seed);
    for _ in 0..50 {
        let spec = match rng.weighted(&[4.0, 2.5, 1.2, 1.3, 0.6]) {
            0 => chain::chain(&mut rng),
            1 => frame::plane(&mut rng),
            2 => frame::space(&mut rng),
            3 => block::block(&mut rng),
            _ => frame::long(&mut rng),
        };
        if let Some(spec) = motion::drive(spec, &mut rng) {
            return spec;
        }
    }
    chain::oscillator()
}

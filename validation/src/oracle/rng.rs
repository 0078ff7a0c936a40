//! Random numbers that are the same on every machine.

/// SplitMix64. [Steele, Lea & Flood 2014]
#[derive(Clone, Debug)]
pub struct Rng {
    state: u64,
    /// Structures may have links of all kinds. Those of smaller seeds are what they were.
    pub all_kinds: bool,
    /// Bodies may turn by finite angles.
    pub rocking: bool,
}

/// From this seed on.
const ALL_KINDS: u64 = 1_000_000;
/// The same.
const ROCKING: u64 = 3_000_000;

impl Rng {
    /// A stream of its own for every seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let state = seed.wrapping_mul(0xD134_2543_DE82_EF95) ^ 0x5851_F42D_4C95_7F2D;
        let mut it = Self { state, all_kinds: seed >= ALL_KINDS, rocking: seed >= ROCKING };
        it.next();
        it
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Evenly from `a` to `b`.
    pub fn even(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Evenly in the logarithm from `a` to `b`, both positive, to four figures.
    pub fn log(&mut self, a: f64, b: f64) -> f64 {
        figures(self.even(a.ln(), b.ln()).exp())
    }

    /// A whole number from `a` to `b`, both included.
    pub fn whole(&mut self, a: usize, b: usize) -> usize {
        a + (self.next() % (b - a + 1) as u64) as usize
    }

    /// True with this probability.
    pub fn chance(&mut self, p: f64) -> bool {
        self.even(0.0, 1.0) < p
    }

    /// One of these.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.whole(0, from.len() - 1)]
    }

    /// The place of a weight, drawn in proportion to the weights.
    pub fn weighted(&mut self, weights: &[f64]) -> usize {
        let mut x = self.even(0.0, weights.iter().sum());
        for (i, w) in weights.iter().enumerate() {
            if x < *w {
                return i;
            }
            x -= w;
        }
        weights.len() - 1
    }

    /// 1 or −1.
    pub fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }
}

/// A number to four figures: what is written is what is computed with.
#[must_use]
pub fn figures(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

//! What the structure answers within a step of one size.
//!
//! ```text
//!   X = U − 1 uₙ over the three stages, Ã = A⁻¹/h:   V = Ã X,   V̇ = Ã (V − 1 vₙ)
//!   (m Ã² + c Ã + k 1) X = P − 1 k uₙ + m Ã 1 vₙ − bᵀ F      for each coordinate
//! ```
//!
//! Rows without mass are algebraic or of first order and need nothing special: the rule ends in a stage.

use super::super::radau::{C64, Radau};
use super::coordinates::Coordinates;
use super::dense::dot;
use super::newton::Kept;

/// Three stages of values.
pub type Stage = [Vec<f64>; 3];

/// The response to a step of one size.
pub struct Response {
    /// Ã.
    pub tilde: [[f64; 3]; 3],
    /// Sums of its rows.
    pub ones: [f64; 3],
    /// (m Ã² + c Ã + k 1)⁻¹: stage over stage, each over coordinates.
    pub by: [[Vec<f64>; 3]; 3],
    /// Link deformations at the stages over link forces at the stages, by rows.
    pub links: Vec<f64>,
    /// Matrices of Newton's method that were of use with it, the last first.
    pub kept: Vec<Kept>,
}

impl Response {
    /// For a step size.
    #[must_use]
    pub fn new(rule: &Radau, at: &Coordinates, h: f64) -> Self {
        let tilde = [0, 1, 2].map(|i| [0, 1, 2].map(|j| rule.inverse[(i, j)] / h));
        let (x, y) = (rule.real / h, rule.complex / h);
        let n = at.len();
        let real: Vec<f64> =
            (0..n).map(|j| (at.m[j] * x * x + at.c[j] * x + at.k[j]).recip()).collect();
        let one = C64::new(1.0, 0.0);
        let complex: Vec<C64> =
            (0..n).map(|j| one / (y * y * at.m[j] + y * at.c[j] + at.k[j])).collect();
        let part = |i: usize, j: usize, a: f64, b: C64| {
            rule.to.0[i] * rule.from.0[j] * a + 2.0 * (rule.to.1[i] * rule.from.1[j] * b).re
        };
        let by = [0, 1, 2]
            .map(|i| [0, 1, 2].map(|j| (0..n).map(|c| part(i, j, real[c], complex[c])).collect()));
        let (re, im): (Vec<f64>, Vec<f64>) = complex.iter().map(|z| (z.re, z.im)).unzip();
        let l = at.links.ncols();
        let mut links = vec![0.0; 9 * l * l];
        let mut weighted = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
        for c in 0..l {
            let own = at.links.column(c);
            for j in 0..n {
                weighted[0][j] = own[j] * real[j];
                weighted[1][j] = own[j] * re[j];
                weighted[2][j] = own[j] * im[j];
            }
            for e in 0..=c {
                let other = &at.links.as_slice()[e * n..e * n + n];
                let [a, b, d] = [0, 1, 2].map(|k| dot(&weighted[k], other));
                for (i, j) in (0..9).map(|x| (x / 3, x % 3)) {
                    let value = part(i, j, a, C64::new(b, d));
                    links[(i * l + c) * 3 * l + j * l + e] = value;
                    links[(i * l + e) * 3 * l + j * l + c] = value;
                }
            }
        }
        let ones = tilde.map(|row| row.iter().sum());
        Self { tilde, ones, by, links, kept: Vec::new() }
    }

    /// Stages of all coordinates under loads at the stages, without links.
    #[must_use]
    pub fn alone(&self, at: &Coordinates, q: &[f64], r: &[f64], loads: &mut Stage) -> Stage {
        for (load, one) in loads.iter_mut().zip(self.ones) {
            for j in 0..q.len() {
                load[j] += at.m[j] * one * r[j] - at.own[j] * q[j];
            }
        }
        self.stages(loads)
    }

    /// Stages of all coordinates under forces on them.
    #[must_use]
    pub fn stages(&self, f: &Stage) -> Stage {
        self.by.each_ref().map(|by| {
            let all = by[0].iter().zip(&f[0]).zip(by[1].iter().zip(&f[1]));
            let all = all.zip(by[2].iter().zip(&f[2]));
            all.map(|(((a, x), (b, y)), (c, z))| a * x + b * y + c * z).collect()
        })
    }

    /// Rates of stages.
    #[must_use]
    pub fn rate(&self, stage: usize, x: &Stage) -> Vec<f64> {
        let [a, b, c] = self.tilde[stage];
        (0..x[0].len()).map(|j| a * x[0][j] + b * x[1][j] + c * x[2][j]).collect()
    }
}

//! Wen's law in a plane over a straight step, in closed form.
//!
//! ```text
//!   dz/du = ω − z Σⱼ aⱼ ωⱼ zⱼ,   0 ≤ u ≤ 1,   aⱼ = 1 where ωⱼ zⱼ > 0, else 0;     ωⱼ = kⱼ Δdⱼ/f_yⱼ
//! ```
//!
//! While the aⱼ hold, z = p/q with p' = ω q and q' = b·p, bⱼ = aⱼ ωⱼ: a linear system with
//! q'' = λ² q, λ² = Σ aⱼ ωⱼ². A component that unloads goes to zero and loads from there on, so a step has three
//! pieces at most, and the end of each is the root of a quadratic equation in e^(λu). |z| ≤ 1 is kept by the
//! equation itself.

use crate::shared::dual::Dual;

/// What became of z, with derivatives by ω.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moved {
    pub(crate) z: [Dual; 2],
    /// ∫ zᵢ (ωᵢ − zᵢ') du, none negative.
    pub(crate) loss: [Dual; 2],
}

/// A piece of a step with constant aⱼ.
struct Piece {
    omega: [Dual; 2],
    z: [Dual; 2],
    loading: [bool; 2],
    lambda: Dual,
    /// b·z at its start.
    beta: Dual,
}

const ZERO: Dual = Dual { x: 0.0, by: [0.0; 2] };

impl Piece {
    fn new(omega: [Dual; 2], z: [Dual; 2]) -> Self {
        let loading =
            [0, 1].map(|j| omega[j].x * z[j].x > 0.0 || (z[j].x == 0.0 && omega[j].x != 0.0));
        let active = |j: usize| if loading[j] { omega[j] } else { ZERO };
        let beta = active(0) * z[0] + active(1) * z[1];
        let lambda = match loading {
            [true, true] => (omega[0] * omega[0] + omega[1] * omega[1]).sqrt(),
            [true, false] => omega[0] * omega[0].x.signum(),
            [false, true] => omega[1] * omega[1].x.signum(),
            [false, false] => ZERO,
        };
        Self { omega, z, loading, lambda, beta }
    }

    /// z after a length `u`.
    fn at(&self, u: Dual) -> [Dual; 2] {
        let (l, o) = (self.lambda, self.omega);
        if l.x == 0.0 {
            return [0, 1].map(|i| self.z[i] + o[i] * u);
        }
        // Both p and q over e^(λu), so that nothing overflows.
        let fall = (-(l * u)).exp_m1();
        let (once, share) = (fall + 1.0, self.beta / l);
        let twice = -((l * u * -2.0).exp_m1());
        let q = (-twice + 2.0 + share * twice) * 0.5;
        let grown = (twice + share * fall * fall) * 0.5 / l;
        [0, 1].map(|i| (self.z[i] * once + o[i] * grown) / q)
    }

    /// Where component `j`, which unloads, comes to zero.
    fn zero(&self, j: usize) -> Option<Dual> {
        if self.loading[j] || self.omega[j].x == 0.0 {
            return None;
        }
        let straight = -(self.z[j] / self.omega[j]);
        if self.lambda.x == 0.0 {
            return Some(straight);
        }
        let (c, share) = (straight * self.lambda, self.beta / self.lambda);
        let s = c * (share * 2.0 + c);
        let root = s / ((s + 1.0).sqrt() + 1.0);
        Some(((c + root) / (share + 1.0)).ln_1p() / self.lambda)
    }

    /// ∫ zᵢ² (b·z) du over a length, by Gauss's rule on parts in which z changes little enough.
    fn loss(&self, length: Dual) -> [Dual; 2] {
        const NODES: [(f64, f64); 4] = [
            (0.183_434_642_495_649_8, 0.362_683_783_378_362),
            (0.525_532_409_916_329, 0.313_706_645_877_887_3),
            (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
            (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
        ];
        let mut sum = [ZERO; 2];
        if self.lambda.x == 0.0 {
            return sum;
        }
        let b = [0, 1].map(|j| if self.loading[j] { self.omega[j] } else { ZERO });
        let parts = (0.5 * self.lambda.x * length.x).ceil().clamp(1.0, 20.0);
        // Beyond 20 parts z has come to rest: the last takes all that is left.
        let part = if parts < 20.0 {
            length * (1.0 / parts)
        } else {
            self.lambda.map(2.0 / self.lambda.x, -2.0 / self.lambda.x.powi(2))
        };
        let mut from = ZERO;
        for i in 1..=parts as usize {
            let to = if i == parts as usize { length } else { from + part };
            let (middle, half) = ((from + to) * 0.5, (to - from) * 0.5);
            for (x, weight) in NODES {
                for x in [-x, x] {
                    let z = self.at(middle + half * x);
                    let rate = (b[0] * z[0] + b[1] * z[1]) * half * weight;
                    sum = [0, 1].map(|i| sum[i] + z[i] * z[i] * rate);
                }
            }
            from = to;
        }
        sum
    }
}

/// z after a step; `rate` has the signs of the motion where ω is zero.
pub(crate) fn advance(z: [f64; 2], omega: [f64; 2], rate: [f64; 2]) -> Moved {
    if omega == [0.0; 2] {
        let loads = |j: usize| if rate[j] * z[j] > 0.0 { z[j] } else { 0.0 };
        let slope = |i: usize, j: usize| f64::from(i == j) - z[i] * loads(j);
        let at = |i: usize| Dual { x: z[i], by: [slope(i, 0), slope(i, 1)] };
        return Moved { z: [at(0), at(1)], loss: [ZERO; 2] };
    }
    let omega = [0, 1].map(|j| Dual::variable(omega[j], j));
    let mut z = z.map(Dual::constant);
    let (mut left, mut loss) = (Dual::constant(1.0), [ZERO; 2]);
    // Each component comes to zero once at most.
    for _ in 0..3 {
        let piece = Piece::new(omega, z);
        let zeros = [0, 1].map(|j| piece.zero(j).filter(|u| u.x < left.x));
        let first = match zeros {
            [Some(a), Some(b)] if b.x < a.x => Some((1, b)),
            [Some(a), _] => Some((0, a)),
            [None, Some(b)] => Some((1, b)),
            [None, None] => None,
        };
        let length = first.map_or(left, |(_, u)| u);
        let lost = piece.loss(length);
        loss = [0, 1].map(|i| loss[i] + lost[i]);
        z = piece.at(length);
        let Some((j, u)) = first else { break };
        z[j] = ZERO;
        left = left - u;
    }
    // Rounding only: the equation keeps |z| ≤ 1.
    let size = z[0].x.hypot(z[1].x).max(1.0);
    z.iter_mut().for_each(|z| z.x /= size);
    Moved { z, loss }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// z and loss by Runge-Kutta's method.
    fn integrated(z0: [f64; 2], omega: [f64; 2], steps: u32) -> [f64; 4] {
        let rate = |s: [f64; 4]| {
            let b = [0, 1].map(|j| (omega[j] * s[j]).max(0.0)).iter().sum::<f64>();
            [omega[0] - s[0] * b, omega[1] - s[1] * b, s[0] * s[0] * b, s[1] * s[1] * b]
        };
        let h = 1.0 / f64::from(steps);
        let mut s = [z0[0], z0[1], 0.0, 0.0];
        let moved = |s: [f64; 4], r: [f64; 4], h: f64| [0, 1, 2, 3].map(|i| s[i] + h * r[i]);
        for _ in 0..steps {
            let a = rate(s);
            let b = rate(moved(s, a, 0.5 * h));
            let c = rate(moved(s, b, 0.5 * h));
            let d = rate(moved(s, c, h));
            s = [0, 1, 2, 3].map(|i| s[i] + h * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0);
        }
        s
    }

    const STARTS: [[f64; 2]; 6] =
        [[0.0, 0.0], [0.5, -0.3], [-0.9, -0.4], [0.6, 0.8], [0.0, -1.0], [1e-9, 0.7]];
    const STEPS: [[f64; 2]; 8] = [
        [0.3, 0.2],
        [2.0, -3.0],
        [0.0, 1.5],
        [-1.0, 0.0],
        [1e-7, 1.0],
        [-8.0, 5.0],
        [1e-5, -1e-6],
        [0.9, 0.9],
    ];

    #[test]
    fn follows_the_differential_equation() {
        for z0 in STARTS {
            for omega in STEPS {
                let moved = advance(z0, omega, omega);
                let s = integrated(z0, omega, 20_000);
                for i in 0..2 {
                    assert_relative_eq!(moved.z[i].x, s[i], epsilon = 1e-7);
                    assert_relative_eq!(moved.loss[i].x, s[2 + i], epsilon = 1e-7);
                }
            }
        }
    }

    #[test]
    fn two_halves_of_a_step_are_the_step() {
        for z0 in STARTS {
            for omega in STEPS {
                let whole = advance(z0, omega, omega);
                let half = omega.map(|w| 0.5 * w);
                let one = advance(z0, half, omega);
                let two = advance(one.z.map(|z| z.x), half, omega);
                for i in 0..2 {
                    assert_relative_eq!(whole.z[i].x, two.z[i].x, epsilon = 1e-13);
                    let loss = one.loss[i].x + two.loss[i].x;
                    assert_relative_eq!(whole.loss[i].x, loss, epsilon = 1e-7);
                }
            }
        }
    }

    #[test]
    fn stays_within_one_for_any_step() {
        for z0 in STARTS {
            for size in [1e-300, 1e-12, 1.0, 1e3, 1e12] {
                for omega in STEPS {
                    let omega = omega.map(|w| w * size);
                    let moved = advance(z0, omega, omega);
                    assert!(moved.z[0].x.hypot(moved.z[1].x) <= 1.0 + 1e-15);
                    let finite = |d: Dual| d.x.is_finite() && d.by.iter().all(|x| x.is_finite());
                    assert!(
                        moved.z.iter().chain(&moved.loss).all(|d| finite(*d)),
                        "{z0:?} {omega:?}"
                    );
                    assert!(moved.loss.iter().all(|l| l.x >= 0.0));
                }
            }
        }
    }
}

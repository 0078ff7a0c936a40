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

use crate::shared::dual::{Dual, by_fewer};
use trilith_element::lanes::Real;

/// A number with its derivatives by ω.
type Two<R> = Dual<2, R>;

/// What became of z, with derivatives by ω; those of the loss as many as are wanted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moved<const N: usize, R = f64> {
    pub(crate) z: [Dual<2, R>; 2],
    /// ∫ zᵢ (ωᵢ − zᵢ') du, none negative.
    pub(crate) loss: [Dual<N, R>; 2],
}

/// A piece of a step with constant aⱼ.
struct Piece<const N: usize, R: Real> {
    omega: [Dual<N, R>; 2],
    z: [Dual<N, R>; 2],
    loading: [R::Mask; 2],
    lambda: Dual<N, R>,
    /// b·z at its start.
    beta: Dual<N, R>,
}

/// Nodes and weights of Gauss's rule with eight points, one half of them.
const NODES: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Most parts of a piece.
const PARTS: i32 = 20;

impl<R: Real> Piece<2, R> {
    #[inline(always)]
    fn new(omega: [Two<R>; 2], z: [Two<R>; 2]) -> Self {
        let zero = z[0].x.of(0.0);
        let mut loading = [zero.lt(zero); 2];
        for j in 0..2 {
            let starts = z[j].x.abs().le(zero) & zero.lt(omega[j].x.abs());
            loading[j] = zero.lt(omega[j].x * z[j].x) | starts;
        }
        let beta = omega[0].only(loading[0]) * z[0] + omega[1].only(loading[1]) * z[1];
        let both = (omega[0] * omega[0] + omega[1] * omega[1]).sqrt();
        let one = Real::abs(Two::select(loading[0], omega[0], omega[1]));
        let lambda = Two::select(loading[0] & loading[1], both, one.only(loading[0] | loading[1]));
        Self { omega, z, loading, lambda, beta }
    }

    /// Where component `j`, which unloads, comes to zero: beyond all steps where it does not.
    #[inline(always)]
    fn zero(&self, j: usize) -> Two<R> {
        let beyond = Two::constant(self.lambda.x.of(f64::INFINITY));
        let nought = self.lambda.x.of(0.0);
        let unloads = !self.loading[j] & nought.lt(self.omega[j].x.abs());
        if !nought.any(unloads) {
            return beyond;
        }
        let (one, two) = (nought.of(1.0), nought.of(2.0));
        let mut at = -(self.z[j] / self.omega[j]);
        let bent = unloads & nought.lt(self.lambda.x);
        if nought.any(bent) {
            let (c, share) = (at * self.lambda, self.beta / self.lambda);
            let s = c * (share * two + c);
            let root = s / ((s + one).sqrt() + one);
            let curved = ((c + root) / (share + one)).ln_1p() / self.lambda;
            at = Two::select(bent, curved, at);
        }
        Two::select(unloads, at, beyond)
    }

    /// The same with fewer derivatives.
    #[inline(always)]
    fn by_fewer<const N: usize>(&self) -> Piece<N, R> {
        Piece {
            omega: [by_fewer(self.omega[0]), by_fewer(self.omega[1])],
            z: [by_fewer(self.z[0]), by_fewer(self.z[1])],
            loading: self.loading,
            lambda: by_fewer(self.lambda),
            beta: by_fewer(self.beta),
        }
    }
}

impl<const N: usize, R: Real> Piece<N, R> {
    /// z after a length `u`.
    #[inline(always)]
    fn at(&self, u: Dual<N, R>) -> [Dual<N, R>; 2] {
        let (l, o) = (self.lambda, self.omega);
        let nought = u.x.of(0.0);
        let bent = nought.lt(l.x.abs());
        let mut z = [self.z[0] + o[0] * u, self.z[1] + o[1] * u];
        if nought.any(bent) {
            // Both p and q over e^(λu), so that nothing overflows.
            let (half, one, two) = (u.x.of(0.5), u.x.of(1.0), u.x.of(2.0));
            let fall = (-(l * u)).exp_and_m1()[1];
            let (once, share) = (fall + one, self.beta / l);
            let twice = -((l * u * -two).exp_and_m1()[1]);
            let q = (-twice + two + share * twice) * half;
            let grown = (twice + share * fall * fall) * half / l;
            for i in 0..2 {
                z[i] = Dual::select(bent, (self.z[i] * once + o[i] * grown) / q, z[i]);
            }
        }
        z
    }

    /// ∫ zᵢ² (b·z) du over a length, by Gauss's rule on parts in which z changes little enough.
    #[inline(always)]
    fn loss(&self, length: Dual<N, R>) -> [Dual<N, R>; 2] {
        let (nought, half) = (length.x.of(0.0), length.x.of(0.5));
        let nothing = Dual::constant(nought);
        let mut sum = [nothing; 2];
        let bent = nought.lt(self.lambda.x.abs());
        if !nought.any(bent) {
            return sum;
        }
        let b = [self.omega[0].only(self.loading[0]), self.omega[1].only(self.loading[1])];
        // So many parts as there are whole numbers below this, and one.
        let wanted = half * self.lambda.x * length.x;
        let mut parts = nought.of(1.0);
        for i in 1..PARTS {
            let more = nought.of(f64::from(i)).lt(wanted);
            if !nought.any(more) {
                break;
            }
            parts = R::select(more, nought.of(f64::from(i + 1)), parts);
        }
        let many = nought.of(f64::from(PARTS)).le(parts);
        // Beyond 20 parts z has come to rest: the last takes all that is left.
        let l = self.lambda.x;
        let equal = length * (nought.of(1.0) / parts);
        let long = self.lambda.map(nought.of(2.0) / l, -nought.of(2.0) / (l * l));
        let part = Dual::select(many, long, equal);
        let mut from = nothing;
        for i in 1..=PARTS {
            let goes_on = bent & nought.of(f64::from(i)).le(parts);
            if !nought.any(goes_on) {
                break;
            }
            let last = parts.le(nought.of(f64::from(i)));
            let to = Dual::select(last, length, from + part);
            let (middle, half) = ((from + to) * half, (to - from) * half);
            for (x, weight) in NODES {
                for x in [-x, x] {
                    let z = self.at(middle + half * nought.of(x));
                    let rate = (b[0] * z[0] + b[1] * z[1]) * half * nought.of(weight);
                    for i in 0..2 {
                        sum[i] = Dual::select(goes_on, sum[i] + z[i] * z[i] * rate, sum[i]);
                    }
                }
            }
            from = to;
        }
        sum
    }
}

/// z after a step; `rate` has the signs of the motion where ω is zero.
#[inline(always)]
pub(crate) fn advance<const N: usize, R: Real>(
    z: [R; 2],
    omega: [R; 2],
    rate: [R; 2],
) -> Moved<N, R> {
    let (nought, one) = (z[0].of(0.0), z[0].of(1.0));
    let moves = nought.lt(omega[0].abs()) | nought.lt(omega[1].abs());
    let nothing = Dual::constant(nought);
    let mut still = [Two::constant(z[0]), Two::constant(z[1])];
    for j in 0..2 {
        let loads = z[j].only(nought.lt(rate[j] * z[j]));
        for i in 0..2 {
            still[i].by[j] = nought.of(f64::from(u8::from(i == j))) - z[i] * loads;
        }
    }
    let mut loss = [nothing; 2];
    if !nought.any(moves) {
        return Moved { z: still, loss };
    }
    let omega = [Two::variable(omega[0], 0), Two::variable(omega[1], 1)];
    let mut z = [Two::constant(z[0]), Two::constant(z[1])];
    let mut left = Two::constant(one);
    let mut goes_on = moves;
    // Each component comes to zero once at most.
    for _ in 0..3 {
        let piece = Piece::new(omega, z);
        let zeros = [piece.zero(0), piece.zero(1)];
        let second = zeros[1].x.lt(zeros[0].x);
        let first = Two::select(second, zeros[1], zeros[0]);
        let cut = first.x.lt(left.x);
        let length = Two::select(cut, first, left);
        let lost = piece.by_fewer::<N>().loss(by_fewer(length));
        let next = piece.at(length);
        for i in 0..2 {
            loss[i] = Dual::select(goes_on, loss[i] + lost[i], loss[i]);
            let own = if i == 0 { !second } else { second };
            z[i] = Two::select(goes_on, next[i].only(!(cut & own)), z[i]);
        }
        goes_on = goes_on & cut;
        if !nought.any(goes_on) {
            break;
        }
        left = left - first;
    }
    // Rounding only: the equation keeps |z| ≤ 1, and its derivatives are those without.
    if nought.any(one.lt(z[0].x * z[0].x + z[1].x * z[1].x + one.of(1e-15))) {
        let size = z[0].x.map2(z[1].x, f64::hypot).max(one).fixed();
        for z in &mut z {
            z.x = z.x / size;
        }
    }
    Moved { z: [Two::select(moves, z[0], still[0]), Two::select(moves, z[1], still[1])], loss }
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
                let moved = advance::<2, f64>(z0, omega, omega);
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
                let whole = advance::<0, f64>(z0, omega, omega);
                let half = omega.map(|w| 0.5 * w);
                let one = advance::<0, f64>(z0, half, omega);
                let two = advance::<0, f64>(one.z.map(|z| z.x), half, omega);
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
                    let moved = advance::<2, f64>(z0, omega, omega);
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

//! The variable z of Wen's law over a straight step, for any exponent n ≥ 1, without sub-steps.
//!
//! ```text
//!   dz/du = 1 − |z|ⁿ   loading (z du > 0),   1   unloading;      u = k d/fy
//! ```
//!
//! Loading from 0 is u = S₁(z) and the work of z is ∫ z du = S₂(z), with
//!
//! ```text
//!   Sₘ(z) = ∫₀ᶻ sᵐ⁻¹/(1 − sⁿ) ds = Σₖ z^(m+kn)/(m + kn)
//! ```
//!
//! For zⁿ ≥ ½ that series is exchanged for the one about z = 1 of 2F1(1, m/n; 1 + m/n; zⁿ)
//! (Abramowitz & Stegun, 15.3.10), in q = −ln(1 − zⁿ). S₁ is convex in z and concave in q, with slopes that
//! change by a factor of two at most on either side, so Newton's method started on the right side
//! comes down on the root in a few steps and cannot pass it.

/// What became of z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transition {
    /// z at the end.
    pub(super) z: f64,
    /// dz/du at the end.
    pub(super) slope: f64,
    /// ∫ z (du − dz), never negative.
    pub(super) loss: f64,
}

/// z after a step `u`; `rate` has the sign of the motion where `u` is zero.
pub(super) fn advance(z0: f64, u: f64, rate: f64, n: f64) -> Transition {
    let sign = if u == 0.0 { rate } else { u };
    let (start, length) = (z0 * 1.0_f64.copysign(sign), u.abs());
    if sign == 0.0 || start + length < 0.0 {
        return Transition { z: z0 + u, slope: 1.0, loss: 0.0 };
    }
    // What is left of the step after unloading.
    let (start, length) = (start.max(0.0), length + start.min(0.0));
    let (end, work) = match n {
        1.0 => first(start, length),
        2.0 => second(start, length),
        _ => general(start, length, n),
    };
    let end = end.clamp(start, 1.0);
    let power = end.powf(n);
    // Far below yield almost all work is stored: the difference of the two would be nothing but rounding.
    let loss = if power < EARLY {
        early(end, power, n) - early(start, start.powf(n), n)
    } else {
        work - 0.5 * (end - start) * (end + start)
    };
    Transition { z: end.copysign(sign), slope: 1.0 - power, loss: loss.max(0.0) }
}

/// zⁿ below which the loss has a series of its own.
const EARLY: f64 = 0.1;

/// ∫₀ᶻ s (1/(1 − sⁿ) − 1) ds = z² Σₖ₌₁ zᵏⁿ/(2 + kn), with y = zⁿ.
fn early(z: f64, y: f64, n: f64) -> f64 {
    let (mut power, mut sum) = (y, 0.0);
    for k in 1..20 {
        let term = power / (2.0 + f64::from(k) * n);
        sum += term;
        if term <= 1e-17 * sum {
            break;
        }
        power *= y;
    }
    z * z * sum
}

/// n = 1: z = 1 − (1 − z₀) e⁻ᵘ; end and ∫ z du.
fn first(z: f64, u: f64) -> (f64, f64) {
    let rise = -(1.0 - z) * (-u).exp_m1();
    (z + rise, u - rise)
}

/// n = 2: z = tanh(artanh z₀ + u).
fn second(z: f64, u: f64) -> (f64, f64) {
    let t = u.tanh();
    let mean = 0.5 * ((1.0 + z) + (1.0 - z) * (-2.0 * u).exp());
    ((z + t) / (1.0 + z * t), u + mean.ln())
}

fn general(z0: f64, u: f64, n: f64) -> (f64, f64) {
    if u == 0.0 || z0 >= 1.0 {
        return (z0, u * z0);
    }
    let curve = Curve::new(n);
    let z = curve.loaded(z0, u);
    (z, u + curve.work(z) - curve.work(z0))
}

/// S₁ and S₂ of one exponent.
struct Curve {
    n: f64,
    /// z where zⁿ = ½: below it series in z, above it series in 1 − zⁿ.
    middle: f64,
    /// S₁ there.
    reach: f64,
}

impl Curve {
    fn new(n: f64) -> Self {
        let middle = 0.5_f64.powf(1.0 / n);
        Self { n, middle, reach: below(middle, 1.0, n) }
    }

    /// z at the end of a loading step `u` from 0 ≤ z₀ < 1.
    fn loaded(&self, z0: f64, u: f64) -> f64 {
        let n = self.n;
        let low = z0 < self.middle;
        let start = if low { below(z0, 1.0, n) } else { 0.0 };
        if low && start + u <= self.reach {
            // Convex: from the right.
            let mut z = (z0 + u).min(self.middle);
            for _ in 0..30 {
                let change = (below(z, 1.0, n) - start - u) * (1.0 - z.powf(n));
                z -= change;
                if change.abs() <= 1e-15 * z {
                    break;
                }
            }
            return z;
        }
        // Concave in q: from the left. `base` is S₁ there, counted from the middle.
        let half = std::f64::consts::LN_2;
        let (mut q, target) = if low {
            (half, start + u - self.reach)
        } else {
            // z so near 1 that zⁿ is 1 to the last digit stays there.
            let q = -(-(n * z0.ln()).exp_m1()).ln();
            (q.clamp(half, 40.0), u + self.above(q.clamp(half, 40.0), 1.0))
        };
        for _ in 0..30 {
            let y = -(-q).exp_m1();
            let change = (target - self.above(q, 1.0)) * n * y.powf(1.0 - 1.0 / n);
            q += change;
            if change.abs() <= 1e-15 * q {
                break;
            }
        }
        (-(-q).exp_m1()).powf(1.0 / n)
    }

    /// Sₘ at q, less its value in the middle.
    fn above(&self, q: f64, m: f64) -> f64 {
        let half = std::f64::consts::LN_2;
        (q - half) / self.n + self.bend(q, m) - self.bend(half, m)
    }

    /// The part of Sₘ at q without its logarithm and constant.
    fn bend(&self, q: f64, m: f64) -> f64 {
        let (x, b) = ((-q).exp(), m / self.n);
        let (mut power, mut harmonic, mut sum) = (1.0, 0.0, 0.0);
        for k in 0..70 {
            let k = f64::from(k);
            power *= (b + k) / (k + 1.0) * x;
            harmonic += 1.0 / (k + 1.0) - 1.0 / (b + k);
            let term = power * harmonic;
            sum += term;
            if term.abs() <= 1e-17 * sum.abs() {
                break;
            }
        }
        (-(-q).exp_m1()).powf(b) * sum / self.n
    }

    /// S₂ − S₁, which stays finite at z = 1.
    fn work(&self, z: f64) -> f64 {
        let n = self.n;
        if z < self.middle {
            return below(z, 2.0, n) - below(z, 1.0, n);
        }
        let q = (-(-(n * z.ln()).exp_m1()).ln()).min(745.0);
        let half = std::f64::consts::LN_2;
        let bends = |q| self.bend(q, 2.0) - self.bend(q, 1.0);
        below(self.middle, 2.0, n) - self.reach + bends(q) - bends(half)
    }
}

/// Sₘ for zⁿ ≤ ½ by its power series.
fn below(z: f64, m: f64, n: f64) -> f64 {
    let y = z.powf(n);
    let (mut power, mut sum) = (1.0, 0.0);
    for k in 0..60 {
        let term = power / (m + f64::from(k) * n);
        sum += term;
        if term <= 1e-17 * sum {
            break;
        }
        power *= y;
    }
    z.powf(m) * sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Far below yield the loss is that of the first term, z^(n+2)/(n + 2), not the rounding of the work.
    #[test]
    fn the_loss_far_below_yield_is_no_rounding() {
        for n in [1.0, 1.5, 2.0, 5.0] {
            let mut z = 0.0;
            let mut sum = 0.0;
            for _ in 0..100 {
                let t = advance(z, 1e-6, 1.0, n);
                (z, sum) = (t.z, sum + t.loss);
            }
            assert_relative_eq!(sum, 1e-4_f64.powf(n + 2.0) / (n + 2.0), max_relative = 2e-4);
        }
        // Where the series ends both forms agree.
        for n in [1.0, 2.0, 3.5] {
            let z = EARLY.powf(1.0 / n);
            let [a, b] = [-1e-9, 1e-9].map(|d| {
                let start = z * (1.0 + d) - 0.05;
                advance(start, 0.05, 1.0, n).loss
            });
            assert_relative_eq!(a, b, max_relative = 1e-6);
        }
    }

    /// z and ∫ z du by Runge-Kutta's method.
    fn integrated(z0: f64, u: f64, n: f64) -> (f64, f64) {
        let steps = 20_000;
        let h = u / f64::from(steps);
        let rate = |z: f64| if z * u > 0.0 { 1.0 - z.abs().powf(n) } else { 1.0 };
        let (mut z, mut work) = (z0, 0.0);
        for _ in 0..steps {
            let a = rate(z);
            let b = rate(z + 0.5 * h * a);
            let c = rate(z + 0.5 * h * b);
            let d = rate(z + h * c);
            let next = z + h * (a + 2.0 * b + 2.0 * c + d) / 6.0;
            let middle = z + 0.5 * h * b;
            work += h * (z + 4.0 * middle + next) / 6.0;
            z = next;
        }
        (z, work)
    }

    #[test]
    fn z_and_its_work_are_those_of_the_differential_equation() {
        for n in [1.0, 1.2, 2.0, 3.0, 7.5, 20.0, 100.0] {
            for z0 in [-1.0, -0.6, 0.0, 0.3, 0.7, 0.95, 0.999_9] {
                for u in [1e-6, 0.05, 0.4, 0.97, 2.0, 8.0] {
                    let t = advance(z0, u, 0.0, n);
                    let (z, work) = integrated(z0, u, n);
                    assert_relative_eq!(t.z, z, epsilon = 2e-8);
                    let loss = work - 0.5 * (z * z - z0 * z0);
                    assert_relative_eq!(t.loss, loss, epsilon = 2e-8);
                    let mirrored = advance(-z0, -u, 0.0, n);
                    assert_eq!((mirrored.z, mirrored.loss), (-t.z, t.loss));
                }
            }
        }
    }

    #[test]
    fn exponents_that_have_a_closed_form_agree_with_the_series() {
        for z in [0.0, 0.2, 0.49, 0.51, 0.9, 0.999] {
            for u in [1e-9, 0.1, 0.5, 1.0, 5.0, 60.0] {
                let (one, two) = (first(z, u), second(z, u));
                for (closed, series) in [(one, general(z, u, 1.0)), (two, general(z, u, 2.0))] {
                    assert_relative_eq!(closed.0, series.0, max_relative = 1e-13);
                    assert_relative_eq!(closed.1, series.1, max_relative = 1e-10, epsilon = 1e-14);
                }
            }
        }
    }

    #[test]
    fn never_passes_one_and_never_fails() {
        for n in [1.0, 1.5, 2.0, 33.0, 1000.0] {
            for u in [1e-300, 1e-12, 1.0, 1e3, 1e12] {
                for z0 in [-1.0, 0.0, 0.5, 1.0 - 1e-16, 1.0] {
                    let t = advance(z0, u, 0.0, n);
                    assert!(t.z.abs() <= 1.0 && t.z >= z0 && t.slope >= 0.0 && t.loss >= 0.0);
                    assert!(t.loss.is_finite());
                }
            }
        }
    }
}

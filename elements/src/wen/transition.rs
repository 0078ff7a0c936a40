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

use std::f64::consts::LN_2;
use trilith_element::lanes::Real;

/// What became of z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transition<R> {
    /// z at the end.
    pub(super) z: R,
    /// dz/du at the end.
    pub(super) slope: R,
    /// ∫ z (du − dz), never negative.
    pub(super) loss: R,
}

/// Exponents that have a closed form of their own.
pub(super) const ONE: u8 = 1;
pub(super) const TWO: u8 = 2;
/// All others, by series.
pub(super) const ANY: u8 = 0;

/// Which of them an exponent is.
pub(super) fn closed_form(n: f64) -> u8 {
    match n {
        1.0 => ONE,
        2.0 => TWO,
        _ => ANY,
    }
}

/// How many numbers an exponent is.
pub(super) const NUMBERS: usize = 3;

/// The numbers of an exponent n: n, and where it goes by [series](Curve) those of its curve.
pub(super) fn numbers(n: f64) -> [f64; NUMBERS] {
    if closed_form(n) != ANY {
        return [n, 0.0, 0.0];
    }
    by_series(n)
}

fn by_series(n: f64) -> [f64; NUMBERS] {
    let middle = 0.5_f64.powf(1.0 / n);
    [n, middle, below(middle, 1.0, n)]
}

/// z after a step `u`; `rate` has the sign of the motion where `u` is zero. `FORM` is that of the exponent.
#[inline(always)]
pub(super) fn advance<const FORM: u8, R: Real>(
    z0: R,
    u: R,
    rate: R,
    exponent: &[R],
) -> Transition<R> {
    let (zero, half, one) = (u.of(0.0), u.of(0.5), u.of(1.0));
    let n = exponent[0];
    let sign = R::select(u.abs().le(zero), rate, u);
    let back = sign.lt(zero);
    let start = R::select(back, -z0, z0);
    let length = u.abs();
    let free = sign.abs().le(zero) | (start + length).lt(zero);
    let mut it = Transition { z: z0 + u, slope: one, loss: zero };
    let loads = !free;
    if !zero.any(loads) {
        return it;
    }
    // What is left of the step after unloading.
    let (start, length) = (start.max(zero), (length + start.min(zero)).only(loads));
    let [end, work] = match FORM {
        ONE => first(start, length),
        TWO => second(start, length),
        _ => general(start, length, exponent),
    };
    let end = end.max(start).min(one);
    let power = end.powf(n);
    let mut loss = work - half * (end - start) * (end + start);
    // Far below yield almost all work is stored: the difference of the two would be nothing but rounding.
    let begins = power.lt(zero.of(EARLY));
    if zero.any(begins & loads) {
        let early = early(end, power, n) - early(start, start.powf(n), n);
        loss = R::select(begins, early, loss);
    }
    it.z = R::select(loads, R::select(back, -end, end), it.z);
    it.slope = R::select(loads, one - power, it.slope);
    it.loss = loss.max(zero).only(loads);
    it
}

/// zⁿ below which the loss has a series of its own.
const EARLY: f64 = 0.1;
/// What adds nothing to a sum.
const NOTHING: f64 = 1e-17;

/// ∫₀ᶻ s (1/(1 − sⁿ) − 1) ds = z² Σₖ₌₁ zᵏⁿ/(2 + kn), with y = zⁿ.
#[inline(always)]
fn early<R: Real>(z: R, y: R, n: R) -> R {
    let (mut power, mut sum) = (y, z.of(0.0));
    let mut goes_on = y.lt(z.of(0.5));
    for k in 1..20 {
        let term = power / (z.of(2.0) + z.of(f64::from(k)) * n);
        sum = R::select(goes_on, sum + term, sum);
        goes_on = goes_on & (z.of(NOTHING) * sum).lt(term);
        if !z.any(goes_on) {
            break;
        }
        power = power * y;
    }
    z * z * sum
}

/// n = 1: z = 1 − (1 − z₀) e⁻ᵘ; end and ∫ z du.
#[inline(always)]
fn first<R: Real>(z: R, u: R) -> [R; 2] {
    let rise = -(z.of(1.0) - z) * (-u).exp_and_m1()[1];
    [z + rise, u - rise]
}

/// n = 2: z = tanh(artanh z₀ + u).
#[inline(always)]
fn second<R: Real>(z: R, u: R) -> [R; 2] {
    let one = z.of(1.0);
    let t = u.tanh();
    let mean = z.of(0.5) * ((one + z) + (one - z) * (z.of(-2.0) * u).exp_by_vectors());
    [(z + t) / (one + z * t), u + mean.ln()]
}

#[inline(always)]
fn general<R: Real>(z0: R, u: R, exponent: &[R]) -> [R; 2] {
    let (zero, one) = (u.of(0.0), u.of(1.0));
    let moves = zero.lt(u) & z0.lt(one);
    if !zero.any(moves) {
        return [z0, u * z0];
    }
    let curve = Curve { n: exponent[0], middle: exponent[1], reach: exponent[2] };
    let z = R::select(moves, curve.loaded(z0, u, moves), z0);
    // One after the other in a loop: the same text twice would take twice as long to compile.
    let (mut at, mut both) = (z, [zero; 2]);
    for it in &mut both {
        *it = curve.work(at);
        at = z0;
    }
    [z, R::select(moves, u + both[0] - both[1], u * z0)]
}

/// S₁ and S₂ of one exponent.
struct Curve<R> {
    n: R,
    /// z where zⁿ = ½: below it series in z, above it series in 1 − zⁿ.
    middle: R,
    /// S₁ there.
    reach: R,
}

impl<R: Real> Curve<R> {
    /// z at the end of a loading step `u` from 0 ≤ z₀ < 1.
    #[inline(always)]
    fn loaded(&self, z0: R, u: R, moves: R::Mask) -> R {
        let n = self.n;
        let (zero, one, rounding) = (n.of(0.0), n.of(1.0), n.of(1e-15));
        let low = z0.lt(self.middle);
        let start = below(z0.min(self.middle), one, n).only(low);
        let inner = low & (start + u).le(self.reach);
        // Convex: from the right.
        let mut z = (z0 + u).min(self.middle);
        let mut goes_on = inner & moves;
        for _ in 0..30 {
            if !zero.any(goes_on) {
                break;
            }
            let change = (below(z, one, n) - start - u) * (one - z.powf(n));
            z = R::select(goes_on, z - change, z);
            goes_on = goes_on & (rounding * z).lt(change.abs());
        }
        let mut goes_on = moves & !inner;
        if !zero.any(goes_on) {
            return z;
        }
        // Concave in q: from the left, S₁ counted from the middle.
        let half = n.of(LN_2);
        let base = bend(half, one, n);
        // z so near 1 that zⁿ is 1 to the last digit stays there.
        let above = -(-(n * z0.ln()).exp_and_m1()[1]).ln();
        let above = above.max(half).min(n.of(40.0));
        let mut q = R::select(low, half, above);
        let mut target = start + u - self.reach;
        // The first turn finds where the step begins, where that is above the middle.
        for turn in 0..=30 {
            let here = self.above(q, base);
            if turn == 0 {
                target = R::select(low, target, u + here);
            }
            let y = -(-q).exp_and_m1()[1];
            let change = (target - here) * n * y.powf(one - one / n);
            q = R::select(goes_on, q + change, q);
            goes_on = goes_on & (rounding * q).lt(change.abs());
            if !zero.any(goes_on) {
                break;
            }
        }
        R::select(inner, z, (-(-q).exp_and_m1()[1]).powf(one / n))
    }

    /// S₁ at q, less its value in the middle, where its [bend] is `base`.
    #[inline(always)]
    fn above(&self, q: R, base: R) -> R {
        (q - q.of(LN_2)) / self.n + bend(q, q.of(1.0), self.n) - base
    }

    /// S₂ − S₁, which stays finite at z = 1.
    #[inline(always)]
    fn work(&self, z: R) -> R {
        let (n, one, two) = (self.n, z.of(1.0), z.of(2.0));
        let low = z.lt(self.middle);
        let within = z.min(self.middle);
        let mut work = below(within, two, n) - below(within, one, n);
        if z.any(!low) {
            let q = (-(-(n * z.ln()).exp_and_m1()[1]).ln()).min(z.of(745.0));
            let half = z.of(LN_2);
            let (mut at, mut bends) = (q, [z; 2]);
            for it in &mut bends {
                *it = bend(at, two, n) - bend(at, one, n);
                at = half;
            }
            let above = below(self.middle, two, n) - self.reach + bends[0] - bends[1];
            work = R::select(low, work, above);
        }
        work
    }
}

/// The part of Sₘ at q without its logarithm and constant.
#[inline(always)]
fn bend<R: Real>(q: R, m: R, n: R) -> R {
    let (zero, one) = (q.of(0.0), q.of(1.0));
    let (x, b) = ((-q).exp_by_vectors(), m / n);
    let (mut power, mut harmonic, mut sum) = (one, zero, zero);
    let mut goes_on = zero.le(zero);
    for k in 0..70 {
        let k = q.of(f64::from(k));
        power = power * ((b + k) / (k + one) * x);
        harmonic = harmonic + (one / (k + one) - one / (b + k));
        let term = power * harmonic;
        sum = R::select(goes_on, sum + term, sum);
        goes_on = goes_on & (q.of(NOTHING) * sum.abs()).lt(term.abs());
        if !q.any(goes_on) {
            break;
        }
    }
    (-(-q).exp_and_m1()[1]).powf(b) * sum / n
}

/// Sₘ for zⁿ ≤ ½ by its power series.
#[inline(always)]
fn below<R: Real>(z: R, m: R, n: R) -> R {
    let zero = z.of(0.0);
    let y = z.powf(n);
    let (mut power, mut sum) = (z.of(1.0), zero);
    let mut goes_on = zero.le(zero);
    for k in 0..60 {
        let term = power / (m + z.of(f64::from(k)) * n);
        sum = R::select(goes_on, sum + term, sum);
        goes_on = goes_on & (z.of(NOTHING) * sum).lt(term);
        if !z.any(goes_on) {
            break;
        }
        power = power * y;
    }
    // m is 1 or 2.
    R::select(m.lt(z.of(1.5)), z * sum, z * z * sum)
}

#[cfg(test)]
mod tests {
    use super::{ANY, EARLY, Transition, numbers};
    use approx::assert_relative_eq;

    fn advance(z0: f64, u: f64, rate: f64, n: f64) -> Transition<f64> {
        let exponent = numbers(n);
        match n {
            1.0 => super::advance::<1, f64>(z0, u, rate, &exponent),
            2.0 => super::advance::<2, f64>(z0, u, rate, &exponent),
            _ => super::advance::<ANY, f64>(z0, u, rate, &exponent),
        }
    }

    /// By the series, whatever the exponent.
    fn general(z: f64, u: f64, n: f64) -> [f64; 2] {
        super::general(z, u, &super::by_series(n))
    }

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
                let (one, two) = (super::first(z, u), super::second(z, u));
                for (closed, series) in [(one, general(z, u, 1.0)), (two, general(z, u, 2.0))] {
                    assert_relative_eq!(closed[0], series[0], max_relative = 1e-13);
                    assert_relative_eq!(
                        closed[1],
                        series[1],
                        max_relative = 1e-10,
                        epsilon = 1e-14
                    );
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

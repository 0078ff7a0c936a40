//! Exponential functions and logarithms in vectors: the same operations whatever the number of lanes, so that every lane has
//! the bits that it has alone. Good to a few units of the last place; only numbers in the normal range are told apart.
//!
//! ```text
//!   eˣ = 2ᵏ eʳ,  |r| ≤ ln 2/2: Taylor's series            ln x = k ln 2 + 2 artanh(f/(2 + f)),  x = 2ᵏ (1 + f)
//! ```

use super::Real;
use super::each::each;
use std::f64::consts::{LN_2, LOG2_E, SQRT_2};

/// 1.5 · 2⁵²: a number added to it is rounded to a whole one, which its last bits hold.
const WHOLE: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts: the first times a whole number below 2²⁰ is exact.
const LN_2_HIGH: f64 = f64::from_bits(LN_2.to_bits() & !0x1f_ffff);
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
/// Beyond these eˣ is nothing, or no number.
const LEAST: f64 = -708.0;
const MOST: f64 = 709.782_712_893_384;

/// Σ cᵢ xⁱ, the highest first.
#[inline(always)]
fn polynomial<R: Real, const N: usize>(x: R, c: &[f64; N]) -> R {
    let mut sum = x.of(c[0]);
    each!(N, i => if i > 0 { sum = sum.mul_add(x, x.of(c[i])) });
    sum
}

/// eˣ and eˣ − 1.
#[inline(always)]
pub(super) fn exp_and_m1<R: Real>(x: R) -> [R; 2] {
    /// 1/13! … 1/2!
    const SERIES: [f64; 12] = [
        1.0 / 6_227_020_800.0,
        1.0 / 479_001_600.0,
        1.0 / 39_916_800.0,
        1.0 / 3_628_800.0,
        1.0 / 362_880.0,
        1.0 / 40_320.0,
        1.0 / 5_040.0,
        1.0 / 720.0,
        1.0 / 120.0,
        1.0 / 24.0,
        1.0 / 6.0,
        1.0 / 2.0,
    ];
    let (zero, one) = (x.of(0.0), x.of(1.0));
    // What is not a number stays so.
    let within = x.of(LEAST).max(x);
    let within = x.of(MOST).min(within);
    let power = within.mul_add(x.of(LOG2_E), x.of(WHOLE));
    let power = x.of(WHOLE + 1023.0).min(power);
    let k = power - x.of(WHOLE);
    let r = k.mul_add(x.of(-LN_2_LOW), k.mul_add(x.of(-LN_2_HIGH), within));
    let rise = (r * r).mul_add(polynomial(r, &SERIES), r);
    let scale = power.map(|p| f64::from_bits(p.to_bits().wrapping_add(1023) << 52));
    let nothing = x.lt(x.of(LEAST));
    let endless = x.of(MOST).lt(x);
    let grown = R::select(endless, x.of(f64::INFINITY), scale.mul_add(rise, scale));
    let more = R::select(endless, x.of(f64::INFINITY), scale.mul_add(rise, scale - one));
    [R::select(nothing, zero, grown), R::select(nothing, -one, more)]
}

/// k and 1 + f of a number 2ᵏ (1 + f), √½ ≤ 1 + f < √2.
#[inline(always)]
fn split<R: Real>(x: R) -> [R; 2] {
    const FRACTION: u64 = 0x000f_ffff_ffff_ffff;
    const ONE: u64 = 1023 << 52;
    // Bits of 2⁵² + the exponent.
    const HELD: u64 = (1023 + 52) << 52;
    let mantissa = x.map(|x| f64::from_bits((x.to_bits() & FRACTION) | ONE));
    let exponent = x.map(|x| f64::from_bits((x.to_bits() >> 52) | HELD));
    let exponent = exponent - x.of(f64::from_bits(HELD) + 1023.0);
    let large = x.of(SQRT_2).le(mantissa);
    let (one, half) = (x.of(1.0), x.of(0.5));
    [R::select(large, exponent + one, exponent), R::select(large, half * mantissa, mantissa)]
}

/// ln(1 + f) for √½ ≤ 1 + f < √2.
#[inline(always)]
fn near_one<R: Real>(f: R) -> R {
    /// 2/21 … 2/3
    const SERIES: [f64; 10] = [
        2.0 / 21.0,
        2.0 / 19.0,
        2.0 / 17.0,
        2.0 / 15.0,
        2.0 / 13.0,
        2.0 / 11.0,
        2.0 / 9.0,
        2.0 / 7.0,
        2.0 / 5.0,
        2.0 / 3.0,
    ];
    let s = f / (f + f.of(2.0));
    let square = s * s;
    // 2 s = f − s f
    f - s * (f - square * polynomial(square, &SERIES))
}

#[inline(always)]
pub(super) fn ln<R: Real>(x: R) -> R {
    let (zero, one, endless) = (x.of(0.0), x.of(1.0), x.of(f64::INFINITY));
    let [k, m] = split(x);
    let known = k.mul_add(x.of(LN_2_HIGH), k.mul_add(x.of(LN_2_LOW), near_one(m - one)));
    let known = R::select(x.lt(endless), known, x);
    let below = R::select(x.lt(zero), x.of(f64::NAN), -endless);
    R::select(x.le(zero), below, known)
}

#[inline(always)]
pub(super) fn ln_1p<R: Real>(x: R) -> R {
    let (one, endless) = (x.of(1.0), x.of(f64::INFINITY));
    let sum = one + x;
    let [k, m] = split(sum);
    // What is lost in the sum.
    let large = x.of(0.25).lt(x.abs());
    let lost = (R::select(one.lt(x), one - (sum - x), x - (sum - one)) / sum).only(large);
    let near = near_one(R::select(large, m - one, x));
    let k = k.only(large);
    let known = k.mul_add(x.of(LN_2_HIGH), k.mul_add(x.of(LN_2_LOW), near) + lost);
    let known = R::select(x.lt(endless), known, x);
    let below = R::select(x.lt(-one), x.of(f64::NAN), -endless);
    R::select(x.le(-one), below, known)
}

#[inline(always)]
pub(super) fn tanh<R: Real>(x: R) -> R {
    let size = x.abs();
    let fall = exp_and_m1(x.of(-2.0) * size)[1];
    let t = -fall / (fall + x.of(2.0));
    R::select(x.lt(x.of(0.0)), -t, t)
}

/// ∛x: from its logarithm, with a step of Newton's method.
#[inline(always)]
pub(super) fn cbrt<R: Real>(x: R) -> R {
    let (zero, third, size) = (x.of(0.0), x.of(1.0 / 3.0), x.abs());
    let root = exp_and_m1(ln(size) * third)[0];
    let square = root * root;
    let root = root - (root * square - size) / square * third;
    let root = R::select(zero.lt(size), root, size);
    R::select(x.lt(zero), -root, root)
}

/// xᵃ of x ≥ 0.
#[inline(always)]
pub(super) fn powf<R: Real>(x: R, a: R) -> R {
    let (zero, one) = (x.of(0.0), x.of(1.0));
    let known = exp_and_m1(a * ln(x))[0];
    let none = a.le(zero) & zero.le(a);
    R::select(none, one, known)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Arithmetic, Avx2Lanes, Fused, FusedOne};

    fn arguments() -> Vec<f64> {
        let sizes = (-60..=60).map(|i| 1.37_f64.powi(i)).chain([1e-300, 0.3465, 0.4, 0.6, 0.9999]);
        sizes.flat_map(|x| [x, -x]).chain([0.0, 700.0, -700.0, 709.0, 800.0, -800.0]).collect()
    }

    fn near(given: f64, own: f64, tolerance: f64, what: &str, x: f64) {
        let error = (given - own).abs();
        assert!(given == own || error <= tolerance * own.abs(), "{what}({x}): {given} for {own}");
    }

    #[test]
    fn they_are_those_of_the_standard_library() {
        for x in arguments() {
            let [e, m] = exp_and_m1(Fused(x));
            if x > LEAST {
                near(e.0, x.exp(), 1e-15, "exp", x);
            } else {
                assert_eq!(e.0, 0.0);
            }
            near(m.0, x.exp_m1(), 1e-15, "exp_m1", x);
            near(tanh(Fused(x)).0, x.tanh(), 1e-15, "tanh", x);
            near(cbrt(Fused(x)).0, x.cbrt(), 1e-15, "cbrt", x);
            if x > -1.0 {
                near(ln_1p(Fused(x)).0, x.ln_1p(), 1e-15, "ln_1p", x);
            }
            if x > 0.0 {
                near(ln(Fused(x)).0, x.ln(), 1e-15, "ln", x);
                for a in [0.0, 0.3, 1.0, 2.0, -0.5] {
                    // The logarithm is rounded before it is multiplied.
                    let tolerance = 1e-15 * (1.0 + (a * x.ln()).abs());
                    near(powf(Fused(x), Fused(a)).0, x.powf(a), tolerance, "powf", x);
                }
            }
        }
        assert_eq!(powf(Fused(0.0), Fused(0.7)).0, 0.0);
        assert_eq!(
            (ln(Fused(0.0)).0, ln_1p(Fused(-1.0)).0),
            (f64::NEG_INFINITY, f64::NEG_INFINITY)
        );
        for f in [ln, ln_1p, tanh, cbrt, |x| exp_and_m1(x)[0], |x| exp_and_m1(x)[1]] {
            assert!(f(Fused(f64::NAN)).0.is_nan());
        }
    }

    #[test]
    fn a_lane_has_the_bits_that_it_has_alone() {
        let (Some(one), Some(eight)) = (FusedOne::available(), Avx2Lanes::available()) else {
            return;
        };
        for x in arguments().chunks(8) {
            let own = |lane: usize| *x.get(lane).unwrap_or(&1.0);
            let all = eight.gather(own);
            for lane in 0..8 {
                let alone = one.splat(own(lane));
                let bits = |a: f64, b: Fused| assert_eq!(a.to_bits(), b.0.to_bits());
                bits(eight.lane(exp_and_m1(all)[1], lane), exp_and_m1(alone)[1]);
                bits(eight.lane(ln_1p(all), lane), ln_1p(alone));
                bits(eight.lane(ln(all), lane), ln(alone));
                bits(eight.lane(tanh(all), lane), tanh(alone));
            }
        }
    }
}

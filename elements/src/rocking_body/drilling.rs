//! Arm of the friction of a rim that turns on the spot: m ρ, the mean distance of what presses from its centre.
//!
//! ```text
//!   arc:    p ~ cos ψ − cos ψ꜀ over |ψ| < ψ꜀       whole rim:  p ~ 1 + u cos ψ,  0 ≤ u ≤ 1
//!   m = ∫ p |e^(iψ) − γ| dψ / ∫ p dψ,   γ = ∫ p cos ψ dψ / ∫ p dψ
//!   m → 3/8 ψ꜀ for a short arc, 1 − 3/16 u² for a rim that lies almost flat
//! ```
//!
//! The arc of a rim of stiffness k under N with b = ρ sin(tilt) follows from sin ψ꜀ − ψ꜀ cos ψ꜀ = π N/(k b).

use std::f64::consts::PI;

/// Gauss's rule of 16 points on (0, 1).
const NODES: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_096),
];

/// ∫ f from 0 to `end`.
fn integral<const N: usize>(end: f64, f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (x, weight) in NODES {
        for x in [-x, x] {
            let at = f(0.5 * end * (1.0 + x));
            for i in 0..N {
                sum[i] += 0.5 * end * weight * at[i];
            }
        }
    }
    sum
}

/// m of an arc of half angle ψ꜀ ≤ π, and its derivative by ψ꜀.
pub(super) fn of_arc(half: f64) -> [f64; 2] {
    // A short arc is straight, its pressure a parabola.
    if half < 1e-6 {
        return [0.375 * half, 0.375];
    }
    let weight = |psi: f64| 2.0 * (0.5 * (half + psi)).sin() * (0.5 * (half - psi)).sin();
    // 1 − cos ψ, which keeps its digits.
    let sunk = |psi: f64| 2.0 * (0.5 * psi).sin().powi(2);
    let [all, sunken, plain] =
        integral(half, |psi| [weight(psi), weight(psi) * sunk(psi), sunk(psi)]);
    let depth = sunken / all;
    let distance = |psi: f64| (depth - sunk(psi)).hypot(psi.sin());
    let [arms, by_depth, distances] = integral(half, |psi| {
        let d = distance(psi);
        [weight(psi) * d, weight(psi) * (depth - sunk(psi)) / d, d]
    });
    // By ψ꜀: the weight grows everywhere by sin ψ꜀, and is zero at its ends.
    let grow = half.sin();
    let by_all = grow * half;
    let depth_by = (grow * plain - depth * by_all) / all;
    let m = arms / all;
    [m, (grow * distances + by_depth * depth_by - m * by_all) / all]
}

/// Times ψ꜀ a bound below m of an arc of half angle ψ꜀, and of the whole rim at π: m/ψ꜀ falls from 3/8 to 13/(16 π).
pub(super) const LEAST: f64 = 0.25;

/// m of a rim that is pressed all around, and its derivative by u².
pub(super) fn of_circle(square: f64) -> [f64; 2] {
    let u = square.max(0.0).sqrt();
    if u < 1e-4 {
        return [1.0 - 0.1875 * square, -0.1875];
    }
    let [arms, slopes] = integral(PI, |psi| {
        let cosine = psi.cos();
        let d = (cosine - 0.5 * u).hypot(psi.sin());
        let weight = 1.0 + u * cosine;
        [weight * d, cosine * d + weight * (0.25 * u - 0.5 * cosine) / d]
    });
    [arms / PI, slopes / PI / (2.0 * u)]
}

/// Half angle ψ꜀ of the arc where sin ψ꜀ − ψ꜀ cos ψ꜀ = y ≤ π, and its derivative by y.
pub(super) fn arc(y: f64) -> [f64; 2] {
    let (mut low, mut high) = (0.0, PI);
    let mut psi = (3.0 * y).cbrt().min(PI);
    for _ in 0..100 {
        // ψ³/3 where the difference has no digits.
        let value = if psi < 1e-2 {
            psi.powi(3) / 3.0 * (1.0 - psi * psi / 10.0)
        } else {
            psi.sin() - psi * psi.cos()
        };
        let rest = value - y;
        if rest < 0.0 {
            low = psi
        } else {
            high = psi
        }
        let next = psi - rest / (psi * psi.sin()).max(f64::MIN_POSITIVE);
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        let done = (next - psi).abs() <= 1e-15 * psi;
        psi = next;
        if done {
            break;
        }
    }
    // Where the arc begins or closes its angle has no slope.
    [psi, 1.0 / (psi * psi.sin()).max(1e-6)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Friction torque of many points on the circle over μ N ρ, with their pressure.
    fn by_points(pressure: impl Fn(f64) -> f64) -> f64 {
        let n = 400_000;
        let points = || (0..n).map(|i| 2.0 * PI * (f64::from(i) + 0.5) / f64::from(n));
        let all: f64 = points().map(|psi| pressure(psi.cos())).sum();
        let centre: f64 = points().map(|psi| pressure(psi.cos()) * psi.cos()).sum::<f64>() / all;
        let arm = |psi: f64| (psi.cos() - centre).hypot(psi.sin());
        points().map(|psi| pressure(psi.cos()) * arm(psi)).sum::<f64>() / all
    }

    #[test]
    fn the_arm_is_that_of_what_presses() {
        for half in [0.05, 0.3, 1.0, 2.0, 3.0, PI] {
            let sum = by_points(|cosine| (cosine - half.cos()).max(0.0));
            assert_relative_eq!(of_arc(half)[0], sum, max_relative = 2e-5);
        }
        for u in [0.0_f64, 1e-5, 0.3, 1.0] {
            let sum = by_points(|cosine| 1.0 + u * cosine);
            assert_relative_eq!(of_circle(u * u)[0], sum, max_relative = 1e-5);
        }
        assert_relative_eq!(of_arc(1e-3)[0], 0.375e-3, max_relative = 1e-5);
        for i in 1..=1000 {
            let half = f64::from(i) * PI / 1000.0;
            assert!(LEAST * half <= of_arc(half)[0], "{half}");
            assert!(LEAST * PI <= of_circle(f64::from(i) / 1000.0)[0]);
        }
        assert_relative_eq!(of_arc(PI)[0], of_circle(1.0)[0], max_relative = 1e-6);
        assert_relative_eq!(of_circle(1e-6)[0], 1.0 - 0.1875e-6, max_relative = 1e-12);
    }

    #[test]
    fn derivatives_are_those_of_the_arm_and_of_the_arc() {
        let by = |f: &dyn Fn(f64) -> f64, x: f64| {
            let h = 1e-5 * x;
            (f(x + h) - f(x - h)) / (2.0 * h)
        };
        for half in [1e-3, 0.3, 1.0, 2.5] {
            assert_relative_eq!(of_arc(half)[1], by(&|x| of_arc(x)[0], half), max_relative = 1e-4);
        }
        for square in [1e-4, 0.1, 0.9] {
            let slope = by(&|x| of_circle(x)[0], square);
            assert_relative_eq!(of_circle(square)[1], slope, max_relative = 1e-5);
        }
        for psi in [1e-3, 0.2, 1.0, 2.0, 3.0] {
            let y = f64::sin(psi) - psi * psi.cos();
            assert_relative_eq!(arc(y)[0], psi, max_relative = 1e-6);
            assert_relative_eq!(arc(y)[1], by(&|y| arc(y)[0], y), max_relative = 1e-5);
        }
    }
}

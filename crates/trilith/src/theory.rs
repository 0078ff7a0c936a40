//! Closed forms of free-standing rigid blocks, drawn beside what is computed.
//!
//! A block of width B and height H, H/B = s, on a rigid ground with friction coefficient µ.

use std::f64::consts::{FRAC_PI_2, PI};

/// Friction coefficient above which a block that rocks under a ground acceleration of `a` g does not slide
/// (Shenton 1996, J. Eng. Mech. 122(7), 690–693).
///
/// A block that begins to rock about its corner has the angular acceleration
/// θ̈ = (g/b) q with q = 3 (a s − 1)/(4 (1 + s²)), b = B/2. The ground must give it the horizontal force
/// m g (a − s q) and the vertical force m g (1 + q); their ratio is what friction must hold.
#[must_use]
pub fn friction_to_rock(a: f64, slenderness: f64) -> f64 {
    let s = slenderness;
    let q = 3.0 * (a * s - 1.0) / (4.0 * (1.0 + s * s));
    (a - s * q) / (1.0 + q)
}

/// The mode in which a block leaves rest under a ground acceleration that jumps to `a` g: `rest`, `slide`,
/// `rock` or `slide-rock` (Shenton 1996).
///
/// It stays up to a = min(µ, 1/s). A sliding block has the friction µ m g beneath it, which turns it where
/// µ > 1/s; a rocking one slides below [`friction_to_rock`].
#[must_use]
pub fn initial_mode(a: f64, mu: f64, slenderness: f64) -> &'static str {
    let corner = 1.0 / slenderness;
    if a <= mu.min(corner) {
        "rest"
    } else if mu <= corner {
        "slide"
    } else if mu >= friction_to_rock(a, slenderness) {
        "rock"
    } else {
        "slide-rock"
    }
}

/// Least amplitude, over g tan α, of a half sine of ω/p = `ratio` that overturns a slender block without impact.
///
/// sin ψ = g α/a is where the block leaves rest, and (ω/p) sin ψ − cos ψ = e^(−(π−ψ)p/ω) is the condition that it
/// comes to balance with no speed left (Housner 1963 as corrected by Makris and Roussos 2000; Zhang and Makris
/// 2001).
#[must_use]
pub fn half_sine_overturning(ratio: f64) -> f64 {
    let excess = |psi: f64| ratio * psi.sin() - psi.cos() - (-(PI - psi) / ratio).exp();
    // The left side grows with ψ in (0, π/2]. Below ω/p of about 1 the block falls as soon as it lifts off.
    if excess(FRAC_PI_2) < 0.0 {
        return 1.0;
    }
    let (mut low, mut high) = (1e-9, FRAC_PI_2);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
    1.0 / low.sin()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_border_of_rock_and_slide_rock_is_shentons() {
        // As printed: µ = (a (4 + s²) + 3 s)/(1 + 4 s² + 3 a s).
        for s in [1.5, 2.0, 4.0] {
            for a in [0.6, 1.0, 2.0] {
                let printed = (a * (4.0 + s * s) + 3.0 * s) / (1.0 + 4.0 * s * s + 3.0 * a * s);
                assert!((friction_to_rock(a, s) - printed).abs() < 1e-14);
            }
            // At the least acceleration that rocks it, friction holds 1/s.
            assert!((friction_to_rock(1.0 / s, s) - 1.0 / s).abs() < 1e-14);
        }
    }

    #[test]
    fn the_four_cases_of_the_paper_have_their_modes() {
        let cases =
            [(0.2, 0.4, "rest"), (1.5, 0.2, "slide"), (1.5, 0.6, "slide-rock"), (0.8, 0.8, "rock")];
        for (a, mu, mode) in cases {
            assert_eq!(initial_mode(a, mu, 2.0), mode);
        }
    }

    #[test]
    fn a_half_sine_that_just_overturns_ends_in_balance() {
        // φ̈ = p² (φ − sin(ωt + ψ)/sin ψ + 1) from rest, rotation over α; free after the pulse: balance at 1
        // is met with φ̇ = p (1 − φ).
        for ratio in [2.0f64, 4.0, 8.0] {
            let psi = (1.0 / half_sine_overturning(ratio)).asin();
            let force = |t: f64| (ratio * t + psi).sin() / psi.sin();
            let end = (PI - psi) / ratio;
            let n = 20_000;
            let h = end / f64::from(n);
            let (mut x, mut v) = (0.0, 0.0);
            let f = |t: f64, x: f64| x - 1.0 + force(t);
            for i in 0..n {
                let t = f64::from(i) * h;
                let (k1, l1) = (v, f(t, x));
                let (k2, l2) = (v + 0.5 * h * l1, f(t + 0.5 * h, x + 0.5 * h * k1));
                let (k3, l3) = (v + 0.5 * h * l2, f(t + 0.5 * h, x + 0.5 * h * k2));
                let (k4, l4) = (v + h * l3, f(t + h, x + h * k3));
                x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
                v += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
            }
            assert!((x + v - 1.0).abs() < 1e-6, "ω/p = {ratio}: {x} {v}");
        }
    }
}

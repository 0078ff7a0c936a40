//! Response spectra by the exact recurrence for straight pieces of acceleration.
//!
//! ```text
//! ü + 2ζω u̇ + ω² u = −a(t),   a straight within a step h:
//! (u, u̇)₁ = A (u, u̇)₀ + B (a₀, a₁)
//! ```
//!
//! A and B are exact \[Nigam & Jennings 1969\]; here they come from the exponential of the step in closed form. Where
//! a step is longer than a 64th of the period it is divided, which changes no sample and meets peaks between
//! samples within 0.12 %. After the end of the record the oscillator swings on by itself; what that reaches is known in
//! closed form.

use pulp::{Arch, Simd, WithSimd};
use std::f64::consts::{PI, TAU};

/// Oscillators that are advanced side by side.
const LANES: usize = 8;
/// Steps of the recurrence in a period, at least.
const STEPS_PER_PERIOD: f64 = 64.0;

/// A linear oscillator with one degree of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    /// Undamped period, s; 0: rigid.
    pub period: f64,
    /// Damping as a share of critical, below 1.
    pub damping: f64,
}

/// Peaks of an oscillator.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    /// Spectral displacement: largest |u|, m.
    pub sd: f64,
    /// Largest |u̇| relative to the ground, m/s.
    pub sv: f64,
    /// Largest absolute acceleration, m/s².
    pub sa: f64,
    /// Pseudo-velocity ω·SD, m/s.
    pub psv: f64,
    /// Pseudo-acceleration ω²·SD, m/s²; of a rigid oscillator the peak of the ground.
    pub psa: f64,
}

/// Responses over periods, for one damping ratio.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Damping as a share of critical.
    pub damping: f64,
    /// Periods, s.
    pub periods: Vec<f64>,
    /// What the oscillators do.
    pub responses: Vec<Response>,
}

impl Spectrum {
    /// Pseudo-accelerations, m/s².
    #[must_use]
    pub fn psa(&self) -> Vec<f64> {
        self.responses.iter().map(|r| r.psa).collect()
    }

    /// The largest absolute acceleration, and its period.
    #[must_use]
    pub fn peak(&self) -> Option<(f64, f64)> {
        let pairs = self.periods.iter().zip(&self.responses);
        pairs.map(|(t, r)| (r.sa, *t)).max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// `n` periods from one to another (s), in even steps of their logarithm.
#[must_use]
pub fn periods(from: f64, to: f64, n: usize) -> Vec<f64> {
    let step = (to / from).ln() / n.saturating_sub(1).max(1) as f64;
    (0..n).map(|i| if i + 1 == n && n > 1 { to } else { from * (step * i as f64).exp() }).collect()
}

/// The response spectrum of a ground acceleration (m/s², every `dt` s).
#[must_use]
pub fn spectrum(acceleration: &[f64], dt: f64, periods: &[f64], damping: f64) -> Spectrum {
    let responses = responses::<true>(acceleration, dt, periods, damping);
    Spectrum { damping, periods: periods.to_vec(), responses }
}

/// The pseudo-accelerations of [`spectrum`] alone, m/s²: the same bits in half the time.
#[must_use]
pub fn pseudo_accelerations(
    acceleration: &[f64],
    dt: f64,
    periods: &[f64],
    damping: f64,
) -> Vec<f64> {
    let all = responses::<false>(acceleration, dt, periods, damping);
    all.iter().map(|r| r.psa).collect()
}

fn responses<const RATES: bool>(
    acceleration: &[f64],
    dt: f64,
    periods: &[f64],
    damping: f64,
) -> Vec<Response> {
    let all: Vec<Oscillator> =
        periods.iter().map(|&period| Oscillator { period, damping }).collect();
    all.chunks(LANES).flat_map(|group| peaks::<RATES>(acceleration, dt, group)).collect()
}

/// Coefficients of one step: (u, v)₁ = A (u, v)₀ + B (a₀, a₁).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    pub a: [[f64; 2]; 2],
    pub b: [[f64; 2]; 2],
}

impl Oscillator {
    /// Circular frequency, rad/s.
    #[must_use]
    pub fn omega(&self) -> f64 {
        TAU / self.period
    }

    /// The exact step of length h.
    pub(crate) fn step(&self, h: f64) -> Step {
        let (w, z) = (self.omega(), self.damping);
        let wd = w * (1.0 - z * z).sqrt();
        let e = (-z * w * h).exp();
        let (s, c) = (wd * h).sin_cos();
        // Homogeneous part.
        let a = [
            [e * (c + z * w / wd * s), e * s / wd],
            [-e * w * w / wd * s, e * (c - z * w / wd * s)],
        ];
        // Particular solution for −(α + β t): p(t) = −α/ω² + 2ζβ/ω³ − β t/ω².
        let of = |a0: f64, a1: f64| {
            let (alpha, beta) = (a0, (a1 - a0) / h);
            let p0 = -alpha / (w * w) + 2.0 * z * beta / (w * w * w);
            let slope = -beta / (w * w);
            let p1 = p0 + slope * h;
            [p1 - a[0][0] * p0 - a[0][1] * slope, slope - a[1][0] * p0 - a[1][1] * slope]
        };
        let (left, right) = (of(1.0, 0.0), of(0.0, 1.0));
        // For steps that are short against the period the closed form cancels: take its series.
        let b =
            if w * h > 0.05 { [[left[0], right[0]], [left[1], right[1]]] } else { series(w, z, h) };
        Step { a, b }
    }

    /// Displacement at the samples, m.
    #[must_use]
    pub fn displacement(&self, acceleration: &[f64], dt: f64) -> Vec<f64> {
        if self.period <= 0.0 {
            return vec![0.0; acceleration.len()];
        }
        let s = self.step(dt);
        let (mut u, mut v) = (0.0, 0.0);
        let mut all = Vec::with_capacity(acceleration.len());
        all.extend(acceleration.first().map(|_| 0.0));
        for p in acceleration.windows(2) {
            (u, v) = s.advance(u, v, p[0], p[1]);
            all.push(u);
        }
        all
    }
}

impl Step {
    #[inline(always)]
    pub(crate) fn advance(&self, u: f64, v: f64, a0: f64, a1: f64) -> (f64, f64) {
        (
            self.a[0][0] * u + self.a[0][1] * v + self.b[0][0] * a0 + self.b[0][1] * a1,
            self.a[1][0] * u + self.a[1][1] * v + self.b[1][0] * a0 + self.b[1][1] * a1,
        )
    }
}

/// B as a power series of the step: u = −∫∫ response, by Taylor's formula with u⁽ᵏ⁺²⁾ = −2ζω u⁽ᵏ⁺¹⁾ − ω² u⁽ᵏ⁾ − a⁽ᵏ⁾.
fn series(w: f64, z: f64, h: f64) -> [[f64; 2]; 2] {
    let of = |a0: f64, a1: f64| {
        let slope = (a1 - a0) / h;
        // Derivatives of u at the start, from rest.
        let mut d = [0.0; 14];
        d[2] = -a0;
        d[3] = -2.0 * z * w * d[2] - slope;
        for k in 4..d.len() {
            d[k] = -2.0 * z * w * d[k - 1] - w * w * d[k - 2];
        }
        let (mut u, mut v, mut power) = (0.0, 0.0, 1.0);
        for k in 1..d.len() {
            v += d[k] * power;
            power *= h / k as f64;
            u += d[k] * power;
        }
        [u, v]
    };
    let (left, right) = (of(1.0, 0.0), of(0.0, 1.0));
    [[left[0], right[0]], [left[1], right[1]]]
}

/// Steps of the recurrence that a step of the record is divided into for an oscillator of a period.
pub(crate) fn steps_per_sample(dt: f64, period: f64) -> usize {
    (STEPS_PER_PERIOD * dt / period).ceil().clamp(1.0, 4096.0) as usize
}

/// Oscillators side by side, under one acceleration; the bits are the same whatever vectors the processor has.
struct Swing<'a, const RATES: bool> {
    acceleration: &'a [f64],
    /// Steps of the recurrence in a step of the record.
    parts: usize,
    steps: [Step; LANES],
    /// ω² and 2ζω.
    w2: [f64; LANES],
    zw: [f64; LANES],
}

/// What they do: where they end, and the largest |u|, |u̇| and |absolute acceleration| on the way. Without `RATES` the
/// last two stay zero.
#[derive(Default)]
struct Swung {
    u: [f64; LANES],
    v: [f64; LANES],
    sd: [f64; LANES],
    sv: [f64; LANES],
    sa: [f64; LANES],
}

impl<const RATES: bool> WithSimd for Swing<'_, RATES> {
    type Output = Swung;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Swung {
        let Self { acceleration, parts, steps, w2, zw } = self;
        let at = |f: fn(&Step) -> f64| -> [f64; LANES] { std::array::from_fn(|i| f(&steps[i])) };
        let [a00, a01, a10, a11] =
            [at(|s| s.a[0][0]), at(|s| s.a[0][1]), at(|s| s.a[1][0]), at(|s| s.a[1][1])];
        let [b00, b01, b10, b11] =
            [at(|s| s.b[0][0]), at(|s| s.b[0][1]), at(|s| s.b[1][0]), at(|s| s.b[1][1])];
        let larger = |most: f64, x: f64| if x.abs() > most { x.abs() } else { most };
        let Swung { mut u, mut v, mut sd, mut sv, mut sa } = Swung::default();
        for p in acceleration.windows(2) {
            let slope = (p[1] - p[0]) / parts as f64;
            for k in 0..parts {
                let (g0, g1) = (p[0] + slope * k as f64, p[0] + slope * (k + 1) as f64);
                for l in 0..LANES {
                    let next = a00[l] * u[l] + a01[l] * v[l] + b00[l] * g0 + b01[l] * g1;
                    v[l] = a10[l] * u[l] + a11[l] * v[l] + b10[l] * g0 + b11[l] * g1;
                    u[l] = next;
                    sd[l] = larger(sd[l], next);
                    if RATES {
                        sv[l] = larger(sv[l], v[l]);
                        sa[l] = larger(sa[l], w2[l] * next + zw[l] * v[l]);
                    }
                }
            }
        }
        Swung { u, v, sd, sv, sa }
    }
}

/// Peaks of up to [`LANES`] oscillators.
fn peaks<const RATES: bool>(acceleration: &[f64], dt: f64, group: &[Oscillator]) -> Vec<Response> {
    let ground = super::peak(acceleration);
    let shortest =
        group.iter().map(|o| o.period).filter(|t| *t > 0.0).fold(f64::INFINITY, f64::min);
    let parts = steps_per_sample(dt, shortest);
    let h = dt / parts as f64;
    // Lanes that are not used hold a copy of the first.
    let lane = |i: usize| group.get(i).filter(|o| o.period > 0.0);
    let spare =
        Oscillator { period: if shortest.is_finite() { shortest } else { 1.0 }, damping: 0.5 };
    let all: [&Oscillator; LANES] = std::array::from_fn(|i| lane(i).unwrap_or(&spare));
    let swing = Swing::<RATES> {
        acceleration,
        parts,
        steps: all.map(|o| o.step(h)),
        w2: all.map(|o| o.omega().powi(2)),
        zw: all.map(|o| 2.0 * o.damping * o.omega()),
    };
    let Swung { u, v, mut sd, mut sv, mut sa } = Arch::new().dispatch(swing);
    for (i, o) in group.iter().enumerate().filter(|(_, o)| o.period > 0.0) {
        // What swings on: u̇ = v, v̇ = −ω² u − 2ζω v, and the same for v and for 2ζω v + ω² u = −v̇.
        let (w, rate) = (o.omega(), o.damping * o.omega());
        let slope = |u: f64, v: f64| -w * w * u - 2.0 * rate * v;
        let (u, v) = (u[i], v[i]);
        let (a, jerk) = (slope(u, v), slope(v, slope(u, v)));
        let swing = (rate, w * (1.0 - o.damping * o.damping).sqrt());
        sd[i] = sd[i].max(largest_free(swing, u, v));
        sv[i] = sv[i].max(largest_free(swing, v, a));
        sa[i] = sa[i].max(largest_free(swing, a, jerk));
    }
    let one = |(i, o): (usize, &Oscillator)| {
        if o.period <= 0.0 {
            return Response { sa: ground, psa: ground, ..Response::default() };
        }
        let w = o.omega();
        Response { sd: sd[i], sv: sv[i], sa: sa[i], psv: w * sd[i], psa: w * w * sd[i] }
    };
    group.iter().enumerate().map(one).collect()
}

/// The largest |x| of x = e^(−rate t) (x₀ cos w t + (ẋ₀ + rate x₀)/w sin w t) from t = 0 on: it is largest at once or where
/// it first stands still, and decays from swing to swing.
fn largest_free((rate, w): (f64, f64), x: f64, slope: f64) -> f64 {
    let sine = (slope + rate * x) / w;
    // ẋ = e^(−rate t) (ẋ₀ cos w t − (w x₀ + rate (ẋ₀ + rate x₀)/w) sin w t)
    let mut turn = slope.atan2(w * x + rate * sine);
    if turn < 0.0 {
        turn += PI;
    }
    let (s, c) = turn.sin_cos();
    x.abs().max(((-rate * turn / w).exp() * (x * c + sine * s)).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(n: usize) -> Vec<f64> {
        (0..n)
            .map(|i| (0.37 * i as f64).sin() + 0.6 * (1.9 * (i as f64).sqrt()).cos() - 0.6)
            .collect()
    }

    /// A step of the ground: u = −a/ω² (1 − e^(−ζωt)(cos ω_d t + ζ/√(1−ζ²) sin ω_d t)), with the peak
    /// a/ω² (1 + e^(−πζ/√(1−ζ²))).
    #[test]
    fn a_step_gives_the_overshoot_of_the_closed_form() {
        let (period, a, dt) = (0.8, 1.7, 0.01);
        for z in [0.0, 0.02, 0.2] {
            let o = Oscillator { period, damping: z };
            let (w, q) = (o.omega(), f64::sqrt(1.0 - z * z));
            let ground = vec![a; 400];
            let u = o.displacement(&ground, dt);
            for i in [1, 50, 399] {
                let t = i as f64 * dt;
                let (s, c) = (w * q * t).sin_cos();
                let exact = -a / (w * w) * (1.0 - (-z * w * t).exp() * (c + z / q * s));
                assert!((u[i] - exact).abs() < 1e-13, "{z} {i}: {} {exact}", u[i]);
            }
            let r = spectrum(&ground, dt, &[period], z).responses[0];
            let exact = a / (w * w) * (1.0 + (-PI * z / q).exp());
            assert!(
                r.sd <= exact * (1.0 + 1e-12) && r.sd > exact * (1.0 - 1.3e-3),
                "{} {exact}",
                r.sd
            );
            assert!((r.psa / (w * w * r.sd) - 1.0).abs() < 1e-14);
        }
    }

    /// Half a sine of acceleration, undamped, β = T/(2 t_d): within the pulse the peaks are at
    /// x = πt/t_d = 2πl/(1 + 1/β) with (sin x − β sin(x/β))/(1 − β²), after it 2β cos(π/(2β))/(1 − β²)
    /// \[Chopra, Dynamics of Structures, §4.8\].
    #[test]
    fn a_half_sine_has_its_shock_spectrum() {
        let (td, dt) = (0.25, 0.25 / 4000.0);
        let pulse: Vec<f64> = (0..=4000).map(|i| (PI * f64::from(i) / 4000.0).sin()).collect();
        for ratio in [0.4, 1.2, 2.0, 4.0] {
            let b = 0.5 / ratio;
            let within = (1..=((1.0 + 1.0 / b) / 2.0) as i32).map(|l| {
                let x = TAU * f64::from(l) / (1.0 + 1.0 / b);
                (x.sin() - b * (x / b).sin()) / (1.0 - b * b)
            });
            let after = 2.0 * b * (PI / (2.0 * b)).cos() / (1.0 - b * b);
            let exact = within.chain([after]).fold(0.0_f64, |m, x| m.max(x.abs()));
            let r = spectrum(&pulse, dt, &[td / ratio], 0.0).responses[0];
            assert!((r.psa / exact - 1.0).abs() < 1e-3, "{ratio}: {} {exact}", r.psa);
        }
    }

    /// After a record that ends while everything moves, against many looks at the closed form of the displacement.
    #[test]
    fn what_swings_on_after_the_end_is_exact() {
        let dt = 0.01;
        for (samples, period, z) in
            [(7, 1.3, 0.0), (13, 0.9, 0.03), (31, 2.0, 0.3), (47, 7.0, 0.8), (9, 30.0, 0.05)]
        {
            let (record, after) = (wave(samples), (2.0 * period / dt) as usize);
            let o = Oscillator { period, damping: z };
            let w = o.omega();
            let (mut u, mut v, mut most) = (0.0, 0.0, [0.0_f64; 3]);
            let mut go = |h: f64, g0: f64, g1: f64| {
                (u, v) = o.step(h).advance(u, v, g0, g1);
                let a = w * w * u + 2.0 * z * w * v;
                most = [most[0].max(u.abs()), most[1].max(v.abs()), most[2].max(a.abs())];
            };
            record.windows(2).for_each(|p| go(dt, p[0], p[1]));
            (0..50 * after).for_each(|_| go(dt / 50.0, 0.0, 0.0));
            let r = spectrum(&record, dt, &[period], z).responses[0];
            for (found, wanted) in [r.sd, r.sv, r.sa].into_iter().zip(most) {
                assert!((found / wanted - 1.0).abs() < 1e-6, "{period} {z}: {found} {wanted}");
            }
        }
        // However long that takes.
        let r = spectrum(&wave(300), dt, &[0.02, 1e12], 0.05).responses[1];
        assert!(r.sd.is_finite() && r.sd > 0.0, "{r:?}");
    }

    /// Against Runge's fourth-order rule with a hundred steps to each of the record's.
    #[test]
    fn an_independent_integration_agrees() {
        let (dt, parts) = (0.02, 100);
        let a = wave(300);
        for (period, z) in [(0.1, 0.05), (0.7, 0.02), (3.0, 0.1)] {
            let o = Oscillator { period, damping: z };
            let w = o.omega();
            let exact = o.displacement(&a, dt);
            let (mut u, mut v) = (0.0, 0.0);
            let h = dt / f64::from(parts);
            for (i, p) in a.windows(2).enumerate() {
                let g = |x: f64| p[0] + (p[1] - p[0]) * x;
                let f = |x: f64, u: f64, v: f64| -g(x) - 2.0 * z * w * v - w * w * u;
                for k in 0..parts {
                    let x = f64::from(k) / f64::from(parts);
                    let (y, e) = (x + 0.5 / f64::from(parts), x + 1.0 / f64::from(parts));
                    let (k1, l1) = (v, f(x, u, v));
                    let (k2, l2) = (v + 0.5 * h * l1, f(y, u + 0.5 * h * k1, v + 0.5 * h * l1));
                    let (k3, l3) = (v + 0.5 * h * l2, f(y, u + 0.5 * h * k2, v + 0.5 * h * l2));
                    let (k4, l4) = (v + h * l3, f(e, u + h * k3, v + h * l3));
                    u += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
                    v += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
                }
                let scale = 1.0 / (w * w);
                assert!((u - exact[i + 1]).abs() < 1e-8 * scale, "{period} {i}");
            }
        }
    }

    #[test]
    fn lanes_of_many_periods_agree_with_single_ones() {
        let a = wave(500);
        let all = periods(0.05, 4.0, 13);
        let together = spectrum(&a, 0.01, &all, 0.05);
        for (t, r) in all.iter().zip(&together.responses) {
            let alone = spectrum(&a, 0.01, &[*t], 0.05).responses[0];
            assert!((r.sd / alone.sd - 1.0).abs() < 2e-3, "{t}");
            assert!((r.sa / alone.sa - 1.0).abs() < 2e-3, "{t}");
        }
        assert_eq!(all[12], 4.0);
    }

    #[test]
    fn very_stiff_and_very_soft_oscillators_have_their_limits() {
        let a = wave(500);
        let s = spectrum(&a, 0.01, &[0.0, 0.002], 0.05);
        let ground = super::super::peak(&a);
        assert_eq!(s.responses[0].psa, ground);
        assert!((s.responses[1].psa / ground - 1.0).abs() < 0.02);
        // A very soft one stays where it is while the ground moves.
        let u = Oscillator { period: 5000.0, damping: 0.05 }.displacement(&a, 0.01);
        let moved = super::super::displacement(&a, 0.01);
        let largest = super::super::peak(&moved);
        assert!(u.iter().zip(&moved).all(|(u, g)| (u + g).abs() < 2e-3 * largest));
    }

    #[test]
    fn the_series_meets_the_closed_form() {
        let o = Oscillator { period: 1.0, damping: 0.3 };
        for h in [0.0079, 0.009, 0.02] {
            let (w, z) = (o.omega(), o.damping);
            let (closed, series) = (o.step(h).b, series(w, z, h));
            for i in 0..2 {
                for j in 0..2 {
                    assert!((closed[i][j] - series[i][j]).abs() < 1e-13, "{h} {i} {j}");
                }
            }
        }
    }
}

//! Friction coefficients, as the largest friction force L(N, v) = μ N.
//!
//! ```text
//!   constant            μ
//!   velocity            μ = μ_fast − (μ_fast − μ_slow) e^(−r v)
//!   velocity and force  the same with μ_slow = a_slow N^(n_slow−1), μ_fast = a_fast N^(n_fast−1),
//!                       both at most μ_max, and r = r₀ + r₁ N + r₂ N²
//!   and pressure        the same with μ_fast = μ_f0 − Δμ tanh(α N/A)
//! ```
//!
//! Sources: \[Constantinou, Mokha & Reinhorn 1990\] for the dependence on velocity,
//! \[Tsopelas et al. 1994\] for that on pressure; the power law of the force is that of \[Bowden &
//! Tabor 1964\].

use super::slip::Cone;
use trilith_element::lanes::Real;

/// How the friction coefficient depends on normal force and speed.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Coefficient {
    Constant {
        mu: f64,
    },
    Velocity {
        slow: f64,
        fast: f64,
        rate: f64,
    },
    Force {
        /// Factor in N^(1−n) and exponent n, at rest and at speed.
        slow: (f64, f64),
        fast: (f64, f64),
        most: f64,
        /// r₀ in s/m, r₁ in s/(m N), r₂ in s/(m N²).
        rate: [f64; 3],
    },
    Pressure {
        slow: f64,
        fast: f64,
        rate: f64,
        /// Δμ.
        drop: f64,
        /// α/A in 1/N.
        per_force: f64,
    },
}

/// Largest friction force and its derivatives by normal force and speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Limit {
    pub(crate) force: f64,
    pub(crate) by_normal: f64,
    pub(crate) by_speed: f64,
}

/// Friction coefficient that grows from slow to fast, and its derivative by the speed.
pub(crate) fn exponential(slow: f64, fast: f64, rate: f64, speed: f64) -> (f64, f64) {
    let decay = (fast - slow) * (-rate * speed).exp();
    (fast - decay, rate * decay)
}

/// How it breaks away.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BreakAway {
    /// Coefficient before it slips.
    pub(crate) mu: f64,
    /// Slip over which that is gone, m.
    pub(crate) over: f64,
}

impl Coefficient {
    /// True where the speed does not matter.
    pub(crate) fn is_constant(&self) -> bool {
        matches!(self, Self::Constant { .. })
    }

    /// μ where it is constant.
    pub(crate) fn constant(&self) -> f64 {
        if let Self::Constant { mu } = *self { mu } else { 0.0 }
    }

    /// As numbers of a law over lanes: kind, μ or a at rest and at speed, exponents, μ_max, r₀ … r₂, Δμ, α/A, and μ where
    /// nothing presses.
    pub(crate) fn numbers(&self) -> [f64; NUMBERS] {
        match *self {
            Self::Constant { mu } => [CONSTANT, mu, mu, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, mu],
            Self::Velocity { slow, fast, rate } => {
                [BY_SPEED, slow, fast, 1.0, 1.0, 0.0, rate, 0.0, 0.0, 0.0, 0.0, slow]
            }
            Self::Force { slow, fast, most, rate: [r0, r1, r2] } => {
                let (a, n) = slow;
                let light = if n < 1.0 && a > 0.0 { most } else { a.min(most) };
                [BY_FORCE, a, fast.0, n, fast.1, most, r0, r1, r2, 0.0, 0.0, light]
            }
            Self::Pressure { slow, fast, rate, drop, per_force } => {
                [BY_PRESSURE, slow, fast, 1.0, 1.0, 0.0, rate, 0.0, 0.0, drop, per_force, slow]
            }
        }
    }

    /// The largest friction force at a normal force (N, ≥ 0), as it depends on slip rate and slip.
    pub(crate) fn cone(&self, normal: f64, away: Option<BreakAway>) -> Cone<f64> {
        let away = away.map_or([0.0; 3], |away| [1.0, away.mu, away.over]);
        cone(&self.numbers(), &away, normal)
    }

    /// Largest friction force at a normal force (N, ≥ 0) and a speed (m/s, ≥ 0).
    pub(crate) fn limit(&self, normal: f64, speed: f64) -> Limit {
        // Nothing touches, and powers of zero have no slope.
        if normal <= 0.0 {
            let by_normal = self.coefficient(f64::MIN_POSITIVE, speed);
            return Limit { by_normal, ..Limit::default() };
        }
        match *self {
            Self::Constant { mu } => Limit { force: mu * normal, by_normal: mu, by_speed: 0.0 },
            Self::Velocity { slow, fast, rate } => {
                let (mu, mu_v) = exponential(slow, fast, rate, speed);
                Limit { force: mu * normal, by_normal: mu, by_speed: mu_v * normal }
            }
            Self::Force { slow, fast, most, rate } => {
                let [slow, slow_n] = power(slow.0, slow.1, most, normal);
                let [fast, fast_n] = power(fast.0, fast.1, most, normal);
                let r = rate[0] + normal * (rate[1] + normal * rate[2]);
                let r_n = rate[1] + 2.0 * normal * rate[2];
                let decay = (-r * speed).exp();
                Limit {
                    force: fast - (fast - slow) * decay,
                    by_normal: fast_n - (fast_n - slow_n - (fast - slow) * r_n * speed) * decay,
                    by_speed: (fast - slow) * r * decay,
                }
            }
            Self::Pressure { slow, fast, rate, drop, per_force } => {
                let tanh = (per_force * normal).tanh();
                let at_speed = fast - drop * tanh;
                let by_normal = -drop * per_force * (1.0 - tanh * tanh);
                let (mu, mu_v) = exponential(slow, at_speed, rate, speed);
                let grown = -(-rate * speed).exp_m1();
                Limit {
                    force: mu * normal,
                    by_normal: mu + normal * by_normal * grown,
                    by_speed: mu_v * normal,
                }
            }
        }
    }

    /// μ at a normal force > 0.
    fn coefficient(&self, normal: f64, speed: f64) -> f64 {
        self.limit(normal, speed).force / normal
    }
}

/// How many numbers a coefficient is.
pub(crate) const NUMBERS: usize = 12;
const CONSTANT: f64 = -1.0;
const BY_SPEED: f64 = 0.0;
const BY_FORCE: f64 = 1.0;
const BY_PRESSURE: f64 = 2.0;

/// True for numbers of a coefficient that looks at the normal force alone.
#[inline(always)]
pub(crate) fn is_constant<R: Real>(p: &[R]) -> R::Mask {
    p[0].lt(p[0].of(-0.5))
}

/// The largest friction force at a normal force (N, ≥ 0), as it depends on slip rate and slip. `p`: numbers of the
/// coefficient; `away`: 1 where it breaks away, μ before that, and the slip over which that is gone.
#[inline(always)]
pub(crate) fn cone<R: Real>(p: &[R], away: &[R], normal: R) -> Cone<R> {
    let (zero, half, one, two) = (normal.of(0.0), normal.of(0.5), normal.of(1.0), normal.of(2.0));
    // Nothing touches, and powers of zero have no slope.
    let nothing = normal.le(zero);
    let n = R::select(nothing, one, normal);
    let (by_force, by_pressure) =
        (half.lt(p[0]) & p[0].lt(normal.of(1.5)), normal.of(1.5).lt(p[0]));
    let mut slow = [p[1] * n, p[1]];
    let mut fast = [p[2] * n, p[2]];
    let mut pace = [p[6], zero];
    if zero.any(by_force) {
        let ([slow_force, slow_by], [fast_force, fast_by]) =
            (power(p[1], p[3], p[5], n), power(p[2], p[4], p[5], n));
        slow = [R::select(by_force, slow_force, slow[0]), R::select(by_force, slow_by, slow[1])];
        fast = [R::select(by_force, fast_force, fast[0]), R::select(by_force, fast_by, fast[1])];
        let grown = p[6] + n * (p[7] + n * p[8]);
        pace[0] = R::select(by_force, grown, pace[0]);
        pace[1] = (p[7] + two * n * p[8]).only(by_force);
    }
    if zero.any(by_pressure) {
        let tanh = (p[10] * n).tanh();
        let mu = p[2] - p[9] * tanh;
        let by_normal = -p[9] * p[10] * (one - tanh * tanh);
        fast[0] = R::select(by_pressure, mu * n, fast[0]);
        fast[1] = R::select(by_pressure, mu + n * by_normal, fast[1]);
    }
    for it in [&mut slow, &mut fast] {
        *it = [R::select(nothing, zero, it[0]), R::select(nothing, p[11], it[1])];
    }
    let breaks = half.lt(away[0]);
    let more = away[1] * normal - slow[0];
    let more_by = away[1] - slow[1];
    let holds = breaks & zero.lt(more);
    let touches = !nothing;
    Cone {
        fast,
        less: [fast[0] - slow[0], fast[1] - slow[1]],
        pace: [pace[0].only(touches), pace[1].only(touches)],
        more: [more.only(holds), more_by.only(holds)],
        over: away[2].only(breaks),
    }
}

/// min(a Nⁿ, μ_max N) and its derivative by N.
#[inline(always)]
fn power<R: Real>(a: R, n: R, most: R, normal: R) -> [R; 2] {
    let force = a * normal.powf(n);
    let much = (most * normal).lt(force);
    [R::select(much, most * normal, force), R::select(much, most, n * force / normal)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn all() -> [Coefficient; 4] {
        [
            Coefficient::Constant { mu: 0.06 },
            Coefficient::Velocity { slow: 0.03, fast: 0.06, rate: 20.0 },
            Coefficient::Force {
                slow: (0.5, 0.8),
                fast: (1.3, 0.78),
                most: 0.2,
                rate: [20.0, 1e-5, 1e-11],
            },
            Coefficient::Pressure {
                slow: 0.02,
                fast: 0.12,
                rate: 25.0,
                drop: 0.07,
                per_force: 1e-6,
            },
        ]
    }

    #[test]
    fn derivatives_are_those_of_the_force() {
        for model in all() {
            for (n, v) in [(1e6, 0.03), (2e5, 0.2), (5e3, 0.01), (3e6, 1.0)] {
                let it = model.limit(n, v);
                let (dn, dv) = (1e-4 * n, 1e-6);
                let by_n = model.limit(n + dn, v).force - model.limit(n - dn, v).force;
                let by_v = model.limit(n, v + dv).force - model.limit(n, v - dv).force;
                assert_relative_eq!(it.by_normal, by_n / (2.0 * dn), max_relative = 1e-6);
                assert_relative_eq!(
                    it.by_speed,
                    by_v / (2.0 * dv),
                    max_relative = 1e-6,
                    epsilon = 1.0
                );
            }
        }
    }

    #[test]
    fn friction_depends_on_speed_force_and_pressure() {
        let [_, velocity, force, pressure] = all();
        // 0.06 − 0.03 e^(−20 v), evaluated.
        for (v, mu) in
            [(0.01, 0.035_438_1), (0.05, 0.048_963_6), (0.1, 0.055_939_9), (0.5, 0.059_998_6)]
        {
            assert_relative_eq!(velocity.limit(1.0, v).force, mu, max_relative = 2e-6);
        }
        // At rest 0.5 · (10⁶)^(−0.2) = 0.5 · 10^(−1.2).
        assert_relative_eq!(force.limit(1e6, 0.0).force, 31_547.867, max_relative = 1e-7);
        // At speed 1.3 · 10^(−1.32); the most below 10^(log(6.5)/0.22) N.
        assert_relative_eq!(force.limit(1e6, 50.0).force, 62_221.912, max_relative = 1e-6);
        assert_relative_eq!(force.limit(100.0, 1e3).force, 20.0, max_relative = 1e-9);
        // 0.12 − 0.07 tanh 1.
        assert_relative_eq!(pressure.limit(1e6, 50.0).force, 66_688.41, max_relative = 1e-6);
        assert_relative_eq!(pressure.limit(1e6, 0.0).force, 2e4, max_relative = 1e-12);
    }

    #[test]
    fn nothing_touches_without_a_force() {
        for model in all() {
            let it = model.limit(0.0, 0.1);
            assert_eq!((it.force, it.by_speed), (0.0, 0.0));
            assert!(it.by_normal.is_finite());
        }
    }
}

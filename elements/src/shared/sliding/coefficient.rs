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

    /// The largest friction force at a normal force (N, ≥ 0), as it depends on slip rate and slip.
    pub(crate) fn cone(&self, normal: f64, away: Option<BreakAway>) -> Cone<f64> {
        let (fast, slow, pace) = match *self {
            // Nothing touches, and powers of zero have no slope.
            _ if normal <= 0.0 => {
                let by_normal = self.coefficient(f64::MIN_POSITIVE, 0.0);
                ([0.0, by_normal], [0.0, by_normal], [0.0; 2])
            }
            Self::Constant { mu } => ([mu * normal, mu], [mu * normal, mu], [0.0; 2]),
            Self::Velocity { slow, fast, rate } => {
                ([fast * normal, fast], [slow * normal, slow], [rate, 0.0])
            }
            Self::Force { slow, fast, most, rate } => {
                let (slow, fast) = (power(slow, most, normal), power(fast, most, normal));
                let pace = rate[0] + normal * (rate[1] + normal * rate[2]);
                (fast.into(), slow.into(), [pace, rate[1] + 2.0 * normal * rate[2]])
            }
            Self::Pressure { slow, fast, rate, drop, per_force } => {
                let tanh = (per_force * normal).tanh();
                let mu = fast - drop * tanh;
                let by_normal = -drop * per_force * (1.0 - tanh * tanh);
                ([mu * normal, mu + normal * by_normal], [slow * normal, slow], [rate, 0.0])
            }
        };
        let more = away.map_or([0.0; 2], |away| {
            let more = away.mu * normal - slow[0];
            if more > 0.0 { [more, away.mu - slow[1]] } else { [0.0; 2] }
        });
        Cone {
            fast,
            less: [fast[0] - slow[0], fast[1] - slow[1]],
            pace,
            more,
            over: away.map_or(0.0, |away| away.over),
        }
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
                let (slow, slow_n) = power(slow, most, normal);
                let (fast, fast_n) = power(fast, most, normal);
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

/// min(a Nⁿ, μ_max N) and its derivative by N.
fn power((a, n): (f64, f64), most: f64, normal: f64) -> (f64, f64) {
    let force = a * normal.powf(n);
    if force > most * normal { (most * normal, most) } else { (force, n * force / normal) }
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

//! The law of Bouc and Wen in a plane over a straight step.
//!
//! ```text
//!   dz/du = ω − z |z|^(η−2) Σⱼ zⱼ ωⱼ (γ + β sⱼ),   0 ≤ u ≤ 1
//!   by axes:       sⱼ = sgn(zⱼ ωⱼ)            by direction:  sⱼ = sgn(z·ω)
//! ```
//!
//! By Runge-Kutta's method of order 4 with derivatives by ω, in steps of a small part of the yield deformation. What the
//! signs multiply is zero where they change, so no step is cut there. After [`SETTLED`] yield deformations in
//! one direction z has come to rest. |z| stays within (β + γ)^(−1/η), whatever the direction.

use crate::shared::biaxial::{self, Moved};
use crate::shared::dual::Dual;
use serde::Deserialize;
use trilith_element::dimension::NONE;
use trilith_element::{Parameter, ParameterError, Range};

/// |z|² below which nothing is held back: its powers would leave the range of numbers.
const NOTHING: f64 = 1e-100;

/// Length of a motion after which z has come to rest, in limits of z.
const SETTLED: f64 = 38.0;

/// How a bearing tells unloading in its plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum Coupling {
    /// Axis by axis, by the signs of zⱼ ḋⱼ.
    Axes,
    /// By the sign of z·ḋ.
    Direction,
}

/// The card's parameters of the coupling.
pub(crate) const PARAMETERS: [Parameter; 4] = [
    Parameter::choice(
        "coupling",
        &["Axes", "Direction"],
        "Axes",
        "how unloading is told: axis by axis, or by the direction of the motion",
    ),
    Parameter::number(
        "beta",
        "β",
        NONE,
        Range::Positive,
        0.5,
        "shape: loading against β + γ, return with γ − β",
    ),
    Parameter::number(
        "gamma",
        "γ",
        NONE,
        Range::Any,
        0.5,
        "shape, −β < γ ≤ β; at γ = β the return is elastic",
    ),
    Parameter::number("eta", "η", NONE, Range::Within(1.0, 20.0), 2.0, "sharpness of yielding"),
];

const ZERO: Dual = Dual { x: 0.0, by: [0.0; 2] };

/// Numbers of the law: −β < γ ≤ β, η ≥ 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// Unloading is told by the direction of the motion instead of axis by axis.
    pub(crate) by_direction: bool,
    pub(crate) beta: f64,
    pub(crate) gamma: f64,
    pub(crate) eta: f64,
}

/// z and ∫ zᵢ (ωᵢ − zᵢ') du.
#[derive(Clone, Copy, Debug)]
struct State {
    z: [Dual; 2],
    loss: [Dual; 2],
}

impl State {
    fn plus(&self, rate: &Self, h: Dual) -> Self {
        Self {
            z: [0, 1].map(|i| self.z[i] + rate.z[i] * h),
            loss: [0, 1].map(|i| self.loss[i] + rate.loss[i] * h),
        }
    }
}

/// (a + 2b + 2c + d)/6.
fn mean(a: Dual, b: Dual, c: Dual, d: Dual) -> Dual {
    (a + (b + c) * 2.0 + d) * (1.0 / 6.0)
}

impl Shape {
    /// The law of Park, Wen and Ang, which has a closed form.
    fn is_closed(&self) -> bool {
        !self.by_direction && [self.beta, self.gamma, self.eta] == [0.5, 0.5, 2.0]
    }

    /// Refuses numbers that give z no limit, or energy on a return.
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        let Self { beta, gamma, .. } = *self;
        if beta + gamma <= 0.0 {
            let message = format!(
                "β + γ = {} gives z no limit: `gamma` must lie above −`beta` = {}",
                beta + gamma,
                -beta
            );
            return Err(ParameterError::inconsistent("gamma", message));
        }
        if gamma > beta {
            let message = format!(
                "γ = {gamma} above β = {beta} would give energy on a return: `gamma` must be at most `beta`"
            );
            return Err(ParameterError::inconsistent("gamma", message));
        }
        Ok(())
    }

    /// What |z| comes to in the end.
    pub(crate) fn limit(&self) -> f64 {
        (self.beta + self.gamma).powf(-1.0 / self.eta)
    }

    /// Steps for the length of one limit.
    fn density(&self) -> f64 {
        16.0 + 4.0 * self.eta
    }

    /// |z|^(η−2), 0 where z is: it stands with two factors of z.
    fn power(&self, z: [Dual; 2]) -> Dual {
        let square = z[0] * z[0] + z[1] * z[1];
        let half = 0.5 * self.eta - 1.0;
        if half == 0.0 {
            return Dual::constant(1.0);
        }
        if square.x <= NOTHING {
            return ZERO;
        }
        let x = square.x.powf(half);
        square.map(x, half * x / square.x)
    }

    /// γ + β sⱼ for zⱼ ωⱼ; where nothing moves, that of unloading.
    fn shares(&self, along: [f64; 2]) -> [f64; 2] {
        let share = |x: f64| self.gamma + if x > 0.0 { self.beta } else { -self.beta };
        if self.by_direction { [share(along[0] + along[1]); 2] } else { along.map(share) }
    }

    /// dz/du and the loss.
    fn rate(&self, z: [Dual; 2], omega: [Dual; 2]) -> State {
        let along = [z[0] * omega[0], z[1] * omega[1]];
        let shares = self.shares(along.map(|a| a.x));
        let held = self.power(z) * (along[0] * shares[0] + along[1] * shares[1]);
        State {
            z: [0, 1].map(|i| omega[i] - z[i] * held),
            loss: [0, 1].map(|i| z[i] * z[i] * held),
        }
    }

    /// One step of order 4.
    fn step(&self, at: &State, omega: [Dual; 2], h: Dual) -> State {
        let a = self.rate(at.z, omega);
        let b = self.rate(at.plus(&a, h * 0.5).z, omega);
        let c = self.rate(at.plus(&b, h * 0.5).z, omega);
        let d = self.rate(at.plus(&c, h).z, omega);
        let weighted = State {
            z: [0, 1].map(|i| mean(a.z[i], b.z[i], c.z[i], d.z[i])),
            loss: [0, 1].map(|i| mean(a.loss[i], b.loss[i], c.loss[i], d.loss[i])),
        };
        at.plus(&weighted, h)
    }

    /// z after a step; `rate` has the direction of the motion where ω is zero.
    pub(crate) fn advance(&self, z: [f64; 2], omega: [f64; 2], rate: [f64; 2]) -> Moved {
        let length = omega[0].hypot(omega[1]);
        if length == 0.0 {
            let shares = self.shares([z[0] * rate[0], z[1] * rate[1]]);
            let power = self.power(z.map(Dual::constant)).x;
            let slope = |i: usize, j: usize| f64::from(i == j) - z[i] * z[j] * shares[j] * power;
            let at = |i: usize| Dual { x: z[i], by: [slope(i, 0), slope(i, 1)] };
            return Moved { z: [at(0), at(1)], loss: [ZERO; 2] };
        }
        let omega = [0, 1].map(|j| Dual::variable(omega[j], j));
        let (limit, most) = (self.limit(), SETTLED * self.limit());
        // Only the length that still turns z.
        let settled = length > most;
        let part = if settled {
            let unit = omega.map(|o| o * (1.0 / length));
            let size = (unit[0] * unit[0] + unit[1] * unit[1]).sqrt();
            unit.map(|o| o / size * most)
        } else {
            omega
        };
        // Steps of one length and what is left, so that nothing jumps where one more is taken.
        let short = limit / self.density();
        let count = (length.min(most) / short).floor();
        let mut at = State { z: z.map(Dual::constant), loss: [ZERO; 2] };
        let mut left = Dual::constant(1.0);
        if count > 0.0 {
            let h = Dual::constant(short) / (part[0] * part[0] + part[1] * part[1]).sqrt();
            for _ in 0..count as usize {
                at = self.step(&at, part, h);
            }
            left = left - h * count;
        }
        at = self.step(&at, part, left);
        if settled {
            let (whole, before) = (self.rate(at.z, omega).loss, self.rate(at.z, part).loss);
            at.loss = [0, 1].map(|i| at.loss[i] + whole[i] - before[i]);
        }
        Moved { z: at.z, loss: at.loss }
    }
}

/// The law with β, γ and η; the one of Park, Wen and Ang, by axes with ½, ½ and 2, in closed form.
pub(crate) fn advance(shape: &Shape, z: [f64; 2], omega: [f64; 2], rate: [f64; 2]) -> Moved {
    if shape.is_closed() {
        return biaxial::advance(z, omega, rate);
    }
    shape.advance(z, omega, rate)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const SHAPES: [Shape; 5] = [
        Shape { by_direction: true, beta: 0.5, gamma: 0.5, eta: 1.0 },
        Shape { by_direction: true, beta: 0.5, gamma: 0.5, eta: 2.0 },
        Shape { by_direction: false, beta: 0.9, gamma: 0.1, eta: 2.0 },
        Shape { by_direction: true, beta: 0.7, gamma: -0.2, eta: 2.0 },
        Shape { by_direction: true, beta: 0.6, gamma: 0.4, eta: 5.0 },
    ];
    const STARTS: [[f64; 2]; 5] = [[0.0, 0.0], [0.5, -0.3], [-0.6, -0.4], [0.6, 0.7], [0.0, -1.0]];
    const STEPS: [[f64; 2]; 6] =
        [[0.3, 0.2], [2.0, -3.0], [0.0, 1.5], [-1.0, 0.0], [-8.0, 5.0], [1e-5, -1e-6]];

    /// By many small steps of the equation as it stands.
    fn integrated(shape: &Shape, z0: [f64; 2], omega: [f64; 2], steps: u32) -> [f64; 4] {
        let rate = |s: [f64; 4]| {
            let along = [s[0] * omega[0], s[1] * omega[1]];
            let size = s[0].hypot(s[1]);
            let sign = |x: f64| if x > 0.0 { shape.beta } else { -shape.beta };
            let told = |x: f64| if shape.by_direction { along[0] + along[1] } else { x };
            let sum: f64 = along.iter().map(|x| x * (shape.gamma + sign(told(*x)))).sum();
            let held = if size > 0.0 { size.powf(shape.eta - 2.0) * sum } else { 0.0 };
            [omega[0] - s[0] * held, omega[1] - s[1] * held, s[0] * s[0] * held, s[1] * s[1] * held]
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

    #[test]
    fn follows_the_differential_equation() {
        for shape in SHAPES {
            for z0 in STARTS {
                for omega in STEPS {
                    let moved = shape.advance(z0, omega, omega);
                    let s = integrated(&shape, z0, omega, 20_000);
                    for i in 0..2 {
                        assert_relative_eq!(moved.z[i].x, s[i], epsilon = 2e-4);
                        assert_relative_eq!(moved.loss[i].x, s[2 + i], epsilon = 2e-4);
                        assert!(moved.loss[i].x >= -1e-12, "{shape:?} {z0:?} {omega:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_closed_form_is_that_of_the_same_numbers() {
        let shape = Shape { by_direction: false, beta: 0.5, gamma: 0.5, eta: 2.0 };
        for z0 in STARTS {
            for omega in STEPS {
                let (one, two) =
                    (shape.advance(z0, omega, omega), advance(&shape, z0, omega, omega));
                for i in 0..2 {
                    assert_relative_eq!(one.z[i].x, two.z[i].x, epsilon = 2e-4);
                    assert_relative_eq!(one.loss[i].x, two.loss[i].x, epsilon = 2e-4);
                }
            }
        }
    }

    #[test]
    fn stays_within_its_limit_for_any_step() {
        for shape in SHAPES {
            for size in [1e-300, 1e-12, 1.0, 1e3, 1e12] {
                for omega in STEPS {
                    let moved = shape.advance([0.3, -0.4], omega.map(|w| w * size), omega);
                    let length = moved.z[0].x.hypot(moved.z[1].x);
                    assert!(length <= shape.limit() * (1.0 + 1e-9), "{shape:?} {length}");
                    let finite = |d: &Dual| d.x.is_finite() && d.by.iter().all(|x| x.is_finite());
                    assert!(
                        moved.z.iter().chain(&moved.loss).all(finite),
                        "{shape:?} {omega:?} {size}"
                    );
                }
            }
        }
    }
}

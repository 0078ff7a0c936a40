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
use crate::shared::dual::{Dual, by_fewer};
use serde::Deserialize;
use trilith_element::lanes::Real;
use trilith_element::{Choices, ParameterError};

/// |z|² below which nothing is held back: its powers would leave the range of numbers.
const NOTHING: f64 = 1e-100;

/// Length of a motion after which z has come to rest, in limits of z.
const SETTLED: f64 = 38.0;

/// Steps at most: those of the sharpest yielding.
const STEPS: i32 = 4000;

/// How a bearing tells unloading in its plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Coupling {
    /// Axis by axis, by the signs of zⱼ ḋⱼ.
    Axes,
    /// By the sign of z·ḋ.
    Direction,
}

/// Numbers of the law: −β < γ ≤ β, η ≥ 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    /// Unloading is told by the direction of the motion instead of axis by axis.
    pub(crate) by_direction: bool,
    pub(crate) beta: f64,
    pub(crate) gamma: f64,
    pub(crate) eta: f64,
}

impl Shape {
    /// The law of Park, Wen and Ang, by axes with ½, ½ and 2, which has a closed form.
    pub(crate) fn is_closed(&self) -> bool {
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

    /// Numbers of the law: 0 by axes, 1 by direction; β, γ, η, limit of z.
    pub(crate) fn numbers(&self) -> [f64; NUMBERS] {
        let how = f64::from(u8::from(self.by_direction));
        [how, self.beta, self.gamma, self.eta, self.limit()]
    }
}

/// How many numbers a shape is.
pub(crate) const NUMBERS: usize = 5;

/// A number with its derivatives by ω.
type Two<R> = Dual<2, R>;

/// A shape over lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shaped<R: Real> {
    by_direction: R::Mask,
    beta: R,
    gamma: R,
    /// ½ η − 1.
    half: R,
    limit: R,
    /// Steps for the length of one limit.
    density: R,
}

/// z and ∫ zᵢ (ωᵢ − zᵢ') du.
#[derive(Clone, Copy, Debug)]
struct State<const N: usize, R> {
    z: [Two<R>; 2],
    loss: [Dual<N, R>; 2],
}

impl<const N: usize, R: Real> State<N, R> {
    #[inline(always)]
    fn plus(&self, rate: &Self, h: Two<R>) -> Self {
        let mut it = *self;
        for i in 0..2 {
            it.z[i] = self.z[i] + rate.z[i] * h;
            it.loss[i] = self.loss[i] + rate.loss[i] * by_fewer(h);
        }
        it
    }

    #[inline(always)]
    fn select(mask: R::Mask, yes: &Self, no: &Self) -> Self {
        let mut it = *yes;
        for i in 0..2 {
            it.z[i] = Dual::select(mask, yes.z[i], no.z[i]);
            it.loss[i] = Dual::select(mask, yes.loss[i], no.loss[i]);
        }
        it
    }
}

/// (a + 2b + 2c + d)/6.
#[inline(always)]
fn mean<const N: usize, R: Real>(
    a: Dual<N, R>,
    b: Dual<N, R>,
    c: Dual<N, R>,
    d: Dual<N, R>,
) -> Dual<N, R> {
    (a + (b + c) * a.x.of(2.0) + d) * a.x.of(1.0 / 6.0)
}

impl<R: Real> Shaped<R> {
    #[inline(always)]
    pub(crate) fn of(numbers: &[R]) -> Self {
        let [how, beta, gamma, eta, limit] = [0, 1, 2, 3, 4].map(|i| numbers[i]);
        let (half, one) = (how.of(0.5), how.of(1.0));
        Self {
            by_direction: half.lt(how),
            beta,
            gamma,
            half: half * eta - one,
            limit,
            density: how.of(16.0) + how.of(4.0) * eta,
        }
    }

    /// |z|^(η−2), 0 where z is: it stands with two factors of z.
    #[inline(always)]
    fn power(&self, z: [Two<R>; 2]) -> Two<R> {
        let (zero, one) = (self.half.of(0.0), self.half.of(1.0));
        let uneven = zero.lt(self.half.abs());
        let none = Dual::constant(one);
        if !zero.any(uneven) {
            return none;
        }
        let square = z[0] * z[0] + z[1] * z[1];
        let x = square.x.powf(self.half);
        let power = square.map(x, self.half * x / square.x);
        let power = power.only(zero.of(NOTHING).lt(square.x));
        Dual::select(uneven, power, none)
    }

    /// γ + β sⱼ for zⱼ ωⱼ; where nothing moves, that of unloading.
    #[inline(always)]
    fn shares(&self, along: [R; 2]) -> [R; 2] {
        let (zero, both) = (along[0].of(0.0), along[0] + along[1]);
        let mut shares = along;
        for j in 0..2 {
            let told = R::select(self.by_direction, both, along[j]);
            shares[j] = self.gamma + R::select(zero.lt(told), self.beta, -self.beta);
        }
        shares
    }

    /// dz/du and the loss.
    #[inline(always)]
    fn rate<const N: usize>(&self, z: [Two<R>; 2], omega: [Two<R>; 2]) -> State<N, R> {
        let along = [z[0] * omega[0], z[1] * omega[1]];
        let shares = self.shares([along[0].x, along[1].x]);
        let held = self.power(z) * (along[0] * shares[0] + along[1] * shares[1]);
        State {
            z: [omega[0] - z[0] * held, omega[1] - z[1] * held],
            loss: [by_fewer(z[0] * z[0] * held), by_fewer(z[1] * z[1] * held)],
        }
    }

    /// One step of order 4.
    #[inline(always)]
    fn step<const N: usize>(&self, at: &State<N, R>, omega: [Two<R>; 2], h: Two<R>) -> State<N, R> {
        let half = h * h.x.of(0.5);
        let a = self.rate(at.z, omega);
        let b = self.rate(at.plus(&a, half).z, omega);
        let c = self.rate(at.plus(&b, half).z, omega);
        let d = self.rate(at.plus(&c, h).z, omega);
        let mut weighted = a;
        for i in 0..2 {
            weighted.z[i] = mean(a.z[i], b.z[i], c.z[i], d.z[i]);
            weighted.loss[i] = mean(a.loss[i], b.loss[i], c.loss[i], d.loss[i]);
        }
        at.plus(&weighted, h)
    }

    /// z after a step, by steps of the differential equation.
    #[inline(always)]
    fn integrated<const N: usize>(&self, z: [R; 2], omega: [R; 2], rate: [R; 2]) -> Moved<N, R> {
        let (zero, one) = (z[0].of(0.0), z[0].of(1.0));
        let length = omega[0].map2(omega[1], f64::hypot);
        let moves = !length.le(zero);
        let shares = self.shares([z[0] * rate[0], z[1] * rate[1]]);
        let power = self.power([Dual::constant(z[0]), Dual::constant(z[1])]).x;
        let mut still = [Dual::constant(z[0]), Dual::constant(z[1])];
        for i in 0..2 {
            for j in 0..2 {
                let own = zero.of(f64::from(u8::from(i == j)));
                still[i].by[j] = own - z[i] * z[j] * shares[j] * power;
            }
        }
        let nothing = Dual::constant(zero);
        if !zero.any(moves) {
            return Moved { z: still, loss: [nothing; 2] };
        }
        let omega = [Dual::variable(omega[0], 0), Dual::variable(omega[1], 1)];
        let most = self.limit * zero.of(SETTLED);
        // Only the length that still turns z.
        let settled = most.lt(length);
        let mut part = omega;
        if zero.any(settled) {
            let unit = [omega[0] * (one / length), omega[1] * (one / length)];
            let size = (unit[0] * unit[0] + unit[1] * unit[1]).sqrt();
            for j in 0..2 {
                part[j] = Dual::select(settled, unit[j] / size * most, omega[j]);
            }
        }
        // Steps of one length and what is left, so that nothing jumps where one more is taken.
        let short = self.limit / self.density;
        let whole = length.min(most) / short;
        let mut at = State { z: [Dual::constant(z[0]), Dual::constant(z[1])], loss: [nothing; 2] };
        let (all, mut count) = (Dual::constant(one), zero);
        let h = Dual::constant(short) / (part[0] * part[0] + part[1] * part[1]).sqrt();
        let mut open = moves;
        for i in 1..=STEPS {
            let full = zero.of(f64::from(i)).le(whole);
            let left = Dual::select(zero.lt(count), all - h * count, all);
            let next = self.step(&at, part, Dual::select(full, h, left));
            at = State::select(open, &next, &at);
            count = R::select(full, zero.of(f64::from(i)), count);
            open = open & full;
            if !zero.any(open) {
                break;
            }
        }
        if zero.any(settled) {
            let (whole, before) =
                (self.rate::<N>(at.z, omega).loss, self.rate::<N>(at.z, part).loss);
            for i in 0..2 {
                let all = at.loss[i] + whole[i] - before[i];
                at.loss[i] = Dual::select(settled, all, at.loss[i]);
            }
        }
        Moved {
            z: [Dual::select(moves, at.z[0], still[0]), Dual::select(moves, at.z[1], still[1])],
            loss: [at.loss[0].only(moves), at.loss[1].only(moves)],
        }
    }

    /// z after a step, with `N` derivatives of the loss, of which 2 there are. `CLOSED`: the law of Park, Wen and Ang in its closed
    /// form, else with β, γ and η by steps. `rate` has the direction of the motion where ω is zero.
    #[inline(always)]
    pub(crate) fn advance<const N: usize, const CLOSED: bool>(
        &self,
        z: [R; 2],
        omega: [R; 2],
        rate: [R; 2],
    ) -> Moved<N, R> {
        if CLOSED {
            return biaxial::advance(z, omega, rate);
        }
        self.integrated(z, omega, rate)
    }
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

    impl Shape {
        fn integrated(&self, z: [f64; 2], omega: [f64; 2]) -> Moved<2> {
            Shaped::of(&self.numbers()).integrated(z, omega, omega)
        }
    }

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
                    let moved = shape.integrated(z0, omega);
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
                let one = shape.integrated(z0, omega);
                let shaped = Shaped::of(&shape.numbers());
                let two = shaped.advance::<2, true>(z0, omega, omega);
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
                    let moved = shape.integrated([0.3, -0.4], omega.map(|w| w * size));
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

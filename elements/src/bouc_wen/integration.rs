//! z and the work ε over a straight step u = Δd/d_y > 0 towards the side of the motion, with their
//! derivatives by u.
//!
//! ```text
//!   motion towards z = 0:   dz/du = −(A + ν (β − γ) |z|ⁿ)/η,   dε/du = −|z|      elastic return, never stiff
//!   away from it:           dz/du =  (A − ν (β + γ) |z|ⁿ)/η,   dε/du =  |z|      stiff where z has come to its limit
//! ```
//!
//! The return is integrated over z instead of u (Runge-Kutta of order 4, [`RETURNS`] steps), so that the way
//! to z = 0 follows from the committed state alone and the law of the other side starts exactly there. What is
//! left of the step goes through [`STEPS`] steps of the singly diagonally implicit method of order 4 of
//! Hairer & Wanner (L-stable, five stages), whose ends are w sinh(i/N arsinh(u/w)): even for a small u,
//! geometric for a large one, and smooth in u. Each stage is one equation for z; it rises with a slope of at
//! least 1, which brackets its only root.

use super::BoucWen;
use crate::shared::dual::Dual;

/// Steps of the return to z = 0.
const RETURNS: usize = 8;
/// Steps away from z = 0.
pub(super) const STEPS: usize = 8;
/// Length below which they are even.
const EVEN: f64 = 2.0;

/// Last change of Newton's method, relative; what it leaves is the square of that.
const ROUGH: f64 = 1e-10;

const STAGES: usize = 5;
/// Diagonal of the method.
const DIAGONAL: f64 = 0.25;
/// Below the diagonal; the last row is the result.
const METHOD: [[f64; STAGES - 1]; STAGES] = [
    [0.0; 4],
    [1.0 / 2.0, 0.0, 0.0, 0.0],
    [17.0 / 50.0, -1.0 / 25.0, 0.0, 0.0],
    [371.0 / 1360.0, -137.0 / 2720.0, 15.0 / 544.0, 0.0],
    [25.0 / 24.0, -49.0 / 48.0, 125.0 / 16.0, -85.0 / 12.0],
];

/// Size of z and work ε, with their derivatives by the length of the step first of the two.
#[derive(Clone, Copy, Debug)]
struct State {
    z: Dual,
    work: Dual,
}

/// What became of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    pub(super) z: f64,
    /// dz/du.
    pub(super) slope: f64,
    pub(super) work: f64,
}

/// z and ε after a step `u`; `rate` has the sign of the motion where `u` is zero.
pub(super) fn advance(law: &BoucWen, z0: f64, work: f64, u: f64, rate: f64, steps: usize) -> End {
    let sign = if u == 0.0 { rate } else { u };
    let returning = sign == 0.0 || z0 * sign < 0.0;
    let length = Dual::variable(u.abs(), 0);
    let end = if returning && z0 != 0.0 {
        let (whole, left) = law.back(z0.abs(), work, Dual::constant(0.0));
        if length.x < whole.x {
            let mut it = law.part_of_return(z0.abs(), work, length, whole.x);
            it.z = -it.z;
            it
        } else {
            law.away(0.0, left.x, length + -whole.x, steps)
        }
    } else {
        law.away(z0.abs(), work, length, steps)
    };
    // Seen from the side the motion goes to; at rest, from the side opposite to z.
    let side = if sign == 0.0 { -1.0_f64.copysign(z0) } else { 1.0_f64.copysign(sign) };
    // z changes its sign with the side, its derivative by u does not.
    End { z: end.z.x * side, slope: end.z.by[0], work: end.work.x }
}

/// sⁿ, 0 below zero.
fn power(s: Dual, n: f64) -> Dual {
    if s.x > 0.0 {
        let x = s.x.powf(n);
        s.map(x, n * x / s.x)
    } else {
        s.map(0.0, if s.x == 0.0 && n == 1.0 { 1.0 } else { 0.0 })
    }
}

impl BoucWen {
    /// A, ν and η after a work.
    fn degraded(&self, work: Dual) -> [Dual; 3] {
        let least = super::LEAST * self.a0;
        let a = work * -self.delta_a + self.a0;
        let a = if a.x > least { a } else { Dual::constant(least) };
        [a, work * self.delta_nu + 1.0, work * self.delta_eta + 1.0]
    }

    /// du/dz on the return.
    fn flexibility(&self, s: Dual, work: Dual) -> Dual {
        let [a, nu, eta] = self.degraded(work);
        eta / (a + nu * power(s, self.n) * (self.beta - self.gamma))
    }

    /// Length u and work ε of the return from `s0` to `s1`.
    fn back(&self, s0: f64, work: f64, s1: Dual) -> (Dual, Dual) {
        let h = (-s1 + s0) * (1.0 / RETURNS as f64);
        let (mut u, mut e) = (Dual::constant(0.0), Dual::constant(work));
        for i in 0..RETURNS {
            let s = -(h * i as f64) + s0;
            let (half, end) = (s - h * 0.5, s - h);
            let slope = |s: Dual, e: Dual| {
                let f = self.flexibility(s, e);
                (f, -(s * f))
            };
            let a = slope(s, e);
            let b = slope(half, e + h * 0.5 * a.1);
            let c = slope(half, e + h * 0.5 * b.1);
            let d = slope(end, e + h * c.1);
            let mean = |a, b, c, d: Dual| (a + (b + c) * 2.0 + d) * (1.0 / 6.0) * h;
            u = u + mean(a.0, b.0, c.0, d.0);
            e = e + mean(a.1, b.1, c.1, d.1);
        }
        (u, e)
    }

    /// Where a return of this length ends; `whole` is the length to z = 0.
    fn part_of_return(&self, s0: f64, work: f64, length: Dual, whole: f64) -> State {
        let (mut low, mut high) = (0.0, s0);
        let mut s = s0 * (1.0 - length.x / whole);
        for _ in 0..60 {
            let (u, _) = self.back(s0, work, Dual::variable(s, 0));
            let error = u.x - length.x;
            if error > 0.0 {
                low = s;
            } else {
                high = s;
            }
            let newton = s - error / u.by[0];
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            let change = (next - s).abs();
            s = next;
            if change <= ROUGH * s0 {
                break;
            }
        }
        let (u, e) = self.back(s0, work, Dual::variable(s, 0));
        let z = length.map(s, 1.0 / u.by[0]);
        State { z, work: z.map(e.x, e.by[0]) }
    }

    /// From `s0` ≥ 0 onwards.
    fn away(&self, s0: f64, work: f64, length: Dual, steps: usize) -> State {
        let mut at = State { z: Dual::constant(s0), work: Dual::constant(work) };
        let reach = length.x / EVEN;
        let spread = reach.asinh();
        let end = |i: usize| {
            let part = i as f64 / steps as f64;
            let slope = part * (part * spread).cosh() / (1.0 + reach * reach).sqrt();
            length.map(EVEN * (part * spread).sinh(), slope)
        };
        for i in 0..steps {
            at = self.step_away(at, end(i + 1) - end(i));
        }
        at
    }

    /// One step of the diagonally implicit method.
    fn step_away(&self, at: State, h: Dual) -> State {
        let mut rates = [State { z: Dual::constant(0.0), work: Dual::constant(0.0) }; STAGES];
        let mut stage = at;
        for (i, row) in METHOD.iter().enumerate() {
            let mut base = at;
            for (rate, a) in rates[..i].iter().zip(row) {
                base.z = base.z + h * rate.z * *a;
                base.work = base.work + h * rate.work * *a;
            }
            let z = self.stage(base, at.work.x, h * DIAGONAL);
            stage = State { z, work: base.work + h * DIAGONAL * z };
            rates[i] = State { z: self.rate(z, stage.work, at.work.x), work: z };
        }
        // Rounding apart, z stays on its side and the work grows.
        stage.z.x = stage.z.x.max(0.0);
        stage.work.x = stage.work.x.max(at.work.x);
        stage
    }

    /// dz/du away from zero. The work of a stage counts from that of the start of the step at least.
    fn rate(&self, z: Dual, work: Dual, least: f64) -> Dual {
        let work = if work.x < least { Dual::constant(least) } else { work };
        let [a, nu, eta] = self.degraded(work);
        (a - nu * power(z, self.n) * (self.beta + self.gamma)) / eta
    }

    /// z of a stage: z = base + h dz/du(z, ε + h z).
    fn stage(&self, base: State, least: f64, h: Dual) -> Dual {
        let residual = |z: f64| {
            let it = Dual::variable(z, 0);
            let work = it * h.x + base.work.x;
            it - self.rate(it, work, least) * h.x + -base.z.x
        };
        let [a, nu, _] = self.degraded(Dual::constant(least));
        let limit = (a.x / (nu.x * (self.beta + self.gamma))).powf(1.0 / self.n);
        let mut z = base.z.x.clamp(0.0, limit);
        let mut g = residual(z);
        let (mut low, mut high) = (z.min(z - g.x), z.max(z - g.x));
        let mut last = f64::INFINITY;
        for _ in 0..80 {
            let newton = z - g.x / g.by[0];
            // Far above the limit zⁿ makes Newton's steps short; where they do not shrink, halving is faster.
            let good = newton >= low && newton <= high && (newton - z).abs() <= 0.5 * last;
            let next = if good { newton } else { 0.5 * (low + high) };
            last = (next - z).abs();
            z = next;
            g = residual(z);
            if last <= ROUGH * z.abs() || g.x == 0.0 {
                break;
            }
            if g.x > 0.0 {
                high = z;
            } else {
                low = z;
            }
        }
        // Derivatives of the root by those of base and h.
        let it = Dual::constant(z);
        let rate = self.rate(it, base.work + h * z, least);
        let open = it - base.z - h * rate;
        Dual { x: z, by: open.by.map(|d| -d / g.by[0]) }
    }
}

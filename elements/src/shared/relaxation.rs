//! A spring in series with a linear dashpot (Maxwell element) over one step, in closed form.
//!
//! ```text
//!   ḟ = k ḋ(t) − f/τ,    ḋ(s) = Δd/Δt + (v₁ − v₀)(s − ½),   s = t/Δt in 0 … 1,   x = Δt/τ
//!   f(s) = e^(−xs) f₀ + k Δt [(Δd/Δt − Δv/2) s φ₁(xs) + Δv s² φ₂(xs)]
//!   φ₁(y) = (1 − e^(−y))/y,   φ₂(y) = (1 − φ₁(y))/y
//! ```
//!
//! The rate is linear in the step and moves the deformation from d₀ to d. Without time (Δt = 0) the
//! dashpot follows whatever the deformation does, and the force stays.

use trilith_element::lanes::{LaneAt, Real};

/// Force at the end of a step, its derivatives, and the energy that the dashpot took in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Followed<R> {
    /// Force, N.
    pub f: R,
    /// ∂f/∂d, N/m.
    pub f_d: R,
    /// ∂f/∂ḋ, N·s/m.
    pub f_v: R,
    /// Energy turned into heat in the step, J, ≥ 0.
    pub viscous: R,
}

impl<R: Real> Followed<R> {
    /// The same, but that a step without time leaves the force as it was.
    #[inline(always)]
    pub(crate) fn where_time_goes_on(self, at: &LaneAt<'_, R>, before: R) -> Self {
        let goes_on = before.of(0.0).lt(at.dt);
        Self {
            f: R::select(goes_on, self.f, before),
            f_d: self.f_d.only(goes_on),
            f_v: self.f_v.only(goes_on),
            viscous: self.viscous.only(goes_on),
        }
    }
}

/// The step, s; where no time goes on, one that nothing is divided by zero for.
#[inline(always)]
pub(crate) fn length<R: Real>(at: &LaneAt<'_, R>) -> R {
    R::select(at.dt.of(0.0).lt(at.dt), at.dt, at.dt.of(1.0))
}

/// Mean rate of coordinate 0 over the step, and the change of its rate.
#[inline(always)]
pub(crate) fn rates<R: Real>(at: &LaneAt<'_, R>) -> [R; 2] {
    [(at.d[0] - at.d0[0]) / length(at), at.v[0] - at.v0[0]]
}

/// Spring of stiffness `k` (N/m) in series with a dashpot k τ, from force `f0` on.
#[inline(always)]
pub(crate) fn relax<R: Real>(k: R, tau: R, f0: R, at: &LaneAt<'_, R>) -> Followed<R> {
    let (zero, one, half) = (k.of(0.0), k.of(1.0), k.of(0.5));
    let [mean, change] = rates(at);
    let dt = length(at);
    let (x, first, impulse) = (dt / tau, mean - half * change, k * dt);
    let is_short = x.lt(one);
    let mut mean_square = zero;
    if x.any(is_short) {
        for (s, w) in GAUSS {
            let s = x.of(s);
            let [decay, p1, p2] = decays(x * s);
            let f = decay * f0 + impulse * s * (first * p1 + change * s * p2);
            mean_square = mean_square + x.of(w) * f * f;
        }
    }
    let [decay, p1, p2] = decays(x);
    if x.any(!is_short) {
        // f = A e^(−xs) + B + C s, squared and integrated: no quadrature sees a short relaxation.
        let b = impulse * (first - change / x) / x;
        let c = impulse * change / x;
        let a = f0 - b;
        let two = x.of(2.0);
        let of_a = a * a * (one - decay * decay) / (two * x);
        let of_both = two * a * (b * p1 + c * (one - decay * (one + x)) / (x * x));
        let long = of_a + of_both + b * (b + c) + c * c * x.of(1.0 / 3.0);
        mean_square = R::select(is_short, mean_square, long);
    }
    let end = Followed {
        f: decay * f0 + impulse * (first * p1 + change * p2),
        f_d: k * p1,
        f_v: impulse * (p2 - half * p1),
        viscous: (x * mean_square / k).max(zero),
    };
    end.where_time_goes_on(at, f0)
}

/// e^(−y), φ₁ and φ₂.
#[inline(always)]
fn decays<R: Real>(y: R) -> [R; 3] {
    let (zero, one) = (y.of(0.0), y.of(1.0));
    let [decay, less] = (-y).exp_and_m1();
    let some = zero.lt(y);
    let p1 = R::select(some, -less / R::select(some, y, one), one);
    // The closed form loses its digits here; the next term is y⁵/5040.
    let mut near = one;
    for factor in [1.0 / 6.0, 1.0 / 5.0, 1.0 / 4.0] {
        near = one - y * y.of(factor) * near;
    }
    let near = y.of(0.5) - y * y.of(1.0 / 6.0) * near;
    let far = (one - p1) / R::select(some, y, one);
    [decay, p1, R::select(y.lt(y.of(0.01)), near, far)]
}

/// Points and weights of Gauss-Legendre on 0 … 1, four points.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use trilith_element::Kinematics;

    /// The same by many steps of Runge-Kutta: force and heat.
    fn integrated(k: f64, tau: f64, f0: f64, at: &LaneAt<'_, f64>) -> [f64; 2] {
        let [mean, change] = rates(at);
        let slope =
            |s: f64, f: f64| [k * (mean + change * (s / at.dt - 0.5)) - f / tau, f * f / (k * tau)];
        let n = 20_000;
        let h = at.dt / f64::from(n);
        let [mut f, mut heat] = [f0, 0.0];
        for i in 0..n {
            let t = h * f64::from(i);
            let a = slope(t, f);
            let b = slope(t + 0.5 * h, f + 0.5 * h * a[0]);
            let c = slope(t + 0.5 * h, f + 0.5 * h * b[0]);
            let d = slope(t + h, f + h * c[0]);
            f += h / 6.0 * (a[0] + 2.0 * (b[0] + c[0]) + d[0]);
            heat += h / 6.0 * (a[1] + 2.0 * (b[1] + c[1]) + d[1]);
        }
        [f, heat]
    }

    #[test]
    fn force_and_heat_of_a_step_are_those_of_the_integrated_equation() {
        for tau in [1e-4, 1e-3, 0.0099, 0.0101, 0.1, 10.0] {
            let at = Kinematics::new([&[0.03], &[-0.4]], [&[0.02], &[1.3]], 0.01);
            let at = LaneAt::new(&at, &[], &[]);
            let got = relax(100.0, tau, 0.7, &at);
            let [f, heat] = integrated(100.0, tau, 0.7, &at);
            assert_relative_eq!(got.f, f, max_relative = 1e-9);
            assert_relative_eq!(got.viscous, heat, max_relative = 1e-6);
        }
    }

    #[test]
    fn both_forms_of_the_second_function_meet() {
        assert_relative_eq!(decays(0.01 - 1e-12)[2], decays(0.01)[2], max_relative = 1e-11);
        assert_eq!(decays(0.0), [1.0, 1.0, 0.5]);
    }
}

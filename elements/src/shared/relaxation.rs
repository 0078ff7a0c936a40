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

use trilith_element::Kinematics;

/// Force at the end of a step, its derivatives, and the energy that the dashpot took in it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Followed {
    /// Force, N.
    pub f: f64,
    /// ∂f/∂d, N/m.
    pub f_d: f64,
    /// ∂f/∂ḋ, N·s/m.
    pub f_v: f64,
    /// Energy turned into heat in the step, J, ≥ 0.
    pub viscous: f64,
}

impl Followed {
    /// A force that a step without time leaves as it was.
    pub(crate) fn unchanged(f: f64) -> Self {
        Self { f, ..Self::default() }
    }
}

/// Mean rate of coordinate 0 over the step, and the change of its rate.
pub(crate) fn rates(at: &Kinematics<'_>) -> (f64, f64) {
    ((at.d[0] - at.d0[0]) / at.dt, at.v[0] - at.v0[0])
}

/// Spring of stiffness `k` (N/m) in series with a dashpot k τ, from force `f0` on.
pub(crate) fn relax(k: f64, tau: f64, f0: f64, at: &Kinematics<'_>) -> Followed {
    if at.dt <= 0.0 {
        return Followed::unchanged(f0);
    }
    let (mean, change) = rates(at);
    let (x, first) = (at.dt / tau, mean - 0.5 * change);
    let impulse = k * at.dt;
    let force = |s: f64| {
        let y = x * s;
        (-y).exp() * f0 + impulse * s * (first * phi1(y) + change * s * phi2(y))
    };
    let mean_square = if x < 1.0 {
        GAUSS.iter().map(|(s, w)| w * force(*s).powi(2)).sum()
    } else {
        // f = A e^(−xs) + B + C s, squared and integrated: no quadrature sees a short relaxation.
        let b = impulse * (first - change / x) / x;
        let c = impulse * change / x;
        let a = f0 - b;
        let decay = (-x).exp();
        a * a * (1.0 - decay * decay) / (2.0 * x)
            + 2.0 * a * (b * phi1(x) + c * (1.0 - decay * (1.0 + x)) / (x * x))
            + b * (b + c)
            + c * c / 3.0
    };
    let (p1, p2) = (phi1(x), phi2(x));
    Followed {
        f: force(1.0),
        f_d: k * p1,
        f_v: impulse * (p2 - 0.5 * p1),
        viscous: (x * mean_square / k).max(0.0),
    }
}

fn phi1(y: f64) -> f64 {
    if y == 0.0 { 1.0 } else { -(-y).exp_m1() / y }
}

fn phi2(y: f64) -> f64 {
    if y < 0.01 {
        // The closed form loses its digits here; the next term is y⁵/5040.
        return 0.5 - y / 6.0 * (1.0 - y / 4.0 * (1.0 - y / 5.0 * (1.0 - y / 6.0)));
    }
    (1.0 - phi1(y)) / y
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

    /// The same by many steps of Runge-Kutta: force and heat.
    fn integrated(k: f64, tau: f64, f0: f64, at: &Kinematics<'_>) -> [f64; 2] {
        let (mean, change) = rates(at);
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
            let got = relax(100.0, tau, 0.7, &at);
            let [f, heat] = integrated(100.0, tau, 0.7, &at);
            assert_relative_eq!(got.f, f, max_relative = 1e-9);
            assert_relative_eq!(got.viscous, heat, max_relative = 1e-6);
        }
    }

    #[test]
    fn both_forms_of_the_second_function_meet() {
        assert_relative_eq!(phi2(0.01 - 1e-12), phi2(0.01), max_relative = 1e-11);
        assert_eq!(phi2(0.0), 0.5);
    }
}

//! The closest point of a superellipsoid Σ |xᵢ|^aᵢ = 1 to a point t outside, in the norm Σ xᵢ²/κᵢ.
//!
//! ```text
//!   xᵢ + μᵢ xᵢ^(aᵢ − 1) = tᵢ,   μᵢ = λ κᵢ aᵢ,   Σ xᵢ^aᵢ = 1          for t ≥ 0; signs are put back
//! ```

use trilith_element::lanes::Real;

/// Most turns of a search; a few are the rule.
const TURNS: usize = 100;
/// An upper bound where there is none.
const ENDLESS: f64 = 1e300;
/// What stands for nothing, so that logarithms are finite.
const LEAST: f64 = 1e-200;

/// The point, and its derivatives by t.
pub(super) struct Projected<R: Real> {
    pub x: [R; 3],
    /// ∂xᵢ/∂tⱼ.
    pub by: [[R; 3]; 3],
    /// The point was outside.
    pub yields: R::Mask,
}

/// One coordinate at some λ.
#[derive(Clone, Copy)]
struct Shrunk<R> {
    x: R,
    /// x^(a − 1)
    y: R,
    /// ∂x/∂t
    by_t: R,
    /// ∂x/∂λ
    by_lambda: R,
}

impl<R: Real> Shrunk<R> {
    #[inline(always)]
    fn of(t: R, a: R, kappa: R, lambda: R) -> Self {
        let (one, two) = (t.of(1.0), t.of(2.0));
        let (mu, less) = (lambda * kappa * a, a - one);
        let quadratic = a.le(two) & two.le(a);
        let mut u = (t / (one + mu)).map(f64::ln);
        if t.any(!quadratic) {
            // e^u + μ e^((a − 1) u) = t by the logarithm of both sides, which is convex in u: from above.
            let above = (mu.max(t.of(LEAST)) / t).map(f64::ln);
            let start = t.map(f64::ln).min(-above / less);
            u = R::select(quadratic, u, start);
            for _ in 0..TURNS {
                let (x, y) = (u.map(f64::exp), mu * (less * u).map(f64::exp));
                let sum = x + y;
                let step = sum * (sum / t).map(f64::ln) / (x + less * y);
                u = u - step.only(!quadratic);
                let far = t.of(1e-15) * (one + u.abs());
                if !t.any(far.lt(step.abs()) & !quadratic) {
                    break;
                }
            }
        }
        let x = R::select(quadratic, t / (one + mu), u.map(f64::exp));
        let y = R::select(quadratic, x, (less * u).map(f64::exp));
        let by_t = x / (x + mu * less * y);
        Self { x, y, by_t, by_lambda: -(kappa * a * y * by_t) }
    }
}

impl<R: Real> Projected<R> {
    #[inline(always)]
    pub fn of(t: [R; 3], a: [R; 3], kappa: [R; 3]) -> Self {
        let (zero, one, two) = (t[0].of(0.0), t[0].of(1.0), t[0].of(2.0));
        let size = t.map(|t| t.abs().max(t.of(LEAST)));
        let at = |lambda: R| [0, 1, 2].map(|i| Shrunk::of(size[i], a[i], kappa[i], lambda));
        // Φ and its derivative by λ.
        let surface = |it: &[Shrunk<R>; 3]| {
            let mut phi = (zero, zero);
            for i in 0..3 {
                phi.0 = it[i].x.mul_add(it[i].y, phi.0);
                phi.1 = (a[i] * it[i].y).mul_add(it[i].by_lambda, phi.1);
            }
            phi
        };
        let level = |i: usize| size[i].map2(a[i], |t, a| if a == 2.0 { t * t } else { t.powf(a) });
        let yields = one.lt(level(0) + level(1) + level(2));
        let mut x = t;
        let mut by = [[zero; 3]; 3];
        for (i, row) in by.iter_mut().enumerate() {
            row[i] = one;
        }
        if !one.any(yields) {
            return Self { x, by, yields };
        }
        let mut lambda = zero;
        let (mut low, mut high) = (zero, t[0].of(ENDLESS));
        let mut here = at(lambda);
        let mut phi = surface(&here);
        for _ in 0..TURNS {
            // Newton's method on Φ^(−½) = 1.
            let step = two * phi.0 * (one - phi.0.sqrt()) / phi.1;
            let outside = one.lt(phi.0);
            low = R::select(outside, lambda, low);
            high = R::select(outside, high, lambda);
            let next = lambda + step;
            let within = low.le(next) & next.le(high);
            // λ goes over many powers of ten where an exponent is near 1: halved by its logarithm, or doubled where nothing
            // bounds it yet.
            let halved = R::select(zero.lt(low), (low * high).sqrt(), t[0].of(0.5) * (low + high));
            let free = t[0].of(0.1 * ENDLESS).lt(high);
            let aside = R::select(free, two * lambda + t[0].of(1e-3), halved);
            let next = R::select(within, next, aside);
            let open = t[0].of(4e-16).lt((next - lambda).abs() / next.max(t[0].of(LEAST)));
            lambda = R::select(yields, next, lambda);
            here = at(lambda);
            phi = surface(&here);
            let open = open & t[0].of(1e-15).lt((phi.0 - one).abs()) & yields;
            if !one.any(open) {
                break;
            }
        }
        for i in 0..3 {
            let sign = R::select(t[i].lt(zero), -one, one);
            x[i] = R::select(yields, sign * here[i].x, t[i]);
            for j in 0..3 {
                let other = R::select(t[j].lt(zero), -one, one);
                let along = here[i].by_lambda * (a[j] * here[j].y * here[j].by_t) / phi.1;
                let own = if i == j { here[i].by_t } else { zero };
                by[i][j] = R::select(yields, own - sign * other * along, by[i][j]);
            }
        }
        Self { x, by, yields }
    }
}

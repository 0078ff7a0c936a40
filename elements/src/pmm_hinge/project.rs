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
        // The closed form of an exponent of 2 does not know what another one would do.
        let quadratic = if R::DERIVATIVES { a.lt(a) } else { a.le(two) & two.le(a) };
        let mut x = t / (one + mu);
        let mut y = x;
        if t.any(!quadratic) {
            // e^u + μ e^((a − 1) u) = t by the logarithm of both sides, which is convex in u: from above.
            let above = (mu.max(t.of(LEAST)) / t).ln();
            let mut u = t.ln().min(-above / less);
            let mut open = !quadratic;
            for _ in 0..TURNS {
                let (x, y) = (u.exp_by_vectors(), mu * (less * u).exp_by_vectors());
                let sum = x + y;
                let step = sum * (sum / t).ln() / (x + less * y);
                // What is found stays as it is, whatever its neighbours do.
                u = R::select(open, u - step, u);
                let far = t.of(1e-15) * (one + u.abs());
                open = open & far.lt(step.abs());
                if !t.any(open) {
                    break;
                }
            }
            x = R::select(quadratic, x, u.exp_by_vectors());
            y = R::select(quadratic, y, (less * u).exp_by_vectors());
        }
        let by_t = x / (x + mu * less * y);
        Self { x, y, by_t, by_lambda: -(kappa * a * y * by_t) }
    }
}

/// The point at some λ, and Φ = Σ xᵢ^aᵢ there with its derivative by λ.
#[derive(Clone, Copy)]
struct Level<R> {
    at: [Shrunk<R>; 3],
    phi: R,
    by_lambda: R,
}

impl<R: Real> Level<R> {
    #[inline(always)]
    fn of(size: [R; 3], a: [R; 3], kappa: [R; 3], lambda: R) -> Self {
        let zero = lambda.of(0.0);
        let none = Shrunk { x: zero, y: zero, by_t: zero, by_lambda: zero };
        let mut it = Self { at: [none; 3], phi: zero, by_lambda: zero };
        for i in 0..3 {
            let one = Shrunk::of(size[i], a[i], kappa[i], lambda);
            it.phi = one.x.mul_add(one.y, it.phi);
            it.by_lambda = (a[i] * one.y).mul_add(one.by_lambda, it.by_lambda);
            it.at[i] = one;
        }
        it
    }
}

impl<R: Real> Projected<R> {
    #[inline(always)]
    pub fn of(t: [R; 3], a: [R; 3], kappa: [R; 3]) -> Self {
        let (zero, one, two) = (t[0].of(0.0), t[0].of(1.0), t[0].of(2.0));
        let size = t.map(|t| t.abs().max(t.of(LEAST)));
        let mut sum = zero;
        for i in 0..3 {
            let quadratic = a[i].le(two) & two.le(a[i]);
            let mut level = size[i] * size[i];
            if one.any(!quadratic) {
                // To the last digit as alone: a point that lies on the surface stays there.
                level = R::select(quadratic, level, size[i].map2(a[i], f64::powf));
            }
            sum = sum + level;
        }
        let yields = one.lt(sum);
        let mut x = t;
        let mut by = [[zero; 3]; 3];
        for (i, row) in by.iter_mut().enumerate() {
            row[i] = one;
        }
        if !one.any(yields) {
            return Self { x, by, yields };
        }
        let (mut lambda, mut next) = (zero, zero);
        let (mut low, mut high) = (zero, t[0].of(ENDLESS));
        let mut it = Level::of(size, a, kappa, zero);
        let mut open = yields;
        for turn in 0..=TURNS {
            if turn > 0 {
                // Beside what is found, which stays as it is, the others go on.
                let far = (next - lambda).abs() / next.max(t[0].of(LEAST));
                lambda = R::select(open, next, lambda);
                it = Level::of(size, a, kappa, lambda);
                open = open & t[0].of(4e-16).lt(far) & t[0].of(1e-15).lt((it.phi - one).abs());
            }
            if !one.any(open) {
                break;
            }
            // Newton's method on Φ^(−½) = 1.
            let step = two * it.phi * (one - it.phi.sqrt()) / it.by_lambda;
            let outside = one.lt(it.phi);
            low = R::select(outside, lambda, low);
            high = R::select(outside, high, lambda);
            next = lambda + step;
            let within = low.le(next) & next.le(high);
            // λ goes over many powers of ten where an exponent is near 1: halved by its logarithm, or doubled where nothing
            // bounds it yet.
            let halved = R::select(zero.lt(low), (low * high).sqrt(), t[0].of(0.5) * (low + high));
            let free = t[0].of(0.1 * ENDLESS).lt(high);
            let aside = R::select(free, two * lambda + t[0].of(1e-3), halved);
            next = R::select(within, next, aside);
        }
        let here = it.at;
        for i in 0..3 {
            let sign = R::select(t[i].lt(zero), -one, one);
            x[i] = R::select(yields, sign * here[i].x, t[i]);
            for j in 0..3 {
                let other = R::select(t[j].lt(zero), -one, one);
                let along = here[i].by_lambda * (a[j] * here[j].y * here[j].by_t) / it.by_lambda;
                let own = if i == j { here[i].by_t } else { zero };
                by[i][j] = R::select(yields, own - sign * other * along, by[i][j]);
            }
        }
        Self { x, by, yields }
    }
}

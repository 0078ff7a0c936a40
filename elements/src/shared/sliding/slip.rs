//! How far a contact slips in a step, where its friction looks at the slip: at its rate, and at its length since
//! the contact last stuck.
//!
//! ```text
//!   L(x, s) = F − A e^(−r x) + B (1 − s/D)⁺     largest friction; x: slip rate, s: slip since it last stuck
//!   T − k p = L(x₀ + w p, s₀ + p)               p: slip of the step; T: force if nothing slipped, k: its stiffness
//! ```
//!
//! D is at least 2 B/kₛ: a force that fell faster than the spring behind it follows would have no unique slip. Then
//! the left side less the right falls with p, and there is one p. Where A > 0 it is found by Newton's method from below, where
//! the difference is convex, so that no step goes too far. Where A < 0 (friction falls with the rate) the rate x must not look at p,
//! for the same reason: w = 0.

use trilith_element::lanes::Real;

/// The largest friction force at a normal force: each with its derivative by the normal force.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cone<R> {
    /// F, at a high slip rate.
    pub(crate) fast: [R; 2],
    /// A, how much less it is at rest.
    pub(crate) less: [R; 2],
    /// r, s/m.
    pub(crate) pace: [R; 2],
    /// B, how much more it takes to break away.
    pub(crate) more: [R; 2],
    /// Slip D over which that is gone, m.
    pub(crate) over: R,
}

/// A contact that wants to slip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trial<R> {
    /// Force T if it did not slip.
    pub(crate) size: R,
    /// Fall of the force with the slip, k.
    pub(crate) stiffness: R,
    /// Stiffness of the spring kₛ.
    pub(crate) spring: R,
    /// Slip rate x₀ without slip in the step; counts as zero where it is below.
    pub(crate) rate: R,
    /// Slip rate by the slip, w, 1/s; zero where it is known.
    pub(crate) per_slip: R,
    /// Slip since it last stuck, s₀.
    pub(crate) since: R,
}

/// What becomes of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slide<R: Real> {
    pub(crate) sticks: R::Mask,
    /// The friction limit where it ends.
    pub(crate) limit: R,
    /// Slip p of the step.
    pub(crate) slip: R,
    /// Slip rate x.
    pub(crate) rate: R,
    /// Derivatives of the limit, all with the slip of the step adapting: by the normal force, by x₀ and by T.
    pub(crate) by_normal: R,
    pub(crate) by_rate: R,
    pub(crate) by_size: R,
}

/// Steps of Newton's method at most; three are usual.
const MOST_STEPS: usize = 60;

impl<R: Real> Slide<R> {
    #[inline(always)]
    pub(crate) fn of(cone: &Cone<R>, it: &Trial<R>) -> Self {
        let (zero, one) = (it.size.of(0.0), it.size.of(1.0));
        let [fast, less, pace] = [cone.fast[0], cone.less[0], cone.pace[0]];
        let steepest = it.spring * it.size.of(0.5);
        let shortest = cone.more[0] / steepest;
        let short = cone.over.lt(shortest);
        let over = R::select(short, shortest, cone.over);
        let fall = (cone.more[0] / over).only(zero.lt(over));
        let left = (over - it.since).max(zero);

        let from = it.rate.max(zero);
        let held = less * (-(pace * from)).exp();
        let at_once = fast - held + fall * left;
        let sticks = it.size.le(at_once) & zero.lt(at_once);
        let slips = !sticks;

        // Whether what is left of the break-away goes in this step, and the equation of that branch.
        let rated = zero.lt(it.per_slip) & zero.lt(less);
        let at_end = R::select(rated, (it.rate + it.per_slip * left).max(zero), from);
        let by_then = fast - less * (-(pace * at_end)).exp();
        let within = zero.lt(fall * left) & (it.size - it.stiffness * left).le(by_then);
        let stiffness = it.stiffness - fall.only(within);
        let size = it.size - (fall * left).only(within);

        // Slower than any rate that matters, or at a rate that is known.
        let slowest = (size - (fast - less)) / stiffness;
        let creeps = slips & rated & zero.lt(it.rate + it.per_slip * slowest);
        let per_rate = stiffness / it.per_slip;
        let least = it.rate + (size - fast) / per_rate;
        let mut rate = R::select(creeps, from.max(least), from);
        rate = rate.only(creeps | sticks | !rated);
        let mut goes_on = creeps;
        for _ in 0..MOST_STEPS {
            if !zero.any(goes_on) {
                break;
            }
            let held = less * (-(pace * rate)).exp();
            let rest = size - per_rate * (rate - it.rate) - fast + held;
            let step = rest / (per_rate + pace * held);
            let next = rate + step;
            let further = goes_on & rate.lt(next);
            rate = R::select(further, next, rate);
            goes_on = further & (rate * it.size.of(1e-15)).lt(step);
        }

        let faded = (-(pace * rate)).exp();
        let held = less * faded;
        let rubbed = fast - held;
        // With the slip that the branch gives, so that the rest of the break-away follows from it.
        let gone = ((size - rubbed) / stiffness).max(zero).only(slips & within);
        let remaining = R::select(slips, (left - gone).only(within), left);
        let limit = rubbed + fall * remaining;
        let slip = ((it.size - limit) / it.stiffness).max(zero).only(slips);

        // Derivatives at a given slip …
        let share = (remaining / over).only(zero.lt(over));
        let share = R::select(short & zero.lt(remaining), one, share);
        let by_normal = cone.fast[1] - (cone.less[1] - less * cone.pace[1] * rate) * faded
            + cone.more[1] * share;
        let by_rate = (pace * held).only(zero.lt(rate));
        // … and with the slip that adapts.
        let follows = by_rate * it.per_slip.only(rated) - fall.only(within);
        let all = it.stiffness + follows;
        let own = it.stiffness / all;
        Self {
            sticks,
            limit,
            slip,
            rate,
            by_normal: by_normal * own,
            by_rate: by_rate * own,
            by_size: follows / all,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn cone(normal: f64) -> Cone<f64> {
        Cone {
            fast: [0.3 * normal, 0.3],
            less: [0.2 * normal, 0.2],
            pace: [50.0, 0.0],
            more: [0.15 * normal, 0.15],
            over: 1e-4,
        }
    }

    fn trials() -> Vec<Trial<f64>> {
        let mut all = Vec::new();
        for size in [1.2e4, 2.6e4, 4e4, 3e5] {
            for rate in [-0.1, 0.0, 1e-3, 0.5] {
                for per_slip in [0.0, 10.0, 1e3, 1e6] {
                    for since in [0.0, 6e-5, 1e-2] {
                        let (stiffness, spring) = (1.3e9, 1e9);
                        all.push(Trial { size, stiffness, spring, rate, per_slip, since });
                    }
                }
            }
        }
        all
    }

    /// By bisection of the equation as it stands.
    fn bisected(c: &Cone<f64>, t: &Trial<f64>) -> f64 {
        let over = c.over.max(2.0 * c.more[0] / t.spring);
        let rest = |p: f64| {
            let x = (t.rate + t.per_slip * p).max(0.0);
            let limit = c.fast[0] - c.less[0] * (-c.pace[0] * x).exp()
                + c.more[0] * (1.0 - (t.since + p) / over).max(0.0);
            t.size - t.stiffness * p - limit
        };
        if rest(0.0) <= 0.0 {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, t.size / t.stiffness);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if rest(middle) > 0.0 { low = middle } else { high = middle }
        }
        low
    }

    #[test]
    fn the_slip_solves_its_equation() {
        for over in [1e-4, 0.0] {
            for t in trials() {
                let c = Cone { over, ..cone(1e5) };
                let s = Slide::of(&c, &t);
                let p = bisected(&c, &t);
                assert_eq!(s.sticks, p == 0.0, "{t:?}");
                assert_relative_eq!(s.slip, p, max_relative = 1e-9, epsilon = 1e-18);
                if !s.sticks {
                    assert_relative_eq!(s.limit, t.size - t.stiffness * p, max_relative = 1e-9);
                }
            }
        }
    }

    #[test]
    fn its_derivatives_are_those_of_the_limit() {
        for over in [1e-4, 0.0] {
            for t in trials() {
                let of = |normal: f64, rate: f64, size: f64| {
                    Slide::of(&Cone { over, ..cone(normal) }, &Trial { rate, size, ..t }).limit
                };
                let s = Slide::of(&Cone { over, ..cone(1e5) }, &t);
                if s.sticks {
                    continue;
                }
                let by = |f: &dyn Fn(f64) -> f64, x: f64, h: f64| (f(x + h) - f(x - h)) / (2.0 * h);
                let by_normal = by(&|n| of(n, t.rate, t.size), 1e5, 1.0);
                let by_size = by(&|size| of(1e5, t.rate, size), t.size, 1.0);
                assert_relative_eq!(s.by_normal, by_normal, max_relative = 1e-4, epsilon = 1e-6);
                assert_relative_eq!(s.by_size, by_size, max_relative = 1e-4, epsilon = 1e-6);
                if t.rate != 0.0 {
                    let by_rate = by(&|rate| of(1e5, rate, t.size), t.rate, 1e-8);
                    assert_relative_eq!(s.by_rate, by_rate, max_relative = 1e-4, epsilon = 10.0);
                }
            }
        }
    }
}

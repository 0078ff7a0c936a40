//! How a dashpot behind a gap takes hold of what comes.
//!
//! ```text
//!   F = c ḋ · min(p/TOUCH, 1)      ḋ < 0, p: penetration;  F = c ḋ where ḋ ≥ 0
//! ```
//!
//! A dashpot that acts in full from the touch on jumps there, from nothing to c ḋ. A joint without mass comes at any
//! rate, but it has no momentum that such a jump could take: at the touch it is held by a force between the two, and
//! creeps on from there. With the jump neither the open nor the closed side is in equilibrium then, however short the
//! step. So the force grows with the penetration over the first nanometre; what has mass does not see it.

use trilith_element::lanes::Real;

/// Penetration over which a dashpot takes hold, m.
pub(crate) const TOUCH: f64 = 1e-9;

/// Share of a dashpot that acts in contact, at a gap (m, not above 0) that opens at `rate` (m/s), and its derivative
/// by the gap.
#[inline(always)]
pub(crate) fn hold<R: Real>(gap: R, rate: R) -> [R; 2] {
    let (zero, one) = (gap.of(0.0), gap.of(1.0));
    let slope = gap.of(-TOUCH.recip());
    let share = gap * slope;
    let grows = share.lt(one) & rate.lt(zero);
    [R::select(grows, share, one), slope.only(grows)]
}

/// A spring of stiffness `k` behind a gap, beside a dashpot whose force at the rate `v` and slope by it are given: total
/// force, its derivatives by d and ḋ, and the force of the spring in it. `PULLS`: the total may pull while closed.
#[inline(always)]
pub(crate) fn strike<R: Real, const PULLS: bool>(
    k: R,
    [force, slope]: [R; 2],
    gap: R,
    v: R,
) -> [R; 4] {
    let zero = k.of(0.0);
    let closed = gap.lt(zero);
    let spring = (k * gap).only(closed);
    let [share, by_gap] = hold(gap, v);
    let f = force * share + spring;
    let acts = if PULLS { closed } else { closed & !zero.lt(f) };
    [f.only(acts), (k + force * by_gap).only(acts), (slope * share).only(acts), spring]
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn takes_hold_over_the_first_nanometre_of_an_approach() {
        assert_eq!(hold(-2.0 * TOUCH, -1.0), [1.0, 0.0]);
        assert_eq!(hold(0.0, -1.0)[0], 0.0);
        let [share, slope] = hold(-0.25 * TOUCH, -1.0);
        assert_relative_eq!(share, 0.25, max_relative = 1e-12);
        assert_relative_eq!(slope, -1e9, max_relative = 1e-12);
    }

    #[test]
    fn lets_go_as_it_was() {
        assert_eq!(hold(-0.25 * TOUCH, 0.0), [1.0, 0.0]);
        assert_eq!(hold(-0.25 * TOUCH, 1.0), [1.0, 0.0]);
    }
}

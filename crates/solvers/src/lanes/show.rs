//! Outputs after a step.

use super::coefficients::Rule;
use super::loads::Loads;
use super::plan::{Plan, Row};
use super::small::dot;
use super::state::State;
use trilith_element::lanes::Arithmetic;

/// Extremes of the outputs after a step that began at `t`.
#[inline(always)]
pub(super) fn show<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    rule: &Rule<A::Real, M, L>,
    loads: &Loads<A::Real, M>,
    t: A::Real,
    state: &mut State<A::Real, M, L, N>,
) {
    let zero = with.splat(0.0);
    for (row, peak) in plan.outputs.iter().zip(&mut state.peaks) {
        let (y, rate) = match row {
            Row::Displacement { own } => (dot(zero, own, &state.q), Some(dot(zero, own, &state.p))),
            Row::Velocity { own } => (dot(zero, own, &state.p), Some(dot(zero, own, &state.a))),
            Row::Acceleration { own, base } => {
                (dot(zero, own, &state.a) + dot(zero, base, &loads.amplitudes), None)
            }
            Row::Element { stiffness, damping } => {
                (dot(zero, stiffness, &state.q) + dot(zero, damping, &state.p), None)
            }
            Row::Deformation { at, factor } => {
                let v = if plan.rate { state.v[*at] } else { dot(zero, &plan.b[*at], &state.p) };
                (*factor * state.d[*at], Some(*factor * v))
            }
            Row::Force { at, factor } => (*factor * state.f[*at], None),
            Row::History { at } => (state.history[*at], None),
            Row::Zero => (zero, None),
        };
        peak.advance(with, (t, rule.dt, rule.third), y, rate);
    }
}

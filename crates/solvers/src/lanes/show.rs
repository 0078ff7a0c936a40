//! Outputs after a step.

use super::outputs::{Extremes, Place, Row};
use super::peaks::TOGETHER;
use super::plan::Plan;
use super::record::Record;
use super::small::dot;
use super::state::State;
use trilith_element::lanes::{Arithmetic, Real};

/// Extremes of the outputs after a step: when it began, its length, and a third of that.
#[inline(always)]
pub(super) fn show<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    step: (A::Real, A::Real, A::Real),
    state: &State<A::Real, M, L, N>,
    record: &mut Record<A::Real>,
) {
    let zero = with.splat(0.0);
    let m = plan.modes();
    for (rows, peaks) in plan.outputs.together.iter().zip(&mut record.peaks.together) {
        let (y, rate) = (displacements(m, rows, &state.q), displacements(m, rows, &state.p));
        peaks.advance(with, step, y, Some(rate));
    }
    let Extremes { alone, together, .. } = &mut record.peaks;
    for (i, row) in plan.outputs.alone.iter().enumerate() {
        let (before, own) = alone.split_at_mut(i);
        let (y, rate) = match row {
            Row::Displacement { own } => {
                (dot(zero, &own[..m], &*state.q), Some([dot(zero, &own[..m], &*state.p)]))
            }
            Row::Velocity { own } => {
                (dot(zero, &own[..m], &*state.p), Some([dot(zero, &own[..m], &*state.a)]))
            }
            Row::Acceleration { own, base } => {
                (dot(zero, &own[..m], &*state.a) + dot(zero, base, &state.amplitudes), None)
            }
            Row::Internal { stiffness, damping, links } => {
                let mut y =
                    dot(zero, &stiffness[..m], &*state.q) + dot(zero, &damping[..m], &*state.p);
                for (at, share) in links {
                    y = y + *share * state.f[*at];
                }
                (y, None)
            }
            Row::Deformation { at, factor } => {
                let v =
                    if plan.rate { state.v[*at] } else { dot(zero, &plan.b[*at][..m], &*state.p) };
                (*factor * state.d[*at], Some([*factor * v]))
            }
            Row::Force { first: (at, factor), more } => {
                let mut y = *factor * state.f[*at];
                for (at, factor) in more {
                    y = y + *factor * state.f[*at];
                }
                (y, None)
            }
            Row::History { at } => (state.history[*at], None),
            Row::Zero => (zero, None),
            Row::Combination(it) => it.of(|place| match *place {
                Place::Alone(i) => before[i].now(0),
                Place::Together(i, k) => together[i].now(k),
            }),
        };
        own[0].advance(with, step, [y], rate);
    }
    record.peaks.integrate(step.1);
}

/// What several outputs take from all modes.
#[inline(always)]
fn displacements<R: Real, const M: usize>(
    n: usize,
    rows: &[[R; TOGETHER]; M],
    modes: &[R; M],
) -> [R; TOGETHER] {
    let mut sum = [modes[0].of(0.0); TOGETHER];
    for j in 0..n {
        for i in 0..TOGETHER {
            sum[i] = rows[j][i].mul_add(modes[j], sum[i]);
        }
    }
    sum
}

//! The equilibrium of a step: Newton's method in the link coordinates.
//!
//! With the link forces held at those of the start the modes go somewhere; what the tangents found last answer to
//! that is the first guess. Where no link changes its regime (open, sticking, slipping …) it is exact for
//! piecewise linear laws, and one look at the laws confirms it. Otherwise Newton's method goes on with the
//! tangents found there.

use super::coefficients::Rule;
use super::laws::look;
use super::loads::Loads;
use super::plan::Plan;
use super::search::Search;
use super::small::{Aligned, combine, factor, less, more, solve, times};
use super::state::State;
use crate::kernel::{DIGIT, ROUNDING, ROUNDING_FROM, SETTLED};
use trilith_element::lanes::{Arithmetic, Real};

const ITERATIONS: usize = 60;

/// The end of a step; written by [`foresee`] and [`settle`] in place, as nothing of it should be copied in every step.
pub(super) struct Found<R: Real, const M: usize, const L: usize> {
    /// Deformations, their rates, and forces of the links.
    pub d: Aligned<[R; L]>,
    pub v: Aligned<[R; L]>,
    pub f: Aligned<[R; L]>,
    /// Laws at d and v: f up to the tolerance.
    pub forces: Aligned<[R; L]>,
    /// Largest force so far, and largest moment.
    pub scale: [R; 2],
    /// ∫q, q and q̇ with the link forces held at those of the start.
    pub integral: Aligned<[R; M]>,
    pub q: Aligned<[R; M]>,
    pub p: Aligned<[R; M]>,
    /// Deformations and rates with the forces held.
    held: Aligned<[R; L]>,
    rates_held: Aligned<[R; L]>,
    /// Change of the forces.
    change: Aligned<[R; L]>,
    /// Who found none: its numbers are rubbish.
    pub wrong: R::Mask,
}

impl<R: Real, const M: usize, const L: usize> Found<R, M, L> {
    /// Nothing yet.
    pub fn new(zero: R) -> Self {
        Self {
            d: Aligned([zero; L]),
            // Laws that do not look at rates get none.
            v: Aligned([zero.of(f64::NAN); L]),
            f: Aligned([zero; L]),
            forces: Aligned([zero; L]),
            scale: [zero; 2],
            integral: Aligned([zero; M]),
            q: Aligned([zero; M]),
            p: Aligned([zero; M]),
            held: Aligned([zero; L]),
            rates_held: Aligned([zero; L]),
            change: Aligned([zero; L]),
            wrong: zero.lt(zero),
        }
    }

    /// Deformations, rates and forces that follow from the change of the forces.
    #[inline(always)]
    fn follow<const N: usize>(
        &mut self,
        plan: &Plan<R, M, L, N>,
        rule: &Rule<R, M, L>,
        state: &State<R, M, L, N>,
    ) {
        *self.d = more(&self.held, &times(&rule.g, &self.change));
        if plan.rate {
            *self.v = more(&self.rates_held, &times(&rule.h, &self.change));
        }
        *self.f = more(&state.f, &self.change);
    }
}

/// Where the step leads with the forces held, and the first guess of their change: what the tangents found last answer,
/// in a step of this length.
#[inline(always)]
pub(super) fn foresee<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    rule: &Rule<R, M, L>,
    loads: &Loads<R, M>,
    state: &State<R, M, L, N>,
    found: &mut Found<R, M, L>,
) {
    hold(plan, rule, loads, state, found);
    *found.change = times(&state.answer, &less(&found.held, &state.d));
    if plan.rate {
        let of_rates = times(&state.answer_to_rate, &less(&found.rates_held, &state.v));
        *found.change = more(&found.change, &of_rates);
    }
    found.follow(plan, rule, state);
}

/// The same where steps have other lengths than those before: the tangents at the start of the step are made to answer.
#[inline(always)]
pub(super) fn foresee_by_tangents<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    rule: &Rule<R, M, L>,
    loads: &Loads<R, M>,
    state: &State<R, M, L, N>,
    found: &mut Found<R, M, L>,
) {
    hold(plan, rule, loads, state, found);
    let moved = less(&found.held, &state.d);
    let faster = if plan.rate { less(&found.rates_held, &state.v) } else { moved };
    for a in 0..L {
        let first = a / N * N;
        let mut sum = state.k[a][0] * moved[first];
        for i in 1..N {
            sum = state.k[a][i].mul_add(moved[first + i], sum);
        }
        if plan.rate {
            for i in 0..N {
                sum = state.c[a][i].mul_add(faster[first + i], sum);
            }
        }
        found.change[a] = sum;
    }
    let mut j = jacobian(plan, rule, state);
    factor(&mut j);
    solve(&j, &mut found.change);
    found.follow(plan, rule, state);
}

/// The motion of the modes with the forces held at those of the start.
#[inline(always)]
fn hold<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    rule: &Rule<R, M, L>,
    loads: &Loads<R, M>,
    state: &State<R, M, L, N>,
    found: &mut Found<R, M, L>,
) {
    let start = less(&loads.start, &state.push);
    let end = less(&loads.end, &state.push);
    let inputs = [&state.q, &state.p, &start, &end];
    let [integral, q, p] = &*rule.c;
    *found.integral = combine(integral, inputs);
    *found.q = combine(q, inputs);
    *found.p = combine(p, inputs);
    *found.held = plan.deform(&found.q);
    if plan.rate {
        *found.rates_held = plan.deform(&found.p);
    }
}

impl<R: Real, const M: usize, const L: usize, const N: usize> Plan<R, M, L, N> {
    /// What may be left of each force, of the largest so far.
    #[inline(always)]
    fn allowed(&self, scale: &[R; 2]) -> [R; L] {
        let mut allowed = [scale[0] * self.tolerance; L];
        if self.turns {
            let of_moments = scale[1] * self.tolerance;
            for a in (0..L).filter(|a| self.rotational[*a]) {
                allowed[a] = of_moments;
            }
        }
        allowed
    }

    /// And what the last digits of deformations and rates make of it: a stiff contact under a body that has gone far.
    #[inline(always)]
    fn allow_rounding(
        &self,
        state: &State<R, M, L, N>,
        found: &Found<R, M, L>,
        allowed: &mut [R; L],
    ) {
        for a in 0..L {
            let first = a / N * N;
            let mut sum = (state.k[a][0] * found.d[first]).abs();
            for i in 1..N {
                sum = sum + (state.k[a][i] * found.d[first + i]).abs();
            }
            if self.rate {
                for i in 0..N {
                    sum = sum + (state.c[a][i] * found.v[first + i]).abs();
                }
            }
            allowed[a] = allowed[a].max(sum.of(DIGIT) * sum);
        }
    }
}

/// True where none of some forces is larger than what may be left of it.
#[inline(always)]
fn within<R: Real, const L: usize>(forces: &[R; L], allowed: &[R; L]) -> R::Mask {
    let mut fine = forces[0].abs().le(allowed[0]);
    for a in 1..L {
        fine = fine & forces[a].abs().le(allowed[a]);
    }
    fine
}

/// The largest of some forces over what may be left of them.
#[inline(always)]
fn over<R: Real, const L: usize>(forces: &[R; L], allowed: &[R; L]) -> R {
    let zero = forces[0].of(0.0);
    let mut most = zero;
    for a in 0..L {
        // Nothing is as much as is allowed of nothing.
        let share = (forces[a].abs() / allowed[a]).only(!forces[a].abs().le(zero));
        most = share.max(most);
    }
    most
}

/// J = I + k G + c H.
#[inline(always)]
fn jacobian<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    rule: &Rule<R, M, L>,
    state: &State<R, M, L, N>,
) -> [[R; L]; L] {
    let (zero, one) = (rule.dt.of(0.0), rule.dt.of(1.0));
    let mut j = [[zero; L]; L];
    for a in 0..L {
        let first = a / N * N;
        j[a][a] = one;
        for i in 0..N {
            let k = -state.k[a][i];
            for b in 0..L {
                j[a][b] = k.mul_add(rule.g[b][first + i], j[a][b]);
            }
            if plan.rate {
                let c = -state.c[a][i];
                for b in 0..L {
                    j[a][b] = c.mul_add(rule.h[b][first + i], j[a][b]);
                }
            }
        }
    }
    j
}

/// Looks for the equilibrium of the analyses in a mask, from what is foreseen. Of the state it changes the tangents,
/// and what follows from them where it is `kept` for the next step; and what the laws say of a step that ends where
/// they were asked last.
#[inline(always)]
pub(super) fn settle<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    rule: &Rule<A::Real, M, L>,
    (who, kept): (<A::Real as Real>::Mask, bool),
    state: &mut State<A::Real, M, L, N>,
    found: &mut Found<A::Real, M, L>,
) {
    let zero = with.splat(0.0);
    let one = with.splat(1.0);
    let mut wrong = state.alive & who;
    // Mostly one look is enough.
    let mut search = None;
    for iteration in 0..ITERATIONS {
        look(with, plan, rule.dt, (&found.d, &found.v), state, &mut found.forces);
        state.iterations = state.iterations + one.only(wrong);
        let residual = less(&found.forces, &found.f);
        let mut scale = state.scale;
        if plan.turns {
            for a in 0..L {
                let kind = usize::from(plan.rotational[a]);
                scale[kind] = scale[kind].max(found.forces[a].abs());
            }
        } else {
            for force in *found.forces {
                scale[0] = scale[0].max(force.abs());
            }
        }
        found.scale = scale;
        let mut allowed = plan.allowed(&scale);
        wrong = wrong & !within(&residual, &allowed);
        if iteration >= ROUNDING_FROM && zero.any(wrong) {
            plan.allow_rounding(state, found, &mut allowed);
            wrong = wrong & !within(&residual, &allowed);
        }
        if !zero.any(wrong) {
            break;
        }
        let size = over(&residual, &allowed);
        if search.is_none() {
            search = Some(Search::new(zero));
        }
        let Some(search) = &mut search else { break };
        let (more, searching) = search.goes_on(rule, iteration, (&residual, size), wrong);
        for a in 0..L {
            found.change[a] = found.change[a] + (more * search.step()[a]).only(searching);
        }
        let mut goes = wrong & !searching;
        if zero.any(goes) {
            let mut j = jacobian(plan, rule, state);
            factor(&mut j);
            if kept {
                state.keep_answers(&j, goes, plan.rate);
            }
            let mut step = residual;
            solve(&j, &mut step);
            if iteration > 0 {
                // What is left is rounding: the correction changes nothing any more.
                let is_little = over(&step, &allowed).le(with.splat(SETTLED));
                let settled = goes & size.le(with.splat(ROUNDING)) & is_little;
                (goes, wrong) = (goes & !settled, wrong & !settled);
                if !zero.any(wrong) {
                    break;
                }
            }
            search.goes(goes, &step, (&residual, size));
            for a in 0..L {
                found.change[a] = found.change[a] + step[a].only(goes);
            }
        }
        found.follow(plan, rule, state);
    }
    found.wrong = wrong;
}

impl<R: Real, const M: usize, const L: usize, const N: usize> State<R, M, L, N> {
    /// J⁻¹ k and J⁻¹ c, column by column, where a mask says so; `j` holds the factors.
    #[inline(always)]
    fn keep_answers(&mut self, j: &[[R; L]; L], mask: R::Mask, rate: bool) {
        let zero = self.external.of(0.0);
        let kinds = [
            Some((&self.k, &mut self.answer)),
            rate.then_some((&self.c, &mut self.answer_to_rate)),
        ];
        for (tangents, answer) in kinds.into_iter().flatten() {
            for b in 0..L {
                let first = b / N * N;
                let mut column = [zero; L];
                for i in 0..N {
                    column[first + i] = tangents[first + i][b - first];
                }
                solve(j, &mut column);
                for a in 0..L {
                    answer[b][a] = R::mix(mask, column[a], answer[b][a]);
                }
            }
        }
    }
}

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
use super::small::{Aligned, SMALL, combine, factor, less, more, solve, times};
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
    /// Room for the factors of J, where they do not fit into registers.
    j: Aligned<[[R; L]; L]>,
    /// Who found none: its numbers are rubbish.
    pub wrong: R::Mask,
}

impl<R: Real, const M: usize, const L: usize> Found<R, M, L> {
    /// Nothing yet.
    pub fn new(zero: R) -> Self {
        Self {
            d: Aligned::filled(zero),
            // Laws that do not look at rates get none.
            v: Aligned::filled(zero.of(f64::NAN)),
            f: Aligned::filled(zero),
            forces: Aligned::filled(zero),
            scale: [zero; 2],
            integral: Aligned::filled(zero),
            q: Aligned::filled(zero),
            p: Aligned::filled(zero),
            held: Aligned::filled(zero),
            rates_held: Aligned::filled(zero),
            change: Aligned::filled(zero),
            j: Aligned::full_of(zero),
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
        let n = plan.coordinates();
        *self.d = more(n, &self.held, &times((n, n), &rule.g, &self.change));
        if plan.rate {
            *self.v = more(n, &self.rates_held, &times((n, n), &rule.h, &self.change));
        }
        *self.f = more(n, &state.f, &self.change);
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
    let n = plan.coordinates();
    *found.change = times((n, n), &state.answer, &less(n, &found.held, &state.d));
    if plan.rate {
        let faster = less(n, &found.rates_held, &state.v);
        let of_rates = times((n, n), &state.answer_to_rate, &faster);
        *found.change = more(n, &found.change, &of_rates);
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
    let n = plan.coordinates();
    let moved = less(n, &found.held, &state.d);
    let faster = if plan.rate { less(n, &found.rates_held, &state.v) } else { moved };
    let block = plan.block();
    for a in 0..n {
        let first = a / block * block;
        let (k, c) = (state.k.row(block, a), state.c.row(block, a));
        let mut sum = k[0] * moved[first];
        for i in 1..block {
            sum = k[i].mul_add(moved[first + i], sum);
        }
        if plan.rate {
            for i in 0..block {
                sum = c[i].mul_add(faster[first + i], sum);
            }
        }
        found.change[a] = sum;
    }
    if const { L <= SMALL } {
        let mut j = [[rule.dt.of(0.0); L]; L];
        jacobian(plan, rule, state, &mut j);
        solve(n, &j, &mut found.change);
    } else {
        jacobian(plan, rule, state, &mut found.j);
        solve(n, &found.j, &mut found.change);
    }
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
    let m = plan.modes();
    let start = less(m, &loads.start, &state.push);
    let end = less(m, &loads.end, &state.push);
    let inputs = [&state.q, &state.p, &start, &end];
    let [integral, q, p] = &*rule.c;
    *found.integral = combine(m, integral, inputs);
    *found.q = combine(m, q, inputs);
    *found.p = combine(m, p, inputs);
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
            for a in (0..self.coordinates()).filter(|a| self.rotational[*a]) {
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
        let block = self.block();
        for a in 0..self.coordinates() {
            let first = a / block * block;
            let (k, c) = (state.k.row(block, a), state.c.row(block, a));
            let mut sum = (k[0] * found.d[first]).abs();
            for i in 1..block {
                sum = sum + (k[i] * found.d[first + i]).abs();
            }
            if self.rate {
                for i in 0..block {
                    sum = sum + (c[i] * found.v[first + i]).abs();
                }
            }
            allowed[a] = allowed[a].max(sum.of(DIGIT) * sum);
        }
    }
}

/// True where none of `n` forces is larger than what may be left of it.
#[inline(always)]
fn within<R: Real, const L: usize>(n: usize, forces: &[R; L], allowed: &[R; L]) -> R::Mask {
    let mut fine = forces[0].abs().le(allowed[0]);
    for a in 1..n {
        fine = fine & forces[a].abs().le(allowed[a]);
    }
    fine
}

/// The largest of `n` forces over what may be left of them.
#[inline(always)]
fn over<R: Real, const L: usize>(n: usize, forces: &[R; L], allowed: &[R; L]) -> R {
    let zero = forces[0].of(0.0);
    let mut most = zero;
    for a in 0..n {
        // Nothing is as much as is allowed of nothing.
        let share = (forces[a].abs() / allowed[a]).only(!forces[a].abs().le(zero));
        most = share.max(most);
    }
    most
}

/// What solves for a residual under the tangents that were found last; they are kept for the next step by those in a mask.
#[inline(always)]
fn correction<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    rule: &Rule<R, M, L>,
    (goes, kept): (R::Mask, bool),
    state: &mut State<R, M, L, N>,
    j: &mut [[R; L]; L],
    step: &mut [R; L],
) {
    jacobian(plan, rule, state, j);
    let n = plan.coordinates();
    if kept {
        state.keep_answers(plan, j, goes);
    }
    solve(n, j, step);
}

/// The factors of J = I + k G + c H, as far as there are coordinates.
#[inline(always)]
fn jacobian<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    rule: &Rule<R, M, L>,
    state: &State<R, M, L, N>,
    j: &mut [[R; L]; L],
) {
    let (zero, one) = (rule.dt.of(0.0), rule.dt.of(1.0));
    let (n, block) = (plan.coordinates(), plan.block());
    for a in 0..n {
        let first = a / block * block;
        for b in 0..n {
            j[a][b] = zero;
        }
        j[a][a] = one;
        for i in 0..block {
            let k = -state.k.row(block, a)[i];
            for b in 0..n {
                j[a][b] = k.mul_add(rule.g[b][first + i], j[a][b]);
            }
            if plan.rate {
                let c = -state.c.row(block, a)[i];
                for b in 0..n {
                    j[a][b] = c.mul_add(rule.h[b][first + i], j[a][b]);
                }
            }
        }
    }
    factor(n, j);
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
    let n = plan.coordinates();
    let mut wrong = state.alive & who;
    // Mostly one look is enough.
    let mut search = None;
    for iteration in 0..ITERATIONS {
        look(with, plan, rule.dt, (&found.d, &found.v), state, &mut found.forces);
        state.iterations = state.iterations + one.only(wrong);
        let residual = less(n, &found.forces, &found.f);
        let mut scale = state.scale;
        if plan.turns {
            for a in 0..n {
                let kind = usize::from(plan.rotational[a]);
                scale[kind] = scale[kind].max(found.forces[a].abs());
            }
        } else {
            for a in 0..n {
                scale[0] = scale[0].max(found.forces[a].abs());
            }
        }
        found.scale = scale;
        let mut allowed = plan.allowed(&scale);
        wrong = wrong & !within(n, &residual, &allowed);
        if iteration >= ROUNDING_FROM && zero.any(wrong) {
            plan.allow_rounding(state, found, &mut allowed);
            wrong = wrong & !within(n, &residual, &allowed);
        }
        if !zero.any(wrong) {
            break;
        }
        let size = over(n, &residual, &allowed);
        if search.is_none() {
            search = Some(Search::new(zero));
        }
        let Some(search) = &mut search else { break };
        let (more, searching) = search.goes_on(rule, (n, iteration), (&residual, size), wrong);
        for a in 0..n {
            found.change[a] = found.change[a] + (more * search.step()[a]).only(searching);
        }
        let mut goes = wrong & !searching;
        if zero.any(goes) {
            let mut step = residual;
            if const { L <= SMALL } {
                let mut j = [[zero; L]; L];
                correction(plan, rule, (goes, kept), state, &mut j, &mut step);
            } else {
                correction(plan, rule, (goes, kept), state, &mut found.j, &mut step);
            }
            if iteration > 0 {
                // What is left is rounding: the correction changes nothing any more.
                let is_little = over(n, &step, &allowed).le(with.splat(SETTLED));
                let settled = goes & size.le(with.splat(ROUNDING)) & is_little;
                (goes, wrong) = (goes & !settled, wrong & !settled);
                if !zero.any(wrong) {
                    break;
                }
            }
            search.goes(n, goes, &step, (&residual, size));
            for a in 0..n {
                found.change[a] = found.change[a] + step[a].only(goes);
            }
        }
        found.follow(plan, rule, state);
    }
    found.wrong = wrong;
}

impl<R: Real, const M: usize, const L: usize, const N: usize> State<R, M, L, N> {
    /// J⁻¹ k and J⁻¹ c, column by column, where a mask says so; `j` holds the factors of J.
    #[inline(always)]
    fn keep_answers(&mut self, plan: &Plan<R, M, L, N>, j: &[[R; L]; L], mask: R::Mask) {
        let (n, block) = (plan.coordinates(), plan.block());
        let zero = self.lost.of(0.0);
        let mut column = [zero; L];
        let kinds = [
            Some((&self.k, &mut self.answer)),
            plan.rate.then_some((&self.c, &mut self.answer_to_rate)),
        ];
        for (tangents, answer) in kinds.into_iter().flatten() {
            for b in 0..n {
                let first = b / block * block;
                for a in 0..n {
                    column[a] = zero;
                }
                for i in 0..block {
                    column[first + i] = tangents.row(block, first + i)[b - first];
                }
                solve(n, j, &mut column);
                for a in 0..n {
                    answer[b][a] = R::mix(mask, column[a], answer[b][a]);
                }
            }
        }
    }
}

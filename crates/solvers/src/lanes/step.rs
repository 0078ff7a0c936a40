//! The end of a step: what the next one starts from, and apart from it energies, outputs and contacts.
//!
//! The next step waits for the former only, so that the processor may account for one while it waits for the other.

use super::coefficients::Rule;
use super::laws::contacts;
use super::loads::Loads;
use super::newton::Found;
use super::plan::Plan;
use super::record::Record;
use super::show::show;
use super::small::Aligned;
use super::state::State;
use trilith_element::lanes::{Arithmetic, Real, Task};

/// What a step leaves to be accounted for.
pub(super) struct Passed<R, const M: usize> {
    /// When the step began.
    t: R,
    /// By modes: work of all loads, and of the links among them; twice the kinetic energy; minus the potential energy.
    of_modes: Aligned<[[R; M]; 4]>,
}

impl<R: Real, const M: usize> Passed<R, M> {
    /// Nothing yet.
    pub fn new(zero: R) -> Self {
        Self { t: zero, of_modes: Aligned::full_of(zero) }
    }

    /// Work that the links took.
    #[inline(always)]
    pub fn of_links(&self) -> R {
        let mut sum = self.t.of(0.0);
        for work in self.of_modes[1] {
            sum = sum + work;
        }
        sum
    }
}

/// Takes the end of a step that began at `t`: what the next step starts from.
#[inline(always)]
pub(super) fn take<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    rule: &Rule<R, M, L>,
    (loads, t): (&Loads<R, M>, R),
    found: &Found<R, M, L>,
    state: &mut State<R, M, L, N>,
    passed: &mut Passed<R, M>,
) {
    passed.t = t;
    let push = plan.push(&found.f);
    // A load is linear in the step, and what it does is ∫ s q̇ dt = s₁ (q₁ − q̄) − s₀ (q₀ − q̄) with q̄ the mean of q.
    let of_modes = &mut passed.of_modes;
    for j in 0..plan.modes() {
        let change = state.push[j] - push[j];
        let integral = rule.c[0][3][j].mul_add(change, found.integral[j]);
        let q = rule.c[1][3][j].mul_add(change, found.q[j]);
        let p = rule.c[2][3][j].mul_add(change, found.p[j]);
        let mean = integral * rule.per_dt;
        let (to, from) = (q - mean, mean - state.q[j]);
        of_modes[0][j] = loads.start[j].mul_add(from, loads.end[j] * to);
        of_modes[1][j] = state.push[j].mul_add(from, push[j] * to);
        of_modes[2][j] = p * p;
        of_modes[3][j] = plan.constant[j] * q;
        (state.q[j], state.p[j], state.push[j]) = (q, p, push[j]);
    }
    if plan.accelerations {
        acceleration(plan, &loads.end, state);
        state.amplitudes.copy_from_slice(&loads.amplitudes);
    }
    std::mem::swap(&mut state.history, &mut state.trial);
    state.d = found.d;
    state.f = found.f;
    state.scale = found.scale;
    if plan.rate {
        state.v = found.v;
    }
}

/// Accelerations under loads over the modes.
#[inline(always)]
pub(super) fn acceleration<R: Real, const M: usize, const L: usize, const N: usize>(
    plan: &Plan<R, M, L, N>,
    load: &Aligned<[R; M]>,
    state: &mut State<R, M, L, N>,
) {
    for j in 0..plan.modes() {
        let source = load[j] - state.push[j];
        let held = (-plan.damping[j]).mul_add(state.p[j], source);
        state.a[j] = (-plan.omega2[j]).mul_add(state.q[j], held);
    }
}

/// Energies, outputs and contacts after a step that was taken and led to a state.
#[inline(always)]
pub(super) fn account<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    rule: &Rule<A::Real, M, L>,
    passed: &Passed<A::Real, M>,
    state: &State<A::Real, M, L, N>,
    record: &mut Record<A::Real>,
) {
    let zero = with.splat(0.0);
    let mut sums = [zero; 4];
    for j in 0..plan.modes() {
        for i in 0..4 {
            sums[i] = sums[i] + passed.of_modes[i][j];
        }
    }
    let [external, taken, kinetic, fallen] = sums;
    let potential = -fallen;
    let half = with.splat(0.5);
    let kinetic = half * kinetic;
    let mut strain = zero;
    if plan.elastic {
        for j in 0..plan.modes() {
            strain = (plan.omega2[j] * state.q[j]).mul_add(state.q[j], strain);
        }
        strain = half * strain;
    }
    if plan.damps {
        let gained = (kinetic - record.kinetic) + (strain - record.strain);
        let damping = external - taken - gained;
        record.damping = record.damping + damping.only(zero.lt(plan.damped));
    }
    (record.kinetic, record.strain, record.potential) = (kinetic, strain, potential);
    record.external = record.external + external;

    // What the links did.
    let mut stored = zero;
    for (step, [hysteretic, viscous]) in state.steps.iter().zip(&mut record.heat) {
        stored = stored + step.stored;
        *hysteretic = *hysteretic + step.hysteretic;
        if plan.rate {
            *viscous = *viscous + step.viscous;
        }
    }
    record.stored = stored;
    let fallen = potential - record.potential0;
    let input = record.kinetic0 + record.external + fallen;
    let mut largest = record.largest.max(kinetic).max(input.abs());
    for size in [fallen, stored - record.stored0] {
        largest = largest.max(size.abs());
    }
    if plan.elastic {
        largest = largest.max((strain - record.strain0).abs());
    }
    record.largest = largest;
    record.count = record.count + with.splat(1.0);
    show(with, plan, (passed.t, rule.dt, rule.third), state, record);
    if plan.falls || plan.contacts > 0 {
        contacts(with, plan, state, record);
        record.feet.enter(&record.contacts, &plan.feet);
        record.feet.press(&record.contacts, &plan.others);
    }
}

/// What [`account`] does, by a call: there is one of it for all who need it off the way of a usual step.
#[inline(never)]
pub(super) fn account_apart<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    rule: &Rule<A::Real, M, L>,
    passed: &Passed<A::Real, M>,
    state: &State<A::Real, M, L, N>,
    record: &mut Record<A::Real>,
) {
    with.run(Account { plan, rule, passed, state, record });
}

/// What [`account`] does, as a task.
struct Account<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    rule: &'a Rule<R, M, L>,
    passed: &'a Passed<R, M>,
    state: &'a State<R, M, L, N>,
    record: &'a mut Record<R>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Account<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { plan, rule, passed, state, record } = self;
        account(with, plan, rule, passed, state, record);
    }
}

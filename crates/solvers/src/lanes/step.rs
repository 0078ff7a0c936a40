//! The end of a step: state, energies, outputs and contacts.

use super::coefficients::Rule;
use super::loads::Loads;
use super::newton::Found;
use super::plan::Plan;
use super::show::show;
use super::state::State;
use trilith_element::lanes::{Arithmetic, LaneLinks, Real};

/// Takes the end of a step that began at `t`.
#[inline(always)]
pub(super) fn finish<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    rule: &Rule<A::Real, M, L>,
    loads: &Loads<A::Real, M>,
    t: A::Real,
    found: Found<A::Real, M, L>,
    state: &mut State<A::Real, M, L, N>,
) {
    let zero = with.splat(0.0);
    let Found { d, v, f, mut forces, source0, mut integral, mut q, mut p, .. } = found;
    let mut push = [zero; M];
    for a in 0..L {
        for j in 0..M {
            push[j] = f[a].mul_add(plan.b[a][j], push[j]);
        }
    }
    let (mut external, mut total) = (zero, zero);
    let (mut kinetic, mut strain, mut potential) = (zero, zero, zero);
    for j in 0..M {
        let c = &rule.c[j];
        integral[j] = (-c[0][3]).mul_add(push[j], integral[j]);
        q[j] = (-c[1][3]).mul_add(push[j], q[j]);
        p[j] = (-c[2][3]).mul_add(push[j], p[j]);
        let source1 = loads.end[j] - push[j];
        // ∫ s q̇ dt of a load that is linear in the step.
        let mean = integral[j] * rule.per_dt;
        let ext1 = loads.end[j] * (q[j] - mean);
        let ext0 = loads.start[j] * (state.q[j] - mean);
        external = external + (ext1 - ext0);
        total = total + (source1 * (q[j] - mean) - source0[j] * (state.q[j] - mean));
        kinetic = p[j].mul_add(p[j], kinetic);
        let w = plan.omega2[j] * q[j];
        strain = w.mul_add(q[j], strain);
        potential = (-plan.constant[j]).mul_add(q[j], potential);
        if plan.accelerations {
            state.a[j] = (-plan.damping[j]).mul_add(p[j], source1) - w;
        }
    }
    let half = with.splat(0.5);
    let (kinetic, strain) = (half * kinetic, half * strain);
    let damping = total - (kinetic - state.kinetic) - (strain - state.strain);
    state.damping = state.damping + damping.only(zero.lt(plan.damped));
    (state.kinetic, state.strain, state.potential) = (kinetic, strain, potential);
    state.external = state.external + external;

    // What the links did.
    let mut at = 0;
    for run in &plan.runs {
        let (law, n) = (&run.law, run.law.coordinates);
        let r = run.first..run.first + run.count * n;
        let (h, o) = (run.history, run.parameters);
        let mut links = LaneLinks {
            parameters: &plan.parameters[o..o + run.count * law.parameters],
            d: &d[r.clone()],
            v: &v[r.clone()],
            d0: &state.d[r.clone()],
            v0: &state.v[r.clone()],
            dt: rule.dt,
            history: &mut state.history[h..h + run.count * law.history],
            f: &mut forces[r],
            k: &mut [],
            c: &mut [],
        };
        with.commit(law, &mut links, &mut state.steps[at..at + run.count]);
        at += run.count;
    }
    let mut stored = zero;
    for (i, step) in state.steps.iter().enumerate() {
        stored = stored + step.stored;
        state.hysteretic[i] = state.hysteretic[i] + step.hysteretic;
        state.viscous[i] = state.viscous[i] + step.viscous;
        state.heat = state.heat + (step.hysteretic + step.viscous);
    }
    state.stored = stored;
    (state.q, state.p) = (q, p);
    (state.d, state.v, state.f) = (d, v, f);
    for a in 0..L {
        let kind = usize::from(plan.rotational[a]);
        let kind = if plan.turns { kind } else { 0 };
        state.scale[kind] = state.scale[kind].max(forces[a].abs());
    }
    let input = state.kinetic0 + state.external + (state.potential - state.potential0);
    for size in [
        input,
        state.kinetic,
        state.potential - state.potential0,
        state.strain - state.strain0,
        stored - state.stored0,
    ] {
        state.largest = state.largest.max(size.abs());
    }
    state.count = state.count + with.splat(1.0);
    show(with, plan, rule, loads, t, state);
    state.feet.enter(&state.steps, &plan.feet);
}

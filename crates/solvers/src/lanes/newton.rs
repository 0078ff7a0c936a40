//! The equilibrium of a step: Newton's method in the link coordinates.
//!
//! It starts from the forces that the tangents of the step before predict: where no link changes its
//! regime (open, sticking, slipping …) these are exact for piecewise linear laws, and one look at the laws
//! confirms them. Otherwise Newton's method goes on with the tangents found there.

use super::coefficients::Rule;
use super::laws::look;
use super::loads::Loads;
use super::plan::Plan;
use super::small::{deform, factor, solve};
use super::state::State;
use trilith_element::lanes::{Arithmetic, Real};

const ITERATIONS: usize = 60;
/// Share of Newton's correction that is made, one after the other for so many iterations each.
const PARTS: [f64; 4] = [1.0, 0.5, 1.0, 0.25];
const PATIENCE: usize = 8;

/// The end of a step.
pub(super) struct Found<R: Real, const M: usize, const L: usize> {
    /// Deformations, their rates, and forces of the links.
    pub d: [R; L],
    pub v: [R; L],
    pub f: [R; L],
    /// Laws at d and v: f up to the tolerance.
    pub forces: [R; L],
    /// Modal loads at the start, links included.
    pub source0: [R; M],
    /// ∫q, q and q̇ without the link forces at the end.
    pub integral: [R; M],
    pub q: [R; M],
    pub p: [R; M],
    /// Who found none: its numbers are rubbish.
    pub wrong: R::Mask,
}

/// Looks for the equilibrium of the analyses in a mask. Of the state it changes the tangents only.
#[inline(always)]
pub(super) fn equilibrium<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    rule: &Rule<A::Real, M, L>,
    loads: &Loads<A::Real, M>,
    who: <A::Real as Real>::Mask,
    state: &mut State<A::Real, M, L, N>,
) -> Found<A::Real, M, L> {
    let zero = with.splat(0.0);
    let one = with.splat(1.0);
    // Modes without the forces at the end.
    let mut source0 = loads.start;
    for a in 0..L {
        for j in 0..M {
            source0[j] = (-state.f[a]).mul_add(plan.b[a][j], source0[j]);
        }
    }
    let (mut integral, mut q, mut p) = ([zero; M], [zero; M], [zero; M]);
    for j in 0..M {
        let inputs = [state.q[j], state.p[j], source0[j], loads.end[j]];
        let c = &rule.c[j];
        for i in 0..4 {
            integral[j] = c[0][i].mul_add(inputs[i], integral[j]);
            q[j] = c[1][i].mul_add(inputs[i], q[j]);
            p[j] = c[2][i].mul_add(inputs[i], p[j]);
        }
    }
    let (mut d_free, mut v_free) = ([zero; L], [zero; L]);
    for a in 0..L {
        for j in 0..M {
            d_free[a] = plan.b[a][j].mul_add(q[j], d_free[a]);
        }
    }
    if plan.rate {
        for a in 0..L {
            for j in 0..M {
                v_free[a] = plan.b[a][j].mul_add(p[j], v_free[a]);
            }
        }
    }
    // What the tangents of the step before predict.
    let mut f = state.f;
    let (mut d, mut v) = (deform(&rule.g, &d_free, &f), v_free);
    if plan.rate {
        v = deform(&rule.h, &v_free, &f);
    }
    let mut change = [zero; L];
    for a in 0..L {
        let first = a / N * N;
        for i in 0..N {
            change[a] = state.k[a][i].mul_add(d[first + i] - state.d[first + i], change[a]);
        }
    }
    if plan.rate {
        for a in 0..L {
            let first = a / N * N;
            for i in 0..N {
                change[a] = state.c[a][i].mul_add(v[first + i] - state.v[first + i], change[a]);
            }
        }
    }
    solve(&state.lu[state.held], &mut change);
    for a in 0..L {
        f[a] = f[a] + change[a];
    }
    let mut forces = [zero; L];
    let mut wrong = state.alive & who;
    for iteration in 0..ITERATIONS {
        d = deform(&rule.g, &d_free, &f);
        if plan.rate {
            v = deform(&rule.h, &v_free, &f);
        }
        look(with, plan, rule.dt, (&d, &v), state, &mut forces);
        state.iterations = state.iterations + one.only(wrong);
        let share = plan.tolerance;
        let mut residual = [zero; L];
        for a in 0..L {
            residual[a] = forces[a] - f[a];
        }
        let mut fine = zero.le(one);
        if plan.turns {
            let mut scale = state.scale;
            for a in 0..L {
                let kind = usize::from(plan.rotational[a]);
                scale[kind] = scale[kind].max(forces[a].abs());
            }
            for a in 0..L {
                let allowed = scale[usize::from(plan.rotational[a])] * share;
                fine = fine & residual[a].abs().le(allowed);
            }
        } else {
            let mut scale = state.scale[0];
            for a in 0..L {
                scale = scale.max(forces[a].abs());
            }
            let allowed = scale * share;
            for a in 0..L {
                fine = fine & residual[a].abs().le(allowed);
            }
        }
        wrong = wrong & !fine;
        if !zero.any(wrong) {
            break;
        }
        let mut j = [[zero; L]; L];
        for a in 0..L {
            let first = a / N * N;
            j[a][a] = one;
            for i in 0..N {
                let k = -state.k[a][i];
                for b in 0..L {
                    j[a][b] = k.mul_add(rule.g[first + i][b], j[a][b]);
                }
                if plan.rate {
                    let c = -state.c[a][i];
                    for b in 0..L {
                        j[a][b] = c.mul_add(rule.h[first + i][b], j[a][b]);
                    }
                }
            }
        }
        factor(&mut j);
        // From one place to the other: not a store under a mask.
        let [first, second] = &mut state.lu;
        let (from, to) = if state.held == 0 { (first, second) } else { (second, first) };
        for a in 0..L {
            for b in 0..L {
                to[a][b] = A::Real::select(wrong, j[a][b], from[a][b]);
            }
        }
        solve(to, &mut residual);
        state.held = 1 - state.held;
        // Who goes in circles between two regimes takes shorter ways.
        let part = with.splat(PARTS[(iteration / PATIENCE).min(PARTS.len() - 1)]);
        for a in 0..L {
            f[a] = f[a] + (part * residual[a]).only(wrong);
        }
    }
    Found { d, v, f, forces, source0, integral, q, p, wrong }
}

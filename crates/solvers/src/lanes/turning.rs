//! Where the motion of a link turns inside a step, lane by lane: see the ordinary [`turning`](crate::step).

use super::coefficients::Rule;
use super::plan::{Plan, Run};
use super::state::State;
use trilith_element::lanes::{Arithmetic, LaneLinks, LaneStep, Real, Task};

/// What a step has missed because links turned inside it.
pub(super) struct Turned<R> {
    /// Energy of the impulses, J.
    pub energy: R,
    /// Largest forces that are wrong at its end: of translations and of rotations.
    pub behind: [R; 2],
}

impl<R: Real> Turned<R> {
    pub fn nothing(zero: R) -> Self {
        Self { energy: zero, behind: [zero; 2] }
    }
}

/// Room for the answers of a link.
pub(super) struct Asked<R> {
    there: Vec<R>,
    after: Vec<R>,
    step: [LaneStep<R>; 1],
}

impl<R: Real> Asked<R> {
    pub fn new<const M: usize, const L: usize, const N: usize>(
        plan: &Plan<R, M, L, N>,
        zero: R,
    ) -> Self {
        let most = plan.runs.iter().map(|run| run.extent.history).max().unwrap_or(0);
        let room = vec![zero; most];
        Self { there: room.clone(), after: room, step: [LaneStep::elastic(zero)] }
    }
}

/// Where a link is: deformations, rates, and how long it took.
#[derive(Clone, Copy)]
struct Place<R, const N: usize> {
    d: [R; N],
    v: [R; N],
}

/// What a law says there: force, and stiffness and damping in rows of its own length.
struct Answer<R, const N: usize> {
    f: [R; N],
    k: [[R; N]; N],
}

/// What the step from one state to another, of the analyses in `who`, has missed.
#[inline(always)]
pub(super) fn turned<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    rule: &Rule<A::Real, M, L>,
    asked: &mut Asked<A::Real>,
    who: <A::Real as Real>::Mask,
    (from, to): (&State<A::Real, M, L, N>, &State<A::Real, M, L, N>),
) -> Turned<A::Real> {
    let zero = with.splat(0.0);
    let rates = if plan.rate { *to.v } else { plan.deform(&to.p) };
    // Rates at the start of a motion of constant acceleration.
    let twice = with.splat(2.0) * rule.per_dt;
    let mut starts = [zero; L];
    let mut any = zero.lt(zero);
    let mut turns = [any; L];
    for a in 0..plan.coordinates() {
        starts[a] = twice.mul_add(to.d[a] - from.d[a], -rates[a]);
        // Softness, which is the diagonal of H.
        let soft = rule.h[a][a].lt(zero);
        turns[a] = who & soft & (starts[a] * rates[a]).lt(zero);
        any = any | turns[a];
    }
    let mut out = Turned::nothing(zero);
    if !zero.any(any) {
        return out;
    }
    for run in &plan.runs {
        let n = run.extent.coordinates;
        for link in 0..run.count {
            let first = run.first + link * n;
            for i in first..first + n {
                let turns = turns[i];
                if zero.any(turns) {
                    let at = (link, first, i);
                    let (starts, rates, asked, out) = (&starts, &rates, &mut *asked, &mut out);
                    with.run(One {
                        plan,
                        rule,
                        run,
                        at,
                        turns,
                        starts,
                        rates,
                        from,
                        to,
                        asked,
                        out,
                    });
                }
            }
        }
    }
    out
}

/// One link that turns in one of its coordinates, as a task.
struct One<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    rule: &'a Rule<R, M, L>,
    run: &'a Run,
    /// The link in its run, its first coordinate, and the one that turns.
    at: (usize, usize, usize),
    turns: R::Mask,
    starts: &'a [R; L],
    rates: &'a [R; L],
    from: &'a State<R, M, L, N>,
    to: &'a State<R, M, L, N>,
    asked: &'a mut Asked<R>,
    out: &'a mut Turned<R>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for One<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { plan, rule, run, at, turns, starts, rates, from, to, asked, out } = self;
        let (link, first, i) = at;
        let zero = with.splat(0.0);
        let n = run.extent.coordinates;
        let (tiny, half) = (with.splat(f64::MIN_POSITIVE), with.splat(0.5));
        let (start, end) = (starts[i].abs(), rates[i].abs());
        let left = rule.dt * end / (start + end).max(tiny);
        let s = rule.dt - left;
        let [mut d0, mut d1, mut v0, mut v1] = [[zero; N]; 4];
        for j in 0..n {
            (d0[j], d1[j]) = (from.d[first + j], to.d[first + j]);
            (v0[j], v1[j]) = (starts[first + j], rates[first + j]);
        }
        let mut there = Place { d: d0, v: v0 };
        for j in 0..n {
            let slope = (v1[j] - v0[j]) * rule.per_dt;
            there.d[j] = s.mul_add((half * slope).mul_add(s, v0[j]), d0[j]);
            there.v[j] = slope.mul_add(s, v0[j]);
        }
        let (begin, end) = (Place { d: d0, v: v0 }, Place { d: d1, v: v1 });
        let h =
            run.history + link * run.extent.history..run.history + (link + 1) * run.extent.history;
        let p = run.parameters + link * run.extent.parameters;
        let parameters = &plan.parameters[p..p + run.extent.parameters];
        let Asked { there: led, after, step } = asked;
        let (led, after) = (&mut led[..h.len()], &mut after[..h.len()]);
        let law = (run, parameters);
        let on_turn = ask(with, law, (&begin, &there), s, (&from.history[h], led), step);
        let at_end = ask(with, law, (&there, &end), left, (led, after), step);
        for j in 0..n {
            let a = first + j;
            // At the turning point, beyond what the tangents at the end say.
            let mut told = to.f[a];
            let (k, c) = (to.k.row(plan.block(), a), to.c.row(plan.block(), a));
            for b in 0..n {
                told = k[b].mul_add(there.d[b] - d1[b], told);
                told = c[b].mul_add(there.v[b] - v1[b], told);
            }
            let apart = (on_turn.f[j] - told).abs();
            let behind = (at_end.f[j] - to.f[a]).abs().only(turns);
            let kind = usize::from(plan.rotational[a]);
            out.behind[kind] = out.behind[kind].max(behind);
            let missed = apart.max(behind) * left;
            let way = (d1[j] - there.d[j]).abs();
            let stiff = at_end.k.as_flattened()[j * n + j].abs().max(tiny);
            let kept = half * behind * way.min(behind / stiff);
            let softness = -rule.h[a][a];
            let energy = (missed * missed * softness * rule.per_dt).max(kept);
            out.energy = out.energy + energy.only(turns);
        }
    }
}

/// Leads a law from one place to another.
#[inline(always)]
fn ask<A: Arithmetic, const N: usize>(
    with: A,
    (run, parameters): (&Run, &[A::Real]),
    (from, to): (&Place<A::Real, N>, &Place<A::Real, N>),
    dt: A::Real,
    (history, trial): (&[A::Real], &mut [A::Real]),
    step: &mut [LaneStep<A::Real>; 1],
) -> Answer<A::Real, N> {
    let zero = with.splat(0.0);
    let n = run.extent.coordinates;
    let mut answer = Answer { f: [zero; N], k: [[zero; N]; N] };
    let mut c = [[zero; N]; N];
    let mut links = LaneLinks {
        parameters,
        d: &to.d[..n],
        v: &to.v[..n],
        d0: &from.d[..n],
        v0: &from.v[..n],
        dt,
        history,
        trial,
        f: &mut answer.f[..n],
        k: &mut answer.k.as_flattened_mut()[..n * n],
        c: &mut c.as_flattened_mut()[..n * n],
    };
    run.laws.respond(with, &mut links, step);
    answer
}

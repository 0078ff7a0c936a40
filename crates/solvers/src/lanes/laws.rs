//! How the laws of all links are asked.

use super::plan::Plan;
use super::record::Record;
use super::state::State;
use trilith_element::lanes::{Arithmetic, LaneLinks, Real};

/// Calls the laws: forces and tangents, and history and energies for the case that the step ends here.
#[inline(always)]
pub(super) fn look<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    dt: A::Real,
    at: (&[A::Real; L], &[A::Real; L]),
    state: &mut State<A::Real, M, L, N>,
    f: &mut [A::Real; L],
) {
    let State { d, v, history, trial, k, c, steps, .. } = state;
    let (d0, v0) = (&**d, &**v);
    if let [run] = &plan.runs[..]
        && run.extent.coordinates == plan.block()
        && run.count * plan.block() == L
    {
        // One law that leaves no place empty: all there is, and no bounds to be looked at.
        let mut links = LaneLinks {
            parameters: &plan.parameters,
            d: at.0,
            v: at.1,
            d0,
            v0,
            dt,
            history,
            trial,
            f,
            k: k.rows_mut(plan.block(), 0..L),
            c: c.rows_mut(plan.block(), 0..L),
        };
        return run.laws.respond(with, &mut links, steps);
    }
    let mut steps = &mut steps[..];
    for run in &plan.runs {
        let (own, n) = (run.extent, run.extent.coordinates);
        let r = run.first..run.first + run.count * n;
        let (h, p) = (run.history, run.parameters);
        let whole = n == plan.block();
        // A narrow link: its blocks are spread afterwards.
        let mut narrow = Narrow::<_, N>::new(dt, whole);
        let blocks = match &mut narrow {
            Some(own) => {
                (&mut own.k.as_flattened_mut()[..n * n], &mut own.c.as_flattened_mut()[..n * n])
            }
            None => (k.rows_mut(n, r.clone()), c.rows_mut(n, r.clone())),
        };
        let mut links = LaneLinks {
            parameters: &plan.parameters[p..p + run.count * own.parameters],
            d: &at.0[r.clone()],
            v: &at.1[r.clone()],
            d0: &d0[r.clone()],
            v0: &v0[r.clone()],
            dt,
            history: &history[h..h + run.count * own.history],
            trial: &mut trial[h..h + run.count * own.history],
            f: &mut f[r],
            k: blocks.0,
            c: blocks.1,
        };
        let (now, rest) = steps.split_at_mut(run.count);
        run.laws.respond(with, &mut links, now);
        steps = rest;
        if let Some(own) = &narrow {
            let blocks = (own.k.as_flattened(), own.c.as_flattened());
            for i in 0..n {
                let row = run.first + i..run.first + i + 1;
                let to = (k.rows_mut(plan.block(), row.clone()), c.rows_mut(plan.block(), row));
                for j in 0..n {
                    to.0[j] = blocks.0[i * n + j];
                    to.1[j] = blocks.1[i * n + j];
                }
            }
        }
    }
}

/// Blocks of a link with fewer coordinates than the widest.
struct Narrow<R, const N: usize> {
    k: [[R; N]; N],
    c: [[R; N]; N],
}

impl<R: Real, const N: usize> Narrow<R, N> {
    #[inline(always)]
    fn new(zero: R, whole: bool) -> Option<Self> {
        if whole { None } else { Some(Self { k: [[zero; N]; N], c: [[zero; N]; N] }) }
    }
}

/// Asks what the contacts do where the state is.
#[inline(always)]
pub(super) fn contacts<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    state: &State<A::Real, M, L, N>,
    record: &mut Record<A::Real>,
) {
    let State { d, v, history, .. } = state;
    let Record { contacts, fallen, .. } = record;
    let mut f = *state.f;
    for run in plan.runs.iter().filter(|run| run.extent.contacts > 0) {
        let (own, count) = (run.extent, run.count);
        let r = run.first..run.first + count * own.coordinates;
        let (h, p) = (run.history, run.parameters);
        let (d, v) = (&d[r.clone()], &v[r.clone()]);
        let links = LaneLinks {
            parameters: &plan.parameters[p..p + count * own.parameters],
            d,
            v,
            d0: d,
            v0: v,
            dt: with.splat(0.0),
            history: &history[h..h + count * own.history],
            trial: &mut [],
            f: &mut f[r],
            k: &mut [],
            c: &mut [],
        };
        let seen = &mut contacts[run.contact..][..count * own.contacts];
        run.laws.contacts(with, &links, seen, &mut fallen[run.link..][..count]);
    }
}

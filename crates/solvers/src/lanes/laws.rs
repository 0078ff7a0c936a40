//! How the laws of all links are asked.

use super::plan::Plan;
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
        && run.law.coordinates == N
        && run.count * N == L
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
            k: k.as_flattened_mut(),
            c: c.as_flattened_mut(),
        };
        return with.respond(&run.law, &mut links, steps);
    }
    let mut steps = &mut steps[..];
    for run in &plan.runs {
        let (law, n) = (&run.law, run.law.coordinates);
        let r = run.first..run.first + run.count * n;
        let (h, p) = (run.history, run.parameters);
        let whole = n == N;
        // A narrow link: its blocks are spread afterwards.
        let mut narrow = Narrow::new(dt, whole);
        let blocks = match &mut narrow {
            Some(own) => (&mut own.k[..n * n], &mut own.c[..n * n]),
            None => (k[r.clone()].as_flattened_mut(), c[r.clone()].as_flattened_mut()),
        };
        let mut links = LaneLinks {
            parameters: &plan.parameters[p..p + run.count * law.parameters],
            d: &at.0[r.clone()],
            v: &at.1[r.clone()],
            d0: &d0[r.clone()],
            v0: &v0[r.clone()],
            dt,
            history: &history[h..h + run.count * law.history],
            trial: &mut trial[h..h + run.count * law.history],
            f: &mut f[r],
            k: blocks.0,
            c: blocks.1,
        };
        let (own, rest) = steps.split_at_mut(run.count);
        with.respond(law, &mut links, own);
        steps = rest;
        if let Some(own) = &narrow {
            for i in 0..n {
                for j in 0..n {
                    k[run.first + i][j] = own.k[i * n + j];
                    c[run.first + i][j] = own.c[i * n + j];
                }
            }
        }
    }
}

/// Blocks of a link with fewer coordinates than the widest.
struct Narrow<R> {
    k: [R; 4],
    c: [R; 4],
}

impl<R: Real> Narrow<R> {
    #[inline(always)]
    fn new(zero: R, whole: bool) -> Option<Self> {
        if whole { None } else { Some(Self { k: [zero; 4], c: [zero; 4] }) }
    }
}

//! Links of one analysis side by side: a law looks at up to four of them at once, each in a lane of one register.
//! Every link gets the bits that it gets alone.

use super::law::RespondTask;
use super::{Arithmetic, Fused, FusedOne, LaneAt, LaneForce, LaneLaw, LaneLinks, LaneStep};
use super::{Task, Wide};
use pulp::x86::V3;
use std::marker::PhantomData;

/// Four links.
type Four = Wide<V3>;

/// Most coordinates, history variables and parameters of a link that goes with others.
const COORDINATES: usize = 3;
const NUMBERS: usize = 16;

/// True where the links of a law may go side by side.
const fn fit<L: LaneLaw>() -> bool {
    !L::IS_LONG
        && L::COORDINATES <= COORDINATES
        && L::HISTORY <= NUMBERS
        && L::PARAMETERS <= NUMBERS
}

/// Forces, tangents and the end of a step for links of a law, as many side by side as there are.
pub(super) fn respond_together<L: LaneLaw>(
    with: FusedOne,
    links: &mut LaneLinks<'_, Fused>,
    steps: &mut [LaneStep<Fused>],
) {
    let mut first = 0;
    if const { fit::<L>() } {
        while steps.len() - first >= 2 {
            let count = (steps.len() - first).min(4);
            let steps = &mut steps[first..first + count];
            with.run(RespondGroup::<L> { links, first, steps, law: PhantomData });
            first += count;
        }
    }
    for i in first..steps.len() {
        steps[i] = with.run(RespondTask::<L, _>(links, i, PhantomData));
    }
}

/// Two to four links from `first` on; a task for each group, as a law inside a loop takes several times as long to compile.
struct RespondGroup<'a, 'b, L> {
    links: &'a mut LaneLinks<'b, Fused>,
    first: usize,
    steps: &'a mut [LaneStep<Fused>],
    law: PhantomData<L>,
}

impl<L: LaneLaw> Task<FusedOne> for RespondGroup<'_, '_, L> {
    type Output = ();

    #[inline(always)]
    fn run(self, with: FusedOne) {
        let Self { links, first, steps, .. } = self;
        let (n, h, p) = (L::COORDINATES, L::HISTORY, L::PARAMETERS);
        let group = Group { simd: with.0, first, count: steps.len() };
        let zero = group.splat(Fused(0.0));
        let parameters = group.read::<NUMBERS>(links.parameters, p);
        let history = group.read::<NUMBERS>(links.history, h);
        let d = group.read::<COORDINATES>(links.d, n);
        let v = group.read::<COORDINATES>(links.v, n);
        let d0 = group.read::<COORDINATES>(links.d0, n);
        let v0 = group.read::<COORDINATES>(links.v0, n);
        let at = LaneAt {
            parameters: &parameters[..p],
            d: &d[..n],
            v: &v[..n],
            d0: &d0[..n],
            v0: &v0[..n],
            dt: group.splat(links.dt),
            history: &history[..h],
        };
        let mut f = [zero; COORDINATES];
        let [mut k, mut c] = [[zero; COORDINATES * COORDINATES]; 2];
        let mut force = LaneForce { f: &mut f[..n], k: &mut k[..n * n], c: &mut c[..n * n] };
        let mut trial = [zero; NUMBERS];
        let step = L::respond(&at, &mut force, &mut trial[..h]);
        group.write(links.f, n, &f);
        group.write(links.k, n * n, &k);
        group.write(links.c, n * n, &c);
        group.write(links.trial, h, &trial);
        for (lane, to) in steps.iter_mut().enumerate() {
            let of = |x: Four| lane_of(x, lane);
            *to = LaneStep {
                stored: of(step.stored),
                hysteretic: of(step.hysteretic),
                viscous: of(step.viscous),
            };
        }
    }
}

/// So many links from `first` on; where there are fewer than four, the last goes in the lanes that are left.
#[derive(Clone, Copy)]
struct Group {
    simd: V3,
    first: usize,
    count: usize,
}

impl Group {
    #[inline(always)]
    fn splat(self, x: Fused) -> Four {
        Four::splat(self.simd, x.0)
    }

    /// The numbers of the links, `count` to each and not more than `N`.
    #[inline(always)]
    fn read<const N: usize>(self, from: &[Fused], count: usize) -> [Four; N] {
        let from = &from[self.first * count..][..self.count * count];
        // Each by its name: a closure is a call here.
        let last = self.count - 1;
        let (a, b) = (&from[..count], &from[1.min(last) * count..][..count]);
        let (c, d) = (&from[2.min(last) * count..][..count], &from[3.min(last) * count..][..count]);
        let mut to = [self.splat(Fused(0.0)); N];
        for i in 0..count {
            to[i] = Four::of_four(self.simd, [a[i].0, b[i].0, c[i].0, d[i].0]);
        }
        to
    }

    #[inline(always)]
    fn write(self, to: &mut [Fused], count: usize, from: &[Four]) {
        let to = &mut to[self.first * count..][..self.count * count];
        for lane in 0..self.count {
            for i in 0..count {
                to[lane * count + i] = lane_of(from[i], lane);
            }
        }
    }
}

#[inline(always)]
fn lane_of(x: Four, lane: usize) -> Fused {
    Fused(x.four()[lane])
}

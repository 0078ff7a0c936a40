//! Where a march is: the motion and the links. What is counted and seen on the way is in its [`record`](super::record).

use super::blocks::Blocks;
use super::plan::{Plan, coordinate_wise, mode_wise, pick};
use super::setup::LaneSetup;
use super::small::Aligned;
use trilith_element::lanes::{Arithmetic, LaneStep, Real, Task};

/// Where a march is.
#[derive(Clone)]
pub(super) struct State<R: Real, const M: usize, const L: usize, const N: usize> {
    pub q: Aligned<[R; M]>,
    pub p: Aligned<[R; M]>,
    pub a: Aligned<[R; M]>,
    /// Amplitude of each channel, where an output asks for accelerations.
    pub amplitudes: Vec<R>,
    pub d: Aligned<[R; L]>,
    pub v: Aligned<[R; L]>,
    pub f: Aligned<[R; L]>,
    /// Tangents of the last look at the laws, for the iteration of a step.
    pub k: Blocks<R, N, L>,
    pub c: Blocks<R, N, L>,
    /// Largest stiffness of each coordinate so far, where steps are adaptive.
    pub stiffest: Aligned<[R; L]>,
    /// Bᵀ f.
    pub push: Aligned<[R; M]>,
    /// What the forces answer to deformations, and to rates, that the modes would have with forces held: (I + k G
    /// + c H)⁻¹ times k, and c, column by column.
    pub answer: Aligned<[[R; L]; L]>,
    pub answer_to_rate: Aligned<[[R; L]; L]>,
    pub history: Vec<R>,
    /// History at the end of the step that is looked for.
    pub trial: Vec<R>,
    pub scale: [R; 2],
    pub alive: R::Mask,
    pub lost: R,
    pub steps: Vec<LaneStep<R>>,
    /// Looks at the laws.
    pub iterations: R,
}

impl<R: Real, const M: usize, const L: usize, const N: usize> State<R, M, L, N> {
    pub fn new<A: Arithmetic<Real = R>>(
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
    ) -> Self {
        let one = setups[0];
        let zero = with.splat(0.0);
        let get = |of: &dyn Fn(&LaneSetup) -> f64| pick(with, setups, of);
        let mode_wise = |of: &dyn Fn(&LaneSetup, usize) -> f64| mode_wise::<A, M>(with, setups, of);
        let flat = |of: &dyn Fn(&LaneSetup, usize) -> f64| {
            coordinate_wise::<A, L>(with, setups, &plan.places, of)
        };
        let f = flat(&|s, i| s.f[i]);
        let stiffness = flat(&|s, i| s.stiffness[i]);
        let mut k = Blocks::filled(zero);
        let n = plan.block();
        for a in 0..plan.coordinates() {
            k.rows_mut(n, a..a + 1)[a % n] = stiffness[a];
        }
        let history: Vec<R> = (0..one.history.len()).map(|i| get(&|s| s.history[i])).collect();
        let links = one.forms.len();
        let stored: Vec<R> = (0..links).map(|l| get(&|s| s.stored[l])).collect();
        Self {
            q: mode_wise(&|s, j| s.q[j]),
            p: mode_wise(&|s, j| s.p[j]),
            a: mode_wise(&|s, j| s.a[j]),
            amplitudes: vec![zero; one.forces.len()],
            d: flat(&|s, i| s.d[i]),
            v: flat(&|s, i| if plan.rate { s.v[i] } else { f64::NAN }),
            push: Aligned(plan.push(&f)),
            f,
            k,
            stiffest: flat(&|s, i| s.stiffest[i]),
            c: Blocks::filled(zero),
            answer: Aligned::full_of(zero),
            answer_to_rate: Aligned::full_of(zero),
            trial: history.clone(),
            history,
            scale: [0, 1].map(|i| get(&|s| s.scale[i])),
            alive: zero.le(with.splat(1.0)),
            lost: zero,
            steps: stored.iter().map(|s| LaneStep::elastic(*s)).collect(),
            iterations: zero,
        }
    }
}

impl<R: Real, const M: usize, const L: usize, const N: usize> State<R, M, L, N> {
    /// Where another state is, as the start of a step into this one: what the step itself writes, tangents and energies of
    /// the links among it, is left.
    #[inline(always)]
    pub fn start_from(&mut self, from: &Self, plan: &Plan<R, M, L, N>) {
        for j in 0..plan.modes() {
            self.q[j] = from.q[j];
            self.p[j] = from.p[j];
            self.push[j] = from.push[j];
        }
        for a in 0..plan.coordinates() {
            self.d[a] = from.d[a];
            self.f[a] = from.f[a];
            self.stiffest[a] = from.stiffest[a];
        }
        if plan.rate {
            for a in 0..plan.coordinates() {
                self.v[a] = from.v[a];
            }
        }
        (self.scale, self.alive) = (from.scale, from.alive);
        copy(&from.history, &mut self.history);
    }

    /// The motion and the links of another state; how often the laws were asked is left.
    #[inline(always)]
    pub fn follow(&mut self, from: &Self, plan: &Plan<R, M, L, N>) {
        self.start_from(from, plan);
        let (n, all) = (plan.block(), plan.coordinates());
        copy(from.k.rows(n, 0..all), self.k.rows_mut(n, 0..all));
        if plan.rate {
            copy(from.c.rows(n, 0..all), self.c.rows_mut(n, 0..all));
        }
        if plan.accelerations {
            self.a = from.a;
            copy(&from.amplitudes, &mut self.amplitudes);
        }
        for (to, from) in self.steps.iter_mut().zip(&from.steps) {
            *to = *from;
        }
    }

    /// The same of the analyses in a mask.
    #[inline(always)]
    pub fn follow_where(&mut self, mask: R::Mask, from: &Self, plan: &Plan<R, M, L, N>) {
        take_motion(mask, from, self, plan);
        for (to, from) in self.steps.iter_mut().zip(&from.steps) {
            to.stored = R::select(mask, from.stored, to.stored);
            (to.hysteretic, to.viscous) = (from.hysteretic, from.viscous);
        }
    }

    /// Takes note of the stiffness at the end of a step.
    #[inline(always)]
    pub fn stiffen(&mut self, plan: &Plan<R, M, L, N>) {
        for a in 0..plan.coordinates() {
            self.stiffest[a] = self.stiffest[a].max(self.k.own(plan.block(), a));
        }
    }
}

/// A few numbers, for which a call would cost more than they do.
#[inline(always)]
fn copy<R: Real>(from: &[R], to: &mut [R]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// Where a mask says yes `to` becomes `from`.
#[inline(always)]
fn take_all<R: Real>(mask: R::Mask, from: &[R], to: &mut [R]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = R::select(mask, *from, *to);
    }
}

/// The motion and the links.
#[inline(always)]
fn take_motion<R: Real, const M: usize, const L: usize, const N: usize>(
    mask: R::Mask,
    from: &State<R, M, L, N>,
    to: &mut State<R, M, L, N>,
    plan: &Plan<R, M, L, N>,
) {
    let (m, l, n) = (plan.modes(), plan.coordinates(), plan.block());
    take_all(mask, &from.q[..m], &mut to.q[..m]);
    take_all(mask, &from.p[..m], &mut to.p[..m]);
    take_all(mask, &from.push[..m], &mut to.push[..m]);
    take_all(mask, &from.d[..l], &mut to.d[..l]);
    take_all(mask, &from.f[..l], &mut to.f[..l]);
    take_all(mask, &from.stiffest[..l], &mut to.stiffest[..l]);
    take_all(mask, from.k.rows(n, 0..l), to.k.rows_mut(n, 0..l));
    if plan.rate {
        take_all(mask, &from.v[..l], &mut to.v[..l]);
        take_all(mask, from.c.rows(n, 0..l), to.c.rows_mut(n, 0..l));
    }
    if plan.accelerations {
        take_all(mask, &*from.a, &mut *to.a);
        take_all(mask, &from.amplitudes, &mut to.amplitudes);
    }
    take_all(mask, &from.history, &mut to.history);
    take_all(mask, &from.scale, &mut to.scale);
}

/// Takes the other state where a mask says no. Who is alive and how often the laws were asked is left.
#[inline(never)]
pub(super) fn keep<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    mask: <A::Real as Real>::Mask,
    to: &mut State<A::Real, M, L, N>,
    from: &State<A::Real, M, L, N>,
) {
    with.run(Keep { plan, mask, to, from });
}

/// What [`keep`] does, as a task.
struct Keep<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    mask: R::Mask,
    to: &'a mut State<R, M, L, N>,
    from: &'a State<R, M, L, N>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Keep<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, _: A) {
        let Self { plan, mask, to, from } = self;
        take_motion(!mask, from, to, plan);
        take_answers(!mask, from, to);
        for (to, from) in to.steps.iter_mut().zip(&from.steps) {
            to.stored = A::Real::select(mask, to.stored, from.stored);
        }
    }
}

/// The next first guess expects no answer where a mask says so: after a failure the tangents may be no numbers.
pub(super) fn forget<R: Real, const M: usize, const L: usize, const N: usize>(
    mask: R::Mask,
    state: &mut State<R, M, L, N>,
) {
    let answers = [&mut state.answer, &mut state.answer_to_rate];
    for x in answers.into_iter().flat_map(|b| b.as_flattened_mut()) {
        *x = R::select(mask, x.of(0.0), *x);
    }
}

/// Takes the answers of the tangents of another state where a mask says so.
#[inline(always)]
pub(super) fn take_answers<R: Real, const M: usize, const L: usize, const N: usize>(
    mask: R::Mask,
    from: &State<R, M, L, N>,
    to: &mut State<R, M, L, N>,
) {
    take_all(mask, from.answer.as_flattened(), to.answer.as_flattened_mut());
    take_all(mask, from.answer_to_rate.as_flattened(), to.answer_to_rate.as_flattened_mut());
}

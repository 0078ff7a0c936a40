//! A step on trial: whole and in two halves.

use super::error::{Norms, Tried};
use super::loads::{Loads, Points};
use super::newton::{Found, foresee_by_tangents, settle};
use super::pieces::look_behind;
use super::plan::Plan;
use super::record::{Record, take_record};
use super::rules::Rules;
use super::state::State;
use super::step::{Passed, account_apart, take};
use super::turning::{Asked, Turned, turned};
use trilith_element::lanes::{Arithmetic, Real, Task};

/// A step on trial.
pub(super) struct Trial<R: Real, const M: usize, const L: usize, const N: usize> {
    whole: State<R, M, L, N>,
    halves: [State<R, M, L, N>; 2],
    /// What was counted before halves were accepted by some.
    before: Record<R>,
    found: Found<R, M, L>,
    passed: [Passed<R, M>; 3],
    asked: Asked<R>,
    /// Energy of the impulses that the halves have missed, and link forces that they have wrong.
    missed: R,
    turned: [R; 2],
}

impl<R: Real, const M: usize, const L: usize, const N: usize> Trial<R, M, L, N> {
    pub fn new<A: Arithmetic<Real = R>>(
        with: A,
        plan: &Plan<R, M, L, N>,
        (at, record): (&State<R, M, L, N>, &Record<R>),
    ) -> Self {
        let zero = with.splat(0.0);
        Self {
            whole: at.clone(),
            halves: [at.clone(), at.clone()],
            before: record.clone(),
            found: Found::new(zero),
            passed: [0; 3].map(|_| Passed::new(zero)),
            asked: Asked::new(plan, zero),
            missed: zero,
            turned: [zero; 2],
        }
    }

    /// Makes whole and halves for the analyses in `who`; gives back who of them has found no equilibrium.
    #[inline(always)]
    pub fn make<A: Arithmetic<Real = R>>(
        &mut self,
        with: A,
        plan: &Plan<R, M, L, N>,
        [rules, of_halves]: &mut [Rules<R, M, L>; 2],
        loads: &Points<R, M>,
        (who, [start, middle]): (R::Mask, [R; 2]),
        at: &State<R, M, L, N>,
    ) -> R::Mask {
        let Self { whole, halves: [first, second], found, passed, asked, .. } = self;
        let [p0, p1, p2] = passed;
        let (of_whole, [of_first, of_second]) = (&loads.whole, &loads.halves);
        let (w0, _) = make(
            with,
            Make {
                plan,
                rules,
                loads: of_whole,
                t: start,
                who,
                from: at,
                to: whole,
                found,
                passed: p0,
                asked: None,
            },
        );
        let (w1, before) = make(
            with,
            Make {
                plan,
                rules: of_halves,
                loads: of_first,
                t: start,
                who,
                from: at,
                to: first,
                found,
                passed: p1,
                asked: Some(asked),
            },
        );
        let (w2, behind) = make(
            with,
            Make {
                plan,
                rules: of_halves,
                loads: of_second,
                t: middle,
                who,
                from: first,
                to: second,
                found,
                passed: p2,
                asked: Some(asked),
            },
        );
        let wrong = w0 | w1 | w2;
        self.missed = before.energy + behind.energy;
        for kind in 0..2 {
            self.turned[kind] = before.behind[kind].max(behind.behind[kind]);
        }
        wrong
    }

    #[inline(always)]
    pub fn tried(&self) -> Tried<'_, R, M, L, N> {
        let Self { whole, halves, passed: [_, first, second], missed, turned, .. } = self;
        let work = first.of_links() + second.of_links();
        Tried { whole, halves, work, missed: *missed, turned: *turned }
    }

    /// The halves of the analyses in `ok` are kept; `all`: of all that there are.
    #[inline(always)]
    pub fn accept<A: Arithmetic<Real = R>>(
        &mut self,
        with: A,
        plan: &Plan<R, M, L, N>,
        half: &Rules<R, M, L>,
        (ok, all): (R::Mask, bool),
        (at, record): (&mut State<R, M, L, N>, &mut Record<R>),
        norms: &mut Norms<R>,
    ) {
        let Self { halves, before, passed: [_, first, second], .. } = self;
        let zero = with.splat(0.0);
        if !all {
            take_record(with, zero.le(zero), record, before);
        }
        // Of the others it is rubbish, and forgotten.
        for (made, passed) in halves.iter().zip([first, second]) {
            account_apart(with, plan, half.exact(), passed, made, record);
            norms.see(ok, record.in_motion());
        }
        if !all {
            take_record(with, !ok, before, record);
        }
        let some = (!all).then_some(ok);
        follow(with, plan, some, &halves[1], at);
        norms.reach(plan, ok, at);
    }

    /// Looks at what outputs are where loads have jumped, of the analyses in a mask, at their times.
    pub fn look_behind<A: Arithmetic<Real = R>>(
        with: A,
        plan: &Plan<R, M, L, N>,
        loads: &Points<R, M>,
        (jumps, t): (R::Mask, R),
        (at, record): (&mut State<R, M, L, N>, &mut Record<R>),
    ) {
        let before = &(at.clone(), record.clone());
        at.amplitudes.copy_from_slice(&loads.start);
        look_behind(with, plan, &loads.whole.start, (jumps, t), before, (at, record));
    }

    /// Evaluations of the link laws.
    pub fn iterations(&self) -> R {
        let [first, second] = &self.halves;
        self.whole.iterations + first.iterations + second.iterations
    }
}

/// Makes one step.
#[inline(never)]
fn make<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    step: Make<'_, A::Real, M, L, N>,
) -> (<A::Real as Real>::Mask, Turned<A::Real>) {
    with.run(step)
}

/// One step into `to`, as a task; gives back who has found no equilibrium, and what a half has missed.
struct Make<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    rules: &'a mut Rules<R, M, L>,
    loads: &'a Loads<R, M>,
    /// Where it begins, s, and for whom.
    t: R,
    who: R::Mask,
    from: &'a State<R, M, L, N>,
    to: &'a mut State<R, M, L, N>,
    found: &'a mut Found<R, M, L>,
    passed: &'a mut Passed<R, M>,
    /// Of a half.
    asked: Option<&'a mut Asked<R>>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Make<'_, A::Real, M, L, N>
{
    type Output = (<A::Real as Real>::Mask, Turned<A::Real>);

    #[inline(always)]
    fn run(self, with: A) -> Self::Output {
        let Self { plan, rules, loads, t, who, from, to, found, passed, asked } = self;
        to.start_from(from, plan);
        let rule = rules.choose(plan, from);
        foresee_by_tangents(plan, rule, loads, from, found);
        settle(with, plan, rule, (who, false), to, found);
        take(plan, rule, (loads, t), found, to, passed);
        to.stiffen(plan);
        let turned = match asked {
            Some(asked) => turned(with, plan, rule, asked, who, (from, to)),
            None => Turned::nothing(with.splat(0.0)),
        };
        (found.wrong, turned)
    }
}

/// A state that was made is where the analyses are: some of them, or all.
#[inline(never)]
pub(super) fn follow<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    some: Option<<A::Real as Real>::Mask>,
    made: &State<A::Real, M, L, N>,
    at: &mut State<A::Real, M, L, N>,
) {
    with.run(Follow { plan, some, made, at });
}

/// What [`follow`] does, as a task.
struct Follow<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    some: Option<R::Mask>,
    made: &'a State<R, M, L, N>,
    at: &'a mut State<R, M, L, N>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Follow<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, _: A) {
        let Self { plan, some, made, at } = self;
        match some {
            Some(ok) => at.follow_where(ok, made, plan),
            None => at.follow(made, plan),
        }
    }
}

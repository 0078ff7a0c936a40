//! The march with adaptive steps: every analysis goes its own way in time.
//!
//! ```text
//! whole:  from t over h            halves:  from t over h/2, and once more
//! ```
//!
//! All analyses make such a step at once, each from where it is and with its own length. What whole and halves are apart
//! is its error (`error`). Who is within the tolerance keeps the halves, the others halve their step and try again;
//! when a step is doubled, halved and given up is what the ordinary [`march`](crate::march) says.

use super::LaneOutcome;
use super::coefficients::Rule;
use super::error::{Norms, Tried};
use super::loads::Loads;
use super::newton::{Found, foresee_by_tangents, settle};
use super::plan::Plan;
use super::setup::LaneSetup;
use super::show::show;
use super::small::Aligned;
use super::state::{Keep, State};
use super::step::{Passed, acceleration, account, take};
use super::turning::{Asked, Turned, turned};
use super::way::{Next, Way};
use crate::march::{ACCURACY_DEPTH, may_grow};
use crate::single_mode::Mode;
use trilith_element::lanes::{Arithmetic, Real, Task};

/// A march with adaptive steps, as a task.
pub(super) struct Adaptive<'a, const M: usize, const L: usize, const N: usize> {
    pub setups: &'a [&'a LaneSetup],
}

/// Lanes at most.
const MOST: usize = 8;

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Adaptive<'_, M, L, N>
{
    type Output = Vec<LaneOutcome>;

    #[inline(always)]
    fn run(self, with: A) -> Vec<LaneOutcome> {
        let setups = self.setups;
        let plan = Plan::<A::Real, M, L, N>::new(with, setups);
        let mut at = State::new(with, setups, &plan);
        let mut trial = Trial::new(with, &plan, &at);
        let mut norms = Norms::new(with, setups);
        let mut sizes = Sizes::new(setups);
        let mut loads = Points::new(with, &plan);
        let mut ways: Vec<Way<'_>> = setups.iter().map(|s| Way::new(s)).collect();
        loop {
            let mut next = [None; MOST];
            next.iter_mut().zip(&mut ways).for_each(|(next, way)| *next = way.next());
            if next.iter().all(Option::is_none) {
                break;
            }
            let rules = sizes.choose(with, setups, &plan, &next);
            loads.gather(with, &plan, &ways);
            let time = |of: fn(&Next) -> f64| with.gather(|i| next[i].as_ref().map_or(0.0, of));
            let starts = [time(|n| n.start), time(|n| n.middle)];
            if plan.accelerations && next.iter().flatten().any(|n| n.jump) {
                let jumps = mask(with, |i| next[i].is_some_and(|n| n.jump));
                trial.look_behind(with, &plan, &loads, (jumps, starts[0]), &mut at);
            }
            let who = mask(with, |i| next[i].is_some());
            let wrong = trial.make(with, &plan, rules, &loads, (who, starts), &at);
            let error = norms.measure(with, &plan, &at, &trial.tried());
            let error = Errors::new(with, wrong, &error);
            let mut accepted = [false; MOST];
            for (i, way) in ways.iter_mut().enumerate() {
                if let Some(next) = &next[i] {
                    accepted[i] = error.decide(i, next.start, way);
                }
            }
            if accepted.contains(&true) {
                let all = (0..ways.len()).all(|i| accepted[i]);
                let ok = mask(with, |i| accepted[i]);
                trial.accept(with, &plan, &rules[1], (ok, all), &mut at, &mut norms);
            }
        }
        let lost = |i: usize| ways.get(i).and_then(|way| way.lost);
        at.alive = mask(with, |i| lost(i).is_none());
        at.lost = with.gather(|i| lost(i).unwrap_or(0.0));
        at.iterations = trial.iterations();
        (0..setups.len()).map(|i| at.outcome(with, setups[i], i)).collect()
    }
}

/// Lanes of which something holds.
#[inline(always)]
fn mask<A: Arithmetic>(with: A, of: impl Fn(usize) -> bool) -> <A::Real as Real>::Mask {
    with.splat(0.0).lt(with.gather(|i| f64::from(u8::from(of(i)))))
}

/// The errors of the steps on trial, lane by lane.
struct Errors {
    wrong: [f64; MOST],
    error: [f64; MOST],
    on_way: [f64; MOST],
}

impl Errors {
    #[inline(always)]
    fn new<A: Arithmetic>(
        with: A,
        wrong: <A::Real as Real>::Mask,
        [error, on_way]: &[A::Real; 2],
    ) -> Self {
        let lanes = |x: A::Real| {
            let mut all = [0.0; MOST];
            with.store(x, &mut all);
            all
        };
        let wrong = lanes(with.splat(1.0).only(wrong));
        Self { wrong, error: lanes(*error), on_way: lanes(*on_way) }
    }

    /// Whether the step of a lane from `t` is accepted; the lane goes on or back accordingly.
    #[inline(always)]
    fn decide(&self, lane: usize, t: f64, way: &mut Way<'_>) -> bool {
        let (error, on_way) = (self.error[lane], self.on_way[lane]);
        let tolerance = way.tolerance();
        let within = error <= tolerance && on_way <= tolerance;
        if self.wrong[lane] == 1.0 {
            way.halve(t);
        } else if within {
            way.advance(may_grow(error, on_way, tolerance));
            return true;
        } else if error.is_finite() && on_way.is_finite() && way.level < ACCURACY_DEPTH {
            way.halve(t);
        } else {
            // The ordinary engine says what is wrong.
            way.give_up(t);
        }
        false
    }
}

/// The rules of the whole steps and of the halves.
struct Sizes<R, const M: usize, const L: usize> {
    rules: Option<[Rule<R, M, L>; 2]>,
    lengths: Vec<f64>,
    /// What was made so far of each analysis.
    known: Vec<Known>,
}

/// Lengths whose coefficients are kept.
const KEPT: usize = 128;

impl<R: Real, const M: usize, const L: usize> Sizes<R, M, L> {
    fn new(setups: &[&LaneSetup]) -> Self {
        let lengths = setups.iter().map(|s| s.shape.grid.step()).collect();
        Self { rules: None, lengths, known: vec![Known::default(); setups.len()] }
    }

    /// Rules for what comes next; those who have nothing to do go on with what they had.
    #[inline(always)]
    fn choose<A: Arithmetic<Real = R>, const N: usize>(
        &mut self,
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
        next: &[Option<Next>],
    ) -> &[Rule<R, M, L>; 2] {
        let Self { rules, lengths, known } = self;
        let mut same = true;
        for (length, next) in lengths.iter_mut().zip(next) {
            if let Some(next) = next {
                same &= *length == next.length;
                *length = next.length;
            }
        }
        if !same {
            rules.take();
        }
        rules.get_or_insert_with(|| {
            for ((length, known), setup) in lengths.iter().zip(&mut *known).zip(setups) {
                known.add(*length, setup);
            }
            let sizes = |share: f64| -> Vec<(f64, &[Mode])> {
                let sizes = lengths.iter().zip(&*known);
                sizes.map(|(x, known)| (share * x, known.of(share * x))).collect()
            };
            [Rule::new(with, plan, &sizes(1.0)), Rule::new(with, plan, &sizes(0.5))]
        })
    }
}

/// Coefficients of the lengths that an analysis has had.
#[derive(Clone, Default)]
struct Known(Vec<(f64, Vec<Mode>)>);

impl Known {
    /// Makes those of a length and of its half.
    #[inline]
    fn add(&mut self, length: f64, setup: &LaneSetup) {
        for length in [length, 0.5 * length] {
            if self.of(length).is_empty() {
                self.make(length, setup);
            }
        }
    }

    #[cold]
    fn make(&mut self, length: f64, setup: &LaneSetup) {
        if self.0.len() >= KEPT {
            // The half goes with the whole.
            self.0.drain(..2);
        }
        self.0.push((length, setup.modes_of(length)));
    }

    /// Of a length that was made; nothing of others.
    #[inline]
    fn of(&self, length: f64) -> &[Mode] {
        self.0.iter().find(|(x, _)| *x == length).map_or(&[], |(_, modes)| modes)
    }
}

/// Loads at the start, in the middle and at the end of the steps.
struct Points<R, const M: usize> {
    whole: Loads<R, M>,
    halves: [Loads<R, M>; 2],
    /// Amplitudes at the start, where an output asks for accelerations.
    start: Vec<R>,
}

impl<R: Real, const M: usize> Points<R, M> {
    fn new<A: Arithmetic<Real = R>, const L: usize, const N: usize>(
        with: A,
        plan: &Plan<R, M, L, N>,
    ) -> Self {
        let none = || plan.no_loads(with);
        Self { whole: none(), halves: [none(), none()], start: none().amplitudes }
    }

    #[inline(always)]
    fn gather<A: Arithmetic<Real = R>, const L: usize, const N: usize>(
        &mut self,
        with: A,
        plan: &Plan<R, M, L, N>,
        ways: &[Way<'_>],
    ) {
        let last = ways.len() - 1;
        let mut points = [plan.steady; 3];
        for varying in &plan.varying {
            let channel = varying.channel;
            let of = |k: usize| with.gather(|i| ways[i.min(last)].amplitudes[channel][k]);
            let (start, middle, end) = (of(0), of(1), of(2));
            for j in 0..M {
                let force = varying.force[j];
                points[0][j] = start.mul_add(force, points[0][j]);
                points[1][j] = middle.mul_add(force, points[1][j]);
                points[2][j] = end.mul_add(force, points[2][j]);
            }
            if plan.accelerations {
                self.start[channel] = start;
                self.halves[0].amplitudes[channel] = middle;
                self.halves[1].amplitudes[channel] = end;
            }
        }
        let [start, middle, end] = points;
        (self.whole.start, self.whole.end) = (start, end);
        (self.halves[0].start, self.halves[0].end) = (start, middle);
        (self.halves[1].start, self.halves[1].end) = (middle, end);
    }
}

/// A step on trial.
struct Trial<R: Real, const M: usize, const L: usize, const N: usize> {
    whole: State<R, M, L, N>,
    halves: [State<R, M, L, N>; 2],
    /// What was before halves were accepted by some.
    before: State<R, M, L, N>,
    found: Found<R, M, L>,
    passed: [Passed<R, M>; 3],
    asked: Asked<R>,
    /// Energy of the impulses that the halves have missed, and link forces that they have wrong.
    missed: R,
    turned: [R; 2],
}

impl<R: Real, const M: usize, const L: usize, const N: usize> Trial<R, M, L, N> {
    fn new<A: Arithmetic<Real = R>>(
        with: A,
        plan: &Plan<R, M, L, N>,
        at: &State<R, M, L, N>,
    ) -> Self {
        let zero = with.splat(0.0);
        Self {
            whole: at.clone(),
            halves: [at.clone(), at.clone()],
            before: at.clone(),
            found: Found::new(zero),
            passed: [0; 3].map(|_| Passed::new(zero)),
            asked: Asked::new(plan, zero),
            missed: zero,
            turned: [zero; 2],
        }
    }

    /// Makes whole and halves for the analyses in `who`; gives back who of them has found no equilibrium.
    #[inline(always)]
    fn make<A: Arithmetic<Real = R>>(
        &mut self,
        with: A,
        plan: &Plan<R, M, L, N>,
        [rule, half]: &[Rule<R, M, L>; 2],
        loads: &Points<R, M>,
        (who, [start, middle]): (R::Mask, [R; 2]),
        at: &State<R, M, L, N>,
    ) -> R::Mask {
        let Self { whole, halves: [first, second], found, passed, asked, .. } = self;
        let [p0, p1, p2] = passed;
        let (of_whole, [of_first, of_second]) = (&loads.whole, &loads.halves);
        let (w0, _) = with.run(Make {
            plan,
            rule,
            loads: of_whole,
            t: start,
            who,
            from: at,
            to: whole,
            found,
            passed: p0,
            asked: None,
        });
        let (w1, before) = with.run(Make {
            plan,
            rule: half,
            loads: of_first,
            t: start,
            who,
            from: at,
            to: first,
            found,
            passed: p1,
            asked: Some(asked),
        });
        let (w2, behind) = with.run(Make {
            plan,
            rule: half,
            loads: of_second,
            t: middle,
            who,
            from: first,
            to: second,
            found,
            passed: p2,
            asked: Some(asked),
        });
        let wrong = w0 | w1 | w2;
        self.missed = before.energy + behind.energy;
        for kind in 0..2 {
            self.turned[kind] = before.behind[kind].max(behind.behind[kind]);
        }
        wrong
    }

    #[inline(always)]
    fn tried(&self) -> Tried<'_, R, M, L, N> {
        let Self { whole, halves, passed: [_, first, second], missed, turned, .. } = self;
        let work = first.of_links() + second.of_links();
        Tried { whole, halves, work, missed: *missed, turned: *turned }
    }

    /// The halves of the analyses in `ok` are kept; `all`: of all that there are.
    #[inline(always)]
    fn accept<A: Arithmetic<Real = R>>(
        &mut self,
        with: A,
        plan: &Plan<R, M, L, N>,
        half: &Rule<R, M, L>,
        (ok, all): (R::Mask, bool),
        at: &mut State<R, M, L, N>,
        norms: &mut Norms<R>,
    ) {
        let Self { halves, before, passed: [_, first, second], .. } = self;
        let zero = with.splat(0.0);
        if !all {
            with.run(Keep { mask: zero.lt(zero), to: before, from: at });
        }
        for (made, passed) in halves.iter().zip([first, second]) {
            with.run(Enter { plan, rule: half, made, passed, at });
            norms.see(ok, at.in_motion());
        }
        norms.reach(plan, ok, at);
        if !all {
            with.run(Keep { mask: ok, to: at, from: before });
        }
    }

    /// Looks at what outputs are where loads have jumped, of the analyses in a mask, at their times.
    fn look_behind<A: Arithmetic<Real = R>>(
        &mut self,
        with: A,
        plan: &Plan<R, M, L, N>,
        loads: &Points<R, M>,
        (jumps, t): (R::Mask, R),
        at: &mut State<R, M, L, N>,
    ) {
        let (zero, before) = (with.splat(0.0), &mut self.before);
        with.run(Keep { mask: zero.lt(zero), to: before, from: at });
        at.amplitudes.copy_from_slice(&loads.start);
        with.run(Behind { plan, load: &loads.whole.start, t, at });
        with.run(Keep { mask: jumps, to: at, from: before });
    }

    /// Evaluations of the link laws.
    fn iterations(&self) -> R {
        let [first, second] = &self.halves;
        self.whole.iterations + first.iterations + second.iterations
    }
}

/// One step into `to`, as a task; gives back who has found no equilibrium, and what a half has missed.
struct Make<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    rule: &'a Rule<R, M, L>,
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
        let Self { plan, rule, loads, t, who, from, to, found, passed, asked } = self;
        to.follow(from);
        foresee_by_tangents(plan, rule, loads, to, found);
        settle(with, plan, rule, (who, false), to, found);
        take(plan, rule, (loads, t), found, to, passed);
        let turned = match asked {
            Some(asked) => turned(with, plan, rule, asked, who, (from, to)),
            None => Turned::nothing(with.splat(0.0)),
        };
        (found.wrong, turned)
    }
}

/// A step that is kept, as a task.
struct Enter<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    rule: &'a Rule<R, M, L>,
    made: &'a State<R, M, L, N>,
    passed: &'a Passed<R, M>,
    at: &'a mut State<R, M, L, N>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Enter<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { plan, rule, made, passed, at } = self;
        at.follow(made);
        account(with, plan, rule, passed, at);
    }
}

/// What outputs are where loads have jumped, of the analyses in `who`, as a task.
struct Behind<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    load: &'a Aligned<[R; M]>,
    t: R,
    at: &'a mut State<R, M, L, N>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Behind<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { plan, load, t, at } = self;
        let zero = with.splat(0.0);
        acceleration(plan, load, at);
        show(with, plan, (t, zero, zero), at);
    }
}

//! Steps in pieces: where loads cut a step, and where a step has no equilibrium and is halved, as the
//! ordinary engine does with fixed steps. Every analysis goes its own way, whoever its neighbours are.

use super::coefficients::Rule;
use super::grid::Piece;
use super::loads::Loads;
use super::newton::{Found, foresee, settle};
use super::plan::Plan;
use super::record::{Record, take_record};
use super::setup::LaneSetup;
use super::show::show;
use super::small::Aligned;
use super::state::{State, forget, keep, take_answers};
use super::step::{Passed, acceleration, account_apart, take};
use super::trial::follow;
use crate::march::DEPTH;
use trilith_element::lanes::{Arithmetic, Real, Task};

/// What one analysis has still to go of a step.
struct Walk {
    pieces: Vec<Piece>,
    /// Pieces done.
    done: usize,
    /// Where it is in the present piece, and how often that is halved.
    at: u64,
    level: u32,
}

const FULL: u64 = 1 << DEPTH;

impl Walk {
    fn new(pieces: Vec<Piece>, level: u32) -> Self {
        Self { pieces, done: 0, at: 0, level }
    }

    /// The next substep.
    fn next(&self) -> Option<Piece> {
        let whole = *self.pieces.get(self.done)?;
        let until = self.at + (FULL >> self.level);
        let time = |at: u64| match at {
            FULL => whole.end,
            at => whole.start + whole.length * (at as f64 / FULL as f64),
        };
        Some(Piece {
            start: time(self.at),
            end: time(until),
            length: whole.length / (1u64 << self.level) as f64,
            jump: whole.jump && self.at == 0,
        })
    }

    fn advance(&mut self) {
        self.at += FULL >> self.level;
        while self.level > 0 && self.at.is_multiple_of(FULL >> (self.level - 1)) {
            self.level -= 1;
        }
        if self.at == FULL {
            (self.at, self.done) = (0, self.done + 1);
        }
    }

    /// False where halving does not help.
    fn halve(&mut self) -> bool {
        let more = self.level + 2 < DEPTH;
        if more {
            self.level += 1
        } else {
            self.done = self.pieces.len()
        }
        more
    }
}

/// A step that loads of some analyses cut.
#[inline(never)]
pub(super) fn cut_step<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    setups: &[&LaneSetup],
    plan: &Plan<A::Real, M, L, N>,
    step: usize,
    both: (&mut State<A::Real, M, L, N>, &mut Record<A::Real>),
) {
    let grid = setups[0].shape.grid;
    let walks = setups.iter().map(|s| {
        let pieces = match s.cut.iter().find(|c| c.0 == step) {
            Some((_, pieces)) => pieces.clone(),
            None => (0..grid.substeps).map(|i| grid.usual(step, i)).collect(),
        };
        Walk::new(pieces, 0)
    });
    walk(with, setups, plan, walks.collect(), both);
}

/// Ends a usual step in which some found no equilibrium: they go on in halves.
#[inline(never)]
pub(super) fn in_halves<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    setups: &[&LaneSetup],
    plan: &Plan<A::Real, M, L, N>,
    (rule, loads, t): (&Rule<A::Real, M, L>, &Loads<A::Real, M>, f64),
    found: &Found<A::Real, M, L>,
    (state, record): (&mut State<A::Real, M, L, N>, &mut Record<A::Real>),
) {
    let wrong = found.wrong;
    let before = (state.clone(), record.clone());
    let begin = with.splat(t);
    let mut passed = Passed::new(with.splat(0.0));
    with.run(End { plan, rule, loads, t: begin, found, state, passed: &mut passed });
    account_apart(with, plan, rule, &passed, state, record);
    keep(with, plan, !wrong, state, &before.0);
    take_record(with, wrong, &before.1, record);
    forget(wrong, state);
    let grid = setups[0].shape.grid;
    let length = grid.step();
    let walks = (0..setups.len()).map(|i| {
        let failed = with.lane(with.splat(1.0).only(wrong), i) == 1.0;
        let whole = Piece { start: t, end: t + length, length, jump: false };
        Walk::new(if failed { vec![whole] } else { Vec::new() }, 1)
    });
    walk(with, setups, plan, walks.collect(), (state, record));
}

fn walk<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    setups: &[&LaneSetup],
    plan: &Plan<A::Real, M, L, N>,
    mut walks: Vec<Walk>,
    (state, record): (&mut State<A::Real, M, L, N>, &mut Record<A::Real>),
) {
    let grid = setups[0].shape.grid;
    let last = walks.len() - 1;
    let zero = with.splat(0.0);
    let (mut made, mut before) = (state.clone(), record.clone());
    let (mut found, mut passed) = (Found::new(zero), Passed::new(zero));
    loop {
        let next: Vec<Option<Piece>> = walks.iter().map(Walk::next).collect();
        if next.iter().all(Option::is_none) {
            break;
        }
        let goes = with.gather(|i| f64::from(u8::from(next[i.min(last)].is_some())));
        // Who has nothing left takes any step, and forgets it.
        let any = Piece { start: 0.0, end: grid.dt, length: grid.dt, jump: false };
        let now: Vec<Piece> = next.iter().map(|p| p.unwrap_or(any)).collect();
        let rule = Rule::of_lengths(with, setups, plan, &|i| now[i].length);
        let loads = plan.loads_of_pieces(with, setups, &now);
        let t = with.gather(|i| now[i.min(last)].start);
        if plan.accelerations && now.iter().any(|p| p.jump) {
            let before = (state.clone(), record.clone());
            let jumps = with.gather(|i| f64::from(u8::from(now[i.min(last)].jump)));
            let who = zero.lt(jumps);
            state.amplitudes = plan.amplitudes_behind(with, setups, &now);
            look_behind(with, plan, &loads.start, (who, t), &before, (state, record));
        }
        let (who, from) = (zero.lt(goes), &*state);
        let (rule, loads, to) = (&rule, &loads, &mut made);
        let (found, passed) = (&mut found, &mut passed);
        with.run(Usual { plan, rule, loads, t, who, from, to, found, passed });
        let wrong = found.wrong;
        let ok = who & !wrong;
        take_record(with, zero.le(zero), record, &mut before);
        account_apart(with, plan, rule, passed, &made, record);
        take_record(with, !ok, &before, record);
        follow(with, plan, Some(ok), &made, state);
        take_answers(ok, &made, state);
        forget(wrong, state);
        state.iterations = made.iterations;
        let failed = with.splat(1.0).only(wrong);
        let mut lost = vec![false; walks.len()];
        for (i, walk) in walks.iter_mut().enumerate().filter(|(i, _)| next[*i].is_some()) {
            if with.lane(failed, i) == 1.0 { lost[i] = !walk.halve() } else { walk.advance() }
        }
        if lost.contains(&true) {
            let lost = with.gather(|i| f64::from(u8::from(lost[i.min(last)])));
            let lost = zero.lt(lost);
            state.lost = A::Real::select(lost, t, state.lost);
            state.alive = state.alive & !lost;
        }
    }
}

/// What outputs are where loads have jumped, of the analyses in `who` at their times; the others stay as they were before.
#[inline(never)]
pub(super) fn look_behind<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    load: &Aligned<[A::Real; M]>,
    (who, t): (<A::Real as Real>::Mask, A::Real),
    before: &(State<A::Real, M, L, N>, Record<A::Real>),
    (state, record): (&mut State<A::Real, M, L, N>, &mut Record<A::Real>),
) {
    with.run(Behind { plan, load, t, state, record });
    keep(with, plan, who, state, &before.0);
    take_record(with, !who, &before.1, record);
}

/// What outputs are under other loads, as a task.
struct Behind<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    load: &'a Aligned<[R; M]>,
    t: R,
    state: &'a mut State<R, M, L, N>,
    record: &'a mut Record<R>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Behind<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { plan, load, t, state, record } = self;
        let zero = with.splat(0.0);
        acceleration(plan, load, state);
        show(with, plan, (t, zero, zero), state, record);
    }
}

/// A step into `to` as the march makes the usual ones, as a task.
struct Usual<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    rule: &'a Rule<R, M, L>,
    loads: &'a Loads<R, M>,
    t: R,
    who: R::Mask,
    from: &'a State<R, M, L, N>,
    to: &'a mut State<R, M, L, N>,
    found: &'a mut Found<R, M, L>,
    passed: &'a mut Passed<R, M>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Usual<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let Self { plan, rule, loads, t, who, from, to, found, passed } = self;
        to.start_from(from, plan);
        to.answer = from.answer;
        to.answer_to_rate = from.answer_to_rate;
        foresee(plan, rule, loads, from, found);
        settle(with, plan, rule, (who, true), to, found);
        take(plan, rule, (loads, t), found, to, passed);
    }
}

/// The end of a step, as a task.
struct End<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    rule: &'a Rule<R, M, L>,
    loads: &'a Loads<R, M>,
    t: R,
    found: &'a Found<R, M, L>,
    state: &'a mut State<R, M, L, N>,
    passed: &'a mut Passed<R, M>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for End<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, _: A) {
        let Self { plan, rule, loads, t, found, state, passed } = self;
        take(plan, rule, (loads, t), found, state, passed);
    }
}

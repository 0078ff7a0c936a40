//! The march with adaptive steps: every analysis goes its own way in time.
//!
//! ```text
//! whole:  from t over h            halves:  from t over h/2, and once more
//! ```
//!
//! All analyses make such a step at once, each from where it is and with its own length. What whole and halves are apart
//! is its error (`error`). Who is within the tolerance keeps the halves, the others halve their step and try again;
//! when a step is doubled, halved and given up is what the ordinary [`march`](crate::march) says.

use super::error::Norms;
use super::loads::Points;
use super::plan::Plan;
use super::record::Record;
use super::setup::LaneSetup;
use super::sizes::Sizes;
use super::state::{State, keep};
use super::trial::Trial;
use super::way::{Next, Way};
use super::{Done, LaneOutcome};
use crate::march::{ACCURACY_DEPTH, may_grow};
use trilith_element::lanes::{Arithmetic, Real, Task};

/// A march with adaptive steps, as a task: so many analyses go side by side, and where one has come to its end the next
/// takes its lane.
pub(super) struct Adaptive<'a, const M: usize, const L: usize, const N: usize> {
    pub setups: &'a [&'a LaneSetup],
    pub beside: usize,
    pub done: Done<'a>,
}

/// Lanes at most.
pub(super) const MOST: usize = 8;

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Adaptive<'_, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        let mut seats = Seats::new(self.setups, self.beside.min(A::WIDTH), self.done);
        let mut plan = Plan::<A::Real, M, L, N>::new(with, &seats.own);
        let mut at = State::new(with, &seats.own, &plan);
        let mut record = Record::new(with, &seats.own, &plan);
        let mut trial = Trial::new(with, &plan, (&at, &record));
        let mut norms = Norms::new(with, &seats.own);
        let mut sizes = Sizes::new(with, &seats.own);
        let mut loads = Points::new(with, &plan);
        let mut ways: Vec<Way<'_>> = seats.own.iter().map(|s| Way::new(s)).collect();
        loop {
            let mut next = [None; MOST];
            next.iter_mut().zip(&mut ways).for_each(|(next, way)| *next = way.next());
            if (0..ways.len()).any(|i| next[i].is_none() && !seats.is_empty(i)) {
                let mut fresh = [false; MOST];
                for i in (0..ways.len()).filter(|i| next[*i].is_none()) {
                    if !seats.is_empty(i) {
                        let both = (&mut at, &record);
                        let outcome = left(with, both, &norms, (&ways[i], &seats), i);
                        seats.leave(i, outcome, with.lane(trial.iterations(), i));
                        fresh[i] = !seats.is_empty(i);
                    }
                }
                if fresh.contains(&true) {
                    plan = Plan::new(with, &seats.own);
                    let who = mask(with, |i| fresh[i]);
                    let before = std::mem::replace(&mut at, State::new(with, &seats.own, &plan));
                    keep(with, &plan, who, &mut at, &before);
                    let fresh_record = Record::new(with, &seats.own, &plan);
                    let before = std::mem::replace(&mut record, fresh_record);
                    record.take(!who, &before);
                    norms.take(who, &Norms::new(with, &seats.own));
                    for i in (0..ways.len()).filter(|i| fresh[*i]) {
                        sizes.forget(i);
                        ways[i] = Way::new(seats.own[i]);
                        next[i] = ways[i].next();
                    }
                }
            }
            if next.iter().all(Option::is_none) {
                if seats.are_empty() {
                    break;
                }
                continue;
            }
            let rules = sizes.choose(with, &seats.own, &plan, &next);
            loads.gather(with, &plan, &ways);
            let time = |of: fn(&Next) -> f64| with.gather(|i| next[i].as_ref().map_or(0.0, of));
            let starts = [time(|n| n.start), time(|n| n.middle)];
            if plan.accelerations && next.iter().flatten().any(|n| n.jump) {
                let jumps = mask(with, |i| next[i].is_some_and(|n| n.jump));
                let both = (&mut at, &mut record);
                Trial::look_behind(with, &plan, &loads, (jumps, starts[0]), both);
            }
            let who = mask(with, |i| next[i].is_some());
            let wrong = trial.make(with, &plan, rules, &loads, (who, starts), &at);
            let error = norms.measure(with, &plan, (&at, &record), &trial.tried());
            let error = Errors::new(with, wrong, &error);
            let mut accepted = [false; MOST];
            let steps: [usize; MOST] = std::array::from_fn(|i| ways.get(i).map_or(0, |w| w.step));
            for (i, way) in ways.iter_mut().enumerate() {
                if let Some(next) = &next[i] {
                    accepted[i] = error.decide(i, next.start, way);
                }
            }
            if accepted.contains(&true) {
                let all = (0..ways.len()).all(|i| accepted[i]);
                let ok = mask(with, |i| accepted[i]);
                let both = (&mut at, &mut record);
                trial.accept(with, &plan, &rules[1], (ok, all), both, &mut norms);
            }
            if plan.falls {
                // Looked at where an output step ends.
                for (i, way) in ways.iter_mut().enumerate().filter(|(i, _)| accepted[*i]) {
                    let fell = |x: &A::Real| with.lane(*x, i) == 1.0;
                    let link = record.fallen.iter().position(fell);
                    if let Some(link) = link.filter(|_| way.step > steps[i]) {
                        way.fall(link);
                    }
                }
            }
        }
    }
}

/// Which analysis goes in which lane.
struct Seats<'a> {
    setups: &'a [&'a LaneSetup],
    /// That of each lane, the last one where none is left.
    own: Vec<&'a LaneSetup>,
    /// Its index; none where it has come to its end and none is left.
    at: Vec<Option<usize>>,
    /// Iterations that the lane had made before.
    before: Vec<f64>,
    next: usize,
    done: Done<'a>,
}

impl<'a> Seats<'a> {
    fn new(setups: &'a [&'a LaneSetup], lanes: usize, done: Done<'a>) -> Self {
        let lanes = lanes.min(setups.len());
        Self {
            setups,
            own: setups[..lanes].to_vec(),
            at: (0..lanes).map(Some).collect(),
            before: vec![0.0; lanes],
            next: lanes,
            done,
        }
    }

    fn is_empty(&self, lane: usize) -> bool {
        self.at[lane].is_none()
    }

    fn are_empty(&self) -> bool {
        self.at.iter().all(Option::is_none)
    }

    /// The analysis of a lane has come to its end, after so many iterations in it; the next takes the lane, if there is one.
    fn leave(&mut self, lane: usize, mut outcome: LaneOutcome, iterations: f64) {
        outcome.iterations = (iterations - self.before[lane]) as usize;
        self.before[lane] = iterations;
        if let Some(i) = self.at[lane].take()
            && !(self.done)(i, outcome)
        {
            self.next = self.setups.len();
        }
        if let Some(next) = self.setups.get(self.next) {
            (self.own[lane], self.at[lane]) = (next, Some(self.next));
            self.next += 1;
        }
    }
}

/// What the analysis of a lane has left at its end.
fn left<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    (at, record): (&mut State<A::Real, M, L, N>, &Record<A::Real>),
    norms: &Norms<A::Real>,
    (way, seats): (&Way<'_>, &Seats<'_>),
    i: usize,
) -> LaneOutcome {
    let setup = seats.own[i];
    at.alive = mask(with, |lane| lane != i || way.lost.is_none());
    at.lost = with.splat(way.lost.unwrap_or(0.0));
    let fallen = way.fallen.map(|(t, link)| (t, setup.elements[link]));
    let mut outcome = at.outcome(with, record, setup, i, fallen);
    at.alive = mask(with, |_| true);
    let moves = outcome.energy.moves();
    outcome.noticed |= moves && norms.is_lost(with, setup, i);
    if fallen.is_some() {
        outcome.contact.iter_mut().for_each(|c| c.overturned = true);
    }
    outcome
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

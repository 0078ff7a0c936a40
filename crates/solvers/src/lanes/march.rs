//! The march in lanes: the only loop over time of a sweep.

use super::adaptive::Adaptive;
use super::coefficients::Rule;
use super::newton::{Found, foresee, settle};
use super::pieces::{cut_step, in_halves};
use super::plan::Plan;
use super::record::Record;
use super::setup::{BODY, LaneSetup, ROOM, WIDEST};
use super::state::State;
use super::step::{Passed, account, account_apart, take};
use super::{Done, LaneOutcome};
use trilith_element::lanes::{Arithmetic, Portable, Real, Task};
#[cfg(target_arch = "x86_64")]
use trilith_element::lanes::{Avx2Lanes, Avx512Lanes, FusedOne};

/// What a march is computed with. All with FMA give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instructions {
    /// One analysis at a time, on any machine.
    Portable,
    /// One analysis at a time, with FMA.
    Fma,
    /// Eight at a time with AVX2 and FMA.
    Avx2,
    /// Eight at a time with AVX-512.
    Avx512,
}

impl Instructions {
    /// All of them, the best last.
    pub const ALL: [Self; 4] = [Self::Portable, Self::Fma, Self::Avx2, Self::Avx512];

    /// True where the machine has them.
    #[must_use]
    pub fn are_available(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        match self {
            Self::Portable => true,
            Self::Fma => FusedOne::available().is_some(),
            Self::Avx2 => Avx2Lanes::available().is_some(),
            Self::Avx512 => Avx512Lanes::available().is_some(),
        }
        #[cfg(not(target_arch = "x86_64"))]
        matches!(self, Self::Portable)
    }

    fn best() -> Self {
        let mut all = Self::ALL.into_iter().rev();
        all.find(|i| i.are_available()).unwrap_or(Self::Portable)
    }

    /// Analyses that go side by side.
    fn width(self) -> usize {
        match self {
            Self::Portable | Self::Fma => 1,
            Self::Avx2 | Self::Avx512 => 8,
        }
    }
}

/// Analyses that go side by side.
pub(super) fn width() -> usize {
    Instructions::best().width()
}

/// Fewer than this go one by one.
const WORTH_LANES: usize = 3;

/// Runs analyses that fit each other, `beside` of them at a time at most.
///
/// # Panics
/// Where there are none, or they do not fit.
pub fn march(setups: &[&LaneSetup], beside: usize, done: Done<'_>) {
    let best = Instructions::best();
    let few = best.width() > 1 && setups.len().min(beside) < WORTH_LANES;
    let ran = run_by(if few { Instructions::Fma } else { best }, setups, beside, done);
    assert!(ran, "instructions that the machine has");
}

/// The same with given instructions; none where the machine does not have them.
///
/// # Panics
/// As [`march`].
#[must_use]
pub fn march_by(
    instructions: Instructions,
    setups: &[&LaneSetup],
    beside: usize,
) -> Option<Vec<LaneOutcome>> {
    let mut found: Vec<Option<LaneOutcome>> = setups.iter().map(|_| None).collect();
    let ran = run_by(instructions, setups, beside, &mut |i, outcome| {
        found[i] = Some(outcome);
        true
    });
    ran.then(|| found.into_iter().flatten().collect())
}

/// False where the machine does not have the instructions.
fn run_by(
    instructions: Instructions,
    setups: &[&LaneSetup],
    beside: usize,
    done: Done<'_>,
) -> bool {
    assert!(!setups.is_empty() && beside > 0, "one analysis at least");
    assert!(setups.iter().all(|s| s.fits(setups[0])), "analyses that fit each other");
    fn side_by_side<A: Arithmetic>(
        with: Option<A>,
        setups: &[&LaneSetup],
        beside: usize,
        done: Done<'_>,
    ) -> bool {
        with.map(|with| sized(with, setups, beside, done)).is_some()
    }
    #[cfg(target_arch = "x86_64")]
    return match instructions {
        Instructions::Portable => side_by_side(Some(Portable), setups, 1, done),
        Instructions::Fma => side_by_side(FusedOne::available(), setups, 1, done),
        Instructions::Avx2 => side_by_side(Avx2Lanes::available(), setups, beside, done),
        Instructions::Avx512 => side_by_side(Avx512Lanes::available(), setups, beside, done),
    };
    #[cfg(not(target_arch = "x86_64"))]
    side_by_side((instructions == Instructions::Portable).then_some(Portable), setups, 1, done)
}

/// Chooses the sizes that the loops are compiled for: modes, link coordinates, coordinates of a link.
fn sized<A: Arithmetic>(with: A, setups: &[&LaneSetup], beside: usize, done: Done<'_>) {
    let shape = &setups[0].shape;
    let n = shape.links.iter().map(|l| l.2.coordinates).max().unwrap_or(1);
    let coordinates = n * shape.links.len();
    // Branches on constants alone: what an arithmetic never takes is not compiled for it.
    if const { !A::IS_RARE } {
        match (shape.modes, n, coordinates) {
            // Seldom does one go alone: of the small sizes there is one, of four modes, which are one register.
            (..=3, 2, ..=4) if const { A::WIDTH == 1 } => {
                return of_size::<A, 4, 4, 2>(with, setups, beside, done);
            }
            _ if const { A::WIDTH == 1 } => {}
            (..=3, 1, ..=2) => return of_size::<A, 3, 2, 1>(with, setups, beside, done),
            (..=3, 2, ..=4) => return of_size::<A, 3, 4, 2>(with, setups, beside, done),
            (..=3, 3, ..=6) => return of_size::<A, 3, 6, 3>(with, setups, beside, done),
            _ => {}
        }
    }
    if n > WIDEST {
        // One body with all its coordinates, which goes with adaptive steps alone.
        run(with, Adaptive::<BODY, BODY, BODY> { setups, beside, done });
    } else {
        of_size::<A, ROOM, ROOM, WIDEST>(with, setups, beside, done);
    }
}

fn of_size<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    setups: &[&LaneSetup],
    beside: usize,
    done: Done<'_>,
) {
    if setups[0].shape.is_adaptive {
        return run(with, Adaptive::<M, L, N> { setups, beside, done });
    }
    let width = beside.min(A::WIDTH);
    for (group, setups) in setups.chunks(width).enumerate() {
        let found = run(with, Lanes::<M, L, N> { setups }).into_iter().enumerate();
        // All of the group have come to their ends.
        if !found.fold(true, |goes_on, (i, outcome)| done(group * width + i, outcome) && goes_on) {
            return;
        }
    }
}

/// The one place that calls a march: every part of the library that calls one has it compiled anew.
#[inline(never)]
fn run<A: Arithmetic, T: Task<A>>(with: A, task: T) -> T::Output {
    with.run(task)
}

struct Lanes<'a, const M: usize, const L: usize, const N: usize> {
    setups: &'a [&'a LaneSetup],
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A> for Lanes<'_, M, L, N> {
    type Output = Vec<LaneOutcome>;

    #[inline(always)]
    fn run(self, with: A) -> Vec<LaneOutcome> {
        let plan = Plan::<A::Real, M, L, N>::new(with, self.setups);
        let mut state = State::new(with, self.setups, &plan);
        let mut record = Record::new(with, self.setups, &plan);
        let shape = &self.setups[0].shape;
        let parts = shape.grid.substeps;
        let part = shape.grid.step();
        let usual = Rule::usual(with, self.setups, &plan);
        let mut loads = plan.no_loads(with);
        let mut found = Found::new(with.splat(0.0));
        let mut passed = Passed::new(with.splat(0.0));
        // A step was taken but is not accounted for: that waits until the next is foreseen, where an analysis goes
        // alone and the processor would wait for one number after the other. Lanes keep it busy anyway.
        let mut open = false;
        let mut cuts: Vec<usize> =
            self.setups.iter().flat_map(|s| s.cut.iter().map(|c| c.0)).collect();
        cuts.sort_unstable();
        cuts.dedup();
        let mut cuts = cuts.into_iter().peekable();
        for step in 0..shape.grid.steps {
            if cuts.next_if_eq(&step).is_some() {
                if std::mem::take(&mut open) {
                    account_apart(with, &plan, &usual, &passed, &state, &mut record);
                }
                cut_step(with, self.setups, &plan, step, (&mut state, &mut record));
            } else {
                for i in 0..parts {
                    plan.loads(with, self.setups, step * parts + i, &mut loads);
                    foresee(&plan, &usual, &loads, &state, &mut found);
                    if std::mem::take(&mut open) {
                        account(with, &plan, &usual, &passed, &state, &mut record);
                    }
                    // Integers with a sign become floats in one instruction.
                    let [step, i] = [step, i].map(|n| n.cast_signed() as f64);
                    let t = step * shape.grid.dt + part * i;
                    let alive = state.alive;
                    settle(with, &plan, &usual, (alive, true), &mut state, &mut found);
                    if found.d[0].any(found.wrong) {
                        let step = (&usual, &loads, t);
                        let both = (&mut state, &mut record);
                        in_halves(with, self.setups, &plan, step, &found, both);
                    } else {
                        let t = with.splat(t);
                        take(&plan, &usual, (&loads, t), &found, &mut state, &mut passed);
                        open = A::WIDTH == 1;
                        if !open {
                            account(with, &plan, &usual, &passed, &state, &mut record);
                        }
                    }
                }
            }
            if !state.scale[0].any(state.alive) {
                break;
            }
        }
        if open {
            account_apart(with, &plan, &usual, &passed, &state, &mut record);
        }
        let left = |i: usize| state.outcome(with, &record, self.setups[i], i, None);
        (0..self.setups.len()).map(left).collect()
    }
}

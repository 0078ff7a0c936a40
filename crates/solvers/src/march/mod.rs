//! The march: the only loop over time. It knows no solver.
//!
//! Output steps cut where loads bend or jump, substeps by their error, and the energy that each enters in the ledger.
//! May use `step` and `record`.
//!
//! An output step is cut into substeps of `S/2ᵏ`. With adaptive control a substep is made once whole and
//! once in two halves. What the two are apart, and what neither of them has seen, is its error:
//!
//! ```text
//! ε = √(E(Δ) / E)                  energy norm of the difference, over the largest energy of the motion so far
//! δ = |Δu| / max(|u₁ − u₀|, U/100) displacements, over how far the step went; U: the largest so far
//! χ = (|Δf| / F)²                  link forces, over the largest so far
//! κ = √(½ p²/m / E)                impulses of links that turned or vibrated inside a half (`turning`, `vibration`)
//! ```
//!
//! All must be below the tolerance, and the energies of the links must close in the step. δ is taken of √(uᵀMu)
//! and of the deformations of the links, translations and rotations apart. It is an *error per unit step*, with the
//! way for the step: what steps leave behind adds up along the way, so a smooth motion keeps its phase within some
//! tolerances of its amplitude whatever the number of steps, and the error of a run falls in proportion to the
//! tolerance. ε is an *error per step*: jumps of a force, of which there are few, are bracketed with bounded effort.
//! What is small beside U, such as the ringing of a stiff contact, is held by ε and χ alone.
//!
//! Too large, or no equilibrium: the step is halved, the state being untouched. Small: the next
//! one is doubled, where it stays on the grid of halvings. A gap that closes with a dashpot, or a load
//! that jumps, is a force jump inside a step, so ε falls only in proportion to the step there:
//! the same rule then brackets the event until its impulse error is below the tolerance, whatever the
//! output step. Only powers of two occur, so that the matrices of a step size are made once.
//!
//! The halves are kept. For a rule of second order they are wrong by a third of what they are apart from the whole.
//!
//! Reference: error per step and per unit step, scaled norms \[Hairer, Nørsett & Wanner 1993, II.4\];
//! proportionality of error and tolerance \[Söderlind 2002\].

mod closing;
mod ends;
mod output_step;
mod timeline;

pub(crate) use output_step::{
    Moment, Moving, at_least, constant_force, jump, output_step, potential,
};
pub(crate) use timeline::{Segment, Timeline};

use crate::error::SolveError;
use crate::kernel::ForceScale;
use crate::step::{Culprit, DisplacementNorms, State, StepEnergy, StepFailure, Stepper, Suspicion};
use crate::vector::larger;
use closing::Closing;
use ends::sound_step;
use serde::{Deserialize, Serialize};
use trilith_model::StepControl;
use trilith_system::{LoadSet, StepLoads};

/// Halvings of an output step at most.
pub(crate) const DEPTH: u32 = 30;
/// Halvings for the sake of accuracy at most; then the step is accepted and counted.
pub(crate) const ACCURACY_DEPTH: u32 = 26;
/// Share of the dissipation of a step that its energy balance may miss; a third of the usual limit of a
/// whole run.
pub(crate) const CLOSURE: f64 = 3e-4;
/// Operations whose rounding may add up in the link energies of a step.
pub(crate) const ROUNDING: f64 = 16.0;
/// A step is doubled where its error is below this share of the tolerance, ...
const GROW_BELOW: f64 = 0.08;
/// ... and that of its displacements, which grows by the way as well, below this share.
const GROW_BELOW_ON_WAY: f64 = 0.16;
/// A step counts as going this share of the largest displacement so far at least.
pub(crate) const LEAST_WAY: f64 = 0.01;

/// What the march carries from step to step beside the state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct StepControlState {
    /// Current number of halvings.
    pub level: u32,
    /// Largest energy of the motion so far, J.
    pub reference: f64,
    /// That of them which counts although nothing moves, as it is rounding of what stands in springs at the start, J.
    pub standing: f64,
    /// Largest displacements so far.
    pub reached: DisplacementNorms,
    /// Forces that count beside the loads: of translations and of rotations, N and N·m.
    pub push: ForceScale,
}

impl StepControlState {
    /// True where no more has moved than counts for nothing beside what stands in springs.
    pub(crate) fn is_lost(&self) -> bool {
        self.standing > 0.0 && self.reference <= self.standing
    }
}

/// Counts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counts {
    pub substeps: usize,
    pub rejected: usize,
    pub forced: usize,
}

/// Why a march stopped.
#[derive(Clone, Debug)]
pub(crate) enum Stop {
    NoEquilibrium {
        t: f64,
        /// The flat link coordinate farthest from equilibrium; beyond the last one where it is the structure.
        worst: usize,
        residual: f64,
    },
    /// The work is spent at this time, s.
    Spent {
        t: f64,
    },
    /// A law breaks its contract from this time on, s.
    Law {
        t: f64,
        culprit: Culprit,
    },
    Fatal(SolveError),
}

/// A march over segments of constant output step.
pub(crate) struct March<'a> {
    pub stepper: &'a mut dyn Stepper,
    pub loads: &'a LoadSet,
    pub control: StepControl,
    pub counts: Counts,
    /// Substeps that may be tried.
    pub budget: usize,
    /// Keeps the steps in one where it has made them in halves.
    pub whole: bool,
    /// Where the step on trial starts, s.
    pub at: f64,
    trial: Trial,
    closing: Closing,
    /// Of steps of a given length.
    suspicion: Suspicion,
    /// Length of the step accepted last, as it was kept, s.
    last: f64,
    /// Steps tried when the laws are next asked whether they answer the same twice.
    ask_at: usize,
}

/// States and energies of a step on trial, kept so that a step allocates nothing; a state that is accepted changes
/// places with the one before.
#[derive(Default)]
struct Trial {
    /// The step in one.
    whole: Box<State>,
    /// In two halves.
    first: Box<State>,
    second: Box<State>,
    energies: [StepEnergy; 3],
    loads: StepLoads,
    /// Energy of the impulses that the halves have missed, J.
    missed: f64,
    /// Largest link forces that they have wrong because links turned inside them.
    turned: ForceScale,
}

impl Trial {
    /// The first half becomes the whole of a step half as long.
    fn first_is_whole(&mut self) {
        std::mem::swap(&mut self.whole, &mut self.first);
        self.energies.swap(0, 1);
    }
}

/// The error of a step.
#[derive(Clone, Copy, Debug)]
struct Measured {
    /// Of energies and forces.
    error: f64,
    /// Of displacements, for the way that the step went.
    per_distance: f64,
    /// True where the energies of the links have not closed.
    open: bool,
}

impl Measured {
    fn most(&self) -> f64 {
        larger(self.error, self.per_distance)
    }
}

/// Whether the step behind one with these errors may be twice as long.
#[inline]
pub(crate) fn may_grow(error: f64, per_distance: f64, tolerance: f64) -> bool {
    error < GROW_BELOW * tolerance && per_distance < GROW_BELOW_ON_WAY * tolerance
}

/// How far the energies of the links in a step are from closing, and what is allowed: a share of what
/// they dissipate, and the square of the tolerance as a share of the energy in motion.
fn closure(
    from: &State,
    to: &State,
    halves: [&StepEnergy; 2],
    tolerance: f64,
    energy: f64,
) -> (f64, f64) {
    let mut missing: f64 = from.stored.iter().sum::<f64>() - to.stored.iter().sum::<f64>();
    let mut dissipated = 0.0;
    for half in halves {
        missing += half.link_work + half.support;
        dissipated += half.links.iter().map(|e| e.hysteretic + e.viscous).sum::<f64>();
    }
    let missing = missing - dissipated;
    (missing.abs(), CLOSURE * dissipated.abs() + 10.0 * tolerance * tolerance * energy)
}

/// What is reported of every accepted substep: end time, state, energies.
pub(crate) type Accepted<'a> = dyn FnMut(f64, &State, &StepEnergy) -> f64 + 'a;

impl<'a> March<'a> {
    pub(crate) fn new(
        stepper: &'a mut dyn Stepper,
        loads: &'a LoadSet,
        control: StepControl,
    ) -> Self {
        Self {
            stepper,
            loads,
            control,
            counts: Counts::default(),
            budget: usize::MAX,
            whole: false,
            at: 0.0,
            trial: Trial::default(),
            closing: Closing::default(),
            suspicion: Suspicion::default(),
            last: 0.0,
            ask_at: ends::ASK_EVERY,
        }
    }

    /// The next segment starts where a load may jump.
    pub(crate) fn cut(&mut self) {
        self.trial.loads.cut();
    }

    /// Over a segment of an output step; `accept` sees every substep and returns the energy it knows of.
    pub(crate) fn segment(
        &mut self,
        state: &mut Box<State>,
        control: &mut StepControlState,
        segment: Segment,
        accept: &mut Accepted<'_>,
    ) -> Result<(), Stop> {
        match self.control {
            StepControl::Adaptive { tolerance } => {
                self.adaptive(state, control, segment, tolerance, accept)
            }
            StepControl::Fixed { substeps: 1 } => self.fixed(state, segment, accept),
            StepControl::Fixed { substeps } => {
                for part in segment.parts(substeps) {
                    self.fixed(state, part, accept)?;
                }
                Ok(())
            }
        }
    }

    fn adaptive(
        &mut self,
        state: &mut Box<State>,
        control: &mut StepControlState,
        segment: Segment,
        tolerance: f64,
        accept: &mut Accepted<'_>,
    ) -> Result<(), Stop> {
        let full: u32 = 1 << DEPTH;
        let mut at: u32 = 0;
        // The number of halvings whose whole step is there already.
        let mut known: Option<u32> = None;
        let time = |ticks: u32| segment.time(f64::from(ticks) / f64::from(full));
        while at < full {
            let mut level = control.level;
            while !at.is_multiple_of(full >> level) {
                level += 1;
            }
            let ticks = full >> level;
            let size = segment.length / f64::from(1u32 << level);
            let (start, middle, end) = (time(at), time(at + ticks / 2), time(at + ticks));
            self.spend(start, state)?;
            let times = [start, middle, end];
            let notable = tolerance * tolerance * control.reference;
            let attempt = self.attempt(state, times, size, known == Some(level), notable);
            known = None;
            match attempt {
                Ok(()) => {
                    let measured = self.measure(state, control, tolerance);
                    let error = measured.most();
                    if measured.open && error > tolerance {
                        self.closing.suspect(start, self.stepper.links());
                    }
                    if !error.is_finite() {
                        // No link is to blame.
                        let worst = usize::MAX;
                        return Err(Stop::NoEquilibrium { t: start, worst, residual: error });
                    }
                    if error > tolerance && level < ACCURACY_DEPTH {
                        self.counts.rejected += 1;
                        known = Some(level + 1);
                        self.trial.first_is_whole();
                        control.level = level + 1;
                        continue;
                    }
                    self.counts.forced += usize::from(error > tolerance);
                    self.watch(state, start)?;
                    let Trial { whole, first, second, energies: [e0, e1, e2], .. } =
                        &mut self.trial;
                    let halves = [(middle, &**first, &*e1), (end, &**second, &*e2)];
                    let kept = if self.whole { &[(end, &**whole, &*e0)][..] } else { &halves };
                    self.counts.substeps += kept.len();
                    for (t, s, e) in kept {
                        let seen = accept(*t, s, e);
                        control.reference = control.reference.max(seen);
                    }
                    let last = if self.whole { whole } else { second };
                    control.reached.reach(&self.stepper.displacement_norms(last, None));
                    std::mem::swap(state, last);
                    self.last = if self.whole { size } else { 0.5 * size };
                    at += ticks;
                    control.level = level;
                    if may_grow(measured.error, measured.per_distance, tolerance) && level > 0 {
                        control.level = level - 1;
                    }
                }
                Err(Failed { failure, first }) => {
                    if first {
                        known = Some(level + 1);
                        self.trial.first_is_whole();
                    }
                    self.counts.rejected += 1;
                    self.give_up(failure, level, (start, state), size)?;
                    control.level = level + 1;
                }
            }
        }
        Ok(())
    }

    /// The error of the step on trial.
    fn measure(&mut self, state: &State, control: &StepControlState, tolerance: f64) -> Measured {
        let Trial { whole, second, energies: [_, e1, e2], missed, turned, .. } = &self.trial;
        let energy = control.reference.max(e2.kinetic);
        let mut apart = self.stepper.difference(whole, second);
        for (off, turned) in apart.force.iter_mut().zip(turned) {
            *off = larger(*off, *turned);
        }
        let moved = self.stepper.displacement_norms(second, Some(state));
        let share = (apart.energy.max(*missed) / energy).sqrt();
        let (missing, mut allowed) = closure(state, second, [e1, e2], tolerance, energy);
        if missing > allowed {
            // No step is short enough to bring it below what rounding leaves.
            allowed += ROUNDING * self.stepper.rounding(second);
        }
        let force = apart.share_of_force(&control.push);
        let of_links = larger(tolerance * missing / allowed, force * force);
        // What is not a number stays so.
        let error = if share.is_nan() { share } else { larger(share, of_links) };
        Measured {
            error,
            per_distance: apart.displacement.over(&moved, LEAST_WAY, &control.reached),
            open: missing > allowed,
        }
    }

    /// One step in one and in two halves; `known`: the one is there already; `notable`: see [`Stepper::missed`].
    fn attempt(
        &mut self,
        state: &State,
        [start, middle, end]: [f64; 3],
        size: f64,
        known: bool,
        notable: f64,
    ) -> Result<(), Failed> {
        let Trial { whole, first, second, energies: [e0, e1, e2], loads, missed, turned } =
            &mut self.trial;
        let mut step = |from: &State, to: &mut State, t0, t1, dt, energy: &mut StepEnergy| {
            self.loads.step(t0, t1, loads);
            sound_step(self.stepper, from, to, loads, dt, energy)
        };
        let failed = |first: bool| move |failure| Failed { failure, first };
        if !known {
            step(state, whole, start, end, size, e0).map_err(failed(false))?;
        }
        step(state, first, start, middle, 0.5 * size, e1).map_err(failed(false))?;
        *missed = self.stepper.missed(state, first, 0.5 * size, notable);
        *turned = self.stepper.turned();
        self.loads.step(middle, end, loads);
        sound_step(self.stepper, first, second, loads, 0.5 * size, e2).map_err(failed(true))?;
        *missed += self.stepper.missed(first, second, 0.5 * size, notable);
        let behind = self.stepper.turned();
        turned.iter_mut().zip(behind).for_each(|(most, x)| *most = larger(*most, x));
        Ok(())
    }

    fn fixed(
        &mut self,
        state: &mut Box<State>,
        segment: Segment,
        accept: &mut Accepted<'_>,
    ) -> Result<(), Stop> {
        let full: u32 = 1 << DEPTH;
        let (mut at, mut level) = (0u32, 0u32);
        let share = |ticks: u32| f64::from(ticks) / f64::from(full);
        let time = |ticks: u32| segment.time(share(ticks));
        while at < full {
            self.spend(time(at), state)?;
            let ticks = full >> level;
            // A power of two: no rounding.
            let size = segment.length * share(ticks);
            let Trial { whole, energies: [energy, ..], loads, .. } = &mut self.trial;
            self.loads.step(time(at), time(at + ticks), loads);
            match sound_step(self.stepper, state, whole, loads, size, energy) {
                Ok(()) => {
                    accept(time(at + ticks), whole, energy);
                    self.counts.substeps += 1;
                    std::mem::swap(state, whole);
                    self.last = size;
                    at += ticks;
                    while level > 0 && at.is_multiple_of(full >> (level - 1)) {
                        level -= 1;
                    }
                }
                Err(failure) => {
                    self.counts.rejected += 1;
                    self.give_up(failure, level, (time(at), state), size)?;
                    level += 1;
                }
            }
        }
        Ok(())
    }
}

/// A step without equilibrium; `first`: its first half is there.
struct Failed {
    failure: StepFailure,
    first: bool,
}

//! One step of a solver: linear propagator and link kernel together.

use super::difference::{Difference, DisplacementNorms, difference_of, displacement_norms};
use super::link_equations::LinkEquations;
use super::propagator::Propagator;
use super::state::{LinksBefore, State, StepEnergy, StepFailure};
use super::turning::Turning;
use super::vibration::{Made, Vibration};
use crate::error::SolveError;
use crate::kernel::{ForceScale, Remembered};
use crate::modal::ClosedForm;
use crate::structure::{Motion, ReducedSystem, accelerate_at_once};
use trilith_system::{Laws, LinkSet, StepLoads};

/// One rule for a step.
///
/// # Contract
/// - `from` is never changed; on failure `to` holds rubbish and is thrown away.
/// - All memory of the past is in the state and in [`memory`](Self::memory).
pub(crate) trait Stepper {
    /// From `from` over `dt` with these loads into `to`; what that did to the energies into `energy`.
    fn step(
        &mut self,
        from: &State,
        to: &mut State,
        loads: &StepLoads,
        dt: f64,
        energy: &mut StepEnergy,
    ) -> Result<(), StepFailure>;

    /// A state at rest or in given motion of the free DOFs, to which the links were led from before.
    fn start(
        &mut self,
        u: &[f64],
        v: &[f64],
        before: &LinksBefore,
        amplitudes: &[f64],
    ) -> Result<State, SolveError>;

    /// Loads jump from one set of amplitudes to another: accelerations follow.
    fn jump(&mut self, state: &mut State, change: &[f64]) -> Result<(), SolveError>;

    /// How far two states are apart.
    fn difference(&mut self, a: &State, b: &State) -> Difference;

    /// The displacements of a state, or how far they are from those of another.
    fn displacement_norms(&mut self, a: &State, b: Option<&State>) -> DisplacementNorms;

    /// Energy of the impulses that the step of length `dt` made last has missed where links turned or vibrated inside,
    /// J; vibrations that cannot miss more than `notable` (J) need not be looked at.
    fn missed(&mut self, from: &State, to: &State, dt: f64, notable: f64) -> f64;

    /// Largest link forces that the step looked at last by [`missed`](Self::missed) has wrong at its end, because links
    /// turned inside it.
    fn turned(&self) -> ForceScale {
        [0.0; 2]
    }

    /// What one rounding of the motion does to the energies of the links, J.
    fn rounding(&self, state: &State) -> f64;

    /// The space of the motion.
    fn space(&self) -> &ReducedSystem;

    /// The links, and their laws.
    fn links(&self) -> &LinkSet;
    fn laws(&self) -> Laws<'_>;

    /// Iterations and factorisations so far.
    fn work(&self) -> (usize, usize);

    /// What is kept beside the state and decides the last bits of what follows.
    fn memory(&self) -> Vec<Remembered>;

    /// Takes up what an earlier run kept, and makes of its state at `t` (s) what nobody looked at then.
    fn recall(
        &mut self,
        memory: Vec<Remembered>,
        t: f64,
        state: &mut State,
    ) -> Result<(), SolveError>;

    /// What is known of the motion inside a step, where that is more than its ends.
    fn closed_form(&self) -> Option<ClosedForm> {
        None
    }

    /// Largest G·k of the links so far under the exact rule (ω_link²Δt²/6), where steps were too long for it
    /// and were made by average acceleration.
    fn beyond_exact(&self) -> Option<f64> {
        None
    }
}

/// What one rounding of the motion does to the energies of the links, J: deformations are differences of
/// displacements that may be far larger, and forces act through them. The force of an effective stiffness does so as well: an open
/// contact far out has none, and all that its effective stiffness takes is given back as a pseudo-force.
pub(crate) fn energy_rounding(space: &ReducedSystem, active: &[usize], state: &State) -> f64 {
    let parts = active.iter().enumerate().map(|(a, flat)| {
        let size: f64 = space.links.row(a).map(|(j, c)| (c * state.motion[j]).abs()).sum();
        (state.f[*flat].abs() + state.pseudo[a].abs()) * size
    });
    f64::EPSILON * parts.sum::<f64>()
}

/// Any propagator with the link kernel.
pub(crate) struct LinkStepper<'a, P> {
    propagator: P,
    side: LinkEquations<'a>,
    laws: Laws<'a>,
    turning: Turning,
    vibration: Option<Vibration>,
    difference: Motion,
    /// Rates of all link coordinates, and Hᵢᵢ of the step made last.
    rates: Vec<f64>,
    softness: Vec<f64>,
}

impl<'a, P: Propagator> LinkStepper<'a, P> {
    pub(crate) fn new(mut propagator: P, side: LinkEquations<'a>) -> Result<Self, SolveError> {
        let layout = side.kernel.layout();
        propagator.set_rates(&layout.rate_dependent, &layout.damped)?;
        let n = side.links().len();
        Ok(Self {
            laws: side.laws(),
            vibration: propagator.closed_form().map(Vibration::new),
            propagator,
            side,
            turning: Turning::default(),
            difference: Vec::new(),
            rates: vec![0.0; n],
            softness: vec![0.0; n],
        })
    }

    pub(crate) fn into_parts(self) -> (P, LinkEquations<'a>) {
        (self.propagator, self.side)
    }
}

impl<P: Propagator> Stepper for LinkStepper<'_, P> {
    fn step(
        &mut self,
        from: &State,
        to: &mut State,
        loads: &StepLoads,
        dt: f64,
        energy: &mut StepEnergy,
    ) -> Result<(), StepFailure> {
        let now = &mut self.side.links().stiffness(&from.tangents);
        let key = self.propagator.choose(dt, now, &from.stiffest);
        self.propagator.prepare(&key)?;
        let side = &mut self.side;
        side.begin(self.propagator.space(), from, to, loads, energy);
        let (forces, wanted) = side.prediction(from);
        self.propagator.predict(&from.motion, &forces, &mut to.motion, wanted);
        side.solve(self.propagator.compliance(), from, to, dt, energy)?;
        let forces = side.forces(&from.pseudo, &to.pseudo);
        self.propagator.correct(&from.motion, &forces, &mut to.motion);
        if let Some(rates) = side.open_rates() {
            let space = self.propagator.space();
            let n = space.order();
            space.links.deform(&to.motion[n..2 * n], rates);
        }
        side.finish(to, energy);
        let forces = side.forces(&from.pseudo, &to.pseudo);
        energy.work = self.propagator.work(&from.motion, &to.motion, &forces);
        let of_motion = (energy.work.kinetic, energy.work.strain);
        side.book(from, to, of_motion, energy);
        Ok(())
    }

    fn start(
        &mut self,
        u: &[f64],
        v: &[f64],
        before: &LinksBefore,
        amplitudes: &[f64],
    ) -> Result<State, SolveError> {
        let space = self.propagator.space();
        let (mut state, force) = self.side.start(space, u, v, before, amplitudes);
        let a = self.propagator.acceleration(&force)?;
        state.motion.extend(a);
        Ok(state)
    }

    fn jump(&mut self, state: &mut State, change: &[f64]) -> Result<(), SolveError> {
        let force = self.propagator.space().force(change);
        let a = self.propagator.acceleration(&force)?;
        let n = a.len();
        accelerate_at_once(&mut state.motion[2 * n..], &a);
        Ok(())
    }

    fn difference(&mut self, a: &State, b: &State) -> Difference {
        let Self { propagator, side, difference, .. } = self;
        let of_structure = |x: &[f64]| propagator.energy(x);
        difference_of(propagator.space(), side.links(), of_structure, a, b, difference)
    }

    fn displacement_norms(&mut self, a: &State, b: Option<&State>) -> DisplacementNorms {
        displacement_norms(self.propagator.space(), self.side.links(), a, b, &mut self.difference)
    }

    fn missed(&mut self, from: &State, to: &State, dt: f64, notable: f64) -> f64 {
        let Self { propagator, side, laws, turning, vibration, rates, softness, difference } = self;
        let space = propagator.space();
        let n = space.order();
        difference.resize(space.links.len(), 0.0);
        space.links.deform(&to.motion[n..2 * n], difference);
        side.support_rates(rates);
        let h = &propagator.compliance().h;
        for (a, flat) in side.links().active.iter().enumerate() {
            rates[*flat] += difference[a];
            softness[*flat] = h.own(a);
        }
        let turned = turning.missed(laws, side.links(), from, to, rates, softness, dt);
        let vibration =
            vibration.as_mut().filter(|_| propagator.compliance().key.average.is_empty());
        let vibrated = vibration.map_or(0.0, |vibration| {
            let (links, effective, supports) = (side.links(), side.effective(), side.supports());
            let made = Made { laws, links, space, effective, supports, from, to, dt };
            vibration.missed(&made, notable)
        });
        turned + vibrated
    }

    fn turned(&self) -> ForceScale {
        self.turning.behind
    }

    fn rounding(&self, state: &State) -> f64 {
        energy_rounding(self.propagator.space(), &self.side.links().active, state)
    }

    fn space(&self) -> &ReducedSystem {
        self.propagator.space()
    }

    fn links(&self) -> &LinkSet {
        self.side.links()
    }

    fn laws(&self) -> Laws<'_> {
        self.laws.clone()
    }

    fn work(&self) -> (usize, usize) {
        (self.side.kernel.iterations(), self.propagator.factorizations())
    }

    fn memory(&self) -> Vec<Remembered> {
        self.side.kernel.memory()
    }

    fn recall(
        &mut self,
        memory: Vec<Remembered>,
        t: f64,
        state: &mut State,
    ) -> Result<(), SolveError> {
        for one in memory {
            self.propagator.prepare(&one.key)?;
            self.side.kernel.recall(one, self.propagator.compliance());
        }
        self.side.recall_rates(self.propagator.space(), t, state);
        Ok(())
    }

    fn closed_form(&self) -> Option<ClosedForm> {
        self.propagator.closed_form()
    }

    fn beyond_exact(&self) -> Option<f64> {
        self.propagator.beyond_exact()
    }
}

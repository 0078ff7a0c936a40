//! One step of a solver: linear propagator and link kernel together.

use crate::error::SolveError;
use crate::kernel::{Affine, Committed, Converged, ForceScale, LinkKernel, Remembered};
use crate::propagator::{Compliance, Forces, Motion, Propagator, StepWork};
use crate::space::Space;
use serde::{Deserialize, Serialize};
use trilith_element::{Energy, Kinematics};
use trilith_model::Model;
use trilith_system::{Channel, LinkSet, LoadSet, StepLoads, System};

/// Everything that changes during a run: copying it is a checkpoint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Displacements, velocities, accelerations in the coordinates of the solver.
    pub(crate) motion: Motion,
    /// Deformation of all link coordinates, flat.
    pub(crate) d: Vec<f64>,
    /// Its rate.
    pub(crate) v: Vec<f64>,
    /// Link forces.
    pub(crate) f: Vec<f64>,
    /// Link history.
    pub(crate) history: Vec<f64>,
    /// Largest link forces so far.
    pub(crate) scale: ForceScale,
    /// Energy stored in each link.
    pub(crate) stored: Vec<f64>,
}

impl State {
    /// The links at a deformation, as the laws see it at the start of a step; no motion yet.
    pub(crate) fn of_links(
        model: &Model,
        links: &LinkSet,
        d: Vec<f64>,
        v: Vec<f64>,
        history: &[f64],
    ) -> Self {
        let mut state = Self {
            motion: Vec::new(),
            f: vec![0.0; links.len()],
            history: history.to_vec(),
            scale: [0.0; 2],
            stored: vec![0.0; links.links.len()],
            d,
            v,
        };
        let mut energy = vec![Energy::default(); links.links.len()];
        links.laws(model).respond(
            Kinematics { d: &state.d, v: &state.v, d0: &state.d, v0: &state.v, dt: 0.0 },
            history,
            &mut state.history,
            &mut state.f,
            &mut links.tangents(),
            &mut energy,
        );
        state.settle(links, &energy);
        state
    }

    /// Makes this a place for the step that follows another state.
    pub(crate) fn follow(&mut self, from: &Self) {
        if self.motion.len() == from.motion.len() && self.d.len() == from.d.len() {
            self.scale = from.scale;
        } else {
            self.clone_from(from);
        }
    }

    /// Takes note of the forces and stored energies of a converged step.
    pub(crate) fn settle(&mut self, links: &LinkSet, energy: &[Energy]) {
        for (stored, e) in self.stored.iter_mut().zip(energy) {
            *stored = e.stored;
        }
        for (f, rotational) in self.f.iter().zip(&links.rotational) {
            let scale = &mut self.scale[usize::from(*rotational)];
            if f.abs() > *scale {
                *scale = f.abs();
            }
        }
    }
}

/// What one step did to the energies.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepEnergy {
    pub work: StepWork,
    /// Work that the links took, dummies put right.
    pub link_work: f64,
    /// Work of moving supports on the links.
    pub support: f64,
    pub kinetic: f64,
    pub strain: f64,
    /// Raw energies of each link.
    pub links: Vec<Energy>,
}

/// A step that found no equilibrium.
#[derive(Clone, Debug)]
pub(crate) enum StepFailure {
    /// The flat link coordinate farthest from equilibrium, and its residual.
    NoEquilibrium { worst: usize, residual: f64 },
    /// The linear algebra failed.
    Fatal(SolveError),
}

impl From<SolveError> for StepFailure {
    fn from(e: SolveError) -> Self {
        Self::Fatal(e)
    }
}

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

    /// A state at rest or in given motion of the free DOFs; forces in equilibrium with the history.
    fn start(
        &mut self,
        u: &[f64],
        v: &[f64],
        history: Vec<f64>,
        amplitudes: &[f64],
    ) -> Result<State, SolveError>;

    /// Loads jump from one set of amplitudes to another: accelerations follow.
    fn jump(&mut self, state: &mut State, change: &[f64]) -> Result<(), SolveError>;

    /// Squared energy norm of the difference of two states, J.
    fn distance(&mut self, a: &State, b: &State) -> f64;

    /// What one rounding of the motion does to the energies of the links, J.
    fn rounding(&self, state: &State) -> f64;

    /// The space of the motion.
    fn space(&self) -> &Space;

    /// Iterations and factorisations so far.
    fn work(&self) -> (usize, usize);

    /// What is kept beside the state and decides the last bits of what follows.
    fn memory(&self) -> Vec<Remembered>;

    /// Takes up what an earlier run kept.
    fn recall(&mut self, memory: Vec<Remembered>) -> Result<(), SolveError>;

    /// Largest G·k of the engaged links under the exact rule, where a step of this length is too long for
    /// it and is made by average acceleration; ω_link²Δt²/6.
    fn beyond_exact(&mut self, dt: f64) -> Result<Option<f64>, SolveError>;
}

/// Squared energy norm of the difference of two states, the springs of the links included; `energy` of a
/// motion by the structure.
pub(crate) fn energy_distance(
    energy: impl Fn(&[f64]) -> (f64, f64),
    a: &State,
    b: &State,
    difference: &mut Motion,
) -> f64 {
    difference.clear();
    difference.extend(a.motion.iter().zip(&b.motion).map(|(x, y)| x - y));
    let (kinetic, strain) = energy(difference);
    let links: f64 = (0..a.d.len()).map(|i| ((a.d[i] - b.d[i]) * (a.f[i] - b.f[i])).abs()).sum();
    kinetic.abs() + strain.abs() + 0.5 * links
}

/// What one rounding of the motion does to the energies of the links, J: deformations are differences of
/// displacements that may be far larger, and forces act through them.
pub(crate) fn energy_rounding(space: &Space, active: &[usize], state: &State) -> f64 {
    let parts = active.iter().enumerate().map(|(a, flat)| {
        let size: f64 = space.links.row(a).map(|(j, c)| (c * state.motion[j]).abs()).sum();
        state.f[*flat].abs() * size
    });
    f64::EPSILON * parts.sum::<f64>()
}

/// Any propagator with the link kernel.
pub(crate) struct LinkStepper<'a, P> {
    system: &'a System,
    model: &'a Model,
    loads: &'a LoadSet,
    propagator: P,
    kernel: LinkKernel<'a>,
    work: Workspace,
}

/// What a step needs on its way, so that it allocates nothing.
#[derive(Default)]
struct Workspace {
    load0: Vec<f64>,
    load1: Vec<f64>,
    /// Deformation that moving supports give the links at the start and the end, and its rate at the end.
    support0: Vec<f64>,
    support1: Vec<f64>,
    support_rate: Vec<f64>,
    pseudo0: Vec<f64>,
    pseudo1: Vec<f64>,
    /// d* and v* of the active coordinates.
    d: Vec<f64>,
    v: Vec<f64>,
    /// True where supports move links.
    moving: bool,
    difference: Motion,
}

impl<'a, P: Propagator> LinkStepper<'a, P> {
    pub(crate) fn new(
        model: &'a Model,
        system: &'a System,
        loads: &'a LoadSet,
        propagator: P,
        kernel: LinkKernel<'a>,
    ) -> Self {
        let n = propagator.space().order();
        let (flat, active) = (system.links.len(), system.links.active.len());
        let moves = |c: &Channel| !c.deformation.is_empty() || !c.rate.is_empty();
        let work = Workspace {
            load0: vec![0.0; n],
            load1: vec![0.0; n],
            support0: vec![0.0; flat],
            support1: vec![0.0; flat],
            support_rate: vec![0.0; flat],
            pseudo0: vec![0.0; active],
            pseudo1: vec![0.0; active],
            d: vec![0.0; active],
            v: vec![0.0; active],
            moving: loads.channels.iter().any(moves),
            difference: Vec::new(),
        };
        Self { system, model, loads, propagator, kernel, work }
    }

    /// Takes note of what moving supports do to the links over a step.
    fn move_supports(&mut self, loads: &StepLoads) {
        let w = &mut self.work;
        if !w.moving {
            return;
        }
        for x in [&mut w.support0, &mut w.support1, &mut w.support_rate] {
            x.fill(0.0);
        }
        self.loads.support_deformation(&loads.start, &mut w.support0, &mut w.support_rate);
        w.support_rate.fill(0.0);
        self.loads.support_deformation(&loads.end, &mut w.support1, &mut w.support_rate);
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
        self.propagator.prepare(dt)?;
        self.move_supports(loads);
        to.follow(from);
        energy.links.resize(self.system.links.links.len(), Energy::default());
        let Workspace { load0, load1, support0, support1, support_rate, pseudo0, pseudo1, d, v, .. } =
            &mut self.work;
        let space = self.propagator.space();
        space.force_into(&loads.start, load0);
        space.force_into(&loads.end, load1);
        self.kernel.pseudo(&from.f, &from.d, support0, pseudo0);
        pseudo1.copy_from_slice(pseudo0);
        let before = Forces { load0, load1, pseudo0, pseudo1 };
        self.propagator.predict(&from.motion, &before, &mut to.motion, d, v);
        let Compliance { g, h, key } = self.propagator.compliance();
        self.kernel
            .solve(
                &Affine { d, v, support_d: support1, support_v: support_rate, g, h, key: *key },
                &Committed { d: &from.d, v: &from.v, history: &from.history, dt },
                &from.scale,
                &mut Converged {
                    d: &mut to.d,
                    v: &mut to.v,
                    f: &mut to.f,
                    history: &mut to.history,
                    energy: &mut energy.links,
                    pseudo: pseudo1,
                },
            )
            .map_err(|e| StepFailure::NoEquilibrium { worst: e.worst, residual: e.residual })?;
        let forces = Forces { load0, load1, pseudo0, pseudo1 };
        self.propagator.correct(&forces, &mut to.motion);
        let unrated = self.kernel.unrated();
        if !unrated.is_empty() {
            let space = self.propagator.space();
            let n = space.order();
            space.links.deform(&to.motion[n..2 * n], v);
            for a in unrated {
                let flat = self.system.links.active[*a];
                to.v[flat] = support_rate[flat] + v[*a];
            }
        }
        to.settle(&self.system.links, &energy.links);
        energy.work = self.propagator.work(&from.motion, &to.motion, &forces);
        self.book(from, to, energy);
        Ok(())
    }

    fn start(
        &mut self,
        u: &[f64],
        v: &[f64],
        history: Vec<f64>,
        amplitudes: &[f64],
    ) -> Result<State, SolveError> {
        let space = self.propagator.space();
        let (q, p) = (space.coordinates(self.system, u), space.coordinates(self.system, v));
        let links = &self.system.links;
        let (mut d, mut rate) = (vec![0.0; links.len()], vec![0.0; links.len()]);
        self.loads.support_deformation(amplitudes, &mut d, &mut rate);
        let support_d = d.clone();
        let mut own = vec![0.0; links.active.len()];
        for (motion, flat) in [(&q, &mut d), (&p, &mut rate)] {
            space.links.deform(motion, &mut own);
            for (a, i) in links.active.iter().enumerate() {
                flat[*i] += own[a];
            }
        }
        let mut state = State::of_links(self.model, links, d, rate, &history);
        let mut force = space.force(amplitudes);
        space.damp(-1.0, &p, &mut force);
        space.stiffness.mul_add(-1.0, &q, &mut force);
        self.kernel.pseudo(&state.f, &state.d, &support_d, &mut own);
        space.links.spread(-1.0, &own, &mut force);
        let a = self.propagator.acceleration(&force)?;
        state.motion = [q, p, a].concat();
        Ok(state)
    }

    fn jump(&mut self, state: &mut State, change: &[f64]) -> Result<(), SolveError> {
        let force = self.propagator.space().force(change);
        let a = self.propagator.acceleration(&force)?;
        let n = a.len();
        for (x, y) in state.motion[2 * n..].iter_mut().zip(a) {
            *x += y;
        }
        Ok(())
    }

    fn distance(&mut self, a: &State, b: &State) -> f64 {
        let of_structure = |x: &[f64]| self.propagator.energy(x);
        energy_distance(of_structure, a, b, &mut self.work.difference)
    }

    fn rounding(&self, state: &State) -> f64 {
        energy_rounding(self.propagator.space(), &self.system.links.active, state)
    }

    fn space(&self) -> &Space {
        self.propagator.space()
    }

    fn work(&self) -> (usize, usize) {
        (self.kernel.iterations(), self.propagator.factorizations())
    }

    fn memory(&self) -> Vec<Remembered> {
        self.kernel.memory()
    }

    fn recall(&mut self, memory: Vec<Remembered>) -> Result<(), SolveError> {
        for one in memory {
            self.propagator.prepare(one.dt)?;
            let compliance = self.propagator.compliance();
            self.kernel.recall(one, &compliance.g, &compliance.h);
        }
        Ok(())
    }

    fn beyond_exact(&mut self, dt: f64) -> Result<Option<f64>, SolveError> {
        self.propagator.prepare(dt)?;
        Ok(self.propagator.stiffness_ratio())
    }
}

impl<P: Propagator> LinkStepper<'_, P> {
    /// Enters a step, taking the dummies out of the books: what they store belongs to the links.
    fn book(&self, from: &State, to: &State, energy: &mut StepEnergy) {
        let space = self.propagator.space();
        let Workspace { support0, support1, moving, .. } = &self.work;
        (energy.kinetic, energy.strain) = self.propagator.energy(&to.motion);
        energy.link_work = energy.work.links;
        for (a, flat) in self.system.links.active.iter().enumerate() {
            let k = space.dummy_k[a];
            if k != 0.0 {
                let (d0, d1) = (from.d[*flat] - support0[*flat], to.d[*flat] - support1[*flat]);
                energy.strain -= 0.5 * k * d1 * d1;
                energy.link_work += 0.5 * k * (d1 * d1 - d0 * d0);
            }
        }
        energy.support = 0.0;
        if *moving {
            for i in 0..from.d.len() {
                energy.support += 0.5 * (from.f[i] + to.f[i]) * (support1[i] - support0[i]);
            }
        }
    }
}

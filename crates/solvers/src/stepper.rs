//! One step of a solver: linear propagator and link kernel together.

use crate::error::SolveError;
use crate::kernel::{Affine, Committed, Converged, ForceScale, LinkKernel, Remembered};
use crate::propagator::{Forces, Motion, Propagator, StepWork, kinetic_and_strain};
use crate::space::Space;
use serde::{Deserialize, Serialize};
use trilith_element::{Energy, Kinematics};
use trilith_model::Model;
use trilith_system::{LinkSet, LoadSet, StepLoads, System};

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
        links.respond(
            model,
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

    /// Takes note of the forces and stored energies of a converged step.
    pub(crate) fn settle(&mut self, links: &LinkSet, energy: &[Energy]) {
        for (stored, e) in self.stored.iter_mut().zip(energy) {
            *stored = e.stored;
        }
        for (f, rotational) in self.f.iter().zip(&links.rotational) {
            let kind = usize::from(*rotational);
            self.scale[kind] = self.scale[kind].max(f.abs());
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
    /// From `from` over `dt` with these loads into `to`.
    fn step(
        &mut self,
        from: &State,
        to: &mut State,
        loads: &StepLoads,
        dt: f64,
    ) -> Result<StepEnergy, StepFailure>;

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
    fn distance(&self, a: &State, b: &State) -> f64;

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

    /// Spectral radius of G·k for a step and the engaged stiffness of the flat coordinates; 0 for rules
    /// that are stable whatever it is. The exact rule with link forces linear in the step is stable
    /// below 2 (ω_link·Δt < 2√3 is ω²Δt²/6 < 2).
    fn stiffness_ratio(&mut self, dt: f64, engaged: &[f64]) -> Result<f64, SolveError>;
}

/// Squared energy norm of the difference of two states, the springs of the links included.
pub(crate) fn energy_distance(space: &Space, a: &State, b: &State) -> f64 {
    let difference: Vec<f64> = a.motion.iter().zip(&b.motion).map(|(x, y)| x - y).collect();
    let (kinetic, strain) = kinetic_and_strain(space, &difference);
    let links: f64 = (0..a.d.len()).map(|i| ((a.d[i] - b.d[i]) * (a.f[i] - b.f[i])).abs()).sum();
    kinetic.abs() + strain.abs() + 0.5 * links
}

/// What one rounding of the motion does to the energies of the links, J: deformations are differences of
/// displacements that may be far larger, and forces act through them.
pub(crate) fn energy_rounding(space: &Space, active: &[usize], state: &State) -> f64 {
    let parts = space.rows.iter().zip(active).map(|(row, flat)| {
        let size: f64 = row.iter().map(|(j, c)| (c * state.motion[*j]).abs()).sum();
        state.f[*flat].abs() * size
    });
    f64::EPSILON * parts.sum::<f64>()
}

/// Any propagator with the link kernel.
pub(crate) struct LinkStepper<'a, P> {
    pub model: &'a Model,
    pub system: &'a System,
    pub loads: &'a LoadSet,
    pub propagator: P,
    pub kernel: LinkKernel,
}

impl<P: Propagator> LinkStepper<'_, P> {
    /// Deformation and rate from moving supports, flat.
    fn support(&self, amplitudes: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = self.system.links.len();
        let (mut d, mut v) = (vec![0.0; n], vec![0.0; n]);
        self.loads.support_deformation(amplitudes, &mut d, &mut v);
        (d, v)
    }

    fn pseudo(&self, state: &State, support_d: &[f64]) -> Vec<f64> {
        let own: Vec<f64> = state.d.iter().zip(support_d).map(|(x, y)| x - y).collect();
        let mut pseudo = vec![0.0; self.system.links.active.len()];
        self.kernel.pseudo(&self.system.links, &state.f, &own, &mut pseudo);
        pseudo
    }
}

impl<P: Propagator> Stepper for LinkStepper<'_, P> {
    fn step(
        &mut self,
        from: &State,
        to: &mut State,
        loads: &StepLoads,
        dt: f64,
    ) -> Result<StepEnergy, StepFailure> {
        self.propagator.prepare(dt)?;
        let space = self.propagator.space();
        let (load0, load1) = (space.force(&loads.start), space.force(&loads.end));
        let (support_d0, _) = self.support(&loads.start);
        let (support_d, support_v) = self.support(&loads.end);
        let pseudo0 = self.pseudo(from, &support_d0);
        to.clone_from(from);
        let zero = vec![0.0; pseudo0.len()];
        let before = Forces { load0: &load0, load1: &load1, pseudo0: &pseudo0, pseudo1: &zero };
        let (mut d, mut v) = (zero.clone(), zero.clone());
        self.propagator.predict(&from.motion, &before, &mut to.motion, &mut d, &mut v);
        let compliance = self.propagator.compliance();
        let mut pseudo = pseudo0.clone();
        let mut links = vec![Energy::default(); self.system.links.links.len()];
        self.kernel
            .solve(
                self.model,
                &self.system.links,
                &Affine {
                    d: &d,
                    v: &v,
                    support_d: &support_d,
                    support_v: &support_v,
                    g: &compliance.g,
                    h: &compliance.h,
                    key: compliance.key,
                },
                &Committed { d: &from.d, v: &from.v, history: &from.history, dt },
                &from.scale,
                &mut Converged {
                    d: &mut to.d,
                    v: &mut to.v,
                    f: &mut to.f,
                    history: &mut to.history,
                    energy: &mut links,
                    pseudo: &mut pseudo,
                },
            )
            .map_err(|e| StepFailure::NoEquilibrium { worst: e.worst, residual: e.residual })?;
        let forces = Forces { load0: &load0, load1: &load1, pseudo0: &pseudo0, pseudo1: &pseudo };
        self.propagator.correct(&forces, &mut to.motion);
        to.settle(&self.system.links, &links);
        let work = self.propagator.work(&from.motion, &to.motion, &forces);
        Ok(self.energy(from, to, (&support_d0, &support_d), work, links))
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
        let (mut d, mut rate) = self.support(amplitudes);
        let mut own = vec![0.0; links.active.len()];
        for (motion, flat) in [(&q, &mut d), (&p, &mut rate)] {
            space.deform(motion, &mut own);
            for (a, i) in links.active.iter().enumerate() {
                flat[*i] += own[a];
            }
        }
        let mut state = State::of_links(self.model, links, d, rate, &history);
        let mut force = space.force(amplitudes);
        space.damp(-1.0, &p, &mut force);
        space.stiffness.mul_add(-1.0, &q, &mut force);
        let (support_d, _) = self.support(amplitudes);
        let pseudo = self.pseudo(&state, &support_d);
        space.spread(-1.0, &pseudo, &mut force);
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

    fn distance(&self, a: &State, b: &State) -> f64 {
        energy_distance(self.propagator.space(), a, b)
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
            self.kernel.recall(&self.system.links, one, &compliance.g, &compliance.h);
        }
        Ok(())
    }

    fn stiffness_ratio(&mut self, dt: f64, engaged: &[f64]) -> Result<f64, SolveError> {
        self.propagator.prepare(dt)?;
        let Some(g) = self.propagator.limited() else { return Ok(0.0) };
        let k: Vec<f64> = self.system.links.active.iter().map(|i| engaged[*i]).collect();
        let mut x = vec![1.0; k.len()];
        let mut ratio = 0.0;
        for _ in 0..50 {
            let f: Vec<f64> = x.iter().zip(&k).map(|(a, b)| a * b).collect();
            let mut y = vec![0.0; k.len()];
            g.mul_add(1.0, &f, &mut y);
            let size = y.iter().fold(0.0f64, |a, b| a.max(b.abs()));
            if size == 0.0 {
                return Ok(0.0);
            }
            ratio = size;
            x = y.into_iter().map(|v| v / size).collect();
        }
        Ok(ratio)
    }
}

impl<P: Propagator> LinkStepper<'_, P> {
    /// Takes the dummies out of the books: what they store and damp belongs to the links.
    fn energy(
        &self,
        from: &State,
        to: &State,
        support: (&[f64], &[f64]),
        work: StepWork,
        links: Vec<Energy>,
    ) -> StepEnergy {
        let space = self.propagator.space();
        let (kinetic, mut strain) = kinetic_and_strain(space, &to.motion);
        let (mut link_work, mut moved) = (work.links, 0.0);
        for (a, flat) in self.system.links.active.iter().enumerate() {
            let k = space.dummy_k[a];
            if k != 0.0 {
                let (d0, d1) = (from.d[*flat] - support.0[*flat], to.d[*flat] - support.1[*flat]);
                strain -= 0.5 * k * d1 * d1;
                link_work += 0.5 * k * (d1 * d1 - d0 * d0);
            }
        }
        for i in 0..from.d.len() {
            moved += 0.5 * (from.f[i] + to.f[i]) * (support.1[i] - support.0[i]);
        }
        StepEnergy { work, link_work, support: moved, kinetic, strain, links }
    }
}

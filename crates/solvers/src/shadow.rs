//! The linear structure on a wider basis, driven by the loads and link forces of a run.
//!
//! What it moves beyond the run is what the basis of the run has no room for (see `certificate`).

use crate::modal::{Modes, Sources};
use crate::output_step::jump;
use crate::outputs::Outputs;
use crate::propagator::{Motion, StepKey};
use crate::space::Space;
use crate::stepper::State;
use trilith_model::{Model, Side};
use trilith_system::{LinkBlocks, LoadSet, StepLoads, System};

/// Step sizes that differ by less than this share are one.
const SAME: f64 = 1e-9;
/// The next vectors of a sequence do not hold all that is left.
const BEYOND: f64 = 2.0;
/// The wider structure beside a run.
pub(crate) struct Shadow<'a> {
    system: &'a System,
    loads: &'a LoadSet,
    modes: Modes,
    sources: Sources,
    motion: Motion,
    next: Motion,
    pseudo: Vec<f64>,
    load: [Vec<f64>; 2],
    /// Time it has come to, s, and step sizes so far.
    t: f64,
    sizes: Vec<f64>,
    amplitudes: StepLoads,
    outputs: Outputs,
    blocks: LinkBlocks,
    state: State,
    values: Vec<f64>,
    own: Vec<f64>,
}

impl<'a> Shadow<'a> {
    /// Beside a run that starts from this state, whose displacements and velocities of the free DOFs are `u` and `v`.
    pub(crate) fn new(
        model: &'a Model,
        system: &'a System,
        loads: &'a LoadSet,
        modes: Modes,
        (u, v): (&[f64], &[f64]),
        t: f64,
        state: &State,
    ) -> Self {
        let space = &modes.space;
        let n = space.order();
        let mut motion = [space.coordinates(system, u), space.coordinates(system, v)].concat();
        motion.resize(3 * n, 0.0);
        let outputs = Outputs::new(model, system, space);
        let laws = system.links.laws(model);
        let blocks = LinkBlocks::of(laws.iter().map(|(_, link)| link));
        Self {
            system,
            loads,
            sources: Sources::new(space, &[], &[]),
            next: motion.clone(),
            motion,
            pseudo: state.pseudo.clone(),
            load: [vec![0.0; n], vec![0.0; n]],
            t,
            sizes: Vec::new(),
            amplitudes: StepLoads::default(),
            outputs,
            blocks,
            state: state.clone(),
            values: vec![0.0; model.outputs.len()],
            own: vec![0.0; space.links.len()],
            modes,
        }
    }

    /// Number of pseudo-forces.
    pub(crate) fn links(&self) -> usize {
        self.pseudo.len()
    }

    /// The loads jump at a time.
    pub(crate) fn jump(&mut self, t: f64) {
        if let Some(change) = jump(self.loads, t) {
            self.modes.jump(&mut self.motion, &change);
        }
    }

    /// Follows the run over an accepted step to a time, s, at whose end it has these pseudo-forces.
    pub(crate) fn follow(&mut self, t: f64, to: &[f64]) {
        let Self { modes, sources, motion, next, pseudo, load, loads, amplitudes, .. } = self;
        let length = t - self.t;
        let known = self.sizes.iter().copied().find(|s| (s - length).abs() <= SAME * length);
        let dt = known.unwrap_or_else(|| {
            self.sizes.push(length);
            length
        });
        amplitudes.cut();
        loads.step(self.t, t, amplitudes);
        let space: &Space = &modes.space;
        let [load0, load1] = load;
        space.force_into(&amplitudes.start, load0);
        space.force_into(&amplitudes.end, load1);
        modes.prepare(StepKey { dt, average: 0 });
        let loads = [&load0[..], &load1[..]];
        if let Some(spread) = sources.renew_spread(pseudo) {
            modes.space.links.spread_into(pseudo, spread);
        }
        modes.predict(sources, motion, &loads, next);
        if let Some(spread) = sources.renew_spread(to) {
            modes.space.links.spread_into(to, spread);
        }
        modes.complete(sources, motion, &loads, next);
        std::mem::swap(motion, next);
        pseudo.copy_from_slice(to);
        self.t = t;
    }

    /// Compares the outputs of the run at this moment with its own; `errors` grow to the differences.
    pub(crate) fn compare(&mut self, values: &[f64], state: &State, errors: &mut [f64]) {
        let Self { system, own, modes, .. } = self;
        let links = &system.links;
        let n = modes.space.order();
        self.state.clone_from(state);
        let mut support = [vec![0.0; links.len()], vec![0.0; links.len()]];
        let [d, v] = &mut support;
        self.loads.support_deformation(&self.amplitudes.end, d, v);
        for (motion, flat) in [(&self.motion[..n], d), (&self.motion[n..2 * n], v)] {
            modes.space.links.deform(motion, own);
            links.active.iter().zip(&*own).for_each(|(i, x)| flat[*i] += x);
        }
        let [d, v] = support;
        self.blocks.add_change(&state.tangents.k, [&state.d, &d], &mut self.state.f);
        self.blocks.add_change(&state.tangents.c, [&state.v, &v], &mut self.state.f);
        (self.state.d, self.state.v) = (d, v);
        self.state.motion.clone_from(&self.motion);
        self.outputs.at((self.t, Side::Before), &self.state, self.loads).values(&mut self.values);
        for (error, (a, b)) in errors.iter_mut().zip(self.values.iter().zip(values)) {
            let off = BEYOND * (a - b).abs();
            if off > *error {
                *error = off;
            }
        }
    }
}

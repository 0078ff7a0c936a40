//! The linear structure on a wider basis, driven by the loads and link forces of a run.
//!
//! What it moves beyond the run is what the basis of the run has no room for (see `certificate`). Links answer it:
//!
//! ```text
//! f̃₂ = f̃ + δ,   δ = a + K e + C ė,   e = d₂ − d     K, C: tangents of the run, less effective stiffnesses
//! (I + K G + C H) δ = a + K e* + C ė*               *: under the forces of the run at the end of the step
//! ```
//!
//! Links with a memory have tangents of their own, and a ≠ 0 is what theirs differs by (see `memory`).

mod memory;

use self::memory::Memory;
use crate::fna::{ModalLoads, Modes};
use crate::kernel::{ComplianceMatrix, Jacobian, Layout, StepKey};
use crate::march::jump;
use crate::record::Outputs;
use crate::step::State;
use crate::structure::{Motion, ReducedSystem};
use trilith_model::{Model, Side};
use trilith_system::{LinkBlocks, LoadSet, StepLoads, System, Tangents};

/// Step sizes that differ by less than this share are one.
const SAME: f64 = 1e-9;
/// The next vectors of a sequence do not hold all that is left.
const BEYOND: f64 = 2.0;
/// Active link coordinates up to which the links answer: their equations are dense.
const ANSWERING: usize = 48;
/// The wider structure beside a run.
pub(crate) struct Shadow<'a> {
    system: &'a System,
    loads: &'a LoadSet,
    modes: Modes,
    modal_loads: ModalLoads,
    layout: Layout<'a>,
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
    memory: Memory<'a>,
    values: Vec<f64>,
    /// Tangents reported last, and the largest stiffness of the active link coordinates so far.
    tangents: Tangents,
    stiffest: Vec<f64>,
}

/// What is reported of the end of a step of the run: pseudo-forces of the active link coordinates; deformations, rates, forces
/// and tangents, flat, where links answer, else nothing.
struct Report<'a> {
    pseudo: &'a [f64],
    d: &'a [f64],
    v: &'a [f64],
    f: &'a [f64],
    k: &'a [f64],
    c: &'a [f64],
}

impl<'a> Report<'a> {
    /// One after the other, as they were reported.
    fn of(
        report: &'a [f64],
        active: usize,
        answers: bool,
        system: &System,
        tangents: &Tangents,
    ) -> Self {
        let flat = if answers { system.links.len() } else { 0 };
        let (pseudo, rest) = report.split_at(active);
        let (d, rest) = rest.split_at(flat);
        let (v, rest) = rest.split_at(flat);
        let (f, rest) = rest.split_at(flat);
        let (k, c) = rest.split_at(if answers { tangents.k.len() } else { 0 });
        Self { pseudo, d, v, f, k, c }
    }
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
            modal_loads: ModalLoads::new(space, &[], &[]),
            layout: Layout::new(&system.links, &laws, space.effective_k.clone()),
            next: motion.clone(),
            motion,
            pseudo: state.pseudo.clone(),
            load: [vec![0.0; n], vec![0.0; n]],
            t,
            sizes: Vec::new(),
            amplitudes: StepLoads::default(),
            outputs,
            blocks,
            memory: Memory::new(model, &system.links, state),
            state: state.clone(),
            values: vec![0.0; model.outputs.len()],
            tangents: state.tangents.clone(),
            stiffest: state.stiffest.clone(),
            modes,
        }
    }

    /// True where links answer in it.
    pub(crate) fn answers(&self) -> bool {
        self.pseudo.len() <= ANSWERING
    }

    /// Number of values that a step is reported by: pseudo-forces, and where links answer, deformations, rates, forces and
    /// tangents.
    pub(crate) fn report_len(&self) -> usize {
        let answers = 3 * self.system.links.len() + self.tangents.k.len() + self.tangents.c.len();
        self.pseudo.len() + if self.answers() { answers } else { 0 }
    }

    /// The loads jump at a time.
    pub(crate) fn jump(&mut self, t: f64) {
        if let Some(change) = jump(self.loads, t) {
            self.modes.jump(&mut self.motion, &change);
        }
    }

    /// Follows the run over an accepted step to a time, s, of whose end this is the report.
    pub(crate) fn follow(&mut self, t: f64, report: &[f64]) {
        let answers = self.answers();
        let run = Report::of(report, self.pseudo.len(), answers, self.system, &self.tangents);
        let dt = self.size(t - self.t);
        self.amplitudes.cut();
        self.loads.step(self.t, t, &mut self.amplitudes);
        let [load0, load1] = &mut self.load;
        self.modes.space.force_into(&self.amplitudes.start, load0);
        self.modes.space.force_into(&self.amplitudes.end, load1);
        let key = match answers {
            true => self.take_tangents(&run, dt),
            false => StepKey::exact(dt),
        };
        self.modes.prepare(&key);
        let loads = [&self.load[0][..], &self.load[1][..]];
        if let Some(spread) = self.modal_loads.renew_spread(&self.pseudo) {
            self.modes.space.links.spread_into(&self.pseudo, spread);
        }
        self.modes.predict(&mut self.modal_loads, &self.motion, &loads, &mut self.next);
        let mut support = [vec![0.0; run.d.len()], vec![0.0; run.d.len()]];
        let mut end = run.pseudo.to_vec();
        if answers {
            let more = self.answer(&run, &mut support, dt);
            end.iter_mut().zip(&more).for_each(|(x, more)| *x += more);
        }
        let loads = [&self.load[0][..], &self.load[1][..]];
        if let Some(spread) = self.modal_loads.renew_spread(&end) {
            self.modes.space.links.spread_into(&end, spread);
        }
        self.modes.complete(&mut self.modal_loads, &self.motion, &loads, &mut self.next);
        std::mem::swap(&mut self.motion, &mut self.next);
        if answers {
            add_deformations(&self.modes.space, self.system, &self.motion, &mut support);
            self.memory.go_on([run.d, run.v], support, dt);
        }
        self.pseudo.copy_from_slice(&end);
        self.t = t;
    }

    /// A step size, which is one of those before where it differs from it by rounding.
    fn size(&mut self, length: f64) -> f64 {
        let known = self.sizes.iter().copied().find(|s| (s - length).abs() <= SAME * length);
        known.unwrap_or_else(|| {
            self.sizes.push(length);
            length
        })
    }

    /// Takes the tangents of the run, by which links answer, and chooses the rule of the step: what answers to itself has
    /// the limit of every link.
    fn take_tangents(&mut self, run: &Report<'_>, dt: f64) -> StepKey {
        self.tangents.k.copy_from_slice(run.k);
        self.tangents.c.copy_from_slice(run.c);
        let links = &self.system.links;
        let now = links.stiffness(&self.tangents);
        self.stiffest.iter_mut().zip(now).for_each(|(most, k)| *most = most.max(k));
        self.modes.choose(dt, &mut links.stiffness(&self.tangents), &self.stiffest)
    }

    /// The pseudo-forces that links answer to what the predicted motion deforms them beyond the run; `support` becomes
    /// what supports give deformations and rates.
    fn answer(&mut self, run: &Report<'_>, support: &mut [Vec<f64>; 2], dt: f64) -> Vec<f64> {
        let Self {
            system, loads, modes, layout, amplitudes, memory, tangents, pseudo, next, ..
        } = self;
        let [of_d, of_v] = &mut *support;
        loads.support_deformation(&amplitudes.end, of_d, of_v);
        let mut own = run.f.to_vec();
        memory.linear([run.d, run.v], dt, tangents, &mut own);
        let apart: Vec<f64> = system.links.active.iter().map(|i| own[*i] - run.f[*i]).collect();
        let change: Vec<f64> = run.pseudo.iter().zip(&*pseudo).map(|(x, x0)| x - x0).collect();
        let beyond =
            |motion: &[f64], run: &[f64], support: &[f64], compliance: &ComplianceMatrix| {
                let mut own = vec![0.0; change.len()];
                modes.space.links.deform(motion, &mut own);
                for (x, i) in own.iter_mut().zip(&system.links.active) {
                    *x -= run[*i] - support[*i];
                }
                compliance.mul_add(-1.0, &change, &mut own);
                own
            };
        let n = modes.space.order();
        let compliance = modes.compliance();
        let e = beyond(&next[..n], run.d, &support[0], &compliance.g);
        let rate = beyond(&next[n..2 * n], run.v, &support[1], &compliance.h);
        let mut force = apart;
        for (a, force) in force.iter_mut().enumerate() {
            *force += layout.linear(a, tangents, [&e, &rate]);
        }
        Jacobian::new(layout, compliance, tangents).solve(&mut force);
        if force.iter().any(|x| !x.is_finite()) {
            force.fill(0.0);
        }
        force
    }

    /// Compares the outputs of the run at this moment with its own; `errors` grow to the differences.
    pub(crate) fn compare(&mut self, values: &[f64], state: &State, errors: &mut [f64]) {
        let Self { system, modes, .. } = self;
        let links = &system.links;
        self.state.clone_from(state);
        let mut support = [vec![0.0; links.len()], vec![0.0; links.len()]];
        let [d, v] = &mut support;
        self.loads.support_deformation(&self.amplitudes.end, d, v);
        add_deformations(&modes.space, system, &self.motion, &mut support);
        let [d, v] = support;
        self.blocks.add_change(&state.tangents.k, [&state.d, &d], &mut self.state.f);
        self.blocks.add_change(&state.tangents.c, [&state.v, &v], &mut self.state.f);
        if self.answers() {
            self.memory.put(&mut self.state.f);
        }
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

/// Adds what a motion makes of link deformations and of their rates, flat.
fn add_deformations(
    space: &ReducedSystem,
    system: &System,
    motion: &Motion,
    flat: &mut [Vec<f64>; 2],
) {
    let mut own = vec![0.0; space.links.len()];
    for (motion, flat) in motion.chunks(space.order().max(1)).zip(flat) {
        space.links.deform(motion, &mut own);
        system.links.active.iter().zip(&own).for_each(|(i, x)| flat[*i] += x);
    }
}

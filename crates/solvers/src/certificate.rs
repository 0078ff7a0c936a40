//! How far the outputs of a reduced run are off, estimated while it runs.
//!
//! ```text
//! span Φ₂ ⊃ span Φ:    M ü + C u̇ + K u = p − Bᵀ f   on Φ₂, driven by the link forces f of the run
//! e_o = max over time |o(Φ₂ q₂) − o(Φ q)|                                       (reduction)
//! ```
//!
//! The run's own link forces and loads drive the linear structure once more on a wider basis, which holds the next
//! vectors of the same sequence. What that moves beyond the run is what the run's basis has no room for: the response
//! to the residual of the full equations, dynamics included, to first order in the link forces. Link forces answer by
//! their present tangents. A complete basis leaves nothing.
//!
//! The error of the steps is what a [companion](crate::companion) at a looser tolerance is away; to link forces it adds
//! what the link equations may leave.
//!
//! References: residual-based estimation of reduced models, \[Antoulas 2005, ch. 11\]; two bases of one sequence as
//! estimator, \[Bai & Su 2005\].

use crate::companion::{SAFE, UNSEEN};
use crate::defect::Defect;
use crate::kernel::ForceScale;
use crate::modal::{Modes, Sources};
use crate::output_step::jump;
use crate::outputs::Outputs;
use crate::propagator::{Motion, StepKey};
use crate::samples::Samples;
use crate::space::Space;
use crate::stepper::State;
use crate::timeline::Piece;
use crate::vector::larger;
use serde::Serialize;
use trilith_model::{Model, Output, Quantity, Side};
use trilith_system::{LinkBlocks, LinkSet, LoadSet, StepLoads, System};

/// Step sizes that differ by less than this share are one.
const SAME: f64 = 1e-9;
/// The next vectors of a sequence do not hold all that is left.
const BEYOND: f64 = 2.0;
/// What runs straight moves links that answer, to first order only.
const ANSWERED: f64 = 1.25;

/// How far an output may be off, in its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct OutputError {
    /// Because the basis does not hold all motions.
    pub reduction: f64,
    /// Because of the steps in time; not a number where nobody knows.
    pub step: f64,
}

impl OutputError {
    /// Both; not a number where one is not.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.reduction + self.step
    }
}

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

    /// Follows the run to a state that it has accepted.
    pub(crate) fn follow(&mut self, t: f64, state: &State) {
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
        if let Some(to) = sources.renew_spread(pseudo) {
            modes.space.links.spread_into(pseudo, to);
        }
        modes.predict(sources, motion, &loads, next);
        if let Some(to) = sources.renew_spread(&state.pseudo) {
            modes.space.links.spread_into(&state.pseudo, to);
        }
        modes.complete(sources, motion, &loads, next);
        std::mem::swap(motion, next);
        pseudo.copy_from_slice(&state.pseudo);
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

/// What a run knows of the errors of its outputs.
pub(crate) struct Certificate<'a> {
    shadow: Option<Shadow<'a>>,
    defect: Option<Defect<'a>>,
    samples: Samples<'a>,
    reduction: Vec<f64>,
    /// What the link equations may leave in the outputs that are link forces: kind of force, and share of the largest.
    left: Vec<Option<(usize, f64)>>,
    /// Largest link forces so far.
    forces: ForceScale,
    /// Smallest and largest value of each output so far.
    range: Vec<[f64; 2]>,
}

impl<'a> Certificate<'a> {
    /// Of a run whose link equations are solved to this tolerance.
    pub(crate) fn new(
        model: &Model,
        links: &LinkSet,
        samples: Samples<'a>,
        shadow: Option<Shadow<'a>>,
        defect: Option<Defect<'a>>,
        link_tolerance: f64,
    ) -> Self {
        let left = |output: &Output| match output.quantity {
            Quantity::LinkForce { element, coordinate, factor } => {
                let link = links.links.iter().find(|link| link.element == element)?;
                let kind = usize::from(links.rotational[link.range.start + coordinate]);
                Some((kind, link_tolerance * factor.abs()))
            }
            _ => None,
        };
        let count = model.outputs.len();
        Self {
            shadow,
            defect,
            samples,
            reduction: vec![0.0; count],
            left: model.outputs.iter().map(left).collect(),
            forces: [0.0; 2],
            range: vec![[0.0; 2]; count],
        }
    }

    /// Takes note of a jump of the loads at a time.
    pub(crate) fn jump(&mut self, t: f64, state: &State) {
        if let Some(defect) = &mut self.defect {
            defect.note(t, state);
        }
        if let Some(Shadow { modes, motion, loads, .. }) = &mut self.shadow
            && let Some(change) = jump(loads, t)
        {
            modes.jump(motion, &change);
        }
    }

    /// Takes note of an accepted step in a piece.
    pub(crate) fn follow(&mut self, piece: Piece, t: f64, state: &State) {
        if let Some(shadow) = &mut self.shadow {
            shadow.follow(t, state);
        }
        if let Some(defect) = &mut self.defect {
            defect.follow(t, state);
        }
        self.forces = state.scale;
        let Some(values) = self.samples.take(piece, t, state) else { return };
        for ([least, most], x) in self.range.iter_mut().zip(values) {
            (*least, *most) = (least.min(*x), most.max(*x));
        }
        if let Some(shadow) = &mut self.shadow {
            shadow.compare(values, state, &mut self.reduction);
        }
        if let Some(defect) = &mut self.defect {
            defect.compare(values, state);
        }
    }

    /// The errors, by what a companion has found.
    pub(crate) fn errors(&self, companion: Option<&Samples<'_>>) -> Vec<OutputError> {
        let apart = companion.map(|c| self.samples.apart(c));
        let step = |i: usize| {
            let apart = apart.as_ref().map_or(f64::NAN, |apart| apart[i]);
            let left = self.left[i].map_or(0.0, |(kind, share)| share * self.forces[kind]);
            let straight = self.defect.as_ref().map_or(0.0, |defect| ANSWERED * defect.most[i]);
            larger(SAFE * apart, straight) + UNSEEN * self.size(i) + left
        };
        let reduction = self.reduction.iter().enumerate();
        reduction.map(|(i, e)| OutputError { reduction: *e, step: step(i) }).collect()
    }

    /// The largest value of an output less the smallest, 0 among them.
    fn size(&self, i: usize) -> f64 {
        self.range[i][1] - self.range[i][0]
    }

    /// The largest error of reduction as a share of the range of its output, among those of one kind that are not
    /// small: index of the output and share.
    pub(crate) fn worst(&self, model: &Model) -> Option<(usize, f64)> {
        let size = |i: usize| self.size(i);
        let all = 0..self.reduction.len();
        let share = |i: usize| {
            // What hardly moves is measured by the largest of its kind.
            let alike = |j: &usize| model.outputs[*j].unit == model.outputs[i].unit;
            let largest = all.clone().filter(alike).map(size).fold(0.0, f64::max);
            let scale = size(i).max(0.1 * largest);
            if scale > 0.0 { self.reduction[i] / scale } else { 0.0 }
        };
        all.clone().map(|i| (i, share(i))).max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

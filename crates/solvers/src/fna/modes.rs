//! The structure on a basis, and its step operators by the length of the step.

use super::{LONGEST, ModalLoads};
use crate::kernel::{Compliance, ComplianceMatrix, ModalCompliance, StepKey};
use crate::modal::{ClosedForm, Recurrence, Structure};
use crate::step::StepWork;
use crate::structure::{ModeSet, Motion, ReducedSystem, accelerate_at_once};
use std::sync::Arc;
use trilith_linalg::{Dense, ModalStep, StepSums, work_of_linear};

/// Values (8 bytes each) in the matrices of step sizes that are kept, and sizes at most.
const KEPT_VALUES: usize = 1 << 25;
const MOST_SIZES: usize = 256;
/// A mode whose own share of G·k is below this stays with the exact rule.
pub(crate) const FREE: f64 = 1e-3;

/// Step operators of one step size.
pub(super) struct Step {
    pub dt: f64,
    pub per_dt: f64,
    /// Largest eigenvalue of G k of the engaged links under the exact rule.
    ratio: f64,
    exact: StepOperator,
    /// With average acceleration of some modes, as far as it was needed.
    others: Vec<StepOperator>,
}

/// The step operator of a step size: its recurrence, and the compliance of the links that follows from it.
struct StepOperator {
    recurrence: Recurrence,
    compliance: Compliance,
}

/// The structure on a basis, and its operators for every step size: the same for all motions of it.
pub(crate) struct Modes {
    pub space: ReducedSystem,
    pub(super) structure: Structure,
    /// Stiffness of the engaged links.
    engaged: Vec<f64>,
    steps: Vec<Step>,
    /// Step size, and which of its other operators.
    now: (usize, Option<usize>),
    /// Largest G·k that the exact rule would not have borne.
    pub(super) beyond: Option<f64>,
    /// √k of the links as they are.
    root: Vec<f64>,
    /// The modes that moved by average acceleration last, and room to find them.
    average: ModeSet,
    room: Vec<u64>,
}

impl Modes {
    /// `engaged` is the stiffness of the active link coordinates where they are engaged, N/m or N·m.
    pub(crate) fn new(space: ReducedSystem, engaged: Vec<f64>) -> Self {
        let m = space.order();
        let mut damping = Dense::zeros(m, m);
        let mut coupled = false;
        for (i, j, v) in space.damping.entries() {
            damping[(i, j)] += v;
            coupled |= i != j && v != 0.0;
        }
        let omega2 = space.stiffness.diagonal();
        let modes = m - space.readers.columns();
        let tied = space.tied;
        let structure = Structure {
            modes,
            tied,
            undamped: (modes + tied..m).filter(|i| damping[(*i, *i)] == 0.0).collect(),
            omega2,
            rates: (0..m).map(|i| damping[(i, i)]).collect(),
            mass: (0..m).map(|i| if i < modes { 1.0 } else { 0.0 }).collect(),
            damping: (coupled || tied > 0).then_some(damping),
        };
        Self {
            space,
            structure,
            engaged,
            steps: Vec::new(),
            now: (0, None),
            beyond: None,
            root: Vec::new(),
            average: ModeSet::default(),
            room: Vec::new(),
        }
    }

    /// Index of a step size: mostly that of the step before.
    #[inline]
    fn size(&mut self, dt: f64) -> usize {
        match self.steps.get(self.now.0) {
            Some(step) if step.dt == dt => self.now.0,
            _ => self.other_size(dt),
        }
    }

    #[cold]
    fn other_size(&mut self, dt: f64) -> usize {
        self.steps.iter().position(|s| s.dt == dt).unwrap_or_else(|| {
            let exact = self.operator(Recurrence::exact(&self.structure, dt), StepKey::exact(dt));
            let of_modes = self.compliance_of(&exact.recurrence, 1, self.structure.modes);
            let ratio = ratio(&of_modes, &self.engaged);
            let numbers = exact.compliance.stored() + 12 * self.space.order();
            if self.steps.len() >= (KEPT_VALUES / numbers.max(1)).clamp(8, MOST_SIZES) {
                // A table with samples at any times may ask for as many sizes.
                self.steps.remove(0);
            }
            self.steps.push(Step { dt, per_dt: dt.recip(), ratio, exact, others: Vec::new() });
            self.steps.len() - 1
        })
    }

    fn operator(&self, recurrence: Recurrence, key: StepKey) -> StepOperator {
        let all = self.space.order();
        let [g, h] = [1, 2].map(|row| self.compliance_of(&recurrence, row, all));
        StepOperator { recurrence, compliance: Compliance { g, h, key } }
    }

    /// The rule for a step from a state whose links have this stiffness.
    #[inline]
    pub(crate) fn choose(
        &mut self,
        dt: f64,
        stiffness: &mut dyn Iterator<Item = f64>,
        stiffest: &[f64],
    ) -> StepKey {
        let size = self.size(dt);
        let step = &self.steps[size];
        let mut average = ModeSet::default();
        if step.ratio > LONGEST {
            self.root.clear();
            self.root.extend(stiffness.map(|k| k.max(0.0).sqrt()));
            let present = step.exact.compliance.g.bound(&self.root);
            if present > LONGEST {
                self.beyond = Some(self.beyond.unwrap_or(0.0).max(step.ratio.min(present)));
                average = self.held(dt, stiffest);
            }
        }
        StepKey { dt, average }
    }

    /// The modes that hang on links which are or have been stiff: one that slips now may stick within the step.
    fn held(&mut self, dt: f64, stiffest: &[f64]) -> ModeSet {
        let Self { space, structure, root, average, room, .. } = self;
        if structure.damping.is_some() {
            // All: the first one stands for what damping couples.
            average.renew(structure.modes.max(1), |_| true, room);
            return average.clone();
        }
        root.clear();
        root.resize(space.order(), 0.0);
        for (a, k) in stiffest.iter().enumerate().filter(|(_, k)| **k > 0.0) {
            space.links.row(a).for_each(|(j, b)| root[j] += k * b * b);
        }
        average.renew(structure.modes, |j| root[j] * dt * dt / 6.0 > FREE, room);
        average.clone()
    }

    /// Largest G·k of the engaged links for a step size.
    pub(crate) fn ratio(&mut self, dt: f64) -> f64 {
        let size = self.size(dt);
        self.steps[size].ratio
    }

    /// B Φ diag(a) Φᵀ Bᵀ of the first coordinates, a: the coefficient of s₁ in a row of the recurrence. G is that of the
    /// displacements, H that of the velocities.
    fn compliance_of(
        &self,
        recurrence: &Recurrence,
        row: usize,
        coordinates: usize,
    ) -> ComplianceMatrix {
        let (l, m) = (self.space.links.len(), self.space.order());
        let columns = self.space.links.columns();
        if let Some(columns) = columns.filter(|_| ModalCompliance::serves(l, m)) {
            let (mut unit, mut inner) = (vec![0.0; m], Dense::zeros(m, m));
            for j in 0..coordinates {
                unit[j] = 1.0;
                recurrence.answer(row, &unit, inner.column_mut(j));
                inner.column_mut(j)[coordinates..].fill(0.0);
                unit[j] = 0.0;
            }
            return ComplianceMatrix::Modal(ModalCompliance::new(Arc::clone(columns), inner));
        }
        let mut b = Dense::zeros(self.space.order(), l);
        for a in 0..l {
            for (j, c) in self.space.links.row(a).filter(|(j, _)| *j < coordinates) {
                b[(j, a)] = c;
            }
        }
        let mut scaled = Dense::zeros(b.rows(), l);
        for a in 0..l {
            recurrence.answer(row, b.column(a), scaled.column_mut(a));
        }
        ComplianceMatrix::Full(b.transpose_times(&scaled))
    }

    /// The step size prepared last.
    #[inline]
    pub(super) fn size_now(&self) -> &Step {
        &self.steps[self.now.0]
    }

    fn operator_now(&self) -> &StepOperator {
        let step = self.size_now();
        self.now.1.map_or(&step.exact, |at| &step.others[at])
    }

    /// Prepares for steps.
    #[inline]
    pub(crate) fn prepare(&mut self, key: &StepKey) {
        let size = self.size(key.dt);
        self.now = (size, None);
        if key.average.is_empty() {
            return;
        }
        let others = &self.steps[size].others;
        let at = others.iter().position(|o| o.compliance.key == *key).unwrap_or(others.len());
        if at == others.len() {
            let operator = self
                .operator(Recurrence::mixed(&self.structure, key.dt, &key.average), key.clone());
            self.steps[size].others.push(operator);
        }
        self.now = (size, Some(at));
    }

    /// Compliance of the step prepared last.
    pub(crate) fn compliance(&self) -> &Compliance {
        &self.operator_now().compliance
    }

    /// Loads jump: accelerations follow.
    pub(crate) fn jump(&self, motion: &mut Motion, change: &[f64]) {
        let m = self.space.order();
        let change = self.structure.free_acceleration(&self.space.force(change));
        accelerate_at_once(&mut motion[2 * m..], &change);
    }

    /// A step from a motion under loads.
    fn start<'a>(&self, from: &'a Motion, loads: &'a [&'a [f64]; 2]) -> ModalStep<'a> {
        let per_dt = self.size_now().per_dt;
        ModalStep { from, p: loads, per_dt }
    }

    /// The motion at the end of a step under the pseudo-forces spread last, at both ends: s = Φᵀ p − (B Φ)ᵀ f̃₀.
    #[inline]
    pub(crate) fn predict(
        &self,
        now: &mut ModalLoads,
        from: &Motion,
        loads: &[&[f64]; 2],
        to: &mut Motion,
    ) {
        let recurrence = &self.operator_now().recurrence;
        let step = self.start(from, loads);
        if let Some(modes) = recurrence.own() {
            modes.predict(&step, &mut now.sources, to);
            return self.predict_following(now, from, to);
        }
        let [source0, source1, spread] = now.parts();
        less(loads[0], spread, source0);
        less(loads[1], spread, source1);
        let n = self.space.order();
        let (q, rest) = to.split_at_mut(n);
        let inputs = [&from[..n], &from[n..2 * n], source0, source1];
        recurrence.apply(1, inputs, q);
        recurrence.apply(2, inputs, &mut rest[..n]);
        self.predict_following(now, from, to);
    }

    /// What was predicted, with the pseudo-forces spread last at the end instead: s₁ = Φᵀ p₁ − (B Φ)ᵀ f̃₁. Accelerations, and
    /// the work ∫ s q̇ dt = s₁ q₁ − s₀ q₀ − ṡ ∫q dt.
    #[inline]
    pub(crate) fn complete(
        &self,
        now: &mut ModalLoads,
        from: &Motion,
        loads: &[&[f64]; 2],
        to: &mut Motion,
    ) {
        let recurrence = &self.operator_now().recurrence;
        let step = self.start(from, loads);
        if let Some(modes) = recurrence.own() {
            modes.complete(&step, &mut now.sources, to, &mut now.sums);
            return self.complete_following(now, from, to);
        }
        let n = self.space.order();
        let works = now.works;
        let mut integral = std::mem::take(&mut now.integral);
        let [source0, source1, spread] = now.parts();
        let (q, rest) = to.split_at_mut(n);
        let (v, a) = rest.split_at_mut(n);
        for (i, x) in integral.iter_mut().enumerate() {
            let source = loads[1][i] - spread[i];
            *x = source - source1[i];
            source1[i] = source;
        }
        recurrence.add_answer(1, &integral, q);
        recurrence.add_answer(2, &integral, v);
        self.structure.acceleration(source1, q, v, a);
        if works {
            recurrence.apply(0, [&from[..n], &from[n..2 * n], source0, source1], &mut integral);
            let ends = [&from[..n], &*q];
            let external = work_of_linear(*loads, ends, &integral, step.per_dt);
            let all = work_of_linear([source0, source1], ends, &integral, step.per_dt);
            let ((k0, e0), (k1, e1)) = (self.energy(from), self.energy(to));
            now.sums = StepSums { external, all, kinetic: [k0, k1], strain: [e0, e1] };
        }
        now.integral = integral;
        self.complete_following(now, from, to);
    }

    /// Work done over the step completed last.
    #[inline]
    pub(crate) fn work(&self, now: &ModalLoads) -> StepWork {
        let StepSums { external, all, kinetic: [k0, kinetic], strain: [e0, strain] } = now.sums;
        let damped = self.structure.is_damped();
        StepWork {
            external,
            links: external - all,
            damping: if damped { all - (kinetic - k0) - (strain - e0) - now.lost } else { 0.0 },
            algorithmic: now.lost,
            kinetic,
            strain,
        }
    }

    /// The motion inside steps of the exact rule.
    pub(crate) fn closed_form(&self) -> ClosedForm {
        ClosedForm::new(&self.structure)
    }

    /// ½ q̇ᵀ q̇ and ½ qᵀ Ω² q.
    pub(crate) fn energy(&self, x: &[f64]) -> (f64, f64) {
        self.structure.energy(x)
    }
}

/// Loads less link forces.
fn less(load: &[f64], links: &[f64], source: &mut [f64]) {
    for (s, (p, f)) in source.iter_mut().zip(load.iter().zip(links)) {
        *s = p - f;
    }
}

/// Largest eigenvalue of G diag(k).
fn ratio(g: &ComplianceMatrix, k: &[f64]) -> f64 {
    const ITERATIONS: usize = 50;
    let mut x = vec![1.0; k.len()];
    let mut ratio = 0.0;
    for _ in 0..ITERATIONS {
        let f: Vec<f64> = x.iter().zip(k).map(|(a, b)| a * b).collect();
        let mut y = vec![0.0; k.len()];
        g.mul_add(1.0, &f, &mut y);
        let size = y.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        if size == 0.0 {
            return 0.0;
        }
        ratio = size;
        x = y.into_iter().map(|v| v / size).collect();
    }
    ratio
}

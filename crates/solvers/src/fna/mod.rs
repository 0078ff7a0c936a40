//! FNA: modal equations solved exactly for loads that are linear in the step.
//!
//! ```text
//! q̈ + D q̇ + Ω² q = s(t),      s(t) = Φᵀ p(t) − (B Φ)ᵀ f̃(t) linear in the step
//! (∫q, q, q̇)ₙ₊₁ = exp(A Δt) (0, q, q̇, s, ṡ)ₙ
//! ```
//!
//! Modes without coupling by damping have a recurrence of their own; otherwise (dashpots of the
//! structure, modal damping beside dummies) one exponential of the whole space is taken. Both are exact,
//! also for ω = 0 and beyond critical damping. Static shapes follow the loads (see `rules`).
//!
//! **Stiff links.** With link forces linear in the step the exact rule is the linear-acceleration method
//! on a link: stable only for ω_link Δt < 2√3. Steps that are too long for it at the stiffest link, as stiff as
//! it is then, are made by average acceleration instead in the modes that hang on such links; it has the same
//! form, the same order and no such limit. A contact at rest or in steady sliding then needs no short steps;
//! where something happens, the error control shortens them until the exact rule is back.
//!
//! The work of a linear load is exact too: ∫ s q̇ dt = s₁q₁ − s₀q₀ − ṡ ∫q dt; under average acceleration,
//! with ∫q = Δt (q₀ + q₁)/2, it is the work by which that rule balances.
//!
//! Reference: \[Wilson 2002, ch. 18\].

use crate::error::SolveError;
use crate::kernel::{Compliance, StepKey, Wanted};
use crate::modal::{ClosedForm, Rule, Structure, bit};
use crate::step::{Forces, Motion, Propagator, StepWork};
use crate::structure::{JUMPED, LinkMap, Space, accelerate_at_once, acceleration, rate_at_end};
use crate::vector::equal;
use trilith_linalg::{Dense, ModalStep, Panel, Product, StepSums, work_of_linear};

/// Steps with a larger G·k of the stiffest link are made by average acceleration; the limit of the exact
/// rule is 2 (ω²Δt²/6), and well before it the rule is no better any more.
pub(crate) const LONGEST: f64 = 0.5;
/// A mode whose own share of G·k is below this stays with the exact rule.
pub(crate) const FREE: f64 = 1e-3;

/// Values (8 bytes each) in the matrices of step sizes that are kept, and sizes at most.
const KEPT_VALUES: usize = 1 << 25;
const MOST_SIZES: usize = 256;

/// Rules of one step size.
struct Step {
    dt: f64,
    per_dt: f64,
    /// Largest eigenvalue of G k of the engaged links under the exact rule.
    ratio: f64,
    exact: Way,
    /// With average acceleration of some modes, as far as it was needed.
    others: Vec<Way>,
}

/// A rule and what it makes of the links.
struct Way {
    rule: Rule,
    compliance: Compliance,
}

/// The exact propagator on a basis of modes.
pub(crate) struct Modal {
    modes: Modes,
    now: Sources,
}

/// The structure on a basis, and its rule for every step size: the same for all motions of it.
pub(crate) struct Modes {
    pub space: Space,
    structure: Structure,
    /// Stiffness of the engaged links.
    engaged: Vec<f64>,
    steps: Vec<Step>,
    /// Step size, and which of its other ways.
    now: (usize, Option<usize>),
    /// Largest G·k that the exact rule would not have borne.
    beyond: Option<f64>,
    /// √k of the links as they are.
    root: Vec<f64>,
}

/// What one motion needs on its way through a step.
pub(crate) struct Sources {
    /// Loads less link forces at the start and at the end of the step, and (B Φ)ᵀ of the pseudo-forces spread last,
    /// one after the other.
    sources: Vec<f64>,
    /// The integral of q.
    integral: Vec<f64>,
    /// What the step completed last did, and what it lost where loads had jumped.
    sums: StepSums,
    lost: f64,
    /// Pseudo-forces spread last.
    pseudo: Vec<f64>,
    /// True of what laws damp, and of what any link acts on.
    damped: Vec<bool>,
    linked: Vec<bool>,
    /// The link coordinates whose rates laws look at, and their rows of B Φ where these are few.
    rated: Vec<usize>,
    rows: Option<Product>,
}

impl Sources {
    /// `rated`: the link coordinates whose rates laws look at, `damped`: those whose forces depend on them.
    pub(crate) fn new(space: &Space, rated: &[usize], damped: &[usize]) -> Self {
        let few = rated.len() <= Panel::MOST_ROWS;
        let rows = few.then(|| {
            let mut rows = Dense::zeros(rated.len(), space.order());
            for (i, a) in rated.iter().enumerate() {
                space.links.row(*a).for_each(|(j, c)| rows[(i, j)] = c);
            }
            Product::new(rows)
        });
        let touched = |some: &mut dyn Iterator<Item = usize>| {
            let mut touched = vec![false; space.order()];
            for a in some {
                space.links.row(a).filter(|(_, c)| *c != 0.0).for_each(|(i, _)| touched[i] = true);
            }
            touched
        };
        Self {
            damped: touched(&mut damped.iter().copied()),
            linked: touched(&mut (0..space.links.len())),
            pseudo: vec![0.0; space.links.len()],
            sources: vec![0.0; 3 * space.order()],
            integral: vec![0.0; space.order()],
            sums: StepSums::default(),
            lost: 0.0,
            rated: rated.to_vec(),
            rows,
        }
    }

    /// Rates that laws look at, of velocities of the modes.
    #[inline]
    pub(crate) fn rates(&self, links: &LinkMap, v: &[f64], rates: &mut [f64]) {
        match &self.rows {
            Some(rows) => rows.times(v, rates),
            None => links.deform_some(v, &self.rated, rates),
        }
    }

    /// Where (B Φ)ᵀ f̃ of these pseudo-forces must go, unless they are those spread last.
    #[inline]
    pub(crate) fn renew_spread(&mut self, pseudo: &[f64]) -> Option<&mut [f64]> {
        if equal(&self.pseudo, pseudo) {
            return None;
        }
        self.pseudo.copy_from_slice(pseudo);
        let [_, _, spread] = self.parts();
        Some(spread)
    }

    /// Loads less link forces at both ends, and the link forces spread last.
    fn parts(&mut self) -> [&mut [f64]; 3] {
        let n = self.sources.len() / 3;
        let (source0, rest) = self.sources.split_at_mut(n);
        let (source1, spread) = rest.split_at_mut(n);
        [source0, source1, spread]
    }
}

impl Modal {
    pub(crate) fn new(modes: Modes) -> Self {
        Self { now: Sources::new(&modes.space, &[], &[]), modes }
    }

    /// What several motions can share.
    pub(crate) fn into_modes(self) -> Modes {
        self.modes
    }

    #[inline]
    fn spread(&mut self, pseudo: &[f64]) {
        if let Some(to) = self.now.renew_spread(pseudo) {
            self.modes.space.links.spread_into(pseudo, to);
        }
    }
}

impl Modes {
    /// `engaged` is the stiffness of the active link coordinates where they are engaged, N/m or N·m.
    pub(crate) fn new(space: Space, engaged: Vec<f64>) -> Self {
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
            let exact = self.way(Rule::exact(&self.structure, dt), StepKey { dt, average: 0 });
            let of_modes = self.compliance_of(&exact.rule, 1, self.structure.modes);
            let ratio = ratio(&of_modes, &self.engaged);
            let numbers = 2 * self.engaged.len() * self.engaged.len() + 12 * self.space.order();
            if self.steps.len() >= (KEPT_VALUES / numbers.max(1)).clamp(8, MOST_SIZES) {
                // A table with samples at any times may ask for as many sizes.
                self.steps.remove(0);
            }
            self.steps.push(Step { dt, per_dt: dt.recip(), ratio, exact, others: Vec::new() });
            self.steps.len() - 1
        })
    }

    fn way(&self, rule: Rule, key: StepKey) -> Way {
        let all = self.space.order();
        let (g, h) = (self.compliance_of(&rule, 1, all), self.compliance_of(&rule, 2, all));
        Way { rule, compliance: Compliance { g, h, key } }
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
        let mut average = 0;
        if step.ratio > LONGEST {
            let present = bound(&step.exact.compliance.g, stiffness, &mut self.root);
            if present > LONGEST {
                self.beyond = Some(self.beyond.unwrap_or(0.0).max(step.ratio.min(present)));
                average = self.held(dt, stiffest);
            }
        }
        StepKey { dt, average }
    }

    /// The modes that hang on links which are or have been stiff: one that slips now may stick within the step.
    fn held(&mut self, dt: f64, stiffest: &[f64]) -> u64 {
        if self.structure.damping.is_some() {
            return u64::MAX;
        }
        self.root.clear();
        self.root.resize(self.space.order(), 0.0);
        for (a, k) in stiffest.iter().enumerate().filter(|(_, k)| **k > 0.0) {
            self.space.links.row(a).for_each(|(j, b)| self.root[j] += k * b * b);
        }
        let shares = self.root[..self.structure.modes].iter().enumerate();
        shares.filter(|(_, k)| *k * dt * dt / 6.0 > FREE).fold(0, |all, (j, _)| all | bit(j))
    }

    /// Largest G·k of the engaged links for a step size.
    pub(crate) fn ratio(&mut self, dt: f64) -> f64 {
        let size = self.size(dt);
        self.steps[size].ratio
    }

    /// B Φ (coefficient of s₁ in the given row) Φᵀ Bᵀ of the first coordinates.
    fn compliance_of(&self, rule: &Rule, row: usize, coordinates: usize) -> Dense {
        let l = self.space.links.len();
        let mut b = Dense::zeros(self.space.order(), l);
        for a in 0..l {
            for (j, c) in self.space.links.row(a).filter(|(j, _)| *j < coordinates) {
                b[(j, a)] = c;
            }
        }
        let mut scaled = Dense::zeros(b.rows(), l);
        for a in 0..l {
            rule.answer(row, b.column(a), scaled.column_mut(a));
        }
        b.transpose_times(&scaled)
    }

    fn way_now(&self) -> &Way {
        let step = &self.steps[self.now.0];
        self.now.1.map_or(&step.exact, |at| &step.others[at])
    }

    /// Prepares for steps.
    #[inline]
    pub(crate) fn prepare(&mut self, key: StepKey) {
        let size = self.size(key.dt);
        self.now = (size, None);
        if key.average == 0 {
            return;
        }
        let others = &self.steps[size].others;
        let at = others.iter().position(|w| w.compliance.key == key).unwrap_or(others.len());
        if at == others.len() {
            let way = self.way(Rule::mixed(&self.structure, key.dt, key.average), key);
            self.steps[size].others.push(way);
        }
        self.now = (size, Some(at));
    }

    /// Compliance of the step prepared last.
    pub(crate) fn compliance(&self) -> &Compliance {
        &self.way_now().compliance
    }

    /// Loads jump: accelerations follow.
    pub(crate) fn jump(&self, motion: &mut Motion, change: &[f64]) {
        let m = self.space.order();
        let change = self.structure.free_acceleration(&self.space.force(change));
        accelerate_at_once(&mut motion[2 * m..], &change);
    }

    /// A step from a motion under loads.
    fn start<'a>(&self, from: &'a Motion, loads: &'a [&'a [f64]; 2]) -> ModalStep<'a> {
        let per_dt = self.steps[self.now.0].per_dt;
        ModalStep { from, p: loads, per_dt }
    }

    /// The motion at the end of a step under the pseudo-forces spread last, at both ends.
    #[inline]
    pub(crate) fn predict(
        &self,
        now: &mut Sources,
        from: &Motion,
        loads: &[&[f64]; 2],
        to: &mut Motion,
    ) {
        let rule = &self.way_now().rule;
        let step = self.start(from, loads);
        if let Some(modes) = rule.own() {
            modes.predict(&step, &mut now.sources, to);
            return self.go_on(now, from, to);
        }
        let [source0, source1, spread] = now.parts();
        less(loads[0], spread, source0);
        less(loads[1], spread, source1);
        let n = self.space.order();
        let (q, rest) = to.split_at_mut(n);
        let inputs = [&from[..n], &from[n..2 * n], source0, source1];
        rule.apply(1, inputs, q);
        rule.apply(2, inputs, &mut rest[..n]);
        self.go_on(now, from, to);
    }

    /// Rates of undamped static shapes: the mean rate of the step, and half a step of the acceleration before, which
    /// makes them right at second order; errors in them die out by 1/√2 a step, whatever the link.
    #[inline]
    fn go_on(&self, now: &Sources, from: &Motion, to: &mut Motion) {
        let n = self.space.order();
        for i in self.structure.undamped.iter().copied() {
            let more = 0.5 * self.steps[self.now.0].dt * acceleration(from[2 * n + i]);
            // Links that look at the rate need it now, others as it is at last.
            to[n + i] = if now.damped[i] {
                rate_at_end(from[n + i], to[n + i], more)
            } else {
                to[n + i] + more
            };
        }
    }

    /// Their accelerations, and what a load that jumps does to them at once: that is no rate, and nothing takes the
    /// work that it does beyond what their springs hold then, ½ (s₀ − κ q₀) (q₁ − q₀).
    ///
    /// Where a load bends, the rate jumps, and the acceleration before says nothing of the step: it goes on no
    /// further than the mean rate of the step says it does, and not against it.
    #[inline]
    fn settle_on(&self, now: &mut Sources, from: &Motion, to: &mut Motion) {
        let n = self.space.order();
        let (dt, per_dt) = (self.steps[self.now.0].dt, self.steps[self.now.0].per_dt);
        now.lost = 0.0;
        for i in self.structure.undamped.iter().copied() {
            let jumped = now.sources[i] - self.structure.omega2[i] * from[i];
            now.lost += 0.5 * jumped * (to[i] - from[i]);
            let is_new = from[2 * n + i] == JUMPED;
            if !now.damped[i] && now.linked[i] && is_new {
                // Where links carry a share, only all of them say how far it jumped.
                to[n + i] = from[n + i];
            } else if !now.damped[i] {
                let predicted = 0.5 * dt * acceleration(from[2 * n + i]);
                let mean = to[n + i] - jumped / self.structure.omega2[i] * per_dt - predicted;
                to[n + i] = rate_at_end(from[n + i], mean, predicted);
            }
            // From the rate before a jump, or that of the start, to this one nothing accelerates.
            to[2 * n + i] = if is_new { 0.0 } else { (to[n + i] - from[n + i]) * per_dt };
        }
    }

    /// What was predicted, with the pseudo-forces spread last at the end instead.
    #[inline]
    pub(crate) fn complete(
        &self,
        now: &mut Sources,
        from: &Motion,
        loads: &[&[f64]; 2],
        to: &mut Motion,
    ) {
        let rule = &self.way_now().rule;
        let step = self.start(from, loads);
        if let Some(modes) = rule.own() {
            modes.complete(&step, &mut now.sources, to, &mut now.sums);
            return self.settle_on(now, from, to);
        }
        let n = self.space.order();
        let mut integral = std::mem::take(&mut now.integral);
        let [source0, source1, spread] = now.parts();
        let (q, rest) = to.split_at_mut(n);
        let (v, a) = rest.split_at_mut(n);
        for (i, x) in integral.iter_mut().enumerate() {
            let source = loads[1][i] - spread[i];
            *x = source - source1[i];
            source1[i] = source;
        }
        rule.add_answer(1, &integral, q);
        rule.add_answer(2, &integral, v);
        self.structure.acceleration(source1, q, v, a);
        rule.apply(0, [&from[..n], &from[n..2 * n], source0, source1], &mut integral);
        let ends = [&from[..n], &*q];
        let external = work_of_linear(*loads, ends, &integral, step.per_dt);
        let all = work_of_linear([source0, source1], ends, &integral, step.per_dt);
        let ((k0, e0), (k1, e1)) = (self.energy(from), self.energy(to));
        now.sums = StepSums { external, all, kinetic: [k0, k1], strain: [e0, e1] };
        now.integral = integral;
        self.settle_on(now, from, to);
    }

    /// Work done over the step completed last.
    #[inline]
    pub(crate) fn work(&self, now: &Sources) -> StepWork {
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

/// A bound of the largest eigenvalue of G diag(k): the row sums of √k G √k.
fn bound(g: &Dense, k: &mut dyn Iterator<Item = f64>, root: &mut Vec<f64>) -> f64 {
    root.clear();
    root.extend(k.map(|k| k.max(0.0).sqrt()));
    let row = |(a, x): (usize, &f64)| {
        x * g.column(a).iter().zip(&*root).map(|(g, y)| g.abs() * y).sum::<f64>()
    };
    root.iter().enumerate().filter(|(_, x)| **x > 0.0).map(row).fold(0.0, f64::max)
}

/// Largest eigenvalue of G diag(k).
fn ratio(g: &Dense, k: &[f64]) -> f64 {
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

impl Propagator for Modal {
    fn space(&self) -> &Space {
        &self.modes.space
    }

    fn factorizations(&self) -> usize {
        0
    }

    fn look_at_rates(&mut self, rated: &[usize], damped: &[usize]) -> Result<(), SolveError> {
        self.now = Sources::new(&self.modes.space, rated, damped);
        Ok(())
    }

    fn choose(
        &mut self,
        dt: f64,
        stiffness: &mut dyn Iterator<Item = f64>,
        stiffest: &[f64],
    ) -> StepKey {
        self.modes.choose(dt, stiffness, stiffest)
    }

    fn prepare(&mut self, key: StepKey) -> Result<(), SolveError> {
        self.modes.prepare(key);
        Ok(())
    }

    fn compliance(&self) -> &Compliance {
        self.modes.compliance()
    }

    fn beyond_exact(&self) -> Option<f64> {
        self.modes.beyond
    }

    fn closed_form(&self) -> Option<ClosedForm> {
        Some(self.modes.closed_form())
    }

    fn acceleration(&mut self, force: &[f64]) -> Result<Vec<f64>, SolveError> {
        Ok(self.modes.structure.free_acceleration(force))
    }

    fn predict(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion, wanted: Wanted<'_>) {
        self.spread(forces.pseudo0);
        self.modes.predict(&mut self.now, from, &forces.loads, to);
        let m = self.modes.space.order();
        let links = &self.modes.space.links;
        links.deform(&to[..m], wanted.d);
        self.now.rates(links, &to[m..2 * m], wanted.v);
    }

    fn correct(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion) {
        self.spread(forces.pseudo1);
        self.modes.complete(&mut self.now, from, &forces.loads, to);
    }

    fn work(&mut self, _: &Motion, _: &Motion, _: &Forces<'_>) -> StepWork {
        self.modes.work(&self.now)
    }

    fn energy(&self, x: &[f64]) -> (f64, f64) {
        self.modes.energy(x)
    }
}

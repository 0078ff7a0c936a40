//! What a parameter moves in a model: differences of models around its value.
//!
//! ```text
//! ∂x = (x(θ−2h) − 8 x(θ−h) + 8 x(θ+h) − x(θ+2h)) / 12h        off by h⁴ x⁗′/30
//! ```
//!
//! Laws that only tell values are moved by less, so that none of them changes its branch between the two sides.

use super::step::Pieces;
use crate::basis::LowRank;
use crate::error::SolveError;
use crate::record::Outputs;
use crate::run::{Equations, Prepared, RunOptions, Setup, assemble, before};
use crate::step::{LinksBefore, State};
use crate::structure::{JUMPED, ReducedSystem};
use trilith_linalg::Sparse;
use trilith_model::{Analysis, DynamicCase, Model, Side, SolverKind};
use trilith_system::{Channel, LoadSet, System, Track};

/// Where the models of [`Around::near`] lie, in steps from the value.
pub const OFFSETS: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
/// Their weights over the step.
pub(super) const WEIGHTS: [f64; 4] = [1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0];
/// Where those of [`Around::close`] lie, in steps on both sides.
pub const SMALL: f64 = 1e-3;

/// A parameter by which derivatives are wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// Its name.
    pub name: String,
    /// Its value, SI.
    pub value: f64,
    /// Step h of the differences; a thousandth of the value is a good one.
    pub step: f64,
}

/// The model at values around that of a parameter.
#[derive(Debug)]
pub struct Around {
    /// The parameter.
    pub of: Varied,
    /// At the value and [these](OFFSETS) many steps.
    pub near: [Model; 4],
    /// At the value less, and more, [this](SMALL) part of a step.
    pub close: [Model; 2],
}

/// The same, assembled.
pub(super) struct Assembled<'a> {
    pub around: &'a Around,
    pub systems: [System; 4],
}

impl<'a> Assembled<'a> {
    pub(super) fn new(around: &'a Around) -> Result<Self, SolveError> {
        let [a, b, c, d] = &around.near;
        Ok(Self { around, systems: [assemble(a)?, assemble(b)?, assemble(c)?, assemble(d)?] })
    }

    fn sides(&self) -> impl Iterator<Item = (&'a Model, &System)> {
        self.around.near.iter().zip(&self.systems)
    }
}

/// Σ of four values by their weights, one by one.
pub(super) fn weighted(step: f64, of: [&[f64]; 4]) -> Vec<f64> {
    let sum = |i: usize| (0..4).map(|side| WEIGHTS[side] * of[side][i]).sum::<f64>() / step;
    // What does not move at all has no rounding.
    let moves = |i: usize| of.iter().any(|x| x[i] != of[0][i]);
    (0..of[0].len()).map(|i| if moves(i) { sum(i) } else { 0.0 }).collect()
}

/// What a parameter moves.
pub(super) struct Influence<'a> {
    /// Step of the differences.
    pub step: f64,
    pub structure: Option<Structure>,
    pub loads: Option<Loads>,
    /// The outputs of the models around, and their loads, where rows may move.
    pub outputs: Option<[(Outputs, LoadSet); 4]>,
    /// The models around, for laws.
    pub around: &'a Around,
    pub systems: &'a [System; 4],
    /// Derivative of the state at the start.
    pub start: State,
}

/// Derivatives of M, C, K and B.
pub(super) struct Structure {
    pub mass: Sparse,
    damping: Sparse,
    stiffness: Sparse,
    modal: Vec<(f64, LowRank)>,
    /// Of the rows of the active link coordinates; none where they stay.
    pub rows: Option<Vec<Vec<(usize, f64)>>>,
}

impl Structure {
    /// p −= ∂K u + ∂C v + ∂Bᵀ f; `f` of the active coordinates.
    pub(super) fn resist(&self, u: &[f64], v: &[f64], f: impl Fn(usize) -> f64, p: &mut [f64]) {
        self.stiffness.mul_add(-1.0, u, p);
        self.damping.mul_add(-1.0, v, p);
        for (weight, modal) in &self.modal {
            let mut y = vec![0.0; modal.rate.len()];
            modal.u.transpose_mul_add(1.0, v, &mut y);
            y.iter_mut().zip(&modal.rate).for_each(|(y, rate)| *y *= rate);
            modal.u.mul_add(-weight, &y, p);
        }
        for (a, row) in self.rows.iter().flatten().enumerate() {
            row.iter().for_each(|(i, c)| p[*i] -= c * f(a));
        }
    }

    /// None where nothing moves.
    fn new(step: f64, spaces: &[ReducedSystem; 4]) -> Result<Option<Self>, String> {
        let order = spaces[0].order();
        if spaces.iter().any(|s| s.order() != order || s.links.len() != spaces[0].links.len()) {
            return Err("changes which directions are free".into());
        }
        let sum = |of: &dyn Fn(&ReducedSystem) -> Sparse| {
            let all = [0, 1, 2, 3].map(|i| of(&spaces[i]));
            let parts: Vec<_> = WEIGHTS.iter().zip(&all).map(|(w, a)| (w / step, a)).collect();
            let same = all.iter().all(|a| a.entries().eq(all[0].entries()));
            (Sparse::combine(&parts), same)
        };
        let (mass, same_mass) = sum(&|s| s.mass.clone());
        let (stiffness, same_stiffness) = sum(&|s| s.stiffness.clone());
        let (damping, same_damping) = sum(&|s| {
            let [of_mass, of_stiffness] = s.rayleigh;
            let parts = [(1.0, &s.damping), (of_mass, &s.mass), (of_stiffness, &s.stiffness)];
            Sparse::combine(&parts)
        });
        let like =
            |s: &ReducedSystem| s.modal.as_ref().map(|m| (m.u.values().to_vec(), m.rate.clone()));
        let first = like(&spaces[0]);
        let same_modal = spaces.iter().all(|s| like(s) == first);
        let weights = WEIGHTS.map(|w| w / step);
        let modal = match same_modal {
            true => Vec::new(),
            false => {
                let all = weights.iter().zip(spaces);
                all.filter_map(|(w, s)| s.modal.clone().map(|m| (*w, m))).collect()
            }
        };
        let row = |s: &ReducedSystem, a: usize| s.links.row(a).collect::<Vec<_>>();
        let moves = (0..spaces[0].links.len())
            .any(|a| spaces.iter().any(|s| row(s, a) != row(&spaces[0], a)));
        let rows = moves.then(|| {
            let of = |a: usize| {
                let terms = weights.iter().zip(spaces);
                let mut sum = std::collections::BTreeMap::new();
                for (w, s) in terms {
                    row(s, a).into_iter().for_each(|(i, c)| *sum.entry(i).or_insert(0.0) += w * c);
                }
                sum.into_iter().collect()
            };
            (0..spaces[0].links.len()).map(of).collect()
        });
        let still = same_mass && same_stiffness && same_damping && same_modal && rows.is_none();
        Ok((!still).then_some(Self { mass, damping, stiffness, modal, rows }))
    }
}

/// Loads of the models around, in the coordinates of the solver.
pub(super) struct Loads {
    spaces: [ReducedSystem; 4],
    sets: [LoadSet; 4],
}

impl Loads {
    /// ∂p at a time, and ∂ of the deformations and rates that supports give the links.
    pub(super) fn at(&self, step: f64, t: f64, side: Side, flat: usize) -> [Vec<f64>; 3] {
        let all = [0, 1, 2, 3].map(|i| {
            let (space, set) = (&self.spaces[i], &self.sets[i]);
            let amplitudes: Vec<f64> = set.channels.iter().map(|c| c.track.at(t, side)).collect();
            let (mut d, mut v) = (vec![0.0; flat], vec![0.0; flat]);
            set.support_deformation(&amplitudes, &mut d, &mut v);
            [space.force(&amplitudes), d, v]
        });
        [0, 1, 2].map(|k| weighted(step, [0, 1, 2, 3].map(|i| &all[i][k][..])))
    }
}

/// True where loads are the same at all times.
fn alike(a: &LoadSet, b: &LoadSet) -> bool {
    let same = |(a, b): (&Channel, &Channel)| {
        let same =
            a.deformation == b.deformation && a.rate == b.rate && is_same(&a.track, &b.track);
        a.force == b.force && same
    };
    a.channels.len() == b.channels.len() && a.channels.iter().zip(&b.channels).all(same)
}

fn is_same(a: &Track, b: &Track) -> bool {
    match (a, b) {
        (Track::Constant, Track::Constant) => true,
        (Track::Value { function: f, factor: x }, Track::Value { function: g, factor: y })
        | (Track::Rate { function: f, factor: x }, Track::Rate { function: g, factor: y })
        | (
            Track::Curvature { function: f, factor: x },
            Track::Curvature { function: g, factor: y },
        ) => f == g && x == y,
        _ => false,
    }
}

impl<'a> Influence<'a> {
    /// What a parameter moves in a case of a run.
    pub(super) fn new(
        assembled: &'a Assembled<'a>,
        pieces: &Pieces<'_, '_>,
        options: &RunOptions<'_>,
    ) -> Result<Self, SolveError> {
        let Pieces { prepared, space, watched } = *pieces;
        let Varied { name, step, .. } = &assembled.around.of;
        let refuse = |why: &str| SolveError::NoGradient { reason: format!("`{name}` {why}") };
        let sides: Vec<_> = assembled.sides().collect();
        let mut all = Vec::with_capacity(4);
        for (model, system) in &sides {
            all.push(prepare(model, system, options)?);
        }
        let base = prepared;
        if all.iter().any(|p| !same_course(&p.analysis, &base.analysis)) {
            return Err(refuse(
                "changes the times or the solution of the case, which stay as they are",
            ));
        }
        if all.iter().any(|p| p.loads.channels.len() != base.loads.channels.len()) {
            return Err(refuse("makes loads come and go"));
        }
        if sides.iter().any(|(model, s)| {
            s.links.active != base.system.links.active
                || s.links.history_len != base.system.links.history_len
                || model.outputs.len() != base.model.outputs.len()
        }) {
            return Err(refuse("changes what links the model has"));
        }
        let none = vec![0.0; base.system.links.len()];
        let physical = |i: usize| {
            let p: &Prepared<'_> = &all[i];
            let damping = p.damping().cloned();
            ReducedSystem::physical(p.system, &p.loads, &none, damping)
        };
        let structure =
            Structure::new(*step, &[0, 1, 2, 3].map(physical)).map_err(|e| refuse(&e))?;
        let reduced = base.kind.is_reduced();
        if reduced && structure.is_some() {
            return Err(refuse(&format!(
                "moves the structure, and so the basis of {}: `--solver hht` gives derivatives by it",
                base.kind.name()
            )));
        }
        let mut states = Vec::with_capacity(4);
        for p in &all {
            states.push(start(p, reduced.then_some(base), watched)?);
        }
        let states: [State; 4] = states.try_into().unwrap_or_default();
        let still = all.iter().all(|p| alike(&p.loads, &base.loads));
        let sets = [0, 1, 2, 3].map(|i| all[i].loads.clone());
        let loads = (!still).then(|| Loads {
            spaces: [0, 1, 2, 3].map(|i| match (&base.bases, reduced) {
                (Some(b), true) => {
                    let effective = &base.system.links.effective;
                    ReducedSystem::reduced(
                        base.system,
                        &sets[i],
                        effective,
                        base.damping(),
                        &b.stepping,
                    )
                }
                _ => physical(i),
            }),
            sets: sets.clone(),
        });
        let own = structure.is_some() || loads.is_some();
        let outputs = own.then(|| {
            [0, 1, 2, 3].map(|i| {
                let p = &all[i];
                let physical = physical(i);
                let (system, space) =
                    if reduced { (base.system, space) } else { (p.system, &physical) };
                (Outputs::new(p.model, system, space), sets[i].clone())
            })
        });
        let start = start_moves(*step, &states, space, base);
        let systems = &assembled.systems;
        Ok(Self {
            step: *step,
            structure,
            loads,
            outputs,
            around: assembled.around,
            systems,
            start,
        })
    }
}

/// A model around, ready to be stepped by HHT.
fn prepare<'a>(
    model: &'a Model,
    system: &'a System,
    options: &RunOptions<'_>,
) -> Result<Prepared<'a>, SolveError> {
    let case = model.cases.get(options.case);
    let Some((case, Analysis::Dynamic(analysis))) = case.map(|c| (c, &c.analysis)) else {
        return Err(SolveError::NoGradient { reason: "the case is gone beside its value".into() });
    };
    let before = before(model, system, case, None, None)?;
    let own = RunOptions {
        case: options.case,
        solver: Some(SolverKind::Hht),
        dt: options.dt,
        ..RunOptions::default()
    };
    Prepared::new(Setup { model, system, case, analysis, before }, &own)
}

/// True for cases of one length and one solution.
fn same_course(a: &DynamicCase, b: &DynamicCase) -> bool {
    a.duration == b.duration
        && a.dt == b.dt
        && a.solution.step == b.solution.step
        && a.solution.alpha == b.solution.alpha
}

/// The state that a model around starts from; on the structure of `on`, where that is given.
fn start(of: &Prepared<'_>, on: Option<&Prepared<'_>>, watched: bool) -> Result<State, SolveError> {
    let own = of.equations(watched);
    let equations = match on {
        None => own,
        Some(base) => Equations { model: of.model, loads: &of.loads, ..base.equations(watched) },
    };
    let before = of.initial.links.clone();
    let before = before.unwrap_or_else(|| LinksBefore::rest(of.model, &of.system.links));
    let amplitudes: Vec<f64> =
        of.loads.channels.iter().map(|c| c.track.at(0.0, Side::After)).collect();
    let (u, v) = (&of.initial.displacement, &of.initial.velocity);
    equations.stepper()?.start(u, v, &before, &amplitudes)
}

/// The derivative of the state at the start.
fn start_moves(
    step: f64,
    states: &[State; 4],
    space: &ReducedSystem,
    base: &Prepared<'_>,
) -> State {
    let of = |x: &dyn Fn(&State) -> &[f64]| weighted(step, [0, 1, 2, 3].map(|i| x(&states[i])));
    let mut start = State {
        motion: of(&|s| &s.motion),
        d: of(&|s| &s.d),
        v: of(&|s| &s.v),
        f: of(&|s| &s.f),
        history: of(&|s| &s.history),
        pseudo: vec![0.0; space.links.len()],
        ..State::default()
    };
    let n = space.order();
    for (i, a) in start.motion[2 * n..].iter_mut().enumerate() {
        // The mark of a jump moves nothing.
        if states.iter().any(|s| s.motion[2 * n + i] == JUMPED) {
            *a = 0.0;
        }
    }
    let mut own = vec![0.0; space.links.len()];
    space.links.deform(&start.motion[..n], &mut own);
    for (a, flat) in base.system.links.active.iter().enumerate() {
        start.pseudo[a] = start.f[*flat] - space.effective_k[a] * own[a];
    }
    start
}

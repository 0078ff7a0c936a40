//! The march in lanes: the only loop over time of a sweep.
//!
//! A step starts from the forces that the tangents of the step before predict: where no link changes its
//! regime (open, sticking, slipping …) these are exact for piecewise linear laws, and one look at the laws
//! confirms them. Otherwise Newton's method goes on with the tangents found there.

use super::LaneOutcome;
use super::contact::Feet;
use super::peaks::Peak;
use super::rule::{Mode, mode};
use super::setup::{LaneSetup, Output, Piece};
use crate::observe::{EnergyTotals, LinkEnergy};
use std::sync::Arc;
use trilith_element::Contact;
use trilith_element::lanes::{Arithmetic, ErasedLaw, LaneLinks, LaneStep, Portable, Real, Task};
#[cfg(target_arch = "x86_64")]
use trilith_element::lanes::{FusedOne, WideLanes};
use trilith_model::Side;

/// Residual of the link forces that counts as none, as share of the largest force so far.
const TOLERANCE: f64 = 1e-9;
const ITERATIONS: usize = 60;
/// Share of Newton's correction that is made, one after the other for so many iterations each.
const PARTS: [f64; 4] = [1.0, 0.5, 1.0, 0.25];
const PATIENCE: usize = 8;

/// Analyses that go side by side.
pub(super) fn width() -> usize {
    #[cfg(target_arch = "x86_64")]
    if WideLanes::available().is_some() {
        return WideLanes::WIDTH;
    }
    Portable::WIDTH
}

/// Fewer than this go one by one.
const WORTH_LANES: usize = 3;

/// Runs analyses that fit each other, [`width`](super::width) at most.
///
/// # Panics
/// Where there are none, too many, or they do not fit.
#[must_use]
pub fn march(setups: &[&LaneSetup]) -> Vec<LaneOutcome> {
    assert!(!setups.is_empty() && setups.len() <= width(), "one to width() analyses");
    assert!(setups.iter().all(|s| s.fits(setups[0])), "analyses that fit each other");
    #[cfg(target_arch = "x86_64")]
    if let (Some(wide), Some(one)) = (WideLanes::available(), FusedOne::available()) {
        if setups.len() >= WORTH_LANES {
            return sized(wide, setups);
        }
        return setups.iter().flat_map(|s| sized(one, &[*s])).collect();
    }
    setups.iter().flat_map(|s| sized(Portable, &[*s])).collect()
}

/// Each alone, with the same bits: to compare.
#[must_use]
pub fn march_alone(setup: &LaneSetup) -> Option<LaneOutcome> {
    #[cfg(target_arch = "x86_64")]
    if let Some(one) = FusedOne::available() {
        return sized(one, &[setup]).pop();
    }
    sized(Portable, &[setup]).pop()
}

/// Chooses the sizes that the loops are compiled for: modes, link coordinates, coordinates of a link.
fn sized<A: Arithmetic>(with: A, setups: &[&LaneSetup]) -> Vec<LaneOutcome> {
    let shape = &setups[0].shape;
    let n = shape.links.iter().map(|l| l.2).max().unwrap_or(1);
    let coordinates = n * shape.links.len();
    let small = shape.modes <= 3;
    match (n, coordinates) {
        (1, ..=2) if small => with.run(Lanes::<3, 2, 1> { setups }),
        (1, _) => with.run(Lanes::<12, 12, 1> { setups }),
        (2, ..=4) if small => with.run(Lanes::<3, 4, 2> { setups }),
        (2, _) => with.run(Lanes::<12, 12, 2> { setups }),
        (_, ..=6) if small => with.run(Lanes::<3, 6, 3> { setups }),
        _ => with.run(Lanes::<12, 12, 3> { setups }),
    }
}

struct Lanes<'a, const M: usize, const L: usize, const N: usize> {
    setups: &'a [&'a LaneSetup],
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A> for Lanes<'_, M, L, N> {
    type Output = Vec<LaneOutcome>;

    #[inline(always)]
    fn run(self, with: A) -> Vec<LaneOutcome> {
        let plan = Plan::<A::Real, M, L, N>::new(with, self.setups);
        let mut state = State::new(with, self.setups, &plan);
        let shape = &self.setups[0].shape;
        let parts = shape.grid.substeps;
        let part = shape.grid.dt / parts as f64;
        let usual = Rule::new(with, self.setups, &plan, None);
        let mut loads = plan.no_loads(with);
        let mut cuts: Vec<usize> =
            self.setups.iter().flat_map(|s| s.cut.iter().map(|c| c.0)).collect();
        cuts.sort_unstable();
        cuts.dedup();
        let mut cuts = cuts.into_iter().peekable();
        for step in 0..shape.grid.steps {
            if cuts.next_if_eq(&step).is_some() {
                cut_step(with, self.setups, &plan, step, &mut state);
            } else {
                for i in 0..parts {
                    plan.loads(with, self.setups, step * parts + i, &mut loads);
                    let t = step as f64 * shape.grid.dt + part * i as f64;
                    substep(with, &plan, &usual, &loads, with.splat(t), &mut state);
                }
            }
            if !state.scale[0].any(state.alive) {
                break;
            }
        }
        (0..self.setups.len()).map(|i| state.outcome(with, self.setups[i], i)).collect()
    }
}

/// Links of one law that follow each other.
#[derive(Clone, Copy)]
struct Run {
    law: ErasedLaw,
    first: usize,
    count: usize,
    history: usize,
    parameters: usize,
}

enum Row<R, const M: usize> {
    Motion { order: usize, own: [R; M], base: Vec<R> },
    Element { stiffness: [R; M], damping: [R; M] },
    Deformation { at: usize, factor: R },
    Force { at: usize, factor: R },
    History { at: usize },
    Zero,
}

/// How a channel gets its amplitudes.
enum Source<R> {
    Constant,
    /// One table for all, times a factor.
    Shared(Arc<super::tables::Table>, R),
    /// A table for each.
    Own,
}

/// What does not change in a march.
struct Plan<R, const M: usize, const L: usize, const N: usize> {
    runs: Vec<Run>,
    parameters: Vec<R>,
    /// B.
    b: [[R; M]; L],
    omega2: [R; M],
    damping: [R; M],
    /// 1 where the structure is damped.
    damped: R,
    rotational: [bool; L],
    /// Some coordinate is a rotation.
    turns: bool,
    /// Place of each lane coordinate of the setups.
    places: Vec<usize>,
    /// Load of each channel over the modes.
    forces: Vec<[R; M]>,
    sources: Vec<Source<R>>,
    constant: [R; M],
    outputs: Vec<Row<R, M>>,
    /// Indices of the links that are contacts.
    feet: Vec<usize>,
    /// Rates matter to the laws, accelerations to an output.
    rate: bool,
    accelerations: bool,
}

/// Coefficients of a step size.
struct Rule<R, const M: usize, const L: usize> {
    dt: R,
    per_dt: R,
    c: [[[R; 4]; 3]; M],
    /// −G and −H.
    g: [[R; L]; L],
    h: [[R; L]; L],
}

/// Loads over a step.
struct Loads<R, const M: usize> {
    start: [R; M],
    end: [R; M],
    /// Amplitudes at the end.
    amplitudes: Vec<R>,
}

/// Picks a number of each lane; lanes without an analysis repeat the last.
fn pick<A: Arithmetic>(with: A, setups: &[&LaneSetup], of: impl Fn(&LaneSetup) -> f64) -> A::Real {
    let last = setups.len() - 1;
    with.gather(|i| of(setups[i.min(last)]))
}

impl<R: Real, const M: usize, const L: usize, const N: usize> Plan<R, M, L, N> {
    fn new<A: Arithmetic<Real = R>>(with: A, setups: &[&LaneSetup]) -> Self {
        let one = setups[0];
        let zero = with.splat(0.0);
        let get = |of: &dyn Fn(&LaneSetup) -> f64| pick(with, setups, of);
        let modes = one.shape.modes;
        let mode_wise = |of: &dyn Fn(&LaneSetup, usize) -> f64| -> [R; M] {
            std::array::from_fn(|j| if j < modes { get(&|s| of(s, j)) } else { zero })
        };
        let mut places = Vec::new();
        let mut runs: Vec<Run> = Vec::new();
        let (mut history, mut parameters) = (0, Vec::new());
        for (l, form) in one.forms.iter().enumerate() {
            let (first, law) = (l * N, form.law);
            places.extend((0..law.coordinates).map(|i| first + i));
            let joins = |r: &&mut Run| r.law.id == law.id && law.coordinates == N;
            match runs.last_mut().filter(joins) {
                Some(run) => run.count += 1,
                None => {
                    runs.push(Run { law, first, count: 1, history, parameters: parameters.len() })
                }
            }
            history += law.history;
            parameters.extend((0..law.parameters).map(|i| get(&|s| s.forms[l].parameters[i])));
        }
        let mut b = [[zero; M]; L];
        let mut rotational = [false; L];
        for (i, place) in places.iter().enumerate() {
            b[*place] = mode_wise(&|s, j| s.rows[i][j]);
            rotational[*place] = one.rotational[i];
        }
        let channels = one.forces.len();
        let sources = (0..channels)
            .map(|c| match &one.tables[c] {
                None => Source::Constant,
                Some((table, _)) => {
                    let same = |s: &&LaneSetup| {
                        s.tables[c].as_ref().is_some_and(|(t, _)| Arc::ptr_eq(t, table))
                    };
                    if setups.iter().all(same) {
                        let size = get(&|s| s.tables[c].as_ref().map_or(0.0, |t| t.1));
                        Source::Shared(Arc::clone(table), size)
                    } else {
                        Source::Own
                    }
                }
            })
            .collect();
        let conserved = |s: &LaneSetup, j: usize| -> f64 {
            (0..channels).filter(|c| s.conservative[*c]).map(|c| s.forces[c][j]).sum()
        };
        let rows = |of: &dyn Fn(&LaneSetup) -> Vec<f64>, len: usize| -> Vec<R> {
            let all: Vec<Vec<f64>> = setups.iter().map(|s| of(s)).collect();
            let last = all.len() - 1;
            (0..len).map(|j| with.gather(|i| all[i.min(last)][j])).collect()
        };
        let modal = |of: &dyn Fn(&LaneSetup) -> Vec<f64>| -> [R; M] {
            let mut all = [zero; M];
            all[..modes].copy_from_slice(&rows(of, modes));
            all
        };
        let outputs = (0..one.outputs.len())
            .map(|o| match &one.outputs[o] {
                Output::Motion { order, base, .. } => Row::Motion {
                    order: *order,
                    own: modal(&|s| s.outputs[o].own().to_vec()),
                    base: rows(&|s| s.outputs[o].base().to_vec(), base.len()),
                },
                Output::Element { .. } => Row::Element {
                    stiffness: modal(&|s| s.outputs[o].own().to_vec()),
                    damping: modal(&|s| s.outputs[o].base().to_vec()),
                },
                Output::Deformation { at, .. } => {
                    Row::Deformation { at: places[*at], factor: get(&|s| s.outputs[o].factor()) }
                }
                Output::Force { at, .. } => {
                    Row::Force { at: places[*at], factor: get(&|s| s.outputs[o].factor()) }
                }
                Output::History { at } => Row::History { at: *at },
                Output::Zero => Row::Zero,
            })
            .collect();
        let damped = |s: &LaneSetup| f64::from(u8::from(s.damping.iter().any(|c| *c != 0.0)));
        Self {
            runs,
            parameters,
            b,
            omega2: mode_wise(&|s, j| s.omega2[j]),
            damping: mode_wise(&|s, j| s.damping[j]),
            damped: get(&damped),
            turns: rotational.contains(&true),
            rotational,
            forces: (0..channels).map(|c| mode_wise(&|s, j| s.forces[c][j])).collect(),
            sources,
            constant: mode_wise(&|s, j| conserved(s, j)),
            rate: setups.iter().any(|s| s.forms.iter().any(|f| f.rate)),
            accelerations: one
                .outputs
                .iter()
                .any(|o| matches!(o, Output::Motion { order: 1 | 2, .. })),
            outputs,
            feet: (0..one.forms.len()).filter(|l| one.forms[*l].law.is_contact).collect(),
            places,
        }
    }

    fn no_loads<A: Arithmetic<Real = R>>(&self, with: A) -> Loads<R, M> {
        let zero = with.splat(0.0);
        Loads { start: [zero; M], end: [zero; M], amplitudes: vec![zero; self.forces.len()] }
    }

    /// Loads of the usual step with this index.
    #[inline(always)]
    fn loads<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        setups: &[&LaneSetup],
        at: usize,
        out: &mut Loads<R, M>,
    ) {
        let zero = with.splat(0.0);
        (out.start, out.end) = ([zero; M], [zero; M]);
        for (c, source) in self.sources.iter().enumerate() {
            let (start, end) = match source {
                Source::Constant => (with.splat(1.0), with.splat(1.0)),
                Source::Shared(table, size) => {
                    let [x, y] = table[at];
                    if x == 0.0 && y == 0.0 {
                        out.amplitudes[c] = zero;
                        continue;
                    }
                    (with.splat(x) * *size, with.splat(y) * *size)
                }
                Source::Own => {
                    let of = |s: &LaneSetup, k: usize| match &s.tables[c] {
                        Some((table, size)) => table[at][k] * size,
                        None => 1.0,
                    };
                    (pick(with, setups, |s| of(s, 0)), pick(with, setups, |s| of(s, 1)))
                }
            };
            out.amplitudes[c] = end;
            for j in 0..M {
                out.start[j] = start.mul_add(self.forces[c][j], out.start[j]);
                out.end[j] = end.mul_add(self.forces[c][j], out.end[j]);
            }
        }
    }

    /// Loads of a piece of a step: one (start, length) for each analysis.
    fn loads_of_pieces<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        setups: &[&LaneSetup],
        pieces: &[Piece],
    ) -> Loads<R, M> {
        let mut out = self.no_loads(with);
        let last = setups.len() - 1;
        for c in 0..self.forces.len() {
            let track = |i: usize| (&setups[i.min(last)].tracks[c], pieces[i.min(last)]);
            let start = with.gather(|i| {
                let (track, (t, _)) = track(i);
                track.at(t, Side::After)
            });
            let end = with.gather(|i| {
                let (track, (t, length)) = track(i);
                track.at(t + length, Side::Before)
            });
            out.amplitudes[c] = end;
            for j in 0..M {
                out.start[j] = start.mul_add(self.forces[c][j], out.start[j]);
                out.end[j] = end.mul_add(self.forces[c][j], out.end[j]);
            }
        }
        out
    }
}

impl Output {
    fn own(&self) -> &[f64] {
        match self {
            Self::Motion { own, .. } => own,
            Self::Element { stiffness, .. } => stiffness,
            _ => &[],
        }
    }

    fn base(&self) -> &[f64] {
        match self {
            Self::Motion { base, .. } => base,
            Self::Element { damping, .. } => damping,
            _ => &[],
        }
    }

    fn factor(&self) -> f64 {
        match self {
            Self::Deformation { factor, .. } | Self::Force { factor, .. } => *factor,
            _ => 0.0,
        }
    }
}

impl<R: Real, const M: usize, const L: usize> Rule<R, M, L> {
    /// Of the usual step, or of a length for each analysis.
    fn new<A: Arithmetic<Real = R>, const N: usize>(
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
        lengths: Option<&[f64]>,
    ) -> Self {
        let zero = with.splat(0.0);
        let grid = setups[0].shape.grid;
        let part = grid.dt / grid.substeps as f64;
        let rules: Vec<Vec<Mode>> = setups
            .iter()
            .enumerate()
            .map(|(i, s)| match lengths {
                None => s.rule.clone(),
                Some(t) => {
                    s.omega2.iter().zip(&s.damping).map(|(w, c)| mode(*w, *c, t[i])).collect()
                }
            })
            .collect();
        let last = setups.len() - 1;
        let mut c = [[[zero; 4]; 3]; M];
        for (j, c) in c.iter_mut().enumerate().take(setups[0].shape.modes) {
            for (row, c) in c.iter_mut().enumerate() {
                for (column, c) in c.iter_mut().enumerate() {
                    *c = with.gather(|i| rules[i.min(last)][j][row][column]);
                }
            }
        }
        let compliance = |row: usize| -> [[R; L]; L] {
            let mut g = [[zero; L]; L];
            for a in 0..L {
                for b in 0..L {
                    for j in 0..M {
                        g[a][b] = g[a][b] - plan.b[a][j] * c[j][row][3] * plan.b[b][j];
                    }
                }
            }
            g
        };
        let dt = match lengths {
            None => with.splat(part),
            Some(t) => with.gather(|i| t[i.min(last)]),
        };
        Self { dt, per_dt: with.splat(1.0) / dt, c, g: compliance(1), h: compliance(2) }
    }
}

/// Everything that changes.
#[derive(Clone)]
struct State<R: Real, const M: usize, const L: usize, const N: usize> {
    q: [R; M],
    p: [R; M],
    a: [R; M],
    d: [R; L],
    v: [R; L],
    f: [R; L],
    /// Tangents of the last look at the laws: a row of the block of its link for every coordinate.
    k: [[R; N]; L],
    c: [[R; N]; L],
    /// Factors of J = I + k G + c H, with inverse diagonals.
    lu: [[[R; L]; L]; 2],
    /// Which of both holds.
    held: usize,
    history: Vec<R>,
    scale: [R; 2],
    alive: R::Mask,
    lost: R,
    steps: Vec<LaneStep<R>>,
    hysteretic: Vec<R>,
    viscous: Vec<R>,
    external: R,
    damping: R,
    kinetic: R,
    strain: R,
    potential: R,
    stored: R,
    heat: R,
    largest: R,
    kinetic0: R,
    strain0: R,
    stored0: R,
    potential0: R,
    iterations: R,
    count: usize,
    peaks: Vec<Peak<R>>,
    feet: Feet<R>,
}

impl<R: Real, const M: usize, const L: usize, const N: usize> State<R, M, L, N> {
    fn new<A: Arithmetic<Real = R>>(
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
    ) -> Self {
        let one = setups[0];
        let zero = with.splat(0.0);
        let get = |of: &dyn Fn(&LaneSetup) -> f64| pick(with, setups, of);
        let modes = one.shape.modes;
        let mode_wise = |of: &dyn Fn(&LaneSetup, usize) -> f64| -> [R; M] {
            std::array::from_fn(|j| if j < modes { get(&|s| of(s, j)) } else { zero })
        };
        let flat = |of: &dyn Fn(&LaneSetup, usize) -> f64| -> [R; L] {
            let mut x = [zero; L];
            for (i, place) in plan.places.iter().enumerate() {
                x[*place] = get(&|s| of(s, i));
            }
            x
        };
        let mut lu = [[zero; L]; L];
        for (i, row) in lu.iter_mut().enumerate() {
            row[i] = with.splat(1.0);
        }
        let links = one.forms.len();
        let stored: Vec<R> = (0..links).map(|l| get(&|s| s.stored[l])).collect();
        let feet: Vec<&[Contact]> = setups.iter().map(|s| &s.contacts[..]).collect();
        let kinetic = get(&|s| s.kinetic);
        Self {
            q: mode_wise(&|s, j| s.q[j]),
            p: mode_wise(&|s, j| s.p[j]),
            a: mode_wise(&|s, j| s.a[j]),
            d: flat(&|s, i| s.d[i]),
            v: flat(&|s, i| s.v[i]),
            f: flat(&|s, i| s.f[i]),
            k: [[zero; N]; L],
            c: [[zero; N]; L],
            lu: [lu; 2],
            held: 0,
            history: (0..one.history.len()).map(|i| get(&|s| s.history[i])).collect(),
            scale: [0, 1].map(|i| get(&|s| s.scale[i])),
            alive: zero.le(with.splat(1.0)),
            lost: zero,
            steps: stored.iter().map(|s| LaneStep::elastic(*s)).collect(),
            hysteretic: vec![zero; links],
            viscous: vec![zero; links],
            external: zero,
            damping: zero,
            kinetic,
            strain: get(&|s| s.strain),
            potential: get(&|s| s.potential),
            stored: get(&|s| s.stored.iter().sum()),
            heat: zero,
            largest: kinetic,
            kinetic0: kinetic,
            strain0: get(&|s| s.strain),
            stored0: get(&|s| s.stored.iter().sum()),
            potential0: get(&|s| s.potential),
            iterations: zero,
            count: 0,
            peaks: (0..one.values.len())
                .map(|o| Peak::new(get(&|s| s.values[o]), get(&|s| s.rates[o])))
                .collect(),
            feet: Feet::new(with, &feet, one.forms.iter().all(|f| f.law.coordinates < 3)),
        }
    }
}

/// Rubbish stays in its lane: what holds of all numbers of a state, taken from the other state where a
/// mask says no.
fn keep<R: Real, const M: usize, const L: usize, const N: usize>(
    mask: R::Mask,
    to: &mut State<R, M, L, N>,
    from: &State<R, M, L, N>,
) {
    let one = |x: &mut R, y: &R| *x = R::select(mask, *x, *y);
    let all = |x: &mut [R], y: &[R]| x.iter_mut().zip(y).for_each(|(x, y)| one(x, y));
    all(&mut to.q, &from.q);
    all(&mut to.p, &from.p);
    all(&mut to.a, &from.a);
    all(&mut to.d, &from.d);
    all(&mut to.v, &from.v);
    all(&mut to.f, &from.f);
    all(to.k.as_flattened_mut(), from.k.as_flattened());
    all(to.c.as_flattened_mut(), from.c.as_flattened());
    all(to.lu[to.held].as_flattened_mut(), from.lu[from.held].as_flattened());
    all(&mut to.history, &from.history);
    all(&mut to.scale, &from.scale);
    // Who is lost where the step is not its own is not lost.
    to.alive = (to.alive & mask) | (from.alive & !mask);
    all(&mut to.hysteretic, &from.hysteretic);
    all(&mut to.viscous, &from.viscous);
    for (x, y) in to.steps.iter_mut().zip(&from.steps) {
        one(&mut x.stored, &y.stored);
    }
    for (x, y) in [
        (&mut to.lost, &from.lost),
        (&mut to.external, &from.external),
        (&mut to.damping, &from.damping),
        (&mut to.kinetic, &from.kinetic),
        (&mut to.strain, &from.strain),
        (&mut to.potential, &from.potential),
        (&mut to.stored, &from.stored),
        (&mut to.heat, &from.heat),
        (&mut to.largest, &from.largest),
        (&mut to.iterations, &from.iterations),
    ] {
        one(x, y);
    }
    for (x, y) in to.peaks.iter_mut().zip(&from.peaks) {
        x.keep(mask, y);
    }
    to.feet.keep(mask, &from.feet);
}

/// A step that loads of some analyses cut: piece by piece, the others waiting.
#[inline(never)]
fn cut_step<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    setups: &[&LaneSetup],
    plan: &Plan<A::Real, M, L, N>,
    step: usize,
    state: &mut State<A::Real, M, L, N>,
) {
    let grid = setups[0].shape.grid;
    let parts = grid.substeps;
    let split = |pieces: &[Piece]| -> Vec<Piece> {
        let cut = |(t, length): &Piece| {
            let (t, part) = (*t, length / parts as f64);
            (0..parts).map(move |i| (t + part * i as f64, part)).collect::<Vec<_>>()
        };
        pieces.iter().flat_map(cut).collect()
    };
    let pieces: Vec<Vec<Piece>> = setups
        .iter()
        .map(|s| match s.cut.iter().find(|c| c.0 == step) {
            Some((_, pieces)) => split(pieces),
            None => split(&[(step as f64 * grid.dt, grid.dt)]),
        })
        .collect();
    let most = pieces.iter().map(Vec::len).max().unwrap_or(0);
    for k in 0..most {
        // Who has no piece left repeats the last, and forgets it.
        let now: Vec<Piece> = pieces.iter().map(|p| p[k.min(p.len() - 1)]).collect();
        let last = now.len() - 1;
        let has = with.gather(|i| f64::from(u8::from(k < pieces[i.min(last)].len())));
        let lengths: Vec<f64> = now.iter().map(|p| p.1).collect();
        let rule = Rule::new(with, setups, plan, Some(&lengths));
        let loads = plan.loads_of_pieces(with, setups, &now);
        let t = with.gather(|i| now[i.min(last)].0);
        let before = state.clone();
        with.run(Piecewise { plan, rule: &rule, loads: &loads, t, has, before: &before, state });
    }
}

struct Piecewise<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    plan: &'a Plan<R, M, L, N>,
    rule: &'a Rule<R, M, L>,
    loads: &'a Loads<R, M>,
    t: R,
    has: R,
    before: &'a State<R, M, L, N>,
    state: &'a mut State<R, M, L, N>,
}

impl<A: Arithmetic, const M: usize, const L: usize, const N: usize> Task<A>
    for Piecewise<'_, A::Real, M, L, N>
{
    type Output = ();

    #[inline(always)]
    fn run(self, with: A) {
        substep(with, self.plan, self.rule, self.loads, self.t, self.state);
        let zero = with.splat(0.0);
        keep(zero.lt(self.has), self.state, self.before);
    }
}

/// Calls the laws.
#[inline(always)]
fn look<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    dt: A::Real,
    at: (&[A::Real; L], &[A::Real; L]),
    state: &mut State<A::Real, M, L, N>,
    f: &mut [A::Real; L],
) {
    let State { d: d0, v: v0, history, k, c, .. } = state;
    for run in &plan.runs {
        let (law, n) = (&run.law, run.law.coordinates);
        let r = run.first..run.first + run.count * n;
        let (h, p) = (run.history, run.parameters);
        let whole = n == N;
        // A narrow link: its blocks are spread afterwards.
        let mut narrow = Narrow::new(dt, whole);
        let blocks = match &mut narrow {
            Some(own) => (&mut own.k[..n * n], &mut own.c[..n * n]),
            None => (k[r.clone()].as_flattened_mut(), c[r.clone()].as_flattened_mut()),
        };
        let mut links = LaneLinks {
            parameters: &plan.parameters[p..p + run.count * law.parameters],
            d: &at.0[r.clone()],
            v: &at.1[r.clone()],
            d0: &d0[r.clone()],
            v0: &v0[r.clone()],
            dt,
            history: &mut history[h..h + run.count * law.history],
            f: &mut f[r],
            k: blocks.0,
            c: blocks.1,
        };
        with.force(law, &mut links);
        if let Some(own) = &narrow {
            for i in 0..n {
                for j in 0..n {
                    k[run.first + i][j] = own.k[i * n + j];
                    c[run.first + i][j] = own.c[i * n + j];
                }
            }
        }
    }
}

/// Blocks of a link with fewer coordinates than the widest.
struct Narrow<R> {
    k: [R; 4],
    c: [R; 4],
}

impl<R: Real> Narrow<R> {
    #[inline(always)]
    fn new(zero: R, whole: bool) -> Option<Self> {
        if whole { None } else { Some(Self { k: [zero; 4], c: [zero; 4] }) }
    }
}

/// Deformations (or rates) with forces at the end; `g` is minus the compliance.
#[inline(always)]
fn deform<R: Real, const L: usize>(g: &[[R; L]; L], free: &[R; L], f: &[R; L]) -> [R; L] {
    let mut d = *free;
    for a in 0..L {
        for b in 0..L {
            d[a] = g[a][b].mul_add(f[b], d[a]);
        }
    }
    d
}

/// Solves with the factors.
#[inline(always)]
fn solve<R: Real, const L: usize>(lu: &[[R; L]; L], x: &mut [R; L]) {
    for i in 1..L {
        for j in 0..i {
            x[i] = (-lu[i][j]).mul_add(x[j], x[i]);
        }
    }
    for i in (0..L).rev() {
        for j in i + 1..L {
            x[i] = (-lu[i][j]).mul_add(x[j], x[i]);
        }
        x[i] = x[i] * lu[i][i];
    }
}

/// Factors in place, without pivots: J is I plus something that is positive for passive links.
#[inline(always)]
fn factor<R: Real, const L: usize>(a: &mut [[R; L]; L]) {
    for i in 0..L {
        let inverse = a[i][i].of(1.0) / a[i][i];
        a[i][i] = inverse;
        for r in i + 1..L {
            let share = a[r][i] * inverse;
            a[r][i] = share;
            for j in i + 1..L {
                a[r][j] = (-share).mul_add(a[i][j], a[r][j]);
            }
        }
    }
}

/// One step of all lanes.
#[inline(always)]
fn substep<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    rule: &Rule<A::Real, M, L>,
    loads: &Loads<A::Real, M>,
    t: A::Real,
    state: &mut State<A::Real, M, L, N>,
) {
    let zero = with.splat(0.0);
    let one = with.splat(1.0);
    // Modes without the forces at the end.
    let mut source0 = loads.start;
    for a in 0..L {
        for j in 0..M {
            source0[j] = (-state.f[a]).mul_add(plan.b[a][j], source0[j]);
        }
    }
    let (mut integral, mut q, mut p) = ([zero; M], [zero; M], [zero; M]);
    for j in 0..M {
        let inputs = [state.q[j], state.p[j], source0[j], loads.end[j]];
        let c = &rule.c[j];
        for i in 0..4 {
            integral[j] = c[0][i].mul_add(inputs[i], integral[j]);
            q[j] = c[1][i].mul_add(inputs[i], q[j]);
            p[j] = c[2][i].mul_add(inputs[i], p[j]);
        }
    }
    let (mut d_free, mut v_free) = ([zero; L], [zero; L]);
    for a in 0..L {
        for j in 0..M {
            d_free[a] = plan.b[a][j].mul_add(q[j], d_free[a]);
        }
    }
    if plan.rate {
        for a in 0..L {
            for j in 0..M {
                v_free[a] = plan.b[a][j].mul_add(p[j], v_free[a]);
            }
        }
    }
    // What the tangents of the step before predict.
    let mut f = state.f;
    let (mut d, mut v) = (deform(&rule.g, &d_free, &f), v_free);
    if plan.rate {
        v = deform(&rule.h, &v_free, &f);
    }
    let mut change = [zero; L];
    for a in 0..L {
        let first = a / N * N;
        for i in 0..N {
            change[a] = state.k[a][i].mul_add(d[first + i] - state.d[first + i], change[a]);
        }
    }
    if plan.rate {
        for a in 0..L {
            let first = a / N * N;
            for i in 0..N {
                change[a] = state.c[a][i].mul_add(v[first + i] - state.v[first + i], change[a]);
            }
        }
    }
    solve(&state.lu[state.held], &mut change);
    for a in 0..L {
        f[a] = f[a] + change[a];
    }
    let mut forces = [zero; L];
    let mut wrong = state.alive;
    for iteration in 0..ITERATIONS {
        d = deform(&rule.g, &d_free, &f);
        if plan.rate {
            v = deform(&rule.h, &v_free, &f);
        }
        look(with, plan, rule.dt, (&d, &v), state, &mut forces);
        state.iterations = state.iterations + one.only(wrong);
        let share = with.splat(TOLERANCE);
        let mut residual = [zero; L];
        for a in 0..L {
            residual[a] = forces[a] - f[a];
        }
        let mut fine = zero.le(one);
        if plan.turns {
            let mut scale = state.scale;
            for a in 0..L {
                let kind = usize::from(plan.rotational[a]);
                scale[kind] = scale[kind].max(forces[a].abs());
            }
            for a in 0..L {
                let allowed = scale[usize::from(plan.rotational[a])] * share;
                fine = fine & residual[a].abs().le(allowed);
            }
        } else {
            let mut scale = state.scale[0];
            for a in 0..L {
                scale = scale.max(forces[a].abs());
            }
            let allowed = scale * share;
            for a in 0..L {
                fine = fine & residual[a].abs().le(allowed);
            }
        }
        wrong = wrong & !fine;
        if !zero.any(wrong) {
            break;
        }
        let mut j = [[zero; L]; L];
        for a in 0..L {
            let first = a / N * N;
            j[a][a] = one;
            for i in 0..N {
                let k = -state.k[a][i];
                for b in 0..L {
                    j[a][b] = k.mul_add(rule.g[first + i][b], j[a][b]);
                }
                if plan.rate {
                    let c = -state.c[a][i];
                    for b in 0..L {
                        j[a][b] = c.mul_add(rule.h[first + i][b], j[a][b]);
                    }
                }
            }
        }
        factor(&mut j);
        // From one place to the other: not a store under a mask.
        let [first, second] = &mut state.lu;
        let (from, to) = if state.held == 0 { (first, second) } else { (second, first) };
        for a in 0..L {
            for b in 0..L {
                to[a][b] = A::Real::select(wrong, j[a][b], from[a][b]);
            }
        }
        solve(to, &mut residual);
        state.held = 1 - state.held;
        // Who goes in circles between two regimes takes shorter ways.
        let part = with.splat(PARTS[(iteration / PATIENCE).min(PARTS.len() - 1)]);
        for a in 0..L {
            f[a] = f[a] + (part * residual[a]).only(wrong);
        }
    }
    if zero.any(wrong) {
        // Those are lost; the others go on.
        state.lost = A::Real::select(wrong, t + rule.dt, state.lost);
        state.alive = state.alive & !wrong;
    }

    // The end of the step.
    let mut push = [zero; M];
    for a in 0..L {
        for j in 0..M {
            push[j] = f[a].mul_add(plan.b[a][j], push[j]);
        }
    }
    let (mut external, mut total) = (zero, zero);
    let (mut kinetic, mut strain, mut potential) = (zero, zero, zero);
    for j in 0..M {
        let c = &rule.c[j];
        integral[j] = (-c[0][3]).mul_add(push[j], integral[j]);
        q[j] = (-c[1][3]).mul_add(push[j], q[j]);
        p[j] = (-c[2][3]).mul_add(push[j], p[j]);
        let source1 = loads.end[j] - push[j];
        // ∫ s q̇ dt of a load that is linear in the step.
        let mean = integral[j] * rule.per_dt;
        let ext1 = loads.end[j] * (q[j] - mean);
        let ext0 = loads.start[j] * (state.q[j] - mean);
        external = external + (ext1 - ext0);
        total = total + (source1 * (q[j] - mean) - source0[j] * (state.q[j] - mean));
        kinetic = p[j].mul_add(p[j], kinetic);
        let w = plan.omega2[j] * q[j];
        strain = w.mul_add(q[j], strain);
        potential = (-plan.constant[j]).mul_add(q[j], potential);
        if plan.accelerations {
            state.a[j] = (-plan.damping[j]).mul_add(p[j], source1) - w;
        }
    }
    let half = with.splat(0.5);
    let (kinetic, strain) = (half * kinetic, half * strain);
    let damping = total - (kinetic - state.kinetic) - (strain - state.strain);
    state.damping = state.damping + damping.only(zero.lt(plan.damped));
    (state.kinetic, state.strain, state.potential) = (kinetic, strain, potential);
    state.external = state.external + external;

    // What the links did.
    let mut at = 0;
    for run in &plan.runs {
        let (law, n) = (&run.law, run.law.coordinates);
        let r = run.first..run.first + run.count * n;
        let (h, o) = (run.history, run.parameters);
        let mut links = LaneLinks {
            parameters: &plan.parameters[o..o + run.count * law.parameters],
            d: &d[r.clone()],
            v: &v[r.clone()],
            d0: &state.d[r.clone()],
            v0: &state.v[r.clone()],
            dt: rule.dt,
            history: &mut state.history[h..h + run.count * law.history],
            f: &mut forces[r],
            k: &mut [],
            c: &mut [],
        };
        with.commit(law, &mut links, &mut state.steps[at..at + run.count]);
        at += run.count;
    }
    let mut stored = zero;
    for (i, step) in state.steps.iter().enumerate() {
        stored = stored + step.stored;
        state.hysteretic[i] = state.hysteretic[i] + step.hysteretic;
        state.viscous[i] = state.viscous[i] + step.viscous;
        state.heat = state.heat + (step.hysteretic + step.viscous);
    }
    state.stored = stored;
    (state.q, state.p) = (q, p);
    (state.d, state.v, state.f) = (d, v, f);
    for a in 0..L {
        let kind = usize::from(plan.rotational[a]);
        let kind = if plan.turns { kind } else { 0 };
        state.scale[kind] = state.scale[kind].max(forces[a].abs());
    }
    let input = state.kinetic0 + state.external + (state.potential - state.potential0);
    for size in [
        input,
        state.kinetic,
        state.potential - state.potential0,
        state.strain - state.strain0,
        stored - state.stored0,
    ] {
        state.largest = state.largest.max(size.abs());
    }
    state.count += 1;
    show(with, plan, rule, loads, t, state);
    state.feet.enter(&state.steps, &plan.feet);
}

#[inline(always)]
fn dot<R: Real>(zero: R, row: &[R], x: &[R]) -> R {
    let mut y = zero;
    for (c, x) in row.iter().zip(x) {
        y = c.mul_add(*x, y);
    }
    y
}

/// Outputs after a step.
#[inline(always)]
fn show<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    rule: &Rule<A::Real, M, L>,
    loads: &Loads<A::Real, M>,
    t: A::Real,
    state: &mut State<A::Real, M, L, N>,
) {
    let zero = with.splat(0.0);
    for (row, peak) in plan.outputs.iter().zip(&mut state.peaks) {
        let (y, rate) = match row {
            Row::Motion { order: 0, own, .. } => {
                (dot(zero, own, &state.q), Some(dot(zero, own, &state.p)))
            }
            Row::Motion { order: 1, own, .. } => {
                (dot(zero, own, &state.p), Some(dot(zero, own, &state.a)))
            }
            Row::Motion { own, base, .. } => {
                (dot(zero, own, &state.a) + dot(zero, base, &loads.amplitudes), None)
            }
            Row::Element { stiffness, damping } => {
                (dot(zero, stiffness, &state.q) + dot(zero, damping, &state.p), None)
            }
            Row::Deformation { at, factor } => {
                let v = if plan.rate { state.v[*at] } else { dot(zero, &plan.b[*at], &state.p) };
                (*factor * state.d[*at], Some(*factor * v))
            }
            Row::Force { at, factor } => (*factor * state.f[*at], None),
            Row::History { at } => (state.history[*at], None),
            Row::Zero => (zero, None),
        };
        peak.advance(with, t, rule.dt, y, rate);
    }
}

/// Where all energy has left again, the error is measured against this share of the largest, and never
/// against less than this share of what stands in springs and loads; as in the ledger.
const SHARE_OF_LARGEST: f64 = 0.01;
const SHARE_OF_STANDING: f64 = 1e-6;

impl<R: Real, const M: usize, const L: usize, const N: usize> State<R, M, L, N> {
    fn outcome<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        setup: &LaneSetup,
        lane: usize,
    ) -> LaneOutcome {
        let of = |x: R| with.lane(x, lane);
        let total = |x: &[R]| -> f64 { x.iter().map(|y| of(*y)).sum() };
        let potential = of(self.potential) - setup.potential;
        let mut energy = EnergyTotals {
            input: setup.kinetic + of(self.external) + potential,
            kinetic: of(self.kinetic),
            strain: of(self.strain) - setup.strain,
            potential,
            modal_damping: of(self.damping),
            link_stored: of(self.stored) - setup.stored.iter().sum::<f64>(),
            link_hysteretic: total(&self.hysteretic),
            link_viscous: total(&self.viscous),
            ..EnergyTotals::default()
        };
        let e = &energy;
        let heat = e.modal_damping + e.link_hysteretic + e.link_viscous;
        let out = e.kinetic + e.strain + e.potential + e.link_stored + heat;
        let error = e.input - out;
        let standing = of(self.strain).abs() + of(self.stored).abs() + of(self.potential).abs();
        let shares = [SHARE_OF_LARGEST * of(self.largest), SHARE_OF_STANDING * standing];
        let size = [e.input, e.kinetic, e.potential, heat]
            .into_iter()
            .chain(shares)
            .fold(0.0, |a: f64, b| a.max(b.abs()));
        energy.error = error;
        energy.error_relative = if size > 0.0 { error.abs() / size } else { 0.0 };
        let alive = of(with.splat(1.0).only(self.alive)) == 1.0;
        let finite = energy.error_relative.is_finite();
        let grid = setup.shape.grid;
        let lost = match (alive, finite) {
            (true, true) => None,
            (true, false) => Some(grid.steps as f64 * grid.dt),
            (false, _) => Some(of(self.lost)),
        };
        LaneOutcome {
            lost,
            steps: self.count,
            iterations: of(self.iterations) as usize,
            outputs: self.peaks.iter().map(|p| p.of_lane(with, lane)).collect(),
            energy,
            link_energy: setup
                .elements
                .iter()
                .enumerate()
                .map(|(i, element)| {
                    let energy = LinkEnergy {
                        stored: of(self.steps[i].stored),
                        hysteretic: of(self.hysteretic[i]),
                        viscous: of(self.viscous[i]),
                    };
                    (*element, energy)
                })
                .collect(),
            contact: self.feet.of_lane(with, lane),
        }
    }
}

//! How forces and histories of links move with the motion, with what was before, and with parameters.
//!
//! A law with a form over lanes is asked in dual numbers: exact to rounding, eight parameters at once. Any other is asked near
//! its state on both sides: a difference of fourth order along the motion, and of second order along the parameter; off by some
//! 1e-9 where it does not bend between.

use super::around::{SMALL, WEIGHTS, weighted};
use super::influence::Influence;
use crate::kernel::LawResponse;
use crate::step::State;
use trilith_element::lanes::{DIRECTIONS, Directions, Dual, ErasedLaw, LaneLinks, LaneStep};
use trilith_element::{Kinematics, Link};
use trilith_model::Model;
use trilith_system::{LinkInstance, LinkSet, System};

/// Steps of differences along the motion, as share of the largest values so far.
const ALONG: f64 = 1e-5;
/// At least as far as this share of the parameter goes: what is rounding yet has no size.
const LEAST: f64 = 1e-8;

/// How the laws of all links move.
pub(super) struct LawMoves<'a> {
    links: Vec<LinkMoves<'a>>,
    /// The largest deformations, rates and histories so far.
    most: [Vec<f64>; 3],
    /// Values of the parameters.
    values: Vec<f64>,
    /// Derivatives of the heat of every link so far, by each parameter, J over the parameter.
    heat: Vec<Vec<f64>>,
    work: Work,
}

/// How one law moves.
struct LinkMoves<'a> {
    /// Index among the links.
    index: usize,
    law: &'a dyn Link,
    link: &'a LinkInstance,
    form: Form<'a>,
}

enum Form<'a> {
    /// Over lanes: which of the coordinates, whether rates matter, parameters, and their derivatives.
    Lanes {
        law: Box<ErasedLaw>,
        at: Vec<usize>,
        rate: bool,
        parameters: Vec<f64>,
        by: Vec<Vec<f64>>,
    },
    /// Values alone: the law on both sides of each parameter that moves it, and how far apart.
    Values(Vec<Option<([&'a dyn Link; 2], f64)>>),
}

/// Numbers of a question in dual form.
#[derive(Default)]
struct Work {
    parameters: Vec<Directions>,
    d: Vec<Directions>,
    v: Vec<Directions>,
    d0: Vec<Directions>,
    v0: Vec<Directions>,
    history: Vec<Directions>,
    trial: Vec<Directions>,
    f: Vec<Directions>,
    k: Vec<Directions>,
    c: Vec<Directions>,
    response: LawResponse,
}

/// A substep that was accepted.
#[derive(Clone, Copy)]
pub(super) struct Made<'a> {
    pub from: &'a State,
    pub to: &'a State,
    pub dt: f64,
}

impl<'a> LawMoves<'a> {
    pub(super) fn new(
        model: &'a Model,
        links: &'a LinkSet,
        by: &[Influence<'a>],
        start: &State,
    ) -> Self {
        let moves = |l: usize, law: &'a dyn Link, link: &'a LinkInstance| LinkMoves {
            index: l,
            law,
            link,
            form: lanes(links, l, law, link, by)
                .unwrap_or_else(|| Form::Values(by.iter().map(|by| sides(l, by)).collect())),
        };
        let all = links.links.iter().enumerate();
        let all = all.filter_map(|(l, link)| Some(moves(l, links.law(model, link)?, link)));
        let mut it = Self {
            links: all.collect(),
            most: [vec![0.0; links.len()], vec![0.0; links.len()], vec![0.0; links.history_len]],
            values: by.iter().map(|by| by.around.of.value).collect(),
            heat: vec![vec![0.0; by.len()]; links.links.len()],
            work: Work::default(),
        };
        it.see(start);
        it
    }

    /// Takes note of how large things are.
    pub(super) fn see(&mut self, state: &State) {
        let Self { most: [d, v, history], .. } = self;
        for (most, now) in [(d, &state.d), (v, &state.v), (history, &state.history)] {
            most.iter_mut().zip(now).for_each(|(m, x)| *m = m.max(x.abs()));
        }
    }

    /// Derivatives of the heat of every link so far, by each parameter.
    pub(super) fn heat(&self) -> &[Vec<f64>] {
        &self.heat
    }

    /// Forces at the end of a substep along the moves at its start, those of deformation and rate at its end that are in `next`
    /// already, and the parameters; with `whole`, the histories as well, and the heat is entered.
    pub(super) fn along(
        &mut self,
        made: Made<'_>,
        moves: &[State],
        next: &mut [State],
        whole: bool,
    ) {
        let Self { links, most, values, heat, work } = self;
        for one in links {
            let heat = &mut heat[one.index];
            match &one.form {
                Form::Lanes { law, at, rate, parameters, by } => {
                    let count = moves.len();
                    for first in (0..count).step_by(DIRECTIONS) {
                        let some = first..(first + DIRECTIONS).min(count);
                        let by = &by[some.clone()];
                        let ends = (&moves[some.clone()], &mut next[some.clone()]);
                        let asked = (&**law, &at[..], *rate, &parameters[..], by);
                        let more = by_duals(asked, one.link, made, ends, whole, work);
                        if whole {
                            heat[some].iter_mut().zip(more.by).for_each(|(h, x)| *h += x);
                        }
                    }
                }
                Form::Values(sides) => {
                    let all = sides.iter().zip(moves).zip(&mut *next);
                    let all = all.zip(&*values).zip(heat);
                    for ((((sides, moves), next), value), heat) in all {
                        let ends = (moves, next);
                        let least = LEAST * value.abs();
                        let more = by_values(
                            one,
                            sides.as_ref(),
                            made,
                            ends,
                            (most, least),
                            &mut work.response,
                        );
                        if whole {
                            *heat += more;
                        }
                    }
                }
            }
        }
    }
}

/// The law of a link over lanes, with the derivatives of its parameters; none where it has no such form, or a model around
/// has another one.
fn lanes<'a>(
    links: &LinkSet,
    l: usize,
    law: &dyn Link,
    link: &LinkInstance,
    by: &[Influence<'a>],
) -> Option<Form<'a>> {
    let moves = |flat: usize| !links.rows[flat].is_empty() || !links.support_rows[flat].is_empty();
    let active: Vec<bool> = link.range.clone().map(moves).collect();
    let form = law.lanes(&active)?;
    if form.law.history != link.history.len() {
        return None;
    }
    let of = |by: &Influence<'a>| {
        let side = |i: usize| {
            let (model, system) = (&by.around.near[i], &by.systems[i]);
            let own = law_of(model, system, l)?.lanes(&active)?;
            let same = own.law.id == form.law.id && own.coordinates == form.coordinates;
            same.then_some(own.parameters)
        };
        let all = [side(0)?, side(1)?, side(2)?, side(3)?];
        Some(weighted(by.step, [0, 1, 2, 3].map(|i| &all[i][..])))
    };
    let by: Option<Vec<Vec<f64>>> = by.iter().map(of).collect();
    Some(Form::Lanes {
        law: Box::new(form.law),
        at: form.coordinates,
        rate: form.rate && law.uses_rates(),
        parameters: form.parameters,
        by: by?,
    })
}

/// The law of the link with this index in a model around.
fn law_of<'a>(model: &'a Model, system: &'a System, l: usize) -> Option<&'a dyn Link> {
    system.links.law(model, system.links.links.get(l)?)
}

/// The law on both sides close to a parameter, and how far apart they are; none where it does not move.
fn sides<'a>(l: usize, by: &Influence<'a>) -> Option<([&'a dyn Link; 2], f64)> {
    let element = by.systems[0].links.links.get(l)?.element;
    let [low, high] = &by.around.close;
    let moved = by.systems[0].links.links[l].settled.is_some()
        || low.elements[element].values != high.elements[element].values
        || low.elements[element].frame.0 != high.elements[element].frame.0
        || low.elements[element]
            .nodes
            .iter()
            .any(|n| low.nodes[*n].position != high.nodes[*n].position);
    let law = |model: &'a Model, system: usize| law_of(model, &by.systems[system], l);
    let settled = by.systems[0].links.links[l].settled.is_some();
    match (moved, settled) {
        (false, _) => None,
        // What the assembly has completed is known of the models it was made of alone.
        (true, true) => {
            let near = &by.around.near;
            Some(([law(&near[1], 1)?, law(&near[2], 2)?], 2.0 * by.step))
        }
        (true, false) => Some(([law(low, 0)?, law(high, 0)?], 2.0 * SMALL * by.step)),
    }
}

type Asked<'a> = (&'a ErasedLaw, &'a [usize], bool, &'a [f64], &'a [Vec<f64>]);

fn constant(x: f64) -> Directions {
    Dual::constant(x)
}

/// In dual numbers. The heat of the substep.
fn by_duals(
    (law, at, rate, parameters, by): Asked<'_>,
    link: &LinkInstance,
    made: Made<'_>,
    (moves, next): (&[State], &mut [State]),
    whole: bool,
    work: &mut Work,
) -> Directions {
    let flat = |i: &usize| link.range.start + i;
    let dual = |x: f64, by: &dyn Fn(usize) -> f64| {
        let mut it = constant(x);
        (0..moves.len()).for_each(|j| it.by[j] = by(j));
        it
    };
    let fill = |to: &mut Vec<Directions>, from: &mut dyn Iterator<Item = Directions>| {
        to.clear();
        to.extend(from);
    };
    let Made { from, to, dt } = made;
    let none = constant(f64::NAN);
    let all = || at.iter().map(flat);
    let count = 0..parameters.len();
    fill(&mut work.parameters, &mut count.map(|p| dual(parameters[p], &|j| by[j][p])));
    fill(&mut work.d, &mut all().map(|i| dual(to.d[i], &|j| next[j].d[i])));
    fill(&mut work.d0, &mut all().map(|i| dual(from.d[i], &|j| moves[j].d[i])));
    if rate {
        fill(&mut work.v, &mut all().map(|i| dual(to.v[i], &|j| next[j].v[i])));
        fill(&mut work.v0, &mut all().map(|i| dual(from.v[i], &|j| moves[j].v[i])));
    } else {
        fill(&mut work.v, &mut all().map(|_| none));
        fill(&mut work.v0, &mut all().map(|_| none));
    }
    let history = link.history.clone();
    fill(&mut work.history, &mut history.map(|i| dual(from.history[i], &|j| moves[j].history[i])));
    let n = at.len();
    let zero = constant(0.0);
    for (x, n) in [
        (&mut work.trial, link.history.len()),
        (&mut work.f, n),
        (&mut work.k, n * n),
        (&mut work.c, n * n),
    ] {
        x.clear();
        x.resize(n, zero);
    }
    let Work { parameters, d, v, d0, v0, history, trial, f, k, c, .. } = work;
    let dt = constant(dt);
    let mut links = LaneLinks { parameters, d, v, d0, v0, dt, history, trial, f, k, c };
    let mut did = [LaneStep::elastic(zero)];
    law.derivative(&mut links, &mut did);
    let [did] = did;
    for (j, next) in next.iter_mut().enumerate() {
        next.f[link.range.clone()].fill(0.0);
        for (i, f) in at.iter().zip(&work.f) {
            next.f[flat(i)] = f.by[j];
        }
        if whole {
            let trial = next.history[link.history.clone()].iter_mut().zip(&work.trial);
            trial.for_each(|(to, x)| *to = x.by[j]);
        }
    }
    did.hysteretic + did.viscous
}

/// By differences. The derivative of the heat of the substep.
fn by_values(
    one: &LinkMoves<'_>,
    sides: Option<&([&dyn Link; 2], f64)>,
    Made { from, to, dt }: Made<'_>,
    (moves, next): (&State, &mut State),
    (most, least): (&[Vec<f64>; 3], f64),
    response: &mut LawResponse,
) -> f64 {
    let LinkMoves { law, link, .. } = one;
    let (r, h) = (link.range.clone(), link.history.clone());
    let [most_d, most_v, most_h] = most;
    let (d, v) = (next.d[r.clone()].to_vec(), next.v[r.clone()].to_vec());
    let (d0, v0) = (&moves.d[r.clone()], &moves.v[r.clone()]);
    let before = &moves.history[h.clone()];
    // As far as no part of it goes further than a small share of its own size.
    let rates = law.uses_rates();
    let mut most_share = 0.0_f64;
    let mut look = |moves: &[f64], most: &[f64]| {
        for (x, most) in moves.iter().zip(most).filter(|(x, _)| **x != 0.0) {
            most_share = most_share.max(x.abs() / most.max(f64::MIN_POSITIVE.sqrt()));
        }
    };
    look(&d, &most_d[r.clone()]);
    look(d0, &most_d[r.clone()]);
    if rates {
        look(&v, &most_v[r.clone()]);
        look(v0, &most_v[r.clone()]);
    }
    look(before, &most_h[h.clone()]);
    next.f[r.clone()].fill(0.0);
    next.history[h.clone()].fill(0.0);
    let plus = |x: &[f64], by: &[f64], s: f64| -> Vec<f64> {
        x.iter().zip(by).map(|(x, by)| if *by == 0.0 { *x } else { x + s * by }).collect()
    };
    let mut heat = 0.0;
    let mut ask = |law: &dyn Link, s: f64, weight: f64| {
        let d = plus(&to.d[r.clone()], &d, s);
        let v = plus(&to.v[r.clone()], &v, s);
        let d0 = plus(&from.d[r.clone()], d0, s);
        let v0 = plus(&from.v[r.clone()], v0, s);
        let history = plus(&from.history[h.clone()], before, s);
        let at = Kinematics::new([&d, &v], [&d0, &v0], dt);
        response.of((law, link), &at, &history);
        let f = next.f[r.clone()].iter_mut().zip(&response.f);
        f.for_each(|(to, x)| *to += weight * x);
        let trial = next.history[h.clone()].iter_mut().zip(&response.history);
        trial.for_each(|(to, x)| *to += weight * x);
        heat += weight * (response.energy.hysteretic + response.energy.viscous);
    };
    if most_share > 0.0 {
        let step = (ALONG / most_share).max(least);
        for (offset, weight) in super::OFFSETS.iter().zip(WEIGHTS) {
            ask(*law, offset * step, weight / step);
        }
    }
    if let Some(([low, high], apart)) = sides {
        ask(*low, 0.0, -1.0 / apart);
        ask(*high, 0.0, 1.0 / apart);
    }
    heat
}

//! What one analysis brings to a sweep: made by the ordinary assembly, basis and start.

use super::rule::stiffness_ratio;
use super::tables::{Grid, Table, Tables, split};
use crate::case::before;
use crate::contact_mode::contacts;
use crate::contact_role::{Role, Roles};
use crate::dynamic::held_load;
use crate::equations::{bases, link_side, modes};
use crate::error::SolveError;
use crate::modal::{LONGEST, Modal};
use crate::outputs::{Outputs, Row};
use crate::propagator::kinetic_and_strain;
use crate::single_mode::{self, Mode};
use crate::space::Space;
use crate::start::{Initial, constant_force, peak, potential, start};
use crate::stepper::{LinkStepper, State, Stepper};
use crate::timeline::Timeline;
use std::any::TypeId;
use std::sync::Arc;
use trilith_element::Contact;
use trilith_element::lanes::LaneForm;
use trilith_linalg::{Dense, Sparse, symmetric_eigen};
use trilith_model::{
    Analysis, DynamicCase, Kernel, Model, Quantity, Side, SolverKind, StepControl,
};
use trilith_system::{Channel, LoadSet, System, Track};

/// What must be equal for analyses to go side by side.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub modes: usize,
    pub links: Vec<(TypeId, Vec<usize>, usize)>,
    pub channels: Vec<(u8, bool)>,
    pub outputs: Vec<u8>,
    /// Indices of the links that a body may stand on.
    pub feet: Vec<usize>,
    pub grid: Grid,
}

/// One output over modal coordinates and lane coordinates.
#[derive(Clone, Debug)]
pub(super) enum Output {
    /// On displacements (0), velocities (1) or accelerations (2), and on the loads of each channel (base
    /// acceleration).
    Motion { order: usize, own: Vec<f64>, base: Vec<f64> },
    /// On displacements and velocities.
    Element { stiffness: Vec<f64>, damping: Vec<f64> },
    /// Deformation of a lane coordinate.
    Deformation { at: usize, factor: f64 },
    /// Force of a lane coordinate.
    Force { at: usize, factor: f64 },
    /// History.
    History { at: usize },
    /// Of a coordinate that nothing deforms.
    Zero,
}

impl Output {
    fn kind(&self) -> u8 {
        match self {
            Self::Motion { order, .. } => *order as u8,
            Self::Element { .. } => 3,
            Self::Deformation { at, .. } => 10 + 4 * *at as u8,
            Self::Force { at, .. } => 11 + 4 * *at as u8,
            Self::History { at } => 12 + 4 * *at as u8,
            Self::Zero => 4,
        }
    }
}

/// A piece of an output step, as a step starts on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub start: f64,
    pub end: f64,
    pub length: f64,
    /// A load jumps at its start.
    pub jump: bool,
}

/// One analysis, ready to go in a lane.
#[derive(Debug)]
pub struct LaneSetup {
    pub(super) shape: Shape,
    /// Coefficients of the usual step.
    pub rule: Vec<Mode>,
    pub(super) omega2: Vec<f64>,
    pub(super) damping: Vec<f64>,
    /// B of the lane coordinates over the modes.
    pub(super) rows: Vec<Vec<f64>>,
    pub(super) rotational: Vec<bool>,
    pub(super) forms: Vec<LaneForm>,
    /// Index of the element of each link.
    pub(super) elements: Vec<usize>,
    /// Load of each channel over the modes.
    pub(super) forces: Vec<Vec<f64>>,
    /// Track of each channel, of unit amplitude where it varies, and its amplitude.
    pub(super) tracks: Vec<(Track, f64)>,
    pub(super) conservative: Vec<bool>,
    /// Table and amplitude of each channel that varies.
    pub(super) tables: Vec<Option<(Arc<Table>, f64)>>,
    /// Steps of output steps that are not steps of the grid.
    pub(super) cut: Vec<(usize, Vec<Piece>)>,
    pub(super) outputs: Vec<Output>,
    pub(super) q: Vec<f64>,
    pub(super) p: Vec<f64>,
    pub(super) a: Vec<f64>,
    pub(super) d: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) f: Vec<f64>,
    pub(super) history: Vec<f64>,
    pub(super) stored: Vec<f64>,
    pub(super) scale: [f64; 2],
    pub(super) kinetic: f64,
    pub(super) strain: f64,
    pub(super) potential: f64,
    pub(super) contacts: Vec<Contact>,
    /// True where something stands on them, or falls onto them.
    pub(super) stands: bool,
    pub(super) values: Vec<f64>,
    pub(super) rates: Vec<f64>,
    /// Largest share of the energy that may be unaccounted for.
    pub energy_limit: f64,
    pub(super) tolerance: f64,
}

impl LaneSetup {
    /// True where both can go side by side.
    #[must_use]
    pub fn fits(&self, other: &Self) -> bool {
        self.shape == other.shape
    }
}

/// Longest ω Δt of a mode: a quarter of its period, in which a cubic misses its crest by a hundredth.
const FASTEST: f64 = std::f64::consts::FRAC_PI_2;

/// Modes, link coordinates and coordinates of one link at most.
pub(super) const MOST: (usize, usize, usize) = (12, 12, 3);

/// Prepares a case for a lane, with so many fixed substeps an output step; `Err` with the reason where it
/// does not fit.
///
/// # Errors
/// [`SolveError`] where the case cannot be run at all.
pub fn prepare(
    model: &Model,
    system: &System,
    case: usize,
    substeps: usize,
    tables: &Tables,
) -> Result<Result<LaneSetup, String>, SolveError> {
    let Analysis::Dynamic(analysis) = &model.cases[case].analysis else {
        return Ok(Err("a static case".into()));
    };
    if model.outputs.iter().any(|o| matches!(o.quantity, Quantity::Combination { .. })) {
        return Ok(Err("an output put together from others".into()));
    }
    if let Some(reason) = unsuited(system, analysis) {
        return Ok(Err(reason.into()));
    }
    let case = &model.cases[case];
    let before = before(model, system, case, None, None)?;
    let constant = held_load(model, system, analysis, before.as_ref());
    let loads = system.dynamic_loads(model, analysis, constant);
    let initial = Initial::new(model, system, analysis, before.as_ref())?;
    let judged = analysis.solution.basis.tolerance < 1.0 && !model.outputs.is_empty();
    let Some(bases) = bases(model, system, analysis, SolverKind::Fna, &loads, &initial, judged)?
    else {
        return Ok(Err("no basis".into()));
    };
    if bases.wider.is_some() {
        return Ok(Err(
            "a basis that leaves something out, so that its error must be watched".into()
        ));
    }
    let modes = modes(model, system, &loads, &bases);
    let order = modes.space.order();
    let side = link_side(model, system, &analysis.solution, &loads, order, true);
    let mut stepper = LinkStepper::new(Modal::new(modes), side)?;
    let dt = analysis.dt;
    let times = [dt, analysis.duration];
    let (state, _, _, _) = start(model, system, &initial, &loads, &mut stepper, times)?;
    let space = stepper.space();

    let m = space.order();
    let links = &system.links;
    if space.readers.columns() > 0 {
        return Ok(Err("places without mass".into()));
    }
    let omega2 = space.stiffness.diagonal();
    let Some((own, turn)) = uncoupled(&omega2, &space.damping)? else {
        return Ok(Err("damping that couples modes".into()));
    };
    let mut active = vec![false; links.len()];
    links.active.iter().for_each(|i| active[*i] = true);
    let (mut forms, mut flat) = (Vec::new(), Vec::new());
    for link in &links.links {
        let own = &active[link.range.clone()];
        let form = links.law(model, link).and_then(|law| law.lanes(own));
        let is_whole = |form: &LaneForm| {
            let holds = |i: usize| !own[i] || form.coordinates.contains(&i);
            (0..own.len()).all(holds) && form.law.history == link.history.len()
        };
        let Some(form) = form.filter(is_whole) else {
            let name = &model.elements[link.element].name;
            return Ok(Err(format!("link \"{name}\" has no form for lanes")));
        };
        flat.extend(form.coordinates.iter().map(|i| link.range.start + i));
        forms.push(form);
    }
    let widest = forms.iter().map(|f| f.law.coordinates).max().unwrap_or(1);
    if m > MOST.0 || forms.len() * widest > MOST.1 || widest > MOST.2 {
        return Ok(Err("too many modes or link coordinates".into()));
    }
    let mut rows = vec![vec![0.0; m]; flat.len()];
    for (row, i) in rows.iter_mut().zip(&flat) {
        let Some(a) = links.active.iter().position(|x| x == i) else { continue };
        space.links.row(a).for_each(|(j, c)| row[j] += c);
        *row = turned(&turn, row);
    }
    let timeline = Timeline::new(dt, analysis.duration, &loads, substeps);
    let parts = common_parts(&timeline);
    let grid = Grid { dt, steps: timeline.steps, substeps: substeps * parts };
    let step = dt / grid.substeps as f64;
    let rule: Vec<Mode> =
        omega2.iter().zip(&own).map(|(w, c)| single_mode::exact(*w, *c, step)).collect();
    // Extremes between steps are those of cubics.
    if omega2.iter().any(|w| w.max(0.0).sqrt() * step > FASTEST) {
        return Ok(Err("modes too fast for the steps".into()));
    }
    let engaged = links.engaged(model);
    let engaged: Vec<f64> = flat.iter().map(|i| engaged[*i]).collect();
    if stiffness_ratio(&rows, &rule, &engaged) > LONGEST {
        return Ok(Err("steps too long for the exact rule at the stiffest link".into()));
    }
    let first = usize::from(loads.channels.iter().any(|c| matches!(c.track, Track::Constant)));
    let base: Vec<usize> = analysis.base.iter().map(|b| b.direction.index()).collect();
    let outputs = outputs(model, system, space, &flat, (loads.channels.len(), first, &base), &turn);
    let (mut values, mut rates) = (vec![0.0; outputs.len()], vec![0.0; outputs.len()]);
    let all = Outputs::new(model, system, space);
    let now = all.at((0.0, Side::After), &state, &loads);
    now.values(&mut values);
    now.rates(&values, &mut rates);
    let (kinetic, strain) = kinetic_and_strain(space, &state.motion);
    let pick = |of: &[f64]| flat.iter().map(|i| of[*i]).collect::<Vec<f64>>();
    let roles = Roles::new(model, system);
    let seen = contacts(model, system, &state);
    let stands = roles.stand(&seen);
    let mine = roles.each(&seen, true);
    // What is no foot has no part in the response mode.
    let standing: Vec<(usize, Contact)> =
        seen.into_iter().zip(mine).filter(|(_, r)| *r == Role::Foot).map(|(c, _)| c).collect();
    let is_foot = |i: &usize| {
        let element = links.links[*i].element;
        forms[*i].law.is_contact && standing.iter().any(|(own, _)| *own == element)
    };
    let feet: Vec<usize> = (0..forms.len()).filter(is_foot).collect();
    if feet.len() != standing.len() {
        return Ok(Err("a body on contacts that have no form for lanes".into()));
    }
    let State { motion, d, v, f, history, stored, scale, .. } = &state;
    let shape = Shape {
        modes: m,
        links: forms.iter().map(|f| (f.law.id, f.coordinates.clone(), f.law.coordinates)).collect(),
        channels: loads.channels.iter().map(|c| (kind(&c.track), c.conservative)).collect(),
        outputs: outputs.iter().map(Output::kind).collect(),
        feet,
        grid,
    };
    Ok(Ok(LaneSetup {
        shape,
        rule,
        damping: own,
        rows,
        rotational: flat.iter().map(|i| links.rotational[*i]).collect(),
        forms,
        elements: links.links.iter().map(|l| l.element).collect(),
        forces: (0..space.forces.columns())
            .map(|j| turned(&turn, space.forces.column(j)))
            .collect(),
        tracks: loads.channels.iter().map(|c| split(&c.track)).collect(),
        conservative: loads.channels.iter().map(|c| c.conservative).collect(),
        tables: loads
            .channels
            .iter()
            .map(|c| match c.track {
                Track::Constant => None,
                _ => Some(tables.of(&c.track, grid)),
            })
            .collect(),
        cut: cuts(&timeline, &loads, substeps, parts),
        outputs,
        q: turned(&turn, &motion[..m]),
        p: turned(&turn, &motion[m..2 * m]),
        a: turned(&turn, &motion[2 * m..]),
        d: pick(d),
        v: pick(v),
        f: pick(f),
        history: history.clone(),
        stored: stored.clone(),
        scale: *scale,
        kinetic,
        strain,
        potential: potential(&constant_force(space, &loads), &state),
        stands,
        contacts: standing.into_iter().map(|(_, c)| c).collect(),
        values,
        rates,
        energy_limit: analysis.solution.energy_limit,
        tolerance: analysis.solution.link_tolerance,
        omega2,
    }))
}

/// Damping between modes that counts as none, as share of the largest.
const COUPLES: f64 = 1e-10;
/// Squares of frequencies that differ by less than this share are one.
const EQUAL: f64 = 1e-9;

/// Damping of every mode, and the turn of the modes that makes it so: modes of one frequency (such as
/// those of a body that nothing but links holds) may be any combination of each other. None where damping couples
/// modes of different frequencies.
fn uncoupled(omega2: &[f64], damping: &Sparse) -> Result<Option<(Vec<f64>, Dense)>, SolveError> {
    let m = omega2.len();
    let mut c = Dense::zeros(m, m);
    for (i, j, x) in damping.entries() {
        c[(i, j)] += x;
    }
    let mut turn = Dense::zeros(m, m);
    let mut first = 0;
    while first < m {
        let near = |j: &usize| (omega2[*j] - omega2[first]).abs() <= EQUAL * omega2[*j].abs();
        let n = (first..m).take_while(near).count().max(1);
        let mut part = Dense::zeros(n, n);
        for i in 0..n {
            for j in 0..n {
                part[(i, j)] = 0.5 * (c[(first + i, first + j)] + c[(first + j, first + i)]);
            }
        }
        let vectors =
            if n == 1 { Dense::from_columns(1, 1, vec![1.0]) } else { symmetric_eigen(&part)?.1 };
        for i in 0..n {
            for j in 0..n {
                turn[(first + i, first + j)] = vectors[(i, j)];
            }
        }
        first += n;
    }
    let c = turn.transpose_times(&c.times(&turn));
    let largest = (0..m).fold(0.0f64, |a, i| a.max(c[(i, i)].abs()));
    let small = |x: f64| x.abs() <= COUPLES * largest;
    let couples = (0..m).any(|i| (0..m).any(|j| i != j && !small(c[(i, j)])));
    let own = (0..m).map(|i| if small(c[(i, i)]) { 0.0 } else { c[(i, i)] }).collect();
    Ok((!couples).then_some((own, turn)))
}

/// Tᵀ x.
fn turned(turn: &Dense, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; x.len()];
    turn.transpose_mul_add(1.0, x, &mut y);
    y
}

fn kind(track: &Track) -> u8 {
    match track {
        Track::Constant => 0,
        Track::Value { .. } => 1,
        Track::Rate { .. } => 2,
        Track::Curvature { .. } => 3,
    }
}

/// Why a case does not fit, as far as its settings tell.
fn unsuited(system: &System, analysis: &DynamicCase) -> Option<&'static str> {
    let solution = &analysis.solution;
    if solution.solver != SolverKind::Fna {
        return Some("another solver than fna");
    }
    if solution.kernel != Kernel::Newton {
        return Some("another iteration than Newton's");
    }
    if !analysis.supports.is_empty() {
        return Some("supports that move");
    }
    if system.links.effective.iter().any(|k| *k != 0.0) {
        return Some("effective stiffnesses of links");
    }
    if system.links.links.is_empty() {
        return Some("a model without links");
    }
    None
}

/// Substeps of the case's own fixed steps.
#[must_use]
pub fn fixed_substeps(analysis: &DynamicCase) -> Option<usize> {
    match analysis.solution.step {
        StepControl::Fixed { substeps } => Some(substeps),
        StepControl::Adaptive { .. } => None,
    }
}

/// Parts of an output step are not made shorter than this for the sake of all of them.
const MOST_PARTS: usize = 64;
/// The grid follows what cuts one output step in so many.
const USUAL: usize = 16;
/// A change of a load below this share of its peak is no jump.
const JUMPS: f64 = 1e-9;

/// The equal parts of an output step that hold its pieces, unless they would be too many.
fn parts(timeline: &Timeline, step: usize) -> Option<usize> {
    let shares: Vec<f64> = timeline.pieces(step).map(|p| p.length / timeline.dt).collect();
    if (shares.iter().sum::<f64>() - 1.0).abs() > 1e-9 {
        return None;
    }
    let whole = |x: f64| (x - x.round()).abs() < 1e-9 * x;
    (1..=MOST_PARTS).find(|n| shares.iter().all(|x| whole(x * *n as f64)))
}

/// Equal parts of every output step, such that few are cut otherwise: 1, unless loads cut many.
fn common_parts(timeline: &Timeline) -> usize {
    let mut found = [0_usize; MOST_PARTS + 1];
    for step in timeline.cut_steps() {
        parts(timeline, step).into_iter().for_each(|n| found[n] += 1);
    }
    let usual = |n: &usize| found[*n] * USUAL >= timeline.steps;
    let common = |a: usize, b: usize| a / divisor(a, b) * b;
    let all = (2..=MOST_PARTS).filter(usual).fold(1, common);
    if all <= MOST_PARTS { all } else { 1 }
}

/// The greatest common divisor.
fn divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { divisor(b, a % b) }
}

/// The output steps that are not so many whole parts, or between which a load jumps, with their steps.
fn cuts(
    timeline: &Timeline,
    loads: &LoadSet,
    substeps: usize,
    common: usize,
) -> Vec<(usize, Vec<Piece>)> {
    let jumps = |t: f64| {
        let jump = |c: &Channel| {
            let change = c.track.at(t, Side::After) - c.track.at(t, Side::Before);
            change.abs() > JUMPS * peak(&c.track)
        };
        t > 0.0 && timeline.is_jump(t) && loads.channels.iter().any(jump)
    };
    let steps = timeline.cut_steps();
    let of_step = |step: usize| -> Vec<Piece> {
        let pieces = timeline.pieces(step).flat_map(|piece| {
            let jump = jumps(piece.start);
            let parts = piece.parts(substeps).enumerate();
            parts.map(move |(i, p)| Piece {
                start: p.start,
                end: p.end,
                length: p.length,
                jump: jump && i == 0,
            })
        });
        pieces.collect()
    };
    let is_cut = |step: usize| {
        let (start, end) = (timeline.time(step), timeline.time(step + 1));
        let as_usual = parts(timeline, step).is_some_and(|n| common.is_multiple_of(n));
        !as_usual || jumps(start) || jumps(end)
    };
    steps.into_iter().filter(|step| is_cut(*step)).map(|step| (step, of_step(step))).collect()
}

/// The outputs; `channels` are their number, the first that is base motion, and the directions of those.
fn outputs(
    model: &Model,
    system: &System,
    space: &Space,
    flat: &[usize],
    (channels, first, directions): (usize, usize, &[usize]),
    turn: &Dense,
) -> Vec<Output> {
    let m = space.order();
    let dense = |row: &[(usize, f64)]| {
        let mut full = vec![0.0; m];
        row.iter().for_each(|(j, c)| full[*j] += c);
        turned(turn, &full)
    };
    let at = |i: usize| flat.iter().position(|x| *x == i);
    let rows = Outputs::new(model, system, space).rows;
    rows.iter()
        .zip(&model.outputs)
        .map(|(row, output)| match row {
            Row::Nodal { order, own, base, .. } => {
                let moves =
                    matches!(&output.quantity, Quantity::Acceleration { absolute: true, .. });
                let mut share = vec![0.0; if moves { channels } else { 0 }];
                for (i, direction) in directions.iter().enumerate().filter(|_| moves) {
                    share[first + i] = base[*direction];
                }
                let base = share;
                Output::Motion { order: *order, own: dense(own), base }
            }
            Row::Deformation { flat, factor } => {
                at(*flat).map_or(Output::Zero, |at| Output::Deformation { at, factor: *factor })
            }
            Row::Force { flat, factor } => {
                at(*flat).map_or(Output::Zero, |at| Output::Force { at, factor: *factor })
            }
            Row::History { at } => Output::History { at: *at },
            // `prepare` sends such models to the ordinary engine.
            Row::Combination { .. } => Output::Zero,
            Row::Element { stiffness, damping } => {
                Output::Element { stiffness: dense(&stiffness.0), damping: dense(&damping.0) }
            }
        })
        .collect()
}

//! What one analysis brings to a sweep: made by the ordinary assembly, basis and start.

use super::form::{Extent, Form, Law, forms};
use super::grid::{Grid, Piece, common_parts, cuts};
use super::rules::stiffness_ratio;
use super::tables::{Table, Tables, split};
use super::uncoupled::{turned, uncoupled};
use super::watch::Watch;
use crate::contacts::{Role, Roles, contacts};
use crate::error::SolveError;
use crate::fna::{LONGEST, Modal};
use crate::march::{StepControlState, Timeline, constant_force, potential};
use crate::modal::Mode;
use crate::modal::single_mode::{self};
use crate::record::{Internal, Outputs, Row};
use crate::run::{Initial, bases, before, fna_modes, held_load, link_equations, start};
use crate::step::{LinkStepper, State, Stepper, kinetic_and_strain};
use crate::structure::ReducedSystem;
use std::any::TypeId;
use std::sync::Arc;
use trilith_element::Contact;
use trilith_linalg::Dense;
use trilith_model::{
    Analysis, Combine, DynamicCase, Kernel, Model, Quantity, Side, SolverKind, StepControl,
};
use trilith_system::{System, Track};

/// What must be equal for analyses to go side by side.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub modes: usize,
    pub links: Vec<(TypeId, Vec<usize>, Extent)>,
    pub channels: Vec<(u8, bool)>,
    pub outputs: Vec<(u8, Vec<usize>)>,
    /// Outputs that are taken over time: how long above a value, or as mean square.
    pub integrals: Vec<(usize, Option<f64>)>,
    /// Indices of the contacts that a body may stand on.
    pub feet: Vec<usize>,
    pub grid: Grid,
    pub is_adaptive: bool,
}

/// One output over modal coordinates and lane coordinates.
#[derive(Clone, Debug)]
pub(super) enum Output {
    /// On displacements (0), velocities (1) or accelerations (2), and on the loads of each channel (base
    /// acceleration).
    Motion { order: usize, own: Vec<f64>, base: Vec<f64> },
    /// On displacements and velocities, and Σ on forces of lane coordinates.
    Internal { stiffness: Vec<f64>, damping: Vec<f64>, links: Vec<(usize, f64)> },
    /// Deformation of a lane coordinate.
    Deformation { at: usize, factor: f64 },
    /// Σ on forces of lane coordinates.
    Force { terms: Vec<(usize, f64)> },
    /// History.
    History { at: usize },
    /// Of a coordinate that nothing deforms.
    Zero,
    /// Of outputs before, each times its factor.
    Combination { how: Combine, constant: f64, terms: Vec<(usize, f64)> },
}

impl Output {
    /// What it is, and of what.
    fn kind(&self) -> (u8, Vec<usize>) {
        match self {
            Self::Motion { order, .. } => (0, vec![*order]),
            Self::Internal { links, .. } => (1, links.iter().map(|t| t.0).collect()),
            Self::Deformation { at, .. } => (2, vec![*at]),
            Self::Force { terms } => (3, terms.iter().map(|t| t.0).collect()),
            Self::History { at } => (4, vec![*at]),
            Self::Zero => (5, Vec::new()),
            Self::Combination { how, terms, .. } => {
                (6 + *how as u8, terms.iter().map(|t| t.0).collect())
            }
        }
    }
}

/// How the control of the steps starts.
#[derive(Clone, Debug)]
pub(super) struct Adaptive {
    pub tolerance: f64,
    pub control: StepControlState,
    /// Substeps that may be tried.
    pub budget: usize,
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
    pub(super) forms: Vec<Form>,
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
    /// Stiffness of each coordinate, and the largest so far.
    pub(super) stiffness: Vec<f64>,
    pub(super) stiffest: Vec<f64>,
    /// Stiffness where the links are engaged.
    pub(super) engaged: Vec<f64>,
    pub(super) history: Vec<f64>,
    pub(super) stored: Vec<f64>,
    pub(super) scale: [f64; 2],
    pub(super) kinetic: f64,
    pub(super) strain: f64,
    pub(super) potential: f64,
    pub(super) watch: Watch,
    pub(super) contacts: Vec<Contact>,
    /// True where something stands on them, or falls onto them.
    pub(super) stands: bool,
    pub(super) values: Vec<f64>,
    pub(super) rates: Vec<f64>,
    /// Where steps are adaptive.
    pub(super) adaptive: Option<Adaptive>,
    /// Largest share of the energy that may be unaccounted for.
    pub energy_limit: f64,
    pub(super) tolerance: f64,
}

impl LaneSetup {
    /// Coefficients of a step of this length, s.
    pub(super) fn modes_of(&self, length: f64) -> Vec<Mode> {
        modes_of(&self.omega2, &self.damping, length)
    }

    /// Largest eigenvalue of G k of the engaged links in a step of which this are the modes.
    pub(super) fn stiffness_ratio(&self, modes: &[Mode]) -> f64 {
        stiffness_ratio(&self.rows, modes, &self.engaged)
    }

    /// Outputs, by their index in the model, of which the time above a value is wanted, or, where there is none, the
    /// root of the mean square.
    #[must_use]
    pub fn take_over_time(mut self, outputs: &[(usize, Option<f64>)]) -> Self {
        self.shape.integrals = outputs.to_vec();
        self
    }

    /// True where a law is not written over lanes: each link answers for itself.
    #[must_use]
    pub fn asks_links(&self) -> bool {
        self.forms.iter().any(|form| matches!(form.law, Law::One(_)))
    }

    /// True where both can go side by side.
    #[must_use]
    pub fn fits(&self, other: &Self) -> bool {
        self.shape == other.shape
    }
}

/// Longest ω Δt of a mode: a quarter of its period, in which a cubic misses its crest by a hundredth. Halves of such
/// steps show how it swings.
const FASTEST: f64 = std::f64::consts::FRAC_PI_2;

/// An output step is cut in so many halves at most where steps are adaptive and longer ones are too long for modes.
const HALVINGS: usize = 4;

/// Modes, and link coordinates, at most.
pub(super) const ROOM: usize = 24;
/// Coordinates of one link at most, where there are others.
const WIDEST: usize = 3;
/// Modes and coordinates of a body in space, which is the only link then.
const BODY: usize = 6;

/// Prepares a case for a lane, with these steps; `Err` with the reason where it does not fit.
///
/// # Errors
/// [`SolveError`] where the case cannot be run at all.
pub fn prepare(
    model: &Model,
    system: &System,
    case: usize,
    control: StepControl,
    tables: &Tables,
) -> Result<Result<LaneSetup, String>, SolveError> {
    let Analysis::Dynamic(analysis) = &model.cases[case].analysis else {
        return Ok(Err("a static case".into()));
    };
    if let Some(reason) = unsuited(system, analysis) {
        return Ok(Err(reason.into()));
    }
    if let Some(o) = model.outputs.iter().find(|o| matches!(o.quantity, Quantity::Derived(_))) {
        return Ok(Err(format!("output \"{}\" has no form for lanes", o.name)));
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
    let modes = fna_modes(model, system, &loads, &bases);
    let order = modes.space.order();
    let side = link_equations(model, system, &analysis.solution, &loads, order, true);
    let mut stepper = LinkStepper::new(Modal::new(modes), side)?;
    let dt = analysis.dt;
    let times = [dt, analysis.duration];
    let (state, step_control, _, _) = start(model, system, &initial, &loads, &mut stepper, times)?;
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
    let seen = contacts(model, system, &state);
    let all = Outputs::new(model, system, space);
    let (forms, flat) = match forms(model, system, &seen, &all.rows) {
        Ok(forms) => forms,
        Err(reason) => return Ok(Err(reason)),
    };
    let widest = forms.iter().map(|f| f.extent.coordinates).max().unwrap_or(1);
    let is_body = widest > WIDEST && widest <= BODY && m <= BODY && forms.len() == 1;
    if !is_body && (m > ROOM || forms.len() * widest > ROOM || widest > WIDEST) {
        return Ok(Err("too many modes or link coordinates".into()));
    }
    let is_fixed = matches!(control, StepControl::Fixed { .. });
    if is_fixed && forms.iter().any(|f| f.extent.falls) {
        return Ok(Err("fixed steps of a body that may overturn".into()));
    }
    if is_fixed && is_body {
        return Ok(Err("fixed steps of a link with more than three coordinates".into()));
    }
    let mut rows = vec![vec![0.0; m]; flat.len()];
    for (row, i) in rows.iter_mut().zip(&flat) {
        let Some(a) = links.active.iter().position(|x| x == i) else { continue };
        space.links.row(a).for_each(|(j, c)| row[j] += c);
        *row = turned(&turn, row);
    }
    let engaged = links.engaged(model);
    let engaged: Vec<f64> = flat.iter().map(|i| engaged[*i]).collect();
    let too_long = |step: f64| -> Option<&'static str> {
        if omega2.iter().any(|w| w.max(0.0).sqrt() * step > FASTEST) {
            return Some("modes too fast for the steps");
        }
        // With adaptive steps average acceleration stands in for it.
        let rule = modes_of(&omega2, &own, step);
        let beyond = is_fixed && stiffness_ratio(&rows, &rule, &engaged) > LONGEST;
        beyond.then_some("steps too long for the exact rule at the stiffest link")
    };
    let (mut substeps, halvings) = match control {
        StepControl::Fixed { substeps } => (substeps, 0),
        StepControl::Adaptive { .. } => (1, HALVINGS),
    };
    for _ in 0..halvings {
        if too_long(dt / substeps as f64).is_some() {
            substeps *= 2;
        }
    }
    let timeline = Timeline::new(dt, analysis.duration, &loads, substeps);
    let parts = common_parts(&timeline);
    let grid = Grid { dt, steps: timeline.steps, substeps: substeps * parts };
    let longest = if halvings == 0 { grid.step() } else { dt / substeps as f64 };
    if let Some(reason) = too_long(longest) {
        return Ok(Err(reason.into()));
    }
    let rule = modes_of(&omega2, &own, grid.step());
    let first = usize::from(loads.channels.iter().any(|c| matches!(c.track, Track::Constant)));
    let base: Vec<usize> = analysis.base.iter().map(|b| b.direction.index()).collect();
    let channels = (loads.channels.len(), first, &base[..]);
    let outputs = outputs(model, space, (&all.rows, &flat), channels, &turn);
    let (mut values, mut rates) = (vec![0.0; outputs.len()], vec![0.0; outputs.len()]);
    if all.is_loaded() {
        return Ok(Err("outputs that loads along members have a share in".into()));
    }
    let now = all.at((0.0, Side::After), &state, &loads);
    now.values(&mut values);
    now.rates(&values, &mut rates);
    let (kinetic, strain) = kinetic_and_strain(space, &state.motion);
    let pick = |of: &[f64]| flat.iter().map(|i| of[*i]).collect::<Vec<f64>>();
    let roles = Roles::new(model, system);
    let stands = roles.stand(&seen);
    let mine = roles.each(&seen, true);
    // What is no foot has no part in the response mode.
    let (mut feet, mut standing) = (Vec::new(), Vec::new());
    for (at, (element, contact)) in seen.iter().enumerate() {
        if mine[at] != Role::Foot {
            continue;
        }
        let before = seen[..at].iter().filter(|(own, _)| own == element).count();
        let Some(link) = links.links.iter().position(|l| l.element == *element) else { continue };
        if before >= forms[link].extent.contacts {
            return Ok(Err("a body on contacts that have no form for lanes".into()));
        }
        let first: usize = forms[..link].iter().map(|f| f.extent.contacts).sum();
        feet.push(first + before);
        standing.push(*contact);
    }
    let State { motion, d, v, f, history, stored, scale, tangents, stiffest, .. } = &state;
    let of_active = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let place = |i: &usize| links.active.iter().position(|x| x == i);
        flat.iter().map(|i| place(i).map_or(0.0, of)).collect()
    };
    let is_adaptive = matches!(control, StepControl::Adaptive { .. });
    let shape = Shape {
        modes: m,
        links: forms.iter().map(|f| (f.id(), f.coordinates.clone(), f.extent)).collect(),
        channels: loads.channels.iter().map(|c| (kind(&c.track), c.conservative)).collect(),
        outputs: outputs.iter().map(Output::kind).collect(),
        integrals: Vec::new(),
        feet,
        grid,
        is_adaptive,
    };
    let adaptive = match control {
        StepControl::Fixed { .. } => None,
        StepControl::Adaptive { tolerance } => {
            let budget = analysis.solution.substep_limit(timeline.steps);
            Some(Adaptive { tolerance, control: step_control, budget })
        }
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
                _ => Some(tables.of(&c.track, grid, is_adaptive)),
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
        stiffness: of_active(&|a| tangents.k[links.diagonal[a]]),
        stiffest: of_active(&|a| stiffest[a]),
        engaged,
        history: history.clone(),
        stored: stored.clone(),
        scale: *scale,
        kinetic,
        strain,
        potential: potential(&constant_force(space, &loads), &state),
        watch: Watch::new(model, system, space, &turn),
        stands,
        contacts: standing,
        values,
        rates,
        adaptive,
        energy_limit: analysis.solution.energy_limit,
        tolerance: analysis.solution.link_tolerance,
        omega2,
    }))
}

fn modes_of(omega2: &[f64], damping: &[f64], step: f64) -> Vec<Mode> {
    omega2.iter().zip(damping).map(|(w, c)| single_mode::exact(*w, *c, step)).collect()
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

/// The outputs; `channels` are their number, the first that is base motion, and the directions of those.
fn outputs(
    model: &Model,
    space: &ReducedSystem,
    (rows, flat): (&[Row], &[usize]),
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
    let of_lanes = |terms: &[(usize, f64)]| -> Vec<(usize, f64)> {
        terms.iter().filter_map(|(flat, factor)| Some((at(*flat)?, *factor))).collect()
    };
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
            Row::Force { terms } => match of_lanes(terms) {
                none if none.is_empty() => Output::Zero,
                terms => Output::Force { terms },
            },
            Row::History { at } => Output::History { at: *at },
            Row::Combination { how, constant, terms } => {
                Output::Combination { how: *how, constant: *constant, terms: terms.clone() }
            }
            // A model with one runs alone, and so does one where loads have a share.
            Row::Derived { .. } => Output::Zero,
            Row::Internal(Internal { stiffness, damping, links, .. }) => Output::Internal {
                stiffness: dense(&stiffness.0),
                damping: dense(&damping.0),
                links: of_lanes(links),
            },
        })
        .collect()
}

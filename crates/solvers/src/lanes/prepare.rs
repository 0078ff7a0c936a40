//! How an analysis is made ready for a lane: by the ordinary assembly, basis and start.
//!
//! ```text
//! settings -> reduced structure at rest -> modes without coupling -> links -> steps -> outputs, feet
//! ```
//!
//! Every phase may find that the case does not fit, and says why.

use super::form::{Form, forms};
use super::grid::{Grid, common_parts, cuts};
use super::rules::stiffness_ratio;
use super::setup::{Adaptive, BODY, LaneSetup, Output, ROOM, Shape, WIDEST, modes_of};
use super::tables::{Tables, split};
use super::uncoupled::{turned, uncoupled};
use super::watch::Watch;
use crate::contacts::{Role, Roles, contacts};
use crate::error::SolveError;
use crate::fna::{LONGEST, Modal, Modes};
use crate::march::{Timeline, constant_force, potential};
use crate::record::{Internal, Outputs, Row};
use crate::run::{Initial, bases, before, fna_modes, held_load, link_equations, start};
use crate::step::{LinkStepper, Stepper, kinetic_and_strain};
use crate::structure::ReducedSystem;
use trilith_element::Contact;
use trilith_linalg::Dense;
use trilith_model::{
    Analysis, DynamicCase, Kernel, Model, Quantity, Side, SolverKind, StepControl,
};
use trilith_system::{Channel, LinkInstance, LoadSet, System, Track};

/// Longest ω Δt of a mode: a quarter of its period, in which a cubic misses its crest by a hundredth. Halves of such
/// steps show how it swings.
const FASTEST: f64 = std::f64::consts::FRAC_PI_2;

/// An output step is cut in so many halves at most where steps are adaptive and longer ones are too long for modes.
const HALVINGS: usize = 4;

/// Why there is no setup.
enum Unfit {
    /// The case does not fit a lane.
    Reason(String),
    /// It cannot be run at all.
    Failed(SolveError),
}

impl From<&str> for Unfit {
    fn from(reason: &str) -> Self {
        Self::Reason(reason.into())
    }
}

impl From<SolveError> for Unfit {
    fn from(error: SolveError) -> Self {
        Self::Failed(error)
    }
}

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
    match setup(model, system, case, control, tables) {
        Ok(setup) => Ok(Ok(setup)),
        Err(Unfit::Reason(reason)) => Ok(Err(reason)),
        Err(Unfit::Failed(error)) => Err(error),
    }
}

/// The phases, one after the other.
fn setup(
    model: &Model,
    system: &System,
    case: usize,
    control: StepControl,
    tables: &Tables,
) -> Result<LaneSetup, Unfit> {
    let analysis = suited(model, system, case)?;
    let before = before(model, system, &model.cases[case], None, None)?;
    let constant = held_load(model, system, analysis, before.as_ref());
    let loads = system.dynamic_loads(model, analysis, constant);
    let initial = Initial::new(model, system, analysis, before.as_ref())?;
    let modes = reduced(model, system, analysis, &loads, &initial)?;
    let side = link_equations(model, system, &analysis.solution, &loads, modes.space.order(), true);
    let mut stepper = LinkStepper::new(Modal::new(modes), side)?;
    let times = [analysis.dt, analysis.duration];
    let (state, step_control, _, _) = start(model, system, &initial, &loads, &mut stepper, times)?;
    let space = stepper.space();

    let own = OwnModes::new(space)?;
    let seen = contacts(model, system, &state);
    let all = Outputs::new(model, system, space);
    let is_fixed = matches!(control, StepControl::Fixed { .. });
    let links = OwnLinks::new(model, system, &seen, &all.rows, (space, &own, is_fixed))?;
    let steps = Steps::new(analysis, control, &loads, (&own, &links))?;
    let outputs = outputs(model, analysis, (&all, &links.flat), &loads, &own)?;
    let now = all.at((0.0, Side::After), &state, &loads);
    let (mut values, mut rates) = (vec![0.0; outputs.len()], vec![0.0; outputs.len()]);
    now.values(&mut values);
    now.rates(&values, &mut rates);
    let roles = Roles::new(model, system);
    let (feet, standing) = feet(system, &seen, &roles.each(&seen, true), &links.forms)?;

    let m = space.order();
    let grid = steps.grid;
    let rule = modes_of(&own.omega2, &own.damping, grid.step());
    let (kinetic, strain) = kinetic_and_strain(space, &state.motion);
    let flat = &links.flat;
    let pick = |of: &[f64]| flat.iter().map(|i| of[*i]).collect::<Vec<f64>>();
    let of_active = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let place = |i: &usize| system.links.active.iter().position(|x| x == i);
        flat.iter().map(|i| place(i).map_or(0.0, of)).collect()
    };
    let adaptive = match control {
        StepControl::Fixed { .. } => None,
        StepControl::Adaptive { tolerance } => {
            let budget = analysis.solution.substep_limit(steps.timeline.steps);
            Some(Adaptive { tolerance, control: step_control, budget })
        }
    };
    let shape = Shape {
        modes: m,
        links: links.forms.iter().map(|f| (f.id(), f.coordinates.clone(), f.extent)).collect(),
        channels: loads.channels.iter().map(|c| (kind(&c.track), c.conservative)).collect(),
        outputs: outputs.iter().map(Output::kind).collect(),
        integrals: Vec::new(),
        feet,
        grid,
        is_adaptive: !is_fixed,
    };
    let table = |c: &Channel| match c.track {
        Track::Constant => None,
        _ => Some(tables.of(&c.track, grid, !is_fixed)),
    };
    let turned = |x: &[f64]| turned(&own.turn, x);
    Ok(LaneSetup {
        shape,
        rule,
        forces: (0..space.forces.columns()).map(|j| turned(space.forces.column(j))).collect(),
        tracks: loads.channels.iter().map(|c| split(&c.track)).collect(),
        conservative: loads.channels.iter().map(|c| c.conservative).collect(),
        tables: loads.channels.iter().map(table).collect(),
        cut: cuts(&steps.timeline, &loads, steps.substeps, steps.parts),
        outputs,
        q: turned(&state.motion[..m]),
        p: turned(&state.motion[m..2 * m]),
        a: turned(&state.motion[2 * m..]),
        d: pick(&state.d),
        v: pick(&state.v),
        f: pick(&state.f),
        stiffness: of_active(&|a| state.tangents.k[system.links.diagonal[a]]),
        stiffest: of_active(&|a| state.stiffest[a]),
        history: state.history.clone(),
        stored: state.stored.clone(),
        scale: state.scale,
        kinetic,
        strain,
        potential: potential(&constant_force(space, &loads), &state),
        watch: Watch::new(model, system, space, &own.turn),
        stands: roles.stand(&seen),
        contacts: standing,
        values,
        rates,
        adaptive,
        energy_limit: analysis.solution.energy_limit,
        tolerance: analysis.solution.link_tolerance,
        rotational: flat.iter().map(|i| system.links.rotational[*i]).collect(),
        elements: system.links.links.iter().map(|l| l.element).collect(),
        rows: links.rows,
        engaged: links.engaged,
        forms: links.forms,
        omega2: own.omega2,
        damping: own.damping,
    })
}

/// The case, where its settings and the outputs of the model fit.
fn suited<'a>(model: &'a Model, system: &System, case: usize) -> Result<&'a DynamicCase, Unfit> {
    let Analysis::Dynamic(analysis) = &model.cases[case].analysis else {
        return Err("a static case".into());
    };
    let solution = &analysis.solution;
    if solution.solver != SolverKind::Fna {
        return Err("another solver than fna".into());
    }
    if solution.kernel != Kernel::Newton {
        return Err("another iteration than Newton's".into());
    }
    if !analysis.supports.is_empty() {
        return Err("supports that move".into());
    }
    if system.links.effective.iter().any(|k| *k != 0.0) {
        return Err("effective stiffnesses of links".into());
    }
    if system.links.links.is_empty() {
        return Err("a model without links".into());
    }
    match model.outputs.iter().find(|o| matches!(o.quantity, Quantity::Derived(_))) {
        Some(o) => Err(Unfit::Reason(format!("output \"{}\" has no form for lanes", o.name))),
        None => Ok(analysis),
    }
}

/// The structure over its modes, of a basis that leaves nothing out.
fn reduced(
    model: &Model,
    system: &System,
    analysis: &DynamicCase,
    loads: &LoadSet,
    initial: &Initial,
) -> Result<Modes, Unfit> {
    let judged = analysis.solution.basis.tolerance < 1.0 && !model.outputs.is_empty();
    let bases = bases(model, system, analysis, SolverKind::Fna, loads, initial, judged)?;
    let bases = bases.ok_or("no basis")?;
    if bases.wider.is_some() {
        return Err("a basis that leaves something out, so that its error must be watched".into());
    }
    Ok(fna_modes(model, system, loads, &bases))
}

/// The modes of a lane, which damping does not couple.
struct OwnModes {
    omega2: Vec<f64>,
    damping: Vec<f64>,
    /// Modes of the space over these.
    turn: Dense,
}

impl OwnModes {
    fn new(space: &ReducedSystem) -> Result<Self, Unfit> {
        if space.readers.columns() > 0 {
            return Err("places without mass".into());
        }
        let omega2 = space.stiffness.diagonal();
        let (damping, turn) =
            uncoupled(&omega2, &space.damping)?.ok_or("damping that couples modes")?;
        Ok(Self { omega2, damping, turn })
    }
}

/// The links of a lane, and those of their coordinates that matter.
struct OwnLinks {
    forms: Vec<Form>,
    /// The coordinates that matter, by their index among those of all links.
    flat: Vec<usize>,
    /// B over the modes of the lane, and the stiffness where the links are engaged, of each of them.
    rows: Vec<Vec<f64>>,
    engaged: Vec<f64>,
}

impl OwnLinks {
    fn new(
        model: &Model,
        system: &System,
        seen: &[(usize, Contact)],
        outputs: &[Row],
        (space, own, is_fixed): (&ReducedSystem, &OwnModes, bool),
    ) -> Result<Self, Unfit> {
        let m = space.order();
        let (forms, flat) = forms(model, system, seen, outputs).map_err(Unfit::Reason)?;
        let widest = forms.iter().map(|f| f.extent.coordinates).max().unwrap_or(1);
        let is_body = widest > WIDEST && widest <= BODY && m <= BODY && forms.len() == 1;
        if !is_body && (m > ROOM || forms.len() * widest > ROOM || widest > WIDEST) {
            return Err("too many modes or link coordinates".into());
        }
        if is_fixed && forms.iter().any(|f| f.extent.falls) {
            return Err("fixed steps of a body that may overturn".into());
        }
        if is_fixed && is_body {
            return Err("fixed steps of a link with more than three coordinates".into());
        }
        let row = |flat: &usize| {
            let mut row = vec![0.0; m];
            if let Some(a) = system.links.active.iter().position(|x| x == flat) {
                space.links.row(a).for_each(|(j, c)| row[j] += c);
                row = turned(&own.turn, &row);
            }
            row
        };
        let rows = flat.iter().map(row).collect();
        let engaged = system.links.engaged(model);
        let engaged = flat.iter().map(|i| engaged[*i]).collect();
        Ok(Self { forms, flat, rows, engaged })
    }
}

/// The steps of a lane.
struct Steps {
    timeline: Timeline,
    grid: Grid,
    /// Steps of an output step, and the equal parts of each of them that loads cut most output steps into.
    substeps: usize,
    parts: usize,
}

impl Steps {
    fn new(
        analysis: &DynamicCase,
        control: StepControl,
        loads: &LoadSet,
        (own, links): (&OwnModes, &OwnLinks),
    ) -> Result<Self, Unfit> {
        let dt = analysis.dt;
        let too_long = |step: f64| -> Option<&'static str> {
            if own.omega2.iter().any(|w| w.max(0.0).sqrt() * step > FASTEST) {
                return Some("modes too fast for the steps");
            }
            // With adaptive steps average acceleration stands in for it.
            let rule = modes_of(&own.omega2, &own.damping, step);
            let is_fixed = matches!(control, StepControl::Fixed { .. });
            let beyond = is_fixed && stiffness_ratio(&links.rows, &rule, &links.engaged) > LONGEST;
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
        let timeline = Timeline::new(dt, analysis.duration, loads, substeps);
        let parts = common_parts(&timeline);
        let grid = Grid { dt, steps: timeline.steps, substeps: substeps * parts };
        let longest = if halvings == 0 { grid.step() } else { dt / substeps as f64 };
        match too_long(longest) {
            Some(reason) => Err(reason.into()),
            None => Ok(Self { timeline, grid, substeps, parts }),
        }
    }
}

/// The outputs over the modes of the lane and the coordinates that matter.
fn outputs(
    model: &Model,
    analysis: &DynamicCase,
    (all, flat): (&Outputs, &[usize]),
    loads: &LoadSet,
    own: &OwnModes,
) -> Result<Vec<Output>, Unfit> {
    if all.is_loaded() {
        return Err("outputs that loads along members have a share in".into());
    }
    // Base motion stands behind what is constant.
    let first = usize::from(loads.channels.iter().any(|c| matches!(c.track, Track::Constant)));
    let directions = analysis.base.iter().map(|b| b.direction.index());
    let base_share = |base: &[f64]| {
        let mut share = vec![0.0; loads.channels.len()];
        directions.clone().enumerate().for_each(|(i, along)| share[first + i] = base[along]);
        share
    };
    let dense = |row: &[(usize, f64)]| {
        let mut full = vec![0.0; own.omega2.len()];
        row.iter().for_each(|(j, c)| full[*j] += c);
        turned(&own.turn, &full)
    };
    let at = |i: usize| flat.iter().position(|x| *x == i);
    let of_lanes = |terms: &[(usize, f64)]| -> Vec<(usize, f64)> {
        terms.iter().filter_map(|(flat, factor)| Some((at(*flat)?, *factor))).collect()
    };
    let output = |(row, quantity): (&Row, &Quantity)| match row {
        Row::Nodal { order, own, base, .. } => {
            let moves = matches!(quantity, Quantity::Acceleration { absolute: true, .. });
            let base = if moves { base_share(base) } else { Vec::new() };
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
    };
    let quantities = model.outputs.iter().map(|o| &o.quantity);
    Ok(all.rows.iter().zip(quantities).map(output).collect())
}

/// The feet of bodies, which alone have a part in the response mode: their indices among the contacts of the lane, and
/// what they do.
fn feet(
    system: &System,
    seen: &[(usize, Contact)],
    roles: &[Role],
    forms: &[Form],
) -> Result<(Vec<usize>, Vec<Contact>), Unfit> {
    let (mut feet, mut standing) = (Vec::new(), Vec::new());
    for (at, (element, contact)) in seen.iter().enumerate() {
        if roles[at] != Role::Foot {
            continue;
        }
        let before = seen[..at].iter().filter(|(own, _)| own == element).count();
        let of_element = |l: &LinkInstance| l.element == *element;
        let Some(link) = system.links.links.iter().position(of_element) else { continue };
        if before >= forms[link].extent.contacts {
            return Err("a body on contacts that have no form for lanes".into());
        }
        let first: usize = forms[..link].iter().map(|f| f.extent.contacts).sum();
        feet.push(first + before);
        standing.push(*contact);
    }
    Ok((feet, standing))
}

/// What must be equal of the tracks of channels for analyses to go side by side.
fn kind(track: &Track) -> u8 {
    match track {
        Track::Constant => 0,
        Track::Value { .. } => 1,
        Track::Rate { .. } => 2,
        Track::Curvature { .. } => 3,
    }
}

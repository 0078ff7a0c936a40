//! Several motions of one structure in lock step: FNA with fixed steps.
//!
//! Each motion iterates on its own; products with link maps and compliances are made for all at once.
//! May use `run` and all that it uses.
//!
//! Link maps and compliances are large matrices, and one motion uses each number of them once. Several
//! motions (records, scales, link laws of other strength) that share the structure share the reading: matrix
//! times matrix in place of matrix times vector. Every motion is iterated on its own and comes out as it
//! would alone.

mod course;

use crate::basis::{BasisReport, ModalDamping, follow_supports, modal_damping};
use crate::checks;
use crate::error::SolveError;
use crate::fna::{LONGEST, Modal, Modes};
use crate::kernel::StepKey;
use crate::march::Timeline;
use crate::record::{Observer, Viewer, needs_rates};
use crate::run::{
    Arrival, CaseResult, Clock, Initial, RunOptions, Work, bases, before, fna_modes, held_load,
    link_equations, peak_rss_mb, run, start,
};
use crate::step::LinkStepper;
use course::Course;
use trilith_model::{Analysis, Case, DynamicCase, Model, SolverKind, StepControl};
use trilith_system::{LoadSet, System};

/// A model and its equations.
#[derive(Clone, Copy, Debug)]
pub struct Member<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its equations.
    pub system: &'a System,
}

/// A member with its case and what it starts from.
struct Entrant<'a> {
    member: Member<'a>,
    case: &'a Case,
    analysis: &'a DynamicCase,
    initial: Initial,
    constant: Vec<f64>,
    loads: LoadSet,
}

/// Runs a dynamic case of several models by FNA, those in lock step that share the structure: the same
/// matrices, link maps and load shapes, the same fixed steps; records, scales and link laws may differ.
/// Whatever does not fit is run alone, and so is a motion whose links find no equilibrium in the common step.
/// Every result is the one that [`run`] gives. `watch` makes the observer of a member, again where it is run
/// anew.
///
/// # Errors
/// As [`run`], for the first member that cannot be run.
pub fn run_together<O: Observer>(
    members: &[Member<'_>],
    case: usize,
    watch: impl Fn(usize) -> O,
) -> Result<Vec<(CaseResult, O)>, SolveError> {
    let entrants = members.iter().map(|m| entrant(*m, case)).collect::<Result<Vec<_>, _>>()?;
    let mut results: Vec<Option<(CaseResult, O)>> = members.iter().map(|_| None).collect();
    for (first, lead) in entrants.iter().enumerate() {
        let Some(lead) = lead else { continue };
        if results[first].is_some() {
            continue;
        }
        let fits = |i: &usize| {
            results[*i].is_none() && entrants[*i].as_ref().is_some_and(|e| suits(lead, e))
        };
        let group: Vec<usize> = (first..members.len()).filter(fits).collect();
        if group.len() < 2 {
            continue;
        }
        let entered: Vec<&Entrant<'_>> =
            group.iter().filter_map(|i| entrants[*i].as_ref()).collect();
        let mut observers: Vec<O> = group.iter().map(|i| watch(*i)).collect();
        let ended = march(&entered, &mut observers)?;
        for ((i, observer), result) in group.into_iter().zip(observers).zip(ended) {
            results[i] = result.map(|r| (r, observer));
        }
    }
    let alone = |(i, result): (usize, Option<(CaseResult, O)>)| match result {
        Some(found) => Ok(found),
        None => {
            let Member { model, system } = members[i];
            let mut observer = watch(i);
            let solver = Some(SolverKind::Fna);
            let options = RunOptions { case, solver, ..RunOptions::default() };
            run(model, system, options, &mut [&mut observer]).map(|r| (r, observer))
        }
    };
    results.into_iter().enumerate().map(alone).collect()
}

/// A member that may go with others; none for static cases and steps that are not fixed.
fn entrant(member: Member<'_>, case: usize) -> Result<Option<Entrant<'_>>, SolveError> {
    let Member { model, system } = member;
    let case = &model.cases[case];
    let Analysis::Dynamic(analysis) = &case.analysis else { return Ok(None) };
    if !matches!(analysis.solution.step, StepControl::Fixed { .. }) {
        return Ok(None);
    }
    let before = before(model, system, case, Some(SolverKind::Fna), None)?;
    let constant = held_load(model, system, analysis, before.as_ref());
    let mut loads = system.dynamic_loads(model, analysis, constant.clone());
    loads.held = model.held_loads(case);
    let initial = Initial::new(model, system, analysis, before.as_ref())?;
    Ok(Some(Entrant { member, case, analysis, initial, constant, loads }))
}

/// True where two members share structure and steps.
fn suits(a: &Entrant<'_>, b: &Entrant<'_>) -> bool {
    let (x, y) = (a.member.system, b.member.system);
    let shape = |e: &Entrant<'_>| (e.analysis.dt, e.analysis.duration);
    let forces =
        |e: &Entrant<'_>| e.loads.channels.iter().map(|c| c.force.clone()).collect::<Vec<_>>();
    std::ptr::eq(a, b)
        || (shape(a) == shape(b)
            && a.analysis.solution == b.analysis.solution
            && a.member.model.damping == b.member.model.damping
            && x.mass == y.mass
            && x.stiffness == y.stiffness
            && x.element_damping == y.element_damping
            && x.rayleigh == y.rayleigh
            && x.links.active == y.links.active
            && x.links.rows == y.links.rows
            && x.links.effective == y.links.effective
            && x.links.engaged(a.member.model) == y.links.engaged(b.member.model)
            && forces(a) == forces(b)
            && a.initial.beyond_equilibrium == b.initial.beyond_equilibrium
            && a.initial.velocity == b.initial.velocity)
}

/// Marches a group; none for those that left it.
fn march<O: Observer>(
    group: &[&Entrant<'_>],
    observers: &mut [O],
) -> Result<Vec<Option<CaseResult>>, SolveError> {
    let clock = Clock::start();
    let none = || group.iter().map(|_| None).collect();
    let Some(lead) = group.first() else { return Ok(Vec::new()) };
    let Entrant { member: Member { model, system }, analysis, loads, initial, .. } = lead;
    let StepControl::Fixed { substeps } = analysis.solution.step else { return Ok(none()) };
    let Some(bases) = bases(model, system, analysis, SolverKind::Fna, loads, initial, false)?
    else {
        return Ok(none());
    };
    let all_loads = with_supports(group, modal_damping(model, system, &bases).as_ref())?;
    let mut modes = fna_modes(model, system, &all_loads[0], &bases);
    let dt = analysis.dt;
    // Stiff links choose their rule step by step, each motion its own.
    if modes.ratio(dt / substeps as f64) > LONGEST {
        return Ok(none());
    }
    let mut watchers: Vec<[&mut dyn Observer; 1]> =
        observers.iter_mut().map(|o| [o as &mut dyn Observer]).collect();
    let mut courses = Vec::new();
    for ((entrant, loads), watcher) in group.iter().zip(&all_loads).zip(&mut watchers) {
        let course;
        (course, modes) = set_out(entrant, loads, modes, watcher, substeps)?;
        courses.push(course);
    }
    let setup_cpu = clock.cpu();
    march_all(&mut modes, &mut courses, substeps);
    courses.iter_mut().filter(|c| !c.left).for_each(Course::show_end);
    let share = (courses.len() as f64).recip();
    let cpu = [share * setup_cpu, share * (clock.cpu() - setup_cpu)];
    let result = |(course, entrant): (Course<'_, '_>, &&Entrant<'_>)| {
        let report = bases.report.clone();
        (!course.left).then(|| result(course, entrant, &modes, report, clock.wall(), cpu))
    };
    Ok(courses.into_iter().zip(group).map(result).collect())
}

/// The loads of each member, with the damping of what follows its moving supports, which is known with the modes.
fn with_supports(
    group: &[&Entrant<'_>],
    damping: Option<&ModalDamping>,
) -> Result<Vec<LoadSet>, SolveError> {
    let mut all = Vec::new();
    for Entrant { member: Member { model, system }, loads, .. } in group {
        let mut loads = loads.clone();
        follow_supports(model, system, damping, true, &mut loads)?;
        all.push(loads);
    }
    Ok(all)
}

/// The start of one motion, and the modes again, which it shares with the others.
fn set_out<'a, 'b>(
    entrant: &Entrant<'a>,
    loads: &'a LoadSet,
    modes: Modes,
    watcher: &'a mut [&'b mut dyn Observer; 1],
    substeps: usize,
) -> Result<(Course<'a, 'b>, Modes), SolveError> {
    let Entrant { member: Member { model, system }, initial, analysis, .. } = entrant;
    let DynamicCase { dt, duration, .. } = **analysis;
    let watched = needs_rates(model, system, watcher.iter().any(|o| o.wants_rates()));
    let order = modes.space.order();
    let side = link_equations(model, system, &analysis.solution, loads, order, watched);
    let mut stepper = LinkStepper::new(Modal::new(modes), side)?;
    let (state, control, ledger, _) =
        start(model, system, initial, loads, &mut stepper, [dt, duration])?;
    let (modal, side) = stepper.into_parts();
    let modes = modal.into_modes();
    let mut viewer = Viewer::new(model, system, loads, &modes.space, watcher);
    viewer.look_inside(Some(modes.closed_form()), dt, Vec::new());
    let timeline = Timeline::new(dt, duration, loads, substeps);
    let mut course =
        Course::new(&modes.space, side, loads, timeline, (state, control, ledger), viewer);
    course.show_start();
    Ok((course, modes))
}

/// All courses to their ends, output step after output step.
fn march_all(modes: &mut Modes, courses: &mut [Course<'_, '_>], substeps: usize) {
    while courses.iter().any(Course::is_on_the_way) {
        let lengths = common(courses);
        courses.iter_mut().filter(|c| c.is_on_the_way()).for_each(|c| c.set_out(&lengths));
        for (segment, length) in lengths.into_iter().enumerate() {
            let going = courses.iter_mut().filter(|c| c.is_on_the_way());
            going.for_each(|c| c.set_off(segment, modes));
            let part = length / substeps as f64;
            for index in 0..substeps {
                step(modes, courses, segment, (index, substeps), part);
            }
        }
        courses.iter_mut().filter(|c| c.is_on_the_way()).for_each(|c| c.arrive());
    }
}

/// What a course has come to; `cpu`: its share of the CPU time before the first step and from there on, s.
fn result(
    course: Course<'_, '_>,
    entrant: &Entrant<'_>,
    modes: &Modes,
    report: BasisReport,
    wall: f64,
    [setup_cpu, march_cpu]: [f64; 2],
) -> CaseResult {
    let work = Work {
        steps: course.made,
        substeps: course.substeps,
        iterations: course.side.kernel.iterations(),
        wall_s: wall,
        setup_cpu_s: setup_cpu,
        march_cpu_s: march_cpu,
        peak_rss_mb: peak_rss_mb(),
        ..Work::default()
    };
    let Member { model, system } = entrant.member;
    let memory = course.side.kernel.memory();
    let (loads, noticed) = (course.loads, course.viewer.noticed());
    let arrival = Arrival {
        timeline: &course.timeline,
        made: course.made,
        state: course.state,
        control: course.control,
        ledger: course.ledger,
        constant: entrant.constant.clone(),
        initial: entrant.initial.clone(),
        fallen: course.fallen,
        largest: course.viewer.largest(),
    };
    let (case, kind) = (entrant.case, SolverKind::Fna);
    let mut result = arrival.result(model, system, case, kind, &modes.space, memory, work);
    let of = (case, entrant.analysis);
    result.warnings = checks::of_dynamic((model, system), of, loads, noticed, &result.place());
    result.basis = Some(report);
    result
}

/// Lengths of the segments of the next output step that most of the courses on the way have in common, the first of
/// them where several are as many.
fn common(courses: &[Course<'_, '_>]) -> Vec<f64> {
    let going = courses.iter().filter(|c| c.is_on_the_way());
    let all: Vec<Vec<f64>> = going.map(Course::lengths).collect();
    let count = |lengths: &Vec<f64>| all.iter().filter(|other| *other == lengths).count();
    all.iter().rev().max_by_key(|lengths| count(lengths)).cloned().unwrap_or_default()
}

/// One step of all courses that are on the way: a part of so many of a segment of their output step, over `dt`.
/// A course whose links find no equilibrium leaves the others.
fn step(
    modes: &mut Modes,
    courses: &mut [Course<'_, '_>],
    segment: usize,
    (part, of): (usize, usize),
    dt: f64,
) {
    modes.prepare(&StepKey::exact(dt));
    let modes = &*modes;
    let mut going: Vec<&mut Course<'_, '_>> =
        courses.iter_mut().filter(|c| c.is_on_the_way()).collect();
    going.iter_mut().for_each(|c| c.begin(&modes.space, segment, part, of));
    let mut pairs: Vec<_> = going.iter_mut().filter_map(|c| c.spread_start()).collect();
    modes.space.links.spread_each(&mut pairs);
    going.iter_mut().for_each(|c| c.predict(modes));
    let mut pairs: Vec<_> = going.iter_mut().map(|c| c.predicted(modes)).collect();
    modes.space.links.deform_each(&mut pairs);
    let mut moved = Vec::new();
    for course in &mut going {
        if course.take_up(modes, dt) {
            moved.extend(course.change(modes));
        }
    }
    modes.compliance().g.mul_add_each(-1.0, &mut moved);
    loop {
        going.iter_mut().filter(|c| !c.is_converged()).for_each(|c| c.iterate(modes, dt));
        let is_open = |c: &Course<'_, '_>| c.is_on_the_way() && !c.is_converged();
        if !going.iter().any(|c| is_open(c)) {
            break;
        }
        let open = going.iter_mut().filter(|c| is_open(c));
        let mut pairs: Vec<_> = open.filter_map(|c| c.change(modes)).collect();
        modes.compliance().g.mul_add_each(-1.0, &mut pairs);
    }
    going.retain(|c| c.is_on_the_way());
    let mut pairs: Vec<_> = going.iter_mut().filter_map(|c| c.spread_end()).collect();
    modes.space.links.spread_each(&mut pairs);
    going.iter_mut().for_each(|c| c.correct(modes));
    let mut pairs: Vec<_> = going.iter_mut().filter_map(|c| c.rates(modes)).collect();
    modes.space.links.deform_each(&mut pairs);
    going.iter_mut().for_each(|c| c.accept(modes));
}

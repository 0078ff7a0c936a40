//! The answer of the oracle, and how sure it is of it.

use super::march::{Between, Course, Effort, Halt, Scale, State, march};
use super::problem::Problem;
use super::spec::{Kind, Law, Output, Spec};
use std::f64::consts::TAU;

/// The answer.
#[derive(Clone, Debug)]
pub struct Truth {
    /// Course at the tight tolerance.
    pub course: Course,
    /// Largest |value| of every output.
    pub size: Vec<f64>,
    /// What an error of every output is a share of: its size, and no less than a share of those of its
    /// kind.
    pub scale: Vec<f64>,
    /// Largest of any direction, of its kind, as far as that is known.
    pub around: Vec<f64>,
    /// What every output is rounded by.
    pub rounding: Vec<f64>,
    /// How far each output moves between a loose and the tight tolerance, over its scale.
    pub moves: Vec<f64>,
}

/// Tolerances of the two passes.
const LOOSE: f64 = 1e-5;
const TIGHT: f64 = 1e-7;
/// What a pass at the tight one takes for one at the loose one, or a little more.
const TIGHT_OVER_LOOSE: f64 = 5.0;
/// Share of its size that an output may be off between the ends of steps, at the tight one, as far as can be told.
const BETWEEN: f64 = 1e-4;
/// Outputs below this share of the largest of their kind are compared on that share.
const SMALL: f64 = 1e-3;
/// Share of the largest motion that an output is compared on at least.
const ROUNDING: f64 = 1e-7;

/// Integrates a description; `work`: at most so many multiplications.
///
/// # Errors
/// Why there is no answer.
pub fn truth(spec: &Spec, work: f64) -> Result<Truth, Halt> {
    // Open links are not asked for their error, but what they record follows the supports.
    let shortest = spec.moved.iter().map(|m| m.2.period()).fold(f64::INFINITY, f64::min);
    truth_in_steps(spec, work, shortest / 32.0)
}

/// The same, no step longer than this, s: the whole step and its halves may both pass by a short contact.
///
/// # Errors
/// Why there is no answer.
pub fn truth_in_steps(spec: &Spec, work: f64, longest: f64) -> Result<Truth, Halt> {
    let mut problem = Problem::new(spec, 10.0 * TAU / spec.duration)?;
    problem.cut(longest);
    let mut start = State::start(&problem);
    if spec.gravity {
        let before = problem.before();
        let effort = Effort { tolerance: 1e-7, work };
        let course = march(&before, State::start(&before), None, effort, None)
            .map_err(|halt| format!("statics: {halt}"))?;
        start = State { v: start.v, ..course.end };
    } else if let Some((joints, q, others)) = problem.led() {
        let effort = Effort { tolerance: 1e-7, work };
        // What no link holds either has no place of its own.
        let scale = Scale::of(&joints, others.amax());
        let course = march(&joints, State::start(&joints), Some(scale), effort, None)
            .map_err(|halt| format!("joints at the start: {halt}"))?;
        start.u = others + q * course.end.u;
        start.z = course.end.z;
    }
    let uneven = if spec.gravity { of_start(&problem, &start.u) } else { 0.0 };
    let loose = march(&problem, start.clone(), None, Effort { tolerance: LOOSE, work }, None)
        .map_err(|halt| match halt {
            Halt::Spent(steps, at) => Halt::Spent(steps, at / TIGHT_OVER_LOOSE),
            stuck @ Halt::Stuck(_) => stuck,
        })?;
    let effort = Effort { tolerance: TIGHT, work };
    let between = Between {
        sizes: Sizes::of(spec, &problem, &loose).scale,
        share: BETWEEN,
        window: 0.25 * WINDOW * spec.duration,
    };
    let known = Some(loose.scale.clone());
    let course = march(&problem, start.clone(), known, effort, Some(&between))?;
    let Sizes { size, scale, floor } = Sizes::of(spec, &problem, &course);
    if size.iter().any(|x| !x.is_finite()) {
        return Err(Halt::Stuck("its values are not finite".into()));
    }
    let alike = |i: usize| largest_alike(spec, &size, i);
    let around = (0..size.len())
        .map(|i| {
            let known = match spec.outputs[i] {
                Output::Displacement(_, d) => course.scale.displacement(&problem, d > 2),
                Output::Velocity(_, d) => course.scale.velocity(&problem, d > 2),
                _ => 0.0,
            };
            alike(i).max(known)
        })
        .collect();
    let samples = 400;
    let moves = (0..size.len())
        .map(|i| {
            let off = (1..=samples).map(|j| {
                let t = spec.duration * f64::from(j) / f64::from(samples);
                let width = WINDOW * spec.duration;
                let (low, high) =
                    course.span(i, (t - width).max(0.0), (t + width).min(spec.duration));
                outside(loose.at(i, t), low, high)
            });
            off.fold(0.0, f64::max) / scale[i]
        })
        .collect();
    let of_floor = (uneven / ROUNDING).clamp(OF_FLOOR, 1.0);
    let tiny = (0..size.len()).any(|i| size[i] < floor[i]);
    let drifts = if tiny { drifts(spec, &problem, start, &course, effort) } else { None };
    let drift = |i: usize| drifts.as_ref().map_or(0.0, |drifts: &Vec<f64>| drifts[i].min(floor[i]));
    let rounding = (0..size.len())
        .map(|i| {
            let noise = noise(spec, &problem, &course, &spec.outputs[i]);
            // What is no more than that is nothing else.
            if size[i] <= noise { noise } else { (of_floor * floor[i]).max(drift(i)) }
        })
        .collect();
    Ok(Truth { course, size, scale, around, rounding, moves })
}

/// Share of the floor of an output that is rounding of the oracle.
const OF_FLOOR: f64 = 1e-2;

/// Share of the displacements under constant loads that is rounding: that of the terms of their equilibrium, over
/// the loads. It sets structures in motion that nothing else moves.
fn of_start(problem: &Problem, u: &nalgebra::DVector<f64>) -> f64 {
    let (terms, load) = ((problem.a.k.abs() * u.abs()).amax(), problem.constant.amax());
    if load > 0.0 { f64::EPSILON * terms / load } else { 0.0 }
}

/// How far the outputs drift where the structure stays under the constant loads that it is in equilibrium with: the
/// rounding of its modes beside each other, which lets loads push where they have no share.
fn drifts(
    spec: &Spec,
    problem: &Problem,
    start: State,
    course: &Course,
    effort: Effort,
) -> Option<Vec<f64>> {
    if !spec.gravity || !spec.moved.is_empty() || !spec.initial.is_empty() {
        return None;
    }
    let still = Problem { channels: Vec::new(), ..problem.clone() };
    let stays = march(&still, start, Some(course.scale.clone()), effort, None).ok()?;
    let ends = (0..spec.outputs.len()).map(|i| stays.span(i, 0.0, spec.duration));
    Some(ends.map(|(low, high)| high - low).collect())
}

/// Sizes of the outputs.
struct Sizes {
    size: Vec<f64>,
    scale: Vec<f64>,
    floor: Vec<f64>,
}

impl Sizes {
    fn of(spec: &Spec, problem: &Problem, course: &Course) -> Self {
        let ends = (0..spec.outputs.len()).map(|i| course.span(i, 0.0, spec.duration));
        let size: Vec<f64> = ends.map(|(a, b)| a.abs().max(b.abs())).collect();
        let most = |o| ROUNDING * largest(problem, course, extent(spec), o);
        let floor: Vec<f64> = spec.outputs.iter().map(most).collect();
        let scale = (0..size.len())
            .map(|i| {
                let noise = noise(spec, problem, course, &spec.outputs[i]);
                size[i]
                    .max(SMALL * largest_alike(spec, &size, i))
                    .max(floor[i])
                    .max(noise)
                    .max(1e-12)
            })
            .collect();
        Self { size, scale, floor }
    }
}

/// The largest size of the outputs of one kind.
fn largest_alike(spec: &Spec, size: &[f64], i: usize) -> f64 {
    let of = kind(&spec.outputs[i]);
    let alike = spec.outputs.iter().zip(size).filter(|(o, _)| kind(o) == of);
    alike.map(|(_, size)| *size).fold(0.0, f64::max)
}

/// The largest value that an output could have by the motion of the whole structure: what its rounding is
/// a share of. Outputs that are 0 by symmetry are nothing else.
fn largest(problem: &Problem, course: &Course, extent: f64, output: &Output) -> f64 {
    let scale = &course.scale;
    // Rotations move what is far away, and come of displacements that differ.
    let both = |turns: bool, of: &dyn Fn(bool) -> f64| {
        let arm = if turns { extent.recip() } else { extent };
        of(turns).max(arm * of(!turns))
    };
    let displacement = |turns| both(turns, &|turns| scale.displacement(problem, turns));
    let of = |member: usize, axis: usize| {
        let link = problem.a.links.iter().find(|l| l.member == member);
        let local = link.and_then(|l| Some(l.first + l.axes.iter().position(|a| *a == axis)?));
        let stiff = local.map_or(0.0, |i| problem.beside[i]);
        (displacement(axis > 2), stiff)
    };
    match *output {
        Output::Displacement(_, d) | Output::Drift(_, _, d) => displacement(d > 2),
        Output::Velocity(_, d) => {
            let velocity = both(d > 2, &|turns| scale.velocity(problem, turns));
            velocity.max(problem.omega * displacement(d > 2))
        }
        Output::LinkForce(e, a) => {
            let (motion, stiff) = of(e, a);
            motion * stiff
        }
        Output::LinkDeformation(e, a) => of(e, a).0,
        Output::Acceleration(..) | Output::End(..) => 0.0,
    }
}

/// What a dashpot makes of the rounding of its speed, N or N·m: the root of a small number is no small one.
fn noise(spec: &Spec, problem: &Problem, course: &Course, output: &Output) -> f64 {
    let Output::LinkForce(e, axis) = *output else { return 0.0 };
    let (c, exponent) = match spec.members[e].kind {
        Kind::Link(Law::Dashpot(c, a) | Law::Maxwell(_, c, a), _) if a < 1.0 => (c, a),
        _ => return 0.0,
    };
    let turns = axis > 2;
    let speed = course.scale.velocity(problem, turns);
    let speed = speed.max(problem.omega * course.scale.displacement(problem, turns));
    c * (OF_FLOOR * ROUNDING * speed).powf(exponent)
}

/// Largest distance of a node from the first, m; 1 m for a point.
fn extent(spec: &Spec) -> f64 {
    let from = spec.nodes[0];
    let far = |n: &[f64; 3]| (0..3).map(|i| (n[i] - from[i]).powi(2)).sum::<f64>().sqrt();
    let most = spec.nodes.iter().map(far).fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}

/// Times may be off by this share of the duration.
pub const WINDOW: f64 = 2e-4;

/// How far a value is outside of an interval.
#[must_use]
pub fn outside(x: f64, low: f64, high: f64) -> f64 {
    if x.is_nan() { f64::INFINITY } else { (low - x).max(x - high).max(0.0) }
}

/// Outputs of one kind have one unit.
fn kind(output: &Output) -> u8 {
    match output {
        Output::Displacement(_, d) => u8::from(*d > 2),
        Output::Velocity(_, d) => 2 + u8::from(*d > 2),
        Output::LinkForce(_, a) => 4 + u8::from(*a > 2),
        Output::LinkDeformation(_, a) => u8::from(*a > 2),
        Output::Drift(_, _, d) => u8::from(*d > 2),
        Output::End(_, _, d) => 4 + u8::from(*d > 2),
        Output::Acceleration(_, d) => 6 + u8::from(*d > 2),
    }
}

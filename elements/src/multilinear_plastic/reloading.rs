//! What `Takeda` and `Pivot` share: elastic lines back, and a way out that the largest deformation sets.
//!
//! From zero force at `zero` the force of a side grows along its *way*: from there to the point of the curve
//! at the largest deformation so far (`reach`), and on along the curve. A reversal leaves the way on an
//! elastic line; moving out again returns on that line until it meets the way. A rule says how steep the
//! lines are and how the way runs below `reach`.
//!
//! Before the first yielding `reach` is the first corner of the curve.

use super::branch::Branch;
use super::{Answer, MultilinearPlastic, Step};
use trilith_element::{Field, History, history};

history! {
    /// Where the spring stands.
    pub(super) struct Standing {
        /// Force.
        force: "N",
        /// Deformation at which the force last was zero.
        zero: "m",
        /// Largest deformation upwards.
        reach_up: "m",
        /// Largest deformation downwards, ≥ 0.
        reach_down: "m",
    }
}

pub(super) fn fields(length: &'static str, force: &'static str) -> Vec<Field> {
    vec![
        Field::new("force", force),
        Field::new("zero", length),
        Field::new("reach_up", length),
        Field::new("reach_down", length),
    ]
}

pub(super) fn at_rest(law: &MultilinearPlastic, at: &mut [f64]) {
    let [reach_up, reach_down] = [1.0, -1.0].map(|sign| law.branch(sign).point(1).0);
    Standing { force: 0.0, zero: 0.0, reach_up, reach_down }.store(at);
}

/// A rule; deformation and force are counted outwards on the side that is asked about.
pub(super) trait Rule {
    /// Slope of the elastic line through a point.
    fn elastic(&self, side: Branch<'_>, x: f64, f: f64) -> f64;
    /// A corner of the way between zero force and `reach`.
    fn corner(&self, side: Branch<'_>, reach: f64) -> Option<(f64, f64)>;
}

/// The way out on a side.
struct Way<'a> {
    side: Branch<'a>,
    zero: f64,
    corner: Option<(f64, f64)>,
    reach: f64,
}

impl Way<'_> {
    /// Force and slope; at a corner the slope outwards.
    fn at(&self, x: f64) -> (f64, f64) {
        let line = |(a, f): (f64, f64), (b, g): (f64, f64)| {
            let slope = (g - f) / (b - a);
            (f + slope * (x - a), slope)
        };
        if x >= self.reach {
            return self.side.at(x);
        }
        let (top, foot) = ((self.reach, self.side.at(self.reach).0), (self.zero, 0.0));
        match self.corner {
            Some(corner) if x < corner.0 => line(foot, corner),
            Some(corner) => line(corner, top),
            None => line(foot, top),
        }
    }

    /// The next corner outwards of `x`.
    fn next(&self, x: f64) -> f64 {
        let within = [self.corner.map_or(x, |c| c.0), self.reach];
        let on_curve = |i| self.side.point(i).0;
        let curve = (1..self.side.lines()).map(on_curve).find(|p| *p > x.max(self.reach));
        let first = within.into_iter().find(|p| *p > x);
        first.or(curve).unwrap_or(f64::INFINITY)
    }

    /// From (`x`, `f`) outwards to `end`, on the line of slope `k` until it meets the way: force, slope,
    /// work, and whether the way was met.
    fn out(&self, mut x: f64, mut f: f64, k: f64, end: f64) -> (f64, f64, f64, bool) {
        let (now, steepness) = self.at(x);
        // At zero force the way may begin steeper than the line, which then leaves it.
        let mut met = f >= now * (1.0 - 1e-12) && steepness <= k * (1.0 + 1e-12);
        let mut work = 0.0;
        let mut slope = if met { steepness } else { k };
        while x < end {
            let mut to = self.next(x).min(end);
            let (here, tangent) = self.at(x);
            let there = here + tangent * (to - x);
            let mut force = if met { there } else { f + k * (to - x) };
            slope = if met { tangent } else { k };
            if force > there {
                // The line meets the way before `to`.
                met = true;
                let (before, after) = ((here - f).max(0.0), force - there);
                to = x + (to - x) * before / (before + after);
                force = here + tangent * (to - x);
                slope = tangent;
            }
            work += 0.5 * (f + force) * (to - x);
            (x, f) = (to, force);
        }
        (f, slope, work, met)
    }
}

pub(super) fn respond(
    law: &MultilinearPlastic,
    rule: &impl Rule,
    step: Step,
    committed: &[f64],
    trial: &mut [f64],
) -> Answer {
    let mut at = Standing::load(committed);
    let (mut d, mut force) = (step.d0, at.force);
    let back = force * step.direction < 0.0 || step.direction == 0.0;
    if back {
        let side = law.branch(1.0_f64.copysign(force));
        let (x, f) = (side.sign * d, side.sign * force);
        let k = rule.elastic(side, x, f);
        let zero = x - f / k;
        if side.sign * step.d >= zero {
            at.force = side.sign * (f + k * (side.sign * step.d - x)).max(0.0);
            at.store(trial);
            return Answer { f: at.force, k, stored: 0.5 * at.force * at.force / k, heat: 0.0 };
        }
        (d, force) = (side.sign * zero, 0.0);
    }
    if force == 0.0 {
        at.zero = d;
    }
    let side = law.branch(step.direction);
    let reach = if side.sign > 0.0 { &mut at.reach_up } else { &mut at.reach_down };
    let (x, f, end) = (side.sign * d, side.sign * force, side.sign * step.d);
    let zero = side.sign * at.zero;
    let corner = rule.corner(side, *reach);
    let way = Way { side, zero, corner, reach: *reach };
    let k = rule.elastic(side, x, f);
    let stored = 0.5 * f * f / k;
    let (f, slope, work, met) = way.out(x, f, k, end);
    if met {
        *reach = reach.max(end);
    }
    at.force = side.sign * f;
    at.store(trial);
    let now = 0.5 * f * f / rule.elastic(side, end, f);
    Answer { f: at.force, k: slope, stored: now, heat: work - (now - stored) }
}

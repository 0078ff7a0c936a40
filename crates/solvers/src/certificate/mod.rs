//! How far the outputs of a run are off, estimated while it runs.
//!
//! Reduction by a wider basis beside the run; steps by comparison with a second run, and by what is between their ends.
//! May use `fna` for motions of its own, `record` for outputs, `march`, `step` and what these use.
//!
//! ```text
//! span Φ₂ ⊃ span Φ:    M ü + C u̇ + K u = p − Bᵀ f   on Φ₂, driven by the link forces f of the run
//! e_o = max over time |o(Φ₂ q₂) − o(Φ q)|                                       (reduction)
//! ```
//!
//! The run's own link forces and loads drive the linear structure once more on a wider basis, which holds the next
//! vectors of the same sequence. What that moves beyond the run is what the run's basis has no room for: the response
//! to the residual of the full equations, dynamics included. Link forces answer by their present tangents; where links
//! are few the wider structure moves under what they answer, which without it no output feels that only another link
//! moves. A complete basis leaves nothing.
//!
//! The error of the steps is what a companion at a looser tolerance is away; to link forces it adds
//! what the link equations may leave.
//!
//! What both leave out is of second order: an estimate e of an output of range s is said as e (1 + 3/2 min(1, 100 e/s)).
//!
//! References: residual-based estimation of reduced models, \[Antoulas 2005, ch. 11\]; two bases of one sequence as
//! estimator, \[Bai & Su 2005\].

mod beside;
mod defect;
mod kicks;
mod samples;
mod shadow;
mod touches;

pub(crate) use beside::{Listener, Reporter, beside};
pub(crate) use defect::Defect;
pub(crate) use kicks::Kicks;
pub(crate) use samples::Samples;
pub(crate) use shadow::Shadow;

use crate::kernel::ForceScale;
use crate::march::Segment;
use crate::step::State;
use crate::vector::larger;
use serde::Serialize;
use trilith_model::Model;
use trilith_system::LinkSet;

/// The error of the steps over what the companion is away.
pub(crate) const SAFE: f64 = 1.25;
/// What neither of two runs sees, as share of the size of an output.
pub(crate) const UNSEEN: f64 = 2e-5;

/// What runs straight moves links that answer, to first order only.
const ANSWERED: f64 = 1.25;

/// Both estimates are of first order. What they leave out grows with the square of the error: from this share of the
/// range on it may be so many times the estimate.
const SECOND_ORDER: f64 = 0.01;
const LEFT_OUT: f64 = 1.5;

/// An error of the steps above this share of the range is worth a warning: what an output may be, and what it may be off
/// by, are of one size. The estimate is some times the error, mostly.
const MUCH: f64 = 0.5;

/// An error of the steps above this share of the range is looked at twice: it may have come out small by chance.
const LOOKED_AT_TWICE: f64 = 0.01;

/// A range below this share of the largest of its kind is no motion.
const STILL: f64 = 1e-9;

/// Share of the largest of its kind that is rounding of an output.
const ROUNDING: f64 = 1e-12;

/// Steps before the first time of comparison whose ends are compared as well.
const SETTING_OUT: usize = 500;

/// How far an output may be off, in its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct OutputError {
    /// Because the basis does not hold all motions.
    pub reduction: f64,
    /// Because of the steps in time; not a number where nobody knows.
    pub step: f64,
}

impl OutputError {
    /// Both; not a number where one is not.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.reduction + self.step
    }
}

/// What a run knows of the errors of its outputs.
pub(crate) struct Certificate<'a> {
    shadow: Option<Reporter>,
    defect: Option<Defect<'a>>,
    kicks: Option<Kicks>,
    samples: Samples<'a>,
    reduction: Vec<f64>,
    /// Steps before the first time of comparison that were compared.
    asked: usize,
    /// What the link equations may leave in the outputs that link forces are part of: shares of the largest ones.
    left: Vec<ForceScale>,
    /// Largest link forces so far.
    forces: ForceScale,
    /// Smallest and largest value of each output so far.
    range: Vec<[f64; 2]>,
}

impl<'a> Certificate<'a> {
    /// Of a run whose link equations are solved to this tolerance.
    pub(crate) fn new(
        model: &Model,
        links: &LinkSet,
        samples: Samples<'a>,
        shadow: Option<Reporter>,
        defect: Option<Defect<'a>>,
        kicks: Option<Kicks>,
        link_tolerance: f64,
    ) -> Self {
        let count = model.outputs.len();
        let left = |output: usize| {
            let mut shares = [0.0; 2];
            for (flat, factor) in samples.link_forces(output) {
                shares[usize::from(links.rotational[*flat])] += link_tolerance * factor.abs();
            }
            shares
        };
        let left = (0..count).map(left).collect();
        Self {
            shadow,
            defect,
            kicks,
            samples,
            reduction: vec![0.0; count],
            asked: 0,
            left,
            forces: [0.0; 2],
            range: vec![[0.0; 2]; count],
        }
    }

    /// Takes note of a jump of the loads at a time.
    pub(crate) fn jump(&mut self, t: f64, state: &State) {
        if let Some(defect) = &mut self.defect {
            defect.note(t, state);
        }
        if let Some(kicks) = &mut self.kicks {
            kicks.jump(t, state);
        }
        if let Some(shadow) = &mut self.shadow {
            shadow.jump(t);
        }
    }

    /// Takes note of an accepted step in a segment.
    pub(crate) fn follow(&mut self, segment: Segment, t: f64, state: &State) {
        if let Some(shadow) = &mut self.shadow {
            shadow.step(t, state);
        }
        if let Some(defect) = &mut self.defect {
            defect.follow(t, state);
        }
        if let Some(kicks) = &mut self.kicks {
            kicks.follow(t, state);
        }
        self.forces = state.scale;
        let Some(values) = self.samples.take(segment, t, state) else {
            return self.set_out(t, state);
        };
        for ([least, most], x) in self.range.iter_mut().zip(values) {
            (*least, *most) = (least.min(*x), most.max(*x));
        }
        if let Some(shadow) = &mut self.shadow {
            shadow.outputs(values, state);
        }
        if let Some(defect) = &mut self.defect {
            defect.compare(values, state);
        }
    }

    /// What the basis lacks of the start sets in at once, and may be gone before the first time of comparison.
    fn set_out(&mut self, t: f64, state: &State) {
        if self.samples.times.is_empty()
            && self.asked < SETTING_OUT
            && let Some(shadow) = &mut self.shadow
        {
            self.asked += 1;
            shadow.outputs(&self.samples.now(t, state), state);
        }
    }

    /// The run is at its end.
    pub(crate) fn end(&mut self) {
        self.shadow = None;
    }

    /// Takes what the shadow has found, nothing where it broke off.
    pub(crate) fn reduce(&mut self, errors: Option<Vec<f64>>) {
        match errors {
            Some(errors) => self.reduction = errors,
            None => self.reduction.fill(f64::NAN),
        }
    }

    /// The errors, by what companions have found: where there are two, what is further away counts.
    pub(crate) fn errors(
        &self,
        model: &Model,
        companions: &[Samples<'_>],
        duration: f64,
    ) -> Vec<OutputError> {
        let count = model.outputs.len();
        let further =
            |a: Vec<f64>, b: Vec<f64>| a.into_iter().zip(b).map(|(a, b)| larger(a, b)).collect();
        let largest = |all: Vec<Vec<f64>>| all.into_iter().reduce(further);
        let apart = largest(companions.iter().map(|c| self.samples.apart(c)).collect());
        let jump = |c: &Samples<'_>| self.samples.touches.apart(&c.touches, SAFE, duration, count);
        let jumps = largest(companions.iter().map(jump).collect());
        let jumps = jumps.unwrap_or_else(|| vec![0.0; count]);
        let doubted = |e: f64, i: usize| {
            let size = SECOND_ORDER * self.size(i);
            // Not a number stays none.
            if size > 0.0 { e * (1.0 + LEFT_OUT * (e / size).clamp(0.0, 1.0)) } else { e }
        };
        let kicked: Option<Vec<f64>> = self.kicks.as_ref().map(|kicks| kicks.errors().collect());
        let step = |i: usize| {
            let apart = apart.as_ref().map_or(f64::NAN, |apart| apart[i]);
            let left: f64 = self.left[i].iter().zip(&self.forces).map(|(share, f)| share * f).sum();
            let straight = self.defect.as_ref().map_or(0.0, |defect| ANSWERED * defect.most[i]);
            let unseen = UNSEEN * self.size(i) + ROUNDING * self.largest_alike(model, i);
            let kicked = kicked.as_ref().map_or(0.0, |kicked| kicked[i]);
            let stepped = doubted(larger(SAFE * apart, straight), i);
            stepped + jumps[i] + kicked + unseen + left
        };
        let reduction = self.reduction.iter().enumerate();
        let error =
            |(i, e): (usize, &f64)| OutputError { reduction: doubted(*e, i), step: step(i) };
        reduction.map(error).collect()
    }

    /// The largest value of an output less the smallest, 0 among them.
    fn size(&self, i: usize) -> f64 {
        self.range[i][1] - self.range[i][0]
    }

    /// The largest value of the outputs that have the unit of this one; of angles one radian at least.
    fn largest_alike(&self, model: &Model, i: usize) -> f64 {
        let unit = &model.outputs[i].unit;
        let alike = model.outputs.iter().zip(&self.range).filter(|(o, _)| o.unit == *unit);
        let largest = alike.map(|(_, [low, high])| high.max(-low));
        largest.fold(if unit == "rad" { 1.0 } else { 0.0 }, f64::max)
    }

    /// The largest error of reduction as a share of the range of its output: index of the output and share.
    pub(crate) fn worst(&self, model: &Model) -> Option<(usize, f64)> {
        self.largest_share(model, |i| self.reduction[i])
    }

    /// True where a second companion is worth its time, by these errors.
    pub(crate) fn is_unsure(&self, model: &Model, errors: &[OutputError]) -> bool {
        self.worst_step(model, errors).is_some_and(|(_, share)| share > LOOKED_AT_TWICE)
    }

    /// The largest of the errors of the steps as a share of the range of its output, among outputs that move.
    fn worst_step(&self, model: &Model, errors: &[OutputError]) -> Option<(usize, f64)> {
        let moves = |i: usize| self.size(i) > STILL * self.largest_alike(model, i);
        self.largest_share(model, |i| if moves(i) { errors[i].step } else { 0.0 })
    }

    /// What to say where outputs may be off by much because of the steps, by these errors.
    pub(crate) fn doubt(&self, model: &Model, errors: &[OutputError]) -> Option<String> {
        let (output, share) = self.worst_step(model, errors)?;
        (share > MUCH).then(|| {
            format!(
                "the steps are coarse for output `{}`, which may be off by {:.0} % of its range: a smaller tolerance, `step: Adaptive(tolerance: …)`, makes them finer",
                model.outputs[output].name,
                (100.0 * share).min(100.0)
            )
        })
    }

    /// The largest of errors as a share of the range of its output, among those of one kind that are not small.
    fn largest_share(&self, model: &Model, error: impl Fn(usize) -> f64) -> Option<(usize, f64)> {
        let all = 0..self.reduction.len();
        let share = |i: usize| {
            // What hardly moves is measured by the largest of its kind.
            let alike = |j: &usize| model.outputs[*j].unit == model.outputs[i].unit;
            let largest = all.clone().filter(alike).map(|j| self.size(j)).fold(0.0, f64::max);
            let scale = self.size(i).max(0.1 * largest);
            if scale > 0.0 { error(i) / scale } else { 0.0 }
        };
        all.clone().map(|i| (i, share(i))).max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

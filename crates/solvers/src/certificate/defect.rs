//! What runs straight in the steps of FNA, and should not.
//!
//! Between the ends of a step FNA knows the motion in closed form, under loads and link forces that run straight there.
//! What loads and links say on that very motion is something else:
//!
//! ```text
//! δ(t) = Φᵀ (p(t) − p̃(t)) − (B Φ)ᵀ (f(d(t), ḋ(t)) − f̃(t))      ~: straight in the step
//! ë + D ė + Ω² e = δ                                            e: what it would have moved
//! ```
//!
//! A run and its companion that are both too coarse for a mode agree by chance, or because neither sees what is between
//! the ends of its steps. δ is evaluated between them, as often as the modes need.
//!
//! A law with a memory ends a step elsewhere where it is led along the motion inside than where the run leads it, by the
//! ends alone. That stays: its history goes on beside the run, and what its force is away from that of the run at the
//! end of a step is an error of that force. It does not drive e, which nothing would hold then: the link itself answers
//! to it, and e knows no links. Where a link is so stiff that it turns the motion within a step, the motion inside says
//! nothing of its path, and its history is that of the run.
//!
//! In a flight, where no link answers, δ is what the loads bend between the ends of a step: a parabola, of which one evaluation
//! says all, so that the evaluations of a run last for long flights. An error of 10⁻⁴ of the velocity that is there at the
//! start of one decides when the flight ends.
//!
//! Reference: defect as an estimate of the global error \[Zadunaisky 1976; Shampine 2005\].

use crate::fna::Modes;
use crate::kernel::LawResponse;
use crate::march::Timeline;
use crate::modal::ClosedForm;
use crate::record::Outputs;
use crate::step::State;
use std::ops::Range;
use trilith_element::Kinematics;
use trilith_model::{Model, Side};
use trilith_system::{Laws, LinkBlocks, LoadSet, StepLoads, System};

/// ω Δt of a part up to which a chord of δ is good.
const SHORT: f64 = 0.78;
/// Evaluations in a step, at least and at most.
const FEWEST: usize = 4;
/// The least where no link answers.
const FEWEST_IN_FLIGHT: usize = 2;
const MOST: usize = 32;
/// Evaluations in all steps of a run, at least; more where modes and links are few: so many, times their number.
const LOOKS: usize = 1_000;
const OF_ALL: usize = 64_000;
/// Segments of the timeline up to which a run is evaluated between its ends.
const SEGMENTS: usize = 500;
/// Stiffness of a link, times how far the structure yields to it in a step, up to which its history goes on beside that
/// of the run: a force that is off moves the link less than it is off itself.
const YIELDS: f64 = 1.0;

/// The motion that δ makes, beside a run.
pub(crate) struct Defect<'a> {
    system: &'a System,
    loads: &'a LoadSet,
    laws: Laws<'a>,
    blocks: LinkBlocks,
    modes: Modes,
    form: ClosedForm,
    fastest: f64,
    outputs: Outputs,
    /// Where the run was last, and when.
    from: State,
    t: f64,
    /// e, ė and ë.
    error: Vec<f64>,
    /// History of the links along the motion inside the steps.
    history: Vec<f64>,
    /// What that makes of their forces at the end of the last step beyond those of the run, flat.
    behind: Vec<f64>,
    left: usize,
    with: State,
    values: Vec<f64>,
    /// Largest share of it in every output.
    pub most: Vec<f64>,
}

impl<'a> Defect<'a> {
    /// True where output steps are few: many are short for what moves there, and a companion sees the rest.
    pub(crate) fn is_worth(timeline: &Timeline, mut steps: Range<usize>) -> bool {
        let mut segments = 0;
        steps.all(|step| {
            segments += timeline.pieces(step).count();
            segments <= SEGMENTS
        })
    }

    /// Beside a run on these modes that starts from this state at `t`.
    pub(crate) fn new(
        model: &'a Model,
        system: &'a System,
        loads: &'a LoadSet,
        modes: Modes,
        t: f64,
        state: &State,
    ) -> Self {
        let form = modes.closed_form();
        let size = form.omega.len() + state.d.len();
        let laws = system.links.laws(model);
        Self {
            system,
            loads,
            blocks: LinkBlocks::of(laws.iter().map(|(_, link)| link)),
            laws,
            fastest: form.omega.iter().copied().fold(0.0, f64::max),
            form,
            outputs: Outputs::new(model, system, &modes.space),
            error: vec![0.0; state.motion.len()],
            history: state.history.clone(),
            behind: vec![0.0; state.f.len()],
            from: state.clone(),
            with: state.clone(),
            t,
            left: LOOKS.max(OF_ALL / size.max(1)),
            values: vec![0.0; model.outputs.len()],
            most: vec![0.0; model.outputs.len()],
            modes,
        }
    }

    /// Takes note of a state that was reached otherwise than by a step.
    pub(crate) fn note(&mut self, t: f64, state: &State) {
        self.from.clone_from(state);
        self.t = t;
    }

    /// Amplitudes of the loads at a time inside a step, or at its end.
    fn amplitudes(&self, t: f64) -> StepLoads {
        let mut all = StepLoads::default();
        self.loads.step(self.t, t, &mut all);
        all
    }

    /// Follows the run to a state that it has accepted.
    pub(crate) fn follow(&mut self, t: f64, state: &State) {
        let length = t - self.t;
        if self.left == 0 || length <= 0.0 {
            return self.note(t, state);
        }
        let flight = self.from.f.iter().chain(&state.f).all(|f| *f == 0.0);
        let fewest = if flight { FEWEST_IN_FLIGHT } else { FEWEST };
        let parts = ((self.fastest * length / SHORT).ceil() as usize).clamp(fewest, MOST);
        // So many times the area of the chords of a parabola is its own.
        let round = if flight { 1.0 + ((parts * parts - 1) as f64).recip() } else { 1.0 };
        self.left = self.left.saturating_sub(parts);
        let n = self.modes.space.order();
        let mut inside = self.form.inside(&self.from.motion, &state.motion, length, parts);
        // A step by another rule has no closed form.
        let known = !inside.is_empty();
        inside.push(state.motion.clone());
        let (mut before, mut source) = (vec![0.0; n], vec![0.0; n]);
        let active = self.system.links.active.len();
        let mut missed = vec![0.0; active];
        let mut history = std::mem::take(&mut self.history);
        if !known {
            for _ in 0..parts {
                self.form.go_on(&mut self.error, [&before, &source]);
            }
            let (to, from) = ((&*state.d, &*state.v), (&*self.from.d, &*self.from.v));
            self.evaluate(to, from, length, &mut history, &mut missed, |i| {
                state.f[i] + self.behind[i]
            });
            self.keep(history, &missed, length, state);
            return self.note(t, state);
        }
        let ends = self.amplitudes(t);
        let (mut d0, mut v0) = (self.from.d.clone(), self.from.v.clone());
        let (mut of_motion, mut of_rates) = (vec![0.0; active], vec![0.0; active]);
        let mut spread = vec![0.0; n];
        for (i, motion) in inside.iter().enumerate() {
            let share = (i + 1) as f64 / parts as f64;
            let at = if i + 1 == parts { t } else { self.t + share * length };
            let now = self.amplitudes(at);
            let (mut d, mut v) = (vec![0.0; d0.len()], vec![0.0; v0.len()]);
            self.loads.support_deformation(&now.end, &mut d, &mut v);
            let links = &self.modes.space.links;
            links.deform(&motion[..n], &mut of_motion);
            links.deform(&motion[n..2 * n], &mut of_rates);
            for (a, flat) in self.system.links.active.iter().enumerate() {
                d[*flat] += of_motion[a];
                v[*flat] += of_rates[a];
            }
            missed.fill(0.0);
            self.evaluate(
                (&d, &v),
                (&d0, &v0),
                length / parts as f64,
                &mut history,
                &mut missed,
                |i| {
                    let linear = |x: &[f64], y: &[f64]| x[i] + share * (y[i] - x[i]);
                    let way = d[i] - linear(&self.from.d, &state.d);
                    let run = linear(&self.from.f, &state.f) + self.system.links.effective[i] * way;
                    // From the start of the step on, only what is new drives e.
                    run + self.behind[i]
                },
            );
            links.spread_into(&missed, &mut spread);
            let curved = now.end.iter().zip(ends.start.iter().zip(&ends.end));
            let curved: Vec<f64> = curved.map(|(x, (a, b))| x - (a + share * (b - a))).collect();
            self.modes.space.force_into(&curved, &mut source);
            source.iter_mut().zip(&spread).for_each(|(s, x)| *s = round * (*s - x));
            self.form.go_on(&mut self.error, [&before, &source]);
            std::mem::swap(&mut before, &mut source);
            (d0, v0) = (d, v);
        }
        self.keep(history, &missed, length, state);
        self.note(t, state);
    }

    /// Keeps the history of the links at the end of a step, and what it adds to their forces there; that of the run
    /// where a link is too stiff.
    fn keep(&mut self, history: Vec<f64>, missed: &[f64], length: f64, state: &State) {
        self.history = history;
        let links = &self.modes.space.links;
        let active = &self.system.links.active;
        // Without a history, what is off there is what the link equations leave.
        for link in self.system.links.links.iter().filter(|link| !link.history.is_empty()) {
            let before = |i: usize| active.partition_point(|flat| *flat < i);
            let own = before(link.range.start)..before(link.range.end);
            let ratio = |a: usize| state.stiffest[a] * self.form.yields(links.row(a), length);
            let soft = own.clone().all(|a| ratio(a) <= YIELDS);
            for a in own {
                let behind = &mut self.behind[active[a]];
                *behind = if soft { *behind + missed[a] } else { 0.0 };
            }
            if !soft {
                let of = link.history.clone();
                self.history[of.clone()].copy_from_slice(&state.history[of]);
            }
        }
    }

    /// The forces of the links beyond known ones of each flat coordinate, active ones; their history goes on.
    fn evaluate(
        &self,
        (d, v): (&[f64], &[f64]),
        (d0, v0): (&[f64], &[f64]),
        dt: f64,
        history: &mut [f64],
        missed: &mut [f64],
        known: impl Fn(usize) -> f64,
    ) {
        let mut answer = LawResponse::default();
        for (law, link) in self.laws.iter() {
            let r = link.range.clone();
            let at = Kinematics::new(
                [&d[r.clone()], &v[r.clone()]],
                [&d0[r.clone()], &v0[r.clone()]],
                dt,
            );
            let own = &mut history[link.history.clone()];
            answer.of((law, link), &at, own);
            own.copy_from_slice(&answer.history);
            for (i, f) in r.zip(&answer.f) {
                if let Ok(a) = self.system.links.active.binary_search(&i) {
                    missed[a] = f - known(i);
                }
            }
        }
    }

    /// What it makes of the outputs of the run, which are these in this state.
    pub(crate) fn compare(&mut self, values: &[f64], state: &State) {
        let n = self.modes.space.order();
        let links = &self.modes.space.links;
        self.with.clone_from(state);
        self.with.motion.iter_mut().zip(&self.error).for_each(|(x, e)| *x += e);
        let mut own = vec![0.0; self.system.links.active.len()];
        links.deform(&self.error[..n], &mut own);
        self.system.links.active.iter().zip(&own).for_each(|(i, x)| self.with.d[*i] += x);
        links.deform(&self.error[n..2 * n], &mut own);
        self.system.links.active.iter().zip(&own).for_each(|(i, x)| self.with.v[*i] += x);
        let State { d, v, f, .. } = &mut self.with;
        self.blocks.add_change(&state.tangents.k, [&state.d, d], f);
        self.blocks.add_change(&state.tangents.c, [&state.v, v], f);
        f.iter_mut().zip(&self.behind).for_each(|(f, x)| *f += x);
        self.outputs.at((self.t, Side::Before), &self.with, self.loads).values(&mut self.values);
        for (most, (a, b)) in self.most.iter_mut().zip(self.values.iter().zip(values)) {
            *most = most.max((a - b).abs());
        }
    }
}

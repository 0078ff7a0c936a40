//! Derivatives of outputs: histories, extremes, values at the end.

use super::around::weighted;
use super::influence::Influence;
use crate::record::{Outputs, Row, move_derived};
use crate::step::State;
use trilith_model::{Combine, Side};
use trilith_system::LoadSet;

/// Derivatives of all outputs of a run.
#[derive(Clone, Debug, Default)]
pub struct Gradient {
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Their values, SI.
    pub values: Vec<f64>,
    /// Output times, s.
    pub time: Vec<f64>,
    /// The outputs, in the order of the model.
    pub outputs: Vec<OutputGradient>,
    /// What the links have turned into heat until the end, in the order of the model.
    pub heat: Vec<HeatGradient>,
    /// What loads and moving supports have put in until the end, J, and its derivatives by each parameter, where they are wanted: `input` of the
    /// summary. Constant loads are none of it.
    pub input: Option<(f64, Vec<f64>)>,
    /// Substeps that were accepted.
    pub substeps: usize,
    /// Links whose laws bend where substeps of the run have ended: what they do to derivatives is that of one side.
    pub bends: Vec<super::Bend>,
    /// What the steps were, for runs over the same ones.
    pub(super) steps: Vec<super::replay::Step>,
}

impl Gradient {
    /// What all links together have turned into heat until the end, J, and its derivatives by each parameter.
    #[must_use]
    pub fn all_heat(&self) -> (f64, Vec<f64>) {
        let mut by = vec![0.0; self.parameters.len()];
        for link in &self.heat {
            by.iter_mut().zip(&link.by).for_each(|(sum, x)| *sum += x);
        }
        (self.heat.iter().map(|link| link.heat).sum(), by)
    }
}

/// What a link has turned into heat until the end of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatGradient {
    /// Name of the link.
    pub link: String,
    /// Heat of friction, yielding and rate-dependent forces, J: `link_energy` of the summary, hysteretic and viscous together.
    pub heat: f64,
    /// Its derivatives by each parameter.
    pub by: Vec<f64>,
}

/// Derivatives of an output.
#[derive(Clone, Debug)]
pub struct OutputGradient {
    /// Its name.
    pub name: String,
    /// Values at the output times.
    pub history: Vec<f64>,
    /// Derivatives of these by each parameter.
    pub by: Vec<Vec<f64>>,
    /// The largest value at the end of a substep.
    pub max: Extreme,
    /// The smallest.
    pub min: Extreme,
}

impl OutputGradient {
    /// The largest magnitude: that of the largest or of the smallest value.
    #[must_use]
    pub fn peak(&self) -> Extreme {
        if self.max.value.abs() >= self.min.value.abs() {
            return self.max.clone();
        }
        let Extreme { t, step, value, by } = self.min.clone();
        Extreme { t, step, value: -value, by: by.iter().map(|x| -x).collect() }
    }

    /// The value at the end.
    #[must_use]
    pub fn last(&self) -> Option<(f64, Vec<f64>)> {
        let by = self.by.iter().map(|by| by.last().copied());
        Some((*self.history.last()?, by.collect::<Option<_>>()?))
    }
}

/// An extreme of an output, and how it moves: as the history does at its time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extreme {
    /// Time, s.
    pub t: f64,
    /// Index of the substep at whose end it is, counted from 1; 0: the start.
    pub step: usize,
    /// Value.
    pub value: f64,
    /// Derivatives by each parameter.
    pub by: Vec<f64>,
}

/// Follows the outputs of a run.
pub(super) struct Follower<'a> {
    outputs: Outputs,
    loads: &'a LoadSet,
    influences: &'a [Influence<'a>],
    none: LoadSet,
    values: Vec<f64>,
    /// Derivatives of all outputs now, by each parameter.
    moves: Vec<Vec<f64>>,
}

impl<'a> Follower<'a> {
    pub(super) fn new(
        outputs: Outputs,
        loads: &'a LoadSet,
        influences: &'a [Influence<'a>],
    ) -> Self {
        let count = outputs.rows.len();
        Self {
            outputs,
            loads,
            influences,
            none: LoadSet::default(),
            values: vec![0.0; count],
            moves: vec![vec![0.0; count]; influences.len()],
        }
    }

    /// A state, and its derivatives; `whole`: at an output time.
    pub(super) fn see(
        &mut self,
        (t, step): (f64, usize),
        state: &State,
        moves: &[State],
        whole: bool,
        to: &mut Gradient,
    ) {
        self.outputs.at((t, Side::Before), state, self.loads).values(&mut self.values);
        let beyond = |g: &OutputGradient, x: f64| [x > g.max.value, x < g.min.value];
        let is_new = |(g, x): (&OutputGradient, &f64)| step == 0 || beyond(g, *x) != [false; 2];
        if !whole && !to.outputs.iter().zip(&self.values).any(is_new) {
            return;
        }
        self.derive(t, state, moves);
        if whole {
            to.time.push(t);
        }
        for (o, g) in to.outputs.iter_mut().enumerate() {
            let value = self.values[o];
            let [more, less] = beyond(g, value);
            for (extreme, is_new) in [(&mut g.max, more), (&mut g.min, less)] {
                if step == 0 || is_new {
                    let by = self.moves.iter().map(|m| m[o]).collect();
                    *extreme = Extreme { t, step, value, by };
                }
            }
            if whole {
                g.history.push(value);
                g.by.iter_mut().zip(&self.moves).for_each(|(by, m)| by.push(m[o]));
            }
        }
    }

    /// Derivatives of all outputs: what the state gives them, and what rows and loads do themselves.
    fn derive(&mut self, t: f64, state: &State, moves: &[State]) {
        let Self { outputs, influences, none, values, moves: to, .. } = self;
        for ((influence, moves), to) in influences.iter().zip(moves).zip(to) {
            // Rows are linear in the state; loads have their share below.
            outputs.at((t, Side::Before), moves, none).values(to);
            if let Some(around) = &influence.outputs {
                let all = [0, 1, 2, 3].map(|i| {
                    let (outputs, loads) = &around[i];
                    let mut own = vec![0.0; values.len()];
                    let there = influence.turns.as_ref().map(|turns| turns[i].state(state));
                    let state = there.as_ref().unwrap_or(state);
                    outputs.at((t, Side::Before), state, loads).values(&mut own);
                    own
                });
                let own = weighted(influence.step, [0, 1, 2, 3].map(|i| &all[i][..]));
                to.iter_mut().zip(own).for_each(|(to, x)| *to += x);
            }
            for (o, row) in outputs.rows.iter().enumerate() {
                match row {
                    Row::Combination { how, terms, .. } => {
                        to[o] = combined(*how, terms, values, to);
                    }
                    // Those without derivatives have none here.
                    Row::Derived { output, of } => {
                        let own = move_derived(output.as_ref(), of, values, to);
                        to[o] = own.unwrap_or(f64::NAN);
                    }
                    _ => {}
                }
            }
        }
    }
}

/// Derivative of outputs put together.
fn combined(how: Combine, terms: &[(usize, f64)], values: &[f64], moves: &[f64]) -> f64 {
    let parts = || terms.iter().map(|(i, factor)| (factor * values[*i], factor * moves[*i]));
    let first = |of: fn(&f64, &f64) -> bool| {
        parts().reduce(|a, b| if of(&b.0, &a.0) { b } else { a }).map_or(0.0, |p| p.1)
    };
    match how {
        Combine::Sum => parts().map(|p| p.1).sum(),
        Combine::Norm => {
            let size = parts().map(|p| p.0 * p.0).sum::<f64>().sqrt();
            let along: f64 = parts().map(|(x, by)| x * by).sum();
            if size > 0.0 { along / size } else { 0.0 }
        }
        Combine::Largest => first(f64::gt),
        Combine::Smallest => first(f64::lt),
    }
}

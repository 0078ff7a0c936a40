//! The recorded quantities of a model, as rows over the coordinates of a solver.

use super::rows::{Internal, Maker, Row, sum};
use crate::step::State;
use crate::structure::ReducedSystem;
use std::ops::Range;
use trilith_element::DerivedOutput;
use trilith_linalg::{Dense, Product};
use trilith_model::{Combine, Model, Side};
use trilith_system::{LoadSet, System};

/// Full nodal rows of one order, one after the other.
struct Run {
    rows: Range<usize>,
    order: usize,
    own: Product,
}

impl Run {
    /// All of them.
    fn of(rows: &[Row], order: usize) -> Vec<Self> {
        let full = |row: &Row| match row {
            Row::Nodal { order: of, own, support, base } => {
                let alone = support.is_empty() && *base == [0.0; 3];
                (alone && own.len() == order).then_some(*of)
            }
            _ => None,
        };
        let mut runs = Vec::new();
        let mut start = 0;
        for group in rows.chunk_by(|a, b| full(a).is_some() && full(a) == full(b)) {
            let range = start..start + group.len();
            start = range.end;
            let Some(of) = group.first().and_then(full) else { continue };
            let mut own = Dense::zeros(group.len(), order);
            for (j, row) in group.iter().enumerate() {
                if let Row::Nodal { own: terms, .. } = row {
                    terms.iter().for_each(|(i, c)| own[(j, *i)] += c);
                }
            }
            let own = Product::new(own);
            runs.push(Self { rows: range, order: of, own });
        }
        runs
    }
}

/// Deformations of links in rows that follow each other, as their flat coordinates do.
struct Deformations {
    rows: Range<usize>,
    /// Coordinate of the first.
    flat: usize,
    factor: f64,
}

impl Deformations {
    /// Those among the rows.
    fn of(rows: &[Row]) -> Vec<Self> {
        let mut all: Vec<Self> = Vec::new();
        for (i, row) in rows.iter().enumerate() {
            let Row::Deformation { flat, factor } = row else { continue };
            let joins = |last: &&mut Self| {
                (last.rows.end, last.flat + last.rows.len(), last.factor) == (i, *flat, *factor)
            };
            match all.last_mut().filter(joins) {
                Some(last) => last.rows.end += 1,
                None => all.push(Self { rows: i..i + 1, flat: *flat, factor: *factor }),
            }
        }
        all
    }

    /// Out of the values of all flat coordinates.
    fn put(&self, flat: &[f64], to: &mut [f64]) {
        let Self { rows, flat: first, factor } = self;
        let own = &flat[*first..*first + rows.len()];
        to[rows.clone()].iter_mut().zip(own).for_each(|(to, x)| *to = factor * x);
    }
}

/// All outputs of a model.
pub(crate) struct Outputs {
    pub(crate) rows: Vec<Row>,
    /// Nodal rows of one order that follow each other, where they are full and nothing else adds to them.
    runs: Vec<Run>,
    /// Deformations of links.
    deformations: Vec<Deformations>,
    /// All other rows.
    others: Vec<usize>,
    /// What deformations of links take from the motion, row by row; empty for other rows.
    stretch: Vec<Vec<(usize, f64)>>,
    prescribed: usize,
    order: usize,
    /// True where an output needs moving supports, or for the acceleration of the base.
    supported: bool,
    absolute: bool,
    /// Number of load patterns, where loads along members have a share in an output.
    loaded: Option<usize>,
}

impl Outputs {
    pub(crate) fn new(model: &Model, system: &System, space: &ReducedSystem) -> Self {
        let maker = Maker { model, system, space };
        let rows: Vec<Row> = model.outputs.iter().map(|o| maker.row(&o.quantity)).collect();
        let supported = rows.iter().any(Row::is_supported);
        let absolute =
            rows.iter().any(|r| matches!(r, Row::Nodal { base, .. } if *base != [0.0; 3]));
        let loaded = rows.iter().any(Row::is_loaded).then_some(model.patterns.len());
        let prescribed = system.reduction.prescribed.len();
        let runs = Run::of(&rows, space.order());
        let in_run = |i: &usize| runs.iter().any(|run| run.rows.contains(i));
        let deformations = Deformations::of(&rows);
        let is_other = |i: &usize| !in_run(i) && !matches!(rows[*i], Row::Deformation { .. });
        let others = (0..rows.len()).filter(is_other).collect();
        let stretch = rows.iter().map(|row| maker.stretch(row)).collect();
        Self {
            rows,
            runs,
            deformations,
            others,
            stretch,
            prescribed,
            order: space.order(),
            supported,
            absolute,
            loaded,
        }
    }

    /// True where loads along members have a share in an output.
    pub(crate) fn is_loaded(&self) -> bool {
        self.loaded.is_some()
    }

    /// What each output takes from each of so many modes, by displacement, velocity and acceleration.
    pub(crate) fn shares(&self, modes: usize) -> Vec<[Vec<f64>; 3]> {
        let of = |(row, stretch): (&Row, &Vec<(usize, f64)>)| {
            let mut shares = [(); 3].map(|()| vec![0.0; modes]);
            let mut add = |order: usize, terms: &[(usize, f64)]| {
                for (j, c) in terms.iter().filter(|(j, _)| *j < modes) {
                    shares[order][*j] += c;
                }
            };
            match row {
                Row::Nodal { order, own, .. } => add(*order, own),
                Row::Deformation { .. } => add(0, stretch),
                Row::Internal(Internal { stiffness, damping, .. }) => {
                    add(0, &stiffness.0);
                    add(1, &damping.0);
                }
                Row::Force { .. }
                | Row::History { .. }
                | Row::Combination { .. }
                | Row::Derived { .. } => {}
            }
            shares
        };
        self.rows.iter().zip(&self.stretch).map(of).collect()
    }

    /// What a motion gives the outputs, and their rates; not numbers where they have none.
    pub(crate) fn of_motion(&self, motion: &[f64], values: &mut [f64], rates: &mut [f64]) {
        let n = self.order;
        let motion = [&motion[..n], &motion[n..2 * n], &motion[2 * n..]];
        for (i, (row, stretch)) in self.rows.iter().zip(&self.stretch).enumerate() {
            (values[i], rates[i]) = match row {
                Row::Nodal { order, own, .. } => {
                    let rate = motion.get(order + 1).map_or(f64::NAN, |m| sum(own, m));
                    (sum(own, motion[*order]), rate)
                }
                Row::Deformation { .. } => (sum(stretch, motion[0]), sum(stretch, motion[1])),
                Row::Internal(Internal { stiffness, damping, .. }) => {
                    (sum(&stiffness.0, motion[0]) + sum(&damping.0, motion[1]), f64::NAN)
                }
                Row::Force { .. }
                | Row::History { .. }
                | Row::Combination { .. }
                | Row::Derived { .. } => (0.0, f64::NAN),
            };
        }
    }

    /// Puts those together that are made of others.
    pub(crate) fn combine(&self, values: &mut [f64], rates: &mut [f64]) {
        for (i, row) in self.rows.iter().enumerate() {
            match row {
                Row::Combination { how, constant, terms } => {
                    values[i] = combined(*how, *constant, terms, values);
                    rates[i] = rate_combined(*how, terms, values[i], values, rates);
                }
                Row::Derived { output, of } => {
                    values[i] = derived(output.as_ref(), of, values);
                    rates[i] = rate_derived(output.as_ref(), of, values, rates);
                }
                _ => {}
            }
        }
    }

    /// The outputs in a state, seen from this side where loads jump.
    #[inline]
    pub(crate) fn at<'a>(
        &'a self,
        (t, side): (f64, Side),
        state: &'a State,
        loads: &LoadSet,
    ) -> Now<'a> {
        let n = self.order;
        let motion = [&state.motion[..n], &state.motion[n..2 * n], &state.motion[2 * n..]];
        let support = if self.supported { self.supports(t, side, loads) } else { None };
        let base = match self.absolute {
            true => loads.base_acceleration(t, side),
            false => [0.0; 3],
        };
        let factors = self.loaded.map(|count| loads.factors(count, t, side));
        Now { outputs: self, state, motion, support, base, factors: factors.unwrap_or_default() }
    }

    /// Displacements, velocities and accelerations of supports.
    #[cold]
    fn supports(&self, t: f64, side: Side, loads: &LoadSet) -> Option<Box<[Vec<f64>; 3]>> {
        Some(Box::new(loads.prescribed(t, side, self.prescribed)))
    }
}

/// Outputs in a state.
pub(crate) struct Now<'a> {
    outputs: &'a Outputs,
    state: &'a State,
    /// Displacements, velocities and accelerations.
    motion: [&'a [f64]; 3],
    /// Those of supports that outputs need; mostly none, which then take no room.
    support: Option<Box<[Vec<f64>; 3]>>,
    /// Acceleration of the base.
    base: [f64; 3],
    /// How many times each load pattern acts, and the weight; none where no output needs them.
    factors: Vec<f64>,
}

impl Now<'_> {
    /// The share of moving supports in a row of this order.
    fn of_support(&self, terms: &[(usize, f64)], order: usize) -> f64 {
        self.support.as_ref().map_or(0.0, |support| sum(terms, &support[order]))
    }

    /// Values of all.
    #[inline]
    pub(crate) fn values(&self, values: &mut [f64]) {
        let Self { outputs, state, motion, base, .. } = self;
        for Run { rows, order, own } in &outputs.runs {
            own.times(motion[*order], &mut values[rows.clone()]);
        }
        outputs.deformations.iter().for_each(|some| some.put(&state.d, values));
        for i in outputs.others.iter().copied() {
            values[i] = match &outputs.rows[i] {
                Row::Nodal { order, own, support: tied, base: share } => {
                    let moving: f64 = share.iter().zip(base).map(|(a, b)| a * b).sum();
                    sum(own, motion[*order]) + self.of_support(tied, *order) + moving
                }
                // Among those above.
                Row::Deformation { .. } => continue,
                Row::Force { terms } => {
                    let parts = terms.iter().map(|(flat, factor)| factor * state.f[*flat]);
                    parts.reduce(|sum, part| sum + part).unwrap_or_default()
                }
                Row::History { at } => state.history[*at],
                Row::Combination { how, constant, terms } => {
                    combined(*how, *constant, terms, values)
                }
                Row::Derived { output, of } => derived(output.as_ref(), of, values),
                Row::Internal(force) => {
                    let motion = [motion[0], motion[1]];
                    force.at(motion, self.support.as_deref(), &state.f, &self.factors)
                }
            };
        }
    }

    /// Rates of those that have one, not numbers of the others.
    pub(crate) fn rates(&self, values: &[f64], rates: &mut [f64]) {
        let Self { outputs, state, motion, .. } = self;
        rates.fill(f64::NAN);
        for Run { rows, order, own } in &outputs.runs {
            if let Some(motion) = motion.get(order + 1) {
                own.times(motion, &mut rates[rows.clone()]);
            }
        }
        outputs.deformations.iter().for_each(|some| some.put(&state.v, rates));
        for i in outputs.others.iter().copied() {
            rates[i] = match &outputs.rows[i] {
                Row::Nodal { order, own, support: tied, .. } if *order < 2 => {
                    sum(own, motion[order + 1]) + self.of_support(tied, order + 1)
                }
                Row::Combination { how, terms, .. } => {
                    rate_combined(*how, terms, values[i], values, rates)
                }
                Row::Derived { output, of } => rate_derived(output.as_ref(), of, values, rates),
                _ => continue,
            };
        }
    }
}

/// Value of outputs put together.
fn combined(how: Combine, constant: f64, terms: &[(usize, f64)], values: &[f64]) -> f64 {
    let parts = || terms.iter().map(|(i, factor)| factor * values[*i]);
    match how {
        Combine::Sum => parts().fold(constant, |sum, x| sum + x),
        Combine::Norm => parts().map(|x| x * x).sum::<f64>().sqrt(),
        Combine::Largest => parts().fold(f64::NEG_INFINITY, f64::max),
        Combine::Smallest => parts().fold(f64::INFINITY, f64::min),
    }
}

/// Which outputs have a peak in a mode that follows its displacements: those linear in displacements, forces and absolute
/// accelerations.
pub(crate) fn has_modal_peak(outputs: &Outputs) -> Vec<bool> {
    let mut all: Vec<bool> = Vec::with_capacity(outputs.rows.len());
    for row in &outputs.rows {
        all.push(match row {
            Row::Nodal { order: 0, .. }
            | Row::Deformation { .. }
            | Row::Force { .. }
            | Row::Internal(_) => true,
            Row::Nodal { order: 2, base, .. } => *base != [0.0; 3],
            Row::Nodal { .. } | Row::History { .. } | Row::Derived { .. } => false,
            Row::Combination { how, terms, .. } => {
                *how == Combine::Sum && terms.iter().all(|(i, _)| all[*i])
            }
        });
    }
    all
}

/// Rate of outputs put together, which have this value.
fn rate_combined(
    how: Combine,
    terms: &[(usize, f64)],
    value: f64,
    values: &[f64],
    rates: &[f64],
) -> f64 {
    let parts = || terms.iter().map(|(i, factor)| (factor * values[*i], factor * rates[*i]));
    match how {
        Combine::Sum => parts().map(|p| p.1).fold(0.0, |sum, x| sum + x),
        Combine::Norm if value > 0.0 => parts().map(|(a, b)| a * b).sum::<f64>() / value,
        // Between two of the largest or the smallest a rate would bend what has a corner.
        Combine::Norm | Combine::Largest | Combine::Smallest => f64::NAN,
    }
}

/// Value of an output of another crate.
fn derived(output: &dyn DerivedOutput, of: &[usize], values: &[f64]) -> f64 {
    let of: Vec<f64> = of.iter().map(|i| values[*i]).collect();
    output.value(&of)
}

/// Its rate, where it has derivatives and they have rates.
fn rate_derived(output: &dyn DerivedOutput, of: &[usize], values: &[f64], rates: &[f64]) -> f64 {
    move_derived(output, of, values, rates).unwrap_or(f64::NAN)
}

/// How it moves where the outputs it is made of do so; none where it has no derivatives.
pub(crate) fn move_derived(
    output: &dyn DerivedOutput,
    of: &[usize],
    values: &[f64],
    moves: &[f64],
) -> Option<f64> {
    let at: Vec<f64> = of.iter().map(|i| values[*i]).collect();
    let mut by = vec![0.0; of.len()];
    let has = output.derivatives(&at, &mut by);
    has.then(|| by.iter().zip(of).map(|(by, i)| by * moves[*i]).sum())
}

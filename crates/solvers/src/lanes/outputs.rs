//! Outputs of a march: where they come from, and their extremes.

use super::integral::Integral;
use super::peaks::{Peaks, TOGETHER};
use super::plan::pick;
use super::setup::{LaneSetup, Output};
use crate::record::Peak;
use trilith_element::lanes::{Arithmetic, Real};
use trilith_model::Combine;

/// Where an output comes from.
pub(super) enum Row<R, const M: usize> {
    Displacement { own: [R; M] },
    Velocity { own: [R; M] },
    Acceleration { own: [R; M], base: Vec<R> },
    Internal { stiffness: [R; M], damping: [R; M], links: Vec<(usize, R)> },
    Deformation { at: usize, factor: R },
    Force { first: (usize, R), more: Vec<(usize, R)> },
    History { at: usize },
    Zero,
    Combination(Combination<R>),
}

/// An output that is put together from others.
pub(super) struct Combination<R> {
    how: Combine,
    constant: R,
    /// Which ones, and their factors.
    terms: Vec<(Place, R)>,
    /// All of them have a rate.
    rated: bool,
}

impl<R, const M: usize> Row<R, M> {
    /// True for what has a rate.
    fn is_rated(&self) -> bool {
        match self {
            Self::Displacement { .. } | Self::Velocity { .. } | Self::Deformation { .. } => true,
            Self::Combination(it) => it.rated && matches!(it.how, Combine::Sum | Combine::Norm),
            _ => false,
        }
    }
}

impl<R: Real> Combination<R> {
    /// Its value, and its rate where it has one; `now`: those of an output.
    #[inline(always)]
    pub fn of(&self, now: impl Fn(&Place) -> [R; 2]) -> (R, Option<[R; 1]>) {
        let zero = self.constant.of(0.0);
        let (mut y, mut rate) = (self.constant, zero);
        match self.how {
            Combine::Sum => {
                for (place, factor) in &self.terms {
                    let [x, v] = now(place);
                    (y, rate) = (y + *factor * x, rate + *factor * v);
                }
            }
            Combine::Norm => {
                let mut square = zero;
                for (place, factor) in &self.terms {
                    let [x, v] = now(place);
                    let (x, v) = (*factor * x, *factor * v);
                    (square, rate) = (square + x * x, rate + x * v);
                }
                y = square.sqrt();
                // A norm that is zero has a corner there.
                rate = (rate / y.max(zero.of(f64::MIN_POSITIVE))).only(zero.lt(y));
            }
            Combine::Largest => {
                y = zero.of(f64::NEG_INFINITY);
                for (place, factor) in &self.terms {
                    y = y.max(*factor * now(place)[0]);
                }
            }
            Combine::Smallest => {
                y = zero.of(f64::INFINITY);
                for (place, factor) in &self.terms {
                    y = y.min(*factor * now(place)[0]);
                }
            }
        }
        let rated = self.rated && matches!(self.how, Combine::Sum | Combine::Norm);
        (y, rated.then_some([rate]))
    }
}

/// Which extremes are those of an output.
#[derive(Clone, Copy)]
pub(super) enum Place {
    Alone(usize),
    /// The group, and the output in it.
    Together(usize, usize),
}

/// Where the outputs come from.
pub(super) struct Outputs<R, const M: usize> {
    /// Those that are looked at one by one.
    pub alone: Vec<Row<R, M>>,
    /// Displacements, [`TOGETHER`] side by side: what they take from each mode. Where an analysis goes alone they
    /// fill a register.
    pub together: Vec<[[R; TOGETHER]; M]>,
    places: Vec<Place>,
}

/// Extremes of all outputs.
#[derive(Clone)]
pub(super) struct Extremes<R> {
    pub alone: Vec<Peaks<R, 1>>,
    pub together: Vec<Peaks<R, TOGETHER>>,
    places: Vec<Place>,
    /// What is taken over time, and of which output.
    pub integrals: Vec<(Place, Integral<R>)>,
}

impl<R: Real, const M: usize> Outputs<R, M> {
    /// Of the setups; `places` says where their link coordinates lie.
    pub fn new<A: Arithmetic<Real = R>>(with: A, setups: &[&LaneSetup], places: &[usize]) -> Self {
        let one = setups[0];
        let zero = with.splat(0.0);
        let modes = one.shape.modes;
        let get = |of: &dyn Fn(&LaneSetup) -> f64| pick(with, setups, of);
        let rows = |of: &dyn Fn(&LaneSetup) -> Vec<f64>, len: usize| -> Vec<R> {
            let all: Vec<Vec<f64>> = setups.iter().map(|s| of(s)).collect();
            let last = all.len() - 1;
            (0..len).map(|j| with.gather(|i| all[i.min(last)][j])).collect()
        };
        let modal = |of: &dyn Fn(&LaneSetup) -> Vec<f64>| -> [R; M] {
            let mut all = [zero; M];
            all[..modes].copy_from_slice(&rows(of, modes));
            all
        };
        let mut rated: Vec<bool> = Vec::new();
        let row = |o: usize, before: &[Place], rated: &[bool]| match &one.outputs[o] {
            Output::Motion { order, base, .. } => {
                let own = modal(&|s| s.outputs[o].own().to_vec());
                match order {
                    0 => Row::Displacement { own },
                    1 => Row::Velocity { own },
                    _ => Row::Acceleration {
                        own,
                        base: rows(&|s| s.outputs[o].base().to_vec(), base.len()),
                    },
                }
            }
            Output::Internal { links, .. } => {
                let term = |k: usize| (places[links[k].0], get(&|s| s.outputs[o].terms()[k].1));
                Row::Internal {
                    stiffness: modal(&|s| s.outputs[o].own().to_vec()),
                    damping: modal(&|s| s.outputs[o].base().to_vec()),
                    links: (0..links.len()).map(term).collect(),
                }
            }
            Output::Deformation { at, .. } => {
                Row::Deformation { at: places[*at], factor: get(&|s| s.outputs[o].factor()) }
            }
            Output::Force { terms } => {
                let term = |k: usize| (places[terms[k].0], get(&|s| s.outputs[o].terms()[k].1));
                Row::Force { first: term(0), more: (1..terms.len()).map(term).collect() }
            }
            Output::History { at } => Row::History { at: *at },
            Output::Zero => Row::Zero,
            Output::Combination { how, terms, .. } => {
                let term = |k: usize| {
                    let (output, _) = terms[k];
                    (before[output], get(&|s| s.outputs[o].terms()[k].1))
                };
                Row::Combination(Combination {
                    how: *how,
                    constant: get(&|s| s.outputs[o].factor()),
                    terms: (0..terms.len()).map(term).collect(),
                    rated: terms.iter().all(|(output, _)| rated[*output]),
                })
            }
        };
        let mut own = Self { alone: Vec::new(), together: Vec::new(), places: Vec::new() };
        let mut free = TOGETHER;
        for o in 0..one.outputs.len() {
            let row = row(o, &own.places, &rated);
            rated.push(row.is_rated());
            match row {
                Row::Displacement { own: modes } if A::WIDTH == 1 => {
                    if free == TOGETHER {
                        own.together.push([[zero; TOGETHER]; M]);
                        free = 0;
                    }
                    let group = own.together.len() - 1;
                    for (to, from) in own.together[group].iter_mut().zip(modes) {
                        to[free] = from;
                    }
                    own.places.push(Place::Together(group, free));
                    free += 1;
                }
                row => {
                    own.places.push(Place::Alone(own.alone.len()));
                    own.alone.push(row);
                }
            }
        }
        own
    }

    /// Extremes at the start.
    pub fn extremes<A: Arithmetic<Real = R>>(&self, with: A, setups: &[&LaneSetup]) -> Extremes<R> {
        let zero = with.splat(0.0);
        let mut alone = vec![([zero; 1], [zero; 1]); self.alone.len()];
        let mut together = vec![([zero; TOGETHER], [zero; TOGETHER]); self.together.len()];
        for (o, place) in self.places.iter().enumerate() {
            let y = pick(with, setups, &|s| s.values[o]);
            // Where there is none it is not a number.
            let rate = pick(with, setups, &|s| if s.rates[o].is_nan() { 0.0 } else { s.rates[o] });
            match *place {
                Place::Alone(i) => alone[i] = ([y], [rate]),
                Place::Together(i, k) => (together[i].0[k], together[i].1[k]) = (y, rate),
            }
        }
        let integral = |(o, above): &(usize, Option<f64>)| {
            (self.places[*o], Integral::new(pick(with, setups, &|s| s.values[*o]), *above))
        };
        Extremes {
            integrals: setups[0].shape.integrals.iter().map(integral).collect(),
            alone: alone.into_iter().map(|(y, rate)| Peaks::new(y, rate)).collect(),
            together: together.into_iter().map(|(y, rate)| Peaks::new(y, rate)).collect(),
            places: self.places.clone(),
        }
    }
}

impl<R: Real> Extremes<R> {
    /// Takes the other where the mask says no.
    #[inline(always)]
    pub fn keep(&mut self, mask: R::Mask, other: &Self) {
        for (x, y) in self.alone.iter_mut().zip(&other.alone) {
            x.keep(mask, y);
        }
        for (x, y) in self.together.iter_mut().zip(&other.together) {
            x.keep(mask, y);
        }
        for ((_, x), (_, y)) in self.integrals.iter_mut().zip(&other.integrals) {
            x.keep(mask, y);
        }
    }

    /// What is taken over time goes on over a step.
    #[inline(always)]
    pub fn integrate(&mut self, dt: R) {
        for (place, integral) in &mut self.integrals {
            let [y, _] = match *place {
                Place::Alone(i) => self.alone[i].now(0),
                Place::Together(i, k) => self.together[i].now(k),
            };
            integral.advance(dt, y);
        }
    }

    /// Of a lane, in the order of the model.
    pub fn of_lane<A: Arithmetic<Real = R>>(&self, with: A, lane: usize) -> Vec<Peak> {
        let one = |place: &Place| match *place {
            Place::Alone(i) => self.alone[i].of_lane(with, 0, lane),
            Place::Together(i, k) => self.together[i].of_lane(with, k, lane),
        };
        self.places.iter().map(one).collect()
    }
}

impl Output {
    fn own(&self) -> &[f64] {
        match self {
            Self::Motion { own, .. } => own,
            Self::Internal { stiffness, .. } => stiffness,
            _ => &[],
        }
    }

    fn base(&self) -> &[f64] {
        match self {
            Self::Motion { base, .. } => base,
            Self::Internal { damping, .. } => damping,
            _ => &[],
        }
    }

    fn factor(&self) -> f64 {
        match self {
            Self::Deformation { factor, .. } => *factor,
            Self::Combination { constant, .. } => *constant,
            _ => 0.0,
        }
    }

    fn terms(&self) -> &[(usize, f64)] {
        match self {
            Self::Combination { terms, .. }
            | Self::Force { terms }
            | Self::Internal { links: terms, .. } => terms,
            _ => &[],
        }
    }
}

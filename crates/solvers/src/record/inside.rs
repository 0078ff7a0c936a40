//! What outputs do inside long steps.
//!
//! Extremes between two moments are those of the cubic through values and rates. That is good for a swing while
//! the step is short beside its period, (ω Δt)⁴/384 of its amplitude; beyond a period it is nonsense. FNA has no
//! other reason to shorten its steps where nothing but the structure moves, so outputs are evaluated inside a step
//! as often as the modes need that swing visibly there. The motion is known in closed form: no step is
//! made for it.

use super::outputs::Outputs;
use crate::modal::ClosedForm;
use crate::vector::dot;

/// Share of an extreme that may be missed where a cubic goes between two moments.
const CUBIC: f64 = 1e-3;
/// The same where nothing goes between them: accelerations.
const SAMPLED: f64 = 0.05;
/// ω Δt below which the cubic errs by less than a thousandth, whatever swings.
const SHORT: f64 = 0.78;
/// Share of the largest motion below which a swing is rounding.
const ROUNDING: f64 = 1e-9;
/// Lengths of steps that differ by less than this share are one, and lengths that are kept at most.
const SAME: f64 = 1e-9;
const KEPT: usize = 16;
/// How much further than a swing its bound is set, as a factor of squares.
const ROOM: f64 = 1.5;
/// Evaluations inside a step at most, as a power of two.
const MOST: u32 = 10;

/// Evaluates outputs inside the steps of FNA.
pub(super) struct Inside {
    form: ClosedForm,
    fastest: f64,
    /// The motion shown last.
    from: Vec<f64>,
    /// What outputs take from each mode, by displacement, velocity and acceleration.
    shares: Vec<[Vec<f64>; 3]>,
    /// Swing of each mode in the step evaluated last, and what outputs miss of it in steps of some lengths.
    swing: Vec<f64>,
    missed: Vec<Missed>,
    /// Largest value of each output so far, and after them the largest motion.
    pub largest: Vec<f64>,
}

/// What outputs miss in steps of one length.
struct Missed {
    length: f64,
    /// What every output misses of a unit of the swing of each mode: by cubics, and in accelerations.
    shares: Vec<[Vec<f64>; 2]>,
    /// Squares that no mode's swing has exceeded so far, and what outputs miss of those: most steps are told by it.
    bounds: Vec<f64>,
    most: Vec<[f64; 2]>,
}

impl Missed {
    /// Takes note of the square of a mode's swing; true where it exceeds what is known.
    #[inline]
    fn exceeds(&mut self, mode: usize, square: f64) -> bool {
        // What is no number is not within.
        let within = square <= self.bounds[mode];
        if !within {
            self.bounds[mode] = ROOM * square;
        }
        !within
    }

    /// What outputs miss of swings within the bounds.
    fn bound(&mut self) {
        let swings: Vec<f64> = self.bounds.iter().map(|square| square.sqrt()).collect();
        self.most.clear();
        self.most.extend(self.shares.iter().map(|of| [0, 1].map(|i| dot(&of[i], &swings))));
    }
}

/// A moment inside a step: share of it, and values and rates that the motion gives the outputs.
pub(super) struct Moment {
    pub share: f64,
    pub values: Vec<f64>,
    pub rates: Vec<f64>,
}

impl Inside {
    /// True where some mode may swing visibly within a step of this length.
    pub(crate) fn is_worth(form: &ClosedForm, length: f64) -> bool {
        form.omega.iter().any(|w| w * length > SHORT)
    }

    pub(crate) fn new(form: ClosedForm, outputs: &Outputs, largest: Vec<f64>) -> Self {
        let mut shares = outputs.shares(form.omega.len());
        shares.iter_mut().flatten().flatten().for_each(|share| *share = share.abs());
        let fastest = form.omega.iter().copied().fold(0.0, f64::max);
        let count = shares.len() + 1;
        let largest = if largest.len() == count { largest } else { vec![0.0; count] };
        let (from, swing, missed) = (Vec::new(), Vec::new(), Vec::new());
        Self { form, fastest, from, shares, swing, missed, largest }
    }

    /// Takes note of a state that is shown.
    pub(crate) fn note(&mut self, motion: &[f64], values: &[f64]) {
        self.from.clear();
        self.from.extend_from_slice(motion);
        let size = motion[..motion.len() / 3].iter().map(|q| q * q).sum::<f64>().sqrt();
        for (most, y) in self.largest.iter_mut().zip(values.iter().copied().chain([size])) {
            if y.is_finite() {
                *most = most.max(y.abs());
            }
        }
    }

    /// Parts into which a step must be divided for an evaluation of the outputs, 1 where its ends will do; and whether
    /// cubics are good between these.
    fn parts(&mut self, to: &[f64], length: f64, values: &[f64]) -> (usize, bool) {
        let at = self.missed_of(length);
        let Self { form, missed, .. } = self;
        let (own, mut grows) = (&mut missed[at], false);
        for (j, w) in form.omega.iter().enumerate() {
            if w * length > SHORT {
                grows |= own.exceeds(j, form.swing_square(j, &self.from, to, length));
            }
        }
        if grows {
            own.bound();
        }
        let few = |(([cubic, sampled], most), y): ((&[f64; 2], &f64), &f64)| {
            let most = most.max(y.abs()) * (1.0 - ROUNDING);
            *cubic <= CUBIC * most && *sampled <= SAMPLED * most
        };
        if own.most.iter().zip(&self.largest).zip(values).all(few) {
            return (1, true);
        }
        let nothing = ROUNDING * self.largest.last().copied().unwrap_or(0.0);
        self.swing.clear();
        for (j, w) in self.form.omega.iter().enumerate() {
            let fast = *w * length > SHORT;
            let swing =
                if fast { self.form.swing_square(j, &self.from, to, length).sqrt() } else { 0.0 };
            self.swing.push(if swing > nothing { swing } else { 0.0 });
        }
        if self.enough(&self.missed[at].shares, values) {
            return (1, true);
        }
        let enough = |i: &u32| self.enough(&self.missed_in(length / f64::from(1_u32 << i)), values);
        let found = (1..=MOST).find(enough);
        (1 << found.unwrap_or(MOST), found.is_some())
    }

    /// True where no output misses too much, if it misses these shares of the swing of each mode.
    fn enough(&self, missed: &[[Vec<f64>; 2]], values: &[f64]) -> bool {
        missed.iter().zip(&self.largest).zip(values).all(|(([cubic, sampled], most), y)| {
            let most = most.max(y.abs());
            dot(cubic, &self.swing) <= CUBIC * most && dot(sampled, &self.swing) <= SAMPLED * most
        })
    }

    /// What every output misses of the swing of each mode in steps of this length: by cubics, and in accelerations.
    fn missed_in(&self, length: f64) -> Vec<[Vec<f64>; 2]> {
        let mut of_modes = Vec::with_capacity(self.form.omega.len());
        for w in &self.form.omega {
            let x = w * length;
            let cubic = (x.powi(4) / 384.0).min(1.0_f64.max(0.25 * x));
            of_modes.push((*w, cubic, (x * x / 8.0).min(1.0)));
        }
        let of_output = |[u, v, a]: &[Vec<f64>; 3]| {
            let modes = || of_modes.iter().enumerate();
            let cubic = modes().map(|(j, (w, cubic, _))| cubic * (u[j] + w * v[j]));
            let sampled = modes().map(|(j, (w, _, sampled))| sampled * w * w * a[j]);
            [cubic.collect(), sampled.collect()]
        };
        self.shares.iter().map(of_output).collect()
    }

    /// Where it is kept for steps of this length.
    fn missed_of(&mut self, length: f64) -> usize {
        let same = |known: &Missed| (known.length - length).abs() <= SAME * length;
        if let Some(at) = self.missed.iter().position(same) {
            return at;
        }
        if self.missed.len() >= KEPT {
            self.missed.remove(0);
        }
        let (shares, bounds) = (self.missed_in(length), vec![0.0; self.form.omega.len()]);
        let most = vec![[0.0; 2]; shares.len()];
        self.missed.push(Missed { length, shares, bounds, most });
        self.missed.len() - 1
    }

    /// Moments inside the step that ends with this motion and these values of the outputs; and whether the cubics
    /// between them, and between the ends where there are none, can be trusted.
    pub(crate) fn evaluate(
        &mut self,
        outputs: &Outputs,
        to: &[f64],
        length: f64,
        values: &[f64],
    ) -> (Vec<Moment>, bool) {
        if self.from.len() != to.len() || length <= 0.0 || self.fastest * length <= SHORT {
            return (Vec::new(), true);
        }
        let (parts, trusted) = self.parts(to, length, values);
        if parts == 1 {
            return (Vec::new(), trusted);
        }
        // A step by another rule has no closed form.
        let inside = self.form.inside(&self.from, to, length, parts);
        let moment = |(i, motion): (usize, &Vec<f64>)| {
            let (mut values, mut rates) = (vec![0.0; values.len()], vec![0.0; values.len()]);
            outputs.of_motion(motion, &mut values, &mut rates);
            Moment { share: (i + 1) as f64 / parts as f64, values, rates }
        };
        let moments: Vec<Moment> = inside.iter().enumerate().map(moment).collect();
        let trusted = trusted || moments.is_empty();
        (moments, trusted)
    }

    /// The motion shown last.
    pub(crate) fn from(&self) -> &[f64] {
        &self.from
    }
}

//! What outputs do inside long steps.
//!
//! Extremes between two moments are those of the cubic through values and rates. That is good for a swing while
//! the step is short beside its period, (ω Δt)⁴/384 of its amplitude; beyond a period it is nonsense. FNA has no
//! other reason to shorten its steps where nothing but the structure moves, so outputs are looked at inside a step
//! as often as the modes ask for that swing visibly there. The motion is known in closed form: no step is
//! made for it.

use crate::modal::ClosedForm;
use crate::outputs::Outputs;

/// Share of an extreme that may be missed where a cubic goes between two moments.
const CUBIC: f64 = 1e-3;
/// The same where nothing goes between them: accelerations.
const SAMPLED: f64 = 0.05;
/// ω Δt below which the cubic errs by less than a thousandth, whatever swings.
const SHORT: f64 = 0.78;
/// Share of the largest motion below which a swing is rounding.
const ROUNDING: f64 = 1e-9;
/// Looks inside a step at most, as a power of two.
const MOST: u32 = 10;

/// Looks at outputs inside the steps of FNA.
pub(crate) struct Inside {
    form: ClosedForm,
    fastest: f64,
    /// The motion shown last.
    from: Vec<f64>,
    /// What outputs take from each mode, by displacement, velocity and acceleration.
    shares: Vec<[Vec<f64>; 3]>,
    /// Largest value of each output so far, and after them the largest motion.
    pub largest: Vec<f64>,
}

/// A moment inside a step: share of it, and values and rates that the motion gives the outputs.
pub(crate) struct Moment {
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
        let shares = outputs.shares(form.omega.len());
        let fastest = form.omega.iter().copied().fold(0.0, f64::max);
        let count = shares.len() + 1;
        let largest = if largest.len() == count { largest } else { vec![0.0; count] };
        Self { form, fastest, from: Vec::new(), shares, largest }
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

    /// Parts into which a step must be divided for a look at the outputs, 1 where its ends will do; and whether
    /// cubics are good between these.
    fn parts(&self, to: &[f64], length: f64, values: &[f64]) -> (usize, bool) {
        let nothing = ROUNDING * self.largest.last().copied().unwrap_or(0.0);
        let swing = self.form.swing(&self.from, to, length);
        let fast: Vec<(usize, f64, f64)> = swing
            .zip(&self.form.omega)
            .enumerate()
            .filter(|(_, (a, w))| **w * length > SHORT && *a > nothing)
            .map(|(j, (a, w))| (j, a, *w))
            .collect();
        let enough = |parts: f64| {
            self.shares.iter().zip(&self.largest).zip(values).all(|((shares, most), y)| {
                let mut missed = [0.0; 2];
                for (j, a, w) in &fast {
                    let x = w * length / parts;
                    let cubic = (x.powi(4) / 384.0).min(1.0_f64.max(0.25 * x));
                    let sampled = (x * x / 8.0).min(1.0);
                    missed[0] += cubic * a * (shares[0][*j] + w * shares[1][*j]);
                    missed[1] += sampled * a * w * w * shares[2][*j];
                }
                let most = most.max(y.abs());
                missed[0] <= CUBIC * most && missed[1] <= SAMPLED * most
            })
        };
        let found = (0..=MOST).find(|i| enough(f64::from(1_u32 << i)));
        (1 << found.unwrap_or(MOST), found.is_some())
    }

    /// Moments inside the step that ends with this motion and these values of the outputs; and whether the cubics
    /// between them, and between the ends where there are none, can be trusted.
    pub(crate) fn look(
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

//! Lognormal fragility curves by maximum likelihood.
//!
//! P(event | im) = Φ((ln im − ln θ)/β). What is known of a capacity lies between two intensities: a run with the
//! event says that it is below, one without that it is above (Baker 2015, Earthquake Spectra 31(1), 579–599), an
//! incremental analysis that it is between two scales. With a = 1/β and b = −ln θ/β the log-likelihood
//! Σ ln(Φ(a ln high + b) − Φ(a ln low + b)) is concave in (a, b): Newton's iteration finds its one maximum, and
//! the inverse of the observed information there is the covariance of the estimates. The band is that of the
//! linear predictor, mapped by Φ.
//!
//! Runs of one motion, at other scales or with slightly other parameters, are no independent draws. Where motions
//! have several, the covariance is the sandwich A⁻¹ (Σ gᵢ gᵢᵀ) A⁻¹ G/(G − 1) with the information A and the sum gᵢ
//! of the scores of each of G motions, and the band takes Student's t with G − 1 degrees of freedom (Liang and
//! Zeger 1986, Biometrika 73(1), 13–22; Cameron and Miller 2015, Journal of Human Resources 50(2), 317–372).

use crate::distribution::{phi, phi_inverse};
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Fewest motions that their scatter is taken from.
const FEWEST: usize = 4;

/// A lognormal fragility curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragility {
    /// Median θ: intensity at which half of the runs show the event.
    pub median: f64,
    /// Dispersion β: standard deviation of ln(intensity).
    pub dispersion: f64,
    /// Covariance of the slope 1/β and of the value at ln im = `centre`.
    covariance: [[f64; 2]; 2],
    /// ln im that the predictor is counted from.
    centre: f64,
    slope: f64,
    value: f64,
    /// Runs, or series of runs, that the fit rests on.
    pub runs: usize,
    /// Motions whose scatter the band is from; none where every run counts as a draw of its own.
    pub motions: Option<usize>,
}

/// A curve and its confidence band at an intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Probability.
    pub probability: f64,
    /// Lower end of its interval.
    pub low: f64,
    /// Upper end of its interval.
    pub high: f64,
}

/// Why there is no curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FragilityError {
    /// No run, or no intensity above 0.
    #[error("no run with an intensity above 0")]
    Nothing,
    /// No run shows the event.
    #[error("the event is in none of the runs: the median is above their intensities")]
    Never,
    /// All runs show the event.
    #[error("the event is in all of the runs: the median is below their intensities")]
    Always,
    /// One intensity separates the runs with the event from those without.
    #[error(
        "one intensity parts the runs with the event from those without: the dispersion is below their distance"
    )]
    Parted,
    /// The event does not become more probable.
    #[error("the event does not become more probable with the intensity")]
    Falls,
}

/// Where the capacity of a structure lies: above `low`, up to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capacity {
    /// Largest intensity known to be borne; 0: none.
    pub low: f64,
    /// Intensity known not to be borne; ∞: none.
    pub high: f64,
}

impl Capacity {
    /// What a run at an intensity says.
    #[must_use]
    pub const fn of_outcome(intensity: f64, event: bool) -> Self {
        if event {
            Self { low: 0.0, high: intensity }
        } else {
            Self { low: intensity, high: f64::INFINITY }
        }
    }
}

impl Fragility {
    /// Fits a curve to runs of (intensity above 0, event), each with a motion of its own.
    ///
    /// # Errors
    /// As [`fit_motions`](Self::fit_motions).
    pub fn of_outcomes(runs: &[(f64, bool)]) -> Result<Self, FragilityError> {
        let known = |(im, event): &(f64, bool)| Capacity::of_outcome(*im, *event);
        Self::fit(&runs.iter().map(known).collect::<Vec<_>>())
    }

    /// Fits a curve to capacities known between two intensities each, draws of their own.
    ///
    /// # Errors
    /// As [`fit_motions`](Self::fit_motions).
    pub fn fit(capacities: &[Capacity]) -> Result<Self, FragilityError> {
        let own: Vec<_> = capacities.iter().enumerate().map(|(i, c)| (*c, i)).collect();
        Self::fit_motions(&own)
    }

    /// Fits a curve to capacities known between two intensities each, and the number of the motion of each.
    ///
    /// # Errors
    /// [`FragilityError`] where no curve is the most likely one.
    pub fn fit_motions(capacities: &[(Capacity, usize)]) -> Result<Self, FragilityError> {
        let known = capacities.iter().filter(|(c, _)| {
            c.high > c.low && c.low >= 0.0 && (c.low > 0.0 || c.high < f64::INFINITY)
        });
        let (all, motions): (Vec<(f64, f64)>, Vec<usize>) =
            known.map(|(c, motion)| ((c.low.ln(), c.high.ln()), *motion)).unzip();
        if all.is_empty() {
            return Err(FragilityError::Nothing);
        }
        if all.iter().all(|c| c.1 == f64::INFINITY) {
            return Err(FragilityError::Never);
        }
        if all.iter().all(|c| c.0 == f64::NEG_INFINITY) {
            return Err(FragilityError::Always);
        }
        let highest = all.iter().fold(f64::NEG_INFINITY, |a, c| a.max(c.0));
        if highest <= all.iter().fold(f64::INFINITY, |a, c| a.min(c.1)) {
            return Err(FragilityError::Parted);
        }
        let ends: Vec<f64> =
            all.iter().flat_map(|c| [c.0, c.1]).filter(|x| x.is_finite()).collect();
        let n = ends.len() as f64;
        let centre = ends.iter().sum::<f64>() / n;
        let spread = (ends.iter().map(|x| (x - centre).powi(2)).sum::<f64>() / n).sqrt();
        let all: Vec<_> = all.into_iter().map(|(l, h)| (l - centre, h - centre)).collect();
        let (mut a, mut b) = (1.0 / spread, 0.0);
        let mut now = likelihood(&all, a, b);
        for _ in 0..200 {
            let Some(inverse) = inverse(now.information) else { break };
            let g = now.gradient;
            let step = [0, 1].map(|i| inverse[i][0] * g[0] + inverse[i][1] * g[1]);
            let mut length = 1.0;
            let mut next = likelihood(&all, a + step[0], b + step[1]);
            let least = now.value - 1e-12 * now.value.abs();
            // A step too far may have no number for its likelihood.
            while (next.value.is_nan() || next.value < least) && length > 1e-12 {
                length *= 0.5;
                next = likelihood(&all, a + length * step[0], b + length * step[1]);
            }
            (a, b) = (a + length * step[0], b + length * step[1]);
            now = next;
            if (step[0] * spread).abs() < 1e-11 && step[1].abs() < 1e-11 {
                break;
            }
        }
        if a.is_nan() || a <= 1e-6 / spread {
            return Err(FragilityError::Falls);
        }
        let covariance = inverse(now.information).ok_or(FragilityError::Parted)?;
        let (covariance, motions) = match of_motions(&all, motions, (a, b), covariance) {
            Some((covariance, count)) => (covariance, Some(count)),
            None => (covariance, None),
        };
        Ok(Self {
            median: (centre - b / a).exp(),
            dispersion: 1.0 / a,
            covariance,
            centre,
            slope: a,
            value: b,
            runs: all.len(),
            motions,
        })
    }

    /// The curve and its pointwise band at an intensity above 0.
    #[must_use]
    pub fn at(&self, intensity: f64, confidence: f64) -> Band {
        let x = intensity.ln() - self.centre;
        let eta = self.slope * x + self.value;
        let [[aa, ab], [_, bb]] = self.covariance;
        let share = 0.5 + 0.5 * confidence;
        let degrees = self.motions.map(|g| StudentsT::new(0.0, 1.0, g as f64 - 1.0));
        let z = match degrees {
            Some(Ok(t)) => t.inverse_cdf(share),
            _ => phi_inverse(share),
        };
        let half = z * (aa * x * x + 2.0 * ab * x + bb).max(0.0).sqrt();
        Band { probability: phi(eta), low: phi(eta - half), high: phi(eta + half) }
    }

    /// Standard errors of ln θ and of β, by the delta method.
    #[must_use]
    pub fn standard_errors(&self) -> [f64; 2] {
        let [[aa, ab], [_, bb]] = self.covariance;
        let (a, b) = (self.slope, self.value);
        // ln θ = centre − b/a, β = 1/a.
        let (da, db) = (b / (a * a), -1.0 / a);
        let median = da * da * aa + 2.0 * da * db * ab + db * db * bb;
        [median.max(0.0).sqrt(), aa.sqrt() / (a * a)]
    }
}

/// The covariance from the scatter of the scores of motions, and their number; none where all capacities have
/// motions of their own, or too few motions are left.
fn of_motions(
    all: &[(f64, f64)],
    motions: Vec<usize>,
    (a, b): (f64, f64),
    inverse: [[f64; 2]; 2],
) -> Option<([[f64; 2]; 2], usize)> {
    let mut groups: BTreeMap<usize, Vec<(f64, f64)>> = BTreeMap::new();
    for (capacity, motion) in all.iter().zip(motions) {
        groups.entry(motion).or_default().push(*capacity);
    }
    let count = groups.len();
    if count == all.len() || count < FEWEST {
        return None;
    }
    let mut covariance = [[0.0; 2]; 2];
    let factor = count as f64 / (count as f64 - 1.0);
    for group in groups.values() {
        let g = likelihood(group, a, b).gradient;
        let step = inverse.map(|row| row[0] * g[0] + row[1] * g[1]);
        for (row, x) in covariance.iter_mut().zip(step) {
            row.iter_mut().zip(step).for_each(|(cell, y)| *cell += factor * x * y);
        }
    }
    Some((covariance, count))
}

/// φ(z)/(1 − Φ(z)), also far out.
fn mills(z: f64) -> f64 {
    if z > 12.0 {
        // Asymptotic series.
        let s = 1.0 / (z * z);
        return z
            / (1.0 - s * (1.0 - 3.0 * s * (1.0 - 5.0 * s * (1.0 - 7.0 * s * (1.0 - 9.0 * s)))));
    }
    (-0.5 * z * z).exp() / ((2.0 * PI).sqrt() * phi(-z))
}

/// The log-likelihood, its gradient and minus its second derivatives.
struct Likelihood {
    value: f64,
    gradient: [f64; 2],
    information: [[f64; 2]; 2],
}

/// ln P = ln(Φ(u) − Φ(v)) with u = a high + b, v = a low + b.
fn likelihood(all: &[(f64, f64)], a: f64, b: f64) -> Likelihood {
    let mut sum = Likelihood { value: 0.0, gradient: [0.0; 2], information: [[0.0; 2]; 2] };
    for (low, high) in all {
        let (u, v) = (a * high + b, a * low + b);
        // First derivatives of ln P by u and v, then minus the second ones.
        let (value, du, dv, uu, vv, uv);
        if *high == f64::INFINITY {
            let m = mills(v);
            (value, du, dv) = (ln_phi(-v), 0.0, -m);
            (uu, vv, uv) = (0.0, m * (m - v), 0.0);
        } else if *low == f64::NEG_INFINITY {
            let m = mills(-u);
            (value, du, dv) = (ln_phi(u), m, 0.0);
            (uu, vv, uv) = (m * (m + u), 0.0, 0.0);
        } else {
            let density = |z: f64| (-0.5 * z * z).exp() / (2.0 * PI).sqrt();
            // In the upper tail the difference of the complements keeps its digits.
            let p = if v > 0.0 { phi(-v) - phi(-u) } else { phi(u) - phi(v) };
            let p = p.max(f64::MIN_POSITIVE);
            let (fu, fv) = (density(u) / p, density(v) / p);
            (value, du, dv) = (p.ln(), fu, -fv);
            (uu, vv, uv) = (fu * (fu + u), fv * (fv - v), -fu * fv);
        }
        let (h, l) =
            (if high.is_finite() { *high } else { 0.0 }, if low.is_finite() { *low } else { 0.0 });
        sum.value += value;
        sum.gradient[0] += du * h + dv * l;
        sum.gradient[1] += du + dv;
        sum.information[0][0] += uu * h * h + vv * l * l + 2.0 * uv * h * l;
        let mixed = uu * h + vv * l + uv * (h + l);
        sum.information[0][1] += mixed;
        sum.information[1][0] += mixed;
        sum.information[1][1] += uu + vv + 2.0 * uv;
    }
    sum
}

/// ln Φ(z), also far out.
fn ln_phi(z: f64) -> f64 {
    if z < -12.0 { -0.5 * z * z - 0.5 * (2.0 * PI).ln() - mills(-z).ln() } else { phi(z).ln() }
}

fn inverse([[a, b], [c, d]]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let determinant = a * d - b * c;
    let good = determinant > 1e-14 * a * d;
    good.then(|| [[d / determinant, -b / determinant], [-c / determinant, a / determinant]])
}

#[cfg(test)]
mod tests;

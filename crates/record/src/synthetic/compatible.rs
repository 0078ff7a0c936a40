//! A motion whose response spectrum is a given one.
//!
//! From filtered noise under an envelope, first the Fourier amplitudes are multiplied by the ratio of target and
//! response spectrum (phases stay) \[Gasparini & Vanmarcke 1976\]; then wavelets, cosines under a Gaussian at the
//! time of each oscillator's peak, take away what is left: their amplitudes solve C b = Δ, C the response of each
//! oscillator at the time of its peak to each wavelet \[Lilhanand & Tseng 1988; Al Atik & Abrahamson 2010\], with
//! the off-diagonal terms times 0.7 \[Hancock et al. 2006\]. The best motion met is kept.

use super::wavelet::{Peak, Wavelet, answers};
use super::{KanaiTajimi, SyntheticError, positive, samples};
use crate::Record;
use crate::measure::{inverse, periods, pseudo_accelerations, steps_per_sample, transform};
use crate::process::{Baseline, correct};

/// Rounds on Fourier amplitudes and on wavelets.
const ROUNDS: [usize; 2] = [12, 24];
/// Periods that are met, beside the points of the target.
const PERIODS: usize = 60;
/// Most steps of oscillators that a round may take. What stands beside them in a round, the wavelets and their
/// responses, is worth [`WAVELETS`] steps for each sample.
const STEPS: f64 = 2e7;
const WAVELETS: f64 = 150.0;
/// It is done when no period is off by more.
const ENOUGH: f64 = 0.02;

/// A response spectrum to be met: pseudo-acceleration over period.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// (period in s, pseudo-acceleration in m/s²), periods rising; straight between points in log–log.
    pub points: Vec<(f64, f64)>,
    /// Damping, share of critical.
    pub damping: f64,
}

impl Target {
    /// Pseudo-acceleration at a period, m/s²; constant beyond the ends.
    #[must_use]
    pub fn at(&self, period: f64) -> f64 {
        let i = self.points.partition_point(|(t, _)| *t < period);
        match (i.checked_sub(1).and_then(|j| self.points.get(j)), self.points.get(i)) {
            (Some((t0, a0)), Some((t1, a1))) => {
                let x = (period / t0).ln() / (t1 / t0).ln();
                (a0.ln() + x * (a1 / a0).ln()).exp()
            }
            (Some((_, a)), None) | (None, Some((_, a))) => *a,
            (None, None) => f64::NAN,
        }
    }

    fn check(&self) -> Result<(), SyntheticError> {
        if self.points.len() < 2 {
            return Err(SyntheticError::Points(self.points.len()));
        }
        for (period, value) in &self.points {
            positive("period", *period)?;
            positive("acceleration", *value)?;
        }
        if let Some(w) = self.points.windows(2).find(|w| w[1].0 <= w[0].0) {
            return Err(SyntheticError::Order { period: w[1].0, before: w[0].0 });
        }
        if !(self.damping > 0.0 && self.damping < 1.0) {
            let range = "between 0 and 1";
            return Err(SyntheticError::Range { name: "damping", value: self.damping, range });
        }
        Ok(())
    }

    fn periods(&self) -> Vec<f64> {
        let (first, last) = (self.points[0].0, self.points[self.points.len() - 1].0);
        periods(first, last, PERIODS)
    }
}

/// A spectrum-compatible motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Compatible {
    /// What is to be met.
    pub target: Target,
    /// Where it starts from: length, time step, envelope, seed; its peak does not matter.
    pub start: KanaiTajimi,
}

/// How far a motion is from its target, over 60 periods in even steps of their logarithm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Mean of |response/target − 1|.
    pub mean: f64,
    /// Largest.
    pub worst: f64,
}

impl Compatible {
    /// Makes the motion and says how well it meets the target. It starts and ends at rest.
    ///
    /// # Errors
    /// [`SyntheticError`] for numbers outside their range, for more samples than can be brought to the spectrum in
    /// seconds, and for motions that are not finite.
    pub fn make(&self) -> Result<(Record, Fit), SyntheticError> {
        self.target.check()?;
        self.check_work()?;
        let mut record = self.start.make()?;
        let task = Task::new(&self.target, record.dt);
        let mut a = std::mem::take(&mut record.acceleration);
        task.bring_to_size(&mut a);
        let mut best = (task.fit(&task.responses(&a)), a.clone());
        for round in 0..ROUNDS[0] + ROUNDS[1] {
            let responses = task.responses(&a);
            let fit = task.fit(&responses);
            if fit.worst < best.0.worst {
                best = (fit, a.clone());
            }
            if fit.worst < ENOUGH {
                break;
            }
            if round < ROUNDS[0] {
                task.amplitudes(&mut a, &responses);
                if round + 1 == ROUNDS[0] {
                    a.clone_from(&best.1);
                }
            } else {
                task.wavelets(&mut a);
            }
            // Long enough, so it cannot fail.
            let _ = correct(&mut a, record.dt, Baseline::Rest);
        }
        let fit = task.fit(&task.responses(&a));
        if fit.worst < best.0.worst {
            best = (fit, a);
        }
        record.acceleration = best.1;
        record.event = format!(
            "spectrum-compatible, {} points at {} % damping",
            self.target.points.len(),
            100.0 * self.target.damping
        );
        record.check_finite()?;
        Ok((record, best.0))
    }

    /// What it takes to make it, over the most that a single motion may take.
    ///
    /// # Errors
    /// [`SyntheticError`] for targets and lengths that are none.
    pub fn work(&self) -> Result<f64, SyntheticError> {
        self.target.check()?;
        let samples = samples(self.start.duration, self.start.dt)?;
        Ok(samples as f64 * self.steps() / STEPS)
    }

    /// Steps of a round for each sample: those of an oscillator are a 64th of its period, or the samples.
    fn steps(&self) -> f64 {
        let parts = |t: &f64| steps_per_sample(self.start.dt, *t) as f64;
        self.target.periods().iter().map(parts).sum::<f64>() + WAVELETS
    }

    /// Holds the steps of a round to [`STEPS`].
    fn check_work(&self) -> Result<(), SyntheticError> {
        let KanaiTajimi { duration, dt, .. } = self.start;
        let samples = samples(duration, dt)?;
        let most = (STEPS / self.steps()) as usize;
        if samples > most {
            let shortest = self.target.periods()[0];
            return Err(SyntheticError::TooMuch { samples, most, shortest, dt });
        }
        Ok(())
    }
}

struct Task {
    dt: f64,
    damping: f64,
    periods: Vec<f64>,
    wanted: Vec<f64>,
}

impl Task {
    fn new(target: &Target, dt: f64) -> Self {
        let periods = target.periods();
        let wanted = periods.iter().map(|t| target.at(*t)).collect();
        Self { dt, damping: target.damping, periods, wanted }
    }

    fn responses(&self, a: &[f64]) -> Vec<f64> {
        pseudo_accelerations(a, self.dt, &self.periods, self.damping)
    }

    fn fit(&self, responses: &[f64]) -> Fit {
        let off = || responses.iter().zip(&self.wanted).map(|(r, w)| (r / w - 1.0).abs());
        Fit {
            mean: off().sum::<f64>() / self.wanted.len() as f64,
            worst: off().fold(0.0, f64::max),
        }
    }

    fn bring_to_size(&self, a: &mut [f64]) {
        let logs =
            self.responses(a).iter().zip(&self.wanted).map(|(r, w)| (w / r).ln()).sum::<f64>();
        let factor = (logs / self.wanted.len() as f64).exp();
        a.iter_mut().for_each(|x| *x *= factor);
    }

    /// Multiplies the Fourier amplitudes by target over response.
    fn amplitudes(&self, a: &mut Vec<f64>, responses: &[f64]) {
        let n = a.len();
        let whole = (2 * n).next_power_of_two();
        let mut padded = a.clone();
        padded.resize(whole, 0.0);
        let mut s = transform(&mut padded);
        let ratios: Vec<f64> = responses.iter().zip(&self.wanted).map(|(r, w)| w / r).collect();
        let last = self.periods.len() - 1;
        let step = (self.periods[last] / self.periods[0]).ln() / last as f64;
        for (k, c) in s.iter_mut().enumerate().skip(1) {
            let period = whole as f64 * self.dt / k as f64;
            let x = ((period / self.periods[0]).ln() / step).clamp(0.0, last as f64);
            let i = (x as usize).min(last - 1);
            *c *= ratios[i] + (x - i as f64) * (ratios[i + 1] - ratios[i]);
        }
        *a = inverse(&mut s, whole);
        a.truncate(n);
    }

    /// Adds the wavelets that take the differences away.
    fn wavelets(&self, a: &mut [f64]) {
        let all = Peak::all(a, self.dt, &self.periods, self.damping);
        let shapes: Vec<Wavelet> = all.iter().map(|p| p.wavelet(a.len(), self.dt)).collect();
        let mut c = answers(&all, &shapes, self.dt);
        for (i, (row, p)) in c.iter_mut().zip(&all).enumerate() {
            let w2 = p.oscillator.omega().powi(2);
            for (j, x) in row.iter_mut().enumerate() {
                // As a share of what is wanted, so that all rows have one size.
                let factor = if i == j { 1.0 } else { 0.7 };
                *x = factor * *x * w2 / self.wanted[i];
            }
        }
        let differences = all
            .iter()
            .zip(&self.wanted)
            .map(|(p, w)| p.value.signum() * (1.0 - p.value.abs() / w))
            .collect();
        for (b, shape) in solve(c, differences).iter().zip(&shapes) {
            shape.of(a).for_each(|(a, s)| *a += 0.7 * b * s);
        }
    }
}

/// C x = b by Gaussian elimination with rows exchanged; a row without a pivot gives zero.
fn solve(mut c: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| c[*i][k].abs().total_cmp(&c[*j][k].abs())).unwrap_or(k);
        c.swap(k, pivot);
        b.swap(k, pivot);
        if c[k][k].abs() < 1e-12 {
            continue;
        }
        for i in k + 1..n {
            let f = c[i][k] / c[k][k];
            let (upper, lower) = c.split_at_mut(i);
            for (x, y) in lower[0][k..].iter_mut().zip(&upper[k][k..]) {
                *x -= f * y;
            }
            b[i] -= f * b[k];
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|j| c[k][j] * x[j]).sum();
        if c[k][k].abs() >= 1e-12 {
            x[k] = (b[k] - sum) / c[k][k];
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{displacement, spectrum, velocity};

    /// The shape of EN 1998-1, type 1, ground C, 0.3 g.
    fn code(damping: f64) -> Target {
        let (a, s, tb, tc, td) = (0.3 * 9.80665, 1.15, 0.2, 0.6, 2.0);
        let at = |t: f64| {
            a * s
                * match t {
                    t if t < tb => 1.0 + 1.5 * t / tb,
                    t if t < tc => 2.5,
                    t if t < td => 2.5 * tc / t,
                    t => 2.5 * tc * td / (t * t),
                }
        };
        Target { points: periods(0.04, 4.0, 40).into_iter().map(|t| (t, at(t))).collect(), damping }
    }

    #[test]
    fn motions_meet_the_spectrum_of_a_code_and_end_at_rest() {
        for seed in [1, 2, 3] {
            let start = KanaiTajimi { seed, ..KanaiTajimi::default() };
            let (r, fit) = Compatible { target: code(0.05), start }.make().unwrap();
            eprintln!("seed {seed}: mean {:.3} worst {:.3}", fit.mean, fit.worst);
            assert!(fit.mean < 0.05 && fit.worst < 0.1, "{seed}: {fit:?}");
            // Between the periods that were looked at too, by a spectrum of its own.
            let between = periods(0.041, 3.9, 97);
            let found = spectrum(&r.acceleration, r.dt, &between, 0.05).psa();
            let off: Vec<f64> = between
                .iter()
                .zip(found)
                .map(|(t, a)| (a / code(0.05).at(*t) - 1.0).abs())
                .collect();
            assert!(off.iter().sum::<f64>() / 97.0 < 0.05, "{seed}");
            assert!(
                off.iter().all(|x| *x < 0.15),
                "{seed}: {:?}",
                off.iter().copied().fold(0.0, f64::max)
            );
            let end = r.acceleration.len() - 1;
            assert!(velocity(&r.acceleration, r.dt)[end].abs() < 1e-10);
            assert!(displacement(&r.acceleration, r.dt)[end].abs() < 1e-10);
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_bits() {
        let start = KanaiTajimi { duration: 10.0, seed: 5, ..KanaiTajimi::default() };
        let make = || Compatible { target: code(0.05), start: start.clone() }.make().unwrap().0;
        let bits = |r: Record| r.acceleration.into_iter().map(f64::to_bits).collect::<Vec<_>>();
        assert_eq!(bits(make()), bits(make()));
    }

    #[test]
    fn motions_that_would_take_too_long_are_refused_at_once() {
        let made = |duration: f64, first: f64| {
            let start = KanaiTajimi { duration, ..KanaiTajimi::default() };
            let points = vec![(first, 1.0), (3.0, 1.0)];
            Compatible { target: Target { points, damping: 0.05 }, start }.make().unwrap_err()
        };
        assert_eq!(made(1e5, 0.05), SyntheticError::TooLong(10_000_001.0));
        for (duration, first) in [(1e4, 0.05), (50.0, 1e-3)] {
            let error = made(duration, first);
            let SyntheticError::TooMuch { samples, most, .. } = error else { panic!("{error}") };
            assert!(most < samples, "{error}");
        }
    }

    #[test]
    fn targets_that_are_none_are_refused() {
        let made = |points: Vec<(f64, f64)>| {
            Compatible { target: Target { points, damping: 0.05 }, start: KanaiTajimi::default() }
                .make()
        };
        assert_eq!(made(vec![(1.0, 1.0)]).unwrap_err(), SyntheticError::Points(1));
        assert!(
            made(vec![(1.0, 1.0), (0.5, 1.0)]).is_err()
                && made(vec![(0.0, 1.0), (1.0, 1.0)]).is_err()
        );
    }
}

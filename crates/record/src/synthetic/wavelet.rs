//! Wavelets at the peaks of oscillators, and what the oscillators answer them.

use crate::measure::{Oscillator, Step, pseudo_accelerations, steps_per_sample};
use pulp::{Arch, Simd, WithSimd};

/// How far a wavelet reaches from its centre, in its widths: beyond, it is below 1e-40 of its height.
const REACH: f64 = 9.6;
/// Wavelets that an oscillator answers side by side.
const LANES: usize = 8;

/// The peak of an oscillator.
pub(super) struct Peak {
    pub oscillator: Oscillator,
    /// Sample.
    pub at: usize,
    /// Pseudo-acceleration there, with its sign.
    pub value: f64,
}

impl Peak {
    /// Those of oscillators of these periods under an acceleration.
    pub fn all(a: &[f64], dt: f64, periods: &[f64], damping: f64) -> Vec<Self> {
        // Those that divide a step alike go side by side, with the same bits as by themselves.
        let alike = |s: &f64, t: &f64| steps_per_sample(dt, *s) == steps_per_sample(dt, *t);
        let groups = periods.chunk_by(alike);
        // Between samples a short period swings further than at them.
        let most = groups.flat_map(|group| pseudo_accelerations(a, dt, group, damping));
        let all: Vec<Oscillator> =
            periods.iter().map(|&period| Oscillator { period, damping }).collect();
        let places = all.chunks(LANES).flat_map(|group| {
            // Lanes that are not used hold a copy of the first.
            let steps = std::array::from_fn(|i| group.get(i).unwrap_or(&group[0]).step(dt));
            let (at, u) = Arch::new().dispatch(Highest { acceleration: a, steps });
            at.into_iter().zip(u).take(group.len())
        });
        let one = |((&oscillator, most), (at, u)): ((&Oscillator, f64), (usize, f64))| {
            let w2 = oscillator.omega().powi(2);
            Self { oscillator, at, value: most.copysign(u * w2) }
        };
        all.iter().zip(most).zip(places).map(one).collect()
    }

    /// A cosine under a Gaussian to which the oscillator responds most at the time of its peak, of `n` samples.
    pub fn wavelet(&self, n: usize, dt: f64) -> Wavelet {
        let z = self.oscillator.damping;
        let q = (1.0 - z * z).sqrt();
        let w = self.oscillator.omega() * q;
        let shift = (q / z).atan() / w;
        let width = 1.178 * self.oscillator.period.powf(0.93);
        let center = self.at as f64 * dt - shift;
        let sample = |t: f64| (t / dt).max(0.0) as usize;
        let first = sample(center - REACH * width).min(n);
        let end = sample(center + REACH * width).saturating_add(2).clamp(first, n);
        let value = |i: usize| {
            let t = i as f64 * dt - center;
            (w * t).cos() * (-(t / width).powi(2)).exp()
        };
        Wavelet { first, values: (first..end).map(value).collect() }
    }
}

/// A wavelet: zero but for some samples.
pub(super) struct Wavelet {
    /// The first of them.
    first: usize,
    values: Vec<f64>,
}

impl Wavelet {
    /// The samples of a motion that it reaches, each with its value there.
    pub fn of<'a>(&'a self, a: &'a mut [f64]) -> impl Iterator<Item = (&'a mut f64, &'a f64)> {
        a[self.first..].iter_mut().zip(&self.values)
    }

    fn end(&self) -> usize {
        self.first + self.values.len()
    }
}

/// The displacement of each oscillator at the time of its peak under each wavelet: a row for each oscillator.
pub(super) fn answers(peaks: &[Peak], wavelets: &[Wavelet], dt: f64) -> Vec<Vec<f64>> {
    let mut rows = vec![Vec::with_capacity(wavelets.len()); peaks.len()];
    for group in wavelets.chunks(LANES) {
        let side_by_side = Group::new(group);
        for (p, row) in peaks.iter().zip(&mut rows) {
            let u = side_by_side.answer(&p.oscillator, p.at, dt);
            row.extend(&u[..group.len()]);
        }
    }
    rows
}

/// Wavelets side by side, from the first sample that one of them reaches to the last.
struct Group {
    first: usize,
    values: Vec<[f64; LANES]>,
}

impl Group {
    fn new(wavelets: &[Wavelet]) -> Self {
        let first = wavelets.iter().map(|w| w.first).min().unwrap_or_default();
        let end = wavelets.iter().map(Wavelet::end).max().unwrap_or_default();
        let mut values = vec![[0.0; LANES]; end - first];
        for (lane, wavelet) in wavelets.iter().enumerate() {
            let own = values[wavelet.first - first..].iter_mut();
            own.zip(&wavelet.values).for_each(|(all, x)| all[lane] = *x);
        }
        Self { first, values }
    }

    /// The displacement of an oscillator at a sample, under each by itself.
    fn answer(&self, oscillator: &Oscillator, at: usize, dt: f64) -> [f64; LANES] {
        Arch::new().dispatch(Answer { group: self, step: oscillator.step(dt), at })
    }
}

/// The answer of an oscillator to a group; the bits are the same whatever vectors the processor has.
struct Answer<'a> {
    group: &'a Group,
    step: Step,
    at: usize,
}

impl WithSimd for Answer<'_> {
    type Output = [f64; LANES];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [f64; LANES] {
        let Self { group: Group { first, values }, step, at } = self;
        let still = [0.0; LANES];
        let (mut u, mut v) = (still, still);
        // Before its first sample it is at rest; behind the last it swings on by itself.
        let Some(steps) = (at + 1).checked_sub(*first) else { return still };
        let driven = &values[..steps.min(values.len())];
        if *first > 0
            && let Some(value) = driven.first()
        {
            advance(&step, &mut u, &mut v, &still, value);
        }
        for w in driven.windows(2) {
            advance(&step, &mut u, &mut v, &w[0], &w[1]);
        }
        if steps > driven.len()
            && let Some(last) = driven.last()
        {
            advance(&step, &mut u, &mut v, last, &still);
            for _ in driven.len() + 1..steps {
                advance(&step, &mut u, &mut v, &still, &still);
            }
        }
        u
    }
}

/// Where oscillators are farthest from rest under one acceleration: the sample, the first but for that of the start, and
/// the displacement there.
struct Highest<'a> {
    acceleration: &'a [f64],
    steps: [Step; LANES],
}

impl WithSimd for Highest<'_> {
    type Output = ([usize; LANES], [f64; LANES]);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Self { acceleration, steps } = self;
        let still = [0.0; LANES];
        let (mut u, mut v, mut most) = (still, still, still);
        let mut at = [1; LANES];
        for (i, w) in acceleration.windows(2).enumerate() {
            for l in 0..LANES {
                (u[l], v[l]) = steps[l].advance(u[l], v[l], w[0], w[1]);
                let farther = u[l].abs() > most[l].abs();
                at[l] = if farther { i + 1 } else { at[l] };
                most[l] = if farther { u[l] } else { most[l] };
            }
        }
        (at, most)
    }
}

/// Not a closure: it must be compiled for the vectors of its caller.
#[inline(always)]
fn advance(
    step: &Step,
    u: &mut [f64; LANES],
    v: &mut [f64; LANES],
    from: &[f64; LANES],
    to: &[f64; LANES],
) {
    for l in 0..LANES {
        (u[l], v[l]) = step.advance(u[l], v[l], from[l], to[l]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn peak(period: f64, damping: f64, at: usize) -> Peak {
        Peak { oscillator: Oscillator { period, damping }, at, value: 1.0 }
    }

    /// One by one over whole records, as the formulas stand.
    fn plain(peaks: &[Peak], n: usize, dt: f64) -> Vec<Vec<f64>> {
        let shape = |p: &Peak| -> Vec<f64> {
            let mut a = vec![0.0; n];
            p.wavelet(n, dt).of(&mut a).for_each(|(a, s)| *a += s);
            a
        };
        let shapes: Vec<Vec<f64>> = peaks.iter().map(shape).collect();
        let one = |p: &Peak, a: &Vec<f64>| p.oscillator.displacement(a, dt)[p.at];
        peaks.iter().map(|p| shapes.iter().map(|a| one(p, a)).collect()).collect()
    }

    #[test]
    fn answers_side_by_side_are_those_one_by_one() {
        let (n, dt) = (3000, 0.01);
        let places = [1, 40, 300, 900, 1500, 2400, 2999, 17, 700, 1100, 2999];
        let periods = [0.04, 0.05, 0.07, 0.1, 0.2, 0.3, 0.4, 0.7, 1.0, 2.0, 5.0];
        let peaks: Vec<Peak> =
            periods.iter().zip(places).map(|(t, at)| peak(*t, 0.05, at)).collect();
        let wavelets: Vec<Wavelet> = peaks.iter().map(|p| p.wavelet(n, dt)).collect();
        assert!(wavelets.iter().any(|w| w.first > 0) && wavelets.iter().any(|w| w.end() < n));
        assert_eq!(answers(&peaks, &wavelets, dt), plain(&peaks, n, dt));
    }

    #[test]
    fn peaks_side_by_side_are_those_one_by_one() {
        let a: Vec<f64> = (0..700).map(|i| (0.05 * f64::from(i * i) / 70.0).sin()).collect();
        let periods: Vec<f64> = (1..40).map(|i| 0.03 * f64::from(i)).collect();
        let all = Peak::all(&a, 0.01, &periods, 0.05);
        for (peak, period) in all.iter().zip(&periods) {
            let alone = &Peak::all(&a, 0.01, &[*period], 0.05)[0];
            assert_eq!((peak.at, peak.value), (alone.at, alone.value), "{period}");
            let u = peak.oscillator.displacement(&a, 0.01);
            assert!(u.iter().all(|x| x.abs() <= u[peak.at].abs()), "{period}");
            assert_eq!(peak.value.signum(), u[peak.at].signum(), "{period}");
        }
    }

    #[test]
    fn a_wavelet_is_nothing_where_it_ends() {
        for (period, at) in [(0.05, 2000), (1.0, 2000), (4.0, 10), (4.0, 4999)] {
            let w = peak(period, 0.05, at).wavelet(5000, 0.01);
            let ends = [(w.first > 0, w.values.first()), (w.end() < 5000, w.values.last())];
            for (inside, value) in ends {
                assert!(!inside || value.is_some_and(|x| x.abs() < 1e-39), "{period}: {value:?}");
            }
        }
    }
}

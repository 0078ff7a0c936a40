//! Laws led along deformations step by step, for tests.

use trilith_element::{Energy, Kinematics, Link, Response};

/// A law with its committed state and what it has done so far.
pub(crate) struct Driven<'a> {
    link: &'a dyn Link,
    pub(crate) history: Vec<f64>,
    pub(crate) d: Vec<f64>,
    v: Vec<f64>,
    pub(crate) f: Vec<f64>,
    pub(crate) stored: f64,
    /// Heat of friction, yielding and rates so far, J.
    pub(crate) heat: f64,
    /// Work so far by the trapezoidal rule, J.
    pub(crate) work: f64,
}

impl<'a> Driven<'a> {
    pub(crate) fn new(link: &'a dyn Link) -> Self {
        let n = link.coordinates().len();
        let mut history = vec![0.0; link.history().len()];
        link.at_rest(&mut history);
        let zero = vec![0.0; n];
        let mut it = Self {
            link,
            history,
            d: zero.clone(),
            v: zero.clone(),
            f: zero.clone(),
            stored: 0.0,
            heat: 0.0,
            work: 0.0,
        };
        it.step(&zero, 0.0);
        it
    }

    /// A committed step at constant rate; the force at its end.
    pub(crate) fn step(&mut self, d: &[f64], dt: f64) -> Vec<f64> {
        let rate = |(a, b): (&f64, &f64)| if dt > 0.0 { (a - b) / dt } else { 0.0 };
        let v: Vec<f64> = d.iter().zip(&self.d).map(rate).collect();
        self.step_at(d, &v, dt)
    }

    /// A committed step to a deformation and a rate.
    pub(crate) fn step_at(&mut self, d: &[f64], v: &[f64], dt: f64) -> Vec<f64> {
        let n = d.len();
        let (mut f, mut k, mut c) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
        let (mut energy, mut trial) = (Energy::default(), vec![f64::NAN; self.history.len()]);
        let mut out = Response { f: &mut f, k: &mut k, c: &mut c, energy: &mut energy };
        let at = Kinematics { d, v, d0: &self.d, v0: &self.v, dt };
        self.link.respond(&at, &self.history, &mut trial, &mut out);
        for i in 0..n {
            self.work += 0.5 * (self.f[i] + f[i]) * (d[i] - self.d[i]);
        }
        self.heat += energy.hysteretic + energy.viscous;
        self.stored = energy.stored;
        self.history = trial;
        (self.d, self.v) = (d.to_vec(), v.to_vec());
        self.f.clone_from(&f);
        f
    }

    /// Static steps of one coordinate through these deformations; the forces there.
    pub(crate) fn through(&mut self, path: &[f64]) -> Vec<f64> {
        path.iter().map(|d| self.step(&[*d], 0.0)[0]).collect()
    }

    /// The same in steps of at most `step`.
    pub(crate) fn finely(&mut self, path: &[f64], step: f64) -> Vec<f64> {
        let to = |it: &mut Self, end: f64| {
            let start = it.d[0];
            let count = ((end - start).abs() / step).ceil().max(1.0) as usize;
            for i in 1..=count {
                it.step(&[start + (end - start) * i as f64 / count as f64], 0.0);
            }
            it.f[0]
        };
        path.iter().map(|d| to(self, *d)).collect()
    }
}

//! One law on a path of its own, for tests.

use trilith_element::{Energy, Kinematics, Link, Response};

/// A law, where it is, and what it has done so far.
pub(crate) struct Ride<'a> {
    link: &'a dyn Link,
    pub(crate) d: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) history: Vec<f64>,
    pub(crate) f: Vec<f64>,
    pub(crate) work: f64,
    /// Stored now, dissipated so far.
    pub(crate) energy: Energy,
}

impl<'a> Ride<'a> {
    pub(crate) fn new(link: &'a dyn Link) -> Self {
        let n = link.coordinates().len();
        let mut history = vec![0.0; link.history().len()];
        link.at_rest(&mut history);
        let zeros = vec![0.0; n];
        let (d, v, f) = (zeros.clone(), zeros.clone(), zeros);
        Self { link, d, v, history, f, work: 0.0, energy: Energy::default() }
    }

    pub(crate) fn step(&mut self, d: &[f64], v: &[f64], dt: f64) {
        let n = d.len();
        let (mut f, mut k, mut c) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
        let (mut energy, mut trial) = (Energy::default(), self.history.clone());
        let mut out = Response { f: &mut f, k: &mut k, c: &mut c, energy: &mut energy };
        let at = Kinematics { d, v, d0: &self.d, v0: &self.v, dt };
        self.link.respond(&at, &self.history, &mut trial, &mut out);
        self.work += (0..n).map(|i| 0.5 * (f[i] + self.f[i]) * (d[i] - self.d[i])).sum::<f64>();
        self.energy.stored = energy.stored;
        self.energy.hysteretic += energy.hysteretic;
        self.energy.viscous += energy.viscous;
        (self.d, self.v, self.f, self.history) = (d.to_vec(), v.to_vec(), f, trial);
    }

    /// A static step.
    pub(crate) fn to(&mut self, d: [f64; 3]) {
        self.step(&d, &[0.0; 3], 0.0);
    }

    /// A straight static path in equal steps.
    pub(crate) fn along(&mut self, end: [f64; 3], steps: u32) {
        let start = self.d.clone();
        for i in 1..=steps {
            let s = f64::from(i) / f64::from(steps);
            self.to([0, 1, 2].map(|j| start[j] + s * (end[j] - start[j])));
        }
    }

    /// One cycle of u₂ = amplitude sin 2πt under constant compression, in `steps` steps; heat of it, J.
    pub(crate) fn cycle(&mut self, d1: f64, amplitude: f64, steps: u32) -> f64 {
        let before = self.energy.hysteretic;
        let w = std::f64::consts::TAU;
        for i in 1..=steps {
            let t = f64::from(i) / f64::from(steps);
            let (s, c) = (w * t).sin_cos();
            self.step(
                &[d1, amplitude * s, 0.0],
                &[0.0, amplitude * w * c, 0.0],
                1.0 / f64::from(steps),
            );
        }
        self.energy.hysteretic - before
    }
}

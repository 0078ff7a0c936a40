//! Leading a law of one coordinate through a motion, and a mass against it, for tests.

use trilith_element::{Energy, Kinematics, Link, Response};

/// A law on its way: its state and what it said last.
#[derive(Clone, Debug)]
pub(crate) struct Led {
    history: Vec<f64>,
    d: f64,
    v: f64,
    /// Last force, N.
    pub f: f64,
    /// Last ∂f/∂d, N/m.
    pub k: f64,
    /// Stored energy, J.
    pub stored: f64,
    /// Sum of the hysteretic energies, J.
    pub hysteretic: f64,
    /// Sum of the viscous energies, J.
    pub viscous: f64,
    /// Work of the force by the trapezoidal rule, J.
    pub work: f64,
}

impl Led {
    /// Before anything has happened.
    pub(crate) fn at_rest(law: &dyn Link) -> Self {
        Self::from(law, 0.0, 0.0)
    }

    /// The same, at another deformation and rate.
    pub(crate) fn from(law: &dyn Link, d: f64, v: f64) -> Self {
        let mut history = vec![0.0; law.history().len()];
        law.at_rest(&mut history);
        let mut it = Self {
            history,
            d,
            v,
            f: 0.0,
            k: 0.0,
            stored: 0.0,
            hysteretic: 0.0,
            viscous: 0.0,
            work: 0.0,
        };
        it.step(law, d, v, 0.0);
        it.work = 0.0;
        it
    }

    /// One step to d, v in dt.
    pub(crate) fn step(&mut self, law: &dyn Link, d: f64, v: f64, dt: f64) {
        let (mut f, mut k, mut c, mut energy) = ([0.0], [0.0], [0.0], Energy::default());
        let mut trial = self.history.clone();
        let mut out = Response { f: &mut f, k: &mut k, c: &mut c, energy: &mut energy };
        let at = Kinematics { d: &[d], v: &[v], d0: &[self.d], v0: &[self.v], dt };
        law.respond(&at, &self.history, &mut trial, &mut out);
        self.work += 0.5 * (self.f + f[0]) * (d - self.d);
        (self.history, self.d, self.v, self.f, self.k) = (trial, d, v, f[0], k[0]);
        self.stored = energy.stored;
        self.hysteretic += energy.hysteretic;
        self.viscous += energy.viscous;
    }

    /// From rest at the first point of a motion to its end, in equal steps.
    pub(crate) fn through(
        law: &dyn Link,
        time: f64,
        steps: usize,
        motion: impl Fn(f64) -> (f64, f64),
    ) -> Self {
        let (d, v) = motion(0.0);
        let mut it = Self::from(law, d, v);
        let dt = time / steps as f64;
        for i in 1..=steps {
            let (d, v) = motion(dt * i as f64);
            it.step(law, d, v, dt);
        }
        it
    }
}

/// Speed of a mass after it has struck a contact at `speed`, as share of it; by the midpoint rule on the
/// force of the law.
pub(crate) fn rebound(law: &dyn Link, mass: f64, speed: f64, dt: f64) -> f64 {
    let (mut d, mut v) = (0.0, -speed);
    let mut it = Led::from(law, d, v);
    loop {
        let (middle, half) = (d + 0.5 * dt * v, v - 0.5 * dt * it.f / mass);
        it.step(law, middle, half, 0.5 * dt);
        v -= dt * it.f / mass;
        d += dt * half;
        it.step(law, d, v, 0.5 * dt);
        if d > 0.0 || v > 0.0 && it.f == 0.0 {
            return v / speed;
        }
    }
}

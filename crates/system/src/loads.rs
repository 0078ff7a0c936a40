//! Loads as channels: a vector on the free DOFs times an amplitude in time.

use crate::System;
use trilith_model::{
    BaseMotion, Corner, DynamicCase, Load, Model, Side, Stretch, Table, TimeFunction,
};

/// What drives the amplitude of a channel.
#[derive(Clone, Debug)]
pub enum Track {
    /// Constant 1: loads held from the start.
    Constant,
    /// factor · function.
    Value {
        /// The function.
        function: TimeFunction,
        /// Factor.
        factor: f64,
    },
    /// factor · first derivative of the function.
    Rate {
        /// The function.
        function: TimeFunction,
        /// Factor.
        factor: f64,
    },
    /// factor · second derivative of the function.
    Curvature {
        /// The function.
        function: TimeFunction,
        /// Factor.
        factor: f64,
    },
}

impl Track {
    /// Amplitude at t.
    #[must_use]
    #[inline]
    pub fn at(&self, t: f64, side: Side) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Value { function, factor } => factor * function.value(t, side),
            Self::Rate { function, factor } => factor * function.derivatives(t, side).0,
            Self::Curvature { function, factor } => factor * function.derivatives(t, side).1,
        }
    }
}

/// One channel.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Force on the free DOFs per unit amplitude.
    pub force: Vec<f64>,
    /// Deformation of the flat link coordinates per unit amplitude (moving supports).
    pub deformation: Vec<(usize, f64)>,
    /// Rate of deformation of the flat link coordinates per unit amplitude.
    pub rate: Vec<(usize, f64)>,
    /// Amplitude.
    pub track: Track,
    /// True for loads whose work is potential energy: constant ones.
    pub conservative: bool,
}

/// Amplitudes of all channels at the start and the end of a step.
#[derive(Clone, Debug, Default)]
pub struct StepLoads {
    /// At the start.
    pub start: Vec<f64>,
    /// At the end.
    pub end: Vec<f64>,
    /// When that is, s; none where a load may jump there.
    until: Option<f64>,
}

impl StepLoads {
    /// The next step starts where a load may jump.
    pub fn cut(&mut self) {
        self.until = None;
    }
}

/// All loads of a case.
#[derive(Clone, Debug, Default)]
pub struct LoadSet {
    /// The channels.
    pub channels: Vec<Channel>,
    /// Uniform base motion, for absolute accelerations.
    pub base: Vec<(BaseMotion, TimeFunction)>,
    /// Prescribed displacement of each prescribed DOF: (prescribed index, function, factor).
    pub supports: Vec<(usize, TimeFunction, f64)>,
    /// Loads held from the start, which the constant channel is the sum of.
    pub held: Vec<Load>,
    /// Patterns that vary: (index, function, factor).
    pub varying: Vec<(usize, TimeFunction, f64)>,
}

impl System {
    /// The force vector of a constant load on the free DOFs.
    #[must_use]
    pub fn load_vector(&self, model: &Model, load: &Load) -> Vec<f64> {
        match load {
            Load::Gravity { factor } => {
                self.inertia[2].iter().map(|m| -factor * model.gravity * m).collect()
            }
            Load::Pattern { pattern, factor } => {
                let mut p = vec![0.0; self.order()];
                for force in &model.patterns[*pattern].forces {
                    let full = 6 * force.node + force.dof.index();
                    for (j, t) in self.reduction.expand(full) {
                        if *j < p.len() {
                            p[*j] += factor * force.value * t;
                        }
                    }
                }
                for load in &model.patterns[*pattern].members {
                    for (full, force) in self.member_load(model, load) {
                        for (j, t) in self.reduction.expand(full) {
                            if *j < p.len() {
                                p[*j] += factor * force * t;
                            }
                        }
                    }
                }
                p
            }
        }
    }

    /// The channels of a dynamic case; `constant` is the sum of all loads held from the start.
    #[must_use]
    pub fn dynamic_loads(&self, model: &Model, case: &DynamicCase, constant: Vec<f64>) -> LoadSet {
        let mut set = LoadSet::default();
        let plain = |force: Vec<f64>, track: Track, conservative: bool| Channel {
            force,
            deformation: Vec::new(),
            rate: Vec::new(),
            track,
            conservative,
        };
        if constant.iter().any(|x| *x != 0.0) {
            set.channels.push(plain(constant, Track::Constant, true));
        }
        let function = |i: usize| model.functions[i].function.clone();
        for base in &case.base {
            let force = self.inertia[base.direction.index()].iter().map(|m| -m).collect();
            let (f, factor) = (function(base.function), base.factor);
            set.base.push((*base, f.clone()));
            set.channels.push(plain(force, Track::Value { function: f, factor }, false));
        }
        for history in &case.forces {
            let pattern = Load::Pattern { pattern: history.pattern, factor: 1.0 };
            let (f, factor) = (function(history.function), history.factor);
            let force = self.load_vector(model, &pattern);
            set.varying.push((history.pattern, f.clone(), factor));
            set.channels.push(plain(force, Track::Value { function: f, factor }, false));
        }
        for motion in &case.supports {
            let full = 6 * motion.node + motion.dof.index();
            let Some(s) = self.reduction.prescribed.iter().position(|p| *p == full) else {
                continue;
            };
            let (f, factor) = (function(motion.function), motion.factor);
            self.support_channels(&mut set, s, &f, factor);
            set.supports.push((s, f, factor));
        }
        set
    }

    /// A moving support acts through −K_fs u_s − C_fs u̇_s − M_fs ü_s and deforms the links at it. C_fs is that of
    /// elements and of K; what damps motion against the supports is added to the channel of the rate by
    /// [`LoadSet::add_to_rates`].
    fn support_channels(&self, set: &mut LoadSet, s: usize, function: &TimeFunction, factor: f64) {
        let column = |a: &trilith_linalg::Sparse| {
            let mut p = vec![0.0; self.order()];
            let (rows, values) = a.column(s);
            for (i, v) in rows.iter().zip(values) {
                p[*i] = -v;
            }
            p
        };
        let links: Vec<(usize, f64)> = self
            .links
            .support_rows
            .iter()
            .enumerate()
            .flat_map(|(i, row)| row.iter().filter(|(j, _)| *j == s).map(move |(_, c)| (i, *c)))
            .collect();
        let f = || function.clone();
        let parts = [
            (&self.stiffness_support, Track::Value { function: f(), factor }),
            (&self.damping_support, Track::Rate { function: f(), factor }),
            (&self.mass_support, Track::Curvature { function: f(), factor }),
        ];
        for (order, (matrix, track)) in parts.into_iter().enumerate() {
            set.channels.push(Channel {
                force: column(matrix),
                deformation: if order == 0 { links.clone() } else { Vec::new() },
                rate: if order == 1 { links.clone() } else { Vec::new() },
                track,
                conservative: false,
            });
        }
    }
}

impl LoadSet {
    /// Adds a force on the free DOFs for each of the moving [`supports`](Self::supports) at unit velocity.
    pub fn add_to_rates(&mut self, forces: &[Vec<f64>]) {
        let rates = self.channels.iter_mut().filter(|c| matches!(c.track, Track::Rate { .. }));
        for (channel, force) in rates.zip(forces) {
            channel.force.iter_mut().zip(force).for_each(|(x, y)| *x += y);
        }
    }

    /// How many times each of so many patterns acts at t, and behind them the weight.
    #[must_use]
    pub fn factors(&self, patterns: usize, t: f64, side: Side) -> Vec<f64> {
        let mut all = vec![0.0; patterns + 1];
        for load in &self.held {
            match load {
                Load::Gravity { factor } => all[patterns] += factor,
                Load::Pattern { pattern, factor } => all[*pattern] += factor,
            }
        }
        for (pattern, function, factor) in &self.varying {
            all[*pattern] += factor * function.value(t, side);
        }
        all
    }

    /// Amplitudes over a step; what is known from a step that ended at its start is kept.
    #[inline]
    pub fn step(&self, t0: f64, t1: f64, loads: &mut StepLoads) {
        let goes_on = |c: &Channel| matches!(c.track, Track::Constant | Track::Value { .. });
        let all = |to: &mut Vec<f64>, t: f64, side: Side| {
            to.resize(self.channels.len(), 0.0);
            for (x, c) in to.iter_mut().zip(&self.channels) {
                *x = c.track.at(t, side);
            }
        };
        if loads.until == Some(t0) && self.channels.iter().all(goes_on) {
            std::mem::swap(&mut loads.start, &mut loads.end);
        } else {
            all(&mut loads.start, t0, Side::After);
        }
        all(&mut loads.end, t1, Side::Before);
        loads.until = Some(t1);
    }

    /// Σ amplitude · force.
    #[must_use]
    pub fn force(&self, amplitudes: &[f64], order: usize) -> Vec<f64> {
        let mut p = vec![0.0; order];
        for (c, a) in self.channels.iter().zip(amplitudes) {
            for (x, y) in p.iter_mut().zip(&c.force) {
                *x += a * y;
            }
        }
        p
    }

    /// Adds the deformation and rate that moving supports give the links.
    pub fn support_deformation(&self, amplitudes: &[f64], d: &mut [f64], v: &mut [f64]) {
        for (c, a) in self.channels.iter().zip(amplitudes) {
            for (i, x) in &c.deformation {
                d[*i] += a * x;
            }
            for (i, x) in &c.rate {
                v[*i] += a * x;
            }
        }
    }

    /// Base acceleration along X, Y, Z at t, m/s².
    #[must_use]
    pub fn base_acceleration(&self, t: f64, side: Side) -> [f64; 3] {
        let mut a = [0.0; 3];
        for (base, function) in &self.base {
            a[base.direction.index()] += base.factor * function.value(t, side);
        }
        a
    }

    /// Prescribed displacement, velocity and acceleration at t of `count` prescribed DOFs.
    #[must_use]
    pub fn prescribed(&self, t: f64, side: Side, count: usize) -> [Vec<f64>; 3] {
        let mut motion = [(); 3].map(|()| vec![0.0; count]);
        for (s, function, factor) in &self.supports {
            let (rate, curvature) = function.derivatives(t, side);
            for (x, y) in motion.iter_mut().zip([function.value(t, side), rate, curvature]) {
                x[*s] += factor * y;
            }
        }
        motion
    }

    /// Times strictly inside (0, end) at which an amplitude or its slope may jump, rising.
    #[must_use]
    pub fn breaks(&self, end: f64) -> Vec<f64> {
        let mut times: Vec<f64> = self
            .functions()
            .flat_map(|(function, _)| function.breaks())
            .filter(|t| *t > 0.0 && *t < end)
            .collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Corners of tables strictly inside (0, end), rising: amplitudes of loads bend there, and rates of moving
    /// supports may. Its value is continuous there, so a step must end there, but nothing jumps. Those of tables whose
    /// samples all lie on output steps of `dt` (s) are left out: steps end there anyhow.
    #[must_use]
    pub fn corners(&self, end: f64, dt: f64) -> Vec<Corner> {
        let mut tables: Vec<&Table> = Vec::new();
        let mut corners = Vec::new();
        for (function, factor) in self.functions() {
            let Some(table) = function.table() else { continue };
            // A moving support has several channels, and several of them may follow one table.
            if factor == 0.0 || tables.iter().any(|other| std::ptr::eq(*other, table)) {
                continue;
            }
            tables.push(table);
            if !table.lies_on(dt) {
                corners.extend(table.corners());
            }
        }
        corners.retain(|c| c.t > 0.0 && c.t < end);
        corners.sort_by(|a, b| a.t.total_cmp(&b.t));
        corners
    }

    /// Times in which loads are curved, and the steps that follow them.
    #[must_use]
    pub fn stretches(&self) -> Vec<Stretch> {
        let curved = self.functions().filter(|(_, factor)| *factor != 0.0);
        curved.filter_map(|(function, _)| function.stretch()).collect()
    }

    /// The functions of time and their factors, channel by channel.
    fn functions(&self) -> impl Iterator<Item = (&TimeFunction, f64)> {
        self.channels.iter().filter_map(|c| match &c.track {
            Track::Constant => None,
            Track::Value { function, factor }
            | Track::Rate { function, factor }
            | Track::Curvature { function, factor } => Some((function, *factor)),
        })
    }
}

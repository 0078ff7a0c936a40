//! What a law did along a motion.

use super::{Coordinate, ExerciseError, History, Motion};
use crate::element::{Driver, Field, Link};
use std::f64::consts::TAU;

/// Steps of a cycle, and of a measured history at least.
const STEPS: usize = 2000;
/// Steps between two samples of a measured history at least.
const PARTS: usize = 4;

/// The last closed cycle of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LastCycle {
    /// Area ∮ f dd, J.
    pub area: f64,
    /// Force over deformation between the extreme deformations, N/m or N·m/rad; none where it does not move.
    pub stiffness: Option<f64>,
    /// Equivalent damping ratio ∮ f dd / (2π k a²) with that stiffness k and the amplitude a; none
    /// where the stiffness is nearly zero beside the forces.
    pub damping: Option<f64>,
}

/// Deformations, forces, energies and history variables along a motion. Lists of coordinates hold a
/// list of all steps each.
#[derive(Clone, Debug)]
pub struct Record {
    /// The coordinates.
    pub coordinates: Vec<Coordinate>,
    /// Times, s.
    pub time: Vec<f64>,
    /// Deformations, m or rad.
    pub deformation: Vec<Vec<f64>>,
    /// Rates, m/s or rad/s.
    pub rate: Vec<Vec<f64>>,
    /// Forces, N or N·m.
    pub force: Vec<Vec<f64>>,
    /// Work done on the link since the start, J.
    pub work: Vec<f64>,
    /// Stored energy, hysteretic and viscous dissipation since the start, J.
    pub energy: [Vec<f64>; 3],
    /// The history variables.
    pub fields: Vec<Field>,
    /// Their values.
    pub history: Vec<Vec<f64>>,
    /// Sum of the absolute work of the steps, J.
    turned_over: f64,
    /// First step of the last cycle; the first of all along a measured history.
    pub(super) last: usize,
}

impl Record {
    pub(super) fn new(
        law: &dyn Link,
        coordinates: Vec<Coordinate>,
        motion: &Motion,
    ) -> Result<Self, ExerciseError> {
        let steps = (motion.periods() * STEPS as f64).round() as usize;
        let dt = motion.duration() / steps as f64;
        let mut it = Self::of_steps(steps, law, coordinates);
        it.last = steps - STEPS;
        let (d, v) = motion.at(0.0);
        let mut driver = Driver::starting_at(law, &d, &v);
        it.push(0.0, &driver)?;
        for step in 1..=steps {
            let time = step as f64 * dt;
            let (d, v) = motion.at(time);
            it.step(time, &mut driver, &d, &v, dt)?;
        }
        it.turned_over = driver.turned_over;
        Ok(it)
    }

    /// Along a measured history, in equal parts between its samples. It has no last cycle.
    pub(super) fn along(
        law: &dyn Link,
        coordinates: Vec<Coordinate>,
        history: &History,
    ) -> Result<Self, ExerciseError> {
        let gaps = history.len() - 1;
        let parts = STEPS.div_ceil(gaps).max(PARTS);
        let mut it = Self::of_steps(gaps * parts, law, coordinates);
        let (d, v) = history.between(0, 0.0);
        let mut driver = Driver::starting_at(law, &d, &v);
        it.push(history.time[0], &driver)?;
        for sample in 0..gaps {
            let (start, end) = (history.time[sample], history.time[sample + 1]);
            let dt = (end - start) / parts as f64;
            for part in 1..=parts {
                let share = part as f64 / parts as f64;
                let (d, v) = history.between(sample, share);
                let time = if part == parts { end } else { start + part as f64 * dt };
                it.step(time, &mut driver, &d, &v, dt)?;
            }
        }
        it.turned_over = driver.turned_over;
        Ok(it)
    }

    /// Nothing yet, with room for so many steps.
    fn of_steps(steps: usize, law: &dyn Link, coordinates: Vec<Coordinate>) -> Self {
        let n = coordinates.len();
        let fields = law.history().into_owned();
        let list = || Vec::with_capacity(steps + 1);
        Self {
            coordinates,
            time: list(),
            deformation: vec![list(); n],
            rate: vec![list(); n],
            force: vec![list(); n],
            work: list(),
            energy: Default::default(),
            history: vec![list(); fields.len()],
            fields,
            turned_over: 0.0,
            last: 0,
        }
    }

    /// Takes a step, and takes it down.
    fn step(
        &mut self,
        time: f64,
        driver: &mut Driver<'_>,
        d: &[f64],
        v: &[f64],
        dt: f64,
    ) -> Result<(), ExerciseError> {
        let before = driver.clone();
        driver.step(d, v, dt);
        self.push(time, driver).map_err(|e| match before.refusal(&before.toward(d, v, dt)) {
            Some(why) => ExerciseError::Refuses { time, why },
            None => e,
        })
    }

    /// Takes down where a law is.
    fn push(&mut self, time: f64, driver: &Driver<'_>) -> Result<(), ExerciseError> {
        let e = driver.energy;
        let energies = [e.stored, e.hysteretic, e.viscous];
        let mut all = driver.f.iter().chain(&energies).chain(&driver.history);
        if !all.all(|x| x.is_finite()) {
            return Err(ExerciseError::NotFinite(time));
        }
        self.time.push(time);
        self.work.push(driver.work);
        self.energy.iter_mut().zip(energies).for_each(|(list, x)| list.push(x));
        let rows = [
            (&mut self.deformation, &driver.d),
            (&mut self.rate, &driver.v),
            (&mut self.force, &driver.f),
            (&mut self.history, &driver.history),
        ];
        for (lists, values) in rows {
            lists.iter_mut().zip(values).for_each(|(list, x)| list.push(*x));
        }
        Ok(())
    }

    /// Work and change of stored energy, hysteretic and viscous dissipation over the whole motion, J.
    #[must_use]
    pub fn totals(&self) -> [f64; 4] {
        let change = |list: &Vec<f64>| match (list.first(), list.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        };
        let [stored, hysteretic, viscous] = &self.energy;
        [change(&self.work), change(stored), change(hysteretic), change(viscous)]
    }

    /// What of the work the energies do not account for, over the work done and taken.
    #[must_use]
    pub fn energy_error(&self) -> f64 {
        let [work, stored, hysteretic, viscous] = self.totals();
        let error = (work - stored - hysteretic - viscous).abs();
        if error == 0.0 { 0.0 } else { error / self.turned_over }
    }

    /// Smallest and largest of the deformation and of the force of a coordinate.
    #[must_use]
    pub fn extremes(&self, coordinate: usize) -> [(f64, f64); 2] {
        [&self.deformation, &self.force].map(|all| extremes(&all[coordinate]))
    }

    /// True where the coordinate is moved to and fro.
    #[must_use]
    pub fn moves(&self, coordinate: usize) -> bool {
        let (low, high) = extremes(&self.deformation[coordinate][self.last..]);
        high - low > 1e-9 * high.abs().max(low.abs())
    }

    /// The last closed cycle of a coordinate.
    #[must_use]
    pub fn last_cycle(&self, coordinate: usize) -> LastCycle {
        let d = &self.deformation[coordinate][self.last..];
        let f = &self.force[coordinate][self.last..];
        let steps = d.windows(2).zip(f.windows(2));
        let area: f64 = steps.map(|(d, f)| 0.5 * (f[0] + f[1]) * (d[1] - d[0])).sum();
        if !self.moves(coordinate) {
            return LastCycle { area, stiffness: None, damping: None };
        }
        let at = |better: fn(&f64, &f64) -> bool| {
            (1..d.len()).fold(0, |best, i| if better(&d[i], &d[best]) { i } else { best })
        };
        let (low, high) = (at(|a, b| a < b), at(|a, b| a > b));
        let amplitude = 0.5 * (d[high] - d[low]);
        let (least, most) = extremes(f);
        // What is nothing but rounding is nothing.
        let size = most - least;
        let real = |x: f64, unit: f64| if x.abs() > 1e-9 * unit { x } else { 0.0 };
        let area = real(area, size * amplitude);
        let stiffness = real((f[high] - f[low]) / (2.0 * amplitude), size / amplitude);
        let felt = stiffness * amplitude > 1e-3 * size;
        let damping = felt.then(|| area / (TAU * stiffness * amplitude * amplitude));
        LastCycle { area, stiffness: Some(stiffness), damping }
    }
}

pub(super) fn extremes(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)))
}

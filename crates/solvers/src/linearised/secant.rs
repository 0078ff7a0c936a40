//! Secants: what one link makes of a cycle of a given amplitude.
//!
//! ```text
//! k = (f(+D) − f(−D)) / 2D        E_D = ∮ f dd        ξ = E_D / (2π k D²)
//! ```
//!
//! The second cycle counts, led as a sine from the state at the start, all other coordinates held.
//! Reference: \[ASCE/SEI 7-16, 17.2.8.3\], \[EN 15129:2009, 3.1\].

use super::Linearised;
use crate::error::SolveError;
use serde::Serialize;
use std::f64::consts::TAU;
use trilith_element::{Axis, Coordinates, Driver, Link};
use trilith_system::blaming;

/// Steps of a cycle.
const STEPS: usize = 400;
/// Cycles before the one that counts, a quarter more than whole ones: it starts at +D.
const BEFORE: usize = STEPS + STEPS / 4;
/// A period that changes by less is the one that rate-dependent laws are led at.
const SAME_PERIOD: f64 = 1e-3;
/// Periods that are tried.
const ROUNDS: usize = 20;
/// The first of these, s.
const FIRST_PERIOD: f64 = 2.0;
/// Forces at the turning points below this share of the largest of the cycle are rounding: a dashpot has none there.
const ROUNDING: f64 = 1e-9;

/// A coordinate of a link in a cycle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Secant {
    /// Index of the element.
    pub element: usize,
    /// Name of the coordinate, such as `U2`.
    pub coordinate: String,
    /// Flat index of the coordinate.
    #[serde(skip)]
    pub(super) flat: usize,
    /// Amplitude, m.
    pub amplitude: f64,
    /// Secant stiffness, N/m.
    pub stiffness: f64,
    /// Work on the link in the cycle, J.
    pub heat: f64,
    /// The same as a damping ratio; `None` where there is no stiffness.
    pub damping: Option<f64>,
    /// Period of the cycle, s; `None` where the law asks for no rates.
    pub period: Option<f64>,
}

/// Coordinates of a law that a cycle is led along, in the law's own order.
fn cycled(law: &dyn Link, named: bool) -> Vec<usize> {
    let Coordinates::Local(axes) = law.coordinates() else { return Vec::new() };
    let of = |wanted: &[Axis]| -> Vec<usize> {
        (0..axes.len()).filter(|i| wanted.contains(&axes[*i])).collect()
    };
    let shear = of(&[Axis::U2, Axis::U3]);
    if shear.is_empty() && named { of(&[Axis::U1]) } else { shear }
}

impl Linearised<'_> {
    /// Puts secants in the place of tangents.
    pub(super) fn take_secants(
        &mut self,
        displacement: f64,
        of: Option<&[usize]>,
    ) -> Result<(), SolveError> {
        let mut period = FIRST_PERIOD;
        for _ in 0..ROUNDS {
            self.secants = self.cycles(displacement, of, period);
            for secant in &self.secants {
                let links = &self.system.links.links;
                let Some(link) = links.iter().find(|l| l.range.contains(&secant.flat)) else {
                    continue;
                };
                let (n, own) = (link.range.len(), secant.flat - link.range.start);
                let block = &mut self.blocks[link.block.clone()];
                for i in 0..n {
                    (block[own * n + i], block[i * n + own]) = (0.0, 0.0);
                }
                block[own * n + own] = secant.stiffness;
            }
            // Laws that ask for rates are led as fast as the structure swings with them.
            if self.secants.iter().all(|s| s.period.is_none()) {
                return Ok(());
            }
            let lowest = self.modes(1)?.omega2.into_iter().find(|w| *w > 0.0);
            let Some(found) = lowest.map(|w| TAU / w.sqrt()) else { return Ok(()) };
            if (found - period).abs() <= SAME_PERIOD * found {
                return Ok(());
            }
            period = found;
        }
        Ok(())
    }

    fn cycles(&self, displacement: f64, of: Option<&[usize]>, period: f64) -> Vec<Secant> {
        let links = &self.system.links;
        let mut all = Vec::new();
        for (law, link) in links.laws(self.model).iter() {
            if of.is_some_and(|of| !of.contains(&link.element)) {
                continue;
            }
            for local in cycled(law, of.is_some()) {
                let flat = link.range.start + local;
                let d = &self.start.d[link.range.clone()];
                let history = &self.start.history[link.history.clone()];
                let [stiffness, heat] =
                    blaming(link.element, || cycle(law, (d, history), local, displacement, period));
                all.push(Secant {
                    element: link.element,
                    coordinate: links.coordinate(self.model, link, local),
                    flat,
                    amplitude: displacement,
                    stiffness,
                    heat,
                    damping: (stiffness > 0.0)
                        .then(|| heat / (TAU * stiffness * displacement * displacement)),
                    period: law.uses_rates().then_some(period),
                });
            }
        }
        all
    }
}

/// Secant stiffness of a coordinate and the work on it in a cycle about where the link is.
fn cycle(
    law: &dyn Link,
    (start, history): (&[f64], &[f64]),
    local: usize,
    amplitude: f64,
    period: f64,
) -> [f64; 2] {
    let (mut d, mut v) = (start.to_vec(), vec![0.0; start.len()]);
    let mut driver = Driver::starting_at(law, &d, &v);
    driver.history.copy_from_slice(history);
    let (mut before, mut ends, mut largest) = (0.0, [0.0; 2], 0.0f64);
    for step in 1..=BEFORE + STEPS {
        let phase = TAU * step as f64 / STEPS as f64;
        d[local] = start[local] + amplitude * phase.sin();
        v[local] = amplitude * TAU / period * phase.cos();
        driver.step(&d, &v, period / STEPS as f64);
        let f = driver.f[local];
        match step {
            BEFORE => before = driver.work,
            _ if step == BEFORE + STEPS / 2 => ends[0] = f,
            _ if step == BEFORE + STEPS => ends[1] = f,
            _ => {}
        }
        if step > BEFORE {
            largest = largest.max(f.abs());
        }
    }
    let between = ends[1] - ends[0];
    let between = if between.abs() <= ROUNDING * largest { 0.0 } else { between };
    [between / (2.0 * amplitude), driver.work - before]
}

//! What is done on a link, and what its law says of that.
//!
//! ```text
//! g = Σ ½ (f₀ + f₁)(d₁ − d₀) − Δstored − heat
//! ```
//!
//! Where steps are as long as the case says, g of a sound law is no small number. So a law that leaves out some of its work
//! in such a step is led through it alone, in shorter and shorter parts: along the cubic through deformation and rate at
//! both ends, straight where no time goes on. Of a law that accounts for its work g falls, with the square of the parts as
//! a rule, with their length where a force jumps; of one that does not it stays.

use super::culprit::{Culprit, Wrong};
use super::state::State;
use crate::vector::larger;
use trilith_element::{Driver, Energy, Link};
use trilith_system::{Laws, LinkInstance, LinkSet, blaming};

/// Share of its work that a law must leave out, led through a step in the shortest parts, to be blamed: more than sound
/// laws may by their own account, as the conformance kit allows.
const SHARE: f64 = 5e-3;
/// Share of what is left out that shorter parts leave where they change nothing.
const STAYS: f64 = 0.6;
/// Parts of the step: few, some, and where these two have left a doubt, many.
const PARTS: [u32; 3] = [8, 64, 4096];
/// Operations whose rounding may add up in the energies of a part.
const ROUNDING: f64 = 16.0;

/// Work done on a link, and what it says of that, J.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Account {
    pub work: f64,
    pub accounted: f64,
    /// Sum of the sizes of all parts.
    pub size: f64,
}

impl Account {
    /// Of a link in a step.
    pub fn of(link: &LinkInstance, i: usize, from: &State, to: &State, energy: &Energy) -> Self {
        let of = |j: usize| 0.5 * (from.f[j] + to.f[j]) * (to.d[j] - from.d[j]);
        let (mut work, mut size) = (0.0, 0.0_f64);
        for part in link.range.clone().map(of) {
            work += part;
            size += part.abs();
        }
        let heat = energy.hysteretic + energy.viscous;
        let stored = to.stored[i] - from.stored[i];
        Self { work, accounted: stored + heat, size: size.max(stored.abs()).max(heat.abs()) }
    }

    pub fn gap(&self) -> f64 {
        self.work - self.accounted
    }

    pub fn add(&mut self, other: &Self) {
        self.work += other.work;
        self.accounted += other.accounted;
        self.size += other.size;
    }

    /// True where more is left out than a sound law may.
    fn is_open(&self, rounding: f64) -> bool {
        self.gap().abs() > larger(SHARE * self.size, rounding)
    }
}

/// In how many steps the energies of each link have not closed; one is led through the first of them, the second, the
/// fourth and so on, so that this costs nothing beside the run.
#[derive(Debug, Default)]
pub(crate) struct Suspicion(Vec<u32>);

impl Suspicion {
    /// Looks at a step: the links that are to be led through it.
    #[inline]
    pub fn look(
        &mut self,
        links: &LinkSet,
        (from, to): (&State, &State),
        energy: &[Energy],
    ) -> Vec<usize> {
        let mut found = Vec::new();
        self.0.resize(links.links.len(), 0);
        for (i, ((link, energy), met)) in
            links.links.iter().zip(energy).zip(&mut self.0).enumerate()
        {
            let account = Account::of(link, i, from, to, energy);
            if account.is_open(rounding(i, from, to, account.size)) {
                *met = met.saturating_add(1);
                if met.is_power_of_two() {
                    found.push(i);
                }
            }
        }
        found
    }
}

/// The first of these links whose law leaves out some of its work, however short the parts of a step of `dt` (s) are in
/// which it is led; `since`: when the step began.
pub(crate) fn leaves_out(
    suspects: &[usize],
    laws: &Laws<'_>,
    (from, to): (&State, &State),
    dt: f64,
    since: Option<f64>,
) -> Option<Culprit> {
    let of = |(i, (law, link)): (usize, (&dyn Link, &LinkInstance))| {
        let Account { work, accounted, .. } = led_out(law, link, i, (from, to), dt)?;
        Some(Culprit { element: link.element, wrong: Wrong::Energies { since, work, accounted } })
    };
    laws.iter().enumerate().filter(|(i, _)| suspects.contains(i)).find_map(of)
}

/// What rounding may do to the energies of one link, J.
fn rounding(i: usize, from: &State, to: &State, size: f64) -> f64 {
    ROUNDING * f64::EPSILON * (from.stored[i].abs() + to.stored[i].abs() + size)
}

/// The account of a law that leaves out some of its work however short the parts are.
fn led_out(
    law: &dyn Link,
    link: &LinkInstance,
    i: usize,
    (from, to): (&State, &State),
    dt: f64,
) -> Option<Account> {
    let mut before: Option<Account> = None;
    for parts in PARTS {
        let now = blaming(link.element, || led(law, link, i, (from, to), dt, parts));
        let stays = before.is_none_or(|before| {
            now.gap().abs() > STAYS * before.gap().abs() && now.gap() * before.gap() > 0.0
        });
        // What is no number is none to be blamed for: another question finds it.
        if !stays || !now.is_open(f64::from(parts) * rounding(i, from, to, now.size)) {
            return None;
        }
        before = Some(now);
    }
    before
}

/// The account of a law that is led through a step in so many parts.
fn led(
    law: &dyn Link,
    link: &LinkInstance,
    i: usize,
    (from, to): (&State, &State),
    dt: f64,
    parts: u32,
) -> Account {
    let own = |x: &[f64]| x[link.range.clone()].to_vec();
    let [d0, d1] = [own(&from.d), own(&to.d)];
    let moving = dt > 0.0 && law.uses_rates();
    let rate = |x: &State| if moving { own(&x.v) } else { vec![0.0; d0.len()] };
    let [v0, v1] = [rate(from), rate(to)];
    let mut driver = Driver::starting_at(law, &d0, &v0);
    driver.history.copy_from_slice(&from.history[link.history.clone()]);
    driver.f.copy_from_slice(&from.f[link.range.clone()]);
    for part in 1..=parts {
        let x = f64::from(part) / f64::from(parts);
        let at = |k: usize| {
            if moving {
                cubic([d0[k], d1[k]], [v0[k], v1[k]], dt, x)
            } else {
                [d0[k] + x * (d1[k] - d0[k]), 0.0]
            }
        };
        let (d, v): (Vec<f64>, Vec<f64>) = (0..d0.len()).map(|k| at(k).into()).unzip();
        driver.step(&d, &v, dt / f64::from(parts));
    }
    let stored = driver.energy.stored - from.stored[i];
    let heat = driver.heat();
    let size = driver.turned_over.max(stored.abs()).max(heat.abs());
    Account { work: driver.work, accounted: stored + heat, size }
}

/// Value and rate of the cubic through values and rates at both ends of a step, at a share of it.
fn cubic([d0, d1]: [f64; 2], [v0, v1]: [f64; 2], dt: f64, x: f64) -> [f64; 2] {
    let y = 1.0 - x;
    let d =
        y * y * ((1.0 + 2.0 * x) * d0 + x * dt * v0) + x * x * ((3.0 - 2.0 * x) * d1 - y * dt * v1);
    let v = 6.0 * x * y * (d1 - d0) / dt + y * (1.0 - 3.0 * x) * v0 + x * (3.0 * x - 2.0) * v1;
    [d, v]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_goes_through_its_ends_and_its_rate_is_its_own() {
        let (d, v, dt) = ([0.3, -0.1], [2.0, 1.5], 0.2);
        let at = |x: f64| cubic(d, v, dt, x);
        assert_eq!((at(0.0), at(1.0)), ([0.3, 2.0], [-0.1, 1.5]));
        for x in [0.1, 0.5, 0.8] {
            let quotient = (at(x + 1e-6)[0] - at(x - 1e-6)[0]) / (2e-6 * dt);
            assert!((quotient - at(x)[1]).abs() < 1e-7, "{x}");
        }
    }
}

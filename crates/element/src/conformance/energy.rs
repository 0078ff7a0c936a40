//! Energy: the balance of a law, and what comes out of it.

use super::path::Path;
use super::probe::start;
use super::{ConformanceError as Broken, Kit, Report};
use crate::Link;

/// Steps of a cycle where energies are added up.
const FINE: usize = 2000;
/// Share of the energy turned over that rounding may make negative of a dissipation.
const ROUNDING: f64 = 1e-12;

/// Energy of three cycles of a path.
#[derive(Default)]
struct Ledger {
    /// Sum of the absolute work of all steps.
    turned_over: f64,
    /// Most energy given so far beyond what was stored at the start.
    gain: f64,
    /// Largest gap between work and account so far, J: time, work, account.
    gap: (f64, f64, f64),
}

impl Ledger {
    fn error(&self, typical: f64) -> f64 {
        let (_, work, accounted) = self.gap;
        (work - accounted).abs() / self.turned_over.max(typical)
    }
}

/// `turnover`: that of the largest path, J, by which rounding is measured.
fn ledger(
    kit: &Kit,
    link: &dyn Link,
    path: &Path,
    steps: usize,
    turnover: f64,
) -> Result<Ledger, Broken> {
    let dt = path.period() / steps as f64;
    let mut driver = start(link, path);
    let (at_start, mut gain) = (driver.energy.stored, 0.0_f64);
    let mut gap = (0.0, 0.0, 0.0_f64);
    for (time, d, v) in path.ends(3, steps) {
        let answer = driver.ask(&driver.toward(&d, &v, dt));
        let e = answer.energy;
        driver.commit(&d, &v, answer);
        for (which, value) in [("hysteretic", e.hysteretic), ("viscous", e.viscous)] {
            let size = turnover.max(driver.turned_over) + e.stored.abs();
            if kit.passive && link.accounts() && value < -ROUNDING * size {
                return Err(Broken::NegativeDissipation { which, value, path: path.number, time });
            }
        }
        gain = gain.max(-driver.work - at_start);
        let (work, accounted) = (driver.work, driver.accounted());
        if (work - accounted).abs() > (gap.1 - gap.2).abs() {
            gap = (time, work, accounted);
        }
    }
    Ok(Ledger { turned_over: driver.turned_over, gain, gap })
}

/// The largest turnover of all paths, J: what is small beside it is rounding, and a path that hardly touches is measured
/// by a thousandth of it.
pub(super) fn turnover(kit: &Kit, link: &dyn Link, paths: &[Path]) -> Result<f64, Broken> {
    let mut most = f64::MIN_POSITIVE;
    let steps = if kit.quick { FINE / 40 } else { FINE / 10 };
    // Dissipation that is negative is looked at once that is known.
    let kit = &Kit { passive: false, ..kit.clone() };
    for path in paths {
        most = most.max(ledger(kit, link, path, steps, 0.0)?.turned_over);
    }
    Ok(most)
}

/// Work against energies at all times, and no more energy out than was in.
pub(super) fn balance(
    kit: &Kit,
    link: &dyn Link,
    path: &Path,
    report: &mut Report,
    turnover: f64,
) -> Result<(), Broken> {
    let typical = (1e-3 * turnover).max(f64::MIN_POSITIVE);
    let mut it = Ledger::default();
    let mut coarse = f64::INFINITY;
    let screen: &[usize] = if kit.quick { &[FINE / 8, FINE] } else { &[FINE] };
    for steps in screen {
        it = ledger(kit, link, path, *steps, turnover)?;
        coarse = it.error(typical);
        if coarse <= kit.energy_tolerance {
            break;
        }
    }
    if coarse > kit.energy_tolerance {
        // Second order makes it 16 times smaller; impacts and reversals may spoil some of it.
        let steps = 4 * FINE;
        it = ledger(kit, link, path, steps, turnover)?;
        if it.error(typical) > (coarse / 8.0).min(5.0 * kit.energy_tolerance) {
            let (time, work, accounted) = it.gap;
            return Err(Broken::Balance { path: path.number, time, work, accounted, steps });
        }
    }
    report.energy_error = report.energy_error.max(it.error(typical));
    if kit.passive && it.gain > kit.energy_tolerance * it.turned_over.max(typical) {
        let (gain, turned_over) = (it.gain, it.turned_over);
        return Err(Broken::GivesEnergy { path: path.number, gain, turned_over });
    }
    Ok(())
}

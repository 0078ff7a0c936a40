//! Energy: the balance of a law, and what comes out of it.

use super::path::Path;
use super::probe::start;
use super::{ConformanceError as Broken, Kit, Report};
use crate::Link;

/// Steps of a cycle where energies are added up.
const FINE: usize = 2000;

/// Energy of three cycles of a path.
#[derive(Default)]
struct Ledger {
    work: f64,
    accounted: f64,
    turned_over: f64,
    /// Most energy given so far beyond what was stored at the start.
    gain: f64,
}

fn ledger(kit: &Kit, link: &dyn Link, path: &Path, steps: usize) -> Result<Ledger, Broken> {
    let dt = path.period() / steps as f64;
    let mut driver = start(link, path);
    let (at_start, mut gain) = (driver.energy.stored, 0.0_f64);
    for (time, d, v) in path.ends(3, steps) {
        let answer = driver.ask(&driver.toward(&d, &v, dt));
        let e = answer.energy;
        driver.commit(&d, &v, answer);
        for (which, value) in [("hysteretic", e.hysteretic), ("viscous", e.viscous)] {
            if kit.passive && value < -1e-12 * (driver.turned_over + e.stored.abs()) {
                return Err(Broken::NegativeDissipation { which, value, path: path.number, time });
            }
        }
        gain = gain.max(-driver.work - at_start);
    }
    let (work, turned_over) = (driver.work, driver.turned_over);
    Ok(Ledger { work, accounted: driver.accounted(), turned_over, gain })
}

/// A thousandth of the largest turnover of all paths, J: a path that hardly touches is measured by it.
pub(super) fn typical(kit: &Kit, link: &dyn Link, paths: &[Path]) -> Result<f64, Broken> {
    let mut most = f64::MIN_POSITIVE;
    let steps = if kit.quick { FINE / 40 } else { FINE / 10 };
    for path in paths {
        most = most.max(ledger(kit, link, path, steps)?.turned_over);
    }
    Ok((1e-3 * most).max(f64::MIN_POSITIVE))
}

/// Work against energies, and no more energy out than was in.
pub(super) fn balance(
    kit: &Kit,
    link: &dyn Link,
    path: &Path,
    report: &mut Report,
    typical: f64,
) -> Result<(), Broken> {
    let error = |l: &Ledger| (l.work - l.accounted).abs() / l.turned_over.max(typical);
    let mut it = Ledger::default();
    let mut coarse = f64::INFINITY;
    let screen: &[usize] = if kit.quick { &[FINE / 8, FINE] } else { &[FINE] };
    for steps in screen {
        it = ledger(kit, link, path, *steps)?;
        coarse = error(&it);
        if coarse <= kit.energy_tolerance {
            break;
        }
    }
    if coarse > kit.energy_tolerance {
        // Second order makes it 16 times smaller; impacts and reversals may spoil some of it.
        let steps = 4 * FINE;
        it = ledger(kit, link, path, steps)?;
        if error(&it) > (coarse / 8.0).min(5.0 * kit.energy_tolerance) {
            let (work, accounted) = (it.work, it.accounted);
            return Err(Broken::Balance { path: path.number, work, accounted, steps });
        }
    }
    report.energy_error = report.energy_error.max(error(&it));
    if kit.passive && it.gain > kit.energy_tolerance * it.turned_over.max(typical) {
        let (gain, turned_over) = (it.gain, it.turned_over);
        return Err(Broken::GivesEnergy { path: path.number, gain, turned_over });
    }
    Ok(())
}

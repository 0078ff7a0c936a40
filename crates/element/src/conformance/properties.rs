//! The properties, one function each.

use super::path::Path;
use super::probe::{Step, march};
use super::{ConformanceError as Broken, Kit, Report};
use crate::definite::{NotDefinite, semi_definite};
use crate::{Answer, Driver, Kinematics, Link};

/// Steps of a cycle where states are looked at one by one.
const COARSE: usize = 48;
/// A quick kit looks at the tangents of every so manieth step; not a divisor of the steps of a cycle.
const SPARSE: usize = 5;
/// Step of a difference quotient, relative to the scale of the coordinate.
const STEP: f64 = 1e-5;
/// Admissible error of a tangent, relative to the force over the scale of the coordinate. Quotients
/// from both sides that differ by more lie at a kink.
const TANGENT: f64 = 1e-4;

/// Lengths, names and the dummy.
pub(super) fn shape(kit: &Kit, link: &dyn Link) -> Result<(), Broken> {
    let n = link.coordinates().len();
    if n != kit.deformation.len() || n == 0 {
        return Err(Broken::Coordinates { link: n, kit: kit.deformation.len() });
    }
    let fields = link.history();
    for (i, field) in fields.iter().enumerate() {
        if field.name.is_empty() || fields[..i].iter().any(|f| f.name == field.name) {
            return Err(Broken::FieldName { name: field.name.clone().into_owned() });
        }
    }
    let mut a = vec![0.0; n * n];
    link.engaged_stiffness(&mut a);
    semi_definite(&a, n, 1e-9).map_err(|fault| {
        let (row, why) = match fault {
            NotDefinite::NotFinite { row, .. } => (row, "a value is not finite"),
            NotDefinite::NotSymmetric { row, .. } => (row, "it is not symmetric"),
            NotDefinite::Diagonal { row, .. } => (row, "a diagonal value is not positive"),
            NotDefinite::Pivot { row } => (row, "a pivot is negative"),
        };
        Broken::EngagedStiffness { row, why }
    })
}

/// Largest absolute force along a path, by coordinate.
fn peaks(link: &dyn Link, path: &Path) -> Result<Vec<f64>, Broken> {
    let mut peak = vec![0.0_f64; path.scale.len()];
    march(link, path, 2, COARSE, |s| {
        peak.iter_mut().zip(&s.answer.f).for_each(|(p, f)| *p = p.max(f.abs()));
        Ok(())
    })?;
    Ok(peak)
}

/// Finite, complete, pure, the same after a discarded trial, and the same at the start of the next step.
pub(super) fn answers(link: &dyn Link, path: &Path) -> Result<(), Broken> {
    let peak = peaks(link, path)?;
    march(link, path, 2, COARSE, |s| {
        finite(s, path).map_err(|fault| blind(link, s, path).err().unwrap_or(fault))?;
        // A discarded trial somewhere else must leave no trace.
        let elsewhere: Vec<f64> =
            s.at.d.iter().zip(&path.scale).map(|(d, x)| d - 1.7 * x).collect();
        let _ = s.before.ask(&Kinematics { d: &elsewhere, ..s.at });
        same(&s.before.ask(&s.at), s.answer, s, path)?;
        blind(link, s, path)?;
        restart(link, s, path, &peak)?;
        contact(link, s, path)
    })
}

/// A law that says that it does not look at rates answers the same whatever they are. A [driver](Driver) gives it none;
/// `respond` itself is asked here.
fn blind(link: &dyn Link, s: &Step<'_>, path: &Path) -> Result<(), Broken> {
    if link.uses_rates() {
        return Ok(());
    }
    let asked = |times: f64, more: f64| {
        let rates = s.at.v.iter().zip(&path.scale);
        let rates: Vec<f64> = rates.map(|(v, x)| times * v + more * x).collect();
        let at = Kinematics { v: &rates, v0: &rates, ..s.at };
        Answer::told_rates(link, &at, &s.before.history)
    };
    same(&asked(3.0, 1.0), &asked(1.0, 0.0), s, path)
        .map_err(|_| Broken::UsesRates { path: path.number, time: s.time })
}

/// The parts of an answer by name.
fn parts(answer: &Answer) -> [(&'static str, Vec<f64>); 5] {
    let e = answer.energy;
    [
        ("f", answer.f.clone()),
        ("k", answer.k.clone()),
        ("c", answer.c.clone()),
        ("energy", vec![e.stored, e.hysteretic, e.viscous]),
        ("trial", answer.trial.clone()),
    ]
}

fn finite(s: &Step<'_>, path: &Path) -> Result<(), Broken> {
    for (what, values) in parts(s.answer) {
        if let Some(index) = values.iter().position(|x| !x.is_finite()) {
            if let Some(why) = s.before.refusal(&s.at) {
                return Err(Broken::Refuses { why, path: path.number, time: s.time });
            }
            return Err(Broken::NotFinite { what, index, path: path.number, time: s.time });
        }
    }
    Ok(())
}

fn same(again: &Answer, before: &Answer, s: &Step<'_>, path: &Path) -> Result<(), Broken> {
    for ((what, one), (_, two)) in parts(before).iter().zip(&parts(again)) {
        for (index, (first, second)) in one.iter().zip(two).enumerate() {
            if first.to_bits() != second.to_bits() {
                let (first, second, path) = (*first, *second, path.number);
                return Err(Broken::Impure { what, index, first, second, path, time: s.time });
            }
        }
    }
    Ok(())
}

fn restart(link: &dyn Link, s: &Step<'_>, path: &Path, peak: &[f64]) -> Result<(), Broken> {
    let (d, v) = (s.at.d, s.at.v);
    let at = Kinematics { d, v, d0: d, v0: v, dt: 0.0 };
    let next = Answer::of(link, &at, &s.answer.trial);
    for (index, (before, after)) in s.answer.f.iter().zip(&next.f).enumerate() {
        let close = (before - after).abs() <= 1e-9 * peak[index];
        if !close {
            let (before, after, path) = (*before, *after, path.number);
            return Err(Broken::Restart { index, before, after, path, time: s.time });
        }
    }
    let size: f64 = peak.iter().zip(&path.scale).map(|(f, d)| f * d).sum();
    for (which, value) in [("hysteretic", next.energy.hysteretic), ("viscous", next.energy.viscous)]
    {
        if value.abs() > 1e-9 * size {
            return Err(Broken::NegativeDissipation {
                which,
                value,
                path: path.number,
                time: s.time,
            });
        }
    }
    Ok(())
}

fn contact(link: &dyn Link, s: &Step<'_>, path: &Path) -> Result<(), Broken> {
    let mut contacts = Vec::new();
    link.contacts(&s.at, &s.answer.trial, &s.answer.f, &mut contacts);
    let wrong = |what, value| Broken::Contact { what, value, path: path.number, time: s.time };
    for c in contacts {
        if !c.gap.is_finite() {
            return Err(wrong("gap", c.gap));
        }
        if !(c.normal.is_finite() && c.normal >= 0.0) {
            return Err(wrong("normal", c.normal));
        }
    }
    Ok(())
}

/// `k` and `c` against central difference quotients.
pub(super) fn tangents(
    kit: &Kit,
    link: &dyn Link,
    path: &Path,
    report: &mut Report,
) -> Result<(), Broken> {
    let peak = peaks(link, path)?;
    let n = path.scale.len();
    let mut step = 0_usize;
    march(link, path, 2, COARSE, |s| {
        step += 1;
        if kit.quick && !step.is_multiple_of(SPARSE) {
            return Ok(());
        }
        for column in (0..n).filter(|i| path.scale[*i] > 0.0) {
            for rate in [false, true] {
                let scale = path.scale[column] * if rate { path.omega } else { 1.0 };
                let moved = |h: f64| {
                    let mut x = if rate { s.at.v.to_vec() } else { s.at.d.to_vec() };
                    x[column] += h;
                    let at = if rate {
                        Kinematics { v: &x, ..s.at }
                    } else {
                        Kinematics { d: &x, ..s.at }
                    };
                    s.before.ask(&at).f
                };
                let h = STEP * scale;
                let (plus, minus) = (moved(h), moved(-h));
                let matrix = if rate { &s.answer.c } else { &s.answer.k };
                let tolerance =
                    |row: usize| TANGENT * (peak[row] / scale + matrix[row * n + column].abs());
                let kink = (0..n).any(|i| {
                    let jump = (plus[i] - 2.0 * s.answer.f[i] + minus[i]) / h;
                    jump.abs() > tolerance(i)
                });
                if kink {
                    report.skipped += 1;
                    continue;
                }
                report.tangents += 1;
                for row in 0..n {
                    let quotient = (plus[row] - minus[row]) / (2.0 * h);
                    let given = matrix[row * n + column];
                    if (given - quotient).abs() > tolerance(row) {
                        let which = if rate { "c" } else { "k" };
                        let (path, time) = (path.number, s.time);
                        return Err(Broken::Tangent {
                            which,
                            row,
                            column,
                            given,
                            quotient,
                            path,
                            time,
                        });
                    }
                }
            }
        }
        Ok(())
    })
}

/// No dependence on speed, nor on the step along a straight path.
pub(super) fn rates(link: &dyn Link, path: &Path) -> Result<(), Broken> {
    let peak = peaks(link, path)?;
    let different = |one: &[f64], two: &[f64], relative: f64, change| {
        let index = (0..one.len()).find(|&i| (one[i] - two[i]).abs() > relative * peak[i]);
        index.map_or(Ok(()), |index| {
            let (first, second) = (one[index], two[index]);
            Err(Broken::DependsOnRate { path: path.number, index, first, second, change })
        })
    };
    march(link, path, 1, COARSE, |s| {
        let v: Vec<f64> = s.at.v.iter().map(|x| 10.0 * x).collect();
        let v0: Vec<f64> = s.at.v0.iter().map(|x| 10.0 * x).collect();
        let fast = Kinematics { v: &v, v0: &v0, dt: 0.1 * s.at.dt, ..s.at };
        different(&s.answer.f, &s.before.ask(&fast).f, 1e-9, "at ten times the speed")
    })?;
    let end = path.at(0.37 * path.period()).0;
    let straight = |steps: usize| {
        let mut driver = Driver::starting_at(link, &vec![0.0; end.len()], &end);
        for i in 1..=steps {
            let d: Vec<f64> = end.iter().map(|x| x * i as f64 / steps as f64).collect();
            driver.step(&d, &end, 1.0);
        }
        driver.f
    };
    different(&straight(400), &straight(800), 1e-3, "with half the step on a straight path")
}

//! The kit passes a sound law and catches every way to spoil it.

use super::*;
use crate::{Axis, Coordinates, Energy, Field, Kinematics, Response};
use std::borrow::Cow;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

const K: f64 = 100.0;
const YIELD: f64 = 0.4;
const C: f64 = 2.0;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Spoil {
    Nothing,
    Stiffness,
    Damping,
    Dissipation,
    NegativeDissipation,
    Purity,
    Trial,
    Dummy,
    Memory,
    Circulation,
    Finite,
    Restart,
    ThresholdOnStep,
    HiddenRates,
}

/// Elastic–plastic spring with a dashpot, and a second uncoupled linear spring.
#[derive(Debug)]
struct Law {
    spoil: Spoil,
    c: f64,
    calls: AtomicU64,
}

fn law(spoil: Spoil) -> Law {
    Law { spoil, c: C, calls: AtomicU64::new(0) }
}

impl Link for Law {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1, Axis::U2])
    }
    fn history(&self) -> Cow<'static, [Field]> {
        vec![Field::new("plastic", "m"), Field::new("taken", "J")].into()
    }
    fn uses_rates(&self) -> bool {
        self.spoil != Spoil::HiddenRates
    }
    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = K;
        k[3] = K;
        if self.spoil == Spoil::Dummy {
            k[1] = 1.5 * K;
            k[2] = 1.5 * K;
        }
    }
    fn respond(&self, at: &Kinematics<'_>, was: &[f64], trial: &mut [f64], out: &mut Response<'_>) {
        let elastic = K * (at.d[0] - was[0]);
        let force = elastic.clamp(-YIELD, YIELD);
        let before = K * (at.d0[0] - was[0]);
        trial[0] = at.d[0] - force / K;
        out.f[0] = force + self.c * at.v[0];
        out.f[1] = K * at.d[1];
        out.k[0] = if elastic == force { K } else { 0.0 };
        out.k[3] = K;
        out.c[0] = self.c;
        let slip = 0.5 * (before + force) * (trial[0] - was[0]);
        let stored = 0.5 * force * force / K + 0.5 * K * at.d[1] * at.d[1];
        let viscous = 0.5 * self.c * (at.v0[0].powi(2) + at.v[0].powi(2)) * at.dt;
        *out.energy = Energy { stored, hysteretic: slip.max(0.0), viscous };
        if self.spoil != Spoil::Trial {
            trial[1] = was[1];
        }
        self.damage(at, was, trial, out);
    }
}

impl Law {
    fn damage(&self, at: &Kinematics<'_>, was: &[f64], trial: &mut [f64], out: &mut Response<'_>) {
        let call = self.calls.fetch_add(1, Relaxed);
        match self.spoil {
            Spoil::Stiffness => out.k[3] *= 1.001,
            Spoil::Damping => out.c[2] = 0.01,
            Spoil::Dissipation => out.energy.hysteretic *= 0.95,
            Spoil::NegativeDissipation => {
                out.energy.stored += 2.0 * out.energy.viscous;
                out.energy.viscous = -out.energy.viscous;
            }
            Spoil::Purity => out.f[0] *= 1.0 + 1e-15 * (call % 7) as f64,
            Spoil::Memory => trial[1] = call as f64,
            Spoil::Finite => out.c[3] = f64::NAN,
            Spoil::Restart if at.dt > 0.0 => out.f[1] += 0.01,
            Spoil::Circulation => {
                // f = Q × d gives energy on loops of one sense; the work is booked as stored.
                let q = 500.0;
                out.f[0] += q * at.d[1];
                out.f[1] -= q * at.d[0];
                out.k[1] += q;
                out.k[2] -= q;
                let mean = [0.5 * (at.d[0] + at.d0[0]), 0.5 * (at.d[1] + at.d0[1])];
                let work = q * (mean[1] * (at.d[0] - at.d0[0]) - mean[0] * (at.d[1] - at.d0[1]));
                trial[1] = was[1] + work;
                out.energy.stored += trial[1];
            }
            Spoil::ThresholdOnStep => {
                let jump = (at.d[1] - at.d0[1]).abs();
                out.f[1] += 1000.0 * jump * at.d[1].signum();
            }
            _ => {}
        }
    }
}

fn kit() -> Kit {
    Kit::new(&[0.01, 0.01], 0.5)
}

fn broken(spoil: Spoil) -> ConformanceError {
    kit().check(&law(spoil)).expect_err("the kit must notice")
}

#[test]
fn a_sound_law_conforms() {
    let report = kit().check(&law(Spoil::Nothing)).unwrap();
    assert!(report.tangents > 1000 && report.skipped < 100, "{report:?}");
    assert!(report.energy_error < 1e-3, "{report:?}");
    let mut slow = law(Spoil::Nothing);
    slow.c = 0.0;
    kit().rate_independent().check(&slow).unwrap();
}

#[test]
fn equal_seeds_give_equal_paths() {
    let check = |seed| kit().seed(seed).check(&law(Spoil::Nothing)).unwrap();
    assert_eq!(check(3), check(3));
    assert_ne!(check(3), check(4));
}

#[test]
fn notices_wrong_tangents() {
    let at = |e| match e {
        ConformanceError::Tangent { which, row, column, .. } => (which, row, column),
        e => panic!("{e}"),
    };
    assert_eq!(at(broken(Spoil::Stiffness)), ("k", 1, 1));
    assert_eq!(at(broken(Spoil::Damping)), ("c", 1, 0));
}

#[test]
fn notices_wrong_energies() {
    assert!(matches!(broken(Spoil::Dissipation), ConformanceError::Balance { .. }));
    let e = broken(Spoil::NegativeDissipation);
    assert!(matches!(e, ConformanceError::NegativeDissipation { which: "viscous", .. }), "{e}");
}

#[test]
fn notices_energy_from_nothing_unless_it_is_allowed() {
    let e = broken(Spoil::Circulation);
    assert!(matches!(e, ConformanceError::GivesEnergy { .. }), "{e}");
    kit().active().check(&law(Spoil::Circulation)).unwrap();
}

#[test]
fn notices_memory_in_the_law() {
    assert!(matches!(broken(Spoil::Purity), ConformanceError::Impure { what: "f", .. }));
    assert!(matches!(broken(Spoil::Memory), ConformanceError::Impure { what: "trial", .. }));
}

#[test]
fn notices_rates_that_are_said_to_be_unused() {
    assert!(matches!(broken(Spoil::HiddenRates), ConformanceError::UsesRates { .. }));
}

#[test]
fn notices_what_is_not_written_or_not_finite() {
    let e = broken(Spoil::Trial);
    assert!(matches!(e, ConformanceError::NotFinite { what: "trial", index: 1, .. }), "{e}");
    assert!(matches!(broken(Spoil::Finite), ConformanceError::NotFinite { what: "c", .. }));
}

#[test]
fn notices_an_indefinite_dummy_and_a_wrong_number_of_coordinates() {
    let e = broken(Spoil::Dummy);
    assert!(matches!(e, ConformanceError::EngagedStiffness { row: 1, .. }), "{e}");
    let e = Kit::new(&[1.0], 1.0).check(&law(Spoil::Nothing)).unwrap_err();
    assert_eq!(e, ConformanceError::Coordinates { link: 2, kit: 1 });
}

#[test]
fn notices_a_force_that_changes_when_a_step_starts() {
    assert!(matches!(broken(Spoil::Restart), ConformanceError::Restart { index: 1, .. }));
}

#[test]
fn notices_rates_and_steps_in_a_law_that_should_not_see_them() {
    let e = kit().rate_independent().check(&law(Spoil::Nothing)).unwrap_err();
    assert!(matches!(e, ConformanceError::DependsOnRate { index: 0, .. }), "{e}");
    let path = path::Path::random(&[0.01, 0.01], &[0.0, 0.0], 0.5, 1, 0);
    let mut coarse = law(Spoil::ThresholdOnStep);
    coarse.c = 0.0;
    let e = properties::rates(&coarse, &path).unwrap_err();
    assert!(matches!(e, ConformanceError::DependsOnRate { index: 1, .. }), "{e}");
}

#[test]
fn a_path_about_a_mean_starts_at_rest_and_has_consistent_rates() {
    let path = path::Path::random(&[0.01], &[-0.03], 0.5, 1, 0);
    assert_eq!(path.at(0.0).0, [0.0]);
    let h = 1e-6;
    for t in [0.1, 0.7, 0.99, 1.3, 2.9] {
        let quotient = (path.at(t + h).0[0] - path.at(t - h).0[0]) / (2.0 * h);
        assert!((quotient - path.at(t).1[0]).abs() < 1e-6, "{t}");
    }
    let over_a_cycle: f64 = (0..100).map(|i| path.at(2.0 + 0.02 * f64::from(i)).0[0]).sum();
    let without = path::Path::random(&[0.01], &[0.0], 0.5, 1, 0);
    let waves: f64 = (0..100).map(|i| without.at(2.0 + 0.02 * f64::from(i)).0[0]).sum();
    assert!(((over_a_cycle - waves) / 100.0 + 0.03).abs() < 1e-12);
}

/// Few steps first: what is sound passes, what is not is caught all the same.
#[test]
fn the_quick_kit_passes_and_catches_the_same() {
    const STROKE: crate::Stroke = crate::Stroke::about(0.0, 0.01);
    const EXERCISE: crate::Exercise =
        crate::Exercise { frequency: 1.0, strokes: &[STROKE, STROKE] };
    let kit = || Kit::of(&EXERCISE).quick();
    assert!(kit().check(&law(Spoil::Nothing)).is_ok());
    for spoil in [
        Spoil::Stiffness,
        Spoil::Dissipation,
        Spoil::NegativeDissipation,
        Spoil::Purity,
        Spoil::Trial,
        Spoil::Circulation,
        Spoil::Finite,
        Spoil::Restart,
    ] {
        assert!(kit().check(&law(spoil)).is_err(), "{spoil:?}");
    }
}

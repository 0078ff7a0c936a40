use super::*;
use crate::NLink;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::{along, cycle};
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Described, Driver, Value};

const KN: f64 = 5e8;

/// On a small scale, so that it slips, lifts and meets its rim on the paths of the kit.
fn coulomb() -> FrictionPendulum {
    FrictionPendulum { mu: Some(0.3), ..FrictionPendulum::new(KN, KN) }
}

fn by_speed() -> FrictionPendulum {
    FrictionPendulum {
        friction_model: FrictionModel::Velocity,
        mu: None,
        mu_slow: Some(0.05),
        mu_fast: Some(0.4),
        rate: Some(20.0),
        ..coulomb()
    }
}

fn by_force() -> FrictionPendulum {
    FrictionPendulum {
        friction_model: FrictionModel::VelocityForce,
        mu: None,
        a_slow: Some(0.5),
        n_slow: Some(0.85),
        a_fast: Some(1.5),
        n_fast: Some(0.8),
        rate_0: Some(20.0),
        rate_1: 1e-4,
        rate_2: 1e-9,
        ..coulomb()
    }
}

fn by_pressure() -> FrictionPendulum {
    FrictionPendulum {
        friction_model: FrictionModel::VelocityPressure,
        area: Some(1e-3),
        delta_mu: Some(0.25),
        pressure_rate: Some(1e-8),
        ..by_speed()
    }
}

fn models() -> [FrictionPendulum; 4] {
    [coulomb(), by_speed(), by_force(), by_pressure()]
}

/// LK-11: 1 MN, R = 1.5 m, μ = 0.06.
fn large(slow: f64) -> FrictionPendulum {
    FrictionPendulum {
        friction_model: FrictionModel::Velocity,
        mu: None,
        mu_slow: Some(slow),
        mu_fast: Some(0.06),
        rate: Some(20.0),
        radius: 1.5,
        ..FrictionPendulum::new(1e10, 1e10)
    }
}

const SCALE: [f64; 3] = [1e-4, 2e-4, 1.5e-4];

#[test]
fn conforms_flat_with_every_friction_model() {
    let kit = || Kit::new(&SCALE, 5.0);
    kit().rate_independent().assert(&FrictionPendulum::new(KN, KN));
    kit().rate_independent().assert(&coulomb());
    for law in models() {
        kit().assert(&law);
        for pull in [false, true] {
            kit().assert(&FrictionPendulum { pull, damping: 1.3e6, ..law.clone() });
        }
    }
}

#[test]
fn conforms_where_it_breaks_away_and_with_a_dashpot_beside_its_spring() {
    for law in models() {
        let law = FrictionPendulum { mu_static: Some(0.6), ..law };
        Kit::new(&SCALE, 5.0).assert(&law);
        Kit::new(&SCALE, 5.0).assert(&FrictionPendulum {
            static_slip: 1e-5,
            cs: 1e6,
            ..law.clone()
        });
        let law = FrictionPendulum { radius: 1e-3, rise: true, cs: 1e6, ..law };
        Kit::new(&SCALE, 5.0).assert(&law);
    }
}

#[test]
fn conforms_as_a_pendulum_whose_force_has_no_potential() {
    for law in models() {
        for surface in [Surface::Shallow, Surface::Spherical] {
            let law = FrictionPendulum { radius: 1e-3, surface, ..law.clone() };
            Kit::new(&SCALE, 5.0).active().assert(&law);
            Kit::new(&SCALE, 5.0).active().assert(&FrictionPendulum { damping: 1.3e6, ..law });
        }
    }
}

#[test]
fn conforms_as_a_pendulum_that_rises_and_has_one() {
    for law in models() {
        for surface in [Surface::Shallow, Surface::Spherical] {
            let law = FrictionPendulum { radius: 1e-3, surface, rise: true, ..law.clone() };
            Kit::new(&SCALE, 5.0).assert(&law);
            Kit::new(&SCALE, 5.0).assert(&FrictionPendulum { damping: 1e5, ..law.clone() });
            Kit::new(&SCALE, 5.0).assert(&FrictionPendulum { damping: 1e5, pull: true, ..law });
        }
    }
}

#[test]
fn conforms_with_a_rim() {
    let (stop, stop_stiffness) = (Some(1e-4), Some(0.3 * KN));
    for law in models() {
        Kit::new(&SCALE, 5.0).assert(&FrictionPendulum { stop, stop_stiffness, ..law });
    }
    let law = FrictionPendulum { radius: 1e-3, rise: true, ..coulomb() };
    Kit::new(&SCALE, 5.0).assert(&FrictionPendulum { stop, stop_stiffness, ..law });
}

#[test]
fn conforms_beyond_the_steepest_slope_and_always_pressed() {
    let (radius, surface) = (1.5e-4, Surface::Spherical);
    let law = FrictionPendulum { radius, surface, ..coulomb() };
    Kit::new(&[1e-5, 2e-4, 1.5e-4], 5.0).active().assert(&law);
    Kit::new(&[1e-5, 2e-4, 1.5e-4], 5.0).assert(&FrictionPendulum { rise: true, ..law });
}

#[test]
fn the_shallow_pendulum_is_an_nlink_with_a_radius() {
    let bearing = FrictionPendulum {
        radius: 1e-3,
        damping: 1e6,
        pull: true,
        mu_static: Some(0.5),
        cs: 1e6,
        ..by_speed()
    };
    let link = NLink {
        mu_static: bearing.mu_static,
        cs: bearing.cs,
        radius: 1e-3,
        damping: 1e6,
        pull: true,
        mu_slow: bearing.mu_slow,
        mu_fast: bearing.mu_fast,
        rate: bearing.rate,
        ks: Some(KN),
        ..NLink::new(KN)
    };
    let (mut one, mut two) = (Driver::new(&bearing), Driver::new(&link));
    // Lifts, touches and slips in all directions.
    for i in 1..400 {
        let t = 0.02 * f64::from(i);
        let d = [1e-4 * ((7.0 * t).sin() - 0.5), 3e-4 * (5.0 * t).sin(), 2e-4 * (3.0 * t).cos()];
        let v = [0.014 * (7.0 * t).cos(), 0.03 * (5.0 * t).cos(), -0.012 * (3.0 * t).sin()];
        one.step(&d, &v, 1e-3);
        two.step(&d, &v, 1e-3);
        for (a, b) in one.f.iter().zip(&two.f) {
            assert_relative_eq!(a, b, max_relative = 1e-9, epsilon = 1e-6);
        }
    }
    assert_relative_eq!(one.energy.hysteretic, two.energy.hysteretic, max_relative = 1e-9);
}

#[test]
fn a_cycle_encloses_four_mu_w_d() {
    let law = large(0.06);
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.0, 0.0]);
    cycle(&mut driver, -1e-4, 0.1, 2000);
    assert_relative_eq!(cycle(&mut driver, -1e-4, 0.1, 2000), 24_000.0, max_relative = 1e-4);
}

#[test]
fn friction_that_grows_with_speed_encloses_the_published_energy() {
    let law = large(0.03);
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.0, 0.0]);
    cycle(&mut driver, -1e-4, 0.1, 4000);
    // 4 ∫ (0.06 − 0.03 e^(−20 v)) W du over a quarter of u = 0.1 sin 2πt.
    assert_relative_eq!(cycle(&mut driver, -1e-4, 0.1, 4000), 23_922.377, max_relative = 1e-4);
}

#[test]
fn the_force_is_w_u_over_r_and_mu_w_against_the_motion_in_any_direction() {
    let law = large(0.06);
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.0, 0.0]);
    along(&mut driver, &[-1e-4, 0.06, 0.08], 200);
    let expected = 1e6 * (0.1 / 1.5 + 0.06);
    assert_relative_eq!(driver.f[1], 0.6 * expected, max_relative = 1e-9);
    assert_relative_eq!(driver.f[2], 0.8 * expected, max_relative = 1e-9);
    // Turned by 90°: the friction follows, the pendulum does not.
    along(&mut driver, &[-1e-4, 0.06 - 0.08, 0.08 + 0.06], 4000);
    assert_relative_eq!(driver.f[1], 1e6 * (-0.02 / 1.5 - 0.06 * 0.8), max_relative = 1e-3);
    assert_relative_eq!(driver.f[2], 1e6 * (0.14 / 1.5 + 0.06 * 0.6), max_relative = 1e-3);
}

#[test]
fn a_sphere_pulls_back_harder_than_its_tangent() {
    let law =
        FrictionPendulum { surface: Surface::Spherical, mu: Some(0.0), radius: 1.5, ..coulomb() };
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.9, 0.0]);
    assert_relative_eq!(driver.f[1], KN * 1e-4 * 0.9 / 1.2, max_relative = 1e-12);
}

#[test]
fn rising_stores_the_work_of_the_weight() {
    let law = FrictionPendulum {
        surface: Surface::Spherical,
        rise: true,
        radius: 1.5,
        ..FrictionPendulum::new(KN, KN)
    };
    let mut driver = Driver::new(&law);
    let n = KN * 1e-4;
    driver.to(&[-1e-4, 0.0, 0.0]);
    // The load goes up by R − √(R² − u²) at constant force.
    driver.to(&[-1e-4 + 0.3, 0.9, 0.0]);
    assert_relative_eq!(driver.f[0], -n, max_relative = 1e-9);
    assert_relative_eq!(driver.f[1], n * 0.75, max_relative = 1e-9);
    assert_relative_eq!(driver.energy.stored, 0.5 * n * 1e-4, max_relative = 1e-9);
}

#[test]
fn a_lifted_bearing_has_no_shear_but_its_rim() {
    let law =
        FrictionPendulum { radius: 1.5, stop: Some(0.2), stop_stiffness: Some(1e7), ..coulomb() };
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.1, 0.0]);
    driver.to(&[1e-3, 0.15, 0.0]);
    assert_eq!(driver.f, [0.0; 3]);
    driver.to(&[1e-3, 0.0, -0.23]);
    assert_relative_eq!(driver.f[2], -3e5, max_relative = 1e-9);
    // It touches halfway in the step and is anchored there.
    driver.to(&[1e-3, 0.1, 0.0]);
    driver.to(&[-1e-3, 0.1 + 4e-5, 0.0]);
    assert_relative_eq!(driver.f[1], KN * 2e-5 + KN * 1e-3 * 0.100_04 / 1.5, max_relative = 1e-9);
}

#[test]
fn the_contact_tells_stick_from_slip() {
    let law = coulomb();
    let mut driver = Driver::new(&law);
    let mut tell = |d: [f64; 3]| {
        driver.to(&d);
        driver.contacts()[0]
    };
    assert!(!tell([-1e-4, 1e-5, 0.0]).slipping);
    let slips = tell([-1e-4, 1e-3, 0.0]);
    assert!(slips.slipping);
    assert_relative_eq!(slips.normal, KN * 1e-4, max_relative = 1e-12);
    let open = tell([2e-4, 1e-3, 0.0]);
    assert_eq!((open.gap, open.normal, open.slipping), (2e-4, 0.0, false));
}

#[test]
fn refuses_what_does_not_fit_together() {
    let with = |given: &[(&str, f64)], model: &str| {
        let mut all = numbers(&[("kn", 1e9), ("ks", 1e8)]);
        all.extend(numbers(given));
        all.push(("friction_model", Value::Text(model.into())));
        read::<FrictionPendulum>(&all)
    };
    let name = |given: &[(&str, f64)], model: &str| {
        with(given, model).unwrap_err().parameter().map(str::to_owned).unwrap()
    };
    assert!(with(&[("mu", 0.1)], "Coulomb").is_ok());
    assert_eq!(name(&[], "Coulomb"), "mu");
    assert_eq!(name(&[("mu", 0.1), ("mu_slow", 0.1)], "Coulomb"), "mu_slow");
    assert_eq!(name(&[("mu_slow", 0.1), ("mu_fast", 0.2)], "Velocity"), "rate");
    assert_eq!(name(&[("mu", 0.1), ("rate_1", 1.0)], "Coulomb"), "rate_1");
    assert_eq!(name(&[("mu", 0.1), ("stop", 1.0)], "Coulomb"), "stop");
    let pressure = [
        ("mu_slow", 0.1),
        ("mu_fast", 0.2),
        ("rate", 20.0),
        ("area", 1.0),
        ("delta_mu", 0.3),
        ("pressure_rate", 1e-8),
    ];
    assert_eq!(name(&pressure, "VelocityPressure"), "delta_mu");
    let text = with(&[], "VelocityForce").unwrap_err().to_string();
    assert!(text.contains("`a_slow`, `n_slow`, `a_fast`, `n_fast`, `rate_0`"), "{text}");
    let flat = FrictionPendulum { rise: true, ..coulomb() };
    assert_eq!(flat.check().unwrap_err().parameter(), Some("rise"));
    let flat = FrictionPendulum { surface: Surface::Spherical, ..coulomb() };
    assert_eq!(flat.check().unwrap_err().parameter(), Some("surface"));
}

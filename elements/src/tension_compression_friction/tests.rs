use super::*;
use crate::FrictionPendulum;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::along;
use approx::assert_relative_eq;
use trilith_element::Driver;
use trilith_element::conformance::Kit;

const KN: f64 = 5e8;
const KT: f64 = 2e8;
const SCALE: [f64; 3] = [1e-4, 2e-4, 1.5e-4];

fn coulomb() -> TensionCompressionFriction {
    let (mu, mu_tension) = (Some(0.3), Some(0.6));
    TensionCompressionFriction { mu, mu_tension, ..TensionCompressionFriction::new(KN, KT, KN) }
}

fn by_speed() -> TensionCompressionFriction {
    TensionCompressionFriction {
        mu_slow: Some(0.05),
        mu_fast: Some(0.4),
        rate: Some(20.0),
        mu_slow_tension: Some(0.1),
        mu_fast_tension: Some(0.6),
        rate_tension: Some(50.0),
        ..TensionCompressionFriction::new(KN, KT, KN)
    }
}

#[test]
fn conforms_with_and_without_clearances_dashpot_and_radius() {
    let kit = || Kit::new(&SCALE, 5.0);
    for law in [coulomb(), by_speed()] {
        for (gap_compression, gap_tension) in [(0.0, 0.0), (3e-5, 0.0), (0.0, 2e-5), (2e-5, 4e-5)] {
            let law = TensionCompressionFriction { gap_compression, gap_tension, ..law.clone() };
            kit().assert(&law);
            for pull in [false, true] {
                kit().assert(&TensionCompressionFriction { damping: 1.3e6, pull, ..law.clone() });
            }
            kit().active().assert(&TensionCompressionFriction { radius: 1e-3, ..law });
        }
    }
    kit().rate_independent().assert(&coulomb());
    kit().rate_independent().assert(&TensionCompressionFriction::new(KN, KT, KN));
}

#[test]
fn each_side_has_its_clearance_its_stiffness_and_its_friction() {
    let (gap_compression, gap_tension) = (1e-3, 2e-3);
    let law = TensionCompressionFriction { gap_compression, gap_tension, ..coulomb() };
    let mut driver = Driver::new(&law);
    driver.to(&[-1.1e-3, 0.0, 0.0]);
    along(&mut driver, &[-1.1e-3, 3e-3, 4e-3], 10);
    let n = KN * 1e-4;
    assert_relative_eq!(driver.f[0], -n, max_relative = 1e-9);
    assert_relative_eq!(driver.f[1], 0.3 * n * 0.6, max_relative = 1e-9);
    assert_relative_eq!(driver.f[2], 0.3 * n * 0.8, max_relative = 1e-9);
    driver.to(&[1.9e-3, 0.0, 0.0]);
    assert_eq!(driver.f, [0.0; 3]);
    driver.to(&[2.1e-3, 0.0, 0.0]);
    along(&mut driver, &[2.1e-3, -3e-3, 0.0], 10);
    let n = KT * 1e-4;
    assert_relative_eq!(driver.f[0], n, max_relative = 1e-9);
    assert_relative_eq!(driver.f[1], -0.6 * n, max_relative = 1e-9);
}

#[test]
fn friction_of_compression_holds_in_tension_where_nothing_is_said() {
    let law = TensionCompressionFriction { mu_tension: None, ..coulomb() };
    let mut driver = Driver::new(&law);
    driver.to(&[1e-4, 0.0, 0.0]);
    along(&mut driver, &[1e-4, 1e-3, 0.0], 10);
    assert_relative_eq!(driver.f[1], 0.3 * KT * 1e-4, max_relative = 1e-9);
}

#[test]
fn a_step_from_one_side_to_the_other_is_anchored_where_it_went_through() {
    let mut law = coulomb();
    law.gap_tension = 1e-4;
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.0, 0.0]);
    // Through 0 at a third and through 0.1 mm at two thirds of the way.
    driver.to(&[2e-4, 3e-5, 0.0]);
    assert_relative_eq!(driver.f[1], KN * 1e-5, max_relative = 1e-9);
}

#[test]
fn pulled_at_the_surface_pushes_out() {
    let law =
        TensionCompressionFriction { radius: 2.0, ..TensionCompressionFriction::new(KN, KT, KN) };
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.1, 0.0]);
    assert_relative_eq!(driver.f[1], KN * 1e-4 * 0.05, max_relative = 1e-9);
    driver.to(&[1e-4, 0.1, 0.0]);
    assert_relative_eq!(driver.f[1], -KT * 1e-4 * 0.05, max_relative = 1e-9);
}

#[test]
fn in_compression_it_is_a_friction_pendulum() {
    let radius = 1e-3;
    let one = TensionCompressionFriction { radius, damping: 1e6, ..coulomb() };
    let two =
        FrictionPendulum { mu: Some(0.3), radius, damping: 1e6, ..FrictionPendulum::new(KN, KN) };
    let (mut one, mut two) = (Driver::new(&one), Driver::new(&two));
    for i in 1..400 {
        let t = 0.02 * f64::from(i);
        let d = [1e-4 * ((7.0 * t).sin() - 1.1), 3e-4 * (5.0 * t).sin(), 2e-4 * (3.0 * t).cos()];
        let v = [0.014 * (7.0 * t).cos(), 0.03 * (5.0 * t).cos(), -0.012 * (3.0 * t).sin()];
        one.step(&d, &v, 1e-3);
        two.step(&d, &v, 1e-3);
        assert_eq!(one.f, two.f);
    }
}

#[test]
fn the_contact_is_the_closer_side() {
    let (gap_compression, gap_tension) = (1e-3, 2e-3);
    let law = TensionCompressionFriction { gap_compression, gap_tension, ..coulomb() };
    let tell = |d1: f64| {
        let d = [d1, 0.0, 0.0];
        let mut driver = Driver::new(&law);
        driver.to(&d);
        let all = driver.contacts();
        (all[0].gap, all[0].normal)
    };
    assert_eq!(tell(0.0), (1e-3, 0.0));
    assert_eq!(tell(1.5e-3).1, 0.0);
    assert_relative_eq!(tell(1.5e-3).0, 0.5e-3, max_relative = 1e-9);
    assert_relative_eq!(tell(2.5e-3).1, KT * 0.5e-3, max_relative = 1e-9);
}

#[test]
fn refuses_half_a_set_of_friction() {
    let name = |given: &[(&str, f64)]| {
        let mut all = numbers(&[("kn", 1e9), ("kt", 1e9), ("ks", 1e8)]);
        all.extend(numbers(given));
        let read = read::<TensionCompressionFriction>(&all);
        read.err().map(|e| e.parameter().unwrap_or("?").to_owned())
    };
    assert_eq!(name(&[]), None);
    assert_eq!(name(&[("mu", 0.1), ("mu_tension", 0.2)]), None);
    assert_eq!(name(&[("mu", 0.1), ("rate", 0.2)]).as_deref(), Some("mu"));
    assert_eq!(name(&[("mu_slow", 0.1), ("rate", 0.2)]).as_deref(), Some("mu_fast"));
    assert_eq!(
        name(&[("mu_slow_tension", 0.1), ("mu_fast_tension", 0.2)]).as_deref(),
        Some("rate_tension")
    );
    assert_eq!(name(&[("mu_tension", 0.1), ("rate_tension", 1.0)]).as_deref(), Some("mu_tension"));
}

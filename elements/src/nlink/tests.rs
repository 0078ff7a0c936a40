use super::*;
use crate::shared::parameters::{numbers, read};
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, History};

const KN: f64 = 5e8;
const MU: f64 = 0.4;

fn friction() -> NLink {
    NLink { mu: Some(MU), ks: Some(KN), ..NLink::new(KN) }
}

fn with_speed() -> NLink {
    let (mu_slow, mu_fast, rate) = (Some(0.05), Some(0.4), Some(20.0));
    NLink { mu_slow, mu_fast, rate, ks: Some(0.6 * KN), ..NLink::new(KN) }
}

fn history(driver: &Driver<'_>) -> NLinkHistory {
    NLinkHistory::load(&driver.history)
}

#[test]
fn conforms_with_and_without_friction_dashpot_and_pull() {
    let scale = [1e-4, 2e-4, 1.5e-4];
    Kit::new(&scale, 5.0).rate_independent().assert(&NLink::new(KN));
    Kit::new(&scale, 5.0).rate_independent().assert(&friction());
    Kit::new(&scale, 5.0).rate_independent().assert(&NLink { opening: 5e-5, ..friction() });
    for pull in [false, true] {
        Kit::new(&scale, 5.0).assert(&NLink { pull, damping: 1.3e6, ..friction() });
        Kit::new(&scale, 5.0).assert(&NLink {
            pull,
            damping: 1.3e7,
            opening: -3e-5,
            ..with_speed()
        });
    }
    let all = NLink { r1: 1e3, r3: 5e3, damping: 1e6, ..friction() };
    Kit::new(&[1e-4, 1e-4, 1e-4, 1e-2, 1e-2], 5.0).assert(&all);
}

#[test]
fn conforms_where_it_breaks_away_and_with_a_dashpot_beside_its_spring() {
    let scale = [1e-4, 2e-4, 1.5e-4];
    let static_slip = 1e-5;
    let away = NLink { mu_static: Some(0.6), static_slip, ..friction() };
    Kit::new(&scale, 5.0).rate_independent().assert(&away);
    Kit::new(&scale, 5.0).assert(&NLink { static_slip: 0.0, cs: 1e6, ..away.clone() });
    Kit::new(&scale, 5.0).assert(&NLink { opening: 5e-5, cs: 1e6, ..friction() });
    for pull in [false, true] {
        let law = NLink { mu_static: Some(0.6), static_slip, pull, damping: 1.3e6, ..with_speed() };
        Kit::new(&scale, 5.0).assert(&law);
        Kit::new(&scale, 5.0).assert(&NLink { cs: 2e6, opening: -3e-5, ..law });
    }
    // Friction that falls with the speed.
    let falling = NLink { mu_slow: Some(0.4), mu_fast: Some(0.1), ..with_speed() };
    Kit::new(&scale, 5.0).assert(&falling);
    Kit::new(&scale, 5.0).assert(&NLink { cs: 2e6, ..falling });
    let back = NLink { radius: 1e-3, k_post: 0.1 * KN, cs: 1e6, ..away };
    Kit::new(&scale, 5.0).active().assert(&back);
}

/// A force that goes up in small steps: the limit is μ_static N, then falls to μ N over the slip, and is back after it stuck.
#[test]
fn static_friction_goes_with_the_slip_and_comes_back_with_rest() {
    let n = KN * 1e-4;
    let law = NLink { mu_static: Some(0.6), static_slip: 4e-4, ..friction() };
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.0, 0.0]);
    driver.to(&[-1e-4, 0.6e-4, 0.0]);
    assert_relative_eq!(driver.f[1], 0.6 * n, max_relative = 1e-9);
    // Slip s from u = s + τ/kₛ, τ = (0.6 − 0.2 s/s₀) N.
    driver.to(&[-1e-4, 2.4e-4, 0.0]);
    let s = (2.4e-4 - 0.6e-4) / (1.0 - 0.2 * 1e-4 / 4e-4);
    assert_relative_eq!(driver.f[1], (0.6 - 0.2 * s / 4e-4) * n, max_relative = 1e-9);
    driver.to(&[-1e-4, 9e-4, 0.0]);
    assert_relative_eq!(driver.f[1], 0.4 * n, max_relative = 1e-9);
    driver.to(&[-1e-4, 8.9e-4, 0.0]);
    driver.to(&[-1e-4, 9.2e-4, 0.0]);
    assert_relative_eq!(driver.f[1], 0.6 * n, max_relative = 1e-9);
    assert!(driver.contacts()[0].slipping);
}

/// Beside the spring in stick, and within the cone with it.
#[test]
fn the_dashpot_of_the_spring_stays_within_the_cone() {
    let (n, cs) = (KN * 1e-4, 1e6);
    let law = NLink { cs, ..friction() };
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.0, 0.0]);
    driver.step(&[-1e-4, 1e-6, 0.0], &[0.0, 1e-3, 0.0], 1e-3);
    assert_relative_eq!(driver.f[1], KN * 1e-6 + cs * 1e-3, max_relative = 1e-9);
    for i in 1..=40 {
        driver.step(&[-1e-4, 1e-6 + 1e-3 * f64::from(i), 0.0], &[0.0, 1.0, 0.0], 1e-3);
        assert_relative_eq!(driver.f[1], MU * n, max_relative = 1e-9);
    }
    // Slipping, the spring has taken over.
    assert_relative_eq!(
        driver.energy.stored - 0.5 * n * 1e-4,
        0.5 * (MU * n).powi(2) / KN,
        max_relative = 1e-3
    );
}

#[test]
fn conforms_with_restoring_forces_which_have_no_potential() {
    let scale = [1e-4, 2e-4, 1.5e-4];
    let law = NLink { k_post: 0.1 * KN, ..friction() };
    Kit::new(&scale, 5.0).active().rate_independent().assert(&law);
    let law = NLink { radius: 1e-3, damping: 1.3e6, ..with_speed() };
    Kit::new(&scale, 5.0).active().assert(&law);
}

#[test]
fn touching_is_closed_and_the_opening_is_free() {
    let link = NLink { opening: 1e-3, ..friction() };
    let mut driver = Driver::new(&link);
    driver.to(&[-0.9e-3, 0.0, 0.0]);
    assert_eq!((driver.f.as_slice(), history(&driver).closed), ([0.0; 3].as_slice(), 0.0));
    driver.to(&[-1e-3, 0.0, 0.0]);
    assert_eq!((driver.f[0], history(&driver).closed), (0.0, 1.0));
    driver.to(&[-1.2e-3, 0.0, 0.0]);
    assert_relative_eq!(driver.f[0], -KN * 0.2e-3, max_relative = 1e-12);
}

#[test]
fn slips_at_mu_n_in_the_direction_of_motion() {
    let link = friction();
    let mut driver = Driver::new(&link);
    driver.to(&[-1e-4, 0.0, 0.0]);
    driver.to(&[-1e-4, 0.3e-4, 0.0]);
    assert_relative_eq!(driver.f[1], KN * 0.3e-4, max_relative = 1e-12);
    assert_eq!(history(&driver).slip, 0.0);
    driver.to(&[-1e-4, 3e-3, 4e-3]);
    assert_relative_eq!(driver.f[1].hypot(driver.f[2]), MU * KN * 1e-4, max_relative = 1e-12);
    assert_relative_eq!(driver.f[1] / driver.f[2], 0.75, max_relative = 1e-12);
    assert_relative_eq!(history(&driver).slip, 5e-3 - MU * 1e-4, max_relative = 1e-3);
}

#[test]
fn a_friction_loop_dissipates_four_mu_n_times_the_slip_amplitude() {
    let link = friction();
    let (n, amplitude) = (KN * 1e-4, 2e-3);
    let mut driver = Driver::new(&link);
    driver.to(&[-1e-4, 0.0, 0.0]);
    let mut cycle = |from: f64| {
        let before = driver.energy.hysteretic;
        for i in 1..=4000 {
            let t = from + std::f64::consts::TAU * f64::from(i) / 4000.0;
            driver.to(&[-1e-4, amplitude * t.sin(), 0.0]);
        }
        driver.energy.hysteretic - before
    };
    cycle(0.0);
    // The elastic part of a reversal, 2 μN/kₛ, does not slip.
    let expected = 4.0 * MU * n * (amplitude - MU * n / KN);
    assert_relative_eq!(cycle(0.0), expected, max_relative = 1e-4);
}

#[test]
fn stick_slip_and_separation_balance_to_the_last_digit() {
    let link = friction();
    let mut driver = Driver::new(&link);
    for d in [
        [-1e-4, 0.0, 0.0],
        [-1e-4, 0.2e-4, 0.1e-4],
        [-1e-4, 0.6e-4, 0.1e-4],
        [-1e-4, 2e-4, 1e-4],
        [-1e-4, 1.9e-4, 1e-4],
        [-1e-4, 1.9e-4, 3e-4],
    ] {
        driver.to(&d);
    }
    let e = driver.energy;
    assert_relative_eq!(driver.work, e.stored + e.hysteretic, max_relative = 1e-12);
}

#[test]
fn the_anchor_does_not_survive_a_separation() {
    let link = friction();
    let mut driver = Driver::new(&link);
    driver.to(&[-1e-4, 0.0, 0.0]);
    driver.to(&[-1e-4, 0.3e-4, 0.0]);
    let stuck = driver.energy.stored;
    driver.to(&[1e-6, 0.3e-4, 0.0]);
    assert_eq!(driver.energy.stored, 0.0);
    // The elastic energy of the stuck contact turned into heat.
    assert_relative_eq!(driver.energy.hysteretic, stuck - 0.5 * KN * 1e-8, max_relative = 1e-9);
    driver.to(&[1e-6, 5e-4, 0.0]);
    driver.to(&[-1e-4, 5e-4, 0.0]);
    assert_eq!(driver.f[1], 0.0);
}

#[test]
fn a_closing_contact_is_anchored_where_it_touched() {
    let link = friction();
    let mut driver = Driver::new(&link);
    driver.to(&[3e-4, 0.0, 0.0]);
    driver.to(&[-1e-4, 1e-4, 0.0]);
    // Touched after three quarters of the step, at 0.75e-4.
    assert_relative_eq!(driver.f[1], KN * 0.25e-4, max_relative = 1e-9);
}

#[test]
fn the_dashpot_pulls_only_where_it_may_and_feeds_the_cone_only_where_it_may_not() {
    let (c, v) = (1e6, 1.0);
    let loose = NLink { damping: c, ..friction() };
    let held = NLink { pull: true, ..loose.clone() };
    let rising = |link: &NLink, d1, v1| {
        let mut driver = Driver::new(link);
        driver.to(&[-1e-4, 0.0, 0.0]);
        driver.step(&[d1, 1e-2, 0.0], &[v1, 0.0, 0.0], 1e-3);
        driver.f
    };
    let n = KN * 1e-4;
    assert_eq!(rising(&loose, -1e-4, v), [0.0; 3]);
    let f = rising(&held, -1e-4, v);
    assert_relative_eq!(f[0], c * v - n, max_relative = 1e-9);
    assert_relative_eq!(f[1], MU * n, max_relative = 1e-9);
    let f = rising(&loose, -1e-4, -v);
    assert_relative_eq!(f[0], -c * v - n, max_relative = 1e-9);
    assert_relative_eq!(f[1], MU * (c * v + n), max_relative = 1e-9);
    assert_eq!(rising(&held, 1e-9, v), [0.0; 3]);
}

#[test]
fn friction_grows_from_slow_to_fast() {
    let link = with_speed();
    let at = |speed: f64| {
        let mut driver = Driver::new(&link);
        driver.to(&[-1e-4, 0.0, 0.0]);
        driver.step(&[-1e-4, 1e-2, 0.0], &[0.0, speed, 0.0], 0.0);
        driver.f[1] / (KN * 1e-4)
    };
    assert_relative_eq!(at(0.0), 0.05, max_relative = 1e-9);
    assert_relative_eq!(at(0.1), 0.4 - 0.35 * (-2.0_f64).exp(), max_relative = 1e-9);
    assert_relative_eq!(at(10.0), 0.4, max_relative = 1e-9);
}

#[test]
fn a_pendulum_pulls_back_with_n_d_over_r() {
    let link = NLink { radius: 2.0, ..NLink::new(KN) };
    let mut driver = Driver::new(&link);
    driver.to(&[-1e-4, 0.0, 0.0]);
    driver.to(&[-1e-4, 0.1, -0.05]);
    assert_relative_eq!(driver.f[1], KN * 1e-4 * 0.1 / 2.0, max_relative = 1e-9);
    assert_relative_eq!(driver.f[2], -KN * 1e-4 * 0.05 / 2.0, max_relative = 1e-9);
    let rise = KN * 1e-4 * (0.01 + 0.0025) / 4.0;
    assert_relative_eq!(driver.energy.stored, rise + 0.5 * KN * 1e-8, max_relative = 1e-9);
}

#[test]
fn the_contact_tells_stick_from_slip() {
    let link = friction();
    let mut driver = Driver::new(&link);
    let mut tell = |d: [f64; 3]| {
        driver.to(&d);
        driver.contacts()[0]
    };
    let still = tell([-1e-4, 0.3e-4, 0.0]);
    assert!(!still.slipping);
    assert_relative_eq!(still.normal, KN * 1e-4, max_relative = 1e-12);
    assert!(tell([-1e-4, 5e-4, 1e-4]).slipping);
    let open = tell([2e-4, 5e-4, 1e-4]);
    assert_eq!((open.normal, open.gap, open.slipping), (0.0, 2e-4, false));
}

#[test]
fn rejects_contradictions_by_name() {
    let name = |given: &[(&str, f64)]| {
        read::<NLink>(&numbers(given)).unwrap_err().parameter().map(str::to_owned)
    };
    assert_eq!(name(&[("kn", 1.0), ("mu", 0.3)]).as_deref(), Some("ks"));
    assert_eq!(name(&[("kn", 1.0), ("mu_slow", 0.3)]).as_deref(), Some("mu_slow"));
    let both = [("kn", 1.0), ("ks", 1.0), ("mu", 0.3), ("mu_slow", 0.3)];
    assert_eq!(name(&both).as_deref(), Some("mu"));
    assert_eq!(name(&[("kn", 1.0), ("ks", 1.0), ("k_post", 1.0)]).as_deref(), Some("k_post"));
    let low = [("kn", 1.0), ("ks", 1.0), ("mu", 0.3), ("mu_static", 0.2)];
    assert_eq!(name(&low).as_deref(), Some("mu_static"));
    let alone = [("kn", 1.0), ("ks", 1.0), ("mu", 0.3), ("static_slip", 0.2)];
    assert_eq!(name(&alone).as_deref(), Some("static_slip"));
    assert_eq!(name(&[("kn", 1.0), ("cs", 1.0)]).as_deref(), Some("cs"));
    assert!(read::<NLink>(&numbers(&[("kn", 1.0), ("k_n", 1.0)])).is_err());
    assert!(read::<NLink>(&numbers(&[("kn", 1.0)])).is_ok());
}

#[test]
fn the_dashpot_takes_the_work_of_a_rate_that_is_linear_in_the_step() {
    let link = NLink { damping: 1e4, ..NLink::new(KN) };
    let mut driver = Driver::new(&link);
    driver.step(&[-1e-4, 0.0, 0.0], &[-0.3, 0.0, 0.0], 1e-3);
    let before = driver.energy.viscous;
    driver.step(&[-3e-4, 0.0, 0.0], &[-0.1, 0.0, 0.0], 1e-3);
    let expected = 1e4 * (0.09 + 0.03 + 0.01) / 3.0 * 1e-3;
    assert_relative_eq!(driver.energy.viscous - before, expected, max_relative = 1e-9);
}

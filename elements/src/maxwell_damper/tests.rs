use super::*;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::led;
use approx::assert_relative_eq;
use std::f64::consts::{PI, TAU};
use trilith_element::Driver;
use trilith_element::conformance::Kit;

fn law(k: f64, c: f64, exponent: f64) -> MaxwellDamper {
    read(&numbers(&[("k", k), ("c", c), ("exponent", exponent)])).unwrap()
}

#[test]
fn conforms_for_every_exponent_from_soft_to_stiff() {
    for exponent in [0.1, 0.35, 0.5, 0.9, 1.0, 1.5, 2.0] {
        for k in [3e5, 1e7] {
            Kit::new(&[0.05], 1.0).assert(&law(k, 2e4, exponent));
        }
    }
}

/// Force and heat after `time` under d = X sin ωt, by Runge-Kutta of fourth order on the equation itself.
fn integrated(law: &MaxwellDamper, x: f64, w: f64, time: f64, steps: u32) -> [f64; 2] {
    let slope = |t: f64, f: f64| {
        let rate = (f.abs() / law.c).powf(1.0 / law.exponent).copysign(f);
        [law.k * (x * w * (w * t).cos() - rate), f * rate]
    };
    let h = time / f64::from(steps);
    let [mut f, mut heat] = [0.0; 2];
    for i in 0..steps {
        let t = h * f64::from(i);
        let a = slope(t, f);
        let b = slope(t + 0.5 * h, f + 0.5 * h * a[0]);
        let c = slope(t + 0.5 * h, f + 0.5 * h * b[0]);
        let d = slope(t + h, f + h * c[0]);
        f += h / 6.0 * (a[0] + 2.0 * (b[0] + c[0]) + d[0]);
        heat += h / 6.0 * (a[1] + 2.0 * (b[1] + c[1]) + d[1]);
    }
    [f, heat]
}

fn harmonic(law: &MaxwellDamper, x: f64, w: f64, time: f64, steps: usize) -> Driver<'_> {
    led(law, time, steps, |t| (x * (w * t).sin(), x * w * (w * t).cos()))
}

#[test]
fn force_and_heat_are_of_second_order() {
    for exponent in [0.35, 0.5, 1.7] {
        let law = law(3e5, 2e4, exponent);
        let exact = integrated(&law, 0.05, TAU, 0.9, 200_000);
        let error = |steps| {
            let it = harmonic(&law, 0.05, TAU, 0.9, steps);
            [(it.f[0] - exact[0]).abs(), (it.energy.viscous - exact[1]).abs()]
        };
        let (coarse, fine) = (error(200), error(800));
        for i in 0..2 {
            let order = (coarse[i] / fine[i]).log2() / 2.0;
            assert!(order > 1.8, "α = {exponent}: {coarse:?}, {fine:?}");
            assert!(fine[i] < 1e-5 * exact[i].abs(), "α = {exponent}: {fine:?} of {exact:?}");
        }
    }
}

#[test]
fn a_flat_law_behind_a_stiff_spring_is_followed_in_steps_of_any_length() {
    let law = law(1e9, 2e4, 0.1);
    for steps in [20, 200, 20_000] {
        let it = harmonic(&law, 0.05, TAU, 1.0, steps);
        // At the end of the cycle the rate is X ω again, and the spring has no say.
        assert_relative_eq!(it.f[0], 2e4 * (0.05 * TAU).powf(0.1), max_relative = 1e-3);
    }
}

#[test]
fn harmonic_motion_gives_storage_and_loss_modulus() {
    // K' = K (ωτ)²/(1 + (ωτ)²), K'' = K ωτ/(1 + (ωτ)²), for K = 100, C = 5.
    let law = law(100.0, 5.0, 1.0);
    for (w, storage, loss) in
        [(5.0, 5.882_353, 23.529_412), (20.0, 50.0, 50.0), (50.0, 86.206_897, 34.482_759)]
    {
        let whole = (1.25_f64 * w / TAU).ceil() * TAU / w;
        let steps = 20_000;
        assert_relative_eq!(harmonic(&law, 1.0, w, whole, steps).f[0], loss, max_relative = 1e-6);
        let quarter = whole + 0.25 * TAU / w;
        assert_relative_eq!(
            harmonic(&law, 1.0, w, quarter, steps).f[0],
            storage,
            max_relative = 1e-6
        );
    }
}

#[test]
fn behind_a_stiff_spring_a_cycle_costs_what_the_dashpot_alone_costs() {
    // λ(α) = 4·2^α Γ(1 + α/2)²/Γ(2 + α); E = λ c X^(1+α) ω^α.
    for (exponent, lambda) in
        [(0.1, 3.882_445), (0.35, 3.627_472), (0.5, 3.496_077), (1.0, PI), (2.0, 2.666_667)]
    {
        let law = law(1e9, 1000.0, exponent);
        let w = 2.0 * TAU;
        let (first, second) =
            (harmonic(&law, 0.1, w, 0.5, 2000), harmonic(&law, 0.1, w, 1.0, 4000));
        let energy = lambda * 1000.0 * 0.1_f64.powf(1.0 + exponent) * w.powf(exponent);
        assert_relative_eq!(
            second.energy.viscous - first.energy.viscous,
            energy,
            max_relative = 2e-4
        );
    }
}

#[test]
fn a_step_of_any_size_gives_a_finite_force() {
    for exponent in [0.1, 0.5, 1.0, 2.0] {
        for k in [1.0, 1e12] {
            let law = law(k, 1e3, exponent);
            for (dt, d) in [(1e-8, 1e-3), (1e-8, 0.0), (1e-2, 1e-300), (1e-2, 1.0), (1e-2, -1.0)] {
                let it = led(&law, dt, 1, |t| (d * t / dt, d / dt));
                assert!(
                    it.f[0].is_finite() && it.energy.viscous >= 0.0,
                    "{law:?} {dt} {d}: {it:?}"
                );
                let most = k * d.abs() * (1.0 + 1e-12);
                assert!(it.f[0].abs() <= most, "{law:?} {dt} {d}: {it:?}");
            }
        }
    }
}

#[test]
fn a_static_step_leaves_the_force() {
    let law = law(3e5, 2e4, 0.5);
    let mut driver = Driver::new(&law);
    driver.step(&[0.01], &[0.5], 0.01);
    let before = driver.f[0];
    assert!(before > 0.0);
    driver.to(&[0.05]);
    assert_eq!(driver.f[0], before);
}

#[test]
fn refuses_exponents_out_of_range() {
    for exponent in [0.05, 2.5] {
        let given = numbers(&[("k", 1.0), ("c", 1.0), ("exponent", exponent)]);
        let range = MaxwellDamper::CARD.parameter("exponent").unwrap().range;
        assert!(!range.contains(exponent), "{given:?}");
    }
    assert!(read::<MaxwellDamper>(&numbers(&[("k", 1.0)])).is_err());
}

use super::*;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::{along, through};
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

const K: f64 = 2e7;
const PU: f64 = 1.5e5;

fn law(more: &[(&'static str, f64)], backbone: &str, sides: &str) -> SoilSpring {
    let mut all = numbers(&[("k", K), ("pu", PU)]);
    all.extend(numbers(more));
    all.push(("backbone", Value::Text(backbone.into())));
    all.push(("sides", Value::Text(sides.into())));
    read(&all).unwrap()
}

#[test]
fn conforms_with_every_backbone_on_every_side() {
    for backbone in ["Hyperbolic", "Sand"] {
        for sides in ["Both", "Positive", "Negative"] {
            for set in [&[][..], &[("ku", 5e7), ("drag", 2e4), ("opening", 0.003)]] {
                let law = law(set, backbone, sides);
                for size in [0.005, 0.03, 0.2] {
                    Kit::new(&[size], 1.0).rate_independent().assert(&law);
                }
            }
        }
    }
}

#[test]
fn pressing_follows_the_curves_of_kondner_and_of_api() {
    let y50 = PU / K;
    for sign in [1.0, -1.0] {
        let clay = law(&[], "Hyperbolic", "Both");
        let mut driver = Driver::new(&clay);
        let f = through(&mut driver, &[sign * y50, sign * 9.0 * y50]);
        assert_relative_eq!(f[0], sign * 0.5 * PU, max_relative = 1e-12);
        assert_relative_eq!(f[1], sign * 0.9 * PU, max_relative = 1e-12);
        let sand = law(&[], "Sand", "Both");
        let mut driver = Driver::new(&sand);
        // tanh 1, tanh 2 to the digits of tables.
        let f = through(&mut driver, &[sign * y50, sign * 2.0 * y50]);
        assert_relative_eq!(f[0], sign * 0.761_594_156 * PU, max_relative = 1e-9);
        assert_relative_eq!(f[1], sign * 0.964_027_580 * PU, max_relative = 1e-9);
    }
}

#[test]
fn a_gap_stays_where_the_soil_was_pressed() {
    let law = law(&[("ku", 5e7), ("drag", 1e4), ("drag_stiffness", 1e8)], "Hyperbolic", "Both");
    let mut driver = Driver::new(&law);
    let y = 0.03;
    let top = K * y / (1.0 + K * y / PU);
    let face = y - top / 5e7;
    // Back to half the pressure, to the face, into the gap: drag alone.
    let half = y - 0.5 * top / 5e7;
    let f = through(&mut driver, &[y, half, face, 0.5 * face, 0.0]);
    for (f, p) in f.iter().zip([top + 1e4, 0.5 * top - 1e4, -1e4, -1e4, -1e4]) {
        assert_relative_eq!(*f, p, max_relative = 1e-9);
    }
    // The soil on the other side is where it was.
    assert_relative_eq!(
        driver.to(&[-0.001])[0],
        -K * 0.001 / (1.0 + 0.02 / 0.15) - 1e4,
        max_relative = 1e-9
    );
    // Again to the first face: it presses where it parted, and goes on along the curve.
    let f = through(&mut driver, &[face, half, y, 0.05]);
    let on = K * 0.05 / (1.0 + K * 0.05 / PU);
    for (f, p) in f.iter().zip([1e4, 0.5 * top + 1e4, top + 1e4, on + 1e4]) {
        assert_relative_eq!(*f, p, max_relative = 1e-9);
    }
}

/// Pressing costs the area under the curve less what comes back; cycles within the gap cost drag alone.
#[test]
fn a_dent_costs_its_area_and_later_cycles_cost_drag() {
    for (backbone, area) in [
        ("Hyperbolic", PU * PU / K * (4.0 - 5.0_f64.ln())),
        ("Sand", PU * PU / K * 4.0_f64.cosh().ln()),
    ] {
        let pd = 5e3;
        let law = law(&[("drag", pd), ("drag_stiffness", 1e9)], backbone, "Both");
        let mut driver = Driver::new(&law);
        let y = 4.0 * PU / K;
        driver.to(&[y]);
        let top = driver.f[0] - pd;
        let slip = y - pd / 1e9;
        let heat = area - 0.5 * top * top / K + pd * slip;
        assert_relative_eq!(driver.energy.hysteretic, heat, max_relative = 1e-12);
        driver.to(&[0.0]);
        let before = driver.energy.hysteretic;
        through(&mut driver, &[y, 0.0]);
        let cycle = 2.0 * pd * (y - 2.0 * pd / 1e9);
        assert_relative_eq!(driver.energy.hysteretic - before, cycle, max_relative = 1e-9);
        // In steps so fine that their trapezoids are the work.
        let (work, accounted) = (driver.work, driver.accounted());
        along(&mut driver, &[-y], 4000);
        let (work, accounted) = (driver.work - work, driver.accounted() - accounted);
        assert_relative_eq!(work, accounted, max_relative = 1e-3);
    }
}

#[test]
fn soil_on_one_side_behind_a_clearance() {
    let law = law(&[("opening", 0.02)], "Hyperbolic", "Negative");
    let mut driver = Driver::new(&law);
    let f = through(&mut driver, &[0.5, -0.02, -0.02 - PU / K, 0.0]);
    assert_eq!((f[0], f[1], f[3]), (0.0, 0.0, 0.0));
    assert_relative_eq!(f[2], -0.5 * PU, max_relative = 1e-12);
}

#[test]
fn a_return_softer_than_the_pressing_is_refused() {
    let given = [("k", K), ("pu", PU), ("ku", 0.5 * K)];
    let error = read::<SoilSpring>(&numbers(&given)).unwrap_err();
    assert_eq!(error.parameter(), Some("ku"));
    assert!(error.to_string().contains("at least `k`"), "{error}");
}

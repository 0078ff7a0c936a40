//! What the page for users of OpenSees calls equal, against the formulas of its materials.

use trilith::element::Driver;
use trilith::exercise::Specimen;

fn link(kind: &str, set: &[(&str, &str)]) -> Specimen {
    let set: Vec<(String, String)> =
        set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    Specimen::new(&trilith::registry(), kind, &set).unwrap()
}

/// Step, s.
const DT: f64 = 1e-3;

/// Deformation and rate of three growing cycles.
fn path(amplitude: f64) -> impl Iterator<Item = (f64, f64)> {
    let w = std::f64::consts::TAU;
    (1..=3000).map(move |i| {
        let t = f64::from(i) * DT;
        let grown = amplitude / 3.0;
        let (sin, cos) = (w * t).sin_cos();
        (grown * t * sin, grown * (sin + w * t * cos))
    })
}

fn close(ours: f64, theirs: f64, size: f64, at: usize) {
    assert!((ours - theirs).abs() < size, "step {at}: {ours} instead of {theirs}");
}

#[test]
fn a_gap_and_a_hook_are_a_hook_gap() {
    let (e, negative, positive) = (2e6, -0.02, 0.03);
    let gap = link("Gap", &[("k", "2 MN/m"), ("opening", "20 mm")]);
    let hook = link("Hook", &[("k", "2 MN/m"), ("opening", "30 mm")]);
    let (mut gap, mut hook) = (Driver::new(gap.law.as_ref()), Driver::new(hook.law.as_ref()));
    for (i, (d, v)) in path(0.1).enumerate() {
        let theirs = match d {
            d if d > positive => e * (d - positive),
            d if d < negative => e * (d - negative),
            _ => 0.0,
        };
        close(gap.step(&[d], &[v], DT)[0] + hook.step(&[d], &[v], DT)[0], theirs, 1e-6, i);
    }
}

#[test]
fn a_kelvin_impact_that_may_pull_is_a_viscoelastic_gap() {
    let (k, c, gap) = (1e8, 8e5, -0.03);
    let set = [
        ("k", "100 MN/m"),
        ("restitution", "none"),
        ("impact_mass", "none"),
        ("damping", "800 kN*s/m"),
        ("pull", "true"),
        ("opening", "3 cm"),
    ];
    let ours = link("ImpactKelvin", &set);
    let mut ours = Driver::new(ours.law.as_ref());
    for (i, (d, v)) in path(0.05).enumerate() {
        let force = ours.step(&[d], &[v], DT)[0];
        // The dashpot takes hold over the first nanometre.
        if (d - gap).abs() > 1e-8 {
            let theirs = if d < gap { k * (d - gap) + c * v } else { 0.0 };
            close(force, theirs, 1e-5, i);
        }
    }
}

#[test]
fn a_dashpot_with_an_exponent_is_viscous() {
    let ours = link("Dashpot", &[("c", "10 kN*(s/m)^0.4"), ("exponent", "0.4")]);
    let mut ours = Driver::new(ours.law.as_ref());
    for (i, (d, v)) in path(0.05).enumerate() {
        let theirs = 1e4 * v.signum() * v.abs().powf(0.4);
        let force = ours.step(&[d], &[v], DT)[0];
        if v.abs() > 1e-6 {
            close(force, theirs, 1e-6, i);
        }
    }
}

#[test]
fn a_kinematic_spring_of_two_lines_is_steel01() {
    let (fy, e, b) = (3e5, 1e8, 0.02);
    let set = [
        ("axis", "U1"),
        ("rule", "Kinematic"),
        ("deformation", "-103 mm, -3 mm, 0 mm, 3 mm, 103 mm"),
        ("force", "-500 kN, -300 kN, 0 kN, 300 kN, 500 kN"),
    ];
    let ours = link("MultilinearPlastic", &set);
    let mut ours = Driver::new(ours.law.as_ref());
    let (mut d0, mut f) = (0.0, 0.0);
    for (i, (d, v)) in path(0.02).enumerate() {
        // An elastic step, held between two lines of the slope b E.
        let middle = b * e * d;
        let width = fy * (1.0 - b);
        f = (f + e * (d - d0)).clamp(middle - width, middle + width);
        d0 = d;
        close(ours.step(&[d], &[v], DT)[0], f, 1e-3, i);
    }
}

/// z after a step of ż = rate(z) ḋ with a straight path, by Runge–Kutta in small parts.
fn advanced(z: f64, d: f64, rate: impl Fn(f64) -> f64) -> f64 {
    let parts = 20;
    let h = d / f64::from(parts);
    (0..parts).fold(z, |z, _| {
        let a = rate(z);
        let b = rate(z + 0.5 * h * a);
        let c = rate(z + 0.5 * h * b);
        z + h * (a + 2.0 * b + 2.0 * c + rate(z + h * c)) / 6.0
    })
}

#[test]
fn a_bouc_wen_spring_in_metres_is_theirs() {
    let (alpha, ko, gamma, beta) = (0.1, 1e7, 30.0, 70.0);
    let set = [
        ("axis", "U1"),
        ("k", "10 MN/m"),
        ("dy", "1 m"),
        ("alpha", "0.1"),
        ("n", "1"),
        ("beta", "70"),
        ("gamma", "30"),
        ("delta_nu", "none"),
        ("delta_eta", "none"),
    ];
    let ours = link("BoucWen", &set);
    let mut ours = Driver::new(ours.law.as_ref());
    let (mut d0, mut z) = (0.0, 0.0);
    for (i, (d, v)) in path(0.03).enumerate() {
        let way = d - d0;
        z = advanced(z, way, |z| 1.0 - z.abs() * (gamma + beta * (way * z).signum()));
        d0 = d;
        let theirs = alpha * ko * d + (1.0 - alpha) * ko * z;
        close(ours.step(&[d], &[v], DT)[0], theirs, 10.0, i);
    }
}

#[test]
fn a_rubber_isolator_along_one_axis_is_an_elastomeric_bearing_of_bouc_and_wen() {
    let (k, alpha, qd) = (1e7, 0.1, 9e4);
    let set = [("k2", "10 MN/m"), ("fy2", "100 kN"), ("ratio2", "0.1"), ("kv", "none")];
    let ours = link("RubberIsolator", &set);
    let mut ours = Driver::new(ours.law.as_ref());
    let (mut d0, mut z) = (0.0, 0.0);
    let uy = qd / ((1.0 - alpha) * k);
    let n = ours.d.len();
    for (i, (d, v)) in path(0.05).enumerate() {
        let way = d - d0;
        let rate = |z: f64| (1.0 - z * z * (0.5 + 0.5 * (way * z).signum())) / uy;
        z = advanced(z, way, rate);
        d0 = d;
        let (mut at, mut speed) = (vec![0.0; n], vec![0.0; n]);
        (at[1], speed[1]) = (d, v);
        close(ours.step(&at, &speed, DT)[1], qd * z + alpha * k * d, 10.0, i);
    }
}

#[test]
fn a_rubber_isolator_by_direction_is_that_bearing_in_its_plane() {
    let (k, alpha, qd) = (1e7, 0.1, 9e4);
    let (eta, beta, gamma) = (1.0, 0.6, 0.4);
    let set = [
        ("k2", "10 MN/m"),
        ("fy2", "100 kN"),
        ("ratio2", "0.1"),
        ("kv", "none"),
        ("coupling", "Direction"),
        ("beta", "0.6"),
        ("gamma", "0.4"),
        ("eta", "1"),
    ];
    let ours = link("RubberIsolator", &set);
    let mut ours = Driver::new(ours.law.as_ref());
    let uy = qd / ((1.0 - alpha) * k);
    let rate = |z: [f64; 2], way: [f64; 2]| {
        let (along, size) = (z[0] * way[0] + z[1] * way[1], z[0].hypot(z[1]));
        let held = if size > 0.0 {
            size.powf(eta - 2.0) * along * (gamma + beta * along.signum())
        } else {
            0.0
        };
        [0, 1].map(|i| (way[i] - z[i] * held) / uy)
    };
    let (mut old, mut z) = ([0.0; 2], [0.0; 2]);
    let n = ours.d.len();
    for (i, (x, _)) in path(0.05).enumerate() {
        // Curls about the line of the first axis.
        let d = [x, 0.03 * (0.011 * i as f64).sin()];
        let parts = 20;
        let way = [0, 1].map(|j| (d[j] - old[j]) / f64::from(parts));
        for _ in 0..parts {
            let moved = |r: [f64; 2], h: f64| [z[0] + h * r[0], z[1] + h * r[1]];
            let a = rate(z, way);
            let b = rate(moved(a, 0.5), way);
            let c = rate(moved(b, 0.5), way);
            let e = rate(moved(c, 1.0), way);
            z = [0, 1].map(|j| z[j] + (a[j] + 2.0 * b[j] + 2.0 * c[j] + e[j]) / 6.0);
        }
        old = d;
        let mut at = vec![0.0; n];
        (at[1], at[2]) = (d[0], d[1]);
        let f = ours.step(&at, &vec![0.0; n], DT).to_vec();
        for j in 0..2 {
            close(f[1 + j], qd * z[j] + alpha * k * d[j], 10.0, i);
        }
    }
}

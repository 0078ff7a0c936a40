//! The oracle against closed forms.

use super::spec::{Contact, Damping, Force, Function, Kind, Law, Member, Output, Spec};
use super::truth::truth;
use std::f64::consts::{PI, TAU};

/// A mass that moves along X on what is given.
fn oscillator(mass: f64, parts: Vec<Kind>) -> Spec {
    let member = |kind| Member { nodes: vec![0], axis1: Some([1.0, 0.0, 0.0]), kind };
    let mut members: Vec<Member> = parts.into_iter().map(member).collect();
    members.push(Member { nodes: vec![0], axis1: None, kind: Kind::Mass(mass, [0.0; 3]) });
    Spec {
        nodes: vec![[0.0; 3]],
        fixed: vec![[false, true, true, true, true, true]],
        members,
        duration: 2.0,
        dt: 0.01,
        outputs: vec![Output::Displacement(0, 0), Output::Velocity(0, 0)],
        ..Spec::default()
    }
}

fn spring(k: f64, c: f64) -> Kind {
    Kind::Spring([k, 0.0, 0.0, 0.0, 0.0, 0.0], [c, 0.0, 0.0, 0.0, 0.0, 0.0])
}

fn compare(spec: &Spec, output: usize, exact: impl Fn(f64) -> f64, tolerance: f64) {
    let it = truth(spec, 1e9).unwrap();
    for i in 1..=200 {
        let t = spec.duration * f64::from(i) / 200.0;
        let (got, want) = (it.course.at(output, t), exact(t));
        assert!((got - want).abs() < tolerance * it.scale[output], "t = {t}: {got} for {want}");
    }
    assert!(it.moves.iter().all(|m| *m < 1e-3), "{:?}", it.moves);
}

#[test]
fn a_damped_oscillator_swings_as_its_formula() {
    let (m, k, zeta): (f64, f64, f64) = (2.0, 300.0, 0.07);
    let w = (k / m).sqrt();
    let wd = w * (1.0 - zeta * zeta).sqrt();
    let (u0, v0) = (0.1, -0.4);
    let exact = |t: f64| {
        (-zeta * w * t).exp() * (u0 * (wd * t).cos() + (v0 + zeta * w * u0) / wd * (wd * t).sin())
    };
    for how in 0..3 {
        let c = 2.0 * zeta * w * m;
        let mut spec = oscillator(m, vec![spring(k, if how == 0 { c } else { 0.0 })]);
        match how {
            1 => spec.damping = Damping::Modal(zeta),
            2 => spec.damping = Damping::Rayleigh(zeta * w, zeta / w),
            _ => {}
        }
        spec.initial.push((0, 0, u0, v0));
        compare(&spec, 0, exact, 1e-5);
    }
}

#[test]
fn a_sine_of_the_ground_shakes_as_its_formula() {
    let (m, k, a, f) = (2.0, 300.0_f64, 3.0, 1.1);
    let (w, o) = ((k / m).sqrt(), TAU * f);
    let mut spec = oscillator(m, vec![spring(k, 0.0)]);
    spec.base.push((0, Function::Sine(a, f, 50.0)));
    let exact = |t: f64| -a / (w * w - o * o) * ((o * t).sin() - o / w * (w * t).sin());
    compare(&spec, 0, exact, 1e-5);
}

/// A step of force on a Maxwell damper without mass beside a spring: first order.
#[test]
fn a_joint_without_mass_creeps_as_a_standard_solid() {
    let (k, km, c, p) = (100.0, 300.0, 40.0, 7.0);
    let mut spec = oscillator(0.0, vec![spring(k, 0.0), Kind::Link(Law::Maxwell(km, c, 1.0), 0)]);
    spec.members.pop();
    // A mass elsewhere, at rest.
    spec.nodes.push([5.0, 0.0, 0.0]);
    spec.fixed.push([false, true, true, true, true, true]);
    spec.members.push(Member { nodes: vec![1], axis1: None, kind: Kind::Mass(1.0, [0.0; 3]) });
    spec.members.push(Member {
        nodes: vec![1],
        axis1: Some([1.0, 0.0, 0.0]),
        kind: spring(1.0, 0.0),
    });
    spec.outputs.pop();
    spec.forces.push(Force { node: 0, dof: 0, value: p, function: Function::Step(1.0, 0.0) });
    let tau = c * (k + km) / (k * km);
    let exact = |t: f64| p / k * (1.0 - km / (k + km) * (-t / tau).exp());
    compare(&spec, 0, exact, 1e-5);
}

/// Free flight onto a stop: half a cycle of the contact, and back.
#[test]
fn a_mass_comes_back_from_a_stop_at_its_speed() {
    let (m, k, g, v) = (2.0_f64, 5000.0, 0.3, 1.0);
    let mut spec = oscillator(m, vec![Kind::Link(Law::Gap(k, g), 0)]);
    spec.initial.push((0, 0, 0.0, -v));
    spec.duration = 0.8;
    let w = (k / m).sqrt();
    let (hit, back) = (g / v, g / v + PI / w);
    let exact = |t: f64| {
        if t < hit {
            -v * t
        } else if t < back {
            -g - v / w * (w * (t - hit)).sin()
        } else {
            -g + v * (t - back)
        }
    };
    compare(&spec, 0, exact, 1e-4);
}

/// A slider on Coulomb friction under its weight, thrown: u = v t − μ g t²/2 until it stands.
#[test]
fn a_slider_stands_where_its_friction_has_eaten_its_energy() {
    let (mass, mu, v) = (10.0, 0.3, 2.0);
    let kn: f64 = 1e7;
    let contact =
        Contact { kn, opening: 0.0, c: 0.0, pull: false, slow: mu, fast: mu, rate: 0.0, ks: kn };
    let mut spec = oscillator(mass, Vec::new());
    spec.fixed[0] = [false, false, false, true, true, true];
    spec.members.push(Member {
        nodes: vec![0],
        axis1: None,
        kind: Kind::Link(Law::Contact(contact), 0),
    });
    spec.gravity = true;
    spec.initial.push((0, 0, 0.0, v));
    spec.duration = 1.0;
    let a = mu * 9.80665;
    let stop = v / a;
    let exact = |t: f64| if t < stop { v * t - 0.5 * a * t * t } else { 0.5 * v * v / a };
    compare(&spec, 0, exact, 2e-4);
}

/// A yielding spring under a slow ramp of force follows its curve, and back.
#[test]
fn a_plastic_spring_goes_along_its_curve_and_back_by_masing() {
    let (d, f) = (vec![0.0, 0.01, 0.03], vec![0.0, 100.0, 140.0]);
    // Light mass: quasi-static.
    let mut spec = oscillator(1e-4, vec![Kind::Link(Law::Plastic(d, f), 0), spring(0.0, 2.0)]);
    let points = vec![(0.0, 0.0), (1.0, 130.0), (2.0, -60.0)];
    spec.forces.push(Force { node: 0, dof: 0, value: 1.0, function: Function::Points(points) });
    spec.outputs.pop();
    let it = truth(&spec, 1e9).unwrap();
    // 130 N: 0.01 + 30/2000; back by 190 N: 200 N of elastic range are not reached.
    let at = |t| it.course.at(0, t);
    assert!((at(1.0) - 0.025).abs() < 3e-4, "{}", at(1.0));
    assert!((at(2.0) - (0.025 - 0.019)).abs() < 3e-4, "{}", at(2.0));
}

/// The same seed is the same structure, and the oracle has an answer for nearly all.
#[test]
fn few_structures_are_without_an_answer() {
    use super::generate::generate;
    use super::text::text;
    let without = (1..=40_u64)
        .filter(|seed| {
            let spec = generate(*seed);
            assert_eq!(text(&spec), text(&generate(*seed)));
            spec.family != "long beam" && truth(&spec, 1e9).is_err()
        })
        .count();
    assert!(without <= 1, "{without}");
}

/// What is too much work is answered for as long as the work lasts, as it would be for all of the time.
#[test]
fn a_first_part_is_answered_as_the_whole() {
    use super::generate::generate;
    use super::judge::reference_of_a_part;
    let mut cut = 0;
    for seed in 1..=12 {
        let whole = generate(seed);
        let mut part = whole.clone();
        let Ok(it) = reference_of_a_part(&mut part, 4e6) else { continue };
        if part.duration == whole.duration {
            continue;
        }
        cut += 1;
        assert!(part.duration >= 0.02 * whole.duration && part.duration < whole.duration);
        let all = truth(&whole, 1e9).unwrap();
        for i in 0..whole.outputs.len() {
            // Times may be off by a share of the duration.
            let width = 2e-4 * whole.duration;
            let t = 0.5 * part.duration;
            let (low, high) = all.course.span(i, t - width, t + width);
            let off = super::truth::outside(it.course.at(i, t), low, high) / all.scale[i];
            assert!(off < 1e-3, "{seed}: output {i} is off by {off:e} at {t}");
        }
    }
    assert!(cut >= 2, "{cut}");
}

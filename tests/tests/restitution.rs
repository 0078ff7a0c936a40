//! A coefficient of restitution in place of a dashpot: the mass it means, and what comes out.

use trilith::calibrate::{CalibrationError, Calibrator, Horizontal};
use trilith_tests::{parse, registry, shipped, shipped_text};

/// Masses that strike a contact: together with the others, alone.
type Masses = (Option<f64>, f64);

/// Masses worked out for the contacts of a model.
fn masses(text: &str) -> Vec<Masses> {
    let (model, system) = parse(text, &[]);
    let all = system.impact_masses(&model).expect("masses");
    all.iter().map(|m| (m.together, m.alone)).collect()
}

#[track_caller]
fn near(found: &[Masses], wanted: &[Masses]) {
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
    let same = |(f, w): (&Masses, &Masses)| {
        close(f.1, w.1)
            && match (f.0, w.0) {
                (Some(a), Some(b)) => close(a, b),
                (a, b) => a == b,
            }
    };
    assert!(
        found.len() == wanted.len() && found.iter().zip(wanted).all(same),
        "{found:?} instead of {wanted:?}"
    );
}

#[test]
fn two_corners_of_a_block_share_its_mass() {
    // Alone: 1/m_e = 1/m + b²/I, with the base free to slide.
    let alone = 1.0 / (1e-4 + 1.0 / (1e4 * 20.0 / 12.0));
    let (model, system) = shipped("rigid_block.ron", &[]);
    let all = system.impact_masses(&model).expect("masses");
    let found: Vec<_> = all.iter().map(|m| (m.together, m.alone)).collect();
    near(&found, &[(Some(5e3), alone), (Some(5e3), alone)]);
}

/// A slab of mass 12 t on four feet, the first two twice as stiff as the others.
const SLAB: &str = r#"(
    nodes: { "c": (0, 0, 1), "1": (-1, -1, 0), "2": (-1, 1, 0), "3": (1, -1, 0), "4": (1, 1, 0) },
    elements: {
        "slab": RigidBody(nodes: ("c", "1", "2", "3", "4")),
        "mass": Mass(node: "c", mass: "12 t", inertia: (4e3, 4e3, 8e3)),
        "f1": NLink(node: "1", kn: 1e8), "f2": NLink(node: "2", kn: 2e8),
        "f3": NLink(node: "3", kn: 2e8), "f4": NLink(node: "4", kn: 1e8),
    },
    cases: { "fall": Dynamic(duration: 1, dt: 0.01) },
)"#;

#[test]
fn feet_that_cannot_be_told_apart_share_as_their_stiffness_does() {
    let found = masses(SLAB);
    let together: Vec<f64> = found.iter().map(|m| m.0.expect("a flat drop")).collect();
    for (p, wanted) in together.iter().zip([2e3, 4e3, 4e3, 2e3]) {
        assert!((p - wanted).abs() < 1e-6, "{together:?}");
    }
}

#[test]
fn stops_on_both_sides_count_alone_and_two_masses_by_the_reduced_one() {
    let found = masses(
        r#"(
        nodes: { "a": (0, 0, 0), "b": (1, 0, 0), "wall": (2, 0, 0) },
        supports: { "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz), "wall": Fixed },
        elements: {
            "a": Mass(node: "a", mass: 2), "b": Mass(node: "b", mass: 6),
            "between": NLink(nodes: ("a", "b"), kn: 1e5, opening: 0.01),
        },
        cases: { "fly": Dynamic(duration: 1, dt: 0.01) },
    )"#,
    );
    near(&found, &[(Some(1.5), 1.5)]);
    let found = masses(
        r#"(
        nodes: { "left": (-1, 0, 0), "a": (0, 0, 0), "right": (1, 0, 0) },
        supports: { "left": Fixed, "right": Fixed, "a": (Uy, Uz, Rx, Ry, Rz) },
        elements: {
            "a": Mass(node: "a", mass: 2),
            "on the left": NLink(nodes: ("left", "a"), kn: 1e5, opening: 0.01),
            "on the right": NLink(nodes: ("a", "right"), kn: 1e5, opening: 0.01),
        },
        cases: { "fly": Dynamic(duration: 1, dt: 0.01) },
    )"#,
    );
    near(&found, &[(None, 2.0), (None, 2.0)]);
}

#[test]
fn a_restitution_runs_bit_for_bit_like_the_dashpot_it_stands_for() {
    let text = shipped_text("rigid_block_drop.ron");
    let wished = text.replace("damping: \"cv\"", "restitution: 0.25");
    assert_ne!(text, wished);
    let (model, system) = parse(&wished, &[]);
    let link = &system.links.links[0];
    let law = system.links.law(&model, link).expect("a law");
    let settled = law.impact().expect("a contact");
    assert_eq!(settled.restitution, None);
    // ζ of e = 0.25: −ln e / √(π² + ln² e)
    let log = 4.0f64.ln();
    let ratio = log / log.hypot(std::f64::consts::PI);
    let dashpot = 2.0 * ratio * (5e8 * 5e3f64).sqrt();
    assert!((settled.damping / dashpot - 1.0).abs() < 1e-12, "{settled:?}");
    let run = |text: &str, set: &[(&str, String)]| {
        let (model, system) = parse(text, set);
        trilith_tests::trace(&model, &system, trilith_model::SolverKind::Fna).0
    };
    let set = [("cv", format!("{:?}", settled.damping))];
    assert_eq!(run(&wished, &[]).history, run(&text, &set).history);
}

fn calibrator(file: &str, set: &[(&str, String)]) -> Calibrator {
    let (model, _) = shipped(file, set);
    Calibrator::new(model, Horizontal::X).expect("a body on feet")
}

#[test]
fn a_tuned_drop_returns_what_was_wanted() {
    for pull in [1, 0] {
        let mut it = calibrator("rigid_block_drop.ron", &[("pull", pull.to_string())]);
        let (dashpots, drop) = it.tune_drop(0.4, 2.0).expect("dashpots");
        assert!((drop.restitution() - 0.4).abs() < 2e-5, "{drop:?}");
        assert_eq!(dashpots.len(), 2);
        let again = it.drop(2.0).expect("a drop");
        assert_eq!(again, drop, "the feet keep the dashpots found");
    }
}

#[test]
fn a_tuned_rocking_keeps_what_was_wanted_and_says_where_it_cannot() {
    let mut it = calibrator("rigid_block_rocking.ron", &[]);
    let theory = it.theory().expect("a body that rocks");
    assert!((theory.uplift - 0.49).abs() < 1e-12 && (theory.speed - 0.7).abs() < 1e-12);
    let (dashpot, swing) = it.tune_rocking(0.42, 0.1).expect("a dashpot");
    assert!(dashpot > 0.0 && (swing.ratio() - 0.42).abs() < 1e-4, "{dashpot} {swing:?}");
    let error = it.tune_rocking(0.9, 0.1).expect_err("contacts take more");
    assert!(matches!(
        error,
        trilith::Error::Calibration(CalibrationError::Unreachable { wanted: 0.9, .. })
    ));
}

#[test]
fn what_is_no_body_on_feet_is_refused() {
    let refuse = |text: &str| {
        let model = trilith::read_text(text, "body.ron", &registry(), &[]).expect("a model");
        match Calibrator::new(model, Horizontal::X) {
            Err(trilith::Error::Calibration(e)) => e,
            other => panic!("{other:?}"),
        }
    };
    let held = SLAB.replace("elements: {", "elements: { \"held\": Spring(node: \"c\", k1: 1e6),");
    assert_eq!(refuse(&held), CalibrationError::Held { motion: "a vertical lift" });
    let hung = SLAB.replace("NLink(", "Hook(").replace("kn:", "k:");
    assert_eq!(refuse(&hung), CalibrationError::NoFeet);
    let model = trilith::read_text(
        &SLAB.replace("\"c\": (0, 0, 1)", "\"c\": (3, 0, 1)"),
        "body.ron",
        &registry(),
        &[],
    );
    let mut it = Calibrator::new(model.expect("a model"), Horizontal::X).expect("feet");
    let error = it.rocking(0.1, 0.0).expect_err("it falls over");
    assert!(error.to_string().contains("does not stand"), "{error}");
    assert!(it.drop(-1.0).is_err() && it.set_restitution(1.5).is_err());
}

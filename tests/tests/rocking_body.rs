//! A body in finite rotation: what a fall does to a run, and plain contacts as its limit.

use trilith_model::SolverKind;
use trilith_solvers::{ContactMode, RunOptions, SolveError, Status, run};
use trilith_tests::{Trace, output, parse, shipped, trace};

const BOTH: [SolverKind; 2] = [SolverKind::Fna, SolverKind::Hht];

fn overturned(set: &[(&str, String)], solver: SolverKind) -> (Status, bool, Trace, usize) {
    let (model, system) = shipped("rocking_body.ron", set);
    let (mut contact, mut trace) = (ContactMode::new(&model, &system), Trace::default());
    let case = model.cases.len() - 1;
    let options = RunOptions { case, solver: Some(solver), ..RunOptions::default() };
    let result = run(&model, &system, options, &mut [&mut contact, &mut trace]).unwrap();
    let fallen = contact.summary().unwrap().overturned;
    (result.status, fallen, trace, output(&model, "tilt"))
}

#[test]
fn a_fall_ends_the_run_and_says_so_under_every_solver() {
    let strong = [("ah", "0.5".to_owned())];
    for solver in SolverKind::ALL {
        let (status, fallen, trace, tilt) = overturned(&strong, solver);
        let Status::Overturned { t, body } = status else {
            panic!("{}: {status:?}", solver.name())
        };
        assert!(fallen && body == "base");
        assert!(
            t < 4.0 && (t - trace.time.last().unwrap()).abs() < 1e-12,
            "{}: {t}",
            solver.name()
        );
        assert!(trace.last[tilt] >= std::f64::consts::FRAC_PI_2);
        // It stops at the first output step past the right angle.
        assert!(trace.history[trace.history.len() - 2][tilt] < std::f64::consts::FRAC_PI_2);
    }
    for solver in BOTH {
        let (status, fallen, ..) = overturned(&[("ah", "0.3".to_owned())], solver);
        assert_eq!((status, fallen), (Status::Converged, false));
    }
}

#[test]
fn the_angle_of_overturning_is_the_users() {
    let (mut model, _) = shipped("rocking_body.ron", &[("ah", "0.5".to_owned())]);
    let text = model.source.text.replace("damping: \"cv\"", "damping: \"cv\", overturned: 0.6");
    let system;
    (model, system) = parse(&text, &[("ah", "0.5".to_owned())]);
    let (trace, result) = trace(&model, &system, SolverKind::Hht);
    assert!(matches!(result.status, Status::Overturned { .. }));
    let tilt = trace.last[output(&model, "tilt")];
    assert!(tilt > 0.6 && tilt < 0.62, "{tilt}");
}

#[test]
fn a_case_after_a_fall_is_refused() {
    let text = trilith_tests::shipped_text("rocking_body.ron").replace(
        "cases: {",
        "cases: { \"first\": Dynamic(duration: \"4 s\", dt: \"2 ms\", constant: [Gravity], base: [(direction: X, function: \"horizontal\")]),",
    );
    let text = text.replace("after: \"gravity\"", "after: \"first\"");
    let (model, system) = parse(&text, &[("ah", "0.5".to_owned())]);
    let options = RunOptions { case: 2, solver: Some(SolverKind::Hht), ..RunOptions::default() };
    let error = run(&model, &system, options, &mut []).unwrap_err();
    let SolveError::Predecessor { reason, .. } = error else { panic!("{error}") };
    assert!(reason.contains("overturned"), "{reason}");
}

/// A block that rocks by a small share of its overturning angle does what plain contacts under rigid links
/// do, up to a part of that share.
#[test]
fn small_rotations_are_those_of_plain_contacts() {
    let set = |frequency: &str| {
        [
            ("ah", "1"),
            ("frequency", frequency),
            ("cycles", "1"),
            ("duration", "1.5 s"),
            ("mu", "0.8"),
            ("kn", "2e10 N/m"),
            ("ks", "2e10 N/m"),
            ("cv", "2e7 N*s/m"),
        ]
        .map(|(n, v)| (n, v.to_owned()))
    };
    let sizes = [("width", "1 m".to_owned()), ("height", "4 m".to_owned())];
    for solver in BOTH {
        for (frequency, limit) in [("10 Hz", 0.02), ("20 Hz", 0.005), ("40 Hz", 0.00125)] {
            let own = set(frequency);
            let plain = [&own[..], &sizes, &[("pull", "0".to_owned())]].concat();
            let (model, system) = shipped("rocking_body.ron", &own);
            let (finite, _) = trace(&model, &system, solver);
            let at = output(&model, "rotation");
            let (model, system) = shipped("rigid_block.ron", &plain);
            let (small, _) = trace(&model, &system, solver);
            let index = output(&model, "rotation");
            let (one, two) = (finite.peak(at), small.peak(index));
            let relative = one / (0.25f64.atan());
            assert!(relative < limit, "{frequency}: {relative}");
            assert!((one / two - 1.0).abs() < 0.3 * relative, "{frequency}: {one} {two}");
        }
    }
}

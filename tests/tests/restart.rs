//! Repeatability: the same bits from a repetition, a checkpoint, and after a failed step.

use trilith_model::SolverKind;
use trilith_solvers::{EndState, Observer, RunOptions, Sample};
use trilith_tests::{Trace, parse, shipped, trace, trace_with};

fn bits(history: &[Vec<f64>]) -> Vec<Vec<u64>> {
    history.iter().map(|row| row.iter().map(|x| x.to_bits()).collect()).collect()
}

#[test]
fn two_runs_give_the_same_bits() {
    for file in ["rigid_block.ron", "pounding_frames.ron", "isolated_frame.ron"] {
        for solver in [SolverKind::Fna, SolverKind::Hht] {
            let once = || -> Trace {
                let (model, system) = shipped(file, &[("duration", "2".into())]);
                trace(&model, &system, solver).0
            };
            assert_eq!(bits(&once().history), bits(&once().history), "{file} {}", solver.name());
        }
    }
}

#[test]
fn a_run_continued_from_a_written_checkpoint_gives_the_same_bits() {
    for file in ["rigid_block.ron", "pounding_frames.ron", "isolated_frame.ron"] {
        for solver in [SolverKind::Fna, SolverKind::Hht] {
            let (model, system) = shipped(file, &[("duration", "2".into())]);
            let (whole, end) = trace(&model, &system, solver);
            let first =
                RunOptions { solver: Some(solver), until: Some(0.7), ..RunOptions::default() };
            let (before, stopped) = trace_with(&model, &system, first);
            let written = serde_json::to_string(&stopped.end).unwrap();
            let read: EndState = serde_json::from_str(&written).unwrap();
            assert_eq!(read, stopped.end, "{file}: the checkpoint survives the file");
            let rest =
                RunOptions { solver: Some(solver), from: Some(read), ..RunOptions::default() };
            let (after, finished) = trace_with(&model, &system, rest);
            // The state at the checkpoint is shown by both parts.
            let joined: Vec<_> =
                before.history.iter().chain(&after.history[1..]).cloned().collect();
            assert_eq!(bits(&joined), bits(&whole.history), "{file} {}", solver.name());
            assert_eq!(finished.end.state, end.end.state, "{file} {}", solver.name());
            assert_eq!(finished.energy, end.energy, "{file} {}", solver.name());
        }
    }
}

/// Rates of the outputs at each shown state.
#[derive(Default)]
struct Rates(Vec<Vec<f64>>);

impl Observer for Rates {
    fn sample(&mut self, sample: &Sample<'_>) {
        self.0.push(sample.rates.to_vec());
    }
}

#[test]
fn who_looks_at_a_run_that_nobody_watched_before_sees_the_rates_of_its_first_state() {
    // Its law looks at no rates, and nothing else does but the output.
    let text = r#"(
        nodes: { "n": (0, 0, 0) },
        elements: {
            "mass": Mass(node: "n", mass: "1 t"),
            "upright": Spring(node: "n", k3: 1e6),
            "bearing": ElastomericBearing(node: "n", k: 1e6, fy: 2e3, ratio: 0.2),
        },
        cases: { "free": Dynamic(duration: "2 s", dt: "0.01 s",
            initial: [(node: "n", dof: Ux, displacement: 0.02), (node: "n", dof: Uy, velocity: 0.5)]) },
        outputs: {
            "x": LinkDeformation(link: "bearing", axis: U2),
            "y": LinkDeformation(link: "bearing", axis: U3),
        },
    )"#;
    let (model, system) = parse(text, &[]);
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let options = |from, until| RunOptions {
            case: model.cases.len() - 1,
            solver: Some(solver),
            from,
            until,
            ..RunOptions::default()
        };
        let run = |options, observers: &mut [&mut dyn Observer]| {
            trilith_solvers::run(&model, &system, options, observers).unwrap()
        };
        let (mut all, mut rest) = (Rates::default(), Rates::default());
        run(options(None, Some(0.7)), &mut [&mut all]);
        let unwatched = run(options(None, Some(0.7)), &mut []);
        run(options(Some(unwatched.end), Some(0.8)), &mut [&mut rest]);
        let (last, first) = (all.0.last().unwrap(), &rest.0[0]);
        for (first, last) in first.iter().zip(last) {
            assert!(last.abs() > 1e-6, "{}: it moves", solver.name());
            assert_eq!(first.to_bits(), last.to_bits(), "{}", solver.name());
        }
    }
}

#[test]
fn a_checkpoint_of_another_solver_is_refused() {
    let (model, system) = shipped("rigid_block.ron", &[("duration", "0.1".into())]);
    let (_, fna) = trace(&model, &system, SolverKind::Fna);
    let options = RunOptions {
        case: model.cases.len() - 1,
        solver: Some(SolverKind::Hht),
        from: Some(fna.end),
        ..RunOptions::default()
    };
    let error = trilith_solvers::run(&model, &system, options, &mut []).unwrap_err();
    assert!(error.to_string().contains("solver"), "{error}");
}

#[test]
fn a_checkpoint_is_refused_by_a_static_case() {
    let (model, system) = shipped("rigid_block.ron", &[("duration", "0.1".into())]);
    let (_, end) = trace(&model, &system, SolverKind::Fna);
    let is_static =
        |c: &trilith_model::Case| matches!(c.analysis, trilith_model::Analysis::Static(_));
    let case = model.cases.iter().position(is_static).unwrap();
    let told = |from: EndState| {
        let options = RunOptions { case, from: Some(from), ..RunOptions::default() };
        trilith_solvers::run(&model, &system, options, &mut []).unwrap_err().to_string()
    };
    let names = (&model.cases[case].name, &end.end.case);
    let error = told(end.end.clone());
    assert!(
        error.contains(&format!("its case is {}, this run's is {}", names.1, names.0)),
        "{error}"
    );
    // Nor does it take its own end.
    let options = RunOptions { case, ..RunOptions::default() };
    let own = trilith_solvers::run(&model, &system, options, &mut []).unwrap();
    assert!(told(own.end).contains("is static"));
}

#[test]
fn a_checkpoint_of_other_parameters_another_step_or_with_damage_is_refused() {
    let (model, system) = shipped("rigid_block.ron", &[("duration", "0.1".into())]);
    let end = || trace(&model, &system, SolverKind::Fna).1.end;
    let refusal = |parameter: (&str, &str), dt: Option<f64>, end: EndState| {
        let set = [("duration", "0.1".to_owned()), (parameter.0, parameter.1.to_owned())];
        let (model, system) = shipped("rigid_block.ron", &set);
        let options = RunOptions {
            case: model.cases.len() - 1,
            solver: Some(SolverKind::Fna),
            dt,
            from: Some(end),
            ..RunOptions::default()
        };
        trilith_solvers::run(&model, &system, options, &mut []).unwrap_err().to_string()
    };
    let same = ("mu", "0.6");
    assert!(refusal(("mu", "0.5"), None, end()).contains("parameter `mu`"));
    assert!(refusal(same, Some(0.002), end()).contains("output step"));
    let mut short = end();
    short.load.pop();
    assert!(refusal(same, None, short).contains("sizes"));
    // One number too many in a list of the state.
    let text = serde_json::to_string(&end()).unwrap();
    for list in ["motion", "d", "v", "f", "history", "stored", "stiffest"] {
        let longer = text.replacen(&format!("\"{list}\":["), &format!("\"{list}\":[0.0,"), 1);
        assert_ne!(longer, text, "{list}");
        let told = refusal(same, None, serde_json::from_str(&longer).unwrap());
        let what = if list == "motion" { "coordinates" } else { "sizes" };
        assert!(told.contains(what), "{list}: {told}");
    }
}

/// The extremes of a continued run are those of the case, not of its rest.
#[test]
fn peaks_and_contacts_go_on_from_a_checkpoint() {
    let read = || {
        let text = trilith_tests::shipped_text("rigid_block.ron");
        let set = [("duration".to_owned(), "1.5".to_owned())];
        let path = trilith_tests::root().join("models/rigid_block.ron");
        trilith_model::read_text(&text, &path, &trilith_tests::registry(), &set).unwrap()
    };
    let model = read();
    let analysis = trilith::Analysis::new(&model).unwrap();
    let case = model.cases.len() - 1;
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let part = |from: Option<EndState>, until| {
            let solver = Some(solver);
            analysis.run(RunOptions { case, solver, from, until, ..RunOptions::default() }).unwrap()
        };
        let whole = part(None, None);
        let first = part(None, Some(0.7));
        let written = serde_json::to_string(&first.result.end).unwrap();
        let checkpoint: EndState = serde_json::from_str(&written).unwrap();
        assert_eq!(checkpoint, first.result.end);
        let rest = part(Some(checkpoint.clone()), None);
        assert!(rest.result.warnings.is_empty(), "{:?}", rest.result.warnings);
        for output in &model.outputs {
            let (a, b) = (whole.peak(&output.name).unwrap(), rest.peak(&output.name).unwrap());
            assert_eq!(a, b, "{} {}", solver.name(), output.name);
        }
        assert_eq!(whole.contact, rest.contact, "{}", solver.name());
        assert_eq!(rest.contact.as_ref().unwrap().mode, "slide-rock");
        assert_eq!(whole.result.end.seen, rest.result.end.seen);
        // One that nobody watched: the summary says what its peaks are.
        let mut unwatched = checkpoint;
        unwatched.seen = trilith_solvers::SoFar::default();
        let told = part(Some(unwatched), None).result.warnings;
        assert!(told.iter().any(|w| w.contains("count from t = 0.7")), "{told:?}");
    }
}

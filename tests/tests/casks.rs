//! The templates of casks and cabinets against what a hand calculation says.

use trilith::model::Model;
use trilith::{Analysis, Run, RunOptions, SolverKind};

/// A shipped template whose horizontal motion along X is a table of (s, m/s²), nothing along Y and Z.
fn model(file: &str, motion: &str, set: &[(&str, &str)]) -> Model {
    let path = trilith_tests::root().join("models").join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    let table =
        r#""x": Table(file: Parameter("record"), value: 1, scale: "scale*g", after_end: Zero)"#;
    assert!(text.contains(table));
    let points = format!("\"x\": Points(points: [{motion}], after_end: Zero)");
    let text = text.replace(table, &points);
    let mut set: Vec<(String, String)> =
        set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    set.push(("scale".into(), "0".into()));
    trilith::read_text(&text, &path, &trilith::registry(), &set).unwrap()
}

fn run(model: &Model, solver: SolverKind) -> Run {
    let case = model.cases.len() - 1;
    let options = RunOptions { case, solver: Some(solver), ..RunOptions::default() };
    Analysis::new(model).unwrap().run(options).unwrap()
}

const SOLVERS: [SolverKind; 2] = [SolverKind::Fna, SolverKind::Hht];

/// While the ground moves at a > µ g the body falls behind with a − µ g, then friction stops it:
/// s = ½ (a − µ g) t² a/(µ g).
#[test]
fn a_rectangular_pulse_slides_them_as_far_as_newton_says() {
    let (a, mu, g, t) = (4.5, 0.25, 9.81, 0.4);
    let slide = 0.5 * (a - mu * g) * t * t * a / (mu * g);
    let motion = format!("(0, {a}), ({t}, {a}), ({}, 0), (3, 0)", t + 1e-6);
    for file in ["storage_cask.ron", "cabinet.ron"] {
        let set = [("mu", "0.25"), ("duration", "1.5 s"), ("clear", "1 m")];
        let model = model(file, &motion, &set);
        for solver in SOLVERS {
            let run = run(&model, solver);
            let found = run.peak("slide").unwrap().max;
            assert!(
                (found / slide - 1.0).abs() < 0.01,
                "{file} {}: {found} {slide}",
                solver.name()
            );
            // It falls behind along −X, away from the neighbour.
            let approach = run.peak("approach").unwrap();
            assert!(approach.min > 0.99 && (approach.last / (1.0 + slide) - 1.0).abs() < 0.01);
            assert!(run.peak("margin").unwrap().min > 0.97);
        }
    }
}

/// A body that cannot slide lifts off where a > g b/h, and not before. A soft rim carries on an arc of its
/// edge: the cask needs contacts ten times as stiff as those that ship to be rigid to the percent.
#[test]
fn they_lift_off_where_statics_says() {
    for (file, limit, kn) in
        [("storage_cask.ron", 1.7 / 3.0, "4e11 N/m"), ("cabinet.ron", 0.3 / 0.95, "2e8 N/m")]
    {
        for (factor, lifts) in [(0.97, false), (1.05, true)] {
            let a = factor * limit * 9.81;
            // Up slowly, so that the contacts do not overshoot.
            let motion = format!("(0, 0), (1, {a}), (1.6, {a}), (1.7, 0), (3, 0)");
            let model = model(file, &motion, &[("mu", "2"), ("duration", "1.6 s"), ("kn", kn)]);
            for solver in SOLVERS {
                let run = run(&model, solver);
                // The uplift of the peaks is that of the contacts.
                let contacts = run.contact.as_ref().unwrap().max_uplift;
                let peak = run.peak("uplift").unwrap().max.max(0.0);
                assert!((peak - contacts).abs() < 1e-12, "{file}: {peak} {contacts}");
                let margin = run.peak("margin").unwrap().min;
                let uplift = run.peak("uplift").unwrap().max;
                let told = format!("{file} {factor} {}: {margin} {uplift}", solver.name());
                assert_eq!(margin < 0.98, lifts, "{told}");
                assert_eq!(uplift > 5e-3, lifts, "{told}");
            }
        }
    }
}

/// The tilt of a cask about its edge puts its top where geometry says, and the margin is gone at balance.
#[test]
fn top_and_edge_of_a_tilted_cask_are_where_geometry_says() {
    let motion = "(0, 0), (0.2, -8), (0.9, -8), (1.0, 0), (3, 0)";
    let model = model("storage_cask.ron", motion, &[("mu", "2"), ("duration", "1.3 s")]);
    let (radius, height, half): (f64, f64, f64) = (1.7, 5.9, 3.0);
    for solver in SOLVERS {
        let run = run(&model, solver);
        let series = |name: &str| run.history(name).unwrap().to_vec();
        let (tilt, margin) = (series("tilt"), series("margin"));
        let (top, uplift, x) = (series("approach top"), series("uplift"), series("x"));
        let z = series("z");
        let largest = tilt.iter().fold(0.0f64, |a, t| a.max(*t));
        assert!(largest > 0.05, "{largest}");
        for i in (0..tilt.len()).step_by(10) {
            let t = tilt[i];
            assert!((margin[i] - (1.0 - t / (radius / half).atan())).abs() < 1e-9);
            let edge = z[i] + half * (1.0 - t.cos()) + radius * t.sin();
            assert!((uplift[i] - edge).abs() < 1e-9, "{} {edge}", uplift[i]);
            // Ground to −X: it leans to +X, towards the neighbour.
            assert!((top[i] - (1.0 - x[i] - (height - half) * t.sin())).abs() < 1e-6, "{t}");
        }
        // It turns about the edge at +X: from (−r, h) of it the centre of gravity goes to (−r cos t + h sin t, …).
        let i = (0..tilt.len()).max_by(|a, b| tilt[*a].total_cmp(&tilt[*b])).unwrap();
        let t = tilt[i];
        let along = half * t.sin() + radius * (1.0 - t.cos());
        assert!((x[i] / along - 1.0).abs() < 0.02, "{} {along}", x[i]);
    }
}

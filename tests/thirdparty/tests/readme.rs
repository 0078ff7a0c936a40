//! The page for newcomers works as it is written.

#[path = "../examples/ten_minutes.rs"]
#[allow(dead_code)]
mod ten_minutes;

const README: &str = include_str!("../README.md");
const MODEL: &str = include_str!("../examples/rod.ron");

/// The first block of a language in the page.
fn block(language: &str) -> &'static str {
    let start = format!("```{language}\n");
    let at = README.find(&start).expect("a block of the language") + start.len();
    &README[at..at + README[at..].find("```\n").expect("an end")]
}

/// What is compiled, tested (the module above) and run is what the page shows.
#[test]
fn the_page_shows_the_files_that_are_compiled() {
    assert_eq!(block("rust"), include_str!("../examples/ten_minutes.rs"));
    assert_eq!(block("ron"), MODEL);
}

/// The mass comes up from −20 mm with a speed of 0.447 m/s; the rod, which yields at 5 mm, takes its share.
#[test]
fn the_model_of_the_page_runs() {
    let mut kinds = trilith::registry();
    trilith::Register::link::<ten_minutes::YieldingRod>(&mut kinds);
    let model = trilith::read_text(MODEL, "rod.ron", &kinds, &[]).expect("a model");
    let run = trilith::run(&model, "fall back").expect("a run");
    let force = run.peak("force").expect("an output");
    assert!((force.max - 5e4).abs() < 1.0, "{force:?}");
    // ½ k x² on both sides less what the rod takes: 200 J = ½·10⁶ x² + ½·F_y·5 mm + F_y (x − 5 mm).
    let lift = run.peak("lift").expect("an output").max;
    let taken = 0.5 * 5e4 * 5e-3 + 5e4 * (lift - 5e-3);
    assert!((0.5e6 * lift * lift + taken - 200.0).abs() < 0.2, "{lift}");
}

/// The solver that the page shows is the one that is compiled.
#[test]
fn the_page_shows_the_solver_that_is_compiled() {
    let source = include_str!("../src/central_difference.rs");
    for head in ["impl Integrator for CentralDifference {", "impl LinearStep for Step {"] {
        let from = source.find(head).expect("an implementation");
        let end = from + source[from..].find("\n}\n").expect("an end") + 3;
        assert!(README.contains(&source[from..end]), "{head}");
    }
}

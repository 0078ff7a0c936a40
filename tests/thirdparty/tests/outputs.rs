//! Outputs from another crate.

use trilith::element::{Card, DerivedOutput, Described, Dimension, ParameterError, Register};
use trilith::gradient::{Wanted, gradient};
use trilith::model::ModelText;
use trilith::{Model, Registry, Run};
use trilith_thirdparty_example::Interaction;

fn kinds() -> Registry {
    let mut kinds = trilith::registry();
    trilith_thirdparty_example::register(&mut kinds);
    kinds
}

fn read(text: &str) -> Model {
    trilith::read_text(text, "outputs.ron", &kinds(), &[]).unwrap_or_else(|e| panic!("{e:?}"))
}

fn errors(text: &str) -> String {
    match trilith::read_text(text, "outputs.ron", &kinds(), &[]) {
        Ok(_) => panic!("this should be refused: {text}"),
        Err(errors) => format!("{errors:?}"),
    }
}

/// A column that is shaken, with a mass and a damper at its top.
fn column(outputs: &str) -> String {
    format!(
        r#"(
            parameters: {{ "mass": "20 t", "height": "4 m" }},
            nodes: {{ "foot": (0, 0, 0), "top": (0, 0, "height") }},
            supports: {{ "foot": Fixed, "top": (Uy, Rx, Rz) }},
            elements: {{
                "column": Beam(nodes: ("foot", "top"), section: Section("HEB 300"), material: Steel),
                "mass": Mass(node: "top", mass: "mass"),
                "damper": Dashpot(node: "top", c: "20 kN*s/m", axis: U2),
            }},
            functions: {{ "shake": Sine(amplitude: "4 m/s^2", frequency: "1.7 Hz") }},
            cases: {{
                "weight": Static(loads: [Gravity]),
                "shake": Dynamic(after: "weight", duration: "2 s", dt: "10 ms", base: [(direction: X, function: "shake")]),
            }},
            outputs: {{
                "N": MemberForce(element: "column", force: N, at: 0),
                "u": Displacement(node: "top", dof: Ux, hidden: true),
                "M2": MemberForce(element: "column", force: M2, at: 0),
                "M3": MemberForce(element: "column", force: M3, at: 0),
                {outputs}
            }},
        )"#
    )
}

const USED: &str =
    r#""used": Interaction(of: ["N", "M2", "M3"], nc: "3 MN", mc2: "300 kN*m", mc3: "300 kN*m"),"#;

fn history<'a>(run: &'a Run, name: &str) -> &'a [f64] {
    run.history(name).expect("an output")
}

#[test]
fn an_output_is_made_of_others_at_every_moment() {
    for nc in ["3 MN", "0.5 MN"] {
        let model = read(&column(&USED.replace("3 MN", nc)));
        let run = trilith::run(&model, "shake").expect("a run");
        let (axial, strength) = (if nc == "3 MN" { 3e6 } else { 5e5 }, 3e5);
        let mut most: f64 = 0.0;
        for i in 0..run.time().len() {
            let [n, m2, m3] = ["N", "M2", "M3"].map(|name| history(&run, name)[i].abs());
            let (n, m) = (n / axial, (m2 + m3) / strength);
            let expected = if n >= 0.2 { n + 8.0 / 9.0 * m } else { 0.5 * n + m };
            let found = history(&run, "used")[i];
            assert!((found - expected).abs() < 1e-12, "{i}: {found} {expected}");
            most = most.max(expected);
        }
        // Peaks come from all substeps, and from between them.
        let peak = run.peak("used").expect("an output").max;
        assert!(peak >= most && peak < 1.02 * most, "{peak} {most}");
        assert_eq!(model.outputs[4].unit, "1");
    }
}

#[test]
fn an_output_is_written_out_and_read_again() {
    let model = read(&column(USED));
    let again = read(&trilith::model::resolved(&model));
    assert_eq!(model.outputs, again.outputs);
    let other = read(&column(&USED.replace("3 MN", "4 MN")));
    assert_ne!(model.outputs, other.outputs);
}

#[test]
fn what_an_output_cannot_be_made_of_is_told_where_it_stands() {
    for (wrong, words) in [
        (USED.replace(r#""N", "#, ""), "`of` must name an axial force and two moments"),
        (
            USED.replace(r#""N", "M2""#, r#""M2", "N""#),
            "`of` must name an axial force and two moments",
        ),
        (USED.replace(r#""M3""#, r#""M4""#), "there is no output `M4` before this one"),
        (USED.replace("Interaction", "Interacton"), "did you mean `Interaction`"),
        (USED.replace("nc:", "mc:"), "output `used` has no field `mc`"),
        (USED.replace("3 MN", "3 m"), "this is a value in m"),
        (USED.replace(r#"of: ["N", "M2", "M3"], "#, ""), "output `used` has no `of`"),
        (USED.replace("Interaction", "Mass"), "there is no output `Mass`"),
    ] {
        let told = errors(&column(&wrong));
        assert!(told.contains(words), "{words} in {told}");
    }
}

#[test]
fn gradients_go_through_an_output_of_another_crate() {
    let file = column(USED).replace("solver: Hht", "");
    let text = ModelText::new(&file, "outputs.ron").expect("a text");
    let wanted = Wanted {
        case: Some("shake".into()),
        solver: Some(trilith::SolverKind::Hht),
        by: vec!["mass".into(), "height".into()],
        ..Wanted::default()
    };
    let found = gradient(&text, &kinds(), &wanted).expect("derivatives");
    let [m2, m3, used] = ["M2", "M3", "used"].map(|name| {
        let at = found.outputs.iter().position(|o| o.name == name).expect("an output");
        &found.outputs[at]
    });
    let n = found.outputs.iter().find(|o| o.name == "N").expect("an output");
    for i in 0..found.time.len() {
        let slope = |x: f64, size: f64| if x < 0.0 { -1.0 / size } else { 1.0 / size };
        for p in 0..2 {
            let expected = 0.5 * slope(n.history[i], 3e6) * n.by[p][i]
                + slope(m2.history[i], 3e5) * m2.by[p][i]
                + slope(m3.history[i], 3e5) * m3.by[p][i];
            let by = used.by[p][i];
            assert!((by - expected).abs() <= 1e-12 + 1e-9 * expected.abs(), "{i}: {by} {expected}");
        }
    }
}

/// Takes whatever it is given, and is no number where that is negative.
#[derive(Debug)]
struct Root;

impl DerivedOutput for Root {
    fn dimension(&self, of: &[Dimension]) -> Result<Dimension, ParameterError> {
        Ok(of[0].powf(0.5))
    }
    fn value(&self, of: &[f64]) -> f64 {
        of[0].sqrt()
    }
}

const ROOT: Card = Interaction::CARD.named("Root").parameters(&[]);

#[test]
fn an_output_that_is_no_number_is_told() {
    let mut kinds = kinds();
    kinds.add_output(&ROOT, std::sync::Arc::new(|_| Ok(Box::new(Root))));
    let text = column(r#""root": Root(of: ["u"]),"#);
    let model = trilith::read_text(&text, "outputs.ron", &kinds, &[]).expect("a model");
    let run = trilith::run(&model, "shake").expect("a run");
    let warnings = run.result.warnings.join("\n");
    assert!(warnings.contains("output \"root\" is no number"), "{warnings}");
}

#[test]
fn an_output_that_tells_no_derivatives_is_no_goal() {
    let mut kinds = kinds();
    kinds.add_output(&ROOT, std::sync::Arc::new(|_| Ok(Box::new(Root))));
    let text = column(r#""size": Norm(terms: ["M2", "M3"]), "root": Root(of: ["size"]),"#);
    let text = ModelText::new(&text, "outputs.ron").expect("a text");
    let search = |goal: &str| {
        let wanted = trilith::optimize::Wanted {
            case: Some("shake".into()),
            solver: Some(trilith::SolverKind::Hht),
            by: vec!["height=3.9 m..4.1 m".parse().expect("a variable")],
            minimise: vec![goal.into()],
            ..Default::default()
        };
        trilith::optimize::optimize(&text, &kinds, &wanted).map(|_| ())
    };
    let told = search("root").expect_err("no derivatives").to_string();
    assert!(told.contains("`root` tells no derivatives"), "{told}");
    search("size").expect("its derivatives are known");
}

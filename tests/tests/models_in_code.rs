//! Models that are made or changed in code: what no file could say is refused, and what is written reads back the same.

use trilith::model::{Analysis as Case, Damping, Model, ModelFault, Quantity, resolved};
use trilith::model::{StepControl, TimeFunction};
use trilith::{Analysis, Error};

const TEXT: &str = r#"(
    nodes: { "base": (0, 0, 0), "top": (0, 0, 3) },
    supports: { "base": Fixed, "top": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "top", mass: 100),
        "spring": Spring(nodes: ("base", "top"), k2: 4e4),
        "stop": Gap(nodes: ("base", "top"), k: 1e6, opening: 0.1, axis: U2),
    },
    functions: { "sine": Sine(amplitude: 1, frequency: 2) },
    loads: { "push": [(node: "top", dof: Ux, force: 10)] },
    cases: {
        "lean": Static(loads: ["push"]),
        "shake": Dynamic(
            after: "lean", duration: 1, dt: 0.01, forces: [(load: "push", function: "sine")],
        ),
    },
    outputs: {
        "sway": Displacement(node: "top", dof: Ux),
        "stop": LinkForce(link: "stop", axis: U2),
    },
)"#;

fn model() -> Model {
    trilith::read_text(TEXT, "code.ron", &trilith::registry(), &[]).expect("a model")
}

/// What is wrong with a model that was changed.
fn faults(change: impl FnOnce(&mut Model)) -> Vec<String> {
    let mut model = model();
    change(&mut model);
    match Analysis::new(&model) {
        Err(Error::Model(all)) => all.iter().map(ToString::to_string).collect(),
        other => panic!("{other:?}"),
    }
}

/// The dynamic case of the model.
fn shake(model: &mut Model) -> &mut trilith::model::DynamicCase {
    match &mut model.cases[1].analysis {
        Case::Dynamic(case) => case,
        Case::Static(_) => panic!("a dynamic case"),
    }
}

#[test]
fn what_was_read_passes() {
    assert_eq!(model().check(), Ok(()));
    Analysis::new(&model()).expect("a structure");
}

#[test]
fn a_case_continues_only_one_before_it() {
    for after in [1, 0] {
        let own = if after == 1 { 1 } else { 0 };
        let told = faults(|m| m.cases[own].after = Some(own));
        let name = ["lean", "shake"][own];
        let wanted = format!(
            "case \"{name}\": it continues case \"{name}\", which does not stand before it"
        );
        assert_eq!(told, [wanted]);
    }
    assert_eq!(
        faults(|m| m.cases[1].after = Some(7)),
        ["case \"shake\": case 7 does not exist: there are 2, with indices 0 to 1"]
    );
}

#[test]
fn times_and_tolerances_are_in_their_ranges() {
    assert_eq!(faults(|m| shake(m).dt = 0.0), ["case \"shake\": `dt` = 0: must be > 0"]);
    assert_eq!(
        faults(|m| shake(m).duration = f64::NAN),
        ["case \"shake\": `duration` = NaN: must be > 0"]
    );
    assert_eq!(
        faults(|m| shake(m).solution.alpha = 5.0),
        ["case \"shake\": `alpha` = 5: must be between -1/3 and 0"]
    );
    assert_eq!(faults(|m| shake(m).dt = 1e-300).len(), 1);
    let told = faults(|m| shake(m).solution.step = StepControl::Adaptive { tolerance: f64::NAN });
    assert!(told[0].starts_with("case \"shake\": `tolerance of the steps` = NaN"), "{told:?}");
    let told = faults(|m| shake(m).solution.step = StepControl::Fixed { substeps: 0 });
    assert!(told[0].starts_with("case \"shake\": `substeps` = 0"), "{told:?}");
    assert_eq!(faults(|m| m.damping = Damping::Modal { ratio: -0.1 }).len(), 1);
    assert_eq!(faults(|m| m.nodes[1].position[2] = f64::INFINITY).len(), 1);
    assert_eq!(faults(|m| m.functions[0].function = TimeFunction::Constant(f64::NAN)).len(), 1);
}

#[test]
fn every_index_leads_somewhere() {
    let changes: [fn(&mut Model); 8] = [
        |m| m.supports[0].node = 9,
        |m| m.elements[0].nodes[0] = 9,
        |m| m.patterns[0].forces[0].node = 9,
        |m| shake(m).forces[0].function = 9,
        |m| shake(m).forces[0].pattern = 9,
        |m| m.p_delta = Some(9),
        |m| match &mut m.outputs[0].quantity {
            Quantity::Displacement(terms) => terms[0].node = 9,
            other => panic!("{other:?}"),
        },
        |m| match &mut m.outputs[1].quantity {
            Quantity::LinkForce(terms) => terms[0].coordinate = 9,
            other => panic!("{other:?}"),
        },
    ];
    for change in changes {
        let mut model = model();
        change(&mut model);
        let errors = model.check().expect_err("an index that leads nowhere");
        let of_index =
            |e: &&trilith::model::ModelError| matches!(e.fault, ModelFault::Index { index: 9, .. });
        assert_eq!(errors.iter().filter(of_index).count(), errors.len(), "{errors:?}");
        assert!(matches!(Analysis::new(&model), Err(Error::Model(_))));
    }
}

#[test]
fn names_come_once_and_links_are_links() {
    assert_eq!(
        faults(|m| m.nodes[1].name = "base".into()),
        ["node \"base\": there is another one of this name"]
    );
    let told = faults(|m| {
        if let Quantity::LinkForce(terms) = &mut m.outputs[1].quantity {
            terms[0].element = 0;
        }
    });
    assert_eq!(told, ["output \"stop\": \"mass\" is not a link"]);
}

/// A frame that was set in code is written, as what is read back would have another one.
#[test]
fn a_frame_that_was_set_is_written() {
    let mut model = model();
    let [first, second, third] = model.elements[1].frame.0;
    model.elements[1].frame.0 = [first, third, second.map(|x| -x)];
    let text = resolved(&model);
    let back = trilith::read_text(&text, "back.ron", &trilith::registry(), &[]).expect("a model");
    let pairs = back.elements[1].frame.0.iter().flatten();
    for (a, b) in pairs.zip(model.elements[1].frame.0.iter().flatten()) {
        assert!((a - b).abs() < 1e-12, "{text}");
    }
}

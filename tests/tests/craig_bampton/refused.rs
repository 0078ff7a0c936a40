//! Parts that cannot be reduced: what is wrong is told with its name.

use crate::whole::tower;
use trilith::reduce::{FixedModes, Request};
use trilith_tests::parse;

fn told(text: &str, part: &[&str], change: impl Fn(&mut Request)) -> String {
    let (model, system) = parse(text, &[]);
    let mut request = Request::new(part.to_vec(), FixedModes::Count(3));
    change(&mut request);
    match trilith::reduce::reduce(&model, &system, &request) {
        Ok(reduced) => panic!("{:?}", reduced.kept),
        Err(e) => match e.help() {
            Some(help) => format!("{e}: {help}"),
            None => e.to_string(),
        },
    }
}

#[test]
fn what_is_no_part_of_matrices_is_told_with_its_name() {
    let text = tower("None");
    let plain = |part: &[&str]| told(&text, part, |_| ());
    assert_eq!(
        plain(&["tower", "iso0"]),
        "\"iso0\" is a Wen, which is a link: only linear elements and constraints are reduced, and links and bodies stay outside of the part"
    );
    assert_eq!(
        plain(&["s*"]),
        "\"s0\" stands on the ground by itself: what is inside of a part must follow the ground by the nodes that are kept alone; leave it out of the part"
    );
    assert_eq!(
        plain(&["towr"]),
        "there is no element or group of elements \"towr\": did you mean `tower`?"
    );
    assert!(plain(&["x*"]).starts_with("there is no element or group of elements \"x*\""));
    assert_eq!(plain(&[]), "the part has no linear element");
    let tied = text.replace(
        "\"mast\": Beam",
        "\"rigid\": RigidLink(nodes: (\"n12\", \"n02\")), \"mast\": Beam",
    );
    assert_eq!(told(&tied, &["rigid"], |_| ()), "the part has no linear element");

    let inerter = text.replace(
        "\"mast\": Beam",
        "\"flywheel\": Inerter(nodes: (\"n12\", \"n02\"), b: \"2 t\"), \"mast\": Beam",
    );
    assert_eq!(
        told(&inerter, &["tower", "flywheel"], |_| ()),
        "\"flywheel\" has inertance, which the matrices of a superelement cannot tell from mass; leave it out of the part"
    );
    let bent = text.replace(
        "\"shear\": BaseShear",
        "\"pull\": MemberForce(element: \"c00\", force: N, at: 1), \"shear\": BaseShear",
    );
    assert_eq!(
        told(&bent, &["tower"], |_| ()),
        "\"pull\" (of \"c00\"): forces of elements that the part has; leave these elements out of the part, or the outputs out of the model"
    );
    let heavy = text.replace("damping: None,", "damping: None, p_delta: \"weight\",");
    assert!(told(&heavy, &["tower"], |_| ()).contains("carries an axial force of `p_delta`"));
}

#[test]
fn nodes_that_do_not_suit_are_told_with_their_names() {
    let text = tower("None");
    let keep = |names: &[&str], part: &[&str]| {
        let names: Vec<String> = names.iter().map(|n| (*n).to_owned()).collect();
        told(&text, part, |request| request.keep = Some(names.clone()))
    };
    assert_eq!(
        keep(&["foot"], &["tower"]),
        "node \"foot\" is none of the part: its elements do not have it"
    );
    assert_eq!(
        keep(&["n99"], &["tower"]).split(':').next(),
        Some("there is no node or group of nodes \"n99\"")
    );
    let recover =
        |name: &str| told(&text, &["tower"], |request| request.recover = vec![name.to_owned()]);
    assert!(recover("mast").starts_with("node \"mast\" is none of the part"));

    // A beam that hangs on nothing.
    let alone = r#"(
        plane: XZ,
        nodes: { "a": (0, 0, 0), "b": (0, 0, 2), "c": (3, 0, 0), "d": (3, 0, 2) },
        supports: { "a": Fixed },
        elements: {
            "column": Beam(nodes: ("a", "b"), young: "200 GPa", area: 0.01, i2: 1e-5, i3: 1e-5, density: 7850),
            "lost": Beam(nodes: ("c", "d"), young: "200 GPa", area: 0.01, i2: 1e-5, i3: 1e-5, density: 7850),
        },
        cases: { "weight": Static(loads: [Gravity]) },
        outputs: { "up": Displacement(node: "b", dof: Uz) },
    )"#;
    assert_eq!(
        told(alone, &["column", "lost"], |_| ()),
        "the nodes that are kept do not hold the part: d Ux, d Uz, d Ry can move while they stand still; keep more nodes"
    );
    assert_eq!(
        told(alone, &["lost"], |_| ()),
        "nothing of the part is kept: nothing else touches it, and no node is named"
    );
}

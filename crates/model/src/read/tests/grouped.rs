use super::*;
use crate::{Quantity, resolved};

/// Three feet on the ground, of nodes and elements of other names, and a mast beside them.
fn feet(groups: &str, extra: &str) -> String {
    format!(
        r#"(
    nodes: {{ "n{{i}}": For(i: "1 to 3", of: ("i", 0, 0)), "top": (0, 0, 2) }},
    elements: {{
        "foot {{i}}": For(i: "1 to 3", of: Slider(node: "n{{i}}", kn: 1, mu: 0)),
        "mast {{i}}": For(i: "1 to 3", of: Spring(nodes: ("n{{i}}", "top"), stiffness: 1)),
        "top": Spring(node: "top", stiffness: 1),
    }},
    groups: {{ {groups} }},
    cases: {{ "rest": Static(loads: [Gravity]) }},
    {extra}
)"#
    )
}

const ALL: &str =
    r#""feet": ["foot *"], "ground": ["n1", "n2", "n3"], "masts": ["mast 3", "mast *"]"#;

fn plain(model: &Model) -> String {
    resolved(model).lines().filter(|l| !l.starts_with("//")).collect::<Vec<_>>().join("\n")
}

/// With groups it is the same as with the second text.
#[track_caller]
fn same(groups: &str, grouped: &str, by_hand: &str) {
    let (a, b) = (model(&feet(groups, grouped)), model(&feet(groups, by_hand)));
    assert_eq!(plain(&a), plain(&b));
    assert_eq!(plain(&a), plain(&model(&plain(&a))));
}

#[track_caller]
fn refused(groups: &str, extra: &str, code: &str, words: &str, at: &str) {
    let text = feet(groups, extra);
    let all = errors(&text);
    let told = format!("{} {}", all[0].message, all[0].help.as_deref().unwrap_or_default());
    assert!(all[0].code == code && told.contains(words), "{code} {words}:\n{}", shown(&all));
    assert_eq!((&text[all[0].span.clone()], all.len()), (at, 1), "{}", shown(&all));
}

#[test]
fn supports_loads_and_values_of_a_group_are_those_of_each_member() {
    same(
        ALL,
        r#"supports: { "ground": (Ux, Uy) }"#,
        r#"supports: { "n{i}": For(i: "1 to 3", of: (Ux, Uy)) }"#,
    );
    same(
        ALL,
        r#"loads: { "p": [(node: "ground", dof: Ux, force: 1), (node: ["top", "n1"], dof: Ry, moment: 2)] }"#,
        r#"loads: { "p": [
            For(i: "1 to 3", of: (node: "n{i}", dof: Ux, force: 1)),
            (node: "top", dof: Ry, moment: 2), (node: "n1", dof: Ry, moment: 2),
        ] }"#,
    );
    let case = |node: &str| {
        format!(
            r#"supports: {{ "ground": Ux }}, functions: {{ "f": Sine(amplitude: "1 m", frequency: 1) }}, cases: {{ "c": Dynamic(
                duration: 1, dt: 0.1, initial: [{}], supports: [{}],
            ) }}"#,
            node.replace("REST", "dof: Uz, velocity: 1"),
            node.replace("REST", r#"dof: Ux, displacement: "f""#),
        )
    };
    let without = |extra: String| {
        feet(ALL, &extra).replace(r#"cases: { "rest": Static(loads: [Gravity]) },"#, "")
    };
    let grouped = model(&without(case(r#"(node: "ground", REST)"#)));
    let by_hand = model(&without(case(r#"For(i: "1 to 3", of: (node: "n{i}", REST))"#)));
    assert_eq!(plain(&grouped), plain(&by_hand));
}

#[test]
fn a_group_in_a_list_of_nodes_stands_for_its_members() {
    let m = model(&feet(r#""pair": ["n1", "n3"], "one": ["n2"]"#, "").replace(
        r#""top": Spring(node: "top", "#,
        r#""a": Spring(nodes: "pair", stiffness: 1), "b": Spring(nodes: ("top", "pair"), stiffness: 1), "top": Spring(nodes: ["one", "n3"], "#,
    ));
    let nodes = |name: &str| {
        let e = m.elements.iter().find(|e| e.name == name).unwrap();
        e.nodes.iter().map(|i| m.nodes[*i].name.as_str()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(
        (nodes("a"), nodes("b"), nodes("top")),
        ("n1 n3".into(), "top n1 n3".into(), "n2 n3".into())
    );
}

#[test]
fn a_force_over_a_group_is_the_sum_of_its_members() {
    let m = model(&feet(
        ALL,
        r#"outputs: {
        "shear": LinkForce(link: "feet", axis: U1, factor: 2),
        "two": LinkForce(link: ["foot 1", "foot 3"], axis: U1),
        "masts": ElementForce(element: "masts", end: 1, dof: Uz),
    }"#,
    ));
    let Quantity::LinkForce(terms) = &m.outputs[0].quantity else { panic!("a force") };
    assert_eq!(
        terms.iter().map(|t| (t.element, t.factor)).collect::<Vec<_>>(),
        [(0, 2.0), (1, 2.0), (2, 2.0)]
    );
    let Quantity::LinkForce(terms) = &m.outputs[1].quantity else { panic!("a force") };
    assert_eq!(terms.iter().map(|t| t.element).collect::<Vec<_>>(), [0, 2]);
    let Quantity::ElementForce { elements, .. } = &m.outputs[2].quantity else { panic!("a force") };
    // The order of the list; a pattern adds what is not there yet.
    assert_eq!(elements, &[5, 3, 4]);
    assert_eq!(plain(&m), plain(&model(&plain(&m))));
}

#[test]
fn what_is_no_force_has_no_sum() {
    for (output, at) in [
        (r#"LinkDeformation(link: "feet", axis: U1)"#, r#""feet""#),
        (r#"LinkHistory(link: "feet", variable: "slip2")"#, r#""feet""#),
        (r#"LinkDeformation(link: ["foot 1", "foot 2"], axis: U1)"#, r#"["foot 1", "foot 2"]"#),
        (r#"Displacement(node: "ground", dof: Ux)"#, r#""ground""#),
        (r#"Acceleration(terms: [(node: "ground", dof: Ux)])"#, r#""ground""#),
    ] {
        let extra = format!("outputs: {{ \"o\": {output} }}");
        refused(ALL, &extra, "E0106", "with `For`, and put them together with `Largest`", at);
    }
    let of = |o: &str| format!("outputs: {{ \"o\": {o} }}");
    refused(
        ALL,
        &of(r#"LinkForce(link: "masts", axis: U1)"#),
        "E0106",
        "`mast 3` (Spring) is no link",
        r#""masts""#,
    );
    refused(
        ALL,
        &of(r#"LinkForce(link: "ground", axis: U1)"#),
        "E0106",
        "`ground` is a group of 3 nodes: an element is wanted",
        r#""ground""#,
    );
    refused(
        ALL,
        &of(r#"LinkForce(link: ["foot 1", "feet"], axis: U1)"#),
        "E0102",
        "`foot 1` comes twice",
        r#""feet""#,
    );
}

#[test]
fn groups_are_of_one_kind_and_of_what_there_is() {
    refused(
        r#""g": ["n1", "foot 1"]"#,
        "",
        "E0106",
        "mixes nodes (`n1`) and elements (`foot 1`)",
        r#""foot 1""#,
    );
    refused(
        r#""g": ["top"]"#,
        "",
        "E0106",
        "names of nodes and of elements write `Nodes([…])`",
        r#"["top"]"#,
    );
    refused(
        r#""g": ["n1", "n4"]"#,
        "",
        "E0106",
        "no node and no element `n4` did you mean `n1`?",
        r#""n4""#,
    );
    refused(r#""g": ["foo *"]"#, "", "E0106", "no node and no element fits `foo *`", r#""foo *""#);
    refused(r#""g": Nodes(["foot *"])"#, "", "E0106", "no node fits `foot *`", r#""foot *""#);
    refused(r#""g": Elements(["n1"])"#, "", "E0106", "no element `n1`", r#""n1""#);
    refused(r#""g": Beams(["n1"])"#, "", "E0107", "`Nodes`, `Elements`", "Beams");
    refused(r#""g": ["n1", "n1"]"#, "", "E0102", "`n1` is in the group twice", r#""n1""#);
    refused(r#""g": []"#, "", "E0104", "group `g` is empty", "[]");
    refused(r#""g": Nodes([])"#, "", "E0104", "group `g` is empty", "Nodes([])");
    refused(r#""g": [1]"#, "", "E0105", "not the number 1", "1");
    refused(r#""n1": ["n2"]"#, "", "E0102", "`n1` names a group and a node", "n1");
    refused(r#""foot 1": ["n2"]"#, "", "E0102", "`foot 1` names a group and an element", "foot 1");
    refused(r#""g": ["n2"], "g": ["n3"]"#, "", "E0102", "`g` is given twice", "g");
    let kinds = model(&feet(
        r#""a": Nodes(["top"]), "b": Elements("top", "foot 1")"#,
        r#"supports: { "a": Ux }"#,
    ));
    assert_eq!(kinds.supports.len(), 1);
}

#[test]
fn a_group_is_refused_where_one_is_wanted() {
    let text = feet(ALL, "").replace(r#"Spring(node: "top""#, r#"Spring(node: "ground""#);
    assert!(
        shown(&errors(&text)).contains("`ground` is a group of 3 nodes: one name is wanted here")
    );
    refused(ALL, r#"supports: { "grund": Ux }"#, "E0106", "did you mean `ground`?", "grund");
    refused(
        ALL,
        r#"supports: { "feet": Ux }"#,
        "E0106",
        "`feet` is a group of 3 elements: a node is wanted here",
        "feet",
    );
    refused(
        ALL,
        r#"supports: { "ground": Ux, "n2": Uy }"#,
        "E0116",
        "node `n2` has two supports",
        "n2",
    );
}

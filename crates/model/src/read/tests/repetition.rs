use super::*;
use crate::expand::MOST_ENTRIES;
use crate::resolved;

/// A frame of bays and storeys in a plane, written node by node or by repetition.
const FRAME: &str = r#"(
    parameters: { "bays": 2, "storeys": 3, "bay": "6 m", "k": "1 kN/m" },
    nodes: { "{i}.{j}": For(i: "0 to bays", j: "0 to storeys", of: ("i*bay", 0, "j * 3.2 m")) },
    supports: { "{i}.0": For(i: "0 to bays", of: Fixed) },
    properties: { "column": Spring(stiffness: "k"), "beam": Spring(stiffness: "2*k") },
    elements: {
        "column {i}.{j}": For(i: "0 to bays", j: "1 to storeys", of: Spring(nodes: ("{i}.{j-1}", "{i}.{j}"), use: "column")),
        "beam {i}.{j}": For(j: "1 to storeys", i: "1 to bays", of: Spring(nodes: ("{i-1}.{j}", "{i}.{j}"), use: "beam")),
    },
    loads: { "wind": [For(j: "1 to storeys", of: (node: "0.{j}", dof: Ux, force: "j * 10 kN"))] },
    cases: { "rest": Static(loads: [Gravity]) },
    outputs: { "roof": Displacement(node: "{bays}.{storeys}", dof: Ux) },
)"#;

/// What a model resolves to, without the comments.
fn plain(model: &Model) -> String {
    resolved(model).lines().filter(|l| !l.starts_with("//")).collect::<Vec<_>>().join("\n")
}

fn node_names(model: &Model) -> Vec<&str> {
    model.nodes.iter().map(|n| n.name.as_str()).collect()
}

/// A model with these nodes.
fn nodes(of: &str) -> String {
    small("").replace(r#""a": (0, 0, 0)"#, &format!("{of}, \"a\": (0, 0, 0)"))
}

#[test]
fn a_repetition_is_what_would_be_written_out() {
    let by_hand = || {
        let mut t = String::from("(nodes: {");
        for i in 0..=2 {
            for j in 0..=3 {
                t += &format!("\"{i}.{j}\": ({}, 0, \"{j} * 3.2 m\"), ", 6 * i);
            }
        }
        t += r#"}, supports: { "0.0": Fixed, "1.0": Fixed, "2.0": Fixed }, elements: {"#;
        for i in 0..=2 {
            for j in 1..=3 {
                t += &format!(
                    r#""column {i}.{j}": Spring(nodes: ("{i}.{}", "{i}.{j}"), stiffness: "1 kN/m"), "#,
                    j - 1
                );
            }
        }
        for j in 1..=3 {
            for i in 1..=2 {
                t += &format!(
                    r#""beam {i}.{j}": Spring(nodes: ("{}.{j}", "{i}.{j}"), stiffness: "2 kN/m"), "#,
                    i - 1
                );
            }
        }
        t + r#"}, loads: { "wind": [
            (node: "0.1", dof: Ux, force: "10 kN"), (node: "0.2", dof: Ux, force: "20 kN"),
            (node: "0.3", dof: Ux, force: "30 kN"),
        ] }, cases: { "rest": Static(loads: [Gravity]) },
        outputs: { "roof": Displacement(node: "2.3", dof: Ux) })"#
    };
    let made = model(FRAME);
    assert_eq!(plain(&made), plain(&model(&by_hand())));
    // What is printed is no repetition any more and reads back.
    assert_eq!(plain(&made), plain(&model(&resolved(&made))));
    let larger = model_with(FRAME, &[("bays", "4"), ("storeys", "1")]);
    assert_eq!((larger.nodes.len(), larger.elements.len()), (10, 9));
    assert_eq!((larger.patterns[0].forces.len(), larger.supports.len()), (1, 5));
    let crate::Quantity::Displacement(roof) = &larger.outputs[0].quantity else { panic!("roof") };
    assert_eq!(larger.nodes[roof[0].node].name, "4.1");
}

#[test]
fn indices_run_through_lists_maps_and_ranges_of_indices_before() {
    let listed = model(&nodes(
        r#""{side} {x}": For(side: ["west", east], x: {"p": "50 cm", "q": 3}, of: ("2*x", 0, 1))"#,
    ));
    assert_eq!(node_names(&listed), ["west p", "west q", "east p", "east q", "a", "b"]);
    assert_eq!(listed.nodes[0].position, [1.0, 0.0, 1.0]);
    assert_eq!(listed.nodes[3].position, [6.0, 0.0, 1.0]);
    let triangle =
        model(&nodes(r#""{i}{k}": For(i: "1 to 3", k: "i + 1 to 3", of: (0, "k", "i"))"#));
    assert_eq!(node_names(&triangle), ["12", "13", "23", "a", "b"]);
    let nested =
        model(&nodes(r#""{i}{k}": For(i: "1 to 3", of: For(k: "i + 1 to 3", of: (0, 0, "i")))"#));
    assert_eq!(node_names(&nested), ["12", "13", "23", "a", "b"]);
    assert_eq!(nested.nodes[2].position, [0.0, 0.0, 2.0]);
    // Braces stand for themselves, a name for a direction may come from an index, and nothing may come of nothing.
    let text = nodes(r#""{{x}} {2*i^2}": For(i: "1 to 1", of: (0, 0, 0)), "{i}": For(i: "2 to 1", of: (0, 0, 0))"#)
        .replace("cases:", r#"outputs: { "u{d}": For(d: [Ux, Ry], of: Displacement(node: "a", dof: "{d}")) }, cases:"#);
    let m = model(&text);
    assert_eq!(node_names(&m), ["{x} 2", "a", "b"]);
    assert_eq!((m.outputs[0].name.as_str(), m.outputs[1].name.as_str()), ("uUx", "uRy"));
    assert_eq!(m.outputs[1].unit, "rad");
    assert_eq!(plain(&m), plain(&model(&resolved(&m))));
}

#[test]
fn values_of_an_index_may_have_several_names() {
    let of = |rows: &str| {
        nodes(&format!(r#""{{c}}{{k}}": For(k: "1 to 2", c: {{ {rows} }}, of: ("x", "k*y", 0))"#))
    };
    let m = model(&of(r#""p": (x: 1, y: "2 m"), "q": (x: "k", y: 0)"#));
    assert_eq!(node_names(&m), ["p1", "q1", "p2", "q2", "a", "b"]);
    assert_eq!((m.nodes[2].position, m.nodes[3].position), ([1.0, 4.0, 0.0], [2.0, 0.0, 0.0]));
    let named = nodes(
        r#""{u}-{v}": For(w: { "uv": (u: "a", v: b), "vw": (u: "v", v: "w") }, of: (0, 0, 0))"#,
    );
    assert_eq!(node_names(&model(&named)), ["a-b", "v-w", "a", "b"]);
    refused(
        &of(r#""p": (x: 1, y: 2), "q": (x: 1)"#),
        "E0105",
        "`q` has other names than the first of these values, with k = 1 all have (x, y)",
        "(x: 1)",
    );
    refused(&of(r#""p": (x: 1, y: 2), "q": 3"#), "E0105", "`q` has other names", "3");
    refused(
        &of(r#""p": 3, "q": (x: 1)"#),
        "E0105",
        "give a number or a text, as the first does",
        "(x: 1)",
    );
    refused(&of(r#""p": (x: 1, m: 2)"#), "E0105", "it is a unit of m", "m");
    refused(&of(r#""p": (x: 1, c: 2)"#), "E0105", "`c` is the index itself", "c");
    let later = of(r#""p": (x: 1, y: 2)"#).replace("y: 2) },", r#"y: 2) }, y: "1 to 2","#);
    refused(&later, "E0105", "an index of the repetition around this one", "y");
    refused(
        &of(r#""p": (x: 1, k: 2)"#),
        "E0105",
        "an index of the repetition around this one",
        "k",
    );
}

#[test]
fn conditions_choose_among_the_repetitions() {
    let chosen = |when: &str| {
        let of = format!(
            r#""{{i}}{{k}}": For(i: "0 to 2", k: "0 to 2", when: "{when}", of: (0, 0, 0))"#
        );
        let m = model(&nodes(&of));
        node_names(&m).iter().filter(|n| n.len() == 2).copied().collect::<Vec<_>>().join(" ")
    };
    assert_eq!(chosen("i == k"), "00 11 22");
    assert_eq!(chosen("i<k and i != 1"), "01 02");
    assert_eq!(chosen("i > 1 and k > 1 or i + k == 0"), "00 22");
    assert_eq!(chosen("i > 1 and (k > 1 or i + k == 2)"), "20 22");
    assert_eq!(chosen("not (i <= 1 or k >= 2)"), "20 21");
    assert_eq!(chosen("(i + 1)*2 == 2*(k - 1)"), "02");
    assert_eq!(chosen("(i)*1 m > 1.5 m and(k)!=0"), "21 22");
}

#[track_caller]
fn refused(text: &str, code: &str, words: &str, at: &str) {
    let all = errors(text);
    let told = format!("{} {}", all[0].message, all[0].help.as_deref().unwrap_or_default());
    assert!(all[0].code == code && told.contains(words), "{code} {words}:\n{}", shown(&all));
    assert_eq!(&text[all[0].span.clone()], at, "{}", shown(&all));
    assert_eq!(all.len(), 1, "{}", shown(&all));
}

#[test]
fn errors_stand_at_the_template_with_the_indices() {
    // In what is repeated, found while it is read.
    let text = FRAME.replace(
        r#"("{i-1}.{j}", "{i}.{j}"), use: "beam""#,
        r#"("{i-1}.{j}", "{i+1}.{j}"), use: "beam""#,
    );
    refused(&text, "E0106", "no node `3.1`, with j = 1, i = 2 and 2 times more", r#""{i+1}.{j}""#);
    let text = FRAME.replace("j * 3.2 m", "j * 3.2 s");
    refused(
        &text,
        "E0111",
        "must be a value in m, with i = 0, j = 0 and 11 times more",
        r#""j * 3.2 s""#,
    );
    let text = FRAME.replace("j * 3.2 m", "l * 3.2 m");
    refused(&text, "E0110", "no parameter `l`, with i = 0, j = 0 and 11 times more", "l");
    // A wrong word that all of them have can be put right, one that an index makes cannot.
    let all = errors(&FRAME.replace(r#"use: "beam""#, r#"use: "beams""#));
    assert_eq!(all.len(), 1);
    assert_eq!(all[0].suggestion.as_ref().map(|s| s.1.as_str()), Some("\"beam\""));
    let all = errors(&FRAME.replace(r#""{i}.{j}"), use: "beam""#, r#""{i}.{j}0"), use: "beam""#));
    assert!(all[0].message.contains("`1.10`, with j = 1, i = 1") && all[0].suggestion.is_none());
    // In the texts themselves.
    refused(
        &nodes(r#""{i+}": For(i: "0 to 9", of: (0, 0, 0))"#),
        "E0108",
        "not the end, with i = 0",
        "",
    );
    refused(
        &nodes(r#""{i/2}": For(i: "0 to 9", of: (0, 0, 0))"#),
        "E0112",
        "`{i/2}` is 0.5: must be a whole number, with i = 1",
        "i/2",
    );
    refused(&nodes(r#""n{l}": For(i: "0 to 9", of: (0, 0, 0))"#), "E0110", "no parameter `l`", "l");
    refused(&nodes(r#""n{i": For(i: "0 to 9", of: (0, 0, 0))"#), "E0108", "`{` is not closed", "{");
    refused(&nodes(r#""n}": For(i: "0 to 9", of: (0, 0, 0))"#), "E0108", "`}` closes nothing", "}");
    refused(
        &nodes(r#""{x}": For(x: ["2 m"], of: (0, 0, "west*x"))"#),
        "E0110",
        "`west`, with x = 2 m",
        "west",
    );
    refused(
        &nodes(r#""{x}": For(x: ["west"], of: (0, 0, "2*x"))"#),
        "E0111",
        "the index `x` is the text \"west\"",
        "x",
    );
}

#[test]
fn names_that_come_twice_name_both() {
    let all = errors(&nodes(r#""n{i*k}": For(i: "1 to 2", k: "1 to 2", of: (0, 0, 0))"#));
    assert_eq!(all.len(), 1, "{}", shown(&all));
    assert_eq!(all[0].message, "`n2` is given twice, with i = 2, k = 1");
    assert_eq!(all[0].related[0].1, "first given here, with i = 1, k = 2");
    assert!(all[0].help.as_ref().unwrap().contains("each index belongs into the name"));
    let all = errors(&nodes(r#""n{i}": For(i: "1 to 2", of: (0, 0, 0)), "n2": (0, 0, 0)"#));
    assert_eq!(all[0].message, "`n2` is given twice");
    assert_eq!(all[0].related[0].1, "first given here, with i = 2");
}

#[test]
fn an_index_hides_nothing() {
    let with = |name: &str| {
        nodes(&format!(r#""{{{name}}}": For({name}: "0 to 1", of: (0, 0, 0))"#))
            .replace("cases:", r#"parameters: {"bay": 1, "file": Text("x")}, cases:"#)
    };
    assert_eq!(model(&with("i")).nodes.len(), 4);
    refused(&with("bay"), "E0105", "it is a parameter of the model", "bay");
    refused(&with("file"), "E0105", "it is a parameter of the model", "file");
    refused(&with("s"), "E0105", "it is a unit of s: `2 s` would not be `2*s`", "s");
    refused(&with("pi"), "E0105", "π", "pi");
    let nested = r#""{i}": For(i: "0 to 1", of: For(i: "0 to 1", of: (0, 0, 0)))"#;
    refused(&nodes(nested), "E0105", "an index of the repetition around this one, with i = 0", "i");
    // Not so beside each other.
    let beside =
        r#""p{i}": For(i: "0 to 1", of: (0, 0, 0)), "q{i}": For(i: "0 to 1", of: (0, 0, 0))"#;
    assert_eq!(model(&nodes(beside)).nodes.len(), 6);
}

#[test]
fn repetitions_have_their_form() {
    let of = |fields: &str| nodes(&format!(r#""n{{i}}": For({fields})"#));
    refused(
        &of(r#"i: "0..4", of: (0, 0, 0)"#),
        "E0105",
        r#"write `"0 to 4"`: both ends are included"#,
        r#""0..4""#,
    );
    refused(&of(r#"i: "0..=4", of: (0, 0, 0)"#), "E0105", r#"write `"0 to 4"`"#, r#""0..=4""#);
    refused(&of("i: 4, of: (0, 0, 0)"), "E0105", "through the number 4 write `\"0 to 4\"`", "4");
    refused(&of("i: [], of: (0, 0, 0)"), "E0104", "runs through nothing", "[]");
    refused(&of("i: [true], of: (0, 0, 0)"), "E0105", "takes `true` as a value", "true");
    refused(
        &of(r#"i: "0 to 1.5", of: (0, 0, 0)"#),
        "E0112",
        "`1.5` is 1.5: an index runs from one whole number",
        r#""0 to 1.5""#,
    );
    refused(&of(r#"i: "0 to 2 m", of: (0, 0, 0)"#), "E0112", "`2 m` is 2 m", r#""0 to 2 m""#);
    refused(&of(r#"i: "0 to bays", of: (0, 0, 0)"#), "E0110", "`bays`", "bays");
    refused(&of(r#"i: "0 to 1""#), "E0104", "a repetition has no `of`", "For");
    refused(&of("of: (0, 0, 0)"), "E0104", "a repetition has no index", "For");
    refused(
        &of(r#"i: "0 to 1", when: i, of: (0, 0, 0)"#),
        "E0105",
        "`when` is `i`: must be a text",
        "i",
    );
    refused(&of(r#"i: "0 to 1", when: "i", of: (0, 0, 0)"#), "E0108", "`i` compares nothing", "i");
    refused(
        &of(r#"i: "0 to 1", when: "i > 1 m", of: (0, 0, 0)"#),
        "E0111",
        "cannot be compared, with i = 1",
        "i > 1 m",
    );
    refused(&of(r#"i: "0 to 1", when: "i > 0 or l > 1", of: (0, 0, 0)"#), "E0110", "`l`", "l");
    refused(
        &small("title: For(i: \"0 to 1\", of: 1)"),
        "E0105",
        "cannot stand here",
        "For(i: \"0 to 1\", of: 1)",
    );
    let nine: String = (0..9).map(|i| format!("i{i}: \"0 to 0\", ")).collect();
    refused(&of(&format!("{nine} of: (0, 0, 0)")), "E0112", "more than 8 indices", "For");
}

#[test]
fn repetition_is_bounded() {
    let of = |fields: &str| nodes(&format!(r#""n{{i}}": For({fields})"#));
    for bounds in ["0 to 1000000", "0 to 1e15", "-1e15 to 1e15"] {
        let text = of(&format!(r#"i: "{bounds}", of: (0, 0, 0)"#));
        refused(
            &text,
            "E0112",
            &format!("more than {MOST_ENTRIES} entries"),
            &format!("\"{bounds}\""),
        );
    }
    refused(&of(r#"i: "0 to 1e16", of: (0, 0, 0)"#), "E0112", "whole number", r#""0 to 1e16""#);
    // What a condition leaves out counts as well.
    let text = of(r#"i: "0 to 999", k: "0 to 1000", when: "i < 0", of: (0, 0, 0)"#);
    refused(&text, "E0112", "entries, with i = 998", r#""0 to 1000""#);
    // Few entries of many values.
    let long = "x".repeat(200_000);
    let text = of(&format!(r#"i: "1 to 10000", of: "{long}""#));
    assert!(shown(&errors(&text)).contains("more than 10000000 values"));
}

#[test]
fn braces_in_texts_of_ordinary_entries_are_filled_in() {
    let text = small(
        r#"parameters: { "n": 2, "what": Text("tall") }, title: "{what}, {n} nodes", outputs: { "u": Displacement(node: "a", dof: Ux) }"#,
    );
    assert_eq!(model(&text).title, "tall, 2 nodes");
    assert_eq!(model_with(&text, &[("n", "7"), ("what", "low")]).title, "low, 7 nodes");
    let resolved = resolved(&model(&small(r#"title: "{{n}}""#)));
    assert!(resolved.contains(r#"title: "{{n}}""#), "{resolved}");
}

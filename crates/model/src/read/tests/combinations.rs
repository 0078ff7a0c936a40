//! Combinations of cases.

use super::{errors, model, shown};
use crate::CombinationTerm::{Case, Combination};
use crate::CombineCases::{Envelope, LinearAdd, Srss};
use crate::resolved;

fn text(combinations: &str) -> String {
    format!(
        r#"(
    nodes: {{ "a": (0, 0, 0), "b": (0, 0, "2 m") }},
    parameters: {{ "share": 0.5, "force": "1 kN" }},
    elements: {{ "k": Spring(nodes: ("a", "b"), stiffness: "1 kN/m") }},
    cases: {{ "dead": Static(loads: [Gravity]), "q 1": Static(loads: []), "q 2": Static(loads: []) }},
    combinations: {{ {combinations} }},
)"#
    )
}

#[test]
fn they_take_cases_and_those_before_them() {
    let m = model(&text(
        r#""add": LinearAdd(cases: { "dead": 1.35, "q 1": "1.5*share" }),
           "both": Srss(cases: [For(i: "1 to 2", of: "q {i}")]),
           "all": Envelope(cases: ["add", "both"])"#,
    ));
    let [add, both, all] = &m.combinations[..] else { panic!("three") };
    assert_eq!((add.how, &add.terms[..]), (LinearAdd, &[(Case(0), 1.35), (Case(1), 0.75)][..]));
    assert_eq!((both.how, &both.terms[..]), (Srss, &[(Case(1), 1.0), (Case(2), 1.0)][..]));
    let terms = [(Combination(0), 1.0), (Combination(1), 1.0)];
    assert_eq!((all.how, &all.terms[..], all.name.as_str()), (Envelope, &terms[..], "all"));
    assert_eq!(model(&resolved(&m)).combinations, m.combinations);
}

#[test]
fn what_they_cannot_combine_is_told() {
    let refused = |combinations: &str, code: &str, words: &str, at: &str| {
        let text = text(combinations);
        let all = errors(&text);
        let told = format!("{} {}", all[0].message, all[0].help.as_deref().unwrap_or_default());
        assert!(all[0].code == code && told.contains(words), "{code} {words}:\n{}", shown(&all));
        assert_eq!((&text[all[0].span.clone()], all.len()), (at, 1), "{}", shown(&all));
    };
    let wrong = r#""a": Envelope(cases: ["dead", "q 3"])"#;
    refused(wrong, "E0106", "there is no case and no combination `q 3`", "\"q 3\"");
    let later = r#""a": Envelope(cases: ["b"]), "b": Srss(cases: ["q 1"])"#;
    refused(later, "E0106", "put it behind", "\"b\"");
    refused(r#""a": Srss(cases: ["a"])"#, "E0106", "is no combination before this one", "\"a\"");
    refused(r#""a": Sum(cases: ["q 1"])"#, "E0107", "there is no combination `Sum`", "Sum");
    refused(r#""a": Srss(cases: [])"#, "E0104", "has no cases", "[]");
    refused(r#""a": Srss(cases: { "dead": "force" })"#, "E0111", "a pure number", "\"force\"");
    refused(r#""a": Srss(cases: 3)"#, "E0105", "a map from names of cases", "3");
    refused(r#""dead": Srss(cases: ["q 1"])"#, "E0102", "give one of them another name", "dead");
    refused(r#""a": Srss(cases: ["q 1", "q 1"])"#, "E0102", "twice", r#"["q 1", "q 1"]"#);
    refused(r#""a": Srss(cases: { "q 3": 1 })"#, "E0106", "did you mean `q 1`?", "q 3");
    refused(r#""a": Srss()"#, "E0104", "has no `cases`", "Srss");
}

#[test]
fn a_model_made_in_code_is_looked_at() {
    let mut m = model(&text(r#""a": Srss(cases: ["q 1"]), "b": Envelope(cases: ["a"])"#));
    assert!(m.check().is_ok());
    m.combinations[0].terms = vec![(Combination(1), f64::NAN), (Case(7), 1.0)];
    m.combinations[1].terms.clear();
    let told: Vec<_> = m.check().unwrap_err().iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 4, "{told:?}");
}

use super::*;

/// The model is refused with this code, these words and an error at this text.
#[track_caller]
fn refused(text: &str, code: &str, words: &str, at: &str) {
    let all = errors(text);
    let hit = all.iter().any(|e| {
        let told = format!("{} {}", e.message, e.help.as_deref().unwrap_or_default());
        e.code == code && told.contains(words) && text[e.span.clone()].contains(at)
    });
    assert!(hit, "{code} {words} at {at} not in\n{}", shown(&all));
}

fn spring(fields: &str) -> String {
    small("").replace(r#"nodes: ("a", "b"), stiffness: "1 kN/m""#, fields)
}

fn case(text: &str) -> String {
    small(r#"functions: { "f": Sine(amplitude: "1 m", frequency: 1) },"#)
        .replace("Static(loads: [Gravity])", text)
}

#[test]
fn misspelt_names_are_answered_with_the_near_one() {
    refused(&spring(r#"nodes: ("a", "b"), stifness: 1"#), "E0103", "`stiffness`", "stifness");
    refused(&spring(r#"nodes: ("a", "bb"), stiffness: 1"#), "E0106", "`b`", "\"bb\"");
    refused(&small("").replace("Spring", "Sprin"), "E0107", "`Spring`", "Sprin");
    refused(&small("").replace("kN/m", "kn/m"), "E0109", "`kN`", "kn");
    refused(&small(r#"parameters: {"wide": 1, "x": "2*wode"},"#), "E0110", "`wide`", "wode");
    refused(&small("gravitty: 1"), "E0103", "`gravity`", "gravitty");
    refused(
        &case(r#"Dynamic(duration: 1, dt: 1, base: [(direction: X, function: "g")])"#),
        "E0106",
        "`f`",
        "\"g\"",
    );
}

#[test]
fn all_errors_of_a_file_come_together_in_its_order() {
    let text = small(r#"gravity: -1, damping: Modal(ratio: 2), supports: {"c": Fixed}"#)
        .replace("1 kN/m", "1 kN");
    let all = errors(&text);
    assert_eq!(all.len(), 4, "{}", shown(&all));
    assert!(all.windows(2).all(|w| w[0].span.start <= w[1].span.start));
}

#[test]
fn dimensions_are_checked() {
    refused(&small("").replace("1 kN/m", "1 kN"), "E0111", "must be a value in N/m", "1 kN");
    refused(&small("").replace("1 kN/m", "1 m + 2 s"), "E0111", "added", "1 m + 2 s");
    refused(&small("").replace("1 kN/m", "90 deg"), "E0111", "pure number", "90 deg");
    let base = r#"Dynamic(duration: 1, dt: 0.1, base: [(direction: X, function: "f")])"#;
    refused(&case(base), "E0111", "gives m: must give m/s²", "\"f\"");
}

#[test]
fn values_out_of_range_say_the_range() {
    refused(&small("").replace("1 kN/m", "-1 kN/m"), "E0112", "-1000 N/m: must be > 0", "-1 kN/m");
    refused(&spring(r#"nodes: ("a", "b"), stiffness: 1e400"#), "E0112", "finite", "1e400");
    refused(&spring(r#"nodes: ("a", "b"), stiffness: NaN"#), "E0112", "finite", "NaN");
    refused(&case("Dynamic(duration: 1, dt: 2)"), "E0112", "longer than the case", "2");
    refused(
        &case("Dynamic(duration: 1, dt: 1, alpha: -0.5)"),
        "E0112",
        "between -1/3 and 0",
        "-0.5",
    );
    refused(&case("Static(loads: [], steps: 0)"), "E0112", "1 or more", "0");
}

#[test]
fn broken_text_and_doubled_keys_have_a_place() {
    refused("(nodes: {,", "E0101", "", ",");
    refused(&small("plane: XZ, plane: YZ"), "E0102", "given twice", "plane");
    let twice = small("").replace(r#""b": (0"#, r#""a": (0"#);
    let all = errors(&twice);
    assert_eq!((all[0].line(), all[0].column()), (2, 31), "{}", shown(&all));
    let marked = format!("\u{feff}{}", small("gravity: true"));
    refused(&marked, "E0105", "a number", "true");
}

#[test]
fn parameters_that_need_each_other_are_named() {
    let text = small(r#"parameters: {"x": "2*y", "y": "x/2"}"#);
    refused(&text, "E0113", "`x` → `y` → `x`", "x");
}

#[test]
fn wrong_arguments_of_set_are_told_with_their_name() {
    let text = small(r#"parameters: {"mass": "1 kg"}"#);
    let e = read_with(&text, &[("mas", "2")]).expect_err("unknown");
    assert!(e[0].to_string().contains("--set mas=2") && shown(&e).contains("`mass`"));
    let e = read_with(&text, &[("mass", "2 m")]).expect_err("dimension");
    assert!(shown(&e).contains("in m, the model declares it in kg"), "{}", shown(&e));
}

#[test]
fn nodes_must_suit_the_kind() {
    refused(&spring(r#"nodes: ("a", "a"), stiffness: 1"#), "E0115", "twice", "\"a\"");
    refused(&spring(r#"nodes: (), stiffness: 1"#), "E0115", "1 to 3", "()");
    refused(&spring("stiffness: 1"), "E0104", "`nodes`", "Spring");
    refused(&spring(r#"node: "a""#), "E0104", "`stiffness`", "Spring");
}

#[test]
fn an_error_of_the_law_points_at_its_parameter() {
    let text = small("").replace("Spring", "Slider").replace("stiffness", "mu: 0, c: 5, kn");
    refused(&text, "E0114", "needs friction", "5");
}

#[test]
fn cases_continue_only_earlier_ones() {
    let text = small("").replace("[Gravity])", r#"[], after: "next"), "next": Static(loads: [])"#);
    refused(&text, "E0118", "stands after it", "\"next\"");
}

#[test]
fn moved_supports_must_be_fixed_and_smooth() {
    let motion =
        r#"Dynamic(duration: 1, dt: 0.1, supports: [(node: "a", dof: Ux, displacement: "f")])"#;
    refused(&case(motion), "E0116", "not fixed", "node");
    let table = case(motion)
        .replace(r#"Sine(amplitude: "1 m", frequency: 1)"#, "Points(points: ((0, 0), (1, 1)))");
    refused(&table, "E0118", "interpolation: Cubic", "\"f\"");
}

#[test]
fn outputs_must_exist() {
    refused(
        &small(r#"outputs: {"o": LinkForce(link: "k", axis: U1)}"#),
        "E0106",
        "no link",
        "\"k\"",
    );
    let slider = |o: &str| {
        small(&format!("outputs: {{\"o\": {o}}}"))
            .replace("Spring", "Slider")
            .replace("stiffness", "kn")
    };
    refused(&slider(r#"LinkForce(link: "k", axis: U2)"#), "E0106", "it has U1", "U2");
    refused(&slider(r#"LinkHistory(link: "k", variable: "slip")"#), "E0106", "`slip2`", "\"slip\"");
    let mixed = r#"Displacement(terms: ((node: "a", dof: Ux), (node: "a", dof: Ry)))"#;
    refused(&small(&format!("outputs: {{\"o\": {mixed}}}")), "E0111", "cannot be added", "Ry");
}

#[test]
fn empty_sections_are_refused() {
    refused("(nodes: {}, elements: {}, cases: {})", "E0104", "`elements` is empty", "{}");
    refused("(title: \"x\")", "E0104", "`nodes`", "title");
}

#[test]
fn parameters_named_like_units_of_another_dimension() {
    refused(&small(r#"parameters: {"h": "2 m"},"#), "E0105", "`2*h` and `2 h`", "h");
    refused(&small(r#"parameters: {"g": 3},"#), "E0105", "unit of m/s", "g");
    let fine = small(r#"parameters: {"g": "9.81 m/s^2", "gap": "1 cm", "load": "2 GN"},"#);
    let model = super::super::read_text(&fine, "model.ron", &registry(), &[]).unwrap();
    assert_eq!(
        model.parameters[2].value,
        crate::ParameterValue::Number(2e9, trilith_element::dimension::FORCE)
    );
}

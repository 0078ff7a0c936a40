//! Files that are absurd: far too large, far too long, far too many.

use super::*;

/// The only error of a model, at this text.
#[track_caller]
fn only(text: &str, code: &str, words: &str, at: &str) {
    let all = errors(text);
    let [e] = all.as_slice() else { panic!("{}", shown(&all)) };
    let told = format!("{} {}", e.message, e.help.as_deref().unwrap_or_default());
    assert!(e.code == code && told.contains(words), "{}", shown(&all));
    assert_eq!(&text[e.span.clone()], at);
}

#[test]
fn coordinates_whose_squares_overflow_are_refused_where_they_stand() {
    let far = |z: &str| small("").replace("\"2 m\"", z);
    for z in ["1e200", "-1e200", "1.1e12", "\"1e150 km\""] {
        only(&far(z), "E0112", "`node b`", z);
    }
    only(&far("1e200"), "E0112", "between -1e12 m and 1e12 m", "1e200");
    model(&far("1e12"));
    let two = far("1e200").replace("(0, 0, 0)", "(0, 1e300, 0)");
    let places: Vec<_> = errors(&two).iter().map(|e| two[e.span.clone()].to_owned()).collect();
    assert_eq!(places, ["1e300", "1e200"]);
}

/// Whose reciprocal is no number, it is no tolerance.
#[test]
fn tolerances_lie_between_zero_and_one() {
    let case = |x: &str| {
        let dynamic = format!("Dynamic(duration: 1, dt: 0.1, link_tolerance: {x})");
        small("").replace("Static(loads: [Gravity])", &dynamic)
    };
    for x in ["0", "1e-310", "1", "-1"] {
        only(&case(x), "E0112", "`link_tolerance`", x);
        only(&case(x), "E0112", "must be > 0 and < 1", x);
    }
    for x in ["1e-300", "0.999"] {
        model(&case(x));
    }
}

#[test]
fn a_lever_of_a_link_is_bounded_as_well() {
    let slider = |at: &str| {
        let fields = format!("Slider(shear_at: {at}, nodes: (\"a\", \"b\"), kn: ");
        small("").replace("Spring(nodes: (\"a\", \"b\"), stiffness: ", &fields)
    };
    only(&slider("1e100"), "E0112", "`shear_at`", "1e100");
    model(&slider("1"));
}

#[test]
fn more_output_steps_than_can_be_kept_are_refused_at_their_step() {
    let case = |duration: &str, dt: &str| {
        let dynamic = format!("Dynamic(duration: {duration}, dt: {dt})");
        small("").replace("Static(loads: [Gravity])", &dynamic)
    };
    only(&case("1e9", "\"1 ms\""), "E0112", "at least 20 s", "\"1 ms\"");
    only(&case("1e300", "1e-300"), "E0112", "at most 50000000", "1e-300");
    model(&case("50000000", "1"));
}

/// Five hundred of them.
fn many(one: impl Fn(usize) -> String) -> String {
    (0..500).map(one).collect::<Vec<_>>().join(", ")
}

#[test]
fn of_hundreds_of_wrong_names_the_first_are_answered_with_a_near_one() {
    let parameters = many(|i| format!("\"p{i}\": \"q{i}*2\""));
    let elements = many(|i| format!("\"m{i}\": Spring(nodes: (\"a\", \"x{i}\"), stiffness: 1)"));
    let numbers = many(|i| format!("\"m{i}\": Spring(nodes: (\"a\", \"b\"), stiffness: \"q{i}\")"));
    let with = |elements: &str| {
        let spring = r#""k": Spring(nodes: ("a", "b"), stiffness: "1 kN/m")"#;
        small("").replace(spring, elements)
    };
    for text in [
        small(&format!("parameters: {{ {parameters} }}")),
        with(&elements),
        with(&numbers).replace("(\n", "(\n    parameters: { \"p\": 1 },\n"),
    ] {
        let all = errors(&text);
        assert_eq!(all.len(), 500);
        let answered = all.iter().filter(|e| e.help.is_some()).count();
        assert_eq!(answered, crate::diagnostic::SEARCHED);
        assert!(all[0].help.is_some() && all[499].help.is_none());
    }
}

#[test]
fn brackets_within_brackets_are_told_in_words_of_the_file() {
    for (open, close) in [("[", "]"), ("(", ")"), ("Some(", ")"), ("{\"a\": ", "}"), ("[1, ", "]")]
    {
        for depth in [200, 20_000] {
            let nested = format!("{}1{}", open.repeat(depth), close.repeat(depth));
            let text = small("").replace("\"2 m\"", &nested);
            let all = errors(&text);
            let [e] = all.as_slice() else { panic!("{}", shown(&all)) };
            assert!(e.code == "E0101" && e.message.contains("nested too deeply"), "{e}");
            assert!(!e.to_string().contains("recursion"), "{e}");
            assert_eq!(e.line(), 2);
            let inside = text.find(&nested).unwrap()..text.find(&nested).unwrap() + nested.len();
            assert!(inside.contains(&e.span.start), "{e}");
        }
    }
}

#[test]
fn motions_that_meet_spectra_are_bounded_together_before_one_is_made() {
    let one = |i: usize, seed: usize, duration: &str| {
        format!(
            "\"f{i}\": Synthetic(seed: {seed}, duration: \"{duration}\", spectrum: [(0.03, 3), (0.3, 8), (4, 1)])"
        )
    };
    let functions = |all: Vec<String>| small(&format!("functions: {{ {} }}", all.join(", ")));
    let text = functions((0..40).map(|i| one(i, i, "200 s")).collect());
    let start = std::time::Instant::now();
    let all = errors(&text);
    let [e] = all.as_slice() else { panic!("{}", shown(&all)) };
    assert!(e.code == "E0112" && e.message.contains("the motions of this file"), "{}", shown(&all));
    assert!(start.elapsed().as_secs_f64() < 1.0);
    // One and the same, and many short ones, are no such thing.
    model(&functions((0..40).map(|i| one(i, 1, "200 s")).collect()));
    model(&functions((0..20).map(|i| one(i, i, "2 s")).collect()));
}

use super::*;
use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// A value in few words: kinds, names and numbers.
fn told(node: &Node) -> String {
    let all = |nodes: &[Node]| nodes.iter().map(told).collect::<Vec<_>>().join(" ");
    let each = |entries: &[Entry]| {
        entries
            .iter()
            .map(|e| format!("{}={}", e.key, told(&e.value)))
            .collect::<Vec<_>>()
            .join(" ")
    };
    match &node.kind {
        Kind::Number(x) => format!("{x:?}"),
        Kind::Flag(flag) => format!("!{flag}"),
        Kind::Text(text) => format!("{text:?}"),
        Kind::Name(name) => name.clone(),
        Kind::List(name, items) => format!("{}[{}]", name.as_deref().unwrap_or(""), all(items)),
        Kind::Fields(name, e) => format!("{}({})", name.as_deref().unwrap_or(""), each(e)),
        Kind::Map(e) => format!("{{{}}}", each(e)),
    }
}

fn read(text: &str) -> String {
    told(&parse(text).unwrap_or_else(|e| panic!("{text}: {e:?}")))
}

#[test]
fn values_of_every_kind() {
    for (text, wanted) in [
        (
            "(a: 1, b: -2.5e-3, c: +.5, d: 1., e: 1_000, f: 0x1F, g: 0b101, h: 0o17)",
            "(a=1.0 b=-0.0025 c=0.5 d=1.0 e=1000.0 f=31.0 g=5.0 h=15.0)",
        ),
        (
            "[inf, -inf, NaN, 3u8, 2.5f64, 18446744073709551616, -0]",
            "[inf -inf NaN 3.0 2.5 1.8446744073709552e19 -0.0]",
        ),
        (
            "[true, false, Fixed, None, Some(Fixed), Some(Some(2))]",
            "[!true !false Fixed None Fixed 2.0]",
        ),
        (
            "{\"a\": A(), \"b\": B(1), \"c\": C (x: (1, 2),), \"d\": (), \"e\": (1)}",
            "{a=A() b=B[1.0] c=C(x=[1.0 2.0]) d=() e=[1.0]}",
        ),
        ("/* a /* b */ */ [ // c\n 1 /**/ , 2 // d\n]//", "[1.0 2.0]"),
        ("\u{feff}#![enable(implicit_some)]\n(é_1: r#a-b, r#in: \u{85} 1)", "(é_1=a-b in=1.0)"),
        ("Model(a: 1)", "(a=1.0)"),
        ("[[], [[1, 2], [3]], (4, 5,)]", "[[] [[1.0 2.0] [3.0]] [4.0 5.0]]"),
    ] {
        assert_eq!(read(text), wanted);
    }
}

#[test]
fn texts_say_what_is_written() {
    for (text, wanted) in [
        (r#""a \"b\" \\ \n\t\r\0\'""#, "a \"b\" \\ \n\t\r\0'"),
        (r#""\u{e9}\x41\xc3\xa9 é""#, "éAé é"),
        ("\"a \\\n   b\"", "a b"),
        ("\"a\nb\"", "a\nb"),
        (r##"r#"a "b" \n"#"##, "a \"b\" \\n"),
        ("r\"\"", ""),
        ("'x'", "x"),
        (r"'\''", "'"),
    ] {
        let Ok(Node { kind: Kind::Text(found), span }) = parse(text) else { panic!("{text}") };
        assert_eq!((found.as_str(), span), (wanted, 0..text.len()));
    }
}

#[test]
fn everything_knows_where_it_stands() {
    let text = "( /* x */ nodes: {\"a b\": [1, 22 ,(3, 4)], r#\"c\"#: A ( p : \"t\" ) }, k: Some( 5 ) ) // end";
    let root = parse(text).unwrap();
    let at = |span: &Span| &text[span.clone()];
    assert_eq!(root.span.end, text.find(" // end").unwrap());
    let Kind::Fields(None, fields) = &root.kind else { panic!() };
    assert_eq!(fields.iter().map(|e| at(&e.key_span)).collect::<Vec<_>>(), ["nodes", "k"]);
    assert_eq!(at(&fields[1].value.span), "5");
    let Kind::Map(all) = &fields[0].value.kind else { panic!() };
    assert_eq!(all.iter().map(|e| at(&e.key_span)).collect::<Vec<_>>(), ["a b", "c"]);
    assert_eq!(at(&all[1].value.span), "A ( p : \"t\" )");
    assert_eq!(at(&all[1].value.name_span()), "A");
    let items: Vec<_> = all[0].value.items().iter().map(|n| at(&n.span)).collect();
    assert_eq!(items, ["1", "22", "(3, 4)"]);
    // Escapes in a key do not hide its place.
    let text = r#"{"a\"b": 1}"#;
    let Kind::Map(all) = parse(text).unwrap().kind else { panic!() };
    assert_eq!((all[0].key.as_str(), &text[all[0].key_span.clone()]), ("a\"b", r#"a\"b"#));
}

#[test]
fn what_is_wrong_is_told_where_it_is() {
    for (text, place, words, help) in [
        ("", "", "a value is wanted here, not the end of the text", ""),
        ("(a: 1", "", "the text ends here, and a `)` is missing", ""),
        ("(a: [1, 2)", ")", "`,` or `]` is wanted here, not `)`", ""),
        ("(a: 1 b: 2)", "b", "`,` or `)` is wanted here, not `b`", ""),
        ("(a: 1\n b: 2)", "a: 1", "`,` is missing behind this", ""),
        ("(a: [\n1\n] // c\n b: 2)", "]", "`,` is missing behind this", ""),
        ("(a: 1\n ])", "]", "`,` or `)` is wanted here, not `]`", ""),
        (
            "(a: 2.5 kN)",
            "kN",
            "`,` or `)` is wanted here, not `kN`",
            "a number with a unit is a text",
        ),
        ("(a: \"1 t),\n b: \"2 t\")", "2", "`,` or `)` is wanted here, not `2`", "may be missing"),
        ("(a: 1, \"b\": 2)", "\"", "the name of a field is wanted here", ""),
        ("(a: 1,, b: 2)", ",", "the name of a field is wanted here, not `,`", ""),
        ("{a: 1}", "a", "a name in quotes is wanted here", ""),
        ("{\"a\" 1}", "1", "`:` is wanted behind \"a\", not `1`", ""),
        ("(a: )", ")", "a value is wanted here, not `)`", ""),
        ("(a: @b)", "@", "a value is wanted here, not `@`", ""),
        ("(a: 1) (b: 2)", "(", "`(` stands behind the end of the value", ""),
        ("(a: 1.2.3)", "1.2.3", "`1.2.3` is no number", ""),
        ("(a: -)", "-", "`-` is no number", ""),
        ("(a: 0xZ)", "Z", "`Z` is no whole number in base 16", ""),
        ("(a: \"b", "\"", "the text that begins here does not end: `\"` is missing", ""),
        ("(a: r#\"b\")", "r#\"", "does not end: `\"#` is missing", ""),
        (r#"(a: "b\c")"#, "\\c", r"`\c` stands for nothing", ""),
        (r#"(a: "\u{110000}")"#, r"\u{", "number of a character", ""),
        (r#"(a: "\x+9")"#, r"\x", "two digits in base 16", ""),
        (r#"(a: "\xc3x")"#, r"\x", "two digits in base 16", ""),
        ("(a: 'bc')", "'", "a text stands between", ""),
        ("(a: 1 / 2)", "/", "`/` begins a comment", ""),
        ("(a: 1 /* b)", "/*", "does not end: `*/` is missing", ""),
        ("(a: Some(1, 2))", "(1, 2)", "`Some(…)` has one value", ""),
        ("# (a: 1)", "#", "begins an attribute", ""),
        ("(a: 1, b: 2, a: 3)", "a", "`a` is given twice", "keep one of the two"),
    ] {
        let error = parse(text).unwrap_err();
        assert!(error.message.contains(words), "{text}: {}", error.message);
        assert_eq!(&text[error.span.clone()], place, "{text}: {}", error.message);
        assert!(error.help.unwrap_or("").contains(help), "{text}: {:?}", error.help);
        let of_places = error.related.iter().all(|(span, _)| text.get(span.clone()).is_some());
        assert!(of_places, "{text}");
    }
}

#[test]
fn a_text_that_may_lack_its_end_is_shown() {
    let text = "(a: 1, b: \"1 t),\n c: \"2 t\")";
    let error = parse(text).unwrap_err();
    let places: Vec<_> = error.related.iter().map(|(span, what)| (span.start, *what)).collect();
    let begin = text.find('"').unwrap();
    assert_eq!(places, [(0, "opened here"), (begin, "the text before it begins here")]);
}

#[test]
fn keys_that_come_again_are_found_among_many() {
    let fields = |n: usize| (0..n).map(|i| format!("\"k{i}\": {i}, ")).collect::<String>();
    for n in [1, 15, 16, 17, 40] {
        for again in [0, n / 2, n - 1] {
            let text = format!("{{{}\"k{again}\": 0}}", fields(n));
            let error = parse(&text).unwrap_err();
            assert_eq!(
                (error.code, error.message),
                ("E0102", format!("`k{again}` is given twice"))
            );
            assert_eq!(&text[error.related[0].0.clone()], format!("k{again}"));
            assert!(error.span.start > error.related[0].0.end);
        }
        assert!(parse(&format!("{{{}}}", fields(n))).is_ok());
    }
}

#[test]
fn brackets_may_be_nested_so_deep() {
    for (open, close) in [("[", "]"), ("(", ")"), ("Some(", ")"), ("{\"a\": ", "}"), ("A(x: ", ")")]
    {
        let nested = |depth: usize| format!("{}1{}", open.repeat(depth), close.repeat(depth));
        assert!(parse(&nested(DEPTH)).is_ok(), "{open}");
        let error = parse(&nested(DEPTH + 1)).unwrap_err();
        assert!(error.message.contains("nested too deeply"), "{open} {}", error.message);
    }
}

/// What `ron` reads, in the same words; it keeps no names.
fn by_ron(value: &ron::Value) -> String {
    let all = |items: &[ron::Value]| items.iter().map(by_ron).collect::<Vec<_>>().join(" ");
    match value {
        ron::Value::Bool(flag) => format!("!{flag}"),
        ron::Value::Char(c) => format!("{:?}", c.to_string()),
        ron::Value::String(text) => format!("{text:?}"),
        ron::Value::Number(n) => format!("{:?}", n.into_f64() + 0.0),
        ron::Value::Option(Some(inner)) => by_ron(inner),
        ron::Value::Option(None) | ron::Value::Unit => "()".into(),
        ron::Value::Bytes(_) => "bytes".into(),
        ron::Value::Seq(items) if items.is_empty() => "()".into(),
        ron::Value::Seq(items) => format!("[{}]", all(items)),
        ron::Value::Map(map) => {
            let mut each: Vec<String> =
                map.iter().map(|(k, v)| format!("{}={}", by_ron(k), by_ron(v))).collect();
            each.sort();
            format!("{{{}}}", each.join(" "))
        }
    }
}

/// What was read here, as far as `ron` keeps it.
fn as_ron(node: &Node) -> String {
    match &node.kind {
        // A zero has no sign there.
        Kind::Number(x) => format!("{:?}", x + 0.0),
        Kind::Name(_) => "()".into(),
        Kind::List(_, items) if items.is_empty() => "()".into(),
        Kind::List(_, items) => {
            format!("[{}]", items.iter().map(as_ron).collect::<Vec<_>>().join(" "))
        }
        Kind::Fields(_, entries) if entries.is_empty() => "()".into(),
        Kind::Fields(_, entries) | Kind::Map(entries) => {
            let one = |e: &Entry| format!("{:?}={}", e.key, as_ron(&e.value));
            let mut each: Vec<String> = entries.iter().map(one).collect();
            each.sort();
            format!("{{{}}}", each.join(" "))
        }
        _ => told(node),
    }
}

/// Shipped models and studies, small ones, and a text with something of everything.
fn texts() -> Vec<String> {
    let models = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models");
    let folders = [models.to_owned(), format!("{models}/studies")];
    let files = folders.iter().flat_map(|f| std::fs::read_dir(f).unwrap());
    let mut paths: Vec<_> = files.map(|file| file.unwrap().path()).collect();
    paths.sort();
    let rons = paths.iter().filter(|path| path.extension().is_some_and(|e| e == "ron"));
    let mut all: Vec<String> = rons.map(|path| std::fs::read_to_string(path).unwrap()).collect();
    assert!(all.len() > 15);
    all.push(
        r##"(a: 1_000, b: [0x1F, -2.5e-3, .5, 1., +4, 1.5f64, inf, -0], c: "a\n\u{e9}\x41 \"q\"", d: r#"raw "x""#, e: 'c',
        f: Some(3), g: None, h: {"k": (), "l\"m": Foo}, i: Foo(1), j: Bar(a: 1, /* c /* d */ */ b: [ ]), k: (1), // end
        l: ("x",), m: "line \
            on", n: Some(Some("x")), o: Foo ( ), p: true)"##
            .into(),
    );
    all
}

/// `ron` is another reader of the same language, and shares nothing with this one.
#[test]
fn texts_mean_what_the_crate_for_the_language_reads() {
    use ron::extensions::Extensions as E;
    let options =
        ron::Options::default().with_default_extension(E::IMPLICIT_SOME | E::UNWRAP_NEWTYPES);
    let ron = |text: &str| options.from_str::<ron::Value>(text).map(|v| by_ron(&v));
    let texts = texts();
    for text in &texts {
        assert_eq!(as_ron(&parse(text).unwrap()), ron(text).unwrap());
    }
    let pieces = [
        "(",
        ")",
        "[",
        "]",
        "{",
        "}",
        ",",
        ":",
        "\"",
        "'",
        "/*",
        "*/",
        "//",
        "\n",
        " ",
        "Some(",
        "true",
        "r\"",
        "\\",
        "\\n",
        "\\u{41}",
        "1",
        "-",
        ".",
        "e5",
        "_",
        "a",
        "0x",
        "é",
        "Foo",
        "()",
        "[]",
        "Foo(1)",
        "a: 1,",
        "\"k\": 2,",
    ];
    let mut rng = ChaCha12Rng::seed_from_u64(1);
    let mut below = |n: usize| (rng.next_u64() % n as u64) as usize;
    let (mut alike, mut refused) = (0, 0);
    for turn in 0..30_000 {
        // Most texts are long, and most of what is put into them is in a text or a comment: the short one is asked most.
        let from = if turn % 3 == 0 { below(texts.len()) } else { texts.len() - 1 };
        let mut text = texts[from].clone();
        for _ in 0..=below(2) {
            let at = |i: usize| (0..=i.min(text.len())).rev().find(|i| text.is_char_boundary(*i));
            let start = at(below(text.len() + 1)).unwrap_or(0);
            let end = at(start + below(5)).unwrap_or(0).max(start);
            let piece = if below(3) == 0 { "" } else { pieces[below(pieces.len())] };
            text.replace_range(start..end, piece);
        }
        match (parse(&text), ron(&text)) {
            (Ok(own), Ok(theirs)) => {
                assert_eq!(as_ron(&own), theirs, "{text}");
                alike += 1;
            }
            (Err(_), Err(_)) => refused += 1,
            (Err(error), Ok(theirs)) => {
                // Of two entries with one key `ron` takes one; ranges, bytes and keys without quotes have no use here.
                let known = error.code == "E0102"
                    || ["no number", "in quotes is wanted"]
                        .iter()
                        .any(|w| error.message.contains(w));
                assert!(known, "{}\n{theirs}\n{text}", error.message);
            }
            // Numbers of some bits may be larger here, and what only may have a value may have none.
            (Ok(own), Err(_)) => {
                let words = told(&own);
                assert!(words.contains("Some") || words.contains("None"), "{text}\n{words}");
            }
        }
    }
    assert!(alike > 5_000 && refused > 5_000, "{alike} {refused}");
}

use super::*;

/// The names of the blocks around the cursor `|`, and the keys that lead to them: `nodes{` or `"a":Spring(`.
fn around(marked: &str) -> String {
    let at = marked.find('|').expect("a cursor");
    let text = marked.replacen('|', "", 1);
    let tree = Tree::new(&text);
    let mut told = Vec::new();
    for b in tree.path(tree.around(at)).into_iter().skip(1) {
        let block = &tree.blocks[b];
        let (parent, entry) = block.parent;
        let key = tree.blocks[parent].entries[entry].key_text(&text);
        let name = block.name.clone().map_or("", |span| &text[span]);
        let bracket = match block.bracket {
            Bracket::None => ' ',
            Bracket::Round => '(',
            Bracket::Square => '[',
            Bracket::Curly => '{',
        };
        told.push(format!("{}{name}{bracket}", key.map_or(String::new(), |k| format!("{k}:"))));
    }
    if tree.in_comment(at) {
        told.push("comment".into());
    }
    told.join(" ")
}

#[test]
fn blocks_around_the_cursor_are_found_in_whole_texts() {
    for (text, found) in [
        ("|(a: 1)", ""),
        ("(|a: 1)", "("),
        ("(a: 1)|", ""),
        ("(nodes: { \"a\": (0, |0, 0) })", "( nodes:{ a:("),
        ("(elements: { \"a\": Spring(node: \"x\", |) })", "( elements:{ a:Spring("),
        ("(elements: { \"a\": Spring (|) })", "( elements:{ a:Spring("),
        ("(elements: { \"a\": Spring|() })", "( elements:{"),
        (
            "(cases: { \"a\": Static(loads: [Gravity, (load: |)]) })",
            "( cases:{ a:Static( loads:[ (",
        ),
        ("#![enable(implicit_some)]\n(title: \"(\", nodes: {|})", "( nodes:{"),
        ("\u{feff}(a: (|))", "( a:("),
    ] {
        assert_eq!(around(text), found, "{text}");
    }
}

#[test]
fn texts_and_comments_hide_their_brackets() {
    for (text, found) in [
        ("(a: \")\", b: (|))", "( b:("),
        ("(a: \"\\\")\", b: (|))", "( b:("),
        ("(a: r#\"\")\"#, b: (|))", "( b:("),
        ("(a: r\"\\\", b: (|))", "( b:("),
        ("(// )\n b: (|))", "( b:("),
        ("(/* ) /* ) */ ) */ b: (|))", "( b:("),
        ("(a: 1, // b|\n)", "( comment"),
        ("(a: 1, // b\n|)", "("),
        ("(a: 1, /* b| */)", "( comment"),
        ("(a: 1, /* b */|)", "("),
        ("(a: \"fuß 🦶 (\", b: [|])", "( b:["),
    ] {
        assert_eq!(around(text), found, "{text}");
    }
}

#[test]
fn what_is_not_closed_yet_is_no_harm() {
    for (text, found) in [
        ("(elements: { \"a\": Spring(|", "( elements:{ a:Spring("),
        ("(elements: { \"a\": Spring(node: \"x|", "( elements:{ a:Spring("),
        // The next entry of the map, the next section, brackets that close what is around.
        ("(elements: { \"a\": Spring(|\n\"b\": Gap(node: \"x\") })", "( elements:{ a:Spring("),
        ("(elements: { \"a\": Spring(\n\"b\": Gap(|node: \"x\") })", "( elements:{ b:Gap("),
        (
            "(elements: { \"a\": Spring(node: \"x\"\n}, cases: { \"c\": Static(|) })",
            "( cases:{ c:Static(",
        ),
        (
            "(elements: { \"a\": Spring(node: \"x\",\n cases: { \"c\": Static(|) } } )",
            "( elements:{ a:Spring( cases:{ c:Static(",
        ),
        ("(nodes: { \"a\": (0, 0, 0), elements: { |", "( elements:{"),
        // Quotes that do not end, end with their line.
        ("(nodes: { \"a: (0, 0, 0),\n\"b\": (|", "( nodes:{ b:("),
        ("(a: \"x,\n b: (|), c: 1)", "( b:("),
        // Too much closed.
        ("(a: 1)) ] } , (b: (|))", "( b:("),
        // Commas that are missing.
        ("(a: (1) b: (|))", "( b:("),
        ("(a: 1 b: (|))", "( b:("),
    ] {
        assert_eq!(around(text), found, "{text}");
    }
}

#[test]
fn entries_have_keys_and_values() {
    let text = "(a: \"x y\", \"k\": B(1), c, d: )";
    let tree = Tree::new(text);
    let block = &tree.blocks[1];
    let keys: Vec<_> = block.entries.iter().map(|e| e.key_text(text)).collect();
    assert_eq!(keys, [Some("a"), Some("k"), None, Some("d")]);
    assert!(
        matches!(&block.entries[0].value, Some(Value::Text(s, true)) if &text[s.clone()] == "x y")
    );
    assert!(matches!(block.entries[1].value, Some(Value::Block(_))));
    assert!(matches!(&block.entries[2].value, Some(Value::Word(s)) if &text[s.clone()] == "c"));
    assert!(block.entries[3].value.is_none());
}

#[test]
fn any_text_is_taken_apart() {
    let texts = [
        "(".repeat(300_000),
        "([{".repeat(100_000) + &")".repeat(300_000),
        "[".to_owned() + &"(".repeat(300_000) + &"}".repeat(300_000),
        "\"".repeat(300_001),
        "\"a\": (".repeat(100_000),
        "{".to_owned() + &"(\"a\": ".repeat(100_000),
        "r#\"".repeat(100_000),
        "/*".repeat(300_000),
        "a:".repeat(300_000),
        "🦶ß:\"(".repeat(50_000),
    ];
    for text in texts {
        let tree = Tree::new(&text);
        for at in (0..=text.len()).step_by(9973).filter(|at| text.is_char_boundary(*at)) {
            tree.in_comment(at);
            assert!(tree.path(tree.around(at)).len() <= tree.blocks.len());
        }
    }
}

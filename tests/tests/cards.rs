//! The example of every card is a line that a model file can hold.

use trilith_element::{Card, Category};
use trilith_model::{Registry, read_text};
use trilith_system::System;

fn registry() -> Registry {
    let mut registry = Registry::new();
    trilith_elements::register(&mut registry);
    trilith_thirdparty_example::register(&mut registry);
    registry
}

/// The texts in quotes that an example gives as nodes.
fn nodes_of(example: &str) -> Vec<&str> {
    let start = example.find("node").expect("an example names its nodes");
    let one = example[start..].starts_with("node:");
    let end = example[start..].find(if one { ',' } else { ')' });
    let list = &example[start..end.map_or(example.len(), |e| start + e)];
    list.split('"').skip(1).step_by(2).collect()
}

/// A model with the example, its nodes at different places on springs.
fn around(card: &Card) -> String {
    let nodes = nodes_of(card.example);
    let vertical = card.kind == "Diaphragm";
    let place = |i: usize| match i {
        _ if vertical => format!("({i}, {}, 3)", i * i),
        0 => "(0, 0, 0)".to_owned(),
        1 => "(3, 0, 0)".to_owned(),
        i => format!("({i}, 1, {i})"),
    };
    let entries: Vec<_> =
        nodes.iter().enumerate().map(|(i, n)| format!("\"{n}\": {}", place(i))).collect();
    let springs: Vec<_> = nodes
        .iter()
        .map(|n| {
            format!(
                "\"ground {n}\": Spring(node: \"{n}\", k1: 1, k2: 1, k3: 1, r1: 1, r2: 1, r3: 1)"
            )
        })
        .collect();
    format!(
        "(nodes: {{ {} }}, elements: {{ {}, {} }}, cases: {{ \"rest\": Static(loads: [Gravity]) }})",
        entries.join(", "),
        card.example,
        springs.join(", "),
    )
}

#[test]
fn the_example_of_every_card_is_read_and_assembled() {
    let registry = registry();
    let mut kinds = Vec::new();
    for card in registry.cards() {
        let text = around(card);
        let model = read_text(&text, "example.ron", &registry, &[]).unwrap_or_else(|all| {
            let told: Vec<_> = all.iter().map(ToString::to_string).collect();
            panic!("{}: {}\n{text}", card.kind, told.join("\n"))
        });
        assert_eq!(model.elements[0].kind, card.kind, "the example shows its own kind");
        let system = System::new(&model).unwrap_or_else(|e| panic!("{}: {e}", card.kind));
        let links = usize::from(card.category == Category::Link);
        assert_eq!(system.links.links.len(), links, "{}", card.kind);
        system.check_supported(&model, false).unwrap_or_else(|e| panic!("{}: {e}", card.kind));
        kinds.push(card.kind);
    }
    assert!(kinds.contains(&"NLink") && kinds.contains(&"CubicSpring"), "{kinds:?}");
}

#[test]
fn a_kind_of_a_third_party_is_read_beside_the_built_in_ones() {
    let registry = registry();
    let kinds: Vec<_> = registry.cards().map(|c| c.kind).collect();
    assert_eq!(kinds.last(), Some(&"CubicSpring"));
    assert!(registry.duplicates().is_empty());
}

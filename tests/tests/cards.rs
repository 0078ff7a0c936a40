//! The example of every card is a line that a model file can hold.

use trilith_element::conformance::{ConstraintKit, ElementKit, StructureError};
use trilith_element::{Card, Category};
use trilith_model::{Body, read_text};
use trilith_system::System;
use trilith_tests::registry;

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
    for card in registry.elements() {
        let text = around(card);
        let model = read_text(&text, "example.ron", &registry, &[]).unwrap_or_else(|all| {
            let told: Vec<_> = all.iter().map(ToString::to_string).collect();
            panic!("{}: {}\n{text}", card.kind, told.join("\n"))
        });
        assert_eq!(model.elements[0].kind, card.kind, "the example shows its own kind");
        let system =
            System::without_axial_forces(&model).unwrap_or_else(|e| panic!("{}: {e}", card.kind));
        let links = usize::from(card.category == Category::Link);
        assert_eq!(system.links.links.len(), links, "{}", card.kind);
        system.check_supported(&model, false).unwrap_or_else(|e| panic!("{}: {e}", card.kind));
        kinds.push(card.kind);
    }
    assert!(kinds.contains(&"NLink") && kinds.contains(&"TensionBracing"), "{kinds:?}");
    assert!(registry.duplicates().is_empty());
}

/// Members between two nodes that are as stiff in two pieces as in one.
const MEMBERS: [&str; 2] = ["Beam", "Truss"];
/// Elements with parameters in global axes.
const GLOBAL: [&str; 1] = ["Mass"];
/// Constraints that are about directions, wherever their nodes are.
const DIRECTIONS: [&str; 1] = ["EqualDof"];
/// Constraints whose forces are in equilibrium only with what is no part of the model.
const GROUNDED: [&str; 1] = ["Gearing"];

#[test]
fn every_linear_element_and_every_constraint_conforms() {
    let registry = registry();
    let mut examined = Vec::new();
    for card in registry.elements().filter(|card| card.category != Category::Link) {
        let kind = card.kind;
        let model = read_text(&around(card), "example.ron", &registry, &[]).expect("an example");
        let element = &model.elements[0];
        let nodes: Vec<_> = element.nodes.iter().map(|n| model.nodes[*n].position).collect();
        let found = match &element.body {
            Body::Linear(law) => {
                let mut kit = ElementKit::new(&nodes).axes(element.axes[0], element.axes[1]);
                if MEMBERS.contains(&kind) {
                    kit = kit.divisible();
                }
                if GLOBAL.contains(&kind) {
                    kit = kit.in_global_axes();
                }
                kit.check(law.as_ref())
            }
            Body::Constraint(law) => {
                let mut kit = ConstraintKit::new(&nodes);
                if DIRECTIONS.contains(&kind) {
                    kit = kit.only_translations();
                }
                let found = kit.check(law.as_ref());
                if GROUNDED.contains(&kind) {
                    assert!(
                        matches!(found, Err(StructureError::Rigid { .. })),
                        "{kind}: {found:?}"
                    );
                    continue;
                }
                found
            }
            Body::Link(..) => continue,
        };
        assert_eq!(found, Ok(()), "{kind}");
        examined.push(kind);
    }
    for kind in MEMBERS.iter().chain(&GLOBAL).chain(&DIRECTIONS).chain(&["Spring", "RigidBody"]) {
        assert!(examined.contains(kind), "{kind} in {examined:?}");
    }
}

#[test]
fn the_committed_catalogue_is_that_of_the_cards() {
    let made = trilith::catalogue::markdown(&trilith::registry());
    let path = trilith_tests::root().join("elements/CATALOGUE.md");
    let committed = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        made == committed,
        "elements/CATALOGUE.md is stale: run `cargo run --release -- elements --page elements/CATALOGUE.md`"
    );
}

#[test]
fn every_link_has_an_exercise_that_moves_it_and_balances() {
    let registry = registry();
    for card in registry.cards().filter(|c| c.category == Category::Link) {
        let kind = card.kind;
        let specimen = trilith::exercise::Specimen::new(&registry, kind, &[])
            .unwrap_or_else(|e| panic!("{kind}: {e}"));
        let motion = specimen.motion().unwrap_or_else(|e| panic!("{kind}: {e}"));
        let record = specimen.exercise(&motion).unwrap_or_else(|e| panic!("{kind}: {e}"));
        assert!(!record.figures().is_empty(), "{kind}: nothing moves");
        assert!(record.energy_error() < 2e-3, "{kind}: {:.1e}", record.energy_error());
    }
}

#[test]
fn the_page_of_the_catalogue_holds_every_kind_and_a_loop_of_every_link() {
    let registry = registry();
    let page = trilith::catalogue::html(&registry);
    for card in registry.cards() {
        assert!(page.contains(&format!("<section id=\"{}\">", card.kind)), "{}", card.kind);
    }
    let links = registry.cards().filter(|c| c.category == Category::Link).count();
    assert!(page.matches("<svg").count() >= links, "{links} links");
    let undrawn = page.find("Not drawn").map(|at| &page[at..(at + 200).min(page.len())]);
    assert_eq!(undrawn, None);
}

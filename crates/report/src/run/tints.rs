//! Which histories and loops tell a colour of the model: of nodes, members or links.

use super::data::{Loop, Picture, Tint, Tinted};
use super::places;
use std::collections::BTreeMap;
use trilith_model::{Model, Quantity};

/// Indices of the marks of a picture by the node or element that they stand for.
#[derive(Debug, Default)]
pub(super) struct Marks {
    pub nodes: BTreeMap<usize, usize>,
    pub lines: BTreeMap<usize, usize>,
    pub links: BTreeMap<usize, usize>,
    pub faces: BTreeMap<usize, Vec<usize>>,
}

/// Quantities by which parts of the picture can be coloured: of histories whose kind is that of one place, and forces of
/// loops. `shown` are the indices of the outputs that have a figure.
pub(super) fn tints(
    model: &Model,
    marks: &Marks,
    picture: &Picture,
    shown: impl Iterator<Item = usize>,
    loops: &[Loop],
) -> Vec<Tint> {
    let mut all: Vec<Tint> = Vec::new();
    for output in shown.filter_map(|i| model.outputs.get(i)) {
        let quantity = places::kind(model, output);
        if quantity.is_empty() {
            continue;
        }
        let figure = output.name.clone();
        let mut tinted = Tinted { figure, ..Tinted::default() };
        match &output.quantity {
            // Displacements are those of the deformed shapes.
            Quantity::Velocity(terms) | Quantity::Acceleration { terms, .. } => {
                tinted.nodes = found(&marks.nodes, terms.iter().map(|t| t.node));
            }
            Quantity::LinkDeformation { element, .. } | Quantity::LinkHistory { element, .. } => {
                tinted.links = found(&marks.links, std::iter::once(*element));
            }
            Quantity::LinkForce(terms) => {
                tinted.links = found(&marks.links, terms.iter().map(|t| t.element));
            }
            Quantity::ElementForce { elements, .. } => {
                tinted.lines = found(&marks.lines, elements.iter().copied());
            }
            _ => {}
        }
        add(&mut all, quantity, tinted);
    }
    for l in loops {
        let quantity = format!("{} {} force", l.kind, l.coordinate);
        let links = picture.links.iter().position(|m| m.name == l.link).into_iter().collect();
        let figure = format!("{} {}", l.link, l.coordinate);
        let already =
            all.iter().any(|t| t.quantity == quantity && t.of.iter().any(|o| o.links == links));
        if !already {
            add(&mut all, quantity, Tinted { figure, links, ..Tinted::default() });
        }
    }
    all
}

/// Adds what has a part to colour to the other values of its quantity.
fn add(all: &mut Vec<Tint>, quantity: String, tinted: Tinted) {
    if tinted.nodes.is_empty() && tinted.lines.is_empty() && tinted.links.is_empty() {
        return;
    }
    match all.iter_mut().find(|t| t.quantity == quantity) {
        Some(t) => t.of.push(tinted),
        None => all.push(Tint { quantity, of: vec![tinted] }),
    }
}

fn found(marks: &BTreeMap<usize, usize>, wanted: impl Iterator<Item = usize>) -> Vec<usize> {
    wanted.filter_map(|i| marks.get(&i).copied()).collect()
}

//! Load patterns of a resolved model.

use super::text;
use crate::{MemberLoad, Model, Pattern};
use trilith_element::{Axis, SpanLoad};

pub(super) fn pattern(model: &Model, p: &Pattern) -> String {
    let forces = p.forces.iter().map(|f| {
        let key = if f.dof.is_rotation() { "moment" } else { "force" };
        let node = text(&model.nodes[f.node].name);
        format!("(node: {node}, dof: {}, {key}: {:?})", f.dof.name(), f.value)
    });
    let along = p.members.iter().flat_map(|load| along(model, load));
    format!("[{}]", forces.chain(along).collect::<Vec<_>>().join(", "))
}

/// A load along a member, axis by axis.
fn along(model: &Model, load: &MemberLoad) -> Vec<String> {
    let element = text(&model.elements[load.element].name);
    let axes = |loads: &[[f64; 6]]| -> Vec<Axis> {
        let acts = |a: &Axis| loads.iter().any(|l| l[a.index()] != 0.0);
        let all: Vec<Axis> = Axis::ALL.into_iter().filter(acts).collect();
        // A load of nothing stays one.
        if all.is_empty() { vec![Axis::U1] } else { all }
    };
    match &load.load {
        SpanLoad::Spread { from, to, start, end } => axes(&[*start, *end])
            .into_iter()
            .map(|a| {
                let [x, y] = [start, end].map(|l| l[a.index()]);
                format!(
                    "Trapezoid(element: {element}, axis: {}, points: [({from:?}, {x:?}), ({to:?}, {y:?})])",
                    a.name()
                )
            })
            .collect(),
        SpanLoad::Point { at, load } => axes(&[*load])
            .into_iter()
            .map(|a| {
                let key = if a.index() > 2 { "moment" } else { "force" };
                let x = load[a.index()];
                format!("Point(element: {element}, at: {at:?}, axis: {}, {key}: {x:?})", a.name())
            })
            .collect(),
        SpanLoad::Warmth { rise, gradients: [a, b] } => vec![format!(
            "Temperature(element: {element}, rise: {rise:?}, gradient_2: {a:?}, gradient_3: {b:?})"
        )],
    }
}

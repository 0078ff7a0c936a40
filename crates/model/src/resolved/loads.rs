//! Load patterns of a resolved model.

use super::{BlockText, list};
use crate::schema;
use crate::{MemberLoad, Model, Pattern};
use trilith_element::{Axis, SpanLoad};

pub(super) fn pattern(model: &Model, p: &Pattern) -> String {
    let forces = p.forces.iter().map(|f| {
        let key = if f.dof.is_rotation() { "moment" } else { "force" };
        let text = BlockText::new(&schema::FORCE).named("node", &model.nodes[f.node].name);
        text.choice("dof", f.dof.name()).number(key, f.value).end()
    });
    list(forces.chain(p.members.iter().flat_map(|load| along(model, load))))
}

/// A load along a member, axis by axis.
fn along(model: &Model, load: &MemberLoad) -> Vec<String> {
    let begin = |block| {
        let element = &model.elements[load.element].name;
        BlockText::new(block).named("element", element)
    };
    let axes = |loads: &[[f64; 6]]| -> Vec<Axis> {
        let acts = |a: &Axis| loads.iter().any(|l| l[a.index()] != 0.0);
        let all: Vec<Axis> = Axis::ALL.into_iter().filter(acts).collect();
        // A load of nothing stays one.
        if all.is_empty() { vec![Axis::U1] } else { all }
    };
    let text = match &load.load {
        SpanLoad::Spread { from, to, start, end } => {
            let one = |a: Axis| {
                let ends = [(from, start), (to, end)];
                let points = ends.map(|(at, l)| format!("({at:?}, {:?})", l[a.index()]));
                let text = begin(&schema::TRAPEZOID).choice("axis", a.name());
                text.list("points", points.into_iter()).flag("projected", false).end()
            };
            return axes(&[*start, *end]).into_iter().map(one).collect();
        }
        SpanLoad::Point { at, load } => {
            let one = |a: Axis| {
                let key = if a.index() > 2 { "moment" } else { "force" };
                let text = begin(&schema::POINT).value("at", format!("{at:?}"));
                text.choice("axis", a.name()).number(key, load[a.index()]).end()
            };
            return axes(&[*load]).into_iter().map(one).collect();
        }
        SpanLoad::Warmth { rise, gradients: [a, b] } => {
            let text = begin(&schema::TEMPERATURE).number("rise", *rise);
            text.number("gradient_2", *a).number("gradient_3", *b)
        }
    };
    vec![text.end()]
}

//! Outputs of a resolved model.

use super::{BlockText, list, text, vector};
use crate::read::nodal_dimension;
use crate::schema;
use crate::units;
use crate::{Body, Combine, Envelope, LinkTerm, Model, NodalTerm, Output, Quantity};
use trilith_element::dimension::{FORCE, LENGTH, MOMENT, NONE};
use trilith_element::{Coordinates, Dimension};

pub(super) fn output(model: &Model, o: &Output) -> String {
    quantity(model, o).flag("hidden", o.hidden).end()
}

fn quantity(model: &Model, o: &Output) -> BlockText {
    // The unit of an output is that of factor times quantity: it tells the unit of the factor.
    let total = units::dimension(&o.unit).unwrap_or(NONE);
    let nodal = |block, terms: &[NodalTerm], order: usize| {
        let one = |t: &NodalTerm| {
            let own = nodal_dimension(order, t.dof.is_rotation());
            let term = BlockText::new(schema::TERM.blocks[0]);
            let term = term.named("node", &model.nodes[t.node].name);
            term.choice("dof", t.dof.name()).quantity("factor", t.factor, total / own).end()
        };
        BlockText::new(block).list("terms", terms.iter().map(one))
    };
    let names = |all: &mut dyn Iterator<Item = usize>| {
        let all: Vec<String> = all.map(|i| text(&model.elements[i].name)).collect();
        if let [one] = &all[..] { one.clone() } else { list(all.into_iter()) }
    };
    let factor =
        |text: BlockText, by: f64, own: Dimension| text.quantity("factor", by, total / own);
    let link = |block, all: &[LinkTerm], force: bool| {
        let LinkTerm { element, coordinate, factor: by } = all[0];
        let text = BlockText::new(block).value("link", names(&mut all.iter().map(|t| t.element)));
        let (text, rotation) = place(model, element, coordinate, text);
        factor(text, by, own(force, rotation))
    };
    match &o.quantity {
        // All terms have their factors.
        Quantity::Displacement(all) => nodal(&schema::DISPLACEMENT, all, 0).without("factor"),
        Quantity::Velocity(all) => nodal(&schema::VELOCITY, all, 1).without("factor"),
        Quantity::Acceleration { terms: all, absolute } => {
            let text = nodal(&schema::ACCELERATION, all, 2).without("factor");
            text.flag("absolute", *absolute)
        }
        Quantity::LinkDeformation { element, coordinate, factor } => {
            let (element, coordinate, factor) = (*element, *coordinate, *factor);
            let term = LinkTerm { element, coordinate, factor };
            link(&schema::LINK_DEFORMATION, &[term], false)
        }
        Quantity::LinkForce(terms) => link(&schema::LINK_FORCE, terms, true),
        Quantity::LinkHistory { element, field } => {
            let e = &model.elements[*element];
            let variable = match &e.body {
                Body::Link(law, _) => law.history().get(*field).map(|f| f.name.clone()),
                _ => None,
            }
            .unwrap_or_default();
            let text = BlockText::new(&schema::LINK_HISTORY).named("link", &e.name);
            text.named("variable", &variable)
        }
        Quantity::ElementForce { elements, end, dof, factor: by } => {
            let name = names(&mut elements.iter().copied());
            let text = BlockText::new(&schema::ELEMENT_FORCE).value("element", name);
            let text = text.count("end", *end).choice("dof", dof.name());
            factor(text, *by, own(true, dof.is_rotation()))
        }
        Quantity::MemberForce { element, force, at, factor: by } => {
            let text = BlockText::new(&schema::MEMBER_FORCE);
            let text = text.named("element", &model.elements[*element].name);
            let text = text.choice("force", force.name()).value("at", format!("{at:?}"));
            factor(text, *by, own(true, force.is_moment()))
        }
        Quantity::BaseShear { direction } => {
            let direction = schema::BASE_DIRECTIONS[direction.index()];
            BlockText::new(&schema::BASE_SHEAR).choice("direction", direction)
        }
        Quantity::Overturning { direction, about } => {
            let direction = schema::BASE_DIRECTIONS[direction.index()];
            let text = BlockText::new(&schema::OVERTURNING).choice("direction", direction);
            text.value("about", vector(*about))
        }
        Quantity::Reaction { nodes, dof, factor: by } => {
            let nodes = nodes.iter().map(|i| super::text(&model.nodes[*i].name));
            let text = BlockText::new(&schema::REACTION).list("node", nodes);
            factor(text.choice("dof", dof.name()), *by, own(true, dof.is_rotation()))
        }
        Quantity::Combination { how, constant, terms } => {
            let one = |(i, by): &(usize, f64)| {
                let other = &model.outputs[*i];
                let part = BlockText::new(schema::PARTS.blocks[0]).named("output", &other.name);
                factor(part, *by, units::dimension(&other.unit).unwrap_or(NONE)).end()
            };
            let (block, constant) = match how {
                Combine::Sum => (&schema::SUM, Some(*constant)),
                Combine::Norm => (&schema::NORM, None),
                Combine::Largest => (&schema::LARGEST, None),
                Combine::Smallest => (&schema::SMALLEST, None),
            };
            let text = BlockText::new(block).list("terms", terms.iter().map(one));
            match constant {
                Some(constant) => text.quantity("constant", constant, total),
                None => text,
            }
        }
        Quantity::Derived(derived) => {
            let of = derived.of.iter().map(|i| super::text(&model.outputs[*i].name));
            let text = BlockText::of_kind(derived.card.kind).with(&schema::DERIVED);
            text.list("of", of).values(&derived.values)
        }
    }
}

pub(super) fn envelope(model: &Model, e: &Envelope) -> String {
    let text = BlockText::new(schema::ENVELOPES.blocks[0]);
    let all = e.members.iter().map(|m| super::text(&model.elements[m.element].name));
    let text = text.list("element", all);
    let Some(first) = e.members.first() else { return text.count("stations", 2).end() };
    let text = text.count("stations", first.stations.len());
    // Members of one envelope may lie in the plane differently.
    match e.members.iter().all(|m| m.forces == first.forces) {
        true => text.list("forces", first.forces.iter().map(|f| f.name().into())).end(),
        false => text.end(),
    }
}

fn own(force: bool, rotation: bool) -> Dimension {
    match (force, rotation) {
        (true, false) => FORCE,
        (true, true) => MOMENT,
        (false, false) => LENGTH,
        (false, true) => NONE,
    }
}

/// The coordinate of a link as the file names it, and whether it is a rotation.
fn place(model: &Model, element: usize, coordinate: usize, text: BlockText) -> (BlockText, bool) {
    if let Body::Link(law, _) = &model.elements[element].body
        && let Coordinates::Local(axes) = law.coordinates()
    {
        let axis = axes[coordinate];
        return (text.choice("axis", axis.name()), axis.index() > 2);
    }
    (text.count("coordinate", coordinate), coordinate % 6 > 2)
}

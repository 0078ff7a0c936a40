//! Outputs of a resolved model.

use super::{custom, factor, text, vector};
use crate::read::nodal_dimension;
use crate::schema::BASE_DIRECTIONS;
use crate::units;
use crate::{Body, Combine, Envelope, LinkTerm, Model, NodalTerm, Output, Quantity};
use trilith_element::dimension::{FORCE, LENGTH, MOMENT, NONE};
use trilith_element::{Coordinates, Dimension};

pub(super) fn output(model: &Model, o: &Output) -> String {
    let mut text = quantity(model, o);
    if o.hidden {
        // Every kind has fields.
        text.truncate(text.len() - 1);
        text += ", hidden: true)";
    }
    text
}

fn quantity(model: &Model, o: &Output) -> String {
    // The unit of an output is that of factor times quantity: it tells the unit of the factor.
    let total = units::dimension(&o.unit).unwrap_or(NONE);
    let terms = |terms: &[NodalTerm], order: usize| {
        let one = |t: &NodalTerm| {
            let own = nodal_dimension(order, t.dof.is_rotation());
            let node = text(&model.nodes[t.node].name);
            let by = factor(t.factor, total / own);
            format!("(node: {node}, dof: {}, factor: {by})", t.dof.name())
        };
        format!("terms: [{}]", terms.iter().map(one).collect::<Vec<_>>().join(", "))
    };
    let names = |all: &mut dyn Iterator<Item = usize>| {
        let all: Vec<String> = all.map(|i| text(&model.elements[i].name)).collect();
        if let [one] = &all[..] { one.clone() } else { format!("[{}]", all.join(", ")) }
    };
    let link = |all: &[LinkTerm], force: bool| {
        let LinkTerm { element, coordinate, factor: by } = all[0];
        let (place, rotation) = place(model, element, coordinate);
        let own = own(force, rotation);
        let names = names(&mut all.iter().map(|t| t.element));
        format!("link: {names}, {place}, factor: {}", factor(by, total / own))
    };
    match &o.quantity {
        Quantity::Displacement(all) => format!("Displacement({})", terms(all, 0)),
        Quantity::Velocity(all) => format!("Velocity({})", terms(all, 1)),
        Quantity::Acceleration { terms: all, absolute } => {
            format!("Acceleration({}, absolute: {absolute})", terms(all, 2))
        }
        Quantity::LinkDeformation { element, coordinate, factor } => {
            let (element, coordinate, factor) = (*element, *coordinate, *factor);
            let term = LinkTerm { element, coordinate, factor };
            format!("LinkDeformation({})", link(&[term], false))
        }
        Quantity::LinkForce(terms) => format!("LinkForce({})", link(terms, true)),
        Quantity::LinkHistory { element, field } => {
            let e = &model.elements[*element];
            let variable = match &e.body {
                Body::Link(law, _) => law.history().get(*field).map(|f| f.name.clone()),
                _ => None,
            }
            .unwrap_or_default();
            format!("LinkHistory(link: {}, variable: {})", text(&e.name), text(&variable))
        }
        Quantity::ElementForce { elements, end, dof, factor: by } => {
            let own = own(true, dof.is_rotation());
            let name = names(&mut elements.iter().copied());
            let by = factor(*by, total / own);
            format!("ElementForce(element: {name}, end: {end}, dof: {}, factor: {by})", dof.name())
        }
        Quantity::MemberForce { element, force, at, factor: by } => {
            let by = factor(*by, total / own(true, force.is_moment()));
            let name = text(&model.elements[*element].name);
            format!(
                "MemberForce(element: {name}, force: {}, at: {at:?}, factor: {by})",
                force.name()
            )
        }
        Quantity::BaseShear { direction } => {
            format!("BaseShear(direction: {})", BASE_DIRECTIONS[direction.index()])
        }
        Quantity::Overturning { direction, about } => {
            let (direction, about) = (BASE_DIRECTIONS[direction.index()], vector(*about));
            format!("Overturning(direction: {direction}, about: {about})")
        }
        Quantity::Reaction { nodes, dof, factor: by } => {
            let by = factor(*by, total / own(true, dof.is_rotation()));
            let all = nodes.iter().map(|i| text(&model.nodes[*i].name));
            let all = all.collect::<Vec<_>>().join(", ");
            format!("Reaction(node: [{all}], dof: {}, factor: {by})", dof.name())
        }
        Quantity::Combination { how, constant, terms } => {
            let one = |(i, by): &(usize, f64)| {
                let other = &model.outputs[*i];
                let own = units::dimension(&other.unit).unwrap_or(NONE);
                format!("(output: {}, factor: {})", text(&other.name), factor(*by, total / own))
            };
            let terms = terms.iter().map(one).collect::<Vec<_>>().join(", ");
            let name = Combine::NAMES[*how as usize];
            let constant = match how {
                Combine::Sum => format!(", constant: {}", factor(*constant, total)),
                _ => String::new(),
            };
            format!("{name}(terms: [{terms}]{constant})")
        }
        Quantity::Derived(derived) => {
            let of = derived.of.iter().map(|i| text(&model.outputs[*i].name));
            let of = format!("of: [{}]", of.collect::<Vec<_>>().join(", "));
            custom(derived.card, &derived.values, &[of])
        }
    }
}

pub(super) fn envelope(model: &Model, e: &Envelope) -> String {
    let all = e.members.iter().map(|m| text(&model.elements[m.element].name));
    let elements = all.collect::<Vec<_>>().join(", ");
    let Some(first) = e.members.first() else { return "()".into() };
    // Members of one envelope may lie in the plane differently.
    let alike = e.members.iter().all(|m| m.forces == first.forces);
    let names = first.forces.iter().map(|f| f.name()).collect::<Vec<_>>().join(", ");
    let forces = if alike { format!(", forces: [{names}]") } else { String::new() };
    format!("(element: [{elements}], stations: {}{forces})", first.stations.len())
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
fn place(model: &Model, element: usize, coordinate: usize) -> (String, bool) {
    if let Body::Link(law, _) = &model.elements[element].body
        && let Coordinates::Local(axes) = law.coordinates()
    {
        let axis = axes[coordinate];
        return (format!("axis: {}", axis.name()), axis.index() > 2);
    }
    (format!("coordinate: {coordinate}"), coordinate % 6 > 2)
}

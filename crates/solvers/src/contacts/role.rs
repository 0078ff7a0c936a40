//! What the contacts of a model are to it.
//!
//! | role | law made for | and |
//! |---|---|---|
//! | foot | standing | its normal is not level, and it carries something at the start, or what it touches would fall |
//! | foot | a stop | its normal is not level, and what it touches would fall |
//! | bearing | a bearing | |
//! | stop | anything else | |
//!
//! What would fall is held by nothing but feet and stops: bearings hold what they carry. A body on feet has a
//! response mode; stops are hit, and bearings travel.

use super::are_contacts;
use trilith_element::{Contact, ContactUse, Coordinates, Link};
use trilith_model::{Element, Model};
use trilith_system::System;

/// A normal with less of the vertical than this is level.
const LEVEL: f64 = 1e-6;

/// What a contact is to its model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// A body stands on it.
    Foot,
    /// Something can be stopped by it.
    Stop,
    /// A structure travels on it.
    Bearing,
}

/// A link with contacts.
#[derive(Clone, Debug)]
struct Place {
    /// Index of the element.
    element: usize,
    /// Its name.
    name: String,
    /// The role where something stands, and where nothing does.
    roles: [Role; 2],
    /// What it touches would fall.
    falls: bool,
}

/// The links with contacts, in the order of the model.
#[derive(Clone, Debug, Default)]
pub(crate) struct Roles(Vec<Place>);

impl Roles {
    pub(crate) fn new(model: &Model, system: &System) -> Self {
        let contacts = are_contacts(model, system);
        if !contacts.contains(&true) {
            return Self::default();
        }
        let links = &system.links;
        let law = |i: usize| links.law(model, &links.links[i]);
        let uses: Vec<ContactUse> = (0..links.links.len())
            .map(|i| law(i).map_or(ContactUse::Stop, Link::contact_use))
            .collect();
        let holds = |i: usize| !contacts[i] || uses[i] == ContactUse::Bearing;
        let falling = system.on_falling_parts(model, holds);
        let place = |i: usize| {
            let element = links.links[i].element;
            let upright = law(i).is_some_and(|law| presses_upright(law, &model.elements[element]));
            let roles = match uses[i] {
                ContactUse::Bearing => [Role::Bearing; 2],
                ContactUse::Standing if upright => [Role::Foot, Role::Stop],
                ContactUse::Stop if upright && falling[i] => [Role::Foot, Role::Stop],
                ContactUse::Standing | ContactUse::Stop => [Role::Stop; 2],
            };
            let name = model.elements[element].name.clone();
            Place { element, name, roles, falls: falling[i] }
        };
        Self((0..contacts.len()).filter(|i| contacts[*i]).map(place).collect())
    }

    /// True where something stands on feet at the start, or falls onto them; `contacts` is what they do then, each
    /// with the index of its element.
    pub(crate) fn stand(&self, contacts: &[(usize, Contact)]) -> bool {
        let carries = |(element, c): &(usize, Contact)| {
            let place = self.place(*element);
            place.is_some_and(|p| p.roles[0] == Role::Foot && (p.falls || c.normal > 0.0))
        };
        contacts.iter().any(carries)
    }

    /// The role of each contact, where something `stands` on feet or nothing does.
    pub(crate) fn each(&self, contacts: &[(usize, Contact)], stands: bool) -> Vec<Role> {
        let role = |(element, _): &(usize, Contact)| {
            self.place(*element).map_or(Role::Stop, |p| p.roles[usize::from(!stands)])
        };
        contacts.iter().map(role).collect()
    }

    /// The name of an element with contacts.
    pub(crate) fn name(&self, element: usize) -> Option<String> {
        self.place(element).map(|p| p.name.clone())
    }

    fn place(&self, element: usize) -> Option<&Place> {
        self.0.binary_search_by_key(&element, |p| p.element).ok().map(|i| &self.0[i])
    }
}

/// True where the normal of a contact is not level; a law on the displacements of its nodes tells by what it is for.
fn presses_upright(law: &dyn Link, element: &Element) -> bool {
    match law.coordinates() {
        Coordinates::Local(axes) => {
            axes.first().is_some_and(|axis| element.frame.0[axis.index() % 3][2].abs() > LEVEL)
        }
        Coordinates::Nodal { .. } => law.contact_use() == ContactUse::Standing,
    }
}

//! Contacts: which links are some, what they do, and what they are to the model.
//!
//! Feet carry bodies, stops are hit, bearings travel; counts and extremes of the latter two.
//! May use `step`: contacts are looked at in a state.

mod bearings;
mod role;
mod stops;

pub use bearings::BearingSummary;
pub(crate) use bearings::Bearings;
pub(crate) use role::{Role, Roles};
pub use stops::StopSummary;
pub(crate) use stops::Stops;

use crate::step::State;
use trilith_element::{Contact, Kinematics, Link};
use trilith_model::Model;
use trilith_system::{LinkInstance, System, blaming};

/// For each link: true where it is a contact.
pub(crate) fn are_contacts(model: &Model, system: &System) -> Vec<bool> {
    let mut seen = Vec::new();
    let is_contact = |(law, link): (&dyn Link, &LinkInstance)| {
        let rest = vec![0.0; link.range.len()];
        let at = Kinematics::still(&rest, &rest);
        let mut history = vec![0.0; link.history.len()];
        law.at_rest(&mut history);
        seen.clear();
        blaming(link.element, || law.contacts(&at, &history, &rest, &mut seen));
        !seen.is_empty()
    };
    system.links.laws(model).iter().map(is_contact).collect()
}

/// What every contact does in a state, with the index of its element.
pub(crate) fn contacts(model: &Model, system: &System, state: &State) -> Vec<(usize, Contact)> {
    let (links, mut all, mut own) = (&system.links, Vec::new(), Vec::new());
    for link in &links.links {
        let Some(law) = links.law(model, link) else { continue };
        let r = link.range.clone();
        let (d, v) = (&state.d[r.clone()], &state.v[r.clone()]);
        let at = Kinematics::still(d, v);
        let history = &state.history[link.history.clone()];
        blaming(link.element, || law.contacts(&at, history, &state.f[r], &mut own));
        all.extend(own.drain(..).map(|c| (link.element, c)));
    }
    all
}

/// Elements of contacts on what nothing else holds against gravity.
pub(crate) fn falling(model: &Model, system: &System) -> Vec<usize> {
    let links = &system.links;
    let contacts = are_contacts(model, system);
    if !contacts.contains(&true) {
        return Vec::new();
    }
    let falling = system.on_falling_parts(model, |i| !contacts[i]);
    let all = links.links.iter().zip(contacts.iter().zip(falling));
    all.filter(|(_, (contact, falls))| **contact && *falls).map(|(l, _)| l.element).collect()
}

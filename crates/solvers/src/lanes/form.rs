//! How lanes ask the law of a link.
//!
//! A law that is written over lanes is asked once for all of them. Any other is asked for one lane after the other
//! ([`Each`]): what its structure does still goes side by side.

use super::each::Each;
use crate::record::{Internal, Row};
use std::any::TypeId;
use std::sync::Arc;
use trilith_element::lanes::{Arithmetic, ErasedLaw, LaneContact, LaneForm, LaneLinks, LaneStep};
use trilith_element::{Contact, ContactUse, Link};
use trilith_model::Model;
use trilith_system::System;

/// How much there is of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Extent {
    pub coordinates: usize,
    /// Coordinates of the link, of which those may be some.
    pub whole: usize,
    pub history: usize,
    pub parameters: usize,
    pub contacts: usize,
    /// It may end a run: a body that overturns.
    pub falls: bool,
}

/// A link of one analysis as it goes in a lane.
#[derive(Clone, Debug)]
pub(super) struct Form {
    pub law: Law,
    pub extent: Extent,
    /// The coordinates of the link that matter; the others stay zero.
    pub coordinates: Vec<usize>,
    pub parameters: Vec<f64>,
    /// Its law looks at rates.
    pub rate: bool,
}

/// The law of a link.
#[derive(Clone, Debug)]
pub(super) enum Law {
    /// Over lanes.
    Over(ErasedLaw),
    /// Of one link.
    One(Arc<dyn Link>),
}

impl Form {
    /// Of a law over lanes.
    pub fn over(form: LaneForm) -> Self {
        let LaneForm { law, coordinates, parameters, rate } = form;
        let extent = Extent {
            coordinates: law.coordinates,
            whole: law.coordinates,
            history: law.history,
            parameters: law.parameters,
            contacts: law.contacts,
            falls: law.falls,
        };
        Self { law: Law::Over(law), extent, coordinates, parameters, rate }
    }

    /// Of a law that is asked lane by lane, of which these coordinates matter.
    pub fn one(law: Arc<dyn Link>, coordinates: Vec<usize>, contacts: usize) -> Self {
        let extent = Extent {
            coordinates: coordinates.len(),
            whole: law.coordinates().len(),
            history: law.history().len(),
            parameters: 0,
            contacts,
            falls: contacts > 0 && law.contact_use() == ContactUse::Standing,
        };
        let rate = law.uses_rates();
        Self { law: Law::One(law), extent, coordinates, parameters: Vec::new(), rate }
    }

    /// What must be equal for links to go side by side.
    pub fn id(&self) -> TypeId {
        match &self.law {
            Law::Over(law) => law.id,
            Law::One(_) => TypeId::of::<Each>(),
        }
    }
}

/// The law of the links of a run, in all lanes.
#[derive(Debug)]
pub(super) enum Laws {
    Over(ErasedLaw),
    Each(Box<Each>),
}

impl Laws {
    /// Of a link of each analysis.
    pub fn of(forms: &[&Form]) -> Self {
        match &forms[0].law {
            Law::Over(law) => Self::Over(*law),
            Law::One(_) => Self::Each(Box::new(Each::of(forms))),
        }
    }

    /// True where they are asked about another link at once.
    pub fn serve(&self, form: &Form) -> bool {
        matches!(self, Self::Over(law) if law.id == form.id())
    }

    /// All of the answer.
    #[inline(always)]
    pub fn respond<A: Arithmetic>(
        &self,
        with: A,
        links: &mut LaneLinks<'_, A::Real>,
        steps: &mut [LaneStep<A::Real>],
    ) {
        match self {
            Self::Over(law) => with.respond(law, links, steps),
            Self::Each(each) => each.respond(with, links, &mut steps[0]),
        }
    }

    /// What their contacts do, and which of them have overturned (1, else 0).
    #[inline(always)]
    pub fn contacts<A: Arithmetic>(
        &self,
        with: A,
        links: &LaneLinks<'_, A::Real>,
        out: &mut [LaneContact<A::Real>],
        fallen: &mut [A::Real],
    ) {
        match self {
            Self::Over(law) => with.contacts(law, links, out, fallen),
            Self::Each(each) => fallen[0] = each.contacts(with, links, out),
        }
    }
}

/// The links of a model as they go in a lane, and the coordinates that matter of them among all, one link after the other;
/// or why one of them does not. `seen`: what the contacts of each element do.
pub(super) fn forms(
    model: &Model,
    system: &System,
    seen: &[(usize, Contact)],
    rows: &[Row],
) -> Result<(Vec<Form>, Vec<usize>), String> {
    let links = &system.links;
    let mut moves = vec![false; links.len()];
    links.active.iter().for_each(|i| moves[*i] = true);
    let mut matters = moves.clone();
    forces_of(rows).for_each(|i| matters[i] = true);
    let (mut forms, mut flat) = (Vec::new(), Vec::new());
    for link in &links.links {
        let name = &model.elements[link.element].name;
        let Some(law) = links.shared_law(model, link) else {
            return Err(format!("\"{name}\" is no link"));
        };
        let own = &moves[link.range.clone()];
        let is_whole = |form: &LaneForm| {
            let holds = |i: usize| !own[i] || form.coordinates.contains(&i);
            (0..own.len()).all(holds) && form.law.history == link.history.len()
        };
        let form = match law.lanes(own).filter(is_whole) {
            Some(form) => Form::over(form),
            None if !law.accounts() => {
                return Err(format!("link \"{name}\" does not say what it stores and loses"));
            }
            None => {
                let mut own: Vec<usize> =
                    (0..own.len()).filter(|i| matters[link.range.start + i]).collect();
                if own.is_empty() {
                    own.push(0);
                }
                let contacts = seen.iter().filter(|(element, _)| *element == link.element).count();
                Form::one(Arc::clone(law), own, contacts)
            }
        };
        flat.extend(form.coordinates.iter().map(|i| link.range.start + i));
        forms.push(form);
    }
    Ok((forms, flat))
}

/// The coordinates whose force an output tells.
fn forces_of(rows: &[Row]) -> impl Iterator<Item = usize> {
    let terms = |row: &Row| match row {
        Row::Force { terms } | Row::Internal(Internal { links: terms, .. }) => terms.clone(),
        _ => Vec::new(),
    };
    rows.iter().flat_map(terms).map(|(i, _)| i)
}

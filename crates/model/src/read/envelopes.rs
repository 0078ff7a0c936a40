//! Envelopes along members: hidden outputs, station by station.

use super::along::{Found, Members};
use super::context::Context;
use super::motion::unit;
use crate::schema;
use crate::tree::{Entry, Node};
use crate::{Envelope, MemberEnvelope, MemberForce, Output, Plane, Quantity};
use trilith_element::dimension::{FORCE, MOMENT};

/// Values that the envelopes of a model may follow: more would hold up every step.
const MOST: usize = 100_000;
const STATIONS: usize = 11;

pub(super) fn envelopes(
    c: &Context<'_>,
    entries: &[Entry],
    members: &Members<'_, '_>,
    plane: Option<Plane>,
    outputs: &mut Vec<Option<Output>>,
) -> Vec<Option<Envelope>> {
    let before = outputs.len();
    entries
        .iter()
        .map(|e| {
            let found = envelope(c, e, members, plane, outputs)?;
            if outputs.len() - before > MOST {
                let message = format!(
                    "envelopes follow {} values in all: at most {MOST}",
                    outputs.len() - before
                );
                let d = c.diagnostic("E0112", message, e.key_span.clone());
                c.report(d.help("name fewer members, `forces` or `stations`"));
                return None;
            }
            Some(found)
        })
        .collect()
}

fn envelope(
    c: &Context<'_>,
    e: &Entry,
    members: &Members<'_, '_>,
    plane: Option<Plane>,
    outputs: &mut Vec<Option<Output>>,
) -> Option<Envelope> {
    let what = format!("envelope `{}`", e.key);
    let fields = c.block(&e.value, &what, schema::ENVELOPES.blocks[0])?;
    let found = members.several(c, &fields);
    let stations =
        fields.get("stations").map_or(Some(STATIONS), |n| c.count_up_to(n, "stations", 2, 1001));
    let forces = fields.get("forces").map_or(Some(None), |n| forces(c, n, &what).map(Some));
    let (found, stations, forces) = (found?, stations?, forces?);
    let mut all = Vec::new();
    for (member, _) in found {
        let forces = forces.clone().unwrap_or_else(|| in_plane(plane, &member));
        let share = |k: usize| member.length() * k as f64 / (stations - 1) as f64;
        let one = MemberEnvelope {
            element: member.index,
            forces,
            stations: (0..stations).map(share).collect(),
            first: outputs.len(),
        };
        for at in &one.stations {
            for force in &one.forces {
                let own = if force.is_moment() { MOMENT } else { FORCE };
                let name = format!("{}: {} {} at {at} m", e.key, member.element.name, force.name());
                let quantity = Quantity::MemberForce {
                    element: member.index,
                    force: *force,
                    at: *at,
                    factor: 1.0,
                };
                let unit = unit(own, false);
                outputs.push(Some(Output { name, unit, quantity, hidden: true }));
            }
        }
        all.push(one);
    }
    Some(Envelope { name: e.key.clone(), members: all })
}

fn forces(c: &Context<'_>, node: &Node, what: &str) -> Option<Vec<MemberForce>> {
    let mut all = Vec::new();
    let mut good = true;
    for item in node.items() {
        match c.choice(item, "force", &schema::FORCES).map(|i| MemberForce::ALL[i]) {
            Some(force) if all.contains(&force) => {
                let message = format!("{what} has `{}` twice", force.name());
                c.report(c.diagnostic("E0102", message, item.span.clone()));
                good = false;
            }
            Some(force) => all.push(force),
            None => good = false,
        }
    }
    if node.items().is_empty() {
        c.report(c.diagnostic("E0104", format!("{what} has no forces"), node.span.clone()));
        good = false;
    }
    good.then_some(all)
}

/// The forces that a member may have in a plane model.
fn in_plane(plane: Option<Plane>, member: &Found<'_>) -> Vec<MemberForce> {
    use MemberForce::{M2, M3, N, V2, V3};
    let square = match plane {
        None => return MemberForce::ALL.to_vec(),
        Some(Plane::XZ) => 1,
        Some(Plane::YZ) => 0,
        Some(Plane::XY) => 2,
    };
    let [_, second, third] = member.element.frame.0;
    let along = |axis: [f64; 3]| axis[square].abs() > 1.0 - 1e-9;
    match (along(second), along(third)) {
        (_, true) => vec![N, V2, M3],
        (true, _) => vec![N, V3, M2],
        _ => MemberForce::ALL.to_vec(),
    }
}

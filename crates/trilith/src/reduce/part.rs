//! Which elements and nodes a part has, and which of them the rest of the model needs.

use super::{ReduceError, Request};
use std::collections::BTreeSet;
use trilith_model::file::fits;
use trilith_model::{Analysis, Body, Model, NodalTerm, Quantity};
use trilith_system::System;

/// A part of a model, by flags in the order of the model.
#[derive(Debug)]
pub(super) struct Part {
    pub elements: Vec<bool>,
    /// Nodes that its elements have.
    pub nodes: Vec<bool>,
    /// Those that become rows.
    pub kept: Vec<bool>,
    /// Those that follow the rows and can be told of.
    pub recovered: Vec<bool>,
}

impl Part {
    pub fn new(model: &Model, system: &System, request: &Request) -> Result<Self, ReduceError> {
        let elements = elements(model, &request.part)?;
        sound(model, system, &elements)?;
        let mut own = model.elements.iter().zip(&elements).filter(|(_, own)| **own);
        if !own.any(|(e, _)| matches!(e.body, Body::Linear(_))) {
            return Err(ReduceError::Nothing);
        }
        let mut nodes = vec![false; model.nodes.len()];
        let own = model.elements.iter().zip(&elements).filter(|(_, own)| **own);
        own.flat_map(|(e, _)| &e.nodes).for_each(|i| nodes[*i] = true);
        let mut kept = needed(model, &elements);
        let spoken = spoken_of(model, &elements)?;
        let within = |all: &[usize]| match all.iter().find(|i| !nodes[**i]) {
            Some(i) => Err(ReduceError::NotInPart { node: model.nodes[*i].name.clone() }),
            None => Ok(()),
        };
        match &request.keep {
            None => spoken.iter().for_each(|i| kept[*i] = true),
            Some(names) => {
                let named = named_nodes(model, names)?;
                within(&named)?;
                named.into_iter().for_each(|i| kept[i] = true);
            }
        }
        kept.iter_mut().zip(&nodes).for_each(|(kept, own)| *kept &= own);
        if !kept.contains(&true) {
            return Err(ReduceError::NothingKept);
        }
        let wanted = named_nodes(model, &request.recover)?;
        within(&wanted)?;
        let mut recovered = vec![request.recover_all; nodes.len()];
        spoken.into_iter().chain(wanted).for_each(|i| recovered[i] = true);
        for (i, recovered) in recovered.iter_mut().enumerate() {
            *recovered &= nodes[i] && !kept[i];
        }
        Ok(Self { elements, nodes, kept, recovered })
    }
}

/// The elements of names: of elements, and of groups of them.
fn elements(model: &Model, names: &[String]) -> Result<Vec<bool>, ReduceError> {
    let mut flags = vec![false; model.elements.len()];
    for name in names {
        if let Some(group) = model.groups.iter().find(|g| !g.of_nodes && g.name == *name) {
            group.members.iter().for_each(|i| flags[*i] = true);
        } else if let Some(i) = model.elements.iter().position(|e| e.name == *name) {
            flags[i] = true;
        } else if let Some(found) = fitting(name, model.elements.iter().map(|e| &e.name)) {
            found.into_iter().for_each(|i| flags[i] = true);
        } else {
            let groups = model.groups.iter().filter(|g| !g.of_nodes).map(|g| g.name.as_str());
            let all: Vec<&str> =
                groups.chain(model.elements.iter().map(|e| e.name.as_str())).collect();
            return Err(ReduceError::unknown(name, "element or group of elements", all));
        }
    }
    Ok(flags)
}

/// What a pattern with `*` stands for, where it is one and stands for any.
fn fitting<'a>(pattern: &str, names: impl Iterator<Item = &'a String>) -> Option<Vec<usize>> {
    let all = names.enumerate().filter(|(_, name)| fits(pattern, name)).map(|(i, _)| i);
    Some(all.collect()).filter(|all: &Vec<usize>| pattern.contains('*') && !all.is_empty())
}

/// The nodes of names: of nodes, and of groups of them.
fn named_nodes(model: &Model, names: &[String]) -> Result<Vec<usize>, ReduceError> {
    let mut found = Vec::new();
    for name in names {
        if let Some(group) = model.groups.iter().find(|g| g.of_nodes && g.name == *name) {
            found.extend(&group.members);
        } else if let Some(i) = model.nodes.iter().position(|n| n.name == *name) {
            found.push(i);
        } else if let Some(fitting) = fitting(name, model.nodes.iter().map(|n| &n.name)) {
            found.extend(fitting);
        } else {
            let groups = model.groups.iter().filter(|g| g.of_nodes).map(|g| g.name.as_str());
            let all: Vec<&str> =
                groups.chain(model.nodes.iter().map(|n| n.name.as_str())).collect();
            return Err(ReduceError::unknown(name, "node or group of nodes", all));
        }
    }
    Ok(found)
}

/// Refuses what matrices of a superelement cannot stand for.
fn sound(model: &Model, system: &System, flags: &[bool]) -> Result<(), ReduceError> {
    for (i, e) in model.elements.iter().enumerate().filter(|(i, _)| flags[*i]) {
        let element = e.name.clone();
        if matches!(e.body, Body::Link(..)) {
            return Err(ReduceError::NotLinear { element, kind: e.kind });
        }
        if system.stands_on_ground(model, i) {
            return Err(ReduceError::OnGround { element });
        }
        if system.has_inertance(model, i) {
            return Err(ReduceError::Inertance { element });
        }
        if system.tension[i] != 0.0 {
            return Err(ReduceError::AxialForce { element });
        }
    }
    Ok(())
}

/// Nodes that the rest of the model touches: its elements, supports, motions of supports and initial values.
fn needed(model: &Model, part: &[bool]) -> Vec<bool> {
    let mut needed = vec![false; model.nodes.len()];
    let others = model.elements.iter().zip(part).filter(|(_, own)| !**own);
    others.flat_map(|(e, _)| &e.nodes).for_each(|i| needed[*i] = true);
    model.supports.iter().for_each(|s| needed[s.node] = true);
    for case in &model.cases {
        if let Analysis::Dynamic(d) = &case.analysis {
            d.supports.iter().for_each(|s| needed[s.node] = true);
            d.initial.iter().for_each(|s| needed[s.node] = true);
        }
    }
    needed
}

/// Nodes that loads and outputs name, those of loads along elements of the part among them.
fn spoken_of(model: &Model, part: &[bool]) -> Result<BTreeSet<usize>, ReduceError> {
    let mut nodes = BTreeSet::new();
    for pattern in &model.patterns {
        nodes.extend(pattern.forces.iter().map(|f| f.node));
        for load in pattern.members.iter().filter(|load| part[load.element]) {
            nodes.extend(&model.elements[load.element].nodes);
        }
    }
    let mut inside = Vec::new();
    // Envelopes make outputs of their own, behind all others.
    let own = model.envelopes.iter().flat_map(|e| &e.members).map(|m| m.first).min();
    for output in &model.outputs[..own.unwrap_or(model.outputs.len())] {
        let mut of = |element: usize| {
            if part[element] {
                inside.push((output.name.clone(), model.elements[element].name.clone()));
            }
        };
        match &output.quantity {
            Quantity::Displacement(terms)
            | Quantity::Velocity(terms)
            | Quantity::Acceleration { terms, .. } => {
                nodes.extend(terms.iter().map(|t: &NodalTerm| t.node));
            }
            Quantity::Reaction { nodes: all, .. } => nodes.extend(all),
            Quantity::ElementForce { elements, .. } => {
                if let Some(element) = elements.iter().find(|e| part[**e]) {
                    of(*element);
                }
            }
            Quantity::MemberForce { element, .. } => of(*element),
            _ => {}
        }
    }
    for envelope in &model.envelopes {
        if let Some(member) = envelope.members.iter().find(|m| part[m.element]) {
            inside.push((envelope.name.clone(), model.elements[member.element].name.clone()));
        }
    }
    if inside.is_empty() { Ok(nodes) } else { Err(ReduceError::Outputs(inside)) }
}

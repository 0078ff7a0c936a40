//! Nodes that are bodies in finite rotation: their rotations are integrals of the angular velocity in the body's own
//! axes, and whoever takes them for small ones is wrong as soon as the body tilts.
//!
//! A constraint that makes a lever of such a rotation is refused. Members and links that lean on it are named.

use crate::SystemError;
use crate::assemble::element_matrices;
use crate::link_rows::full_rows;
use std::collections::BTreeMap;
use trilith_model::{Body, Element, Model};

/// An element that takes the rotations of a body in finite rotation for small ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SmallTurn {
    /// Index of the element.
    pub element: usize,
    /// Index of the link that turns the body.
    pub body: usize,
}

/// Nodes that turn finitely, each with the element that turns it.
fn turning(model: &Model) -> impl Iterator<Item = (usize, usize)> + '_ {
    let of = |(i, e): (usize, &Element)| match &e.body {
        Body::Link(law, _) => Some((*e.nodes.get(law.turning_node()?)?, i)),
        _ => None,
    };
    model.elements.iter().enumerate().filter_map(of)
}

/// The nodes that turn finitely.
///
/// # Errors
/// Where two elements turn the same: each would count its gyroscopic moment.
pub(crate) fn turning_nodes(model: &Model) -> Result<BTreeMap<usize, usize>, SystemError> {
    let mut nodes = BTreeMap::new();
    for (node, element) in turning(model) {
        if let Some(first) = nodes.insert(node, element) {
            let [e, first] = [element, first].map(|i| &model.elements[i]);
            return Err(SystemError::Element {
                element: e.name.clone(),
                reason: format!(
                    "node \"{}\" is the body of \"{}\" already: one {} has all of its base; what else it touches are `BodyContact`s",
                    model.nodes[node].name, first.name, first.kind
                ),
                span: e.span.clone(),
            });
        }
    }
    Ok(nodes)
}

/// Refuses an equation between full DOFs in which the rotation of a body that turns finitely is a lever. In a plane
/// rotations themselves add up, and may be tied to each other.
///
/// # Errors
/// [`SystemError::Element`] with the constraint.
pub(crate) fn refuse_lever(
    model: &Model,
    turning: &BTreeMap<usize, usize>,
    element: usize,
    dofs: impl Iterator<Item = usize> + Clone,
    is_held: impl Fn(usize) -> bool,
) -> Result<(), SystemError> {
    let rotates = |full: &usize| full % 6 > 2;
    let body = |full: usize| turning.get(&(full / 6)).map(|body| (full / 6, *body));
    let mut turns = dofs.clone().filter(rotates).filter(|full| !is_held(*full));
    let Some((node, body)) = turns.find_map(body) else { return Ok(()) };
    if model.plane.is_some() && dofs.clone().all(|full| rotates(&full)) {
        return Ok(());
    }
    let e = &model.elements[element];
    Err(SystemError::Element {
        element: e.name.clone(),
        reason: format!(
            "it takes the rotations of node \"{}\" for small ones, and \"{}\" turns that body finitely: what is fixed to the body belongs to its `Mass` and its outline, what touches it is a `BodyContact`, and outputs take its rotations as they are",
            model.nodes[node].name, model.elements[body].name
        ),
        span: e.span.clone(),
    })
}

/// The elements that lean on rotations of bodies in finite rotation, in the order of the model.
///
/// # Errors
/// As an assembly has them.
pub fn small_turns(model: &Model) -> Result<Vec<SmallTurn>, SystemError> {
    let nodes = turning_nodes(model)?;
    if nodes.is_empty() {
        return Ok(Vec::new());
    }
    let moves = |node: usize, direction: usize| {
        let plane = model.plane.is_none_or(|p| p.dofs().iter().any(|d| d.index() == direction));
        let fixed = model.supports.iter().any(|s| s.node == node && s.fixed[direction]);
        plane && !fixed
    };
    // The body that turns a full DOF, where it is a rotation of one.
    let turned = |full: usize| {
        let (node, direction) = (full / 6, full % 6);
        let body = nodes.get(&node).filter(|_| direction > 2 && moves(node, direction));
        body.copied()
    };
    let mut found = Vec::new();
    for (element, e) in model.elements.iter().enumerate() {
        let body = match &e.body {
            Body::Constraint(_) => None,
            Body::Link(law, options) => {
                let coordinates = law.coordinates();
                // Laws on the displacements of their nodes do their own kinematics.
                let local = matches!(coordinates, trilith_element::Coordinates::Local(_));
                let rows = local.then(|| full_rows(model, element, &coordinates, options.shear_at));
                rows.into_iter().flatten().flatten().find_map(|(full, _)| turned(full))
            }
            Body::Linear(_) => leaning(model, e, &turned)?,
        };
        found.extend(body.map(|body| SmallTurn { element, body }));
    }
    Ok(found)
}

/// The body whose rotation a linear element holds, or couples to something else by its mass.
fn leaning(
    model: &Model,
    e: &Element,
    turned: &impl Fn(usize) -> Option<usize>,
) -> Result<Option<usize>, SystemError> {
    let full = |n: usize, direction: usize| 6 * e.nodes[n] + direction;
    if !e.nodes.iter().any(|n| (3..6).any(|k| turned(6 * n + k).is_some())) {
        return Ok(None);
    }
    if let Some(own) = crate::inner::sparse(e) {
        let tied = |row: &trilith_element::SparseRow| match row {
            trilith_element::SparseRow::Node(n, dof) => turned(full(*n, dof.index())),
            trilith_element::SparseRow::Inner(_) => None,
        };
        return Ok(own.rows.iter().find_map(tied));
    }
    let Some(m) = element_matrices(model, e, 0.0)? else { return Ok(None) };
    let size = m.dofs.len();
    let held = |i: usize| {
        (0..size).any(|j| {
            let at = size * i + j;
            let stiff = [&m.stiffness, &m.damping, &m.inertance].map(|a| a.values()[at]);
            stiff != [0.0; 3] || (i != j && m.mass.values()[at] != 0.0)
        })
    };
    let leans = |(i, (n, dof)): (usize, &(usize, trilith_element::Dof))| {
        turned(full(*n, dof.index())).filter(|_| held(i))
    };
    Ok(m.dofs.iter().enumerate().find_map(leans))
}

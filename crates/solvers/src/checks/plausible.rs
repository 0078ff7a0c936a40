//! What a run says about a model that is hardly meant so: bodies without weight, contacts without stiffness, parts
//! that have left. All of it begins with `check the model`.

use super::overlap;
use crate::contacts::{contacts, falling};
use crate::error::SolveError;
use crate::step::State;
use trilith_element::{Contact, Dof, Vector3};
use trilith_model::{Body, Case, DynamicCase, Element, Model, Side};
use trilith_system::{LoadSet, SmallTurn, System, small_turns};

/// Share of the size of a model by which a contact may be pressed in without a word.
pub(crate) const PRESSED: f64 = 0.05;

/// How far a part may go without a word where a model has no size, m: farther than across a continent.
pub(crate) const FAR: f64 = 1e6;

/// Names that a sentence holds.
const NAMES: usize = 3;

/// What was noticed on the way through a case.
#[derive(Debug, Default)]
pub(crate) struct Noticed {
    /// The contact that was pressed in deepest.
    pub pressed: Pressed,
    /// What there is to say of bodies that were in each other, and of outputs that were no numbers.
    pub said: Vec<String>,
}

/// The contact that was pressed in deepest.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pressed {
    /// Index of its element, where there was one.
    element: Option<usize>,
    /// By how much, m.
    depth: f64,
}

impl Pressed {
    /// Looks at contacts, each with the index of its element.
    pub(crate) fn see(&mut self, contacts: &[(usize, Contact)]) {
        for (element, contact) in contacts {
            if contact.normal > 0.0 && -contact.gap > self.depth {
                *self = Self { element: Some(*element), depth: -contact.gap };
            }
        }
    }
}

/// What there is to say of a model before any case: who takes the rotations of a body in finite rotation for small ones,
/// whose energies are not known, and bodies that are in each other.
///
/// # Errors
/// As an assembly has them.
pub fn of_model(model: &Model) -> Result<Vec<String>, SolveError> {
    let mut all = turns(model)?;
    all.extend(unaccounted(model));
    all.extend(overlap::at_rest(model));
    Ok(all)
}

/// Links whose laws do not say what becomes of the work that is done on them.
fn unaccounted(model: &Model) -> Option<String> {
    let silent = |e: &&Element| matches!(&e.body, Body::Link(law, _) if !law.accounts());
    let all: Vec<&Element> = model.elements.iter().filter(silent).collect();
    let (first, rest) = all.split_first()?;
    let others =
        if rest.is_empty() { String::new() } else { format!(" and {} more links", rest.len()) };
    Some(format!(
        "check the model: the law of \"{}\" ({}){others} does not tell its energies: the work that is done on it counts as heat, less than none \
         where it gives work back, so the balance of energies says nothing of it",
        first.name, first.kind
    ))
}

/// Who takes the rotations of a body in finite rotation for small ones.
fn turns(model: &Model) -> Result<Vec<String>, SolveError> {
    let say = |SmallTurn { element, body }: SmallTurn| {
        let [element, body] = [element, body].map(|i| &model.elements[i]);
        format!(
            "check the model: {} \"{}\" takes the rotations of the body of \"{}\" for small ones, which are finite: it is \
             wrong by the square of the tilt",
            element.kind, element.name, body.name
        )
    };
    Ok(small_turns(model)?.into_iter().map(say).collect())
}

/// Where a dynamic case ended.
pub(crate) struct End<'a> {
    /// Time in the case, s.
    pub time: f64,
    /// Displacements and constant loads of the free DOFs.
    pub displacement: &'a [f64],
    pub load: &'a [f64],
    pub state: &'a State,
    /// True where a body has fallen over.
    pub fallen: bool,
}

/// What there is to say of a dynamic case from its end and from what was noticed on the way.
pub(crate) fn of_dynamic(
    (model, system): (&Model, &System),
    (case, analysis): (&Case, &DynamicCase),
    loads: &LoadSet,
    noticed: Noticed,
    end: &End<'_>,
) -> Vec<String> {
    let count = system.reduction.prescribed.len();
    let [supports, _, _] = loads.prescribed(end.time, Side::Before, count);
    // One that fell over is far from its place, and the status says why.
    let free = (!end.fallen).then_some(end.displacement);
    let weight = weightless(model, system, case, analysis, end.load);
    let Noticed { pressed, said } = noticed;
    let place = of_state(model, system, end.state, pressed, free, &supports);
    let turns = turns(model).unwrap_or_default();
    let doubts = system.inner.doubts.iter().cloned();
    let silent = unaccounted(model);
    weight.into_iter().chain(place).chain(said).chain(turns).chain(silent).chain(doubts).collect()
}

/// What there is to say of a static case.
pub(crate) fn of_static(
    model: &Model,
    system: &System,
    state: &State,
    noticed: Noticed,
    u: &[f64],
) -> Vec<String> {
    let supports = vec![0.0; system.reduction.prescribed.len()];
    let said = of_state(model, system, state, noticed.pressed, Some(u), &supports);
    let silent = unaccounted(model);
    let doubts = system.inner.doubts.iter().cloned();
    said.into_iter().chain(noticed.said).chain(silent).chain(doubts).collect()
}

/// Of the place where a case ends: contacts, and the displacements of the free DOFs where these count.
fn of_state(
    model: &Model,
    system: &System,
    state: &State,
    mut pressed: Pressed,
    free: Option<&[f64]>,
    supports: &[f64],
) -> Option<String> {
    pressed.see(&contacts(model, system, state));
    let Some(size) = size(model) else {
        let (node, moved) = farthest(model, system, free?, supports)?;
        return (moved > FAR).then(|| away(model, node, moved));
    };
    if let Some(element) = pressed.element.filter(|_| pressed.depth > PRESSED * size) {
        // What stands on it has moved as far for that.
        return Some(format!(
            "check the model: the contact \"{}\" was pressed in by {} m, {} % of the size of the model ({} m; {} % are \
             taken without a word): it is too soft for what it carries",
            model.elements[element].name,
            rounded(pressed.depth),
            rounded(100.0 * pressed.depth / size),
            rounded(size),
            100.0 * PRESSED
        ));
    }
    let (node, moved) = farthest(model, system, free?, supports)?;
    let carried = supports.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
    (moved > size + carried).then(|| beyond(model, node, moved, size))
}

/// Says that a node is farther away than the model is large.
pub(crate) fn beyond(model: &Model, node: usize, moved: f64, size: f64) -> String {
    let [share, size] = [100.0 * moved / size, size].map(rounded);
    away(model, node, moved) + &format!(", {share} % of the size of the model ({size} m)")
}

/// Says that a node has left.
pub(crate) fn away(model: &Model, node: usize, moved: f64) -> String {
    let name = &model.nodes[node].name;
    format!(
        "check the model: at the end node \"{name}\" is {} m away from its place",
        rounded(moved)
    )
}

/// Whether ground motion or forces act in a case.
pub(crate) fn drives(analysis: &DynamicCase) -> bool {
    !analysis.base.is_empty() || !analysis.forces.is_empty()
}

/// Says where ground motion or forces act on a body that only contacts could carry and that nothing presses onto
/// them.
pub(crate) fn weightless(
    model: &Model,
    system: &System,
    case: &Case,
    analysis: &DynamicCase,
    constant: &[f64],
) -> Option<String> {
    if !drives(analysis) {
        return None;
    }
    let down = Dof::Uz.index();
    let free = &system.reduction.free;
    let falls = |full: usize| system.inner.shift(full, down) != 0.0;
    let held = constant.iter().zip(free).any(|(p, full)| *p != 0.0 && falls(*full));
    // A weight may come as a force that varies.
    let forced = analysis.forces.iter().any(|history| {
        let pattern = &model.patterns[history.pattern];
        !pattern.members.is_empty()
            || pattern
                .forces
                .iter()
                .any(|f| f.dof.index() == down && f.value * history.factor < 0.0)
    });
    if held || forced {
        return None;
    }
    let elements = falling(model, system);
    if elements.is_empty() {
        return None;
    }
    let name = |i: &usize| format!("\"{}\"", model.elements[*i].name);
    let names: Vec<String> = elements.iter().take(NAMES).map(name).collect();
    let more = if elements.len() > NAMES { ", …" } else { "" };
    Some(format!(
        "check the model: nothing but contacts ({}{more}) carries a part of it, and in case \"{}\" its {} kg have no \
         weight: `after` a static case with `loads: [Gravity]`, or `constant: [Gravity]`, gives it",
        names.join(", "),
        case.name,
        rounded(system.total_mass)
    ))
}

/// The node that is farthest from its place, and how far, m; displacements of the free and of the prescribed DOFs.
fn farthest(
    model: &Model,
    system: &System,
    free: &[f64],
    supports: &[f64],
) -> Option<(usize, f64)> {
    let along = |full: usize| -> f64 {
        let terms = system.reduction.expand(full).iter();
        terms.map(|(j, c)| c * free.get(*j).unwrap_or_else(|| &supports[j - free.len()])).sum()
    };
    let moved = |node: usize| (0..3).map(|axis| along(6 * node + axis).powi(2)).sum::<f64>().sqrt();
    (0..model.nodes.len()).map(|node| (node, moved(node))).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Largest extent of nodes and outlines of bodies along an axis, m; `None` for a point, which has no size.
pub(crate) fn size(model: &Model) -> Option<f64> {
    let mut points: Vec<Vector3> = model.nodes.iter().map(|node| node.position).collect();
    for (element, law) in overlap::links(model) {
        let Some(outline) = overlap::still(law) else { continue };
        let Some(node) = model.elements[element].nodes.first() else { continue };
        let place = model.nodes[*node].position;
        points.extend(outline.points.iter().map(|p| [0, 1, 2].map(|i| place[i] + p[i])));
    }
    let along = |axis: usize| {
        let whole = (f64::INFINITY, f64::NEG_INFINITY);
        let all = points.iter().map(|p| p[axis]);
        let (low, high) = all.fold(whole, |(low, high), x| (x.min(low), x.max(high)));
        high - low
    };
    let most = (0..3).map(along).fold(0.0, f64::max);
    (most > 0.0).then_some(most)
}

/// With three significant digits.
pub(crate) fn rounded(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}

//! Bodies that are in each other, which nothing but a contact between them prevents.

mod convex;

use convex::{Convex, Posed, overlap};
use std::collections::HashMap;
use trilith_element::{Contact, Coordinates, Kinematics, Link, Outline, Vector3};
use trilith_model::{Body, Model};

/// Share of the width of the smaller body by which two may be in each other without a word.
const TAKEN: f64 = 0.01;

/// Pairs that are told one by one.
const TOLD: usize = 3;

/// A link with an outline.
#[derive(Debug)]
struct Solid {
    /// Its place among the laws.
    body: usize,
    element: usize,
    node: usize,
    shape: Convex,
    /// How far it reaches from its node, m.
    reach: f64,
    /// True where the first coordinates are the displacement of its node.
    nodal: bool,
}

/// Two bodies that have come near each other.
#[derive(Debug)]
struct Pair {
    /// Where they were apart last.
    axis: Option<Vector3>,
    /// What is between them; none where they are one rigid body.
    between: Option<Vec<usize>>,
    /// How deep they were in each other, and when.
    deepest: Option<(f64, f64)>,
}

/// Where bodies are, by their places among the laws that [`Overlaps`] was made of.
pub(crate) trait Place {
    /// Displacements along the coordinates of the law.
    fn deformation(&self, body: usize) -> Option<&[f64]>;
    /// Its outline.
    fn outline(&self, body: usize) -> Option<Outline>;
}

/// Looks whether bodies are in each other.
#[derive(Debug)]
pub(crate) struct Overlaps<'a> {
    model: &'a Model,
    solids: Vec<Solid>,
    /// For each node, the first of those that constraints hold together with it.
    parts: Vec<usize>,
    near: HashMap<(usize, usize), Pair>,
}

impl<'a> Overlaps<'a> {
    /// Of links with outlines, by their elements, in the place that they have before anything moves.
    pub fn new(model: &'a Model, laws: &[(usize, &dyn Link)]) -> Self {
        let solids: Vec<Solid> = if laws.len() < 2 {
            Vec::new()
        } else {
            laws.iter().enumerate().filter_map(|(i, (e, law))| solid(model, i, *e, *law)).collect()
        };
        let parts = if solids.len() < 2 { Vec::new() } else { parts(model) };
        Self { model, solids, parts, near: HashMap::new() }
    }

    /// Looks at a moment; `contacts`: what they do then, each with the index of its element.
    pub fn see(&mut self, t: f64, place: &dyn Place, contacts: &[(usize, Contact)]) {
        if self.solids.len() < 2 {
            return;
        }
        let centers: Vec<Option<Vector3>> =
            self.solids.iter().map(|s| self.center(s, place)).collect();
        let mut posed: Vec<Option<Posed>> = self.solids.iter().map(|_| None).collect();
        for j in 1..self.solids.len() {
            for i in 0..j {
                let reach = self.solids[i].reach + self.solids[j].reach;
                if let (Some(a), Some(b)) = (centers[i], centers[j])
                    && (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>() > reach * reach
                {
                    continue;
                }
                self.look((i, j), t, place, contacts, &mut posed);
            }
        }
    }

    /// Looks at two bodies that are near each other.
    fn look(
        &mut self,
        (i, j): (usize, usize),
        t: f64,
        place: &dyn Place,
        contacts: &[(usize, Contact)],
        posed: &mut [Option<Posed>],
    ) {
        let (model, parts) = (self.model, &self.parts);
        let (first, second) = (&self.solids[i], &self.solids[j]);
        let pair = self.near.entry((i, j)).or_insert_with(|| {
            let between = between(model, parts, first.node, second.node);
            Pair { axis: None, between, deepest: None }
        });
        let Some(between) = &pair.between else { return };
        for k in [i, j] {
            let solid = &self.solids[k];
            posed[k] = posed[k].take().or_else(|| {
                let origin = model.nodes[solid.node].position;
                let points = place.outline(solid.body)?.points;
                solid.shape.posed(points.iter().map(|p| sum(origin, *p)).collect())
            });
        }
        let (Some(a), Some(b)) = (&posed[i], &posed[j]) else { return };
        let taken = TAKEN * first.shape.width.min(second.shape.width);
        let Some(depth) = overlap(a, b, taken, &mut pair.axis) else { return };
        // A contact between them that is pressed in has them as deep in each other.
        let pressed = contacts.iter().filter(|(element, _)| between.contains(element));
        let pressed = pressed.map(|(_, c)| -c.gap).fold(0.0, f64::max);
        if depth > taken + pressed && pair.deepest.is_none_or(|(most, _)| depth > most) {
            pair.deepest = Some((depth, t));
        }
    }

    /// Where the node of a body is, for those that tell.
    fn center(&self, solid: &Solid, place: &dyn Place) -> Option<Vector3> {
        let d = place.deformation(solid.body).filter(|_| solid.nodal)?;
        let &[x, y, z, ..] = d else { return None };
        Some(sum(self.model.nodes[solid.node].position, [x, y, z]))
    }

    /// What was seen, the deepest first; `when` puts a time in words.
    pub fn told(&self, when: impl Fn(f64) -> String) -> Vec<String> {
        let found = |((i, j), pair): (&(usize, usize), &Pair)| {
            pair.deepest.map(|(depth, t)| (depth, t, [*i, *j]))
        };
        let mut all: Vec<_> = self.near.iter().filter_map(found).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.2.cmp(&b.2)));
        let more = all.len().saturating_sub(TOLD);
        let one = |(depth, t, pair): (f64, f64, [usize; 2])| {
            let [a, b] = pair.map(|i| &self.model.elements[self.solids[i].element].name);
            format!(
                "check the model: the bodies of \"{a}\" and \"{b}\" are {} m deep in each other {}: nothing but a \
                 contact between them, such as a `BodyContact`, keeps bodies apart",
                super::plausible::rounded(depth),
                when(t)
            )
        };
        let mut told: Vec<String> = all.into_iter().take(TOLD).map(one).collect();
        if let Some(last) = told.last_mut().filter(|_| more > 0) {
            *last += &format!("; so are {more} more pairs");
        }
        told
    }
}

/// What is in each other where the model has it, before anything moves.
pub(super) fn at_rest(model: &Model) -> Vec<String> {
    let outlined = links(model).filter(|(_, law)| still(*law).is_some());
    let laws: Vec<(usize, &dyn Link)> = outlined.collect();
    let mut overlaps = Overlaps::new(model, &laws);
    let (mut contacts, mut own) = (Vec::new(), Vec::new());
    if laws.len() > 1 {
        for (element, law) in links(model) {
            let (zero, history) = rest(law);
            law.contacts(&unmoved(&zero), &history, &zero, &mut own);
            contacts.extend(own.drain(..).map(|c| (element, c)));
        }
    }
    overlaps.see(0.0, &Rest(&laws), &contacts);
    overlaps.told(|_| "where the model places them".into())
}

struct Rest<'a>(&'a [(usize, &'a dyn Link)]);

impl Place for Rest<'_> {
    fn deformation(&self, _: usize) -> Option<&[f64]> {
        Some(&[0.0; 3])
    }

    fn outline(&self, body: usize) -> Option<Outline> {
        still(self.0.get(body)?.1)
    }
}

/// The links of a model, each with the index of its element.
pub(super) fn links(model: &Model) -> impl Iterator<Item = (usize, &dyn Link)> {
    model.elements.iter().enumerate().filter_map(|(i, e)| match &e.body {
        Body::Link(law, _) => Some((i, &**law)),
        _ => None,
    })
}

/// Deformations and history of a law before anything has happened.
fn rest(law: &dyn Link) -> (Vec<f64>, Vec<f64>) {
    let mut history = vec![0.0; law.history().len()];
    law.at_rest(&mut history);
    (vec![0.0; law.coordinates().len()], history)
}

fn unmoved(zero: &[f64]) -> Kinematics<'_> {
    Kinematics::still(zero, zero)
}

/// The outline of a law before anything has happened.
pub(super) fn still(law: &dyn Link) -> Option<Outline> {
    let (zero, history) = rest(law);
    law.outline(&unmoved(&zero), &history)
}

fn solid(model: &Model, body: usize, element: usize, law: &dyn Link) -> Option<Solid> {
    let outline = still(law)?;
    let node = *model.elements[element].nodes.first()?;
    let shape = Convex::new(&outline)?;
    let far = |p: &Vector3| p.iter().map(|x| x * x).sum::<f64>().sqrt();
    let reach = outline.points.iter().map(far).fold(0.0, f64::max);
    let nodal = matches!(law.coordinates(), Coordinates::Nodal { .. });
    Some(Solid { body, element, node, shape, reach, nodal })
}

/// For each node, the first of those that constraints hold together with it.
fn parts(model: &Model) -> Vec<usize> {
    let mut parts: Vec<usize> = (0..model.nodes.len()).collect();
    for e in model.elements.iter().filter(|e| matches!(e.body, Body::Constraint(_))) {
        let own: Vec<usize> = e.nodes.iter().map(|n| parts[*n]).collect();
        let Some(first) = own.iter().min().copied() else { continue };
        parts.iter_mut().filter(|p| own.contains(p)).for_each(|p| *p = first);
    }
    parts
}

/// Links between two nodes or what moves with them; none where the two move together.
fn between(model: &Model, parts: &[usize], a: usize, b: usize) -> Option<Vec<usize>> {
    let (a, b) = (parts[a], parts[b]);
    if a == b {
        return None;
    }
    let has = |nodes: &[usize], part: usize| nodes.iter().any(|n| parts[*n] == part);
    let both = links(model).filter(|(i, _)| {
        let nodes = &model.elements[*i].nodes;
        has(nodes, a) && has(nodes, b)
    });
    Some(both.map(|(i, _)| i).collect())
}

fn sum(a: Vector3, b: Vector3) -> Vector3 {
    [0, 1, 2].map(|i| a[i] + b[i])
}

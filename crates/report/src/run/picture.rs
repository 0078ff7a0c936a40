//! The model as points, lines, faces and marks.

use super::data::{FaceMark, Family, GroupMark, LineKind, LineMark, LinkMark, NodeMark, Picture};
use super::extruded::Outlines;
use super::thin_frame::joined;
use super::tints::Marks;
use std::collections::{BTreeMap, BTreeSet};
use trilith_element::{Contact, Dof, Kinematics, Link, NodalOutline, Vector3};
use trilith_model::{Body, Element, Model, Plane};

/// Nodes drawn one by one; of larger models members that were cut into elements are one line.
const NODES: usize = 1500;
/// Lines drawn at most.
const LINES: usize = 6000;

/// How a point of the picture moves.
#[derive(Clone, Copy, Debug)]
enum Mover {
    /// As a node.
    Node(usize),
    /// As a point at this distance from a node, with small rotations.
    Lever(usize, Vector3),
    /// As a point of the outline of a link: its index among all of them, and its place at rest from the
    /// link's first node.
    Outline(usize, usize, Vector3),
}

/// The picture, and how its points follow the model.
#[derive(Debug)]
pub(crate) struct Sketch {
    pub picture: Picture,
    /// What was left out.
    pub note: Option<String>,
    /// Which mark stands for which node or element.
    pub(super) marks: Marks,
    movers: Vec<Mover>,
}

impl Sketch {
    pub(crate) fn new(model: &Model) -> Self {
        let plane = model.plane.map(|p| {
            match p {
                Plane::XZ => "XZ",
                Plane::YZ => "YZ",
                Plane::XY => "XY",
            }
            .to_owned()
        });
        let picture = Picture { plane, ..Picture::default() };
        let mut build = Builder {
            model,
            picture,
            movers: Vec::new(),
            points: BTreeMap::new(),
            outlined: 0,
            marks: Marks::default(),
            outlines: Outlines::default(),
        };
        let note = build.members();
        for (i, e) in model.elements.iter().enumerate() {
            let faces = build.picture.faces.len();
            match &e.body {
                Body::Linear(_) => build.shape(e),
                Body::Constraint(c) => build.constraint(e, c.as_ref()),
                Body::Link(law, _) => {
                    build.marks.links.insert(i, build.picture.links.len());
                    build.link(e, law.as_ref());
                }
            }
            build.marks.faces.insert(i, (faces..build.picture.faces.len()).collect());
        }
        build.nodes();
        build.groups();
        build.picture.outlines = std::mem::take(&mut build.outlines.all);
        build.picture.ground = ground(model);
        Self { picture: build.picture, note, marks: build.marks, movers: build.movers }
    }

    /// Displacements of the points (X, Y, Z, point after point) from six of every node and the places of
    /// the outlines of links; without the latter these stay with their node.
    pub(crate) fn moved(&self, nodes: &[f32], outlines: &[[f32; 3]]) -> Vec<f64> {
        let of = |node: usize| -> [f64; 6] {
            [0, 1, 2, 3, 4, 5].map(|i| nodes.get(6 * node + i).copied().map_or(0.0, f64::from))
        };
        let lever = |node: usize, r: Vector3| {
            let u = of(node);
            [
                u[0] + u[4] * r[2] - u[5] * r[1],
                u[1] + u[5] * r[0] - u[3] * r[2],
                u[2] + u[3] * r[1] - u[4] * r[0],
            ]
        };
        let one = |mover: &Mover| match *mover {
            Mover::Node(n) => [of(n)[0], of(n)[1], of(n)[2]],
            Mover::Lever(n, r) => lever(n, r),
            Mover::Outline(n, i, rest) => match outlines.get(i) {
                Some(now) => [0, 1, 2].map(|k| f64::from(now[k]) - rest[k]),
                None => lever(n, rest),
            },
        };
        self.movers.iter().flat_map(one).collect()
    }
}

struct Builder<'m> {
    model: &'m Model,
    picture: Picture,
    movers: Vec<Mover>,
    /// Points of nodes that are drawn.
    points: BTreeMap<usize, usize>,
    /// Points of outlines of links so far.
    outlined: usize,
    marks: Marks,
    outlines: Outlines,
}

impl Builder<'_> {
    fn point(&mut self, node: usize) -> usize {
        if let Some(at) = self.points.get(&node) {
            return *at;
        }
        let at = self.add(self.model.nodes[node].position, Mover::Node(node));
        self.points.insert(node, at);
        at
    }

    fn add(&mut self, place: Vector3, mover: Mover) -> usize {
        self.picture.points.push(place);
        self.movers.push(mover);
        self.movers.len() - 1
    }

    /// Two-node members.
    fn members(&mut self) -> Option<String> {
        let model = self.model;
        let member = |(i, e): (usize, &Element)| match (&e.body, &e.nodes[..]) {
            (Body::Linear(_), [a, b]) if a != b && self.outlined(e).is_none() => {
                Some((i, [*a, *b]))
            }
            _ => None,
        };
        let mut lines: Vec<_> = model.elements.iter().enumerate().filter_map(member).collect();
        let mut note = None;
        if model.nodes.len() > NODES {
            let linked = model.elements.iter().filter(|e| matches!(e.body, Body::Link(..)));
            let needed: BTreeSet<usize> = linked.flat_map(|e| e.nodes.iter().copied()).collect();
            lines = joined(&lines, &needed);
            note = Some(format!(
                "The picture joins the elements of a member to one line: {} nodes are too many to be drawn one by one.",
                model.nodes.len()
            ));
        }
        if lines.len() > LINES {
            note = Some(format!("The picture shows {LINES} of {} members.", lines.len()));
            let all = lines.len();
            lines = (0..LINES).map(|i| lines[i * all / LINES]).collect();
        }
        for (i, [a, b]) in lines {
            let ends = [self.point(a), self.point(b)];
            let e = &model.elements[i];
            self.marks.lines.insert(i, self.picture.lines.len());
            self.line(e, LineKind::Member, ends);
        }
        note
    }

    fn line(&mut self, e: &Element, what: LineKind, ends: [usize; 2]) {
        let outline = if what == LineKind::Member { self.outlines.of(e) } else { None };
        self.picture.lines.push(LineMark { name: title(e), what, ends, outline });
    }

    /// The points of an outline, which begin at `first`, as faces and lines.
    fn paths(&mut self, e: &Element, paths: &[Vec<usize>], first: usize) {
        for path in paths {
            let at: Vec<usize> = path.iter().map(|i| first + i).collect();
            match at.split_last() {
                Some((end, corners)) if corners.len() > 2 && corners[0] == *end => {
                    self.picture.faces.push(FaceMark { name: title(e), corners: corners.to_vec() });
                }
                _ => at.windows(2).for_each(|w| self.line(e, LineKind::Edge, [w[0], w[1]])),
            }
        }
    }

    /// What an element or a constraint says that it looks like, in models whose nodes are drawn one by one.
    fn outlined(&self, e: &Element) -> Option<NodalOutline> {
        let all = matches!(e.body, Body::Constraint(_)) || self.model.nodes.len() <= NODES;
        e.outline(&self.model.nodes).filter(|_| all)
    }

    /// Draws what an element or a constraint says that it looks like.
    fn shape(&mut self, e: &Element) {
        let Some(NodalOutline { points, paths }) = self.outlined(e) else { return };
        let first = self.movers.len();
        for (node, r) in points {
            let node = e.nodes[node];
            self.add(sum(self.model.nodes[node].position, r), Mover::Lever(node, r));
        }
        self.paths(e, &paths, first);
    }

    fn constraint(&mut self, e: &Element, constraint: &dyn trilith_element::Constraint) {
        if self.outlined(e).is_some() {
            return self.shape(e);
        }
        let places: Vec<_> = e.nodes.iter().map(|n| self.model.nodes[*n].position).collect();
        if self.model.nodes.len() > NODES {
            return;
        }
        let equations = constraint.equations(&places).unwrap_or_default();
        let pairs: BTreeSet<(usize, usize)> = equations
            .iter()
            .flat_map(|q| q.terms.iter().map(|((n, _), _)| (e.nodes[*n], e.nodes[q.dependent.0])))
            .filter(|(a, b)| a != b)
            .collect();
        for (a, b) in pairs {
            let ends = [self.point(a), self.point(b)];
            self.line(e, LineKind::Tie, ends);
        }
    }

    fn link(&mut self, e: &Element, law: &dyn Link) {
        let ends: Vec<usize> = e.nodes.iter().map(|n| self.point(*n)).collect();
        let mut at = vec![0.0; law.history().len()];
        law.at_rest(&mut at);
        let still = vec![0.0; law.coordinates().len()];
        let rest = Kinematics::still(&still, &still);
        let outline = law.outline(&rest, &at);
        let body = outline.is_some();
        if let (Some(outline), Some(lead)) = (outline, e.nodes.first()) {
            let (first, base) = (self.movers.len(), self.model.nodes[*lead].position);
            for r in &outline.points {
                self.add(sum(base, *r), Mover::Outline(*lead, self.outlined, *r));
                self.outlined += 1;
            }
            self.paths(e, &outline.paths, first);
        }
        let family = family(law, &rest, &at);
        let (name, kind) = (e.name.clone(), e.kind.to_owned());
        self.picture.links.push(LinkMark { name, kind, family, ends, axis: e.frame.0[0], body });
    }

    /// Marks of the nodes that are drawn, and of all where there are few.
    fn nodes(&mut self) {
        if self.model.nodes.len() <= NODES {
            (0..self.model.nodes.len()).for_each(|n| {
                self.point(n);
            });
        }
        let mut fixed: BTreeMap<usize, [bool; 6]> = BTreeMap::new();
        for s in &self.model.supports {
            let all = fixed.entry(s.node).or_default();
            all.iter_mut().zip(s.fixed).for_each(|(a, b)| *a |= b);
        }
        let inside = |dof: Dof| self.model.plane.is_none_or(|p| p.dofs().contains(&dof));
        let words = |node: &usize| {
            let held = fixed.get(node).copied().unwrap_or_default();
            let names = Dof::ALL.iter().filter(|d| held[d.index()] && inside(**d));
            names.map(|d| d.name()).collect::<Vec<_>>().join(" ")
        };
        let mark = |(node, at): (&usize, &usize)| NodeMark {
            name: self.model.nodes[*node].name.clone(),
            at: *at,
            fixed: words(node),
        };
        self.picture.nodes = self.points.iter().map(mark).collect();
        self.marks.nodes = self.points.keys().enumerate().map(|(i, node)| (*node, i)).collect();
    }

    /// Groups, as far as they are in the picture.
    fn groups(&mut self) {
        let Marks { nodes, lines, links, faces } = &self.marks;
        for group in &self.model.groups {
            let of = |marks: &BTreeMap<usize, usize>| -> Vec<usize> {
                group.members.iter().filter_map(|i| marks.get(i).copied()).collect()
            };
            let name = group.name.clone();
            let mark = match group.of_nodes {
                true => GroupMark { name, nodes: of(nodes), ..GroupMark::default() },
                false => GroupMark {
                    name,
                    nodes: Vec::new(),
                    lines: of(lines),
                    faces: group
                        .members
                        .iter()
                        .filter_map(|i| faces.get(i))
                        .flatten()
                        .copied()
                        .collect(),
                    links: of(links),
                },
            };
            self.picture.groups.push(mark);
        }
    }
}

fn sum(a: Vector3, b: Vector3) -> Vector3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn title(e: &Element) -> String {
    format!("{} ({})", e.name, e.kind)
}

/// The family of a link as it lies at rest.
pub(crate) fn family_at_rest(law: &dyn Link) -> Family {
    let mut at = vec![0.0; law.history().len()];
    law.at_rest(&mut at);
    let still = vec![0.0; law.coordinates().len()];
    let rest = Kinematics::still(&still, &still);
    family(law, &rest, &at)
}

/// The family by what the law does, so that it holds for kinds of any crate.
fn family(law: &dyn Link, at: &Kinematics<'_>, history: &[f64]) -> Family {
    let n = law.coordinates().len();
    let (mut contacts, mut stiff): (Vec<Contact>, _) = (Vec::new(), vec![0.0; n * n]);
    law.contacts(at, history, &vec![0.0; n], &mut contacts);
    law.engaged_stiffness(&mut stiff);
    if !contacts.is_empty() {
        Family::Contact
    } else if stiff.iter().all(|k| *k == 0.0) {
        Family::Dashpot
    } else if history.is_empty() {
        Family::Spring
    } else {
        Family::Hysteretic
    }
}

/// The level that the model stands on: of fixed nodes, of links on the ground, of the feet of bodies.
fn ground(model: &Model) -> Option<f64> {
    if model.plane == Some(Plane::XY) {
        return None;
    }
    let held = model.supports.iter().filter(|s| s.fixed[Dof::Uz.index()]).map(|s| s.node);
    let standing = model.elements.iter().filter(|e| {
        matches!(e.body, Body::Link(..)) && e.nodes.len() == 1 && e.frame.0[0][2].abs() > 0.9
    });
    let feet = standing.flat_map(|e| {
        let z = model.nodes[e.nodes[0]].position[2];
        let Body::Link(law, _) = &e.body else { return vec![z] };
        let mut at = vec![0.0; law.history().len()];
        law.at_rest(&mut at);
        let still = vec![0.0; law.coordinates().len()];
        let rest = Kinematics::still(&still, &still);
        match law.outline(&rest, &at) {
            Some(outline) => outline.points.iter().map(|p| z + p[2]).collect(),
            None => vec![z],
        }
    });
    let levels = held.map(|n| model.nodes[n].position[2]).chain(feet);
    levels.min_by(f64::total_cmp)
}

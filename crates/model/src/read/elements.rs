//! Elements, constraints and links.

use super::context::{Context, Fields};
use super::members;
use super::names::Names;
use super::values::{Given, values};
use crate::diagnostic::names_help;
use crate::registry::Reader;
use crate::schema;
use crate::sections::Shape;
use crate::tree::{Entry, Kind, Node};
use crate::{Body, Element, LinkOptions, Span};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::sync::Arc;
use trilith_element::dimension::{MOMENT, NONE, STIFFNESS};
use trilith_element::{
    Card, Coordinates, Form, Frame, Geometry, LinearElement, Link, NodeCount, ParameterError,
    Range, ReadLinear, Value, Values, Vector3,
};

struct Reading<'c, 'n> {
    c: &'c Context<'c>,
    sets: Names<'n>,
    properties: &'n [Entry],
    names: &'c Names<'n>,
    nodes: &'c [Option<crate::Node>],
    /// What was met last: most elements of a model share a few sets of parameter values.
    met: RefCell<VecDeque<Met>>,
}

/// Parameter values, and the linear element that a kind makes of them.
struct Met {
    values: Arc<Values>,
    linear: Option<(&'static str, Arc<dyn LinearElement>)>,
}

/// Sets of parameter values that are looked through for an equal one.
const MET: usize = 16;

pub(super) fn elements<'n>(
    c: &Context<'_>,
    entries: &'n [Entry],
    properties: &'n [Entry],
    names: &Names<'n>,
    nodes: &[Option<crate::Node>],
) -> Vec<Option<Element>> {
    let sets = Names::new("property set", "property sets", properties);
    let reading = Reading { c, sets, properties, names, nodes, met: RefCell::default() };
    for e in properties {
        // Known kind and known fields; values are read where the set is used.
        if let Some((card, _)) = kind(c, &e.value) {
            let what = format!("property set `{}`", e.key);
            let _ = c.fields(&e.value, &what, &allowed(card, &[]));
        }
    }
    entries.iter().map(|e| reading.element(e)).collect()
}

/// The kind that a value names.
fn kind<'c>(c: &'c Context<'_>, node: &Node) -> Option<(&'static Card, &'c Reader)> {
    let Some(name) = node.name() else {
        return c.wrong(node, "a kind with its parameters, `Kind(…)`,");
    };
    let offered = c.registry.find(name);
    let found = offered.filter(|(card, _)| c.registry.elements().any(|of| of.kind == card.kind));
    if found.is_none() {
        let kinds: Vec<&str> = c.registry.elements().map(|card| card.kind).collect();
        let span = node.name_span();
        let mut d = c
            .diagnostic("E0107", format!("there is no kind `{name}`"), span.clone())
            .help(names_help(name, "kinds", kinds.iter().copied()));
        if let Some(near) = crate::diagnostic::closest(name, kinds) {
            d = d.suggestion(span, near);
        }
        c.report(d);
    }
    found
}

pub(super) fn allowed(card: &Card, place: &[&'static str]) -> Vec<&'static str> {
    let mut all: Vec<&str> = place.to_vec();
    all.extend(card.parameters.iter().map(|p| p.name));
    all.extend(schema::beside(card).into_iter().flat_map(schema::Block::names));
    all
}

/// True where files of the kind have names of their own for its nodes.
fn labelled(card: &Card) -> bool {
    card.parameters.iter().any(|p| p.form == Form::Labels)
}

/// The entries of nodes that are given by labels: those of a map, which may look like fields where all labels are words.
fn keyed(nodes: &Node) -> Option<&[Entry]> {
    match &nodes.kind {
        Kind::Map(entries) | Kind::Fields(None, entries) => Some(entries),
        _ => None,
    }
}

/// What the cross-section of a member looks like: as its own section says, by its sides, or as the set says that it uses.
fn shape(card: &Card, given: &Given<'_>, values: &Values) -> Option<Shape> {
    let [own, shared] = &given.made;
    let sides = || match (values.number("width"), values.number("depth")) {
        (Some(width), Some(depth)) => Some(Shape::Rectangle { width, depth }),
        _ => None,
    };
    own.shape.or_else(sides).or(shared.shape).filter(|_| schema::is_member(card))
}

impl Reading<'_, '_> {
    fn element(&self, e: &Entry) -> Option<Element> {
        let c = self.c;
        let (card, reader) = kind(c, &e.value)?;
        let what = format!("element `{}`", e.key);
        let fields = c.fields(&e.value, &what, &allowed(card, &schema::PLACE.names()))?;
        let at = e.value.name_span();
        let shared = match fields.get("use") {
            Some(node) => self.shared(node, card),
            None => Some(&[][..]),
        };
        let nodes = self.members(&fields, card, &what, &at);
        let given = self.given(&fields, card, shared?, &what)?;
        let values = values(c, card, &given, &what, &at, self.names);
        let axis = |key: &'static str| match given.get(key) {
            None => Some(None),
            Some(node) => c.vector(node, key, NONE).map(Some),
        };
        let (axis1, axis2) = (axis("axis1"), axis("axis2"));
        let (nodes, mut values) = (nodes?, values?);
        if let Some(p) = card.parameters.iter().find(|p| p.form == Form::Labels) {
            self.label(p.name, &fields, &nodes, &mut values, &what)?;
        }
        let positions: Option<Vec<Vector3>> =
            nodes.iter().map(|&i| self.nodes[i].as_ref().map(|n| n.position)).collect();
        let (axis1, axis2) = (axis1?, axis2?);
        let positions = positions?;
        let frame = match Frame::of_nodes(&positions, axis1, axis2) {
            Ok(frame) => Some(frame),
            Err(error) => {
                let place = given.get("axis2").or(given.get("axis1"));
                let span = place.map_or(at.clone(), |n| n.span.clone());
                c.report(c.diagnostic("E0114", format!("{what}: {error}"), span));
                None
            }
        };
        let frame = frame?;
        let place = Geometry::new(&positions, frame);
        let section = shape(card, &given, &values);
        let values = self.shared_values(values);
        let body = match reader {
            Reader::Linear(read) => self.linear(card, &values, read).map(Body::Linear),
            Reader::Constraint(read) => read(&values).map(Body::Constraint),
            Reader::Link(read) => read(&values).and_then(|mut law| {
                law.place(&place)?;
                Ok(Body::Link(Arc::from(law), LinkOptions::default()))
            }),
            // No kind of elements, as `kind` has said.
            Reader::Function(_) | Reader::Output(_) | Reader::Solver(_) => return None,
        };
        let body = match body {
            Ok(Body::Link(law, _)) => {
                let options = self.link_options(&given, law.as_ref(), &what, &at, nodes.len())?;
                Body::Link(law, options)
            }
            Ok(body) => body,
            Err(error) => return self.refuse(&error, &given, &what, &at),
        };
        Some(Element {
            name: e.key.clone(),
            kind: card.kind,
            nodes,
            frame,
            body,
            span: e.key_span.clone(),
            values,
            axes: [axis1, axis2],
            section,
        })
    }

    /// The fields of an element and of the set that it uses, and what sections and materials make of them.
    fn given<'f>(
        &self,
        fields: &Fields<'f>,
        card: &Card,
        shared: &'f [Entry],
        what: &str,
    ) -> Option<Given<'f>> {
        let own = fields.entries();
        let of_own = members::made(self.c, card, own, what);
        let of_shared = members::made(self.c, card, shared, what);
        Some(Given { own, shared, made: [of_own?, of_shared?] })
    }

    /// The same values, in one place for all elements that have them.
    fn shared_values(&self, values: Values) -> Arc<Values> {
        let mut met = self.met.borrow_mut();
        if let Some(same) = met.iter().find(|it| *it.values == values) {
            return Arc::clone(&same.values);
        }
        let values = Arc::new(values);
        if met.len() == MET {
            met.pop_front();
        }
        met.push_back(Met { values: Arc::clone(&values), linear: None });
        values
    }

    /// The linear element that a kind makes of [shared values](Self::shared_values), one for all that have them.
    fn linear(
        &self,
        card: &Card,
        values: &Arc<Values>,
        read: &ReadLinear,
    ) -> Result<Arc<dyn LinearElement>, ParameterError> {
        let is_same = |it: &Met| Arc::ptr_eq(&it.values, values);
        let known =
            self.met.borrow().iter().find(|it| is_same(it)).and_then(|it| it.linear.clone());
        if let Some((_, made)) = known.filter(|(kind, _)| *kind == card.kind) {
            return Ok(made);
        }
        let made: Arc<dyn LinearElement> = Arc::from(read(values)?);
        if let Some(same) = self.met.borrow_mut().iter_mut().find(|it| is_same(it)) {
            same.linear = Some((card.kind, Arc::clone(&made)));
        }
        Ok(made)
    }

    fn refuse<T>(
        &self,
        error: &ParameterError,
        given: &Given<'_>,
        what: &str,
        at: &Span,
    ) -> Option<T> {
        let place = error.parameter().and_then(|name| given.get(name));
        let span = place.map_or(at.clone(), |n| n.span.clone());
        self.c.report(self.c.diagnostic("E0114", format!("{what}: {error}"), span));
        None
    }

    /// The fields of the set that an element uses.
    fn shared(&self, node: &Node, card: &Card) -> Option<&[Entry]> {
        let i = self.sets.refer(self.c, node)?;
        let set = &self.properties[i];
        let name = set.value.name()?;
        if name != card.kind {
            let message =
                format!("property set `{}` is for {name}, this element is {}", set.key, card.kind);
            let d = self.c.diagnostic("E0107", message, node.span.clone());
            self.c.report(d.related(set.value.name_span(), "the kind of the set"));
            return None;
        }
        match &set.value.kind {
            crate::tree::Kind::Fields(_, entries) => Some(entries),
            _ => Some(&[]),
        }
    }

    /// Indices of the element's nodes.
    fn members(
        &self,
        fields: &Fields<'_>,
        card: &Card,
        what: &str,
        at: &Span,
    ) -> Option<Vec<usize>> {
        let c = self.c;
        let items: Vec<&Node> = match (fields.get("nodes"), fields.get("node")) {
            (Some(_), Some(one)) => {
                let d = c.diagnostic(
                    "E0102",
                    format!("{what} has `nodes` and `node`"),
                    one.span.clone(),
                );
                c.report(d.help("keep one of the two"));
                return None;
            }
            (Some(list), None) => match keyed(list).filter(|_| labelled(card)) {
                Some(entries) => entries.iter().map(|e| &e.value).collect(),
                None => list.items(),
            },
            (None, Some(one)) => vec![one],
            (None, None) => return fields.required(c, "nodes").and(None),
        };
        // A group in a list stands for its members, the only node is one.
        let of_list = fields.get("nodes").is_some_and(|n| keyed(n).is_none());
        let mut found: Vec<(&Node, Option<usize>)> = Vec::with_capacity(items.len());
        for item in items {
            match self.names.group(item).filter(|_| of_list) {
                Some((members, true)) => found.extend(members.iter().map(|i| (item, Some(*i)))),
                _ => found.push((item, self.names.refer(c, item))),
            }
        }
        let NodeCount { min, max } = card.nodes;
        if !(min..=max).contains(&found.len()) {
            let wanted = match (min, max) {
                (a, b) if a == b => format!("{a}"),
                (a, usize::MAX) => format!("{a} or more"),
                (a, b) => format!("{a} to {b}"),
            };
            let message = format!("{what} has {} nodes: {} takes {wanted}", found.len(), card.kind);
            let place = fields.get("nodes").or(fields.get("node"));
            let span = place.map_or(at.clone(), |n| n.span.clone());
            c.report(c.diagnostic("E0115", message, span));
            return None;
        }
        let all: Vec<usize> = found.iter().map(|(_, i)| *i).collect::<Option<_>>()?;
        let mut sorted: Vec<usize> = (0..all.len()).collect();
        sorted.sort_by_key(|k| (all[*k], *k));
        if let Some(twice) = sorted.windows(2).find(|two| all[two[0]] == all[two[1]]) {
            let [before, again] = [0, 1].map(|k| found[twice[k]].0.span.clone());
            let message = format!("{what} has the node `{}` twice", self.names.name(all[twice[0]]));
            c.report(c.diagnostic("E0115", message, again).related(before, "first given here"));
            return None;
        }
        Some(all)
    }

    /// What the files of an element call its nodes: keys of `nodes`, the field of that name, or the names of the nodes.
    fn label(
        &self,
        name: &str,
        fields: &Fields<'_>,
        nodes: &[usize],
        values: &mut Values,
        what: &str,
    ) -> Option<()> {
        let c = self.c;
        let keys = fields.get("nodes").and_then(keyed);
        if let (Some(_), Some(given)) = (keys, fields.get(name)) {
            let message = format!("{what} gives labels as keys of `nodes`, and `{name}`");
            let d = c.diagnostic("E0102", message, given.span.clone());
            c.report(d.help("keep one of the two"));
            return None;
        }
        if let Some(Value::List(given)) = values.get(name) {
            if given.len() == nodes.len() {
                return Some(());
            }
            let (labels, nodes) = (given.len(), nodes.len());
            let message =
                format!("{what} has {labels} `{name}` and {nodes} nodes: must have as many");
            let span = fields.get(name).map(|n| n.span.clone())?;
            c.report(c.diagnostic("E0105", message, span));
            return None;
        }
        let texts: Vec<Value> = match keys {
            Some(entries) => entries.iter().map(|e| Value::Text(e.key.clone())).collect(),
            None => nodes.iter().map(|i| Value::Text(self.names.name(*i).to_owned())).collect(),
        };
        values.0.push((name.to_owned(), Value::List(texts)));
        Some(())
    }

    fn link_options(
        &self,
        given: &Given<'_>,
        law: &dyn Link,
        what: &str,
        at: &Span,
        nodes: usize,
    ) -> Option<LinkOptions> {
        let c = self.c;
        let coordinates = law.coordinates();
        let misfit = match &coordinates {
            Coordinates::Local(_) if nodes > 2 => {
                Some(format!("{what} has {nodes} nodes: its law works between two"))
            }
            Coordinates::Nodal { nodes: wanted } if *wanted != nodes => {
                Some(format!("{what} has {nodes} nodes: its law wants {wanted}"))
            }
            _ => None,
        };
        if let Some(message) = misfit {
            c.report(c.diagnostic("E0115", message, at.clone()));
            return None;
        }
        let shear_at = match given.get("shear_at") {
            Some(node) => c.lever(node, "shear_at"),
            None => Some(0.0),
        };
        let effective_stiffness = match given.get("effective_stiffness") {
            Some(node) => self.effective_stiffness(node, &coordinates).map(Some),
            None => Some(None),
        };
        let p_delta_at = match given.get("p_delta_at") {
            Some(node) => self.p_delta_at(node).map(Some),
            None => Some(None),
        };
        Some(LinkOptions {
            effective_stiffness: effective_stiffness?,
            shear_at: shear_at?,
            p_delta_at: p_delta_at?,
        })
    }

    /// Two shares, not more than 1 in sum.
    fn p_delta_at(&self, node: &Node) -> Option<[f64; 2]> {
        let c = self.c;
        let items = node.items();
        let [i, j] = items[..] else {
            return c.wrong(node, "two shares `(first node, second node)`");
        };
        let share = |item| c.ranged(item, "p_delta_at", NONE, Range::Within(0.0, 1.0));
        let (i, j) = (share(i), share(j));
        let shares = [i?, j?];
        let sum: f64 = shares.iter().sum();
        if sum > 1.0 + 1e-9 {
            let message = format!("`p_delta_at`: the shares are {sum} in sum, must be at most 1");
            c.report(c.diagnostic("E0112", message, node.span.clone()));
            return None;
        }
        Some(shares)
    }

    /// One number for all coordinates, or a list with one for each.
    fn effective_stiffness(&self, node: &Node, coordinates: &Coordinates) -> Option<Vec<f64>> {
        let n = coordinates.len();
        let rotation = |i: usize| match coordinates {
            Coordinates::Local(axes) => axes[i].index() > 2,
            Coordinates::Nodal { .. } => i % 6 > 2,
        };
        let items = if node.is_list() { node.items() } else { vec![node; n] };
        if items.len() != n {
            let message = format!(
                "`effective_stiffness` has {} numbers: the law has {n} coordinates",
                items.len()
            );
            self.c.report(self.c.diagnostic("E0105", message, node.span.clone()));
            return None;
        }
        let read: Vec<_> = items
            .iter()
            .enumerate()
            .map(|(i, item)| {
                let dimension = if rotation(i) { MOMENT } else { STIFFNESS };
                self.c.ranged(item, "effective_stiffness", dimension, Range::NonNegative)
            })
            .collect();
        read.into_iter().collect()
    }
}

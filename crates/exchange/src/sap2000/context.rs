//! What the parts of a reader share.

use super::database::{Database, Entry};
use super::geometry::{Axes, GLOBAL, Vector};
use crate::draft::Draft;
use crate::report::Report;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Forces and moments of nodes.
pub type Forces = BTreeMap<usize, [f64; 6]>;

/// A model in the making, with what the tables say of its joints.
pub struct Context<'a> {
    pub db: &'a Database,
    pub draft: Draft,
    pub report: Report,
    /// Node of each joint.
    pub joints: HashMap<&'a str, usize>,
    /// Local axes of the joints that have other ones than the global.
    pub axes: HashMap<usize, Axes>,
    /// Coordinate systems: origin and axes.
    pub systems: HashMap<&'a str, (Vector, Axes)>,
    /// Directions that any joint can move in.
    pub active: [bool; 6],
    /// Load patterns.
    pub patterns: BTreeMap<&'a str, Forces>,
    /// Joint forces that do what loads along frames do, by pattern: mass may be made of them.
    pub spread: BTreeMap<&'a str, Forces>,
    /// Displacements of the ground, by pattern.
    pub ground: BTreeMap<&'a str, Forces>,
    /// Nodes whose motion is of interest.
    pub watched: Vec<usize>,
    /// Names of nodes.
    pub taken: HashSet<String>,
}

impl<'a> Context<'a> {
    pub fn new(db: &'a Database) -> Self {
        Self {
            db,
            draft: Draft::default(),
            report: Report::default(),
            joints: HashMap::new(),
            axes: HashMap::new(),
            systems: HashMap::from([("GLOBAL", ([0.0; 3], GLOBAL))]),
            active: [true; 6],
            patterns: BTreeMap::new(),
            spread: BTreeMap::new(),
            ground: BTreeMap::new(),
            watched: Vec::new(),
            taken: HashSet::new(),
        }
    }

    /// The node of a joint that a row names.
    pub fn joint(&self, row: Entry<'a>, key: &str) -> Option<usize> {
        let name = row.need(key);
        let found = self.joints.get(name).copied();
        if found.is_none() && !name.is_empty() {
            let message = format!("there is no joint \"{name}\"");
            row.wrong_at(key, &message, "joints stand in the table JOINT COORDINATES");
        }
        found
    }

    /// Name of a node.
    pub fn name(&self, node: usize) -> &str {
        &self.draft.nodes[node].0
    }

    /// Position of a node.
    pub fn at(&self, node: usize) -> Vector {
        self.draft.nodes[node].1
    }

    /// Axes of a node.
    pub fn axes_of(&self, node: usize) -> Axes {
        self.axes.get(&node).copied().unwrap_or(GLOBAL)
    }

    /// A node that no joint is at, by a name of its own.
    pub fn new_node(&mut self, name: &str, at: Vector) -> usize {
        let mut name = name.to_owned();
        while !self.taken.insert(name.clone()) {
            name.push('\'');
        }
        self.draft.nodes.push((name, at));
        self.draft.nodes.len() - 1
    }

    /// Notes that a node's motion is of interest.
    pub fn watch(&mut self, node: usize) {
        if !self.watched.contains(&node) {
            self.watched.push(node);
        }
    }

    /// Adds to a pattern.
    pub fn add(&mut self, pattern: &'a str, node: usize, forces: [f64; 6]) {
        let to = self.patterns.entry(pattern).or_default().entry(node).or_default();
        to.iter_mut().zip(forces).for_each(|(a, b)| *a += b);
    }

    /// Axes of the coordinate system that a row names: `local` for `Local`.
    pub fn system(&mut self, row: Entry<'a>, local: Axes) -> Axes {
        match row.text("CoordSys").unwrap_or("GLOBAL") {
            "Local" | "Joint Local" => local,
            name => match self.systems.get(name) {
                Some((_, axes)) => *axes,
                None => {
                    let message = format!("there is no coordinate system \"{name}\"");
                    row.wrong_at("CoordSys", &message, "they stand in COORDINATE SYSTEMS");
                    GLOBAL
                }
            },
        }
    }
}

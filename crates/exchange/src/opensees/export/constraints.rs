//! Constraints as multi-point constraints, each node following one other at most.
//!
//! The handler `Transformation` knows no chains: a node that is followed follows none. Bodies that hang on each other
//! become one.

use super::command::{Command, Word};
use super::members::choice;
use super::{ExportError, Writer};
use std::collections::{BTreeSet, HashMap};
use trilith_element::Dof;
use trilith_model::{Body, Element};

/// How a node follows another one.
#[derive(Clone, Debug, PartialEq)]
enum How {
    Rigid,
    Floor(usize),
    Equal(Vec<usize>),
}

/// A node that follows.
#[derive(Clone, Debug)]
struct Follower {
    element: usize,
    leader: usize,
    node: usize,
    how: How,
}

/// What constraints say: commands, and which directions follow which.
#[derive(Default)]
pub(super) struct Followers {
    pub commands: Vec<Command>,
    /// Of a direction that follows, as 6 · node + direction: what it is made of.
    pub of: HashMap<usize, Vec<(usize, f64)>>,
    /// Nodes that are followed.
    pub leaders: BTreeSet<usize>,
}

impl Writer<'_> {
    /// Reads all constraints.
    pub(super) fn constraints(&mut self) -> Result<Followers, ExportError> {
        let model = self.model;
        let mut all: Vec<Follower> = Vec::new();
        for (index, e) in model.elements.iter().enumerate() {
            if let Body::Constraint(_) = &e.body {
                match self.followers(index, e) {
                    Ok(more) => {
                        self.count(e.kind);
                        all.extend(more);
                    }
                    Err(why) => self.losses.lost(e.kind, &e.name, &why),
                }
            }
        }
        flatten(&mut all);
        let leads = |node: usize| all.iter().any(|f| f.leader == node);
        let follows = |node: usize| all.iter().filter(|f| f.node == node).count();
        let wrong: Vec<usize> = all
            .iter()
            .filter(|f| follows(f.node) > 1 || leads(f.node))
            .map(|f| f.element)
            .collect();
        for index in wrong {
            let e = &model.elements[index];
            let why =
                "a node that follows two others, or one that follows itself, is not followed there";
            self.losses.lost(e.kind, &e.name, why);
            all.retain(|f| f.element != index);
        }
        let mut out = Followers::default();
        for f in &all {
            out.leaders.insert(f.leader);
            self.follower(f, &mut out);
        }
        Ok(out)
    }

    fn followers(&self, element: usize, e: &Element) -> Result<Vec<Follower>, String> {
        let leader = e.nodes[0];
        let how = match e.kind {
            "RigidLink" if super::members::flag(&e.values, "translations_only") => {
                return Err("rigidLink there leaves no rotation free".into());
            }
            "RigidBody" | "RigidLink" => How::Rigid,
            "Diaphragm" => {
                let normal = ["X", "Y", "Z"].iter().position(|n| *n == choice(&e.values, "normal"));
                let normal = normal.unwrap_or(2);
                let height = |n: usize| self.model.nodes[n].position[normal];
                if e.nodes.iter().any(|n| (height(*n) - height(leader)).abs() > 1e-9) {
                    return Err("the nodes of a rigid diaphragm lie in one plane there".into());
                }
                How::Floor(normal)
            }
            "EqualDof" => {
                let named = |t: &trilith_element::Value| match t {
                    trilith_element::Value::Text(t) => Dof::ALL.iter().position(|d| d.name() == t),
                    _ => None,
                };
                let dofs = match e.values.get("dofs") {
                    Some(trilith_element::Value::List(all)) => {
                        all.iter().filter_map(named).collect()
                    }
                    Some(one) => named(one).into_iter().collect(),
                    None => Vec::new(),
                };
                How::Equal(dofs)
            }
            _ => return Err("no constraint there is the same".into()),
        };
        let one = |node: &usize| Follower { element, leader, node: *node, how: how.clone() };
        Ok(e.nodes[1..].iter().map(one).collect())
    }

    /// The command of a follower, and what its directions are made of.
    fn follower(&self, f: &Follower, out: &mut Followers) {
        let [leader, node] = [self.node(f.leader), self.node(f.node)];
        let at = |n: usize| self.model.nodes[n].position;
        let r: [f64; 3] = std::array::from_fn(|k| at(f.node)[k] - at(f.leader)[k]);
        let (lead, own) = (6 * f.leader, 6 * f.node);
        // u = u + θ × r.
        let moved = |k: usize| -> Vec<(usize, f64)> {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            vec![(lead + k, 1.0), (lead + 3 + a, r[b]), (lead + 3 + b, -r[a])]
        };
        let turned = |k: usize| vec![(lead + k, 1.0)];
        let command = match &f.how {
            How::Rigid => {
                out.of.extend((0..3).map(|k| (own + k, moved(k))));
                out.of.extend((3..6).map(|k| (own + k, turned(k))));
                Command::new("rigidLink", [Word::from("beam"), leader.into(), node.into()])
            }
            How::Floor(normal) => {
                let n = *normal;
                for k in (0..3).filter(|k| *k != n) {
                    let mut terms = moved(k);
                    terms.retain(|(i, _)| *i == lead + k || *i == lead + 3 + n);
                    out.of.insert(own + k, terms);
                }
                out.of.insert(own + 3 + n, turned(3 + n));
                Command::new("rigidDiaphragm", [n as i64 + 1, leader, node].map(Word::from))
            }
            How::Equal(dofs) => {
                out.of.extend(dofs.iter().map(|k| (own + k, turned(*k))));
                let command = Command::new("equalDOF", [leader, node].map(Word::from));
                command.all(dofs.iter().map(|k| *k as i64 + 1))
            }
        };
        out.commands.push(command.remark(&self.model.elements[f.element].name));
    }
}

/// Bodies that hang on each other follow the first node of all.
fn flatten(all: &mut [Follower]) {
    for _ in 0..all.len() {
        let mut changed = false;
        for i in 0..all.len() {
            if all[i].how != How::Rigid {
                continue;
            }
            let leader = all[i].leader;
            let up = all.iter().find(|f| f.node == leader && f.how == How::Rigid).map(|f| f.leader);
            if let Some(up) = up.filter(|up| *up != all[i].node) {
                all[i].leader = up;
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
}

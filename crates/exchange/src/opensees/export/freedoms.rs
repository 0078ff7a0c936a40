//! Which directions of nodes are free, held, or follow others; masses.

use super::command::{Command, Word};
use super::constraints::Followers;
use super::members::matrices;
use super::{ExportError, Writer};
use std::collections::HashMap;
use trilith_element::{Coordinates, Dof, cross, norm, sub};
use trilith_model::{Body, Element};

/// Stiffness of a stay, N/m and N·m.
const STAY: f64 = 1e6;

/// Freedoms of a script.
pub(super) struct Freedoms {
    /// By 6 · node + direction.
    pub held: Vec<bool>,
    pub followers: Followers,
    /// Springs that stand for held directions of nodes that are followed.
    pub stays: Vec<Command>,
    /// Masses of nodes, by direction.
    pub mass: Vec<f64>,
    /// Weight by direction: what one unit of gravity along −Z does.
    pub weight: Vec<f64>,
    /// Equations.
    pub equations: usize,
    /// Directions with a mass, or followed by one.
    pub modes: usize,
    /// Free directions that neither mass nor structure holds: links alone do.
    pub linked: Vec<usize>,
}

impl Freedoms {
    /// Held directions, constraints and masses of what was written.
    pub fn of(writer: &mut Writer<'_>) -> Result<Self, ExportError> {
        let model = writer.model;
        let n = 6 * model.nodes.len();
        let followers = writer.constraints()?;
        let (mut mass, mut weight) = (vec![0.0; n], vec![0.0; n]);
        let (mut stiff, mut used, mut heavy) = (vec![false; n], vec![false; n], vec![false; n]);
        for (index, e) in model.elements.iter().enumerate() {
            match &e.body {
                Body::Linear(_) => {
                    if e.kind != "Mass" && !writer.elements.contains_key(&index) {
                        continue;
                    }
                    let Some(m) = matrices(writer, e)? else { continue };
                    let full = |p: usize| 6 * e.nodes[m.dofs[p].0] + m.dofs[p].1.index();
                    let spread = Writer::spread_mass(e) != 0.0;
                    let mut coupled = false;
                    for p in 0..m.dofs.len() {
                        let i = full(p);
                        used[i] = true;
                        stiff[i] |= m.stiffness[(p, p)] != 0.0;
                        heavy[i] |= m.mass[(p, p)] != 0.0 || m.inertance[(p, p)] != 0.0;
                        for q in 0..m.dofs.len() {
                            let x = m.mass[(p, q)];
                            if m.dofs[q].1 == Dof::Uz {
                                weight[i] -= x;
                            }
                            if !spread && p == q {
                                mass[i] += x;
                            }
                            let size = m.mass[(p, p)].max(m.mass[(q, q)]);
                            coupled |= p != q && x.abs() > 1e-12 * size;
                        }
                    }
                    if coupled && !spread {
                        let why = "masses of nodes there have no products of inertia";
                        writer.losses.lost(e.kind, &e.name, why);
                    }
                }
                Body::Link(law, _) if writer.elements.contains_key(&index) => {
                    if let Coordinates::Local(axes) = law.coordinates() {
                        let rows = axes.iter().flat_map(|a| row(writer, e, a.index()));
                        rows.for_each(|(i, _)| used[i] = true);
                    }
                }
                _ => {}
            }
        }
        // What follows is used where it is, and so is what it follows.
        for (own, terms) in &followers.of {
            for (i, c) in terms.iter().filter(|(_, c)| *c != 0.0) {
                used[*i] |= used[*own];
                stiff[*i] |= stiff[*own];
                heavy[*i] |= heavy[*own] && c.abs() > 1e-9;
            }
        }
        let mut held = vec![false; n];
        for support in &model.supports {
            for k in (0..6).filter(|k| support.fixed[*k]) {
                held[6 * support.node + k] = true;
            }
        }
        if let Some(plane) = model.plane {
            let inside = plane.dofs().map(Dof::index);
            (0..n).filter(|i| !inside.contains(&(i % 6))).for_each(|i| held[i] = true);
        }
        for i in 0..n {
            held[i] |= !used[i];
            if let Some(terms) = followers.of.get(&i) {
                let free = terms.iter().any(|(j, c)| *c != 0.0 && !held[*j] && used[*j]);
                let meant = model.supports.iter().any(|s| s.node == i / 6 && s.fixed[i % 6]);
                if free && meant {
                    let node = &model.nodes[i / 6].name;
                    let why = "a direction that follows another one cannot be held there as well";
                    writer.losses.lost("support", node, why);
                }
                held[i] = false;
            }
        }
        // What does not move needs no mass, and would have modes of its own on a stay.
        let still = |i: &usize| match followers.of.get(i) {
            Some(terms) => terms.iter().all(|(j, c)| *c == 0.0 || held[*j]),
            None => held[*i],
        };
        (0..n).filter(still).for_each(|i| mass[i] = 0.0);
        let free = |i: &usize| !held[*i] && !followers.of.contains_key(i);
        let linked = (0..n).filter(free).filter(|i| !stiff[*i] && !heavy[*i]).collect();
        let equations = (0..n).filter(free).count();
        let modes = (0..n).filter(free).filter(|i| heavy[*i]).count();
        let mut out =
            Self { held, followers, stays: Vec::new(), mass, weight, equations, modes, linked };
        out.stay(writer, &used);
        Ok(out)
    }

    /// A node that others follow must not be held in single directions: `Transformation` of OpenSees 3.7 loses what its
    /// followers have moved so far. A spring holds it where nothing else acts, which is the same.
    fn stay(&mut self, writer: &mut Writer<'_>, used: &[bool]) {
        let model = writer.model;
        let out_of_plane =
            |k: usize| model.plane.is_some_and(|p| !p.dofs().map(Dof::index).contains(&k));
        for node in self.followers.leaders.clone() {
            let own: Vec<usize> = (0..6).filter(|k| self.held[6 * node + k]).collect();
            if own.is_empty() {
                continue;
            }
            if own.iter().any(|k| used[6 * node + k] && !out_of_plane(*k)) {
                let why = "a node that others follow cannot be held in single directions there";
                writer.losses.lost("support", &model.nodes[node].name, why);
                continue;
            }
            let (ground, material, element) =
                (writer.on_ground(node), writer.material(), writer.element());
            let elastic = [Word::from("Elastic"), material.into(), STAY.into()];
            self.stays.push(Command::new("uniaxialMaterial", elastic));
            let stay = Command::new("element", [Word::from("zeroLength"), element.into()])
                .all([ground, writer.node(node)])
                .with("-mat")
                .all(own.iter().map(|_| material))
                .with("-dir")
                .all(own.iter().map(|k| *k as i64 + 1));
            let why = format!(
                "holds {}, which others follow, where nothing else acts",
                model.nodes[node].name
            );
            self.stays.push(stay.remark(why));
            self.equations += own.len();
            own.iter().for_each(|k| self.held[6 * node + k] = false);
        }
    }

    /// Commands for what is held, for constraints and masses.
    pub fn commands(&self, writer: &Writer<'_>) -> [Vec<Command>; 3] {
        let mut fixed = Vec::new();
        let mut masses = Vec::new();
        for (node, n) in writer.model.nodes.iter().enumerate() {
            let own = 6 * node..6 * node + 6;
            if self.held[own.clone()].iter().any(|h| *h) {
                let flags = self.held[own.clone()].iter().map(|h| i64::from(*h));
                fixed.push(
                    Command::new("fix", [writer.node(node).into()]).all(flags).remark(&n.name),
                );
            }
            if self.mass[own.clone()].iter().any(|m| *m != 0.0) {
                let all = self.mass[own].iter().copied();
                masses.push(
                    Command::new("mass", [writer.node(node).into()]).all(all).remark(&n.name),
                );
            }
        }
        for k in 0..writer.ground.len() {
            let tag = (writer.model.nodes.len() + k + 1) as i64;
            fixed.push(Command::new("fix", [tag.into()]).all([1; 6]).remark("ground"));
        }
        [fixed, self.followers.commands.clone(), masses]
    }
}

/// What a deformation of a link along or about a local axis is made of: 6 · node + direction, and a factor.
pub(super) fn row(writer: &Writer<'_>, e: &Element, axis: usize) -> Vec<(usize, f64)> {
    let nodes = &writer.model.nodes;
    let (i, j) = match e.nodes[..] {
        [i, j] => (Some(i), j),
        _ => (None, e.nodes[0]),
    };
    let along = e.frame.0[axis % 3];
    let mut sum: HashMap<usize, f64> = HashMap::new();
    let mut add = |node: usize, v: [f64; 3], part: usize, c: f64| {
        for (k, x) in v.iter().enumerate().filter(|(_, x)| x.abs() > 1e-12) {
            *sum.entry(6 * node + part + k).or_default() += c * x;
        }
    };
    let part = 3 * (axis / 3);
    add(j, along, part, 1.0);
    if let Some(i) = i {
        add(i, along, part, -1.0);
        if axis < 3 {
            let line = sub(nodes[j].position, nodes[i].position);
            let length = norm(line);
            let shear_at = super::links::options(e).shear_at;
            let share = if length > 0.0 { shear_at / length } else { 0.0 };
            add(j, cross(line.map(|x| -share * x), along), 3, 1.0);
            add(i, cross(line.map(|x| (1.0 - share) * x), along), 3, -1.0);
        }
    }
    let mut all: Vec<(usize, f64)> = sum.into_iter().filter(|(_, c)| *c != 0.0).collect();
    all.sort_by_key(|(i, _)| *i);
    all
}

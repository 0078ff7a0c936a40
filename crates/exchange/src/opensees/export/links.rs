//! Links: an element between two nodes, or a node and the ground, with a material for each law.

use super::command::{Command, Word};
use super::laws::{Material, materials};
use super::{Place, Writer};
use trilith_element::{Axis, norm, sub};
use trilith_model::{Body, Element, LinkOptions};

/// What parts of links are called by, and where they lie.
pub(super) struct Line {
    /// Tags of the nodes.
    pub nodes: [i64; 2],
    /// Share of the length, from the first node, at which shear acts; none for nodes in one place.
    pub shear: Option<f64>,
}

impl Writer<'_> {
    /// Tags of the two ends of an element; with one node the ground is the first.
    pub(super) fn ends(&mut self, index: usize) -> Option<[i64; 2]> {
        let e = &self.model.elements[index];
        match e.nodes[..] {
            [j] => {
                let ground = self.on_ground(j);
                Some([ground, self.node(j)])
            }
            [i, j] => Some([self.node(i), self.node(j)]),
            _ => {
                self.losses.lost(e.kind, &e.name, "an element there has two nodes");
                None
            }
        }
    }

    /// Tag of a node that is held where a node is.
    pub(super) fn on_ground(&mut self, node: usize) -> i64 {
        let at = self.model.nodes[node].position;
        let known = self.ground.iter().position(|g| *g == at);
        let k = known.unwrap_or_else(|| {
            self.ground.push(at);
            self.ground.len() - 1
        });
        (self.model.nodes.len() + k + 1) as i64
    }

    /// Where a link lies; none where OpenSees puts it elsewhere.
    pub(super) fn line(&mut self, index: usize, across: bool) -> Option<Line> {
        let e = &self.model.elements[index];
        let options = options(e);
        let span = match e.nodes[..] {
            [i, j] => norm(sub(self.model.nodes[j].position, self.model.nodes[i].position)),
            _ => 0.0,
        };
        if span > 0.0 && self.is_askew(e) {
            let why = "between nodes apart local 1 runs along them there";
            self.losses.lost(e.kind, &e.name, why);
            return None;
        }
        if span == 0.0 && options.shear_at != 0.0 && across {
            let why = "shear beside the node has no counterpart where nodes are in one place";
            self.losses.lost(e.kind, &e.name, why);
            return None;
        }
        let shear = (span > 0.0).then(|| 1.0 - options.shear_at / span);
        Some(Line { nodes: self.ends(index)?, shear })
    }

    /// Writes linear stiffness and damping in local directions; false where it is not written.
    pub(super) fn linear_parts(
        &mut self,
        index: usize,
        k: [f64; 6],
        c: [f64; 6],
        structural: bool,
    ) -> bool {
        let parts: Vec<(usize, Material)> = (0..6)
            .filter(|i| k[*i] != 0.0 || c[*i] != 0.0)
            .map(|i| (i, Material::elastic(k[i], c[i])))
            .collect();
        // Directions without anything take part in nothing.
        parts.is_empty() || self.directions(index, &parts, structural).is_some()
    }

    /// Writes materials in local directions as one element; its tag.
    pub(super) fn directions(
        &mut self,
        index: usize,
        parts: &[(usize, Material)],
        structural: bool,
    ) -> Option<i64> {
        let model = self.model;
        let e = &model.elements[index];
        let across = parts.iter().any(|(axis, _)| matches!(axis, 1 | 2));
        let line = self.line(index, across)?;
        let mut commands = Vec::new();
        let mut tags = Vec::new();
        for (_, material) in parts {
            let tag = self.material();
            commands.push(
                Command::new("uniaxialMaterial", [Word::from(material.name), tag.into()])
                    .all(material.words.iter().cloned()),
            );
            tags.push(tag);
        }
        let tag = self.element();
        let kind = if line.shear.is_some() { "twoNodeLink" } else { "zeroLength" };
        let mut command = Command::new("element", [Word::from(kind), tag.into()])
            .all(line.nodes)
            .with("-mat")
            .all(tags)
            .with("-dir")
            .all(parts.iter().map(|(axis, _)| *axis as i64 + 1))
            .with("-orient")
            .all(e.frame.0[0])
            .all(e.frame.0[1]);
        if let Some(share) = line.shear {
            command = command.with("-shearDist").with(share).with(share);
        }
        if structural && self.rayleigh {
            command = command.with("-doRayleigh");
            if line.shear.is_none() {
                command = command.with(1);
            }
        }
        commands.push(command.remark(&e.name));
        let to = if structural { &mut self.structure } else { &mut self.linked };
        to.extend(commands);
        for (place, (axis, _)) in parts.iter().enumerate() {
            let forces = self.forces.entry((index, *axis)).or_default();
            forces.push(Place::Material(tag, place + 1));
        }
        self.elements.insert(index, tag);
        Some(tag)
    }

    /// Writes a link, or says why not.
    pub(super) fn link(&mut self, index: usize) {
        let model = self.model;
        let e = &model.elements[index];
        let sloped = options(e).p_delta_at;
        if matches!(
            e.kind,
            "NLink" | "FrictionPendulum" | "ElastomericBearing" | "RubberIsolator" | "LeadRubber"
        ) {
            return self.bearing(index);
        }
        if sloped.is_some() {
            let why =
                "the moment of its axial force over its shear (`p_delta_at`) has no counterpart";
            return self.losses.lost(e.kind, &e.name, why);
        }
        let axis = match &e.body {
            Body::Link(law, _) => match law.coordinates() {
                trilith_element::Coordinates::Local(axes) if !axes.is_empty() => axes[0],
                _ => Axis::U1,
            },
            _ => Axis::U1,
        };
        if e.kind == "LinearLink" {
            return self.linear_link(index);
        }
        let found = match materials(e) {
            Ok(found) => found,
            Err(why) => return self.losses.lost(e.kind, &e.name, &why),
        };
        if let Some(why) = found.near
            && !self.losses.near(e.kind, &e.name, why)
        {
            return;
        }
        for (what, why) in found.notes {
            self.losses.note(&format!("{}: {what}", e.kind), &e.name, why);
        }
        let parts: Vec<(usize, Material)> =
            found.materials.into_iter().map(|m| (axis.index(), m)).collect();
        if self.directions(index, &parts, false).is_some() {
            self.count(e.kind);
        }
    }

    fn linear_link(&mut self, index: usize) {
        let e = &self.model.elements[index];
        let mut diagonal = [[0.0; 6]; 2];
        for (at, name) in ["stiffness", "damping"].into_iter().enumerate() {
            let full = super::members::numbers(e.values.get(name));
            if full.iter().enumerate().any(|(k, x)| k % 7 != 0 && *x != 0.0) {
                let why = "directions that are coupled by a matrix have no counterpart";
                return self.losses.lost("LinearLink", &e.name, why);
            }
            for i in 0..6 {
                diagonal[at][i] = full.get(7 * i).copied().unwrap_or(0.0);
            }
        }
        if self.linear_parts(index, diagonal[0], diagonal[1], false) {
            self.count("LinearLink");
        }
    }
}

/// What a link says beside its law.
pub(super) fn options(e: &Element) -> LinkOptions {
    match &e.body {
        Body::Link(_, options) => options.clone(),
        _ => LinkOptions::default(),
    }
}

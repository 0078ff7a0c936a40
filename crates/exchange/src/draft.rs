//! A model file in the making.

use crate::ron::{Ron, number, quoted};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Directions of a node in the order of a vector of forces.
pub const DOFS: [&str; 6] = ["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"];

/// A section of a model file: values by name, in their order.
pub type Section = Vec<(String, Ron)>;

/// A model file in the making, in units of its own.
#[derive(Clone, Debug, Default)]
pub struct Draft {
    /// Comment at the top, by lines.
    pub head: Vec<String>,
    /// Title.
    pub title: String,
    /// Units of length and force.
    pub units: (String, String),
    /// Plane that all motion stays in.
    pub plane: Option<&'static str>,
    /// Nodes and their positions.
    pub nodes: Vec<(String, [f64; 3])>,
    /// Supported directions of nodes.
    pub supports: BTreeMap<usize, [bool; 6]>,
    /// Sets of parameters.
    pub properties: Section,
    /// Elements, constraints and links.
    pub elements: Section,
    /// Damping.
    pub damping: Option<Ron>,
    /// Case whose axial forces give the geometric stiffness.
    pub p_delta: Option<String>,
    /// Functions of time.
    pub functions: Section,
    /// Patterns: forces and moments of nodes.
    pub loads: Vec<(String, BTreeMap<usize, [f64; 6]>)>,
    /// Loads along members, by the patterns that they belong to.
    pub along: BTreeMap<String, Vec<Ron>>,
    /// Cases.
    pub cases: Section,
    /// Outputs.
    pub outputs: Section,
}

impl Draft {
    /// Adds an element, with a set of properties of that name that is written once.
    pub fn shared(&mut self, name: String, set: &str, properties: &Ron, place: Ron) {
        if !self.properties.iter().any(|(n, _)| n == set) {
            self.properties.push((set.into(), properties.clone()));
        }
        let Ron::Block(_, place) = place else { return };
        let mut fields = place;
        fields.push(("use".into(), Ron::text(set)));
        self.elements.push((name, Ron::Block(properties.name().into(), fields)));
    }

    /// The first name at which a number is beyond all bounds.
    #[must_use]
    pub fn beyond(&self) -> Option<&str> {
        let sections =
            [&self.properties, &self.elements, &self.functions, &self.cases, &self.outputs];
        let wrong = |section: &&Section| section.iter().any(|(_, v)| !v.is_finite());
        let section = sections.into_iter().find(wrong);
        let value = section.and_then(|s| s.iter().find(|(_, v)| !v.is_finite()));
        let node = self.nodes.iter().find(|(_, at)| at.iter().any(|x| !x.is_finite()));
        let load = self.loads.iter().find(|(_, f)| f.values().flatten().any(|x| !x.is_finite()));
        let along = self.along.iter().find(|(_, all)| all.iter().any(|b| !b.is_finite()));
        let damping = self.damping.iter().find(|d| !d.is_finite()).map(|_| "damping");
        let name = value.map(|(n, _)| n.as_str()).or(node.map(|(n, _)| n.as_str()));
        name.or(load.map(|(n, _)| n.as_str())).or(along.map(|(n, _)| n.as_str())).or(damping)
    }

    /// The model file.
    #[must_use]
    pub fn to_ron(&self) -> String {
        let mut out = String::new();
        for line in &self.head {
            let _ = writeln!(out, "// {}", line.replace(char::is_control, " "));
        }
        let _ = writeln!(out, "(\n    title: {},", quoted(&self.title));
        let (length, force) = &self.units;
        let _ = writeln!(out, "    units: (length: {}, force: {}),", quoted(length), quoted(force));
        if let Some(plane) = self.plane {
            let _ = writeln!(out, "    plane: {plane},");
        }
        let line = |(name, value): &(String, Ron)| (name.clone(), value.to_string());
        let nodes = self.nodes.iter().map(|(n, at)| (n.clone(), Ron::vector(at).to_string()));
        map(&mut out, "nodes", nodes);
        map(&mut out, "supports", self.supports.iter().filter_map(|(n, s)| self.support(*n, *s)));
        map(&mut out, "properties", self.properties.iter().map(line));
        map(&mut out, "elements", self.elements.iter().map(line));
        if let Some(damping) = &self.damping {
            let _ = writeln!(out, "    damping: {damping},");
        }
        if let Some(case) = &self.p_delta {
            let _ = writeln!(out, "    p_delta: {},", quoted(case));
        }
        map(&mut out, "functions", self.functions.iter().map(line));
        map(&mut out, "loads", self.loads.iter().map(|l| (l.0.clone(), self.load(&l.0, &l.1))));
        map(&mut out, "cases", self.cases.iter().map(line));
        map(&mut out, "outputs", self.outputs.iter().map(line));
        out.push_str(")\n");
        out
    }

    fn support(&self, node: usize, held: [bool; 6]) -> Option<(String, String)> {
        let dofs: Vec<&str> = (0..6).filter(|i| held[*i]).map(|i| DOFS[i]).collect();
        let text = match dofs.len() {
            0 => return None,
            6 => "Fixed".into(),
            _ => format!("({})", dofs.join(", ")),
        };
        Some((self.nodes[node].0.clone(), text))
    }

    fn load(&self, name: &str, forces: &BTreeMap<usize, [f64; 6]>) -> String {
        let mut lines = String::from("[\n");
        for (node, f) in forces {
            for (i, x) in f.iter().enumerate().filter(|(_, x)| **x != 0.0) {
                let what = if i < 3 { "force" } else { "moment" };
                let (node, dof, x) = (quoted(&self.nodes[*node].0), DOFS[i], number(*x));
                let _ = writeln!(lines, "            (node: {node}, dof: {dof}, {what}: {x}),");
            }
        }
        for block in self.along.get(name).into_iter().flatten() {
            let _ = writeln!(lines, "            {block},");
        }
        if lines.len() == 2 {
            return "[]".into();
        }
        lines + "        ]"
    }
}

fn map(out: &mut String, name: &str, entries: impl Iterator<Item = (String, String)>) {
    let mut entries = entries.peekable();
    if entries.peek().is_none() && name != "nodes" && name != "elements" && name != "cases" {
        return;
    }
    let _ = writeln!(out, "    {name}: {{");
    for (name, value) in entries {
        let _ = writeln!(out, "        {}: {value},", quoted(&name));
    }
    out.push_str("    },\n");
}

//! Beams, trusses, springs, masses: what is linear.

use super::command::{Command, Word};
use super::{ExportError, Writer};
use trilith_element::{ElementMatrices, Geometry, Value, Values, cross, norm, sub};
use trilith_model::{Body, Element};

/// Names of the stiffnesses and dampings of a spring, by local axis.
const STIFFNESS: [&str; 6] = ["k1", "k2", "k3", "r1", "r2", "r3"];
const DAMPING: [&str; 6] = ["c1", "c2", "c3", "cr1", "cr2", "cr3"];

/// The text of a choice.
pub(super) fn choice<'v>(values: &'v Values, name: &str) -> &'v str {
    match values.get(name) {
        Some(Value::Text(text)) => text,
        _ => "",
    }
}

/// True where a flag is set; numbers stand for flags as well.
pub(super) fn flag(values: &Values, name: &str) -> bool {
    match values.get(name) {
        Some(Value::Flag(b)) => *b,
        Some(Value::Number(x)) => *x != 0.0,
        _ => false,
    }
}

/// Numbers of a list.
pub(super) fn numbers(value: Option<&Value>) -> Vec<f64> {
    match value {
        Some(Value::Number(x)) => vec![*x],
        Some(Value::List(all)) => all.iter().flat_map(|v| numbers(Some(v))).collect(),
        _ => Vec::new(),
    }
}

fn axes(values: &Values, name: &str) -> Vec<String> {
    match values.get(name) {
        Some(Value::Text(one)) => vec![one.clone()],
        Some(Value::List(all)) => all
            .iter()
            .filter_map(|v| if let Value::Text(t) = v { Some(t.clone()) } else { None })
            .collect(),
        _ => Vec::new(),
    }
}

/// Stiffness, mass and damping of an element that is linear; none for others.
pub(super) fn matrices(
    writer: &Writer<'_>,
    element: &Element,
) -> Result<Option<ElementMatrices>, ExportError> {
    let Body::Linear(body) = &element.body else { return Ok(None) };
    if body.sparse().is_some() {
        return Ok(None);
    }
    let places: Vec<_> = element.nodes.iter().map(|n| writer.model.nodes[*n].position).collect();
    let made = body.matrices(&Geometry::new(&places, element.frame));
    let part = |e: trilith_element::ParameterError| ExportError::Part {
        name: element.name.clone(),
        why: e.to_string(),
    };
    made.map(Some).map_err(part)
}

impl Writer<'_> {
    /// Writes a linear element; masses come later, by nodes.
    pub(super) fn member(&mut self, index: usize) -> Result<(), ExportError> {
        let e = &self.model.elements[index];
        match e.kind {
            "Beam" => self.beam(index),
            "Truss" => self.truss(index),
            "Spring" => self.spring(index),
            "Inerter" => self.inerter(index),
            "Mass" => self.count("Mass"),
            kind => self.losses.lost(kind, &e.name, "no element there has this stiffness"),
        }
        Ok(())
    }

    /// Mass of a consistent mass matrix by length; 0 where masses are lumped.
    pub(super) fn spread_mass(element: &Element) -> f64 {
        let v = &element.values;
        if choice(v, "mass_matrix") != "Consistent" {
            return 0.0;
        }
        let number = |name: &str| v.number(name).unwrap_or(0.0);
        number("density") * area(v) + number("distributed_mass")
    }

    fn beam(&mut self, index: usize) {
        let model = self.model;
        let e = &model.elements[index];
        let v = &e.values;
        let number = |name: &str| v.number(name).unwrap_or(0.0);
        let (young, a) = (number("young"), area(v));
        let [i2, i3, torsion] = inertia(v);
        let by_poisson = v.number("poisson").map(|nu| young / (2.0 * (1.0 + nu)));
        let g = v.number("shear_modulus").or(by_poisson).unwrap_or(0.0);
        let by_share = v.number("shear_coefficient").map(|k| k * a);
        let shear = ["shear_area_2", "shear_area_3"].map(|name| v.number(name).or(by_share));
        let stiff = shear.iter().any(Option::is_some);
        let offsets = [number("offset_i"), number("offset_j")];
        if offsets != [0.0; 2] && choice(v, "offsets_stiffen") == "Bending" {
            let why = "rigid offsets there stiffen stretch and twist as well";
            if !self.losses.near("Beam", &e.name, why) {
                return;
            }
        }
        let (mut about_z, mut about_y) = (0, 0);
        for (name, bit) in [("release_i", 1), ("release_j", 2)] {
            for axis in axes(v, name) {
                match axis.as_str() {
                    "R3" => about_z |= bit,
                    "R2" => about_y |= bit,
                    _ => {
                        let why = "ends are released about local 2 and 3 alone there";
                        return self.losses.lost("Beam", &e.name, why);
                    }
                }
            }
        }
        let released = about_y != 0 || about_z != 0;
        if released && stiff {
            let why = "a beam with shear areas has no releases there";
            return self.losses.lost("Beam", &e.name, why);
        }
        // With one area alone the other direction is as good as stiff in shear.
        let areas = shear.map(|s| s.unwrap_or(1e6 * a));
        let mass = Self::spread_mass(e);
        if mass != 0.0 && (stiff || released || offsets != [0.0; 2]) {
            let why = "its consistent mass there knows neither shear, releases nor offsets";
            if !self.losses.near("Beam", &e.name, why) {
                return;
            }
        } else if mass != 0.0 && torsion > 0.0 && model.plane.is_none() {
            let why =
                "its consistent mass turns about the axis by J m/A there, by its polar moment here";
            if !self.losses.near("Beam", &e.name, why) {
                return;
            }
        }
        let transform = self.transform(e, offsets);
        let tag = self.element();
        let kind = if stiff { "ElasticTimoshenkoBeam" } else { "elasticBeamColumn" };
        let mut command = Command::new("element", [Word::from(kind), tag.into()])
            .all(e.nodes.iter().map(|n| self.node(*n)));
        command = if stiff {
            command.all([young, g, a, torsion, i2, i3, areas[0], areas[1]])
        } else {
            command.all([a, young, g, torsion, i2, i3])
        };
        command = command.with(transform);
        if mass != 0.0 {
            command = command.with("-mass").with(mass).with("-cMass");
        }
        for (option, code) in [("-releasez", about_z), ("-releasey", about_y)] {
            if code != 0 {
                command = command.with(option).with(code);
            }
        }
        self.structure.push(command.remark(&e.name));
        self.elements.insert(index, tag);
        self.count("Beam");
    }

    /// Tag of the transformation of a beam, written on its first use.
    fn transform(&mut self, e: &Element, offsets: [f64; 2]) -> i64 {
        let [first, _, third] = e.frame.0;
        let arms = [first.map(|x| x * offsets[0]), first.map(|x| -x * offsets[1])];
        let mut key = [0.0; 9];
        key[..3].copy_from_slice(&third);
        key[3..6].copy_from_slice(&arms[0]);
        key[6..].copy_from_slice(&arms[1]);
        if let Some((_, tag)) = self.transforms.iter().find(|t| t.0 == key) {
            return *tag;
        }
        let tag = self.transforms.len() as i64 + 1;
        self.transforms.push((key, tag));
        let mut command = Command::new("geomTransf", ["Linear".into(), tag.into()]).all(third);
        if offsets != [0.0; 2] {
            command = command.with("-jntOffset").all(arms[0]).all(arms[1]);
        }
        self.structure.push(command);
        tag
    }

    fn truss(&mut self, index: usize) {
        let model = self.model;
        let e = &model.elements[index];
        let number = |name: &str| e.values.number(name).unwrap_or(0.0);
        let material = self.material();
        let elastic = [Word::from("Elastic"), material.into(), number("young").into()];
        self.structure.push(Command::new("uniaxialMaterial", elastic));
        let tag = self.element();
        let mut command = Command::new("element", [Word::from("Truss"), tag.into()])
            .all(e.nodes.iter().map(|n| self.node(*n)))
            .with(number("area"))
            .with(material);
        let mass = Self::spread_mass(e);
        if mass != 0.0 {
            command = command.with("-rho").with(mass).with("-cMass").with(1);
        }
        if self.rayleigh {
            command = command.with("-doRayleigh").with(1);
        }
        self.structure.push(command.remark(&e.name));
        self.elements.insert(index, tag);
        self.count("Truss");
    }

    fn spring(&mut self, index: usize) {
        let e = &self.model.elements[index];
        let mut diagonal = [[0.0; 6]; 2];
        for (at, (names, whole)) in
            [(STIFFNESS, "stiffness"), (DAMPING, "damping")].into_iter().enumerate()
        {
            let full = numbers(e.values.get(whole));
            for i in 0..6 {
                let own = e.values.number(names[i]).unwrap_or(0.0);
                diagonal[at][i] = own + full.get(7 * i).copied().unwrap_or(0.0);
            }
            if full.iter().enumerate().any(|(k, x)| k % 7 != 0 && *x != 0.0) {
                let why = "directions that are coupled by a matrix have no counterpart";
                return self.losses.lost("Spring", &e.name, why);
            }
        }
        let [k, c] = diagonal;
        if self.linear_parts(index, k, c, true) {
            self.count("Spring");
        }
    }

    fn inerter(&mut self, index: usize) {
        let e = &self.model.elements[index];
        if e.nodes.len() == 2
            && norm(sub(
                self.model.nodes[e.nodes[0]].position,
                self.model.nodes[e.nodes[1]].position,
            )) > 0.0
            && choice(&e.values, "axis") != "U1"
        {
            let why = "between nodes apart it acts along its axis alone there";
            return self.losses.lost("Inerter", &e.name, why);
        }
        let Some(nodes) = self.ends(index) else { return };
        let axis = trilith_element::Axis::NAMES
            .iter()
            .position(|n| *n == choice(&e.values, "axis"))
            .unwrap_or(0);
        let tag = self.element();
        let command = Command::new("element", [Word::from("inerter"), tag.into()])
            .all(nodes)
            .with("-dir")
            .with(axis as i64 + 1)
            .with("-inertance")
            .with(e.values.number("b").unwrap_or(0.0))
            .with("-orient")
            .all(e.frame.0[0])
            .all(e.frame.0[1]);
        self.structure.push(command.remark(&e.name));
        self.elements.insert(index, tag);
        self.count("Inerter");
    }

    /// True where two nodes are apart and local axis 1 does not run along them.
    pub(super) fn is_askew(&self, e: &Element) -> bool {
        let [i, j] = e.nodes[..] else { return false };
        let line = sub(self.model.nodes[j].position, self.model.nodes[i].position);
        norm(cross(line, e.frame.0[0])) > 1e-9 * norm(line).max(1e-9)
            || trilith_element::dot(line, e.frame.0[0]) < 0.0
    }
}

/// Area of a section.
fn area(v: &Values) -> f64 {
    match (v.number("width"), v.number("depth")) {
        (Some(b), Some(h)) => b * h,
        _ => v.number("area").unwrap_or(0.0),
    }
}

/// Second moments about local 2 and 3, and the torsion constant; of a rectangle as the element has them \[Roark\].
fn inertia(v: &Values) -> [f64; 3] {
    if let (Some(b), Some(h)) = (v.number("width"), v.number("depth")) {
        let (a, s) = (b.max(h), b.min(h));
        let q = s / a;
        let torsion = a * s.powi(3) * (1.0 / 3.0 - 0.21 * q * (1.0 - q.powi(4) / 12.0));
        return [h * b.powi(3) / 12.0, b * h.powi(3) / 12.0, torsion];
    }
    ["i2", "i3", "torsion"].map(|name| v.number(name).unwrap_or(0.0))
}

//! Bearings: elements of their own there.

use super::command::{Command, Word};
use super::laws::Material;
use super::links::options;
use super::members::{choice, flag};
use super::{Place, Writer};

/// What a bearing takes along its axis and about its three axes.
struct Beside {
    axial: Material,
    turning: [f64; 3],
}

/// A friction model without its tag, and where it differs.
struct Friction {
    name: &'static str,
    numbers: Vec<f64>,
    near: Option<&'static str>,
}

const BY_SPEED: &str = "friction by the speed of the bearing there, of the slip here";

impl Writer<'_> {
    /// Writes a bearing, or says why not.
    pub(super) fn bearing(&mut self, index: usize) {
        let kind = self.model.elements[index].kind;
        let done = match kind {
            "NLink" | "FrictionPendulum" => self.slider(index),
            _ => self.rubber(index),
        };
        match done {
            Ok(true) => self.count(kind),
            Ok(false) => {}
            Err(why) => {
                let name = &self.model.elements[index].name;
                self.losses.lost(kind, name, &why);
            }
        }
    }

    /// A contact with or without friction; false where a near one may not be written.
    fn slider(&mut self, index: usize) -> Result<bool, String> {
        let model = self.model;
        let e = &model.elements[index];
        let v = &*e.values;
        let number = |name: &str| v.number(name).unwrap_or(0.0);
        let rocks = e.kind == "NLink";
        if rocks && v.number("restitution").is_some() {
            return Err("its dashpot follows from `restitution`: give `damping`".into());
        }
        for (name, what) in [
            ("cs", "a dashpot beside the spring before slip"),
            ("k_post", "a stiffness behind slip"),
            ("mu_static", "friction that breaks away"),
            ("stop", "a rim"),
        ] {
            if number(name) != 0.0 {
                return Err(format!("{what} (`{name}`) has no counterpart"));
            }
        }
        let (kn, c, opening) = (number("kn"), number("damping"), number("opening"));
        if opening < 0.0 {
            return Err(
                "a contact that is pressed at rest (`opening` below zero) has no counterpart"
                    .into(),
            );
        }
        let mut near = Vec::new();
        if c != 0.0 && !flag(v, "pull") {
            near.push("the dashpot of a contact pulls as it lets go there (`pull: true`), and counts for no friction");
        }
        let friction = friction(e.kind, v)?;
        let radius = number("radius");
        let turning = if rocks { ["r1", "r2", "r3"].map(number) } else { [0.0; 3] };
        let frictionless = friction.is_none() && radius == 0.0;
        if !frictionless {
            near.extend(friction.as_ref().and_then(|f| f.near));
            if radius > 0.0 {
                if flag(v, "rise") {
                    near.push("moving out lifts no load there");
                }
                near.push("singleFPBearing takes N with its share of the shear over the slope, and N/R out of kInit");
            }
            near.extend(self.sloped(index, [1.0, 0.0]));
        } else if options(e).p_delta_at.is_some() {
            return Err(
                "the moment of its axial force over its shear (`p_delta_at`) has no counterpart"
                    .into(),
            );
        }
        if !self.all_near(index, &near) {
            return Ok(false);
        }
        let contact = Material::gap(kn, opening);
        let damper = (c != 0.0).then(|| Material::kelvin(0.0, c, opening));
        if frictionless {
            let mut parts = vec![(0, contact)];
            parts.extend(damper.map(|m| (0, m)));
            let turns = turning.iter().enumerate().filter(|(_, r)| **r != 0.0);
            parts.extend(turns.map(|(i, r)| (3 + i, Material::elastic(*r, 0.0))));
            return Ok(self.directions(index, &parts, false).is_some());
        }
        let Friction { name, numbers, .. } =
            friction.unwrap_or(Friction { name: "Coulomb", numbers: vec![0.0], near: None });
        self.tags.friction += 1;
        let model_of = self.tags.friction;
        let line = Command::new("frictionModel", [Word::from(name), model_of.into()]).all(numbers);
        let beside = Beside { axial: contact, turning };
        let ks = number("ks");
        let (element, own) = if radius > 0.0 {
            ("singleFPBearing", vec![model_of.into(), radius.into(), ks.into()])
        } else {
            ("flatSliderBearing", vec![model_of.into(), Word::from(ks)])
        };
        self.linked.push(line);
        if !self.plane_bearing(index, element, own, &beside, true) {
            self.linked.pop();
            return Ok(false);
        }
        if let Some(damper) = damper {
            let tag = self.elements[&index];
            self.directions(index, &[(0, damper)], false);
            self.elements.insert(index, tag);
        }
        Ok(true)
    }

    /// Names all that differs; false where a law that is near may not be written.
    fn all_near(&mut self, index: usize, near: &[&str]) -> bool {
        let e = &self.model.elements[index];
        let may: Vec<bool> =
            near.iter().map(|why| self.losses.near(e.kind, &e.name, why)).collect();
        !may.contains(&false)
    }

    /// Why the moments of its axial force are not those here; none where they are, or do nothing.
    fn sloped(&self, index: usize, shares: [f64; 2]) -> Option<&'static str> {
        let e = &self.model.elements[index];
        match options(e).p_delta_at {
            Some(own) if own == shares => None,
            // Moments on the ground do nothing.
            None if e.nodes.len() == 1 && shares == [1.0, 0.0] => None,
            _ => Some(
                "the moment of its axial force over its shear stands elsewhere there (`p_delta_at`)",
            ),
        }
    }

    /// A bearing of rubber, with or without lead.
    fn rubber(&mut self, index: usize) -> Result<bool, String> {
        let model = self.model;
        let e = &model.elements[index];
        let v = &*e.values;
        let number = |name: &str| v.number(name).unwrap_or(0.0);
        let mut near = Vec::new();
        let (element, own, kv) = match e.kind {
            "ElastomericBearing" => {
                let (k, fy, ratio) = (number("k"), number("fy"), number("ratio"));
                let own = [k, (1.0 - ratio) * fy, ratio, 0.0, 1.0];
                ("elastomericBearingPlasticity", own.to_vec(), 0.0)
            }
            kind => {
                let [k, q, ratio] = if kind == "RubberIsolator" {
                    let alike = |a: &str, b: &str| v.number(b).is_none_or(|x| x == number(a));
                    if !(alike("k2", "k3") && alike("fy2", "fy3") && alike("ratio2", "ratio3")) {
                        return Err(
                            "a bearing that is not the same along both axes has no counterpart"
                                .into(),
                        );
                    }
                    let (k, fy, ratio) = (number("k2"), number("fy2"), number("ratio2"));
                    [k, (1.0 - ratio) * fy, ratio]
                } else {
                    if flag(v, "heating") {
                        return Err("a core that heats up is another law in LeadRubberX (`heating: false` has a counterpart)".into());
                    }
                    let area = std::f64::consts::FRAC_PI_4 * number("lead_diameter").powi(2);
                    let (kr, q) = (number("kr"), area * number("lead_strength"));
                    let k = kr + q / number("yield_displacement");
                    [k, q, kr / k]
                };
                if choice(v, "coupling") != "Direction" {
                    near.push("unloading is told by the direction of the motion there (`coupling: Direction`): the same along one axis");
                }
                let own = [k, q, ratio, 0.0, 1.0, number("eta"), number("beta"), number("gamma")];
                ("elastomericBearingBoucWen", own.to_vec(), number("kv"))
            }
        };
        // Without a moment of the axial force that force goes beside the bearing, which knows none then.
        let inside = options(e).p_delta_at.is_some();
        if inside {
            near.extend(self.sloped(index, [0.5, 0.5]));
        }
        if !self.all_near(index, &near) {
            return Ok(false);
        }
        if e.kind != "ElastomericBearing" {
            self.losses.note(
                "Bouc and Wen: z",
                &e.name,
                "steps of the first order there: it needs short ones",
            );
        }
        let axial = Material::elastic(if inside { kv } else { 0.0 }, 0.0);
        let beside = Beside { axial, turning: [0.0; 3] };
        let words = own.into_iter().map(Word::Real).collect();
        if !self.plane_bearing(index, element, words, &beside, false) {
            return Ok(false);
        }
        if !inside && kv > 0.0 {
            let tag = self.elements[&index];
            self.forces.remove(&(index, 0));
            self.directions(index, &[(0, Material::elastic(kv, 0.0))], false);
            self.elements.insert(index, tag);
        }
        Ok(true)
    }

    /// Writes an element with the materials beside its own law.
    fn plane_bearing(
        &mut self,
        index: usize,
        element: &'static str,
        own: Vec<Word>,
        beside: &Beside,
        iterates: bool,
    ) -> bool {
        let model = self.model;
        let e = &model.elements[index];
        let Some(line) = self.line(index, true) else { return false };
        let material = |writer: &mut Self, material: &Material| {
            let tag = writer.material();
            let words = [Word::from(material.name), tag.into()];
            writer
                .linked
                .push(Command::new("uniaxialMaterial", words).all(material.words.iter().cloned()));
            tag
        };
        let axial = material(self, &beside.axial);
        let turning = beside.turning.map(|r| material(self, &Material::elastic(r, 0.0)));
        let tag = self.element();
        let mut command =
            Command::new("element", [Word::from(element), tag.into()]).all(line.nodes).all(own);
        let options = ["-P", "-T", "-My", "-Mz"];
        for (option, tag) in options.iter().zip([axial].into_iter().chain(turning)) {
            command = command.with(*option).with(tag);
        }
        command = command.with("-orient").all(e.frame.0[0]).all(e.frame.0[1]);
        command = command.with("-shearDist").with(line.shear.unwrap_or(0.0));
        if iterates {
            command = command.with("-iter").with(100).with(1e-10);
        }
        self.linked.push(command.remark(&e.name));
        for axis in 0..6 {
            self.forces.insert((index, axis), vec![Place::Basic(tag, axis)]);
        }
        self.elements.insert(index, tag);
        true
    }
}

/// The friction of a contact; none where it has none.
fn friction(kind: &str, v: &trilith_element::Values) -> Result<Option<Friction>, String> {
    let number = |name: &str| v.number(name).unwrap_or(0.0);
    let (by_speed, coulomb) = match (kind, choice(v, "friction_model")) {
        ("NLink", _) => (v.number("mu_fast").is_some(), v.number("mu").is_some()),
        (_, "Velocity") => (true, false),
        (_, "Coulomb") => (false, true),
        (_, other) => {
            return Err(format!(
                "friction of the model `{other}` is not written: its numbers are in other units there"
            ));
        }
    };
    if by_speed {
        let (slow, fast) = (number("mu_slow"), number("mu_fast"));
        if slow == fast {
            return Ok(Some(Friction { name: "Coulomb", numbers: vec![slow], near: None }));
        }
        let numbers = vec![slow, fast, number("rate")];
        return Ok(Some(Friction { name: "VelDependent", numbers, near: Some(BY_SPEED) }));
    }
    Ok(coulomb.then(|| Friction { name: "Coulomb", numbers: vec![number("mu")], near: None }))
}

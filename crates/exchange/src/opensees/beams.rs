//! Beams, trusses, their sections and transformations.

use super::args::{Args, Told, wrong};
use super::materials::Law;
use super::outputs::Written;
use super::recorder::{Recorder, Section, Transform, Undamped};
use super::tcl::Value;
use crate::ron::Ron;

/// Difference of two points.
pub fn between(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| b[k] - a[k])
}

/// Cross product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Length of a vector.
pub fn length(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl Recorder<'_> {
    pub(super) fn section(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "section Elastic tag E A Iz …");
        let kind = a.word("its type")?;
        if kind != "Elastic" {
            self.lost(
                "sections with fibres, plates and the like are not read: members stay elastic",
            );
            return Ok(());
        }
        let tag = a.whole("its tag")?;
        let [e, area, iz] = a.numbers::<3>("E, A, Iz")?;
        let mut section = Section { e, a: area, iz, ..Section::default() };
        if self.ndm == 3 {
            [section.iy, section.g, section.j] = a.numbers::<3>("Iy, G, J")?;
        } else if let Some(g) = a.maybe() {
            section.g = g;
        }
        let factors = a.all();
        if !factors.is_empty() {
            self.ignore("alphaY alphaZ", "shear counts in *ElasticTimoshenkoBeam* alone");
        }
        self.sections.insert(tag, section);
        Ok(())
    }

    pub(super) fn transform(&mut self, words: &[Value]) -> Told<()> {
        self.begun()?;
        let mut a = Args::new(words, 1, "geomTransf Linear tag vecxz …");
        let kind = a.word("its type")?.to_owned();
        if !matches!(kind.as_str(), "Linear" | "PDelta" | "Corotational") {
            return wrong(
                1,
                format!("`{kind}` is no transformation"),
                "Linear, PDelta or Corotational",
            );
        }
        let tag = a.whole("its tag")?;
        let plane = if self.ndm == 3 {
            a.flag("-vecxz");
            Some(a.numbers::<3>("the vector in the plane of local x and z")?)
        } else {
            None
        };
        let mut offsets = [[0.0; 3]; 2];
        while let Some(option) = a.option() {
            match option {
                "-jntOffset" => {
                    for end in &mut offsets {
                        for x in end.iter_mut().take(self.ndm) {
                            *x = a.number("an offset")?;
                        }
                    }
                }
                other => self.unread(other),
            }
        }
        self.transforms.insert(tag, Transform { kind, plane, offsets });
        Ok(())
    }

    fn transform_of(&self, a: &mut Args<'_>) -> Told<Transform> {
        let word = a.at();
        let tag = a.whole("its transformation")?;
        match self.transforms.get(&tag) {
            Some(t) => Ok(t.clone()),
            None => wrong(
                word,
                format!("there is no transformation {tag}"),
                "`geomTransf` stands before what uses it",
            ),
        }
    }

    pub(super) fn beam(&mut self, words: &[Value], shear: bool) -> Told<()> {
        let usage = if self.ndm == 3 {
            "element elasticBeamColumn tag i j A E G J Iy Iz transf"
        } else {
            "element elasticBeamColumn tag i j A E Iz transf"
        };
        let mut a = Args::new(words, 2, usage);
        let (tag, nodes) = self.placed(&mut a)?;
        let numbers =
            words[5..].iter().take_while(|w| super::tcl::Number::read(w.str()).is_some()).count();
        let s = if numbers == 2 && !shear {
            let word = a.at();
            let section = a.whole("its section")?;
            match self.sections.get(&section) {
                Some(s) => *s,
                None => {
                    return wrong(
                        word,
                        format!("there is no section {section} that stays elastic"),
                        "",
                    );
                }
            }
        } else if shear && self.ndm == 3 {
            let [e, g, a1, j, iy, iz, avy, avz] = a.numbers::<8>("E, G, A, J, Iy, Iz, Avy, Avz")?;
            Section { e, a: a1, iz, iy, g, j, shear: [avy, avz] }
        } else if shear {
            let [e, g, a1, iz, avy] = a.numbers::<5>("E, G, A, Iz, Avy")?;
            Section { e, a: a1, iz, g, shear: [avy, 0.0], ..Section::default() }
        } else if self.ndm == 3 {
            let [a1, e, g, j, iy, iz] = a.numbers::<6>("A, E, G, J, Iy, Iz")?;
            Section { e, a: a1, iz, iy, g, j, shear: [0.0; 2] }
        } else {
            let [a1, e, iz] = a.numbers::<3>("A, E, Iz")?;
            Section { e, a: a1, iz, ..Section::default() }
        };
        if [s.e, s.a, s.iz].iter().any(|x| *x <= 0.0) {
            return wrong(5, "a beam whose E, A or Iz is not above zero", usage);
        }
        let transform = self.transform_of(&mut a)?;
        let (mut mass, mut consistent) = (0.0, false);
        let mut released = [Vec::new(), Vec::new()];
        while let Some(option) = a.option() {
            match option {
                "-mass" => mass = a.number("the mass by length")?,
                "-cMass" => consistent = true,
                "-lMass" => consistent = false,
                "-release" | "-releasez" | "-releasey" => {
                    let axis = if option == "-releasey" { "R2" } else { "R3" };
                    let word = a.at();
                    let code = a.whole("0, 1, 2 or 3")?;
                    if !(0..=3).contains(&code) {
                        return wrong(
                            word,
                            format!("`{code}` is no release"),
                            "1: first end, 2: second end, 3: both",
                        );
                    }
                    for (end, list) in released.iter_mut().enumerate() {
                        if code & (1 << end) != 0 {
                            list.push(axis);
                        }
                    }
                }
                "-alpha" | "-depth" => {
                    let x = a.number("a number")?;
                    self.ignore(option, &format!("warmth is not loaded ({x})"));
                }
                other => self.unread(other),
            }
        }
        let mut ends = nodes;
        for (k, offset) in transform.offsets.iter().enumerate().filter(|(_, o)| **o != [0.0; 3]) {
            ends[k] = self.offset(nodes[k], *offset, tag, k);
        }
        let x = between(self.at(ends[0]), self.at(ends[1]));
        if length(x) == 0.0 {
            return wrong(3, "a beam without a length", "its ends lie apart");
        }
        let y = match transform.plane {
            Some(plane) => cross(plane, x),
            None => cross([0.0, 0.0, 1.0], x),
        };
        if length(y) <= 1e-9 * length(x) {
            return wrong(
                0,
                "the vector of its transformation lies along the beam",
                "a vector in the plane of local x and z",
            );
        }
        let pair = Ron::Tuple(ends.iter().map(|n| Ron::text(&self.draft.nodes[*n].0)).collect());
        let some = |x: f64| (x > 0.0).then_some(x);
        let mut block = Ron::block("Beam")
            .with("nodes", pair)
            .with("axis2", Ron::vector(&y))
            .with("young", s.e)
            .with("area", s.a)
            .with("i3", s.iz)
            .maybe("i2", some(s.iy))
            .maybe("shear_modulus", some(s.g))
            .maybe("torsion", some(s.j))
            .maybe("shear_area_2", some(s.shear[0]))
            .maybe("shear_area_3", some(s.shear[1]));
        let eccentric = ends != nodes && !consistent;
        if eccentric {
            // It is lumped at the nodes themselves, not at the ends of the offsets.
            nodes.iter().for_each(|n| self.nodes[*n].brought += mass * length(x) / 2.0);
        } else if mass != 0.0 {
            block = block.with("distributed_mass", mass);
            if consistent {
                block = block.with("mass_matrix", Ron::word("Consistent"));
            }
        }
        for (key, list) in ["release_i", "release_j"].iter().zip(&released) {
            block = block.maybe(key, (!list.is_empty()).then(|| Ron::words(list)));
        }
        if transform.kind != "Linear" {
            self.analysis.geometric(&transform.kind, &self.line);
        }
        let name = format!("element {tag}");
        self.draft.elements.push((name.clone(), block));
        self.elements.insert(tag, Written { beam: Some(name), nodes: ends, ..Written::default() });
        self.changed();
        Ok(())
    }

    /// A node at the end of a rigid offset.
    fn offset(&mut self, node: usize, offset: [f64; 3], tag: i64, end: usize) -> usize {
        let at = self.at(node);
        let index = self.draft.nodes.len();
        let name = format!("element {tag} end {}", ["i", "j"][end]);
        self.draft.nodes.push((name.clone(), std::array::from_fn(|k| at[k] + offset[k])));
        let ndf = self.nodes[node].ndf;
        self.nodes.push(super::recorder::Node { ndf, mass: [0.0; 6], brought: 0.0 });
        let pair = Ron::Tuple(vec![Ron::text(&self.draft.nodes[node].0), Ron::text(&name)]);
        self.draft
            .elements
            .push((format!("offset {name}"), Ron::block("RigidLink").with("nodes", pair)));
        index
    }

    pub(super) fn truss(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 2, "element truss tag i j A material");
        let (tag, nodes) = self.placed(&mut a)?;
        let area = a.positive("the area")?;
        let word = a.at();
        let material = a.whole("its material")?;
        let material = self.material_of(word, material)?;
        let (mut rho, mut consistent, mut damped) = (0.0, false, false);
        while let Some(option) = a.option() {
            match option {
                "-rho" => rho = a.number("the mass by length")?,
                "-cMass" => consistent = a.maybe().is_none_or(|x| x != 0.0),
                "-doRayleigh" => damped = a.maybe().is_none_or(|x| x != 0.0),
                other => self.unread(other),
            }
        }
        let x = between(self.at(nodes[0]), self.at(nodes[1]));
        let long = length(x);
        if long == 0.0 {
            return wrong(3, "a truss without a length", "its ends lie apart");
        }
        let Some(material) = material else {
            self.lost("its material was lost");
            return Ok(());
        };
        if words[1].str().eq_ignore_ascii_case("corotTruss") {
            self.lose("it is written as a truss of small displacements");
        }
        let name = format!("element {tag}");
        let mut written = Written { nodes, ..Written::default() };
        let pair = self.pair(nodes);
        match material.linear() {
            Some((e, c)) if e > 0.0 && c == 0.0 => {
                let mut block = Ron::block("Truss")
                    .with("nodes", pair.clone())
                    .with("young", e)
                    .with("area", area);
                if rho != 0.0 {
                    block = block.with("distributed_mass", rho);
                    if consistent {
                        block = block.with("mass_matrix", Ron::word("Consistent"));
                    }
                }
                if !damped {
                    let mut k = [0.0; 6];
                    k[0] = e * area / long;
                    let instead = super::links::linear_link(k, [0.0; 6]).with("nodes", pair);
                    let masses = nodes.map(|n| (n, rho * long / 2.0)).to_vec();
                    self.undamped.push(Undamped { name: name.clone(), instead, masses });
                }
                self.draft.elements.push((name.clone(), block));
                written.beam = Some(name);
            }
            _ => {
                for node in nodes {
                    self.nodes[node].brought += rho * long / 2.0;
                }
                let pairs: Vec<(&Law, f64, f64)> =
                    material.laws.iter().map(|l| (l, area, long)).collect();
                let place = Ron::block("").with("nodes", pair);
                self.write_laws(&name, 0, &pairs, &place, damped, &mut written);
            }
        }
        self.elements.insert(tag, written);
        self.changed();
        Ok(())
    }

    /// Tag and nodes of an element.
    pub(super) fn placed(&mut self, a: &mut Args<'_>) -> Told<(i64, [usize; 2])> {
        self.begun()?;
        let word = a.at();
        let tag = a.whole("its tag")?;
        if self.elements.contains_key(&tag) {
            return wrong(
                word,
                format!("there are two elements {tag}"),
                "every element has a tag of its own",
            );
        }
        let first = a.whole("its first node")?;
        let second = a.whole("its second node")?;
        Ok((tag, [self.node(word + 1, first)?, self.node(word + 2, second)?]))
    }

    /// Names of two nodes.
    pub(super) fn pair(&self, nodes: [usize; 2]) -> Ron {
        Ron::Tuple(nodes.iter().map(|n| Ron::text(&self.draft.nodes[*n].0)).collect())
    }
}

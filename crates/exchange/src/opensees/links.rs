//! Links of materials: `zeroLength`, `twoNodeLink`, and what all links share.

use super::args::{Args, Told, wrong};
use super::beams::{between, cross, length};
use super::materials::{Law, Material};
use super::outputs::Written;
use super::recorder::{Recorder, Undamped};
use super::tcl::Value;
use crate::ron::Ron;

/// Local directions.
pub const LOCAL: [&str; 6] = ["U1", "U2", "U3", "R1", "R2", "R3"];

/// Stiffness and damping in local directions as a link, which no damping of the structure acts on.
pub fn linear_link(k: [f64; 6], c: [f64; 6]) -> Ron {
    let matrix = |d: [f64; 6]| {
        let row = |i: usize| {
            Ron::List((0..6).map(|j| Ron::Number(if i == j { d[i] } else { 0.0 })).collect())
        };
        Ron::List((0..6).map(row).collect())
    };
    let some = |d: [f64; 6]| d.iter().any(|x| *x != 0.0).then(|| matrix(d));
    Ron::block("LinearLink").maybe("stiffness", some(k)).maybe("damping", some(c))
}

/// The same as a spring of the structure.
fn spring(k: [f64; 6], c: [f64; 6]) -> Ron {
    const STIFF: [&str; 6] = ["k1", "k2", "k3", "r1", "r2", "r3"];
    const DAMP: [&str; 6] = ["c1", "c2", "c3", "cr1", "cr2", "cr3"];
    let mut block = Ron::block("Spring");
    for (keys, values) in [(STIFF, k), (DAMP, c)] {
        for (key, x) in keys.iter().zip(values).filter(|(_, x)| *x != 0.0) {
            block = block.with(key, x);
        }
    }
    block
}

/// A block with the fields of another behind its own.
fn joined(block: Ron, more: &Ron) -> Ron {
    match more {
        Ron::Block(_, fields) => fields.iter().fold(block, |b, (k, v)| b.with(k, v.clone())),
        _ => block,
    }
}

/// Where a link lies, and what else it takes.
pub struct Place {
    pub name: String,
    /// Nodes and axes.
    pub fields: Ron,
    /// Where its shear acts, from the second node.
    pub shear: Option<f64>,
    pub damped: bool,
}

impl Recorder<'_> {
    /// Local x and y of an element: given, or from its nodes.
    pub(super) fn axes(
        &mut self,
        nodes: [usize; 2],
        given: &[f64],
        word: usize,
    ) -> Told<[[f64; 3]; 2]> {
        let line = between(self.at(nodes[0]), self.at(nodes[1]));
        let long = length(line) > 1e-12;
        let mut x = if long { line } else { [1.0, 0.0, 0.0] };
        let flat = self.ndm < 3;
        let mut y = if flat { cross([0.0, 0.0, 1.0], x) } else { [0.0, 1.0, 0.0] };
        match given {
            [] => {
                if !flat && long {
                    self.otherwise(
                        "without -orient local y lies in the plane of local x and global Y",
                    );
                }
            }
            [a, b, c] => y = [*a, *b, *c],
            [a, b, c, d, e, f] => {
                x = [*a, *b, *c];
                y = [*d, *e, *f];
            }
            _ => {
                return wrong(
                    word,
                    format!("{} numbers behind -orient", given.len()),
                    "local x and y, or y alone",
                );
            }
        }
        if length(cross(x, y)) <= 1e-9 * length(x) * length(y) || length(x) == 0.0 {
            return wrong(word, "local x and y lie along one line", "-orient x1 x2 x3 y1 y2 y3");
        }
        Ok([x, y])
    }

    /// Writes laws of one direction; what is linear becomes a spring.
    pub(super) fn write_laws(
        &mut self,
        name: &str,
        axis: usize,
        laws: &[(&Law, f64, f64)],
        fields: &Ron,
        damped: bool,
        written: &mut Written,
    ) {
        let (mut k, mut c) = ([0.0; 6], [0.0; 6]);
        for (law, force, long) in laws {
            if let Law::Elastic { k: e, c: eta } = law {
                k[axis] += e * force / long;
                c[axis] += eta * force / long;
                continue;
            }
            let Some(block) = law.block(*force, *long, axis >= 3) else {
                self.lose("a law about a rotation that is there for translations alone");
                continue;
            };
            let block = if axis == 0 { block } else { block.with("axis", Ron::word(LOCAL[axis])) };
            let own = self.free_name(&format!("{name} {}", LOCAL[axis]));
            self.draft.elements.push((own.clone(), joined(block, fields)));
            written.links.push((own, axis));
            if damped {
                self.lose("damping of its stiffness (-doRayleigh) is not written");
            }
        }
        let place = Place {
            name: self.free_name(&format!("{name} {}", LOCAL[axis])),
            fields: fields.clone(),
            shear: None,
            damped,
        };
        self.write_linear(&place, k, c, written);
    }

    /// A name that no element has, with a number where one has.
    fn free_name(&self, name: &str) -> String {
        let taken = |n: &str| self.draft.elements.iter().rev().any(|(m, _)| m == n);
        let mut tries =
            std::iter::once(name.to_owned()).chain((2..).map(|k| format!("{name} {k}")));
        tries.find(|n| !taken(n)).unwrap_or_default()
    }

    /// Writes stiffness and damping in local directions.
    pub(super) fn write_linear(
        &mut self,
        place: &Place,
        k: [f64; 6],
        c: [f64; 6],
        written: &mut Written,
    ) {
        if k.iter().chain(&c).all(|x| *x == 0.0) {
            return;
        }
        if k.iter().chain(&c).any(|x| *x < 0.0) {
            self.lose("a stiffness or damping below zero is not written");
            return;
        }
        let shear = place
            .shear
            .filter(|s| *s != 0.0 && [1, 2].iter().any(|i| k[*i] != 0.0 || c[*i] != 0.0));
        let link = joined(linear_link(k, c), &place.fields).maybe("shear_at", shear);
        if shear.is_some() {
            self.draft.elements.push((place.name.clone(), link));
        } else {
            self.draft.elements.push((place.name.clone(), joined(spring(k, c), &place.fields)));
            if !place.damped {
                self.undamped.push(Undamped {
                    name: place.name.clone(),
                    instead: link,
                    masses: Vec::new(),
                });
            }
        }
        written.linear = Some(place.name.clone());
    }

    pub(super) fn link(&mut self, words: &[Value], long: bool) -> Told<()> {
        let usage = if long {
            "element twoNodeLink tag i j -mat m … -dir d … -orient …"
        } else {
            "element zeroLength tag i j -mat m … -dir d … -orient …"
        };
        let mut a = Args::new(words, 2, usage);
        let (tag, nodes) = self.placed(&mut a)?;
        let (mut materials, mut dirs, mut orient) = (Vec::new(), Vec::new(), (0, Vec::new()));
        let (mut share, mut damped, mut mass, mut tilt) = (None, false, 0.0, None);
        while let Some(option) = a.option() {
            match option {
                "-mat" => {
                    while let Some(tag) = {
                        let word = a.at();
                        a.maybe_whole().map(|t| (word, t))
                    } {
                        materials.push(tag);
                    }
                }
                "-dir" | "-dof" => {
                    while let Some(dir) = {
                        let word = a.at();
                        a.maybe_whole().map(|t| (word, t))
                    } {
                        dirs.push(dir);
                    }
                }
                "-orient" => orient = (a.at(), a.all()),
                "-doRayleigh" => damped = a.maybe_whole().is_none_or(|x| x != 0),
                "-shearDist" if long => share = Some(a.all()),
                "-pDelta" if long => tilt = Some(a.all()),
                "-mass" if long => mass = a.number("its mass")?,
                other => self.unread(other),
            }
        }
        if materials.len() != dirs.len() || dirs.is_empty() {
            let message = format!("{} materials for {} directions", materials.len(), dirs.len());
            return wrong(0, message, usage);
        }
        let [x, y] = self.axes(nodes, &orient.1, orient.0)?;
        let span = length(between(self.at(nodes[0]), self.at(nodes[1])));
        let share = match share.as_deref() {
            None => 0.5,
            Some([s]) => *s,
            Some([s, t, ..]) => {
                if s != t {
                    self.lose("shear of both directions acts where that of the first does");
                }
                *s
            }
            Some([]) => return wrong(0, "-shearDist without a number", usage),
        };
        let shear = (long && span > 0.0).then_some((1.0 - share) * span);
        let mut fields = Ron::block("")
            .with("nodes", self.pair(nodes))
            .with("axis1", Ron::vector(&x))
            .with("axis2", Ron::vector(&y));
        if let Some(tilt) = tilt {
            match tilt.as_slice() {
                [i, j] | [i, j, _, _] => {
                    fields = fields.with("p_delta_at", Ron::vector(&[*i, *j]));
                    self.otherwise("the end that tilts pushes sideways as well");
                }
                _ => return wrong(0, "-pDelta without its two or four shares", usage),
            }
        }
        let name = format!("element {tag}");
        let mut written = Written { nodes, ..Written::default() };
        let (mut k, mut c) = ([0.0; 6], [0.0; 6]);
        for ((mat_word, material), (dir_word, dir)) in materials.into_iter().zip(dirs) {
            let axis = match (self.ndm, dir) {
                (2, 3) => 5,
                (3, 1..=6) | (2, 1 | 2 | 6) | (1, 1) => dir as usize - 1,
                _ => {
                    return wrong(
                        dir_word,
                        format!("there is no direction {dir} here"),
                        "1, 2, 3 along and 4, 5, 6 about local axes",
                    );
                }
            };
            match self.material_of(mat_word, material)? {
                None => self.lose(&format!("its material in direction {dir} was lost")),
                Some(material) => {
                    if let Some((stiffness, damping)) = material.linear() {
                        k[axis] += stiffness;
                        c[axis] += damping;
                        continue;
                    }
                    let laws: Vec<(&Law, f64, f64)> =
                        material.laws.iter().map(|l| (l, 1.0, 1.0)).collect();
                    let place = if axis == 1 || axis == 2 {
                        fields.clone().maybe("shear_at", shear)
                    } else {
                        fields.clone()
                    };
                    self.write_laws(&name, axis, &laws, &place, damped, &mut written);
                }
            }
        }
        let own = if written.links.is_empty() { name } else { format!("{name} linear") };
        let plain = match fields {
            Ron::Block(n, all) => {
                Ron::Block(n, all.into_iter().filter(|f| f.0 != "p_delta_at").collect())
            }
            other => other,
        };
        self.write_linear(&Place { name: own, fields: plain, shear, damped }, k, c, &mut written);
        for node in nodes {
            self.nodes[node].brought += mass / 2.0;
        }
        self.elements.insert(tag, written);
        self.changed();
        Ok(())
    }

    pub(super) fn element(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "element type tag …");
        match a.word("its type")? {
            "elasticBeamColumn" => self.beam(words, false),
            "ElasticTimoshenkoBeam" => self.beam(words, true),
            "truss" | "Truss" | "corotTruss" | "CorotTruss" => self.truss(words),
            "zeroLength" => self.link(words, false),
            "twoNodeLink" => self.link(words, true),
            "flatSliderBearing" => self.sliding(words, false),
            "singleFPBearing" | "singleFPSlider" => self.sliding(words, true),
            "elastomericBearingPlasticity" | "elastomericBearing" => self.rubber(words, false),
            "elastomericBearingBoucWen" => self.rubber(words, true),
            "TripleFrictionPendulum" => self.triple(words),
            _ => {
                self.lost("this element has no counterpart");
                Ok(())
            }
        }
    }

    /// A material that is linear, or lost by name.
    pub(super) fn linear_of(&mut self, material: Option<&Material>, what: &str) -> (f64, f64) {
        match material.map(Material::linear) {
            Some(Some(linear)) => linear,
            Some(None) => {
                self.lose(&format!("the material of {what} is not elastic: it is not written"));
                (0.0, 0.0)
            }
            None => (0.0, 0.0),
        }
    }
}

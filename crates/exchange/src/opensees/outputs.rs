//! Recorders become outputs.

use super::args::{Args, Told, wrong};
use super::links::LOCAL;
use super::recorder::Recorder;
use super::tcl::Value;
use crate::DOFS;
use crate::ron::Ron;

/// What an element of the script was written as.
#[derive(Clone, Debug, Default)]
pub struct Written {
    pub nodes: [usize; 2],
    /// The beam or truss.
    pub beam: Option<String>,
    /// Links and the directions that they have.
    pub links: Vec<(String, usize)>,
    /// What is linear beside them.
    pub linear: Option<String>,
}

impl Recorder<'_> {
    pub(super) fn recorder(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "recorder Node -file f -time -node 1 -dof 1 disp");
        match a.word("its type")? {
            "Node" | "EnvelopeNode" => self.node_recorder(&mut a),
            "Element" | "EnvelopeElement" => self.element_recorder(&mut a),
            "Drift" | "EnvelopeDrift" => self.drift_recorder(&mut a),
            _ => {
                self.lost("this recorder is not read");
                Ok(())
            }
        }
    }

    fn push(&mut self, name: String, block: Ron) {
        if !self.draft.outputs.iter().any(|(n, _)| *n == name) {
            self.draft.outputs.push((name, block));
        }
    }

    /// An option that all recorders have; true where it was one.
    fn common(&mut self, option: &str, a: &mut Args<'_>) -> bool {
        match option {
            "-file" | "-xml" | "-binary" | "-fileCSV" | "-xmlFile" => {
                a.option();
                self.ignore(option, "outputs are named by what they are");
            }
            "-time" | "-closeOnWrite" | "-scientific" => {
                self.ignore(option, "histories have their times and all digits")
            }
            "-dT" | "-dt" | "-precision" | "-rTolDt" => {
                a.option();
                self.ignore(option, "outputs are written at the step of the case");
            }
            _ => return false,
        }
        true
    }

    fn node_recorder(&mut self, a: &mut Args<'_>) -> Told<()> {
        let (mut nodes, mut dofs, mut what, mut absolute) = (Vec::new(), Vec::new(), None, false);
        while let Some(option) = a.option() {
            match option {
                "-node" | "-nodes" => {
                    while let Some((word, tag)) = {
                        let word = a.at();
                        a.maybe_whole().map(|t| (word, t))
                    } {
                        nodes.push(self.node(word, tag)?);
                    }
                    if a.flag("all") {
                        nodes.extend(self.by_tag.values().copied());
                    }
                }
                "-nodeRange" => {
                    let (first, last) = (a.whole("the first node")?, a.whole("the last node")?);
                    nodes.extend(
                        self.by_tag
                            .iter()
                            .filter(|(t, _)| (first..=last).contains(*t))
                            .map(|(_, n)| *n),
                    );
                }
                "-dof" | "-dofs" => dofs = a.wholes(),
                "-timeSeries" => {
                    a.all();
                    absolute = true;
                }
                "disp" | "vel" | "accel" | "reaction" => what = Some(option),
                other if self.common(other, a) => {}
                other => self.unread(other),
            }
        }
        let Some(what) = what else {
            self.lose("a response other than disp, vel, accel and reaction is not recorded");
            return Ok(());
        };
        if absolute && what != "accel" {
            self.lose("only accelerations are recorded with the motion of the ground");
        }
        nodes.sort_unstable();
        nodes.dedup();
        for node in nodes {
            let name = self.draft.nodes[node].0.clone();
            let ndf = self.nodes[node].ndf;
            for dof in dofs.iter().filter_map(|d| self.direction(ndf, *d)).collect::<Vec<_>>() {
                let held = self.draft.supports.get(&node).is_some_and(|h| h[dof]);
                let (kind, said) = match what {
                    "disp" => ("Displacement", ""),
                    "vel" => ("Velocity", " velocity"),
                    "accel" => ("Acceleration", " acceleration"),
                    _ => ("Reaction", " reaction"),
                };
                if kind == "Reaction" && !held {
                    self.otherwise(
                        "a reaction of a node that nothing holds is zero: it is not recorded",
                    );
                    continue;
                }
                let mut block = Ron::block(kind)
                    .with("node", Ron::text(&name))
                    .with("dof", Ron::word(DOFS[dof]));
                if absolute && kind == "Acceleration" {
                    block = block.with("absolute", Ron::word("true"));
                }
                self.push(format!("{name} {}{said}", DOFS[dof]), block);
            }
        }
        Ok(())
    }

    fn element_recorder(&mut self, a: &mut Args<'_>) -> Told<()> {
        let (mut tags, mut what): (Vec<(usize, i64)>, Vec<&str>) = (Vec::new(), Vec::new());
        while let Some(option) = a.option() {
            match option {
                "-ele" | "-eles" => {
                    while let Some(tag) = {
                        let word = a.at();
                        a.maybe_whole().map(|t| (word, t))
                    } {
                        tags.push(tag);
                    }
                    if a.flag("all") {
                        tags.extend(self.elements.keys().map(|t| (0, *t)));
                    }
                }
                "-eleRange" => {
                    let (first, last) =
                        (a.whole("the first element")?, a.whole("the last element")?);
                    tags.extend(self.elements.range(first..=last.max(first)).map(|(t, _)| (0, *t)));
                }
                "-dof" => {
                    a.all();
                    self.ignore("-dof", "all directions are recorded");
                }
                other if self.common(other, a) => {}
                other => what.push(other),
            }
        }
        let deformation = what.iter().any(|w| {
            [
                "deformation",
                "deformations",
                "basicDeformation",
                "basicDeformations",
                "basicDisplacement",
                "deformationsANDforces",
            ]
            .contains(w)
        });
        let force = what.iter().any(|w| {
            let w = w.to_lowercase();
            w.ends_with("force") || w.ends_with("forces") || w.ends_with("anddeformation")
        });
        if !force && !deformation {
            self.lose(&format!(
                "the response `{}` is not recorded",
                super::args::short(&what.join(" "))
            ));
            return Ok(());
        }
        for (word, tag) in tags {
            let Some(written) = self.elements.get(&tag).cloned() else {
                if word == 0 || !self.draft.nodes.is_empty() {
                    self.lose(&format!("element {tag} is not there, or was lost"));
                    continue;
                }
                return wrong(word, format!("there is no element {tag}"), "");
            };
            for (link, axis) in &written.links {
                let wanted = [
                    (force, "LinkForce", "force"),
                    (deformation, "LinkDeformation", "deformation"),
                ];
                for (_, kind, said) in wanted.iter().filter(|w| w.0) {
                    let block = Ron::block(kind)
                        .with("link", Ron::text(link))
                        .with("axis", Ron::word(LOCAL[*axis]));
                    self.push(format!("element {tag} {} {said}", LOCAL[*axis]), block);
                }
            }
            let linear = written.beam.as_ref().or(written.linear.as_ref());
            if let (Some(beam), true) = (linear, force) {
                if what.iter().any(|w| {
                    w.starts_with("local") || w.starts_with("axial") || w.starts_with("basic")
                }) {
                    self.otherwise(
                        "forces of beams and springs are recorded along global directions",
                    );
                }
                // What a damping of the stiffness would turn into a link has no such output.
                if self.undamped.iter().any(|u| u.name == *beam) {
                    let shown =
                        self.draft.elements.iter().any(|(n, e)| n == beam && e.name() == "Truss");
                    let other = if shown { "its axial force" } else { "its forces" };
                    self.otherwise(&format!(
                        "{other} is recorded where nothing but the mass damps it"
                    ));
                }
                for (end, node) in written.nodes.iter().enumerate() {
                    let ndf = self.nodes[*node].ndf;
                    for dof in
                        (1..=ndf as i64).filter_map(|d| self.direction(ndf, d)).collect::<Vec<_>>()
                    {
                        let block = Ron::block("ElementForce")
                            .with("element", Ron::text(beam))
                            .with("end", end as f64)
                            .with("dof", Ron::word(DOFS[dof]));
                        self.push(
                            format!("element {tag} end {} {}", ["i", "j"][end], DOFS[dof]),
                            block,
                        );
                    }
                }
            }
        }
        Ok(())
    }

    fn drift_recorder(&mut self, a: &mut Args<'_>) -> Told<()> {
        let (mut low, mut high, mut dof, mut normal) = (Vec::new(), Vec::new(), None, None);
        while let Some(option) = a.option() {
            let end = match option {
                "-iNode" => Some(&mut low),
                "-jNode" => Some(&mut high),
                _ => None,
            };
            if let Some(end) = end {
                while let Some(tag) = {
                    let word = a.at();
                    a.maybe_whole().map(|t| (word, t))
                } {
                    end.push(tag);
                }
                continue;
            }
            match option {
                "-dof" => dof = Some((a.at(), a.whole("the direction")?)),
                "-perpDirn" => normal = Some((a.at(), a.whole("the direction of the storey")?)),
                other if self.common(other, a) => {}
                other => self.unread(other),
            }
        }
        let (Some((_, dof)), Some((word, normal))) = (dof, normal) else {
            return wrong(
                0,
                "a drift without -dof and -perpDirn",
                "recorder Drift -iNode 1 -jNode 2 -dof 1 -perpDirn 2",
            );
        };
        for ((wi, i), (wj, j)) in low.into_iter().zip(high) {
            let (i, j) = (self.node(wi, i)?, self.node(wj, j)?);
            let axis = usize::try_from(normal - 1).unwrap_or(9);
            let rise = if axis < self.ndm { self.at(j)[axis] - self.at(i)[axis] } else { 0.0 };
            let Some(direction) = self.direction(self.nodes[i].ndf, dof).filter(|_| rise != 0.0)
            else {
                return wrong(
                    word,
                    "a drift without a height between its nodes",
                    "-perpDirn along which they lie apart",
                );
            };
            let (ni, nj) = (self.draft.nodes[i].0.clone(), self.draft.nodes[j].0.clone());
            let term = |name: &str, factor: f64| {
                Ron::block("")
                    .with("node", Ron::text(name))
                    .with("dof", Ron::word(DOFS[direction]))
                    .with("factor", factor)
            };
            let terms = Ron::List(vec![term(&nj, 1.0), term(&ni, -1.0)]);
            let block = Ron::block("Displacement").with("terms", terms);
            self.otherwise("a drift is the difference of displacements, not divided by the height");
            self.push(format!("drift {ni} {nj} {}", DOFS[direction]), block);
        }
        Ok(())
    }
}

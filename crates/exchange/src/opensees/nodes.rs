//! Nodes, masses, supports, constraints.

use super::args::{Args, Told, wrong};
use super::recorder::{Node, Recorder};
use super::tcl::Value;
use crate::draft::DOFS;
use crate::ron::Ron;

impl Recorder<'_> {
    pub(super) fn model(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "model BasicBuilder -ndm 2 -ndf 3");
        let kind = a.word("its kind")?;
        if !kind.to_lowercase().starts_with("basic") {
            return wrong(1, format!("`{kind}` is no builder that is read"), "BasicBuilder");
        }
        let (mut ndm, mut ndf) = (None, None);
        while let Some(option) = a.option() {
            match option {
                "-ndm" => ndm = Some((a.at(), a.whole("the number of dimensions")?)),
                "-ndf" => ndf = Some((a.at(), a.whole("the number of degrees of freedom")?)),
                other => self.unread(other),
            }
        }
        let Some((word, dimensions)) = ndm else {
            return wrong(
                0,
                "`model` without the number of dimensions",
                "model BasicBuilder -ndm 2 -ndf 3",
            );
        };
        if !(1..=3).contains(&dimensions) {
            return wrong(word, format!("{dimensions} dimensions"), "1, 2 or 3");
        }
        let usual = [1, 3, 6][dimensions as usize - 1];
        let (word, freedoms) = ndf.unwrap_or((0, usual));
        let fits = matches!((dimensions, freedoms), (1, 1) | (2, 2 | 3) | (3, 3 | 6));
        if !fits {
            let message = format!("{freedoms} degrees of freedom in {dimensions} dimensions");
            return wrong(word, message, "1 in 1, 2 or 3 in 2, 3 or 6 in 3 dimensions");
        }
        if self.ndm != 0 && self.ndm != dimensions as usize {
            return wrong(
                word,
                "a model that changes its dimensions",
                "one model with the same `-ndm` everywhere",
            );
        }
        (self.ndm, self.ndf) = (dimensions as usize, freedoms as usize);
        self.draft.plane = (self.ndm < 3).then_some("XY");
        Ok(())
    }

    pub(super) fn add_node(&mut self, words: &[Value]) -> Told<()> {
        self.begun()?;
        let mut a = Args::new(words, 1, "node tag x y …");
        let tag = a.whole("its tag")?;
        if self.by_tag.contains_key(&tag) {
            return wrong(
                1,
                format!("there are two nodes {tag}"),
                "every node has a tag of its own",
            );
        }
        let mut at = [0.0; 3];
        for x in at.iter_mut().take(self.ndm) {
            *x = a.number("a coordinate")?;
        }
        let mut node = Node { ndf: self.ndf, mass: [0.0; 6], brought: 0.0 };
        let mut mass = None;
        while let Some(option) = a.option() {
            match option {
                "-mass" => mass = Some((a.at(), a.all())),
                "-ndf" => {
                    node.ndf =
                        usize::try_from(a.whole("the number of degrees of freedom")?).unwrap_or(0);
                    if !matches!((self.ndm, node.ndf), (1, 1) | (2, 2 | 3) | (3, 3 | 6)) {
                        return wrong(
                            a.at() - 1,
                            "degrees of freedom that a node here does not have",
                            "as in `model`",
                        );
                    }
                }
                other => {
                    let said = super::tcl::Number::read(other).is_some();
                    if said {
                        let message = format!("`node` with more than {} coordinates", self.ndm);
                        return wrong(a.at() - 1, message, "the model has fewer dimensions");
                    }
                    self.unread(other);
                }
            }
        }
        let index = self.draft.nodes.len();
        self.draft.nodes.push((tag.to_string(), at));
        self.by_tag.insert(tag, index);
        let held = match (self.ndm, node.ndf) {
            (1, _) => [false, true, false, false, false, true],
            (2, 2) => [false, false, false, false, false, true],
            (3, 3) => [false, false, false, true, true, true],
            _ => [false; 6],
        };
        if held != [false; 6] {
            self.draft.supports.insert(index, held);
        }
        self.nodes.push(node);
        if let Some((word, values)) = mass {
            self.set_mass(index, word, &values)?;
        }
        self.changed();
        Ok(())
    }

    fn set_mass(&mut self, node: usize, word: usize, values: &[f64]) -> Told<()> {
        let ndf = self.nodes[node].ndf;
        if values.len() != ndf {
            let message = format!("{} masses for {ndf} degrees of freedom", values.len());
            return wrong(word, message, "one for each");
        }
        let mut mass = [0.0; 6];
        for (k, m) in values.iter().enumerate() {
            if *m < 0.0 {
                return wrong(word + k, "a mass below zero", "");
            }
            mass[self.direction(ndf, k as i64 + 1).unwrap_or(0)] = *m;
        }
        self.nodes[node].mass = mass;
        Ok(())
    }

    pub(super) fn mass(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "mass node m1 m2 …");
        let tag = a.whole("its node")?;
        let node = self.node(1, tag)?;
        let mut values = Vec::new();
        while a.peek().is_some() {
            values.push(a.number("a mass")?);
        }
        self.changed();
        self.set_mass(node, 2, &values)
    }

    pub(super) fn fix(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "fix node 1 1 0");
        let tag = a.whole("its node")?;
        let node = self.node(1, tag)?;
        let ndf = self.nodes[node].ndf;
        for dof in 1..=ndf {
            let word = a.at();
            match a.whole("0 or 1 for each degree of freedom")? {
                0 => {}
                1 => self.hold(node, dof as i64),
                other => {
                    return wrong(
                        word,
                        format!("`{other}` is neither 0 nor 1"),
                        "1 where it is held",
                    );
                }
            }
        }
        if a.peek().is_some() {
            let message = format!("`fix` with more than {ndf} degrees of freedom");
            return wrong(a.at(), message, "the node has fewer");
        }
        self.changed();
        Ok(())
    }

    fn hold(&mut self, node: usize, dof: i64) {
        if let Some(d) = self.direction(self.nodes[node].ndf, dof) {
            self.draft.supports.entry(node).or_default()[d] = true;
        }
    }

    pub(super) fn fix_plane(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "fixY coordinate 1 1 0 -tol 1e-10");
        let at = a.number("the coordinate")?;
        let axis = usize::from(words[0].str().as_bytes()[3] - b'X');
        let flags = a.wholes();
        let tolerance = if a.flag("-tol") { a.number("the tolerance")? } else { 1e-10 };
        if let Some(other) = a.peek() {
            return wrong(
                a.at(),
                format!("`{other}` is not expected"),
                "flags of 0 and 1, then -tol",
            );
        }
        for node in 0..self.nodes.len() {
            if (self.at(node)[axis] - at).abs() <= tolerance
                && self.by_tag.values().any(|n| *n == node)
            {
                for (k, flag) in flags.iter().enumerate().filter(|(_, f)| **f != 0) {
                    let _ = flag;
                    self.hold(node, k as i64 + 1);
                }
            }
        }
        self.changed();
        Ok(())
    }

    fn named(&self, node: usize) -> Ron {
        Ron::text(&self.draft.nodes[node].0)
    }

    /// Adds a constraint, with a name of its own.
    fn constraint(&mut self, kind: &str, nodes: &[usize], more: &[(&str, Ron)]) {
        let count = self.draft.elements.iter().filter(|(_, e)| e.name() == kind).count();
        let word = match kind {
            "EqualDof" => "equal",
            "Diaphragm" => "diaphragm",
            _ => "rigid",
        };
        let list = Ron::Tuple(nodes.iter().map(|n| self.named(*n)).collect());
        let block = more
            .iter()
            .fold(Ron::block(kind).with("nodes", list), |b, (k, v)| b.with(k, v.clone()));
        self.draft.elements.push((format!("{word} {}", count + 1), block));
        self.changed();
    }

    pub(super) fn equal_dof(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "equalDOF retained constrained 1 2");
        let first = a.whole("the retained node")?;
        let second = a.whole("the constrained node")?;
        let nodes = [self.node(1, first)?, self.node(2, second)?];
        let mut dofs = Vec::new();
        while a.peek().is_some() {
            let word = a.at();
            let dof = a.whole("a degree of freedom")?;
            match self.direction(self.nodes[nodes[1]].ndf, dof) {
                Some(d) => dofs.push(DOFS[d]),
                None => {
                    return wrong(word, format!("the nodes have no degree of freedom {dof}"), "");
                }
            }
        }
        if dofs.is_empty() {
            return wrong(
                0,
                "`equalDOF` without a degree of freedom",
                "equalDOF retained constrained 1 2",
            );
        }
        self.constraint("EqualDof", &nodes, &[("dofs", Ron::words(&dofs))]);
        Ok(())
    }

    pub(super) fn rigid_link(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "rigidLink beam retained constrained");
        let kind = a.word("beam or bar")?;
        let first = a.whole("the retained node")?;
        let second = a.whole("the constrained node")?;
        let nodes = [self.node(2, first)?, self.node(3, second)?];
        match kind {
            "beam" | "-beam" => self.constraint("RigidLink", &nodes, &[]),
            "bar" | "rod" | "-bar" | "-rod" => {
                let dofs = &DOFS[..self.ndm];
                self.constraint("EqualDof", &nodes, &[("dofs", Ron::words(dofs))]);
            }
            _ => return wrong(1, format!("`{kind}` is no rigid link"), "beam or bar"),
        }
        Ok(())
    }

    pub(super) fn diaphragm(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "rigidDiaphragm 3 retained constrained …");
        let normal = a.whole("the direction normal to it")?;
        let axis = match (self.ndm, normal) {
            (3, 1..=3) => ["X", "Y", "Z"][normal as usize - 1],
            _ => {
                return wrong(
                    1,
                    format!("a diaphragm normal to {normal}"),
                    "1, 2 or 3, in three dimensions",
                );
            }
        };
        let mut nodes = Vec::new();
        while a.peek().is_some() {
            let word = a.at();
            let tag = a.whole("a node")?;
            nodes.push(self.node(word, tag)?);
        }
        if nodes.len() < 2 {
            return wrong(
                0,
                "`rigidDiaphragm` with fewer than two nodes",
                "rigidDiaphragm 3 retained constrained …",
            );
        }
        self.constraint("Diaphragm", &nodes, &[("normal", Ron::word(axis))]);
        Ok(())
    }

    pub(super) fn coordinates(&mut self, words: &[Value]) -> Told<Value> {
        let mut a = Args::new(words, 1, "nodeCoord node 1");
        let tag = a.whole("a node")?;
        let at = self.at(self.node(1, tag)?);
        let texts: Vec<String> = at[..self.ndm].iter().map(|x| format!("{x:?}")).collect();
        match a.maybe_whole() {
            Some(k) => match usize::try_from(k - 1).ok().and_then(|k| texts.get(k)) {
                Some(text) => Ok(Value::new(text.clone())),
                None => wrong(2, format!("a node has no coordinate {k}"), ""),
            },
            None => Ok(Value::list(&texts)),
        }
    }
}

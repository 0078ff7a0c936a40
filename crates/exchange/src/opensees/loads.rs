//! Patterns of loads, motions of the ground and of supports.

use super::args::{Args, Told, wrong};
use super::recorder::Recorder;
use super::series::Series;
use super::tcl::{Reply, Value};
use crate::ron::Ron;
use std::collections::BTreeMap;

/// What a pattern does.
#[derive(Clone, Debug)]
pub enum Kind {
    Plain,
    /// An acceleration of the ground along a direction.
    Ground {
        direction: &'static str,
    },
    /// Supports that move: node, direction, motion.
    Supports {
        moves: Vec<(usize, usize, Series)>,
    },
}

/// A pattern.
#[derive(Clone, Debug)]
pub struct Pattern {
    pub tag: i64,
    pub name: String,
    pub kind: Kind,
    pub series: Option<Series>,
    /// Factor of all that it holds.
    pub factor: f64,
    pub forces: BTreeMap<usize, [f64; 6]>,
    /// Loads along members.
    pub along: Vec<Ron>,
    /// Its value since `loadConst`.
    pub frozen: Option<f64>,
    /// How much of it the cases so far have put on.
    pub applied: f64,
    /// Motions of the supports of this pattern.
    pub motions: BTreeMap<i64, Option<Series>>,
}

impl Pattern {
    /// Its factor at a time.
    pub fn value(&self, t: f64) -> f64 {
        let live = || self.series.as_ref().map_or(0.0, |s| s.value(t)) * self.factor;
        self.frozen.unwrap_or_else(live)
    }
}

impl Recorder<'_> {
    pub(super) fn pattern(&mut self, words: &[Value]) -> Told<Reply> {
        self.begun()?;
        let mut a = Args::new(words, 1, "pattern Plain tag series {loads}");
        let kind = a.word("its type")?;
        let tag = a.whole("its tag")?;
        if self.patterns.iter().any(|p| p.tag == tag) {
            return wrong(
                2,
                format!("there are two patterns {tag}"),
                "every pattern has a tag of its own",
            );
        }
        let mut pattern = Pattern {
            tag,
            name: format!("pattern {tag}"),
            kind: Kind::Plain,
            series: None,
            factor: 1.0,
            forces: BTreeMap::new(),
            along: Vec::new(),
            frozen: None,
            applied: 0.0,
            motions: BTreeMap::new(),
        };
        let mut body = None;
        match kind {
            "Plain" => {
                pattern.series = self.series_of(&mut a, &format!("series of pattern {tag}"))?;
                while let Some(word) = a.peek() {
                    if a.flag("-fact") || a.flag("-factor") {
                        pattern.factor = a.number("the factor")?;
                    } else if word.starts_with('-') {
                        a.option();
                        self.unread(word);
                    } else {
                        body = Some(a.value("its loads")?.clone());
                    }
                }
            }
            "UniformExcitation" => {
                let word = a.at();
                let dir = a.whole("its direction")?;
                let direction = match (self.ndm, dir) {
                    (_, 1) => "X",
                    (2 | 3, 2) => "Y",
                    (3, 3) => "Z",
                    _ => {
                        self.lost("a ground that turns is not read");
                        return Ok(Reply::Value(Value::empty()));
                    }
                };
                let _ = word;
                pattern.kind = Kind::Ground { direction };
                while let Some(option) = a.option() {
                    match option {
                        "-accel" => {
                            pattern.series =
                                self.series_of(&mut a, &format!("ground of pattern {tag}"))?
                        }
                        "-fact" | "-factor" => pattern.factor = a.number("the factor")?,
                        "-vel0" => {
                            if a.number("a velocity")? != 0.0 {
                                self.lose("a velocity of the ground at its start is not read");
                            }
                        }
                        "-disp" | "-vel" => {
                            a.option();
                            self.lose("the ground moves by its acceleration alone here");
                        }
                        other => self.unread(other),
                    }
                }
                if pattern.series.is_none() {
                    self.lost("a motion of the ground without an acceleration that is read");
                    return Ok(Reply::Value(Value::empty()));
                }
            }
            "MultipleSupport" => {
                pattern.kind = Kind::Supports { moves: Vec::new() };
                body = Some(a.value("its motions")?.clone());
            }
            _ => {
                self.lost("this pattern is not read");
                return Ok(Reply::Value(Value::empty()));
            }
        }
        self.patterns.push(pattern);
        self.changed();
        Ok(match body {
            Some(body) => {
                self.open = Some(self.patterns.len() - 1);
                Reply::Block(body)
            }
            None => Reply::Value(Value::empty()),
        })
    }

    fn opened(&mut self) -> Told<usize> {
        match self.open {
            Some(k) => Ok(k),
            None => wrong(
                0,
                "a load outside of a pattern",
                "it stands in the braces of a `pattern Plain`",
            ),
        }
    }

    pub(super) fn load(&mut self, words: &[Value]) -> Told<()> {
        let at = self.opened()?;
        let mut a = Args::new(words, 1, "load node F1 F2 …");
        let tag = a.whole("its node")?;
        let node = self.node(1, tag)?;
        let ndf = self.nodes[node].ndf;
        let mut values = [0.0; 6];
        for dof in 1..=ndf {
            let x = a.number("a force for each degree of freedom")?;
            values[self.direction(ndf, dof as i64).unwrap_or(0)] = x;
        }
        while let Some(option) = a.option() {
            match option {
                "-const" => self.lose(
                    "a load that is constant in a pattern that varies (-const) varies with it",
                ),
                other => self.unread(other),
            }
        }
        let to = self.patterns[at].forces.entry(node).or_default();
        to.iter_mut().zip(values).for_each(|(a, b)| *a += b);
        self.changed();
        Ok(())
    }

    pub(super) fn element_load(&mut self, words: &[Value]) -> Told<()> {
        let at = self.opened()?;
        let mut a = Args::new(words, 1, "eleLoad -ele tag … -type -beamUniform Wy");
        let mut members: Vec<(usize, i64)> = Vec::new();
        let mut made: Vec<Ron> = Vec::new();
        while let Some(option) = a.option() {
            match option {
                "-ele" => {
                    while let Some(tag) = {
                        let word = a.at();
                        a.maybe_whole().map(|t| (word, t))
                    } {
                        members.push(tag);
                    }
                }
                "-range" => {
                    let (first, last) =
                        (a.whole("the first element")?, a.whole("the last element")?);
                    members
                        .extend(self.elements.range(first..=last.max(first)).map(|(t, _)| (0, *t)));
                }
                "-type" => {}
                "-beamUniform" | "beamUniform" => {
                    let n = if self.ndm == 3 { 2 } else { 1 };
                    let mut cross = [0.0; 2];
                    for x in cross.iter_mut().take(n) {
                        *x = a.number("a force by length")?;
                    }
                    let axial = a.maybe().unwrap_or(0.0);
                    if !a.all().is_empty() {
                        self.lose("a load along a part of a beam acts along all of it");
                    }
                    for (axis, w) in [("U2", cross[0]), ("U3", cross[1]), ("U1", axial)] {
                        if w != 0.0 {
                            made.push(
                                Ron::block("Uniform")
                                    .with("axis", Ron::word(axis))
                                    .with("force", w),
                            );
                        }
                    }
                }
                "-beamPoint" | "beamPoint" => {
                    let n = if self.ndm == 3 { 2 } else { 1 };
                    let mut cross = [0.0; 2];
                    for x in cross.iter_mut().take(n) {
                        *x = a.number("a force")?;
                    }
                    let word = a.at();
                    let share = a.number("its place")?;
                    if !(0.0..=1.0).contains(&share) {
                        return wrong(
                            word,
                            format!("a place of {share}"),
                            "a share of the length, from 0 to 1",
                        );
                    }
                    let axial = a.maybe().unwrap_or(0.0);
                    for (axis, w) in [("U2", cross[0]), ("U3", cross[1]), ("U1", axial)] {
                        if w != 0.0 {
                            let place = Ron::text(format!("{} %", share * 100.0));
                            made.push(
                                Ron::block("Point")
                                    .with("at", place)
                                    .with("axis", Ron::word(axis))
                                    .with("force", w),
                            );
                        }
                    }
                }
                other => {
                    self.lose(&format!(
                        "a load of the type {} is not written",
                        super::args::short(other)
                    ));
                    return Ok(());
                }
            }
        }
        for (word, tag) in members {
            let Some(written) = self.elements.get(&tag) else {
                return wrong(
                    word,
                    format!("there is no element {tag}"),
                    "elements stand before their loads",
                );
            };
            let Some(beam) = written.beam.clone() else {
                self.lose("a load along an element that is no beam is not written");
                continue;
            };
            for block in &made {
                let Ron::Block(name, fields) = block else { continue };
                let mut all = vec![("element".to_owned(), Ron::text(&beam))];
                all.extend(fields.iter().cloned());
                self.patterns[at].along.push(Ron::Block(name.clone(), all));
            }
        }
        self.changed();
        Ok(())
    }

    pub(super) fn single_point(&mut self, words: &[Value]) -> Told<()> {
        let at = self.opened()?;
        let mut a = Args::new(words, 1, "sp node dof value");
        let tag = a.whole("its node")?;
        let node = self.node(1, tag)?;
        let word = a.at();
        let dof = a.whole("the degree of freedom")?;
        let value = a.number("the displacement")?;
        let Some(direction) = self.direction(self.nodes[node].ndf, dof) else {
            return wrong(word, format!("node {tag} has no degree of freedom {dof}"), "");
        };
        if a.flag("-const") {
            self.lose("a displacement that is constant (-const) varies with its pattern");
        }
        self.draft.supports.entry(node).or_default()[direction] = true;
        if value != 0.0 {
            let Some(mut series) = self.patterns[at].series.clone() else { return Ok(()) };
            series.factor *= value;
            let pattern = &mut self.patterns[at];
            if matches!(pattern.kind, Kind::Plain)
                && pattern.forces.is_empty()
                && pattern.along.is_empty()
            {
                pattern.kind = Kind::Supports { moves: Vec::new() };
            }
            match &mut pattern.kind {
                Kind::Supports { moves } => moves.push((node, direction, series)),
                _ => self.lose("a displacement beside forces of the same pattern is not written: the support stays"),
            }
        }
        self.changed();
        Ok(())
    }

    pub(super) fn ground_motion(&mut self, words: &[Value]) -> Told<()> {
        let at = self.opened()?;
        let mut a = Args::new(words, 1, "groundMotion tag Plain -disp series");
        let tag = a.whole("its tag")?;
        let kind = a.word("its type")?;
        let mut motion = None;
        if kind != "Plain" {
            self.lose(&format!("a motion of the type {} is not read", super::args::short(kind)));
        }
        while let Some(option) = a.option() {
            match option {
                "-disp" => motion = self.series_of(&mut a, &format!("motion {tag}"))?,
                "-vel" | "-accel" => {
                    self.series_of(&mut a, &format!("motion {tag}"))?;
                    self.ignore(option, "a support moves by its displacement");
                }
                "-fact" | "-factor" => {
                    let f = a.number("the factor")?;
                    if let Some(m) = &mut motion {
                        m.factor *= f;
                    }
                }
                "-int" => {
                    a.option();
                    self.ignore("-int", "nothing is integrated");
                }
                other => self.unread(other),
            }
        }
        if motion.is_none() {
            self.lose("a motion without a displacement (-disp) is not written");
        }
        self.patterns[at].motions.insert(tag, motion);
        Ok(())
    }

    pub(super) fn imposed_motion(&mut self, words: &[Value]) -> Told<()> {
        let at = self.opened()?;
        let mut a = Args::new(words, 1, "imposedMotion node dof motion");
        let (tag, dof, motion) =
            (a.whole("its node")?, a.whole("the degree of freedom")?, a.whole("its motion")?);
        let node = self.node(1, tag)?;
        let Some(direction) = self.direction(self.nodes[node].ndf, dof) else {
            return wrong(2, format!("node {tag} has no degree of freedom {dof}"), "");
        };
        let Some(series) = self.patterns[at].motions.get(&motion).cloned() else {
            return wrong(
                3,
                format!("there is no motion {motion}"),
                "`groundMotion` stands before it",
            );
        };
        self.draft.supports.entry(node).or_default()[direction] = true;
        if let (Kind::Supports { moves }, Some(series)) = (&mut self.patterns[at].kind, series) {
            moves.push((node, direction, series));
        }
        self.changed();
        Ok(())
    }
}

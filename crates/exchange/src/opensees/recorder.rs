//! The model that the commands of a script build.

use super::analysis::Analysis;
use super::args::{Told, Wrong, wrong};
use super::commands::{self, CHOICES, COMMANDS, LOST, QUESTIONS};
use super::loads::Pattern;
use super::materials::{Friction, Material};
use super::outputs::Written;
use super::series::Series;
use super::tcl::{Call, Host, Reply, Value};
use super::{Eigenvalues, Options};
use crate::ron::Ron;
use crate::{Draft, Fate, Report, TableReport};
use std::collections::{BTreeMap, HashMap};

/// Most lines that a lost command is named with.
const SHOWN: usize = 8;

/// A node.
#[derive(Clone, Debug)]
pub struct Node {
    /// Its degrees of freedom.
    pub ndf: usize,
    /// Masses in global directions, of the node itself.
    pub mass: [f64; 6],
    /// Masses that elements bring to it.
    pub brought: f64,
}

/// How local axes of beams lie, and what else belongs to it.
#[derive(Clone, Debug)]
pub struct Transform {
    pub kind: String,
    pub plane: Option<[f64; 3]>,
    pub offsets: [[f64; 3]; 2],
}

/// A section that stays elastic.
#[derive(Clone, Copy, Debug, Default)]
pub struct Section {
    pub e: f64,
    pub a: f64,
    pub iz: f64,
    pub iy: f64,
    pub g: f64,
    pub j: f64,
    pub shear: [f64; 2],
}

/// What a damping of the stiffness must not act on: the element and what it is instead.
pub struct Undamped {
    pub name: String,
    pub instead: Ron,
    pub masses: Vec<(usize, f64)>,
}

/// The model in the making.
pub struct Recorder<'a> {
    pub options: &'a Options,
    pub oracle: &'a dyn Eigenvalues,
    pub draft: Draft,
    pub report: Report,
    pub files: Vec<(String, String)>,
    pub ndm: usize,
    pub ndf: usize,
    pub nodes: Vec<Node>,
    pub by_tag: HashMap<i64, usize>,
    pub elements: BTreeMap<i64, Written>,
    pub materials: HashMap<i64, Option<Material>>,
    pub frictions: HashMap<i64, Option<Friction>>,
    pub sections: HashMap<i64, Section>,
    pub transforms: HashMap<i64, Transform>,
    pub series: HashMap<i64, Series>,
    pub patterns: Vec<Pattern>,
    pub open: Option<usize>,
    pub undamped: Vec<Undamped>,
    pub analysis: Analysis,
    /// Line of the command that is read, and its name.
    pub line: String,
    pub command: String,
    /// Nothing more is read: the model was wiped.
    pub ended: bool,
    commands: Vec<(String, usize, Option<String>)>,
    lost: Vec<(String, String, Vec<String>, usize)>,
}

impl<'a> Recorder<'a> {
    /// Nothing yet.
    pub fn new(options: &'a Options, oracle: &'a dyn Eigenvalues) -> Self {
        Self {
            options,
            oracle,
            draft: Draft::default(),
            report: Report::default(),
            files: Vec::new(),
            ndm: 0,
            ndf: 0,
            nodes: Vec::new(),
            by_tag: HashMap::new(),
            elements: BTreeMap::new(),
            materials: HashMap::new(),
            frictions: HashMap::new(),
            sections: HashMap::new(),
            transforms: HashMap::new(),
            series: HashMap::new(),
            patterns: Vec::new(),
            open: None,
            undamped: Vec::new(),
            analysis: Analysis::default(),
            line: String::new(),
            command: String::new(),
            ended: false,
            commands: Vec::new(),
            lost: Vec::new(),
        }
    }

    /// Names a loss at the line of the command.
    pub fn lose(&mut self, what: &str) {
        self.report.lose(&self.command, what, &self.line);
    }

    /// Names what is said otherwise.
    pub fn otherwise(&mut self, what: &str) {
        self.report.otherwise(&self.command, what, &self.line);
    }

    /// Names an argument that is left out knowingly.
    pub fn ignore(&mut self, argument: &str, why: &str) {
        self.report.ignore(&format!("{}: {argument}", self.command), why);
    }

    /// An argument that is not among those that are read.
    pub fn unread(&mut self, argument: &str) {
        self.lose(&format!("the argument `{}` is not read", super::args::short(argument)));
    }

    /// The whole command is lost.
    pub fn lost(&mut self, why: &str) {
        let (name, line) = (self.command.clone(), self.line.clone());
        if let Some(last) = self.commands.iter_mut().find(|c| c.0 == name) {
            last.1 -= 1;
        }
        let found = self.lost.iter().position(|l| l.0 == name && l.1 == why);
        let at = found.unwrap_or_else(|| {
            self.lost.push((name, why.into(), Vec::new(), 0));
            self.lost.len() - 1
        });
        self.lost[at].3 += 1;
        if self.lost[at].2.len() < SHOWN {
            self.lost[at].2.push(line);
        }
    }

    /// Puts what became of all commands into the report.
    pub fn settle(&mut self) {
        for (name, rows, ignored) in self.commands.drain(..).filter(|c| c.1 > 0) {
            let fate = ignored.map_or(Fate::Read, Fate::Ignored);
            self.report.tables.push(TableReport { name, rows, fate });
        }
        for (name, why, lines, rows) in self.lost.drain(..) {
            let more = if rows > lines.len() { ", …" } else { "" };
            let fate = Fate::Lost(format!("{why} ({}{more})", lines.join(", ")));
            self.report.tables.push(TableReport { name, rows, fate });
        }
    }

    fn counted(&mut self, ignored: Option<&str>) {
        match self.commands.iter_mut().find(|c| c.0 == self.command) {
            Some(known) => known.1 += 1,
            None => self.commands.push((self.command.clone(), 1, ignored.map(Into::into))),
        }
    }

    /// The node of a tag at a word.
    pub fn node(&self, word: usize, tag: i64) -> Told<usize> {
        match self.by_tag.get(&tag) {
            Some(node) => Ok(*node),
            None => {
                wrong(word, format!("there is no node {tag}"), "nodes stand before what uses them")
            }
        }
    }

    /// Name and position of a node.
    pub fn at(&self, node: usize) -> [f64; 3] {
        self.draft.nodes[node].1
    }

    /// The direction of a degree of freedom of a node, both counted as OpenSees counts them from 1.
    pub fn direction(&self, ndf: usize, dof: i64) -> Option<usize> {
        let dof = usize::try_from(dof).ok().filter(|d| (1..=ndf).contains(d))?;
        match (self.ndm, ndf, dof) {
            (2, 3, 3) => Some(5),
            _ => Some(dof - 1),
        }
    }

    /// True once nodes can be made.
    pub fn begun(&self) -> Told<()> {
        if self.ndm == 0 {
            return wrong(
                0,
                "there is no model yet",
                "`model BasicBuilder -ndm 2 -ndf 3` stands first",
            );
        }
        Ok(())
    }

    /// The end of the model: what follows is another one.
    pub fn wipe(&mut self) -> Told<()> {
        self.finish_analysis()?;
        self.ended = !self.draft.nodes.is_empty();
        Ok(())
    }
}

impl Host for Recorder<'_> {
    fn call(&mut self, call: &Call<'_>, line: &str) -> Reply {
        let name = call.words[0].str();
        self.line = line.into();
        self.command = name.into();
        let kinds = [
            "element",
            "uniaxialMaterial",
            "section",
            "pattern",
            "timeSeries",
            "frictionModel",
            "recorder",
        ];
        if let (true, Some(kind)) = (kinds.contains(&name), call.words.get(1)) {
            self.command = format!("{name} {}", super::args::short(kind.str()));
        }
        if self.ended {
            let known = commands::names().any(|n| n == name);
            if known && name != "wipe" {
                self.command = "wipe".into();
                self.lose("what follows the first model is not read: a script becomes one model");
            }
            return if known { Reply::Value(Value::new("0")) } else { Reply::Unknown };
        }
        if let Some((_, why)) = CHOICES.iter().find(|c| c.0 == name) {
            self.counted(Some(why));
            return Reply::Value(Value::empty());
        }
        if QUESTIONS.contains(&name) {
            self.counted(Some("results are not there yet when a script is imported"));
            return Reply::Value(Value::new(format!("{} {name}", super::UNKNOWN)));
        }
        if LOST.contains(&name) {
            self.counted(None);
            self.lost("this command has no counterpart");
            return Reply::Value(Value::empty());
        }
        self.counted(None);
        let Some((_, does)) = COMMANDS.iter().find(|c| c.0 == name) else { return Reply::Unknown };
        match does(self, call.words) {
            Ok(reply) => reply,
            Err(Wrong { word, message, help }) => Reply::Wrong(word, message, help),
        }
    }

    fn closed(&mut self) {
        self.open = None;
    }

    fn left_out(&mut self, command: &str, what: &str, line: &str) {
        self.command = command.into();
        self.line = line.into();
        self.counted(Some(what));
    }

    fn names(&self) -> Vec<&'static str> {
        commands::names().collect()
    }
}

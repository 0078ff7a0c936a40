//! Cases as stages of a script: static ones first, each going on from the one before, then the dynamic one.

use super::Writer;
use super::command::{Command, Word};
use super::freedoms::Freedoms;
use trilith_element::{Geometry, SpanLoad};
use trilith_model::{Analysis, DynamicCase, Load, MemberLoad, SolverKind};

/// Tag of the series that grows with the load factor, and of the one that stays.
pub(super) const LINEAR: i64 = 1;
pub(super) const CONSTANT: i64 = 2;

/// A static case.
pub(super) struct Static {
    pub name: String,
    pub commands: Vec<Command>,
    pub steps: usize,
}

/// What a dynamic case does.
#[derive(Default)]
pub(super) struct Dynamic {
    pub lines: Vec<String>,
    /// HHT's α as OpenSees counts it; 1 is Newmark's rule of average acceleration.
    pub alpha: f64,
    pub dt: f64,
    pub steps: usize,
    /// Functions that are used.
    pub functions: Vec<usize>,
    /// Motions of the ground: direction, function, factor.
    pub base: Vec<(usize, usize, f64)>,
    /// Something begins with a jump: accelerations at rest are not those of a state at rest.
    pub jumps: bool,
}

/// The stages of a case.
#[derive(Default)]
pub(super) struct Stages {
    pub statics: Vec<Static>,
    pub dynamic: Option<Dynamic>,
}

/// Stages of a case with those that it continues.
pub(super) fn stages(writer: &mut Writer<'_>, case: usize, freedoms: &Freedoms) -> Stages {
    let model = writer.model;
    let mut chain: Vec<usize> =
        std::iter::successors(Some(case), |c| model.cases[*c].after).collect();
    chain.reverse();
    let mut out = Stages::default();
    if model.p_delta.is_some() {
        let why = "axial forces of one static case stiffen the structure here (`p_delta`), those of every step there";
        writer.losses.lost("P-Δ", "", why);
    }
    for index in chain {
        let c = &model.cases[index];
        match &c.analysis {
            Analysis::Static(s) => {
                let commands = writer.loads(&s.loads, LINEAR, freedoms);
                // Links slip and yield on the way: ten steps at least.
                let steps = s.steps.max(10);
                out.statics.push(Static { name: c.name.clone(), commands, steps });
            }
            Analysis::Dynamic(d) if index == case => {
                out.dynamic = Some(writer.dynamic(d, &c.name, freedoms));
            }
            Analysis::Dynamic(_) => {
                let why = "a case that goes on from a dynamic one is not written";
                writer.losses.lost("case", &model.cases[case].name, why);
            }
        }
    }
    out
}

impl Writer<'_> {
    fn pattern(&mut self) -> i64 {
        self.tags.pattern += 1;
        self.tags.pattern
    }

    /// A pattern of loads times their factors; what acts on held directions is left out, but for loads along members.
    fn loads(&mut self, loads: &[Load], series: i64, freedoms: &Freedoms) -> Vec<Command> {
        let model = self.model;
        let mut sum = vec![0.0; 6 * model.nodes.len()];
        for load in loads {
            match *load {
                Load::Gravity { factor } => {
                    let free = (0..sum.len()).filter(|i| !freedoms.held[*i]);
                    free.for_each(|i| sum[i] += factor * model.gravity * freedoms.weight[i]);
                }
                Load::Pattern { pattern, factor } => {
                    self.add(pattern, factor, freedoms, &mut sum);
                }
            }
        }
        self.plain(&sum, series)
    }

    fn plain(&mut self, sum: &[f64], series: i64) -> Vec<Command> {
        let tag = self.pattern();
        let mut all = vec![Command::new("pattern", ["Plain".into(), tag.into(), series.into()])];
        for (node, forces) in sum.chunks(6).enumerate() {
            if forces.iter().any(|f| *f != 0.0) {
                let tag = Word::from(self.node(node));
                all.push(Command::new("load", [tag]).all(forces.iter().copied()));
            }
        }
        all
    }

    /// Adds a pattern: forces at nodes, and what loads along members are worth there.
    fn add(&mut self, pattern: usize, factor: f64, freedoms: &Freedoms, sum: &mut [f64]) {
        let model = self.model;
        let p = &model.patterns[pattern];
        for f in &p.forces {
            let i = 6 * f.node + f.dof.index();
            if !freedoms.held[i] {
                sum[i] += factor * f.value;
            }
        }
        for load in &p.members {
            if matches!(load.load, SpanLoad::Warmth { .. }) {
                self.losses.note(
                    "loads",
                    &p.name,
                    "warmth acts as the forces at the ends that it is worth",
                );
            }
            match self.ends_of(load) {
                Some(ends) => {
                    for (k, force) in ends.iter().enumerate() {
                        let node = model.elements[load.element].nodes[k / 6];
                        sum[6 * node + k % 6] += factor * force;
                    }
                }
                None => self.losses.lost("loads", &p.name, "a load along a member that has none"),
            }
        }
    }

    /// What a load along a member is worth at its ends, in global directions.
    fn ends_of(&self, load: &MemberLoad) -> Option<[f64; 12]> {
        let e = &self.model.elements[load.element];
        let places: Vec<_> = e.nodes.iter().map(|n| self.model.nodes[*n].position).collect();
        let member = self.model.member(load.element)?;
        let local = member.end_loads(&Geometry::new(&places, e.frame), &load.load).ok()?;
        Some(std::array::from_fn(|i| {
            let (part, axis) = (3 * (i / 3), i % 3);
            (0..3).map(|k| e.frame.0[k][axis] * local[part + k]).sum()
        }))
    }

    fn dynamic(&mut self, d: &DynamicCase, name: &str, freedoms: &Freedoms) -> Dynamic {
        let model = self.model;
        let reduced = d.solution.solver == SolverKind::Fna;
        let steps = super::output_steps(d.duration, d.dt) as usize;
        let mut out = Dynamic {
            alpha: if reduced { 1.0 } else { 1.0 + d.solution.alpha },
            dt: d.dt,
            steps,
            jumps: !d.initial.is_empty() || !d.constant.is_empty(),
            ..Dynamic::default()
        };
        if (steps as f64 * d.dt - d.duration).abs() > 1e-9 * d.duration {
            self.losses.note("case", name, "its last output step is whole there");
        }
        if matches!(d.solution.solver, SolverKind::Custom { .. }) {
            self.losses.note(
                "case",
                name,
                "its solver is one of another crate: Newmark's rule stands for it",
            );
            out.alpha = 1.0;
        }
        if !d.supports.is_empty() {
            self.losses.lost("case", name, "supports that move are not written");
        }
        if !d.constant.is_empty() {
            let commands = self.loads(&d.constant, CONSTANT, freedoms);
            out.lines.push("# loads that stay".into());
            out.lines.extend(commands.iter().map(Command::python));
        }
        let mut series = CONSTANT;
        for f in &d.forces {
            series += 1;
            out.uses(f.function);
            out.lines.push(format!("series({series}, f{})", f.function + 1));
            let mut sum = vec![0.0; 6 * model.nodes.len()];
            self.add(f.pattern, f.factor, freedoms, &mut sum);
            let commands = self.plain(&sum, series);
            out.lines.extend(commands.iter().map(Command::python));
        }
        for b in &d.base {
            series += 1;
            out.uses(b.function);
            out.lines.push(format!("series({series}, f{})", b.function + 1));
            let tag = self.pattern();
            let direction = b.direction.index() % 3;
            let words =
                [Word::from("UniformExcitation"), tag.into(), (direction as i64 + 1).into()];
            let command = Command::new("pattern", words)
                .with("-accel")
                .with(series)
                .with("-fact")
                .with(b.factor);
            out.lines.push(command.python());
            out.base.push((direction, b.function, b.factor));
        }
        for f in &out.functions {
            let at_once = model.functions[*f].function.value(0.0, trilith_model::Side::After);
            out.jumps |= at_once != 0.0;
        }
        let n = 6 * model.nodes.len();
        let (mut displaced, mut moving) = (vec![0.0; n], vec![0.0; n]);
        for start in &d.initial {
            let i = 6 * start.node + start.dof.index();
            displaced[i] = start.displacement.unwrap_or(0.0);
            moving[i] = start.velocity.unwrap_or(0.0);
        }
        for (command, all) in [("setNodeDisp", &mut displaced), ("setNodeVel", &mut moving)] {
            // What follows has to be told.
            for (own, terms) in &freedoms.followers.of {
                all[*own] = terms.iter().map(|(i, c)| c * all[*i]).sum();
            }
            for (i, x) in all.iter().enumerate().filter(|(_, x)| **x != 0.0) {
                let place = [self.node(i / 6), (i % 6) as i64 + 1].map(Word::from);
                out.lines.push(Command::new(command, place).with(*x).with("-commit").python());
            }
        }
        out
    }
}

impl Dynamic {
    fn uses(&mut self, function: usize) {
        if !self.functions.contains(&function) {
            self.functions.push(function);
        }
    }
}

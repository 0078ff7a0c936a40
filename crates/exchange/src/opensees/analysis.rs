//! Analyses: what a script runs becomes cases; damping becomes that of the model.

use super::args::{Args, Told, wrong};
use super::loads::Kind;
use super::recorder::Recorder;
use super::tcl::Value;
use crate::Draft;
use crate::ron::{Ron, number};

/// Most straight parts of a path of loads in statics.
const PARTS: usize = 60;

/// An analysis that goes on: equal steps under what acts.
#[derive(Clone, Debug)]
struct Going {
    dynamic: bool,
    step: f64,
    steps: i64,
    from: f64,
}

/// What the script has said of its analyses.
#[derive(Debug, Default)]
pub struct Analysis {
    /// Time of the script.
    pub time: f64,
    dynamic: Option<bool>,
    integrator: Option<Integrator>,
    going: Option<Going>,
    /// The case before.
    last: Option<String>,
    /// The last static case.
    pub(super) last_static: Option<String>,
    cases: usize,
    pub(super) rayleigh: Option<[f64; 4]>,
    pub(super) modal: Option<Vec<f64>>,
    /// Circular frequencies squared of the last `eigen`.
    pub(super) eigen: Vec<f64>,
    /// A transformation that follows axial forces, and its line.
    pub(super) geometric: Option<(String, String)>,
}

#[derive(Clone, Debug)]
enum Integrator {
    Load { step: f64 },
    Time { alpha: f64 },
    Other(String),
}

impl Analysis {
    /// Notes a transformation that follows axial forces.
    pub fn geometric(&mut self, kind: &str, line: &str) {
        if self.geometric.as_ref().is_none_or(|(k, _)| k == "PDelta") {
            self.geometric = Some((kind.into(), line.into()));
        }
    }
}

impl Recorder<'_> {
    /// What acts has changed: the analysis that goes on ends where it is.
    pub(super) fn changed(&mut self) {
        // An error is told by the next analysis.
        let _ = self.finish_analysis();
    }

    pub(super) fn integrator(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "integrator Newmark 0.5 0.25");
        let kind = a.word("its type")?;
        self.changed();
        let new = match kind {
            "LoadControl" => {
                let step = a.number("the step of the load factor")?;
                if a.peek().is_some() {
                    a.all();
                    self.ignore(
                        "LoadControl numIter minLambda maxLambda",
                        "load steps are chosen here",
                    );
                }
                Integrator::Load { step }
            }
            "Newmark" => {
                let [gamma, beta] = a.numbers::<2>("gamma, beta")?;
                if (gamma, beta) != (0.5, 0.25) {
                    self.otherwise("steps are those of average acceleration (0.5 0.25), and as short as their error asks");
                }
                if a.flag("-form") {
                    a.option();
                    self.ignore("-form", "which unknowns are iterated changes nothing");
                }
                Integrator::Time { alpha: 0.0 }
            }
            "HHT" => {
                let word = a.at();
                let alpha = a.number("alpha")? - 1.0;
                if !(-1.0 / 3.0 - 1e-9..=0.0).contains(&alpha) {
                    return wrong(
                        word,
                        "an alpha that is not between 2/3 and 1",
                        "1 is Newmark's rule",
                    );
                }
                if !a.all().is_empty() {
                    self.otherwise("gamma and beta are those that belong to alpha");
                }
                Integrator::Time { alpha: alpha.max(-1.0 / 3.0) }
            }
            "DisplacementControl"
            | "ArcLength"
            | "MinUnbalDispNorm"
            | "StagedLoadControl"
            | "EQPath"
            | "HSConstraint" => Integrator::Other(kind.into()),
            _ => {
                self.otherwise(
                    "steps are those of average acceleration, and as short as their error asks",
                );
                Integrator::Time { alpha: 0.0 }
            }
        };
        self.analysis.integrator = Some(new);
        Ok(())
    }

    pub(super) fn kind_of_analysis(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "analysis Static, or analysis Transient");
        let dynamic = match a.word("its type")? {
            "Static" => false,
            "Transient" | "VariableTransient" => true,
            other => {
                self.lose(&format!(
                    "an analysis of the type {} is not written",
                    super::args::short(other)
                ));
                return Ok(());
            }
        };
        while let Some(option) = a.option() {
            match option {
                "-noWarnings" | "-numSublevels" | "-numSubSteps" => {
                    a.all();
                    self.ignore(option, "steps are halved here where they must be");
                }
                other => self.unread(other),
            }
        }
        self.changed();
        self.analysis.dynamic = Some(dynamic);
        Ok(())
    }

    pub(super) fn analyze(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "analyze steps dt");
        let steps = a.whole("the number of steps")?;
        if steps < 1 {
            return wrong(1, "an analysis of no steps", "analyze 10, or analyze 1000 0.01");
        }
        let Some(dynamic) = self.analysis.dynamic else {
            return wrong(
                0,
                "`analyze` before `analysis`",
                "analysis Static, or analysis Transient",
            );
        };
        let step = if dynamic { a.positive("the step of time")? } else { 0.0 };
        while let Some(more) = a.option() {
            self.ignore(more, "steps are as short as their error asks");
        }
        let step = match (&self.analysis.integrator, dynamic) {
            (_, true) => step,
            (Some(Integrator::Load { step }), false) => *step,
            (None, false) => 1.0,
            (Some(Integrator::Other(kind)), false) => {
                let what = format!("a case of {kind} is not written");
                self.finish_analysis()?;
                self.lose(&what);
                return Ok(());
            }
            (Some(Integrator::Time { .. }), false) => {
                return wrong(
                    0,
                    "a static analysis with an integrator of time",
                    "integrator LoadControl 0.1",
                );
            }
        };
        let same =
            self.analysis.going.as_ref().is_some_and(|g| g.dynamic == dynamic && g.step == step);
        if !same {
            self.finish_analysis()?;
        }
        let from = self.analysis.time;
        let going = self.analysis.going.get_or_insert(Going { dynamic, step, steps: 0, from });
        going.steps = going.steps.saturating_add(steps);
        self.analysis.time = going.from + going.steps as f64 * step;
        Ok(())
    }

    pub(super) fn load_constant(&mut self, words: &[Value]) -> Told<()> {
        self.finish_analysis()?;
        let t = self.analysis.time;
        for pattern in &mut self.patterns {
            if matches!(pattern.kind, Kind::Plain) {
                pattern.frozen = Some(pattern.value(t));
            }
        }
        let mut a = Args::new(words, 1, "loadConst -time 0.0");
        while let Some(option) = a.option() {
            match option {
                "-time" => self.analysis.time = a.number("the time")?,
                other => self.unread(other),
            }
        }
        Ok(())
    }

    pub(super) fn set_time(&mut self, words: &[Value]) -> Told<()> {
        self.finish_analysis()?;
        let mut a = Args::new(words, 1, "setTime 0.0");
        self.analysis.time = a.number("the time")?;
        Ok(())
    }

    /// Ends the analysis that goes on and writes its case.
    pub(super) fn finish_analysis(&mut self) -> Told<()> {
        let Some(going) = self.analysis.going.take() else { return Ok(()) };
        if going.dynamic {
            self.dynamic(&going)
        } else {
            self.statics(&going)
        }
        Ok(())
    }

    fn case(&mut self, kind: &str, block: Ron) {
        self.analysis.cases += 1;
        let name = format!("{kind} {}", self.analysis.cases);
        if kind == "static" {
            self.analysis.last_static = Some(name.clone());
        }
        self.analysis.last = Some(name.clone());
        self.draft.cases.push((name, block));
    }

    fn statics(&mut self, going: &Going) {
        let to = going.from + going.steps as f64 * going.step;
        // Ends of parts in which every pattern runs straight.
        let mut ends = Vec::new();
        let mut from = going.from;
        for k in 1..=going.steps {
            let next = going.from + (k + 1) as f64 * going.step;
            let here = going.from + k as f64 * going.step;
            let straight = k < going.steps
                && self.patterns.iter().all(|p| {
                    p.frozen.is_some()
                        || p.series.as_ref().is_none_or(|s| s.is_straight(from, next))
                });
            if !straight {
                ends.push(here);
                from = here;
                if ends.len() > PARTS {
                    self.lose(
                        "a path of loads with many turns is not followed: its end is written",
                    );
                    ends = vec![to];
                    break;
                }
            }
        }
        if self
            .patterns
            .iter()
            .any(|p| matches!(&p.kind, Kind::Supports { moves } if !moves.is_empty()))
        {
            self.lose("supports move in histories alone, not in a static case");
        }
        for end in ends {
            let mut loads = Vec::new();
            for p in self.patterns.iter_mut().filter(|p| matches!(p.kind, Kind::Plain)) {
                let more = p.value(end) - p.applied;
                let empty = p.forces.is_empty() && p.along.is_empty();
                if more != 0.0 && !empty {
                    loads.push(load(&p.name, more));
                }
                p.applied += more;
            }
            let after = self.analysis.last.clone().map(Ron::Text);
            self.case(
                "static",
                Ron::block("Static").maybe("after", after).with("loads", Ron::List(loads)),
            );
        }
    }

    fn dynamic(&mut self, going: &Going) {
        let duration = going.steps as f64 * going.step;
        let (mut base, mut forces, mut constant, mut supports) = (vec![], vec![], vec![], vec![]);
        let unit = format!("{}/s^2", self.draft.units.0);
        for k in 0..self.patterns.len() {
            let pattern = self.patterns[k].clone();
            let series = pattern.series.clone().filter(|_| pattern.frozen.is_none());
            match (&pattern.kind, series) {
                (Kind::Plain, _) if pattern.forces.is_empty() && pattern.along.is_empty() => {}
                (Kind::Plain, Some(mut series)) => {
                    series.factor *= pattern.factor;
                    if series.value(going.from) == series.value(going.from + duration)
                        && matches!(series.shape, super::series::Shape::Constant)
                    {
                        let more = series.factor - pattern.applied;
                        if more != 0.0 {
                            constant.push(load(&pattern.name, more));
                        }
                        self.patterns[k].applied += more;
                        continue;
                    }
                    if pattern.applied != 0.0 {
                        constant.push(load(&pattern.name, -pattern.applied));
                        self.patterns[k].applied = 0.0;
                    }
                    let function = self.function(&series, going.from, duration, false);
                    forces.push(
                        Ron::block("")
                            .with("load", Ron::text(&pattern.name))
                            .with("function", Ron::text(function)),
                    );
                }
                (Kind::Plain, None) => {
                    let more = pattern.frozen.unwrap_or(0.0) - pattern.applied;
                    if more != 0.0 {
                        constant.push(load(&pattern.name, more));
                    }
                    self.patterns[k].applied += more;
                }
                (Kind::Ground { direction }, Some(series)) => {
                    let function = self.function(&series, going.from, duration, false);
                    let factor = Ron::Text(format!("{} {unit}", number(pattern.factor)));
                    let block = Ron::block("").with("direction", Ron::word(*direction));
                    base.push(block.with("function", Ron::text(function)).with("factor", factor));
                }
                (Kind::Supports { moves }, _) => {
                    for (node, direction, series) in moves {
                        let function = self.function(series, going.from, duration, true);
                        let factor = if *direction < 3 {
                            Ron::Text(format!("1 {}", self.draft.units.0))
                        } else {
                            Ron::Number(1.0)
                        };
                        let block =
                            Ron::block("").with("node", Ron::text(&self.draft.nodes[*node].0));
                        let block = block.with("dof", Ron::word(crate::DOFS[*direction]));
                        supports.push(
                            block.with("displacement", Ron::text(function)).with("factor", factor),
                        );
                    }
                }
                _ => {}
            }
        }
        let alpha = match self.analysis.integrator {
            Some(Integrator::Time { alpha }) => alpha,
            _ => 0.0,
        };
        let list = |all: Vec<Ron>| (!all.is_empty()).then_some(Ron::List(all));
        let block = Ron::block("Dynamic")
            .maybe("after", self.analysis.last.clone().map(Ron::Text))
            .with("duration", duration)
            .with("dt", going.step)
            .maybe("constant", list(constant))
            .maybe("base", list(base))
            .maybe("forces", list(forces))
            .maybe("supports", list(supports))
            .with("solver", Ron::word("Hht"))
            .maybe("alpha", (alpha != 0.0).then_some(alpha));
        self.case("dynamic", block);
    }

    pub(super) fn eigen(&mut self, words: &[Value]) -> Told<Value> {
        self.finish_analysis()?;
        let mut a = Args::new(words, 1, "eigen 3");
        while a.peek().is_some_and(|w| w.starts_with('-')) {
            a.option();
            self.ignore("-solver", "how eigenvalues are found is chosen here");
        }
        let word = a.at();
        let count = a.whole("the number of modes")?;
        let Some(count) = usize::try_from(count).ok().filter(|n| *n > 0) else {
            return wrong(word, format!("{count} modes"), "one or more");
        };
        let draft = self.still();
        match self.oracle.eigenvalues(&draft.to_ron(), self.analysis.last_static.as_deref(), count)
        {
            Ok(values) if values.len() >= count => {
                let texts: Vec<String> = values[..count].iter().map(|x| format!("{x:?}")).collect();
                self.analysis.eigen = values;
                self.otherwise("modes are those of this program: links by their tangents after the last static case");
                Ok(Value::list(&texts))
            }
            Ok(values) => wrong(
                word,
                format!("the model has {} modes", values.len()),
                "as many as it has masses that move",
            ),
            Err(why) => wrong(0, format!("the model has no modes yet: {why}"), ""),
        }
    }

    /// The model as it is, with its static cases alone.
    fn still(&self) -> Draft {
        let mut draft = self.draft.clone();
        draft.cases.retain(|(_, c)| c.name() == "Static");
        if draft.cases.is_empty() {
            draft
                .cases
                .push(("rest".into(), Ron::block("Static").with("loads", Ron::List(Vec::new()))));
        }
        draft.functions.clear();
        draft.outputs.clear();
        self.write_masses(&mut draft);
        self.write_loads(&mut draft);
        if self.analysis.geometric.as_ref().is_some_and(|(k, _)| k == "PDelta") {
            draft.p_delta = self.analysis.last_static.clone();
        }
        draft
    }

    /// Masses of nodes.
    pub(super) fn write_masses(&self, draft: &mut Draft) {
        for (node, n) in self.nodes.iter().enumerate() {
            let mut mass = n.mass;
            mass[..self.ndm].iter_mut().for_each(|m| *m += n.brought);
            if mass == [0.0; 6] {
                continue;
            }
            let name = &self.draft.nodes[node].0;
            let block = Ron::block("Mass")
                .with("node", Ron::text(name))
                .with("masses", Ron::vector(&mass[..3]));
            let turning = mass[3..] != [0.0; 3];
            draft.elements.push((
                format!("mass {name}"),
                block.maybe("inertia", turning.then(|| Ron::vector(&mass[3..]))),
            ));
        }
    }

    /// Patterns of loads.
    pub(super) fn write_loads(&self, draft: &mut Draft) {
        for p in self.patterns.iter().filter(|p| matches!(p.kind, Kind::Plain)) {
            if !p.forces.is_empty() || !p.along.is_empty() {
                draft.loads.push((p.name.clone(), p.forces.clone()));
                draft.along.insert(p.name.clone(), p.along.clone());
            }
        }
    }
}

/// A load of a case: its pattern times a factor.
fn load(name: &str, factor: f64) -> Ron {
    if factor == 1.0 {
        return Ron::text(name);
    }
    Ron::block("").with("load", Ron::text(name)).with("factor", factor)
}

//! Reading a study file.

mod axes;
mod columns;
mod figures;
mod identity;
mod names;
mod random;
mod setting;

use crate::shape::Shape;
use crate::{Condition, Plan, Study, schema};
use names::Names;
use setting::Settings;
use std::path::{Path, PathBuf};
use trilith::Registry;
use trilith::model::file::{Context, Fields, Kind, Node, open, parse, resembles_model};
use trilith::model::{Analysis, Diagnostic, Model, ModelText, ParameterValue};

/// Most runs of a study.
const MOST: usize = 100_000_000;

impl Study {
    /// Reads a study file and its model. `overrides` are names and values of parameters that replace those of
    /// the study: a value that all runs have, or the only value of an axis.
    ///
    /// # Errors
    /// All errors of the study at once, then those of its model.
    pub fn read(
        path: impl AsRef<Path>,
        registry: &Registry,
        overrides: &[(String, String)],
    ) -> Result<Self, Vec<Diagnostic>> {
        let path = path.as_ref();
        Self::read_text(&open(path, "study")?, path, registry, overrides)
    }

    /// Reads a study from a text; its model is looked for in the folder of `path`.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_text(
        text: &str,
        path: impl AsRef<Path>,
        registry: &Registry,
        overrides: &[(String, String)],
    ) -> Result<Self, Vec<Diagnostic>> {
        let path = path.as_ref();
        let (source, root) = parse(text, path)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let c = Context::new(source, folder.clone(), registry);
        let mut foreign = Vec::new();
        let study = whole(&c, &root, path, &folder, registry, overrides, &mut foreign);
        let mut errors = c.into_errors();
        errors.append(&mut foreign);
        match study {
            Some(study) if errors.is_empty() => Ok(study),
            _ if errors.is_empty() => {
                let (source, root) = parse(text, path)?;
                Err(vec![Diagnostic::new("E0105", "this is no study", root.span, &source)])
            }
            _ => Err(errors),
        }
    }
}

fn whole(
    c: &Context<'_>,
    root: &Node,
    path: &Path,
    folder: &Path,
    registry: &Registry,
    overrides: &[(String, String)],
    foreign: &mut Vec<Diagnostic>,
) -> Option<Study> {
    let top = c.block(root, "the study", schema::STUDY.blocks[0])?;
    let title = top.get("title").map_or(Some(String::new()), |n| c.text(n, "title"));
    let seed = top.count(c, "seed");

    let mut settings = Settings::default();
    let mut plan = Plan {
        fixed: axes::fixed(c, top.get("set"), &mut settings),
        rows: axes::points(c, top.get("points"), &mut settings),
        axes: axes::axes(c, top.get("axes"), &mut settings),
        ..Plan::default()
    };
    let seed = seed.unwrap_or(1) as u64;
    plan.samples = top.get("samples").and_then(|n| random::samples(c, n, seed, &mut settings));
    plan.ensemble = top.get("ensemble").and_then(|n| random::ensemble(c, n, seed, &mut settings));
    settings.check_twice(c);
    for (name, value) in overrides {
        if let Some(axis) = plan.axes.iter_mut().find(|a| a.name == *name) {
            axis.values = vec![value.clone()];
        } else {
            plan.fixed.retain(|(n, _)| n != name);
            plan.fixed.push((name.clone(), value.clone()));
        }
    }

    // Without a model nothing else can be checked.
    let model_node = top.required(c, "model");
    let model_path: PathBuf = folder.join(c.text(model_node?, "model")?);
    let text = match trilith::record::file::read_text(&model_path) {
        Ok(text) => text,
        Err(error) => {
            let message = format!("the model {} cannot be read: {error}", model_path.display());
            let help = "the path counts from the folder of the study";
            c.report(c.diagnostic("E0100", message, model_node?.span.clone()).help(help));
            return None;
        }
    };
    if !resembles_model(&text) {
        let message = format!("{} is no model: it has no `nodes`", model_path.display());
        let help =
            "the path counts from the folder of the study; `trilith check` says more of a model";
        c.report(c.diagnostic("E0105", message, model_node?.span.clone()).help(help));
        return None;
    }
    let parsed = match ModelText::new(&text, &model_path) {
        Ok(parsed) => parsed,
        Err(errors) => {
            foreign.extend(errors);
            return None;
        }
    };
    let model = first_model(c, &parsed, &plan, registry, &settings, foreign)?;
    let shape = Shape::of(&model);
    settings.check_all(c, (&parsed, &shape), &plan, registry, foreign);
    settings.check_perturbed(c, &model);

    let case = match top.get("case") {
        Some(node) => {
            let names: Vec<&str> = model.cases.iter().map(|case| case.name.as_str()).collect();
            c.choice(node, "case", &names)
        }
        None => model.cases.len().checked_sub(1),
    };
    let combination = combination(c, &top, &model);
    if let (Some(Analysis::Static(_)), None) =
        (case.map(|i| &model.cases[i].analysis), top.get("combination"))
    {
        let at = top.get("case").or(model_node).map_or(0..0, |n| n.span.clone());
        let message = "the case of the study is static";
        c.report(c.diagnostic("E0112", message, at).help("name a dynamic case with `case`"));
    }
    let solver = top.get("solver").map_or(Some(None), |n| {
        let names = model.solver_names();
        c.choice(n, "solver", &names).map(|i| model.solver(names[i], case.unwrap_or(0)))
    });
    let columns = columns::columns(c, top.get("columns"), &model);
    let is_combined = top.get("combination").is_some();
    if is_combined {
        columns::check_combined(c, top.get("columns"), &columns, &model);
    }
    let varied: Vec<String> = plan.varied().into_iter().map(str::to_owned).collect();
    let kind = |name: &String| match model.parameters.iter().find(|p| p.name == *name)?.value {
        ParameterValue::Number(_, dimension) => Some(dimension),
        ParameterValue::Text(_) => None,
    };
    let kinds: Vec<_> = varied.iter().map(kind).collect();
    let names = Names::new(&varied, &kinds, &columns, is_combined);
    let stop = top.get("stop").map(|n| stop(c, n, &mut plan, &names));
    let histories = top.get("histories").map(|n| columns::condition(c, n, &names));
    let events = top.get("events").map_or(Some(Vec::new()), |n| columns::events(c, n, &names));
    let over = top.get("over").map_or(Some(Vec::new()), |n| over(c, n, &plan));
    let sensitive = top.number(c, "sensitive_above");
    let figures =
        top.get("figures").map_or(Some(Vec::new()), |n| figures::figures(c, n, &names, &model));
    let runs = plan.runs().filter(|runs| *runs <= MOST);
    if runs.is_none() {
        let message = format!("the study has more than {MOST} runs");
        c.report(c.diagnostic("E0112", message, root.span.start..root.span.start + 1));
    }
    let how = (case?, solver?, combination?);
    let (first, mut files) = (settings.first(&plan), Vec::new());
    let identity =
        identity::identity(&parsed, &plan, registry, &first, &how, &columns, &stop, &mut files)?;
    let sum = model.sha256();
    Some(Study {
        title: title?,
        path: path.to_owned(),
        model_path,
        model_title: model.title,
        columns,
        stop: stop.flatten(),
        histories: histories.flatten(),
        events: events?,
        over: over?,
        sensitive_above: sensitive?,
        figures: figures?,
        files,
        identity: crate::Identity { runs: runs?, model: sum, ..identity },
        plan,
        varied,
        text: parsed,
        shape,
        case: case?,
        case_named: top.get("case").and_then(|_| Some(model.cases.get(case?)?.name.clone())),
        solver: solver?,
        combination: how.2,
        kinds,
    })
}

/// The model with the first value of everything.
fn first_model(
    c: &Context<'_>,
    parsed: &ModelText,
    plan: &Plan,
    registry: &Registry,
    settings: &Settings,
    foreign: &mut Vec<Diagnostic>,
) -> Option<Model> {
    match parsed.read(registry, &settings.first(plan)) {
        Ok(model) => Some(model),
        Err(errors) => {
            settings.tell(c, errors, None, foreign);
            // As it stands in its file it still has the names that the rest of the study refers to.
            parsed.read(registry, &[]).ok()
        }
    }
}

/// `combination: "design"`, which goes with nothing that is of one case. Outer none: it is wrong.
fn combination(c: &Context<'_>, top: &Fields<'_>, model: &Model) -> Option<Option<String>> {
    let Some(node) = top.get("combination") else { return Some(None) };
    for (name, why) in [
        ("case", "runs a case and no combination: one of them is wanted"),
        ("solver", "is that of one case: cases of a combination have their own in the model"),
        ("histories", "are those of one case: a combination has extremes alone"),
    ] {
        if let Some(other) = top.get(name) {
            c.report(c.diagnostic("E0112", format!("`{name}` {why}"), other.span.clone()));
        }
    }
    if model.combinations.is_empty() {
        let message = "the model has no combination".to_owned();
        let help = "`combinations` of the model says which cases it has";
        c.report(c.diagnostic("E0106", message, node.span.clone()).help(help));
        return None;
    }
    let names: Vec<&str> = model.combinations.iter().map(|k| k.name.as_str()).collect();
    c.choice(node, "combination", &names).map(|i| Some(names[i].to_owned()))
}

/// `stop: (along: "scale", when: Overturned)`.
fn stop(c: &Context<'_>, node: &Node, plan: &mut Plan, names: &Names<'_>) -> Option<Condition> {
    let fields = c.block(node, "`stop`", schema::STOP.blocks[0])?;
    let along = fields.required(c, "along").and_then(|n| axis(c, n, plan));
    let when = fields.required(c, "when").and_then(|n| columns::condition(c, n, names));
    plan.chain = Some(along?);
    when
}

fn over(c: &Context<'_>, node: &Node, plan: &Plan) -> Option<Vec<usize>> {
    let all: Vec<_> = node.items().into_iter().map(|n| axis(c, n, plan)).collect();
    all.into_iter().collect()
}

/// The axis that a value names.
fn axis(c: &Context<'_>, node: &Node, plan: &Plan) -> Option<usize> {
    let Kind::Text(name) = &node.kind else {
        return c.wrong(node, "the name of an axis in quotes");
    };
    let names: Vec<&str> = plan.axes.iter().map(|a| a.name.as_str()).collect();
    let found = names.iter().position(|n| n == name);
    if found.is_none() {
        names::unknown(c, node, "axis", "axes", name, &names);
    }
    found
}

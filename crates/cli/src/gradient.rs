//! `trilith gradient`: derivatives of outputs by parameters.

use crate::args::GradientArguments;
use crate::interrupt::INTERRUPTED;
use crate::text::{names_help, number, row, table};
use crate::{Answer, Failure, case, diagnostics, model_text, names, solver};
use serde::Serialize;
use trilith::gradient::{GradientError, HEAT, HEAT_OF, INPUT, Wanted, gradient as find};
use trilith::model::{Body, ParameterValue, visible_line};
use trilith::solvers::gradient::{Bend, Extreme, Gradient};
use trilith::{Error, Model, Registry};

/// What is told of an output.
const VALUES: [&str; 4] = ["max", "min", "peak", "final"];

/// One derivative.
#[derive(Serialize)]
struct Derivative<'a> {
    parameter: &'a str,
    /// Of the parameter.
    unit: String,
    derivative: f64,
    /// Per cent of the value by per cent of the parameter; none where the value is zero.
    elasticity: Option<f64>,
}

/// One value of an output with its derivatives.
#[derive(Serialize)]
struct Row<'a> {
    output: String,
    what: &'static str,
    unit: &'a str,
    value: f64,
    /// Time, s.
    t: f64,
    by: Vec<Derivative<'a>>,
}

/// All that is told.
#[derive(Serialize)]
pub(crate) struct Told<'a> {
    case: &'a str,
    substeps: usize,
    derivatives: Vec<Row<'a>>,
    /// Links whose laws bend where substeps have ended.
    bends: Vec<Bent<'a>>,
}

/// A link whose law bends.
#[derive(Serialize)]
struct Bent<'a> {
    link: &'a str,
    /// When first, s.
    t: f64,
    substeps: usize,
}

pub(crate) fn gradient(registry: &Registry, args: &GradientArguments) -> Result<Answer, Failure> {
    let text = model_text(&args.model)?;
    let model = text.read(registry, &args.model.set).map_err(|e| Failure::diagnostics(&e))?;
    let chosen = case(&model, args.case.as_deref())?;
    let named = args.solver.as_deref().map(|name| solver(&model, chosen, name));
    let solver = named.transpose()?;
    let asked = asked(&model, &names::flat(&args.of))?;
    let wanted = Wanted {
        case: Some(model.cases[chosen].name.clone()),
        solver,
        dt: args.dt,
        by: names::flat(&args.by),
        set: args.model.set.clone(),
        input: asked.contains(&Asked::Input),
    };
    let found = find(&text, registry, &wanted).map_err(|e| failure(e, &model))?;
    let told = told(&model, &model.cases[chosen].name, &found, &asked);
    if args.json {
        let text = serde_json::to_string_pretty(&told).unwrap_or_default();
        return Ok((text + "\n").into());
    }
    Ok(page(&model, &told).into())
}

/// What is told of these.
pub(crate) fn told<'a>(
    model: &'a Model,
    case: &'a str,
    found: &'a Gradient,
    asked: &[Asked],
) -> Told<'a> {
    Told {
        case,
        substeps: found.substeps,
        bends: bends(found),
        derivatives: asked
            .iter()
            .flat_map(|asked| match asked {
                Asked::Output(output) => rows(model, found, *output),
                Asked::Heat(element) => vec![heat(model, found, *element)],
                Asked::Input => {
                    let of = found.input.clone();
                    of.map(|of| energy(model, found, INPUT.into(), of)).into_iter().collect()
                }
            })
            .collect(),
    }
}

fn bends(found: &Gradient) -> Vec<Bent<'_>> {
    let bent = |b: &'_ Bend| (b.t, b.count);
    let all = found.bends.iter().map(|b| (b.link.as_str(), bent(b)));
    all.map(|(link, (t, substeps))| Bent { link, t, substeps }).collect()
}

/// What derivatives are told of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Asked {
    /// The output of this index.
    Output(usize),
    /// The heat of the link that is the element of this index; of all links together.
    Heat(Option<usize>),
    /// The energy that loads and moving supports have put in.
    Input,
}

/// Outputs and energies of these names; all outputs that are shown where none are given.
fn asked(model: &Model, wanted: &[String]) -> Result<Vec<Asked>, Failure> {
    if wanted.is_empty() && model.outputs.is_empty() {
        let help = "give the model `outputs`: there are derivatives of these, and with `--of heat,input` of energies";
        return Err(Failure::input("the model has no output", Some(help)));
    }
    if wanted.is_empty() {
        return Ok(model.shown().map(|(i, _)| Asked::Output(i)).collect());
    }
    let of = |name: &String| {
        if let Some(output) = model.output(name) {
            return Ok(Asked::Output(output));
        }
        let mut links =
            model.elements.iter().enumerate().filter(|(_, e)| matches!(e.body, Body::Link(..)));
        if name == HEAT {
            return Ok(Asked::Heat(None));
        }
        if name == INPUT {
            return Ok(Asked::Input);
        }
        if let Some(link) = name.strip_prefix(HEAT_OF) {
            if let Some((element, _)) = links.clone().find(|(_, e)| e.name == link) {
                return Ok(Asked::Heat(Some(element)));
            }
            let help = names::help(link, "links", "--of", links.map(|(_, e)| e.name.as_str()));
            return Err(Failure::input(&format!("there is no link \"{link}\""), Some(&help)));
        }
        let all = model.outputs.iter().map(|o| o.name.as_str());
        let heat = links.next().map(|_| HEAT);
        let help = names::help(name, "outputs", "--of", all.chain(heat).chain([INPUT]));
        Err(Failure::input(&format!("there is no output \"{name}\""), Some(&help)))
    };
    wanted.iter().map(of).collect()
}

pub(crate) fn failure(error: GradientError, model: &Model) -> Failure {
    match &error {
        GradientError::Run(e @ Error::Interrupted) => {
            Failure { text: diagnostics::plain(&e.to_string(), None), status: INTERRUPTED }
        }
        GradientError::Run(e) => Failure::of(e, model),
        GradientError::Model(all) => Failure::diagnostics(all),
        GradientError::UnknownParameter { name, .. } => {
            let all = model.parameters.iter().map(|p| p.name.as_str());
            let help = names_help(name, "parameters", all);
            Failure::input(&format!("the model has no parameter `{name}`"), Some(&help))
        }
        GradientError::Beside { errors, .. } => {
            let text = diagnostics::plain(&error.to_string(), None);
            Failure { text: text + &diagnostics::all(errors), status: 2 }
        }
        _ => Failure::input(&error.to_string(), None),
    }
}

/// What is told of an output.
fn rows<'a>(model: &'a Model, found: &'a Gradient, output: usize) -> Vec<Row<'a>> {
    let of = &found.outputs[output];
    let (last, by) = of.last().unwrap_or_default();
    let end = Extreme { t: found.time.last().copied().unwrap_or(0.0), step: 0, value: last, by };
    let all = [of.max.clone(), of.min.clone(), of.peak(), end];
    let row = |(what, at): (&'static str, Extreme)| Row {
        output: model.outputs[output].name.clone(),
        what,
        unit: &model.outputs[output].unit,
        value: at.value,
        t: at.t,
        by: (0..found.parameters.len()).map(|j| derivative(model, found, j, &at)).collect(),
    };
    VALUES.into_iter().zip(all).map(row).collect()
}

/// What a link, or all of them, have turned into heat until the end.
fn heat<'a>(model: &'a Model, found: &'a Gradient, element: Option<usize>) -> Row<'a> {
    let name = element.map(|e| &model.elements[e].name);
    let link = name.and_then(|name| found.heat.iter().find(|h| h.link == *name));
    let of = link.map_or_else(|| found.all_heat(), |h| (h.heat, h.by.clone()));
    let name = name.map_or(HEAT.into(), |name| format!("{HEAT_OF}{name}"));
    energy(model, found, name, of)
}

/// What is told of an energy until the end.
fn energy<'a>(
    model: &Model,
    found: &'a Gradient,
    name: String,
    (value, by): (f64, Vec<f64>),
) -> Row<'a> {
    let t = found.time.last().copied().unwrap_or(0.0);
    let at = Extreme { t, step: 0, value, by };
    Row {
        output: name,
        what: "final",
        unit: "J",
        value,
        t,
        by: (0..found.parameters.len()).map(|j| derivative(model, found, j, &at)).collect(),
    }
}

fn derivative<'a>(model: &Model, found: &'a Gradient, j: usize, at: &Extreme) -> Derivative<'a> {
    let (name, value, derivative) = (&found.parameters[j], found.values[j], at.by[j]);
    let unit = model.parameters.iter().find(|p| p.name == *name).map(|p| match &p.value {
        ParameterValue::Number(_, dimension) => dimension.unit(),
        ParameterValue::Text(_) => String::new(),
    });
    let elasticity = (at.value != 0.0).then(|| derivative * value / at.value);
    Derivative { parameter: name, unit: unit.unwrap_or_default(), derivative, elasticity }
}

/// What the program prints.
pub(crate) fn page(model: &Model, told: &Told<'_>) -> String {
    let mut out = format!("{}\n\n", visible_line(&model.title));
    out += &format!("derivatives of case \"{}\" over its {} substeps\n", told.case, told.substeps);
    let mut rows = vec![row(["output", "", "value", "by", "derivative", "", "% per %"])];
    for one in told.derivatives.iter().filter(|r| r.what == "peak" || r.what == "final") {
        for (i, by) in one.by.iter().enumerate() {
            let first = i == 0;
            let value = format!("{} {}", number(one.value), one.unit);
            let per = if by.unit == "1" {
                one.unit.to_owned()
            } else {
                format!("{} per {}", one.unit, by.unit)
            };
            let elasticity = by.elasticity.map_or("–".into(), |e| format!("{e:+.4}"));
            let head = |text: &str| if first { text.to_owned() } else { String::new() };
            rows.push(vec![
                head(&one.output),
                head(one.what),
                head(&value),
                by.parameter.to_owned(),
                number(by.derivative),
                per,
                elasticity,
            ]);
        }
    }
    out += &table(&rows, &[0, 1, 3, 5]);
    out += "  peak: the largest magnitude at the end of a substep; its derivative is that of the history at its time\n";
    for Bent { link, t, substeps } in &told.bends {
        out += &format!(
            "  warning: the law of \"{link}\" bends at the end of {substeps} of the substeps, first at t = {} s: there it has one derivative to each side, and what is told is that of one\n",
            number(*t)
        );
    }
    out
}

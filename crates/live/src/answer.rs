//! Answers to the questions of a page.

use crate::draft;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::path::Path;
use std::rc::Rc;
use trilith::model::file::{Kind, Node};
use trilith::model::{ModelText, Output, ParameterValue};
use trilith::report::{self, Sections};
use trilith::{Analysis, Diagnostic, Error, Model, Run, RunOptions};
use trilith_diagnostics::{Renderer, all, at, plain};

/// Deformed shapes that a page moves through.
const FRAMES: usize = 200;

/// What a page asks.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case", deny_unknown_fields)]
enum Question {
    /// Keeps files that models read: their content by their path. Those kept before are no more, nor is what was read of them.
    Files { files: BTreeMap<String, String> },
    /// Cases, solvers and parameters of a model.
    Look {
        path: String,
        text: String,
        #[serde(default)]
        set: BTreeMap<String, String>,
    },
    /// Runs a case and makes the page of the run.
    Run(ToRun),
}

/// What is to run, and how.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ToRun {
    path: String,
    text: String,
    #[serde(default)]
    set: BTreeMap<String, String>,
    /// The last one where none is named.
    case: Option<String>,
    /// That of the case where none is named.
    solver: Option<String>,
    #[serde(default)]
    care: Care,
    /// Whether the page is there already, of another run of the same model: what takes the place of its parts will do.
    #[serde(default)]
    update: bool,
    /// Sections that a draft takes the place of; all where none are named.
    #[serde(default)]
    sections: Option<Vec<String>>,
}

/// How carefully.
#[derive(Clone, Copy, Default, Deserialize, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Care {
    /// With coarser steps, for a value that is still being moved.
    Draft,
    /// As the file says.
    #[default]
    Plain,
    /// With the errors of the steps, which takes as long again.
    Errors,
}

/// A parameter as its field shows it.
#[derive(Serialize)]
struct Parameter<'a> {
    name: &'a str,
    /// As the file says it.
    text: &'a str,
    /// In SI; none for a text.
    value: Option<f64>,
}

/// Answers a question; all that may go wrong is told in the answer: `{"told": "error: …"}`.
#[must_use]
pub fn answer(question: &str) -> String {
    let answer = match serde_json::from_str(question) {
        Ok(question) => of(question).unwrap_or_else(|told| json!({ "told": told })),
        Err(error) => json!({ "told": told(&format!("a question that is none: {error}"), None) }),
    };
    answer.to_string()
}

fn told(message: &str, help: Option<&str>) -> String {
    plain(&Renderer::plain(), message, help)
}

fn of(question: Question) -> Result<Value, String> {
    match question {
        Question::Files { files } => {
            LAST.take();
            keep(files);
            Ok(json!({}))
        }
        Question::Look { path, text, set } => {
            let (text, model) = read(&path, &text, set)?;
            let source = text.sources().next().map_or("", |source| &source.text);
            let cases: Vec<&str> = model.cases.iter().map(|c| c.name.as_str()).collect();
            Ok(json!({
                "title": model.title,
                "parameters": parameters(&model, source),
                "cases": cases,
                "solvers": model.solver_names(),
                "version": trilith::LONG_VERSION,
            }))
        }
        Question::Run(asked) => run(asked),
    }
}

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
fn keep(files: BTreeMap<String, String>) {
    use trilith::record::file::memory;
    memory::forget();
    files.into_iter().for_each(|(path, text)| memory::keep(path, text.into_bytes()));
}

/// Where there is a system, its files are read.
#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
fn keep(_: BTreeMap<String, String>) {}

thread_local! {
    /// The model that was read last, with its files: most questions differ in values alone.
    static LAST: Cell<Option<Rc<ModelText>>> = const { Cell::new(None) };
}

fn parsed(path: &str, text: &str) -> Result<Rc<ModelText>, Vec<Diagnostic>> {
    let same = |last: &Rc<ModelText>| {
        last.sources().next().is_some_and(|s| s.path == Path::new(path) && s.text == text)
    };
    let model = match LAST.take().filter(same) {
        Some(last) => last,
        None => Rc::new(ModelText::new(text, path)?),
    };
    LAST.set(Some(Rc::clone(&model)));
    Ok(model)
}

fn read(
    path: &str,
    text: &str,
    set: BTreeMap<String, String>,
) -> Result<(Rc<ModelText>, Model), String> {
    let wrong = |errors: Vec<Diagnostic>| all(&Renderer::plain(), &errors);
    let set: Vec<(String, String)> = set.into_iter().collect();
    let text = parsed(path, text).map_err(wrong)?;
    let model = text.read(&trilith::registry(), &set).map_err(wrong)?;
    Ok((text, model))
}

/// The parameters with the words of the file.
fn parameters<'a>(model: &'a Model, source: &'a str) -> Vec<Parameter<'a>> {
    let root = trilith::model::file::parse(source, &model.source.path).ok();
    let field = |node: &Node, key: &str| match &node.kind {
        Kind::Fields(_, entries) => entries.iter().find(|e| e.key == key).map(|e| e.value.clone()),
        Kind::Map(entries) => entries.iter().find(|e| e.key == key).map(|e| e.value.clone()),
        _ => None,
    };
    let words = root.and_then(|(_, root)| field(&root, "parameters"));
    let text = |name: &str| -> &'a str {
        let span = words.as_ref().and_then(|words| field(words, name)).map(|node| node.span);
        span.and_then(|span| source.get(span)).unwrap_or_default().trim_matches('"')
    };
    let one = |p: &'a trilith::model::Parameter| Parameter {
        name: &p.name,
        text: text(&p.name),
        value: match p.value {
            ParameterValue::Number(value, _) => Some(value),
            ParameterValue::Text(_) => None,
        },
    };
    model.parameters.iter().map(one).collect()
}

fn run(asked: ToRun) -> Result<Value, String> {
    let ToRun { path, text, set, case, solver, mut care, update, sections } = asked;
    let overrides: Vec<(String, String)> = set.clone().into_iter().collect();
    let (_, mut model) = read(&path, &text, set)?;
    if care == Care::Draft && !draft::coarsen(&mut model) {
        care = Care::Plain;
    }
    let model = &model;
    let renderer = Renderer::plain();
    let failed = |error: Error| match error.span() {
        Some(span) => at(&renderer, &error.to_string(), &model.places.find(&span)),
        None => told(&error.to_string(), None),
    };
    let case = match case {
        Some(name) => model.case(&name).ok_or_else(|| failed(Error::unknown_case(model, &name)))?,
        None => model.cases.len().checked_sub(1).ok_or_else(|| told("there is no case", None))?,
    };
    let solver = match solver {
        Some(name) => Some(model.solver(&name, case).ok_or_else(|| {
            let names = model.solver_names().join(", ");
            told(&format!("there is no solver `{name}`"), Some(&format!("there are {names}")))
        })?),
        None => None,
    };
    let analysis = Analysis::new(model).map_err(failed)?.with_frames(FRAMES).with_loops();
    let options =
        RunOptions { case, solver, step_errors: care == Care::Errors, ..RunOptions::default() };
    let run = analysis.run(options).map_err(failed)?;
    let summary = run.summary(model);
    // After a run that is no draft none follows.
    let sections = sections.filter(|_| update && care == Care::Draft);
    let sections = sections.map_or_else(Sections::all, Sections::of);
    let data = run.report_of(&analysis, &summary, &overrides, &[], &sections);
    let value = serde_json::to_value(&summary).unwrap_or_default();
    let page = match update {
        true => report::run_update(&value, &data, &Value::Null, &sections),
        false => report::run_page(&value, &data, &Value::Null),
    };
    Ok(json!({
        "page": page,
        "care": care,
        "warnings": summary.warnings,
        "peaks": peaks(model, &run),
        "ended": summary.status,
    }))
}

/// The value of largest magnitude of every output, SI.
fn peaks(model: &Model, run: &Run) -> Vec<Value> {
    let one = |(_, output): (usize, &Output)| {
        let peak = run.peak(&output.name).ok()?;
        let value = if peak.max >= -peak.min { peak.max } else { peak.min };
        Some(json!({ "name": output.name, "unit": output.unit, "value": value }))
    };
    model.shown().filter_map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"(
        title: "Oscillator",
        parameters: { "k": "4 kN/m", "twice": "2 * k" },
        plane: XZ,
        nodes: { "m": (0, 0, 0) },
        supports: { "m": (Uz, Ry) },
        elements: {
            "mass": Mass(node: "m", mass: "100 kg"),
            "spring": Spring(node: "m", k2: "k"),
        },
        cases: { "swing": Dynamic(
            duration: "2 s", dt: "5 ms", solver: Hht,
            initial: [(node: "m", dof: Ux, velocity: "1 m/s")],
        ) },
        outputs: { "sway": Displacement(node: "m", dof: Ux) },
    )"#;

    fn asked(question: &Value) -> Value {
        serde_json::from_str(&answer(&question.to_string())).unwrap()
    }

    #[test]
    fn a_model_tells_its_parameters_in_the_words_of_its_file() {
        let told = asked(&json!({ "ask": "look", "path": "a.ron", "text": TEXT }));
        let parameters = json!([
            { "name": "k", "text": "4 kN/m", "value": 4000.0 },
            { "name": "twice", "text": "2 * k", "value": 8000.0 },
        ]);
        assert_eq!(told["parameters"], parameters);
        assert_eq!((&told["title"], &told["cases"]), (&json!("Oscillator"), &json!(["swing"])));
        assert!(told["solvers"].as_array().unwrap().contains(&json!("hht")));
    }

    #[test]
    fn a_run_answers_with_its_page_and_the_peaks_of_the_values_asked_for() {
        let run =
            |set: Value| asked(&json!({ "ask": "run", "path": "a.ron", "text": TEXT, "set": set }));
        // v/ω, ω² = k/m
        let sway = |told: &Value| told["peaks"][0]["value"].as_f64().unwrap().abs();
        let told = run(json!({}));
        assert!((sway(&told) - (100.0_f64 / 4000.0).sqrt()).abs() < 1e-3, "{}", told["peaks"]);
        assert!(told["page"].as_str().unwrap().contains("Oscillator"));
        let told = run(json!({ "k": "16 kN/m" }));
        assert!((sway(&told) - (100.0_f64 / 16000.0).sqrt()).abs() < 1e-3, "{}", told["peaks"]);
    }

    #[test]
    fn a_draft_is_near_and_says_what_it_is() {
        let run = |care: &str| {
            asked(&json!({ "ask": "run", "path": "a.ron", "text": TEXT, "care": care }))
        };
        let sway = |told: &Value| told["peaks"][0]["value"].as_f64().unwrap().abs();
        let [draft, plain, errors] = ["draft", "plain", "errors"].map(run);
        let exact = (100.0_f64 / 4000.0).sqrt();
        assert_eq!([&draft["care"], &plain["care"]], ["draft", "plain"]);
        // What has no draft is run.
        let fixed = TEXT.replace("solver: Hht", "solver: Hht, step: Fixed");
        let fixed =
            asked(&json!({ "ask": "run", "path": "a.ron", "text": fixed, "care": "draft" }));
        assert_eq!(fixed["care"], "plain");
        assert_eq!(sway(&errors), sway(&plain));
        assert!((sway(&draft) / exact - 1.0).abs() < 3e-3, "{}", draft["peaks"]);
        assert!((sway(&plain) / exact - 1.0).abs() < 2e-4, "{}", plain["peaks"]);
    }

    #[test]
    fn a_draft_makes_the_sections_that_are_asked_for() {
        let page = |text: &str, more: Value| {
            let mut question = json!({ "ask": "run", "path": "a.ron", "text": text });
            question.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
            asked(&question)["page"].as_str().unwrap().to_owned()
        };
        let has = |page: &str, id: &str| page.contains(&format!("<section id=\"{id}\">"));
        let sections = json!(["peaks", "histories"]);
        let draft = page(TEXT, json!({ "update": true, "care": "draft", "sections": sections }));
        assert!(has(&draft, "peaks") && has(&draft, "histories"), "{draft}");
        assert!(!has(&draft, "motion") && !has(&draft, "energy") && !draft.contains("<nav"));
        assert!(!draft.contains("\"frames\"") && !draft.contains("id=\"shapes\""));
        // None follows what is no draft, nor what makes a page of its own: they are whole.
        let fixed = TEXT.replace("solver: Hht", "solver: Hht, step: Fixed");
        for (text, more) in [
            (TEXT, json!({ "update": true, "sections": sections })),
            (TEXT, json!({ "care": "draft", "sections": sections })),
            (&fixed, json!({ "update": true, "care": "draft", "sections": sections })),
        ] {
            let whole = page(text, more);
            assert!(has(&whole, "motion") && has(&whole, "energy") && whole.contains("<nav"));
            assert!(whole.contains("\"frames\"") && whole.contains("id=\"shapes\""));
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_its_caret_and_nothing_ends_the_engine() {
        let told = |question: Value| asked(&question)["told"].as_str().unwrap().to_owned();
        let run = |text: &str, more: Value| {
            let mut question = json!({ "ask": "run", "path": "a.ron", "text": text });
            question.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
            told(question)
        };
        let wrong = run(&TEXT.replace("100 kg", "100 m"), json!({}));
        assert!(wrong.contains("a.ron:8:") && wrong.contains("^^^"), "{wrong}");
        assert!(run(TEXT, json!({ "set": { "q": "1" } })).contains('q'));
        assert!(run(TEXT, json!({ "case": "fall" })).contains("fall"));
        assert!(run(TEXT, json!({ "solver": "magic" })).contains("hht"));
        assert!(run("(", json!({})).contains("a.ron:1:"));
        assert!(told(json!({ "ask": "sing" })).contains("sing"));
    }
}

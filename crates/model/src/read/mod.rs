//! Reading a model file: RON text in, checked [`Model`] in SI out.

mod accelerogram;
mod along;
mod cases;
mod combinations;
mod context;
mod custom;
mod damping;
mod declared;
mod dynamic;
mod elements;
mod envelopes;
mod files;
mod functions;
mod groups;
mod likeness;
mod loads;
mod members;
mod motion;
mod motions;
mod names;
mod nodes;
mod outputs;
mod reach;
mod record;
mod solution;
mod spectra;
mod synthetic;
mod tables;
mod units;
mod values;

#[cfg(test)]
mod tests;

use crate::expand::{expand, has_templates};
use crate::include::{self, OpenTexts, Whole};
use crate::named::Named;
use crate::schema;
use crate::tree::{self, Kind, Node};
use crate::units::STANDARD_GRAVITY;
use crate::{Diagnostic, Model, Plane, Registry, Source};
pub use context::{Context, Fields};
pub(crate) use files::CONTENTS;
pub use groups::fits;
pub use likeness::resembles_model;
pub(crate) use motion::nodal_dimension;
use names::Names;
use std::path::Path;
use std::sync::Arc;
use trilith_element::dimension as d;

/// Reads a model file. `overrides` are names and values of parameters that replace those of the
/// file; a value is an expression, or the text of a text parameter.
///
/// # Errors
/// All errors of the file at once; of a file that is no RON, the first.
pub fn read(
    path: impl AsRef<Path>,
    registry: &Registry,
    overrides: &[(String, String)],
) -> Result<Model, Vec<Diagnostic>> {
    let path = path.as_ref();
    read_text(&open(path, "model")?, path, registry, overrides)
}

/// The text of a file; `what` it is stands in the error.
///
/// # Errors
/// E0100 where it cannot be read, is no regular file, or is larger than [`trilith_record::file::MOST_BYTES`].
pub fn open(path: &Path, what: &str) -> Result<String, Vec<Diagnostic>> {
    trilith_record::file::read_text(path).map_err(|error| {
        let source = Arc::new(Source { path: path.to_owned(), ..Source::default() });
        let message = format!("the {what} file cannot be read: {error}");
        vec![Diagnostic::new("E0100", message, 0..0, &source)]
    })
}

/// Reads a model from a text. Files it names are looked for in the folder of `path`.
///
/// # Errors
/// As [`read`].
pub fn read_text(
    text: &str,
    path: impl AsRef<Path>,
    registry: &Registry,
    overrides: &[(String, String)],
) -> Result<Model, Vec<Diagnostic>> {
    ModelText::new(text, path)?.read(registry, overrides)
}

/// Takes a RON text apart; a JSON text, where the path ends so.
///
/// # Errors
/// What is wrong with the text itself.
pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<(Arc<Source>, Node), Vec<Diagnostic>> {
    let sha256 = crate::model::sha256(text.as_bytes());
    let path = path.as_ref().to_owned();
    let source = Arc::new(Source { path, text: text.to_owned(), sha256 });
    let is_json = source.path.extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
    let root = apart(text, || if is_json { tree::json::parse(text) } else { tree::parse(text) });
    let root = root.map_err(|e| {
        let d = Diagnostic::new(e.code, e.message, e.span, &source);
        let d = e.related.into_iter().fold(d, |d, (span, what)| d.related(span, what));
        vec![match e.help {
            Some(help) => d.help(help),
            None => d,
        }]
    })?;
    Ok((source, root))
}

/// Texts from this size on, in bytes, are taken apart on a thread of their own.
const LARGE: usize = 1 << 20;

/// A tree is millions of small pieces. Those that a thread of its own makes lie together, and the system has their memory back
/// when the tree goes; among what is made from the tree they would leave holes, hundreds of MB of them for a frame of 1.5 million equations.
fn apart<T: Send>(text: &str, make: impl Fn() -> T + Send + Sync) -> T {
    if text.len() >= LARGE {
        let made = std::thread::scope(|scope| {
            let thread = std::thread::Builder::new().spawn_scoped(scope, &make).ok()?;
            Some(thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
        });
        if let Some(made) = made {
            return made;
        }
    }
    // A small one, or there are no threads.
    make()
}

/// A model file whose text has been understood, with those that it includes, to be read with many values of its
/// parameters. Motions are read from their files, or made, once: what changes on disk afterwards is not seen.
#[derive(Clone, Debug)]
pub struct ModelText {
    whole: Whole,
    /// Names of the sections that have something to expand.
    templates: Vec<String>,
    motions: Arc<motions::Motions>,
}

impl ModelText {
    /// Takes a text apart. Files it names are looked for in the folder of `path`.
    ///
    /// # Errors
    /// What is wrong with the text itself, or with a file that it includes.
    pub fn new(text: &str, path: impl AsRef<Path>) -> Result<Self, Vec<Diagnostic>> {
        Self::with_open(text, path, &OpenTexts::new())
    }

    /// The same where other texts count than those that included files have on the disk, as in an editor.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_open(
        text: &str,
        path: impl AsRef<Path>,
        open: &OpenTexts,
    ) -> Result<Self, Vec<Diagnostic>> {
        let (source, root) = parse(text, path)?;
        let whole = include::whole(&source, root, open)?;
        let templates = match &whole.root.kind {
            Kind::Fields(_, entries) => {
                let all = entries.iter().filter(|e| {
                    !schema::AS_IT_STANDS.contains(&e.key.as_str()) && has_templates(&e.value)
                });
                all.map(|e| e.key.clone()).collect()
            }
            _ => Vec::new(),
        };
        Ok(Self { whole, templates, motions: Arc::default() })
    }

    /// The model file and those that it includes.
    pub fn sources(&self) -> impl Iterator<Item = &Source> {
        self.whole.places.files().map(|source| &**source)
    }

    /// The model with these values of its parameters.
    ///
    /// # Errors
    /// As [`read`].
    pub fn read(
        &self,
        registry: &Registry,
        overrides: &[(String, String)],
    ) -> Result<Model, Vec<Diagnostic>> {
        let source = self.whole.places.main();
        if let Some(kind) = registry.duplicates().first() {
            let message = format!("two kinds are registered under the name `{kind}`");
            let help = "give one of them another name";
            return Err(vec![Diagnostic::new("E0121", message, 0..0, source).help(help)]);
        }
        let folder = source.path.parent().unwrap_or(Path::new("")).to_owned();
        let mut context = Context::new(Arc::clone(source), folder, registry);
        context.motions = Arc::clone(&self.motions);
        context.set_places(self.whole.places.clone());
        let model = sections(&mut context, &self.whole, &self.templates, overrides);
        // What every model must keep to, this one does unless something was overlooked above.
        if let (Some(model), true) = (&model, context.is_content()) {
            for error in model.check().err().into_iter().flatten() {
                context.report(context.diagnostic("E0112", error.to_string(), error.span));
            }
        }
        let errors = context.into_errors();
        match model {
            Some(model) if errors.is_empty() => Ok(model),
            _ if errors.is_empty() => {
                let span = self.whole.root.span.clone();
                Err(vec![Diagnostic::new("E0105", "this is no model", span, source)])
            }
            _ => Err(errors),
        }
    }
}

fn sections(
    c: &mut Context<'_>,
    whole: &Whole,
    templates: &[String],
    overrides: &[(String, String)],
) -> Option<Model> {
    let top = c.block(&whole.root, "the model", schema::MODEL.blocks[0])?;
    let own = top.get("units").map(|node| (0, node));
    for (file, node) in own.into_iter().chain(whole.units.iter().map(|(i, n)| (*i, n))) {
        let units = units::file_units(c, node).unwrap_or_default();
        c.set_units(file, units);
    }
    let declared = c.section(&top, "parameters", false);
    c.set_parameters(declared, overrides);
    let expanded = expand(c, &top, templates)?;
    let top = top.with(&expanded);
    let c = &*c;

    let plane = top.get("plane");
    let plane = plane.and_then(|node| c.choice(node, "plane", schema::PLANES));
    let plane = plane.map(|i| Plane::ALL[i]);
    let gravity = match top.get("gravity") {
        Some(node) => {
            c.ranged(node, "gravity", d::ACCELERATION, trilith_element::Range::NonNegative)
        }
        None => Some(STANDARD_GRAVITY),
    };
    let title = top.get("title").map_or(Some(String::new()), |n| c.text(n, "title"));

    let node_entries = c.section(&top, "nodes", true);
    let element_entries = c.section(&top, "elements", true);
    let function_entries = c.section(&top, "functions", false);
    let load_entries = c.section(&top, "loads", false);
    let case_entries = c.section(&top, "cases", true);
    let node_names = Names::new(names::NODE, "nodes", node_entries);
    let element_names = Names::new("element", "elements", element_entries);
    let group_entries = c.section(&top, "groups", false);
    let groups = groups::groups(c, group_entries, &node_names, &element_names);
    let (node_names, element_names) = (node_names.with(&groups), element_names.with(&groups));
    let function_names = Names::new("function", "functions", function_entries);
    let load_names = Names::new("load", "loads", load_entries);

    let nodes = nodes::nodes(c, node_entries);
    let supports = nodes::supports(c, c.section(&top, "supports", false), &node_names);
    let properties = c.section(&top, "properties", false);
    let elements = elements::elements(c, element_entries, properties, &node_names, &nodes);
    let damping = top.get("damping").map_or(Some(crate::Damping::None), |n| damping::damping(c, n));
    let functions = functions::functions(c, function_entries, &function_names);
    let members = along::Members { names: &element_names, elements: &elements, nodes: &nodes };
    let patterns = loads::patterns(c, load_entries, &node_names, &members);
    let about = cases::Surroundings {
        nodes: &node_names,
        supports: &supports,
        functions: &function_names,
        functions_read: &functions,
        loads: &load_names,
    };
    let cases = cases::cases(c, case_entries, &about);
    let p_delta =
        top.get("p_delta").map_or(Some(None), |n| cases::p_delta(c, n, case_entries, &cases));
    let combination_entries = c.section(&top, "combinations", false);
    let case_names = Names::new("case", "cases", case_entries);
    let combinations = combinations::combinations(c, combination_entries, &case_names);
    let structure = outputs::Structure {
        members: &members,
        nodes: &node_names,
        names: &element_names,
        places: &nodes,
        supports: &supports,
        elements: &elements,
        patterns: &patterns,
    };
    let mut outputs = outputs::outputs(c, c.section(&top, "outputs", false), &structure);
    let spectrum_entries = c.section(&top, "spectra", false);
    let spectra = spectra::spectra(c, spectrum_entries, &node_names, &mut outputs);
    let envelope_entries = c.section(&top, "envelopes", false);
    let envelopes = envelopes::envelopes(c, envelope_entries, &members, plane, &mut outputs);
    Some(Model {
        title: title?,
        source: Source::clone(&c.source),
        places: c.places.clone(),
        files: c.files.borrow().clone(),
        plane,
        gravity: gravity?,
        p_delta: p_delta?,
        parameters: c.parameters().values(),
        nodes: without_gaps(nodes),
        supports: supports.into_iter().flatten().collect(),
        elements: without_gaps(elements),
        groups: groups.kept(group_entries),
        damping: damping?,
        functions: functions.into_iter().flatten().collect(),
        patterns: patterns.into_iter().flatten().collect(),
        cases: cases.into_iter().flatten().collect(),
        combinations: combinations.into_iter().flatten().collect(),
        solvers: custom::solvers(c),
        outputs: outputs.into_iter().flatten().collect(),
        spectra: spectra.into_iter().flatten().collect(),
        envelopes: envelopes.into_iter().flatten().collect(),
    })
}

/// What could be read, with no room to spare: large models are nodes and elements above all.
fn without_gaps<T>(read: Vec<Option<T>>) -> Vec<T> {
    let mut all = Vec::with_capacity(read.len());
    all.extend(read.into_iter().flatten());
    all
}

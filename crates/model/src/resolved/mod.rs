//! A model as a file with every default filled in and every expression evaluated.

mod block;
mod cases;
mod loads;
mod outputs;
mod spectra;

use crate::matrices::written;
use crate::named::Named;
use crate::read::CONTENTS;
use crate::schema;
use crate::{Body, Damping, Harmonic, Model, ParameterValue, Pattern, TimeFunction};
pub(crate) use block::BlockText;
use block::list;
use cases::{case, combination};
use outputs::output;
use std::fmt::Write;
use trilith_element::{Dimension, Dof, Frame, Value, Values, Vector3};

/// The model as a RON text in SI that reads back to the same model.
///
/// Parameters have gone into the numbers; they are listed in comments. Tables of files are written
/// out, so the text stands for itself.
///
/// # Panics
/// Where a model made in code does not hold together, as [`Model::check`] tells.
#[must_use]
pub fn resolved(model: &Model) -> String {
    written_with(model, None)
}

/// An element in place of others.
#[derive(Debug)]
pub struct Replacement<'a> {
    /// What the text says of itself in front, line by line.
    pub notes: &'a [String],
    /// True for the nodes that are left out, in the order of the model; nothing else may speak of them.
    pub without_nodes: &'a [bool],
    /// True for the elements that are left out; nothing else may speak of them.
    pub without_elements: &'a [bool],
    /// Name of the element.
    pub name: &'a str,
    /// Its kind.
    pub kind: &'a str,
    /// Its nodes.
    pub nodes: &'a [usize],
    /// Its fields; a text may be the name of a file.
    pub values: &'a Values,
    /// The load patterns, all of them, in place of those of the model.
    pub patterns: &'a [Pattern],
}

/// The model with an element in place of others, as [`resolved`] writes it.
///
/// # Panics
/// As [`resolved`].
#[must_use]
pub fn resolved_with(model: &Model, replacement: &Replacement<'_>) -> String {
    written_with(model, Some(replacement))
}

fn written_with(model: &Model, replacement: Option<&Replacement<'_>>) -> String {
    let mut w = Writer(String::new());
    w.line(0, "// Resolved model: SI units, all defaults filled in.");
    for note in replacement.into_iter().flat_map(|r| r.notes) {
        w.line(0, &format!("// {note}"));
    }
    let none: &[bool] = &[];
    let without_nodes = replacement.map_or(none, |r| r.without_nodes);
    let without_elements = replacement.map_or(none, |r| r.without_elements);
    let stays = |without: &[bool], i: usize| !without.get(i).copied().unwrap_or(false);
    for p in &model.parameters {
        let value = match &p.value {
            ParameterValue::Number(x, d) => measured(*x, Some(*d).filter(|d| !d.is_none())),
            ParameterValue::Text(t) => format!("{t:?}"),
        };
        w.line(0, &format!("// {} = {}", p.name, value.replace('"', "")));
    }
    w.line(0, "(");
    w.field("title", &text(&model.title));
    if let Some(plane) = model.plane {
        w.field("plane", plane.name());
    }
    w.field("gravity", &format!("{:?}", model.gravity));
    let nodes = model.nodes.iter().enumerate().filter(|(i, _)| stays(without_nodes, *i));
    w.map("nodes", nodes, |(_, n)| (n.name.clone(), vector(n.position)));
    w.map("supports", &model.supports, |s| {
        let dofs = Dof::ALL.iter().filter(|d| s.fixed[d.index()]).map(|d| format!("{},", d.name()));
        (model.nodes[s.node].name.clone(), format!("({})", dofs.collect::<Vec<_>>().join(" ")))
    });
    let elements = model.elements.iter().enumerate();
    let mut elements: Vec<(String, String)> = elements
        .filter(|(i, _)| stays(without_elements, *i))
        .map(|(_, e)| (e.name.clone(), element(model, e)))
        .collect();
    elements.extend(replacement.map(|r| (r.name.to_owned(), replaced(model, r))));
    w.map("elements", elements, |e| e);
    w.field("damping", &damping(&model.damping));
    if let Some(case) = model.p_delta {
        w.field("p_delta", &text(&model.cases[case].name));
    }
    w.map("functions", &model.functions, |f| (f.name.clone(), function(&f.function, f.dimension)));
    let patterns = replacement.map_or(&model.patterns[..], |r| r.patterns);
    w.map("loads", patterns, |p| (p.name.clone(), loads::pattern(model, p)));
    w.map("cases", &model.cases, |c| (c.name.clone(), case(model, c)));
    if !model.combinations.is_empty() {
        w.map("combinations", &model.combinations, |c| (c.name.clone(), combination(model, c)));
    }
    // Envelopes make their own outputs, behind all others.
    let firsts = model.envelopes.iter().flat_map(|e| &e.members).map(|m| m.first);
    let own = firsts.min().unwrap_or(model.outputs.len());
    w.map("outputs", &model.outputs[..own], |o| (o.name.clone(), output(model, o)));
    w.map("spectra", &model.spectra, |s| (s.name.clone(), spectra::spectrum(model, s)));
    if !model.envelopes.is_empty() {
        w.map("envelopes", &model.envelopes, |e| (e.name.clone(), outputs::envelope(model, e)));
    }
    w.line(0, ")");
    w.0
}

/// A sparse matrix of at most so many entries is written out; of a larger one the text names the file.
const WRITTEN: usize = 10_000;

struct Writer(String);

impl Writer {
    fn line(&mut self, indent: usize, line: &str) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.0, "{:1$}{line}", "", 4 * indent);
    }

    fn field(&mut self, name: &str, value: &str) {
        self.line(1, &format!("{name}: {value},"));
    }

    fn map<T>(
        &mut self,
        name: &str,
        items: impl IntoIterator<Item = T>,
        one: impl Fn(T) -> (String, String),
    ) {
        self.line(1, &format!("{name}: {{"));
        for item in items {
            let (key, value) = one(item);
            self.line(2, &format!("{}: {value},", text(&key)));
        }
        self.line(1, "},");
    }
}

/// A text in quotes, escaped as RON wants it.
fn text(s: &str) -> String {
    let mut out = String::from("\"");
    for c in s.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            // Braces of a text would be filled in when it is read.
            '{' | '}' => out.extend([c, c]),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            c if c.is_control() => {
                let _ = write!(out, "\\u{{{:x}}}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

fn vector(v: [f64; 3]) -> String {
    format!("({:?}, {:?}, {:?})", v[0], v[1], v[2])
}

/// A number, with its unit where there is one.
fn measured(x: f64, dimension: Option<Dimension>) -> String {
    match dimension {
        None => format!("{x:?}"),
        Some(d) if d.is_none() => format!("\"{x:?} rad\""),
        Some(d) => format!("\"{x:?} {}\"", d.unit()),
    }
}

/// A factor with a unit where it has one.
fn factor(x: f64, dimension: Dimension) -> String {
    measured(x, Some(dimension).filter(|d| !d.is_none()))
}

fn value(v: &Value) -> String {
    match v {
        Value::Number(x) => format!("{x:?}"),
        Value::Text(t) => text(t),
        Value::Flag(b) => b.to_string(),
        Value::File(file) => format!("{CONTENTS}({}, {})", text(&file.name), text(&file.text)),
        Value::Matrix(a) if a.entries.len() <= WRITTEN || a.path.is_empty() => {
            format!("{CONTENTS}({}, {})", text(&a.name), text(&written(a)))
        }
        Value::Matrix(a) => {
            // From any folder the same file.
            let path = std::path::absolute(&a.path).unwrap_or_else(|_| a.path.clone().into());
            text(&path.to_string_lossy())
        }
        Value::List(items) => {
            format!("[{}]", items.iter().map(value).collect::<Vec<_>>().join(", "))
        }
    }
}

/// A kind of element with its nodes and parameters.
fn kind(model: &Model, kind: &str, nodes: &[usize], values: &Values) -> BlockText {
    let nodes = nodes.iter().map(|&i| text(&model.nodes[i].name));
    BlockText::of_kind(kind).with(schema::PLACE.fields).list("nodes", nodes).values(values)
}

fn replaced(model: &Model, r: &Replacement<'_>) -> String {
    kind(model, r.kind, r.nodes, r.values).end()
}

fn element(model: &Model, e: &crate::Element) -> String {
    let mut text = kind(model, e.kind, &e.nodes, &e.values).with(schema::ELEMENT.fields);
    for (name, axis) in ["axis1", "axis2"].into_iter().zip(axes(model, e)) {
        if let Some(axis) = axis {
            text = text.value(name, vector(axis));
        }
    }
    if let Body::Link(_, options) = &e.body {
        text = text.with(schema::LINK.fields).number("shear_at", options.shear_at);
        if let Some([i, j]) = options.p_delta_at {
            text = text.value("p_delta_at", format!("({i:?}, {j:?})"));
        }
        if let Some(k) = &options.effective_stiffness {
            text = text.list("effective_stiffness", k.iter().map(|x| format!("{x:?}")));
        }
    }
    text.end()
}

/// Directions of local axes as the file gives them; those of the frame where an element made in code has another one.
fn axes(model: &Model, e: &crate::Element) -> [Option<Vector3>; 2] {
    let places: Vec<Vector3> = e.nodes.iter().map(|n| model.nodes[*n].position).collect();
    let alike = |frame: Frame| {
        let pairs = frame.0.iter().flatten().zip(e.frame.0.iter().flatten());
        pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-9)
    };
    match Frame::of_nodes(&places, e.axes[0], e.axes[1]) {
        Ok(frame) if alike(frame) => e.axes,
        _ => [Some(e.frame.0[0]), Some(e.frame.0[1])],
    }
}

fn damping(d: &Damping) -> String {
    match d {
        Damping::None => BlockText::new(&schema::NO_DAMPING),
        Damping::Modal { ratio } => BlockText::new(&schema::MODAL).number("ratio", *ratio),
        Damping::ModalTable { points } => {
            let points = points.iter().map(|(f, r)| format!("({f:?}, {r:?})"));
            BlockText::new(&schema::MODAL_TABLE).list("points", points)
        }
        Damping::Rayleigh { mass, stiffness } => {
            let text = BlockText::new(&schema::RAYLEIGH).number("mass", *mass);
            text.number("stiffness", *stiffness)
        }
    }
    .end()
}

fn function(f: &TimeFunction, d: Option<Dimension>) -> String {
    let amplitude = |block, x: f64| BlockText::new(block).value("amplitude", measured(x, d));
    let harmonic = |block, h: &Harmonic| {
        let text = amplitude(block, h.amplitude).number("frequency", h.frequency);
        text.number_if("cycles", h.cycles).number("start", h.start).number("phase", h.phase)
    };
    match f {
        TimeFunction::Constant(c) => {
            BlockText::new(&schema::CONSTANT).value("value", measured(*c, d))
        }
        TimeFunction::Step { amplitude: a, start, end } => {
            amplitude(&schema::STEP, *a).number("start", *start).number_if("end", *end)
        }
        TimeFunction::Ramp { amplitude: a, start, rise } => {
            amplitude(&schema::RAMP, *a).number("start", *start).number("rise", *rise)
        }
        TimeFunction::Sine(h) => harmonic(&schema::SINE, h),
        TimeFunction::Cosine(h) => harmonic(&schema::COSINE, h),
        TimeFunction::HalfSine { amplitude: a, duration, start } => {
            amplitude(&schema::HALF_SINE, *a).number("duration", *duration).number("start", *start)
        }
        TimeFunction::Ricker { amplitude: a, frequency, center } => {
            let text = amplitude(&schema::RICKER, *a).number("frequency", *frequency);
            text.number("center", *center)
        }
        TimeFunction::Custom(it) => {
            let text = BlockText::of_kind(it.card.kind).with(&[schema::AMPLITUDE]);
            text.value("amplitude", measured(it.amplitude, d)).values(&it.values)
        }
        TimeFunction::Table(table) => {
            let pairs = table.times().iter().zip(table.values());
            let points = pairs.map(|(t, y)| format!("({t:?}, {})", measured(*y, d)));
            BlockText::new(&schema::POINTS)
                .choice("interpolation", table.interpolation().name())
                .choice("after_end", table.after_end().name())
                .list("points", points)
        }
    }
    .end()
}

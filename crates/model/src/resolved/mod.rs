//! A model as a file with every default filled in and every expression evaluated.

mod cases;
mod loads;
mod outputs;
mod spectra;

use crate::matrices::written;
use crate::read::CONTENTS;
use crate::{
    AfterEnd, Body, Damping, Harmonic, Interpolation, Model, ParameterValue, Pattern, Plane,
    TimeFunction,
};
use cases::{case, combination};
use outputs::output;
use std::fmt::Write;
use trilith_element::{Card, Dimension, Dof, Frame, Value, Values, Vector3};

/// The model as a RON text in SI that reads back to the same model.
///
/// Parameters have gone into the numbers; they are listed in comments. Tables of files are written
/// out, so the text stands for itself.
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
    w.line(1, &format!("title: {},", text(&model.title)));
    if let Some(plane) = model.plane {
        let name = match plane {
            Plane::XZ => "XZ",
            Plane::YZ => "YZ",
            Plane::XY => "XY",
        };
        w.line(1, &format!("plane: {name},"));
    }
    w.line(1, &format!("gravity: {:?},", model.gravity));
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
    w.line(1, &format!("damping: {},", damping(&model.damping)));
    if let Some(case) = model.p_delta {
        w.line(1, &format!("p_delta: {},", text(&model.cases[case].name)));
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

/// Nodes and parameters.
fn fields(model: &Model, nodes: &[usize], values: &Values) -> Vec<String> {
    let nodes: Vec<String> = nodes.iter().map(|&i| text(&model.nodes[i].name)).collect();
    let mut fields = vec![format!("nodes: [{}]", nodes.join(", "))];
    fields.extend(values.0.iter().map(|(name, v)| format!("{name}: {}", value(v))));
    fields
}

fn replaced(model: &Model, r: &Replacement<'_>) -> String {
    format!("{}({})", r.kind, fields(model, r.nodes, r.values).join(", "))
}

fn element(model: &Model, e: &crate::Element) -> String {
    let mut fields = fields(model, &e.nodes, &e.values);
    for (name, axis) in ["axis1", "axis2"].iter().zip(axes(model, e)) {
        fields.extend(axis.map(|a| format!("{name}: {}", vector(a))));
    }
    if let Body::Link(_, options) = &e.body {
        fields.push(format!("shear_at: {:?}", options.shear_at));
        if let Some([i, j]) = options.p_delta_at {
            fields.push(format!("p_delta_at: ({i:?}, {j:?})"));
        }
        if let Some(k) = &options.effective_stiffness {
            let k: Vec<String> = k.iter().map(|x| format!("{x:?}")).collect();
            fields.push(format!("effective_stiffness: [{}]", k.join(", ")));
        }
    }
    format!("{}({})", e.kind, fields.join(", "))
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
        Damping::None => "None".into(),
        Damping::Modal { ratio } => format!("Modal(ratio: {ratio:?})"),
        Damping::ModalTable { points } => {
            let points: Vec<String> =
                points.iter().map(|(f, r)| format!("({f:?}, {r:?})")).collect();
            format!("ModalTable(points: [{}])", points.join(", "))
        }
        Damping::Rayleigh { mass, stiffness } => {
            format!("Rayleigh(mass: {mass:?}, stiffness: {stiffness:?})")
        }
    }
}

fn function(f: &TimeFunction, d: Option<Dimension>) -> String {
    let amount = |x: f64| measured(x, d);
    let harmonic = |name: &str, h: &Harmonic| {
        let cycles = h.cycles.map_or(String::new(), |n| format!("cycles: {n:?}, "));
        format!(
            "{name}(amplitude: {}, frequency: {:?}, {cycles}start: {:?}, phase: {:?})",
            amount(h.amplitude),
            h.frequency,
            h.start,
            h.phase
        )
    };
    match f {
        TimeFunction::Constant(c) => format!("Constant(value: {})", amount(*c)),
        TimeFunction::Step { amplitude, start, end } => {
            let end = end.map_or(String::new(), |e| format!(", end: {e:?}"));
            format!("Step(amplitude: {}, start: {start:?}{end})", amount(*amplitude))
        }
        TimeFunction::Ramp { amplitude, start, rise } => {
            format!("Ramp(amplitude: {}, start: {start:?}, rise: {rise:?})", amount(*amplitude))
        }
        TimeFunction::Sine(h) => harmonic("Sine", h),
        TimeFunction::Cosine(h) => harmonic("Cosine", h),
        TimeFunction::HalfSine { amplitude, duration, start } => format!(
            "HalfSine(amplitude: {}, duration: {duration:?}, start: {start:?})",
            amount(*amplitude)
        ),
        TimeFunction::Ricker { amplitude, frequency, center } => format!(
            "Ricker(amplitude: {}, frequency: {frequency:?}, center: {center:?})",
            amount(*amplitude)
        ),
        TimeFunction::Custom(it) => {
            let amplitude = format!("amplitude: {}", amount(it.amplitude));
            custom(it.card, &it.values, &[amplitude])
        }
        TimeFunction::Table(table) => {
            let pairs = table.times().iter().zip(table.values());
            let points: Vec<String> =
                pairs.map(|(t, y)| format!("({t:?}, {})", amount(*y))).collect();
            let interpolation = match table.interpolation() {
                Interpolation::Linear => "Linear",
                Interpolation::Cubic => "Cubic",
            };
            let after = match table.after_end() {
                AfterEnd::Error => "Error",
                AfterEnd::Zero => "Zero",
                AfterEnd::Hold => "Hold",
            };
            format!(
                "Points(interpolation: {interpolation}, after_end: {after}, points: [{}])",
                points.join(", ")
            )
        }
    }
}

/// What another crate offers, with fields of its own before those of its card.
fn custom(card: &Card, values: &Values, own: &[String]) -> String {
    let fields = values.0.iter().map(|(name, v)| format!("{name}: {}", value(v)));
    let fields: Vec<String> = own.iter().cloned().chain(fields).collect();
    format!("{}({})", card.kind, fields.join(", "))
}

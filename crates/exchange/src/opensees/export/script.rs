//! The text of a script.

use super::cases::{CONSTANT, LINEAR, Stages};
use super::command::{Command, number, quoted};
use super::freedoms::Freedoms;
use super::functions::{HELPERS, functions};
use super::outputs::Written;
use super::{Writer, losses::Loss};
use std::collections::BTreeSet;
use std::fmt::Write;
use trilith_model::{Damping, visible_line};

/// What every script has.
const RUNTIME: &str = include_str!("runtime.py");
/// Modes whose periods are written.
const MODES: usize = 12;
/// Largest increment of a displacement that ends the iterations, m.
const TOLERANCE: f64 = 1e-10;

/// The script.
pub(super) fn script(
    writer: &Writer<'_>,
    case: usize,
    freedoms: &Freedoms,
    stages: &Stages,
    outputs: &[Written],
) -> String {
    let mut out = head(writer, case);
    let full = has_modal(writer);
    let dynamic = stages.dynamic.as_ref();
    let substeps = writer.options.substeps.max(1);
    let stem = &writer.options.stem;
    let constants = [
        ("OUTPUTS", quoted(&format!("{stem}.csv")), "what is recorded"),
        (
            "PERIODS",
            quoted(&format!("{stem}.periods.csv")),
            "periods after the static cases, links by their tangents",
        ),
        ("PEAKS", quoted(&format!("{stem}.peaks.csv")), "extremes over all steps"),
        ("DT", number(dynamic.map_or(1.0, |d| d.dt)), "s, between outputs"),
        ("STEPS", dynamic.map_or(0, |d| d.steps).to_string(), "output steps"),
        ("SUBSTEPS", substeps.to_string(), "steps of OpenSees in an output step"),
        (
            "ALPHA",
            number(dynamic.map_or(1.0, |d| d.alpha)),
            "of HHT as OpenSees counts it: 1 is average acceleration",
        ),
        ("TOLERANCE", number(TOLERANCE), "m, increment that ends the iterations"),
        ("RAYLEIGH", if writer.rayleigh { "True" } else { "False" }.into(), "stiffness damps"),
        ("SYSTEM", quoted(if full { "FullGeneral" } else { "UmfPack" }), "of equations"),
        ("EQUATIONS", freedoms.equations.to_string(), "free directions"),
        ("MODES", freedoms.modes.to_string(), "of them with a mass"),
    ];
    for (name, value, what) in constants {
        let _ = writeln!(out, "{name} = {value}  # {what}");
    }
    let _ = write!(out, "\n\n{HELPERS}");
    if let Some(d) = dynamic {
        let h = d.dt / substeps as f64;
        out += &functions(writer.model, &d.functions, h, d.steps * substeps + 1);
    }
    ground(&mut out, stages);
    let _ = write!(out, "\n\n{RUNTIME}");
    structure(&mut out, writer, freedoms);
    let links = if writer.linked.is_empty() { vec!["pass".into()] } else { lines(&writer.linked) };
    function(&mut out, "links", "Links, and bearings.", &links);
    statics(&mut out, stages);
    damping(&mut out, writer, freedoms);
    record(&mut out, outputs);
    main(&mut out, stages);
    out
}

fn has_modal(writer: &Writer<'_>) -> bool {
    matches!(writer.model.damping, Damping::Modal { .. } | Damping::ModalTable { .. })
}

/// A text within three double quotes.
fn documented(text: &str) -> String {
    visible_line(text).replace('\\', "\\\\").replace('"', "'")
}

fn head(writer: &Writer<'_>, case: usize) -> String {
    let model = writer.model;
    let mut out = String::from("#!/usr/bin/env python3\n\"\"\"");
    let _ = writeln!(
        out,
        "{}\n\nCase '{}' of {}, written by `trilith export` for OpenSeesPy. SI: m, N, kg, s.",
        documented(&model.title),
        documented(&model.cases[case].name),
        documented(&writer.options.file)
    );
    let stem = documented(&writer.options.stem);
    let _ = writeln!(
        out,
        "\n    python {stem}.py      writes {stem}.csv, the outputs, {stem}.peaks.csv and {stem}.periods.csv\n\n\
         Node k of the model has the tag k; nodes behind them stand on the ground. Displacements are relative to the ground.\n\
         OpenSees has no control of the error of a step: with SUBSTEPS twice as large the results should stay.\n\
         Loads along members act as the forces at their ends that they are worth."
    );
    let differs = [&writer.losses.left_out, &writer.losses.near, &writer.losses.notes];
    let heads = ["Left out", "Near, not equal", "Notes"];
    for (head, all) in heads.iter().zip(differs).filter(|(_, all)| !all.is_empty()) {
        let _ = writeln!(out, "\n{head}:");
        for line in all.iter().map(Loss::line) {
            let _ = writeln!(out, "  {}", documented(&line));
        }
    }
    out += "\"\"\"\n\nimport csv\nimport math\nfrom bisect import bisect_right\n\nimport openseespy.opensees as ops\n\n";
    out
}

/// A function of Python with a sentence on it.
fn function(out: &mut String, name: &str, what: &str, body: &[String]) {
    let _ = writeln!(
        out,
        "\n\ndef {name}:\n    \"\"\"{what}\"\"\"",
        name = if name.ends_with(')') { name.into() } else { format!("{name}()") }
    );
    for line in body {
        let _ = writeln!(out, "    {line}");
    }
}

fn lines(commands: &[Command]) -> Vec<String> {
    commands.iter().map(Command::python).collect()
}

fn ground(out: &mut String, stages: &Stages) {
    let base = stages.dynamic.as_ref().map_or(&[][..], |d| &d.base);
    let each = |direction: usize| {
        let all: Vec<String> = base
            .iter()
            .filter(|b| b.0 == direction)
            .map(|(_, f, factor)| format!("{} * f{}(t)", number(*factor), f + 1))
            .collect();
        if all.is_empty() { "0.0".into() } else { all.join(" + ") }
    };
    let body = [format!("return ({}, {}, {})[direction]", each(0), each(1), each(2))];
    function(out, "ground(direction, t)", "Acceleration of the ground along X, Y, Z.", &body);
}

fn structure(out: &mut String, writer: &Writer<'_>, freedoms: &Freedoms) {
    let [fixed, followers, masses] = freedoms.commands(writer);
    let basic =
        Command::new("model", ["basic".into(), "-ndm".into(), 3.into(), "-ndf".into(), 6.into()]);
    let mut body = vec!["ops.wipe()".into(), basic.python()];
    for (k, n) in writer.model.nodes.iter().enumerate() {
        let node = Command::new("node", [writer.node(k).into()]).all(n.position);
        body.push(node.remark(&n.name).python());
    }
    for (k, at) in writer.ground.iter().enumerate() {
        let tag = (writer.model.nodes.len() + k + 1) as i64;
        body.push(Command::new("node", [tag.into()]).all(*at).remark("ground").python());
    }
    body.extend(lines(&fixed));
    body.extend(lines(&followers));
    body.extend(lines(&masses));
    body.extend(lines(&freedoms.stays));
    body.extend(lines(&writer.structure));
    function(out, "structure", "Nodes, supports, constraints, masses and what is linear.", &body);
}

fn statics(out: &mut String, stages: &Stages) {
    let linear = Command::new("timeSeries", ["Linear".into(), LINEAR.into()]);
    let constant = Command::new("timeSeries", ["Constant".into(), CONSTANT.into()]);
    let mut body = vec![linear.python(), constant.python()];
    for s in &stages.statics {
        body.push(format!("# {}", visible_line(&s.name)));
        body.extend(lines(&s.commands));
        body.push(format!("static_case({})", s.steps));
    }
    function(out, "statics", "Static cases, each from where the one before ended.", &body);
}

/// Modal damping acts on the structure without its links: it is found before they are there.
fn damping(out: &mut String, writer: &Writer<'_>, freedoms: &Freedoms) {
    let mut body = Vec::new();
    match &writer.model.damping {
        Damping::None => body.push("pass".into()),
        Damping::Rayleigh { mass, stiffness } => {
            let all = [*mass, 0.0, *stiffness, 0.0];
            body.push(Command::new("rayleigh", []).all(all).python());
        }
        Damping::Modal { .. } | Damping::ModalTable { .. } => {
            let points = match &writer.model.damping {
                Damping::Modal { ratio } => vec![(1.0, *ratio)],
                Damping::ModalTable { points } => points.clone(),
                _ => Vec::new(),
            };
            let list = |of: fn(&(f64, f64)) -> f64| {
                points.iter().map(|p| number(of(p))).collect::<Vec<_>>().join(", ")
            };
            body.push(format!("hertz, ratios = [{}], [{}]", list(|p| p.0), list(|p| p.1)));
            let held: Vec<String> =
                freedoms.linked.iter().map(|i| format!("({}, {})", i / 6 + 1, i % 6 + 1)).collect();
            if !held.is_empty() {
                body.push(format!(
                    "only_links = [{}]  # nothing else holds these directions",
                    held.join(", ")
                ));
                body.push("for node, dof in only_links:".into());
                body.push("    ops.fix(node, *[int(k + 1 == dof) for k in range(6)])".into());
            }
            body.extend(MODAL.lines().map(str::to_owned));
            if !held.is_empty() {
                body.push("for node, dof in only_links:".into());
                body.push("    ops.remove(\"sp\", node, dof)".into());
            }
        }
    }
    let what = "Damping of the structure, before links are there: it does not act on them.";
    function(out, "damping", what, &body);
}

const MODAL: &str = "\
values = [w for w in eigenvalues(MODES) if w < 1e16]
if len(values) < MODES:
    values = eigenvalues(len(values))  # those without a mass are none
f = [math.sqrt(max(w, 0.0)) / (2.0 * math.pi) for w in values]
z = [table(min(max(x, hertz[0]), hertz[-1]), hertz, ratios, ratios[-1]) for x in f]
if z:
    ops.modalDamping(*z)
";

fn record(out: &mut String, outputs: &[Written]) {
    let mut body = Vec::new();
    let nodes: BTreeSet<i64> = outputs.iter().flat_map(|o| o.reactions.iter().copied()).collect();
    if !nodes.is_empty() {
        let nodes: Vec<String> = nodes.iter().map(i64::to_string).collect();
        body.push(format!("take_reactions([{}])", nodes.join(", ")));
    }
    for o in outputs {
        body.push(format!("o{} = {}  # {}", o.index, o.expression, visible_line(&o.name)));
    }
    let shown: Vec<String> =
        outputs.iter().filter(|o| !o.hidden).map(|o| format!("o{}", o.index)).collect();
    body.push(format!("return [{}]", shown.join(", ")));
    function(out, "recorded(t)", "The outputs.", &body);
    let names: Vec<String> =
        outputs.iter().filter(|o| !o.hidden).map(|o| quoted(&o.name)).collect();
    let _ = writeln!(out, "\n\nNAMES = [{}]", names.join(", "));
}

fn main(out: &mut String, stages: &Stages) {
    let mut body: Vec<String> = Vec::new();
    body.extend(["structure()", "links()", "statics()"].map(str::to_owned));
    body.push(format!("omega2 = [w for w in eigenvalues(min(MODES, {MODES})) if 0.0 < w < 1e16]"));
    body.push("periods = [2.0 * math.pi / math.sqrt(w) for w in omega2]".into());
    body.push("write(PERIODS, [\"mode\", \"period [s]\"], enumerate(periods, 1))".into());
    body.push("rows = []".into());
    if stages.dynamic.is_some() {
        body.push("# once more from the start: modes of the structure alone damp it".into());
        body.extend(["structure()", "damping()", "links()", "statics()"].map(str::to_owned));
    }
    if let Some(d) = &stages.dynamic {
        body.push("solver(False)".into());
        body.extend(d.lines.iter().cloned());
    }
    body.push("peaks = Peaks()".into());
    body.push("values = recorded(0.0)".into());
    body.push("peaks.see(0.0, values)".into());
    body.push("rows.append([0.0, *values])".into());
    if let Some(d) = &stages.dynamic {
        body.push("h = DT / SUBSTEPS".into());
        if d.jumps {
            body.push(
                "# what begins with a jump: a very short step finds the accelerations".into(),
            );
            body.push("first = 1e-3 * h".into());
            body.push("advance(first)".into());
        } else {
            body.push("first = 0.0".into());
        }
        body.extend(
            [
                "for step in range(1, STEPS + 1):",
                "    for part in range(1, SUBSTEPS + 1):",
                "        advance(h - first)",
                "        first = 0.0",
                "        t = (step - 1) * DT + part * h",
                "        values = recorded(t)",
                "        peaks.see(t, values)",
                "    rows.append([step * DT, *values])",
            ]
            .map(str::to_owned),
        );
    }
    body.push("write(OUTPUTS, [\"t\", *NAMES], rows)".into());
    body.push(
        "head = [\"output\", \"max\", \"t_max [s]\", \"min\", \"t_min [s]\", \"final\"]".into(),
    );
    body.push("write(PEAKS, head, [[name, *row] for name, row in zip(NAMES, peaks.rows)])".into());
    function(out, "main", "Runs the case and writes what it gave.", &body);
    out.push_str("\n\nif __name__ == \"__main__\":\n    main()\n");
}

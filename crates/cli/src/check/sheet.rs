//! The sheet that `trilith check` prints: is this the structure that was meant?

use crate::text::significant;
use trilith::Model;
use trilith::model::{
    Analysis, Case, DynamicCase, Load, Plane, StepControl, output_steps, visible_line,
};
use trilith::solvers::{Freedoms, Periods, Survey};

/// Cases that are listed.
const CASES: usize = 6;
/// Significant digits.
const DIGITS: usize = 4;

pub(super) fn text(model: &Model, s: &Survey) -> String {
    let mut lines = vec![("model", visible_line(&model.title).into_owned())];
    lines.push(("counts", counts(model, s)));
    lines.push(("unknowns", unknowns(model, s)));
    lines.push(("mass", mass(s)));
    let weight = s.mass.mass[2] * model.gravity;
    let [x, y, z] = s.mass.centre.map(|x| number(rounded(x)));
    lines.push(("weight", format!("{} at g = {} m/s²", force(weight), number(model.gravity))));
    lines.push(("centre", format!("of gravity at ({x}, {y}, {z}) m")));
    lines.push(("reactions", reactions(model, s, weight)));
    lines.push(("freedoms", freedoms(&s.freedoms)));
    match &s.open {
        None => lines.push(("periods", periods(&s.engaged))),
        Some(open) => {
            lines.push(("periods", format!("{}, links engaged", periods(&s.engaged))));
            let how =
                if s.effective { "links at their `effective_stiffness`" } else { "links open" };
            lines.push(("", format!("{}, {how}", periods(open))));
        }
    }
    let mut key = "cases";
    for (case, sum) in model.cases.iter().zip(&s.loads).take(CASES) {
        lines.push((key, self::case(model, case, *sum)));
        key = "";
    }
    if let Some(more) = model.cases.len().checked_sub(CASES + 1) {
        lines.push(("", format!("and {} more", more + 1)));
    }
    lines.push(("outputs", outputs(model)));
    let line = |(key, what): (&str, String)| format!("{key:<9}  {what}\n");
    lines.into_iter().map(line).collect()
}

fn number(x: f64) -> String {
    let text = significant(x, DIGITS);
    match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// What rounding leaves of a place at the origin is none.
fn rounded(x: f64) -> f64 {
    if x.abs() < 1e-9 { 0.0 } else { x }
}

/// A number with a unit of a size that fits it.
fn scaled(x: f64, units: &[(f64, &str)]) -> String {
    let fits = |(size, _): &&(f64, &str)| x.abs() >= 0.9995 * size;
    let (size, unit) = units.iter().find(fits).or(units.last()).copied().unwrap_or((1.0, ""));
    format!("{} {unit}", number(x / size))
}

fn force(x: f64) -> String {
    scaled(x, &[(1e9, "GN"), (1e6, "MN"), (1e3, "kN"), (1.0, "N")])
}

fn several(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

fn counts(model: &Model, s: &Survey) -> String {
    let [elements, links, constraints] = s.members;
    let parts = [
        (model.nodes.len(), "node", "nodes"),
        (elements, "element", "elements"),
        (links, "link", "links"),
        (constraints, "constraint", "constraints"),
        (model.supports.len(), "support", "supports"),
    ];
    let parts = parts.into_iter().map(|(count, one, many)| several(count, one, many));
    parts.collect::<Vec<_>>().join(", ")
}

fn unknowns(model: &Model, s: &Survey) -> String {
    let mut text = several(s.equations, "equation", "equations");
    if s.massless > 0 {
        text += &format!(", {} of them without mass", s.massless);
    }
    if s.led > 0 {
        text += &format!("; {} led by cases", several(s.led, "direction", "directions"));
    }
    match model.plane {
        None => text,
        Some(Plane::XZ) => text + "; motion in XZ",
        Some(Plane::YZ) => text + "; motion in YZ",
        Some(Plane::XY) => text + "; motion in XY",
    }
}

fn mass(s: &Survey) -> String {
    let tell = |m: f64| scaled(m, &[(1e3, "t"), (1.0, "kg")]);
    let [x, y, z] = s.mass.mass;
    let alike = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
    if alike(x, z) && alike(y, z) {
        return tell(z);
    }
    format!("{} along X, {} along Y, {} along Z", tell(x), tell(y), tell(z))
}

fn reactions(model: &Model, s: &Survey, weight: f64) -> String {
    if weight == 0.0 {
        return "none: the model has no weight".into();
    }
    let direct = s.mass.on_supports * model.gravity;
    let Some(through) = s.reaction else {
        return "not found: something moves without stiffness".into();
    };
    let sum = through + direct;
    let mut text = format!("{} under gravity, {} of the weight", force(sum), percent(sum / weight));
    if direct > 0.0 {
        text += &format!("; {} of it weighs on supports itself", force(direct));
    }
    if (sum / weight - 1.0).abs() > 1e-6 {
        text += ": constraints or supports keep weight from where it should go";
    }
    text
}

fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}

fn freedoms(f: &Freedoms) -> String {
    if f.count == 0 {
        return "none: the structure is held without its links".into();
    }
    let mut text = format!("{} without links: ", several(f.count, "freedom", "freedoms"));
    if f.rigid.len() == f.count {
        text += &format!("as a rigid body {}", f.rigid.join(", "));
    } else {
        let at: Vec<String> =
            f.at.iter().map(|(node, dof)| format!("\"{}\" {dof}", visible_line(node))).collect();
        text += &at.join(", ");
        if f.at.len() < f.count {
            text += ", …";
        }
        if !f.rigid.is_empty() {
            text += &format!(" (as a rigid body {})", f.rigid.join(", "));
        }
    }
    match f.engaged {
        0 => text,
        n => text + &format!("; {n} left with links engaged, where mass alone answers"),
    }
}

fn periods(p: &Periods) -> String {
    if let Some(reason) = &p.reason {
        return format!("none ({reason})");
    }
    let mut parts: Vec<String> = p.periods.iter().map(|t| number(*t)).collect();
    if p.free > 0 {
        parts.insert(0, format!("∞ ({} free)", p.free));
    }
    match p.periods.is_empty() {
        true => parts.join(", "),
        false => format!("{} s", parts.join(", ")),
    }
}

fn case(model: &Model, case: &Case, sum: [f64; 3]) -> String {
    let name = |i: usize| format!("\"{}\"", visible_line(&model.cases[i].name));
    let after = case.after.map_or(String::new(), |i| format!(" after {}", name(i)));
    let named = format!("\"{}\"", visible_line(&case.name));
    match &case.analysis {
        Analysis::Static(s) => {
            let loads = loads(model, &s.loads);
            format!("{named} static{after}: {loads}, sum {}", vector(sum))
        }
        Analysis::Dynamic(d) => format!("{named} dynamic{after}: {}", dynamic(model, d, sum)),
    }
}

fn vector(sum: [f64; 3]) -> String {
    let [x, y, z] = sum.map(force);
    format!("({x}, {y}, {z})")
}

fn loads(model: &Model, all: &[Load]) -> String {
    let one = |load: &Load| match load {
        Load::Gravity { factor } if *factor == 1.0 => "weight".to_owned(),
        Load::Gravity { factor } => format!("{} × weight", number(*factor)),
        Load::Pattern { pattern, factor } => {
            let name = visible_line(&model.patterns[*pattern].name).into_owned();
            if *factor == 1.0 { name } else { format!("{} × {name}", number(*factor)) }
        }
    };
    match all.is_empty() {
        true => "no loads".into(),
        false => all.iter().map(one).collect::<Vec<_>>().join(" + "),
    }
}

fn dynamic(model: &Model, d: &DynamicCase, sum: [f64; 3]) -> String {
    let mut parts =
        vec![format!("{} s in {} steps", number(d.duration), output_steps(d.duration, d.dt))];
    if !d.constant.is_empty() {
        parts.push(format!("{}, sum {}", loads(model, &d.constant), vector(sum)));
    }
    let peak = |function: usize, by: f64| {
        by.abs() * model.functions[function].function.peak_until(d.duration)
    };
    for b in &d.base {
        let g = peak(b.function, b.factor) / trilith::model::STANDARD_GRAVITY;
        parts.push(format!("base {} up to {} g", ["X", "Y", "Z"][b.direction.index()], number(g)));
    }
    for f in &d.forces {
        let name = visible_line(&model.patterns[f.pattern].name);
        parts.push(format!("{name} up to {} times", number(peak(f.function, f.factor))));
    }
    if !d.supports.is_empty() {
        parts.push(several(d.supports.len(), "moving support", "moving supports"));
    }
    if !d.initial.is_empty() {
        parts.push(several(d.initial.len(), "initial value", "initial values"));
    }
    let step = match d.solution.step {
        StepControl::Adaptive { .. } => String::new(),
        StepControl::Fixed { substeps } => format!(", {substeps} fixed substeps"),
    };
    parts.push(format!("{}{step}", d.solution.solver.name()));
    parts.join("; ")
}

fn outputs(model: &Model) -> String {
    let shown = model.shown().count();
    let mut text = several(shown, "output", "outputs");
    let followed: usize = (model.envelopes.iter().flat_map(|e| &e.members))
        .map(|m| m.forces.len() * m.stations.len())
        .sum();
    let hidden = model.outputs.len() - shown - followed;
    if hidden > 0 {
        text += &format!(" and {hidden} hidden");
    }
    if followed > 0 {
        text += &format!(", {}", several(model.envelopes.len(), "envelope", "envelopes"));
    }
    if !model.spectra.is_empty() {
        text += &format!(", {}", several(model.spectra.len(), "floor spectrum", "floor spectra"));
    }
    text
}

//! Load cases.

use super::context::Context;
use super::control;
use super::damping::Damping;
use super::database::Entry;
use super::functions::Functions;
use super::histories::dynamic;
use super::sums::combinations;
use crate::ron::Ron;
use std::collections::{HashMap, HashSet};

/// How loads of nonlinear statics are applied.
const APPLIED: &str = "CASE - STATIC 2 - NONLINEAR LOAD APPLICATION";
/// What geometry static cases follow.
const GEOMETRY: &str = "CASE - STATIC 4 - NONLINEAR PARAMETERS: GeoNonLin";
/// Where cases stand.
pub const DEFINED: &str = "LOAD CASE DEFINITIONS";

/// A case that is written.
pub struct Case<'a> {
    pub name: &'a str,
    pub kind: &'a str,
    pub initial: Option<&'a str>,
}

/// What a case begins with: the case before it, and forces of that which go on.
pub struct Before<'a> {
    pub after: Option<&'a str>,
    pub carried: Vec<Ron>,
}

/// What cases leave to be settled.
#[derive(Default)]
pub struct Cases {
    /// Damping of the model and the case it is of.
    pub damping: Option<(String, Damping)>,
}

/// Reads cases and writes those that can be, or one of them with those before it.
pub fn cases<'a>(
    cx: &mut Context<'a>,
    functions: &mut Functions<'a>,
    only: Option<&str>,
    nonlinear_links: bool,
) -> Cases {
    let mut all = defined(cx);
    if let Some(only) = only {
        all = chain(&all, only);
    }
    let (geometric, bent) = geometric(cx, &all);
    let mut control = control::whole(cx, &all);
    let mut out = Cases::default();
    let mut dampings: Vec<(&str, Damping)> = Vec::new();
    let mut written: HashSet<&str> = HashSet::new();
    let mut ends: HashMap<&str, Vec<Ron>> = HashMap::new();
    for case in &all {
        if let Some(initial) = case.initial.filter(|i| nonlinear(case.kind) && !written.contains(i))
        {
            let what = format!("a case that continues the lost case {initial} is not written");
            cx.report.lose(DEFINED, &what, case.name);
            continue;
        }
        let after = case.initial.filter(|_| nonlinear(case.kind));
        // Forces that vary are not carried on here: they go on as constant ones.
        let carried = after.and_then(|a| ends.get(a)).cloned().unwrap_or_default();
        let before = Before { after, carried };
        let block = match case.kind {
            "NonStatic" if control::is_controlled(cx, case.name) => {
                let control = control.as_mut();
                let block = control.and_then(|c| control::imposed(cx, c, case, &before));
                if block.is_none() {
                    let what = "a case under displacement control is not written";
                    cx.report.lose(APPLIED, what, case.name);
                }
                block
            }
            "LinStatic" | "NonStatic" => statics(cx, case, before),
            "LinModHist" | "NonModHist" | "LinDirHist" | "NonDirHist" => {
                let mut left = Vec::new();
                let block = dynamic(cx, functions, case, before, &mut dampings, &mut left);
                ends.insert(case.name, left);
                block
            }
            "LinModal" => {
                cx.report.otherwise(DEFINED, "modes are shown by `trilith modes`", case.name);
                continue;
            }
            other => {
                let what = format!("a case of type {other} has no counterpart");
                cx.report.lose(DEFINED, &what, case.name);
                continue;
            }
        };
        let Some(block) = block else { continue };
        linear_is_linear(cx, case, nonlinear_links, &geometric);
        written.insert(case.name);
        cx.draft.cases.push((case.name.into(), block));
    }
    for (name, kind) in bent.into_iter().filter(|(name, _)| written.contains(name)) {
        let what = format!("{kind} of a static case: it is written without");
        cx.report.lose(GEOMETRY, &what, name);
    }
    cx.draft.p_delta = geometric.filter(|name| written.contains(name.as_str()));
    settle_damping(cx, dampings, &mut out);
    combinations(cx, &written);
    out
}

fn nonlinear(kind: &str) -> bool {
    kind.starts_with("Non")
}

/// Cases of the file, each behind the one that it continues.
fn defined<'a>(cx: &mut Context<'a>) -> Vec<Case<'a>> {
    let mut open: Vec<(Case<'a>, Entry<'a>)> = Vec::new();
    for row in cx.db.rows(DEFINED) {
        let initial = row.text("InitialCond").filter(|i| *i != "Zero");
        row.text("ModalCase");
        let (name, kind) = (row.need("Case"), row.need("Type"));
        if open.iter().any(|(c, _)| c.name == name) {
            row.wrong(
                &format!("there are two cases \"{name}\""),
                "every case has a name of its own",
            );
            continue;
        }
        open.push((Case { name, kind, initial }, row));
    }
    let mut out: Vec<Case<'a>> = Vec::new();
    while !open.is_empty() {
        let ready = |c: &Case<'_>| c.initial.is_none_or(|i| out.iter().any(|o| o.name == i));
        match open.iter().position(|(c, _)| ready(c)) {
            Some(at) => out.push(open.remove(at).0),
            None => {
                let (case, row) = &open[0];
                let message =
                    format!("the case before \"{}\" is missing or comes after it", case.name);
                row.wrong_at("InitialCond", &message, "Zero, or a case of this table");
                return out;
            }
        }
    }
    out
}

/// A case and those before it.
fn chain<'a>(all: &[Case<'a>], only: &str) -> Vec<Case<'a>> {
    let mut wanted = vec![only];
    while let Some(next) =
        wanted.last().and_then(|name| all.iter().find(|c| c.name == *name).and_then(|c| c.initial))
    {
        if wanted.contains(&next) {
            break;
        }
        wanted.push(next);
    }
    let keep = |c: &&Case<'a>| wanted.contains(&c.name);
    all.iter()
        .filter(keep)
        .map(|c| Case { name: c.name, kind: c.kind, initial: c.initial })
        .collect()
}

/// The static case with P-Δ whose stiffness linear cases take, where it is one, and cases whose geometry is lost.
fn geometric<'a>(
    cx: &mut Context<'a>,
    all: &[Case<'a>],
) -> (Option<String>, Vec<(&'a str, &'a str)>) {
    let (mut found, mut lost) = (None, Vec::new());
    let named: HashSet<&str> = all.iter().map(|c| c.name).collect();
    for row in cx.db.rows("CASE - STATIC 4 - NONLINEAR PARAMETERS") {
        let (name, kind) = (row.need("Case"), row.text("GeoNonLin").unwrap_or("None"));
        if kind == "None" || !named.contains(name) {
            continue;
        }
        let followed = all.iter().any(|c| c.initial == Some(name) && !nonlinear(c.kind));
        if kind != "P-Delta" || !followed || found.is_some() {
            lost.push((name, kind));
            continue;
        }
        found = Some(name.to_owned());
        let what = "its axial forces stiffen frames in all cases (`p_delta`)";
        cx.report.otherwise(GEOMETRY, what, name);
        let warm = cx.db.rows("FRAME LOADS - TEMPERATURE").next().is_some();
        if warm || !cx.ground.is_empty() {
            let what = "axial forces by warmth and moved supports are not among those that stiffen";
            cx.report.lose(GEOMETRY, what, name);
        }
    }
    (found, lost)
}

/// Names what a linear case has otherwise here.
fn linear_is_linear(
    cx: &mut Context<'_>,
    case: &Case<'_>,
    links: bool,
    geometric: &Option<String>,
) {
    if nonlinear(case.kind) {
        return;
    }
    if links {
        let what =
            "in linear cases links act by their nonlinear laws here, in SAP2000 by KE and CE";
        cx.report.lose(DEFINED, what, case.name);
    }
    match (case.initial, geometric) {
        (Some(initial), Some(p_delta)) if initial == p_delta => {}
        (Some(initial), None) if !links => {
            let what = format!("the stiffness at the end of {initial} is that of the model");
            cx.report.otherwise(DEFINED, &what, case.name);
        }
        (Some(initial), _) => {
            let what = format!("the stiffness at the end of {initial} is not taken");
            cx.report.lose(DEFINED, &what, case.name);
        }
        (None, Some(_)) => {
            cx.report.lose(DEFINED, "a case without P-Δ has that of the model", case.name);
        }
        (None, None) => {}
    }
}

pub fn of<'a>(cx: &Context<'a>, table: &str, case: &str) -> Vec<Entry<'a>> {
    cx.db.rows(table).filter(|row| row.need("Case") == case).collect()
}

/// A load of a case: its pattern times a factor.
pub fn load(name: &str, factor: f64) -> Ron {
    if factor == 1.0 {
        return Ron::text(name);
    }
    Ron::block("").with("load", Ron::text(name)).with("factor", factor)
}

pub fn known_pattern(cx: &Context<'_>, row: Entry<'_>, name: &str) -> bool {
    let known = cx.patterns.contains_key(name);
    if !known {
        let message = format!("there is no load pattern \"{name}\"");
        row.wrong_at("LoadName", &message, "they stand in LOAD PATTERN DEFINITIONS");
    }
    known
}

/// True where a pattern has no force.
pub fn is_empty(cx: &Context<'_>, pattern: &str) -> bool {
    let forces = cx.patterns.get(pattern);
    let none = forces.is_none_or(|all| all.values().flatten().all(|x| *x == 0.0));
    none && cx.draft.along.get(pattern).is_none_or(Vec::is_empty)
}

fn statics<'a>(cx: &mut Context<'a>, case: &Case<'a>, before: Before<'_>) -> Option<Ron> {
    for row in of(cx, APPLIED, case.name) {
        if let Some(node) = row.text("MonitorJt").and_then(|j| cx.joints.get(j).copied()) {
            cx.watch(node);
        }
    }
    let mut loads = before.carried;
    for row in of(cx, "CASE - STATIC 1 - LOAD ASSIGNMENTS", case.name) {
        let name = row.need("LoadName");
        if row.text("LoadType").is_none_or(|t| t.eq_ignore_ascii_case("Load pattern")) {
            let factor = row.number("LoadSF").unwrap_or(1.0);
            if known_pattern(cx, row, name) && !is_empty(cx, name) {
                loads.push(load(name, factor));
            }
        } else {
            cx.report.lose(
                "CASE - STATIC 1 - LOAD ASSIGNMENTS",
                "a load other than a pattern",
                case.name,
            );
        }
    }
    let block = Ron::block("Static").maybe("after", before.after.map(Ron::text));
    Some(block.with("loads", Ron::List(loads)))
}

/// Damping of the model: that of the last dynamic case.
fn settle_damping(cx: &mut Context<'_>, dampings: Vec<(&str, Damping)>, out: &mut Cases) {
    let Some((last, chosen)) = dampings.last().cloned() else { return };
    for (name, damping) in &dampings {
        if (&damping.ron, &damping.overrides) != (&chosen.ron, &chosen.overrides) {
            let what = format!(
                "damping of its own: the model has that of {last} (`--case` takes another)"
            );
            cx.report.lose("CASE - … DAMPING", &what, name);
        }
    }
    cx.draft.damping = chosen.ron.clone();
    out.damping = Some((last.into(), chosen));
}

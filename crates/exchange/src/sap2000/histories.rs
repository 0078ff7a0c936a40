//! Time histories.

use super::cases::{Before, Case, DEFINED, is_empty, known_pattern, load, of};
use super::context::Context;
use super::damping::{self, Damping};
use super::database::Entry;
use super::functions::Functions;
use crate::ron::{Ron, number};

/// Share of critical damping from which on a nonlinear modal history is taken for statics.
const STATIC: f64 = 0.9;

pub fn dynamic<'a>(
    cx: &mut Context<'a>,
    functions: &mut Functions<'a>,
    case: &Case<'a>,
    before: Before<'_>,
    dampings: &mut Vec<(&'a str, Damping)>,
    left: &mut Vec<Ron>,
) -> Option<Ron> {
    let modal = case.kind.ends_with("ModHist");
    let front = if modal { "CASE - MODAL HISTORY" } else { "CASE - DIRECT HISTORY" };
    let general = of(cx, &format!("{front} 1 - GENERAL"), case.name).first().copied();
    let Some(general) = general else {
        cx.report.lose(DEFINED, "a time history without its steps is not written", case.name);
        return None;
    };
    if general.text("HistoryType").is_some_and(|t| t != "Transient") {
        cx.report.lose(front, "a periodic history has no counterpart", case.name);
        return None;
    }
    let dt = general.need_number("StepSize");
    let duration = general.need_number("OutSteps") * dt;
    if !(dt > 0.0 && duration > 0.0) {
        general.wrong("a time history needs steps above zero", "OutSteps=100   StepSize=0.01");
        return None;
    }
    let damping = if modal {
        damping::modal(cx, case.name, general)
    } else {
        damping::direct(cx, case.name, general)
    };
    let rows = of(cx, &format!("{front} 2 - LOAD ASSIGNMENTS"), case.name);
    let slow = case.kind == "NonModHist" && damping.ratio.is_some_and(|r| r >= STATIC);
    if slow && rows.iter().all(|r| r.text("LoadType") != Some("Accel")) {
        return crept(cx, functions, case, before, &rows, duration);
    }
    let (mut base, mut forces) = (Vec::new(), Vec::new());
    for row in rows {
        let Some(function) = functions.used(cx, row, row.need("Function")) else {
            let what = "a case without one of its functions is not written";
            cx.report.lose(front, what, case.name);
            return None;
        };
        if row.text("LoadType") == Some("Accel") {
            accelerated(cx, case, front, row, &function, &mut base);
        } else if known_pattern(cx, row, row.need("LoadName"))
            && !is_empty(cx, row.need("LoadName"))
        {
            let factor = row.number("LoadSF").unwrap_or(1.0);
            let end = functions.value(row, row.need("Function"), duration).unwrap_or(0.0) * factor;
            if end != 0.0 {
                left.push(load(row.need("LoadName"), end));
            }
            let block = Ron::block("").with("load", Ron::text(row.need("LoadName")));
            let block = block.with("function", Ron::Text(function));
            forces.push(block.maybe("factor", (factor != 1.0).then_some(factor)));
        }
    }
    let mut block = Ron::block("Dynamic")
        .maybe("after", before.after.map(Ron::text))
        .with("duration", duration)
        .with("dt", dt)
        .maybe("constant", (!before.carried.is_empty()).then_some(Ron::List(before.carried)))
        .maybe("base", (!base.is_empty()).then_some(Ron::List(base)))
        .maybe("forces", (!forces.is_empty()).then_some(Ron::List(forces)));
    if !modal {
        block = block.with("solver", Ron::word("Hht"));
        for row in of(cx, "CASE - DIRECT HISTORY 5 - NONLINEAR PARAMETERS", case.name) {
            if row.text("GeoNonLin").is_some_and(|g| g != "None") {
                cx.report.lose(
                    "CASE - DIRECT HISTORY 5: GeoNonLin",
                    "it is written without",
                    case.name,
                );
            }
        }
        block = integrated(cx, case, block);
    }
    dampings.push((case.name, damping));
    Some(block)
}

/// α of a direct integration.
fn integrated(cx: &mut Context<'_>, case: &Case<'_>, block: Ron) -> Ron {
    let place = "CASE - DIRECT HISTORY 4 - INTEGRATION PARAMETERS";
    let Some(row) = of(cx, place, case.name).first().copied() else { return block };
    let (method, alpha) = (row.text("IntMethod"), row.or_zero("Alpha"));
    let (gamma, beta) = (row.number("Gamma").unwrap_or(0.5), row.number("Beta").unwrap_or(0.25));
    let average = (gamma - 0.5).abs() < 1e-9 && (beta - 0.25).abs() < 1e-9;
    match method {
        None | Some("HilberHughesTaylor") => block.maybe("alpha", (alpha != 0.0).then_some(alpha)),
        Some("Newmark") if average => block,
        Some(other) => {
            let what = format!("{other} is not there: the average acceleration is taken");
            cx.report.otherwise(place, &what, case.name);
            block
        }
    }
}

/// A nonlinear modal history that near-critical damping makes a slow loading: statics with its loads as they are at the end.
fn crept<'a>(
    cx: &mut Context<'a>,
    functions: &Functions<'a>,
    case: &Case<'a>,
    before: Before<'_>,
    rows: &[Entry<'a>],
    duration: f64,
) -> Option<Ron> {
    let mut loads = before.carried;
    for row in rows {
        let (name, function) = (row.need("LoadName"), row.need("Function"));
        let value = functions.value(*row, function, duration)?;
        if known_pattern(cx, *row, name) && !is_empty(cx, name) {
            loads.push(load(name, value * row.number("LoadSF").unwrap_or(1.0)));
        }
    }
    let what = "a slow loading under near-critical damping is a static case";
    cx.report.otherwise(DEFINED, what, case.name);
    let block = Ron::block("Static").maybe("after", before.after.map(Ron::text));
    Some(block.with("loads", Ron::List(loads)))
}

/// Acceleration of the ground.
fn accelerated(
    cx: &mut Context<'_>,
    case: &Case<'_>,
    front: &str,
    row: Entry<'_>,
    function: &str,
    base: &mut Vec<Ron>,
) {
    let (name, angle) = (row.need("LoadName"), row.or_zero("Angle"));
    let axis = match name {
        "Accel U1" | "Accel UX" => 0,
        "Accel U2" | "Accel UY" => 1,
        "Accel U3" | "Accel UZ" => 2,
        _ => {
            cx.report.lose(front, "an acceleration that is no translation", case.name);
            return;
        }
    };
    if row.text("CoordSys").is_some_and(|s| s != "GLOBAL") {
        cx.report.lose(front, "accelerations in other axes than the global", case.name);
    }
    let scale = row.number("TransAccSF").unwrap_or(1.0);
    let unit = format!("{}/s^2", cx.draft.units.0);
    let mut put = |direction: &str, factor: f64| {
        if factor != 0.0 {
            let factor = Ron::Text(format!("{} {unit}", number(factor)));
            let block = Ron::block("").with("direction", Ron::word(direction));
            base.push(block.with("function", Ron::text(function)).with("factor", factor));
        }
    };
    if axis == 2 || angle == 0.0 {
        put(["X", "Y", "Z"][axis], scale);
        return;
    }
    let (s, c) = angle.to_radians().sin_cos();
    let [x, y] = if axis == 0 { [c, s] } else { [-s, c] };
    put("X", scale * x);
    put("Y", scale * y);
}

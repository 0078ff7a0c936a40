//! Damping of cases.

use super::context::Context;
use super::database::Entry;
use crate::ron::Ron;

/// Damping of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Damping {
    /// As a model file has it; none: no damping.
    pub ron: Option<Ron>,
    /// The same ratio in all modes, where it is that.
    pub ratio: Option<f64>,
    /// Modes, from 1, with a ratio of their own.
    pub overrides: Vec<(usize, f64)>,
}

const MODAL: &str = "CASE - MODAL HISTORY";
const DIRECT: &str = "CASE - DIRECT HISTORY";
/// Largest ratio that a model takes.
const MOST: f64 = 0.999;

/// C = a M + b K.
fn rayleigh(row: Entry<'_>) -> Option<Ron> {
    let (a, b) = (row.or_zero("MassCoeff"), row.or_zero("StiffCoeff"));
    if a < 0.0 || b < 0.0 {
        row.wrong("a factor of proportional damping below zero", "");
    }
    let some = |x: f64| (x != 0.0).then_some(x);
    (a != 0.0 || b != 0.0)
        .then(|| Ron::block("Rayleigh").maybe("mass", some(a)).maybe("stiffness", some(b)))
}

fn of<'a>(cx: &Context<'a>, table: &str, case: &str) -> Vec<Entry<'a>> {
    cx.db.rows(table).filter(|row| row.need("Case") == case).collect()
}

/// Damping of a modal history.
pub fn modal(cx: &mut Context<'_>, case: &str, general: Entry<'_>) -> Damping {
    let ratio = general.number("ConstDamp");
    general.text("DampingType");
    let proportional = of(cx, &format!("{MODAL} 4 - PROPORTIONAL DAMPING"), case);
    let between = of(cx, &format!("{MODAL} 3 - INTERPOLATED DAMPING"), case);
    let overrides = (of(cx, &format!("{MODAL} 5 - DAMPING OVERRIDES"), case).into_iter())
        .map(|row| (row.need_number("Mode").max(0.0) as usize, row.need_number("Damping")))
        .collect();
    let mut constant = None;
    let ron = if let Some(row) = proportional.first() {
        rayleigh(*row)
    } else if !between.is_empty() {
        let mut points: Vec<[f64; 2]> = (between.iter())
            .map(|row| {
                let f = row.number("Frequency").or_else(|| row.number("Period").map(|t| 1.0 / t));
                [f.filter(|f| f.is_finite()).unwrap_or(0.0), row.need_number("Damping")]
            })
            .collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Some(table(&points))
    } else {
        constant = ratio.map(|r| r.min(MOST));
        if ratio.is_some_and(|r| !(0.0..1.0).contains(&r)) {
            general.wrong_at(
                "ConstDamp",
                "a share of critical damping that is not between 0 and 1",
                "",
            );
        }
        constant.filter(|r| *r != 0.0).map(|r| Ron::block("Modal").with("ratio", r))
    };
    Damping { ron, ratio: constant, overrides }
}

/// Ratios by frequency.
pub fn table(points: &[[f64; 2]]) -> Ron {
    let points = points.iter().map(|p| Ron::vector(p)).collect();
    Ron::block("ModalTable").with("points", Ron::List(points))
}

/// Damping of a direct history.
pub fn direct(cx: &mut Context<'_>, case: &str, general: Entry<'_>) -> Damping {
    general.text("VDampType");
    let proportional = of(cx, &format!("{DIRECT} 3 - VISCOUS PROPORTIONAL DAMPING"), case);
    let beside = general.text("MDampType").is_some_and(|t| t != "None")
        || [
            "6 - MODAL PROPORTIONAL DAMPING",
            "7 - MODAL INTERPOLATED DAMPING",
            "8 - MODAL DAMPING OVERRIDES",
        ]
        .iter()
        .any(|t| !of(cx, &format!("{DIRECT} {t}"), case).is_empty());
    if beside {
        cx.report.lose(DIRECT, "modal damping beside that in proportion", case);
    }
    let ron = proportional.first().and_then(|row| rayleigh(*row));
    Damping { ron, ratio: None, overrides: Vec::new() }
}

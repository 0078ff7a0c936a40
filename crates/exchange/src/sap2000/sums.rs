//! Combinations of cases.

use super::cases::{is_empty, load, of};
use super::context::Context;
use crate::ron::Ron;
use std::collections::{HashMap, HashSet};

/// Sums of linear static cases become cases.
pub fn combinations(cx: &mut Context<'_>, written: &HashSet<&str>) {
    const TABLE: &str = "COMBINATION DEFINITIONS";
    let mut order: Vec<&str> = Vec::new();
    let mut parts: HashMap<&str, (bool, Vec<Ron>)> = HashMap::new();
    for row in cx.db.rows(TABLE) {
        let name = row.need("ComboName");
        if !parts.contains_key(name) {
            order.push(name);
            let sum = row.text("ComboType").is_none_or(|t| t == "Linear Add");
            parts.insert(name, (sum, Vec::new()));
        }
        let Some((sum, loads)) = parts.get_mut(name) else { continue };
        let linear = row.text("CaseType").is_none_or(|t| t == "Linear Static");
        let (case, factor) = (row.need("CaseName"), row.number("ScaleFactor").unwrap_or(1.0));
        let rows = of(cx, "CASE - STATIC 1 - LOAD ASSIGNMENTS", case);
        *sum &= linear && written.contains(case) && !rows.is_empty();
        for row in rows.into_iter().filter(|row| !is_empty(cx, row.need("LoadName"))) {
            loads.push(load(row.need("LoadName"), factor * row.number("LoadSF").unwrap_or(1.0)));
        }
    }
    for name in order {
        let Some((true, loads)) = parts.remove(name) else {
            cx.report.lose(TABLE, "a combination that is no sum of linear static cases", name);
            continue;
        };
        let name = if written.contains(name) { format!("{name} (sum)") } else { name.into() };
        // Before the others: the last case is the one that runs.
        cx.draft.cases.insert(0, (name, Ron::block("Static").with("loads", Ron::List(loads))));
    }
}

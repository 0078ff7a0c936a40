//! What cases are about, and how near they come: the answer in front of the page.

use crate::{Outcome, Row};
use trilith_report::{Block, short};

/// Heads by the letters that the ids of their cases begin with, in the order in which a reader wants them.
const TOPICS: [(&str, &[&str]); 11] = [
    ("The paper on rigid blocks", &["FIG", "TAB"]),
    ("Rigid bodies: sliding, rocking, restitution", &["RB", "CAL"]),
    ("Friction", &["SL", "TC"]),
    ("Dampers", &["DP", "FS", "IN", "LL"]),
    ("Isolators", &["FP", "TP"]),
    ("Hysteretic and elastic links", &["LK"]),
    ("Impact and pounding", &["IM", "PO"]),
    ("Linear structures and P-Δ", &["LM", "PD"]),
    ("Whole structures", &["TS", "RS", "FR", "EQ", "MD"]),
    ("Beside OpenSees", &["OP"]),
    ("FNA, direct integration and their steps", &["AG", "BA", "ST", "ND", "CV", "FN", "TI"]),
];
/// What has no head of its own.
const OTHER: &str = "Other";

/// The head of a case.
pub(crate) fn topic(id: &str) -> &'static str {
    let letters = id.split(|c: char| !c.is_ascii_uppercase()).next().unwrap_or_default();
    TOPICS.iter().find(|(_, all)| all.contains(&letters)).map_or(OTHER, |(head, _)| head)
}

/// The outcomes head by head, each in its order.
pub(crate) fn by_topic(outcomes: &[Outcome]) -> Vec<&Outcome> {
    let heads = TOPICS.iter().map(|(head, _)| *head).chain([OTHER]);
    heads.flat_map(|head| outcomes.iter().filter(move |o| topic(o.id) == head)).collect()
}

/// How near the comparisons of each head come, and those with each kind of reference.
pub(crate) fn summary(outcomes: &[Outcome]) -> [Block; 2] {
    let line = |name: &str, cases: &[&Outcome]| {
        let rows: Vec<&Row> = cases.iter().flat_map(|o| &o.rows).collect();
        let missing = cases.iter().filter(|o| o.unavailable.is_some()).count();
        let mut cells = vec![name.to_owned(), cases.len().to_string()];
        cells.extend(nearness(&rows));
        cells.push(if missing == 0 { "–".into() } else { missing.to_string() });
        cells
    };
    let heads = TOPICS.iter().map(|(head, _)| *head).chain([OTHER]);
    let of = |head: &str| outcomes.iter().filter(|o| topic(o.id) == head).collect::<Vec<_>>();
    let mut topics: Vec<Vec<String>> = heads
        .map(|head| (head, of(head)))
        .filter(|(_, cases)| !cases.is_empty())
        .map(|(head, cases)| line(head, &cases))
        .collect();
    topics.push(line("all", &outcomes.iter().collect::<Vec<_>>()));
    let all: Vec<&Row> = outcomes.iter().flat_map(|o| &o.rows).collect();
    let mut kinds: Vec<&str> = Vec::new();
    for row in &all {
        if !kinds.contains(&row.kind.as_str()) {
            kinds.push(&row.kind);
        }
    }
    let kinds = kinds.into_iter().map(|kind| {
        let own: Vec<&Row> = all.iter().copied().filter(|row| row.kind == kind).collect();
        std::iter::once(kind.to_owned()).chain(nearness(&own)).collect()
    });
    let head = |first: &[&str], last: &[&str]| {
        let near = ["comparisons", "half of them within", "95 % within", "fail"];
        [first, &near, last].concat().into_iter().map(str::to_owned).collect()
    };
    [
        Block::Table { head: head(&["about", "cases"], &["not run"]), rows: topics },
        Block::Table { head: head(&["reference"], &[]), rows: kinds.collect() },
    ]
}

/// How many comparisons, within how much of the reference half of those are that are told so, and 95 %; how many fail.
fn nearness(rows: &[&Row]) -> [String; 4] {
    let relative = rows.iter().filter(|row| row.measure == "relative");
    let mut errors: Vec<f64> = relative.filter_map(|row| Some(row.error?.abs())).collect();
    errors.sort_by(f64::total_cmp);
    let within = |share: f64| {
        let at = (share * errors.len() as f64).ceil() as usize;
        errors.get(at.max(1) - 1).map_or("–".into(), |error| match 100.0 * error {
            // What is left of rounding.
            percent if percent < 1e-6 => "10⁻⁶ %".into(),
            percent => format!("{} %", short(percent, 2)),
        })
    };
    let failed = rows.iter().filter(|row| !row.pass).count();
    let failed = if failed == 0 { "–".into() } else { failed.to_string() };
    [rows.len().to_string(), within(0.5), within(0.95), failed]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_has_a_head() {
        let items = crate::all();
        assert!(items.len() > 200, "{}", items.len());
        for item in items {
            assert_ne!(topic(item.id()), OTHER, "{}", item.id());
        }
        assert_eq!(
            (topic("TI-4"), topic("FIG-S"), topic("ZZ-1")),
            (TOPICS[10].0, TOPICS[0].0, OTHER)
        );
    }

    #[test]
    fn half_and_nearly_all_errors_are_within_what_is_told() {
        let row = |error: f64, measure: &str, pass| Row {
            id: "SL-1".into(),
            quantity: "q".into(),
            unit: String::new(),
            reference: 1.0,
            source: String::new(),
            kind: "theory".into(),
            solver: "fna".into(),
            value: Some(1.0),
            error: Some(error),
            tolerance: 1.0,
            measure: measure.into(),
            pass,
            note: None,
        };
        let mut rows: Vec<Row> =
            (1..=20).map(|i| row(-0.01 * f64::from(i), "relative", true)).collect();
        rows.push(row(7.0, "absolute", false));
        let told = nearness(&rows.iter().collect::<Vec<_>>());
        assert_eq!(told, ["21", "10 %", "19 %", "1"]);
        assert_eq!(nearness(&[]), ["0", "–", "–", "–"]);
        assert_eq!(nearness(&[&row(0.0, "relative", true)])[1], "10⁻⁶ %");
    }
}

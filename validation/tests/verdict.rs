//! The verdict of all validation cases.

use trilith_validation::{cases, run_all};

#[test]
fn every_case_meets_its_reference() {
    let all = cases::all();
    let failed: Vec<String> = run_all(&all)
        .iter()
        .filter(|r| !r.pass)
        .map(|r| {
            format!(
                "{} {} {}: {:?} instead of {} (tolerance {} {}) {}",
                r.id,
                r.solver,
                r.quantity,
                r.value,
                r.reference,
                r.tolerance,
                r.measure,
                r.note.as_deref().unwrap_or("")
            )
        })
        .collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn every_case_has_a_name_of_its_own() {
    let mut ids: Vec<&str> = cases::all().iter().map(|c| c.id).collect();
    ids.sort_unstable();
    let count = ids.len();
    ids.dedup();
    assert_eq!(ids.len(), count);
}

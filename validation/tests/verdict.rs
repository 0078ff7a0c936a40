//! The verdict of all validation cases and studies.

use trilith_validation::studies::RANDOM_FNA;
use trilith_validation::{all, run_all};

/// All but the study of minutes: the first of its structures have a test of their own, and `cargo run` of this crate makes it.
#[test]
fn every_case_and_study_meets_its_reference() {
    let mut chosen = all();
    chosen.retain(|c| c.id() != RANDOM_FNA);
    let outcomes = run_all(&chosen, &|_| {});
    let failed: Vec<String> = outcomes
        .iter()
        .flat_map(|o| &o.rows)
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
    assert!(
        outcomes
            .iter()
            .filter(|o| o.unavailable.is_none())
            .all(|o| o.pass() && !o.figures.is_empty()),
        "nothing compared or drawn"
    );
}

#[test]
fn every_case_and_study_has_a_name_of_its_own() {
    let mut ids: Vec<&str> = all().iter().map(|c| c.id()).collect();
    ids.sort_unstable();
    let count = ids.len();
    ids.dedup();
    assert_eq!(ids.len(), count);
}

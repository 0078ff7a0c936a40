//! Random structures under FNA against an oracle that shares nothing with it.

use trilith::SolverKind;
use trilith_validation::oracle::generate::generate;
use trilith_validation::oracle::judge::{Verdict, WORK, judge, reference};

/// The first thirty random structures; `fuzz` of this crate runs any number under all solvers.
#[test]
fn random_structures_move_as_their_equations_say() {
    let (mut compared, mut off) = (0, Vec::new());
    for seed in 1..=30 {
        let spec = generate(seed);
        // These take seconds each.
        if spec.family == "long beam" {
            continue;
        }
        let Ok(truth) = reference(&spec, WORK) else { continue };
        compared += 1;
        match judge(&spec, &truth, SolverKind::Fna) {
            Verdict::Passed(_) => {}
            verdict => off.push((seed, verdict)),
        }
    }
    assert!(compared >= 20, "{compared}");
    assert!(off.is_empty(), "{off:?}");
}

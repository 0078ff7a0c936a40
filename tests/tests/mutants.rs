//! Spoiled files are refused, and nothing else happens.

use trilith_tests::mutants::{Corpus, mutant, read};

/// The first of those that the program `mutants` makes by the million.
#[test]
fn readers_bear_spoiled_files() {
    let corpus = Corpus::shipped();
    let mut through = 0;
    for seed in 1..=3_000 {
        let it = mutant(&corpus, seed);
        match read(&it) {
            Ok(yes) => through += usize::from(yes),
            // A slow machine is no fault of a reader.
            Err(trilith_tests::mutants::Fault::Slow(_)) => {}
            Err(fault) => panic!("seed {seed}, {:?}: {fault:?}", it.target),
        }
    }
    // Some are still what they were, most are not.
    assert!((30..2_000).contains(&through), "{through}");
}

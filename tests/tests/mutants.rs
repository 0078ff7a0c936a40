//! Spoiled files are refused, and nothing else happens.

use trilith_tests::mutants::{Corpus, Fault, Target, mutant, mutant_of, read};

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
            Err(Fault::Slow(_)) => {}
            Err(fault) => panic!("seed {seed}, {:?}: {fault:?}", it.target),
        }
    }
    // Some are still what they were, most are not.
    assert!((30..2_000).contains(&through), "{through}");
}

/// Mutants of each reader.
const EACH: u64 = 60;

#[test]
fn every_reader_bears_spoiled_files_of_its_own() {
    let corpus = Corpus::shipped();
    for target in Target::ALL {
        let (mut through, mut refused) = (0, 0);
        for seed in 1..=EACH {
            let it = mutant_of(&corpus, target, seed).unwrap_or_else(|| panic!("no {target:?}"));
            match read(&it) {
                Ok(yes) => *(if yes { &mut through } else { &mut refused }) += 1,
                Err(Fault::Slow(_)) => {}
                Err(fault) => panic!("{target:?}, seed {seed}: {fault:?}"),
            }
        }
        assert!(refused > 0, "{target:?}: nothing is refused, {through} let through");
    }
}

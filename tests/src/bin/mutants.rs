//! Reads spoiled files by the million.
//!
//! ```text
//! mutants [COUNT [FIRST SEED]]        how many, 100 000 where nothing is said
//! mutants show SEED                   writes the mutant to the screen
//! ```

use std::collections::BTreeMap;
use std::io::Write;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use trilith_tests::mutants::{Corpus, Fault, mutant, read};

/// A reader that stands still is given up after this.
const STILL: Duration = Duration::from_secs(120);

fn main() -> ExitCode {
    let corpus = Corpus::shipped();
    let given: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize, plain: u64| given.get(i).map_or(Ok(plain), |text| text.parse());
    if given.first().is_some_and(|first| first == "show") {
        let Ok(seed) = number(1, 1) else { return wrong() };
        let bytes = mutant(&corpus, seed).bytes;
        return if std::io::stdout().write_all(&bytes).is_ok() {
            ExitCode::SUCCESS
        } else {
            wrong()
        };
    }
    let (Ok(count), Ok(first)) = (number(0, 100_000), number(1, 1)) else { return wrong() };
    static AT: AtomicU64 = AtomicU64::new(0);
    std::thread::spawn(|| {
        let mut last = None;
        loop {
            let now = AT.load(Ordering::Relaxed);
            if last == Some(now) {
                println!("{now}: stands still");
                std::process::exit(1);
            }
            last = Some(now);
            std::thread::sleep(STILL);
        }
    });
    let (mut faults, mut through) = (BTreeMap::<String, Vec<u64>>::new(), 0_u64);
    for seed in first..first + count {
        AT.store(seed, Ordering::Relaxed);
        let it = mutant(&corpus, seed);
        match read(&it) {
            Ok(yes) => through += u64::from(yes),
            Err(fault) => {
                println!("{seed}: {:?}: {fault:?}", it.target);
                let class = match fault {
                    Fault::Panicked(said) => said.lines().next().unwrap_or_default().to_owned(),
                    Fault::Slow(_) => format!("{:?}: slow", it.target),
                    Fault::NotANumber(place) => format!("not a number in {place}"),
                };
                faults.entry(class).or_default().push(seed);
            }
        }
    }
    println!(
        "{count} mutants from seed {first}: {through} let through, {} kinds of faults",
        faults.len()
    );
    for (class, seeds) in &faults {
        println!("{:6}  {class}  {:?}", seeds.len(), &seeds[..seeds.len().min(5)]);
    }
    if faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn wrong() -> ExitCode {
    eprintln!("mutants [COUNT [FIRST SEED]], mutants show SEED");
    ExitCode::from(2)
}

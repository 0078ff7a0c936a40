//! Reads spoiled files by the million.
//!
//! ```text
//! mutants [COUNT [FIRST SEED]]            how many, 100 000 where nothing is said
//! mutants READER [COUNT [FIRST SEED]]     of one reader: model, json, etabs, script, npz …
//! mutants show [READER] SEED              writes the mutant to the screen
//! ```

use std::collections::BTreeMap;
use std::io::Write;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use trilith_tests::mutants::{Corpus, Fault, Mutant, Target, mutant, mutant_of, read};

/// A reader that stands still is given up after this.
const STILL: Duration = Duration::from_secs(120);

fn main() -> ExitCode {
    let corpus = Corpus::shipped();
    let mut given: Vec<String> = std::env::args().skip(1).collect();
    let show = given.first().is_some_and(|first| first == "show");
    given.drain(..usize::from(show));
    let named = |text: &String| {
        Target::ALL.into_iter().find(|t| format!("{t:?}").eq_ignore_ascii_case(text))
    };
    let target = given.first().and_then(named);
    given.drain(..usize::from(target.is_some()));
    let number = |i: usize, plain: u64| given.get(i).map_or(Ok(plain), |text| text.parse());
    let make = |seed: u64| -> Option<Mutant> {
        target.map_or_else(|| Some(mutant(&corpus, seed)), |t| mutant_of(&corpus, t, seed))
    };
    if show {
        let Some(it) = number(0, 1).ok().and_then(make) else { return wrong() };
        return if std::io::stdout().write_all(&it.bytes).is_ok() {
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
        let Some(it) = make(seed) else { return wrong() };
        match read(&it) {
            Ok(yes) => through += u64::from(yes),
            Err(fault) => {
                println!("{seed}: {:?}: {fault:?}", it.target);
                let class = match fault {
                    Fault::Panicked(said) => said.lines().next().unwrap_or_default().to_owned(),
                    Fault::Slow(_) => format!("{:?}: slow", it.target),
                    Fault::Heavy(_) => format!("{:?}: heavy", it.target),
                    Fault::Wrong(what) => format!("{:?}: {what}", it.target),
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
    let readers = Target::ALL.map(|t| format!("{t:?}").to_lowercase()).join(", ");
    eprintln!(
        "mutants [READER] [COUNT [FIRST SEED]], mutants show [READER] SEED\nreaders: {readers}"
    );
    ExitCode::from(2)
}

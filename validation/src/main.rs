//! Runs the validation cases and studies and prints the verdict. Arguments: the ids of those to run;
//! none: all.

use indicatif::{ProgressBar, ProgressStyle};
use std::process::ExitCode;
use trilith_validation::{Outcome, all, report, run_all};

fn main() -> ExitCode {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let mut chosen = all();
    if let Some(unknown) = wanted.iter().find(|w| !chosen.iter().any(|c| c.id() == w.as_str())) {
        eprintln!("there is no case or study `{unknown}`");
        return ExitCode::from(2);
    }
    chosen.retain(|c| wanted.is_empty() || wanted.iter().any(|w| w == c.id()));
    // Hidden by itself where stderr is not a terminal.
    let bar = ProgressBar::new(chosen.len() as u64).with_style(
        ProgressStyle::with_template("{bar:40} {pos}/{len} {msg} [{elapsed}, {eta} left]")
            .unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    let outcomes = run_all(&chosen, &|id| {
        bar.set_message(id.to_owned());
        bar.inc(1);
    });
    bar.finish_and_clear();
    print!("{}", report::text(&outcomes));
    let folder = report::folder();
    if let Err(error) = report::write(&folder, &outcomes) {
        eprintln!("the report cannot be written to {}: {error}", folder.display());
        return ExitCode::from(2);
    }
    println!("report: {}", folder.join("report.html").display());
    if outcomes.iter().any(Outcome::fails) { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

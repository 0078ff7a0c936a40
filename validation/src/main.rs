//! Runs the validation cases and prints the verdict. Arguments: ids of the cases to run; none: all.

use std::process::ExitCode;
use trilith_validation::{cases, report, run_all};

fn main() -> ExitCode {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let mut chosen = cases::all();
    if let Some(unknown) = wanted.iter().find(|w| !chosen.iter().any(|c| c.id == w.as_str())) {
        eprintln!("there is no case `{unknown}`");
        return ExitCode::from(2);
    }
    chosen.retain(|c| wanted.is_empty() || wanted.iter().any(|w| w == c.id));
    let rows = run_all(&chosen);
    print!("{}", report::text(&chosen, &rows));
    let folder = report::folder();
    if let Err(error) = report::write(&folder, &chosen, &rows) {
        eprintln!("the report cannot be written to {}: {error}", folder.display());
        return ExitCode::from(2);
    }
    println!("report: {}", folder.join("REPORT.md").display());
    if rows.iter().all(|r| r.pass) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

//! Random structures under the program against an independent oracle; see `trilith_validation::oracle`.
//!
//! ```text
//! fuzz [--count N] [--seed S] [--solver NAME]… [--seconds T] [--work W] [--shrink TRIALS] [--keep N] [--show] [--tolerance T] [--trace OUTPUT] [--aloud] [--estimates]
//! ```

use std::process::ExitCode;
use std::time::Duration;
use trilith::SolverKind;
use trilith_validation::oracle::campaign::{Campaign, say};
use trilith_validation::oracle::generate::generate;
use trilith_validation::oracle::judge::{Pair, WORK, judge_and_compare, reference_of_a_part};
use trilith_validation::oracle::spec::Spec;
use trilith_validation::oracle::subject::{Ended, run};
use trilith_validation::oracle::text::text;
use trilith_validation::oracle::truth::Truth;
use trilith_validation::report;

struct Wanted {
    campaign: Campaign,
    shrink: usize,
    keep: usize,
    show: bool,
    trace: Option<usize>,
    estimates: bool,
    tolerance: Option<f64>,
}

fn arguments() -> Result<Wanted, String> {
    let budget = Duration::from_secs(3600);
    let campaign =
        Campaign { seed: 1, count: 200, solvers: Vec::new(), work: WORK, budget, aloud: false };
    let mut it = Wanted {
        campaign,
        shrink: 0,
        keep: 50,
        show: false,
        trace: None,
        estimates: false,
        tolerance: None,
    };
    let mut given = std::env::args().skip(1);
    while let Some(name) = given.next() {
        match name.as_str() {
            "--show" => it.show = true,
            "--aloud" => it.campaign.aloud = true,
            "--estimates" => it.estimates = true,
            _ => {}
        }
        if matches!(name.as_str(), "--show" | "--aloud" | "--estimates") {
            continue;
        }
        let value = given.next().ok_or_else(|| format!("`{name}` needs a value"))?;
        let number = || value.parse::<u64>().map_err(|_| format!("`{value}` is no whole number"));
        let real = || value.parse::<f64>().map_err(|_| format!("`{value}` is no number"));
        match name.as_str() {
            "--count" => it.campaign.count = number()? as usize,
            "--seed" => it.campaign.seed = number()?,
            "--seconds" => it.campaign.budget = Duration::from_secs(number()?),
            "--shrink" => it.shrink = number()? as usize,
            "--trace" => it.trace = Some(number()? as usize),
            "--tolerance" => it.tolerance = Some(real()?),
            "--work" => it.campaign.work = real()?,
            "--keep" => it.keep = number()? as usize,
            "--solver" => {
                let known = SolverKind::ALL.into_iter().find(|s| s.name() == value);
                it.campaign.solvers.push(known.ok_or_else(|| format!("no solver `{value}`"))?);
            }
            _ => return Err(format!("unknown argument `{name}`")),
        }
    }
    if it.campaign.solvers.is_empty() {
        it.campaign.solvers = SolverKind::ALL.to_vec();
    }
    Ok(it)
}

/// Both histories of an output side by side.
fn trace(spec: &Spec, truth: &Truth, solver: SolverKind, output: usize) {
    let Ended::Shown(shown) = run(&text(spec), solver) else { return };
    println!("// t, oracle, {}", solver.name());
    for (t, row) in shown.time.iter().zip(&shown.values) {
        println!("// {t:.6e} {:14.6e} {:14.6e}", truth.course.at(output, *t), row[output]);
    }
}

fn main() -> ExitCode {
    let wanted = match arguments() {
        Ok(wanted) => wanted,
        Err(message) => {
            eprintln!("{message}");
            return ExitCode::from(2);
        }
    };
    if wanted.show || wanted.trace.is_some() {
        let mut spec = generate(wanted.campaign.seed);
        spec.tolerance = wanted.tolerance.or(spec.tolerance);
        let truth = reference_of_a_part(&mut spec, wanted.campaign.work);
        print!("{}", text(&spec));
        match truth {
            Ok(truth) => {
                println!(
                    "// size {:?}\n// scale {:?}\n// moves {:?}, {} steps",
                    truth.size, truth.scale, truth.moves, truth.course.steps
                );
                for solver in &wanted.campaign.solvers {
                    let (verdict, pairs) = judge_and_compare(&spec, &truth, *solver);
                    println!("// {}: {}", solver.name(), say(&spec, &verdict));
                    for Pair { output, off, said: [reduction, step] } in pairs {
                        println!("// o{output}: off {off:.2e}, said {reduction:.1e} + {step:.1e}");
                    }
                    if let Some(output) = wanted.trace {
                        trace(&spec, &truth, *solver, output);
                    }
                }
            }
            Err(skip) => println!("// {skip:?}"),
        }
        return ExitCode::SUCCESS;
    }
    let result = wanted.campaign.run();
    let folder = report::folder().join("fuzz");
    if let Err(error) = result.write(&folder, wanted.shrink, wanted.keep) {
        eprintln!("failures cannot be written to {}: {error}", folder.display());
    }
    if wanted.estimates {
        println!("seed,family,solver,output,off,reduction,step");
        for f in &result.runs {
            for Pair { output, off, said: [reduction, step] } in &f.pairs {
                let (seed, family, solver) = (f.seed, f.family, f.solver.name());
                println!("{seed},{family},{solver},{output},{off:e},{reduction:e},{step:e}");
            }
        }
    }
    print!("{}{}", result.summary(), result.certificates());
    println!("failures: {}", folder.display());
    if result.failures().is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

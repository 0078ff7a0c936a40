//! `trilith compare`: one case under several solvers.

use crate::args::CompareArguments;
use crate::progress::Progress;
use crate::report::{energies, work};
use crate::text::{number, percent, row, table};
use crate::{Answer, Failure, case, diagnostics, read};
use trilith::results::{Peak, Summary};
use trilith::{Analysis, Registry, RunOptions};

pub(crate) fn compare(registry: &Registry, args: &CompareArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    let case = case(&model, args.case.as_deref())?;
    if args.solvers.len() < 2 {
        let help = "such as `--solvers hht,fna`";
        return Err(Failure::input("a comparison needs two solvers", Some(help)));
    }
    if matches!(model.cases[case].analysis, trilith::model::Analysis::Static(_)) {
        let message =
            format!("case \"{}\" is static: there is one solver for it", model.cases[case].name);
        return Err(Failure::input(&message, Some("name a dynamic case with `--case`")));
    }
    let analysis = Analysis::new(&model).map_err(|e| Failure::of(&e, &model))?;
    let (mut summaries, mut status) = (Vec::new(), 0);
    for solver in &args.solvers {
        let mut bar = Progress::new(solver.name());
        let mut show = |share| bar.show(share);
        let options = RunOptions {
            case,
            solver: Some(*solver),
            dt: args.dt,
            progress: Some(&mut show),
            ..RunOptions::default()
        };
        let run = analysis.run(options).map_err(|e| Failure::of(&e, &model))?;
        drop(bar);
        if !run.result.status.is_good() {
            let message = format!("{}: {}", solver.name(), run.result.status.text());
            eprint!("{}", diagnostics::plain(&message, None));
            status = 1;
        }
        for w in &run.result.warnings {
            eprint!("{}", diagnostics::warning(&format!("{}: {w}", solver.name())));
        }
        summaries.push(run.summary(&model));
    }
    let head = format!("model  {}\ncase   {}\n", model.title, model.cases[case].name);
    Ok(Answer { text: head + &text(&summaries), status })
}

fn text(summaries: &[Summary]) -> String {
    let mut out = format!("\npeaks; differences relative to {}\n", summaries[0].solver);
    out += &table(&peaks(summaries), &[0, 1]);
    let names = || summaries.iter().map(|s| s.solver.to_owned());
    let mut rows = vec![std::iter::once("energy [J]".to_owned()).chain(names()).collect()];
    for (i, (name, _)) in energies(&summaries[0].energy).iter().enumerate() {
        let values: Vec<f64> = summaries.iter().map(|s| energies(&s.energy)[i].1).collect();
        if values.iter().any(|e| *e != 0.0) {
            let cells = values.into_iter().map(number);
            rows.push(std::iter::once((*name).to_owned()).chain(cells).collect());
        }
    }
    out += &format!("\n{}\n", table(&rows, &[0]));
    for s in summaries {
        out += &format!("{} ({}): {}\n", s.solver, s.status, work(&s.work));
        if let Some(worst) = s.basis.as_ref().and_then(|b| b.worst.as_ref()) {
            out += &format!(
                "  the basis holds {} of the flexibility of {}, the worst link coordinate\n",
                percent(worst.share),
                worst.coordinate
            );
        }
    }
    out
}

fn peaks(summaries: &[Summary]) -> Vec<Vec<String>> {
    let mut head = row(["output", "unit"]);
    for (i, s) in summaries.iter().enumerate() {
        head.push(format!("{} max", s.solver));
        head.extend((i > 0).then(|| "diff".to_owned()));
        head.push(format!("{} min", s.solver));
        head.extend((i > 0).then(|| "diff".to_owned()));
    }
    let mut rows = vec![head];
    for (name, first) in &summaries[0].outputs.0 {
        let mut cells = row([name, &first.unit]);
        for (i, s) in summaries.iter().enumerate() {
            let peak = s.outputs.get(name).and_then(|o| o.peak);
            for value in [|p: &Peak| p.max, |p: &Peak| p.min] {
                cells.push(peak.as_ref().map_or("–".into(), |p| number(value(p))));
                if i > 0 {
                    cells.push(difference(first.peak.as_ref(), peak.as_ref(), value));
                }
            }
        }
        rows.push(cells);
    }
    rows
}

/// Difference of an extreme relative to the larger magnitude of the first solver's extremes.
fn difference(first: Option<&Peak>, other: Option<&Peak>, value: fn(&Peak) -> f64) -> String {
    match (first, other) {
        (Some(a), Some(b)) if value(a) == value(b) => "0".into(),
        (Some(a), Some(b)) if a.magnitude() > 0.0 => {
            format!("{:+.2} %", 100.0 * (value(b) - value(a)) / a.magnitude())
        }
        _ => "–".into(),
    }
}

//! `trilith compare`: one case in several ways, and why the results differ.

use crate::args::CompareArguments;
use crate::interrupt::{Ear, INTERRUPTED};
use crate::report::{energies, work};
use crate::text::{number, percent, row, significant, table};
use crate::{
    Answer, Failure, browser, case, compare_page, diagnostics, output, place, read, solver,
};
use std::io::IsTerminal;
use std::path::Path;
use std::sync::atomic::Ordering;
use trilith::compare::{Compared, Comparison, Difference, Variant};
use trilith::model::{Analysis, visible_line};
use trilith::results::{Folder, Peak, Writer};
use trilith::{Model, Registry, SolverKind};

const PAGE: &str = "compare.html";

pub(crate) fn compare(registry: &Registry, args: &CompareArguments) -> Result<Answer, Failure> {
    let mut model = read(registry, &args.model)?;
    let case = case(&model, args.case.as_deref())?;
    if args.peer.peer.is_some() {
        return crate::peer::compare(&mut model, case, args);
    }
    let variants = variants(&model, case, args)?;
    // Looked at before the runs: nothing that was computed is lost for want of a place.
    let folder = args.out.as_ref().map(|dir| open(dir, &model)).transpose()?;
    let (result, interrupted) = {
        // Failures are shown in the text of the model, which is on loan.
        let on_terminal = std::io::stderr().is_terminal();
        let announce = |what: &str| {
            if on_terminal {
                output::tell(&format!("running {}\n", visible_line(what)));
            }
        };
        let ear = Ear::open("the comparison ends, and what its finished runs found is shown");
        let mut comparison = Comparison::new(&mut model, case, announce).until(ear.flag());
        (comparison.run(&variants, !args.no_cause), ear.flag().load(Ordering::Relaxed))
    };
    let all = result.map_err(|e| Failure::of(&e, &model))?;
    let mut status = 0;
    if interrupted {
        let (done, wanted) = (all.len(), variants.len());
        let message = match done {
            0 => format!("interrupted before the first of {wanted} runs came to its end"),
            _ => format!("interrupted: {done} of {wanted} runs came to their end"),
        };
        output::tell(&diagnostics::plain(&message, None));
        if done == 0 {
            return Ok(Answer { text: String::new(), status: INTERRUPTED });
        }
        status = INTERRUPTED;
    }
    for c in &all {
        if !c.outcome.good {
            let message = format!("{}: {}", c.variant, c.outcome.summary.message);
            output::tell(&diagnostics::plain(&message, None));
            status = status.max(1);
        }
        for w in &c.outcome.summary.warnings {
            output::tell(&diagnostics::warning(&format!("{}: {w}", c.variant)));
        }
    }
    let [title, name] = [&model.title, &model.cases[case].name].map(|text| visible_line(text));
    let head = format!("model  {title}\ncase   {name}\n");
    let mut text = head + &self::text(&all);
    text += &geometry(&model, &all).map_or(String::new(), |g| format!("\n{g}\n"));
    if let Some(folder) = folder {
        let page = compare_page::page(&model, &model.cases[case].name, &all);
        for path in place::write(folder, &[(PAGE.into(), page)])? {
            text += &format!("\npage: {path}\n");
            browser::show(args.open, Path::new(&path));
        }
    }
    Ok(Answer { text, status })
}

/// Takes the folder of the page.
fn open(dir: &Path, model: &Model) -> Result<Folder, Failure> {
    let inputs = model.inputs();
    let writer = Writer { name: "compare", own: &[PAGE], writes: vec![PAGE.into()], inputs };
    place::open(dir, writer)
}

/// Every combination of what the command line lists, the first in each list before the others.
fn variants(model: &Model, case: usize, args: &CompareArguments) -> Result<Vec<Variant>, Failure> {
    let Analysis::Dynamic(dynamic) = &model.cases[case].analysis else {
        let message =
            format!("case \"{}\" is static: there is one solver for it", model.cases[case].name);
        return Err(Failure::input(&message, Some("name a dynamic case with `--case`")));
    };
    let lists = !(args.dts.is_empty()
        && args.vectors.is_empty()
        && args.dummies.is_empty()
        && args.alphas.is_empty());
    let solvers = match &args.solvers[..] {
        [] if lists => vec![dynamic.solution.solver],
        [] => vec![SolverKind::Hht, SolverKind::Fna],
        given => given.iter().map(|name| solver(model, case, name)).collect::<Result<_, _>>()?,
    };
    fn options<T: Copy>(list: &[T]) -> Vec<Option<T>> {
        if list.is_empty() { vec![None] } else { list.iter().copied().map(Some).collect() }
    }
    let dts = match args.dt {
        Some(dt) => vec![Some(dt)],
        None => options(&args.dts),
    };
    let mut all: Vec<Variant> = Vec::new();
    for solver in solvers {
        let plain = Variant::new(solver);
        let reduced = plain.is_reduced();
        let conserves = solver == SolverKind::Fna;
        // A list says nothing to a solver that has no such setting.
        let vectors = options(if reduced { &args.vectors } else { &[] });
        let dummies = options(if reduced { &args.dummies } else { &[] });
        let alphas = options(if conserves { &[] } else { &args.alphas });
        for dt in &dts {
            for vectors in &vectors {
                for dummies in &dummies {
                    for alpha in &alphas {
                        let (dt, vectors, dummies, alpha) = (*dt, *vectors, *dummies, *alpha);
                        all.push(Variant { dt, vectors, dummies, alpha, ..plain.clone() });
                    }
                }
            }
        }
    }
    if all.len() < 2 {
        let help = "such as `--solvers hht,fna`, `--dts 0.01,0.005`, `--vectors 10,20` or `--dummies 0.001,0.1`";
        return Err(Failure::input(
            "a comparison needs two solvers, or two values of a setting",
            Some(help),
        ));
    }
    Ok(all)
}

pub(crate) fn text(all: &[Compared]) -> String {
    let first = &all[0];
    let mut out = format!("\npeaks; differences relative to {}\n", first.variant);
    out += &table(&peaks(all), &[0, 1]);
    let names = || all.iter().map(|c| c.variant.to_string());
    let mut rows = vec![std::iter::once("energy [J]".to_owned()).chain(names()).collect()];
    for (i, (name, _)) in energies(&first.outcome.summary.energy).iter().enumerate() {
        let shown = |c: &Compared| {
            let energy = &c.outcome.summary.energy;
            let e = energies(energy)[i].1;
            // Rounding of the largest says nothing.
            if energy.balance().is_rounding(e) { 0.0 } else { e }
        };
        let values: Vec<f64> = all.iter().map(shown).collect();
        if values.iter().any(|e| *e != 0.0) {
            let cells = values.into_iter().map(number);
            rows.push(std::iter::once((*name).to_owned()).chain(cells).collect());
        }
    }
    out += &format!("\n{}\n", table(&rows, &[0]));
    for c in all {
        let s = &c.outcome.summary;
        out += &format!("{} ({}): {}\n", c.variant, s.status, work(&s.work));
        if let Some(worst) = s.basis.as_ref().and_then(|b| b.worst.as_ref()) {
            out += &format!(
                "  the basis holds {} of the flexibility of {}, the worst link coordinate\n",
                percent(worst.share),
                visible_line(&worst.coordinate)
            );
        }
    }
    for c in &all[1..] {
        out += &format!("\n{}\n{}", answer(first, c), table(&differences(c), &[0]));
        if let Some(finding) = &c.finding {
            out += &format!("  likely cause: {}\n", visible_line(&finding.to_string()));
        }
    }
    out
}

/// How far a variant is from the first, and what it costs beside it, in one sentence.
pub(crate) fn answer(first: &Compared, c: &Compared) -> String {
    // What is no number is beyond all that are.
    let largest = |of: fn(&Difference) -> f64| {
        c.differences.iter().max_by(|a, b| of(a).abs().total_cmp(&of(b).abs()))
    };
    let apart = match (largest(|d| d.peak), largest(|d| d.rms)) {
        (Some(peak), Some(rms)) => format!(
            "peaks within {} % ({}), histories within {} % rms ({})",
            significant(100.0 * peak.peak.abs(), 2),
            visible_line(&peak.name),
            significant(100.0 * rms.rms, 2),
            visible_line(&rms.name)
        ),
        _ => "no output to compare".into(),
    };
    let [own, other] = [c, first].map(|c| c.outcome.summary.work.march_cpu_s);
    let cost = if own > 0.0 && other > 0.0 {
        format!("; {} × the CPU of its march", significant(own / other, 2))
    } else {
        String::new()
    };
    let [own, other] = [c, first].map(|c| match c.outcome.summary.status {
        "converged" => c.variant.to_string(),
        status => format!("{} ({status})", c.variant),
    });
    format!("{own} beside {other}: {apart}{cost}.")
}

/// Differences over time, a row for each output.
pub(crate) fn differences(c: &Compared) -> Vec<Vec<String>> {
    let mut rows = vec![row(["output", "peak", "rms of difference", "later by [s]", "final"])];
    for d in &c.differences {
        let signed = |x: f64| if x == 0.0 { "0".into() } else { format!("{:+.3} %", 100.0 * x) };
        let (peak, rms, last) = (signed(d.peak), percent(d.rms), signed(d.residual));
        rows.push(row([&d.name, &peak, &rms, &significant(d.lag, 3), &last]));
    }
    rows
}

/// What all variants have in common and none of them can show: small rotations of bodies on contacts.
fn geometry(model: &Model, all: &[Compared]) -> Option<String> {
    /// Rotation whose neglect makes rocking periods wrong by about 2 % for a slender block, rad.
    const LARGE: f64 = 0.01;
    let contacts = model.elements.iter().any(|e| e.kind == "NLink");
    let rotation = all.iter().fold(0.0_f64, |a, c| a.max(c.outcome.rotation));
    (contacts && rotation > LARGE).then(|| {
        format!(
            "geometry: nodes tilt by up to {} rad, and every variant takes rotations as small; a `RockingBody` does not",
            number(rotation)
        )
    })
}

fn peaks(all: &[Compared]) -> Vec<Vec<String>> {
    let mut head = row(["output", "unit"]);
    for (i, c) in all.iter().enumerate() {
        head.push(format!("{} max", c.variant));
        head.extend((i > 0).then(|| "diff".to_owned()));
        head.push(format!("{} min", c.variant));
        head.extend((i > 0).then(|| "diff".to_owned()));
    }
    let mut rows = vec![head];
    for (name, first) in &all[0].outcome.summary.outputs.0 {
        let mut cells = row([name, &first.unit]);
        for (i, c) in all.iter().enumerate() {
            let peak = c.outcome.summary.outputs.get(name).and_then(|o| o.peak);
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

/// A magnitude in SI below which there is nothing to compare with; a length of this is far less than an atom.
pub(crate) const NOTHING: f64 = 1e-12;

/// Difference of an extreme relative to the larger magnitude of the first solver's extremes.
pub(crate) fn difference(
    first: Option<&Peak>,
    other: Option<&Peak>,
    value: fn(&Peak) -> f64,
) -> String {
    match (first, other) {
        (Some(a), Some(b)) if value(a) == value(b) => "0".into(),
        (Some(a), Some(b)) if a.magnitude() > NOTHING => {
            format!("{:+.2} %", 100.0 * (value(b) - value(a)) / a.magnitude())
        }
        _ => "–".into(),
    }
}

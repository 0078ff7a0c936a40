//! `trilith modes`.

pub(crate) mod linked;

use crate::args::ModesArguments;
use crate::text::{number, percent, row, table};
use crate::{Answer, Failure, case, read};
use std::f64::consts::TAU;
use trilith::model::visible_line;
use trilith::solvers::BasisReport;
use trilith::{Analysis, Registry};

pub(crate) fn modes(registry: &Registry, args: &ModesArguments) -> Result<Answer, Failure> {
    let model = read(registry, &args.model)?;
    let chosen = args.case.as_deref().map(|c| case(&model, Some(c))).transpose()?;
    if let Some(links) = args.links {
        return linked::modes(&model, args, links, chosen);
    }
    let report =
        Analysis::new(&model).and_then(|a| a.modes(chosen)).map_err(|e| Failure::of(&e, &model))?;
    Ok(format!("{}\n\n{}", visible_line(&model.title), text(&report)).into())
}

pub(crate) fn text(report: &BasisReport) -> String {
    let mut out = String::from("modes of the structure without links; mass cumulative\n");
    let mut rows = vec![row(["mode", "period [s]", "frequency [Hz]", "X", "Y", "Z"])];
    let mut sum = [0.0; 3];
    for (i, omega) in report.omega.iter().enumerate() {
        if let Some(share) = report.mass_participation.get(i) {
            sum.iter_mut().zip(share).for_each(|(s, x)| *s += x);
        }
        let period = if *omega > 0.0 { number(TAU / omega) } else { "∞ (free)".into() };
        let [x, y, z] = sum.map(percent);
        rows.push(row([&(i + 1).to_string(), &period, &number(omega / TAU), &x, &y, &z]));
    }
    out += &table(&rows, &[]);
    let free = report.omega.iter().filter(|omega| **omega <= 0.0).count();
    if free > 0 && !report.adequacy.is_empty() {
        out += &format!(
            "  {free} of {} modes are free: links hold what moves in them, and count without stiffness here.\n  \
             With them: `--links engaged`, `tangent` or `secant`.\n",
            report.omega.len()
        );
    }
    if report.static_shapes > 0 {
        out += &format!("  static shapes of places without mass: {}\n", report.static_shapes);
    }
    if !report.static_participation.is_empty() {
        let shares = report.static_participation.iter();
        let rows: Vec<_> = shares.map(|(name, s)| row([name, &percent(*s)])).collect();
        out += &format!("\nstatic participation of the loads\n{}", table(&rows, &[0]));
    }
    if !report.adequacy.is_empty() {
        let shares = report.adequacy.iter();
        let rows: Vec<_> = shares.map(|a| row([&a.coordinate, &percent(a.share)])).collect();
        out += &format!(
            "\nflexibility of each link coordinate that the basis holds\n{}",
            table(&rows, &[0])
        );
    }
    out
}

//! `trilith modes --links …`: modes with links, and peaks under a response spectrum.

use crate::args::{Combination, DirectionRule, LinksAs, ModesArguments};
use crate::names::flat;
use crate::text::{names_help, number, percent, row, table};
use crate::{Answer, Failure, case, design_spectrum};
use std::f64::consts::TAU;
use trilith::model::file::fits;
use trilith::model::{Body, visible_line};
use trilith::solvers::{
    CombineDirections, CombineModes, LinearModes, Linearised, LinkStiffness, Secant,
    SpectrumRequest,
};
use trilith::{Analysis, Error, Model};

/// Shares of damping above which a mode's shape is no longer that of the undamped structure.
const HEAVY: f64 = 0.3;
/// Mass along an excited direction that the modes should hold \[EN 1998-1:2004, 4.3.3.3.1\].
const ENOUGH: f64 = 0.9;

pub(super) fn modes(
    model: &Model,
    args: &ModesArguments,
    links: LinksAs,
    chosen: Option<usize>,
) -> Result<Answer, Failure> {
    if links != LinksAs::Secant && args.amplitude.is_some() {
        return Err(Failure::input(
            "`--amplitude` is that of cycles, which links are led through by `--links secant` alone",
            None,
        ));
    }
    if matches!(links, LinksAs::Open | LinksAs::Engaged) && args.after.is_some() {
        return Err(Failure::input(
            "`--after` names a state of the links, which counts for `--links tangent` and `secant`",
            None,
        ));
    }
    let failed = |e: Error| Failure::of(&e, model);
    let analysis = Analysis::new(model).map_err(failed)?;
    let after = match args.after.as_deref() {
        Some("rest") if model.case("rest").is_none() => None,
        Some(name) => Some(case(model, Some(name))?),
        None => analysis.links_begin_after(chosen),
    };
    let stiffness = match (links, args.amplitude) {
        (LinksAs::Open, _) => LinkStiffness::Open,
        (LinksAs::Engaged, _) => LinkStiffness::Engaged,
        (LinksAs::Tangent, _) => LinkStiffness::Tangent,
        (LinksAs::Secant, displacement) => LinkStiffness::Secant {
            displacement: displacement.unwrap_or_default(),
            of: of(model, args)?,
        },
    };
    let linear = analysis.linearised(&stiffness, after).map_err(failed)?;
    let modes = linear.modes(args.count).map_err(|e| failed(e.into()))?;
    let state = match after {
        Some(case) => format!("after \"{}\"", model.cases[case].name),
        None => "at rest".into(),
    };
    let head = match &stiffness {
        LinkStiffness::Open => "with open links".into(),
        LinkStiffness::Engaged => "with engaged links".into(),
        LinkStiffness::Tangent => format!("with links by their tangents {state}"),
        LinkStiffness::Secant { displacement, .. } => {
            format!("with links by secants of cycles of {} m {state}", number(*displacement))
        }
    };
    let title = visible_line(&model.title);
    let mut out = format!("{title}\n\nmodes {head}; mass cumulative\n{}", told(&linear, &modes));
    if links == LinksAs::Secant {
        out += &secants(model, &linear.secants);
    }
    for element in &linear.unsymmetric {
        let name = &model.elements[*element].name;
        out += &format!("  \"{name}\" slips there: the symmetric part of its tangent counts\n");
    }
    if let Some(text) = &args.spectrum {
        out += &peaks(model, args, &linear, &modes, text)?;
    }
    Ok(out.into())
}

/// Elements that are led through cycles.
fn of(model: &Model, args: &ModesArguments) -> Result<Option<Vec<usize>>, Failure> {
    if args.of.is_empty() {
        return Ok(None);
    }
    let links = || {
        let all = model.elements.iter().enumerate();
        all.filter(|(_, e)| matches!(e.body, Body::Link(..)))
    };
    let mut all = Vec::new();
    for name in flat(&args.of) {
        let found: Vec<usize> =
            links().filter(|(_, e)| fits(&name, &e.name)).map(|(i, _)| i).collect();
        if found.is_empty() {
            let help = names_help(&name, "links", links().map(|(_, e)| e.name.as_str()));
            return Err(Failure::input(&format!("there is no link \"{name}\""), Some(&help)));
        }
        all.extend(found);
    }
    Ok(Some(all))
}

/// Periods, mass and damping of modes with links.
pub(crate) fn told(linear: &Linearised<'_>, modes: &LinearModes) -> String {
    let cycled = !linear.secants.is_empty();
    let mut head = row(["mode", "period [s]", "frequency [Hz]", "X", "Y", "Z"]);
    head.extend(cycled.then(|| "damping of links".to_owned()));
    let mut rows = vec![head];
    let mut sum = [0.0; 3];
    for (i, omega2) in modes.omega2.iter().enumerate() {
        sum.iter_mut().zip(modes.mass_share[i]).for_each(|(s, x)| *s += x);
        let (period, frequency) = match *omega2 {
            w if w > 0.0 => (number(TAU / w.sqrt()), number(w.sqrt() / TAU)),
            0.0 => ("∞ (free)".into(), "0".into()),
            _ => ("unstable".into(), "–".into()),
        };
        let [x, y, z] = sum.map(percent);
        let mut cells = row([&(i + 1).to_string(), &period, &frequency, &x, &y, &z]);
        cells.extend(cycled.then(|| percent(modes.damping[i])));
        rows.push(cells);
    }
    let mut out = table(&rows, &[]);
    if let Some(most) = modes.damping.iter().copied().reduce(f64::max).filter(|x| *x > HEAVY) {
        out += &format!(
            "  damping of {}: so much is no longer that of modes of their own; compare with a run\n",
            percent(most)
        );
    }
    out
}

/// Cycles of links that came out alike in one line.
fn secants(model: &Model, secants: &[Secant]) -> String {
    if secants.is_empty() {
        return "  no link is led: none has a shear axis U2 or U3; name others with `--of`\n"
            .into();
    }
    let mut groups: Vec<(Vec<String>, &str, usize)> = Vec::new();
    for s in secants {
        let period = s.period.map_or("–".into(), number);
        let damping = s.damping.map_or("–".into(), percent);
        let heat = number(s.heat);
        let cells = vec![s.coordinate.clone(), number(s.stiffness), heat, damping, period];
        match groups.iter_mut().find(|(of, ..)| *of == cells) {
            Some((_, _, count)) => *count += 1,
            None => groups.push((cells, &model.elements[s.element].name, 1)),
        }
    }
    let mut rows = vec![row(["link", "", "secant [N/m]", "work [J]", "damping", "led at [s]"])];
    for (cells, first, count) in groups {
        let name = match count {
            1 => first.to_owned(),
            _ => format!("{first} and {} more", count - 1),
        };
        rows.push([vec![name], cells].concat());
    }
    format!("\ncycles of links\n{}", table(&rows, &[0, 1]))
}

fn peaks(
    model: &Model,
    args: &ModesArguments,
    linear: &Linearised<'_>,
    modes: &LinearModes,
    text: &str,
) -> Result<String, Failure> {
    let spectrum = design_spectrum::read(text)?;
    let request = SpectrumRequest {
        acceleration: &|period, damping| spectrum.acceleration(period, damping),
        range: spectrum.range(),
        along: args.along,
        damping: args.damping,
        modes: match args.combine {
            Combination::Cqc => CombineModes::Cqc,
            Combination::Srss => CombineModes::Srss,
        },
        directions: match args.directions {
            DirectionRule::Srss => CombineDirections::Srss,
            DirectionRule::Thirty => CombineDirections::Thirty,
        },
    };
    let found = linear.spectrum(modes, &request).map_err(|e| Failure::of(&e.into(), model))?;
    let mut rows = vec![row(["output", "X", "Y", "Z", "peak", "unit"])];
    let mut without = Vec::new();
    for (output, peak) in model.outputs.iter().zip(found).filter(|(o, _)| !o.hidden) {
        match peak {
            Some(p) => {
                let [x, y, z] = p.along.map(number);
                rows.push(row([&output.name, &x, &y, &z, &number(p.peak), &output.unit]));
            }
            None => without.push(format!("\"{}\"", output.name)),
        }
    }
    let rule = match args.combine {
        Combination::Cqc => "CQC",
        Combination::Srss => "SRSS",
    };
    let mut out = format!(
        "\npeaks under {}, modes by {rule}, {} of damping beside that of links\n{}",
        visible_line(text),
        percent(args.damping),
        table(&rows, &[0, 5])
    );
    if !without.is_empty() {
        out += &format!("  no peak of modes: {}\n", without.join(", "));
    }
    let loose = modes.omega2.iter().filter(|w| **w <= 0.0).count();
    if loose > 0 {
        out += &format!(
            "  {loose} of the modes have no stiffness, and a spectrum says nothing of them: they are left out of the peaks\n"
        );
    }
    let moved = |axis: &usize| args.along[*axis] > 0.0 && modes.mass[*axis] > 0.0;
    for (axis, name) in ["X", "Y", "Z"].iter().enumerate().filter(|(axis, _)| moved(axis)) {
        let held: f64 = modes.mass_share.iter().map(|share| share[axis]).sum();
        if held < ENOUGH && modes.omega2.len() == args.count {
            out += &format!(
                "  the modes hold {} of the mass along {name}: take more of them, `--count {}`\n",
                percent(held),
                4 * args.count
            );
        }
    }
    Ok(out)
}

//! A run as text.

use crate::text::{number, percent, row, significant, table};
use trilith::Model;
use trilith::model::visible_line;
use trilith::results::Summary;
use trilith::solvers::{EnergyTotals, Work};

/// Kinds of energy with their names; the potential with the sign of its change.
pub(crate) fn energies(e: &EnergyTotals) -> [(&'static str, f64); 13] {
    [
        ("at the start: kinetic", e.start.kinetic),
        ("at the start: strain", e.start.strain),
        ("at the start: stored in links", e.start.link_stored),
        ("input", e.input),
        ("kinetic", e.kinetic),
        ("strain", e.strain),
        ("potential", e.potential),
        ("structural damping", e.modal_damping),
        ("stored in links", e.link_stored),
        ("friction and yielding", e.link_hysteretic),
        ("viscous in links", e.link_viscous),
        ("time rule", e.algorithmic),
        ("unaccounted for", e.error),
    ]
}

/// Share of the largest value of its kind below which one is rounding.
const ROUNDING: f64 = 1e-12;

/// A value of a unit, 0 where it is rounding of the largest of its kind; of one radian.
fn shown(s: &Summary, unit: &str, x: f64) -> String {
    let alike = s.outputs.0.iter().filter(|(_, o)| o.unit == unit).filter_map(|(_, o)| o.peak);
    let own = if unit == "rad" { 1.0 } else { 0.0 };
    let largest = alike.fold(own, |a: f64, p| a.max(p.max.abs()).max(p.min.abs()));
    number(if x.abs() < ROUNDING * largest { 0.0 } else { x })
}

/// What `trilith run` prints.
pub(crate) fn text(model: &Model, s: &Summary) -> String {
    let mut out = String::new();
    for (name, value) in [
        ("model", s.model.title.as_str()),
        ("case", &s.case),
        ("solver", s.solver),
        ("status", s.status),
    ] {
        out += &format!("{name:7} {}\n", visible_line(value));
    }
    let mut rows = vec![row(["output", "unit", "max", "at s", "min", "at s", "final", "±"])];
    for (name, o) in &s.outputs.0 {
        if let Some(p) = &o.peak {
            let [a, c, e] = [p.max, p.min, p.last].map(|x| shown(s, &o.unit, x));
            let [b, d] = [p.t_max, p.t_min].map(number);
            let off = o.error.map(|e| e.total()).filter(|e| e.is_finite());
            let off = off.map_or_else(String::new, |e| significant(e, 2));
            rows.push(row([name, &o.unit, &a, &b, &c, &d, &e, &off]));
        }
    }
    if rows.iter().skip(1).all(|r| r.last().is_none_or(String::is_empty)) {
        rows.iter_mut().for_each(|r| r.truncate(7));
    }
    if rows.len() > 1 {
        out += &format!("\n{}", table(&rows, &[0, 1]));
    } else if model.shown().next().is_some() {
        out += "\n  no outputs were recorded in this case\n";
    }
    out += &spectra(s);
    out += &envelopes(s);
    if let Some(c) = &s.contact {
        out += &format!(
            "\ncontact: {} at first, {} in all{}; uplift ≤ {} m, slip ≤ {} m, {} m at the end\n",
            c.initial_mode,
            c.mode,
            if c.overturned { ", overturned" } else { "" },
            shown(s, "m", c.max_uplift),
            shown(s, "m", c.max_slip),
            shown(s, "m", c.residual_slip)
        );
    }
    out += &structure(s);
    out += &format!("\n{}", energy(s));
    // The limit of the model is on this share, not on that of the input at the end.
    let share = percent(s.energy.error_relative);
    out += &format!("  unaccounted for: {share} of what was put in, released or dissipated\n");
    out + &format!("\nwork: {}\n", work(&s.work))
}

/// What was there and what was put in, and what became of it.
fn energy(s: &Summary) -> String {
    let balance = s.energy.balance();
    // No time passes in a static case: what its loads release is not all taken up.
    let whole = balance.whole().filter(|_| s.solver != "static");
    let mut rows = vec![row(["energy", "J", "of start + input"])];
    for (name, e) in balance.sources.iter().chain(&balance.uses) {
        // Kinds that are nothing but rounding are left out.
        let nothing = balance.is_rounding(*e);
        if !nothing || *name == "input" {
            let e = if nothing { 0.0 } else { *e };
            let share = whole.map_or_else(|| "–".into(), |whole| percent(e / whole));
            rows.push(row([name, &number(e), &share]));
        }
    }
    table(&rows, &[0])
}

/// What a structure did as a whole: base shear, drift, its bearings and stops.
fn structure(s: &Summary) -> String {
    let mut lines = Vec::new();
    if let Some(b) = &s.base_shear {
        let largest = b.max[0].max(b.max[1]);
        let along = ["X", "Y"].into_iter().zip(b.max.into_iter().zip(b.time));
        let moved = along.filter(|(_, (force, _))| *force > ROUNDING * largest);
        let parts = moved.map(|(axis, (force, t))| {
            format!("≤ {} N along {axis} at {} s", number(force), number(t))
        });
        lines.push(format!("base shear: {}", parts.collect::<Vec<_>>().join(", ")));
    }
    if let Some(d) = &s.drift {
        lines.push(format!(
            "drift: ≤ {} m in \"{}\", {} of the {} m between its nodes",
            number(d.max),
            d.output,
            percent(d.ratio),
            number(d.height)
        ));
    }
    if let Some(b) = &s.bearings {
        let place =
            b.farthest.as_ref().map(|name| format!(" in \"{name}\" at {} s", number(b.time)));
        lines.push(format!(
            "bearings: travel ≤ {} m{}, {} m at the end; uplift ≤ {} m",
            shown(s, "m", b.max_travel),
            place.unwrap_or_default(),
            shown(s, "m", b.residual_travel),
            shown(s, "m", b.max_uplift)
        ));
    }
    // A static case hits nothing.
    if let Some(stops) =
        s.stops.as_ref().filter(|stops| stops.hardest.is_some() || s.solver != "static")
    {
        let hardest = stops.hardest.as_ref().map_or_else(String::new, |name| {
            let force = number(stops.largest_force);
            format!("; largest force {force} N in \"{name}\" at {} s", number(stops.time))
        });
        lines.push(format!("stops: {}{hardest}", hits(stops.hits)));
    }
    if lines.is_empty() { String::new() } else { format!("\n{}\n", lines.join("\n")) }
}

/// How often stops were hit.
fn hits(count: usize) -> String {
    match count {
        0 => "no hit".into(),
        1 => "1 hit".into(),
        n => format!("{n} hits"),
    }
}

/// The largest responses of floor spectra.
fn spectra(s: &Summary) -> String {
    let mut rows = vec![row(["spectrum", "damping", "peak m/s²", "period s", "rigid m/s²"])];
    for (name, floor) in &s.spectra.0 {
        for p in &floor.peaks {
            let [sa, period, zpa] = [p.sa, p.period, floor.zpa].map(number);
            rows.push(row([name, &percent(p.damping), &sa, &period, &zpa]));
        }
    }
    if rows.len() > 1 { format!("\n{}", table(&rows, &[0])) } else { String::new() }
}

/// Extremes of forces along members, where there are any.
fn envelopes(s: &Summary) -> String {
    let head =
        ["envelope", "force", "unit", "max", "in", "at m", "at s", "min", "in", "at m", "at s"];
    let mut rows = vec![row(head)];
    for (name, forces) in &s.envelopes.0 {
        for (force, e) in &forces.0 {
            let mut cells = row([name, force, e.unit]);
            for extreme in [&e.max, &e.min] {
                let [value, at, t] = [extreme.value, extreme.at, extreme.t].map(number);
                cells.extend([value, extreme.element.clone(), at, t]);
            }
            rows.push(cells);
        }
    }
    if rows.len() > 1 { format!("\n{}", table(&rows, &[0, 1, 2, 4, 8])) } else { String::new() }
}

/// The work in one line.
pub(crate) fn work(w: &Work) -> String {
    let mut text = format!(
        "{} steps, {} substeps, {} iterations, {} rejected, {} factorizations, {} s wall, {} s setup + {} s march CPU, {} MB",
        w.steps,
        w.substeps,
        w.iterations,
        w.rejected,
        w.factorizations,
        crate::text::significant(w.wall_s, 3),
        crate::text::significant(w.setup_cpu_s, 3),
        crate::text::significant(w.march_cpu_s, 3),
        crate::text::significant(w.peak_rss_mb, 3),
    );
    if w.forced > 0 {
        text += &format!("; {} substeps at the smallest step above the tolerance", w.forced);
    }
    text
}

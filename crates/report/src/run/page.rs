//! The page of a run.

use super::data::{Family, RunData};
use super::units::{number, percent, short, shown};
use super::{drawing, figures, script};
use crate::Figure;
use crate::page::STYLE;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::Value;

const RUN_STYLE: &str = include_str!("run.css");

/// Links to the sections.
const SECTIONS: [(&str, &str); 7] = [
    ("motion", "Model and motion"),
    ("peaks", "Peaks"),
    ("histories", "Time histories"),
    ("energy", "Energy"),
    ("loops", "Hysteresis loops"),
    ("modes", "Mode shapes"),
    ("settings", "Settings and work"),
];

/// The page of a run as one HTML document without network: still figures, and a script of ours that makes
/// them move. `summary` is `summary.json`; a key that is missing leaves its place empty.
#[must_use]
pub fn run_page(summary: &Value, data: &RunData) -> String {
    let title = summary["model"]["title"].as_str().filter(|t| !t.is_empty()).unwrap_or(&data.file);
    let there = |id: &str| match id {
        "motion" => !data.picture.points.is_empty(),
        "histories" => !data.histories.is_empty(),
        "energy" => !data.energies.is_empty(),
        "loops" => !data.loops.is_empty(),
        "modes" => !data.modes.is_empty(),
        _ => true,
    };
    let body = |id: &str| match id {
        "motion" => motion(data),
        "peaks" => peaks(summary, data),
        "histories" => histories(data),
        "energy" => energy(summary, data),
        "loops" => loops(data),
        "modes" => modes(data),
        _ => settings(summary, data),
    };
    let shown: Vec<_> = SECTIONS.iter().filter(|(id, _)| there(id)).collect();
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) " – " (text(&summary["case"])) " – " (text(&summary["solver"])) }
                style { (PreEscaped(STYLE)) (PreEscaped(RUN_STYLE)) }
                link rel="icon" href="data:,";
            }
            body {
                h1 { (title) }
                (facts(summary))
                (warnings(summary, data))
                nav { ol { @for (id, head) in &shown { li { a href={ "#" (id) } { (head) } } } } }
                @for (id, head) in &shown { section id=(id) { h2 { (head) } (body(id)) } }
                script type="application/json" id="data" { (PreEscaped(embedded(data))) }
                script { (PreEscaped(script::text())) }
            }
        }
    }
    .into_string()
}

/// The data as JSON that cannot end its element.
fn embedded(data: &RunData) -> String {
    // Numbers, texts and lists: nothing that JSON does not have.
    serde_json::to_string(data).unwrap_or_default().replace('<', "\\u003c")
}

fn text(value: &Value) -> String {
    value.as_str().map_or_else(|| "–".into(), str::to_owned)
}

fn value(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

fn measured(unit: &str, x: f64) -> String {
    let s = shown(unit, x.abs());
    format!("{} {}", number(x * s.factor), s.unit)
}

fn facts(summary: &Value) -> Markup {
    let status = text(&summary["status"]);
    let good = ["converged", "overturned"].contains(&status.as_str());
    let class = if good { "fact good" } else { "fact bad" };
    let contact = summary.get("contact").filter(|c| c.is_object());
    let fact = |words: &str, what: String| html! { div.fact { span { (words) } b { (what) } } };
    html! {
        div.facts {
            div class=(class) { span { "status" } b { (status) } }
            (fact("case", text(&summary["case"])))
            (fact("solver", text(&summary["solver"])))
            @if let Some(c) = contact {
                (fact("leaves rest by", text(&c["initial_mode"])))
                (fact("response mode", text(&c["mode"])))
                (fact("largest uplift", measured("m", value(&c["max_uplift"]))))
                (fact("largest slip", measured("m", value(&c["max_slip"]))))
                (fact("slip at the end", measured("m", value(&c["residual_slip"]))))
            }
            (fact("energy unaccounted for", percent(value(&summary["energy"]["error_relative"]))))
        }
    }
}

fn warnings(summary: &Value, data: &RunData) -> Markup {
    let mut all: Vec<String> = Vec::new();
    if summary["status"].as_str() != Some("converged") {
        all.extend(summary["message"].as_str().map(str::to_owned));
    }
    let warned = summary["warnings"].as_array().into_iter().flatten();
    all.extend(warned.filter_map(Value::as_str).map(str::to_owned));
    html! {
        @if !all.is_empty() {
            div.warnings role="note" { b { "What to know" } ul { @for w in &all { li { (w) } } } }
        }
        @for note in &data.notes { p.note { (note) } }
    }
}

fn motion(data: &RunData) -> Markup {
    let peak = drawing::largest(data).filter(|_| data.frames.t.len() > 1);
    let n = data.picture.points.len();
    let rest = drawing::svg(data, &[], "The model", true);
    html! {
        div.still {
            (PreEscaped(rest))
            @if let Some((frame, scale)) = peak {
                p.note {
                    "Moved as at " (short(data.frames.t[frame], 5)) " s, "
                    @if scale == 1.0 { "to scale" } @else { (short(scale, 3)) " times as much" }
                    "; at rest in grey."
                }
                (PreEscaped(drawing::svg(
                    data,
                    &(0..n).map(|p| data.frames.at(frame, n, p).map(|u| u * scale)).collect::<Vec<_>>(),
                    "The model as it moves",
                    false,
                )))
            }
        }
        div.stage.live {
            canvas id="stage" tabindex="0" role="img" aria-label="The moving model; the controls below play it" {}
            div.tip hidden {}
        }
        div.controls.live #player data-scale=(peak.map_or(1.0, |p| p.1)) {}
        (key(data))
        @if data.frames.t.len() > 1 {
            p.note { "Displacements are relative to the base. Deformed shapes at " (data.frames.t.len()) " times." }
        }
    }
}

/// What the symbols mean.
fn key(data: &RunData) -> Markup {
    let mut seen: Vec<(Family, String, usize)> = Vec::new();
    for link in data.picture.links.iter().filter(|l| !l.body) {
        match seen.iter_mut().find(|s| s.0 == link.family && s.1 == link.kind) {
            Some(s) => s.2 += 1,
            None => seen.push((link.family, link.kind.clone(), 1)),
        }
    }
    let word = |f: Family| match f {
        Family::Contact => "contact",
        Family::Dashpot => "dashpot",
        Family::Hysteretic => "with memory",
        Family::Spring => "spring",
    };
    html! {
        div.key {
            @for (family, kind, count) in &seen {
                span {
                    svg viewBox="-10 -7 20 14" aria-hidden="true" { (PreEscaped(drawing::symbol(*family, 0.0, 0.0))) }
                    (kind) " (" (word(*family)) ")" @if *count > 1 { " × " (count) }
                }
            }
        }
    }
}

fn peaks(summary: &Value, data: &RunData) -> Markup {
    let outputs = &summary["outputs"];
    let rows = data.outputs.iter().map(|name| (name, &outputs[name]));
    let row = |name: &str, o: &Value| {
        let all = ["max", "min", "final"].map(|k| value(&o[k]));
        let size = all.iter().filter(|x| x.is_finite()).fold(0.0_f64, |a, x| a.max(x.abs()));
        let s = shown(o["unit"].as_str().unwrap_or(""), size);
        // Rounding beside the other values is nothing.
        let [max, min, last] =
            all.map(|x| number(if x.abs() < 1e-9 * size { 0.0 } else { x * s.factor }));
        let [at_max, at_min] = ["t_max", "t_min"].map(|k| number(value(&o[k])));
        html! { tr {
            td { (name) } td { (s.unit) } td.num { (max) } td.num { (at_max) } td.num { (min) } td.num { (at_min) } td.num { (last) }
        } }
    };
    html! {
        p.note { "Over all substeps, not only at output times." }
        div.wide { table {
            thead { tr { th { "output" } th { "unit" } th { "max" } th { "at s" } th { "min" } th { "at s" } th { "final" } } }
            tbody { @for (name, o) in rows { (row(name, o)) } }
        } }
    }
}

/// Names, words and colours of the energies that can be seen, for the script.
fn kinds(data: &RunData) -> String {
    let all: Vec<[String; 3]> = figures::seen(data)
        .into_iter()
        .map(|(h, words, c)| {
            [h.name.clone(), words.to_owned(), format!("#{:02x}{:02x}{:02x}", c.0, c.1, c.2)]
        })
        .collect();
    serde_json::to_string(&all).unwrap_or_default()
}

/// A figure that the script replaces by a live one.
fn figure(id: &str, still: &Figure, caption: &str, kinds: Option<&str>) -> Markup {
    html! {
        figure {
            div.still { (PreEscaped(still.svg())) }
            div.plot.live data-plot=(id) data-kinds=[kinds] {}
            @if !caption.is_empty() { figcaption { (caption) } }
        }
    }
}

fn histories(data: &RunData) -> Markup {
    html! {
        p.note.live {
            "Drag to zoom in time, double-click to see all; arrow keys move the time of all figures and of the model."
        }
        div.figures.board { @for (i, h) in data.histories.iter().enumerate() {
            (figure(&format!("history {i}"), &figures::history(h), "", None))
        } }
    }
}

fn energy(summary: &Value, data: &RunData) -> Markup {
    let e = &summary["energy"];
    let input = value(&e["input"]);
    let largest =
        e.as_object().into_iter().flatten().fold(0.0_f64, |a, (k, x)| {
            if k == "error_relative" { a } else { a.max(value(x).abs()) }
        });
    let rows = [("input", "input")]
        .into_iter()
        .chain(figures::KINDS.iter().map(|(k, w, _)| (*k, *w)))
        .chain([("error", "unaccounted for")]);
    let rows: Vec<_> =
        rows.filter(|(k, _)| *k == "input" || value(&e[*k]).abs() > 1e-12 * largest).collect();
    let s = shown("J", largest);
    let (links, kinds) = (links(summary), kinds(data));
    let in_links = shown("J", links.first().map_or(0.0, |(_, h, v)| h + v));
    html! {
        div.figures.board {
            (figure("energy curves", &figures::energy_curves(data),
                "Friction and yielding is the energy of the links (NLlink), viscous that of their dashpots (Ndamp).", Some(&kinds)))
            (figure("energy stack", &figures::energy_stack(data),
                "Stored and dissipated energies on top of each other; together they are the input. Changes that are negative go downwards.", Some(&kinds)))
        }
        div.two {
            div { table {
                thead { tr { th { "at the end" } th { (s.unit) } th { "of input" } } }
                tbody { @for (k, words) in &rows { tr {
                    td { (words) } td.num { (number(value(&e[*k]) * s.factor)) }
                    td.num { @if input > 0.0 { (percent(value(&e[*k]) / input)) } @else { "–" } }
                } } }
            } }
            @if !links.is_empty() { div { table {
                thead { tr { th { "link" } th { "friction, yielding [" (in_links.unit) "]" } th { "viscous [" (in_links.unit) "]" } } }
                tbody { @for (name, h, v) in &links { tr { td { (name) } td.num { (number(*h * in_links.factor)) } td.num { (number(*v * in_links.factor)) } } } }
            } } }
        }
    }
}

/// The links that dissipate most.
fn links(summary: &Value) -> Vec<(String, f64, f64)> {
    const COUNT: usize = 12;
    let all = summary["link_energy"].as_object().into_iter().flatten();
    let mut all: Vec<_> = all
        .map(|(name, e)| (name.clone(), value(&e["hysteretic"]), value(&e["viscous"])))
        .filter(|(_, h, v)| h + v != 0.0)
        .collect();
    all.sort_by(|a, b| (b.1 + b.2).total_cmp(&(a.1 + a.2)));
    all.truncate(COUNT);
    all
}

fn loops(data: &RunData) -> Markup {
    html! {
        p.note { "Force over deformation; U1, U2 … are the local axes of the link, U1 along it." }
        div.figures.board.loops { @for (i, l) in data.loops.iter().enumerate() {
            (figure(&format!("loop {i}"), &figures::link_loop(l), &format!("{} ({})", l.link, l.kind), None))
        } }
    }
}

fn modes(data: &RunData) -> Markup {
    let n = data.picture.points.len();
    let free = match data.free_modes {
        0 => String::new(),
        1 => " One motion has no stiffness: its mode is not shown.".into(),
        n => format!(" {n} motions have no stiffness: their modes are not shown."),
    };
    html! {
        p.note { "Of the structure without its links." (free) }
        div.figures.board.modes { @for (i, m) in data.modes.iter().enumerate() {
            figure {
                div.still { (PreEscaped(drawing::svg(data, &drawing::mode(data, i, n), &format!("Mode {}", m.number), false))) }
                div.stage.live { canvas data-mode=(i) role="img" aria-label={ "Mode " (m.number) } {} }
                figcaption {
                    b { "Mode " (m.number) ": " (number(m.frequency)) " Hz" } ", " (number(1.0 / m.frequency)) " s"
                    // A structure that floats without its links carries all mass in its free motions.
                    @if m.participation.iter().any(|x| *x > 5e-5) {
                        "; mass X " (percent(m.participation[0])) ", Y " (percent(m.participation[1])) ", Z " (percent(m.participation[2]))
                    }
                }
            }
        } }
    }
}

fn settings(summary: &Value, data: &RunData) -> Markup {
    let w = &summary["work"];
    let count = |k: &str| w[k].as_u64().map_or("–".into(), |n| n.to_string());
    let seconds = |k: &str| format!("{} s", number(value(&w[k])));
    let mut work = vec![
        ("output steps".to_owned(), count("steps")),
        ("substeps".into(), count("substeps")),
        ("iterations of the link equations".into(), count("iterations")),
        ("steps thrown away".into(), count("rejected")),
        ("factorisations".into(), count("factorizations")),
        ("wall time".into(), seconds("wall_s")),
        ("CPU time of set-up".into(), seconds("setup_cpu_s")),
        ("CPU time of the march".into(), seconds("march_cpu_s")),
        ("largest memory".into(), format!("{} MB", number(value(&w["peak_rss_mb"])))),
    ];
    let b = &summary["basis"];
    if b.is_object() {
        let share = |v: &Value| percent(value(v));
        work.push((
            "basis: vectors".into(),
            b["vectors"].as_u64().map_or("–".into(), |n| n.to_string()),
        ));
        let [low, high] = [0, 1].map(|i| number(value(&b["frequency"][i])));
        let band = match high.as_str() {
            "0" => "0 Hz: the body moves freely".into(),
            _ => format!("{low} … {high} Hz"),
        };
        work.push(("basis: frequencies".into(), band));
        let mass: Vec<String> = (0..3).map(|i| share(&b["mass_participation"][i])).collect();
        work.push(("basis: mass X, Y, Z".into(), mass.join(", ")));
        let worst = &b["worst"];
        if worst.is_object() {
            let held = format!("{} of {}", share(&worst["share"]), text(&worst["coordinate"]));
            work.push(("basis: flexibility held, worst link coordinate".into(), held));
        }
    }
    let files = [
        ("program".to_owned(), format!("trilith {}", text(&summary["version"]))),
        ("model file".into(), data.file.clone()),
        ("SHA-256 of it".into(), text(&summary["model"]["sha256"])),
    ];
    html! {
        div.two {
            div { (pairs("input", &files)) (pairs("solution", &data.settings)) }
            div {
                (pairs("work", &work))
                @if !data.overrides.is_empty() { (pairs("set on the command line", &data.overrides)) }
                @if !data.parameters.is_empty() { (pairs("parameter", &data.parameters)) }
            }
        }
    }
}

fn pairs(head: &str, all: &[(String, String)]) -> Markup {
    html! { table {
        thead { tr { th colspan="2" { (head) } } }
        tbody { @for (what, value) in all { tr { td { (what) } td.hash { (value) } } } }
    } }
}

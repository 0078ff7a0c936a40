//! The page of a run.

mod curves;
mod energy;
mod facts;
mod modes;
mod motion;
mod peaks;
mod rounding;
mod settings;
mod shaking;

use super::sections::SECTIONS;
use super::{Frames, Mode, Numbers, Picture, RunData, Sections, Tint, legible, script};
use crate::chart::Scales;
use crate::page::STYLE;
use crate::{Figure, chart};
use base64::prelude::{BASE64_STANDARD, Engine as _};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde::Serialize;
use serde_json::Value;
use std::hash::{DefaultHasher, Hash, Hasher};

const RUN_STYLE: &str = include_str!("../run.css");

/// The page of a run as one HTML document without network: still figures, and a script of ours that makes
/// them move. `summary` is `summary.json`, `made` is `made_by.json`, null where there is none; a key that is missing
/// leaves its place empty.
#[must_use]
pub fn run_page(summary: &Value, data: &RunData, made: &Value) -> String {
    let parts = Parts::of(summary, data, made, &Sections::all(), true);
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (parts.title) }
                style { (PreEscaped(STYLE)) (PreEscaped(RUN_STYLE)) }
                link rel="icon" href="data:,";
            }
            body {
                (parts.shown)
                (chart::script(&script::PARTS))
            }
        }
    }
    .into_string()
}

/// What a page of another run of the same model shows, for `renew` of its script to put in the place of what it shows: no
/// still pictures, no style, no script. Of some sections: these alone, beside the head of the page; `data` need have no more.
#[must_use]
pub fn run_update(summary: &Value, data: &RunData, made: &Value, sections: &Sections) -> String {
    let parts = Parts::of(summary, data, made, sections, false);
    html! { title { (parts.title) } (parts.shown) }.into_string()
}

/// What differs between the pages of two runs.
struct Parts {
    title: String,
    shown: Markup,
}

impl Parts {
    fn of(summary: &Value, data: &RunData, made: &Value, wanted: &Sections, still: bool) -> Self {
        let (summary, made) = (&legible::summary(summary), &legible::summary(made));
        let data = legible::data(data);
        let data: &RunData = &data;
        let title =
            summary["model"]["title"].as_str().filter(|t| !t.is_empty()).unwrap_or(&data.file);
        let there = |id: &str| match id {
            "motion" => !data.picture.points.is_empty(),
            "peaks" => !data.outputs.is_empty(),
            "ground" => !data.ground.is_empty(),
            "floors" => !data.floor_spectra.is_empty(),
            "profiles" => !data.profiles.is_empty(),
            "members" => !data.members.is_empty(),
            "plan" => !data.orbits.is_empty(),
            "histories" => !data.histories.is_empty(),
            "energy" => !data.energies.is_empty(),
            "loops" => !data.loops.is_empty(),
            "modes" => !data.modes.is_empty(),
            _ => true,
        };
        let body = |id: &str| match id {
            "motion" => motion::motion(data, still),
            "peaks" => peaks::peaks(summary, data),
            "ground" => shaking::ground(data, still),
            "floors" => shaking::floors(summary, data, still),
            "profiles" => curves::profiles(data, still),
            "members" => curves::members(data, still),
            "plan" => curves::plan(data, still),
            "histories" => curves::histories(summary, data, still),
            "energy" => energy::energy(summary, data, still),
            "loops" => curves::loops(data, still),
            "modes" => modes::modes(data, still),
            _ => settings::settings(summary, data),
        };
        let sections: Vec<_> =
            SECTIONS.iter().filter(|(id, _)| wanted.have(id) && there(id)).collect();
        let shown = html! {
            main data-model=(identity(data)) {
                h1 { (title) }
                (facts::facts(summary, data))
                // One part, whether there are any or none: another run may take this one's place.
                div { (facts::warnings(summary, data)) }
                @if wanted.are_all() {
                    nav aria-label="Contents" {
                        ol { @for (id, head) in &sections { li { a href={ "#" (id) } { (head) } } } }
                    }
                }
                @for (id, head) in &sections { section id=(id) { h2 { (head) } (body(id)) } }
            }
            @if wanted.are_all() { footer id="made" { (settings::made(summary, data, made)) } }
            (chart::json("", Some("data"), &embedded(data, wanted)))
            @if wanted.have("motion") {
                script type="text/plain" id="shapes" { (PreEscaped(shapes(data))) }
            }
        };
        let [case, solver] = [&summary["case"], &summary["solver"]].map(text);
        Self { title: format!("{title} – {case} – {solver}"), shown }
    }
}

/// What the script draws beside the figures: the times of deformed shapes, the modes; of all sections also the model and
/// what colours it.
fn embedded<'a>(data: &'a RunData, wanted: &Sections) -> impl Serialize + use<'a> {
    #[derive(Serialize)]
    struct Embedded<'a> {
        #[serde(skip_serializing_if = "Option::is_none")]
        picture: Option<&'a Picture>,
        #[serde(skip_serializing_if = "Option::is_none")]
        tints: Option<&'a [Tint]>,
        #[serde(skip_serializing_if = "Option::is_none")]
        frames: Option<Frames>,
        #[serde(skip_serializing_if = "Option::is_none")]
        modes: Option<&'a [Mode]>,
    }
    let frames =
        || Frames { t: data.frames.t.clone(), u: Numbers { n: Vec::new(), ..data.frames.u } };
    let [all, motion, modes] = [wanted.are_all(), wanted.have("motion"), wanted.have("modes")];
    Embedded {
        picture: all.then_some(&data.picture),
        tints: all.then_some(&data.tints),
        frames: motion.then(frames),
        modes: modes.then_some(&data.modes),
    }
}

/// Tells the model of one page from that of another: what only a new page takes.
fn identity(data: &RunData) -> String {
    let mut hasher = DefaultHasher::new();
    // What cannot be written is the same as itself.
    serde_json::to_string(&data.picture).unwrap_or_default().hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

/// The deformed shapes, which are most of the page of a large model: two bytes a number, the low one first, in
/// base 64. Their steps are chosen so that they fit.
fn shapes(data: &RunData) -> String {
    let bytes: Vec<u8> = data
        .frames
        .u
        .n
        .iter()
        .map(|n| i16::try_from(*n).unwrap_or(if *n > 0 { i16::MAX } else { i16::MIN }))
        .flat_map(i16::to_le_bytes)
        .collect();
    BASE64_STANDARD.encode(bytes)
}

fn text(value: &Value) -> String {
    value.as_str().map_or_else(|| "–".into(), str::to_owned)
}

fn value(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// A figure with a sentence beneath.
fn figure(figure: Figure, caption: &str, still: bool) -> Markup {
    figures(&[figure.caption(caption)], still)
}

/// Figures that may have one scale. The histories of a run are short already.
fn figures(all: &[Figure], still: bool) -> Markup {
    if !still {
        return html! { @for f in all { (chart::alive(f, 0.0)) } };
    }
    let scales = Scales::of(all.iter());
    html! { @for f in all { (chart::figure(f, 0.0, &scales)) } }
}

//! Time histories, orbits, profiles over the height, hysteresis loops.

use super::rounding::Outputs;
use super::value;
use super::{figure, figures as drawn};
use crate::Figure;
use crate::run::data::{History, Loop};
use crate::run::{RunData, figures};
use maud::{Markup, html};
use serde_json::Value;

/// So many histories of one kind stand together under a head.
const KIND: usize = 3;
/// A peak to the other side is marked too, where it is this share of the larger one.
const OTHER: f64 = 0.3;

pub(super) fn histories(summary: &Value, data: &RunData, still: bool) -> Markup {
    let outputs = Outputs::of(summary);
    let count = |kind: &str| data.histories.iter().filter(|h| h.kind == kind).count();
    let together = |h: &History| !h.kind.is_empty() && count(&h.kind) >= KIND;
    let mut kinds: Vec<&str> = Vec::new();
    for h in data.histories.iter().filter(|h| together(h)) {
        if !kinds.contains(&h.kind.as_str()) {
            kinds.push(&h.kind);
        }
    }
    let draw = |h: &History| history(&outputs, summary, h);
    let of =
        |kind: &str| data.histories.iter().filter(|h| h.kind == kind).map(draw).collect::<Vec<_>>();
    let alone = || data.histories.iter().filter(|h| !together(h));
    html! {
        p.note.live {
            "Drag or pinch to zoom in time, double-click to see all; arrow keys move the time of all figures and of the model. "
            "Names beneath a figure switch its curves."
        }
        label.scales { input type="checkbox" checked data-scales="kind "; " one scale for all of a kind" }
        @if alone().next().is_some() { div.figures.board { (drawn(&alone().map(draw).collect::<Vec<_>>(), still)) } }
        @for kind in kinds {
            h3 { (kind) }
            div.figures.board.small { (drawn(&of(kind), still)) }
        }
    }
}

/// A history with its peaks, which are those of all substeps; nothing but rounding is a line at zero.
fn history(outputs: &Outputs<'_>, summary: &Value, h: &History) -> Figure {
    if outputs.is_rounding(&h.name) {
        let mut flat = figures::history(h);
        flat.peaks.clear();
        flat.series.iter_mut().flat_map(|s| &mut s.points).for_each(|p| p.1 = 0.0);
        return flat.caption("Nothing but rounding.");
    }
    let mut drawn = figures::history(h);
    let o = &summary["outputs"][&h.name];
    let of = |x: &str, t: &str| (value(&o[t]), value(&o[x]) * h.shown.factor);
    let (max, min) = (of("max", "t_max"), of("min", "t_min"));
    if max.1.is_finite() && min.1.is_finite() {
        let (most, other) = if max.1.abs() >= min.1.abs() { (max, min) } else { (min, max) };
        let across = most.1 * other.1 < 0.0 && other.1.abs() > OTHER * most.1.abs();
        drawn.peaks =
            std::iter::once(most).chain(across.then_some(other)).map(|p| (0, p)).collect();
    }
    if !h.kind.is_empty() {
        drawn = drawn.scaled(format!("kind {}", h.kind));
    }
    drawn
}

pub(super) fn plan(data: &RunData, still: bool) -> Markup {
    html! {
        p.note { "Two directions of one place against each other, a unit as long on both axes; the dot is the time of the model." }
        div.figures.board.loops { @for o in &data.orbits { (figure(figures::orbit(o), "", still)) } }
    }
}

pub(super) fn profiles(data: &RunData, still: bool) -> Markup {
    html! {
        p.note { "Largest magnitudes over the height, whenever they were." }
        div.figures.board.loops { @for p in &data.profiles { (figure(figures::profile(p), "", still)) } }
    }
}

pub(super) fn members(data: &RunData, still: bool) -> Markup {
    let mut kinds: Vec<(&str, &str)> = Vec::new();
    for m in &data.members {
        if !kinds.contains(&(&m.envelope, &m.force)) {
            kinds.push((&m.envelope, &m.force));
        }
    }
    let of = |envelope: &str, force: &str| {
        let scale = format!("member {envelope} {force}");
        let these = data.members.iter().filter(|m| m.envelope == envelope && m.force == force);
        these.map(|m| figures::member(m).scaled(scale.clone())).collect::<Vec<_>>()
    };
    html! {
        p.note { "The largest and the smallest value at each place, whenever they were; signs as in the guide: tension is positive." }
        label.scales { input type="checkbox" checked data-scales="member "; " one scale for a force of all members" }
        @for (envelope, force) in kinds {
            h3 { (envelope) ": " (force) }
            div.figures.board.loops { (drawn(&of(envelope, force), still)) }
        }
    }
}

pub(super) fn loops(data: &RunData, still: bool) -> Markup {
    let key = |l: &Loop| (l.kind.clone(), l.coordinate.clone());
    let mut kinds: Vec<(String, String)> = Vec::new();
    for l in &data.loops {
        if !kinds.contains(&key(l)) {
            kinds.push(key(l));
        }
    }
    // Coordinates of a kind behind each other.
    let first = |kind: &str| data.loops.iter().position(|l| l.kind == kind);
    kinds.sort_by_key(|k| first(&k.0));
    let of = |kind: &str, coordinate: &str| {
        let scale = format!("loop {kind} {coordinate}");
        let these = data.loops.iter().filter(|l| l.kind == kind && l.coordinate == coordinate);
        these.map(|l| figures::link_loop(l).scaled(scale.clone())).collect::<Vec<_>>()
    };
    html! {
        p.note { "Force over deformation; U1, U2 … are the local axes of the link, U1 along it." }
        label.scales { input type="checkbox" checked data-scales="loop "; " one scale of force for all of a kind" }
        @for (kind, coordinate) in kinds {
            h3 { (kind) " " (coordinate) }
            div.figures.board.loops { (drawn(&of(&kind, &coordinate), still)) }
        }
    }
}

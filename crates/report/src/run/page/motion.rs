//! The model as it moves.

use crate::run::data::{Family, RunData};
use crate::run::drawing;
use crate::run::units::short;
use maud::{Markup, PreEscaped, html};

pub(super) fn motion(data: &RunData, still: bool) -> Markup {
    let peak = drawing::largest(data).filter(|_| data.frames.t.len() > 1);
    html! {
        @if still { div.still {
            (PreEscaped(drawing::svg(data, &[], "The model", true)))
            @if let Some((frame, scale)) = peak {
                p.note {
                    "Moved as at " (short(data.frames.t[frame], 5)) " s, "
                    @if scale == 1.0 { "to scale" } @else { (short(scale, 3)) " times as much" }
                    "; at rest in grey."
                }
                (PreEscaped(drawing::svg(
                    data,
                    &drawing::displaced(data, frame, scale),
                    "The model as it moves",
                    false,
                )))
            }
        } }
        div.stage.live {
            canvas id="stage" tabindex="0" role="img" aria-label="The moving model; the controls below play it" {}
            div.tip hidden {}
        }
        div.controls.live #player data-scale=(peak.map_or(1.0, |p| p.1)) {}
        div.controls.live #finder {}
        p.note.live {
            @if data.picture.plane.is_none() { "Drag or one finger turns the model, with Shift it moves it" } @else { "Drag moves the model" }
            "; wheel (after a click) or two fingers bring it closer; double-click resets. Keys, after a click: Shift and arrows turn, Ctrl and arrows move, + and − come closer and go away, 0 resets. Point at a part for its name."
        }
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

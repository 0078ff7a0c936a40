//! Time histories and hysteresis loops.

use super::figure;
use super::rounding::Outputs;
use crate::run::{RunData, figures};
use maud::{Markup, html};
use serde_json::Value;

pub(super) fn histories(summary: &Value, data: &RunData) -> Markup {
    let outputs = Outputs::of(summary);
    let caption = |name: &str| match outputs.is_rounding(name) {
        true => "Nothing but rounding.",
        false => "",
    };
    html! {
        p.note.live {
            "Drag to zoom in time, double-click to see all; arrow keys move the time of all figures and of the model."
        }
        div.figures.board { @for (i, h) in data.histories.iter().enumerate() {
            (figure(&format!("history {i}"), &figures::history(h), caption(&h.name), None))
        } }
    }
}

pub(super) fn loops(data: &RunData) -> Markup {
    html! {
        p.note { "Force over deformation; U1, U2 … are the local axes of the link, U1 along it." }
        div.figures.board.loops { @for (i, l) in data.loops.iter().enumerate() {
            (figure(&format!("loop {i}"), &figures::link_loop(l), &format!("{} ({})", l.link, l.kind), None))
        } }
    }
}

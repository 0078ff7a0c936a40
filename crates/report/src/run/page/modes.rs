//! Mode shapes.

use crate::run::data::Mode;
use crate::run::units::{number, percent};
use crate::run::{RunData, drawing};
use maud::{Markup, PreEscaped, html};

pub(super) fn modes(data: &RunData, still: bool) -> Markup {
    let free = match data.free_modes {
        0 => String::new(),
        1 => " One motion has no stiffness: its mode is not shown.".into(),
        n => format!(" {n} motions have no stiffness: their modes are not shown."),
    };
    let board = |with_links| {
        let own = data.modes.iter().enumerate().filter(move |(_, m)| m.with_links == with_links);
        html! { div.figures.board.modes { @for (i, m) in own { (figure(data, i, m, still)) } } }
    };
    let is_there = |with_links| data.modes.iter().any(|m| m.with_links == with_links);
    html! {
        @if is_there(true) {
            p.note {
                "With the links as stiff as they are when engaged: closed, sticking, elastic. Modes at other states, and by "
                "secants of cycles: " code { "trilith modes --links tangent" } ", " code { "--links secant" } "."
            }
            (board(true))
        }
        @if is_there(false) {
            p.note { "Of the structure without its links." (free) }
            (board(false))
        }
    }
}

fn figure(data: &RunData, i: usize, m: &Mode, still: bool) -> Markup {
    let n = data.picture.points.len();
    html! {
        figure {
            @if still { div.still { (PreEscaped(drawing::mode_svg(data, &drawing::mode(data, i, n), &format!("Mode {}", m.number)))) } }
            div.stage.live { canvas data-mode=(i) role="img" aria-label={ "Mode " (m.number) } {} }
            figcaption {
                b { "Mode " (m.number) ": " (number(m.frequency)) " Hz" } ", " (number(1.0 / m.frequency)) " s"
                // A structure that floats without its links carries all mass in its free motions.
                @if m.participation.iter().any(|x| *x > 5e-5) {
                    "; mass X " (percent(m.participation[0])) ", Y " (percent(m.participation[1])) ", Z " (percent(m.participation[2]))
                }
            }
        }
    }
}

//! Mode shapes.

use crate::run::units::{number, percent};
use crate::run::{RunData, drawing};
use maud::{Markup, PreEscaped, html};

pub(super) fn modes(data: &RunData, still: bool) -> Markup {
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
        } }
    }
}

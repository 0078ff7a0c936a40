//! The motion of the ground and the spectra of the floors.

use super::{figure, figures as drawn, value};
use crate::run::units::{number, short};
use crate::run::{RunData, figures};
use maud::{Markup, html};
use serde_json::Value;
use trilith_model::STANDARD_GRAVITY;

/// An acceleration in g.
fn in_g(x: f64) -> String {
    number(x / STANDARD_GRAVITY)
}

pub(super) fn ground(data: &RunData, still: bool) -> Markup {
    let peak = |g: &crate::run::Ground| {
        format!("Peak {} g ({} m/s²) at {} s.", in_g(g.peak), number(g.peak), short(g.t_peak, 4))
    };
    html! {
        p.note { "The acceleration of the base that loads the model, positive along the axis, over the whole case." }
        div.figures.board {
            (drawn(&data.ground.iter().map(|g| figures::ground(g).caption(peak(g))).collect::<Vec<_>>(), still))
            @for s in &data.ground_spectra {
                (figure(figures::spectra(s).sized(440, 240), "Pseudo-acceleration of oscillators on the ground.", still))
            }
        }
    }
}

pub(super) fn floors(summary: &Value, data: &RunData, still: bool) -> Markup {
    // In the order of the model, which a JSON object does not keep.
    let mut names: Vec<&str> = Vec::new();
    for curve in data.floor_spectra.iter().flat_map(|c| &c.curves) {
        if !names.contains(&curve.name.as_str()) {
            names.push(&curve.name);
        }
    }
    let floors = names.into_iter().map(|name| (name, &summary["spectra"][name]));
    html! {
        p.note {
            "Largest absolute acceleration of oscillators on each place, from its acceleration at the output times. "
            "All curves are in " code { "spectra.csv" } "."
        }
        div.figures.board {
            (drawn(&data.floor_spectra.iter().map(|s| figures::spectra(s).scaled("floors")).collect::<Vec<_>>(), still))
        }
        div.wide { table {
            thead { tr {
                th { "place" } th { "damping" } th { "largest [g]" } th { "period [s]" } th { "frequency [Hz]" } th { "rigid [g]" }
            } }
            tbody { @for (name, floor) in floors {
                @for p in floor["peaks"].as_array().into_iter().flatten() { tr {
                    td { (name) }
                    td.num { (short(100.0 * value(&p["damping"]), 3)) " %" }
                    td.num { (in_g(value(&p["sa"]))) }
                    td.num { (number(value(&p["period"]))) }
                    td.num { (number(1.0 / value(&p["period"]))) }
                    td.num { (in_g(value(&floor["zpa"]))) }
                } }
            } }
        } }
    }
}

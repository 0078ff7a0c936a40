//! How the run was made.

use super::{text, value};
use crate::run::RunData;
use crate::run::units::{number, percent};
use maud::{Markup, html};
use serde_json::Value;

pub(super) fn settings(summary: &Value, data: &RunData) -> Markup {
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
        ("build of it".into(), text(&summary["build"])),
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
